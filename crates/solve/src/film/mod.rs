//! A run as a film: bodies, and lines in the shape they hang in, at a number of instants.
//!
//! A dynamic line is where its nodes were, which the run kept. The shapes of others are solved exactly between the ends at the
//! instant, whatever the forces of the run came from, as those of a [`Scene`](super::scene::Scene) are.

mod interpolation;
mod lines;
mod sea;
mod solid;

pub use lines::{ConnectorState, Strand};
pub use sea::{FilmWave, FilmWaves};
pub use solid::FilmSolid;

use super::results::{EventWindow, events};
use super::time::Run;
use nalgebra::Vector3;
use windlass_base::geometry::{Place, Position};
use windlass_base::pose::Pose;
use windlass_model::{ClassError, Model};

/// Most instants of a film.
pub const MAX_FRAMES: usize = 2_000;
/// Most numbers of a film, of all its instants: what a page bears that a browser opens at once.
pub const MAX_NUMBERS: usize = 4_000_000;
/// Most triangles of the bodies; a hull beyond is shown as a box.
pub const MAX_TRIANGLES: usize = 60_000;
/// Numbers of a body at an instant: origin and rotation.
const VALUES_PER_BODY: usize = 7;
/// Numbers of a point of a line at an instant: place, tension, share of break.
const VALUES_PER_POINT: usize = 5;

/// What of a run is shown.
pub struct FilmSelection<'a> {
    /// Whether a connector of this name is.
    pub connector: &'a dyn Fn(&str) -> bool,
    /// Whether a body of this name is; one on which a shown connector ends always is.
    pub body: &'a dyn Fn(&str) -> bool,
    /// Which instants.
    pub window: Option<EventWindow>,
    /// Points of a mooring line.
    pub points: usize,
    /// Whether to give up.
    pub stop: &'a dyn Fn() -> bool,
}

/// A body that moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Actor {
    /// Its name.
    pub name: String,
    /// Whether it is a junction, a point where connectors meet.
    pub junction: bool,
    /// Its form, in its axes.
    pub solid: FilmSolid,
    /// Where it stands at every instant.
    pub poses: Vec<Pose>,
    /// Of a body in a regular wave: real and imaginary part of the pressure on each triangle, over that of a column of water of the wave's amplitude;
    /// empty of others.
    pub pressures: Vec<[f64; 2]>,
}

/// The water about bodies in a regular wave, on a grid: the elevation is `Re(value exp(-i omega t))`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WaveField {
    /// x and y of its first point (m).
    pub low: [f64; 2],
    /// Distance of its points (m).
    pub step: f64,
    /// Points along x.
    pub columns: usize,
    /// Real and imaginary parts (m), row by row from the lowest y; not finite within the bodies.
    pub values: Vec<[f64; 2]>,
    /// Frequency (rad/s).
    pub frequency: f64,
}

/// A run made ready to be shown.
#[derive(Clone, Debug, Default)]
pub struct Film {
    /// The instants (s).
    pub times: Vec<f64>,
    /// The bodies.
    pub actors: Vec<Actor>,
    /// The connectors.
    pub strands: Vec<Strand>,
    /// Ends of connectors in the ground, each once, with the name of its point or connector (m, global).
    pub anchors: Vec<(String, Position)>,
    /// Elevation of the mean water surface (m).
    pub level: f64,
    /// Elevation of the bottom (m), where there is one.
    pub bottom: Option<f64>,
    /// The waves.
    pub waves: Option<FilmWaves>,
    /// The water about bodies in a regular wave, in place of the waves.
    pub field: Option<WaveField>,
    /// Corners of a box about all that is shown (m).
    pub extent: [Position; 2],
    /// What was left out or thinned, a sentence each.
    pub notes: Vec<String>,
}

impl Film {
    /// The film of a run.
    ///
    /// # Errors
    /// A run without instants, or none in the window; more than a film bears; interrupted.
    pub fn build(run: &Run, take: &FilmSelection) -> Result<Film, ClassError> {
        let layout = &run.history.layout;
        let links: Vec<usize> = (0..layout.links.len())
            .filter(|n| layout.links.get(*n).is_some_and(|l| (take.connector)(&l.name)))
            .collect();
        let held: Vec<usize> =
            links.iter().filter_map(|n| layout.links.get(*n)).flat_map(|l| l.ends.iter().flatten().copied()).collect();
        let bodies: Vec<usize> = layout
            .bodies
            .iter()
            .enumerate()
            .filter(|(n, (name, _))| held.contains(n) || (take.body)(name))
            .map(|(n, _)| n)
            .collect();
        if bodies.is_empty() && links.is_empty() {
            return Err(ClassError::new("there is nothing to show: no body and no connector"));
        }
        let mut film = Film::default();
        let rows =
            film.instants(run, take, bodies.len() * VALUES_PER_BODY + links.len() * VALUES_PER_POINT * take.points)?;
        let mut model = run.model.clone();
        let surroundings = model.surroundings();
        (film.level, film.bottom) = (surroundings.tide, surroundings.depth.map(|d| -d));
        film.strands = links.iter().filter_map(|n| Strand::new(*n, layout.links.get(*n)?, &model)).collect();
        let mut poses: Vec<Vec<Pose>> = vec![Vec::with_capacity(rows.len()); layout.bodies.len()];
        for row in &rows {
            if (take.stop)() {
                return Err(ClassError::new("interrupted"));
            }
            for (body, (_, key)) in layout.bodies.iter().enumerate() {
                let Some(position) = body_place(row, layout.body(body)) else { continue };
                if let Some(body) = model.bodies.get_mut(key) {
                    body.position = position;
                }
                if let Some(list) = poses.get_mut(body) {
                    list.push(Pose::from_place(&position));
                }
            }
            for strand in &mut film.strands {
                strand.shoot(&mut model, layout, row, take.points);
            }
        }
        film.ends(&model);
        film.tell_unsolved();
        film.waves = FilmWaves::from_run(run, &mut film.notes);
        film.cast(run, &bodies, poses);
        film.measure()?;
        Ok(film)
    }

    /// The rows shown, thinned to what a film bears.
    fn instants(&mut self, run: &Run, take: &FilmSelection, numbers: usize) -> Result<Vec<Vec<f64>>, ClassError> {
        let chosen = events(&run.history, take.window.as_ref())?;
        let times: Vec<f64> = chosen.iter().filter_map(|e| e.time(&run.history)).collect();
        let most = MAX_FRAMES.min(MAX_NUMBERS / numbers.max(1));
        if most < 2 {
            return Err(ClassError::new(format!(
                "an instant of these bodies and lines has {numbers} numbers, and a film bears {MAX_NUMBERS} in all"
            ))
            .help("name fewer of them, or give their lines fewer points"));
        }
        let step = times.len().div_ceil(most).max(1);
        if step > 1 {
            self.notes.push(format!(
                "only one in {step} of {} instants is shown: a film bears {most} of them here (-EVENTS takes a part)",
                times.len()
            ));
        }
        self.times = times.into_iter().step_by(step).collect();
        Ok(interpolation::rows(&run.history, &self.times))
    }

    /// The bodies with their forms.
    fn cast(&mut self, run: &Run, bodies: &[usize], mut poses: Vec<Vec<Pose>>) {
        let [low, high] = self.span(&poses);
        let least = (0.01 * (high - low).norm()).max(0.5);
        let mut triangles = 0;
        for index in bodies {
            let Some((name, key)) = run.history.layout.bodies.get(*index) else { continue };
            let Some(body) = run.model.bodies.get(key) else { continue };
            let junction = body.junction.is_some();
            let mut solid = FilmSolid::from_body(&run.model, body, if junction { 0.5 * least } else { least });
            if triangles + solid.triangles.len() > MAX_TRIANGLES {
                self.notes.push(format!(
                    "{name} is shown as a box: its hull of {} triangles goes beyond the {MAX_TRIANGLES} of a film",
                    solid.triangles.len()
                ));
                solid = FilmSolid::bounding_box(&run.model, body, least);
            }
            triangles += solid.triangles.len();
            let poses = poses.get_mut(*index).map(std::mem::take).unwrap_or_default();
            self.actors.push(Actor { name: name.clone(), junction, solid, poses, pressures: Vec::new() });
        }
    }

    /// Least and greatest coordinates of lines and origins of bodies (m).
    fn span(&self, poses: &[Vec<Pose>]) -> [Vector3<f64>; 2] {
        let lines = self.strands.iter().flat_map(|s| &s.points).map(|at| Vector3::from(*at));
        let origins = poses.iter().flatten().map(|p| p.origin);
        let ends = self.anchors.iter().map(|(_, at)| Vector3::from(*at));
        span(lines.chain(origins).chain(ends))
    }

    /// Sets the box about all that is shown.
    fn measure(&mut self) -> Result<(), ClassError> {
        let lines = self.strands.iter().flat_map(|s| &s.points).map(|at| Vector3::from(*at));
        let ends = self.anchors.iter().map(|(_, at)| Vector3::from(*at));
        let bodies = self.actors.iter().flat_map(|actor| {
            let reach = Vector3::repeat(actor.solid.reach());
            actor.poses.iter().flat_map(move |p| [p.origin - reach, p.origin + reach])
        });
        let [mut low, mut high] = span(lines.chain(ends).chain(bodies));
        for z in [Some(self.level), self.bottom].into_iter().flatten() {
            (low.z, high.z) = (low.z.min(z), high.z.max(z));
        }
        self.extent = [low.into(), high.into()];
        if self.extent.iter().flatten().all(|c| c.is_finite()) {
            Ok(())
        } else {
            Err(ClassError::new("the film has a position that is not finite"))
        }
    }

    /// The ends in the ground.
    fn ends(&mut self, model: &Model) {
        for strand in &self.strands {
            let Some(connector) = model.connectors.get(&Model::key(&strand.name)) else { continue };
            for (index, name) in connector.points.iter().enumerate() {
                let ground = model.points.get(&Model::key(name)).is_some_and(|p| model.body_of(p).is_none());
                if let (true, Some(at)) = (ground, model.end(connector, index))
                    && !self.anchors.iter().any(|(n, _)| n == name)
                {
                    self.anchors.push((name.clone(), at));
                }
            }
            if let (1, Some(at)) = (connector.points.len(), model.placement(connector).other) {
                self.anchors.push((strand.name.clone(), at));
            }
        }
        if self.bottom.is_none() {
            self.bottom = self.strands.iter().find_map(|s| s.bottom);
        }
    }

    fn tell_unsolved(&mut self) {
        for strand in &self.strands {
            let count = strand.states.iter().filter(|s| **s == ConnectorState::Unsolved).count();
            if let (Some(error), 1..) = (&strand.error, count) {
                self.notes.push(format!("{} is straight at {count} instants: {error}", strand.name));
            }
            if strand.nodeless {
                self.notes.push(format!(
                    "{} is not shown as it moved: the run kept none of its nodes (TDOM -ALONG 1 keeps all)",
                    strand.name
                ));
            }
        }
    }
}

fn span(positions: impl Iterator<Item = Vector3<f64>>) -> [Vector3<f64>; 2] {
    let found = positions.fold(None, |found: Option<[Vector3<f64>; 2]>, at| {
        let [low, high] = found.unwrap_or([at, at]);
        // a place that is no number must show: inf and sup would lose it
        let sound = at.iter().all(|c| c.is_finite());
        Some(if sound { [low.inf(&at), high.sup(&at)] } else { [Vector3::repeat(f64::NAN); 2] })
    });
    found.unwrap_or_default()
}

/// The place of a body in a row.
fn body_place(row: &[f64], at: usize) -> Option<Place> {
    let [x, y, z, roll, pitch, yaw] = *row.get(at..at + 6)? else { return None };
    Some(Place { shift: [x, y, z], turn: [roll, pitch, yaw] })
}
