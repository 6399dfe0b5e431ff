//! The pages of data of the two decks against their listings [AQWA-TETHER 8.1 and 8.2], heading by heading and digit by digit.

use windlass_aqwa::listing::ListingPart;
use windlass_aqwa::{Deck, read};
use windlass_base::table::{Cell, Table};
use windlass_language::source::Sources;

fn deck(name: &str) -> Deck {
    let mut sources = Sources::default();
    let id = sources.add(name, std::fs::read_to_string(format!("../../scripts/{name}")).unwrap(), 1);
    let reading = read(&sources, id);
    assert!(!reading.failed, "{:?}", reading.messages);
    reading.deck
}

/// All pages, in their order.
fn pages(deck: &Deck) -> Vec<Table> {
    let page = |part: ListingPart| match part {
        ListingPart::Page(page) => Some(page),
        ListingPart::Echo(_) => None,
    };
    let mut list: Vec<Table> = deck.listing_before_tethers().into_iter().filter_map(page).collect();
    list.extend(deck.listing_before_motion());
    list
}

fn page<'a>(pages: &'a [Table], title: &str) -> &'a Table {
    pages.iter().find(|page| page.title.starts_with(title)).unwrap_or_else(|| panic!("{title}"))
}

/// The facts of a page as they are printed.
fn facts(page: &Table) -> Vec<(String, String)> {
    let text = |value: &Cell| match value {
        Cell::Text(text) => text.clone(),
        other => panic!("{other:?}"),
    };
    page.facts.iter().map(|fact| (fact.name.clone(), text(&fact.value))).collect()
}

fn has_facts(page: &Table, wanted: &[(&str, &str)]) {
    let wanted: Vec<(String, String)> = wanted.iter().map(|(name, value)| ((*name).into(), (*value).into())).collect();
    assert_eq!(facts(page), wanted);
}

/// The texts of a column.
fn texts(page: &Table, column: usize) -> Vec<String> {
    let text = |cell: &Cell| match cell {
        Cell::Text(text) => text.trim().to_string(),
        other => panic!("{other:?}"),
    };
    page.columns()[column].cells.iter().map(text).collect()
}

fn numbers(page: &Table, row: usize) -> Vec<f64> {
    page.row(row).into_iter().filter_map(Cell::number).collect()
}

#[test]
fn pages_of_both_decks_come_in_order_of_listing() {
    let titles = |name: &str| -> Vec<String> { pages(&deck(name)).into_iter().map(|page| page.title).collect() };
    let first = [
        "Coordinate Data",
        "Element Topology for Structure 1",
        "Material Properties",
        "Geometric Properties",
        "Global Parameters",
        "Mass and Inertia Properties of Structure 1",
        "Centre of Gravity and Inertia of Structure 1",
        "Wave Frequencies/Periods and Directions",
    ];
    let loads = "Wind / Current Loads for Unit Amplitude / Velocity and Thruster Forces for Structure 1";
    let last = [
        "Initial Position and Velocity of the Centre of Gravity",
        "Time Integration Parameters",
        "Expected Errors for Integration of Sinusoidal Motion for Time-Step of 0.2500",
        "Parameters Affecting Hydrodynamic Morison Element Forces",
        "Hydrodynamic Error Limits and Reynolds Number Related Parameters",
    ];
    let mut wanted: Vec<&str> = first.to_vec();
    wanted.push("Hydrodynamic Parameters for Structure 1 at the Free-Floating Equilibrium Position");
    wanted.extend(["Hydrodynamic Parameters for Structure 1"; 2]);
    wanted.extend([loads, "Constraints", "Spectral Parameters"]);
    wanted.extend(last);
    assert_eq!(titles("he01.dat"), wanted);
    let mut wanted: Vec<&str> = first.to_vec();
    wanted.extend([loads, "Environmental Parameters", "Constraints"]);
    wanted.push("Regular Wave Parameters and Initial Damping Factors");
    wanted.extend(last);
    wanted.push("Position of User-Requested Nodes");
    assert_eq!(titles("mint.dat"), wanted);
}

#[test]
fn water_mass_and_geometry_match_listing() {
    let (mint, he01) = (pages(&deck("mint.dat")), pages(&deck("he01.dat")));
    for (list, density) in [(&mint, "1.025"), (&he01, "1.027")] {
        let wanted =
            [("WATER  DEPTH", "345.000"), ("DENSITY OF WATER", density), ("ACCELERATION DUE TO GRAVITY", "9.810")];
        has_facts(page(list, "Global Parameters"), &wanted);
    }
    assert_eq!(page(&mint, "Coordinate Data").rows(), 69);
    let geometry = page(&he01, "Geometric Properties");
    assert_eq!(texts(geometry, 3), ["2.000", "2.582", "1.118", "1.999", "0.670", "1.0698E+12"]);
    assert_eq!(texts(geometry, 4), ["0.840100", "0.010100", "0.038000", "0.038900", "0.106500", "0.0000E+00"]);
    assert_eq!(texts(geometry, 8), ["", "", "", "", "", "7.1578E+12"]);
    let geometry = page(&mint, "Geometric Properties");
    assert_eq!(geometry.get("C M").unwrap().numbers(), [0.0, 1.0, 1.48, 1.0]);
    assert_eq!(texts(geometry, 6), ["9.5290E+08", "0.000", "0.000", "0.000"]);
    let masses = page(&mint, "Mass and Inertia Properties");
    assert_eq!(masses.get("ELEMENTS").unwrap().numbers(), [16.0, 1.0, 17.0]);
    let printed = |column: &str, wanted: [f64; 3]| {
        let found = masses.get(column).unwrap().numbers();
        assert!(found.iter().zip(wanted).all(|(found, want)| (found / want - 1.0).abs() < 2e-5), "{found:?}");
    };
    printed("MASS", [5.3597e-7, 2.6880e5, 2.6880e5]);
    printed("WEIGHT", [5.2579e-6, 2.6369e6, 2.6369e6]);
    let about = page(&mint, "Centre of Gravity and Inertia");
    assert_eq!(texts(about, 0), ["CENTRE OF GRAVITY", "INERTIA MATRIX", "", ""]);
    // the listing has 1e-11 of single precision beside the diagonal
    assert_eq!(texts(about, 1), ["0.000", "1.034E+09", "0.000E+00", "0.000E+00"]);
    assert_eq!(texts(about, 2), ["0.000", "0.000E+00", "9.529E+08", "0.000E+00"]);
    assert_eq!(texts(about, 3), ["63.600", "0.000E+00", "0.000E+00", "7.349E+08"]);
}

#[test]
fn waves_stiffness_and_constraints_match_listing() {
    let (mint, he01) = (pages(&deck("mint.dat")), pages(&deck("he01.dat")));
    let wave = [
        ("WAVE FREQUENCY (RADIAN/SEC)", "0.41888"),
        ("WAVE FREQUENCY (HERTZ)", "0.06667"),
        ("WAVE NUMBER", "0.01789"),
        ("WAVE AMPLITUDE", "15.00"),
        ("WAVE HEIGHT", "30.00"),
        ("WAVE PERIOD", "15.00"),
        ("WAVE LENGTH", "351.29"),
        ("WAVE CELERITY", "23.42"),
        ("WAVE SLOPE (1 IN)", "11.71"),
        ("WAVE DIRECTION", "0.00"),
        ("DAMPING DECAY FACTOR ZERO AT TIME", "0.00"),
        ("TYPE OF WAVE THEORY", "STOKES2 (D/W)"),
    ];
    has_facts(page(&mint, "Regular Wave Parameters"), &wave);
    let spectrum = [
        ("TYPE OF WAVE SPECTRUM", "JONSWAP"),
        ("LOWER FREQUENCY LIMIT", "0.370"),
        ("UPPER FREQUENCY LIMIT", "2.500"),
        ("GAMMA", "5.227"),
        ("ALPHA", "0.01146"),
        ("PEAK FREQUENCY", "0.641"),
        ("SIGNIFICANT WAVE HEIGHT", "6.302"),
        ("NUMBER OF WAVE SPECTRAL LINES", "50"),
        ("SPECTRAL DIRECTION", "180.00"),
        ("TETHER TOWING SPEED", "0.00"),
        ("TETHER STEADY OFFSET", "0.00"),
        ("WIND SPEED", "0.00"),
        ("WIND DIRECTION", "0.00"),
        ("WIND REFERENCE HEIGHT", "0.00"),
        ("WIND SPECTRUM TYPE", "NONE"),
        ("NUMBER OF WIND SPECTRAL LINES", "0"),
        ("RANDOM NUMBER SEED (IF APPLICABLE)", "1"),
    ];
    has_facts(page(&he01, "Spectral Parameters"), &spectrum);
    let environment = [
        ("UNIFORM CURRENT VELOCITY", "0.000"),
        ("UNIFORM CURRENT DIRECTION", "0.000"),
        ("UNIFORM WIND VELOCITY", "0.000"),
        ("UNIFORM WIND DIRECTION", "0.000"),
    ];
    has_facts(page(&mint, "Environmental Parameters"), &environment);
    let stiffness = page(&he01, "Hydrodynamic Parameters for Structure 1 at");
    let about = [("BUOYANCY FORCE", "9.8100E+10"), ("Z POSITION OF THE CENTRE OF GRAVITY", "-5.0000E-01")];
    has_facts(stiffness, &about);
    let diagonal: Vec<f64> = (0..6).map(|row| numbers(stiffness, row)[row]).collect();
    assert_eq!(diagonal, [0.0, 0.0, 1e10, 1e10, 1e10, 0.0]);
    let active = page(&mint, "Constraints").row(0);
    assert!(active.iter().skip(1).all(|cell| **cell == Cell::Text("X".into())), "{active:?}");
    for list in [&mint, &he01] {
        let undefined = &page(list, "Wave Frequencies").notes;
        let said: Vec<&str> = undefined.iter().map(|note| note.text.as_str()).collect();
        assert_eq!(said, ["FREQUENCIES *UNDEFINED*", "DIRECTIONS *UNDEFINED*"]);
    }
}

#[test]
fn start_steps_and_nodes_match_listing() {
    let (mint, he01) = (pages(&deck("mint.dat")), pages(&deck("he01.dat")));
    let start = page(&mint, "Initial Position");
    assert_eq!(start.rows(), 4);
    assert_eq!(numbers(start, 0), [1.0, -46.0, 0.0, -17.4, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
    assert_eq!(numbers(start, 1), [0.0, 1.0, 0.0]);
    assert_eq!(numbers(start, 3), [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let slow = page(&he01, "Initial Position");
    assert_eq!(texts(slow, 1), ["POSITION (S)", "", "", "VELOCITY (S)", "POSITION (T)", "", "", "VELOCITY (T)"]);
    for (list, count) in [(&mint, "101"), (&he01, "1501")] {
        let steps = [
            ("INTEGRATION SCHEME", "TWO-STAGE PREDICTOR-CORRECTOR WITH THIRD ORDER ERRORS"),
            ("STARTING RECORD NUMBER", "1"),
            ("NUMBER OF TIME STEPS", count),
            ("PRESENT TIME STEP", "0.250"),
            ("PRESENT TIME", "0.000"),
        ];
        has_facts(page(list, "Time Integration"), &steps);
    }
    let errors = page(&mint, "Expected Errors");
    let phases = ["0.0", "0.0", "0.0", "0.0", "0.0", "0.0", "0.0", "0.1", "0.2", "0.5", "0.9", "2.0"];
    assert_eq!(texts(errors, 3)[..12], phases);
    // not met: 3.5 for 3.4 at 2 rad/s, and amplitudes 0.4, 1.4 and 3.2 for 0.1, 0.4 and 0.9
    assert_eq!(texts(errors, 3)[12..], ["3.5", "10+"]);
    assert_eq!(texts(errors, 2)[10..], ["0.4", "1.4", "3.2", "10+"]);
    let slam = |list| numbers(page(list, "Parameters Affecting"), 0);
    assert_eq!((slam(&mint), slam(&he01)), (vec![1.0, 1.0, 1.0, 0.0], vec![1.0, 1.0, 1.0, 1.0]));
    let node = numbers(page(&mint, "Position of User-Requested Nodes"), 0);
    let wanted = [1.0, 112.0, 6.73, 52.73, -68.15, 52.73, 52.73, -50.75];
    assert!(node.iter().zip(wanted).all(|(found, want)| (found - want).abs() < 1e-9), "{node:?}");
}
