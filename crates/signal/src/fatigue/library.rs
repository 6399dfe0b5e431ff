//! The curves windlass ships: `data/fatigue_curves.toml`, where each curve names its source and how sure it is.

use super::curve::{CurveBranch, SnCurve};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::LazyLock;
use windlass_model::{FatigueKind, FatigueSelection};

/// The library as shipped.
const TEXT: &str = include_str!("../../data/fatigue_curves.toml");

/// Read once; the test below holds that the shipped text can be.
static LIBRARY: LazyLock<FatigueLibrary> = LazyLock::new(|| toml::from_str(TEXT).unwrap_or_default());

/// The shipped library.
pub fn library() -> &'static FatigueLibrary {
    &LIBRARY
}

/// Curves and the sources of their numbers.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FatigueLibrary {
    /// Sources by the key that curves use.
    pub sources: BTreeMap<String, CurveSource>,
    /// The curves, in the order of the file.
    pub curves: Vec<Shipped>,
}

/// Where the numbers of a curve come from.
#[derive(Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CurveSource {
    /// The document.
    pub text: String,
    /// Whether nobody independent was found who quotes the same numbers.
    pub unconfirmed: bool,
    /// Where they were seen or checked.
    pub how: String,
}

/// A curve of the file.
#[derive(Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Shipped {
    /// Its name.
    pub name: String,
    /// Other names of the same.
    #[serde(default)]
    pub aliases: Vec<String>,
    /// `STRESS` or `TENSION`.
    kind: CurveKeyword,
    /// What it is for, in a line.
    pub what: String,
    /// Branches from the largest ranges down.
    branches: Vec<ShippedBranch>,
    /// Range below which there is no damage.
    #[serde(default)]
    limit: f64,
    /// Change of log10 a with mean tension over breaking tension.
    #[serde(default)]
    mean_slope: f64,
    /// Cross-sections of the nominal diameter that bear the tension.
    #[serde(default = "unit_factor")]
    legs: f64,
    /// Exponent of thickness its source gives, over 25 mm unless the source says else; reported, not applied.
    #[serde(default)]
    pub thickness_exponent: f64,
    /// Key of its source.
    pub source: String,
}

fn unit_factor() -> f64 {
    1.0
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
enum CurveKeyword {
    Stress,
    Tension,
}

#[derive(Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct ShippedBranch {
    m: f64,
    log_a: f64,
    /// Cycles up to which it holds; the last branch holds beyond.
    #[serde(default)]
    to: Option<f64>,
}

impl Shipped {
    /// The curve, ready to be asked.
    pub fn curve(&self) -> SnCurve {
        let branches = self.branches.iter().map(|b| CurveBranch {
            slope: b.m,
            log_a: b.log_a,
            // the range at which the branch itself comes to its last number of cycles
            from: b.to.map_or(0.0, |n| 10f64.powf((b.log_a - n.log10()) / b.m)),
        });
        SnCurve {
            name: self.name.clone(),
            kind: match self.kind {
                CurveKeyword::Stress => FatigueKind::Stress,
                CurveKeyword::Tension => FatigueKind::Tension,
            },
            branches: branches.collect(),
            limit: self.limit,
            mean_slope: self.mean_slope,
            legs: self.legs,
            unconfirmed: library().sources.get(&self.source).is_none_or(|s| s.unconfirmed),
        }
    }

    /// Whether a name, in capitals or not, is this curve's.
    pub fn is_called(&self, name: &str) -> bool {
        std::iter::once(&self.name).chain(&self.aliases).any(|own| own.eq_ignore_ascii_case(name))
    }
}

/// The curve of a name: a user's own goes before one of the library. `None` when nothing is called so.
pub fn find(name: &str, selection: &FatigueSelection) -> Option<SnCurve> {
    let own = selection.curves.values().find(|c| c.name.eq_ignore_ascii_case(name));
    match own {
        Some(given) => SnCurve::from_points(given).ok(),
        None => library().curves.iter().find(|c| c.is_called(name)).map(Shipped::curve),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn find_curve(name: &str) -> SnCurve {
        find(name, &FatigueSelection::default()).unwrap()
    }

    #[test]
    fn shipped_curve_library_is_read_and_valid() {
        let read: FatigueLibrary = toml::from_str(TEXT).unwrap();
        assert!(read.curves.len() > 50);
        for shipped in &read.curves {
            assert!(read.sources.contains_key(&shipped.source), "{}", shipped.name);
            let same = read.curves.iter().filter(|c| c.is_called(&shipped.name)).count();
            assert_eq!(same, 1, "{}", shipped.name);
            let curve = shipped.curve();
            assert!(curve.branches.windows(2).all(|w| w[1].from < w[0].from), "{}", shipped.name);
            assert_eq!(curve.branches.last().unwrap().from, 0.0, "{}", shipped.name);
            // branches meet where they part: sources print three decimals of log a
            for pair in curve.branches.windows(2) {
                let at = pair[0].from;
                assert!((pair[0].cycles(at) / pair[1].cycles(at)).log10().abs() < 2.5e-3, "{}", shipped.name);
            }
        }
    }

    #[test]
    fn dnv_curves_match_cycles_of_another_program() {
        // benchmark-sncurve-2014.06.csv of iamlikeme/sncurves , some of its points (thickness against 25 mm): numbers
        // of the standard's rules printed to a tenth of a cycle
        let table = include_str!("../../tests/data/sncurves.csv");
        let mut count = 0;
        for line in table.lines().skip(1) {
            let f: Vec<&str> = line.split(',').collect();
            let position = match (f[1], f[2]) {
                ("FALSE", _) => "AIR",
                (_, "TRUE") => "CP",
                _ => "FREE",
            };
            let number = |i: usize| f[i].parse::<f64>().unwrap();
            let name = format!("DNV_{}_{position}", f[0]);
            let shipped = library().curves.iter().find(|c| c.is_called(&name)).unwrap();
            let factor = (number(3).max(25.0) / 25.0).powf(shipped.thickness_exponent);
            let found = shipped.curve().cycles(number(4) * factor, 0.0).unwrap();
            assert!((found - number(5)).abs() < 0.06 + 1e-9 * number(5), "{line}: {found}");
            count += 1;
        }
        assert_eq!(count, 26);
    }

    #[test]
    fn tension_curves_match_reference() {
        // [API-RP-2SK]: N R^M = K
        assert!((find_curve("CHAIN").cycles(0.1, 0.3).unwrap() - 1e6).abs() < 1e-3);
        assert_eq!(find_curve("API_CHAIN"), find_curve("chain"));
        assert!((find_curve("API_STUDLESS").cycles(0.1, 0.0).unwrap() / 316e3 - 1.0).abs() < 1e-12);
        let wire = 10f64.powf(3.20 - 2.79 * 0.3) / 0.1f64.powf(4.09);
        assert!((find_curve("WIRE").cycles(0.1, 0.3).unwrap() / wire - 1.0).abs() < 1e-12);
        let spiral = 10f64.powf(3.25 - 3.43 * 0.3) / 0.1f64.powf(5.05);
        assert!((find_curve("API_SPIRAL").cycles(0.1, 0.3).unwrap() / spiral - 1.0).abs() < 1e-12);
        // [DNV-OS-E301]: studless chain 6.0e10 S^-3
        let studless = find_curve("DNV_STUDLESS");
        assert!((studless.cycles(100.0, 0.0).unwrap() / 6.0e4 - 1.0).abs() < 1e-3 && studless.legs == 2.0);
        assert!(find("NOTHING", &FatigueSelection::default()).is_none());
    }

    #[test]
    fn endurance_limit_gives_no_damage_below() {
        let x = find_curve("API_X");
        assert!(x.damage(34.0, 0.0) == 0.0 && x.damage(36.0, 0.0) > 0.0 && x.unconfirmed);
    }
}
