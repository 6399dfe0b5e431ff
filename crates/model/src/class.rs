//! Classes: what a connector is made of, and what a connector class can be asked.

use super::assembly::{PipeLayout, ReevedLayout};
use super::connector::Connector;
use super::defaults::Defaults;
use super::element::{Connection, ConnectorElement};
use super::environment::Surroundings;
use super::fatigue::FatigueSegment;
use super::idealisation::Idealisation;
use super::line::{LineModel, Placement};
use super::line_properties::LineProperties;
use super::member_section::MemberSection;
use super::tether::TetherSection;
use crate::options::{C_SN, EI, EMODULUS, FYIELD, IG_STIFF, POI_RAT, TENSTR};
use std::fmt::Debug;
use std::sync::Arc;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::message::Message;
use windlass_base::span::Span;
use windlass_base::table::Table;
use windlass_base::units::{Dim, ForceUnit, LengthUnit, UnitSystem, eight_figures};
use windlass_base::values::Args;

/// One record of a class: SI values with their places, and the defaults in force when it was read.
#[derive(Clone, Debug, PartialEq)]
pub struct ClassRecord {
    /// The record's data and options.
    pub args: Args,
    /// Defaults at the time of the record.
    pub defaults: Defaults,
}

/// A class: its records, fairlead first, and the object built of them.
#[derive(Clone, Debug)]
pub struct Class {
    /// Its name as written, with its `~`.
    pub name: String,
    /// Its records in order.
    pub records: Vec<ClassRecord>,
    /// Whether its stiffness is left out of what is reported of the bodies beside the one of a connector [MOSES-FLEX -IG_STIFF];
    /// its force is not.
    pub ignored_stiffness: bool,
    /// What the records make.
    pub object: Arc<dyn ConnectorClass>,
    /// Where it was first defined.
    pub span: Span,
}

impl Class {
    /// Adds the segment of a further record. `build` makes the object anew where a copy of the model shares it.
    ///
    /// # Errors
    /// As [`SegmentedClass::append`]; the class is then as it was.
    pub fn append(
        &mut self,
        record: ClassRecord,
        build: fn(&[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>>,
    ) -> Outcome<()> {
        match Arc::get_mut(&mut self.object).and_then(|object| object.as_segmented_mut()) {
            Some(object) => object.append(&record)?,
            None => {
                let all: Vec<ClassRecord> = self.records.iter().chain([&record]).cloned().collect();
                self.object = build(&all)?;
            }
        }
        self.ignored_stiffness |= record.args.option_if_declared(&IG_STIFF).is_some();
        self.records.push(record);
        Ok(())
    }

    /// What fatigue goes by in each segment, from the fairlead: one a record, with the curve of its `-C_SN`; none of a class
    /// without sections.
    pub fn fatigue_segments(&self) -> Vec<FatigueSegment> {
        let mut segments = self.object.as_segmented().map_or_else(Vec::new, |class| class.fatigue_segments());
        for (segment, record) in segments.iter_mut().zip(&self.records) {
            segment.curve = record.args.option_if_declared(&C_SN).and_then(|g| g.first_word()).map(str::to_string);
        }
        segments
    }
}

/// What the wall of a tube is made of, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallMaterial {
    /// Yield stress (Pa).
    pub yield_stress: f64,
    /// Tensile strength (Pa).
    pub tensile: f64,
    /// Young's modulus (Pa).
    pub modulus: f64,
    /// Poisson's ratio.
    pub poisson: f64,
}

impl Class {
    /// The bending stiffness of its segments by `-EI` (N m2), one a record; `None` where it is that of the section.
    pub fn given_bending_stiffnesses(&self) -> impl Iterator<Item = Option<f64>> {
        self.records.iter().map(|record| record.args.number_if_declared(&EI))
    }

    /// What the walls of its segments are made of, one a record: of its options, else of `&DEFAULT` when it was read.
    pub fn wall_materials(&self) -> Vec<WallMaterial> {
        let of = |record: &ClassRecord| {
            let usual = &record.defaults.material;
            let number = |option| record.args.number_if_declared(option);
            let given = number(&FYIELD);
            // as the break of a section: without a strength of its own, yield / 0.6
            let by_yield = given.map(|y| y / 0.6);
            WallMaterial {
                yield_stress: given.unwrap_or(usual.yield_stress),
                tensile: number(&TENSTR).or(by_yield).unwrap_or(usual.ultimate()),
                modulus: number(&EMODULUS).unwrap_or(usual.emodulus),
                poisson: number(&POI_RAT).unwrap_or(usual.poisson),
            }
        };
        self.records.iter().map(of).collect()
    }
}

/// Why a class could not answer.
#[derive(Clone, Debug, PartialEq)]
pub struct ClassError {
    /// One sentence for the user.
    pub message: Message,
    /// The record or value it is about, where one can be named.
    pub span: Option<Span>,
    /// What to change.
    pub help: Vec<String>,
    /// Whether a run meets it again with any smaller step.
    pub lasting: bool,
}

impl std::fmt::Display for ClassError {
    /// The sentence in metres and newtons.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let si = UnitSystem { length: LengthUnit::Meters, force: ForceUnit::Newtons };
        f.write_str(&self.text(si))
    }
}

impl std::error::Error for ClassError {}

impl ClassError {
    /// An error with a message alone.
    pub fn new(message: impl Into<Message>) -> Self {
        ClassError { message: message.into(), span: None, help: Vec::new(), lasting: false }
    }

    /// An error that names values: `{}` in the message stands for each.
    pub fn with_values(message: impl AsRef<str>, values: &[(f64, Dim)]) -> Self {
        ClassError::new(Message::with_values(message, values))
    }

    /// The sentence with its values in these units.
    pub fn text(&self, units: UnitSystem) -> String {
        self.message.text(units, eight_figures)
    }

    /// The same about a subject: `subject: sentence`.
    pub fn with_subject(self, subject: impl Into<Message>) -> Self {
        ClassError { message: self.message.with_subject(subject), ..self }
    }

    /// The same at a place.
    pub fn with_span(self, span: Span) -> Self {
        ClassError { span: Some(span), ..self }
    }

    /// The same with advice.
    pub fn help(mut self, text: impl Into<String>) -> Self {
        self.help.push(text.into());
        self
    }

    /// The same as one that no smaller step of a run gets round.
    pub fn lasting(self) -> Self {
        ClassError { lasting: true, ..self }
    }

    /// The message for the user; it points at `fallback` when the error has no place of its own.
    pub fn diagnostic(self, fallback: Span, units: UnitSystem) -> Box<Diagnostic> {
        let mut made = Diagnostic::error(self.text(units), self.span.unwrap_or(fallback));
        made.help.extend(self.help);
        made
    }
}

/// What a class is for beside a force between two points: which tables, checks and assemblies take its connectors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ClassRole {
    /// Nothing else.
    #[default]
    Connector,
    /// A FOUNDATION check reports it: the ratio and the springs of its summaries [MOSES-FLEX FOUNDATION].
    Foundation,
    /// A fender: its summaries have a [`super::FenderState`].
    Fender,
    /// A pipe lies on it.
    PipeRoller,
    /// A pipe hangs from it.
    PipeDavit,
    /// It is a line of a tip-hook set.
    Sling,
}

/// What every connector class answers. What only some classes can make are traits of their own, which the accessors `as_..` give.
pub trait ConnectorClass: Debug + Send + Sync {
    /// The class type, e.g. `B_CAT`.
    fn kind(&self) -> &'static str;

    /// Whether the class is complete enough to be used by a connector (a spring buoy needs a further segment, ...).
    ///
    /// # Errors
    /// What is missing or contradicts itself, at its place.
    fn check(&self) -> Outcome<()> {
        Ok(())
    }

    /// What the writer of the last record should know: notes and warnings at its words, values in these units.
    fn notices(&self, _last: &Args, _: UnitSystem, _: &Surroundings) -> Vec<Diagnostic> {
        Vec::new()
    }

    /// Whether a connector of this class fits its ends: number of points, and how many of them are on bodies.
    ///
    /// # Errors
    /// What does not fit.
    fn check_ends(&self, connector: &Connector, bodies: usize) -> Outcome<()>;

    /// The properties of the class as `&STATUS CLASS` prints them; one row a segment or degree of freedom.
    fn properties(&self, name: &str, surroundings: &Surroundings) -> Table;

    /// What a connector of this class is to an engine.
    ///
    /// # Errors
    /// A class whose connectors an assembly takes care of, or values that make none here.
    fn element(&self, connection: &Connection) -> Result<Box<dyn ConnectorElement>, ClassError>;

    /// Whether its connectors are lines between two ends, which reports of the angles of lines list; dynamic lines always are.
    fn is_line(&self) -> bool {
        self.as_line().is_some()
    }

    /// What the class is for beside.
    fn role(&self) -> ClassRole {
        ClassRole::Connector
    }

    /// How its connectors are idealised where `&CONNECTOR -DYNAMICS` says nothing else.
    fn idealisation(&self) -> Idealisation {
        if self.as_line().is_some() { Idealisation::QuasiStatic } else { Idealisation::Massless }
    }

    /// The class as one of connectors with a length.
    fn as_length(&self) -> Option<&dyn LengthClass> {
        None
    }

    /// The class as one of lines that go to an anchor.
    fn as_anchored(&self) -> Option<&dyn AnchoredClass> {
        None
    }

    /// The class as one of tethers.
    fn as_tether(&self) -> Option<&dyn TetherSectionsClass> {
        None
    }

    /// The sections of a class of structural members, from the first end.
    fn as_members(&self) -> Option<&[MemberSection]> {
        None
    }

    /// The class as one of segments: a repeated class name adds one. A record of any other class replaces it.
    fn as_segmented(&self) -> Option<&dyn SegmentedClass> {
        None
    }

    /// The same, to be changed.
    fn as_segmented_mut(&mut self) -> Option<&mut dyn SegmentedClass> {
        None
    }

    /// The class as one of quasi-static lines.
    fn as_line(&self) -> Option<&dyn StaticLineClass> {
        None
    }

    /// The class as one of dynamic lines.
    fn as_dynamic_line(&self) -> Option<&dyn DynamicLineClass> {
        None
    }

    /// The class as one of pipes.
    fn as_pipe(&self) -> Option<&dyn PipeClass> {
        None
    }

    /// The class as one whose connectors are spans of a line over pulleys or off a drum.
    fn as_reeved(&self) -> Option<&dyn ReevedLineClass> {
        None
    }
}

/// A class of segments in series, one a record, fairlead first.
pub trait SegmentedClass {
    /// Adds the segment of a further record; one that is refused changes nothing.
    ///
    /// # Errors
    /// What the record lacks, or how it contradicts those before it.
    fn append(&mut self, record: &ClassRecord) -> Outcome<()>;

    /// What fatigue goes by in each segment, without curves; none of a class without sections.
    fn fatigue_segments(&self) -> Vec<FatigueSegment> {
        Vec::new()
    }

    /// A line of it in numbers, for the decks of other programs; `is_dynamic` where `&CONNECTOR -DYNAMICS` makes it a dynamic one.
    ///
    /// # Errors
    /// What those numbers cannot say.
    fn line_properties(&self, _surroundings: &Surroundings, _is_dynamic: bool) -> Result<LineProperties, ClassError> {
        Err(ClassError::new("its class has no counterpart"))
    }
}

/// A class of connectors with a length.
pub trait LengthClass {
    /// Unstretched length of the first segment (m), which a connector may have its own of; none of a tie without a segment.
    fn first_length(&self) -> Option<f64>;

    /// Whether `&CONNECTOR` may give its connectors another length though it makes no quasi-static line.
    fn is_adjustable(&self) -> bool {
        false
    }
}

/// A class of lines that go to an anchor in the ground.
pub trait AnchoredClass {
    /// Depth of the anchor below z = 0 (m): of the class, else of the bottom; none where neither is known.
    fn anchor_depth(&self, surroundings: &Surroundings) -> Option<f64>;
}

/// A class of tethers.
pub trait TetherSectionsClass {
    /// Its sections, from the fairlead.
    fn sections(&self) -> &[TetherSection];
}

/// The bottom that a quasi-static line lies on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StaticSeabed {
    /// It sees none.
    None,
    /// A plane through its own anchor.
    Plane,
    /// The bathymetry of the environment; a plane through its own anchor where there is none below it.
    Bathymetry,
}

/// A class of mooring lines that have the shape of rest between their ends.
pub trait StaticLineClass {
    /// The line a connector of this class makes between two places.
    ///
    /// # Errors
    /// Values that make none here.
    fn line(&self, position: &Placement, surroundings: &Surroundings) -> Result<Box<dyn LineModel>, ClassError>;

    /// The bottom that its lines lie on.
    fn seabed(&self) -> StaticSeabed;

    /// Whether the forces of its lines are interpolated in a table, not solved: reports name them.
    fn is_tabulated(&self) -> bool {
        false
    }

    /// The convolution curve of a viscoelastic spring in series, where the class names one, with its place.
    fn series_curve(&self) -> Option<(&str, Span)> {
        None
    }
}

/// A class of which connectors can be dynamic lines.
pub trait DynamicLineClass {
    /// A connector of this class as a dynamic line, cut into about so many elements.
    ///
    /// # Errors
    /// Values that make no such line.
    fn dynamic_line(&self, connection: &Connection, elements: usize) -> Result<Box<dyn ConnectorElement>, ClassError>;

    /// Whether its dynamic lines lie on a plane bottom that the class slopes.
    fn has_sloped_seabed(&self) -> bool {
        false
    }
}

/// A class whose connectors are spans of a line over pulleys or off a drum.
pub trait ReevedLineClass {
    /// A span of a line over pulleys, as an engine sees it.
    ///
    /// # Errors
    /// A layout that makes no such line.
    fn reeved_line(&self, layout: ReevedLayout) -> Result<Box<dyn ConnectorElement>, ClassError>;

    /// Whether its connectors can be such spans at all.
    ///
    /// # Errors
    /// Why not.
    fn may_reeve(&self) -> Result<(), ClassError>;

    /// The segments of a span that is straight and weightless, from its first end: unstretched lengths (m) and axial stiffnesses (N).
    ///
    /// # Errors
    /// A span that is neither, and why.
    fn straight_segments(&self, placement: &Placement) -> Result<Vec<[f64; 2]>, ClassError>;
}

/// A class of which an assembly makes a pipe.
pub trait PipeClass {
    /// The pipe.
    ///
    /// # Errors
    /// A layout that makes no pipe.
    fn pipe(&self, layout: PipeLayout) -> Result<Box<dyn ConnectorElement>, ClassError>;
}

impl Class {
    /// Unstretched length of the first segment (m); none of a class without length.
    pub fn first_length(&self) -> Option<f64> {
        self.object.as_length()?.first_length()
    }

    /// The sections of a tether from the fairlead; none of other classes.
    pub fn tether_sections(&self) -> &[TetherSection] {
        self.object.as_tether().map_or(&[], |class| class.sections())
    }

    /// The quasi-static line that a connector of this class makes between two places.
    ///
    /// # Errors
    /// A class that makes none, or values that make none here.
    pub fn line(&self, position: &Placement, surroundings: &Surroundings) -> Result<Box<dyn LineModel>, ClassError> {
        if let Some(class) = self.object.as_line() {
            return class.line(position, surroundings);
        }
        let kind = self.object.kind();
        if self.object.idealisation() == Idealisation::Dynamic {
            let error = ClassError::new(format!("a line of class type {kind} is a dynamic line: it has no table"));
            return Err(error.help("MOVE and &CONNECTOR -L_HORIZONTAL and -L_TENSION take it as it is"));
        }
        Err(ClassError::new(format!("a connector of class type {kind} is no mooring line")))
    }

    /// A connector of this class as a dynamic line, cut into about so many elements.
    ///
    /// # Errors
    /// A class without dynamics of its own, or values that make no such line.
    pub fn dynamic_line(
        &self,
        connection: &Connection,
        elements: usize,
    ) -> Result<Box<dyn ConnectorElement>, ClassError> {
        let class = self.object.as_dynamic_line().ok_or_else(|| {
            ClassError::new(format!("a connector of class type {} has no dynamics of its own", self.object.kind()))
        })?;
        class.dynamic_line(connection, elements)
    }
}
