//! Forces by category: every load and every class has a place in the tables, whose rows add up to what moves the body.

use crate::common::run as runs;
use crate::common::run::model_as_written;

use runs::settings;
use windlass_base::table::{Cell, Table};
use windlass_connectors::CLASSES;
use windlass_model::{Mass, Model};
use windlass_solve::results::{self, Magnitude};
use windlass_solve::time::{Action, ActionKind, Run, SilentWatcher, Trigger};
use windlass_solve::{System, tables};

/// A body on which every kind of load acts, one with a database, and a junction on the bottom.
const LOADS: &str = "&DATA CONVOLUTION TIME SOFT 0 900 1 700 3 500 8 300 20 200 -NDOF 3
&ENV CALM -DEPTH 100 -TIME 2 0.1
&ENV STORM -DEPTH 100 -SEA JONSWAP 180 3 9 -WIND 40 150 -CURRENT 1.5 120 -TIME 2 0.1 -RAMP 0
MEDIT
*G 60 0 5
*GT 20 5 -95
&DESCRIBE BODY BARGE
*CG 0 0 -1
*K 3 2 -4
*D 0 0 12
*P1 18 -8 6
*P2 18 8 6
*P3 18 8 10
*P4 18 -8 10
*T1 -15 0 -30
*T2 -15 0 -6
*E 20 0 5
*F 20 5 0
#WEIGHT *CG 39000 8 14 15
#AREA *D 100 200
#PLATE *P1 *P2 *P3 *P4 -CD 1.2
#TABLE *K 0 -60 0 0 0 0 0 90 0 -120 0 0 0 0 180 60 0 0 0 0 0 -SYMMETRIC
#DRIFT *K 0 6 -60 0 0 0 0 0 16 -2 0 0 0 0 0 -SYMMETRIC
#DRIFT *K 90 6 0 -60 0 0 0 0 16 0 -2 0 0 0 0 -SYMMETRIC
#DRIFT *K 180 6 60 0 0 0 0 0 16 2 0 0 0 0 0 -SYMMETRIC
#DRAG *K 20 80
#DAMP *CG 100 100 500 8E5 2E6 1E6
#AMASS *CG 5E3 8E3 2E4 1E5 5E5 5E5
END
&SURFACE
BLOCK HULL -20 -10 -5 20 0 5 -CS_WIND 1 1 1 -CS_CURRENT 1 1 1
BLOCK PRESSED -20 0 -5 20 10 5 -DIFTYPE FK
TUBE LEG *T1 *T2 1500 -CD 1 -CAA 0.5
END
MEDIT
&DESCRIBE BODY BALL
*CB 0 0 -3
#WEIGHT *CB 21053 5 5 5
DATABASE BALL -CAPYTAINE DATA/tests/data/hemisphere/hemisphere.nc -SYMMETRIC -HYDROSTATICS YES
JUNCTION J 200 30 -100 -WEIGHT 50
END
&INSTATE -LOCATE BALL 60 0 0 0 0 10
MEDIT
&DESCRIBE BODY BARGE
";

/// A connector of each class that acts on a body by itself; those of hooks and pipes act as the one connector that they are part of.
const CONNECTORS: [(&str, &str); 21] = [
    ("FOUNDATION", "~FO FOUNDATION X 50 Y 50 Z 50\nCONNECTOR FO ~FO *E *G"),
    ("GSPR", "~GS GSPR X 50 Y 20 -LEN 1 -X_DAMPING 20 1 -CONVOLUTION Y SOFT\nCONNECTOR GS ~GS *E *G"),
    ("LMU", "~LM LMU 60 24 48 X 50 Y 50\nCONNECTOR LM ~LM *E *G"),
    ("SLING", "~SL SLING 4 -LEN 30 -EMOD 120000"),
    ("DAVIT", "~DA DAVIT 40 -LEN 30"),
    ("ROLLER", "~RO ROLLER COMPRESSION Y 100 Z 100 -Z_ROLLER 0 10"),
    ("ROD", "~RD ROD 300 20 -LEN 250 -REFINE 10\nCONNECTOR RD -ANC 80 180 ~RD *F"),
    ("B_CAT", "~BC B_CAT -TYPE CHAIN_R4 84 -LEN 700\nCONNECTOR BC -ANC 180 660 ~BC *F"),
    ("H_CAT", "~HC H_CAT -TYPE CHAIN_R4 84 -LEN 70\nCONNECTOR HC ~HC *E *G"),
    ("SL_ELEM", "~SE SL_ELEM 30 -LEN 39\nCONNECTOR SE ~SE *E *G"),
    ("CATENARY", "~CA CATENARY 170 0.02 -LEN 300 -EA 7E5\nCONNECTOR CA -ANC 90 270 ~CA *F"),
    ("FIX", "~FI FIX X Y Z\n*B 60 0 5\n&DESCRIBE BODY BALL\n*EB 0 0 2\nCONNECTOR FI ~FI *EB *G"),
    ("SPR", "~SP SPR X 1000 Z 2000 RY 500\nCONNECTOR SP ~SP *E *G"),
    ("GAP", "~GA GAP 0.3\nCONNECTOR GA ~GA *E *G"),
    ("FENDER", "~FE FENDER 1.5 2E4 0.3 4E4 0.8\nCONNECTOR FE ~FE *E *G"),
    ("TUG_BOAT", "~TU TUG_BOAT 60\nCONNECTOR TU -TUG 30 100 ~TU *E"),
    ("CT_LINE", "~CT CT_LINE 80\nCONNECTOR CT ~CT *E *G"),
    ("NLIN", "~NL NLIN 5 -POLY 2E4 1E3\nCONNECTOR NL ~NL *E *G"),
    ("LNDW", "~LW LNDW 2E4 5 4 -0.1 8E4\nCONNECTOR LW ~LW *E *G"),
    ("PULY", "~PU PULY 2E4 12 8\nCONNECTOR PU ~PU *E *G"),
    ("TETHER", "~TE TETHER 1.1 0.035 -LEN 94\nCONNECTOR TE ~TE *F *GT"),
];

fn model(records: &str) -> Model {
    let records = records.replace("DATA/", concat!(env!("CARGO_MANIFEST_DIR"), "/"));
    model_as_written(&format!(
        "&DIMEN -DIMEN METERS K-NTS
{records}
"
    ))
}

/// A column of a table.
fn column(table: &Table, group: &str, name: &str) -> Vec<f64> {
    let found = table.columns().iter().find(|c| c.group == group && c.name == name).unwrap();
    found.cells.iter().map(|cell| if let Cell::Number(value) = cell { *value } else { f64::NAN }).collect()
}

const COMPONENTS: [&str; 6] = ["FX", "FY", "FZ", "MX", "MY", "MZ"];

/// What the categories of the run of a model leave on a body, over its weight, moments over that and its radius of gyration, of which a step
/// leaves 1e-7; and the categories.
fn residual_of_categories(model: &Model, actions: Vec<Action>, body: usize) -> ([f64; 2], Vec<&'static str>) {
    let mut made = Run::new(model, settings(2.0, 0.1), actions).unwrap();
    made.run(&mut SilentWatcher).unwrap();
    let events = results::events(&made.history, None).unwrap();
    let table = results::body_forces(&made, &[body], Magnitude::default(), &events).unwrap();
    let groups: Vec<&str> = made.history.layout.categories.iter().map(|c| c.name()).collect();
    let mass = Mass::from_parts(model.parts_of(&model.bodies[body]), model.defaults.gravity);
    let weight = mass.mass * model.defaults.gravity;
    let radius = (mass.inertia.diagonal().max() / mass.mass).sqrt().max(1.0);
    let mut shares = [0.0f64; 2];
    for (n, names) in COMPONENTS.chunks(3).enumerate() {
        let each: Vec<f64> = groups.iter().flat_map(|g| names.iter().flat_map(|c| column(&table, g, c))).collect();
        let largest = each.iter().fold(0.0f64, |a, b| a.max(b.abs()));
        for name in names {
            for (i, total) in column(&table, "TOTAL", name).into_iter().enumerate() {
                let sum: f64 = groups.iter().map(|g| column(&table, g, name)[i]).sum();
                assert!((sum - total).abs() <= 1e-12 * largest, "{name} {i}: {sum} {total}");
                shares[n] = shares[n].max(total.abs() / (weight * if n == 0 { 1.0 } else { radius }));
            }
        }
    }
    (shares, groups)
}

#[test]
fn tube_across_current_has_drag_category_and_zero_total() {
    // 1/2 1025 kg/m3 Cd 1, D 1 m, 10 m, (1 m/s)^2 = 5.125 kN; held by nothing it goes with the water
    let model = model(
        "&DEFAULT -WATER 1025\n&ENV -CURRENT 1 180 -DEPTH 100 -TIME 1 0.1\nMEDIT\n&DESCRIBE BODY B -IGNORE Z RX RY RZ\n*A 0 -5 -20\n*E 0 5 -20\n\
         *G 0 0 -20\n#WEIGHT *G 1000 5 5 5\nEND\n&SURFACE\nTUBE T *A *E 1000 -CD 1",
    );
    let mut made = Run::new(&model, settings(1.0, 0.1), vec![]).unwrap();
    made.run(&mut SilentWatcher).unwrap();
    let events = results::events(&made.history, None).unwrap();
    let table = results::body_forces(&made, &[0], Magnitude::default(), &events).unwrap();
    assert!((column(&table, "V_DRAG", "FX")[0].abs() / 5125.0 - 1.0).abs() < 1e-12);
    // a step leaves 1e-7 g of 1000 kN, the start rounding
    let total = column(&table, "TOTAL", "FX");
    assert!(total[0].abs() < 1e-9 && total.iter().all(|f| f.abs() < 0.1), "{total:?}");
}

#[test]
fn all_load_categories_add_up_to_inertia_in_run() {
    let made = model(&format!("{LOADS}END\n&ENV STORM"));
    for body in 0..3 {
        let (shares, groups) = residual_of_categories(&made, vec![], body);
        for group in ["WIND", "V_DRAG", "WAVE", "R_DRAG", "W_DRIFT", "BOTTOM", "BUOYANCY", "A_INERTIA"] {
            assert!(groups.contains(&group), "{group} of {groups:?}");
        }
        assert!(shares.iter().all(|s| *s < 2e-7), "{body}: {shares:?}");
    }
}

#[test]
fn categories_of_an_action_have_columns_from_the_start() {
    let made = model(&format!("{LOADS}END\n&ENV CALM"));
    let storm = Action { name: "S".into(), when: Trigger::At(1.0), what: ActionKind::Environment("STORM".into()) };
    let (shares, groups) = residual_of_categories(&made, vec![storm], 0);
    assert!(["WIND", "V_DRAG", "WAVE", "W_DRIFT"].iter().all(|g| groups.contains(g)), "{groups:?}");
    assert!(shares.iter().all(|s| *s < 2e-7), "{shares:?}");
}

#[test]
fn categories_of_every_class_add_up_in_run_and_statics() {
    assert!(CLASSES.iter().all(|c| CONNECTORS.iter().any(|(name, _)| c.spec.name == *name)), "a class has no case");
    for (class, records) in CONNECTORS {
        let made = model(&format!("{LOADS}{records}\nEND\n&ENV STORM"));
        let (shares, groups) = residual_of_categories(&made, vec![], usize::from(class == "FIX"));
        assert!(shares.iter().all(|s| *s < 2e-7), "{class}: {shares:?}");
        let acts = made.connectors.len();
        assert_eq!(usize::from(groups.contains(&"FLEX_CONNECTORS")), acts, "{class}");
        let system = System::new(&made, &[]).unwrap();
        let mut state = system.state(&made);
        system.evaluate(&mut state).unwrap();
        let table = tables::by_category(&system, &state, &|_| true).unwrap();
        for (n, name) in COMPONENTS.into_iter().enumerate() {
            let group = if n < 3 { "Force" } else { "Moment" };
            let values = column(&table, group, name);
            let rows = table.columns()[0].cells.iter().zip(&table.columns()[1].cells).zip(values);
            let rows: Vec<(String, String, f64)> =
                rows.map(|((body, what), v)| (format!("{body:?}"), format!("{what:?}"), v)).collect();
            for (body, node) in system.nodes.iter().enumerate() {
                let mine = rows.iter().filter(|(name, ..)| name.contains(&node.name));
                let (total, parts): (Vec<_>, Vec<_>) = mine.partition(|(_, what, _)| what.contains("TOTAL"));
                let (sum, largest) = parts.iter().fold((0.0, 1.0f64), |(s, l), (.., v)| (s + v, l.max(v.abs())));
                let want = state.residual[6 * body + n];
                // values below 1e-10 of the largest force on arms of metres are printed as zero
                let near = |v: f64| (v - want).abs() <= 1e-8 * largest.max(state.residual.amax());
                assert!(near(sum) && near(total[0].2), "{class} {} {name}: {sum} {want}", node.name);
            }
        }
    }
}
