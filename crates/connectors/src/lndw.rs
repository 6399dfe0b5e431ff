//! LNDW: a straight weightless elastic line on a winch drum that winds in or pays out at a speed from a time on.
//!
//! Source: [AQWA-THEORY 9.3] and [AQWA-REF LNDW, DWT0, DWAL]. EA is constant: the stiffness is EA over the free length plus an additional
//! length. A positive speed pays out up to the final length, a negative one winds in down to it; a final length on the wrong side of the initial one
//! stops the drum for good. While the tension is above a maximum the drum stands. Readings where the source's equations cannot be read: the speed is that of the
//! unstretched line, and EA is the given stiffness times the initial plus the additional length, so that the stiffness at the start is the given one. A drum that winds in
//! stops within a step where the tension reaches the maximum; one that pays out stands through a step that begins beyond it.

use super::ClassKind;
use super::options::aqwa;
use super::taut_span::{SpanTension, apply_tension, check_span_ends, read_span};
use std::sync::Arc;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec};
use windlass_model::{
    ClassError, ClassRecord, Connection, Connector, ConnectorClass, ConnectorElement, ConnectorResponse,
    ConnectorSummary, Note, Situation, SolverCache, Surroundings, TimeStep,
};

/// The class type.
pub static LNDW: ClassKind = ClassKind { spec: &SPEC, build, idle: &[] };

const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}

const START: OptionSpec =
    aqwa("-START", &[number("T", Dim::Time, "time").not_negative()], "time at which the drum begins to turn")
        .default("0");
const ADDED: OptionSpec = aqwa(
    "-ADDED",
    &[number("LA", Dim::Metres, "length").not_negative()],
    "additional length in the stiffness EA / (LA + free length), not in the distance",
)
.default("0");

static SPEC: CommandSpec = CommandSpec {
    owner: Owner::Aqwa,
    data: &[
        number("K", Dim::None, "stiffness at the start (N/m)").positive(),
        number("L1", Dim::Metres, "initial unstretched length").positive(),
        number("L2", Dim::Metres, "final unstretched length").positive(),
        number("V", Dim::None, "speed of the drum (m/s): positive pays out, negative winds in"),
        number("TMAX", Dim::Newtons, "tension above which the drum stands").or("no limit").positive(),
    ],
    options: &[START, ADDED],
    detail: "A straight elastic line that only pulls, in m and N in every unit system. The drum turns in runs of TDOM from -START on, until the \
             free length is L2. In statics the free length is L1.",
    example: "MEDIT\n*QUAY 0 0 8\n&DESCRIBE BODY SHIP\n*BITT 12 3 6\n~WINCH LNDW 2E5 10 6 -0.1 5E5 -START 20\nCONNECTOR W1 ~WINCH *BITT *QUAY\nEND\n\
              &STATUS CLASS ~WINCH",
    ..CommandSpec::new("LNDW", "AQWA linear drum winch")
};

/// A line on a drum.
#[derive(Clone, Copy, Debug)]
struct DrumLine {
    /// EA (N).
    ea: f64,
    /// Unstretched length at the start (m).
    initial: f64,
    /// Unstretched length at which the drum stops (m).
    last: f64,
    /// Speed of the drum (m/s), positive pays out.
    speed: f64,
    /// Tension above which it stands (N).
    most: f64,
    /// When it begins to turn (s).
    start: f64,
    /// Length that only the stiffness has (m).
    added: f64,
}

/// A line on a drum at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
struct DrumState {
    /// Free unstretched length (m).
    free: f64,
    tension: f64,
    /// Derivative of the tension by the distance of the ends (N/m).
    slope: f64,
}

fn build(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    let Some(args) = records.last().map(|r| &r.args) else {
        return Err(Diagnostic::error("a class needs a record", windlass_base::span::Span::default()));
    };
    let [stiffness, initial, last, speed] = args.numbers_or_zero(const { SPEC.numbers(["K", "L1", "L2", "V"]) });
    let most = args.number(const { SPEC.number("TMAX") }).unwrap_or(f64::INFINITY);
    let added = args.option_number(&ADDED).unwrap_or(0.0);
    let start = args.option_number(&START).unwrap_or(0.0);
    Ok(Arc::new(DrumLine { ea: stiffness * (initial + added), initial, last, speed, most, start, added }))
}

impl DrumLine {
    /// Tension (N) of a free length over a distance (m), and its slopes by the distance and by the free length (N/m).
    fn tension(&self, free: f64, distance: f64) -> (f64, f64) {
        let stiffness = self.ea / (self.added + free);
        if distance > free { (stiffness * (distance - free), stiffness) } else { (0.0, 0.0) }
    }

    /// Whether the final length is not where the drum turns to.
    fn never_turns(&self) -> bool {
        self.speed * (self.last - self.initial) <= 0.0
    }

    /// Free length and tension at the end of a step to a distance of the ends.
    ///
    /// # Errors
    /// A committed state that is not one of its own.
    fn state(&self, step: Option<TimeStep>, committed: &[f64], distance: f64) -> Result<DrumState, ClassError> {
        let [paid_out, last_tension] = *committed else {
            return Err(ClassError::new("the state of an LNDW is not one of its own").lasting());
        };
        let before = self.initial + paid_out;
        let turning = step.map_or(0.0, |step| step.dt.min((step.time - self.start).max(0.0)));
        let way = self.speed * turning;
        let wanted = if way > 0.0 && self.last > before && last_tension <= self.most {
            (before + way).min(self.last)
        } else if way < 0.0 && self.last < before {
            (before + way).max(self.last)
        } else {
            before
        };
        let (tension, slope) = self.tension(wanted, distance);
        if wanted < before && tension > self.most {
            // the free length at which the tension is the maximum: EA (distance - L) = TMAX (LA + L)
            let held = (self.ea * distance - self.most * self.added) / (self.ea + self.most);
            if held < before {
                return Ok(DrumState { free: held, tension: self.most, slope: 0.0 });
            }
            let (tension, slope) = self.tension(before, distance);
            return Ok(DrumState { free: before, tension, slope });
        }
        Ok(DrumState { free: wanted, tension, slope })
    }
}

impl ConnectorClass for DrumLine {
    fn kind(&self) -> &'static str {
        "LNDW"
    }

    fn check_ends(&self, connector: &Connector, _: usize) -> Outcome<()> {
        check_span_ends("LNDW", "an LNDW takes 2 points; its anchor is a point of the ground", connector)
    }

    fn properties(&self, name: &str, _: &Surroundings) -> Table {
        let table = Table::new(format!("Class {name}"))
            .fact("Type", "LNDW (AQWA, in m, N)", Dim::None)
            .fact("EA", self.ea, Dim::Newtons)
            .fact("Initial Length", self.initial, Dim::Metres)
            .fact("Final Length", self.last, Dim::Metres)
            .fact("Drum Speed", self.speed, Dim::None)
            .fact("Start of Drum", self.start, Dim::Time)
            .fact("Additional Length", self.added, Dim::Metres);
        if self.most.is_finite() { table.fact("Stands Above", self.most, Dim::Newtons) } else { table }
    }

    fn element(&self, _: &Connection) -> Result<Box<dyn ConnectorElement>, ClassError> {
        Ok(Box::new(*self))
    }
}

impl ConnectorElement for DrumLine {
    fn states(&self) -> usize {
        2
    }

    fn evaluate(
        &self,
        at: &Situation,
        committed: &[f64],
        trial: &mut [f64],
        _: &mut SolverCache,
        out: &mut ConnectorResponse,
    ) -> Result<(), ClassError> {
        let span = read_span(at.ends)?;
        let state = self.state(at.step, committed, span.length)?;
        for (value, new) in trial.iter_mut().zip([state.free - self.initial, state.tension]) {
            *value = new;
        }
        let tension = SpanTension { tension: state.tension, by_length: state.slope, by_rate: 0.0 };
        apply_tension(&span, &tension, out);
        Ok(())
    }

    fn summary(&self, at: &Situation, committed: &[f64]) -> Result<ConnectorSummary, ClassError> {
        let distance = read_span(at.ends)?.length;
        let state = self.state(None, committed, distance)?;
        let mut notes: Vec<Note> = Vec::new();
        if state.tension == 0.0 {
            notes.push("the line is slack".into());
        }
        if self.never_turns() {
            notes.push(Note::warning("the drum never turns: its final length is not where its speed leads"));
        }
        if state.tension > self.most {
            notes.push(Note::warning("the tension is above that at which the drum stands"));
        }
        Ok(ConnectorSummary { tension: Some(state.tension), notes, solution: "exact", ..ConnectorSummary::default() })
    }
}
