//! Mean drift of bodies by their panels, with the motions that their mass, stiffness, moorings and damping give them where they stand; `G_MDRIFT`
//! makes it anew.
//!
//! Of several bodies each has a control surface of its own; the one that none fits around, as a dock around a barge, has what the drifts of the others leave of that of
//! the waves far away. The drift of a body alone is that of the waves far away [MARUO-1960]
//! [NEWMAN-1967]; G_MDRIFT finds it by a control surface and by the pressure too, and shows how far all agree.

use crate::commands::Job;
use crate::commands::model::panel_forces::{MeshedBodies, MeshedBody, PanelRequest, progress_bar};
use crate::report::pressure_file::{BodyDrift, least_drift};
use nalgebra::{Complex, DMatrix, Matrix6, Rotation3, Vector3};
use std::f64::consts::TAU;
use std::sync::Arc;
use windlass_base::diagnostic::{Diagnostic, Outcome, Severity};
use windlass_base::pose::Pose;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_diffraction::{
    ControlSurface, DiffractionError, DiffractionProblem, FarFieldDrift, FrequencyForces, MOTIONS, WaveSolution,
};
use windlass_hydro::database::DriftTable;
use windlass_hydro::in_pose;
use windlass_hydro::roll_damping::fix_critical_damping;
use windlass_hydro::sea::dispersion::wave_number;
use windlass_model::{AttachedDatabase, Database, DriftMethod, LoadKind, Model};
use windlass_solve::SolveError;
use windlass_solve::frequency::{LinearSystem, Motions};

/// Far field and control surface that differ by more than this share of the largest drift are warned of.
pub const POOR_AGREEMENT: f64 = 0.05;

/// How mean drift is found: of a body alone, of several bodies, and of the one of them that no control surface fits around.
const BY_FAR_FIELD: &str = "by the waves far away";
const BY_SURFACE: &str = "by a control surface around it";
const BY_REST: &str = "by the waves far away from all bodies, less the drift of the others, as no control surface around it leaves them outside";

/// What of the largest force is rounding.
const ROUNDING_SHARE: f64 = 1e-6;
/// What of the largest drift of a database is nothing: planes of symmetry.
const NOISE_SHARE: f64 = 1e-12;

type C = Complex<f64>;

/// What motions the bodies have in the waves.
pub enum DriftSource {
    /// Those of the equations of motion without the databases of the bodies.
    Motions(Box<LinearSystem>),
    /// None: the body is held.
    Fixed,
    /// There is no drift, and why.
    None(String),
}

impl DriftSource {
    /// What a report says of it, with how the drift of each body was found.
    pub fn said(&self, meshed: &MeshedBodies, databases: &[Database]) -> String {
        let method = |data: &Database| data.drift.as_ref().and_then(|drift| drift.method.clone()).unwrap_or_default();
        let methods: Vec<String> = databases.iter().map(method).collect();
        let (way, who) = match methods.as_slice() {
            [only] => (only.clone(), "the body"),
            list if list.iter().all(|own| own == BY_SURFACE) => {
                ("by a control surface around each body".to_owned(), "the bodies")
            }
            list => {
                let of = |(body, own): (&MeshedBody, &String)| format!("{} {own}", body.name);
                (meshed.bodies.iter().zip(list).map(of).collect::<Vec<_>>().join("; "), "the bodies")
            }
        };
        match self {
            DriftSource::Motions(_) => format!("{way}, of {who} in motion"),
            DriftSource::Fixed => format!("{way}, of {who} held"),
            DriftSource::None(_) => "none".into(),
        }
    }
}

/// The motions of bodies that are meshed; none where drift is not asked for. Damping of roll in per cent of critical is that with the added mass of the
/// databases that there are.
pub fn source(model: &Model, meshed: &MeshedBodies, is_asked: bool) -> DriftSource {
    if !is_asked {
        return DriftSource::None("-MEAN_DRIFT NO".into());
    }
    let is_held = |body: &MeshedBody| model.bodies.get(&body.key).is_some_and(|body| body.ignored.len() >= MOTIONS);
    if meshed.bodies.iter().all(is_held) {
        return DriftSource::Fixed;
    }
    match without_databases(model.clone(), meshed) {
        Ok(linear) => DriftSource::Motions(Box::new(linear)),
        Err(error) => DriftSource::None(said(error)),
    }
}

/// As [`source`] before the bodies are solved: whatever databases they have, so that the same is computed again. [`settle_critical_damping`] follows
/// where [`has_critical_damping`].
pub fn first_source(model: &Model, meshed: &MeshedBodies, is_asked: bool) -> DriftSource {
    let mut bare = model.clone();
    remove_databases(&mut bare, meshed);
    source(&bare, meshed, is_asked)
}

/// What is wrong with the place that motions are taken about, as that bodies are not at rest there.
pub fn place_warnings(source: &DriftSource) -> Vec<String> {
    let DriftSource::Motions(linear) = source else { return Vec::new() };
    let warnings = linear.notes.iter().filter(|note| note.severity == Severity::Warning);
    warnings.map(|note| format!("mean drift: {}", note.text)).collect()
}

/// Whether motions wait for the added mass of all frequencies, of which damping of roll in per cent of critical is made.
pub fn has_critical_damping(model: &Model, source: &DriftSource) -> bool {
    let is_critical = |kind: &LoadKind| matches!(kind, LoadKind::RollDamping(given) if given.critical > 0.0);
    matches!(source, DriftSource::Motions(_)) && model.loads.iter().any(|load| is_critical(&load.kind))
}

/// The same motions with damping of roll in per cent of critical by the added mass that was found.
pub fn settle_critical_damping(
    model: &Model,
    meshed: &MeshedBodies,
    forces: &[FrequencyForces],
    source: &mut DriftSource,
) {
    let mut with_added_mass = model.clone();
    for (i, body) in meshed.bodies.iter().enumerate() {
        let turn = *Rotation3::from_axis_angle(&Vector3::z_axis(), -body.turn).matrix();
        let own = |forces: &FrequencyForces| {
            let block = forces.added_mass.fixed_view::<MOTIONS, MOTIONS>(MOTIONS * i, MOTIONS * i).into_owned();
            in_pose(&block, &Pose { axes: turn, ..Pose::default() })
        };
        let data = Database {
            frequencies: meshed.frequencies.clone(),
            added_mass: forces.iter().map(own).collect(),
            ..Database::default()
        };
        if let Some(body) = with_added_mass.bodies.get_mut(&body.key) {
            body.database = Some(AttachedDatabase {
                data: Arc::new(data),
                at: [0.0; 3],
                memory: None,
                drift: DriftMethod::None,
                drift_damping: None,
                hydrostatics: false,
                span: body.span,
            });
        }
    }
    *source = match without_databases(with_added_mass, meshed) {
        Ok(linear) => DriftSource::Motions(Box::new(linear)),
        Err(error) => DriftSource::None(said(error)),
    };
}

/// The equations of motion without the databases of bodies that are meshed, but for what damping of roll in per cent of critical takes of their added mass.
fn without_databases(mut model: Model, meshed: &MeshedBodies) -> Result<LinearSystem, SolveError> {
    fix_critical_damping(&mut model).map_err(SolveError::new)?;
    remove_databases(&mut model, meshed);
    LinearSystem::new(&model)
}

fn remove_databases(model: &mut Model, meshed: &MeshedBodies) {
    for meshed in &meshed.bodies {
        if let Some(body) = model.bodies.get_mut(&meshed.key) {
            body.database = None;
        }
    }
}

/// What of a source the drift depends on: all of stiffness, mass, damping and other loads of waves at the frequencies.
pub fn numbers(source: &DriftSource, meshed: &MeshedBodies, headings: &[f64]) -> Vec<f64> {
    let linear = match source {
        DriftSource::Motions(linear) => linear,
        DriftSource::Fixed => return vec![1.0],
        DriftSource::None(_) => return vec![2.0],
    };
    let mut list = vec![3.0, meshed.heading, meshed.place[0], meshed.place[1]];
    list.extend(linear.stiffness.iter());
    for frequency in &meshed.frequencies {
        let (mass, damping) = linear.inertia_and_damping(*frequency);
        list.extend(mass.iter().chain(damping.iter()));
        for heading in headings {
            let loads = linear.excitation(*frequency, heading + meshed.heading).unwrap_or_default();
            list.extend(loads.iter().flat_map(|load| [load.re, load.im]));
        }
    }
    list
}

/// A control surface around each of several bodies, none around one that it cannot leave the others outside of; none around a body alone, whose waves far away
/// tell its drift.
///
/// # Errors
/// More than one body without such a surface, in words.
pub fn surfaces(meshed: &MeshedBodies, problem: &DiffractionProblem) -> Result<Vec<Option<ControlSurface>>, String> {
    if meshed.bodies.len() == 1 {
        return Ok(Vec::new());
    }
    let around = |(i, body): (usize, &MeshedBody)| problem.turned_control_box(i, body.turn).map(ControlSurface::Box);
    let made: Vec<_> = meshed.bodies.iter().enumerate().map(around).collect();
    let without: Vec<&str> = meshed
        .bodies
        .iter()
        .zip(&made)
        .filter(|(_, surface)| surface.is_none())
        .map(|(body, _)| body.name.as_str())
        .collect();
    if without.len() > 1 {
        let names = without.join(", ");
        return Err(format!(
            "no upright box fits around each of {names} that leaves the other bodies outside, a tenth of the size of the panels from all hulls at least"
        ));
    }
    Ok(made)
}

/// How the drift of each body is found.
pub fn methods(surfaces: &[Option<ControlSurface>]) -> Vec<String> {
    match surfaces {
        [] => vec![BY_FAR_FIELD.to_owned()],
        list => list.iter().map(|own| if own.is_some() { BY_SURFACE } else { BY_REST }.to_owned()).collect(),
    }
}

/// The drift of a frequency; none where there is no source.
///
/// # Errors
/// Motions that have no bound; a control surface that crosses a hull.
pub fn of_frequency(
    source: &DriftSource,
    meshed: &MeshedBodies,
    surfaces: &[Option<ControlSurface>],
    waves: &WaveSolution,
    headings: &[f64],
) -> Result<Option<BodyDrift>, String> {
    let Some(motions) = motions_in_waves(source, meshed, &waves.forces, headings)? else { return Ok(None) };
    let far: Vec<FarFieldDrift> =
        motions.iter().enumerate().map(|(heading, motions)| at_heading(waves, heading, motions)).collect();
    let near = near_field(waves, &motions);
    if meshed.bodies.len() == 1 {
        return Ok(Some(of_body_alone(&far, near)));
    }
    // force, and moment about the vertical through the origin of the group
    let mut sums = vec![[0.0; 3]; headings.len()];
    let mut found: Vec<Option<Vec<[f64; 3]>>> = Vec::new();
    for (body, surface) in meshed.bodies.iter().zip(surfaces) {
        let Some(surface) = surface else {
            found.push(None);
            continue;
        };
        let drifts = waves.control_surface_drift(&motions, surface);
        let drifts = drifts.ok_or_else(|| format!("the control surface around {} crosses a hull", body.name))?;
        let [x, y] = surface.centre();
        let own: Vec<[f64; 3]> =
            drifts.iter().map(|own| [own.surge, own.sway, own.yaw + x * own.sway - y * own.surge]).collect();
        for (sum, own) in sums.iter_mut().zip(&own) {
            (0..3).for_each(|i| sum[i] += own[i]);
        }
        found.push(Some(own));
    }
    let of_far = |far: &FarFieldDrift| [far.surge, far.sway, far.yaw];
    let rest = || far.iter().zip(&sums).map(|(far, sum)| [0, 1, 2].map(|i| of_far(far)[i] - sum[i])).collect();
    let is_whole = found.iter().all(Option::is_some);
    let found: Vec<Vec<[f64; 3]>> = found.into_iter().map(|own| own.unwrap_or_else(rest)).collect();
    let values = (0..headings.len())
        .map(|heading| {
            let about_own = |(body, own): (&MeshedBody, &Vec<[f64; 3]>)| {
                let [x, y, moment] = own.get(heading).copied().unwrap_or_default();
                [x, y, moment - body.origin.x * y + body.origin.y * x]
            };
            meshed.bodies.iter().zip(&found).map(about_own).collect()
        })
        .collect();
    let lever = meshed.bodies.iter().map(|body| body.origin.x.hypot(body.origin.y)).fold(0.0, f64::max);
    let over_lever = |[x, y, moment]: [f64; 3]| [x, y, if lever > 0.0 { moment / lever } else { 0.0 }];
    let sums = far.iter().zip(sums).map(|(far, sum)| [over_lever(sum), over_lever(of_far(far))]);
    Ok(Some(BodyDrift { values, near, sums: if is_whole { sums.collect() } else { Vec::new() } }))
}

/// Where the drift of a body alone is largest: the number of the frequency, and the largest difference over all headings of the drift by the waves far away
/// from that by a control surface, over the largest. None where there is no drift, or no control surface fits.
pub fn check_of_largest(
    source: &DriftSource,
    meshed: &MeshedBodies,
    problem: &DiffractionProblem,
    drifts: &[BodyDrift],
    headings: &[f64],
) -> Option<(usize, f64)> {
    let forces = |own: &BodyDrift| own.values.iter().filter_map(|of| of.first().copied()).collect::<Vec<_>>();
    let largest_of = |own: &BodyDrift| forces(own).iter().map(|[x, y, _]| x.hypot(*y)).fold(0.0, f64::max);
    let sizes = drifts.iter().map(largest_of).enumerate();
    let least = least_drift(meshed.water, meshed.size);
    let (at, largest) = sizes.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, largest)| *largest > least)?;
    let waves = problem.solve_waves(*meshed.frequencies.get(at)?, headings).ok()?;
    let motions = motions_in_waves(source, meshed, &waves.forces, headings).ok()??;
    let near = waves.control_surface_drift(&motions, &ControlSurface::Cylinder(problem.control_cylinder()))?;
    let off =
        forces(drifts.get(at)?).into_iter().zip(near).map(|([x, y, _], near)| (x - near.surge).hypot(y - near.sway));
    Some((at, off.fold(0.0, f64::max) / largest))
}

/// Motions of the bodies in waves of unit amplitude, heading by heading, six a body in axes of the group, phases to its origin; none where there is no
/// source.
///
/// # Errors
/// Motions that have no bound, in words.
pub fn motions_in_waves(
    source: &DriftSource,
    meshed: &MeshedBodies,
    forces: &FrequencyForces,
    headings: &[f64],
) -> Result<Option<Vec<Vec<C>>>, String> {
    match source {
        DriftSource::Motions(linear) => motions(linear, meshed, forces, headings).map(Some),
        DriftSource::Fixed => Ok(Some(vec![vec![C::default(); MOTIONS * meshed.bodies.len()]; headings.len()])),
        DriftSource::None(_) => Ok(None),
    }
}

/// Drift by the pressure on the hulls: heading by heading, then body by body.
fn near_field(waves: &WaveSolution, motions: &[Vec<C>]) -> Vec<Vec<[f64; 3]>> {
    let found = waves.near_field_drift(motions).unwrap_or_default();
    found.iter().map(|of| of.iter().map(|own| [own.surge, own.sway, own.yaw]).collect()).collect()
}

/// The drift of a body alone, heading by heading.
fn of_body_alone(far: &[FarFieldDrift], near: Vec<Vec<[f64; 3]>>) -> BodyDrift {
    BodyDrift { values: far.iter().map(|d| vec![[d.surge, d.sway, d.yaw]]).collect(), near, sums: Vec::new() }
}

/// Takes away what rounding leaves of the drift of symmetric hulls.
pub fn remove_noise(drifts: &mut [BodyDrift]) {
    let all = || drifts.iter().flat_map(|own| own.values.iter().flatten());
    let force = all().map(|[x, y, _]| x.hypot(*y)).fold(0.0, f64::max);
    // the moment of a symmetric hull is rounding of its forces over the lengths of waves
    let moment = all().map(|[.., turn]| turn.abs()).fold(force, f64::max);
    for own in drifts.iter_mut().flat_map(|own| own.values.iter_mut().flatten()) {
        for (value, largest) in own.iter_mut().zip([force, force, moment]) {
            if value.abs() < NOISE_SHARE * largest {
                *value = 0.0;
            }
        }
    }
}

/// An error in words, with whom it is about.
fn said(error: SolveError) -> String {
    match error.who {
        Some(who) => format!("{who}: {}", error.error),
        None => error.error.to_string(),
    }
}

/// Motions in waves of unit amplitude, heading by heading, six a body in axes of the group, phases to its origin.
fn motions(
    linear: &LinearSystem,
    meshed: &MeshedBodies,
    forces: &FrequencyForces,
    headings: &[f64],
) -> Result<Vec<Vec<C>>, String> {
    let frequency = forces.frequency;
    let number = |key: &String| linear.system.nodes.iter().position(|node| node.key == *key);
    // a body that is held is none
    let nodes: Vec<Option<usize>> = meshed.bodies.iter().map(|body| number(&body.key)).collect();
    let moving = || nodes.iter().enumerate().filter_map(|(i, node)| Some((i, (*node)?)));
    let turned = Rotation3::from_axis_angle(&Vector3::z_axis(), meshed.heading);
    let mut to_global = Matrix6::zeros();
    for at in [0, 3] {
        to_global.fixed_view_mut::<3, 3>(at, at).copy_from(turned.matrix());
    }
    let (mut mass, mut damping) = linear.inertia_and_damping(frequency);
    for (i, row) in moving() {
        for (j, column) in moving() {
            let own = |all: &DMatrix<f64>| -> Matrix6<f64> {
                let block = Matrix6::from_fn(|a, b| all[(MOTIONS * i + a, MOTIONS * j + b)]);
                to_global * block * to_global.transpose()
            };
            let mut block = mass.fixed_view_mut::<6, 6>(MOTIONS * row, MOTIONS * column);
            block += own(&forces.added_mass);
            let mut block = damping.fixed_view_mut::<6, 6>(MOTIONS * row, MOTIONS * column);
            block += own(&forces.damping);
        }
    }
    let k = wave_number(frequency, meshed.water.depth, meshed.water.gravity).map_err(|error| error.to_string())?;
    let phase = |toward: f64| C::from_polar(1.0, k * (meshed.place[0] * toward.cos() + meshed.place[1] * toward.sin()));
    let mut loads: Vec<Motions> = Vec::new();
    for (heading, own) in headings.iter().zip(&forces.excitation) {
        let toward = heading + meshed.heading;
        let mut all = linear.excitation(frequency, toward).map_err(said)?;
        for (i, row) in moving() {
            for a in 0..MOTIONS {
                let turned: C = (0..MOTIONS).map(|b| own[MOTIONS * i + b] * to_global[(a, b)]).sum();
                all[MOTIONS * row + a] += turned * phase(toward);
            }
        }
        loads.push(all);
    }
    let made = linear.motions_with(frequency, (mass, damping), &loads).map_err(said)?;
    let in_group = |(heading, all): (&f64, &Motions)| {
        let back = phase(heading + meshed.heading).conj();
        let of_node = |node: &Option<usize>| {
            let node = *node;
            let motion = move |row: usize, a: usize| {
                (0..MOTIONS).map(|b| all[MOTIONS * row + b] * to_global[(b, a)]).sum::<C>() * back
            };
            (0..MOTIONS).map(move |a| node.map_or_else(C::default, |row| motion(row, a)))
        };
        nodes.iter().flat_map(of_node).collect()
    };
    Ok(headings.iter().zip(&made).map(in_group).collect())
}

/// Other damping of roll than that of radiated waves, over the critical one, below which roll is said to have none; and of both below which the
/// roll at its natural period is too large to be let pass.
const NO_ROLL_DAMPING: f64 = 2e-3;
const LIGHT_ROLL_DAMPING: f64 = 0.05;

/// The warnings of bodies whose roll at its natural period has the damping of radiated waves alone; none where that period is not among the
/// frequencies.
pub fn roll_warnings(
    model: &Model,
    source: &DriftSource,
    meshed: &MeshedBodies,
    databases: &[Database],
) -> Vec<String> {
    let made;
    let linear = match source {
        DriftSource::Motions(linear) => linear.as_ref(),
        // what has no equations of motion is said where they are needed
        _ => match without_databases(model.clone(), meshed) {
            Ok(linear) => {
                made = linear;
                &made
            }
            Err(_) => return Vec::new(),
        },
    };
    let warning = |(body, data)| roll_warning(linear, meshed, (body, data), has_quadratic_roll_damping(model, body));
    meshed.bodies.iter().zip(databases).filter_map(warning).collect()
}

fn has_quadratic_roll_damping(model: &Model, body: &MeshedBody) -> bool {
    let parts = || model.parts.values().filter(|part| Model::key(&part.body) == body.key);
    let by_record = |kind: &LoadKind| match kind {
        LoadKind::EddyDamping(factor) => *factor > 0.0,
        LoadKind::RollDamping(given) => given.quadratic > 0.0,
        _ => false,
    };
    parts().any(|part| part.pieces.iter().any(|piece| piece.eddy_damping > 0.0))
        || model
            .loads
            .iter()
            .any(|load| by_record(&load.kind) && parts().any(|part| Model::key(&part.name) == Model::key(&load.part)))
}

fn roll_warning(
    linear: &LinearSystem,
    meshed: &MeshedBodies,
    (body, data): (&MeshedBody, &Database),
    is_quadratic: bool,
) -> Option<String> {
    const ROLL: usize = 3;
    let node = linear.system.nodes.iter().position(|node| node.key == body.key)?;
    if !linear.system.nodes.get(node)?.moves(ROLL) {
        return None;
    }
    let at = MOTIONS * node + ROLL;
    // along the heading of the body its roll is about x
    let turned = Rotation3::from_axis_angle(&Vector3::z_axis(), -meshed.heading - body.turn);
    let about = |all: &DMatrix<f64>| -> f64 {
        let block = all.fixed_view::<3, 3>(at, at);
        (turned.matrix() * block * turned.matrix().transpose())[(0, 0)]
    };
    let stiffness = about(&linear.stiffness);
    let (mass, damping) = linear.inertia_and_damping(meshed.frequencies.first().copied()?);
    let (own, given) = (about(&mass), about(&damping));
    // mass and added mass as far as they go with the stiffness
    let rows: Vec<[f64; 3]> = data
        .frequencies
        .iter()
        .zip(data.added_mass.iter().zip(&data.damping))
        .map(|(w, (added, damping))| [*w, w * w * (own + added[(ROLL, ROLL)]) - stiffness, damping[(ROLL, ROLL)]])
        .collect();
    let pair = rows.windows(2).find(|pair| matches!(pair, [low, high] if low[1] <= 0.0 && high[1] > 0.0))?;
    let [low, high] = pair else { return None };
    let share = -low[1] / (high[1] - low[1]);
    let between = |a: f64, b: f64| a + (b - a) * share;
    let frequency = between(low[0], high[0]);
    let radiated = between(low[2], high[2]);
    let critical = 2.0 * stiffness / frequency;
    let shares = [given / critical, (given + radiated) / critical];
    let is_light = shares[0] < NO_ROLL_DAMPING && shares[1] < LIGHT_ROLL_DAMPING;
    if is_light && is_quadratic {
        return Some(format!(
            "{}: the damping of roll that grows with its rate is none of motions in waves of unit amplitude, as of RAO and of its mean drift: at its natural \
             period of {:.2} s they have {:.2} % of critical, and are too large; -LINEAR or -CRITICAL of #ROLL_DAMPING acts in them",
            body.name,
            TAU / frequency,
            100.0 * shares[1]
        ));
    }
    is_light.then(|| {
        format!(
            "{}: roll has the damping of radiated waves alone, {:.2} % of critical at its natural period of {:.2} s, where it is too large: \
             #ROLL_DAMPING or #TANAKA gives what eddies take",
            body.name,
            100.0 * shares[1],
            TAU / frequency
        )
    })
}

/// Drift of a heading by the waves far away, with given motions.
fn at_heading(waves: &WaveSolution, heading: usize, motions: &[C]) -> FarFieldDrift {
    let none = FarFieldDrift { surge: 0.0, sway: 0.0, yaw: 0.0, energy_residual: 0.0 };
    waves.far_field_drift(heading, motions).unwrap_or(none)
}

/// Drift by heading of a database, then frequency, from that by frequency, then heading (rad).
fn by_heading(headings: &[f64], wanted: &[f64], drifts: &[BodyDrift]) -> Vec<Vec<[f64; 6]>> {
    let off = |a: f64, b: f64| {
        let turn = (a - b).rem_euclid(TAU);
        turn.min(TAU - turn)
    };
    wanted
        .iter()
        .map(|heading| {
            let nearest =
                (0..headings.len()).min_by(|a, b| off(headings[*a], *heading).total_cmp(&off(headings[*b], *heading)));
            let of = |row: &BodyDrift| {
                let [x, y, turn] = nearest.and_then(|at| row.values.get(at)?.first().copied()).unwrap_or_default();
                [x, y, 0.0, 0.0, 0.0, turn]
            };
            drifts.iter().map(of).collect()
        })
        .collect()
}

/// What G_MDRIFT shows of a frequency.
struct DriftRow {
    period: f64,
    /// Heading of the largest force (rad, where the waves come from), and the force there: far away, by the control surface, by the pressure (N/m2).
    heading: f64,
    far: [f64; 2],
    around: [f64; 2],
    near: [f64; 2],
    /// Largest difference of the forces over all headings from those far away: by the control surface, and by the pressure on the hull (N/m2).
    differences: [f64; 2],
}

/// Computes the mean drift of a body and puts it into its database; the report of it is shown.
///
/// # Errors
/// As of [`MeshedBodies::new`]; motions without bound; an interrupt: the body keeps what it has.
pub fn compute(job: &mut Job, name: &str, data: &Database, request: &PanelRequest) -> Outcome<()> {
    let span = request.span;
    let wrong = |text: String| Diagnostic::error(format!("{name}: {text}"), span);
    let meshed = MeshedBodies::new(&job.model, &[name.to_owned()], request)?;
    let problem = meshed.problem(span)?;
    let refused = |error: DiffractionError| wrong(error.to_string());
    let source = source(&job.model, &meshed, true);
    if let DriftSource::None(why) = &source {
        return Err(wrong(why.clone()));
    }
    let surface = ControlSurface::Cylinder(problem.control_cylinder());
    let bar = progress_bar(meshed.frequencies.len());
    let (mut drifts, mut rows) = (Vec::new(), Vec::new());
    for frequency in &meshed.frequencies {
        if job.is_interrupted() {
            bar.finish_and_clear();
            return Err(wrong("interrupted: it keeps the drift it had, if any".into()));
        }
        let waves = problem.solve_waves(*frequency, &request.headings).map_err(refused)?;
        let motions = match &source {
            DriftSource::Motions(linear) => {
                motions(linear, &meshed, &waves.forces, &request.headings).map_err(wrong)?
            }
            _ => vec![vec![C::default(); MOTIONS]; request.headings.len()],
        };
        let far: Vec<FarFieldDrift> =
            motions.iter().enumerate().map(|(heading, motions)| at_heading(&waves, heading, motions)).collect();
        let around = waves.control_surface_drift(&motions, &surface);
        let around = around.ok_or_else(|| wrong("no control surface fits around it".into()))?;
        let around: Vec<[f64; 2]> = around.iter().map(|own| [own.surge, own.sway]).collect();
        let drift = of_body_alone(&far, near_field(&waves, &motions));
        rows.extend(drift_row(*frequency, &request.headings, &around, &drift));
        drifts.push(drift);
        bar.inc(1);
    }
    bar.finish_and_clear();
    remove_noise(&mut drifts);
    let mut headings = request.headings.clone();
    headings.iter_mut().for_each(|heading| *heading = heading.rem_euclid(TAU));
    headings.sort_by(f64::total_cmp);
    headings.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    let drift = DriftTable {
        frequencies: meshed.frequencies.clone(),
        values: by_heading(&request.headings, &headings, &drifts),
        headings,
        method: Some(BY_FAR_FIELD.to_owned()),
    };
    let largest = rows.iter().map(|row: &DriftRow| row.far[0].hypot(row.far[1])).fold(0.0, f64::max);
    let worst = rows.iter().map(|row| row.differences[0]).fold(0.0, f64::max);
    if worst > POOR_AGREEMENT * largest && largest > least_drift(meshed.water, meshed.size) {
        let text = format!(
            "far field and control surface differ by {:.1} % of the largest drift, more than {:.0} %: the panels are too large, -PANEL {:.2} would agree",
            100.0 * worst / largest,
            100.0 * POOR_AGREEMENT,
            meshed.size * (POOR_AGREEMENT * largest / worst).sqrt()
        );
        job.warn(format!("{name}: {text}"), span);
    }
    let table = report(name, &meshed, &source, (&rows, largest));
    let key = Model::key(name);
    if let Some(attached) = job.model.bodies.get_mut(&key).and_then(|body| body.database.as_mut()) {
        attached.data = Arc::new(Database { drift: Some(drift), ..data.clone() });
    }
    job.say_tables(&[table]);
    Ok(())
}

/// The row of a frequency; none without headings. `around` is the force by a control surface.
fn drift_row(frequency: f64, headings: &[f64], around: &[[f64; 2]], drift: &BodyDrift) -> Option<DriftRow> {
    let force = |list: &Vec<[f64; 3]>| list.first().map_or([0.0; 2], |[x, y, _]| [*x, *y]);
    let [far, near] = [&drift.values, &drift.near].map(|of| of.iter().map(force).collect::<Vec<[f64; 2]>>());
    let size = |[x, y]: &[f64; 2]| x.hypot(*y);
    let largest = far.iter().map(size).fold(0.0, f64::max);
    // the first of equals, as of both sides of a hull
    let at = far.iter().position(|own| size(own) >= largest * (1.0 - ROUNDING_SHARE))?;
    let clean = |of: &[[f64; 2]]| {
        let force = of.get(at).copied().unwrap_or_default();
        force.map(|v| if v.abs() < ROUNDING_SHARE * largest { 0.0 } else { v })
    };
    let difference =
        |other: &[[f64; 2]]| far.iter().zip(other).map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1])).fold(0.0, f64::max);
    Some(DriftRow {
        period: TAU / frequency,
        heading: (headings.get(at)? + 0.5 * TAU).rem_euclid(TAU),
        far: clean(&far),
        around: clean(around),
        near: clean(&near),
        differences: [difference(around), difference(&near)],
    })
}

fn report(name: &str, meshed: &MeshedBodies, source: &DriftSource, (rows, largest): (&[DriftRow], f64)) -> Table {
    let force = Dim::Derived { force: 1, length: -2, seconds: 0 };
    let mut rows: Vec<&DriftRow> = rows.iter().collect();
    rows.reverse();
    let share = |difference: f64| if largest > 0.0 { 100.0 * difference / largest } else { 0.0 };
    let mut table = Table::new(format!("Mean Drift by Panels of {name}"))
        .with_rows(&rows)
        .column("", "Period", Dim::Time, Digits::Decimals(2), |row| row.period)
        .column("", "Heading", Dim::Angle, Digits::Usual, |row| row.heading)
        .column("Far Field", "Far X", force, Digits::Scientific(4), |row| row.far[0])
        .column("Far Field", "Far Y", force, Digits::Scientific(4), |row| row.far[1])
        .column("Control Surface", "Surface X", force, Digits::Scientific(4), |row| row.around[0])
        .column("Control Surface", "Surface Y", force, Digits::Scientific(4), |row| row.around[1])
        .column("Near Field", "Near X", force, Digits::Scientific(4), |row| row.near[0])
        .column("Near Field", "Near Y", force, Digits::Scientific(4), |row| row.near[1])
        .column("Difference", "of Surface", Dim::None, Digits::Decimals(2), |row| share(row.differences[0]))
        .column("Difference", "of Near Field", Dim::None, Digits::Decimals(2), |row| share(row.differences[1]))
        .build();
    table = table.fact("Size of Panels", meshed.size, Dim::Length);
    table =
        table.fact("Motions", if matches!(source, DriftSource::Fixed) { "held" } else { "free, as moored" }, Dim::None);
    table.note("over the square of the wave amplitude, at the heading of the largest force, along the heading of the body; V_MDRIFT has every heading");
    table.note(
        "Near Field: by the pressure on the hull, which does not act: beside sharp edges the velocity has no bound, and it needs far smaller panels there than the others",
    );
    table.note("Difference: largest difference from the far field over all headings, per cent of the largest force; solves use the far field");
    if let DriftSource::Motions(linear) = source {
        // remarks are of motions without databases
        table.add_notes(linear.notes.iter().filter(|note| note.severity == Severity::Warning).cloned());
    }
    table
}
