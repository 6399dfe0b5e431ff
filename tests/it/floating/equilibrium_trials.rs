//! Equilibrium where a connector has no answer at some places: a search goes up to them, not into them.

use crate::common;

use nalgebra::Matrix6;
use std::sync::Arc;
use windlass_base::diagnostic::Outcome;
use windlass_base::pose::Six;
use windlass_base::table::Table;
use windlass_model::{
    ClassError, Connection, Connector, ConnectorClass, ConnectorElement, ConnectorResponse, ConnectorSummary,
    Situation, SolverCache, Surroundings,
};
use windlass_solve::{EquilibriumOptions, find_equilibrium_with_rebuilds};

/// A rope that stiffens without bound: at a stretch d it pulls by k d/(1 - d/LIMIT), and beyond LIMIT it has no answer.
#[derive(Clone, Copy, Debug)]
struct Rope;

const LIMIT: f64 = 1e-4;
const STIFFNESS: f64 = 1e3;
const WEIGHT: f64 = 1e5;

impl ConnectorElement for Rope {
    fn evaluate(
        &self,
        at: &Situation,
        _: &[f64],
        _: &mut [f64],
        _: &mut SolverCache,
        out: &mut ConnectorResponse,
    ) -> Result<(), ClassError> {
        let d = -at.ends[0].pose.origin.z;
        if d >= LIMIT {
            return Err(ClassError::new("the rope is stretched beyond its limit"));
        }
        out.clear(2);
        let room = 1.0 - d / LIMIT;
        out.wrench[0] = Six::new(0.0, 0.0, STIFFNESS * d / room, 0.0, 0.0, 0.0);
        let mut block = Matrix6::zeros();
        block[(2, 2)] = STIFFNESS / (room * room);
        out.stiffness[0] = block;
        Ok(())
    }

    fn summary(&self, _: &Situation, _: &[f64]) -> Result<ConnectorSummary, ClassError> {
        Ok(ConnectorSummary::default())
    }
}

impl ConnectorClass for Rope {
    fn kind(&self) -> &'static str {
        "ROPE"
    }

    fn check_ends(&self, _: &Connector, _: usize) -> Outcome<()> {
        Ok(())
    }

    fn properties(&self, _: &str, _: &Surroundings) -> Table {
        Table::new("Rope")
    }

    fn element(&self, _: &Connection) -> Result<Box<dyn ConnectorElement>, ClassError> {
        Ok(Box::new(*self))
    }
}

#[test]
fn trial_without_solution_shortens_step_to_its_fraction() {
    let (mut session, _screen, _folder) = common::session();
    let records = format!(
        "&DIMEN -DIMEN METERS N\nMEDIT\n&DESCRIBE BODY B -IGNORE X Y RX RY RZ\n*G 0 0 0\n#WEIGHT *G {WEIGHT} 1 1 1\n\
         *TOP 0 0 10\n~R GSPR BOTH X 1\nCONNECTOR R ~R *G\nEND\n"
    );
    session.open("records", records);
    session.run();
    let mut model = session.job.model.clone();
    model.classes.values_mut().for_each(|class| class.object = Arc::new(Rope));
    let found = find_equilibrium_with_rebuilds(&mut model, &EquilibriumOptions::default()).unwrap();
    // k d/(1 - d/L) = W: d = W L/(k L + W); Newton's first step from d = 0 is W/k = 100 m, a million times the limit
    let want = -WEIGHT * LIMIT / (STIFFNESS * LIMIT + WEIGHT);
    let got = model.bodies["B"].position.shift[2];
    // at the tolerance of a thousandth of the weight d errs by 1e-3 (1 - d/L)^2 k/W of itself
    assert!((got / want - 1.0).abs() < 1e-9, "{got} {want} {:?}", found.found);
}
