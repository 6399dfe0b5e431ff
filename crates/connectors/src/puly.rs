//! PULY: an elastic line from its first end over a pulley, the second end, to a point that the pulley's own body carries.
//!
//! Source: [AQWA-REF LINE, PULY]. The span behind the pulley keeps its length l2; the other has the distance l1 of the ends. Without friction the tension
//! is T = k (l1 + l2 - L) in both. With a ratio R of the tensions of a line that runs, T1/T2 is R where l1 grows and 1/R where it falls, and the stretch is shared:
//! T1 l1 + T2 l2 = k (l1 + l2 - L) (l1 + l2). The pulley is a point. Both spans pull on its body at the pulley and at the far point, which leaves T1 at the pulley.

use super::ClassKind;
use super::options::aqwa;
use super::taut_span::{SpanElement, SpanLaw, SpanTension, TautSpan, check_span_ends, smooth_step};
use std::sync::Arc;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec};
use windlass_model::{
    ClassError, ClassRecord, Connection, Connector, ConnectorClass, ConnectorElement, Note, Surroundings,
};

/// The class type.
pub static PULY: ClassKind = ClassKind { spec: &SPEC, build, idle: &[] };

/// Speed of the line (m/s) at which friction is fully mobilised, as of a CT_LINE.
const FULL_FRICTION_SPEED: f64 = 0.01;

const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}

const RATIO: OptionSpec = aqwa(
    "-RATIO",
    &[number("R", Dim::None, "ratio").in_range(1.0, 100.0)],
    "ratio of the tensions of a line that runs over the pulley; 1 at rest",
)
.default("1");

static SPEC: CommandSpec = CommandSpec {
    owner: Owner::Aqwa,
    data: &[
        number("K", Dim::None, "stiffness of the whole line (N/m)").positive(),
        number("L", Dim::Metres, "unstretched length of the whole line").not_negative(),
        number("L2", Dim::Metres, "length behind the pulley").not_negative(),
    ],
    options: &[RATIO],
    detail: "A straight weightless line from its first point over a pulley, its second point, to a point of the pulley's body that is L2 away, in m and N in every unit \
             system. It only pulls. The pulley has no size.",
    example: "MEDIT\n*QUAY 0 0 8\n&DESCRIBE BODY SHIP\n*LEAD 12 3 6\n~HAWSER PULY 2E5 20 8 -RATIO 1.1\nCONNECTOR H1 ~HAWSER *QUAY *LEAD\nEND\n\
              &STATUS CLASS ~HAWSER",
    ..CommandSpec::new("PULY", "AQWA line over a pulley")
};

/// A line over a pulley.
#[derive(Clone, Copy, Debug)]
struct PulleyLine {
    /// Stiffness (N/m).
    stiffness: f64,
    /// Unstretched length (m).
    length: f64,
    /// Length behind the pulley (m).
    behind: f64,
    /// Ratio of the tensions of a line that runs.
    ratio: f64,
}

fn build(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    let Some(args) = records.last().map(|r| &r.args) else {
        return Err(Diagnostic::error("a class needs a record", windlass_base::span::Span::default()));
    };
    let [stiffness, length, behind] = args.numbers_or_zero(const { SPEC.numbers(["K", "L", "L2"]) });
    let ratio = args.option_number(&RATIO).unwrap_or(1.0);
    Ok(Arc::new(PulleyLine { stiffness, length, behind, ratio }))
}

impl ConnectorClass for PulleyLine {
    fn kind(&self) -> &'static str {
        "PULY"
    }

    fn check_ends(&self, connector: &Connector, _: usize) -> Outcome<()> {
        check_span_ends("PULY", "a PULY takes 2 points: an end of the line, and the pulley", connector)
    }

    fn properties(&self, name: &str, _: &Surroundings) -> Table {
        Table::new(format!("Class {name}"))
            .fact("Type", "PULY (AQWA, in m, N)", Dim::None)
            .fact("Stiffness", self.stiffness, Dim::None)
            .fact("Unstretched Length", self.length, Dim::Metres)
            .fact("Behind the Pulley", self.behind, Dim::Metres)
            .fact("Tension Ratio", self.ratio, Dim::None)
    }

    fn element(&self, _: &Connection) -> Result<Box<dyn ConnectorElement>, ClassError> {
        Ok(Box::new(SpanElement(*self)))
    }
}

impl SpanLaw for PulleyLine {
    fn notes(&self, span: &TautSpan) -> Vec<Note> {
        if self.tension_of(span).tension == 0.0 { vec!["the line is slack".into()] } else { Vec::new() }
    }

    fn tension_of(&self, span: &TautSpan) -> SpanTension {
        let whole = span.length + self.behind;
        let stretch = whole - self.length;
        if stretch <= 0.0 {
            return SpanTension::default();
        }
        // from -1, running away from the first end, to 1, running toward it
        let (half, slope) = smooth_step(0.5 * (span.rate / FULL_FRICTION_SPEED + 1.0));
        let (running, by_rate) = (2.0 * half - 1.0, slope / FULL_FRICTION_SPEED);
        let behind_share = self.ratio.powf(-running);
        let shared = span.length + behind_share * self.behind;
        let tension = self.stiffness * stretch * whole / shared;
        SpanTension {
            tension,
            by_length: self.stiffness * (whole + stretch) / shared - tension / shared,
            by_rate: tension * self.behind * self.ratio.ln() * behind_share * by_rate / shared,
        }
    }
}
