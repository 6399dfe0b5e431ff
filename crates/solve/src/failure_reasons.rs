//! Reasons behind a solution that was not found: what a user changes, where a connector or a step alone names what failed.

use super::link::EndAttachment;
use super::system::{DOFS, SolveError, System};
use windlass_base::pose::Pose;
use windlass_base::units::Dim;
use windlass_model::ClassError;

/// Radius of gyration (m) that no body has: weights without radii, at one point or in a row, leave rounding.
const NO_RADIUS: f64 = 1e-4;
/// Depth (m) from which on a body that goes down sinks.
const SINKING_DEPTH_M: f64 = 1.0;

impl System {
    /// The error of a connector that has no answer, where it hangs on a body that sinks: that of the body, the connector's its help. `sunk` gives
    /// by how much a body that goes down has gone down (m).
    pub(super) fn because_it_sinks(&self, error: SolveError, sunk: &dyn Fn(usize) -> Option<f64>) -> SolveError {
        let Some(link) = self.links.iter().find(|l| Some(&l.name) == error.who.as_ref()) else { return error };
        let bodies = link.ends.iter().filter_map(|end| match end {
            EndAttachment::Body(body, _) => Some(*body),
            EndAttachment::Ground(_) => None,
        });
        let found = bodies.filter_map(|body| Some((body, sunk(body)?))).find(|(_, depth)| *depth > SINKING_DEPTH_M);
        let Some((body, depth)) = found else { return error };
        let name = self.nodes.get(body).map(|n| n.name.clone()).unwrap_or_default();
        let text = format!("it sinks: {{}} below where it began connector {} has no answer", link.name);
        let made = ClassError::with_values(text, &[(depth, Dim::Length)])
            .help(format!("connector {}: {}", link.name, error.error.message.without_values()))
            .help(format!("nothing carries its weight: see the weight, hull and lines of {name}, and where it begins"));
        SolveError { who: Some(name), error: ClassError { lasting: error.error.lasting, ..made } }
    }

    /// The error of a body that moves in a rotation in which it has no inertia, where there is one in these poses.
    pub(super) fn without_inertia(&self, poses: &[Pose]) -> Option<SolveError> {
        self.nodes.iter().zip(poses).find_map(|(node, pose)| {
            let mass = &node.floating.mass;
            if node.junction || mass.mass <= 0.0 {
                return None;
            }
            let own = pose.axes * mass.inertia_about(mass.centre) * pose.axes.transpose();
            let added = node.floating.added_mass(pose);
            let least = mass.mass * NO_RADIUS * NO_RADIUS;
            let lacks = |axis: usize| node.moves(3 + axis) && own[(axis, axis)] + added[(3 + axis, 3 + axis)] <= least;
            let dof = DOFS.get(3 + (0..3).find(|axis| lacks(*axis))?).copied().unwrap_or_default();
            Some(no_inertia(&node.name, dof))
        })
    }
}

/// The error of a body without inertia in a degree of freedom.
pub(super) fn no_inertia(name: &str, dof: &str) -> SolveError {
    let error = ClassError::new(format!("it has no inertia in {dof}")).help(format!(
        "give its #WEIGHT radii of gyration, or hold that degree of freedom: &DESCRIBE BODY {name} -IGNORE"
    ));
    SolveError { who: Some(name.to_string()), error }
}
