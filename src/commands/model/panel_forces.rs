//! `G_PRESSURE`: added mass, damping and wave forces of a body by panels, where it stands.

use crate::commands::model::database;
use crate::commands::model::hydrodynamics::settle_pressure;
use crate::commands::{Job, count};
use indicatif::{ProgressBar, ProgressStyle};
use nalgebra::{DMatrix, Matrix6, Vector3};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_diffraction::{
    DiffractionBody, DiffractionError, DiffractionProblem, FrequencyForces, FrequencyLimit, HullMesh, MirrorPlanes,
    Water,
};
use windlass_hydro::database::Amplitudes;
use windlass_hydro::database::typed::{self, TypedAxes, TypedPeriod};
use windlass_hydro::wetted_hull::WettedHull;
use windlass_model::{AttachedDatabase, Body, Database, DriftMethod, Model, WaveAction};

/// Panels of the whole hull where no size is given.
const USUAL_PANELS: f64 = 1000.0;
/// Panels a wave length below which a result is poor, and below which it is none.
const POOR_PANELS_A_WAVE: f64 = 8.0;
const LEAST_PANELS_A_WAVE: f64 = 4.0;
/// Most panels of the part of a hull that is solved.
const MAX_PANELS: usize = 20_000;
/// Bytes of a pair of panels in a symmetry class, its Rankine part included.
const BYTES_A_PAIR: u64 = 24;
/// Most bytes of all matrices.
const MAX_BYTES: u64 = 8 << 30;
/// Panels a wave length that the shortest of the usual periods has.
const USUAL_PANELS_A_WAVE: f64 = 16.0;
/// Frequencies where no periods are given: from the first, by a step, to the last (rad/s).
const USUAL_FREQUENCIES: [f64; 3] = [0.1, 0.05, 2.0];
/// Exciting forces by pressure and by Haskind's relation that differ by more than this share of the largest are warned of.
const POOR_EXCITATION: f64 = 0.05;

/// What is asked for.
pub struct PanelRequest {
    /// Where the waves go to, from the body's heading (rad).
    pub headings: Vec<f64>,
    /// Periods (s); none chooses them by the panels.
    pub periods: Vec<f64>,
    /// Size of the panels (m); none chooses it by the hull.
    pub size: Option<f64>,
    /// Depth (m) instead of that of the environment.
    pub depth: Option<f64>,
    /// Where the record stands.
    pub span: Span,
}

/// A meshed hull, and what was chosen for it.
struct Meshed {
    hull: WettedHull,
    mesh: HullMesh,
    size: f64,
    frequencies: Vec<f64>,
    has_lid: bool,
    /// Displaced volume of the panels of the whole hull (m3).
    volume: f64,
}

/// Computes the database of a body and attaches it; the report of it is shown.
///
/// # Errors
/// A hull that cannot be meshed where the body stands, periods too short for the panels, more panels than memory, a bottom above the keel,
/// an interrupt: the body keeps what it has.
pub fn compute(job: &mut Job, name: &str, request: &PanelRequest) -> Outcome<()> {
    let span = request.span;
    let Some(body) = job.model.bodies.get(&Model::key(name)).cloned() else { return Ok(()) };
    let around = job.model.surroundings();
    let depth = request.depth.or(around.depth);
    let water = Water { density: around.water_density, gravity: around.gravity, depth };
    let meshed = mesh_hull(&job.model, &body, request, water)?;
    let refused = |error: DiffractionError| Diagnostic::error(format!("{name}: {error}"), span);
    let origin = Vector3::new(0.0, 0.0, meshed.hull.origin_height);
    let problem = DiffractionProblem::new(&[DiffractionBody { mesh: meshed.mesh.clone(), origin }], water);
    let problem = problem.map_err(refused)?;
    let bar = ProgressBar::new(meshed.frequencies.len() as u64);
    if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos} of {len} periods, {elapsed} gone, {eta} to go") {
        bar.set_style(style);
    }
    let mut made: Vec<FrequencyForces> = Vec::new();
    for frequency in &meshed.frequencies {
        if job.is_interrupted() {
            bar.finish_and_clear();
            return Err(Diagnostic::error(format!("interrupted: {name} keeps the database it had, if any"), span));
        }
        made.push(problem.solve(*frequency, &request.headings).map_err(refused)?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    let infinite = problem.added_mass_limit(FrequencyLimit::Infinite).map_err(refused)?;
    let data = database_of(&meshed, &made, &infinite, request, depth, &job.model)
        .map_err(|error| Diagnostic::error(format!("{name}: {error}"), span))?;
    let own = Model::key(&body.name);
    for part in job.model.parts.values_mut().filter(|part| Model::key(&part.body) == own) {
        for piece in &mut part.pieces {
            // the hull of a database, as -DIFTYPE 3DDIF says it
            if meshed.hull.pieces.contains(&piece.name) && piece.waves == WaveAction::ByForm && piece.member.is_none() {
                piece.waves = WaveAction::Database;
            }
        }
    }
    let attached = AttachedDatabase {
        data: Arc::new(data),
        at: [0.0; 3],
        memory: None,
        drift: DriftMethod::Newman,
        hydrostatics: false,
        span,
    };
    let table = report(&body, &meshed, &made, depth, around.gravity);
    database::attach(job, name, attached, span)?;
    settle_pressure(&mut job.model, name);
    let poor = made.iter().map(FrequencyForces::excitation_difference).fold(0.0, f64::max);
    if poor > POOR_EXCITATION {
        let text = format!(
            "{name}: exciting forces by pressure and by Haskind's relation differ by {:.1} % of the largest: the panels are too large",
            100.0 * poor
        );
        job.warn(text, span);
    }
    let shortest = meshed.frequencies.last().map_or(f64::INFINITY, |w| wave_length(*w, water));
    if shortest < POOR_PANELS_A_WAVE * meshed.size {
        let text = format!(
            "{name}: the shortest wave has {:.1} panels; -PANEL {:.2} has eight",
            shortest / meshed.size,
            shortest / POOR_PANELS_A_WAVE
        );
        job.warn(text, span);
    }
    if !meshed.has_lid {
        let text =
            "its waterline is not one ring that a lid can close: results near irregular frequencies are wrong there";
        job.warn(format!("{name}: {text}"), span);
    }
    job.say_tables(&[table]);
    Ok(())
}

/// The mesh and the frequencies.
fn mesh_hull(model: &Model, body: &Body, request: &PanelRequest, water: Water) -> Outcome<Meshed> {
    let (span, name) = (request.span, &body.name);
    let wrong = |text: String| Diagnostic::error(text, span);
    let level = model.surroundings().tide;
    let hull = WettedHull::new(model, body, level).map_err(|error| wrong(error.to_string()))?;
    let size = request.size.unwrap_or_else(|| (hull.area / USUAL_PANELS).sqrt());
    let images = hull.mirrors.iter().map(|used| if *used { 2 } else { 1 }).product::<u32>();
    // before they are made
    let expected = hull.area / (size * size) / f64::from(images);
    let pairs = expected * expected * f64::from(images);
    if !(expected <= MAX_PANELS as f64 && pairs * BYTES_A_PAIR as f64 <= MAX_BYTES as f64) {
        let text = format!(
            "{name}: panels of {size:.3} m would be about {expected:.0} for each symmetry class: {MAX_PANELS} and {} GB are the most",
            MAX_BYTES >> 30
        );
        return Err(wrong(text).help("-PANEL gives a larger size"));
    }
    let mirrors = MirrorPlanes { x: hull.mirrors[0], y: hull.mirrors[1] };
    let quads = hull.panels(size, hull.mirrors);
    let plain = HullMesh::new(&quads, mirrors).map_err(|error| wrong(format!("{name}: {error}")))?;
    let lid = plain.with_lid();
    let (mesh, has_lid) = lid.map_or((plain, false), |mesh| (mesh, true));
    let volume = mesh.volumes()[2].abs() * f64::from(images);
    let wave = |frequency: f64| wave_length(frequency, water);
    let frequencies: Vec<f64> = if request.periods.is_empty() {
        let [first, step, last] = USUAL_FREQUENCIES;
        let all = ((last - first) / step).round() as usize;
        (0..=all).map(|i| first + step * i as f64).filter(|w| wave(*w) >= USUAL_PANELS_A_WAVE * size).collect()
    } else {
        let mut list: Vec<f64> = request.periods.iter().map(|period| TAU / period).collect();
        list.sort_by(f64::total_cmp);
        list.dedup();
        list
    };
    let Some(shortest) = frequencies.last().map(|w| wave(*w)) else {
        let text = format!("{name}: panels of {size:.2} m carry none of the usual periods");
        return Err(wrong(text).help("-PANEL gives a smaller size"));
    };
    if shortest < LEAST_PANELS_A_WAVE * size {
        let text = format!(
            "{name}: the shortest wave, of {shortest:.2} m, has {:.1} panels of {size:.2} m; at least {LEAST_PANELS_A_WAVE} are needed",
            shortest / size
        );
        return Err(wrong(text).help(format!(
            "-PANEL {:.2} has eight, or leave the shortest periods out",
            shortest / POOR_PANELS_A_WAVE
        )));
    }
    Ok(Meshed { hull, mesh, size, frequencies, has_lid, volume })
}

/// Length of a wave (m), by Newton's iteration of the dispersion relation.
fn wave_length(frequency: f64, water: Water) -> f64 {
    let nu = frequency * frequency / water.gravity;
    let Some(depth) = water.depth else { return TAU / nu };
    let mut k = nu / (nu * depth).tanh().sqrt();
    for _ in 0..20 {
        let t = (k * depth).tanh();
        k -= (k * t - nu) / (t + k * depth * (1.0 - t * t));
    }
    TAU / k
}

fn six(matrix: &DMatrix<f64>) -> Matrix6<f64> {
    Matrix6::from_fn(|i, j| matrix.get((i, j)).copied().unwrap_or_default())
}

/// The database of the body, in its axes and about its origin.
fn database_of(
    meshed: &Meshed,
    made: &[FrequencyForces],
    infinite: &DMatrix<f64>,
    request: &PanelRequest,
    depth: Option<f64>,
    model: &Model,
) -> Result<Database, String> {
    let periods: Vec<TypedPeriod> = made
        .iter()
        .map(|forces| TypedPeriod {
            period: TAU / forces.frequency,
            added_mass: Some(six(&forces.added_mass)),
            damping: Some(six(&forces.damping)),
            forces: request
                .headings
                .iter()
                .zip(&forces.excitation)
                .map(|(heading, force)| {
                    let all: Amplitudes = std::array::from_fn(|i| force.get(i).copied().unwrap_or_default());
                    (*heading, all)
                })
                .collect(),
        })
        .collect();
    let axes = TypedAxes { reference: Vector3::zeros(), axes: meshed.hull.axes, yaw: 0.0 };
    let around = model.surroundings();
    let mut data = typed::build("G_PRESSURE", &axes, &periods, &around).map_err(|error| error.to_string())?;
    let mut turn = Matrix6::zeros();
    for at in [0, 3] {
        turn.fixed_view_mut::<3, 3>(at, at).copy_from(&meshed.hull.axes);
    }
    data.infinite = Some(turn * six(infinite) * turn.transpose());
    data.depth = depth;
    data.mass = Some(meshed.hull.volume * around.water_density);
    Ok(data)
}

/// What was computed, a row a period.
fn report(body: &Body, meshed: &Meshed, made: &[FrequencyForces], depth: Option<f64>, gravity: f64) -> Table {
    let water = Water { density: 1.0, gravity, depth };
    let rows: Vec<(f64, f64, f64, f64, usize)> = made
        .iter()
        .rev()
        .map(|forces| {
            let length = wave_length(forces.frequency, water);
            let relation = 100.0 * forces.excitation_difference();
            (TAU / forces.frequency, length, length / meshed.size, relation, forces.iterations)
        })
        .collect();
    let planes = match meshed.hull.mirrors {
        [false, false] => "none",
        [true, false] => "fore and aft",
        [false, true] => "port and starboard",
        [true, true] => "fore and aft, port and starboard",
    };
    let solved = meshed.mesh.hull().len();
    let images = meshed.mesh.mirrors().images().len();
    let lid = if meshed.has_lid { count(meshed.mesh.lid().len(), "panel") } else { "none".to_owned() };
    let mut table = Table::new(format!("Pressures on {}", body.name))
        .with_rows(&rows)
        .column("", "Period", Dim::Time, Digits::Decimals(2), |row| row.0)
        .column("", "Wave Length", Dim::Length, Digits::Decimals(2), |row| row.1)
        .column("", "Panels a Wave", Dim::None, Digits::Decimals(1), |row| row.2)
        .column("", "Haskind", Dim::None, Digits::Decimals(3), |row| row.3)
        .column("", "Products", Dim::None, Digits::Usual, |row| row.4)
        .build();
    table = table.fact("Pieces", meshed.hull.pieces.join(" "), Dim::None);
    table = table.fact("Panels of the Hull", solved * images, Dim::None);
    table = table.fact("Of These Solved For", solved, Dim::None);
    table = table.fact("Lid of the Waterplane", lid, Dim::None);
    table = table.fact("Symmetry", planes, Dim::None);
    table = table.fact("Size of Panels", meshed.size, Dim::Length);
    table = table.fact("Displaced Volume", meshed.hull.volume, Dim::Volume);
    table = table.fact("By the Panels", meshed.volume, Dim::Volume);
    table = match depth {
        Some(depth) => table.fact("Depth", depth, Dim::Length),
        None => table.fact("Depth", "deep water", Dim::None),
    };
    table.note(
        "Haskind: largest difference of exciting forces by pressure and by Haskind's relation, per cent of the largest",
    );
    table
}

/// The usual headings: all round by 15 degrees (rad).
pub fn usual_headings() -> Vec<f64> {
    (0..24).map(|i| f64::from(i) * PI / 12.0).collect()
}
