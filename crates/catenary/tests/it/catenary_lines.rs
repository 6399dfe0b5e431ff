//! Whole lines between two ends, against numbers not made here and against equilibrium itself.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

use crate::random::RandomNumbers;
use windlass_catenary::{Heap, Joint, Line, LineError, SeabedModel, Segment};

struct PlacedLine {
    x: f64,
    z: f64,
    segment: Segment,
    friction: f64,
    suspended: bool,
    want: [f64; 4],
    regime: String,
}

fn cases() -> Vec<PlacedLine> {
    let mut reader = csv::Reader::from_path("../../tests/data/catenary_2000.csv").unwrap();
    let heads = reader.headers().unwrap().clone();
    let position = |name: &str| heads.iter().position(|h| h == name).unwrap();
    reader
        .records()
        .map(|r| {
            let r = r.unwrap();
            let number = |name: &str| r[position(name)].parse::<f64>().unwrap();
            PlacedLine {
                x: number("x_m"),
                z: number("z_m"),
                segment: Segment { length: number("length_m"), weight: number("w_N_per_m"), ea: number("EA_N") },
                friction: number("friction"),
                suspended: number("suspended") == 1.0,
                want: ["fairlead_H_N", "fairlead_V_N", "anchor_H_N", "anchor_V_N"].map(number),
                regime: r[position("regime")].to_string(),
            }
        })
        .collect()
}

/// The 2,000 lines of the validation data, each cut in pieces.
fn check(pieces: usize) {
    let (mut worst, mut wrong) = (0.0_f64, Vec::new());
    for (row, case) in cases().iter().enumerate() {
        let part = Segment { length: case.segment.length / pieces as f64, ..case.segment };
        let line = Line::new(vec![part; pieces], vec![Joint::Free; pieces - 1], 0.0, 1e4).unwrap();
        let floor = SeabedModel { elevation: 0.0, slope: 0.0, friction: case.friction };
        let line = line.with_seabed((!case.suspended).then_some(floor)).unwrap();
        match line.at_distance(case.x, case.z) {
            Ok(s) => {
                let got = [s.force, s.top_vertical, s.anchor_horizontal, s.anchor_vertical];
                let scale = case.want[0].hypot(case.want[1]);
                let off = got.iter().zip(&case.want).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
                let off = if scale > 0.0 { off / scale } else { off };
                worst = worst.max(off);
                if off > 1e-8 {
                    wrong.push(format!("{row} {} {off:.2e}: {got:?} {:?}", case.regime, case.want));
                }
            }
            Err(error) => wrong.push(format!("{row} {}: {error}", case.regime)),
        }
    }
    println!("{pieces} pieces: worst {worst:.2e}");
    assert!(wrong.is_empty(), "{} wrong\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn all_2000_whole_lines_agree_to_1e_8_of_fairlead_tension() {
    check(1);
}

#[test]
fn all_2000_lines_cut_in_three_agree_to_1e_8_of_fairlead_tension() {
    check(3);
}

/// Walks down a solved line in small steps with nothing of the engine but the forces at the upper ends of its segments
/// and their lengths on the bottom; what contradicts equilibrium or geometry, or with `true`, the error it ends in.
fn contradiction(
    line: &Line,
    joints: &[Joint],
    floor: SeabedModel,
    fairlead: f64,
    anchor: f64,
    x: f64,
) -> Result<(), (bool, String)> {
    let wrong = |what: String| Err((false, what));
    const STEPS: usize = 4000;
    let state = match line.at_distance(x, fairlead) {
        Ok(state) => state,
        Err(LineError::Undetermined) => return Ok(()),
        Err(error) => return Err((true, error.to_string())),
    };
    let (sin, cos) = (floor.slope / floor.slope.hypot(1.0), 1.0 / floor.slope.hypot(1.0));
    let bottom = |at: f64| floor.elevation + (x - at) * floor.slope;
    let weight: f64 = line.segments().iter().map(|s| s.weight.abs() * s.length).sum();
    let force = 1e-7 * (state.top_tension + weight);
    let stretched: f64 = line.segments().iter().map(|s| s.length * (1.0 + state.top_tension / s.ea)).sum();
    let position = 2e-3 * (stretched + fairlead.abs() + floor.elevation.abs());
    // what lies in a heap, of which a solution says where it is and how long
    let mut heap = match state.heap {
        Some((Heap::Touchdown, length)) => length,
        _ => 0.0,
    };
    let heaped = heap > 0.0;
    let fine = 1e-9 * stretched;
    // what has slid down to the anchor lies in a heap there
    let slides = matches!(state.heap, Some((Heap::Anchor, _)));
    let mut slid = false;
    let (mut at, mut z) = (0.0, fairlead);
    let (mut h, mut v) = (state.segments[0].top_horizontal, state.segments[0].top_vertical);
    for (index, (s, got)) in line.segments().iter().zip(&state.segments).enumerate() {
        if (got.top_horizontal - h).abs() > force || (got.top_vertical - v).abs() > force {
            return wrong(format!("segment {} begins with {h} {v}, not as {got:?}", index + 1));
        }
        let rests = got.grounded > 0.0;
        let above = if rests { (v * cos - h * sin) / (s.weight * cos) } else { s.length };
        let below = s.length - above - got.grounded;
        let hang = |length: f64, at: &mut f64, z: &mut f64, h: f64, v: &mut f64| {
            let ds = length / STEPS as f64;
            for _ in 0..STEPS {
                let middle = *v - 0.5 * s.weight * ds;
                let stretch = ds * (1.0 / h.hypot(middle).max(f64::MIN_POSITIVE) + 1.0 / s.ea);
                *at += h * stretch;
                *z -= middle * stretch;
                *v -= s.weight * ds;
                if *z < bottom(*at) - position {
                    return Some(bottom(*at) - *z);
                }
            }
            None
        };
        if let Some(by) = hang(above, &mut at, &mut z, h, &mut v) {
            return wrong(format!("segment {} is {by} m below the bottom", index + 1));
        }
        if rests {
            if (z - bottom(at)).abs() > position || (v * cos - h * sin).abs() > force {
                return wrong(format!("segment {} touches down at {} above the bottom", index + 1, z - bottom(at)));
            }
            // Coulomb friction toward the fairlead and the weight along the slope, down to nothing
            let loss = s.weight * (sin + floor.friction * cos);
            let tension = if heap > fine || slid { 0.0 } else { h * cos + v * sin };
            let in_heap = if slid { got.grounded } else { heap.min(got.grounded) };
            heap -= in_heap;
            let grounded = got.grounded - in_heap;
            let under = if loss > 0.0 { (tension / loss).min(grounded) } else { grounded };
            let left = (tension - loss * under).max(0.0);
            let stretch = 0.5 * (tension + left) / s.ea * under;
            let mut lies = if sin > floor.friction * cos { under } else { grounded };
            if state.slack && !heaped {
                // a heap is where the state says that the joint or the anchor is
                let end = state.joints.get(index).map_or(x, |j| j.x);
                lies = ((end - at) / cos).min(lies + stretch).max(0.0) - stretch;
            }
            let length = lies + stretch;
            at += length * cos;
            z -= length * sin;
            if slides && !slid && left == 0.0 && under < grounded {
                if (at - x).abs() > position {
                    return wrong(format!("slides from {at}, not the anchor"));
                }
                slid = true;
            }
            (h, v) = (left * cos, left * sin);
            if let Some(by) = hang(below.max(0.0), &mut at, &mut z, h, &mut v) {
                return wrong(format!("segment {} is {by} m below the bottom after its rest", index + 1));
            }
        }
        let (Some(joint), Some(found)) = (joints.get(index), state.joints.get(index)) else { continue };
        if (found.x - at).abs() > position || (found.z - z).abs() > position {
            return wrong(format!("joint {} at {at} {z}, not as {found:?}", index + 1));
        }
        let on_bottom = (z - bottom(at)).abs() < position;
        let lift = match joint {
            Joint::Free => 0.0,
            Joint::Weight(w) => -w,
            Joint::SpringBuoy { .. } | Joint::Buoy { .. } => found.lift,
        };
        if found.reaction < 0.0 || (found.reaction > 0.0 && !on_bottom) {
            return wrong(format!("joint {} at {z} is carried by no bottom {}: {found:?}", index + 1, bottom(at)));
        }
        if (heap > fine || slid) && on_bottom {
            // what carries in a heap is level
            (h, v) = (0.0, v + lift + found.reaction / cos);
            continue;
        }
        // the bottom's reaction along its normal, and friction on it: no more than leaves the line beyond it upright
        let friction = (floor.friction * found.reaction).min((h - found.reaction * sin) / cos);
        let pushed = (h - found.reaction * sin - friction * cos, v + lift + found.reaction * cos - friction * sin);
        // a heap that ends here holds the joint with any force up to that
        let next = state.segments.get(index + 1).map_or(pushed, |s| (s.top_horizontal, s.top_vertical));
        let held = heaped && heap <= fine && rests && found.reaction > 0.0 && (0.0..pushed.0 + force).contains(&next.0);
        (h, v) = if held { next } else { pushed };
    }
    if (at - x).abs() > position || (z - anchor).abs() > position {
        return wrong(format!("the anchor at {at} {z}, not {x} {anchor}: {state:?}"));
    }
    if (h - state.anchor_horizontal).abs() > force || (v - state.anchor_vertical).abs() > force {
        return wrong(format!("the anchor is pulled with {h} {v}: {state:?}"));
    }
    Ok(())
}

/// Ranges of random lines: pieces at most, slopes and frictions of the bottom, and whether buoys and buoyant pieces are among them.
#[derive(Clone, Copy)]
struct LineRange {
    pieces: f64,
    slopes: f64,
    frictions: f64,
    lifts: bool,
}

/// A random line between two ends.
struct RandomLine {
    segments: Vec<Segment>,
    joints: Vec<Joint>,
    floor: SeabedModel,
    fairlead: f64,
    anchor: f64,
    x: f64,
}

impl RandomLine {
    fn new(dice: &mut RandomNumbers, range: LineRange) -> Self {
        let LineRange { pieces, slopes, frictions, lifts } = range;
        let pieces = 1 + (dice.roll() * pieces) as usize;
        let segments: Vec<Segment> = (0..pieces)
            .map(|_| Segment {
                length: dice.number_between(30.0, 900.0),
                weight: dice.scale(1.0, 3.7) * if lifts && dice.roll() < 0.15 { -0.3 } else { 1.0 },
                ea: dice.scale(6.5, 10.0),
            })
            .collect();
        let joints: Vec<Joint> = (1..pieces)
            .map(|_| match (dice.roll() * 4.0) as usize {
                0 => Joint::Weight(dice.scale(3.0, 5.5)),
                1 if lifts => Joint::Weight(-dice.scale(3.0, 5.5)),
                2 if lifts => Joint::Buoy { lift: dice.scale(3.0, 6.0), weight: dice.scale(2.0, 4.0) },
                _ => Joint::Free,
            })
            .collect();
        let depth = dice.number_between(20.0, 1500.0);
        let (slope, friction) = (slopes * dice.number_between(-1.0, 1.0), frictions * dice.roll());
        let up = if slopes == 0.0 && frictions == 0.0 && dice.roll() < 0.3 {
            dice.number_between(0.0, 0.8 * depth)
        } else {
            0.0
        };
        let floor = SeabedModel { elevation: -depth, slope, friction };
        let length: f64 = segments.iter().map(|s| s.length).sum();
        let x = length * dice.number_between(0.05, 1.1);
        let fairlead = -dice.number_between(0.0, 0.5) * depth;
        RandomLine { segments, joints, floor, fairlead, anchor: -depth + up, x }
    }

    /// What contradicts its equilibrium, as [`contradiction`] finds it; nothing where its fairlead is in the bottom.
    fn contradiction(&self) -> Result<(), (bool, String)> {
        let RandomLine { segments, joints, floor, fairlead, anchor, x } = self;
        if *fairlead < floor.elevation + x * floor.slope {
            return Ok(());
        }
        let line = Line::new(segments.clone(), joints.clone(), *anchor, 0.0).unwrap();
        let found = contradiction(&line.with_seabed(Some(*floor)).unwrap(), joints, *floor, *fairlead, *anchor, *x);
        found.map_err(|(refused, what)| {
            let line = format!("x {x} fairlead {fairlead} anchor {anchor} {floor:?} {segments:?} {joints:?}");
            (refused, format!("{what}\n   {line}"))
        })
    }
}

/// At most `refused` lines may end in an error; none may contradict equilibrium.
fn random_lines(count: usize, slopes: f64, frictions: f64, lifts: bool, refused: usize) {
    let mut dice = RandomNumbers(7);
    let (mut wrong, mut errors) = (Vec::new(), 0);
    for number in 0..count {
        let line = RandomLine::new(&mut dice, LineRange { pieces: 5.0, slopes, frictions, lifts });
        if let Err((error, what)) = line.contradiction() {
            errors += usize::from(error);
            if error && errors <= refused {
                continue;
            }
            wrong.push(format!("{number}: {what}"));
        }
    }
    println!("slopes to {slopes}, friction to {frictions}, buoys {lifts}: {errors} of {count} refused");
    assert!(
        wrong.is_empty(),
        "{} wrong\n{}",
        wrong.len(),
        wrong.iter().take(6).cloned().collect::<Vec<_>>().join("\n")
    );
}

#[test]
fn random_lines_with_clumps_on_flat_seabed_are_in_equilibrium() {
    random_lines(1000, 0.0, 0.0, false, 0);
}

#[test]
fn random_lines_with_buoys_and_buoyant_segments_are_in_equilibrium() {
    random_lines(1000, 0.0, 0.0, true, 0);
}

#[test]
fn random_lines_with_friction_are_in_equilibrium() {
    random_lines(1000, 0.0, 1.0, false, 0);
}

#[test]
fn random_lines_on_smooth_slope_are_in_equilibrium() {
    random_lines(1000, 0.15, 0.0, false, 0);
}

#[test]
fn random_lines_with_friction_and_buoys_balance_or_are_refused() {
    random_lines(1000, 0.0, 1.0, true, 0);
}

#[test]
fn random_lines_on_rough_slope_with_clumps_are_in_equilibrium() {
    random_lines(1000, 0.15, 1.0, false, 0);
}

#[test]
fn random_buoyed_lines_on_rough_slope_balance_or_are_refused() {
    random_lines(1000, 0.15, 1.0, true, 0);
}

#[test]
fn lines_at_folds_of_friction_are_in_equilibrium() {
    // lines of up to twelve pieces, by the seeds they come from and their numbers: of 200,000 those whose end jumps where a buoy sinks on the way,
    // where several places are there to leave the bottom from, where a span only just touches it, and where two spans are at folds at once
    let lines: [(u64, f64, &[usize]); 12] = [
        (8_919, 0.0, &[896, 4341]),
        (8_919, 0.15, &[4341]),
        (16_838, 0.0, &[3943]),
        (16_838, 0.15, &[2581]),
        (24_757, 0.0, &[1005, 4706]),
        (48_514, 0.0, &[184, 3550]),
        (48_514, 0.15, &[1387, 2736, 4670]),
        (56_433, 0.0, &[1352, 2526]),
        (72_271, 0.0, &[3816]),
        (72_271, 0.15, &[3136, 3745, 3816]),
        (80_190, 0.0, &[1248, 2071]),
        (80_190, 0.15, &[530]),
    ];
    for (seed, slopes, numbers) in lines {
        let mut dice = RandomNumbers(seed);
        for number in 0..=numbers.iter().copied().max().unwrap() {
            let line = RandomLine::new(&mut dice, LineRange { pieces: 12.0, slopes, frictions: 1.0, lifts: true });
            if numbers.contains(&number) {
                assert_eq!(line.contradiction(), Ok(()), "{seed} {slopes} {number}");
            }
        }
    }
}

#[test]
fn line_that_ends_beside_its_anchor_is_not_taken_as_solved() {
    // a buoy that lifts its line off the bottom stands at the end of a jump, 54 m beyond the anchor, and the line there is so soft that
    // no force is missing; what is given back is in equilibrium, or an error
    let rows = [
        (365.022_956_882_380_6, -5.252_589_542_971_878, 4_435_974_018.2),
        (774.687_326_254_821_5, 1_544.433_596_031_206, 50_679_763.4),
        (627.435_763_924_456_2, 12.805_508_773_920_284, 94_789_523.2),
        (651.729_686_384_879_3, 40.744_506_056_030_694, 2_146_085_182.2),
        (418.935_110_109_975_8, -51.102_350_957_532_23, 10_109_385.0),
        (633.672_644_981_943_4, 43.138_814_649_044_61, 26_081_087.0),
        (81.999_469_071_978_03, 1_065.920_232_808_232_6, 32_322_377.7),
        (553.330_254_605_434_6, -21.186_048_197_155_74, 117_203_268.9),
        (351.723_077_879_185_5, 29.459_523_273_550_92, 12_200_361.9),
        (871.308_817_577_582_2, 4_571.136_107_793_322, 6_130_063.4),
        (178.643_462_645_755_25, 2_383.058_601_936_497, 143_237_488.4),
        (59.325_886_918_646_59, 12.428_184_374_843_978, 388_229_821.6),
    ];
    let segments = rows.map(|(length, weight, ea)| Segment { length, weight, ea }).to_vec();
    let joints = vec![
        Joint::Weight(7_922.399_673_329_872),
        Joint::Free,
        Joint::Weight(-61_060.081_541_458_83),
        Joint::Weight(5_187.136_716_932_971),
        Joint::Weight(-226_095.780_285_452),
        Joint::Free,
        Joint::Free,
        Joint::Buoy { lift: 9_125.323_090_600_91, weight: 5_667.617_469_070_902 },
        Joint::Buoy { lift: 132_339.459_828_059_04, weight: 1_690.265_621_300_871_8 },
        Joint::Weight(1_544.094_639_259_853_2),
        Joint::Buoy { lift: 318_331.304_629_101_9, weight: 670.258_733_300_892_1 },
    ];
    let depth = 729.774_791_007_007_3;
    let floor = SeabedModel { elevation: -depth, slope: 0.0, friction: 0.582_121_302_512_163_2 };
    let line = Line::new(segments, joints.clone(), -depth, 0.0).unwrap().with_seabed(Some(floor)).unwrap();
    let around = (0..=40).map(|step| 2_300.0 + 3.0 * f64::from(step));
    for x in around.chain([2_353.983_048_819_771_7]) {
        if let Err((false, what)) = contradiction(&line, &joints, floor, -134.871_781_466_203, -depth, x) {
            panic!("{x}: {what}");
        }
    }
}

#[test]
fn slack_line_on_smooth_slope_hangs_on_anchor_or_slides_to_it() {
    let heavy = Segment { length: 600.0, weight: 1000.0, ea: 1e15 };
    let on = |slope: f64, friction: f64| Some(SeabedModel { elevation: -100.0, slope, friction });
    let line = |slope, friction| {
        Line::new(vec![heavy], vec![], -100.0, 0.0).unwrap().with_seabed(on(slope, friction)).unwrap()
    };
    // deeper toward the fairlead: 130 m hang down to the foot, and hypot(300, 30) m on the anchor by w (sin - mu cos)
    for friction in [0.0, 0.04] {
        let state = line(-0.1, friction).at_distance(300.0, 0.0).unwrap();
        let lies = 300f64.hypot(30.0);
        let (sin, cos) = (30.0 / lies, 300.0 / lies);
        let pull = 1000.0 * (sin - friction * cos) * lies;
        assert_eq!(state.force, 0.0);
        assert!((state.top_vertical - 130e3).abs() < 1e-3, "{state:?}");
        assert!(
            (state.anchor_horizontal - pull * cos).abs() < 1e-3 && (state.anchor_vertical + pull * sin).abs() < 1e-3
        );
        assert!(
            matches!(state.heap, Some((Heap::Touchdown, m)) if (m - (600.0 - 130.0 - lies)).abs() < 1e-6),
            "{state:?}"
        );
    }
    // deeper toward the anchor, without friction: T = w lying there from the anchor, where it is zero, to the touchdown
    let state = line(0.1, 0.0).at_distance(300.0, 0.0).unwrap();
    let (x, z) = state.touchdown.unwrap();
    let lies = (300.0 - x).hypot(z + 100.0);
    assert!((state.force - 1000.0 * lies * (0.1 / 1f64.hypot(0.1)) / 1f64.hypot(0.1)).abs() < 1e-3, "{state:?}");
    assert!(matches!(state.heap, Some((Heap::Anchor, _))) && state.anchor_horizontal == 0.0);
    for slope in [-0.1, 0.1] {
        let held = line(slope, 0.5).at_distance(300.0, 0.0).unwrap();
        // it hangs down to the bottom beneath
        let depth = 100.0 - 300.0 * slope;
        assert!((held.top_vertical - 1000.0 * depth).abs() < 1e-3 * held.top_vertical, "{held:?}");
    }
    // a clump of 23.5 kN on a slope of 1 in 4 pulls the line above it uphill only as far as friction bears it
    let soft = Segment { length: 32.5, weight: 139.0, ea: 168_000.0 };
    let below = Segment { length: 138.0, weight: 12.0, ea: 540_000.0 };
    let clump = Line::new(vec![soft, below], vec![Joint::Weight(23_500.0)], -45.0, 0.0).unwrap();
    let clump = clump.with_seabed(Some(SeabedModel { elevation: -45.0, slope: 0.25, friction: 1.3 })).unwrap();
    if let Ok(state) = clump.at_distance(28.8, 0.0) {
        assert!(state.force > -1.0, "it does not push: {state:?}");
    }
}

#[test]
fn numbers_with_overflowing_squares_are_refused() {
    for (length, x, z, weight, ea) in
        [(1e10, 1e10, 1e10, 1e300, 1e300), (1e300, 1e300, 1e300, 1.0, 1e9), (1.0, 1e200, 1.0, 1.0, 1.0)]
    {
        let segment = Segment { length, weight, ea };
        assert!(segment.solve_end_forces(x, z, None).is_err(), "{segment:?}");
    }
}

#[test]
fn slack_line_with_fairlead_on_seabed_has_no_force() {
    let heavy = Segment { length: 100.0, weight: 1000.0, ea: 1e9 };
    let light = Segment { length: 50.0, weight: -100.0, ea: 1e9 };
    let line = Line::new(vec![heavy, light, heavy], vec![Joint::Free; 2], -100.0, 0.0).unwrap();
    for x in [0.0, 150.0] {
        let state = line.at_distance(x, -100.0).unwrap();
        assert!(state.force == 0.0 && state.top_vertical.abs() <= 1e-6, "{x}: {state:?}");
    }
}
