//! Databases given by the records of I_TOTAL, against an oscillator in closed form: a ball that heaves on a spring of its hydrostatics,
//! of mass m, stiffness c, with added mass a, damping b and force F at two periods: |z| = |F| / |c - w^2 (m + a) - i w b|.

use crate::common::{self, assert_near};
use std::f64::consts::PI;
use windlass_base::diagnostic::Severity;

/// Weight of the ball (kN), its stiffness (kN/m), and g.
const WEIGHT: f64 = 20_000.0;
const STIFFNESS: f64 = 3000.0;
const G: f64 = 9.80665;
/// Period (s), added mass as a weight (kN), damping (kN s/m), force (kN/m), its lag (degrees).
const ROWS: [[f64; 5]; 2] = [[6.0, 9000.0, 300.0, 1500.0, 20.0], [9.0, 11_000.0, 400.0, 2200.0, -10.0]];

fn run(records: &str) -> (String, Vec<(Severity, String)>) {
    let (mut session, screen, _folder) = common::session();
    session.open("records", records.to_string());
    session.run();
    let said = session.reports.iter().map(|d| (d.severity, format!("{} {}", d.message, d.help.join(" "))));
    (screen.text(), said.collect())
}

fn ball(more: &str) -> String {
    format!(
        "&DIMEN -DIMEN METERS K-NTS\n&DEFAULT -G {G}\nMEDIT\n&DESCRIBE BODY BALL -IGNORE X Y RX RY RZ\n*CG 0 0 0\n#WEIGHT *CG {WEIGHT} 4 4 4\n\
         #HYDROSTATIC *CG {STIFFNESS} 0 0 -BUOYANCY {WEIGHT} -ZCGE 0\nEND\n{more}"
    )
}

/// A matrix with one entry on its diagonal.
fn single(value: f64, at: usize) -> String {
    (0..36).map(|n| if n == 7 * at { format!(" {value}") } else { " 0".into() }).collect()
}

/// The records of I_TOTAL of the oscillator, in one direction.
fn total(at: usize, head: &str) -> String {
    let period = |[period, mass, damping, force, lag]: [f64; 5]| {
        let forces: String = (0..6).map(|n| if n == at { format!(" {force} {lag}") } else { " 0 0".into() }).collect();
        format!("H_PERIOD {period}\nH_AMASS{}\nH_DAMP{}\nH_FORCE 180{forces}\n", single(mass, at), single(damping, at))
    };
    format!("HYDRODYNAMICS\nI_TOTAL BALL PKT\n{head}{}{}END_I_TOTAL\n", period(ROWS[1]), period(ROWS[0]))
}

/// Heave over wave amplitude of RAO, and its lag (degrees), by period.
fn response(records: &str, rao: &str) -> (Vec<f64>, Vec<f64>, Vec<(Severity, String)>) {
    let (text, said) = run(&format!(
        "{records}&EQUI\nFREQ_RESPONSE\n{rao}\nMOTION BALL\nSET_VARIABLE A 'Z Amp'\nSET_VARIABLE P 'Z Phase'\nEND\nEND\n&TYPE AMPS %A% LAGS %P% DONE\n"
    ));
    let list = |from: &str, to: &str| {
        let part = text.split_once(from).and_then(|(_, rest)| rest.split_once(to)).map(|(part, _)| part);
        part.unwrap_or_else(|| panic!("{said:?} {text}")).split_whitespace().map(|w| w.parse().unwrap()).collect()
    };
    (list("AMPS ", " LAGS "), list(" LAGS ", " DONE"), said)
}

/// The closed form at a row: amplitude and lag (degrees).
fn oscillator([period, mass, damping, force, lag]: [f64; 5]) -> (f64, f64) {
    let w = 2.0 * PI / period;
    let (real, imaginary) = (STIFFNESS - w * w * (WEIGHT + mass) / G, w * damping);
    // F exp(i lag) / (real - i imaginary)
    (force / real.hypot(imaginary), lag + imaginary.atan2(real).to_degrees())
}

fn assert_oscillates(found: &(Vec<f64>, Vec<f64>, Vec<(Severity, String)>)) {
    for (n, row) in ROWS.iter().enumerate() {
        let (size, lag) = oscillator(*row);
        assert_near(found.0[n], size, 1e-9);
        let off = (found.1[n] - lag + 180.0).rem_euclid(360.0) - 180.0;
        assert!(off.abs() < 1e-6, "{} is not {lag}", found.1[n]);
    }
}

#[test]
fn typed_oscillator_has_response_of_closed_form() {
    let rao = "RAO -PERIOD 6 9 -HEADING 180";
    assert_oscillates(&response(&ball(&format!("{}END\n", total(2, "H_ORIGIN 0 0 0\n"))), rao));
    // the defaults that G_PRESSURE keeps are those of RAO; the data are there, and nothing is asked for
    let kept = ball(&format!("{}G_PRESSURE BALL PKT -HEADING 180 -PERIOD 6 9\nEND\n", total(2, "")));
    let found = response(&kept, "RAO");
    assert_oscillates(&found);
    assert!(found.2.iter().any(|(s, text)| *s == Severity::Note && text.contains("G_PRESSURE computes none")));
    // the same by the files of WAMIT: A / rho, B / (rho w), F / (rho g) of the heave mode, its phase ahead of the crest
    let file = |ending: &str, lines: [String; 2]| {
        format!("&FILE OPEN F ball.{ending}\n&FILE WRITE F {}\n&FILE WRITE F {}\n&FILE CLOSE F\n", lines[0], lines[1])
    };
    let density = 1.025;
    let radiation = ROWS.map(|[t, mass, damping, ..]| {
        format!("{t} 3 3 {:.12} {:.12}", mass / G / density, damping / density / (2.0 * PI / t))
    });
    let waves = ROWS.map(|[t, _, _, force, lag]| {
        let (size, lead) = (force / density / G, (-lag).to_radians());
        format!("{t} 0 3 {size:.12} {:.12} {:.12} {:.12}", -lag, size * lead.cos(), size * lead.sin())
    });
    let wamit = format!(
        "&DEFAULT -WATER 1025\n{}{}MEDIT\nDATABASE BALL -WAMIT job.ans/ball\nEND\n",
        file("1", radiation),
        file("3", waves)
    );
    assert_oscillates(&response(&ball(&wamit), rao));
}

#[test]
fn typed_database_in_turned_axes_equals_body_axes() {
    // pitched by 90 degrees the x axis of the values points down: their surge is heave, with the sign of the force turned
    let turned = ball(&format!("{}END\n", total(0, "H_EULERA 0 90 0\n")));
    let found = response(&turned, "RAO -PERIOD 6 9 -HEADING 180");
    for (n, row) in ROWS.iter().enumerate() {
        let (size, lag) = oscillator(*row);
        assert_near(found.0[n], size, 1e-9);
        let off = (found.1[n] - lag).rem_euclid(360.0) - 180.0;
        assert!(off.abs() < 1e-6, "{} is not {lag} and half a turn", found.1[n]);
    }
}

#[test]
fn exported_database_reads_back_to_the_same_response() {
    let written = ball(&format!("{}E_TOTAL BALL ball.tot\nEND\n", total(2, "")));
    let read = format!("{written}&DESCRIBE BODY BALL\n&INSERT job.ans/ball.tot\n");
    let found = response(&read, "RAO -PERIOD 6 9 -HEADING 180");
    assert_oscillates(&found);
    assert!(found.2.iter().any(|(_, text)| text.contains("database of BALL is replaced")), "{:?}", found.2);
}

#[test]
fn values_of_database_are_shown_in_actual_units() {
    let shown = |command: &str, selector: &str| {
        let (text, said) = run(&ball(&format!(
            "{}{command}\nSET_VARIABLE V '{selector}'\nEND\nEND\n&TYPE GOT %V% END\n",
            total(2, "")
        )));
        let part =
            text.split_once("GOT ").and_then(|(_, rest)| rest.split_once(" END")).map(|(part, _)| part.to_string());
        let part = part.unwrap_or_else(|| panic!("{said:?} {text}"));
        part.split_whitespace().map(|w| w.parse().unwrap()).collect::<Vec<f64>>()
    };
    // frequencies grow: the period of 9 s is the first
    for (command, selector, column) in
        [("V_MATRICES BALL", "A Z-Z", 1), ("V_MATRICES BALL", "B Z-Z", 2), ("V_EXFORCES BALL", "Amplitude: Z", 3)]
    {
        let found = shown(command, selector);
        assert_near(found[0], ROWS[1][column], 1e-12);
        assert_near(found[1], ROWS[0][column], 1e-12);
    }
}

#[test]
fn pressure_without_database_stops_motions_until_there_is_one() {
    let asked = ball("HYDRODYNAMICS\nG_PRESSURE BALL -HEADING 180 -PERIOD 6 9\nEND\n");
    let (text, said) = run(&format!("{asked}&EQUI\n&ENV -TIME 1 0.1 -RAMP 0\nTDOM\n"));
    let errors: Vec<_> = said.iter().filter(|(severity, _)| *severity == Severity::Error).collect();
    assert!(errors.len() == 1 && errors[0].1.contains("G_PRESSURE of BALL"), "{said:?}");
    assert!(text.contains("E Q U I L I B R I U M"), "{text}");
    assert_oscillates(&response(&format!("{asked}{}END\n", total(2, "")), "RAO"));
}
