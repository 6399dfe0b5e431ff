//! TETHER: an AQWA tether or riser section as a class. Its numbers are in kg, m, N whatever `&DIMEN` says.
//!
//! Source: [AQWA-CONN 5.8.3.3].

use super::aqwa::{CA, LENGTH, number};
use super::options::aqwa;
use super::{ClassKind, append_all, checks};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::FRAC_PI_4;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::spec::ValueKey;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec};
use windlass_model::Note;
use windlass_model::{
    ClassError, ClassRecord, Connection, Connector, ConnectorClass, ConnectorElement, ConnectorResponse,
    ConnectorSummary, LengthClass, SegmentedClass, Situation, SolverCache, Surroundings, TetherSection,
    TetherSectionsClass, TetherUse,
};

/// The class type TETHER: an AQWA tether/riser section.
pub static TETHER: ClassKind = ClassKind { spec: &TETHER_SPEC, build: append_all::<TetherClass>, idle: &[] };

const REFINE: OptionSpec = aqwa(
    "-REFINE",
    &[ValueSpec::new("N", Kind::Integer, "number of elements").in_range(1.0, 10_000.0)],
    "number of elements",
)
.default("1");
const DENSITY: OptionSpec =
    aqwa("-DENSITY", &[number("RHO", Dim::KilogramsPerCubicMetre, "density").positive()], "density of the material")
        .default("7850");
const EMODULUS: OptionSpec =
    aqwa("-EMODULUS", &[number("E", Dim::Pascals, "Young's modulus").positive()], "Young's modulus")
        .default("&DEFAULT");
const CD: OptionSpec = aqwa(
    "-CD",
    &[number("Cd", Dim::None, "transverse drag coefficient").not_negative()],
    "transverse drag 0.5 rho Cd V2 OD",
)
.default("0.75");
const LABEL: OptionSpec = OptionSpec::new(
    "-LABEL",
    &[
        ValueSpec::new("N1", Kind::Integer, "the node nearer to the anchor"),
        ValueSpec::new("N2", Kind::Integer, "the node nearer to the vessel"),
        ValueSpec::new("MATE", Kind::Integer, "its material group"),
        ValueSpec::new("GEOM", Kind::Integer, "its geometry group"),
    ],
    "what the tables call its nodes and groups; of a section of one element",
)
.owner(Owner::Ours)
.default("numbers from 1 at the anchor");

/// The values of `-LABEL`.
const LABELS: [ValueKey<i64>; 4] =
    [LABEL.integer("N1"), LABEL.integer("N2"), LABEL.integer("MATE"), LABEL.integer("GEOM")];

static TETHER_SPEC: CommandSpec = CommandSpec {
    owner: Owner::Aqwa,
    data: &[
        number("OD", Dim::Metres, "outer diameter").positive(),
        number("T", Dim::Metres, "wall thickness").positive(),
    ],
    options: &[LENGTH, REFINE, DENSITY, EMODULUS, CA, CD, LABEL],
    detail: "An AQWA tether or riser section, in kg, m and N in every unit system; one record a section.",
    example: "MEDIT\n~LEG TETHER 1.1 0.035 -LEN 250 -REFINE 10\nEND\n&STATUS CLASS ~LEG",
    ..CommandSpec::new("TETHER", "AQWA tether/riser section")
};

#[derive(Debug, Default)]
struct TetherClass(Vec<TetherSection>);

impl ConnectorClass for TetherClass {
    fn kind(&self) -> &'static str {
        "TETHER"
    }

    fn check_ends(&self, connector: &Connector, bodies: usize) -> Outcome<()> {
        checks::ends("TETHER", connector, bodies, 2, 2)
    }

    fn properties(&self, name: &str, surroundings: &Surroundings) -> Table {
        let sections: Vec<(usize, &TetherSection)> = self.0.iter().enumerate().collect();
        Table::new(format!("Class {name}"))
            .fact("Type", "TETHER (AQWA, in kg, m, N)", Dim::None)
            .with_rows(&sections)
            .column("", "Section", Dim::None, Digits::Usual, |(index, _)| index + 1)
            .column("", "OD", Dim::Metres, Digits::Decimals(4), |(_, s)| s.outer_diameter)
            .column("", "T", Dim::Metres, Digits::Decimals(4), |(_, s)| s.wall_thickness)
            .column("", "Length", Dim::Metres, Digits::Usual, |(_, s)| s.length)
            .column("", "Elements", Dim::None, Digits::Usual, |(_, s)| s.elements)
            .column("", "Mass/L", Dim::MassPerLength, Digits::Usual, |(_, s)| s.density * area(s))
            .column("", "Displaced/L", Dim::MassPerLength, Digits::Usual, |(_, s)| {
                surroundings.water_density * outer(s)
            })
            .column("", "EA", Dim::Newtons, Digits::Scientific(5), |(_, s)| s.youngs_modulus * area(s))
            .column("", "EI", Dim::NewtonSquareMetres, Digits::Scientific(5), |(_, s)| {
                s.youngs_modulus * second_moment(s)
            })
            .column("Coefficients", "Ca", Dim::None, Digits::Decimals(3), |(_, s)| s.added_mass)
            .column("Coefficients", "Cd", Dim::None, Digits::Decimals(3), |(_, s)| s.drag)
            .build()
    }

    fn element(&self, connection: &Connection) -> Result<Box<dyn ConnectorElement>, ClassError> {
        Ok(Box::new(Bar::new(&self.0, connection)))
    }

    fn as_segmented(&self) -> Option<&dyn SegmentedClass> {
        Some(self)
    }

    fn as_segmented_mut(&mut self) -> Option<&mut dyn SegmentedClass> {
        Some(self)
    }

    fn as_length(&self) -> Option<&dyn LengthClass> {
        Some(self)
    }

    fn as_tether(&self) -> Option<&dyn TetherSectionsClass> {
        Some(self)
    }
}

impl LengthClass for TetherClass {
    fn first_length(&self) -> Option<f64> {
        self.0.first().map(|s| s.length)
    }
}

impl TetherSectionsClass for TetherClass {
    fn sections(&self) -> &[TetherSection] {
        &self.0
    }
}

impl SegmentedClass for TetherClass {
    fn append(&mut self, record: &ClassRecord) -> Outcome<()> {
        let args = &record.args;
        let [od, thickness] = args.numbers_or_zero(const { TETHER_SPEC.numbers(["OD", "T"]) });
        if 2.0 * thickness > od {
            return Err(Diagnostic::error(
                "the wall thickness T is larger than half of OD",
                args.position(const { TETHER_SPEC.number("T") }),
            ));
        }
        let material = &record.defaults.material;
        let elements = args.option_integer(&REFINE);
        self.0.push(TetherSection {
            outer_diameter: od,
            wall_thickness: thickness,
            length: checks::length(args, "TETHER")?,
            elements: elements.and_then(|n| usize::try_from(n).ok()).unwrap_or(1),
            density: args.option_number(&DENSITY).unwrap_or(material.density),
            youngs_modulus: args.option_number(&EMODULUS).unwrap_or(material.emodulus),
            added_mass: args.option_number(&CA).unwrap_or(1.0),
            drag: args.option_number(&CD).unwrap_or(0.75),
            label: args.option(&LABEL).map(|given| LABELS.map(|key| given.integer(key).unwrap_or(0))),
        });
        Ok(())
    }
}

/// Area within the outer diameter (m2).
fn outer(s: &TetherSection) -> f64 {
    FRAC_PI_4 * s.outer_diameter * s.outer_diameter
}

fn inner(s: &TetherSection) -> f64 {
    FRAC_PI_4 * (s.outer_diameter - 2.0 * s.wall_thickness).powi(2)
}

fn area(s: &TetherSection) -> f64 {
    outer(s) - inner(s)
}

fn second_moment(s: &TetherSection) -> f64 {
    FRAC_PI_4 / 16.0 * (s.outer_diameter.powi(4) - (s.outer_diameter - 2.0 * s.wall_thickness).powi(4))
}

/// An installed tether as a bar between its ends, without bending and without dynamics of its own: what &EQUI has, and TDOM without
/// -TETHERS. A towed tether exerts nothing on its vessel.
///
/// The effective tension halfway is `EA/L0 (L - L0) + rho g (h_top + h_bottom)/2 A_e - (p + rho_i g (h_top + h_bottom)/2) A_i`, in which
/// the depths h are below the mean level ([W-INSTALLED 2, 4]; internal fluid by the same balance). Each end
/// bears half of the weight in water. A slack tether keeps the tension with which it hangs from one end.
#[derive(Clone, Debug, PartialEq)]
struct Bar {
    towed: bool,
    count: f64,
    length: f64,
    /// EA of the whole over its length (N/m).
    stiffness: f64,
    /// External and internal area, averaged over the length (m2).
    areas: [f64; 2],
    /// Pressure at sea level (Pa) and density (kg/m3) inside.
    fluid: [f64; 2],
    /// Mass of the walls (kg).
    mass: f64,
}

/// The tension of a bar where it is.
struct BarTension {
    /// Unit vector from the first end to the second.
    toward: Vector3<f64>,
    distance: f64,
    /// Weight in water (N).
    weight: f64,
    /// Effective tension halfway (N).
    tension: f64,
    /// d(tension)/d(place of the ends) (N/m).
    slopes: [Vector3<f64>; 2],
    slack: bool,
}

impl Bar {
    fn new(sections: &[TetherSection], connection: &Connection) -> Self {
        let ends = connection.connector.tether.clone().unwrap_or_default();
        let length: f64 = sections.iter().map(|s| s.length).sum();
        let mean =
            |value: fn(&TetherSection) -> f64| sections.iter().map(|s| value(s) * s.length).sum::<f64>() / length;
        let flexibility: f64 = sections.iter().map(|s| s.length / (s.youngs_modulus * area(s))).sum();
        Bar {
            towed: ends.used == TetherUse::Towed,
            count: ends.count(),
            length,
            stiffness: flexibility.recip(),
            areas: [mean(outer), mean(inner)],
            fluid: ends.fluid,
            mass: sections.iter().map(|s| s.density * area(s) * s.length).sum(),
        }
    }

    fn pull(&self, at: &Situation) -> Result<BarTension, ClassError> {
        let [first, second] = at.ends else { return Err(ClassError::new("a tether has two ends")) };
        let chord = second.pose.origin - first.pose.origin;
        let distance = chord.norm();
        if distance <= 0.0 {
            return Err(ClassError::new("the two ends of the tether are at one place"));
        }
        let toward = chord / distance;
        let water = at.surroundings;
        let depths = [first, second].map(|end| (water.tide - end.pose.origin.z).max(0.0));
        let middle = 0.5 * (depths[0] + depths[1]);
        let [external, internal] = self.areas;
        let [pressure, density] = self.fluid;
        let outside = water.water_weight() * external;
        let inside = density * water.gravity * internal;
        let weight = self.mass * water.gravity + (inside - outside) * self.length;
        let taut = self.stiffness * (distance - self.length) + (outside - inside) * middle - pressure * internal;
        let hanging = 0.5 * (toward.z * weight).abs();
        let up = Vector3::z();
        let slack = taut < hanging;
        let slopes = if slack {
            let turn = (up - toward * toward.z) * (0.5 * (toward.z * weight).signum() * weight / distance);
            [-turn, turn]
        } else {
            let of_depth = |depth: f64| up * (0.5 * (inside - outside) * f64::from(depth > 0.0));
            let along = toward * self.stiffness;
            [of_depth(depths[0]) - along, of_depth(depths[1]) + along]
        };
        Ok(BarTension { toward, distance, weight, tension: taut.max(hanging), slopes, slack })
    }
}

impl ConnectorElement for Bar {
    fn evaluate(
        &self,
        at: &Situation,
        _: &[f64],
        _: &mut [f64],
        _: &mut SolverCache,
        out: &mut ConnectorResponse,
    ) -> Result<(), ClassError> {
        out.clear(2);
        if self.towed {
            return Ok(());
        }
        let found = self.pull(at)?;
        let n = found.toward;
        let across = (Matrix3::identity() - n * n.transpose()) * (found.tension / found.distance);
        let [first, second] = found.slopes.map(|slope| n * slope.transpose());
        let blocks = [across - first, -across - second, first - across, across + second];
        for (out, block) in out.stiffness.iter_mut().zip(blocks) {
            out.fixed_view_mut::<3, 3>(0, 0).copy_from(&(block * self.count));
        }
        for (wrench, sign) in out.wrench.iter_mut().zip([1.0, -1.0]) {
            let force = n * (sign * found.tension) - Vector3::z() * (0.5 * found.weight);
            wrench.fixed_rows_mut::<3>(0).copy_from(&(force * self.count));
        }
        Ok(())
    }

    fn summary(&self, at: &Situation, _: &[f64]) -> Result<ConnectorSummary, ClassError> {
        if self.towed {
            let notes = vec!["a towed tether exerts nothing at rest: TDOM -TETHERS runs it".into()];
            return Ok(ConnectorSummary { solution: "exact", notes, ..ConnectorSummary::default() });
        }
        let found = self.pull(at)?;
        let mut notes = Vec::new();
        if self.count > 1.0 {
            notes.push(format!("the tension is of one of {} tethers", self.count).into());
        }
        if found.slack {
            notes.push(Note::warning("it is slack"));
        }
        let at_fairlead = found.tension - 0.5 * found.toward.z * found.weight;
        Ok(ConnectorSummary { tension: Some(at_fairlead), solution: "exact", notes, ..ConnectorSummary::default() })
    }
}
