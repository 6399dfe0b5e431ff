//! Static equilibrium of bodies and connectors: Newton on the sum of forces with the analytic stiffness. What connectors do not join
//! is brought to rest part by part, and then seen to be so all together.
//!
//! Far away, or where the stiffness does not hold the bodies, the stiffness is helped by a share of the mass: a step in
//! pseudo-time, which shrinks to none as the residual does (Kelley and Keyes, SIAM Journal on Numerical Analysis 35
//! (1998), 508-523). Each step is shortened until the forces along it have not turned around.

use super::parts::{BodySubset, parts};
use super::search::{BodyPlaces, EquilibriumSearch};
use super::system::{Contribution, DOFS, SolveError, System, SystemState};
use super::unknowns::{Turns, Unknowns, find_restrained_rotations};
use nalgebra::DMatrix;
use windlass_base::dense::SymmetricEigen;
use windlass_base::units::Dim;
use windlass_model::ClassError;
use windlass_nonlinear::NewtonStatistics;

/// What an equilibrium is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct EquilibriumOptions {
    /// Most steps.
    pub most: usize,
    /// Residual acceleration tolerance (fraction of gravity): of translation, and of rotation times the radius of gyration.
    pub tolerance: [f64; 2],
    /// Degrees of freedom that do not move in this solution: number of the body, number of the degree of freedom.
    pub ignored: Vec<(usize, usize)>,
    /// A body that does not move along a horizontal direction, from +X toward +Y (rad): across it, it does.
    pub held: Option<(usize, f64)>,
    /// The fraction of each Newton step that is tried first: 1 is the whole step.
    pub fraction: f64,
    /// The longest step of a body, in translation (m) and rotation (rad), where it is given.
    pub longest_step: Option<[f64; 2]>,
}

impl Default for EquilibriumOptions {
    /// Source: [MOSES-REF equi].
    fn default() -> Self {
        let (ignored, held, longest_step) = (Vec::new(), None, None);
        EquilibriumOptions { most: 50, tolerance: [1e-3, 1e-3], ignored, held, fraction: 1.0, longest_step }
    }
}

/// An equilibrium that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibrium {
    /// The search: its steps, and as residual the largest residual acceleration (fraction of gravity).
    pub search: NewtonStatistics,
    /// Degrees of freedom that nothing holds, with their bodies, as written.
    pub loose: Vec<(String, String)>,
}

/// A step ends where this share of the largest acceleration asked for is reached: Newton's last steps cost little.
const FINAL_TOLERANCE_SHARE: f64 = 1e-9;
/// Eigenvalue (rad2/s2) below which a motion is not stable: it grows by e in a quarter of an hour. What lies between is what a solution within
/// its tolerance leaves of nothing.
const UNSTABLE_EIGENVALUE: f64 = -1e-6;
/// Share of the largest eigenvalue that rounding makes of the least.
const EIGENVALUE_ROUNDING: f64 = 1e-11;

/// Whether an eigenvalue of a system whose largest is given is that of a motion that is not stable (rad2/s2).
pub(super) fn is_unstable(eigenvalue: f64, largest: f64) -> bool {
    eigenvalue < UNSTABLE_EIGENVALUE.min(-EIGENVALUE_ROUNDING * largest.abs())
}

/// Square of a natural frequency (rad2/s2) below which nothing holds a motion: a period of 17 hours.
pub(super) const UNRESTRAINED_EIGENVALUE: f64 = 1e-8;
/// Share of the tolerance that rounding may leave, and steps without half as much left after which it has.
const ROUNDING_TOLERANCE_SHARE: f64 = 1e-4;
const MAX_STALLED_STEPS: usize = 3;
/// Steps without half as much left after which a search within the tolerance ends wherever it is.
const LONG_STALE: usize = 12;

/// Brings the bodies of a state to rest.
///
/// # Errors
/// A place on the way that cannot be evaluated; no equilibrium within the steps: the body and degree of freedom that is left, and
/// what acts on it most; a direction that nothing holds, with a force in it.
pub fn equilibrium(
    system: &System,
    state: &mut SystemState,
    options: &EquilibriumOptions,
) -> Result<Equilibrium, SolveError> {
    check_weights(system, options)?;
    let turns = find_restrained_rotations(system, state, options);
    let free = |body: usize, dof: usize| {
        system.nodes.get(body).and_then(|n| n.free.get(dof)) == Some(&true) && !options.ignored.contains(&(body, dof))
    };
    let moves = |part: &BodySubset| part.iter().enumerate().any(|(body, own)| *own && (0..6).any(|f| free(body, f)));
    let parts: Vec<BodySubset> = parts(system).into_iter().filter(moves).collect();
    let mut search = NewtonStatistics::default();
    if parts.len() > 1 {
        for part in &parts {
            search += find(system, state, options, (&turns, Some(part)))?;
        }
    }
    search += find(system, state, options, (&turns, None))?;
    let unknowns = Unknowns::new(system, state, options, (&turns, None));
    let loose = find_unrestrained_dofs(system, &unknowns, state)?;
    Ok(Equilibrium { search, loose })
}

/// Brings a part to rest, `None` for everything together; what is loose in it is left open.
fn find(
    system: &System,
    state: &mut SystemState,
    options: &EquilibriumOptions,
    (turns, part): (&[Turns], Option<&BodySubset>),
) -> Result<NewtonStatistics, SolveError> {
    let mut search = EquilibriumSearch::new(system, options, part);
    search.evaluate(state)?;
    let start: Vec<f64> = state.poses.iter().map(|p| p.origin.z).collect();
    let mut best = (f64::INFINITY, BodyPlaces::from_state(state));
    let mut stale = 0;
    for steps in 0..=options.most {
        if system.is_interrupted() {
            return Err(SolveError::new(ClassError::new("interrupted").lasting()));
        }
        // a junction is measured by what pulls at it now
        let unknowns = Unknowns::new(system, state, options, (turns, part));
        let (worst, at) = search.worst(&unknowns, state);
        if worst.is_nan() {
            return Err(failure(system, state, &unknowns, at, options));
        }
        stale = if worst <= 0.5 * best.0 { 0 } else { stale + 1 };
        if worst < best.0 {
            best = (worst, BodyPlaces::from_state(state));
        }
        let polished = worst <= FINAL_TOLERANCE_SHARE || unknowns.rows.is_empty();
        // within the tolerance the search goes on as long as it gets better
        let rounded = (best.0 <= ROUNDING_TOLERANCE_SHARE && stale >= MAX_STALLED_STEPS)
            || stale >= LONG_STALE
            || steps == options.most;
        if polished || (best.0 <= 1.0 && rounded) {
            if best.0 < worst {
                best.1.restore(state);
                search.evaluate(state)?;
            }
            let residual = unknowns.largest(&unknowns.residual(state));
            return Ok(NewtonStatistics { iterations: steps, residual, ..search.statistics });
        }
        if steps == options.most {
            return Err(failure(system, state, &unknowns, at, options));
        }
        if let Err(error) = search.advance(&unknowns, state, worst) {
            let sunk = |body: usize| {
                let down = *state.residual.get(6 * body + 2)? < 0.0;
                down.then_some(start.get(body)? - state.poses.get(body)?.origin.z)
            };
            return Err(system.because_it_sinks(error, &sunk));
        }
    }
    let unknowns = Unknowns::new(system, state, options, (turns, part));
    let (_, at) = unknowns.worst(&unknowns.residual(state), options);
    Err(failure(system, state, &unknowns, at, options))
}

/// Sees that every body that is to come to rest has weight, unless it moves in the horizontal plane alone.
fn check_weights(system: &System, options: &EquilibriumOptions) -> Result<(), SolveError> {
    for (body, node) in system.nodes.iter().enumerate() {
        let free = |dof: usize| node.free.get(dof) == Some(&true) && !options.ignored.contains(&(body, dof));
        if !node.junction && node.floating.mass.mass <= 0.0 && (2..5).any(free) {
            let name = &node.name;
            let error = ClassError::new("it has no weight").help(format!(
                "give it one: #WEIGHT *POINT W KX KY KZ; or leave it out: &DESCRIBE BODY {name} -IGNORE X Y Z RX RY RZ"
            ));
            return Err(SolveError { who: Some(name.clone()), error });
        }
    }
    Ok(())
}

/// A way (m) that no body goes to its equilibrium.
const MAX_TRAVEL_M: f64 = 5000.0;

/// Degrees of freedom along which nothing holds a body.
fn find_unrestrained_dofs(
    system: &System,
    unknowns: &Unknowns,
    state: &SystemState,
) -> Result<Vec<(String, String)>, SolveError> {
    let stiffness = unknowns.stiffness(state);
    let root = unknowns.inertia.map(|d| 1.0 / d.sqrt());
    let scaled = DMatrix::from_fn(root.len(), root.len(), |i, j| {
        0.5 * (stiffness[(i, j)] + stiffness[(j, i)]) * root[i] * root[j]
    });
    let made = SymmetricEigen::new(scaled, &|| system.is_interrupted())
        .map_err(|e| unknowns.singular_stiffness_error(system, e))?;
    let mut found: Vec<usize> = Vec::new();
    for (value, vector) in made.values.iter().zip(made.vectors.column_iter()) {
        if value.abs() <= UNRESTRAINED_EIGENVALUE {
            found.extend(vector.iter().enumerate().filter(|(_, v)| v.abs() > 0.3).map(|(i, _)| i));
        }
    }
    found.sort_unstable();
    found.dedup();
    let name = |i: usize| {
        let body = system.nodes.get(unknowns.body(i)).map_or(String::new(), |n| n.name.clone());
        (body, DOFS.get(unknowns.dof(i)).copied().unwrap_or_default().to_string())
    };
    Ok(found.into_iter().map(name).collect())
}

/// The error of bodies that do not come to rest.
fn failure(
    system: &System,
    state: &SystemState,
    unknowns: &Unknowns,
    at: usize,
    options: &EquilibriumOptions,
) -> SolveError {
    let (body, dof) = (unknowns.body(at), unknowns.dof(at));
    let name = system.nodes.get(body).map_or(String::new(), |n| n.name.clone());
    let dim = if dof >= 3 { Dim::Moment } else { Dim::Force };
    let left = unknowns.residual(state).get(at).copied().unwrap_or(f64::NAN);
    let word = DOFS.get(dof).copied().unwrap_or_default();
    let mut values = vec![(left, dim)];
    let mut acting: Vec<(f64, String)> = Vec::new();
    for Contribution { body: on, connector, category, load } in system.contributions(&state.poses).unwrap_or_default() {
        let value = load.wrench[dof];
        if on == body && value != 0.0 {
            let who = connector.unwrap_or_else(|| category.name().to_string());
            match acting.iter_mut().find(|(_, name)| *name == who) {
                Some((sum, _)) => *sum += value,
                None => acting.push((value, who)),
            }
        }
    }
    acting.sort_by(|a, b| b.0.abs().total_cmp(&a.0.abs()));
    let largest: Vec<String> = acting.iter().take(3).map(|(_, who)| format!("{who} {{}}")).collect();
    values.extend(acting.iter().take(3).map(|(value, _)| (*value, dim)));
    let largest = if largest.is_empty() { "nothing acts on it".to_string() } else { largest.join(", ") };
    let mut free = find_unrestrained_dofs(system, unknowns, state).unwrap_or_default();
    // nor does what holds so little that the body would go a mile
    let held = unknowns.stiffness(state)[(at, at)];
    if dof < 3 && left.abs() > held.abs() * MAX_TRAVEL_M {
        free.push((name.clone(), word.to_string()));
    }
    let error = match free.iter().filter(|(who, _)| *who == name).map(|(_, f)| f.as_str()).collect::<Vec<_>>() {
        list if list.contains(&word) => {
            ClassError::with_values(format!("nothing holds it in {word}, and {{}} is left there: {largest}"), &values)
                .help(format!("moor it, or leave the degree of freedom out: -IGNORE {name} {word}"))
        }
        _ => ClassError::with_values(
            format!("no equilibrium in {} steps: {{}} is left in {word}: {largest}", options.most),
            &values,
        )
        .help("-ITER_MAX allows more steps; &INSTATE begins nearer; nothing has been moved"),
    };
    SolveError { who: Some(name), error }
}
