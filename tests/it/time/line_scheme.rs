//! The scheme of a run as its dynamic lines have it, against the closed form of the scheme.

use crate::common::run as runs;
use runs::{model, run, settings};
use std::f64::consts::TAU;
use windlass_solve::run_tables::run_table;
use windlass_solve::time::{Method, Run, RunSettings, TimeScheme};

/// Mass of the line (kg), and of what hangs on it.
const LINE: f64 = 1000.0;
const BODY: f64 = 10.0;
/// Axial stiffness of the line (N/m).
const STIFFNESS: f64 = 1e5;

/// A body on a vertical line of one element in air, let go 5 mm below its rest. The line has its mass at its nodes, so that a half of
/// it swings with the body, fifty times as heavy: it is the line that damps.
fn swung(method: Method, steps: f64, periods: f64) -> Run {
    let (g, moved) = (9.80665, BODY + 0.5 * LINE);
    let (length, period) = (10.0, TAU * (moved / STIFFNESS).sqrt());
    let below = moved * g / STIFFNESS + 0.005;
    let records = format!(
        "MEDIT\n*G 0 0 60\n&DESCRIBE BODY B -IGNORE X Y RX RY RZ\n*B 0 0 50\n#WEIGHT *B {} 1 1 1\n\
         ~L ROD 50 25 -LEN {length} -REFINE 1 -EI 0 -EA {} -WTPLEN {} -CD 0 -CA 0\nCONNECTOR K ~L *B *G\nEND\n\
         &INSTATE -LOCATE B 0 0 {}\n",
        BODY * g,
        STIFFNESS * length,
        LINE * g / length,
        -below
    );
    run(&model(&records), RunSettings { method, ..settings(periods * period, period / steps) }, vec![])
}

/// Share of critical damping of the oscillation, from one turn of its phase to another, by place and velocity.
fn damping(made: &Run, periods: [usize; 2], steps: f64) -> f64 {
    let at = made.history.layout.body(0);
    let rest = -(BODY + 0.5 * LINE) * 9.80665 / STIFFNESS;
    let w = (STIFFNESS / (BODY + 0.5 * LINE)).sqrt();
    let rows: Vec<[f64; 2]> = made.history.rows().map(|r| [r[at + 2] - rest, r[at + 8] / w]).collect();
    let [first, last] = periods.map(|p| (p as f64 * steps) as usize);
    let size = |r: [f64; 2]| r[0].hypot(r[1]);
    let turned: f64 = rows[first..=last]
        .windows(2)
        .map(|p| ((-p[1][1]).atan2(p[1][0]) - (-p[0][1]).atan2(p[0][0])).rem_euclid(TAU))
        .sum();
    let decay = (size(rows[first]) / size(rows[last])).ln();
    decay / turned.hypot(decay)
}

#[test]
fn line_mode_damping_matches_run_scheme() {
    // numpy's eigenvalues of the amplification matrix of the form of [CHUNG-HULBERT-1993 eq. 5 to 8]:
    // M a[n+1-am] + K d[n+1-af] = 0 with Newmark's d and v; damping is -ln|z| / |ln z|
    for (method, steps, closed) in [
        (TimeScheme::generalised_alpha(0.2), 10.0, 0.022552),
        (TimeScheme::generalised_alpha(0.2), 20.0, 0.003954),
        (TimeScheme::generalised_alpha(0.5), 10.0, 0.003780),
        (TimeScheme::generalised_alpha(0.9), 10.0, 0.000017),
        (TimeScheme::generalised_alpha(0.0), 10.0, 0.054905),
        (TimeScheme::newmark(0.3025, 0.6), 20.0, 0.015453),
    ] {
        let made = swung(Method::Implicit(method), steps, 30.0);
        // velocity and acceleration of a decay are not quite those of a sine; phases are met to a step
        let found = damping(&made, [4, 24], steps);
        assert!((found - closed).abs() < 0.03 * closed + 2e-6, "{method:?} {steps}: {found} for {closed}");
    }
}

#[test]
fn line_with_trapezoidal_rule_conserves_energy() {
    let made = swung(Method::Implicit(TimeScheme::generalised_alpha(1.0)), 10.0, 30.0);
    assert!(damping(&made, [4, 24], 10.0).abs() < 1e-6);
}

#[test]
fn corrector_run_table_names_scheme_of_its_lines() {
    let made = swung(Method::Corrector, 40.0, 1.0);
    let said = format!("{:?}", run_table(&made));
    assert!(said.contains("dynamic lines by generalised-alpha, spectral radius 0.200"), "{said}");
}
