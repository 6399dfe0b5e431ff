//! TETHER: an AQWA tether or riser section as a class. Its numbers are in kg, m, N whatever `&DIMEN` says.
//!
//! Source: seed 002, 5.8.3.3.

use super::aqwa::{CA, LENGTH, number};
use super::options::aqwa;
use super::{ClassKind, checks};
use crate::language::diagnostic::{Diagnostic, Outcome};
use crate::language::select::Owner;
use crate::language::spec::{CommandSpec, Kind, ValueSpec};
use crate::language::units::Dim;
use crate::model::{ClassRecord, Connector, ConnectorClass, Surroundings};
use crate::table::{Cell, Digits, Table};
use std::f64::consts::FRAC_PI_4;
use std::sync::Arc;

/// The class type TETHER: an AQWA tether/riser section.
pub static TETHER: ClassKind = ClassKind { spec: &TETHER_SPEC, segmented: true, build: build_tether };

static TETHER_SPEC: CommandSpec = CommandSpec {
    owner: Owner::Aqwa,
    data: &[
        number("OD", Dim::Metres, "outer diameter").positive(),
        number("T", Dim::Metres, "wall thickness").positive(),
    ],
    options: &[
        LENGTH,
        aqwa(
            "-REFINE",
            &[ValueSpec::new("N", Kind::Integer, "number of elements").within(1.0, 10_000.0)],
            "number of elements",
        )
        .default("1"),
        aqwa(
            "-DENSITY",
            &[number("RHO", Dim::KilogramsPerCubicMetre, "density").positive()],
            "density of the material",
        )
        .default("7850"),
        aqwa("-EMODULUS", &[number("E", Dim::Pascals, "Young's modulus").positive()], "Young's modulus")
            .default("&DEFAULT"),
        CA,
        aqwa(
            "-CD",
            &[number("Cd", Dim::None, "transverse drag coefficient").not_negative()],
            "transverse drag 0.5 rho Cd V2 OD",
        )
        .default("0.75"),
    ],
    detail: "An AQWA tether or riser section, in kg, m and N in every unit system; one record a section.",
    example: "MEDIT\n~LEG TETHER 1.1 0.035 -LEN 250 -REFINE 10\nEND\n&STATUS CLASS ~LEG",
    ..CommandSpec::new("TETHER", "AQWA tether/riser section")
};

#[derive(Debug)]
struct TetherSection {
    od: f64,
    thickness: f64,
    length: f64,
    elements: i64,
    density: f64,
    emodulus: f64,
    ca: f64,
    cd: f64,
}

#[derive(Debug)]
struct TetherClass(Vec<TetherSection>);

fn build_tether(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    let mut sections = Vec::new();
    for record in records {
        let args = &record.args;
        let (od, thickness) = (args.number(0).unwrap_or(0.0), args.number(1).unwrap_or(0.0));
        if 2.0 * thickness > od {
            return Err(Diagnostic::error("the wall thickness T is larger than half of OD", args.place(1)));
        }
        let material = &record.defaults.material;
        sections.push(TetherSection {
            od,
            thickness,
            length: checks::length(args, "TETHER")?,
            elements: args.option("-REFINE").and_then(|g| g.values.first()).and_then(|v| v.integer()).unwrap_or(1),
            density: args.option_number("-DENSITY").unwrap_or(material.density),
            emodulus: args.option_number("-EMODULUS").unwrap_or(material.emodulus),
            ca: args.option_number("-CA").unwrap_or(1.0),
            cd: args.option_number("-CD").unwrap_or(0.75),
        });
    }
    Ok(Arc::new(TetherClass(sections)))
}

impl ConnectorClass for TetherClass {
    fn kind(&self) -> &'static str {
        "TETHER"
    }

    fn check_ends(&self, connector: &Connector, bodies: usize) -> Outcome<()> {
        checks::ends("TETHER", connector, bodies, 2, 2)
    }

    fn properties(&self, name: &str, surroundings: &Surroundings) -> Table {
        let mut table = Table::new(format!("Class {name}"))
            .fact("Type", "TETHER (AQWA, in kg, m, N)", Dim::None)
            .column("", "Section", Dim::None, Digits::Usual)
            .column("", "OD", Dim::Metres, Digits::Decimals(4))
            .column("", "T", Dim::Metres, Digits::Decimals(4))
            .column("", "Length", Dim::Metres, Digits::Usual)
            .column("", "Elements", Dim::None, Digits::Usual)
            .column("", "Mass/L", Dim::MassPerLength, Digits::Usual)
            .column("", "Displaced/L", Dim::MassPerLength, Digits::Usual)
            .column("", "EA", Dim::Newtons, Digits::Scientific(5))
            .column("", "EI", Dim::NewtonSquareMetres, Digits::Scientific(5))
            .column("Coefficients", "Ca", Dim::None, Digits::Decimals(3))
            .column("Coefficients", "Cd", Dim::None, Digits::Decimals(3));
        for (index, s) in self.0.iter().enumerate() {
            let inner = s.od - 2.0 * s.thickness;
            let area = FRAC_PI_4 * (s.od * s.od - inner * inner);
            let inertia = FRAC_PI_4 / 16.0 * (s.od.powi(4) - inner.powi(4));
            let row: Vec<Cell> = vec![
                (index + 1).into(),
                s.od.into(),
                s.thickness.into(),
                s.length.into(),
                Cell::Integer(s.elements),
                (s.density * area).into(),
                (surroundings.water_density * FRAC_PI_4 * s.od * s.od).into(),
                (s.emodulus * area).into(),
                (s.emodulus * inertia).into(),
                s.ca.into(),
                s.cd.into(),
            ];
            // the row has one cell a column, made just above
            let _ = table.push(row);
        }
        table
    }

    fn first_length(&self) -> Option<f64> {
        self.0.first().map(|s| s.length)
    }
}
