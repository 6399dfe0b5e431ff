//! The section of a line's segment: what its diameter, material and load options amount to.
//!
//! Source: [MOSES-FLEX B_CAT] and [W-SECTION]: AE and break use the full area pi/4 OD^2; the submerged weight per
//! length is WTPLEN - DISPLEN - rho_w g pi/4 BUOYDIA^2. With -TYPE these come from the library of line types; an option
//! given beside it overrides it.

use super::devices;
use super::dynamic_line as m;
use super::line_types::{LineType, library};
use super::{checks, options as o};
use std::f64::consts::FRAC_PI_4;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::spec::{DatumKey, ValueKey};
use windlass_base::table::{Digits, Table};
use windlass_base::units::{Dim, UnitSystem, eight_figures};
use windlass_base::values::{Args, Given};
use windlass_language::select::{Owner, choose};
use windlass_language::spec::OptionSpec;
use windlass_model::{ClassRecord, FatigueSegment, RopeStiffness, Surroundings};

/// Density against which a specific gravity is given: fresh water (kg/m3).
const FRESH_WATER: f64 = 1000.0;

/// With what options of dynamic lines act.
const DYNAMICS: &str = "&CONNECTOR -DYNAMICS";
/// Options of the catenaries that do nothing by themselves.
pub const CATENARY_IDLE: &[(OptionSpec, &str)] = &[
    (o::POI_RAT, ""),
    (o::ALPHA, ""),
    (o::REFINE, DYNAMICS),
    (o::DRAGDIAMETER, DYNAMICS),
    (o::WINDDIAMETER, DYNAMICS),
    (o::AMASDIAMETER, DYNAMICS),
    (m::CD, DYNAMICS),
    (m::CA, DYNAMICS),
    (m::AX_DAMPING, DYNAMICS),
    (m::SEABED, DYNAMICS),
    (m::ROPE, DYNAMICS),
];

/// The same of a hanging catenary, whose weight is that in air.
pub const HANGING_IDLE: &[(OptionSpec, &str)] = &{
    let mut all = [(o::DISPLEN, DYNAMICS); CATENARY_IDLE.len() + 2];
    let mut i = 0;
    while i < CATENARY_IDLE.len() {
        all[i] = CATENARY_IDLE[i];
        i += 1;
    }
    all[i] = (o::BUOYDIAMETER, DYNAMICS);
    all
};

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
    /// Whether its record gives it: by `-B_TENSION`, a strength, or a line type.
    pub break_is_given: bool,
    /// Weight of the clump at the end (N); negative: capacity of a spring buoy.
    pub clump: f64,
    /// Pendant of the spring buoy (m).
    pub pendant: f64,
    /// Elements.
    pub refine: i64,
    /// Its type of the library.
    pub of_type: Option<TypeProperties>,
    /// Whether its record gives no weight: it has that of a solid bar.
    pub is_bar: bool,
    /// Whether it is a fibre rope that is to have its dynamic stiffness, which a quasi-static line has not.
    pub needs_dynamics: bool,
}

/// What a section of the library has beside weight, stiffness and strength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TypeProperties {
    /// The type.
    pub line_type: &'static LineType,
    /// Nominal diameter (m).
    pub diameter: f64,
    /// Diameter for drag (m).
    pub drag: f64,
    /// Diameter for added mass (m).
    pub added_mass: f64,
    /// Diameter for wind (m).
    pub wind: f64,
}

impl TypeProperties {
    /// From `-TYPE NAME D` and the diameters given beside it.
    fn read(args: &Args) -> Outcome<Option<TypeProperties>> {
        let Some((line_type, diameter)) = line_type_and_diameter(args)? else { return Ok(None) };
        if !line_type.has_values(diameter) {
            let text = format!("the formulas of {} give no line at this diameter", line_type.name);
            return Err(Diagnostic::error(text, diameter_place(args)).label("far outside of their range"));
        }
        let drag = line_type.drag.ratio * diameter;
        Ok(Some(TypeProperties {
            line_type,
            diameter,
            drag: args.number_if_declared(&o::DRAGDIAMETER).unwrap_or(drag),
            added_mass: args.number_if_declared(&o::AMASDIAMETER).unwrap_or(line_type.volume_diameter(diameter)),
            wind: args.number_if_declared(&o::WINDDIAMETER).unwrap_or(drag),
        }))
    }
}

/// The nominal diameter of `-TYPE`.
const DIAMETER: ValueKey<f64> = o::TYPE.number("D");
/// The first datum of every line.
const OD: DatumKey<f64> = DatumKey::number(&o::TUBE, "OD");
const WALL: DatumKey<f64> = DatumKey::number(&o::TUBE, "T");

/// The type a record names, and its nominal diameter (m).
fn line_type_and_diameter(args: &Args) -> Outcome<Option<(&'static LineType, f64)>> {
    let Some(given) = args.option_if_declared(&o::TYPE) else { return Ok(None) };
    let (Some(name), Some(diameter)) = (given.value(const { o::TYPE.word("NAME") }), given.number(DIAMETER)) else {
        return Ok(None);
    };
    let names = library().types.iter().map(|t| (t.name.as_str(), Owner::Ours, t));
    Ok(Some((choose(name.word().unwrap_or_default(), name.span, "line type", names)?, diameter)))
}

/// Where D of `-TYPE` stands.
fn diameter_place(args: &Args) -> Span {
    args.option_if_declared(&o::TYPE).map_or(args.span, |given| given.position(DIAMETER))
}

/// What a record with `-TYPE` should report to its writer: a diameter outside the range of the formulas, and which options
/// override the type. Diameters are printed in the user's `units`.
pub fn type_notices(args: &Args, units: UnitSystem) -> Vec<Diagnostic> {
    const OVERRIDE: [(OptionSpec, &str); 12] = [
        (o::WTPLEN, "weight"),
        (o::SPGRAVITY, "weight, of the solid area"),
        (o::DENSITY, "weight, of the solid area"),
        (o::DISPLEN, "buoyancy"),
        (o::BUOYDIAMETER, "buoyancy"),
        (o::EMODULUS, "AE, of the solid area"),
        (o::FYIELD, "break, of the solid area"),
        (o::TENSTR, "break, of the solid area"),
        (o::B_TENSION, "break"),
        (o::DRAGDIAMETER, "drag"),
        (o::WINDDIAMETER, "wind"),
        (o::AMASDIAMETER, "added mass"),
    ];
    let Ok(Some((line_type, diameter))) = line_type_and_diameter(args) else { return Vec::new() };
    let mut notices = Vec::new();
    if !line_type.covers(diameter) {
        let written = |d: f64| format!("{:.3}", Dim::Section.from_si(d, units));
        let short = |d: f64| written(d).trim_end_matches('0').trim_end_matches('.').to_string();
        let [given, least, most] = [diameter, line_type.diameter.least, line_type.diameter.most].map(short);
        let (name, unit) = (&line_type.name, Dim::Section.label(units));
        let text =
            format!("{given} {unit} is outside of {least} to {most} {unit}, which the formulas of {name} are held for");
        notices.push(*Diagnostic::warning(text, diameter_place(args)));
    }
    let given: Vec<(&Given, &str)> =
        OVERRIDE.iter().filter_map(|(option, what)| args.option_if_declared(option).map(|g| (g, *what))).collect();
    let listed: Vec<String> = given.iter().map(|(g, what)| format!("{} ({what})", g.name())).collect();
    if let Some(first) = given.iter().map(|(g, _)| g.span).min_by_key(|s| s.start) {
        let verb = if given.len() == 1 { "overrides" } else { "override" };
        notices.push(*Diagnostic::remark(format!("{} {verb} what {} gives", listed.join(", "), line_type.name), first));
    }
    if args.number(OD).is_some() {
        let text =
            format!("OD is the diameter listed, and of the solid area; {} itself has D of -TYPE", line_type.name);
        notices.push(*Diagnostic::remark(text, args.position(OD)));
    }
    notices
}

impl LineSection {
    /// From a record whose first datum is OD (and second T for a tube).
    ///
    /// # Errors
    /// A record without `-LEN`, one with neither OD nor `-TYPE`, an unknown type or one without values at its diameter, a
    /// wall thicker than the radius, P-Y curves or pistons that contradict themselves.
    pub fn read(record: &ClassRecord, kind: &str, tube: bool) -> Outcome<LineSection> {
        let args = &record.args;
        let material = &record.defaults.material;
        let of_type = TypeProperties::read(args)?;
        let od = args.number(OD).or(of_type.map(|t| t.diameter)).ok_or_else(|| {
            Diagnostic::error(format!("{kind} lacks its value OD"), args.span)
                .label("expected a diameter after this, or -TYPE NAME D")
                .help("&STATUS LINE_TYPES lists the types")
        })?;
        let thickness = if tube { args.number(WALL) } else { None };
        if let Some(t) = thickness
            && 2.0 * t > od
        {
            return Err(Diagnostic::error("the wall thickness T is larger than half of OD", args.position(WALL)));
        }
        let length = checks::length(args, kind)?;
        checks::py_curves(args)?;
        devices::check(args)?;
        let area = FRAC_PI_4 * (od * od - thickness.map_or(0.0, |t| (od - 2.0 * t).powi(2)));
        let number = |option: &OptionSpec| args.number_if_declared(option);
        let solid_weight = |density: f64| density * record.defaults.gravity * area;
        let density = number(&o::DENSITY).or(number(&o::SPGRAVITY).map(|s| s * FRESH_WATER));
        let ultimate = number(&o::TENSTR).or(number(&o::FYIELD).map(|y| y / 0.6));
        // the type's value, where the record has one
        let from_type = |of: fn(&LineType, f64) -> f64| of_type.map(|t| of(t.line_type, t.diameter));
        let weight = number(&o::WTPLEN)
            .or(density.map(solid_weight))
            .or(from_type(|t, d| t.mass.evaluate(d)).map(|mass| mass * record.defaults.gravity))
            .unwrap_or(solid_weight(material.density));
        let ea = number(&o::EMODULUS).map(|e| e * area).or(from_type(|t, d| t.ea.evaluate(d)));
        let ea = bounded_stiffness(record)?.or(ea);
        let breaking =
            number(&o::B_TENSION).or(ultimate.map(|u| u * area)).or(from_type(|t, d| t.breaking.evaluate(d)));
        // a displacement given stands for the type's, else it would count twice
        let displaced = from_type(LineType::volume_diameter)
            .map(|d| if args.option_if_declared(&o::DISPLEN).is_some() { 0.0 } else { d });
        let clump = args.option_if_declared(&o::CLUMP);
        Ok(LineSection {
            od,
            thickness,
            length,
            ea: ea.unwrap_or(material.emodulus * area),
            weight,
            displacement: number(&o::DISPLEN).unwrap_or(0.0),
            buoyancy_diameter: number(&o::BUOYDIAMETER).or(displaced).unwrap_or(od),
            breaking: breaking.unwrap_or(material.ultimate() * area),
            break_is_given: breaking.is_some(),
            clump: clump.and_then(|given| given.number(const { o::CLUMP.number("CW") })).unwrap_or(0.0),
            pendant: clump.and_then(|given| given.number(const { o::CLUMP.number("CLEN") })).unwrap_or(0.0),
            refine: args
                .option_if_declared(&o::REFINE)
                .and_then(|g| g.values.first())
                .and_then(|v| v.integer())
                .unwrap_or(1),
            of_type,
            is_bar: of_type.is_none()
                && [o::WTPLEN, o::DENSITY, o::SPGRAVITY].iter().all(|option| args.option_if_declared(option).is_none()),
            needs_dynamics: record.defaults.rope_stiffness == Some(RopeStiffness::Dynamic)
                && has_rope_stiffness(record),
        })
    }

    /// What fatigue goes by in this segment; its curve is reported by the class.
    pub fn fatigue(&self) -> FatigueSegment {
        FatigueSegment {
            curve: None,
            breaking: self.breaking,
            break_is_given: self.break_is_given,
            od: self.od,
            thickness: self.thickness,
            length: self.length,
        }
    }

    /// Weight per unstretched length in water (N/m).
    pub fn submerged_weight(&self, surroundings: &Surroundings) -> f64 {
        let buoyancy = surroundings.water_weight() * FRAC_PI_4 * self.buoyancy_diameter * self.buoyancy_diameter;
        self.weight - self.displacement - buoyancy
    }

    /// Weight per unstretched length in air (N/m).
    pub fn in_air(&self) -> f64 {
        self.weight
    }
}

/// The axial stiffness (N) that `-EA_BOUNDS` of a record and `&PARAMETER -STIFFNESS` give a fibre rope; none where it has no bounds.
///
/// # Errors
/// Bounds in the wrong order; a rope without the largest or the dynamic stiffness that is asked for.
fn bounded_stiffness(record: &ClassRecord) -> Outcome<Option<f64>> {
    let args = &record.args;
    let (bounds, rope) = (args.option_if_declared(&o::EA_BOUNDS), args.option_if_declared(&m::ROPE));
    let chosen = record.defaults.rope_stiffness;
    let Some(given) = bounds else {
        return match (chosen, rope) {
            (Some(RopeStiffness::Upper), Some(given)) => {
                Err(Diagnostic::error("the largest stiffness of this rope is not given", given.span)
                    .help("-EA_BOUNDS EAL EAU gives it; &PARAMETER -STIFFNESS UPPER, or a column stiffness of a study, asks for it"))
            }
            _ => Ok(None),
        };
    };
    let [lower, upper] =
        const { o::EA_BOUNDS.numbers(["EAL", "EAU"]) }.map(|key| given.number(key).unwrap_or(f64::NAN));
    if upper < lower {
        let text = format!("EAU is below EAL of {}", given.name());
        return Err(Diagnostic::error(text, given.position(const { o::EA_BOUNDS.number("EAU") })));
    }
    if let Some(other) = [o::EMODULUS, m::EA, m::STRETCH].iter().find_map(|option| args.option_if_declared(option)) {
        return Err(Diagnostic::error("axial stiffness is given twice", other.span).other(given.span, "and here"));
    }
    if (chosen, rope) == (Some(RopeStiffness::Dynamic), None) {
        return Err(Diagnostic::error("the dynamic stiffness of this rope is not given", given.span).help(
            "-ROPE EAD B TAU gives it; &PARAMETER -STIFFNESS DYNAMIC, or a column stiffness of a study, asks for it",
        ));
    }
    Ok(Some(if chosen == Some(RopeStiffness::Upper) { upper } else { lower }))
}

/// Whether a record is of a fibre rope whose stiffness `&PARAMETER -STIFFNESS` chooses.
pub fn has_rope_stiffness(record: &ClassRecord) -> bool {
    [o::EA_BOUNDS, m::ROPE].iter().any(|option| record.args.option_if_declared(option).is_some())
}

/// A value to four figures, with its unit.
pub fn four_figures(value: f64, dim: Dim, units: UnitSystem) -> String {
    let own = dim.from_si(value, units);
    format!("{} {}", eight_figures(format!("{own:.3e}").parse().unwrap_or(own)), dim.label(units))
}

/// What is said of the first segment of a line that has a diameter alone: it weighs as much as a solid bar. `weight` is that
/// by which its class hangs (N/m), with the word of where it is so.
pub fn bar_notice(
    sections: &[LineSection],
    last: &Args,
    units: UnitSystem,
    weight: impl Fn(&LineSection) -> (f64, &'static str),
) -> Option<Diagnostic> {
    let (own, others) = sections.split_last()?;
    if !own.is_bar || own.thickness.is_some() || others.iter().any(|s| s.is_bar) {
        return None;
    }
    let (weight, there) = weight(own);
    let (od, weight) = (four_figures(own.od, Dim::Section, units), four_figures(weight, Dim::ForcePerLength, units));
    let mut text = format!("{od} without a weight is a solid steel bar, {weight} {there}");
    if !own.break_is_given {
        text.push_str(&format!(", break {}", four_figures(own.breaking, Dim::Force, units)));
    }
    let advice =
        "-TYPE CHAIN_R4 D makes it a chain (&STATUS LINE_TYPES lists chain, wire and rope); -WTPLEN gives a weight";
    Some(*Diagnostic::remark(text, last.position(OD)).help(advice))
}

/// The `&STATUS CLASS` table of a line: one row a segment.
pub fn properties(name: &str, kind: &str, sections: &[LineSection], surroundings: &Surroundings) -> Table {
    let rows: Vec<(usize, &LineSection)> = sections.iter().enumerate().collect();
    let table = Table::new(format!("Class {name}"))
        .fact("Type", kind, Dim::None)
        .with_rows(&rows)
        .column("", "Segment", Dim::None, Digits::Usual, |(index, _)| index + 1)
        .column("", "OD", Dim::Section, Digits::Usual, |(_, s)| s.od)
        .column("", "Length", Dim::Length, Digits::Usual, |(_, s)| s.length)
        .column("Weight / Length", "Air", Dim::ForcePerLength, Digits::Usual, |(_, s)| s.in_air())
        .column("Weight / Length", "Water", Dim::ForcePerLength, Digits::Usual, |(_, s)| {
            s.submerged_weight(surroundings)
        })
        .column("", "AE", Dim::Force, Digits::Scientific(5), |(_, s)| s.ea)
        .column("", "Break", Dim::Force, Digits::Usual, |(_, s)| s.breaking)
        .column("", "Elements", Dim::None, Digits::Usual, |(_, s)| s.refine)
        .column("End of Segment", "Clump", Dim::Force, Digits::Usual, |(_, s)| s.clump)
        .column("End of Segment", "Pendant", Dim::Length, Digits::Usual, |(_, s)| (s.clump < 0.0).then_some(s.pendant));
    if sections.iter().all(|s| s.of_type.is_none()) {
        return table.build();
    }
    table
        .text("Type", |(_, s)| s.of_type.map(|t| t.line_type.name.as_str()))
        .column("Diameter for", "Buoyancy", Dim::Section, Digits::Usual, |(_, s)| s.buoyancy_diameter)
        .column("Diameter for", "Drag", Dim::Section, Digits::Usual, |(_, s)| s.of_type.map(|t| t.drag))
        .column("Diameter for", "Add. Mass", Dim::Section, Digits::Usual, |(_, s)| s.of_type.map(|t| t.added_mass))
        .column("Diameter for", "Wind", Dim::Section, Digits::Usual, |(_, s)| s.of_type.map(|t| t.wind))
        .build()
}
