//! Files beside a deck, by MoorDyn's input format [MOORDYN-2].

use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::SourceId;
use windlass_moordyn::files::{current_profile, seafloor, stiffness_table, wave_components, wave_elevation};

fn source() -> SourceId {
    SourceId::new(0)
}

fn word<'a>(text: &'a str, error: &Diagnostic) -> &'a str {
    let span = error.span.unwrap();
    &text[span.start as usize..span.end as usize]
}

#[test]
fn seafloor_is_read_row_by_row_and_wrong_ones_are_refused_at_the_word() {
    let text = "2 3\n0 100\n-50 0 50\n0 -50 -10\n100 -50 -11\n100 0 -13\n0 0 -12\n0 50 -14\n100 50 -15\n";
    let floor = seafloor(text, source()).unwrap();
    assert_eq!((floor.x, floor.y), (vec![0.0, 100.0], vec![-50.0, 0.0, 50.0]));
    assert_eq!(floor.heights, [-10.0, -11.0, -12.0, -13.0, -14.0, -15.0]);
    for (from, to, at, says) in [
        ("-10", "deep", "deep", "not a number"),
        ("0 100\n", "100 0\n", "0", "must grow"),
        ("0 100\n", "0 50 100\n", "0 50 100", "expected 2"),
        ("0 50 -14", "1 50 -14", "1 50 -14", "not of the grid"),
        ("0 50 -14", "0 0 -14", "0 0 -14", "twice"),
        ("0 50 -14\n", "", "2 3", "no z at x 0, y 50"),
        ("2 3\n", "2 3 4\n", "4", "more values"),
    ] {
        let wrong = text.replacen(from, to, 1);
        let error = seafloor(&wrong, source()).unwrap_err();
        assert_eq!(word(&wrong, &error), at, "{}", error.message);
        assert!(format!("{} {}", error.message, error.label).contains(says), "{}", error.message);
    }
    assert!(seafloor("", source()).is_err());
}

#[test]
fn current_profile_is_turned_into_growing_depths() {
    let text = "head\nz ux uy\n(m) (m/s) (m/s)\n-200 0.1 0.2 0\n-50 0.5\n0 1 -1\n";
    let profile = current_profile(text, source()).unwrap();
    assert_eq!(profile.rows, [(0.0, [1.0, -1.0]), (50.0, [0.5, 0.0]), (200.0, [0.1, 0.2])]);
    let upward = text.replace("0.2 0\n", "0.2 0.3\n");
    let error = current_profile(&upward, source()).unwrap_err();
    assert!(word(&upward, &error) == "0.3" && error.message.contains("upward"));
    assert!(current_profile(&text.replace("-50", "50"), source()).is_err());
}

#[test]
fn components_are_sines_of_time_that_travel_toward_their_direction() {
    let waves = wave_components("0 0 0 0\n0.6 3 4 0.5\n0.9 0 -2\n", source()).unwrap();
    let [first, second] = waves[..] else { panic!("{waves:?}") };
    assert_eq!((first.frequency, first.amplitude, first.toward), (0.6, 5.0, 0.5));
    // |a| sin(w t - k x + arg a) at x = 0 is a cos(phase - w t)
    for wave in [first, second] {
        let argument = if wave == first { 4f64.atan2(3.0) } else { -std::f64::consts::FRAC_PI_2 };
        for time in [0.0, 1.3, 7.0] {
            let sine = (wave.frequency * time + argument).sin();
            assert!((sine - (wave.phase - wave.frequency * time).cos()).abs() < 1e-12);
        }
    }
    assert!(wave_components("0 1 0\n", source()).is_err() && wave_components("-1 1 0\n", source()).is_err());
}

#[test]
fn elevations_and_tables_grow_from_row_to_row() {
    assert_eq!(wave_elevation("0 0\n0.5 1\n1 0\n", source()).unwrap().len(), 3);
    assert!(wave_elevation("0 0\n0 1\n1 0\n", source()).is_err() && wave_elevation("0 0\n1 1\n", source()).is_err());
    let table = "a\nb\nc\n0 0\n0.1 1e5\n0.2 4e5\n";
    assert_eq!(stiffness_table(table, source()).unwrap(), [(0.0, 0.0), (0.1, 1e5), (0.2, 4e5)]);
    assert!(stiffness_table(&table.replace("4e5", "1e4"), source()).is_err());
}
