//! What a line feels all along itself: waves, current, wind, marine growth, the bottom, and what a pipe holds.

use super::growth::Growth;
use super::sea::{Prepared, Sea, SeaAt};
use super::steady::{Medium, Steady};
use nalgebra::Vector3;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use windlass_model::{Ambient, Bathymetry, ClassError, Contents, Flow, Model};

/// Water, wind and bottom of the environment in force.
#[derive(Debug)]
struct EnvironmentAmbient {
    steady: Steady,
    sea: Option<Arc<Sea>>,
    /// The sea as it was last asked about: lines ask one after the other at the same time.
    prepared: Mutex<Option<Prepared>>,
    growth: Option<Growth>,
    /// The bottom, where it is not flat.
    bottom: Option<Arc<Bathymetry>>,
    contents: Option<Contents>,
    interrupt: Arc<AtomicBool>,
}

/// Water, wind and bottom of the environment in force, with the waves of a sea.
///
/// # Errors
/// An environment that cannot be computed, or names a bottom or contents that are not there.
pub fn ambient(model: &Model, sea: Option<&Arc<Sea>>) -> Result<Arc<dyn Ambient>, ClassError> {
    let env = &model.environment;
    let mut steady = Steady::streams(model, env)?.under_way(model, env)?;
    let bottom = model.bathymetry_in(env).cloned();
    if let (Some(named), None) = (&env.bathymetry, &bottom) {
        return Err(ClassError::new(format!("there is no bathymetry {}", named.kind)).with_span(named.span));
    }
    // what lies is a little below -DEPTH, as it presses itself in, and a bottom of its own may be deeper: the current goes on there
    steady.current = steady.current.bottomless();
    let contents = match &env.filling {
        None => None,
        Some(named) => match model.fillings.get(&Model::key(&named.kind)) {
            Some(filling) => Some(filling.contents),
            None => {
                let text = format!("there is no set of T_PRESSURE data {}", named.kind);
                return Err(ClassError::new(text).with_span(named.span));
            }
        },
    };
    let interrupt = Arc::clone(&model.interrupt);
    let (sea, growth) = (sea.cloned(), Growth::from_environment(model, env)?);
    Ok(Arc::new(EnvironmentAmbient { steady, sea, prepared: Mutex::default(), growth, bottom, contents, interrupt }))
}

impl Ambient for EnvironmentAmbient {
    fn flow(&self, time: f64, positions: &[Vector3<f64>], out: &mut [Flow]) {
        let streams = self.steady.streams_at_time(time);
        let prepared = || self.prepared.lock().unwrap_or_else(PoisonError::into_inner);
        // another thread that comes meanwhile prepares its own
        let last = prepared().take();
        let sea = self.sea.as_ref().map(|sea| match last {
            Some(last) => sea.reuse_at_time(time, last),
            None => sea.at_time(time),
        });
        let level = self.steady.around.tide;
        let weight = self.sea.as_ref().map_or(1.0, |sea| (sea.density * sea.gravity).max(f64::MIN_POSITIVE));
        for (position, out) in positions.iter().zip(&mut *out) {
            *out = Flow::still_water(level);
            if !self.steady.is_still(Medium::Water) {
                out.velocity = streams.velocity(Medium::Water, position.z).0;
            }
            out.wind = streams.velocity(Medium::Air, position.z).0;
        }
        if let Some(sea) = &sea {
            sea.wetted_lines(positions, |index, found| {
                let Some(out) = out.get_mut(index) else { return };
                out.velocity += found.velocity;
                out.acceleration += found.acceleration;
                out.surface += found.elevation;
                out.head = found.pressure / weight - found.elevation;
            });
        }
        *prepared() = sea.map(SeaAt::into_prepared);
    }

    fn mean(&self, positions: &[Vector3<f64>], out: &mut [Flow]) {
        let streams = self.steady.mean();
        for (position, out) in positions.iter().zip(out) {
            *out = Flow::still_water(self.steady.around.tide);
            out.velocity = streams.velocity(Medium::Water, position.z).0;
            out.wind = streams.velocity(Medium::Air, position.z).0;
        }
    }

    fn bottom(&self, x: f64, y: f64) -> Option<(f64, [f64; 2])> {
        match &self.bottom {
            Some(grid) => Some(grid.elevation_and_slopes(x, y)),
            None => self.steady.around.depth.map(|depth| (-depth, [0.0; 2])),
        }
    }

    fn has_bottom_grid(&self) -> bool {
        self.bottom.is_some()
    }

    fn is_interrupted(&self) -> bool {
        self.interrupt.load(Ordering::Relaxed)
    }

    fn contents(&self) -> Option<Contents> {
        self.contents
    }

    fn grows(&self) -> bool {
        self.growth.is_some()
    }

    fn growth(&self, z: f64) -> (f64, f64) {
        self.growth.as_ref().map_or((0.0, 0.0), |growth| (0.5 * growth.added_diameter(z), growth.density))
    }
}

#[cfg(test)]
mod tests;
