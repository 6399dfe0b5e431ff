//! Tables of PRCPOST that MOSES has, and columns made in the disposition menu, against closed forms: a box that falls freely, whose
//! height is a parabola that the run follows to rounding.

use crate::common::{assert_near, session};

use std::f64::consts::TAU;
use windlass::commands::Menu;
use windlass_base::table::{Cell, Table};

const G: f64 = 9.80665;

/// The table over which a script leaves the disposition menu open.
fn table(script: &str) -> Table {
    let (mut session, screen, _folder) = session();
    session.open("test", script.to_string());
    session.run();
    assert_eq!(session.errors, 0, "{:?} {}", session.reports, screen.text());
    match session.job.menu() {
        Menu::Disposition(made) => made.table.clone(),
        _ => panic!("no table is open: {}", screen.text()),
    }
}

/// The numbers of a column by its long name.
fn column(table: &Table, group: &str, name: &str) -> Vec<f64> {
    let found = table.columns().iter().find(|c| c.group == group && c.name == name);
    let found = found.unwrap_or_else(|| panic!("no {group}: {name} in {:?}", table.columns()));
    found.cells.iter().map(|c| c.number().unwrap_or(f64::NAN)).collect()
}

fn assert_follows(table: &Table, (group, name): (&str, &str), want: impl Fn(f64) -> f64) {
    let times = column(table, "", "Time");
    assert!(times.len() > 5, "{times:?}");
    for (t, got) in times.iter().zip(column(table, group, name)) {
        // rounding of some hundred steps
        assert_near(got, want(*t), 1e-9);
    }
}

/// A box of 4 x 2 x 3 m from 2 m above the water, half full of a liquid twice as heavy as the sea, falling from rest.
const BOX: &str = "&DIMEN -DIMEN METERS K-NTS\n&ENV E -DEPTH 500 -TIME 1.5 0.1 -RAMP 0\nMEDIT\n*GND 3 4 -10\n\
    &DESCRIBE BODY BOX -IGNORE X Y RX RY RZ\n*C 2 0 1.5\n#WEIGHT *C 500 1 1 1\n*LOW 0 0 -1\n*HIGH 0 3 3\n*VENT 0 0 2.5\n*FAR 3 4 0\n\
    &DESCRIBE HOLE H1 VENT -POINT *VENT\n&DESCRIBE COMPARTMENT TANK -HOLES H1\nPGEN\nPLANE 0 4 -RECT 0 3 2\nEND\nEND\n\
    &COMPARTMENT -PERCENT TANK 50 2.05\n&DESCRIBE DMARK MARK *LOW *HIGH\n&INSTATE -LOCATE BOX 0 0 2\n";

/// The height of the box.
fn height(t: f64) -> f64 {
    2.0 - 0.5 * G * t * t
}

fn post_table(describe: &str, post: &str) -> Table {
    table(&format!("{BOX}{describe}TDOM\nPRCPOST\n{post}\n"))
}

#[test]
fn relative_motion_of_falling_point_is_its_fall() {
    let made = post_table("", "REL_MOTION *C *GND *FAR *LOW");
    let of = |group: &str| format!("*C less *GND {group}");
    assert_follows(&made, (&of("Location"), "Z"), |t| height(t) + 11.5);
    assert_follows(&made, (&of("Location"), "Mag."), |t| (1.0f64 + 16.0 + (height(t) + 11.5).powi(2)).sqrt());
    assert_follows(&made, (&of("Velocity"), "VZ"), |t| -G * t);
    assert_follows(&made, (&of("Acceleration"), "AZ"), |_| -G);
    assert_follows(&made, ("*FAR less *LOW Location", "Mag."), |_| 26f64.sqrt());
    assert_follows(&made, ("*FAR less *LOW Velocity", "V Mag."), |_| 0.0);
}

#[test]
fn least_distance_is_of_nearest_pair_and_its_rate() {
    // of *FAR and *C the first is above *GND at all times
    let made = post_table("", "P_MIN_DISTANCE *FAR *GND");
    assert_follows(&made, ("", "Distance"), |t| (height(t) + 10.0).abs());
    assert_follows(&made, ("", "Rate"), |t| -G * t * (height(t) + 10.0).signum());
    let fact = |name: &str| made.facts.iter().find(|f| f.name == name).and_then(|f| f.value.number()).unwrap();
    let times = column(&made, "", "Time");
    let least = times.iter().map(|t| (height(*t) + 10.0).abs()).fold(f64::INFINITY, f64::min);
    assert_near(fact("Least"), least, 1e-9);
    // *FAR is 3 4 beside *LOW, *VENT 2.5 above it: in the plane *VENT is nearest
    let made = post_table("", "P_MIN_DISTANCE @F@ *GND -MAG_DEFINE X Y");
    assert_follows(&made, ("", "Distance"), |_| 0.0);
}

#[test]
fn draft_at_inclined_mark_follows_the_fall() {
    // the mark is 5 m long and rises 4 m from 1 m below the origin
    let made = post_table("", "DRAFT MARK");
    assert_follows(&made, ("MARK", "Draft"), |t| -1.25 * (height(t) - 1.0));
    assert_follows(&made, ("MARK", "W. Elv"), |_| 0.0);
}

#[test]
fn tank_heads_follow_the_fall_and_contents_stay() {
    let made = post_table("", "TANK_FLD TANK");
    for (name, want) in [("% Full", 50.0), ("Sounding", 1.5), ("Ullage", 1.5), ("Amount", 12.0 * 2050.0 * G)] {
        assert_follows(&made, ("Contents", name), |_| want);
    }
    // 1.5 m of twice the density of the sea
    assert_follows(&made, ("Head", "Pressure"), |_| 3.0);
    let difference = |t: f64| {
        let heads = |z: f64| 2.0 * (height(t) + 1.5 - z).max(0.0) - (-z).max(0.0);
        // a fine search of the wall, whose kinks are within a millimetre of its points
        (0..=3000).map(|i| heads(height(t) + 0.001 * f64::from(i)).abs()).fold(0.0, f64::max)
    };
    for (t, got) in column(&made, "", "Time").iter().zip(column(&made, "Head", "Max Diff.")) {
        assert!((got - difference(*t)).abs() <= 0.002, "at {t}: {got}");
    }
    // the vent is a metre above the liquid, and goes under water
    assert_follows(&made, ("Hole", "Above Water"), |t| height(t) + 2.5);
    assert_follows(&made, ("Head", "External"), |t| (-height(t) - 2.5).max(0.0));
    assert_follows(&made, ("Head", "Internal"), |_| 0.0);
    assert!(made.notes.iter().any(|n| n.text.contains("times to flood are not computed")), "{:?}", made.notes);
}

#[test]
fn sensors_read_signals_of_the_fall_and_raise_alarms() {
    let sensors = "&DESCRIBE SENSOR Z -SIGNAL POINT *C Z -LIMITS 0 9\n&DESCRIBE SENSOR RATE -SIGNAL POINT *C Z -DERIVATIVE YES\n\
        &DESCRIBE SENSOR APART -SIGNAL VECTOR *GND *C\n&DESCRIBE SENSOR VENTS -SIGNAL MIN_NWT_DOWN BOX\n\
        &DESCRIBE SENSOR CLOCK -SIGNAL TIME\n&DESCRIBE SENSOR ROLL -SIGNAL BODY_ANG BOX ROLL\n&DESCRIBE SENSOR -OFF CLOCK\n";
    let made = post_table(sensors, "SENSOR");
    assert_follows(&made, ("Z", "Value"), |t| height(t) + 1.5);
    assert_follows(&made, ("Z", "Alarm"), |t| f64::from(u8::from(height(t) + 1.5 < 0.0)));
    assert_follows(&made, ("RATE", "Value"), |t| -G * t);
    assert_follows(&made, ("APART", "Value"), |t| (17.0 + (height(t) + 11.5).powi(2)).sqrt());
    assert_follows(&made, ("VENTS", "Value"), |t| height(t) + 2.5);
    assert_follows(&made, ("ROLL", "Value"), |_| 0.0);
    assert!(made.columns().iter().all(|c| c.group != "CLOCK"));
}

/// 400 s of two sines that fit it whole, one of 8 s and one of 100 s, about 50.
fn two_sines() -> String {
    let row = |i: i32| {
        let t = 0.5 * f64::from(i);
        format!("{t} {}\n", 50.0 + 3.0 * (TAU * t / 8.0).sin() + 8.0 * (TAU * t / 100.0).sin())
    };
    let rows: String = (0..800).map(row).collect();
    format!("&BUILDG -BRIEF\nTime (s)\nOffset (ft)\n\n{rows}\n")
}

#[test]
fn blank_line_ends_brief_table_also_in_a_macro() {
    let records = "&BUILDG -BRIEF\n$ heads\nTime (s)\nForce (kips)\n\n0 2\n$ a remark\n1 4\n\nC_SCALE 3 Time\n";
    for script in [records.to_string(), format!("&MACRO MAKE\n{records}&ENDMACRO\nMAKE\n")] {
        let made = table(&script);
        assert_eq!(column(&made, "", "Time"), [0.0, 1.0], "{script}");
        // 4.4482216152605 kN a kip
        assert_near(column(&made, "", "Force")[1], 4.0 * 4448.2216152605, 1e-12);
    }
}

#[test]
fn filter_of_two_sines_leaves_one_and_combination_the_other() {
    let made = table(&format!(
        "{}ADD_COLUMN S_HIGH -FILTER PERIOD 1 2 30 1E5\nADD_COLUMN S_LOW -COMBINE Offset 1 S_HIGH -1\n",
        two_sines()
    ));
    let foot = 0.3048;
    for ((t, high), low) in
        column(&made, "", "Time").iter().zip(column(&made, "", "S_HIGH")).zip(column(&made, "", "S_LOW"))
    {
        // seven figures of the rows given
        assert!((high - foot * (50.0 + 3.0 * (TAU * t / 8.0).sin())).abs() < 1e-9, "{t}: {high}");
        assert!((low - foot * 8.0 * (TAU * t / 100.0).sin()).abs() < 1e-9, "{t}: {low}");
    }
}

#[test]
fn rp2sk_combination_is_of_maximum_and_significant_by_band() {
    let (mut session, screen, _folder) = session();
    let script = format!(
        "{}ADD_COLUMN S_HIGH -FILTER PERIOD 1 2 30 1E5\nADD_COLUMN S_LOW -COMBINE 2 1 3 -1\nC_SHIFT -50 S_HIGH\n\
         ADD_COLUMN MAX_LOW -COMBINE S_LOW 3.72 S_HIGH 2\nSTATISTIC Time S_HIGH S_LOW\nEND\n",
        two_sines()
    );
    session.open("test", script);
    session.run();
    assert_eq!(session.errors, 0, "{:?} {}", session.reports, screen.text());
    let text = screen.text();
    // name, unit, count, mean, deviation
    let deviation = |name: &str| -> f64 {
        let line = text.lines().find(|line| line.trim_start().starts_with(name)).unwrap();
        line.split_whitespace().nth(4).unwrap().parse().unwrap()
    };
    let (high, low) = (deviation("S_HIGH"), deviation("S_LOW"));
    // sines have the root mean square of their amplitude over sqrt(2); printed with six figures
    assert_near(high, 3.0 / 2f64.sqrt(), 1e-5);
    assert_near(low, 8.0 / 2f64.sqrt(), 1e-5);
    // API RP 2SK: the maximum of the larger and the significant value of the smaller, against the maximum of both together
    let (ratio, both) = (high / low, 3.72 * high.hypot(low));
    let combined = 3.72 * low + 2.0 * high;
    assert_near(combined / both, (1.0 + 0.5376 * ratio) / (1.0 + ratio * ratio).sqrt(), 1e-4);
    assert_near(combined, (3.72 * 8.0 + 2.0 * 3.0) / 2f64.sqrt(), 1e-5);
}

/// A ball that heaves on its water plane of 3000 kN/m and a spring of 100 kN/m, with a database of two periods.
fn ball() -> String {
    let data = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/heave/heave");
    format!(
        "&DIMEN -DIMEN METERS K-NTS\n&ENV -SPGWATER 1.025\nMEDIT\n*G 0 0 1\n&DESCRIBE BODY BALL -IGNORE X Y RX RY RZ\n*CG 0 0 0\n\
         #WEIGHT *CG 20000 4 4 4\n#HYDROSTATIC *CG 3000 0 0 -BUOYANCY 20000 -ZCGE 0\n~S GSPR BOTH Z 100 1000 -LEN 0\n\
         CONNECTOR LINE ~S *CG *G\nDATABASE BALL -WAMIT {data}\nEND\n&EQUI\n&DEFAULT -PROBABILITY RMS 3.72\nFREQ_RESPONSE\n\
         RAO -PERIOD 6 -HEADING 180\n"
    )
}

/// The heave of the ball in waves of unit amplitude of 6 s, by hand: coefficients over the density and the frequency, the force over
/// density and gravity.
fn ball_heave() -> f64 {
    let w = TAU / 6.0;
    let real = 3100e3 - w * w * (20000e3 / G + 1025.0 * 900.0);
    1025.0 * G * 150.0 / real.hypot(w * w * 1025.0 * 300.0)
}

fn first(table: &Table, group: &str, name: &str) -> f64 {
    column(table, group, name)[0]
}

fn of_row(table: &Table, label: &str, name: &str) -> f64 {
    let rows = &table.columns()[0].cells;
    let row = rows.iter().position(|cell| matches!(cell, Cell::Text(text) if text == label)).unwrap();
    let column = table.columns().iter().find(|c| c.name == name).unwrap();
    column.cells[row].number().unwrap()
}

#[test]
fn point_statistics_in_regular_sea_follow_oscillator() {
    let heave = ball_heave();
    let made = table(&format!("{}FR_POINT 0 0 0\n", ball()));
    // water density and gravity to five figures and more
    assert_near(first(&made, "Z", "Z Amp") / heave, 1.0, 1e-6);
    let made = table(&format!("{}FR_POINT *CG\nEND\nST_POINT -SEA REGULAR 180 2 6\n", ball()));
    assert_near(of_row(&made, "Z", "RMS") * 2f64.sqrt() / heave, 1.0, 1e-6);
    assert_near(of_row(&made, "Z", "Maximum") / of_row(&made, "Z", "RMS"), 3.72, 1e-9);
    // a named environment is defined anew, and keeps its sea
    let made = table(&format!(
        "{}FR_POINT *CG\nEND\nST_POINT STORM -SEA REGULAR 180 4 6\nEND\nST_CFORCE LINE STORM\n",
        ball()
    ));
    assert_near(of_row(&made, "LINE", "RMS") / (2.0 * 100e3 * heave / 2f64.sqrt()), 1.0, 1e-6);
    let made = table(&format!("{}FR_CFORCE LINE\n", ball()));
    assert_near(first(&made, "LINE", "LINE Amp") / (100e3 * heave), 1.0, 1e-6);
}

#[test]
fn cargo_force_in_regular_sea_is_its_inertia() {
    let (heave, w) = (ball_heave(), TAU / 6.0);
    let inertia = 500e3 / G * w * w * heave;
    let made = table(&format!("{}FR_POINT 3 0 2\nEND\nFR_FCARGO 500 2 2 2\n", ball()));
    assert_near(first(&made, "FZ", "FZ Amp") / inertia, 1.0, 1e-6);
    let made = table(&format!("{}FR_POINT 3 0 2\nEND\nST_FCARGO 500 2 2 2 -SEA REGULAR 180 2 6\n", ball()));
    assert_near(of_row(&made, "Z", "RMS") * 2f64.sqrt() / inertia, 1.0, 1e-6);
    assert_near(of_row(&made, "Z", "Mean"), -500e3, 1e-9);
}

#[test]
fn exciting_forces_about_a_point_have_its_moment() {
    // a force of 150 rho g up at the origin turns about 2 m along x by -2 m of it: about y, r x F of (-2, 0, 0) and (0, 0, F) is +2 F
    let made = table(&format!("{}FR_POINT 2 0 3\nEND\nEXFORCE\n", ball()));
    let force = 1025.0 * G * 150.0;
    assert_near(first(&made, "FZ", "FZ Amp") / force, 1.0, 1e-6);
    assert_near(first(&made, "MY", "MY Amp") / (2.0 * force), 1.0, 1e-6);
    assert_near(first(&made, "MX", "MX Amp"), 0.0, 1e-6);
    let phase = first(&made, "MY", "MY Phase") - first(&made, "FZ", "FZ Phase");
    assert_near(phase.cos(), 1.0, 1e-9);
}

#[test]
fn matrices_about_a_point_are_moved_by_its_arm() {
    let (mut session, screen, folder) = session();
    // the spring bears nothing at rest: it is 100 kN/m alone
    let free = ball().replace("*G 0 0 1", "*G 0 0 0");
    session.open("test", format!("{free}FR_POINT 2 0 3\nEND\nMATRICES -FILE\nEQU_SUM\nEND\n"));
    session.run();
    assert_eq!(session.errors, 0, "{:?} {}", session.reports, screen.text());
    let text = std::fs::read_to_string(find_file(folder.path(), "PPO00001.CSV")).unwrap();
    let mut lines = text.lines();
    let heads: Vec<&str> = lines.next().unwrap().split(',').collect();
    let row: Vec<f64> = lines.next().unwrap().split(',').map(|v| v.parse().unwrap()).collect();
    let value = |name: &str| row[heads.iter().position(|head| head.starts_with(name)).unwrap()];
    // heave stiffness of 3100 kN/m, 2 m off: a pitch coupling of 2 and a pitch stiffness of 4 times it; added mass alike
    assert_near(value("K33"), 3100.0, 1e-9);
    assert_near(value("K35").abs(), 6200.0, 1e-9);
    assert_near(value("K55"), 12_400.0, 1e-9);
    assert_near(value("B33"), 1.025 * TAU / 6.0 * 300.0, 1e-6);
    assert_near(value("M33"), 20000.0 / G + 1.025 * 900.0, 1e-6);
}

/// A file of a name anywhere in a folder.
fn find_file(folder: &std::path::Path, name: &str) -> std::path::PathBuf {
    let mut folders = vec![folder.to_path_buf()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()) {
            if entry.is_dir() {
                folders.push(entry);
            } else if entry.file_name().is_some_and(|n| n == name) {
                return entry;
            }
        }
    }
    panic!("no file {name}");
}

#[test]
fn element_forces_are_along_a_straight_line_in_its_axes() {
    // a weight of 500 kN at rest on two lines that lean by 3 in 5 and stretch: each pulls W/2 x 5/4 at a length of 25 m; one turns its first
    // end up, the other down
    let ea = 29000.0 * 6894.757293168361 * std::f64::consts::FRAC_PI_4 * 0.01;
    let length = 25.0 / (1.0 + 312.5 / ea);
    let made = table(&format!(
        "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n*A -15 0 20\n*B 15 0 20\n&DESCRIBE BODY LOAD -IGNORE RX RY RZ\n*W 0 0 0\n#WEIGHT *W 500 1 1 1\n\
         ~R H_CAT 100 -LEN {length}\nCONNECTOR UP ~R *W *A\nCONNECTOR DOWN ~R *B *W\nEND\n&ENV -TIME 1 0.1 -RAMP 0\nTDOM\nPRCPOST\nELMFORCE\n"
    ));
    for (group, name, want) in [
        ("UP End 1 Global", "FX", -187.5),
        ("UP End 1 Global", "FZ", 250.0),
        ("UP End 1 Element", "FX", 312.5),
        ("UP End 1 Element", "FY", 0.0),
        ("UP End 1 Element", "FZ", 0.0),
        ("UP End 1 Element", "MY", 0.0),
        ("DOWN End 2 Global", "FX", 187.5),
        ("DOWN End 2 Global", "FZ", 250.0),
        ("DOWN End 2 Element", "FX", -312.5),
        ("DOWN End 2 Element", "FZ", 0.0),
    ] {
        for got in column(&made, group, name) {
            // cells are in SI; the length has ten figures or more
            assert!((got - 1000.0 * want).abs() < 0.01, "{group} {name}: {got} {want}");
        }
    }
    assert!(!made.columns().iter().any(|c| c.group.starts_with("UP End 2")), "its second end is in the ground");
}

#[test]
fn length_of_span_over_pulley_follows_the_drum_and_the_load() {
    // rope off a drum at 0.3 m/s over a pulley to a hanging weight: what is paid out hangs behind the pulley
    let made = table(
        "&DIMEN -DIMEN METERS K-NTS\n&DATA CURVES LT_MULTIPLIER V 0 0 2 1 60 1\nMEDIT\n*A -30 0 10\n*P 0 0 20\n&DESCRIBE BODY LOAD -IGNORE RX RY RZ\n\
         *W 0 0 0\n#WEIGHT *W 500 1 1 1\n~R H_CAT 100 -LEN 26\nCONNECTOR S1 ~R *A *P\nCONNECTOR S2 ~R *P *W\nASSEMBLY WINCH D S1 S2 -VELOCITY V 0.3\nEND\n\
         &EQUI\n&ENV -TIME 6 0.05 -RAMP 0\nTDOM\nPRCPOST\nC_LENGTH\n",
    );
    let paid = |t: f64| if t < 2.0 { 0.3 * t * t / 4.0 } else { 0.3 * (t - 1.0) };
    let aside = 1000f64.sqrt();
    for (t, (first, second)) in column(&made, "", "Time")
        .into_iter()
        .zip(column(&made, "First Segment", "S1").into_iter().zip(column(&made, "First Segment", "S2")))
    {
        // the stretch is 3.2e-4 of it, and swings by the rise of speed, v w / g = 1 % of that
        assert!((first - aside / (1.0 + 3.18e-4)).abs() < 1e-3 * aside, "{t} {first}");
        assert!((first + second - 52.0 - paid(t)).abs() < 1e-9, "{t} {first} {second}");
    }
}

#[test]
fn load_group_forces_of_falling_body_are_those_of_its_areas_and_weights() {
    // no wind: an area A of 40 m2 across z at a speed gt meets 1/2 rho_air A (gt)^2 against the fall once it is in the run's environment; its weight
    // of 60 kN is constant, and the other group has the rest
    let made = table(
        "&DIMEN -DIMEN METERS K-NTS\n&ENV E -DEPTH 500 -TIME 1 0.05 -RAMP 0 -WIND 30 180 -W_PROFILE POWER 0\nMEDIT\n&DESCRIBE BODY BOX -IGNORE X Y RX RY RZ\n\
         *C 2 0 60\n*F 0 0 60\n#WEIGHT *C 500 1 1 1\n#AREA *C 50 0 0\n&DESCRIBE LOAD_GROUP CRANE *F\n#WEIGHT *F 60 0 0 0\n#AREA *F 20 0 0\n#AMASS *F 0 0 100\n\
         #DAMP *F 0 0 3\nEND\nTDOM\nPRCPOST\nLDGFORCE\n",
    );
    // the horizontal wind on 20 m2 along x: the stream as seen from the body is (u, gt), and the force along x has |w| u
    let (u, area): (f64, f64) = (30.0 * 1852.0 / 3600.0, 20.0);
    let (mass, added) = (560e3 / G, 100e3 / G);
    let heights = column(&made, "", "Time");
    let weight = column(&made, "CRANE WEIGHT", "FZ");
    assert!(weight.iter().all(|w| (w + 60e3).abs() < 1e-6), "{weight:?}");
    let rest = column(&made, "BOX WEIGHT", "FZ");
    assert!(rest.iter().all(|w| (w + 500e3).abs() < 1e-6), "{rest:?}");
    let wind = [column(&made, "CRANE WIND", "FX"), column(&made, "BOX WIND", "FX")];
    let damping = column(&made, "CRANE R_DRAG", "FZ");
    // m v' = -W - c v with m of both masses: v = -(W/c) (1 - exp(-c t/m))
    let (c, whole) = (3e3, mass + added);
    for (n, t) in heights.iter().enumerate() {
        let v = -(560e3 / c) * (1.0 - (-c * t / whole).exp());
        let x = 0.5 * 1.226 * u * u.hypot(v);
        // steps of 0.05 s leave 1e-5 of the speed
        assert!((wind[0][n] - area * x).abs() < 1e-4 * area * x, "{t} {} {}", wind[0][n], area * x);
        assert!((wind[1][n] - 50.0 * x).abs() < 1e-4 * 50.0 * x, "{t} {}", wind[1][n]);
        assert!((damping[n] + c * v).abs() < 1e-4 * c * v.abs() + 1e-6, "{t} {} {}", damping[n], c * v);
    }
}
