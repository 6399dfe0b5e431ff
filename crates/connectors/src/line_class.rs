//! The class of the mooring lines B_CAT, H_CAT and SL_ELEM: segments in series with springs and devices at the ends. What differs
//! between the three is data of a [`LineClassKind`].
//!
//! Which options hold per segment and which per line: [W-PER-LINE].

use super::chord::Chord;
use super::chord::ChordElement;
use super::devices::{self, Devices};
use super::dynamic_line::{self as m, DynamicLine, Flexure, Seabed};
use super::extension::ExtensibleLine;
use super::line_element::LineElement;
use super::line_profile::LineProfile;
use super::line_properties;
use super::mooring::{Mooring, end_springs, line_error, no_other_end, segments_and_joints, with_series};
use super::per_line::PerLineOptions;
use super::reeved_line::ReevedLine;
use super::section::{LineSection, properties};
use super::{checks, options as o};
use std::sync::Arc;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::table::Table;
use windlass_base::units::UnitSystem;
use windlass_base::values::Args;
use windlass_catenary::{Line, LineError, SeabedModel, StretchLaw};
use windlass_language::spec::{CommandSpec, OptionSpec};
use windlass_model::{
    AnchoredClass, ClassError, ClassRecord, Connection, Connector, ConnectorClass, ConnectorElement, DynamicLineClass,
    FatigueSegment, LengthClass, LineModel, LineProperties, Note, Placement, ReevedLayout, ReevedLineClass,
    SegmentedClass, StaticLineClass, StaticSeabed, Surroundings,
};

/// What -PISTON and -X_DAMPING do, of the help of every class of lines.
macro_rules! devices_help {
    () => {
        "-PISTON is a link of its position less LD between the first end and the line, in the direction of the tension; it has no weight. \
         MAX stands as near to LD as TMAX allows; MINMAX stays where it is between TMIN and TMAX. While it can follow, the tension \
         stays at the limit without stiffness along it; beyond VLONG, VSHORT or the stroke (0 to LT) it departs. At rest the piston \
         has slid from LD as far as it must. A table or a shape of the line is at LD. The piston does not feel the dashpot of \
         -X_DAMPING, which also pushes while the ends come nearer."
    };
}
pub(crate) use devices_help;

/// What is said of the options of dynamic lines, of the help of classes that can be dynamic.
macro_rules! dynamics_help {
    () => {
        "-CD, -CA, -AX_DAMPING and -SEABED act with the line's own dynamics alone: &CONNECTOR -DYNAMICS. "
    };
}
pub(crate) use dynamics_help;

/// The shape of a line at rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineForm {
    /// A catenary with its weight in water that lies on the bottom.
    OnBottom,
    /// A catenary that sees neither bottom nor surface: with its weight in air, or with that of its clumps alone.
    Hanging {
        /// Whether its segments have their weight in air.
        has_weight: bool,
    },
    /// A weightless spring along the chord.
    Chord {
        /// Whether it also takes compression.
        takes_compression: bool,
    },
}

/// A class type of lines: what distinguishes it from the others.
pub struct LineClassKind {
    /// Its record; the name of the record is the type.
    pub spec: &'static CommandSpec,
    /// The place of its flag in a record, where given.
    pub flag: fn(&Args) -> Option<Span>,
    /// Options that hold for the whole line, beside those of devices.
    pub per_line: &'static [OptionSpec],
    /// Most points of its connectors that are on bodies.
    pub max_bodies: usize,
    /// Whether a negative -CLUMP is a spring buoy; where not it is refused.
    pub takes_spring_buoys: bool,
    /// Whether its connectors can be dynamic lines.
    pub has_dynamics: bool,
    /// The shape of its lines, by its records so far.
    pub form: fn(&LineClass) -> LineForm,
    /// What is always reported of its lines.
    pub notes: fn(&LineClass) -> Vec<Note>,
    /// What the writer of the last record should know.
    pub notices: fn(&LineClass, &Args, UnitSystem, &Surroundings) -> Vec<Diagnostic>,
    /// Adds its facts to the table of `&STATUS CLASS`.
    pub add_facts: fn(&LineClass, Table, &Surroundings) -> Table,
}

impl std::fmt::Debug for LineClassKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.spec.name)
    }
}

/// A class of lines.
#[derive(Debug)]
pub struct LineClass {
    kind: &'static LineClassKind,
    /// Options of the whole line, as its records gave them.
    pub per_line: PerLineOptions,
    /// Its segments from the fairlead.
    pub sections: Vec<LineSection>,
    /// What a dynamic line needs of them beside, of a kind that has dynamics.
    flexures: Vec<Flexure>,
    /// The record of each segment, or its -CLUMP.
    positions: Vec<Span>,
    /// The first flag.
    pub flag: Option<Span>,
    /// The first -TABLE: forces are interpolated.
    tabulated: Option<Span>,
    seabed: Seabed,
    springs: [Option<StretchLaw>; 2],
    devices: Devices,
}

impl LineClass {
    /// A class of its records.
    ///
    /// # Errors
    /// As [`SegmentedClass::append`].
    pub fn build(kind: &'static LineClassKind, records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
        let mut class = LineClass {
            kind,
            per_line: PerLineOptions::default(),
            sections: Vec::new(),
            flexures: Vec::new(),
            positions: Vec::new(),
            flag: None,
            tabulated: None,
            seabed: Seabed::default(),
            springs: [None, None],
            devices: Devices::default(),
        };
        for record in records {
            class.append(record)?;
        }
        Ok(Arc::new(class))
    }

    fn name(&self) -> &'static str {
        self.kind.spec.name
    }

    fn form(&self) -> LineForm {
        (self.kind.form)(self)
    }

    /// Whether its lines lie on the bottom.
    fn is_on_bottom(&self) -> bool {
        self.form() == LineForm::OnBottom
    }

    /// -DEPANCHOR (m).
    pub fn depth(&self) -> Option<f64> {
        self.per_line.number(&o::DEPANCHOR)
    }

    /// -SLOPE: fall of the bottom toward the anchor over the distance (a ratio); none where it was not given.
    pub fn slope(&self) -> Option<f64> {
        self.per_line.number(&o::SLOPE)
    }

    /// -FRICTION: the coefficient of seabed friction (a ratio).
    pub fn friction(&self) -> f64 {
        self.per_line.number(&o::FRICTION).unwrap_or(0.0)
    }

    /// Largest horizontal force of its table (N): -TAB_LIM, else the largest break.
    pub fn table_limit(&self) -> Option<f64> {
        let largest = || self.sections.iter().map(|s| s.breaking).reduce(f64::max);
        self.per_line.number(&o::TAB_LIM).or_else(largest)
    }

    /// The line with these springs at its ends.
    fn mooring(
        &self,
        position: &Placement,
        surroundings: &Surroundings,
        springs: &[Option<StretchLaw>; 2],
    ) -> Result<Mooring, ClassError> {
        let mut made = match self.form() {
            LineForm::OnBottom => self.on_bottom(position, surroundings, springs)?,
            LineForm::Hanging { has_weight } => {
                let weight = |s: &LineSection| if has_weight { s.in_air() } else { 0.0 };
                self.hanging(&self.sections, weight, position, surroundings, springs)?
            }
            LineForm::Chord { .. } => {
                let straight: Vec<LineSection> =
                    self.sections.iter().map(|s| LineSection { clump: 0.0, ..*s }).collect();
                self.hanging(&straight, |_| 0.0, position, surroundings, springs)?
            }
        };
        made.notes.splice(0..0, (self.kind.notes)(self));
        Ok(made)
    }

    /// What a line is reported by, whatever its shape.
    fn build_mooring(&self, line: Line, position: &Placement, surroundings: &Surroundings) -> Mooring {
        Mooring {
            line,
            breaks: self.sections.iter().map(|s| s.breaking).collect(),
            breaks_given: self.sections.iter().map(|s| s.break_is_given).collect(),
            largest: self.table_limit().unwrap_or(0.0),
            tabulated: self.is_tabulated(),
            profile: None,
            position: position.clone(),
            surface: surroundings.tide,
            bottom: surroundings.depth.map(|d| -d),
            positions: self.positions.clone(),
            notes: Vec::new(),
        }
    }

    /// A line that sees neither bottom nor surface.
    fn hanging(
        &self,
        sections: &[LineSection],
        weight: impl Fn(&LineSection) -> f64,
        position: &Placement,
        surroundings: &Surroundings,
        springs: &[Option<StretchLaw>; 2],
    ) -> Result<Mooring, ClassError> {
        let [_, _, far] = position.other.ok_or_else(no_other_end)?;
        let (segments, joints) = segments_and_joints(sections, position, weight);
        let line = Line::new(segments, joints, far, surroundings.tide)
            .and_then(|l| l.with_seabed(None))
            .and_then(|l| l.with_springs(springs.clone()))
            .map_err(|e| line_error(&e, &self.positions))?;
        Ok(self.build_mooring(line, position, surroundings))
    }

    /// A line on the bottom, which is a plane through its anchor or the profile of the bathymetry along its azimuth.
    fn on_bottom(
        &self,
        position: &Placement,
        surroundings: &Surroundings,
        springs: &[Option<StretchLaw>; 2],
    ) -> Result<Mooring, ClassError> {
        let unknown = || {
            ClassError::new("the depth at the anchor is not known")
                .help("give -DEPANCHOR on the class, or -DEPTH on &ENV")
        };
        let depth = match position.other {
            Some([_, _, anchor]) if position.to_ground => -anchor,
            _ => self.anchor_depth(surroundings).ok_or_else(unknown)?,
        };
        let error = |e: LineError| line_error(&e, &self.positions);
        let (segments, joints) = segments_and_joints(&self.sections, position, |s| s.submerged_weight(surroundings));
        let slope = self.slope().unwrap_or(0.0);
        let floor = SeabedModel { elevation: -depth, slope, friction: self.friction() };
        let (distance, azimuth) = position.span();
        let length = segments.iter().map(|s| s.length).sum::<f64>().max(distance);
        let profile = position
            .bathymetry
            .as_ref()
            .zip(position.other)
            .map(|(grid, [x, y, _])| LineProfile::new(grid, [x, y], azimuth, length, self.friction()));
        let line = Line::new(segments, joints, -depth, surroundings.tide)
            .and_then(|l| match &profile {
                Some(profile) => profile.lay(l),
                None => l.with_seabed(Some(floor)),
            })
            .and_then(|l| l.with_springs(springs.clone()))
            .map_err(error)?;
        if depth <= -surroundings.tide {
            return Err(ClassError::new("the anchor lies above the water surface").help("check -DEPANCHOR and -ANCHOR"));
        }
        let [_, _, fairlead] = position.fairlead;
        let flat = slope == 0.0 && profile.is_none();
        if flat && fairlead < -depth {
            return Err(
                ClassError::new("the fairlead lies below the anchor's depth").help("check &INSTATE and -DEPANCHOR")
            );
        }
        let mut made = Mooring { bottom: Some(-depth), ..self.build_mooring(line, position, surroundings) };
        if let Some(known) = surroundings.depth.filter(|d| (d - depth).abs() > 0.2 * d.max(depth) && flat) {
            let share = depth / known;
            made.notes.push(Note::warning(format!("the depth of the anchor is {share:.2} of the depth of &ENV")));
        }
        if let Some(coarse) = profile.as_ref().map(LineProfile::coarseness).filter(|c| *c > 1.0) {
            made.notes.push(Note::warning(format!(
                "the profile under the line has {coarse:.1} times the spacing of the bathymetry"
            )));
        }
        made.profile = profile;
        Ok(made)
    }

    /// The line as a spring along its chord.
    fn chord(
        &self,
        (line, springs): (Mooring, [Option<StretchLaw>; 2]),
        takes_compression: bool,
        surroundings: &Surroundings,
    ) -> Chord {
        let left_out = self.sections.iter().map(|s| s.submerged_weight(surroundings) * s.length).sum();
        Chord { line, springs, takes_compression, left_out }
    }
}

impl ConnectorClass for LineClass {
    fn kind(&self) -> &'static str {
        self.name()
    }

    fn check(&self) -> Outcome<()> {
        if let (Some(last), Some(position)) = (self.sections.last(), self.positions.last())
            && last.clump < 0.0
        {
            return Err(Diagnostic::error("a spring buoy cannot be part of the last segment", *position)
                .label("this segment is attached to ground")
                .help("add the next segment with the same class name, or make CW positive"));
        }
        Ok(())
    }

    fn notices(&self, last: &Args, units: UnitSystem, around: &Surroundings) -> Vec<Diagnostic> {
        (self.kind.notices)(self, last, units, around)
    }

    fn check_ends(&self, connector: &Connector, bodies: usize) -> Outcome<()> {
        checks::ends(self.name(), connector, bodies, 2, self.kind.max_bodies)
    }

    fn properties(&self, name: &str, surroundings: &Surroundings) -> Table {
        let table = properties(name, self.name(), &self.sections, surroundings);
        (self.kind.add_facts)(self, table, surroundings)
    }

    fn element(&self, connection: &Connection) -> Result<Box<dyn ConnectorElement>, ClassError> {
        if self.sections.iter().any(|section| section.needs_dynamics) {
            let text = "a quasi-static line has no dynamic stiffness, which &PARAMETER -STIFFNESS or the column stiffness of a study asks for";
            return Err(
                ClassError::new(text).help("&CONNECTOR -DYNAMICS makes it a dynamic line; LOWER and UPPER act on both")
            );
        }
        if self.devices.is_none() {
            return self.line(&connection.placement, connection.surroundings)?.element();
        }
        let around = connection.surroundings;
        let line = self.mooring(&connection.placement, around, &self.springs)?;
        let line: Box<dyn ExtensibleLine> = match self.form() {
            LineForm::Chord { takes_compression } => {
                let made = (line, self.springs.clone());
                Box::new(ChordElement::new(self.chord(made, takes_compression, around))?)
            }
            LineForm::OnBottom | LineForm::Hanging { .. } => Box::new(LineElement::new(line)?),
        };
        self.devices.element(connection, line)
    }

    fn as_line(&self) -> Option<&dyn StaticLineClass> {
        Some(self)
    }

    fn as_dynamic_line(&self) -> Option<&dyn DynamicLineClass> {
        self.kind.has_dynamics.then_some(self)
    }

    fn as_reeved(&self) -> Option<&dyn ReevedLineClass> {
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

impl ReevedLineClass for LineClass {
    fn reeved_line(&self, layout: ReevedLayout) -> Result<Box<dyn ConnectorElement>, ClassError> {
        Ok(Box::new(ReevedLine::new(layout)?))
    }

    fn may_reeve(&self) -> Result<(), ClassError> {
        let refused = |text: &str| Err(ClassError::new(format!("a {} {text} does not run over a pulley", self.name())));
        match self.form() {
            LineForm::Chord { takes_compression: true } => refused("that also pushes"),
            _ if !self.devices.is_none() => refused("with a piston, a dashpot or a viscoelastic spring"),
            _ if self.is_tabulated() => refused("with a table"),
            LineForm::OnBottom | LineForm::Hanging { .. } | LineForm::Chord { .. } => Ok(()),
        }
    }

    fn straight_segments(&self, placement: &Placement) -> Result<Vec<[f64; 2]>, ClassError> {
        let clump = self.sections.split_last().is_some_and(|(_, before)| before.iter().any(|s| s.clump != 0.0));
        let is_straight = match self.form() {
            LineForm::Chord { takes_compression } => !takes_compression,
            LineForm::Hanging { has_weight } => !has_weight && !clump,
            LineForm::OnBottom => false,
        };
        if !is_straight || self.springs.iter().any(Option::is_some) {
            let text = format!(
                "a {} with weight, clumps or springs is the last span of a line over pulleys alone",
                self.name()
            );
            return Err(ClassError::new(text).help("H_CAT without EXACT is straight and weightless"));
        }
        let (segments, _) = segments_and_joints(&self.sections, placement, |_| 0.0);
        Ok(segments.into_iter().map(|segment| [segment.length, segment.ea]).collect())
    }
}

impl LengthClass for LineClass {
    fn first_length(&self) -> Option<f64> {
        self.sections.first().map(|s| s.length)
    }
}

impl AnchoredClass for LineClass {
    fn anchor_depth(&self, surroundings: &Surroundings) -> Option<f64> {
        self.depth().or(surroundings.depth)
    }
}

impl SegmentedClass for LineClass {
    fn append(&mut self, record: &ClassRecord) -> Outcome<()> {
        let (args, kind) = (&record.args, self.kind);
        if !kind.takes_spring_buoys {
            refuse_spring_buoy(args, kind.spec.name)?;
        }
        let section = LineSection::read(record, kind.spec.name, false)?;
        self.per_line.check(args, kind.per_line)?;
        self.per_line.check(args, &devices::OPTIONS)?;
        let tabulated = self.tabulated.or(args.option_if_declared(&o::TABLE).map(|given| given.span));
        let flag = self.flag.or((kind.flag)(args));
        if let (Some(table), Some(flag)) = (tabulated, flag) {
            return Err(Diagnostic::error("EXACT and -TABLE contradict each other", table)
                .other(flag, "solved exactly")
                .help("leave one of them out; without both the line is solved exactly"));
        }
        if kind.has_dynamics {
            // nothing is refused behind this
            self.flexures.push(Flexure::read(record, &section)?);
        }
        self.sections.push(section);
        self.positions.push(args.option(&o::CLUMP).map_or(args.span, |clump| clump.span));
        (self.tabulated, self.flag) = (tabulated, flag);
        // both take, whatever the first has taken
        if self.per_line.take(args, kind.per_line) | self.per_line.take(args, &devices::OPTIONS) {
            self.seabed = m::parse_seabed(&self.per_line);
            self.springs = end_springs(&self.per_line);
            self.devices = Devices::read(&self.per_line);
        }
        Ok(())
    }

    fn fatigue_segments(&self) -> Vec<FatigueSegment> {
        self.sections.iter().map(LineSection::fatigue).collect()
    }

    fn line_properties(&self, around: &Surroundings, is_dynamic: bool) -> Result<LineProperties, ClassError> {
        let hangs = match self.form() {
            LineForm::OnBottom => false,
            LineForm::Hanging { has_weight: true } => true,
            LineForm::Hanging { has_weight: false } | LineForm::Chord { .. } => {
                let error = ClassError::new("it is a spring without weight along its chord");
                return Err(error.help("EXACT makes it a catenary"));
            }
        };
        if !self.devices.is_none() || self.springs.iter().any(Option::is_some) {
            return Err(ClassError::new("it has springs, pistons or dashpots at its ends"));
        }
        if self.is_tabulated() {
            return Err(ClassError::new("its forces are interpolated in a table").help("leave -TABLE out"));
        }
        let seabed = line_properties::seabed(&self.seabed)?;
        let made = |(section, flexure): (&LineSection, &Flexure)| {
            let elements = usize::try_from(section.refine).ok().filter(|count| *count > 1);
            let mut made = line_properties::segment(&flexure.part(section, 1, around), elements, around.water_density)?;
            // at rest it hangs by its weight in air, whatever it displaces
            if hangs && !is_dynamic {
                made.displaced = 0.0;
            }
            Ok(made)
        };
        let segments = self.sections.iter().zip(&self.flexures).map(made).collect::<Result<_, ClassError>>()?;
        Ok(LineProperties { segments, seabed: (!hangs || is_dynamic).then_some(seabed) })
    }
}

impl StaticLineClass for LineClass {
    fn line(&self, position: &Placement, surroundings: &Surroundings) -> Result<Box<dyn LineModel>, ClassError> {
        let springs = with_series(&self.springs, self.devices.convolution.as_ref(), position)?;
        let mut line = self.mooring(position, surroundings, &springs)?;
        line.notes.extend(self.devices.notes());
        Ok(match self.form() {
            LineForm::Chord { takes_compression } => {
                Box::new(self.chord((line, springs), takes_compression, surroundings))
            }
            LineForm::OnBottom | LineForm::Hanging { .. } => Box::new(line),
        })
    }

    fn seabed(&self) -> StaticSeabed {
        match (self.depth(), self.slope()) {
            _ if !self.is_on_bottom() => StaticSeabed::None,
            (None, None) => StaticSeabed::Bathymetry,
            _ => StaticSeabed::Plane,
        }
    }

    fn is_tabulated(&self) -> bool {
        self.tabulated.is_some()
    }

    fn series_curve(&self) -> Option<(&str, Span)> {
        self.devices.convolution.as_ref().map(|(name, span)| (name.as_str(), *span))
    }
}

impl DynamicLineClass for LineClass {
    fn dynamic_line(&self, connection: &Connection, elements: usize) -> Result<Box<dyn ConnectorElement>, ClassError> {
        let plain = self.devices.is_none() && self.springs.iter().all(Option::is_none);
        let made = (self.sections.as_slice(), self.flexures.as_slice());
        let seabed = Seabed { with_anchor: self.is_on_bottom(), ..self.seabed };
        let made = m::describe_chain((self.name(), plain), made, seabed, elements, connection.surroundings)?;
        Ok(Box::new(DynamicLine::build(made, connection)?))
    }

    fn has_sloped_seabed(&self) -> bool {
        self.seabed.slopes()
    }
}

/// Refuses a negative -CLUMP.
fn refuse_spring_buoy(args: &Args, kind: &str) -> Outcome<()> {
    let weight = |clump: &windlass_base::values::Given| clump.number(const { o::CLUMP.number("CW") });
    match args.option(&o::CLUMP).filter(|clump| weight(clump).is_some_and(|w| w < 0.0)) {
        Some(clump) => {
            Err(Diagnostic::error(format!("class type {kind} takes no spring buoy"), clump.span).help("use B_CAT"))
        }
        None => Ok(()),
    }
}
