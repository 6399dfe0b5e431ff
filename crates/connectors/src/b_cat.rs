//! B_CAT: a catenary to ground, of one or more segments.
//!
//! Source: [MOSES-FLEX B_CAT]; which options hold per segment and which per line:
//! [W-PER-LINE].

use super::devices::Devices;
use super::dynamic_line::{self as m, DynamicLine, Flexure, Seabed};
use super::line_element::LineElement;
use super::line_profile::LineProfile;
use super::mooring::{Mooring, end_springs, line_error, parts, with_series};
use super::per_line::PerLineOptions;
use super::section::{self, LineSection, properties};
use super::{ClassKind, append_all, checks, options as o};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::table::Table;
use windlass_base::units::{Dim, UnitSystem};
use windlass_base::values::Args;
use windlass_catenary::{Line, LineError, SeabedModel, StretchLaw};
use windlass_language::spec::{CommandSpec, DatumKey, OptionSpec, ValueSpec};
use windlass_model::Note;
use windlass_model::{
    ClassError, ClassRecord, Connection, Connector, ConnectorClass, Element, FatigueSegment, LineModel, Placement,
    Surroundings,
};

/// The class type.
pub static B_CAT: ClassKind =
    ClassKind { spec: &SPEC, segmented: true, build: append_all::<Catenary>, idle: section::CATENARY_IDLE };

static SPEC: CommandSpec = CommandSpec {
    data: &[
        o::LINE_OD,
        ValueSpec::choice::<o::CatenaryFlag>("FLAG", "without effect: the line is always solved exactly").or("exact"),
    ],
    options: &[
        o::LEN,
        o::TYPE,
        o::DEPANCHOR,
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
        o::TABLE,
        o::CLUMP,
        o::BUOYDIAMETER,
        o::DRAGDIAMETER,
        o::WINDDIAMETER,
        o::AMASDIAMETER,
        o::FRICTION,
        o::SLOPE,
        m::CD,
        m::CA,
        m::AX_DAMPING,
        m::SEABED,
    ],
    detail: "-CD, -CA, -AX_DAMPING and -SEABED act with the line's own dynamics alone: &CONNECTOR -DYNAMICS. One record a segment, fairlead first, all with the same class name. A negative -CLUMP is a spring buoy: \
             the joint stays CLEN below the surface until the pull reaches the buoy's displacement, then sinks; the \
             segments above it do not see the bottom. -TYPE NAME D takes a chain or rope of the library (&STATUS LINE_TYPES) \
             instead of OD. Per segment: OD, -TYPE, -LEN, material, diameters, -CLUMP, -B_TENSION, -C_SN. Per line, on any \
             record: FLAG, -DEPANCHOR, -FRICTION, -SLOPE, -TABLE, -TAB_LIM, -SEND, -X_PY, -X_DAMPING, -CONVOLUTION, -PISTON. \
             Connects a body to ground. On -BATHYMETRY of &ENV the line lies on the profile along its azimuth, unless -DEPANCHOR or -SLOPE is given. The line is solved exactly wherever it is used. -TABLE is the shortcut of MOSES: thirty rows \
             at the elevation of the fairlead, forces interpolated between them, exact nearer than the first row, straight on beyond the \
             last. Its rows are made anew where the fairlead rises or sinks, which makes it slower than the exact solution. -PISTON is a link of its position less LD between the first end and the line, in the direction of the tension; it has no weight. \
             MAX stands as near to LD as TMAX allows; MINMAX stays where it is between TMIN and TMAX. While it can follow, the tension \
             stays at the limit without stiffness along it; beyond VLONG, VSHORT or the stroke (0 to LT) it departs. At rest the piston \
             has slid from LD as far as it must. A table or a shape of the line is at LD. The piston does not feel the dashpot of \
             -X_DAMPING, which also pushes while the ends come nearer.",
    example: "MEDIT\n~WIRE B_CAT 4.625 -LEN 500 -BUOY 0 -WTPL 37.51/1000 -EMOD 29000*0.1 -CLUMP -100\n\
              ~WIRE B_CAT 4.625 -LEN 4000 -BUOY 0 -WTPL 37.51/1000 -EMOD 29000*0.1 -DEPANCHOR 3000\nEND\n&STATUS CLASS ~WIRE",
    ..CommandSpec::new("B_CAT", "catenary to ground")
};

/// Options that hold for the whole line.
const PER_LINE: [OptionSpec; 9] =
    [o::DEPANCHOR, o::FRICTION, o::SLOPE, o::TAB_LIM, o::SEND, o::X_PY, o::X_DAMPING_LINE, o::CONVOLUTION, o::PISTON];

#[derive(Debug, Default)]
struct Catenary {
    per_line: PerLineOptions,
    flexures: Vec<Flexure>,
    seabed: Seabed,
    sections: Vec<LineSection>,
    places: Vec<Span>,
    /// The first `-TABLE`: forces are interpolated.
    tabulated: Option<Span>,
    /// The first EXACT.
    exact: Option<Span>,
    depth: Option<f64>,
    friction: f64,
    slope: Option<f64>,
    limit: Option<f64>,
    springs: [Option<StretchLaw>; 2],
    devices: Devices,
}

impl Catenary {
    /// Depth of the anchor below z = 0 (m).
    fn known_depth(&self, surroundings: &Surroundings) -> Result<f64, ClassError> {
        self.anchor_depth(surroundings).ok_or_else(|| {
            ClassError::new("the depth at the anchor is not known")
                .help("give -DEPANCHOR on the class, or -DEPTH on &ENV")
        })
    }

    /// The line with these springs at its ends.
    fn build_line(
        &self,
        place: &Placement,
        surroundings: &Surroundings,
        springs: [Option<StretchLaw>; 2],
    ) -> Result<Mooring, ClassError> {
        let depth = match place.other {
            Some([_, _, anchor]) if place.to_ground => -anchor,
            _ => self.known_depth(surroundings)?,
        };
        let error = |e: LineError| line_error(&e, &self.places);
        let (segments, joints) = parts(&self.sections, place, |s| s.submerged_weight(surroundings));
        let floor = SeabedModel { elevation: -depth, slope: self.slope.unwrap_or(0.0), friction: self.friction };
        let (distance, azimuth) = place.span();
        let length = segments.iter().map(|s| s.length).sum::<f64>().max(distance);
        let profile = place
            .bathymetry
            .as_ref()
            .zip(place.other)
            .map(|(grid, [x, y, _])| LineProfile::new(grid, [x, y], azimuth, length, self.friction));
        let line = Line::new(segments, joints, -depth, surroundings.tide)
            .and_then(|l| match &profile {
                Some(profile) => profile.lay(l),
                None => l.with_seabed(Some(floor)),
            })
            .and_then(|l| l.with_springs(springs))
            .map_err(error)?;
        if depth <= -surroundings.tide {
            return Err(ClassError::new("the anchor lies above the water surface").help("check -DEPANCHOR and -ANCHOR"));
        }
        let [_, _, fairlead] = place.fairlead;
        let flat = self.slope.is_none_or(|slope| slope == 0.0) && profile.is_none();
        if flat && fairlead < -depth {
            return Err(
                ClassError::new("the fairlead lies below the anchor's depth").help("check &INSTATE and -DEPANCHOR")
            );
        }
        let mut notes = Vec::new();
        if let Some(known) = surroundings.depth.filter(|d| (d - depth).abs() > 0.2 * d.max(depth) && flat) {
            let share = depth / known;
            notes.push(Note::warning(format!("the depth of the anchor is {share:.2} of the depth of &ENV")));
        }
        if let Some(coarse) = profile.as_ref().map(LineProfile::coarseness).filter(|c| *c > 1.0) {
            notes.push(Note::warning(format!(
                "the profile under the line has {coarse:.1} times the spacing of the bathymetry"
            )));
        }
        Ok(Mooring {
            line,
            breaks: self.sections.iter().map(|s| s.breaking).collect(),
            breaks_given: self.sections.iter().map(|s| s.break_is_given).collect(),
            largest: self.limit.or(largest_break(&self.sections)).unwrap_or(0.0),
            tabulated: self.is_tabulated(),
            profile,
            place: place.clone(),
            surface: surroundings.tide,
            bottom: Some(-depth),
            places: self.places.clone(),
            notes,
        })
    }
}

impl ConnectorClass for Catenary {
    fn kind(&self) -> &'static str {
        "B_CAT"
    }

    fn append(&mut self, record: &ClassRecord) -> Outcome<()> {
        let args = &record.args;
        let section = LineSection::read(record, "B_CAT", false)?;
        self.per_line.check(args, &PER_LINE)?;
        let tabulated = self.tabulated.or(args.option(&o::TABLE).map(|given| given.span));
        const FLAG: DatumKey<o::CatenaryFlag> = SPEC.choice("FLAG");
        let flag = args.choice(FLAG).map(|o::CatenaryFlag::Exact| args.place(FLAG));
        let exact = self.exact.or(flag);
        if let (Some(table), Some(flag)) = (tabulated, exact) {
            return Err(Diagnostic::error("EXACT and -TABLE contradict each other", table)
                .other(flag, "solved exactly")
                .help("leave one of them out; without both the line is solved exactly"));
        }
        let flexure = Flexure::read(record, &section)?;
        self.per_line.check(args, &[m::SEABED])?;
        // nothing is refused from here on
        self.sections.push(section);
        self.flexures.push(flexure);
        self.places.push(args.option(&o::CLUMP).map_or(args.span, |clump| clump.span));
        (self.tabulated, self.exact) = (tabulated, exact);
        if self.per_line.take(args, &PER_LINE) | self.per_line.take(args, &[m::SEABED]) {
            let options = &self.per_line;
            self.seabed = m::parse_seabed(options);
            self.depth = options.number(&o::DEPANCHOR);
            self.friction = options.number(&o::FRICTION).unwrap_or(0.0);
            self.slope = options.number(&o::SLOPE);
            self.limit = options.number(&o::TAB_LIM);
            self.springs = end_springs(options);
            self.devices = Devices::read(options);
        }
        Ok(())
    }

    fn check(&self) -> Outcome<()> {
        if let (Some(last), Some(place)) = (self.sections.last(), self.places.last())
            && last.clump < 0.0
        {
            return Err(Diagnostic::error("a spring buoy cannot be part of the last segment", *place)
                .label("this segment is attached to ground")
                .help("add the next segment with the same class name, or make CW positive"));
        }
        Ok(())
    }

    fn notices(&self, last: &Args, units: UnitSystem, around: &Surroundings) -> Vec<Diagnostic> {
        section::bar_notice(&self.sections, last, units, |s| (s.submerged_weight(around), "in water"))
            .into_iter()
            .collect()
    }

    fn check_ends(&self, connector: &Connector, bodies: usize) -> Outcome<()> {
        checks::ends("B_CAT", connector, bodies, 2, 1)
    }

    fn fatigue_segments(&self) -> Vec<FatigueSegment> {
        self.sections.iter().map(LineSection::fatigue).collect()
    }

    fn properties(&self, name: &str, surroundings: &Surroundings) -> Table {
        let mut table = properties(name, "B_CAT", &self.sections, surroundings)
            .fact("Solution", if self.is_tabulated() { "table of thirty points (-TABLE)" } else { "exact" }, Dim::None)
            .fact("Depth at Anchor", self.depth.or(surroundings.depth), Dim::Length)
            .fact("Slope of Bottom", self.slope.unwrap_or(0.0), Dim::None)
            .fact("Friction of Bottom", self.friction, Dim::None)
            .fact("Table Limit", self.limit.or(largest_break(&self.sections)), Dim::Force);
        if self.check().is_err() {
            table.note("a spring buoy ends the last segment: a further segment is needed");
        }
        table
    }

    fn first_length(&self) -> Option<f64> {
        self.sections.first().map(|s| s.length)
    }

    fn anchor_depth(&self, surroundings: &Surroundings) -> Option<f64> {
        self.depth.or(surroundings.depth)
    }

    fn follows_bathymetry(&self) -> bool {
        self.depth.is_none() && self.slope.is_none()
    }

    fn lies_on_plane(&self) -> bool {
        true
    }

    fn slopes(&self) -> bool {
        self.seabed.slopes()
    }

    fn series_curve(&self) -> Option<(&str, Span)> {
        self.devices.convolution.as_ref().map(|(name, span)| (name.as_str(), *span))
    }

    fn is_line(&self) -> bool {
        true
    }

    fn is_tabulated(&self) -> bool {
        self.tabulated.is_some()
    }

    fn line(&self, place: &Placement, surroundings: &Surroundings) -> Result<Box<dyn LineModel>, ClassError> {
        let springs = with_series(&self.springs, self.devices.convolution.as_ref(), place)?;
        let mut line = self.build_line(place, surroundings, springs)?;
        line.notes.extend(self.devices.notes());
        Ok(Box::new(line))
    }

    fn moving(&self, connection: &Connection, elements: usize) -> Result<Box<dyn Element>, ClassError> {
        let plain = self.devices.is_none() && self.springs.iter().all(Option::is_none);
        let made = (self.sections.as_slice(), self.flexures.as_slice());
        let seabed = Seabed { with_anchor: true, ..self.seabed };
        let made = m::chain(("B_CAT", plain), made, seabed, elements, connection.surroundings)?;
        Ok(Box::new(DynamicLine::build(made, connection)?))
    }

    fn element(&self, connection: &Connection) -> Result<Box<dyn Element>, ClassError> {
        let line = self.build_line(&connection.placement, connection.surroundings, self.springs.clone())?;
        let line = LineElement::new(line)?;
        if self.devices.is_none() {
            return Ok(Box::new(line));
        }
        self.devices.element(connection, Box::new(line))
    }
}

fn largest_break(sections: &[LineSection]) -> Option<f64> {
    sections.iter().map(|s| s.breaking).reduce(f64::max)
}
