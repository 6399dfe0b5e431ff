//! SL_ELEM: a spring along the chord between its ends, both ways or in tension only.
//!
//! Source: [MOSES-FLEX SL_ELEM].

use super::chord::{Chord, ChordElement};
use super::devices::Devices;
use super::dynamic_line as m;
use super::h_cat::{LINE_OPTIONS, PER_LINE, check_record, hung};
use super::mooring::{end_springs, with_series};
use super::per_line::PerLineOptions;
use super::section::{LineSection, properties, short};
use super::{ClassKind, append_all, checks, options as o};
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::table::Table;
use windlass_base::units::{Dim, UnitSystem};
use windlass_base::values::Args;
use windlass_catenary::StretchLaw;
use windlass_language::spec::{CommandSpec, OptionSpec, ValueSpec};
use windlass_model::{
    ClassError, ClassRecord, Connection, Connector, ConnectorClass, Element, FatigueSegment, LineModel, Note,
    Placement, Surroundings,
};

/// The class type.
pub static SL_ELEM: ClassKind =
    ClassKind { spec: &SL_ELEM_SPEC, segmented: true, build: append_all::<Spring>, idle: IDLE };

/// Options that do nothing in a spring along a chord.
const IDLE: &[(OptionSpec, &str)] = &[
    (o::WTPLEN, ""),
    (o::DISPLEN, ""),
    (o::DENSITY, ""),
    (o::SPGRAVITY, ""),
    (o::BUOYDIAMETER, ""),
    (o::DRAGDIAMETER, ""),
    (o::WINDDIAMETER, ""),
    (o::AMASDIAMETER, ""),
    (o::POI_RAT, ""),
    (o::ALPHA, ""),
    (o::REFINE, ""),
    (o::CLUMP, ""),
    (m::CD, ""),
    (m::CA, ""),
    (m::AX_DAMPING, ""),
    (m::SEABED, ""),
];

choices! {
    /// The flag of a straight line.
    enum BarFlag {
        /// It only pulls.
        Tension = "TENSION",
    }
}

static SL_ELEM_SPEC: CommandSpec = CommandSpec {
    data: &[o::LINE_OD, ValueSpec::choice::<BarFlag>("FLAG", "tension only").or("tension and compression")],
    detail: "Its force depends only on the distance between the ends and acts along the line between them: it has no weight. H_CAT EXACT has. -PISTON is a link of its position less LD between the first end and the line, in the direction of the tension; it has no weight. \
             MAX stands as near to LD as TMAX allows; MINMAX stays where it is between TMIN and TMAX. While it can follow, the tension \
             stays at the limit without stiffness along it; beyond VLONG, VSHORT or the stroke (0 to LT) it departs. At rest the piston \
             has slid from LD as far as it must. A table or a shape of the line is at LD. The piston does not feel the dashpot of \
             -X_DAMPING, which also pushes while the ends come nearer.",
    example: "MEDIT\n~TIE SL_ELEM 3 TENSION -LEN 50\nEND\n&STATUS CLASS ~TIE",
    options: LINE_OPTIONS,
    ..CommandSpec::new("SL_ELEM", "spring along the chord between its ends")
};

#[derive(Debug, Default)]
struct Spring {
    per_line: PerLineOptions,
    sections: Vec<LineSection>,
    places: Vec<Span>,
    tension: bool,
    springs: [Option<StretchLaw>; 2],
    devices: Devices,
    limit: Option<f64>,
    notes: Vec<Note>,
}

impl ConnectorClass for Spring {
    fn kind(&self) -> &'static str {
        "SL_ELEM"
    }

    fn append(&mut self, record: &ClassRecord) -> Outcome<()> {
        let args = &record.args;
        check_record(&self.per_line, args, "SL_ELEM")?;
        let section = LineSection::read(record, "SL_ELEM", false)?;
        // nothing is refused from here on
        if section.clump != 0.0 && self.notes.is_empty() {
            self.notes.push(Note::warning("-CLUMP does not act on an SL_ELEM, which is straight"));
        }
        self.sections.push(section);
        self.places.push(args.span);
        self.tension |= match args.choice(const { SL_ELEM_SPEC.choice("FLAG") }) {
            Some(BarFlag::Tension) => true,
            None => false,
        };
        if self.per_line.take(args, &PER_LINE) {
            self.springs = end_springs(&self.per_line);
            self.devices = Devices::read(&self.per_line);
            self.limit = self.per_line.number(&o::TAB_LIM);
        }
        Ok(())
    }

    fn notices(&self, last: &Args, units: UnitSystem, around: &Surroundings) -> Vec<Diagnostic> {
        let [only] = self.sections.as_slice() else { return Vec::new() };
        let weight = only.submerged_weight(around) * only.length;
        if weight == 0.0 {
            return Vec::new();
        }
        let text = format!("an SL_ELEM has no weight: {} in water are left out", short(weight, Dim::Force, units));
        vec![*Diagnostic::remark(text, last.span).help("H_CAT EXACT has its weight, ROD bends as well")]
    }

    fn check_ends(&self, connector: &Connector, bodies: usize) -> Outcome<()> {
        checks::ends("SL_ELEM", connector, bodies, 2, 2)
    }

    fn fatigue_segments(&self) -> Vec<FatigueSegment> {
        self.sections.iter().map(LineSection::fatigue).collect()
    }

    fn properties(&self, name: &str, surroundings: &Surroundings) -> Table {
        let flag = if self.tension { "TENSION" } else { "tension and compression" };
        let mut table = properties(name, "SL_ELEM", &self.sections, surroundings).fact("Flag", flag, Dim::None);
        table.note("an SL_ELEM has no weight: those above are not used");
        table
    }

    fn first_length(&self) -> Option<f64> {
        self.sections.first().map(|s| s.length)
    }

    fn anchor_depth(&self, surroundings: &Surroundings) -> Option<f64> {
        surroundings.depth
    }

    fn series_curve(&self) -> Option<(&str, Span)> {
        self.devices.convolution.as_ref().map(|(name, span)| (name.as_str(), *span))
    }

    fn is_line(&self) -> bool {
        true
    }

    fn line(&self, place: &Placement, surroundings: &Surroundings) -> Result<Box<dyn LineModel>, ClassError> {
        let springs = with_series(&self.springs, self.devices.convolution.as_ref(), place)?;
        let mut chord = self.build_line(place, surroundings, springs)?;
        chord.line.notes.extend(self.devices.notes());
        Ok(Box::new(chord))
    }

    fn element(&self, connection: &Connection) -> Result<Box<dyn Element>, ClassError> {
        let chord = self.build_line(&connection.placement, connection.surroundings, self.springs.clone())?;
        let line = Box::new(ChordElement::new(chord)?);
        if self.devices.is_none() { Ok(line) } else { self.devices.element(connection, line) }
    }
}

impl Spring {
    /// The spring with these at its ends.
    fn build_line(
        &self,
        place: &Placement,
        surroundings: &Surroundings,
        springs: [Option<StretchLaw>; 2],
    ) -> Result<Chord, ClassError> {
        let straight: Vec<LineSection> = self.sections.iter().map(|s| LineSection { clump: 0.0, ..*s }).collect();
        let mut line = hung(&straight, &springs, place, surroundings, &self.places, |_| 0.0)?;
        line.largest = self.limit.unwrap_or(line.largest);
        line.notes.clone_from(&self.notes);
        let left_out = straight.iter().map(|s| s.submerged_weight(surroundings) * s.length).sum();
        Ok(Chord { line, springs, pushes: !self.tension, left_out })
    }
}
