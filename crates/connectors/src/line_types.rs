//! The library of line types: what a chain or rope of a nominal diameter weighs, displaces, how stiff and strong it is.
//!
//! Source: `data/line_types.toml`, where each formula names its own source and how sure it is.

use serde::Deserialize;
use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_4;
use std::sync::LazyLock;

/// The library as shipped.
const TEXT: &str = include_str!("../data/line_types.toml");

/// Read once; the test below holds that the shipped text can be.
static LIBRARY: LazyLock<LineTypeLibrary> = LazyLock::new(|| toml::from_str(TEXT).unwrap_or_default());

/// The shipped library.
pub fn library() -> &'static LineTypeLibrary {
    &LIBRARY
}

/// Line types and the sources of their formulas.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LineTypeLibrary {
    /// Sources by the key that formulas use.
    pub sources: BTreeMap<String, FormulaSource>,
    /// The types, in the order of the file.
    pub types: Vec<LineType>,
}

/// Where a formula comes from.
#[derive(Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FormulaSource {
    /// The document, and the formula where it is one of several.
    pub text: String,
    /// How sure its numbers are.
    pub sure: SourceConfidence,
    /// Where they were seen or checked.
    pub how: String,
}

/// How sure a number is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub enum SourceConfidence {
    /// The source itself was read.
    #[serde(rename = "verified")]
    Verified,
    /// Others who quote it were read.
    #[serde(rename = "second hand")]
    SecondHand,
    /// From what the field knows.
    #[serde(rename = "memory")]
    Memory,
}

impl SourceConfidence {
    /// The word in the file.
    pub fn word(self) -> &'static str {
        match self {
            SourceConfidence::Verified => "verified",
            SourceConfidence::SecondHand => "second hand",
            SourceConfidence::Memory => "from memory",
        }
    }
}

/// `d2 d**2 + d3 d**3` with the nominal diameter d in m; the value in kg/m or N.
#[derive(Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DiameterFormula {
    /// Coefficient of d**2.
    pub d2: f64,
    /// Coefficient of d**3.
    #[serde(default)]
    pub d3: f64,
    /// Key of its source.
    pub source: String,
}

impl DiameterFormula {
    /// Its value at a nominal diameter (m).
    pub fn evaluate(&self, diameter: f64) -> f64 {
        diameter * diameter * (self.d2 + self.d3 * diameter)
    }
}

/// A diameter as a share of the nominal one.
#[derive(Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ratio {
    /// Diameter over nominal diameter.
    pub ratio: f64,
    /// Key of its source.
    pub source: String,
}

/// The diameter for drag as a share of the nominal one, with the coefficient published for it.
#[derive(Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Drag {
    /// Diameter over nominal diameter.
    pub ratio: f64,
    /// Drag coefficient across the line on that diameter.
    pub coefficient: f64,
    /// Key of its source.
    pub source: String,
}

/// The nominal diameters formulas are held for.
#[derive(Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DiameterRange {
    /// Least nominal diameter (m).
    pub least: f64,
    /// Largest nominal diameter (m).
    pub most: f64,
    /// Key of its source.
    pub source: String,
}

/// A type of chain or rope.
#[derive(Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LineType {
    /// Its name, e.g. `CHAIN_R4`.
    pub name: String,
    /// What it is, in a line.
    pub what: String,
    /// The nominal diameters (m) the formulas are held for.
    pub diameter: DiameterRange,
    /// Mass per length in air, dry (kg/m).
    pub mass: DiameterFormula,
    /// Diameter of the cylinder of the same displaced volume.
    pub volume: Ratio,
    /// Axial stiffness (N).
    pub ea: DiameterFormula,
    /// Minimum breaking load (N).
    pub breaking: DiameterFormula,
    /// Diameter for drag.
    pub drag: Drag,
}

impl LineType {
    /// True when the formulas are held for a nominal diameter (m).
    pub fn covers(&self, diameter: f64) -> bool {
        // a diameter in inches comes through a conversion: the ends themselves must stay inside
        let slack = 1e-9 * diameter.abs();
        (self.diameter.least - slack..=self.diameter.most + slack).contains(&diameter)
    }

    /// Diameter (m) of the cylinder of the same displaced volume.
    pub fn volume_diameter(&self, diameter: f64) -> f64 {
        self.volume.ratio * diameter
    }

    /// Mass per length (kg/m) less that of the displaced water of a density (kg/m3).
    pub fn submerged_mass(&self, diameter: f64, water: f64) -> f64 {
        self.mass.evaluate(diameter) - water * FRAC_PI_4 * self.volume_diameter(diameter).powi(2)
    }

    /// True when mass, stiffness and strength at a nominal diameter (m) are numbers greater than zero; far outside of
    /// their range the formulas of chain are not.
    pub fn has_values(&self, diameter: f64) -> bool {
        [&self.mass, &self.ea, &self.breaking].map(|f| f.evaluate(diameter)).iter().all(|v| v.is_finite() && *v > 0.0)
    }

    /// Its quantities, each with the key of its source, in the order of the file.
    pub fn sources(&self) -> [(&'static str, &str); 6] {
        [
            ("diameters", &self.diameter.source),
            ("mass", &self.mass.source),
            ("volume", &self.volume.source),
            ("AE", &self.ea.source),
            ("break", &self.breaking.source),
            ("drag", &self.drag.source),
        ]
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    /// Sea water (kg/m3).
    const SEA: f64 = 1025.0;

    fn find_type(name: &str) -> &'static LineType {
        library().types.iter().find(|t| t.name == name).unwrap()
    }

    fn assert_share(name: &str, what: &str, got: f64, want: f64, tolerance: f64) {
        assert!(
            (got / want - 1.0).abs() <= tolerance,
            "{what} of {name}: {got}, catalogue {want}, off {}",
            got / want - 1.0
        );
    }

    #[test]
    fn shipped_library_parses_and_names_every_used_source() {
        let read: Result<LineTypeLibrary, _> = toml::from_str(TEXT);
        let read = read.unwrap();
        assert_eq!(read.types.len(), 18);
        let mut used: Vec<&str> = read.types.iter().flat_map(|t| t.sources().map(|(_, key)| key)).collect();
        used.sort_unstable();
        used.dedup();
        let known: Vec<&str> = read.sources.keys().map(String::as_str).collect();
        assert_eq!(used, known, "a source that is missing, or that nothing uses");
        assert!(read.sources.values().all(|s| !s.text.is_empty() && !s.how.is_empty()));
    }

    #[test]
    fn unknown_library_key_is_refused() {
        let wrong: Result<LineTypeLibrary, _> = toml::from_str(&TEXT.replacen("\nvolume =", "\nvolumme =", 1));
        assert!(wrong.is_err());
    }

    #[test]
    fn every_type_is_valid_over_its_whole_range() {
        for line in &library().types {
            let (least, most) = (line.diameter.least, line.diameter.most);
            assert!(0.0 < least && least < most && most < 0.5, "{}", line.name);
            let mut before = (0.0, 0.0, 0.0);
            for step in 0..=20 {
                let d = least + (most - least) * f64::from(step) / 20.0;
                let now = (line.mass.evaluate(d), line.ea.evaluate(d), line.breaking.evaluate(d));
                assert!(now.0 > before.0 && now.1 > before.1 && now.2 > before.2, "{} does not grow at {d}", line.name);
                before = now;
                // the density of what is inside the volume: from polyethylene to steel
                let density = now.0 / (FRAC_PI_4 * line.volume_diameter(d).powi(2));
                assert!((960.0..8000.0).contains(&density), "{} has a density of {density}", line.name);
                // the strain at which it would break on its EA: steel 0.5 to 3 %, fibre up to that of nylon (118 %)
                let strain = now.2 / now.1;
                assert!((0.005..1.2).contains(&strain), "{} breaks at a strain of {strain}", line.name);
                // the stress at break on the nominal circle, twice the area of which is a link's: below drawn wire
                let stress = now.2 / (FRAC_PI_4 * d * d);
                assert!((1e8..1.8e9).contains(&stress), "{} breaks at {stress} Pa", line.name);
            }
        }
    }

    #[test]
    fn chain_break_matches_makers_table_to_rules() {
        // pilotfits.com/products/offshore-mooring-chain (to [DNV-OS-E302; IACS-W22]): whole kN, rounded up or to nearest
        for (grade, rows) in [
            ("R3", [(0.034, 1065.0), (0.050, 2230.0), (0.070, 4196.0)]),
            ("R3S", [(0.034, 1189.0), (0.050, 2490.0), (0.070, 4686.0)]),
            ("R4", [(0.034, 1308.0), (0.050, 2740.0), (0.064, 4364.0)]),
        ] {
            for link in ["", "_STUD"] {
                for (d, kilonewtons) in rows {
                    let got = find_type(&format!("CHAIN_{grade}{link}")).breaking.evaluate(d) / 1e3;
                    assert!((got - kilonewtons).abs() < 1.0, "{grade} at {d}: {got}, table {kilonewtons}");
                }
            }
        }
        // the 185 mm R3 chain of the IEA 15 MW VolturnUS-S (JMSE 12(1) 33): 22,286 kN, 685 kg/m
        let r3 = find_type("CHAIN_R3");
        assert_share("CHAIN_R3", "break", r3.breaking.evaluate(0.185), 22.286e6, 1e-4);
        assert_share("CHAIN_R3", "mass", r3.mass.evaluate(0.185), 685.0, 0.01);
    }

    #[test]
    fn chain_mass_and_stiffness_match_other_published_formulas() {
        // MoorPy's fits to four makers: 20.0e3 and 21.9e3 d**2 kg/m; 1 % is their difference from OrcaFlex
        assert_share("CHAIN_R4", "mass", find_type("CHAIN_R4").mass.evaluate(0.084), 20.0e3 * 0.084 * 0.084, 0.01);
        assert_share(
            "CHAIN_R4_STUD",
            "mass",
            find_type("CHAIN_R4_STUD").mass.evaluate(0.084),
            21.9e3 * 0.084 * 0.084,
            1e-9,
        );
        // [DNV-OS-E301] (ckunte.net/2015/ea; 5.6e10 for studlink by MoorPy): E on the area of both legs. OrcaFlex is older
        // and, for studlink, 15 % stiffer
        let legs = 2.0 * FRAC_PI_4 * 0.084 * 0.084;
        assert_share(
            "CHAIN_R4",
            "AE",
            find_type("CHAIN_R4").ea.evaluate(0.084),
            (5.45 - 0.0025 * 84.0) * 1e10 * legs,
            0.04,
        );
        assert_share(
            "CHAIN_R3",
            "AE",
            find_type("CHAIN_R3").ea.evaluate(0.084),
            (5.40 - 0.0040 * 84.0) * 1e10 * legs,
            0.08,
        );
        assert_share("CHAIN_R4_STUD", "AE", find_type("CHAIN_R4_STUD").ea.evaluate(0.084), 5.6e10 * legs, 0.15);
        // steel of 7850 kg/m3 in sea water keeps 0.87 of its weight
        for name in ["CHAIN_R4", "CHAIN_R4_STUD"] {
            let line = find_type(name);
            assert_share(
                name,
                "submerged mass",
                line.submerged_mass(0.084, SEA),
                0.87 * line.mass.evaluate(0.084),
                0.005,
            );
        }
    }

    #[test]
    fn wire_matches_published_tables() {
        // API Spec 9A mooring rope, IWRC, galvanized (Standard Handbook of Petroleum and Natural Gas Engineering, Table
        // 4-25): 1 in 1.89 lb/ft 414 kN; 2 in 1590 kN; 3 in 16.6 lb/ft 3400 kN. One formula for ropes of several
        // constructions: 10 %
        let rope = find_type("WIRE_6STRAND");
        assert_share("WIRE_6STRAND", "mass", rope.mass.evaluate(0.0254), 1.89 * 1.48816, 0.1);
        assert_share("WIRE_6STRAND", "mass", rope.mass.evaluate(0.0762), 16.6 * 1.48816, 0.1);
        for (d, newtons) in [(0.0254, 414e3), (0.0508, 1590e3), (0.0762, 3400e3)] {
            assert_share("WIRE_6STRAND", "break", rope.breaking.evaluate(d), newtons, 0.1);
        }
        // 6x19 fibre core, improved plow steel (engineeringtoolbox.com): 1 in 2.50 kg/m 372 kN; 2 in 10.0 kg/m 1420 kN
        let rope = find_type("WIRE_6STRAND_FC");
        for (d, mass, newtons) in [(0.0254, 2.50, 372e3), (0.0508, 10.0, 1420e3)] {
            assert_share("WIRE_6STRAND_FC", "mass", rope.mass.evaluate(d), mass, 0.08);
            assert_share("WIRE_6STRAND_FC", "break", rope.breaking.evaluate(d), newtons, 0.07);
        }
        // spiral strand, sheathed (Vryhof anchor manual, FROM MEMORY): 76 mm 5647 kN, 557 MN, 30.4 kg/m, 23.8 in water
        let rope = find_type("WIRE_SPIRAL");
        assert_share("WIRE_SPIRAL", "break", rope.breaking.evaluate(0.076), 5647e3, 0.05);
        assert_share("WIRE_SPIRAL", "AE", rope.ea.evaluate(0.076), 557e6, 0.02);
        assert_share("WIRE_SPIRAL", "mass", rope.mass.evaluate(0.076), 30.4, 0.02);
        assert_share("WIRE_SPIRAL", "submerged mass", rope.submerged_mass(0.076, SEA), 23.8, 0.02);
    }

    #[test]
    fn fibre_rope_matches_published_tables() {
        // 8-strand polyester, 48 mm: 1.74 kg/m (engineeringtoolbox.com); DIN 83331 36.7 t
        // [OCIMF-MEG2 table 6.5]. Makers exceed the standards: 12 %
        let rope = find_type("POLYESTER");
        assert_share("POLYESTER", "mass", rope.mass.evaluate(0.048), 1.74, 0.06);
        assert_share("POLYESTER", "break", rope.breaking.evaluate(0.048), 36.7 * 9806.65, 0.12);
        // the 290 mm rope of MoorDyn's own polyester test: 52.0 kg/m, 333.9 MN, volume diameter 0.217 m; one rope
        // against a fit to seven makers: 12 %
        let rope = find_type("POLYESTER_MOORING");
        assert_share("POLYESTER_MOORING", "mass", rope.mass.evaluate(0.290), 52.0, 0.12);
        assert_share("POLYESTER_MOORING", "AE", rope.ea.evaluate(0.290), 333.9e6, 0.12);
        assert_share("POLYESTER_MOORING", "volume diameter", rope.volume_diameter(0.290), 0.217, 0.06);
        // nylon, 48 mm: 1.49 kg/m, 376 kN dry (engineeringtoolbox.com); wet nylon keeps 0.85 of it
        let rope = find_type("NYLON");
        assert_share("NYLON", "mass", rope.mass.evaluate(0.048), 1.49, 0.01);
        assert_share("NYLON", "break", rope.breaking.evaluate(0.048), 0.85 * 376e3, 0.01);
        // nylon braid, 48 mm: 50,000 kg (English Braids, Superyacht Dockline)
        assert_share(
            "NYLON_MOORING",
            "break",
            find_type("NYLON_MOORING").breaking.evaluate(0.048),
            50_000.0 * 9.80665,
            0.03,
        );
        // HMPE, 60 mm: MoorPy's earlier formula of its own, 619e6 d**2 N and 38.17e9 d**2 N; 48 mm: 1.29 kg/m, 1503 kN
        // mean strength (Samson AmSteel-Blue 2 in, FROM MEMORY)
        let rope = find_type("HMPE");
        assert_share("HMPE", "break", rope.breaking.evaluate(0.060), 619e6 * 0.0036, 0.01);
        assert_share("HMPE", "AE", rope.ea.evaluate(0.060), 38.17e9 * 0.0036, 0.10);
        assert_share("HMPE", "break", rope.breaking.evaluate(0.048), 1503e3, 0.10);
        assert_share("HMPE", "mass", rope.mass.evaluate(0.048), 1.29, 0.12);
    }

    #[test]
    fn diameter_range_ends_are_inside_in_inches_too() {
        let chain = find_type("CHAIN_R4");
        assert!(chain.covers(0.034) && chain.covers(0.185 / 0.0254 * 0.0254));
        assert!(!chain.covers(0.033) && !chain.covers(0.186));
    }
}
