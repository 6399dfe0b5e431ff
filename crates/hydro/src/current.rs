//! Steady current over the depth.
//!
//! Source: [MOSES-REF env, curv]. Where they are silent: a C_PROFILE curve counts its depth from
//! the actual surface, tide included, and is not stretched; it is straight between its points, and above the first and
//! below the last the current is that of the point; below the bottom there is none.

use nalgebra::Vector3;
use windlass_base::geometry::unit_vector;
use windlass_model::{ClassError, Current, CurveKind, Environment, Model};

/// One current over the depth, with its direction.
#[derive(Clone, Debug, PartialEq)]
struct Layered {
    /// Horizontal direction it flows toward.
    toward: Vector3<f64>,
    /// Depth below the surface (m), speed (m/s); depths grow.
    points: Vec<(f64, f64)>,
}

/// The current of an environment: the sum of all that are given.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CurrentField {
    parts: Vec<Layered>,
    /// Depth of the bottom below the surface (m).
    bottom: Option<f64>,
}

impl CurrentField {
    /// The current of an environment, under water of a depth below the surface (m) where it is known.
    ///
    /// # Errors
    /// A curve that is not there.
    pub fn new(model: &Model, env: &Environment, bottom: Option<f64>) -> Result<Self, ClassError> {
        let parts = match &env.current {
            None => Vec::new(),
            Some(Current::Uniform { velocity, direction }) => vec![Layered::new(*direction, vec![(0.0, *velocity)])],
            Some(Current::Profiles(list)) => {
                let one = |(name, direction): &(String, f64)| match model.curves.get(&Model::key(name)) {
                    Some(curve) if curve.kind == CurveKind::CurrentProfile => {
                        Ok(Layered::new(*direction, curve.points.clone()))
                    }
                    _ => Err(ClassError::new(format!("there is no C_PROFILE curve {name}"))),
                };
                list.iter().map(one).collect::<Result<_, _>>()?
            }
        };
        Ok(CurrentField { parts, bottom })
    }

    /// A current of one speed (m/s) from a direction (rad) at every depth.
    pub fn uniform(speed: f64, from: f64) -> Self {
        CurrentField { parts: vec![Layered::new(from, vec![(0.0, speed)])], bottom: None }
    }

    /// The same down to any depth: for a bottom that is not everywhere at one depth.
    pub fn bottomless(self) -> Self {
        CurrentField { bottom: None, ..self }
    }

    /// Whether there is none.
    pub fn is_none(&self) -> bool {
        self.parts.is_empty()
    }

    /// Depths below the surface (m) at which its curves have their points.
    pub fn kinks(&self) -> Vec<f64> {
        self.parts.iter().flat_map(|part| part.points.iter().map(|p| p.0)).collect()
    }

    /// Whether it is one that flows one way at every depth.
    pub fn simple(&self) -> bool {
        self.parts.len() <= 1 && self.parts.iter().flat_map(|part| &part.points).all(|p| p.1 >= 0.0)
    }

    /// Velocity (m/s, global) at a depth below the surface (m), and its change with the depth (1/s). Above the surface it
    /// is that of the surface.
    pub fn at_depth(&self, depth: f64) -> (Vector3<f64>, Vector3<f64>) {
        let mut sum = (Vector3::zeros(), Vector3::zeros());
        if self.bottom.is_some_and(|bottom| depth > bottom) {
            return sum;
        }
        for part in &self.parts {
            let (speed, change) = part.speed_at_depth(depth.max(0.0));
            sum.0 += part.toward * speed;
            sum.1 += part.toward * if depth > 0.0 { change } else { 0.0 };
        }
        sum
    }
}

impl Layered {
    fn new(from: f64, points: Vec<(f64, f64)>) -> Self {
        let (cos, sin) = unit_vector(from);
        Layered { toward: Vector3::new(-cos, -sin, 0.0), points }
    }

    /// Speed at a depth, and its change with the depth.
    fn speed_at_depth(&self, depth: f64) -> (f64, f64) {
        let next = self.points.partition_point(|p| p.0 <= depth);
        let before = next.checked_sub(1).and_then(|i| self.points.get(i));
        match (before, self.points.get(next)) {
            (Some((low, at_low)), Some((high, at_high))) => {
                let change = (at_high - at_low) / (high - low);
                (at_low + change * (depth - low), change)
            }
            (Some(end), None) | (None, Some(end)) => (end.1, 0.0),
            (None, None) => (0.0, 0.0),
        }
    }
}
