//! What acts on a point where connectors meet: the buoyancy of a sphere, and the sea bottom.

use super::{BodyLoad, Category, Load};
use std::f64::consts::PI;
use windlass_base::pose::Pose;
use windlass_model::{ClassError, Junction, Mass, Surroundings};

/// A sphere about the origin.
#[derive(Debug)]
struct Sphere {
    radius: f64,
    /// Weight of the water (N/m3) and its level (m).
    water: f64,
    level: f64,
}

/// A bottom that pushes the more the nearer the origin is to it.
#[derive(Debug)]
struct JunctionBottom {
    /// Its elevation (m).
    elevation: f64,
    /// Height from which on it pushes (m).
    reach: f64,
    /// What it carries where three fifths of the reach are missing (N), about; at nothing left, all there is.
    carried: f64,
}

/// Height above the bottom from which on it carries a junction (m): small against any line, so that what lies there lies as
/// good as on it, and above it, where a line to its anchor has an answer.
const BOTTOM_REACH_M: f64 = 0.01;

/// Share of the reach from which on the force grows straight: a thousand times what is carried in the middle, and more on the
/// bottom than any line pulls.
const LINEAR_REACH_SHARE: f64 = 0.9999;

/// The loads of a junction besides its weight.
pub fn build_junction_loads(junction: &Junction, mass: &Mass, around: &Surroundings) -> Vec<Box<dyn BodyLoad>> {
    let mut list: Vec<Box<dyn BodyLoad>> = Vec::new();
    if junction.volume > 0.0 {
        let radius = (0.75 * junction.volume / PI).cbrt();
        list.push(Box::new(Sphere { radius, water: around.water_weight(), level: around.tide }));
    }
    if let Some(depth) = around.depth {
        // the weight and a ton of line
        let carried = mass.mass * around.gravity + 1e4;
        list.push(Box::new(JunctionBottom { elevation: -depth, reach: BOTTOM_REACH_M, carried }));
    }
    list
}

/// A force straight up on the origin, and its decrease by the elevation.
fn upward(force: f64, stiffness: f64) -> Load {
    let mut load = Load::none();
    load.wrench[2] = force;
    load.stiffness[(2, 2)] = stiffness;
    load
}

impl BodyLoad for Sphere {
    fn category(&self) -> Category {
        Category::Buoyancy
    }

    fn mean_load(&self, pose: &Pose) -> Result<Load, ClassError> {
        let r = self.radius;
        let h = (self.level - pose.origin.z + r).clamp(0.0, 2.0 * r);
        let (volume, plane) = (PI * h * h * (3.0 * r - h) / 3.0, PI * h * (2.0 * r - h));
        Ok(upward(self.water * volume, self.water * plane))
    }
}

impl BodyLoad for JunctionBottom {
    fn category(&self) -> Category {
        Category::Bottom
    }

    fn mean_load(&self, pose: &Pose) -> Result<Load, ClassError> {
        let missing = (1.0 - (pose.origin.z - self.elevation) / self.reach).max(0.0);
        // s2 / (1 - s), straight from near its end on: a search may begin below
        let s = missing.min(LINEAR_REACH_SHARE);
        let force = s * s / (1.0 - s);
        let slope = s * (2.0 - s) / ((1.0 - s) * (1.0 - s));
        let force = force + slope * (missing - s);
        Ok(upward(self.carried * force, self.carried * slope / self.reach))
    }
}
