//! What dynamic lines are judged by: pressures under waves, both sides of where segments meet, tension at their ends.

use crate::common;
use crate::common::run as runs;

use runs::{model, run, settings};
use std::f64::consts::FRAC_PI_4;
use windlass_base::table::Table;
use windlass_signal::line::lrfd::LrfdFactors;
use windlass_signal::line::working_stress::DesignCase;
use windlass_solve::results::along::{Code, LineResults, check, lines_at_rest};
use windlass_solve::results::events;
use windlass_solve::time::Run;

fn column(table: &Table, name: &str) -> Vec<f64> {
    table.get(name).unwrap_or_else(|| panic!("{name}")).numbers()
}

/// A riser of 500 mm by 20 mm upright between two points of the ground, in a wave of 10 m and 8 s.
fn deep(top: f64) -> Run {
    let records = format!(
        "&ENV -DEPTH 1000 -SEA REGULAR 180 10 8 -RAMP 0\nMEDIT\n&DESCRIBE BODY SHIP -IGNORE X Y Z RX RY RZ\n*T 0 0 {top}\n\
         #WEIGHT *T 1000 5 5 5\n*E 0 0 {}\n~R ROD 500 20 -LEN 500 -REFINE 20 -FYIELD 450\nCONNECTOR A ~R *T *E\nEND\n",
        top - 500.0
    );
    run(&model(&records), settings(16.0, 0.5), vec![])
}

/// Places of the nodes that are there all the time; a winch would make more.
fn there(run: &Run) -> Vec<usize> {
    let columns = run.history.layout.links[0].along.as_ref().unwrap();
    let kept = |position: &usize| run.history.rows().all(|row| columns.node(*position, row).is_some());
    (0..columns.numbers.len()).filter(kept).collect()
}

#[test]
fn wave_does_not_load_riser_far_below() {
    let made = deep(-500.0);
    let line = LineResults::find(&made, "A").unwrap();
    let all = events(&made.history, None).unwrap();
    // exp(-k 500) of a wave of 98.7 m is 1.5e-14, and statics leave 1e-9 of 1.1 MN
    let columns = made.history.layout.links[0].along.as_ref().unwrap();
    let there = there(&made);
    assert_eq!(there.len(), 21);
    for position in there {
        let rows = || made.history.rows().map(|row| columns.node(position, row).unwrap());
        let swing = |of: &dyn Fn(&windlass_solve::time::NodeRow) -> f64| {
            let all: Vec<f64> = rows().map(|n| of(&n)).collect();
            all.iter().fold(f64::MIN, |m, v| m.max(*v)) - all.iter().fold(f64::MAX, |m, v| m.min(*v))
        };
        assert!(swing(&|n| n.effective) < 1.0, "{position}: {}", swing(&|n| n.effective));
        assert!(swing(&|n| n.bent.unwrap().wall) < 1.0, "{position}: {}", swing(&|n| n.bent.unwrap().wall));
    }
    let table = check(&line, &Code::Lrfd(LrfdFactors::default(), 0.0), &all).unwrap();
    for (net, arc) in column(&table, "Net Pressure").iter().zip(column(&table, "Arc")) {
        // rho g h, empty; it stretches by a thousandth at most
        let want = -1025.0 * 9.80665 * (500.0 + arc);
        assert!((net / want - 1.0).abs() < 1e-3, "{arc}: {net} {want}");
    }
}

#[test]
fn riser_pressure_below_wave_matches_wave_at_its_depth() {
    let made = deep(-20.0);
    let columns = made.history.layout.links[0].along.as_ref().unwrap();
    let number = (std::f64::consts::TAU / 8.0).powi(2) / 9.80665;
    for position in there(&made) {
        for row in made.history.rows() {
            let node = columns.node(position, row).unwrap();
            let [x, _, z] = node.position;
            let angle = number * x - std::f64::consts::TAU / 8.0 * row[0];
            // rho g (-z + a exp(k z) cos(k x - w t)), Airy in deep water: 1000 m of water are ten wavelengths
            let want = 1025.0 * 9.80665 * (5.0 * (number * z).exp() * angle.cos() - z);
            let found = node.bent.unwrap().pressures[0];
            // wave numbers are solved to 1e-12; a line leaves out the wave where less than a millionth of its 5 m is left
            assert!((found - want).abs() < 1e-9 * want + 1e-6 * 5.0 * 1025.0 * 9.80665, "{position}: {found} {want}");
        }
    }
}

#[test]
fn thin_pipe_governs_at_thick_junction_from_either_end() {
    let thin = "~R ROD 300 10 -LEN 92.5 -REFINE 6 -FYIELD 450\n";
    let thick = "~R ROD 300 40 -LEN 92.5 -REFINE 6 -FYIELD 450\n";
    let checked = |class: String, ends: &str| {
        let records = format!(
            "&ENV -DEPTH 300\nMEDIT\n&DESCRIBE BODY SHIP -IGNORE X Y Z RX RY RZ\n*T 0 0 -5\n#WEIGHT *T 1000 5 5 5\n*E 150 0 -100\n\
             {class}CONNECTOR A ~R {ends}\nEND\n"
        );
        let table = lines_at_rest(&model(&records), &|_| true).unwrap().remove(0);
        ["Z", "Tension", "Moment", "Wall", "Axial", "Bending", "Von Mises", "Utilisation"]
            .map(|name| column(&table, name)[6])
    };
    let one = checked(format!("{thin}{thick}"), "*T *E");
    let other = checked(format!("{thick}{thin}"), "*E *T");
    for (a, b) in one.iter().zip(&other) {
        // two searches for rest to 1e-9 of the weight, in a hanging shape
        assert!((a / b - 1.0).abs() < 1e-4, "{one:?} {other:?}");
    }
    let [z, tension, moment, wall, axial, bending, mises, used] = one;
    // the thin one by its own section: 300 mm by 10 mm, empty
    let (outside, inside) = (FRAC_PI_4 * 0.09, FRAC_PI_4 * 0.28 * 0.28);
    let second = FRAC_PI_4 / 16.0 * (0.3f64.powi(4) - 0.28f64.powi(4));
    let pressed = tension + 1025.0 * 9.80665 * z * outside;
    // the same formulas another way: rounding
    assert!((wall / pressed - 1.0).abs() < 1e-9, "{wall} {pressed}");
    assert!((axial / (pressed / (outside - inside)) - 1.0).abs() < 1e-9, "{axial}");
    assert!((bending / (moment * 0.15 / second) - 1.0).abs() < 1e-9, "{bending}");
    assert!((used / (mises / 450e6) - 1.0).abs() < 1e-9 && mises > bending, "{used} {mises}");
}

#[test]
fn rope_end_carries_no_compression() {
    let records = "&ENV -DEPTH 60\nMEDIT\n&DESCRIBE BODY SHIP -IGNORE X Y Z RX RY RZ\n*T 0 0 -5\n#WEIGHT *T 1000 5 5 5\n*E 150 0 -60\n\
                   ~R ROD 300 20 -EI 0 -LEN 185 -REFINE 12\nCONNECTOR A ~R *T *E\nEND\n";
    let table = lines_at_rest(&model(records), &|_| true).unwrap().remove(0);
    let tension = column(&table, "Tension");
    assert!(tension.iter().all(|t| *t >= 0.0), "{tension:?}");
}

#[test]
fn paid_out_pipe_is_checked_against_static_state_of_its_position() {
    // a pipe that hangs from a crane in still air: 50 m at first, 100 m in the end, without a load
    let records = "&ENV -DEPTH 500 -TIME 130 0.25\nMEDIT\n&DESCRIBE BODY CRANE -IGNORE X Y Z RX RY RZ\n*H 0 0 150\n\
         &DESCRIBE BODY LOAD -IGNORE X Y RX RY RZ\n*P 0 0 0\n#WEIGHT *P 1000 1 1 1\n\
         ~R ROD 300 20 -LEN 50 -REFINE 10 -FYIELD 450 -TENSTR 535 -WTPLEN 20000 -AX_DAMPING 1E8\nCONNECTOR R ~R *H *P\nEND\n\
         &INSTATE -LOCATE LOAD 0 0 99.99\n&EQUI\n&ACTION LOWER -AT 5 -WINCH R 0.5 100\nTDOM\n";
    let (mut session, _, _folder) = common::session();
    session.open("test", format!("&DIMEN -DIMEN METERS N\n{records}"));
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    let made = session.job.run.as_ref().unwrap();
    let line = LineResults::find(made, "R").unwrap();
    let all = events(&made.history, None).unwrap();
    let factors = LrfdFactors::default();
    let table = check(&line, &Code::Lrfd(factors, 0.0), &all[all.len() - 1..]).unwrap();
    assert!(table.notes.iter().any(|n| n.text.contains("winch")), "{:?}", table.notes);
    // design tension gamma_F T0 + gamma_E (T - T0), T0 that of 50 m from the place to the load and 1000 N
    let (used, arcs, tension) = (column(&table, "Utilisation"), column(&table, "Arc"), column(&table, "Tension"));
    let design = |arc: f64, tension: f64| {
        let rest = 1000.0 + 20_000.0 * (50.0 - arc).max(0.0);
        factors.functional * rest + factors.environmental * (tension - rest)
    };
    // without moments and pressure what is used goes with the tension: its square by the standard's formula
    let share = used[0] / design(arcs[0], tension[0]).powi(2);
    let upper: Vec<usize> = (0..arcs.len()).filter(|i| arcs[*i] < 48.0).collect();
    assert!(upper.len() > 5);
    for i in upper {
        let want = share * design(arcs[i], tension[i]).powi(2);
        // what is left of its swing, and the load at its second end
        assert!((used[i] / want - 1.0).abs() < 5e-3, "{}: {} {want}", arcs[i], used[i]);
    }
}

#[test]
fn corrosion_thins_wall_for_tension_and_internal_pressure() {
    // sea water inside and outside: the stress is that of effective tension in what is left of the wall, less the pressure
    let records = "INMODEL\nT_PRESSURE SEA 0 0 -DENSITY 1025\nEND\n&ENV -DEPTH 3000 -T_PRESSURE SEA\nMEDIT\n&DESCRIBE BODY S -IGNORE X Y Z RX RY RZ\n\
                   *F 0 0 -2990\n*E 0 0 -3000\n#WEIGHT *F 1E6 5 5 5\n\
                   ~R ROD 300 20 -LEN 9.999 -REFINE 10 -FYIELD 450 -WTPLEN 20\nCONNECTOR A ~R *F *E\nEND\n";
    let made = run(&model(records), settings(0.2, 0.1), vec![]);
    let line = LineResults::find(&made, "A").unwrap();
    let all = events(&made.history, None).unwrap();
    let columns = made.history.layout.links[0].along.as_ref().unwrap();
    let node = columns.node(0, made.history.rows().next().unwrap()).unwrap();
    for corroded in [0.0, 0.008] {
        let table = check(&line, &Code::WorkingStress(DesignCase::Operating, corroded), &all).unwrap();
        let wall = 0.02 - corroded;
        let area = FRAC_PI_4 * (0.3f64.powi(2) - (0.3 - 2.0 * wall).powi(2));
        // two thirds of yield stress
        let wanted = node.effective / area / 3e8;
        assert!(
            (column(&table, "Utilisation")[0] / wanted - 1.0).abs() < 5e-3,
            "{corroded}: {} {wanted}",
            column(&table, "Utilisation")[0]
        );
    }
}
