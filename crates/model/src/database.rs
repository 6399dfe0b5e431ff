//! What a hydrodynamic database holds of one body: data only; the physics is in `hydro::database`.

use crate::{Body, LoadKind, Mass, Model};
use nalgebra::{Complex, Matrix6, Vector3};
use std::sync::Arc;
use windlass_base::choice::{Choice, Dof};
use windlass_base::span::Span;

/// Share by which the depth of a database may differ from that of the environment.
const DEPTH_SHARE: f64 = 1e-3;
/// Depth over the inverse wave number in deep water from which on a wave does not feel the bottom: half a wave length, where the wave
/// number is that of deep water within 0.4 per cent.
const DEEP_WATER: f64 = std::f64::consts::PI;

/// Six complex amplitudes: of force (N) and moment (N m), or of translation (m) and rotation (rad).
pub type Amplitudes = [Complex<f64>; 6];

/// Radiation and diffraction of one floating body, as a program of potential flow computed them.
///
/// **Conventions**, to which every format is converted when it is read. Axes are those of the body, SI, radians. The wave is
/// `zeta = a cos(w t) = Re(a exp(-i w t))` at the reference point, of real amplitude a (m); what it causes is
/// `F(t) = Re(X a exp(-i w t))`, so a phase lag e is `X = |X| exp(i e)`. Headings are the direction the waves travel TOWARD, from the
/// body's x axis toward its y axis. A radiated force is `-A(w) acceleration - B(w) velocity`. Matrices and forces are along axes that are turned
/// by the heading of the body alone, z up: a trim or heel of the body does not tilt them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Database {
    /// What it was read from, in words.
    pub source: String,
    /// The point the matrices and moments are about, and to which phases refer, in the body's axes (m).
    pub reference: Vector3<f64>,
    /// Frequencies (rad/s): finite, greater than zero, growing.
    pub frequencies: Vec<f64>,
    /// Added mass, one matrix a frequency (kg, kg m, kg m2); empty when the source has none.
    pub added_mass: Vec<Matrix6<f64>>,
    /// Damping by radiated waves, one matrix a frequency (N s/m, N s, N m s); empty when the source has none.
    pub damping: Vec<Matrix6<f64>>,
    /// Added mass at infinite frequency, as the source gives it.
    pub infinite: Option<Matrix6<f64>>,
    /// Added mass at zero frequency, as the source gives it.
    pub zero: Option<Matrix6<f64>>,
    /// Headings (rad) in [0, 2 pi), growing.
    pub headings: Vec<f64>,
    /// Excitation by heading, then frequency: force and moment over wave amplitude (N/m, N); empty when the source has none.
    pub excitation: Vec<Vec<Amplitudes>>,
    /// Motions in a free float by heading, then frequency: over wave amplitude (m/m, rad/m), of the reference point.
    pub motions: Option<Vec<Vec<Amplitudes>>>,
    /// Mean drift.
    pub drift: Option<DriftTable>,
    /// Slow drift of pairs of waves.
    pub qtf: Option<Qtf>,
    /// Hydrostatic stiffness about the reference point (N/m, N, N m), as the source gives it.
    pub hydrostatics: Option<Matrix6<f64>>,
    /// Density of the water it was computed for (kg/m3).
    pub density: f64,
    /// Gravity it was computed for (m/s2).
    pub gravity: f64,
    /// Depth of the water it was computed for (m); `None` for deep water.
    pub depth: Option<f64>,
    /// Mass or displaced mass of the body as the source gives it (kg).
    pub mass: Option<f64>,
    /// How the body floated; none of a source that does not tell.
    pub stance: Option<Stance>,
    /// The number of its body among those of its source, from 0.
    pub index: usize,
    /// Radiation of the other bodies of its source, as it acts on this one.
    pub interactions: Vec<Interaction>,
    /// Rectangles of damped surface that it was computed with here: x and y of two corners from the first body of its source, along its heading (m), and the damping.
    pub lids: Vec<[f64; 5]>,
    /// Sizes of the panels that it was computed with here; none of a source that was read.
    pub panels: Option<PanelSizes>,
    /// What the reader noticed: asymmetry, negative damping, gaps.
    pub remarks: Vec<String>,
}

/// How a body floats.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stance {
    /// Height of its origin over the water level (m).
    pub height: f64,
    /// Up, in the axes of the body.
    pub up: Vector3<f64>,
}

impl Stance {
    /// That of a body in water of a level (m).
    pub fn of(body: &Body, level: f64) -> Self {
        let turned = body.position.rotation();
        Stance { height: body.position.shift[2] - level, up: turned.matrix().transpose() * Vector3::z() }
    }
}

/// How large panels are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PanelSizes {
    /// Length of their sides at most (m).
    pub largest: f64,
    /// The same at the edges toward which they are refined, over `largest`: 1 leaves all of one size.
    pub edge_share: f64,
}

impl PanelSizes {
    /// All of one size (m).
    pub fn equal(size: f64) -> Self {
        PanelSizes { largest: size, edge_share: 1.0 }
    }
}

/// Forces on a body, about the reference point of its database and in its axes, by motions of another body, of the reference point of that
/// one's and in its axes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Interaction {
    /// The number of the other body among those of the source, from 0.
    pub index: usize,
    /// Added mass, one matrix a frequency (kg, kg m, kg m2).
    pub added_mass: Vec<Matrix6<f64>>,
    /// Damping by radiated waves, one matrix a frequency (N s/m, N s, N m s).
    pub damping: Vec<Matrix6<f64>>,
    /// Added mass at infinite frequency, as the source gives it.
    pub infinite: Option<Matrix6<f64>>,
    /// Where the other body stood: x and y of its origin in axes of this one's heading (m), and its heading from this one's (rad); where the
    /// source tells.
    pub place: Option<[f64; 3]>,
}

/// An interaction with the two bodies that it is between.
#[derive(Clone, Copy, Debug)]
pub struct InteractingBodies<'a> {
    /// The body that the forces are on, with its key.
    pub on: (&'a str, &'a Body),
    /// The body whose motions make them.
    pub by: (&'a str, &'a Body),
    /// The forces.
    pub interaction: &'a Interaction,
}

/// Mean drift over the square of the wave amplitude (N/m2, N/m), about the reference point of its database.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DriftTable {
    /// Frequencies (rad/s), growing.
    pub frequencies: Vec<f64>,
    /// Headings (rad) in [0, 2 pi), growing, direction of travel.
    pub headings: Vec<f64>,
    /// By heading, then frequency.
    pub values: Vec<Vec<[f64; 6]>>,
    /// How the panels gave it, in words: none of a source that was read.
    pub method: Option<String>,
}

/// Difference-frequency forces of pairs of waves of one heading: `F(t) = Re sum_ij Q_ij a_i conj(a_j) exp(-i (w_i - w_j) t)`
/// (N/m2, N/m), with `Q_ji = conj(Q_ij)`, about the reference point of its database.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Qtf {
    /// Frequencies (rad/s), growing.
    pub frequencies: Vec<f64>,
    /// Headings (rad) in [0, 2 pi), growing, direction of travel.
    pub headings: Vec<f64>,
    /// By heading, then frequency i, then frequency j.
    pub values: Vec<Vec<Vec<Amplitudes>>>,
}

/// How waves make slow drift.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DriftMethod {
    /// None.
    None,
    /// The mean only.
    Mean,
    /// Newman's approximation from the mean drift.
    #[default]
    Newman,
    /// The pairs of the QTF.
    Full,
}

/// A database on a body, and how it is used.
#[derive(Clone, Debug, PartialEq)]
pub struct AttachedDatabase {
    /// The database.
    pub data: Arc<Database>,
    /// Where the origin of its source stands in the body (m).
    pub at: [f64; 3],
    /// Memory of the radiation (s); `None` chooses it by the decay of the kernel.
    pub memory: Option<f64>,
    /// How waves make slow drift.
    pub drift: DriftMethod,
    /// Factor of its wave drift damping, and of what a current changes of its drift; none leaves that to the pieces of the body.
    pub drift_damping: Option<f64>,
    /// Whether its hydrostatics are those of the body.
    pub hydrostatics: bool,
    /// Where it was given.
    pub span: Span,
}

/// Share of the distance, and angle (rad), by which bodies may stand otherwise than their source had them.
const PLACE_SHARE: f64 = 0.05;
const PLACE_ANGLE: f64 = 0.05;
/// The largest difference of the mass of a body from that of its database that is let pass.
const MAX_MASS_DIFFERENCE: f64 = 0.2;
/// Over the side of a cube of its displacement: how much deeper or higher a body may float than its database had it. By how much it may be turned (rad).
const HEIGHT_SHARE: f64 = 0.01;
const STANCE_ANGLE: f64 = 0.02;

impl Model {
    /// The interactions of databases whose two bodies are both in the model with databases of one source, in the order of the bodies.
    pub fn interactions(&self) -> Vec<InteractingBodies<'_>> {
        let with_data = || {
            self.bodies.iter().filter_map(|(key, body)| {
                let data = body.database.as_ref()?.data.as_ref();
                Some((key.as_str(), body, data))
            })
        };
        let mut list = Vec::new();
        for (key, body, data) in with_data() {
            for interaction in &data.interactions {
                let other = with_data().find(|(other, _, found)| {
                    *other != key && found.source == data.source && found.index == interaction.index
                });
                if let Some((other, found, _)) = other {
                    list.push(InteractingBodies { on: (key, body), by: (other, found), interaction });
                }
            }
        }
        list
    }

    /// The bodies of the source of a body's database that the model has not, where it lacks some.
    fn missing_partners(&self, body: &Body, data: &Database) -> Option<String> {
        let found: Vec<_> = self.interactions().into_iter().filter(|pair| pair.on.1.name == body.name).collect();
        let missing =
            data.interactions.iter().filter(|own| !found.iter().any(|pair| pair.interaction.index == own.index));
        let count = missing.count();
        (count > 0).then(|| {
            format!(
                "{} of {} bodies that {} was computed with have no database of it: their waves do not act on {}",
                count,
                data.interactions.len(),
                data.source,
                body.name
            )
        })
    }

    /// Bodies that stand elsewhere beside another than where their waves were computed, each pair once.
    fn partners_elsewhere(&self) -> Vec<String> {
        let mut list = Vec::new();
        let mut told: Vec<[&str; 2]> = Vec::new();
        for pair in self.interactions() {
            let Some([x, y, turn]) = pair.interaction.place else { continue };
            let (body, partner) = (pair.on.1, pair.by.1);
            let Some(data) = body.database.as_ref().map(|attached| attached.data.as_ref()) else { continue };
            let (own, other) = (&body.position, &partner.position);
            let (dx, dy) = (other.shift[0] - own.shift[0], other.shift[1] - own.shift[1]);
            let (sine, cosine) = own.turn[2].sin_cos();
            let (ahead, aside) = (dx * cosine + dy * sine, dy * cosine - dx * sine);
            let off = (ahead - x).hypot(aside - y);
            let angle = (other.turn[2] - own.turn[2] - turn + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU)
                - std::f64::consts::PI;
            let is_told = told.contains(&[partner.name.as_str(), body.name.as_str()]);
            if !is_told && (off > PLACE_SHARE * x.hypot(y) || angle.abs() > PLACE_ANGLE) {
                told.push([&body.name, &partner.name]);
                list.push(format!(
                    "{} stands {off:.2} m and {:.1} degrees away from where {} had it beside {}: the waves that they send to each other are those of there",
                    partner.name,
                    angle.abs().to_degrees(),
                    data.source,
                    body.name
                ));
            }
        }
        list
    }

    /// How bodies that move differ from those that their databases were computed for, and where they stand beside each other.
    pub fn stance_warnings(&self) -> Vec<String> {
        self.bodies.values().flat_map(|body| self.stance_warnings_of(body)).chain(self.partners_elsewhere()).collect()
    }

    /// How a body that moves differs from the one that its database was computed for: its mass, and how it floats.
    pub fn stance_warnings_of(&self, body: &Body) -> Vec<String> {
        let mut list = Vec::new();
        let Some(data) = body.database.as_ref().map(|attached| attached.data.as_ref()) else { return list };
        if body.ignored.len() >= Dof::ALL.len() {
            return list;
        }
        let mass = Mass::from_parts(self.parts_of(body), self.defaults.gravity).mass;
        let computed = data.mass.filter(|computed| mass > 0.0 && *computed > 0.0);
        // where it is known how the body floated that is looked at: of one that tethers or members hold the mass is another, and contents of tanks are not among
        // the weights
        let has_tanks = self.parts_of(body).any(|part| part.pieces.iter().any(|piece| piece.compartment.is_some()));
        if let Some(computed) = computed.filter(|computed| {
            !has_tanks && data.stance.is_none() && (computed / mass - 1.0).abs() > MAX_MASS_DIFFERENCE
        }) {
            let text = format!(
                "{} has {:.4} times the mass that {} was computed for",
                body.name,
                mass / computed,
                data.source
            );
            list.push(text);
        }
        let Some(stance) = data.stance else { return list };
        let now = Stance::of(body, self.surroundings().tide);
        let size = (computed.unwrap_or(mass) / data.density.max(f64::MIN_POSITIVE)).cbrt();
        let (sunk, angle) = (stance.height - now.height, stance.up.angle(&now.up));
        let mut parts = Vec::new();
        if sunk.abs() > HEIGHT_SHARE * size {
            parts.push(format!("{:.2} m {}", sunk.abs(), if sunk > 0.0 { "below" } else { "above" }));
        }
        if angle > STANCE_ANGLE {
            parts.push(format!("turned by {:.1} degrees of trim and heel from", angle.to_degrees()));
        }
        if !parts.is_empty() {
            list.push(format!(
                "{} is {} where {} had it: its coefficients are of another hull under water",
                body.name,
                parts.join(" and "),
                data.source
            ));
        }
        list
    }

    /// What the database of a body lacks in the environment in force, or does not fit: each is in every report. Waves without drift
    /// coefficients make no drift force, unless `#DRIFT` gives it or `-DRIFT NONE` waives it; coefficients of another depth of water are
    /// those of other waves where these feel the bottom.
    pub fn database_caveats(&self, body: &Body) -> Vec<String> {
        let Some(attached) = &body.database else { return Vec::new() };
        let data = attached.data.as_ref();
        let mut list = Vec::new();
        let env = &self.environment;
        let waves = env.has_waves();
        let own = |part: &str| self.parts_of(body).any(|p| Model::key(&p.name) == Model::key(part));
        let drifts = self.loads.iter().any(|load| matches!(load.kind, LoadKind::Drift { .. }) && own(&load.part));
        let lacks_drift = data.drift.is_none() && data.qtf.is_none() && attached.drift != DriftMethod::None;
        if waves && !data.excitation.is_empty() && lacks_drift && !drifts {
            list.push(format!(
                "no wave drift acts on {}: {} has no drift coefficients; -DRIFT NONE of DATABASE accepts that",
                body.name, data.source
            ));
        }
        let around = self.surroundings();
        let here = around.depth.map(|depth| depth + around.tide);
        let lowest = data.frequencies.first().copied().unwrap_or(f64::INFINITY);
        let shallower = [data.depth, here].into_iter().flatten().fold(f64::INFINITY, f64::min);
        let differ = match (data.depth, here) {
            (Some(one), Some(other)) => (one - other).abs() > DEPTH_SHARE * other.abs(),
            (one, other) => one.is_some() != other.is_some(),
        };
        if differ && lowest * lowest / around.gravity * shallower < DEEP_WATER {
            let depth = |depth: Option<f64>| depth.map_or("infinite".to_string(), |d| format!("{d} m"));
            list.push(format!(
                "the coefficients of {} are of another depth of water: {} has {}, the environment {}",
                body.name,
                data.source,
                depth(data.depth),
                depth(here)
            ));
        }
        list.extend(self.missing_partners(body, data));
        list
    }
}
