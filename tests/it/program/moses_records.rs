//! Records that scripts of MOSES have, against closed forms: options of &EQUI and TDOM.

use crate::common::{function_values, run_script};

/// A cart of 100 kN on a spring of 40 kN/m, half a metre from its rest: 0.2 g.
const CART: &str = "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n*G 0 0 0\n&DESCRIBE BODY CART -IGNORE Y Z RX RY RZ\n*C 0 0 0\n#WEIGHT *C 100 1 1 1\n\
                    ~S GSPR BOTH X 40 1000 -LEN 0\nCONNECTOR K ~S *C *G\nEND\n&INSTATE -LOCATE CART 0.5 0 0\n";

#[test]
fn fraction_of_newton_step_leaves_power_of_itself() {
    // on a linear spring a half step halves the distance: n of them leave 0.5/2^n m, from 8 on less than 1E-3 g
    for steps in [8, 13, 20] {
        let x = function_values(&format!("{CART}&EQUI -OMEGA 0.5 -ITER_MAX {steps}\n"), "&BODY(LOCATION CART)")[0];
        assert!((x - 0.5f64.powi(steps + 1)).abs() < 1e-12, "{steps}: {x}");
    }
    let (_, said) = run_script(&format!("{CART}&EQUI -OMEGA 0.5 -ITER_MAX 7\n"));
    assert!(said.len() == 1 && said[0].contains("-0.15625 kN is left in X"), "20 kN over 2^7: {said:?}");
    // it is remembered, and -DEFAULTS forgets it
    let again = format!("{CART}&EQUI -OMEGA 0.5 -ITER_MAX 13\n&INSTATE -LOCATE CART 0.5 0 0\n");
    let x = function_values(&format!("{again}&EQUI -ECHO NO\n"), "&BODY(LOCATION CART)")[0];
    assert!((x - 0.5 / 8192.0).abs() < 1e-12, "{x}");
    let x = function_values(&format!("{again}&EQUI -DEFAULTS\n"), "&BODY(LOCATION CART)")[0];
    assert!(x.abs() < 1e-12, "{x}");
}

#[test]
fn longest_step_of_equilibrium_needs_distance_over_step_steps() {
    // half a metre in steps of 0.1 m
    let x = function_values(&format!("{CART}&EQUI -MOVE_MAX 0.1 -ITER_MAX 5\n"), "&BODY(LOCATION CART)")[0];
    assert!(x.abs() < 1e-9, "{x}");
    let (_, said) = run_script(&format!("{CART}&EQUI -MOVE_MAX 0.1 -ITER_MAX 4\n"));
    assert_eq!(said.len(), 1, "{said:?}");
}

#[test]
fn bare_newmark_is_default_scheme_of_runs() {
    let last = |options: &str| {
        let script = format!(
            "{CART}&ENV -TIME 10 0.1 -RAMP 0\nTDOM {options}\nPRCPOST\nTRAJECTORY\nSET_VARIABLE X 101 2\nEND\nEND\n"
        );
        run_script(&script)
    };
    let (bare, said) = last("-NEWMARK");
    assert!(said.iter().all(|m| !m.contains("NEWMARK")), "{said:?}");
    assert_eq!(bare, last("").0);
}

#[test]
fn event_of_run_places_body_by_trapezoidal_rule() {
    // x(n h) = 0.5 cos(n 2 atan(w h/2)) of the trapezoidal rule, w = sqrt(K g/W)
    let (h, rate) = (0.01, (40.0 * 9.806_65 / 100.0f64).sqrt());
    let script = format!("{CART}&ENV -TIME 2 {h} -RAMP 0\nTDOM -NEWMARK YES 0.25 0.5\n");
    for time in [0.5, 1.37, 2.0] {
        let x = function_values(&format!("{script}&INSTATE -EVENT {time}\n"), "&BODY(LOCATION CART)")[0];
        let want = 0.5 * (time / h * 2.0 * (rate * h / 2.0).atan()).cos();
        assert!((x - want).abs() < 1e-8, "{time}: {x} is not {want}");
    }
    let (_, said) = run_script(&format!("{CART}&INSTATE -EVENT 1\n"));
    assert!(said[0].contains("no run"), "{said:?}");
}

/// A box of 91.5 x 27.5 x 6.1 m with 6,000 m-tons at (45.75, 0, 5), and draft marks at its bow and at its quarters.
const BARGE: &str = "&DIMEN -DIMEN METERS M-TONS\nMEDIT\n&DESCRIBE BODY BARGE\n&SURFACE\nBLOCK HULL 0 -13.75 0 91.5 13.75 6.1\nEND\n\
                     *CG 45.75 0 5\n#WEIGHT *CG 6000 10 25 25\n*F1 0 0 0\n*F2 0 0 6\n*S1 91.5 13.75 0\n*S2 91.5 13.75 6\n*P1 91.5 -13.75 0\n\
                     *P2 91.5 -13.75 6\nEND\n&DESCRIBE DMARK FWD *F1 *F2\n&DESCRIBE DMARK STB *S1 *S2\n&DESCRIBE DMARK PRT *P1 *P2\n";

#[test]
fn draft_marks_give_place_of_plane_through_their_readings() {
    // the water's surface in the body is z = a + b x + c y; the global Z axis there is (-sin t, cos t sin r, cos t cos r)
    let location = |records: &str| function_values(&format!("{BARGE}{records}\n"), "&BODY(LOCATION BARGE)");
    let near = |got: &[f64], want: [f64; 3]| {
        let got = [got[2], got[3], got[4]];
        got.iter().zip(want).for_each(|(g, w)| assert!((g - w).abs() < 1e-8, "{got:?} is not {want:?}"));
    };
    near(&location("&INSTATE -DRAFT FWD 2.5"), [-2.5, 0.0, 0.0]);
    let trim = (1.0 / 91.5f64).atan();
    near(&location("&INSTATE -DRAFT FWD 2 PRT 3"), [-2.0 * trim.cos(), 0.0, trim.to_degrees()]);
    let (b, c) = ((2.75 - 2.0) / 91.5, (3.0 - 2.5) / 27.5);
    let roll = -f64::atan(c);
    let trim = f64::atan(b * roll.cos());
    let found = location("&INSTATE -DRAFT FWD 2 STB 3 PRT 2.5");
    near(&found, [-2.0 * trim.cos() * roll.cos(), roll.to_degrees(), trim.to_degrees()]);
    let (text, said) = run_script(&format!("{BARGE}&INSTATE -DRAFT FWD 2 STB 3 PRT 2.5\n&STATUS DRAFT\n"));
    assert!(text.contains("2.0000") && text.contains("3.0000") && text.contains("2.5000"), "{text} {said:?}");
}

#[test]
fn wrong_draft_marks_are_refused_and_leave_body_in_place() {
    for (record, says) in [
        ("&INSTATE -DRAFT FWD 2 FWX 3", "unknown draft mark FWX"),
        ("&INSTATE -DRAFT FWD 2 FWD 3", "no place of the body has these drafts"),
        ("&DESCRIBE DMARK BAD *F1", "DMARK takes two points"),
        ("&DESCRIBE DMARK BAD *F1 *F1", "runs between two points"),
        ("&DESCRIBE DMARK BARGE *F1 *F2", "BARGE is the name of a body already"),
        ("&INSTATE -SL_SET 1", "-SL_SET of &INSTATE is not supported"),
        ("&DESCRIBE INTEREST", "INTEREST lacks its points"),
        ("MEDIT\nDELETE *F1", "*F1 is used by FWD"),
    ] {
        let (text, said) = run_script(&format!("{BARGE}{record}\nEND\n&TYPE <&BODY(LOCATION BARGE)>\n"));
        assert!(said[0].contains(says) && text.contains("<0 0 0 0 0 0>"), "{record}: {said:?} {text}");
    }
}

#[test]
fn point_of_body_is_moved_to_global_coordinates() {
    let script = format!("{BARGE}&INSTATE -CONDITION BARGE 3 2 1 -POINT *S1 100 20\n");
    let got = function_values(&script, "&POINT(COORDINATES *S1 -GLOBAL)");
    assert!((got[0] - 100.0).abs() < 1e-9 && (got[1] - 20.0).abs() < 1e-9, "{got:?}");
    let turned = function_values(&script, "&BODY(LOCATION BARGE)");
    assert!((turned[2] + 3.0).abs() < 1e-9 && turned[3..] == [2.0, 1.0, 0.0], "{turned:?}");
}

#[test]
fn points_of_interest_are_marked_by_associate_as_by_name() {
    let report = |record: &str| {
        let rest = "&ENV -TIME 1 0.1 -RAMP 0\nTDOM\nPRCPOST\nPOINTS\nREPORT\nEND\nEND\n";
        run_script(&format!("{CART}&DESCRIBE INTEREST {record}\n{rest}")).0
    };
    assert_eq!(report("-ASSOCIATE *C"), report("*C"));
}

#[test]
fn status_of_buoyancy_and_weight_has_published_heights_of_barge() {
    // GMT 23.2533 m, GML 296.071 m, KB 1.16317 m of this barge
    let (text, said) = run_script(&format!("{BARGE}&INSTATE -CONDITION 2.3263421903965686\n&STATUS B_W\n"));
    for number in ["23.25", "296.07", "1.1632", "6000.00"] {
        assert!(text.contains(number), "{number}: {text} {said:?}");
    }
    let (brief, _) = run_script(&format!("{BARGE}&STATUS B_W -BRIEF\n"));
    assert!(text.contains("&STATUS MODES") && !brief.contains("&STATUS MODES"), "{brief}");
}

#[test]
fn words_of_moses_ask_for_reports_of_other_names() {
    for (word, kind) in [
        ("PARTS", "BODIES"),
        ("NODE", "POINTS"),
        ("POINT", "POINTS"),
        ("G_FORCE", "FORCE"),
        ("G_LOAD", "LOADS"),
        ("TIP-HOOK", "ASSEMBLIES"),
        ("CONFIG", "CONFIGURATION"),
    ] {
        let [one, other] = [word, kind].map(|name| run_script(&format!("{BARGE}&STATUS {name}\n")));
        assert_eq!(one, other, "{word}");
    }
    let (text, said) = run_script(&format!("{BARGE}&STATUS FORCE -FORCE WEIGHT\n&STATUS SIZE -FORCE WEIGHT\n"));
    assert!(text.contains("WEIGHT") && !text.contains("TOTAL"), "{text}");
    assert_eq!(said, ["SIZE has no forces to choose among"]);
    let (text, _) = run_script(&format!("{BARGE}&STATUS NAMES\n&STATUS SYSTEM -HARD\n"));
    assert!(text.contains("draft mark") && !text.contains("C O N F I G"), "{text}");
}

/// The numbers of the first printed row that begins with some words.
fn row(text: &str, begins: &[&str]) -> Vec<f64> {
    let found =
        text.lines().map(|line| line.split_whitespace().collect::<Vec<_>>()).find(|words| words.starts_with(begins));
    let words = found.unwrap_or_else(|| panic!("no row of {begins:?}: {text}"));
    words[begins.len()..].iter().filter_map(|word| word.parse().ok()).collect()
}

/// A tube of 2 m, upright between -20 and -10 m, or between 10 and 20 m.
fn tube(parameters: &str, low: f64) -> String {
    format!(
        "&DIMEN -DIMEN METERS K-NTS\n{parameters}\nMEDIT\n&DESCRIBE BODY B\n*LOW 0 0 {low}\n*HIGH 0 0 {}\n&SURFACE\nTUBE LEG *LOW *HIGH 2000\nEND\n\
         #WEIGHT *LOW 100 1 1 1\nEND\n&ENV -DEPTH 50 -CURRENT 1.5 180 -WIND 40 180 -W_PROFILE POWER 0\n",
        low + 10.0
    )
}

#[test]
fn parameters_of_tubes_and_plates_scale_their_loads() {
    // 1/2 rho CD D L U^2 = 1/2 1.025 0.7 2 10 1.5^2 kN
    let (text, said) =
        run_script(&format!("{}&STATUS FORCE -FORCE V_DRAG\n", tube("&PARAMETER -DRGTUB 1E4 0.7 1E6 0.7", -20.0)));
    let drag = row(&text, &["B", "V_DRAG"]);
    assert!((drag[0].abs() - 0.5 * 1.025 * 0.7 * 20.0 * 2.25).abs() < 0.005, "{drag:?} {said:?}");
    // wind: 1/2 rho CS D L V^2, of a prism of 64 sides, in air of 1.226 kg/m3; 40 knots
    let wind = |parameters: &str| {
        row(&run_script(&format!("{}&STATUS FORCE -FORCE WIND\n", tube(parameters, 10.0))).0, &["B", "WIND"])[0].abs()
    };
    let full = 0.5 * 1.226e-3 * 20.0 * (40.0f64 * 1852.0 / 3600.0).powi(2);
    assert!((wind("&PARAMETER -WCSTUBE 0.6") - 0.6 * full).abs() < 0.012, "{} {full}", wind("&PARAMETER -WCSTUBE 0.6"));
    assert!((wind("") - full).abs() < 0.012);
    // a plate of 10 x 10 m across the wind: 1/2 rho CD A V^2
    let plate = "&DIMEN -DIMEN METERS K-NTS\n&PARAMETER -DRGPLA 1.2\nMEDIT\n&DESCRIBE BODY B\n*A 0 0 10\n*B 0 10 10\n*C 0 10 20\n*D 0 0 20\n\
                 #PLATE *A *B *C *D\n#WEIGHT *A 1 1 1 1\nEND\n&ENV -WIND 40 180 -W_PROFILE POWER 0\n&STATUS FORCE -FORCE WIND\n";
    let force = row(&run_script(plate).0, &["B", "WIND"])[0].abs();
    assert!((force - 1.2 * full * 5.0).abs() < 0.005, "{force}");
    // -REMEMBER goes back to 1
    let back = "&PARAMETER -SAVE -DRGTUB 1E4 0.7\n&PARAMETER -REMEMBER";
    let drag = row(&run_script(&format!("{}&STATUS FORCE -FORCE V_DRAG\n", tube(back, -20.0))).0, &["B", "V_DRAG"]);
    assert!((drag[0].abs() - 0.5 * 1.025 * 20.0 * 2.25).abs() < 0.005, "{drag:?}");
}

#[test]
fn points_are_read_in_a_placed_system() {
    // X of the system along Y of the part: (1, 2, 3) is 10 - 2, 1, 3
    let script = "&DIMEN -DIMEN METERS K-NTS\n&DEFAULT -SAVE -LOCATION 10 0 0 0 0 90\nMEDIT\n*P 1 2 3\n&DEFAULT -REMEMBER\n*Q 1 2 3\nEND\n";
    let got = function_values(script, "&POINT(COORDINATES *P) &POINT(COORDINATES *Q)");
    let want = [8.0, 1.0, 3.0, 1.0, 2.0, 3.0];
    assert!(got.iter().zip(want).all(|(g, w)| (g - w).abs() < 1e-12), "{got:?}");
}

#[test]
fn time_of_reinforcement_is_taken_from_defaults() {
    let phases = |default: &str, option: &str| {
        run_script(&format!("{default}\n&ENV -DEPTH 300 -SEA ISSC 180 12 10 {option}\n&STATUS SEA_SPECTRUM\n")).0
    };
    assert_eq!(phases("&DEFAULT -T_REINF 120", ""), phases("", "-T_REINFORCE 120"));
    assert_ne!(phases("&DEFAULT -T_REINF 120", ""), phases("", ""));
    assert_eq!(phases("&DEFAULT -T_REINF 120", "-SEED 7"), phases("", "-SEED 7"));
}

#[test]
fn process_keeps_own_positions_connectors_and_run() {
    let script = format!(
        "{CART}&ENV -TIME 2 0.1 -RAMP 0\nTDOM\n&DESCRIBE PROCESS TOW\n&INSTATE -LOCATE CART 3 0 0\nMEDIT\n&CONNECTOR K -INACTIVE\nEND\n"
    );
    let (text, said) = run_script(&format!("{script}&STATUS PROCESS\n&INSTATE -EVENT 1\n"));
    assert!(text.contains("Process is TOW") && said.iter().any(|m| m.contains("no run")), "{text} {said:?}");
    assert_eq!(row(&text, &["DEFAULT", "a", "run"]), [0.0; 0]);
    let back = format!("{script}&DESCRIBE PROCESS DEFAULT\n");
    assert!((function_values(&back, "&BODY(LOCATION CART)")[0] - 0.5).abs() < 1e-12);
    assert!(run_script(&format!("{back}&TYPE <&CONNECTOR(STATUS K)>\n")).0.contains("<ACTIVE>"));
    let there = format!("{back}&DESCRIBE PROCESS TOW\n");
    assert!((function_values(&there, "&BODY(LOCATION CART)")[0] - 3.0).abs() < 1e-12);
    let (_, said) = run_script(&format!("{back}&DESCRIBE PROCESS DEFAULT -EVENTS\n&INSTATE -EVENT 1\n"));
    assert!(said.iter().any(|m| m.contains("no run")), "{said:?}");
}

#[test]
fn older_form_of_assignment_drops_its_comment() {
    let (text, said) = run_script("&SET_VAR LEN := 215   $ comment\n&SET_VAR W = 2\n&TYPE <%LEN> <%W>\n&SET A := 1\n");
    assert!(text.contains("<215> <2>") && said.len() == 1 && said[0].contains("expected `=`"), "{text} {said:?}");
}

#[test]
fn summaries_have_tables_of_status() {
    let (menu, _) = run_script(&format!(
        "{BARGE}&SUMMARY\nPOINT_SUM *F1\nPIECE_SUM\nCATEG_SUM\nCLASS_SUM\nLOADG_SUM ATTRIB\nEND\n"
    ));
    let (status, _) = run_script(&format!(
        "{BARGE}&STATUS POINTS *F1\n&STATUS PIECES\n&STATUS CATEGORY\n&STATUS CL_FLEX\n&STATUS LOADS\n"
    ));
    assert_eq!(menu, status);
    let (text, said) = run_script(&format!(
        "{BARGE}MEDIT\n*SAME 0 0 0.0005\n*NEAR 0 0 0.5\nEND\n&SUMMARY\nN_COINCIDENT\nPOINT_SUM *FX\nEND\n"
    ));
    assert!((row(&text, &["*F1", "*SAME"])[3] - 0.0005).abs() < 1e-9 && !text.contains("*NEAR"), "{text}");
    assert!(said.len() == 1 && said[0].contains("*FX"), "{said:?}");
}

#[test]
fn picture_options_without_effect_keep_picture_equal() {
    let picture = |options: &str| run_script(&format!("{CART}&PICTURE TOP {options}\n"));
    let (plain, _) = picture("");
    let (with, said) = picture("-CATEGORY STR_MODEL A -RENDER GL -DETAIL YES");
    assert_eq!((plain, said.len()), (with, 3), "{said:?}");
    let (_, said) = run_script(&format!("{CART}&PICTURE TOP 30 45\n&PICTURE TOP 30\n"));
    assert!(said.len() == 1 && said[0].starts_with("angles after the view"), "{said:?}");
}

#[test]
fn categories_have_sums_and_centers_of_their_weights() {
    // 100 at x = 0 and 300 at x = 4, times 1.1, come to 440 at x = 3; 50 at x = 10; buoyancy of 80 at x = 5
    let model = "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n&DESCRIBE BODY B\n*P0 0 0 0\n*P4 4 0 0\n*P10 10 0 0\n*P5 5 0 0\n\
                 #WEIGHT *P0 100 1 1 1 -CATEGORY STEEL\n#WEIGHT *P4 300 1 1 1 -CATEGORY STEEL\n#WEIGHT *P10 50 1 1 1\n\
                 #BUOY *P5 80 1 1 1 -CATEGORY STEEL\nEND\n&APPLY -PERCENT -CATEGORY STEEL #DEAD 110\n&STATUS CATEGORY\n";
    let (text, said) = run_script(model);
    let steel = row(&text, &["B", "STEEL"]);
    assert_eq!(steel, [440.0, 3.0, 0.0, 0.0, 80.0, 5.0, 0.0, 0.0], "{text} {said:?}");
    assert_eq!(row(&text, &["B", "EXTRA"])[..2], [50.0, 10.0], "{text}");
    // a process keeps its multipliers, and gives them back
    let weight = |records: &str| function_values(&format!("{model}{records}"), "&BODY(WEIGHT B)")[0];
    assert!((weight("") - 490.0).abs() < 1e-9);
    assert!((weight("&DESCRIBE PROCESS P\n&APPLY -PERCENT -CATEGORY STEEL #DEAD 100\n") - 450.0).abs() < 1e-9);
    let back = "&DESCRIBE PROCESS P\n&APPLY -PERCENT -CATEGORY STEEL #DEAD 100\n&DESCRIBE PROCESS DEFAULT\n";
    assert!((weight(back) - 490.0).abs() < 1e-9);
}

#[test]
fn added_mass_of_tubes_takes_its_parameter() {
    // rho pi/4 D^2 L CA across the axis, 1.025 t/m3
    let (text, said) = run_script(&format!("{}&STATUS PIECES\n", tube("&PARAMETER -AMCTUB 0.8", -20.0)));
    let want = 1.025 * std::f64::consts::PI / 4.0 * 4.0 * 10.0 * 0.8;
    let got = row(&text, &["B", "X"])[0];
    assert!((got - want).abs() < 1e-3, "{got} is not {want}: {said:?}");
}

/// A ball that heaves in waves, with its database, and the menu of the frequency domain open.
const BALL: &str = "&DIMEN -DIMEN METERS K-NTS\n&FILE OPEN A ball.1\n&FILE WRITE A 6 3 3 900 300\n&FILE WRITE A 9 3 3 1100 400\n&FILE CLOSE A\n\
     &FILE OPEN X ball.3\n&FILE WRITE X 6 180 3 150 0 150 0\n&FILE WRITE X 9 180 3 220 0 220 0\n&FILE CLOSE X\n\
     MEDIT\n*G 0 0 1\n&DESCRIBE BODY BALL -IGNORE X Y RX RY RZ\n*CG 0 0 0\n#WEIGHT *CG 20000 4 4 4\n\
     #HYDROSTATIC *CG 3000 0 0 -BUOYANCY 20000 -ZCGE 0\n~S GSPR BOTH Z 100 1000 -LEN 0\nCONNECTOR LINE ~S *CG *G\n\
     DATABASE BALL -WAMIT job.ans/ball\nEND\n&EQUI\n&ENV -SEA ISSC 0 2 8\n";

#[test]
fn periods_headings_and_statistic_of_frequency_domain_come_from_defaults() {
    let motions = |default: &str, rao: &str| {
        run_script(&format!(
            "{BALL}{default}\nFREQ_RESPONSE\nRAO {rao}\nMOTION BALL\nVIEW Period 'Z Amp' 'Z Phase'\nEND\nEND\n"
        ))
    };
    let (given, said) = motions("", "-PERIOD 6.5 7 8 -HEADING 0");
    assert!(given.contains("6.5"), "{given} {said:?}");
    assert_eq!(motions("&DEFAULT -PERIOD 6.5 7 8 -HEADING 0", "").0, given);
    assert_ne!(motions("", "").0, given);
    // the most of a record asked for as 3.72 times its rms
    let script = format!(
        "{BALL}&DEFAULT -PROBABILITY RMS 3.72\nFREQ_RESPONSE\nSRESPONSE\nSTATISTICS MOTION BALL\nREPORT\nEND\nEND\n"
    );
    let (text, said) = run_script(&script);
    let [_, _, _, rms, _, most, ..] = row(&text, &["Z"])[..] else { panic!("{text} {said:?}") };
    // both are printed to 0.01
    assert!(rms > 0.0 && (most - 3.72 * rms).abs() < 0.024, "{most} is not 3.72 of {rms}");
    assert!(text.contains("3.7200"), "{text}");
}
