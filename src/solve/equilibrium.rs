//! Static equilibrium of bodies and connectors: Newton on the sum of forces with the analytic stiffness.
//!
//! Far away, or where the stiffness does not hold the bodies, the stiffness is helped by a share of the mass: a step in
//! pseudo-time, which shrinks to none as the residual does (Kelley and Keyes, SIAM Journal on Numerical Analysis 35
//! (1998), 508-523). Each step is shortened until the forces along it have not turned around.

use super::system::{Contribution, FREEDOMS, SolveError, State, System};
use crate::language::units::Dim;
use crate::model::{ClassError, Pose, Six};
use nalgebra::{Cholesky, DMatrix, DVector};

/// What an equilibrium is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Most steps.
    pub most: usize,
    /// Largest acceleration left, as a share of gravity: of translation, and of rotation times the radius of gyration.
    pub tolerance: [f64; 2],
    /// Freedoms that do not move in this solution: number of the body, number of the freedom.
    pub ignored: Vec<(usize, usize)>,
    /// A body that does not move along a horizontal direction, from +X toward +Y (rad): across it, it does.
    pub held: Option<(usize, f64)>,
}

impl Default for Options {
    /// Source: reference/solve.md, &EQUI.
    fn default() -> Self {
        Options { most: 50, tolerance: [1e-3, 1e-3], ignored: Vec::new(), held: None }
    }
}

/// An equilibrium that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibrium {
    /// Steps taken.
    pub steps: usize,
    /// Evaluations of the forces.
    pub evaluations: usize,
    /// Largest acceleration left, as a share of gravity.
    pub measure: f64,
    /// Freedoms that nothing holds, with their bodies, as written.
    pub loose: Vec<(String, String)>,
}

/// A step ends where this share of the largest acceleration asked for is reached: Newton's last steps cost little.
const POLISH: f64 = 1e-9;
/// Longest step (m), and largest rotation in it (rad).
const LONGEST: [f64; 2] = [50.0, 0.3];
/// Square of a natural frequency (rad2/s2) below which nothing holds a motion: a period of 17 hours.
const LOOSE: f64 = 1e-8;
/// Shortest share of a step that is tried.
const SHORTEST: f64 = 1e-4;

/// Rows of the system with their shares in one unknown, the larger first.
type Direction = [(usize, f64); 2];

/// The free unknowns and their measures.
struct Unknowns {
    /// The direction of each: a row of the system, or two with their shares.
    rows: Vec<Direction>,
    /// Inertia of each (kg or kg m2).
    inertia: DVector<f64>,
    /// Force (N) or moment (N m) that is gravity's on it.
    measure: DVector<f64>,
}

impl Unknowns {
    fn of(system: &System, state: &State, options: &Options) -> Self {
        let (mut rows, mut inertia, mut measure) = (Vec::new(), Vec::new(), Vec::new());
        for (body, node) in system.nodes.iter().enumerate() {
            let own = &node.floating.mass;
            let pull = state.pull.get(body).copied().unwrap_or(0.0) / system.gravity;
            let mass = if node.junction || own.mass <= 0.0 { own.mass.max(pull).max(1e-3) } else { own.mass };
            let about = own.inertia.trace() / 3.0 - mass * own.centre.norm_squared() * 2.0 / 3.0;
            let radius = if about > 1e-12 * mass { (about / mass).sqrt() } else { 1.0 };
            for (freedom, free) in node.free.iter().enumerate() {
                if !free || options.ignored.contains(&(body, freedom)) {
                    continue;
                }
                match options.held {
                    Some((held, angle)) if held == body && freedom < 2 => match across(body, angle, &node.free) {
                        Some(direction) if freedom == 1 => rows.push(direction),
                        _ => continue,
                    },
                    _ => rows.push([(6 * body + freedom, 1.0), (6 * body + freedom, 0.0)]),
                }
                let turns = freedom >= 3;
                inertia.push(if turns { mass * radius * radius } else { mass });
                measure.push(if turns { mass * radius * system.gravity } else { mass * system.gravity });
            }
        }
        Unknowns { rows, inertia: DVector::from_vec(inertia), measure: DVector::from_vec(measure) }
    }

    fn residual(&self, state: &State) -> DVector<f64> {
        let along = |d: &Direction| d.iter().map(|(r, share)| share * state.residual[*r]).sum();
        DVector::from_iterator(self.rows.len(), self.rows.iter().map(along))
    }

    fn stiffness(&self, state: &State) -> DMatrix<f64> {
        DMatrix::from_fn(self.rows.len(), self.rows.len(), |i, j| match (self.rows.get(i), self.rows.get(j)) {
            (Some(rows), Some(columns)) => rows
                .iter()
                .flat_map(|(r, one)| columns.iter().map(move |(c, other)| one * other * state.stiffness[(*r, *c)]))
                .sum(),
            _ => 0.0,
        })
    }

    /// The largest acceleration left over what is tolerated, and the unknown that has it.
    fn worst(&self, residual: &DVector<f64>, options: &Options) -> (f64, usize) {
        let [shift, turn] = options.tolerance;
        let share = |(i, (r, m)): (usize, (&f64, &f64))| {
            let tolerance = if self.freedom(i) >= 3 { turn } else { shift };
            (r.abs() / m / tolerance, i)
        };
        residual.iter().zip(self.measure.iter()).enumerate().map(share).fold((0.0, 0), |worst, one| {
            // what is no number is the worst
            if one.0 > worst.0 || one.0.is_nan() { one } else { worst }
        })
    }

    fn freedom(&self, unknown: usize) -> usize {
        self.rows.get(unknown).map_or(0, |[(r, _), _]| r % 6)
    }

    fn body(&self, unknown: usize) -> usize {
        self.rows.get(unknown).map_or(0, |[(r, _), _]| r / 6)
    }

    /// The share of a step that stays within the longest.
    fn limit(&self, step: &DVector<f64>) -> f64 {
        let [far, turn] = LONGEST;
        step.iter().enumerate().fold(1.0, |share: f64, (i, s)| {
            let most = if self.freedom(i) >= 3 { turn } else { far };
            share.min(most / s.abs().max(1e-300))
        })
    }

    fn moved(&self, poses: &[Pose], step: &DVector<f64>, share: f64) -> Vec<Pose> {
        let mut motions = vec![Six::zeros(); poses.len()];
        for (direction, s) in self.rows.iter().zip(step.iter()) {
            for (row, part) in direction {
                if let Some(motion) = motions.get_mut(row / 6) {
                    motion[row % 6] += share * part * s;
                }
            }
        }
        poses.iter().zip(&motions).map(|(p, m)| if *m == Six::zeros() { *p } else { p.moved(m) }).collect()
    }
}

/// The horizontal direction across an angle (rad), where the body is free in both.
fn across(body: usize, angle: f64, free: &[bool; 6]) -> Option<Direction> {
    let [x, y, ..] = *free;
    let (x_share, y_share) = (-angle.sin(), angle.cos());
    let (x_row, y_row) = ((6 * body, x_share), (6 * body + 1, y_share));
    (x && y).then_some(if x_share.abs() > y_share.abs() { [x_row, y_row] } else { [y_row, x_row] })
}

/// Brings the bodies of a state to rest.
///
/// # Errors
/// A place on the way that cannot be evaluated; no equilibrium within the steps: the body and freedom that is left, and
/// what acts on it most; a direction that nothing holds, with a force in it.
pub fn equilibrium(system: &System, state: &mut State, options: &Options) -> Result<Equilibrium, SolveError> {
    weighed(system, options)?;
    system.evaluate(state)?;
    let mut search = Search { system, options, evaluations: 1, help: 0.0, careful: 0, window: CAREFUL };
    let mut stale = 0;
    let mut best = Best { worst: f64::INFINITY, poses: state.poses.clone(), since: 0 };
    for steps in 0..=options.most {
        // a junction is measured by what pulls at it now
        let unknowns = Unknowns::of(system, state, options);
        let (worst, at) = unknowns.worst(&unknowns.residual(state), options);
        let polished = worst <= POLISH || unknowns.rows.is_empty();
        // within the tolerance the search goes on as long as it gets better
        let done = polished || (worst.min(best.worst) <= 1.0 && (stale >= STALE || steps == options.most));
        if done {
            if !polished && best.worst < worst {
                state.poses.clone_from(&best.poses);
                search.evaluate(state)?;
            }
            let unknowns = Unknowns::of(system, state, options);
            let (left, _) = unknowns.worst(&unknowns.residual(state), options);
            let loose = loose(system, &unknowns, state);
            let [tolerance, _] = options.tolerance;
            return Ok(Equilibrium { steps, evaluations: search.evaluations, measure: left * tolerance, loose });
        }
        if steps == options.most {
            return Err(failure(system, state, &unknowns, at, options));
        }
        stale = if worst <= 0.5 * best.worst { 0 } else { stale + 1 };
        if search.careful > 0 {
            // a careful step may leave as much as before it: where it leads is the best there is
            best = Best { worst, poses: state.poses.clone(), since: 0 };
        } else if best.is_left_behind(worst, state) {
            search.careful = search.window;
            search.window = search.window.saturating_mul(2);
            search.help = 0.0;
            state.poses.clone_from(&best.poses);
            search.evaluate(state)?;
            best.since = 0;
            continue;
        }
        search.step(&unknowns, state, worst)?;
    }
    let unknowns = Unknowns::of(system, state, options);
    let residual = unknowns.residual(state);
    Err(failure(system, state, &unknowns, unknowns.worst(&residual, options).1, options))
}

/// Sees that every body that is to come to rest has weight, unless it moves in the horizontal plane alone.
fn weighed(system: &System, options: &Options) -> Result<(), SolveError> {
    for (body, node) in system.nodes.iter().enumerate() {
        let free =
            |freedom: usize| node.free.get(freedom) == Some(&true) && !options.ignored.contains(&(body, freedom));
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

/// Steps without half as much left after which a search within the tolerance has come as near as rounding lets it.
const STALE: usize = 3;
/// Steps that may lead nowhere better before the search goes back to the best place it had: where something stiff turns, a
/// step stretches it first, and the next mends that.
const PATIENCE: usize = 5;
/// Steps that are shortened until the forces along them have not turned around, after going back for the first time; twice as
/// many each further time.
const CAREFUL: usize = 8;

/// The place with the least left so far.
struct Best {
    worst: f64,
    poses: Vec<Pose>,
    since: usize,
}

impl Best {
    /// Whether steps have led nowhere better for too long; a better place is kept.
    fn is_left_behind(&mut self, worst: f64, state: &State) -> bool {
        if worst < self.worst {
            (self.worst, self.since) = (worst, 0);
            self.poses.clone_from(&state.poses);
        } else {
            self.since += 1;
        }
        self.since > PATIENCE
    }
}

/// A search on its way.
struct Search<'a> {
    system: &'a System,
    options: &'a Options,
    evaluations: usize,
    /// Share of the inertia added to the stiffness (1/s2).
    help: f64,
    /// Steps yet to be taken with care.
    careful: usize,
    /// Steps to be taken with care after going back.
    window: usize,
}

impl Search<'_> {
    fn evaluate(&mut self, state: &mut State) -> Result<(), SolveError> {
        self.evaluations += 1;
        self.system.evaluate(state)
    }

    /// Takes one step.
    fn step(&mut self, unknowns: &Unknowns, state: &mut State, worst: f64) -> Result<(), SolveError> {
        let residual = unknowns.residual(state);
        let (step, needed) = direction(unknowns, &unknowns.stiffness(state), &residual, self.help);
        let work = residual.dot(&step);
        let from = state.poses.clone();
        let longest = unknowns.limit(&step);
        // a long step where nothing holds back
        let blind = needed > 0.0 && longest < 1.0;
        let mut share = longest;
        let mut error = None;
        while share >= SHORTEST * longest {
            state.poses = unknowns.moved(&from, &step, share);
            match self.evaluate(state) {
                Ok(()) => {
                    let new = unknowns.residual(state);
                    let now = unknowns.worst(&new, self.options).0;
                    let after = new.dot(&step);
                    if (self.careful == 0 && !blind) || now < worst || after >= -0.5 * work.abs() {
                        self.careful = self.careful.saturating_sub(1);
                        // a stiffness that needed help is helped less as the residual shrinks
                        let change = if now <= worst { (0.5 * now / worst).max(0.1) } else { (now / worst).min(4.0) };
                        self.help = Some(needed * change).filter(|h| *h >= LOOSE).unwrap_or(0.0);
                        return Ok(());
                    }
                    // where the force along the step is nothing, were it straight
                    share *= (work.abs() / (work.abs() - after)).clamp(0.1, 0.7);
                }
                Err(wrong) => {
                    error = Some(wrong);
                    share *= 0.5;
                }
            }
        }
        state.poses = from;
        if let Some(error) = error {
            return Err(error);
        }
        // no share of the step is good: a shorter step in pseudo-time
        self.help = (10.0 * needed.max(self.help)).max(1e-3);
        self.evaluate(state)
    }
}

/// The step, and the share of the inertia (1/s2) that had to be added to the stiffness to hold the bodies.
fn direction(unknowns: &Unknowns, stiffness: &DMatrix<f64>, residual: &DVector<f64>, help: f64) -> (DVector<f64>, f64) {
    let root = unknowns.inertia.map(|d| 1.0 / d.sqrt());
    let scaled = DMatrix::from_fn(root.len(), root.len(), |i, j| stiffness[(i, j)] * root[i] * root[j]);
    let symmetric = (&scaled + scaled.transpose()) * 0.5;
    let size = symmetric.amax().max(1e-6);
    let mut needed = help;
    let mut next = (1e-9 * size).max(10.0 * LOOSE);
    loop {
        let mut held = symmetric.clone();
        held.iter_mut().step_by(root.len() + 1).for_each(|d| *d += needed - LOOSE);
        if Cholesky::new(held).is_some() || needed > 1e3 * size {
            break;
        }
        needed = needed.max(next);
        next = 10.0 * needed;
    }
    let mut held = scaled;
    held.iter_mut().step_by(root.len() + 1).for_each(|d| *d += needed);
    let right = residual.component_mul(&root);
    let solved = held.lu().solve(&right).filter(|s| s.iter().all(|v| v.is_finite()));
    (solved.unwrap_or(right).component_mul(&root), needed)
}

/// Freedoms along which nothing holds a body.
fn loose(system: &System, unknowns: &Unknowns, state: &State) -> Vec<(String, String)> {
    if unknowns.rows.is_empty() {
        // no matrix has eigenvalues then
        return Vec::new();
    }
    let stiffness = unknowns.stiffness(state);
    let root = unknowns.inertia.map(|d| 1.0 / d.sqrt());
    let scaled = DMatrix::from_fn(root.len(), root.len(), |i, j| {
        0.5 * (stiffness[(i, j)] + stiffness[(j, i)]) * root[i] * root[j]
    });
    let made = scaled.symmetric_eigen();
    let mut found: Vec<usize> = Vec::new();
    for (value, vector) in made.eigenvalues.iter().zip(made.eigenvectors.column_iter()) {
        if value.abs() <= LOOSE {
            found.extend(vector.iter().enumerate().filter(|(_, v)| v.abs() > 0.3).map(|(i, _)| i));
        }
    }
    found.sort_unstable();
    found.dedup();
    let name = |i: usize| {
        let body = system.nodes.get(unknowns.body(i)).map_or(String::new(), |n| n.name.clone());
        (body, FREEDOMS.get(unknowns.freedom(i)).copied().unwrap_or_default().to_string())
    };
    found.into_iter().map(name).collect()
}

/// The error of bodies that do not come to rest.
fn failure(system: &System, state: &State, unknowns: &Unknowns, at: usize, options: &Options) -> SolveError {
    let (body, freedom) = (unknowns.body(at), unknowns.freedom(at));
    let name = system.nodes.get(body).map_or(String::new(), |n| n.name.clone());
    let dim = if freedom >= 3 { Dim::Moment } else { Dim::Force };
    let left = unknowns.residual(state).get(at).copied().unwrap_or(f64::NAN);
    let word = FREEDOMS.get(freedom).copied().unwrap_or_default();
    let mut values = vec![(left, dim)];
    let mut acting: Vec<(f64, String)> = Vec::new();
    for Contribution { body: on, connector, category, load } in system.contributions(&state.poses).unwrap_or_default() {
        let value = load.wrench[freedom];
        if on == body && value != 0.0 {
            acting.push((value, connector.unwrap_or_else(|| category.name().to_string())));
        }
    }
    acting.sort_by(|a, b| b.0.abs().total_cmp(&a.0.abs()));
    let told: Vec<String> = acting.iter().take(3).map(|(_, who)| format!("{who} {{}}")).collect();
    values.extend(acting.iter().take(3).map(|(value, _)| (*value, dim)));
    let told = if told.is_empty() { "nothing acts on it".to_string() } else { told.join(", ") };
    let free = loose(system, unknowns, state);
    let error = match free.iter().filter(|(who, _)| *who == name).map(|(_, f)| f.as_str()).collect::<Vec<_>>() {
        list if list.contains(&word) => {
            ClassError::of(format!("nothing holds it in {word}, and {{}} is left there: {told}"), &values)
                .help(format!("moor it, or leave the freedom out: -IGNORE {name} {word}"))
        }
        _ => {
            ClassError::of(format!("no equilibrium in {} steps: {{}} is left in {word}: {told}", options.most), &values)
                .help("-ITER_MAX allows more steps; &INSTATE begins nearer; nothing has been moved")
        }
    };
    SolveError { who: Some(name), error }
}
