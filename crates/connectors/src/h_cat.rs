//! H_CAT: a hanging catenary between a body and ground or another body; it knows neither bottom nor surface.
//!
//! Source: [MOSES-FLEX H_CAT]; [MOSES-HELP connect]: weightless unless EXACT, then with its weight in air.

use super::chord::{Chord, ChordElement};
use super::devices::Devices;
use super::dynamic_line::{self as m, DynamicLine, Flexure, Seabed};
use super::extension::Extended;
use super::line_element::LineElement;
use super::mooring::{Mooring, end_springs, line_error, no_other_end, parts, with_series};
use super::per_line::PerLineOptions;
use super::section::{self, LineSection, properties};
use super::{ClassKind, append_all, checks, options as o};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::table::Table;
use windlass_base::units::{Dim, UnitSystem};
use windlass_base::values::{Args, Given};
use windlass_catenary::{Line, StretchLaw};
use windlass_language::spec::{CommandSpec, OptionSpec, ValueSpec};
use windlass_model::{
    ClassError, ClassRecord, Connection, Connector, ConnectorClass, Element, FatigueSegment, LineModel, Placement,
    Surroundings,
};

/// The class type.
pub static H_CAT: ClassKind =
    ClassKind { spec: &H_CAT_SPEC, segmented: true, build: append_all::<Hanging>, idle: section::HANGING_IDLE };

/// Options of lines between two places.
pub const LINE_OPTIONS: &[OptionSpec] = &[
    o::LEN,
    o::TYPE,
    o::REFINE,
    o::IG_STIFF,
    o::SEND,
    o::X_PY,
    o::X_DAMPING_LINE,
    o::SPGRAVITY,
    o::DENSITY,
    o::CONVOLUTION,
    o::EMODULUS,
    o::POI_RAT,
    o::ALPHA,
    o::FYIELD,
    o::TENSTR,
    o::WTPLEN,
    o::DISPLEN,
    o::PISTON,
    o::B_TENSION,
    o::C_SN,
    o::TAB_LIM,
    o::CLUMP,
    o::BUOYDIAMETER,
    o::DRAGDIAMETER,
    o::WINDDIAMETER,
    o::AMASDIAMETER,
    m::CD,
    m::CA,
    m::AX_DAMPING,
    m::SEABED,
];

/// Options of a B_CAT that are taken, and do nothing without a bottom or give the place of an anchor.
const BOTTOM_OPTIONS: [OptionSpec; 3] = [o::DEPANCHOR, o::FRICTION, o::SLOPE];

const H_CAT_OPTIONS: [OptionSpec; LINE_OPTIONS.len() + BOTTOM_OPTIONS.len()] = {
    let mut all = [o::DEPANCHOR; LINE_OPTIONS.len() + BOTTOM_OPTIONS.len()];
    let mut i = 0;
    while i < LINE_OPTIONS.len() {
        all[i] = LINE_OPTIONS[i];
        i += 1;
    }
    while i < all.len() {
        all[i] = BOTTOM_OPTIONS[i - LINE_OPTIONS.len()];
        i += 1;
    }
    all
};

/// What is said of a class with options of the bottom.
const NO_BOTTOM: &str = "it has no bottom: -FRICTION and -SLOPE do nothing, and -DEPANCHOR is the depth of its anchor alone; a B_CAT lies on the bottom";

static H_CAT_SPEC: CommandSpec = CommandSpec {
    data: &[o::LINE_OD, ValueSpec::choice::<o::CatenaryFlag>("FLAG", "with its weight").or("weightless")],
    options: &H_CAT_OPTIONS,
    detail: "-CD, -CA, -AX_DAMPING and -SEABED act with the line's own dynamics alone: &CONNECTOR -DYNAMICS. A hanging catenary: it knows neither bottom nor surface (reports say where it passes them), and takes no buoys. -DEPANCHOR is the depth of its anchor; -FRICTION and -SLOPE do nothing. Without EXACT it is weightless: \
             a spring along the chord that only pulls. -PISTON is a link of its position less LD between the first end and the line, in the direction of the tension; it has no weight. \
             MAX stands as near to LD as TMAX allows; MINMAX stays where it is between TMIN and TMAX. While it can follow, the tension \
             stays at the limit without stiffness along it; beyond VLONG, VSHORT or the stroke (0 to LT) it departs. At rest the piston \
             has slid from LD as far as it must. A table or a shape of the line is at LD. The piston does not feel the dashpot of \
             -X_DAMPING, which also pushes while the ends come nearer.",
    example: "MEDIT\n~HANG H_CAT 3 EXACT -LEN 400\nEND\n&STATUS CLASS ~HANG",
    ..CommandSpec::new("H_CAT", "hanging catenary")
};

/// Options that hold for the whole line, in this class and in SL_ELEM.
pub const PER_LINE: [OptionSpec; 6] = [o::SEND, o::X_PY, o::X_DAMPING_LINE, o::CONVOLUTION, o::PISTON, o::TAB_LIM];

#[derive(Debug, Default)]
struct Hanging {
    per_line: PerLineOptions,
    flexures: Vec<Flexure>,
    seabed: Seabed,
    sections: Vec<LineSection>,
    places: Vec<Span>,
    exact: bool,
    springs: [Option<StretchLaw>; 2],
    devices: Devices,
    limit: Option<f64>,
    depth: Option<f64>,
    /// Whether options of a bottom were given.
    bottom: bool,
}

/// Refuses spring buoys, and options of the whole line with another value than on the records before.
///
/// # Errors
/// Both, at their places.
pub fn check_record(before: &PerLineOptions, args: &Args, kind: &str) -> Outcome<()> {
    if let Some(clump) =
        args.option(&o::CLUMP).filter(|clump| clump.number(const { o::CLUMP.number("CW") }).is_some_and(|w| w < 0.0))
    {
        let article = if kind.starts_with(['A', 'E', 'H', 'S']) { "an" } else { "a" };
        return Err(Diagnostic::error(format!("{article} {kind} takes no spring buoy"), clump.span).help("use B_CAT"));
    }
    before.check(args, &PER_LINE)
}

impl ConnectorClass for Hanging {
    fn kind(&self) -> &'static str {
        "H_CAT"
    }

    fn append(&mut self, record: &ClassRecord) -> Outcome<()> {
        let args = &record.args;
        check_record(&self.per_line, args, "H_CAT")?;
        let section = LineSection::read(record, "H_CAT", false)?;
        let flexure = Flexure::read(record, &section)?;
        self.per_line.check(args, &BOTTOM_OPTIONS)?;
        self.per_line.check(args, &[m::SEABED])?;
        // nothing is refused from here on
        self.sections.push(section);
        self.flexures.push(flexure);
        self.places.push(args.span);
        self.exact |= match args.choice(const { H_CAT_SPEC.choice("FLAG") }) {
            Some(o::CatenaryFlag::Exact) => true,
            None => false,
        };
        self.bottom |= BOTTOM_OPTIONS.iter().any(|option| args.has(option));
        if self.per_line.take(args, &PER_LINE)
            | self.per_line.take(args, &BOTTOM_OPTIONS)
            | self.per_line.take(args, &[m::SEABED])
        {
            let options = &self.per_line;
            self.seabed = m::parse_seabed(options);
            self.springs = end_springs(options);
            self.devices = Devices::read(options);
            self.limit = options.number(&o::TAB_LIM);
            self.depth = options.number(&o::DEPANCHOR);
        }
        Ok(())
    }

    fn notices(&self, last: &Args, units: UnitSystem, _: &Surroundings) -> Vec<Diagnostic> {
        if self.exact {
            return section::bar_notice(&self.sections, last, units, |s| (s.in_air(), "in air, which H_CAT hangs by"))
                .into_iter()
                .collect();
        }
        let given = [o::WTPLEN, o::DENSITY, o::SPGRAVITY, o::TYPE].iter().find_map(|option| last.option(option));
        let says = |given: &Given| {
            let text = format!("{} is not used: an H_CAT without EXACT is weightless", given.name());
            *Diagnostic::remark(text, given.span)
                .help("~NAME H_CAT OD EXACT has its weight; a dynamic line has it always")
        };
        given.filter(|_| self.straight() && self.sections.len() == 1).map(says).into_iter().collect()
    }

    fn check_ends(&self, connector: &Connector, bodies: usize) -> Outcome<()> {
        checks::ends("H_CAT", connector, bodies, 2, 2)
    }

    fn fatigue_segments(&self) -> Vec<FatigueSegment> {
        self.sections.iter().map(LineSection::fatigue).collect()
    }

    fn properties(&self, name: &str, surroundings: &Surroundings) -> Table {
        let flag = if self.exact { "EXACT" } else { "weightless" };
        let mut table = properties(name, "H_CAT", &self.sections, surroundings).fact("Flag", flag, Dim::None);
        if self.bottom {
            table.note(NO_BOTTOM);
        }
        table
    }

    fn first_length(&self) -> Option<f64> {
        self.sections.first().map(|s| s.length)
    }

    fn anchor_depth(&self, surroundings: &Surroundings) -> Option<f64> {
        self.depth.or(surroundings.depth)
    }

    fn series_curve(&self) -> Option<(&str, Span)> {
        self.devices.convolution.as_ref().map(|(name, span)| (name.as_str(), *span))
    }

    fn is_line(&self) -> bool {
        true
    }

    fn line(&self, place: &Placement, surroundings: &Surroundings) -> Result<Box<dyn LineModel>, ClassError> {
        let springs = with_series(&self.springs, self.devices.convolution.as_ref(), place)?;
        let mut line = self.build_line(place, surroundings, &springs)?;
        line.notes.extend(self.devices.notes());
        if self.straight() {
            return Ok(Box::new(Chord { line, springs, pushes: false, left_out: self.left_out(surroundings) }));
        }
        Ok(Box::new(line))
    }

    fn moving(&self, connection: &Connection, elements: usize) -> Result<Box<dyn Element>, ClassError> {
        let plain = self.devices.is_none() && self.springs.iter().all(Option::is_none);
        let made = (self.sections.as_slice(), self.flexures.as_slice());
        let made = m::chain(("H_CAT", plain), made, self.seabed, elements, connection.surroundings)?;
        Ok(Box::new(DynamicLine::build(made, connection)?))
    }

    fn element(&self, connection: &Connection) -> Result<Box<dyn Element>, ClassError> {
        if self.devices.is_none() {
            return self.line(&connection.placement, connection.surroundings)?.element();
        }
        let springs = self.springs.clone();
        let line = self.build_line(&connection.placement, connection.surroundings, &springs)?;
        let line: Box<dyn Extended> = if self.straight() {
            Box::new(ChordElement::new(Chord {
                line,
                springs,
                pushes: false,
                left_out: self.left_out(connection.surroundings),
            })?)
        } else {
            Box::new(LineElement::new(line)?)
        };
        self.devices.element(connection, line)
    }
}

impl Hanging {
    /// Whether it is a spring along its chord.
    fn straight(&self) -> bool {
        !self.exact && self.sections.iter().all(|s| s.clump == 0.0)
    }

    /// Weight in water that a spring along the chord leaves out (N).
    fn left_out(&self, surroundings: &Surroundings) -> f64 {
        self.sections.iter().map(|s| s.submerged_weight(surroundings) * s.length).sum()
    }

    /// The line with these springs at its ends.
    fn build_line(
        &self,
        place: &Placement,
        surroundings: &Surroundings,
        springs: &[Option<StretchLaw>; 2],
    ) -> Result<Mooring, ClassError> {
        let weight = |s: &LineSection| if self.exact { s.in_air() } else { 0.0 };
        let mut line = hung(&self.sections, springs, place, surroundings, &self.places, weight)?;
        line.largest = self.limit.unwrap_or(line.largest);
        if self.bottom {
            line.notes.push(NO_BOTTOM.into());
        }
        Ok(line)
    }
}

/// A line between two places that sees neither bottom nor surface.
///
/// # Errors
/// An end whose place is not known, values that make no line.
pub fn hung(
    sections: &[LineSection],
    springs: &[Option<StretchLaw>; 2],
    place: &Placement,
    surroundings: &Surroundings,
    places: &[Span],
    weight: impl Fn(&LineSection) -> f64,
) -> Result<Mooring, ClassError> {
    let [_, _, far] = place.other.ok_or_else(no_other_end)?;
    let (segments, joints) = parts(sections, place, weight);
    let line = Line::new(segments, joints, far, surroundings.tide)
        .and_then(|l| l.with_seabed(None))
        .and_then(|l| l.with_springs(springs.clone()))
        .map_err(|e| line_error(&e, places))?;
    Ok(Mooring {
        line,
        breaks: sections.iter().map(|s| s.breaking).collect(),
        breaks_given: sections.iter().map(|s| s.break_is_given).collect(),
        largest: sections.iter().map(|s| s.breaking).reduce(f64::max).unwrap_or(0.0),
        tabulated: false,
        profile: None,
        place: place.clone(),
        surface: surroundings.tide,
        bottom: surroundings.depth.map(|d| -d),
        places: places.to_vec(),
        notes: Vec::new(),
    })
}
