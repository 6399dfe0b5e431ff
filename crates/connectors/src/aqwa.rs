//! CATENARY: an AQWA catenary section with the joint at its end as a class. Its numbers are in kg, m, N whatever
//! `&DIMEN` says.
//!
//! Source: [AQWA-CONN 5.8.3.1 and 5.8.3.2]; defaults of EA, maximum tension and coefficients: [AQWA-REF deck 14].

use super::dynamic_line::{BreakingStrength, DynamicLine, JointMass, LinePart, Seabed, description};
use super::line_properties;
use super::mooring::{Mooring, line_error, no_other_end};
use super::options::aqwa;
use super::per_line::PerLineOptions;
use super::{ClassKind, append_all, checks};
use std::f64::consts::{FRAC_PI_4, PI};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_base::values::{Args, Given};
use windlass_catenary::{Joint, Line, SeabedModel, Segment, StretchLaw};
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec};
use windlass_line_dynamics::{self as rod, TensionLaw};
use windlass_model::{
    AnchoredClass, AttachedMass, ClassError, ClassRecord, Connection, Connector, ConnectorClass, ConnectorElement,
    DynamicLineClass, LengthClass, LineModel, LineProperties, Placement, SegmentedClass, StaticLineClass, StaticSeabed,
    Surroundings,
};

/// The class type CATENARY: an AQWA catenary section with the joint at its end.
pub static CATENARY: ClassKind = ClassKind { spec: &CATENARY_SPEC, build: append_all::<CatenaryClass>, idle: &[] };

/// A number of an AQWA record.
pub const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}

/// `-LEN L` in metres.
pub const LENGTH: OptionSpec =
    aqwa("-LEN", &[number("L", Dim::Metres, "length of the section").positive()], "unstretched length");
/// `-CA Ca`.
pub const CA: OptionSpec =
    aqwa("-CA", &[number("Ca", Dim::None, "added mass coefficient").not_negative()], "added mass rho Ca A")
        .default("1.0");
const JOINT: &[ValueSpec] = &[
    number("MASS", Dim::Mass, "structural mass"),
    number("DISPLACED", Dim::Mass, "mass of water displaced"),
    number("ADDED", Dim::Mass, "added mass, constant").or("0"),
    number("CDA", Dim::SquareMetres, "drag coefficient times area").or("0").not_negative(),
];

const EA: OptionSpec = aqwa("-EA", &[number("EA", Dim::Newtons, "stiffness").positive()], "axial stiffness")
    .default("5.0E6 times mass per length");
const TMAX: OptionSpec = aqwa(
    "-TMAX",
    &[number("TMAX", Dim::Newtons, "maximum expected tension").positive()],
    "highest tension of the database",
)
.default("5.0E4 times mass per length");
const K: OptionSpec = aqwa(
    "-K",
    &[
        number("k1", Dim::Newtons, "coefficient of strain"),
        number("k2", Dim::Newtons, "coefficient of strain squared").or("0"),
        number("k3", Dim::Newtons, "coefficient of strain cubed").or("0"),
    ],
    "axial stiffness coefficients: EA(e) = EA + k1 e + k2 e2 + k3 e3",
);
const EI: OptionSpec = aqwa(
    "-EI",
    &[number("EI", Dim::NewtonSquareMetres, "bending stiffness").not_negative()],
    "bending stiffness (cable dynamics)",
)
.default("0");
const CD: OptionSpec = aqwa(
    "-CD",
    &[number("Cd", Dim::None, "transverse drag coefficient").not_negative()],
    "transverse drag 0.5 rho Cd V2 De",
)
.default("1.0");
const DE: OptionSpec =
    aqwa("-DE", &[number("De", Dim::Metres, "equivalent diameter for drag").positive()], "diameter for drag")
        .default("that of AREA");
const CX: OptionSpec = aqwa(
    "-CX",
    &[number("Cx", Dim::None, "longitudinal drag coefficient").not_negative()],
    "inline drag 0.5 rho Cx V2 De",
)
.default("0.025");
const BUOY: OptionSpec = aqwa("-BUOY", JOINT, "buoy at the end of the section: structural mass smaller than displaced");
const CLUMP: OptionSpec =
    aqwa("-CLUMP", JOINT, "clump weight at the end of the section: structural mass larger than displaced");
const DEPANCHOR: OptionSpec =
    aqwa("-DEPANCHOR", &[number("DEPTH", Dim::Metres, "depth of the anchor").positive()], "depth at the anchor")
        .default("depth of &ENV");
const SLOPE: OptionSpec = aqwa(
    "-SLOPE",
    &[number("SLOP", Dim::None, "vertical / horizontal distance").in_range(-10.0, 10.0)],
    "slope of the bottom, positive where it rises from the anchor toward the fairlead",
)
.default("0");

static CATENARY_SPEC: CommandSpec = CommandSpec {
    owner: Owner::Aqwa,
    data: &[
        number("MASS", Dim::MassPerLength, "mass per unit length").positive(),
        number("AREA", Dim::SquareMetres, "equivalent cross-sectional area").or("0").not_negative(),
    ],
    options: &[LENGTH, EA, TMAX, K, EI, CA, CD, DE, CX, BUOY, CLUMP, DEPANCHOR, SLOPE],
    detail: "An AQWA catenary section, in kg, m and N in every unit system; one record a section, fairlead first. Buoys \
             always have the same buoyancy and do not know where the surface is; those of a line that &CONNECTOR -DYNAMICS makes dynamic \
             lose it as they come out of the water.",
    example: "MEDIT\n~CHAIN CATENARY 170 0.0217 -LEN 600 -EA 7.0E8 -CLUMP 20000 2500\n~CHAIN CATENARY 170 0.0217 -LEN 300\nEND\n\
              &STATUS CLASS ~CHAIN",
    ..CommandSpec::new("CATENARY", "AQWA catenary section with its joint")
};

#[derive(Debug)]
struct CatenarySection {
    mass: f64,
    area: f64,
    length: f64,
    ea: f64,
    largest: f64,
    largest_is_given: bool,
    /// k1, k2, k3, where given.
    coefficients: Option<[f64; 3]>,
    span: Span,
    ca: f64,
    cd: f64,
    diameter: f64,
    cx: f64,
    ei: f64,
    joint: Option<(&'static str, f64)>,
    /// Structural mass, mass of water displaced, added mass (kg), drag coefficient times area (m2).
    joint_mass: Option<[f64; 4]>,
    joint_span: Span,
}

/// Options of the whole line.
const PER_LINE: [OptionSpec; 2] = [DEPANCHOR, SLOPE];

#[derive(Debug, Default)]
struct CatenaryClass {
    per_line: PerLineOptions,
    sections: Vec<CatenarySection>,
    depth: Option<f64>,
    /// Slope of the bottom, positive where it rises from the anchor toward the fairlead.
    slope: f64,
}

impl CatenarySection {
    /// How it stretches: along the polynomial of -K up to the strain at the maximum tension and straight on; without -K
    /// no tension beyond the maximum [AQWA-CONN 5.8.3.1].
    fn law(&self) -> Option<StretchLaw> {
        let Some(k) = self.coefficients else { return Some(StretchLaw::Capped { ea: self.ea, most: self.largest }) };
        let most = StretchLaw::Polynomial { ea: self.ea, k, most: f64::INFINITY }.stretch(self.largest).0;
        Some(StretchLaw::Polynomial { ea: self.ea, k, most })
    }
}

fn joint(args: &Args) -> Outcome<(Option<(&'static str, f64)>, Span)> {
    let net = |given: &Given| {
        let [mass, displaced] = given.numbers_or_zero(const { BUOY.numbers(["MASS", "DISPLACED"]) });
        mass - displaced
    };
    let (buoy, clump) = (args.option(&BUOY), args.option(&CLUMP));
    match (buoy, clump) {
        (Some(buoy), Some(clump)) => {
            Err(Diagnostic::error("a joint is either a buoy or a clump weight", clump.span)
                .other(buoy.span, "the buoy"))
        }
        (Some(given), None) if net(given) >= 0.0 => Err(Diagnostic::error(
            "the structural mass of a buoy must be smaller than the mass it displaces",
            given.span,
        )),
        (None, Some(given)) if net(given) <= 0.0 => Err(Diagnostic::error(
            "the structural mass of a clump weight must be larger than the mass it displaces",
            given.span,
        )),
        (Some(given), None) => Ok((Some(("buoy", net(given))), given.span)),
        (None, Some(given)) => Ok((Some(("clump", net(given))), given.span)),
        (None, None) => Ok((None, args.span)),
    }
}

impl ConnectorClass for CatenaryClass {
    fn kind(&self) -> &'static str {
        "CATENARY"
    }

    fn check(&self) -> Outcome<()> {
        match self.sections.last().filter(|s| s.joint.is_some()) {
            Some(last) => {
                Err(Diagnostic::error("a joint lies between two sections; the last section has none", last.joint_span))
            }
            None => Ok(()),
        }
    }

    fn check_ends(&self, connector: &Connector, bodies: usize) -> Outcome<()> {
        checks::ends("CATENARY", connector, bodies, 2, 2)
    }

    fn properties(&self, name: &str, surroundings: &Surroundings) -> Table {
        let sections: Vec<(usize, &CatenarySection)> = self.sections.iter().enumerate().collect();
        Table::new(format!("Class {name}"))
            .fact("Type", "CATENARY (AQWA, in kg, m, N)", Dim::None)
            .with_rows(&sections)
            .column("", "Section", Dim::None, Digits::Usual, |(index, _)| index + 1)
            .column("", "Length", Dim::Metres, Digits::Usual, |(_, s)| s.length)
            .column("", "Mass/L", Dim::MassPerLength, Digits::Usual, |(_, s)| s.mass)
            .column("", "Area", Dim::SquareMetres, Digits::Usual, |(_, s)| s.area)
            .column("", "W/L in Water", Dim::None, Digits::Decimals(2), |(_, s)| {
                (s.mass - surroundings.water_density * s.area) * surroundings.gravity
            })
            .column("", "EA", Dim::Newtons, Digits::Scientific(5), |(_, s)| s.ea)
            .column("", "Max. Tension", Dim::Newtons, Digits::Scientific(5), |(_, s)| s.largest)
            .column("", "EI", Dim::NewtonSquareMetres, Digits::Scientific(4), |(_, s)| s.ei)
            .column("Coefficients", "Ca", Dim::None, Digits::Decimals(3), |(_, s)| s.ca)
            .column("Coefficients", "Cd", Dim::None, Digits::Decimals(3), |(_, s)| s.cd)
            .column("Coefficients", "Cx", Dim::None, Digits::Decimals(3), |(_, s)| s.cx)
            .column("", "De", Dim::Metres, Digits::Decimals(4), |(_, s)| s.diameter)
            .column("Joint", "Type", Dim::None, Digits::Usual, |(_, s)| s.joint.map(|j| j.0))
            .column("Joint", "Net Weight", Dim::Newtons, Digits::Usual, |(_, s)| {
                s.joint.map(|j| j.1 * surroundings.gravity)
            })
            .build()
    }

    fn element(&self, connection: &Connection) -> Result<Box<dyn ConnectorElement>, ClassError> {
        self.line(&connection.placement, connection.surroundings)?.element()
    }

    fn as_line(&self) -> Option<&dyn StaticLineClass> {
        Some(self)
    }

    fn as_dynamic_line(&self) -> Option<&dyn DynamicLineClass> {
        Some(self)
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

    fn as_anchored(&self) -> Option<&dyn AnchoredClass> {
        Some(self)
    }
}

impl LengthClass for CatenaryClass {
    fn first_length(&self) -> Option<f64> {
        self.sections.first().map(|s| s.length)
    }
}

impl AnchoredClass for CatenaryClass {
    fn anchor_depth(&self, surroundings: &Surroundings) -> Option<f64> {
        self.depth.or(surroundings.depth)
    }
}

impl SegmentedClass for CatenaryClass {
    fn append(&mut self, record: &ClassRecord) -> Outcome<()> {
        let args = &record.args;
        let (joint, joint_span) = joint(args)?;
        let [mass, area] = args.numbers_or_zero(const { CATENARY_SPEC.numbers(["MASS", "AREA"]) });
        let option = |option: &OptionSpec, default: f64| args.option_number(option).unwrap_or(default);
        let section = CatenarySection {
            mass,
            area,
            length: checks::length(args, "CATENARY")?,
            ea: option(&EA, 5.0e6 * mass),
            largest: option(&TMAX, 5.0e4 * mass),
            largest_is_given: args.has(&TMAX),
            coefficients: args.option(&K).map(|given| given.numbers_or_zero(const { K.numbers(["k1", "k2", "k3"]) })),
            span: args.span,
            ca: option(&CA, 1.0),
            cd: option(&CD, 1.0),
            diameter: option(&DE, (area / FRAC_PI_4).sqrt()),
            cx: option(&CX, 0.025),
            ei: option(&EI, 0.0),
            joint,
            joint_mass: args
                .option(&BUOY)
                .or(args.option(&CLUMP))
                .map(|given| given.numbers_or_zero(const { BUOY.numbers(["MASS", "DISPLACED", "ADDED", "CDA"]) })),
            joint_span,
        };
        self.per_line.check(args, &PER_LINE)?;
        self.sections.push(section);
        if self.per_line.take(args, &PER_LINE) {
            self.depth = self.per_line.number(&DEPANCHOR);
            self.slope = self.per_line.number(&SLOPE).unwrap_or(0.0);
        }
        Ok(())
    }

    fn line_properties(&self, around: &Surroundings, _: bool) -> Result<LineProperties, ClassError> {
        let slope = Some(self.slope);
        let seabed = line_properties::seabed(&Seabed { depth: self.depth, slope, ..Seabed::default() })?;
        let made = |section: &CatenarySection| {
            let mut made =
                line_properties::segment(&section.part(1, around.water_density), None, around.water_density)?;
            // a joint given by its net weight or lift alone
            if let (Some((_, net)), None) = (section.joint, section.joint_mass) {
                let (mass, volume) = if net > 0.0 { (net, 0.0) } else { (0.0, -net / around.water_density) };
                made.attached = Some(AttachedMass { mass, volume, ..AttachedMass::default() });
            }
            Ok(made)
        };
        let segments = self.sections.iter().map(made).collect::<Result<_, ClassError>>()?;
        Ok(LineProperties { segments, seabed: Some(seabed) })
    }
}

impl StaticLineClass for CatenaryClass {
    fn line(&self, position: &Placement, surroundings: &Surroundings) -> Result<Box<dyn LineModel>, ClassError> {
        let [_, _, far] = position.other.ok_or_else(no_other_end)?;
        let count = self.sections.len();
        let length = |i: usize, s: &CatenarySection| position.first_length.filter(|_| i == 0).unwrap_or(s.length);
        let segments = self.sections.iter().enumerate().map(|(i, s)| Segment {
            length: length(i, s),
            weight: (s.mass - surroundings.water_density * s.area) * surroundings.gravity,
            ea: s.ea,
        });
        // a buoy never knows the surface [AQWA-CONN 5.8.3.2]: a weight less than nothing
        let joint =
            |s: &CatenarySection| s.joint.map_or(Joint::Free, |(_, net)| Joint::Weight(net * surroundings.gravity));
        let joints = self.sections.iter().take(count.saturating_sub(1)).map(joint);
        let positions: Vec<Span> = self.sections.iter().map(|s| s.span).collect();
        // ends on a structure see no bottom, an anchor lies on it
        let floor = position.anchored.then_some(SeabedModel { elevation: far, slope: self.slope, friction: 0.0 });
        let line = Line::new(segments.collect(), joints.collect(), far, surroundings.tide)
            .and_then(|l| l.with_seabed(floor))
            .and_then(|l| l.with_laws(self.sections.iter().map(CatenarySection::law).collect()))
            .map_err(|e| line_error(&e, &positions))?;
        // the table ends where the first section would pass its maximum: at a tension, not at a horizontal force
        let [_, _, fairlead] = position.fairlead;
        let least = self.sections.iter().map(|s| s.largest).fold(f64::INFINITY, f64::min);
        let largest = line.at_tension(least, fairlead).map_or(least, |s| s.force);
        Ok(Box::new(Mooring {
            line,
            breaks: self.sections.iter().map(|s| s.largest).collect(),
            breaks_given: self.sections.iter().map(|s| s.largest_is_given).collect(),
            largest,
            tabulated: false,
            profile: None,
            position: position.clone(),
            surface: surroundings.tide,
            bottom: surroundings.depth.map(|d| -d),
            positions,
            notes: vec![
                "breaks are the maximum expected tensions of -TMAX; beyond them the tension is held (with -K: \
                         continues straight)"
                    .into(),
            ],
        }))
    }

    fn seabed(&self) -> StaticSeabed {
        StaticSeabed::Plane
    }
}

impl CatenarySection {
    /// The part of a dynamic line, in water of a density (kg/m3).
    fn part(&self, elements: usize, density: f64) -> LinePart {
        LinePart {
            segment: rod::RodSegment {
                axial: self.coefficients.map_or(TensionLaw::Linear(self.ea), |[k1, k2, k3]| {
                    TensionLaw::from_powers(vec![self.ea, k1, k2, k3])
                }),
                bending: self.ei,
                compression: self.ei > 0.0,
                displaced: self.area,
                drag_diameter: self.diameter,
                drag_normal: self.cd,
                drag_tangential: self.cx / PI,
                added_area: self.area,
                added_normal: self.ca,
                ..rod::RodSegment::line(self.length, elements, self.mass, self.ea, (self.area / FRAC_PI_4).sqrt())
            },
            strength: BreakingStrength { breaking: self.largest, is_given: self.largest_is_given },
            joint: self.joint_mass.map(|[mass, displaced, added, drag]| JointMass {
                mass,
                volume: displaced / density,
                added: if displaced > 0.0 { added / displaced } else { added },
                drag,
                pendant: 0.0,
            }),
        }
    }
}

impl DynamicLineClass for CatenaryClass {
    /// Cable dynamics: `rho Ca A` of added mass, `0.5 rho Cd V2 De` across and `0.5 rho Cx V2 De` along, EI, and no maximum tension
    /// [AQWA-CONN 5.8.3.1].
    fn dynamic_line(&self, connection: &Connection, elements: usize) -> Result<Box<dyn ConnectorElement>, ClassError> {
        let density = connection.surroundings.water_density;
        if let Some(dry) = self.sections.iter().find(|s| s.area == 0.0) {
            return Err(ClassError::new("cable dynamics needs a section with an area")
                .with_span(dry.span)
                .help("give AREA"));
        }
        for s in &self.sections {
            let [mass, displaced, added, _] = s.joint_mass.unwrap_or_default();
            let named = [("structural mass", mass), ("mass of water displaced", displaced), ("added mass", added)];
            if let Some((what, value)) = named.into_iter().find(|(_, value)| *value < 0.0) {
                let text = format!("cable dynamics needs a joint without negative masses: the {what} is {{}}");
                return Err(ClassError::with_values(text, &[(value, Dim::Mass)])
                    .with_span(s.joint_span)
                    .help("a net weight is a structural mass, a net lift a mass of water displaced"));
            }
        }
        let whole: f64 = self.sections.iter().map(|s| s.length).sum();
        let count = |s: &CatenarySection| ((elements as f64 * s.length / whole).round() as usize).max(1);
        let part = |s: &CatenarySection| s.part(count(s), density);
        let slope = Some(self.slope).filter(|slope| *slope != 0.0);
        let seabed = Seabed { depth: self.depth, slope, with_anchor: true, ..Seabed::default() };
        let parts = self.sections.iter().map(part).collect();
        let made = description("CATENARY", parts, seabed, [None, None]);
        Ok(Box::new(DynamicLine::build(made, connection)?))
    }

    fn has_sloped_seabed(&self) -> bool {
        self.slope != 0.0
    }
}
