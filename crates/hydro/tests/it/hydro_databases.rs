//! Files of hydrodynamic databases: the same body through every format, dimensionless values, and bad files.

use nalgebra::{Complex, Matrix6};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};
use windlass_hydro::database::rao::{self, RaoConvention};
use windlass_hydro::database::wamit::{self, WamitScale};
use windlass_hydro::database::{Database, SourceFile, aqwa, capytaine, nemoh};
use windlass_hydro::database::{DatabaseLookup, mirror_headings};

const FOLDER: &str = "../../tests/data/hemisphere/";

fn bytes(name: &str) -> Vec<u8> {
    std::fs::read(format!("{FOLDER}{name}")).unwrap()
}

fn file(name: &str) -> SourceFile {
    SourceFile { name: name.into(), text: String::from_utf8(bytes(name)).unwrap() }
}

fn text(name: &str, text: &str) -> SourceFile {
    SourceFile { name: name.into(), text: text.into() }
}

fn scale(length: f64) -> WamitScale {
    WamitScale { length, density: 1025.0, gravity: 9.80665, depth: None, body: None, origin: None }
}

fn whole() -> Database {
    capytaine::read("hemisphere.nc", &bytes("hemisphere.nc"), None).unwrap()
}

fn of_wamit() -> Database {
    wamit::read("wamit", &[file("wamit.1"), file("wamit.3"), file("wamit.hst")], &scale(1.0)).unwrap()
}

fn nemoh_files() -> Vec<SourceFile> {
    let names = [
        "Nemoh.cal",
        "results/RadiationCoefficients.tec",
        "results/ExcitationForce.tec",
        "mesh/KH.dat",
        "mesh/Hydrostatics.dat",
    ];
    names.iter().map(|n| file(&format!("nemoh/{n}"))).collect()
}

/// Sees that a part agrees with the whole at its own frequencies and headings, to a share of the largest value.
fn agrees(part: &Database, all: &Database, share: f64) {
    let near = |a: &Matrix6<f64>, b: &Matrix6<f64>| {
        let scale = |i: usize, j: usize| (b[(i, i)].abs() * b[(j, j)].abs()).sqrt().max(1e-6 * b.amax());
        // Capytaine writes the indices of its .1 the other way round: what its own matrix lacks of symmetry is let pass
        let own = |i: usize, j: usize| 1.001 * (b[(i, j)] - b[(j, i)]).abs() + share * scale(i, j);
        (0..6).all(|i| (0..6).all(|j| (a[(i, j)] - b[(i, j)]).abs() <= own(i, j)))
    };
    for (index, w) in part.frequencies.iter().enumerate() {
        assert!(near(&part.added_mass[index], &all.added_mass_at(*w).unwrap()), "added mass at {w}");
        let (own, other) = (part.damping[index], all.damping_at(*w).unwrap());
        let off = (own - other).amax() - (other - other.transpose()).amax();
        assert!(off <= share * all.damping.iter().map(|b| b.amax()).fold(0.0, f64::max), "damping at {w}");
        for (n, heading) in part.headings.iter().enumerate() {
            let other = all.excitation_at(*heading, *w).unwrap();
            for (a, b) in part.excitation[n][index].iter().zip(other) {
                assert!((a - b).norm() <= share * other[2].norm().max(1e6), "{a} {b} at {w} {heading}");
            }
        }
    }
}

#[test]
fn every_database_format_gives_same_hemisphere() {
    let all = whole();
    assert_eq!((all.frequencies.len(), all.headings.len(), all.remarks.len()), (97, 8, 0));
    let classic = capytaine::read("classic.nc", &bytes("classic.nc"), None).unwrap();
    // the same numbers; the frequencies of a file of doubles are exact
    agrees(&classic, &all, 1e-12);
    assert_eq!((classic.zero, classic.infinite, classic.mass), (all.zero, all.infinite, all.mass));
    // seven digits of values and of the periods they are at
    agrees(&of_wamit(), &all, 2e-5);
    assert!(
        (of_wamit().hydrostatics.unwrap() - all.hydrostatics.unwrap()).amax() < 1e-6 * all.hydrostatics.unwrap().amax()
    );
    let nemoh = nemoh::read("nemoh", &nemoh_files(), None).unwrap();
    agrees(&nemoh, &all, 2e-6);
    assert!((nemoh.mass.unwrap() / all.mass.unwrap() - 1.0).abs() < 1e-6);
    // headings 0 to 180 only, and nothing else to say
    assert!(matches!(nemoh.remarks.as_slice(), [one] if one.contains("gap of 180 degrees")), "{:?}", nemoh.remarks);
}

#[test]
fn aqwa_text_database_in_tonnes_gives_same_hemisphere() {
    let (all, data) = (whole(), aqwa::read("aqwa", &file("hemisphere.AH1"), None).unwrap());
    assert_eq!((data.frequencies.len(), data.headings.len(), data.depth), (25, 8, Some(1000.0)));
    // seven digits of values and frequencies, 5E-4 degrees of phases
    agrees(&data, &all, 3e-5);
    let (own, other) = (data.hydrostatics.unwrap(), all.hydrostatics.unwrap());
    assert!((own - other).amax() < 1e-6 * other.amax());
    assert!((data.mass.unwrap() / (1025.0 * 2.0 / 3.0 * PI * 1000.0) - 1.0).abs() < 1e-6);
    assert!((data.density - 1025.0).abs() < 1e-9 && data.remarks.is_empty(), "{:?}", data.remarks);
}

/// Two structures, two directions, two frequencies; `general` is the row of GENERAL.
fn two_structures(general: &str) -> String {
    let matrix = |head: String, first: f64| {
        let row =
            |i: usize| (0..6).map(|j| format!(" {}", if i == j { first + i as f64 } else { 0.0 })).collect::<String>();
        (0..6).map(|i| format!("{}{}\n", if i == 0 { head.as_str() } else { "" }, row(i))).collect::<String>()
    };
    let pairs = [(1, 1), (1, 2), (2, 1), (2, 2)];
    let radiation = |base: f64| -> String {
        let at =
            |(a, b): (usize, usize), w: usize| matrix(format!(" {a} {b} {w}"), base + (100 * a + 10 * b + w) as f64);
        pairs.iter().flat_map(|pair| [at(*pair, 1), at(*pair, 2)]).collect()
    };
    let mut force = String::new();
    for body in 1..=2 {
        for direction in 1..=2 {
            for w in 1..=2 {
                force.push_str(&format!(
                    " {body} {direction} {w} {} 2 3 4 5 6\n 90 0 0 -90 0 0\n",
                    100 * body + 10 * direction + w
                ));
            }
        }
    }
    format!(
        "* made by hand\n 2 2 2 180.0 0.0\n 1.0 0.5\n GENERAL\n {general}\n COG\n 1 10 0 -2\n 2 -30 0 -4\n MASS\n{}{} HYDSTIFFNESS\n{}{} \
         ADDEDMASS\n{} DAMPING\n{} FORCERAO\n{force}",
        matrix(" 1".into(), 5.0),
        matrix(" 2".into(), 7.0),
        matrix(" 1".into(), 50.0),
        matrix(" 2".into(), 70.0),
        radiation(1000.0),
        radiation(2000.0),
    )
}

#[test]
fn aqwa_text_database_has_lags_order_and_units_of_its_file() {
    let text_of = |general: &str| text("two.AH1", &two_structures(general));
    let read = |general: &str, body: Option<usize>| aqwa::read("two", &text_of(general), body);
    let data = read("200 1025 9.81 0", Some(1)).unwrap();
    assert_eq!((data.frequencies.as_slice(), data.headings.as_slice()), (&[0.5, 1.0][..], &[0.0, PI][..]));
    assert_eq!((data.reference.x, data.reference.z, data.depth, data.mass), (10.0, -2.0, Some(200.0), Some(5.0)));
    // frequencies grow here, so that the second of the file is the first; its own matrix 1 1
    assert_eq!((data.added_mass[0][(0, 0)], data.added_mass[1][(5, 5)]), (1112.0, 1116.0));
    assert_eq!((data.damping[0][(1, 1)], data.hydrostatics.unwrap()[(2, 2)]), (2113.0, 52.0));
    // direction 2 of the file is 0 degrees; a lag of 90 degrees is i, -90 is -i
    let force = data.excitation[0][1];
    assert!(
        (force[0] - Complex::new(0.0, 121.0)).norm() < 1e-12 && (force[3] - Complex::new(0.0, -4.0)).norm() < 1e-12
    );
    // tonnes; a leading number as later versions have it; feet and slugs
    let tonnes = read("7 200 1.025 9.81", Some(1)).unwrap();
    assert_eq!((tonnes.added_mass[0][(0, 0)], tonnes.density, tonnes.depth), (1_112_000.0, 1025.0, Some(200.0)));
    let feet = read("200 1.9905 32.2 0", Some(1)).unwrap();
    assert!((feet.added_mass[0][(0, 0)] / (1112.0 * 14.593_903) - 1.0).abs() < 1e-12);
    assert!((feet.added_mass[0][(3, 3)] / (1115.0 * 14.593_903 * 0.3048 * 0.3048) - 1.0).abs() < 1e-12);
    // the second structure: phases refer to the centre of the first, 40 m along the waves
    let second = read("200 1025 9.81 0", Some(2)).unwrap();
    let k = 0.5f64.powi(2) / 9.81;
    let turned = Complex::new(0.0, 222.0) * Complex::from_polar(1.0, 40.0 * k);
    assert!((second.excitation[0][0][0] - turned).norm() < 0.02 * 222.0, "{} {turned}", second.excitation[0][0][0]);
    assert!(second.remarks.iter().any(|r| r.contains("centre of gravity of the first")));
}

#[test]
fn aqwa_text_database_has_limits_of_long_and_short_waves() {
    let limit = |body: usize, value: u32| {
        let rows = (0..6).map(|i| {
            let head = if i == 0 { format!(" {body} {body}") } else { String::new() };
            head + &(0..6).map(|j| format!(" {}", if i == j { value + i } else { 0 })).collect::<String>() + "\n"
        });
        rows.collect::<String>()
    };
    // with a blank for the underscore, too
    for (low, high) in [("ADDEDMASS_LF", "ADDEDMASS_HF"), ("ADDEDMASS LF", "ADDEDMASS HF")] {
        let whole = format!(
            "{} {low}\n{}{} {high}\n{}{}",
            two_structures("200 1.025 9.81 0"),
            limit(1, 3000),
            limit(2, 3200),
            limit(1, 900),
            limit(2, 920)
        );
        let data = aqwa::read("two", &text("two.AH1", &whole), Some(2)).unwrap();
        let [zero, infinite] = [data.zero.unwrap(), data.infinite.unwrap()];
        // tonnes
        assert_eq!((zero[(0, 0)], zero[(5, 5)]), (3_200_000.0, 3_205_000.0));
        assert_eq!((infinite[(0, 0)], infinite[(5, 5)]), (920_000.0, 925_000.0));
    }
}

#[test]
fn damping_of_drift_frequencies_in_aqwa_text_database_is_refused() {
    let with = |row: &str| format!("{} FIDD\n 1 0 0 0 0 0 0\n{row}", two_structures("200 1025 9.81 0"));
    let read = |row: &str, body| aqwa::read("two", &text("two.AH1", &with(row)), Some(body));
    assert!(read(" 2 0 0 0 0 0 0\n", 2).is_ok());
    // that of the other structure is none of its own
    assert!(read(" 2 1E5 0 0 0 0 0\n", 1).is_ok());
    let error = read(" 2 1E5 0 0 0 0 0\n", 2).unwrap_err().to_string();
    assert!(error.contains("FIDD") && error.contains("#DAMP"), "{error}");
}

#[test]
fn wrong_aqwa_text_database_reports_missing_part() {
    let good = two_structures("200 1025 9.81 0");
    let refused = |file: &str, body: Option<usize>, wanted: &str| {
        let error = aqwa::read("two", &text("two.AH1", file), body).unwrap_err().to_string();
        assert!(error.contains(wanted), "{error}");
    };
    refused(&good, None, "it has 2 structures: -INDEX, or CSTR of a deck, says which one to take");
    refused(&good, Some(3), "there is no structure 3: it has 2");
    refused("", None, "it is no file .AH1");
    refused("1 1 1 0 1\n", None, "no section GENERAL");
    refused(&good.replace("200 1025 9.81 0", "200 1.5 9.81 0"), Some(1), "belong to no set of units");
    refused(
        &good.replace(" 2 2 2 180.0 0.0", " 2 2 3 180.0 0.0"),
        Some(1),
        "3 frequencies are announced, and 4 numbers follow",
    );
    refused(&good.replace(" 1 1 2 1112", " 1 1 3 1112"), Some(1), "ADDEDMASS lacks the matrix 1 1 2");
    refused(
        &good.replace(" 1 2 2 122 2", " 1 2 3 122 2"),
        Some(1),
        "FORCERAO lacks structure 1, direction 2, frequency 2",
    );
    refused(&good.replace(" COG\n", " CG\n"), Some(1), "it has no section COG");
    refused(&good.replace("1112", "nan"), Some(1), "a row of finite numbers is expected");
}

#[test]
fn swapped_frequency_limits_are_corrected() {
    // a version of Capytaine marked infinite frequency by -1 and zero frequency by 0; the manual of WAMIT has it the other way round
    let all = whole();
    let straight = of_wamit();
    assert!((straight.zero.unwrap()[(2, 2)] / all.zero.unwrap()[(2, 2)] - 1.0).abs() < 1e-6);
    assert!((straight.infinite.unwrap()[(2, 2)] / all.infinite.unwrap()[(2, 2)] - 1.0).abs() < 1e-6);
    assert_eq!(straight.remarks, Vec::<String>::new());
    let odd = file("wamit.1")
        .text
        .replace("-1.000000e+00", "none")
        .replace("0.000000e+00\t    ", "-1.0 ")
        .replace("none", "0.0");
    let data = wamit::read("odd", &[text("odd.1", &odd)], &scale(1.0)).unwrap();
    assert_eq!((data.zero, data.infinite), (straight.zero, straight.infinite));
    assert!(data.remarks.iter().any(|r| r.contains("exchanged")), "{:?}", data.remarks);
    let manual = "0.0 3 3 0.5\n-1.0 3 3 0.83\n8.0 3 3 0.7 0.2\n6.0 3 3 0.6 0.25\n4.0 3 3 0.52 0.01\n";
    let data = wamit::read("m", &[text("m.1", manual)], &scale(1.0)).unwrap();
    assert_eq!((data.infinite.unwrap()[(2, 2)], data.zero.unwrap()[(2, 2)]), (0.5 * 1025.0, 0.83 * 1025.0));
}

#[test]
fn wamit_values_are_dimensional_as_in_its_manual() {
    let one = "WAMIT Numeric Output\n 0.62831853E+01 1 1 2.0 3.0\n6.2831853 1 5 2.0 3.0\n6.2831853 5 1 2.0 3.0\n6.2831853 5 5 2.0 3.0\n";
    let three = "6.2831853 180 1 5 0 3.0 4.0\n6.2831853 180 5 5 0 3.0 4.0\n";
    let four = "6.2831853 180 1 1 0 0.6 0.8\n6.2831853 180 4 1 0 0.6 0.8\n";
    let nine = "6.2831853 180 180 1 2 180 -2.0 0.0\n6.2831853 180 180 6 3 0 3.0 0.0\n6.2831853 90 180 1 9 0 9.0 0.0\n";
    let hst = "3 3 2.0\n4 4 2.0\n3 5 2.0\n";
    let files = [text("a.1", one), text("a.3", three), text("a.4", four), text("a.9", nine), text("a.hst", hst)];
    let data =
        wamit::read("a", &files, &WamitScale { length: 10.0, density: 1000.0, gravity: 10.0, ..scale(1.0) }).unwrap();
    // w = 1: A = A' rho L^k, B = B' rho L^k w
    let close = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-7, "{a} {b}");
    close(data.added_mass[0][(0, 0)], 2e6);
    close(data.added_mass[0][(0, 4)], 2e7);
    close(data.damping[0][(4, 4)], 3e8);
    // rho g L^2, rho g L^3; conjugated
    assert_eq!(data.excitation[0][0][0], Complex::new(3e6, -4e6));
    assert_eq!(data.excitation[0][0][4], Complex::new(3e7, -4e7));
    assert_eq!(data.motions.unwrap()[0][0][0], Complex::new(0.6, -0.8));
    let drift = data.drift.unwrap();
    assert_eq!(drift.values[0][0], [-2e5, 0.0, 0.0, 0.0, 0.0, 3e6]);
    let c = data.hydrostatics.unwrap();
    assert_eq!((c[(2, 2)], c[(3, 3)], c[(2, 4)]), (2e6, 2e8, 2e7));
    assert_eq!(data.headings, vec![PI]);
    assert!(data.remarks.iter().any(|r| r.contains("1 rows of crossing waves")), "{:?}", data.remarks);
}

#[test]
fn wamit_qtf_is_hermitian_from_either_half() {
    let rows =
        "6 6 0 0 1 1 0 1.0 0\n6 8 0 0 1 1 0 0.5 0.25\n8 8 0 0 1 1 0 2.0 0\n10 10 0 0 1 1 0 3.0 0\n6 8 0 45 1 1 0 9 9\n";
    let mut remarks = Vec::new();
    let one = "6 1 1 1 1\n";
    let data = wamit::read("q", &[text("q.12d", rows), text("q.1", one)], &scale(1.0)).unwrap();
    remarks.extend(data.remarks.clone());
    let qtf = data.qtf.unwrap();
    let weight = 1025.0 * 9.80665;
    // frequencies grow: 10 s, 8 s, 6 s; WAMIT's exp(+i w t) is conjugated
    assert!((qtf.values[0][2][1][0] - Complex::new(0.5, -0.25) * weight).norm() < 1e-9);
    assert!((qtf.values[0][1][2][0] - Complex::new(0.5, 0.25) * weight).norm() < 1e-9);
    assert_eq!(qtf.values[0][0][1][0], Complex::new(0.0, 0.0));
    assert!(remarks.iter().any(|r| r.contains("4 of 9 pairs")), "{remarks:?}");
    let error = wamit::read("q", &[text("q.12d", "6 8 0 0 1 1 0 1 0\n"), text("q.1", one)], &scale(1.0)).unwrap_err();
    assert!(error.to_string().contains("with itself"), "{error}");
}

#[test]
fn other_side_of_symmetric_body_is_mirrored() {
    let all = whole();
    let half = Database {
        headings: all.headings[..5].to_vec(),
        excitation: all.excitation[..5].to_vec(),
        remarks: Vec::new(),
        ..all.clone()
    };
    assert!(half.excitation_at(-1.0, 1.0).is_err());
    let made = mirror_headings(half);
    assert_eq!(made.headings.len(), 8);
    for (own, other) in made.excitation.iter().flatten().zip(all.excitation.iter().flatten()) {
        for (a, b) in own.iter().zip(other) {
            // the panels are symmetric to rounding
            assert!((a - b).norm() < 1e-6 * other[2].norm().max(1e4), "{a} {b}");
        }
    }
}

fn convention(lag: bool, degrees: bool) -> RaoConvention {
    RaoConvention { lag, degrees, density: 1025.0, gravity: 9.80665, depth: None }
}

#[test]
fn rao_motions_are_read_with_their_conventions() {
    let named = "Displacement RAOs of a ship\nWP, WD, ZA, ZP, RYA, RYP\n10, 0, 0.5, 30, 2, -90\n8, 0, 0.4, 40, 1, -80\n10, 90, 0.6, 0, 0, 0\n8, 90, 0.7, 0, 0, 0\n";
    let data = rao::read("r", &text("r.csv", named), &convention(true, true)).unwrap();
    let heave = data.motion_at(0.0, TAU / 10.0).unwrap()[2];
    assert!((heave - Complex::from_polar(0.5, 30f64.to_radians())).norm() < 1e-12);
    let pitch = data.motion_at(0.0, TAU / 10.0).unwrap()[4];
    assert!((pitch - Complex::from_polar(2f64.to_radians(), -PI / 2.0)).norm() < 1e-12);
    let led = rao::read("r", &text("r.csv", named), &convention(false, false)).unwrap();
    assert!((led.motion_at(0.0, TAU / 10.0).unwrap()[4] - Complex::from_polar(2.0, PI / 2.0)).norm() < 1e-12);
    let plain = "0 10 1 0 0 0 0.5 30 0 0 2 -90 0 0\n";
    let data = rao::read("r", &text("r.txt", plain), &convention(true, true)).unwrap();
    assert!((data.motion_at(0.0, TAU / 10.0).unwrap()[4] - pitch).norm() < 1e-12);
}

#[test]
fn incomplete_file_reports_missing_part() {
    let refused = |files: &[SourceFile], wanted: &str| {
        let error = wamit::read("w", files, &scale(1.0)).unwrap_err().to_string();
        assert!(error.contains(wanted), "{error}");
    };
    let good = "8 3 3 1 1\n8 5 5 1 1\n6 3 3 1 1\n6 5 5 1 1\n";
    refused(&[text("w.1", "8 3 3 1 1\n8 5 5 1 1\n6 3 3 1 1\n")], "it has no row for modes 5 5 at 1.04720 rad/s");
    refused(&[text("w.1", "8 3 3 1 1\n8 3 3 2 1\n")], "two unlike rows for modes 3 3");
    refused(&[text("w.1", "8 3 3 nan 1\n")], "w.1, line 1: `nan` is no finite number");
    refused(&[text("w.1", "8 3 3 1e999 1\n")], "no finite number");
    refused(&[text("w.1", "8 3 9 1 1\n")], "is of a second body");
    refused(&[text("w.1", "8 3 0 1 1\n")], "not a valid number of a mode");
    refused(&[text("w.1", "8 3\n")], "2 numbers stand here, 4 are expected");
    refused(&[text("w.1", "")], "no rows of numbers");
    refused(&[text("w.1", good), text("w.3", "8 0 3 1 0 1 0\n")], "lacks the frequency (rad/s) 1.04720");
    let lone = "8 0 3 1 0 1 0\n6 0 3 1 0 1 0\n8 90 3 1 0 1 0\n";
    refused(&[text("w.1", good), text("w.3", lone)], "no row for mode 3, heading 90.00 degrees, 1.04720 rad/s");
    refused(&[], "neither added mass");
    let body = WamitScale { body: Some(2), ..scale(1.0) };
    let error = wamit::read("w", &[text("w.1", good)], &body).unwrap_err().to_string();
    assert!(error.contains("no frequency of this body"), "{error}");
    for (lacking, wanted) in [(0, "there is no Nemoh.cal"), (1, "")] {
        let mut files = nemoh_files();
        files.remove(lacking);
        let read = nemoh::read("n", &files, None);
        assert!(lacking > 0 || read.unwrap_err().to_string().contains(wanted));
    }
    let error = nemoh::read("n", &nemoh_files(), Some(2)).unwrap_err().to_string();
    assert!(error.contains("there is no body 2"), "{error}");
}

#[test]
fn phases_of_a_body_of_wamit_are_those_at_the_global_origin() {
    // heave of the second body in waves of 8 s along x and along y: with XBODY 4, 20 it is ahead of its own phase by k times that
    let files = [
        text("w.1", "8 9 9 1 1\n5 9 9 1 1\n"),
        text("w.3", "8 0 9 1 0 1 0\n8 90 9 1 0 1 0\n5 0 9 1 0 1 0\n5 90 9 1 0 1 0\n"),
    ];
    let read = |origin| wamit::read("w", &files, &WamitScale { body: Some(2), origin, ..scale(1.0) }).unwrap();
    let data = read(Some([4.0, 20.0]));
    let at = data.frequencies.iter().position(|w| (w * 8.0 / TAU - 1.0).abs() < 1e-6).unwrap();
    let number = (TAU / 8.0).powi(2) / 9.80665;
    for (heading, along) in [(0, 4.0), (1, 20.0)] {
        let phase = data.excitation[heading][at][2].arg();
        assert!((phase + number * along).abs() < 1e-9, "{heading}: {phase}");
    }
    let is_named = |data: &Database| data.remarks.iter().any(|remark| remark.contains("-XBODY"));
    assert!(!is_named(&data), "{:?}", data.remarks);
    let data = read(None);
    assert!(data.excitation[1][at][2].arg().abs() < 1e-12 && is_named(&data), "{:?}", data.remarks);
}

#[test]
fn corrupt_number_of_each_format_is_refused_with_its_place() {
    // NetCDF 3 holds its doubles as they are, the largest byte first
    let sound = bytes("classic.nc");
    let data = capytaine::read("classic.nc", &sound, None).unwrap();
    let (frequency, heave) = (data.frequencies[2], data.added_mass[2][(2, 2)]);
    let at = sound.windows(8).position(|w| w == heave.to_be_bytes()).unwrap();
    for value in [f64::NAN, f64::INFINITY, 1e300, 1e155, -1.1e36] {
        let mut damaged = sound.clone();
        damaged[at..at + 8].copy_from_slice(&value.to_be_bytes());
        let error = capytaine::read("classic.nc", &damaged, None).unwrap_err().to_string();
        assert!(
            error.contains(&format!("added mass Z-Z at {frequency:.4} rad/s is not finite, or larger than 1E36")),
            "{error}"
        );
    }
    for word in ["NaN", "1E300", "1E155", "-1.1E36", "1E999"] {
        let damaged = |name: &str, line: usize, column: usize| {
            let text = file(name).text;
            let changed = text.lines().enumerate().map(|(i, l)| {
                let mut words: Vec<&str> = l.split_whitespace().collect();
                if i + 1 == line {
                    words[column] = word;
                }
                words.join(" ")
            });
            SourceFile { name: name.into(), text: changed.collect::<Vec<_>>().join("\n") }
        };
        let error = wamit::read("wamit", &[damaged("wamit.1", 87, 3)], &scale(1.0)).unwrap_err().to_string();
        assert!(error.starts_with(&format!("wamit.1, line 87: `{word}` is ")), "{error}");
        let error =
            wamit::read("wamit", &[file("wamit.1"), damaged("wamit.3", 20, 5)], &scale(1.0)).unwrap_err().to_string();
        assert!(error.starts_with(&format!("wamit.3, line 20: `{word}` is ")), "{error}");
        for (index, line, column) in [(1, 12, 1), (2, 12, 1), (3, 3, 2)] {
            let mut files = nemoh_files();
            files[index] = damaged(&files[index].name, line, column);
            let error = nemoh::read("nemoh", &files, None).unwrap_err().to_string();
            assert!(error.contains(&format!("line {line}: ")), "{index} {word}: {error}");
        }
    }
}

#[test]
fn implausible_database_is_reported() {
    let rows = "8 1 1 1 1\n8 5 5 1 1\n8 1 5 1 0\n8 5 1 0.5 0\n6 1 1 1 -0.5\n6 5 5 1 1\n6 1 5 1 0\n6 5 1 1 0\n";
    let three = "8 0 1 1 0 1 0\n6 0 1 1 0 1 0\n8 120 1 1 0 1 0\n6 120 1 1 0 1 0\n";
    let data = wamit::read("w", &[text("w.1", rows), text("w.3", three)], &scale(1.0)).unwrap();
    for wanted in ["added mass is not symmetric", "damping of X is negative", "a gap of 240 degrees"] {
        assert!(data.remarks.iter().any(|r| r.contains(wanted)), "{wanted}: {:?}", data.remarks);
    }
    // rows in any order, and a row twice over, are no fault
    let mixed = "6 3 3 2 1\n8 3 3 1 1\n6 3 3 2 1\n";
    assert_eq!(wamit::read("w", &[text("w.1", mixed)], &scale(1.0)).unwrap().frequencies.len(), 2);
}

#[test]
fn truncated_hdf5_and_classic_files_are_refused() {
    for name in ["hemisphere.nc", "classic.nc"] {
        let whole = bytes(name);
        for part in [0, 3, 100, 1000, whole.len() / 2] {
            assert!(capytaine::read(name, &whole[..part], None).is_err(), "{name} {part}");
        }
        assert!(capytaine::read(name, &whole, Some(2)).is_err());
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn arbitrary_text_does_not_panic_database_reader(body in "([0-9.eED+\\- ]{0,12}[ \\n,\"=A-Za-z]{0,4}){0,60}", cut in 0usize..4000, junk in "\\PC{0,20}") {
        let _ = aqwa::read("a", &text("a.AH1", &body), None);
        for ending in ["1", "3", "9", "12d", "hst"] {
            let _ = wamit::read("w", &[text(&format!("w.{ending}"), &body)], &scale(1.0));
        }
        let _ = rao::read("r", &text("r.csv", &body), &convention(true, true));
        for index in 0..5 {
            let mut files = nemoh_files();
            let own = &mut files[index].text;
            let at = (0..=cut.min(own.len())).rev().find(|n| own.is_char_boundary(*n)).unwrap();
            own.replace_range(at..(at + 3).min(own.len()), &junk);
            let _ = nemoh::read("n", &files, None);
            files[index].text = body.clone();
            let _ = nemoh::read("n", &files, None);
        }
    }

    #[test]
    fn corrupt_netcdf_bytes_do_not_panic_reader(
        changes in proptest::collection::vec((0.0f64..1.0, any::<u8>()), 1..6), head in any::<bool>(), classic in any::<bool>(),
    ) {
        let mut bytes = bytes(if classic { "classic.nc" } else { "hemisphere.nc" });
        let most = if head { bytes.len().min(6000) } else { bytes.len() };
        for (position, value) in changes {
            let at = (position * most as f64) as usize;
            bytes[at] = value;
        }
        let _ = capytaine::read("c", &bytes, None);
    }
}
