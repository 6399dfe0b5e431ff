//! ROD: a line with bending stiffness and its own dynamics.
//!
//! Source: [MOSES-FLEX ROD]. MOSES treats rods as an assembly of large deflection tubular beam elements with inertia; the engine is `windlass_line_dynamics`.

use super::dynamic_line::{self as m, DynamicLine, EndFixity, Flexure, LineDescription, LinePart, Seabed};
use super::line_properties;
use super::per_line::PerLineOptions;
use super::section::{LineSection, properties};
use super::{ClassKind, append_all, checks, options as o};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::Table;
use windlass_base::values::Given;
use windlass_language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec, count_options, join_lists};
use windlass_model::{
    AnchoredClass, ClassError, ClassRecord, Connection, Connector, ConnectorClass, ConnectorElement, DynamicLineClass,
    FatigueSegment, Idealisation, LengthClass, LineProperties, PipeClass, PipeLayout, SegmentedClass, Surroundings,
};

/// The class type.
pub static ROD: ClassKind = ClassKind { spec: &ROD_SPEC, build: append_all::<RodClass>, idle: &[] };

const NO_TORSION: &str = "a rod has no torsion";
const NO_SHEAR: &str = "a rod does not deform in shear (Euler and Bernoulli)";
const ONE_BENDING: &str = "a rod has one bending stiffness in all directions, -EI";

const ROD_LISTS: &[&[OptionSpec]] = &[
    &[o::LEN, REFINE, o::IG_STIFF],
    &o::SEGMENT,
    &[o::EA_BOUNDS, o::CLUMP],
    &o::DIAMETERS,
    &[
        o::FRICTION,
        o::SLOPE,
        o::DEPANCHOR,
        m::CD,
        m::CA,
        o::EI,
        m::EA,
        m::STRETCH,
        m::AX_DAMPING,
        m::ROPE,
        m::SLAM,
        m::CLUMP_DRAG,
        m::CLAMP,
        m::SEABED,
        m::VERTICAL_PUSH,
        m::MID_TENSION,
    ],
];

static ROD_OPTIONS: [OptionSpec; count_options(ROD_LISTS)] = join_lists(ROD_LISTS);

static ROD_SPEC: CommandSpec = CommandSpec {
    data: &o::TUBE,
    options: &ROD_OPTIONS,
    absent: &[
        ("-GJ", NO_TORSION),
        ("-TORSION", NO_TORSION),
        ("-CURVATURE", "a rod is straight without load"),
        ("-SHEAR", NO_SHEAR),
        ("-GA", NO_SHEAR),
        ("-EIY", ONE_BENDING),
        ("-EIZ", ONE_BENDING),
        ("-MOMENT", "its ends are pinned, or held by -CLAMP; a moment at an end cannot be given"),
    ],
    detail: "Large-deflection tubular elements with inertia, first record at the first end. -REFINE cuts a segment into elements; \
             MOSES allows 300 over all segments, here memory is the limit. The rod feels waves, current, wind, growth and bottom along itself, at rest without \
             the waves. Its weight is that of -WTPLEN or of the wall, empty; what is in it comes by -T_PRESSURE of &ENV. -EI 0 makes a chain or rope, which \
             neither pushes nor bends; with a bore it keeps its wall: contents, heat and pressure act. -CLUMP is a weight in water, taken as a mass without volume; negative: a buoy without mass, CLEN above the line. -ROPE: a standard linear solid. Its ends turn freely but for -CLAMP. \
             Per line, on any record: -FRICTION, -SLOPE, -DEPANCHOR, -SEABED, -VERTICAL_PUSH, -CLAMP. No convolution.",
    example: "MEDIT\n~PIPE ROD 12.75 0.5 -LEN 1000 -REFINE 50\nEND\n&STATUS CLASS ~PIPE",
    ..CommandSpec::new("ROD", "line with bending stiffness and its own dynamics")
};

/// `-REFINE N`, without the limit of what other classes cut: how many elements are too many is reported with the memory they take.
const REFINE: OptionSpec =
    OptionSpec { values: &[ValueSpec::new("N", Kind::Integer, "number of elements").positive()], ..o::REFINE };
/// Options of the whole line.
const PER_LINE: [OptionSpec; 5] = [m::SEABED, m::VERTICAL_PUSH, o::FRICTION, o::SLOPE, o::DEPANCHOR];
/// Most elements of a line: the limit of the engine.
const MAX_ELEMENTS: i64 = windlass_line_dynamics::MAX_ELEMENTS as i64;

#[derive(Debug, Default)]
struct RodClass {
    per_line: PerLineOptions,
    /// Every `-CLAMP`: two at most.
    clamps: Vec<Given>,
    /// Elements of all segments.
    elements: i64,
    sections: Vec<LineSection>,
    flexures: Vec<Flexure>,
    seabed: Seabed,
    holds: [Option<EndFixity>; 2],
    slam: bool,
    has_middle_end_tension: bool,
}

impl RodClass {
    fn description(&self, around: &Surroundings) -> LineDescription {
        let count = |s: &LineSection| usize::try_from(s.refine).unwrap_or(1).max(1);
        let part = |(s, f): (&LineSection, &Flexure)| -> LinePart { f.part(s, count(s), around) };
        let parts = self.sections.iter().zip(&self.flexures).map(part).collect();
        let mut made = m::description("ROD", parts, self.seabed, self.holds);
        if self.has_middle_end_tension {
            made.notes
                .push("the tension at its ends is that in the middle of its end elements: -MID_TENSION".to_string());
        }
        LineDescription { slam: self.slam, has_middle_end_tension: self.has_middle_end_tension, ..made }
    }
}

impl ConnectorClass for RodClass {
    fn kind(&self) -> &'static str {
        "ROD"
    }

    fn check_ends(&self, connector: &Connector, bodies: usize) -> Outcome<()> {
        checks::ends("ROD", connector, bodies, 2, 2)
    }

    fn properties(&self, name: &str, surroundings: &Surroundings) -> Table {
        // its law of stretch may be another than that of the tube
        let shown = |(section, flexure): (&LineSection, &Flexure)| LineSection { ea: flexure.ea(), ..*section };
        let sections: Vec<LineSection> = self.sections.iter().zip(&self.flexures).map(shown).collect();
        properties(name, "ROD", &sections, surroundings)
    }

    fn idealisation(&self) -> Idealisation {
        Idealisation::Dynamic
    }

    fn element(&self, connection: &Connection) -> Result<Box<dyn ConnectorElement>, ClassError> {
        Ok(Box::new(DynamicLine::build(self.description(connection.surroundings), connection)?))
    }

    fn as_dynamic_line(&self) -> Option<&dyn DynamicLineClass> {
        Some(self)
    }

    fn as_pipe(&self) -> Option<&dyn PipeClass> {
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

impl LengthClass for RodClass {
    fn first_length(&self) -> Option<f64> {
        self.sections.first().map(|s| s.length)
    }

    fn is_adjustable(&self) -> bool {
        true
    }
}

impl AnchoredClass for RodClass {
    fn anchor_depth(&self, surroundings: &Surroundings) -> Option<f64> {
        self.seabed.depth.or(surroundings.depth)
    }
}

impl SegmentedClass for RodClass {
    fn append(&mut self, record: &ClassRecord) -> Outcome<()> {
        let args = &record.args;
        let section = LineSection::read(record, "ROD", true)?;
        if section.weight <= 0.0 {
            let given = [o::WTPLEN, o::DENSITY, o::SPGRAVITY].iter().find_map(|option| args.option(option));
            let span = given.map_or(args.span, |g| g.span);
            return Err(Diagnostic::error("a ROD needs weight: its mass is what it moves by", span)
                .label(format!("{} N/m", section.weight)));
        }
        let elements = self.elements.saturating_add(section.refine);
        if elements > MAX_ELEMENTS {
            let span = args.option(&o::REFINE).map_or(args.span, |g| g.span);
            let megabytes = elements as f64 * windlass_line_dynamics::BYTES_PER_ELEMENT / 1e6;
            return Err(Diagnostic::error(format!("a ROD has at most {MAX_ELEMENTS} elements"), span)
                .label(format!("with this segment it has {elements}, which would take about {megabytes:.0} MB")));
        }
        let flexure = Flexure::read(record, &section)?;
        let mut clamps = self.clamps.clone();
        clamps.extend(args.occurrences(&m::CLAMP).cloned());
        let holds = m::read_end_fixities(&clamps, [self.flexures.first().unwrap_or(&flexure), &flexure])?;
        self.per_line.check(args, &PER_LINE)?;
        // nothing is refused from here on
        self.sections.push(section);
        self.flexures.push(flexure);
        (self.clamps, self.holds, self.elements) = (clamps, holds, elements);
        self.slam |= args.has(&m::SLAM);
        self.has_middle_end_tension |= args.has(&m::MID_TENSION);
        if self.per_line.take(args, &PER_LINE) {
            self.seabed = m::parse_seabed(&self.per_line);
        }
        Ok(())
    }

    fn fatigue_segments(&self) -> Vec<FatigueSegment> {
        self.sections.iter().map(LineSection::fatigue).collect()
    }

    fn line_properties(&self, around: &Surroundings, _: bool) -> Result<LineProperties, ClassError> {
        if self.holds.iter().any(Option::is_some) {
            return Err(ClassError::new("-CLAMP holds its ends in their direction").help("a line of a deck is hinged"));
        }
        if self.slam {
            return Err(ClassError::new("it is slammed where it enters the water").help("leave -SLAM out"));
        }
        let seabed = line_properties::seabed(&self.seabed)?;
        let parts = self.description(around).parts;
        let made = |part: &LinePart| line_properties::segment(part, Some(part.segment.elements), around.water_density);
        let segments = parts.iter().map(made).collect::<Result<_, ClassError>>()?;
        Ok(LineProperties { segments, seabed: Some(seabed) })
    }
}

impl DynamicLineClass for RodClass {
    fn has_sloped_seabed(&self) -> bool {
        self.seabed.slopes()
    }

    fn dynamic_line(&self, _: &Connection, _: usize) -> Result<Box<dyn ConnectorElement>, ClassError> {
        Err(ClassError::new("a ROD is a dynamic line already")
            .help("-REFINE of its class says into how many elements it is cut"))
    }
}

impl PipeClass for RodClass {
    /// A pipe of the first segment's section, as long as it needs to be.
    fn pipe(&self, layout: PipeLayout) -> Result<Box<dyn ConnectorElement>, ClassError> {
        Ok(Box::new(DynamicLine::build_pipe(self.description(layout.surroundings), layout)?))
    }
}
