//! The section of a line's segment: what its diameter, material and load options amount to.
//!
//! Source: seed 001 (B_CAT) and reference/model.md: AE and break use the full area pi/4 OD^2; the submerged weight per
//! length is WTPLEN - DISPLEN - rho_w g pi/4 BUOYDIA^2.

use super::checks;
use crate::language::diagnostic::Outcome;
use crate::language::units::Dim;
use crate::model::{ClassRecord, Surroundings};
use crate::table::{Cell, Digits, Table};
use std::f64::consts::FRAC_PI_4;

/// Density against which a specific gravity is given: fresh water (kg/m3).
const FRESH_WATER: f64 = 1000.0;

/// A segment of line, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineSection {
    /// Outside diameter (m).
    pub od: f64,
    /// Wall thickness (m); `None` for a solid section.
    pub thickness: Option<f64>,
    /// Unstretched length (m).
    pub length: f64,
    /// Axial stiffness (N).
    pub ea: f64,
    /// Weight per length in air (N/m).
    pub weight: f64,
    /// Displacement per length given by -DISPLEN (N/m).
    pub displacement: f64,
    /// Diameter for buoyancy (m).
    pub buoyancy_diameter: f64,
    /// Breaking tension (N).
    pub breaking: f64,
    /// Weight of the clump at the end (N); negative: capacity of a spring buoy.
    pub clump: f64,
    /// Pendant of the spring buoy (m).
    pub pendant: f64,
    /// Elements.
    pub refine: i64,
}

impl LineSection {
    /// From a record whose first datum is OD (and second T for a tube).
    ///
    /// # Errors
    /// A record without `-LEN`, a wall thicker than the radius, P-Y curves or pistons that contradict themselves.
    pub fn read(record: &ClassRecord, kind: &str, tube: bool) -> Outcome<LineSection> {
        let args = &record.args;
        let material = &record.defaults.material;
        let od = args.number(0).unwrap_or(0.0);
        let thickness = if tube { args.number(1) } else { None };
        if let Some(t) = thickness
            && 2.0 * t > od
        {
            return Err(crate::language::diagnostic::Diagnostic::error(
                "the wall thickness T is larger than half of OD",
                args.place(1),
            ));
        }
        let length = checks::length(args, kind)?;
        checks::py_curves(args)?;
        checks::piston(args)?;
        let area = FRAC_PI_4 * (od * od - thickness.map_or(0.0, |t| (od - 2.0 * t).powi(2)));
        let number = |name: &str| args.option_number(name);
        let density = number("-DENSITY").or(number("-SPGRAVITY").map(|s| s * FRESH_WATER)).unwrap_or(material.density);
        let emodulus = number("-EMODULUS").unwrap_or(material.emodulus);
        let ultimate = number("-TENSTR").or(number("-FYIELD").map(|y| y / 0.6)).unwrap_or(material.ultimate());
        let clump = args.option("-CLUMP");
        Ok(LineSection {
            od,
            thickness,
            length,
            ea: emodulus * area,
            weight: number("-WTPLEN").unwrap_or(density * record.defaults.gravity * area),
            displacement: number("-DISPLEN").unwrap_or(0.0),
            buoyancy_diameter: number("-BUOYDIAMETER").unwrap_or(od),
            breaking: number("-B_TENSION").unwrap_or(ultimate * area),
            clump: clump.and_then(|c| c.number(0)).unwrap_or(0.0),
            pendant: clump.and_then(|c| c.number(1)).unwrap_or(0.0),
            refine: args.option("-REFINE").and_then(|g| g.values.first()).and_then(|v| v.integer()).unwrap_or(1),
        })
    }

    /// Weight per unstretched length in water (N/m).
    pub fn submerged(&self, surroundings: &Surroundings) -> f64 {
        let buoyancy = surroundings.water_weight() * FRAC_PI_4 * self.buoyancy_diameter * self.buoyancy_diameter;
        self.weight - self.displacement - buoyancy
    }

    /// Weight per unstretched length in air (N/m).
    pub fn in_air(&self) -> f64 {
        self.weight
    }
}

/// The `&STATUS CLASS` table of a line: one row a segment.
pub fn properties(name: &str, kind: &str, sections: &[LineSection], surroundings: &Surroundings) -> Table {
    let mut table = Table::new(format!("Class {name}"))
        .fact("Type", kind, Dim::None)
        .column("", "Segment", Dim::None, Digits::Usual)
        .column("", "OD", Dim::Section, Digits::Usual)
        .column("", "Length", Dim::Length, Digits::Usual)
        .column("Weight / Length", "Air", Dim::ForcePerLength, Digits::Usual)
        .column("Weight / Length", "Water", Dim::ForcePerLength, Digits::Usual)
        .column("", "AE", Dim::Force, Digits::Scientific(5))
        .column("", "Break", Dim::Force, Digits::Usual)
        .column("", "Elements", Dim::None, Digits::Usual)
        .column("End of Segment", "Clump", Dim::Force, Digits::Usual)
        .column("End of Segment", "Pendant", Dim::Length, Digits::Usual);
    for (index, s) in sections.iter().enumerate() {
        let pendant = if s.clump < 0.0 { Cell::Number(s.pendant) } else { Cell::Missing };
        let row = vec![
            (index + 1).into(),
            s.od.into(),
            s.length.into(),
            s.in_air().into(),
            s.submerged(surroundings).into(),
            s.ea.into(),
            s.breaking.into(),
            Cell::Integer(s.refine),
            s.clump.into(),
            pendant,
        ];
        // the row has one cell a column, made just above
        let _ = table.push(row);
    }
    table
}
