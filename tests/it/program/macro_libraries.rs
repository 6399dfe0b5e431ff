//! Libraries of macros: those that ship with windlass, and those that are not there.

use crate::common::{self, assert_share};
use windlass_base::diagnostic::Severity;
use windlass_base::pose::{Pose, Six};
use windlass_hydro::{Category, Floating};
use windlass_model::Model;

/// What a script prints, its messages with how serious they are, and its model.
fn run(script: &str) -> (String, Vec<(Severity, String)>, Model) {
    let (mut session, screen, _folder) = common::session();
    session.open("script", script.to_string());
    session.run();
    session.job.output.flush();
    let said = session.reports.iter().map(|r| (r.severity, format!("{} {}", r.message, r.help.join(" "))));
    (screen.text(), said.collect(), session.job.model.clone())
}

fn load(model: &Model, category: Category) -> Six {
    let floating = Floating::at_rest(model, &model.bodies["RIG"]).unwrap();
    let own = floating.loads.iter().filter(|load| load.category() == category);
    own.map(|load| load.mean_load(&Pose::default()).unwrap().wrench).sum()
}

/// A rig whose deck house is made by the macro, in metres, in a wind of 40 knots from a direction.
fn rig(call: &str, direction: i32) -> Model {
    let (text, said, model) = run(&format!(
        "&DIMEN -DIMEN METERS M-TONS\n&DEFAULT -G 9.80665 -AIR 1.25\nINMODEL\nUSE_MAC V_MODEL\n&DESCRIBE BODY RIG\n*N1 0 0 0\n&DESCRIBE COMPARTMENT T\n\
         PGEN\nPLANE -2 2 -RECT -3 -1 4\nEND\n{call}\nEND\n&ENV -WIND 40 {direction} -W_PROFILE POWER 0\n"
    ));
    assert!(said.iter().all(|(severity, _)| *severity != Severity::Error), "{said:?} {text}");
    model
}

#[test]
fn wind_box_has_force_of_its_faces_at_its_middle() {
    // 1/2 rho V^2 of 40 knots on 4 x 3 m ahead and 5 x 3 m abeam, 1.5 m above the bottom of the box
    let pressure = 0.5 * 1.25 * (40.0 * 1852.0 / 3600.0_f64).powi(2);
    let call = "W_BOX HOUSE 10 2 6 5 4 3 -SHAPE 1.1";
    let ahead = load(&rig(call, 180), Category::Wind);
    assert_share(ahead[0], 1.1 * pressure * 12.0, 1e-9);
    assert_share(ahead[4], 1.1 * pressure * 12.0 * 7.5, 1e-9);
    assert_share(ahead[5], -1.1 * pressure * 12.0 * 2.0, 1e-9);
    let abeam = load(&rig(call, 90), Category::Wind);
    assert_share(abeam[1], -1.1 * pressure * 15.0, 1e-9);
    assert_share(abeam[5], -1.1 * pressure * 15.0 * 10.0, 1e-9);
    // a coefficient of one where none is given
    assert_share(load(&rig("W_BOX HOUSE 10 2 6 5 4 3", 180), Category::Wind)[0], pressure * 12.0, 1e-9);
}

#[test]
fn wind_box_has_weight_at_its_middle_and_no_faces_by_option() {
    let model = rig("W_BOX HOUSE 10 2 6 5 4 3 -NO_TBOT -WEIGHT 50 *N1 *N1 *N1", 180);
    let weight = load(&model, Category::Weight);
    let force = 50_000.0 * 9.80665;
    assert_share(weight[2], -force, 1e-9);
    assert_share(weight[3], -force * 2.0, 1e-9);
    assert_share(weight[4], force * 10.0, 1e-9);
    let (_, house) = model.piece("HOUSE").unwrap();
    assert_eq!((house.cs_wind, house.permeability), ([1.0, 1.0, 0.0], 0.0));
    assert!(house.compartment.is_none());
    // radii of gyration of a box that is the same all through: (4^2 + 3^2)/12 about its length
    let mass = windlass_hydro::Floating::at_rest(&model, &model.bodies["RIG"]).unwrap().mass;
    let radii = mass.radii().map(|k| k.unwrap());
    for (found, sum) in radii.into_iter().zip([25.0, 34.0, 41.0_f64]) {
        assert_share(found, (sum / 12.0).sqrt(), 1e-9);
    }
}

#[test]
fn absent_library_gives_one_message_and_its_macros_stop_solves() {
    let cart = "MEDIT\n*G 0 0 0\n&DESCRIBE BODY CART -IGNORE Y Z RX RY RZ\n*C 0 0 0\n#WEIGHT *C 100 1 1 1\n~S GSPR BOTH X 40 1000 -LEN 0\nCONNECTOR K ~S *C *G\nEND\n";
    let (_, said, _) = run(&format!("{cart}USE_MAC MYLIB\nMY_MACRO 1 2\nMY_MACRO 3 4\nOTHER\n&EQUI\n"));
    let errors: Vec<_> = said.iter().filter(|(severity, _)| *severity == Severity::Error).collect();
    assert!(errors.len() == 2 && errors[0].1.contains("no macro library MYLIB"), "{said:?}");
    assert!(errors[1].1.contains("MY_MACRO (a macro of MYLIB, which was not found)"), "{said:?}");
    assert_eq!(said.len(), 4, "{said:?}");
    // a library of MOSES alone: its macros say themselves what is lost
    let (_, said, _) = run(&format!("{cart}USE_MAC AUTO_TKR\nTKR_GEN 240 -TURRET 22 0 0\n&EQUI\n"));
    let count = |severity: Severity| said.iter().filter(|(own, _)| *own == severity).count();
    assert_eq!((count(Severity::Note), count(Severity::Warning), count(Severity::Error)), (1, 1, 1), "{said:?}");
}

#[test]
fn library_beside_script_comes_before_shipped_one() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("v_model.mac"), "&MACRO W_BOX A\n&TYPE mine %A\n&ENDMACRO\n").unwrap();
    std::fs::write(folder.path().join("m.cif"), "USE_MAC V_MODEL\nW_BOX 7\n").unwrap();
    let done = std::process::Command::new(env!("CARGO_BIN_EXE_windlass"))
        .arg("m.cif")
        .current_dir(folder.path())
        .output()
        .unwrap();
    assert!(String::from_utf8(done.stdout).unwrap().contains("mine 7"));
}
