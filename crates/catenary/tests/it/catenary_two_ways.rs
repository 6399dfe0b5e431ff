//! Single lines solved by the engine of single segments and by that of whole lines, which share no search: the same forces.

use crate::random::RandomNumbers;
use windlass_catenary::{FlatBottom, Line, SeabedModel, Segment};

#[test]
fn two_solvers_agree_on_random_lines_of_every_kind() {
    let mut dice = RandomNumbers(12345);
    let (mut worst, mut wrong) = (0.0_f64, Vec::new());
    for number in 0..20_000 {
        let length = dice.scale(1.0, 4.0);
        let weight = dice.scale(0.0, 4.5) * if dice.roll() < 0.1 { -1.0 } else { 1.0 };
        // from half its weight, which is a rubber band, to ten million times
        let ea = weight.abs() * length * dice.scale(-0.3, 7.0);
        let bottom = dice.roll() > 0.4;
        let friction = if dice.roll() < 0.5 { 0.0 } else { dice.number_between(0.0, 1.5) };
        let (reach, angle) =
            (length * dice.number_between(0.0, 1.15), dice.number_between(0.0, std::f64::consts::FRAC_PI_2));
        let (mut x, mut z) = (reach * angle.cos(), reach * angle.sin());
        for value in [&mut x, &mut z] {
            *value *= match (dice.roll() * 20.0) as usize {
                0 => 0.0,
                1 => 1e-6,
                _ => 1.0,
            };
        }
        if !bottom && dice.roll() < 0.5 {
            z = -z;
        }
        let segment = Segment { length, weight, ea };
        let floor = SeabedModel { elevation: 0.0, slope: 0.0, friction };
        let line = Line::new(vec![segment], vec![], 0.0, 1e5).unwrap().with_seabed(bottom.then_some(floor)).unwrap();
        let (one, two) =
            (segment.solve_end_forces(x, z, bottom.then_some(FlatBottom { friction })), line.at_distance(x, z));
        let case = format!("{number}: {segment:?} x {x} z {z} friction {friction} bottom {bottom}");
        let (Ok(one), Ok(two)) = (&one, &two) else {
            wrong.push(format!("{case}: {one:?} {two:?}"));
            continue;
        };
        let [fh, fv, ah, av] = [two.force, two.top_vertical, two.anchor_horizontal, two.anchor_vertical];
        let scale = fh.hypot(fv).max(ah.hypot(av));
        let pairs = [(one.fairlead[0], fh), (one.fairlead[1], fv), (one.anchor[0], ah), (one.anchor[1], av)];
        let off = pairs.iter().fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
        worst = worst.max(off / scale.max(f64::MIN_POSITIVE));
        if off > 1e-9 * scale {
            wrong.push(format!("{case}: {:.2e} {:?} {one:?} {fh} {fv} {ah} {av}", off / scale, one.regime));
        }
    }
    assert!(
        wrong.is_empty(),
        "{} wrong, worst {worst:.2e}\n{}",
        wrong.len(),
        wrong.iter().take(5).cloned().collect::<Vec<_>>().join("\n")
    );
}
