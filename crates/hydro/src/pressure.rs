//! The pressure of waves on a hull that does not change them (Froude and Krylov), up to the surface where it is: pieces of
//! `-DIFTYPE FK`.
//!
//! The whole pressure, `-rho g z` with the dynamic pressure of the waves, is integrated over the panels below the surface of the waves, and
//! the hydrostatics up to the mean level, which are the body's buoyancy, are taken off. Panels are divided until they are short against
//! the waves; on each the pressure is straight, and so is the surface where it cuts one. All of it is found once a step, at the place expected
//! at its end. What the hull makes of the waves, diffraction and radiation, needs a hydrodynamic database, which is why a piece
//! that is in one takes no part here.

use super::buoyancy::skin;
use super::hull::{Solid, Surface};
use super::morison::mean_number;
use super::sea::Sea;
use super::{BodyLoad, Category, Load, MovingLoad, Underway};
use nalgebra::Vector3;
use std::collections::BTreeMap;
use std::sync::Arc;
use windlass_base::pose::{Pose, Six};
use windlass_model::{Body, ClassError, Model, WaveAction};

/// Longest edge of a panel times the mean wave number: a straight line errs on the pressure by its square over 8.
const EDGE: f64 = 0.3;
/// Panels of a piece beyond which none is divided.
const MOST: usize = 20_000;

/// The pressure of a sea on the pieces of a body.
#[derive(Debug)]
pub struct WavePressure {
    sea: Arc<Sea>,
    /// Each piece with its permeability.
    pieces: Vec<(f64, Surface)>,
    /// Weight of the water (N/m3).
    weight: f64,
}

/// A corner of a panel: its arm from the body's origin, its height over the surface of the waves (m), and the pressure there (Pa).
#[derive(Clone, Copy, Debug)]
struct Corner {
    arm: Vector3<f64>,
    over: f64,
    pressure: f64,
}

/// That of a body under way; `None` without waves or without such pieces.
///
/// # Errors
/// A piece that is not a closed surface.
pub fn of(model: &Model, body: &Body, sea: Option<&Arc<Sea>>) -> Result<Option<WavePressure>, ClassError> {
    let Some(sea) = sea else { return Ok(None) };
    let mut pieces = Vec::new();
    for part in model.parts_of(body) {
        for piece in part.pieces.iter().filter(|p| p.waves == WaveAction::Pressure && p.permeability != 0.0) {
            if let Some(surface) = skin(part, piece)? {
                let factor = piece.permeability * model.multipliers.of(Category::Wave.name(), &part.name);
                pieces.push((factor, divided(surface, EDGE / mean_number(sea))));
            }
        }
    }
    let weight = sea.density * sea.gravity;
    Ok((!pieces.is_empty()).then(|| WavePressure { sea: Arc::clone(sea), pieces, weight }))
}

/// A surface whose edges are no longer than a length (m), as far as it may be divided. Each edge that is too long is halved, in both of its
/// panels, so that the surface stays closed.
fn divided(mut surface: Surface, longest: f64) -> Surface {
    loop {
        let mut halves: BTreeMap<(u32, u32), u32> = BTreeMap::new();
        let mut faces = Vec::with_capacity(2 * surface.faces.len());
        for &[a, b, c] in &surface.faces {
            let mut middle = |p: u32, q: u32| {
                let (from, to) = (*surface.vertices.get(p as usize)?, *surface.vertices.get(q as usize)?);
                ((to - from).norm() > longest).then(|| {
                    *halves.entry((p.min(q), p.max(q))).or_insert_with(|| {
                        surface.vertices.push((from + to) * 0.5);
                        (surface.vertices.len() - 1) as u32
                    })
                })
            };
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            match [ab, bc, ca] {
                [None, None, None] => faces.push([a, b, c]),
                [Some(x), Some(y), Some(z)] => faces.extend([[a, x, z], [x, b, y], [z, y, c], [x, y, z]]),
                // one half, or two: the corner first that follows the whole edge or precedes the halved one
                [Some(x), None, None] => faces.extend([[a, x, c], [x, b, c]]),
                [None, Some(y), None] => faces.extend([[b, y, a], [y, c, a]]),
                [None, None, Some(z)] => faces.extend([[c, z, b], [z, a, b]]),
                [Some(x), Some(y), None] => faces.extend([[x, b, y], [a, x, y], [a, y, c]]),
                [None, Some(y), Some(z)] => faces.extend([[y, c, z], [b, y, z], [b, z, a]]),
                [Some(x), None, Some(z)] => faces.extend([[z, a, x], [c, z, x], [c, x, b]]),
            }
        }
        surface.faces = faces;
        if halves.is_empty() || surface.faces.len() > MOST {
            return surface;
        }
    }
}

/// Where the surface cuts the edge between two corners on its two sides; the pressure there is zero.
fn cut(a: &Corner, b: &Corner) -> Corner {
    let share = a.over / (a.over - b.over);
    Corner { arm: a.arm + (b.arm - a.arm) * share, over: 0.0, pressure: 0.0 }
}

/// The force and moment of a pressure that is straight on a triangle, against its normal.
fn pressed([a, b, c]: [&Corner; 3]) -> Six {
    let area = (b.arm - a.arm).cross(&(c.arm - a.arm)) * 0.5;
    let (sum, arms) = (a.pressure + b.pressure + c.pressure, a.arm + b.arm + c.arm);
    let force = -area * (sum / 3.0);
    // int p r dA = A/12 (sum p sum r + sum p r)
    let own = a.arm * a.pressure + b.arm * b.pressure + c.arm * c.pressure;
    let moment = -((arms * sum + own) / 12.0).cross(&area);
    Six::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
}

/// The part of a triangle below the surface.
fn below([a, b, c]: [&Corner; 3]) -> Six {
    // the corner that is alone on its side comes first
    let wet = [a, b, c].map(|x| x.over <= 0.0);
    let [p, q, r] = match wet {
        [true, true, true] => return pressed([a, b, c]),
        [false, false, false] => return Six::zeros(),
        [true, false, false] | [false, true, true] => [a, b, c],
        [false, true, false] | [true, false, true] => [b, c, a],
        _ => [c, a, b],
    };
    let (pq, pr) = (cut(p, q), cut(p, r));
    if p.over <= 0.0 { pressed([p, &pq, &pr]) } else { pressed([&pq, q, r]) + pressed([&pq, r, &pr]) }
}

impl WavePressure {
    /// The force of the waves at a time in a pose, beyond that of the mean level.
    pub fn at(&self, time: f64, pose: &Pose) -> Six {
        let sea = self.sea.at(time);
        let mut sum = Six::zeros();
        let mut corners: Vec<Corner> = Vec::new();
        for (factor, surface) in &self.pieces {
            corners.clear();
            corners.extend(surface.vertices.iter().map(|vertex| {
                let arm = pose.axes * vertex;
                let place = pose.origin + arm;
                let (found, height) = (sea.kinematics(place), place.z - self.sea.level);
                Corner { arm, over: height - found.elevation, pressure: found.pressure - self.weight * height }
            }));
            let mut own = Six::zeros();
            for face in &surface.faces {
                let [a, b, c] = face.map(|n| corners.get(n as usize));
                if let (Some(a), Some(b), Some(c)) = (a, b, c) {
                    own += below([a, b, c]);
                }
            }
            sum += (own - surface.wet(pose, self.sea.level).load(self.weight).wrench) * *factor;
        }
        sum
    }
}

impl BodyLoad for WavePressure {
    fn category(&self) -> Category {
        Category::Wave
    }

    /// Its mean: that of the waves of first order, nothing.
    fn load(&self, _pose: &Pose) -> Result<Load, ClassError> {
        Ok(Load::none())
    }

    fn states(&self) -> usize {
        6
    }

    fn begin(&self, ahead: &Underway, state: &mut [f64]) -> Result<(), ClassError> {
        let found = self.at(ahead.time, ahead.pose);
        if found.iter().any(|x| !x.is_finite()) {
            return Err(ClassError::new("the pressure of the waves has no value where the body is"));
        }
        for (kept, value) in state.iter_mut().zip(found.iter()) {
            *kept = *value;
        }
        Ok(())
    }

    fn moving(&self, _at: &Underway, state: &[f64]) -> Result<MovingLoad, ClassError> {
        let wrench = Six::from_iterator(state.iter().copied().chain([0.0; 6]).take(6));
        Ok(MovingLoad::of(Load { wrench, ..Load::none() }))
    }
}
