//! TUG_BOAT: a constant horizontal force.
//!
//! Source: [MOSES-REF conn_rest] (the names TUG_BOAT and -TUG ANG DIST); that the force is constant is our reading.

use super::ClassKind;
use super::spring::no_anchor;
use std::sync::Arc;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::geometry::unit_vector;
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec};
use windlass_model::{
    ClassError, ClassRecord, Connection, Connector, ConnectorClass, ConnectorElement, ConnectorResponse,
    ConnectorSummary, Situation, SolveKind, SolverCache, Surroundings,
};

/// The class type.
pub static TUG_BOAT: ClassKind = ClassKind { spec: &SPEC, build, idle: &[] };

const T_DYNAM: OptionSpec = OptionSpec::new(
    "-T_DYNAM",
    &[
        ValueSpec::new("PERCENT", Kind::Number(Dim::None), "significant change of the pull, percent"),
        ValueSpec::new("PHASE", Kind::Number(Dim::Angle), "phase behind the crest at the tug"),
    ],
    "the pull changes with the waves at the tug",
)
.stops(SolveKind::Motions, "a pull of a tug that changes with the waves");
const DAMPING: OptionSpec = OptionSpec::new(
    "-DAMPING",
    &[ValueSpec::new("C", Kind::Number(Dim::None), "force for a velocity, in units of force times s over length")],
    "the pull falls with the velocity of the point",
)
.stops(SolveKind::Motions, "damping by a tug");

static SPEC: CommandSpec = CommandSpec {
    options: &[T_DYNAM, DAMPING],
    data: &[ValueSpec::new("FORCE", Kind::Number(Dim::Force), "bollard pull").not_negative()],
    detail: "Pulls its point with FORCE toward the direction ANG of -TUG ANG DIST on the connector, degrees from +X toward +Y in the global \
             horizontal plane, wherever the body goes and turns: it has no stiffness. DIST is where the tug is drawn. The tug itself \
             bears the reaction, and is no part of the model.",
    example: "MEDIT\n&DESCRIBE BODY BARGE\n*BITT 0 0 5\n~TUG TUG_BOAT 60\nCONNECTOR T1 -TUG 180 300 ~TUG *BITT\nEND\n&STATUS CLASS ~TUG",
    ..CommandSpec::new("TUG_BOAT", "constant pull of a tug")
};

#[derive(Debug)]
struct TugClass {
    force: f64,
}

/// The force on its point (N, global).
#[derive(Debug)]
struct TugForce {
    force: [f64; 2],
}

fn build(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    let force = records.last().and_then(|r| r.args.number(const { SPEC.number("FORCE") }));
    Ok(Arc::new(TugClass { force: force.unwrap_or(0.0) }))
}

impl ConnectorClass for TugClass {
    fn kind(&self) -> &'static str {
        "TUG_BOAT"
    }

    fn check_ends(&self, connector: &Connector, _: usize) -> Outcome<()> {
        no_anchor("TUG_BOAT", connector)?;
        if connector.points.len() > 1 {
            return Err(Diagnostic::error("a TUG_BOAT takes 1 point, its other end is the tug", connector.span));
        }
        if connector.tug.is_none() {
            return Err(Diagnostic::error("a TUG_BOAT needs -TUG ANG DIST on its connector", connector.span));
        }
        Ok(())
    }

    fn properties(&self, name: &str, _: &Surroundings) -> Table {
        Table::new(format!("Class {name}")).fact("Type", "TUG_BOAT", Dim::None).fact("Force", self.force, Dim::Force)
    }

    fn element(&self, connection: &Connection) -> Result<Box<dyn ConnectorElement>, ClassError> {
        let tug = connection.connector.tug.ok_or_else(|| ClassError::new("the connector has no -TUG"))?;
        let (cos, sin) = unit_vector(tug.direction);
        Ok(Box::new(TugForce { force: [self.force * cos, self.force * sin] }))
    }
}

impl ConnectorElement for TugForce {
    fn evaluate(
        &self,
        _: &Situation,
        _: &[f64],
        _: &mut [f64],
        _: &mut SolverCache,
        out: &mut ConnectorResponse,
    ) -> Result<(), ClassError> {
        out.clear(2);
        let [x, y] = self.force;
        if let Some(wrench) = out.wrench.first_mut() {
            wrench.x = x;
            wrench.y = y;
        }
        Ok(())
    }

    fn summary(&self, _: &Situation, _: &[f64]) -> Result<ConnectorSummary, ClassError> {
        let [x, y] = self.force;
        Ok(ConnectorSummary { tension: Some(x.hypot(y)), solution: "exact", ..ConnectorSummary::default() })
    }
}
