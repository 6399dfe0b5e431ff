//! String functions against closed forms: a box that floats, a load on a tie, a catenary, arithmetic.

use crate::common::{assert_share, function_values, run_script};

/// Fails unless a function gives these numbers, to so many of their digits.
fn assert_values(script: &str, function: &str, want: &[f64], share: f64) {
    let got = function_values(script, function);
    assert_eq!(got.len(), want.len(), "{function}: {got:?}");
    for (got, want) in got.iter().zip(want) {
        assert!((got - want).abs() <= share * want.abs().max(1e-6), "{function}: {got} is not {want}");
    }
}

/// A box of 91.5 x 27.5 x 6.1 m with 6,000 m-tons at (45.75, 0, 5), afloat on even keel in water of 1.025 m-tons a cubic metre.
const BARGE: &str = "&DIMEN -DIMEN METERS M-TONS\nMEDIT\n&DESCRIBE BODY BARGE\n&SURFACE\nBLOCK HULL 0 -13.75 0 91.5 13.75 6.1\nEND\n\
                     *CG 45.75 0 5\n#WEIGHT *CG 6000 10 25 25\nEND\n&INSTATE -CONDITION 2.3263421903965686\n";

#[test]
fn body_function_gives_hydrostatics_of_a_floating_box() {
    // T = W/(rho L B); KB = T/2; BM = B^2/(12 T), L^2/(12 T)
    let (length, breadth, depth, weight, rho): (f64, f64, f64, f64, f64) = (91.5, 27.5, 6.1, 6000.0, 1.025);
    let draft = weight / (rho * length * breadth);
    let gm = |side: f64| draft / 2.0 + side * side / (12.0 * draft) - 5.0;
    assert_values(BARGE, "&BODY(DRAFT BARGE)", &[draft], 1e-8);
    assert_values(BARGE, "&BODY(DISPLACE BARGE)", &[weight], 1e-8);
    assert_values(BARGE, "&BODY(CB BARGE)", &[length / 2.0, 0.0, draft / 2.0], 1e-8);
    assert_values(BARGE, "&BODY(GM BARGE)", &[gm(breadth), gm(length)], 1e-8);
    // the printed values of this barge: 23.2533 and 296.071 m
    assert_values(BARGE, "&BODY(GM BARGE)", &[23.2533, 296.071], 2e-6);
    assert_values(BARGE, "&BODY(MAX_BUOY BARGE)", &[rho * length * breadth * depth], 1e-12);
    assert_values(BARGE, "&BODY(WEIGHT BARGE) &BODY(CG BARGE)", &[weight, 45.75, 0.0, 5.0], 1e-12);
    assert_values(BARGE, "&BODY(EXTREMES BARGE)", &[0.0, 91.5, -13.75, 13.75, 0.0, 6.1], 1e-12);
    assert_values(
        BARGE,
        "&PART(WEIGHT BARGE) &PART(EXTREMES BARGE)",
        &[6000.0, 0.0, 91.5, -13.75, 13.75, 0.0, 6.1],
        1e-12,
    );
}

#[test]
fn center_of_buoyancy_of_heeled_box_moves_by_wall_sided_formula() {
    // dy = b^2 tan(phi)/(12 T), dz = dy tan(phi)/2, in the axes of the body; T along its z axis
    let draft = 6000.0 / (1.025 * 91.5 * 27.5);
    let heel = 5f64.to_radians();
    let shift = 27.5f64.powi(2) * heel.tan() / (12.0 * draft);
    let script = format!("{BARGE}&INSTATE -CONDITION BARGE {} 5 0\n", draft * heel.cos());
    let [x, y, z] = function_values(&script, "&BODY(CB BARGE)")[..] else { panic!("three numbers") };
    assert_share(x, 45.75, 1e-9);
    // a positive roll lifts the starboard side: the center moves to port
    assert_share(y.abs(), shift, 1e-9);
    assert_share(z, draft / 2.0 + shift * heel.tan() / 2.0, 1e-9);
}

const LOAD: &str = "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n*A 0 0 20\n&DESCRIBE BODY LOAD\n*HOOK 0 0 2\n*CG 0 0 0\n#WEIGHT *CG 500 1 1 1\n\
                    ~TIE SL_ELEM 60 TENSION -LEN 10\nCONNECTOR T ~TIE *HOOK *A\nEND\n&INSTATE -LOCATE LOAD 0 0 8\n&EQUI -TOL 1E-10\n";

#[test]
fn connector_function_gives_weight_that_hangs_on_a_tie() {
    assert_values(LOAD, "&CONNECTOR(TENSION T)", &[500.0], 1e-9);
    assert_values(LOAD, "&CONNECTOR(FORCE T)", &[0.0, 0.0, 500.0, 500.0], 1e-9);
    assert_values(LOAD, "&CONNECTOR(LENGTH T) &CONNECTOR(HORIZONTAL T)", &[10.0, 0.0], 1e-9);
    // the tie of 60 mm and 29,000 ksi stretches by W L/(E A)
    let stiffness = 29_000.0 * 4_448.221_615_260_5 / 0.0254f64.powi(2) * std::f64::consts::FRAC_PI_4 * 0.06f64.powi(2);
    assert_values(LOAD, "&ELEMENT(LENGTH T)", &[10.0 * (1.0 + 500e3 / stiffness)], 1e-9);
    assert_values(LOAD, "&ELEMENT(DCOSINES T)", &[0.0, 0.0, 1.0], 1e-9);
    let off = format!("{LOAD}MEDIT\n&CONNECTOR T -INACTIVE\nEND\n");
    assert_values(&off, "&CONNECTOR(TENSION T) &CONNECTOR(FORCE T)", &[0.0; 5], 0.0);
    assert!(
        run_script(&format!("{off}&TYPE <&CONNECTOR(STATUS T) &ELEMENT(ELE_TYPE T)>\n"))
            .0
            .contains("<INACTIVE SL_ELEM>")
    );
}

#[test]
fn connector_function_gives_tension_and_length_on_bottom_of_catenary() {
    // stiff line of w = 1 kN/m in 100 m with H = 300 kN: T = H + w h, hanging length sqrt(h^2 + 2 h H/w), X = H/w acosh(1 + w h/H)
    let (h, pull, length): (f64, f64, f64) = (100.0, 300.0, 500.0);
    let hanging = (h * h + 2.0 * h * pull).sqrt();
    let reach = pull * (1.0 + h / pull).acosh() + length - hanging;
    let script = format!(
        "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n*P 0 0 0\n~W B_CAT 100 EXACT -LEN {length} -DEP {h} -BUOY 0 -WTPL 1 -EMOD 1E9\n\
         CONNECTOR A -ANC 0 {reach} ~W *P\nEND\n"
    );
    // AE is 7.9E9 kN: its stretch changes the numbers by less than 1e-6
    assert_values(&script, "&CONNECTOR(TENSION A)", &[pull + h], 1e-5);
    assert_values(&script, "&CONNECTOR(HORIZONTAL A)", &[pull], 1e-5);
    assert_values(&script, "&CONNECTOR(ON_BOTTOM A)", &[length - hanging], 1e-5);
    assert_values(&script, "&CONNECTOR(DISTANCE A)", &[reach], 1e-9);
}

#[test]
fn tube_is_an_element_with_length_cosines_and_buoyancy() {
    let script = "&DIMEN -DIMEN METERS M-TONS\nMEDIT\n&DESCRIBE BODY B\n*P 0 0 0\n*Q 3 0 4\nEND\n&SURFACE\nTUBE LEG *P *Q 2000\nEND\n";
    let buoyancy = 1.025 * std::f64::consts::FRAC_PI_4 * 4.0 * 5.0;
    assert_values(script, "&ELEMENT(LENGTH LEG) &ELEMENT(DCOSINES LEG)", &[5.0, 0.6, 0.0, 0.8], 1e-12);
    assert_values(script, "&ELEMENT(BUOYANCY LEG)", &[buoyancy], 1e-12);
    let (_, said) = run_script(&format!("{script}&TYPE x &ELEMENT(CDR LEG)\n&TYPE x &ELEMENT(LENGTH LOG)\n"));
    assert!(said[0].contains("no stress analysis") && said[1] == "unknown element LOG", "{said:?}");
}

#[test]
fn beam_is_an_element_with_its_segments_weight_and_displacement() {
    // 4 m of tube of 1000 x 25 mm and 6 m of 500 x 20 mm, flooded: it displaces its metal, and weighs that of steel
    let script = "&DIMEN -DIMEN METERS M-TONS\nMEDIT\n&DESCRIBE BODY B\n*P 0 0 0\n*Q 6 0 8\n~C TUBE 1000 25 -LEN 4\n~C TUBE 500 20\n\
                  BEAM LEG ~C -FLOOD YES -CATEGORY LEGS *P *Q\nEND\n&APPLY -CATEGORY LEGS #BUOY 1.5 #DEAD 2\n";
    let ring = |d: f64, t: f64| std::f64::consts::PI * t * (d - t);
    let metal = 4.0 * ring(1.0, 0.025) + 6.0 * ring(0.5, 0.02);
    assert_values(script, "&ELEMENT(LENGTH LEG) &ELEMENT(DCOSINES LEG)", &[10.0, 0.6, 0.0, 0.8], 1e-12);
    assert_values(script, "&ELEMENT(BUOYANCY LEG)", &[1.5 * 1.025 * metal], 1e-9);
    assert_values(script, "&ELEMENT(WEIGHT LEG)", &[2.0 * 7.85 * metal], 1e-9);
    let (text, _) =
        run_script(&format!("{script}&TYPE <&ELEMENT(CLASS LEG) &ELEMENT(ELE_TYPE LEG) &ELEMENT(CATEGORY LEG)>\n"));
    assert!(text.contains("<~C BEAM LEGS>"), "{text}");
}

#[test]
fn environment_function_gives_values_as_env_takes_them() {
    let env = "&DIMEN -DIMEN METERS K-NTS\n&ENV E1 -SEA ISSC 180 4 9.5 -WIND 40 90 -CURRENT 1.5 45 -DEPTH 80 -TIDE 2 -SPGWATER 1.02\n\
               &ENV E2 -DEPTH 90\n";
    assert_values(env, "&ENV(DEPTH) &ENV(DEPTH E1) &ENV(TIDE E1) &ENV(SPGWATER E1)", &[90.0, 80.0, 2.0, 1.02], 1e-12);
    assert_values(env, "&ENV(WIND E1) &ENV(CURRENT E1)", &[40.0, 90.0, 1.5, 45.0], 1e-12);
    let (text, said) = run_script(&format!("{env}&TYPE <&ENV(SEA E1)> <&ENV(SEA)> <&ENV(NAME)>\n"));
    assert!(text.contains("<ISSC 180 4 9.5> <> <E2>"), "{text} {said:?}");
}

#[test]
fn points_between_two_points_are_ordered_from_first_to_last() {
    let points = "MEDIT\n*B 30 0 0\n*M2 20 0 0\n*A 0 0 0\n*M1 10 0 0\n*OFF 10 1 0\nEND\n";
    let (text, said) = run_script(&format!("{points}&TYPE <&POINT(N_2NODES *A *B)> <&POINT(N_2NODES *B *A)>\n"));
    assert!(text.contains("<*A *M1 *M2 *B> <*B *M2 *M1 *A>"), "{text} {said:?}");
    let (_, said) = run_script(&format!("{points}&TYPE x &POINT(RATIO *A)\n"));
    assert!(said[0].contains("stress analysis, which windlass does not make"), "{said:?}");
}

#[test]
fn names_are_listed_by_singular_and_plural_words() {
    let (text, said) = run_script(&format!(
        "{BARGE}&TYPE <&NAMES(BODY)|&NAMES(BODIES)|&NAMES(NODE)|&NAMES(POINTS)|&NAMES(PIECES)|&NAMES(CLASS)|&NAMES(ASSEMBLY)>\n"
    ));
    assert!(text.contains("<BARGE|BARGE|*CG|*CG|HULL||>"), "{text} {said:?}");
    assert!(run_script("&TYPE <&BODY(CURRENT)> <&PART(CURRENT)>\n").0.contains("<> <>"));
}

#[test]
fn macro_call_without_argument_or_with_option_twice_is_refused() {
    let pair = "&MACRO PT X Y -OPT FLAG V\n&TYPE ran %X %Y\n&ENDMACRO\n";
    for (call, says) in [
        ("PT 1", "macro PT lacks Y"),
        ("PT 1 2 -OPT", "macro PT lacks V of -OPT"),
        ("PT 1 2 -OPT 3 -OP 4", "-OPT of macro PT is given twice"),
    ] {
        let (text, said) = run_script(&format!("{pair}{call}\n"));
        assert!(said == [says] && !text.contains("ran"), "{call}: {said:?} {text}");
    }
    assert_eq!(run_script(&format!("{pair}PT 1,,\n")).1, [""; 0], "an empty value is given by two commas");
}

#[test]
fn arithmetic_functions_match_tabulated_values() {
    for (function, want) in [
        ("&NUMBER(ROUND 2.345 2) &NUMBER(ROUND -2.5) &NUMBER(ROUND 12345 -2)", &[2.35, -3.0, 12_300.0][..]),
        ("&NUMBER(FLOOR -2.5) &NUMBER(CEILING -2.5) &NUMBER(INTEGER -2.6)", &[-3.0, -2.0, -3.0]),
        ("&NUMBER(MOD 17 5) &NUMBER(MOD -17 5) &NUMBER(MOD 7.5 2)", &[2.0, -2.0, 1.5]),
        ("&NUMBER(LOG10 1000) &NUMBER(LOG10 3) &NUMBER(LN 3)", &[3.0, 0.477_121_254_7, 1.098_612_288_7]),
        ("&NUMBER(ASIND 0.5) &NUMBER(ACOSD 0.5) &NUMBER(ATAND 1)", &[30.0, 60.0, 45.0]),
        ("&NUMBER(ATAN2D -1 1) &NUMBER(ATAN2D 3**0.5 1)", &[135.0, 30.0]),
        ("&NUMBER(SUM 1 2 3.5) &NUMBER(PRODUCT 2 3 4)", &[6.5, 24.0]),
        ("&NUMBER(ADDV 1 .5 0 0 10 20 30)", &[10.5, 20.0, 30.0]),
    ] {
        assert_values("", function, want, 1e-7);
    }
    let (_, said) = run_script("&TYPE x &NUMBER(ASIND 2)\n&TYPE x &NUMBER(MOD 1 0)\n&TYPE x &NUMBER(ROUND 1 0.5)\n");
    assert_eq!(said.len(), 3, "{said:?}");
    // what MOSES has keeps its abbreviations
    assert_values("", "&NUMBER(L 1) &NUMBER(MEA 1 3) &NUMBER(ABS -2)", &[0.0, 2.0, 2.0], 0.0);
}

#[test]
fn string_actions_take_text_apart_and_put_it_together() {
    let (text, said) = run_script(
        "&TYPE <&STRING(LENGTH ab cd)|&STRING(UPPER ab)|&STRING(LOWER AB)|&STRING(CONCAT ML A 1)|\
                            &STRING(SUBSTRING 2 3 LINE)|&STRING(POSITION NE LINE)|&STRING(POSITION X LINE)|&STRING(REPLACE A B CAT)>\n\
                            &TYPE x &STRING(SUBSTRING 0 3 LINE)\n&TYPE x &STRING(LENGHT a)\n",
    );
    assert!(text.contains("<5|AB|ab|MLA1|IN|3|0|CBT>"), "{text} {said:?}");
    assert!(said[0].contains("numbers of two characters") && said[1].contains("unknown action"), "{said:?}");
}

#[test]
fn compartment_function_gives_data_of_the_record_that_fills_it() {
    // a tank of 20 x 10 x 6 m, 40 per cent full of water of 1.025: 480 m3, 492 m-tons, 2.4 m deep, its centre 1.2 m above its floor
    let tank = format!(
        "{BARGE}MEDIT\n&DESCRIBE BODY BARGE\n&DESCRIBE COMPARTMENT T1\nPGEN -PERM -1\nPLANE 10 30 -RECT 0 6 10\nEND\nEND\n\
         &COMPARTMENT -CORRECT -PERCENT T1 40 1.025\n"
    );
    let (text, said) = run_script(&format!(
        "{tank}&TYPE <&COMPARTMENT(T1 -AMOUNT)> <&COMPARTMENT(T1 -PERCENT)> <&NAMES(COMPARTMENT)>\n"
    ));
    let values_of = |option: &str| -> Vec<f64> {
        let (text, _) = run_script(&format!("{tank}&TYPE => &COMPARTMENT(T1 {option})\n"));
        let line = text.lines().find_map(|line| line.strip_prefix("=> ")).unwrap_or_default().to_string();
        line.split_whitespace().filter_map(|word| word.parse().ok()).collect()
    };
    let near = |got: &[f64], want: &[f64]| {
        assert!(
            got.len() == want.len() && got.iter().zip(want).all(|(g, w)| (g - w).abs() < 1e-9 * w.abs().max(1.0)),
            "{got:?} {want:?}"
        );
    };
    assert!(text.contains("<T1 492 1.025>") && text.contains("<T1>"), "{text} {said:?}");
    near(&values_of("-AMOUNT"), &[492.0, 1.025]);
    near(&values_of("-PERCENT"), &[40.0, 1.025]);
    near(&values_of("-SOUNDING"), &[2.4, 1.025]);
    near(&values_of("-VOLUME"), &[480.0]);
    near(&values_of("-CG"), &[20.0, 0.0, 1.2]);
    // its value fills the tank again
    let again = format!(
        "{tank}&SET AMT = &COMPARTMENT(T1 -AMOUNT)\n&COMPARTMENT -PERCENT T1 0\n&COMPARTMENT -CORRECT -AMOUNT %AMT\n"
    );
    let (text, said) = run_script(&format!("{again}&TYPE <&COMPARTMENT(T1 -AMOUNT)>\n"));
    assert!(text.contains("<T1 492 1.025>"), "{text} {said:?}");
}

#[test]
fn names_come_in_singular_and_plural() {
    let model = "MEDIT\n&DESCRIBE BODY B\n*P 0 0 9\n*Q 9 0 9\n&DESCRIBE LOAD_GROUP LG\n#WEIGHT *P 10 -CATEGORY STEEL\n#WEIGHT *P 10\n&DESCRIBE HOLE H VENT -POINT *P -NORMAL 0 0 1\n\
                 ~T TUBE 20 1\nBEAM BM ~T *P *Q\nEND\n&DESCRIBE SENSOR S -SIGNAL POINT *P Z\n&DATA SHAPES\nW14 IBEAM 14 14 1 1\nEND\n";
    for (kinds, want) in [
        (["LOAD_GROUPS", "LOAD_GROUP"], "B LG"),
        (["CATEGORIES", "CATEGORY"], "STEEL EXTRA STR_MODEL"),
        (["HOLES", "HOLE"], "H"),
        (["SENSORS", "SENSOR"], "S"),
        (["ELEMENTS", "ELEMENT"], "BM"),
        (["SHAPES", "SHAPE"], "W14"),
        (["PROCESSES", "PROCESS"], "DEFAULT"),
        (["PI_VIEWS", "PI_VIEW"], ""),
    ] {
        for kind in kinds {
            let (text, said) = run_script(&format!("{model}&TYPE <&NAMES({kind})> <&NAMES({kind} NO@)>\n"));
            assert!(text.contains(&format!("<{want}> <>")), "{kind}: {text} {said:?}");
        }
    }
}

#[test]
fn question_without_answer_is_one_error_and_script_goes_on() {
    let script = "&LOCAL DUM = &GET(YES/NO )\n&IF &STRING(MATCH '%DUM%' YES) &THEN\n&TYPE yes\n&ELSE\n&TYPE no\n&ENDIF\n&LOCAL DUM = &GET(YES/NO )\n&TYPE behind\n";
    let (text, said) = run_script(script);
    assert!(text.contains("no\nbehind"), "{text}");
    assert!(said.len() == 1 && said[0].contains("&GET got no answer"), "{said:?}");
}

#[test]
fn list_of_names_is_gone_through_by_pattern_and_again() {
    let walk = "&LOOP\n&EXIT &VARIABLE(-WHILE <MACDBF>TANKS 1@ T)\n&TYPE got %T\n&ENDLOOP\n";
    let (text, said) =
        run_script(&format!("&VARIABLE <MACDBF>TANKS -ADD 1P 1S 2P\n&VARIABLE <macdbf>tanks -ADD 1C\n{walk}{walk}"));
    let got: Vec<_> = text.lines().filter_map(|line| line.strip_prefix("got ")).collect();
    assert_eq!(got, ["1P", "1S", "1C", "1P", "1S", "1C"], "{said:?}");
    let (_, said) = run_script(
        "&VARIABLE TANKS -ADD A\n&VARIABLE <NODBF>T -ADD A\n&VARIABLE <MACDBF>T\n&SET X = &VARIABLE(-WHILE <MACDBF>T @ V)\n&SET X = &VARIABLE(-FIRST <MACDBF>T @ V)\n",
    );
    let heads = [
        "`TANKS` names no list",
        "unknown database NODBF",
        "&VARIABLE lacks -ADD",
        "there is no list <MACDBF>T",
        "unknown option of &VARIABLE",
    ];
    assert!(said.len() == 5 && said.iter().zip(heads).all(|(said, head)| said.starts_with(head)), "{said:?}");
}
