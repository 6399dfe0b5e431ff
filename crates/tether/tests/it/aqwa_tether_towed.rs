//! The towed tether of [AQWA-TETHER 8.1]: description, natural modes, and the run in an irregular sea, against the listing.
//!
//! `tests/data/towed_tether.json` holds the printed numbers. Formulation and what of the
//! listing cannot be met: [W-TOWED]. Units of the deck: t, kN, m, s.

use serde_json::Value;
use windlass_hydro::sea::Component;
use windlass_tether::towed::{
    EndSpring, Towed, TowedCompatibility, TowedHistory, TowedRecord, TowedSteps, WaterForceMultipliers,
};
use windlass_tether::{TetherElement, TetherLine};

/// The printed numbers.
fn read_printed_numbers() -> Value {
    serde_json::from_str(&std::fs::read_to_string("../../tests/data/towed_tether.json").unwrap()).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

/// The tether of deck HE01.
fn line() -> TetherLine {
    // outer diameter, wall, density, modulus of the geometric and material groups 1 to 5
    const GROUPS: [[f64; 4]; 5] = [
        [2.0, 0.84010, 7.850263, 2.0e5],
        [2.5822, 0.01010, 7.850263, 1.35e7],
        [1.1176, 0.03800, 7.816940, 2.15e8],
        [1.9993, 0.03890, 7.751645, 1.35e7],
        [0.670, 0.10650, 7.751645, 1.35e7],
    ];
    let mut nodes = vec![0.0, 1.053];
    nodes.extend((0..10).map(|i| 7.503 + 27.787 * f64::from(i)));
    nodes.extend([262.636, 266.486]);
    let groups = [1, 2, 3, 3, 3, 3, 3, 3, 3, 3, 3, 4, 5];
    let element = |(i, group): (usize, &i64)| {
        let [outer_diameter, wall_thickness, density, youngs_modulus] = GROUPS[*group as usize - 1];
        let label = windlass_tether::line::ElementLabel {
            nodes: [i as i64 + 1, i as i64 + 2],
            material: *group,
            geometry: *group,
        };
        let length = nodes[i + 1] - nodes[i];
        TetherElement {
            length,
            outer_diameter,
            wall_thickness,
            density,
            youngs_modulus,
            drag: 0.75,
            added_mass: 1.0,
            label,
        }
    };
    TetherLine::new(groups.iter().enumerate().map(element).collect()).unwrap()
}

/// The fifty waves with their printed wave numbers and phases; amplitudes are equal, 1/50 of the energy within the limits.
fn waves() -> Vec<Component> {
    let amplitude = (2.0 * (6.2934f64 / 4.0).powi(2) / 50.0).sqrt();
    let lines = read_printed_numbers()["spectral_lines"].as_array().unwrap().clone();
    let wave = |line: &Value| {
        // the wave number has a digit more than the frequency
        let k = number(&line[1]);
        let frequency = (9.81 * k * (345.0 * k).tanh()).sqrt();
        Component { frequency, number: k, amplitude, toward: [-1.0, 0.0], phase: number(&line[3]).to_radians() }
    };
    lines.iter().map(wave).collect()
}

fn case() -> Towed {
    let spring = EndSpring { along: 0.5, y: 0.5, z: 0.5 };
    Towed {
        line: line(),
        origin: [-266.486, 0.0, -0.5],
        heading: 0.0,
        springs: [spring; 2],
        density: 1.027,
        gravity: 9.81,
        depth: Some(345.0),
        waves: waves(),
        stokes: None,
        current: Vec::new(),
        tow: [0.0; 2],
        multipliers: WaterForceMultipliers { slam: 1.0, ..WaterForceMultipliers::default() },
        compatibility: TowedCompatibility::aqwa_5_4(),
    }
}

/// The run of the deck: 1501 records at 0.25 s.
fn steps() -> TowedSteps {
    TowedSteps { step: 0.25, number: 1501, ..TowedSteps::default() }
}

fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let list: Vec<f64> = values.collect();
    (list.iter().map(|v| v * v).sum::<f64>() / list.len() as f64).sqrt()
}

/// Differences of listed and reckoned values of the fourteen nodes: their root mean square, and that of the listed values.
fn misfit(found: impl Fn(usize) -> f64, listed: impl Fn(usize) -> f64) -> (f64, f64) {
    (rms((0..14).map(|i| found(i) - listed(i))), rms((0..14).map(listed)))
}

#[test]
fn sections_and_description_match_listing() {
    let p = read_printed_numbers();
    let case = case();
    let description = case.description(1, ["100", "999"]);
    let table = description.table();
    let rows = p["element_table"].as_array().unwrap();
    // printed: four decimals of area, six of I, four digits of EI and EA, three decimals of the outer area
    let near = |found: f64, want: &Value, unit: f64| {
        let want = number(want);
        assert!((found - want).abs() <= 0.5 * unit + 1e-9 * want, "{found} {want}");
    };
    let four = |want: &Value| 10f64.powf(number(want).log10().floor() - 3.0);
    for (row, want) in rows.iter().enumerate() {
        let cell = |name: &str| table.get(name).unwrap().cells[row + 1].number().unwrap();
        near(cell("ELEVATION"), &want["elev"], 0.1);
        assert_eq!((cell("NODE 1"), cell("NODE 2")), (number(&want["n1"]), number(&want["n2"])));
        assert_eq!((cell("MATE GROUP"), cell("GEOM GROUP")), (number(&want["mat"]), number(&want["geom"])));
        near(cell("X-SECT AREA"), &want["area"], 1e-4);
        near(cell("2ND-MOM OF AREA"), &want["I"], 1e-6);
        near(cell("EI"), &want["EI"], four(&want["EI"]));
        near(cell("EA"), &want["EA"], four(&want["EA"]));
        near(cell("EXTERNAL DIAM AREA"), &want["extarea"], 1e-3);
    }
    assert_eq!(table.rows(), 14);
    near(case.line.length(), &p["unstretched"], 1e-3);
    near(description.initial_distance(), &p["unstretched"], 1e-3);
    near(description.longitudinal_stiffness(), &p["long_stiff"], 1e-3);
    near(description.weight(), &p["weight"], 1.0);
    near(description.buoyancy(), &p["buoy"], 1.0);
    near(description.end_cap_buoyancy(), &p["endcap"], 1e-3);
    near(description.free_hanging_reaction(), &p["fhr"], 0.1);
}

#[test]
fn bending_modes_match_listing() {
    let p = read_printed_numbers();
    let case = case();
    let modes = case.modes(56).unwrap();
    assert_eq!(modes.len(), 56);
    let eigen = p["eigen"].as_array().unwrap();
    // towed-tether.md, section 2: -0.12 % and -0.02 %; the added mass at -0.5 m is a closed form recognised there
    for (mode, tolerance) in [(5, 1.3e-3), (6, 3e-4)] {
        let want = &eigen[mode - 1];
        let found = &modes[mode - 1];
        assert!((found.period().unwrap() / number(&want["period"]) - 1.0).abs() < tolerance);
        for row in want["shape"].as_array().unwrap() {
            let node = number(&row[0]) as usize - 1;
            let at = found.node(node);
            for axis in 0..2 {
                // 1.0e-3 and 4e-4 there; the shape is printed to 1e-4
                assert!((at[axis] - number(&row[2 + axis])).abs() < 1.1e-3, "mode {mode} node {node}");
                assert!((at[2 + axis].to_degrees() - number(&row[4 + axis])).abs() < 2.5e-3, "mode {mode} node {node}");
            }
        }
    }
    // mode 7 is not printed; its period is known from the acceleration at the start, 5.5079 s
    assert!((modes[6].period().unwrap() / 5.5079 - 1.0).abs() < 2e-4);
}

#[test]
fn modes_have_places_of_listing_in_matrices() {
    let eigen = read_printed_numbers()["eigen"].as_array().unwrap().clone();
    let listed: Vec<usize> = eigen.iter().map(|mode| number(&mode["posn"]) as usize).collect();
    assert_eq!(listed, [14, 13, 22, 25, 26, 21]);
    let found: Vec<usize> = case().modes(6).unwrap().iter().map(|mode| mode.freedom_position().unwrap()).collect();
    assert_eq!(found, listed);
}

/// Modes 1 to 4 are held by the end springs of 0.5 kN/m alone, beside a stiffness of 1.6e6 in the matrix: the listing's differ
/// from any exact solution by what single precision leaves (towed-tether.md, section 2). They are not met, and the springs
/// are not tuned to meet them; what is pinned here is how far off the listing is.
#[test]
fn listing_spring_modes_are_three_percent_too_slow() {
    let modes = case().modes(4).unwrap();
    let eigen = read_printed_numbers()["eigen"].as_array().unwrap().clone();
    let expected = [151.00, 150.29, 91.87, 90.99];
    let off = [-0.034, -0.019, -0.033, -0.015];
    for i in 0..4 {
        let period = modes[i].period().unwrap();
        // the prototype's periods, to their last digit
        assert!((period - expected[i]).abs() < 0.006, "{period}");
        assert!((period / number(&eigen[i]["period"]) - 1.0 - off[i]).abs() < 1e-3);
        let want = eigen[i]["shape"].as_array().unwrap();
        let axis = if number(&want[5][2]) == 0.0 { 1 } else { 0 };
        for row in want {
            // towed-tether.md: up to 9.9e-3
            assert!((modes[i].node(number(&row[0]) as usize - 1)[axis] - number(&row[2 + axis])).abs() < 1.0e-2);
        }
    }
}

#[test]
fn accelerations_and_moments_at_start_match_listing() {
    let p = read_printed_numbers();
    let motion = &p["history"]["0"]["motion"];
    let listed = |column: usize| move |i: usize| number(&motion[13 - i][column]);
    let mut seen = 0;
    case()
        .run(&TowedSteps { number: 1, ..steps() }, &mut |r: &TowedRecord| {
            // asked: 0.2 % of the root mean square; found 0.05 %, where half a printed unit is 0.0003
            let (error, size) = misfit(|i| r.accelerations[i][1], listed(11));
            assert!(error < 0.002 * size && error < 0.0016, "{error} of {size}");
            let (error, size) = misfit(|i| r.accelerations[i][2].to_degrees(), listed(12));
            assert!(error < 0.002 * size, "{error} of {size}");
            let forces = &p["history"]["0"]["nodal_forces"];
            let at = |i: usize| r.ends[if i == 0 { 0 } else { 2 * i - 1 }];
            let (error, size) = misfit(|i| at(i).moment[0], |i| number(&forces[(i + 1).to_string()]["MY"]));
            assert!(error < 0.002 * size, "{error} of {size}");
            // printed is the shear of the element above the node, that of the vessel's node apart
            let above = |i: usize| r.ends[if i == 13 { 25 } else { 2 * i }];
            let (error, _) = misfit(|i| above(i).shear[1], |i| number(&forces[(i + 1).to_string()]["SZ"]));
            assert!(error < 0.2, "{error}");
            seen += 1;
        })
        .unwrap();
    assert_eq!(seen, 1);
}

#[test]
fn run_matches_printed_states() {
    let p = read_printed_numbers();
    let mut seen = 0;
    case()
        .run(&steps(), &mut |r: &TowedRecord| {
            // asked: 0.025 m; moments of rms 1048, 814, 1343 kNm. An independent program of the same equations, whose waves meet the tether as if
            // its trailing end stayed, misses these by 42, 17 and 13.5 kNm, and the statistics of all records by more (the tests of the pages)
            let [velocity_room, moment_room] = match r.index {
                500 => [0.017, 42.0],
                1000 => [0.012, 17.0],
                1500 => [0.0185, 24.0],
                _ => return,
            };
            seen += 1;
            let at = &p["history"][r.time.to_string()];
            let listed = |column: usize| move |i: usize| number(&at["motion"][13 - i][column]);
            let (position, _) = misfit(|i| r.positions[i][1], listed(3));
            let (velocity, _) = misfit(|i| r.velocities[i][1], listed(7));
            let (acceleration, _) = misfit(|i| r.accelerations[i][1], listed(11));
            let (along, _) = misfit(|i| r.along[i], listed(1));
            assert!(position < 0.025, "{} s: {position}", r.time);
            assert!(velocity < velocity_room && acceleration < 0.056, "{} s: {velocity} {acceleration}", r.time);
            // printed to 0.1 m
            assert!(along < 0.05, "{} s: {along}", r.time);
            let bending = |i: usize| r.ends[if i == 0 { 0 } else { 2 * i - 1 }].moment[0];
            let (error, _) = misfit(bending, |i| number(&at["nodal_forces"][(i + 1).to_string()]["MY"]));
            assert!(error < moment_room, "{} s: {error}", r.time);
        })
        .unwrap();
    assert_eq!(seen, 3);
}

#[test]
fn statistics_match_listing() {
    let p = read_printed_numbers();
    // the listing takes every second step: records 50 to 751
    let mut history = TowedHistory { every: 2, ..TowedHistory::default() };
    case().run(&steps(), &mut history).unwrap();
    assert_eq!(history.times.len(), 751);
    let statistics = |series: Vec<f64>| {
        let kept = &series[49..];
        let mean = kept.iter().sum::<f64>() / kept.len() as f64;
        (mean, 2.0 * rms(kept.iter().map(|v| v - mean)))
    };
    for node in 0..14 {
        // asked of position: 0.5 %; velocity and acceleration as towed-tether.md, section 5
        for (group, quantity, tolerance) in [("pos", 1, 0.005), ("vel", 5, 0.0095), ("acc", 9, 0.0175)] {
            let want = &p["stats"][group][(node + 1).to_string()];
            let (mean, double) = statistics(history.node(node, 14, quantity));
            let error = double / number(&want["rms2"][1]) - 1.0;
            assert!(error.abs() < tolerance, "{group} of node {}: {error}", node + 1);
            assert!((mean - number(&want["mean"][1])).abs() < 0.009, "{group} of node {}: {mean}", node + 1);
        }
    }
    for end in 1..25 {
        let want = &p["stats"]["bm"][format!("{}{}", end / 2 + 1, ["a", "b"][end % 2])];
        let (_, double) = statistics(history.end(end, 13, 2));
        // asked: 1.5 %
        let error = double / number(&want["rms2"][0]) - 1.0;
        assert!(error.abs() < 0.015, "moment at end {end}: {error}");
    }
}

#[test]
fn each_documented_deviation_of_aqwa_has_its_stated_effect() {
    let p = read_printed_numbers();
    let motion = &p["history"]["0"]["motion"];
    let start = |compatibility: TowedCompatibility| {
        let mut error = 0.0;
        let case = Towed { compatibility, ..case() };
        case.run(&TowedSteps { number: 1, ..steps() }, &mut |r: &TowedRecord| {
            error = misfit(|i| r.accelerations[i][1], |i| number(&motion[13 - i][11])).0;
        })
        .unwrap();
        error
    };
    let aqwa = TowedCompatibility::aqwa_5_4();
    // towed-tether.md, section 4: Wheeler .157, slam on entry alone .116, of an acceleration of 2.86 m/s2
    assert!((start(TowedCompatibility { unstretched_crests: false, ..aqwa }) - 0.157).abs() < 0.01);
    assert!((start(TowedCompatibility { exit_slam: false, ..aqwa }) - 0.116).abs() < 0.005);
    // of a step of 0.25 s, half of the change of the acceleration
    assert!(start(TowedCompatibility { acceleration_of_step_before: false, ..aqwa }) > 0.2);
}
