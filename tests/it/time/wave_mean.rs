//! The mean force of undisturbed waves on hulls and members (W_MEAN): a category of its own, and no drift force.

use crate::common;
use crate::common::run as runs;

use runs::settings;
use windlass_base::table::{Cell, Table};
use windlass_model::Model;
use windlass_solve::results::{self, Magnitude};
use windlass_solve::run_tables;
use windlass_solve::time::{Run, SilentWatcher};

/// A held body of pieces, in waves of 4 m and 7 s.
fn held_body(pieces: &str) -> Model {
    let (mut session, screen, _folder) = common::session();
    session.open(
        "records",
        format!(
            "&DIMEN -DIMEN METERS K-NTS\n&DEFAULT -WATER 1025 -G 9.80665\nMEDIT\n&DESCRIBE BODY B -IGNORE X Y Z RX RY RZ\n*G 0 0 0\n\
             *T1 0 0 -30\n*T2 0 0 10\n#WEIGHT *G 1000 5 5 5\n{pieces}\nEND\n\
             &ENV -SEA REGULAR 180 4 7 -STRETCHING LINEAR -TIME 210 0.1 -RAMP 20\n"
        ),
    );
    session.run();
    assert_eq!(session.errors, 0, "{:?} {}", session.reports, screen.text());
    session.job.model.clone()
}

/// The mean of a column over the last ten periods.
fn mean(table: &Table, group: &str, name: &str) -> f64 {
    let found = table.columns().iter().find(|c| c.group == group && c.name == name).unwrap();
    let value = |cell: &Cell| if let Cell::Number(v) = cell { *v } else { f64::NAN };
    found.cells.iter().rev().take(700).map(value).sum::<f64>() / 700.0
}

#[test]
fn mean_pressure_on_flared_hull_matches_waterline_drift() {
    // the pressure on a length of flare is int rho g (zeta - z) dz tan(b) over the mean level, upward, and what a trough takes away of
    // rho g (zeta exp(kz) - z): zeta^2/2, and k zeta^3/2 in troughs, so that the mean is rho g (a^2/4 - k a^3/(3 pi)) times the flare around the
    // waterline: two sides of 40 m, 1 m in 2 m: 374.0 kN. The waterline is closed: none along the waves
    let model = held_body("PGEN HULL -PERM 1 -DIFTYPE FK\nPLANE -20 20 -CARTESIAN 5 -5 10 5\nEND PGEN");
    let mut made = Run::new(&model, settings(210.0, 0.1), vec![]).unwrap();
    made.run(&mut SilentWatcher).unwrap();
    let events = results::events(&made.history, None).unwrap();
    let table = results::body_forces(&made, &[0], Magnitude::default(), &events).unwrap();
    let (a, k) = (2.0f64, (std::f64::consts::TAU / 7.0).powi(2) / 9.80665);
    let want = 1025.0 * 9.80665 * 80.0 * 0.5 * (a * a / 4.0 - k * a.powi(3) / (3.0 * std::f64::consts::PI));
    let got = mean(&table, "W_MEAN", "FZ");
    // fourth powers of k a = 0.16, and a thousandth of the largest force, 5 MN, by panels that the surface cuts: a percent
    let allowed = 0.01 * want;
    assert!((got - want).abs() < allowed, "{got} for {want}");
    assert!(mean(&table, "WAVE", "FZ").abs() < allowed, "{}", mean(&table, "WAVE", "FZ"));
    for group in ["WAVE", "W_MEAN"] {
        assert!(mean(&table, group, "FX").abs() < allowed, "{group} {}", mean(&table, group, "FX"));
    }
    let notes = [table.notes, run_tables::run_table(&made).notes]
        .concat()
        .iter()
        .map(|n| n.text.as_str())
        .collect::<Vec<_>>()
        .join(" ");
    assert!(notes.contains("W_MEAN is what is slow") && notes.contains("B: -DIFTYPE FK is no drift force"), "{notes}");
}

#[test]
fn member_mean_wave_force_excludes_waves_and_drag() {
    let model = held_body("END\n&SURFACE\nTUBE T *T1 *T2 2000 -CD 1");
    let mut made = Run::new(&model, settings(210.0, 0.1), vec![]).unwrap();
    made.run(&mut SilentWatcher).unwrap();
    let events = results::events(&made.history, None).unwrap();
    let table = results::body_forces(&made, &[0], Magnitude::default(), &events).unwrap();
    // pressure and inertia up to the surface: a ~ sin, zeta ~ cos have no mean along the waves; drag has: 1/2 rho Cd D <u|u| zeta> above
    // the mean level, u = a w |cos|: rho Cd D a^3 w^2 / 2 <|cos|cos cos> = 2/(3 pi) .. with <|cos|^3> = 4/(3 pi)
    let w = std::f64::consts::TAU / 7.0;
    let want = 0.5 * 1025.0 * 2.0 * 8.0 * w * w * 4.0 / (3.0 * std::f64::consts::PI);
    let drag = mean(&table, "V_DRAG", "FX");
    // (1 + k zeta)^2 above the level of LINEAR, k a 8 %, is odd in zeta where |u|u is even beside zeta: second order
    assert!((drag / want - 1.0).abs() < 0.05, "{drag} for {want}");
    assert!(mean(&table, "W_MEAN", "FX").abs() < 0.02 * want, "{}", mean(&table, "W_MEAN", "FX"));
    assert!(mean(&table, "WAVE", "FX").abs() < 0.02 * want, "{}", mean(&table, "WAVE", "FX"));
}
