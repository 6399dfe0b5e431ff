//! `G_PRESSURE`: added mass, damping and wave forces of bodies by panels, where they stand. Several bodies are solved together: each has a
//! database with the radiation of the others.

use crate::commands::model::database;
use crate::commands::model::hydrodynamics::settle_pressure;
use crate::commands::model::panel_drift::{self, DriftSource};
use crate::commands::{Job, count};
use indicatif::{ProgressBar, ProgressStyle};
use nalgebra::{Complex, DMatrix, Matrix3, Matrix6, Rotation3, Vector3};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_diffraction::{
    DiffractionBody, DiffractionError, DiffractionProblem, FrequencyForces, FrequencyLimit, HullMesh, MOTIONS,
    MirrorPlanes, Water,
};
use windlass_hydro::database::typed::{self, TypedAxes, TypedPeriod};
use windlass_hydro::database::{Amplitudes, DriftTable};
use windlass_hydro::wetted_hull::WettedHull;
use windlass_model::{AttachedDatabase, Body, Database, DriftMethod, Interaction, Model, WaveAction};

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
/// How the source of a database begins that was made here.
pub const SOURCE: &str = "G_PRESSURE";

type C = Complex<f64>;

/// What is asked for.
pub struct PanelRequest {
    /// Where the waves go to, from the heading of the first body (rad).
    pub headings: Vec<f64>,
    /// Periods (s); none chooses them by the panels.
    pub periods: Vec<f64>,
    /// Size of the panels (m); none chooses it by the hulls.
    pub size: Option<f64>,
    /// Depth (m) instead of that of the environment.
    pub depth: Option<f64>,
    /// Where the record stands.
    pub span: Span,
}

/// A meshed body. Positions are those of the group: x along the heading of its first body, the origin below or above the origin of that body
/// at the water level.
pub struct MeshedBody {
    /// Name of the body.
    pub name: String,
    /// Key of the body.
    pub key: String,
    hull: WettedHull,
    /// Where its origin is (m).
    pub origin: Vector3<f64>,
    /// Its heading from that of the group (rad).
    turn: f64,
    has_lid: bool,
    /// Panels of its mesh, of the part that is solved.
    panels: usize,
    lid_panels: usize,
    /// Displaced volume of its panels, with those of the images (m3).
    volume: f64,
}

/// The bodies of a problem, and what was chosen for them.
pub struct MeshedBodies {
    /// The bodies.
    pub bodies: Vec<MeshedBody>,
    /// Heading of the group (rad), and where its origin is on the plan (m).
    pub heading: f64,
    /// Where the origin of the group is on the plan (m).
    pub place: [f64; 2],
    /// Size of the panels (m).
    pub size: f64,
    /// Frequencies, growing (rad/s).
    pub frequencies: Vec<f64>,
    /// The water.
    pub water: Water,
    mirrors: MirrorPlanes,
}

impl MeshedBodies {
    /// Their names in a sentence.
    pub fn names(&self) -> String {
        let names: Vec<&str> = self.bodies.iter().map(|body| body.name.as_str()).collect();
        match names.as_slice() {
            [first @ .., last] if !first.is_empty() => format!("{} and {last}", first.join(", ")),
            list => list.concat(),
        }
    }

    /// Meshes bodies where they stand, and makes the problem of them.
    ///
    /// # Errors
    /// A hull that cannot be meshed; bodies that overlap; periods too short for the panels; more panels than memory; a bottom above a keel.
    pub fn new(model: &Model, names: &[String], request: &PanelRequest) -> Outcome<(Self, DiffractionProblem)> {
        let around = model.surroundings();
        let depth = request.depth.or(around.depth);
        let water = Water { density: around.water_density, gravity: around.gravity, depth };
        let wrong = |text: String| Diagnostic::error(text, request.span);
        let mut hulls: Vec<(String, &Body, WettedHull)> = Vec::new();
        for name in names {
            let key = Model::key(name);
            let Some(body) = model.bodies.get(&key) else { continue };
            let hull = WettedHull::new(model, body, around.tide).map_err(|error| wrong(error.to_string()))?;
            hulls.push((key, body, hull));
        }
        let Some((_, first, _)) = hulls.first() else { return Err(wrong("there is no body to mesh".into())) };
        let (heading, place) = (first.position.turn[2], [first.position.shift[0], first.position.shift[1]]);
        let alone = hulls.len() == 1;
        let mirrors = match hulls.as_slice() {
            [(_, _, hull)] => MirrorPlanes { x: hull.mirrors[0], y: hull.mirrors[1] },
            _ => MirrorPlanes::default(),
        };
        let images = mirrors.images().len() as f64;
        let area: f64 = hulls.iter().map(|(_, _, hull)| hull.area).sum();
        let size = request.size.unwrap_or_else(|| (area / (USUAL_PANELS * hulls.len() as f64)).sqrt());
        // before they are made; the lid has about as many as its part of the area
        let expected = area / (size * size) / images;
        let pairs = expected * expected * images;
        if !(expected <= MAX_PANELS as f64 && pairs * BYTES_A_PAIR as f64 <= MAX_BYTES as f64) {
            let text = format!(
                "{}: panels of {size:.3} m would be about {expected:.0} for each symmetry class, of {:.1} GB: {MAX_PANELS} and {} GB are the most",
                names.join(", "),
                pairs * BYTES_A_PAIR as f64 / f64::powi(2.0, 30),
                MAX_BYTES >> 30
            );
            return Err(wrong(text).help("-PANEL gives a larger size"));
        }
        let mut bodies = Vec::new();
        let mut parts = Vec::new();
        for (key, body, hull) in hulls {
            let refused = |error: DiffractionError| wrong(format!("{}: {error}", body.name));
            let turn = body.position.turn[2] - heading;
            let (dx, dy) = (body.position.shift[0] - place[0], body.position.shift[1] - place[1]);
            let (sine, cosine) = heading.sin_cos();
            let shift = if alone {
                Vector3::zeros()
            } else {
                Vector3::new(dx * cosine + dy * sine, dy * cosine - dx * sine, 0.0)
            };
            let axes = Rotation3::from_axis_angle(&Vector3::z_axis(), turn);
            let mut quads = hull.panels(size, [mirrors.x, mirrors.y]);
            if !alone {
                for corner in quads.iter_mut().flatten() {
                    *corner = axes * *corner + shift;
                }
            }
            let plain = HullMesh::new(&quads, mirrors).map_err(refused)?;
            let (mesh, has_lid) = plain.with_lid().map_or((plain, false), |mesh| (mesh, true));
            let volume = mesh.volumes()[2].abs() * images;
            let origin = shift + Vector3::new(0.0, 0.0, hull.origin_height);
            let (panels, lid_panels) = (mesh.hull().len(), mesh.lid().len());
            let name = body.name.clone();
            bodies.push(MeshedBody { name, key, hull, origin, turn, has_lid, panels, lid_panels, volume });
            parts.push(DiffractionBody { mesh, origin });
        }
        let frequencies = choose_frequencies(names, request, size, water)?;
        let problem = DiffractionProblem::new(&parts, water);
        let problem = problem.map_err(|error| {
            let named: Vec<String> =
                bodies.iter().enumerate().map(|(i, b)| format!("{} is {}", i + 1, b.name)).collect();
            let said = wrong(format!("{}: {error}", names.join(", ")));
            if alone { said } else { said.help(format!("of the bodies {}", named.join(", "))) }
        })?;
        Ok((MeshedBodies { bodies, heading, place, size, frequencies, water, mirrors }, problem))
    }

    /// The databases of the bodies, each in its axes and about its origin.
    fn databases(
        &self,
        made: &[FrequencyForces],
        infinite: &DMatrix<f64>,
        request: &PanelRequest,
        model: &Model,
    ) -> Result<Vec<Database>, String> {
        let around = model.surroundings();
        let source = if self.bodies.len() == 1 { SOURCE.to_owned() } else { format!("{SOURCE} of {}", self.names()) };
        let turns: Vec<Matrix6<f64>> = self.bodies.iter().map(MeshedBody::axes).collect();
        let block = |matrix: &DMatrix<f64>, i: usize, j: usize| -> Matrix6<f64> {
            let own = Matrix6::from_fn(|row, column| matrix[(MOTIONS * i + row, MOTIONS * j + column)]);
            turns[i] * own * turns[j].transpose()
        };
        let mut list = Vec::new();
        for (i, body) in self.bodies.iter().enumerate() {
            let periods: Vec<TypedPeriod> = made
                .iter()
                .map(|forces| {
                    let k = TAU / wave_length(forces.frequency, self.water);
                    let of_heading = |(heading, force): (&f64, &Vec<C>)| {
                        // the phase goes with the wave at the origin of the body
                        let along = body.origin.x * heading.cos() + body.origin.y * heading.sin();
                        let phase = C::from_polar(1.0, -k * along);
                        let at = |row: usize| force.get(MOTIONS * i + row).copied().unwrap_or_default() * phase;
                        let all: Amplitudes = std::array::from_fn(|row| {
                            (0..MOTIONS).map(|column| at(column) * turns[i][(row, column)]).sum()
                        });
                        (heading - body.turn, all)
                    };
                    TypedPeriod {
                        period: TAU / forces.frequency,
                        added_mass: Some(block(&forces.added_mass, i, i)),
                        damping: Some(block(&forces.damping, i, i)),
                        forces: request.headings.iter().zip(&forces.excitation).map(of_heading).collect(),
                    }
                })
                .collect();
            let axes = TypedAxes { reference: Vector3::zeros(), axes: Matrix3::identity(), yaw: 0.0 };
            let mut data = typed::build(&source, &axes, &periods, &around).map_err(|error| error.to_string())?;
            data.infinite = Some(block(infinite, i, i));
            data.depth = self.water.depth;
            data.mass = Some(body.hull.volume * around.water_density);
            data.index = i;
            data.panel_size = Some(self.size);
            for (j, other) in self.bodies.iter().enumerate().filter(|(j, _)| *j != i) {
                let between = other.origin - body.origin;
                let (sine, cosine) = body.turn.sin_cos();
                data.interactions.push(Interaction {
                    index: j,
                    added_mass: made.iter().map(|forces| block(&forces.added_mass, i, j)).collect(),
                    damping: made.iter().map(|forces| block(&forces.damping, i, j)).collect(),
                    infinite: Some(block(infinite, i, j)),
                    place: Some([
                        between.x * cosine + between.y * sine,
                        between.y * cosine - between.x * sine,
                        other.turn - body.turn,
                    ]),
                });
            }
            list.push(data);
        }
        Ok(list)
    }
}

impl MeshedBody {
    /// From axes of the group to those of the body, of motions and forces.
    fn axes(&self) -> Matrix6<f64> {
        let turned = self.hull.axes * Rotation3::from_axis_angle(&Vector3::z_axis(), -self.turn).matrix();
        let mut made = Matrix6::zeros();
        for at in [0, 3] {
            made.fixed_view_mut::<3, 3>(at, at).copy_from(&turned);
        }
        made
    }
}

/// The frequencies (rad/s), growing: those asked for, or what the panels carry of the usual ones.
fn choose_frequencies(names: &[String], request: &PanelRequest, size: f64, water: Water) -> Outcome<Vec<f64>> {
    let wrong = |text: String| Diagnostic::error(format!("{}: {text}", names.join(", ")), request.span);
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
        let text = format!("panels of {size:.2} m carry none of the usual periods");
        return Err(wrong(text).help("-PANEL gives a smaller size"));
    };
    if shortest < LEAST_PANELS_A_WAVE * size {
        let text = format!(
            "the shortest wave, of {shortest:.2} m, has {:.1} panels of {size:.2} m; at least {LEAST_PANELS_A_WAVE} are needed",
            shortest / size
        );
        return Err(wrong(text).help(format!(
            "-PANEL {:.2} has eight, or leave the shortest periods out",
            shortest / POOR_PANELS_A_WAVE
        )));
    }
    Ok(frequencies)
}

/// Computes the databases of bodies together and attaches them; the report of it is shown.
///
/// # Errors
/// As of [`MeshedBodies::new`]; an interrupt: the bodies keep what they have.
pub fn compute(job: &mut Job, names: &[String], request: &PanelRequest) -> Outcome<()> {
    let span = request.span;
    let (meshed, problem) = MeshedBodies::new(&job.model, names, request)?;
    let all = meshed.names();
    let refused = |error: DiffractionError| Diagnostic::error(format!("{all}: {error}"), span);
    let mut drift = panel_drift::source(&job.model, &meshed);
    let mut made: Vec<FrequencyForces> = Vec::new();
    let mut drifts = Vec::new();
    let bar = progress_bar(meshed.frequencies.len());
    for frequency in &meshed.frequencies {
        if job.is_interrupted() {
            bar.finish_and_clear();
            return Err(Diagnostic::error(format!("interrupted: {all} keeps the database it had, if any"), span));
        }
        let waves = problem.solve_waves(*frequency, &request.headings).map_err(refused)?;
        if let DriftSource::Motions(linear) = &drift {
            match panel_drift::far_field(linear, &meshed, &waves, &request.headings) {
                Ok(row) => drifts.push(row),
                Err(why) => drift = DriftSource::None(why),
            }
        } else if matches!(drift, DriftSource::Fixed) {
            drifts.push(panel_drift::far_field_fixed(&waves, &request.headings));
        }
        made.push(waves.forces);
        bar.inc(1);
    }
    bar.finish_and_clear();
    let infinite = problem.added_mass_limit(FrequencyLimit::Infinite).map_err(refused)?;
    let databases = meshed.databases(&made, &infinite, request, &job.model);
    let mut databases = databases.map_err(|error| Diagnostic::error(format!("{all}: {error}"), span))?;
    if let ([data], [body], false) =
        (databases.as_mut_slice(), meshed.bodies.as_slice(), matches!(drift, DriftSource::None(_)))
    {
        data.drift = Some(DriftTable {
            frequencies: meshed.frequencies.clone(),
            headings: data.headings.clone(),
            values: panel_drift::by_heading(&request.headings, body.turn, &data.headings, &drifts),
        });
    }
    let table = report(&meshed, &made, drift.said());
    for (body, data) in meshed.bodies.iter().zip(databases) {
        take_hull(&mut job.model, body);
        let attached = AttachedDatabase {
            data: Arc::new(data),
            at: [0.0; 3],
            memory: None,
            drift: DriftMethod::Newman,
            hydrostatics: false,
            span,
        };
        database::attach(job, &body.name, attached, span)?;
        settle_pressure(&mut job.model, &body.name);
    }
    warn_of_quality(job, &meshed, &made, span);
    if let DriftSource::Motions(linear) = &drift
        && let Some(text) = panel_drift::roll_warning(linear, &meshed, &made)
    {
        job.warn(text, span);
    }
    if let DriftSource::None(why) = &drift {
        job.warn(format!("{all}: mean drift is left out: {why}"), span);
    }
    job.say_tables(&[table]);
    Ok(())
}

/// The bar of a loop over periods.
pub fn progress_bar(count: usize) -> ProgressBar {
    let bar = ProgressBar::new(count as u64);
    if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos} of {len} periods, {elapsed} gone, {eta} to go") {
        bar.set_style(style);
    }
    bar
}

/// The pieces of a body become those of a database, as -DIFTYPE 3DDIF says it.
fn take_hull(model: &mut Model, body: &MeshedBody) {
    for part in model.parts.values_mut().filter(|part| Model::key(&part.body) == body.key) {
        for piece in &mut part.pieces {
            if body.hull.pieces.contains(&piece.name) && piece.waves == WaveAction::ByForm && piece.member.is_none() {
                piece.waves = WaveAction::Database;
            }
        }
    }
}

fn warn_of_quality(job: &mut Job, meshed: &MeshedBodies, made: &[FrequencyForces], span: Span) {
    let all = meshed.names();
    let poor = made.iter().map(FrequencyForces::excitation_difference).fold(0.0, f64::max);
    if poor > POOR_EXCITATION {
        let text = format!(
            "{all}: exciting forces by pressure and by Haskind's relation differ by {:.1} % of the largest: the panels are too large",
            100.0 * poor
        );
        job.warn(text, span);
    }
    let shortest = meshed.frequencies.last().map_or(f64::INFINITY, |w| wave_length(*w, meshed.water));
    if shortest < POOR_PANELS_A_WAVE * meshed.size {
        let text = format!(
            "{all}: the shortest wave has {:.1} panels; -PANEL {:.2} has eight",
            shortest / meshed.size,
            shortest / POOR_PANELS_A_WAVE
        );
        job.warn(text, span);
    }
    for body in meshed.bodies.iter().filter(|body| !body.has_lid) {
        let text =
            "its waterline does not close, so that it has no lid: results near irregular frequencies are wrong there";
        job.warn(format!("{}: {text}", body.name), span);
    }
}

/// Length of a wave (m), by Newton's iteration of the dispersion relation.
pub fn wave_length(frequency: f64, water: Water) -> f64 {
    let nu = frequency * frequency / water.gravity;
    let Some(depth) = water.depth else { return TAU / nu };
    let mut k = nu / (nu * depth).tanh().sqrt();
    for _ in 0..20 {
        let t = (k * depth).tanh();
        k -= (k * t - nu) / (t + k * depth * (1.0 - t * t));
    }
    TAU / k
}

/// What was computed, a row a period.
fn report(meshed: &MeshedBodies, made: &[FrequencyForces], drift: &str) -> Table {
    let water = meshed.water;
    let rows: Vec<(f64, f64, f64, f64, usize)> = made
        .iter()
        .rev()
        .map(|forces| {
            let length = wave_length(forces.frequency, water);
            let relation = 100.0 * forces.excitation_difference();
            (TAU / forces.frequency, length, length / meshed.size, relation, forces.iterations)
        })
        .collect();
    let planes = match (meshed.mirrors.x, meshed.mirrors.y) {
        (false, false) => "none",
        (true, false) => "fore and aft",
        (false, true) => "port and starboard",
        (true, true) => "fore and aft, port and starboard",
    };
    let images = meshed.mirrors.images().len();
    let mut table = Table::new(format!("Pressures on {}", meshed.names()))
        .with_rows(&rows)
        .column("", "Period", Dim::Time, Digits::Decimals(2), |row| row.0)
        .column("", "Wave Length", Dim::Length, Digits::Decimals(2), |row| row.1)
        .column("", "Panels a Wave", Dim::None, Digits::Decimals(1), |row| row.2)
        .column("", "Haskind", Dim::None, Digits::Decimals(3), |row| row.3)
        .column("", "Products", Dim::None, Digits::Usual, |row| row.4)
        .build();
    for body in &meshed.bodies {
        // of several bodies each fact names its own
        let fact = |text: &str| match meshed.bodies.len() {
            1 => text.to_owned(),
            _ => format!("{}: {text}", body.name),
        };
        let lid = match body.lid_panels {
            0 if body.has_lid => "none is needed".to_owned(),
            0 => "none".to_owned(),
            number => count(number, "panel"),
        };
        table = table.fact(&fact("Pieces"), body.hull.pieces.join(" "), Dim::None);
        table = table.fact(&fact("Panels of the Hull"), body.panels * images, Dim::None);
        if images > 1 {
            table = table.fact(&fact("Of These Solved For"), body.panels, Dim::None);
        }
        table = table.fact(&fact("Lid of the Waterplane"), lid, Dim::None);
        table = table.fact(&fact("Displaced Volume"), body.hull.volume, Dim::Volume);
        table = table.fact(&fact("By the Panels"), body.volume, Dim::Volume);
    }
    table = table.fact("Symmetry", planes, Dim::None);
    table = table.fact("Size of Panels", meshed.size, Dim::Length);
    table = match water.depth {
        Some(depth) => table.fact("Depth", depth, Dim::Length),
        None => table.fact("Depth", "deep water", Dim::None),
    };
    table = table.fact("Mean Drift", drift, Dim::None);
    table.note(
        "Haskind: largest difference of exciting forces by pressure and by Haskind's relation, per cent of the largest",
    );
    table
}

/// The usual headings: all round by 15 degrees (rad).
pub fn usual_headings() -> Vec<f64> {
    (0..24).map(|i| f64::from(i) * PI / 12.0).collect()
}
