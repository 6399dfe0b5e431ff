//! The bottom under a line: plane faces between vertices, by the distance from the anchor toward the fairlead.

/// The inclination of a face, rising toward the fairlead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tilt {
    pub sin: f64,
    pub cos: f64,
}

impl Tilt {
    pub const FLAT: Tilt = Tilt { sin: 0.0, cos: 1.0 };

    /// From vertical / horizontal distance.
    pub fn new(slope: f64) -> Tilt {
        let hypotenuse = slope.hypot(1.0);
        Tilt { sin: slope / hypotenuse, cos: 1.0 / hypotenuse }
    }

    /// Vertical over horizontal distance (a ratio; above zero where the bottom rises away from the anchor).
    pub fn slope(self) -> f64 {
        self.sin / self.cos
    }

    /// The angle above the horizontal, toward the fairlead (rad).
    pub fn angle(self) -> f64 {
        self.sin.atan2(self.cos)
    }

    /// Components along and normal to the face from those along x and z.
    pub fn to_face(self, x: f64, z: f64) -> (f64, f64) {
        (x * self.cos + z * self.sin, z * self.cos - x * self.sin)
    }
}

/// A bottom of plane faces. Beyond its first and last vertex the outer faces go on.
#[derive(Clone, Debug, PartialEq)]
pub struct SeabedProfile {
    /// Distances from the anchor toward the fairlead (m), growing; at least two.
    at: Vec<f64>,
    /// Elevations there (m).
    z: Vec<f64>,
    /// Inclination of the face beyond each vertex but the last.
    tilts: Vec<Tilt>,
}

impl SeabedProfile {
    /// A plane through an elevation (m) under the anchor, with a slope (vertical over horizontal, rising toward the fairlead).
    pub fn plane(elevation: f64, slope: f64) -> SeabedProfile {
        SeabedProfile { at: vec![0.0, 1.0], z: vec![elevation, elevation + slope], tilts: vec![Tilt::new(slope)] }
    }

    /// From points (distance from the anchor, elevation; m), growing and at least two, so that it has a face; neighbours in one plane are
    /// one face.
    pub fn new(positions: &[(f64, f64)]) -> SeabedProfile {
        let mut kept: Vec<(f64, f64)> = Vec::with_capacity(positions.len());
        let slope = |a: (f64, f64), b: (f64, f64)| (b.1 - a.1) / (b.0 - a.0);
        for position in positions {
            while let [.., before, last] = kept.as_slice()
                && (slope(*before, *last) - slope(*last, *position)).abs()
                    <= 1e-12 * (1.0 + slope(*before, *last).abs())
            {
                kept.pop();
            }
            kept.push(*position);
        }
        let tilts = kept.iter().zip(kept.iter().skip(1)).map(|(a, b)| Tilt::new(slope(*a, *b))).collect();
        let (at, z) = kept.into_iter().unzip();
        SeabedProfile { at, z, tilts }
    }

    /// Number of faces.
    pub fn faces(&self) -> usize {
        self.tilts.len()
    }

    /// The face at a distance (m) from the anchor; 0 is the anchor's.
    pub fn face(&self, at: f64) -> usize {
        self.at.partition_point(|v| *v <= at).clamp(1, self.faces()) - 1
    }

    /// The inclination of a face, a number below [`Profile::faces`].
    pub fn tilt(&self, face: usize) -> Tilt {
        self.tilts[face]
    }

    /// A vertex, a number up to [`Profile::faces`]: distance from the anchor and elevation (m).
    pub fn vertex(&self, vertex: usize) -> (f64, f64) {
        (self.at[vertex], self.z[vertex])
    }

    /// The elevation of a face's plane (m) at a distance (m) from the anchor.
    pub fn elevation_of(&self, face: usize, at: f64) -> f64 {
        let (from, z) = self.vertex(face);
        z + (at - from) * self.tilt(face).slope()
    }

    /// The elevation of the bottom (m) at a distance (m) from the anchor.
    pub fn elevation(&self, at: f64) -> f64 {
        self.elevation_of(self.face(at), at)
    }

    /// From which distance to which (m from the anchor) a face goes: the outer ones without end.
    pub fn extent(&self, face: usize) -> (f64, f64) {
        let from = if face == 0 { f64::NEG_INFINITY } else { self.vertex(face).0 };
        let to = if face + 1 >= self.faces() { f64::INFINITY } else { self.vertex(face + 1).0 };
        (from, to)
    }

    /// Whether the bottom bends downward at the inner vertex on the way to the anchor: a line lies around it.
    pub fn is_ridge(&self, vertex: usize) -> bool {
        vertex > 0 && vertex < self.faces() && self.tilt(vertex - 1).slope() > self.tilt(vertex).slope()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn profile_has_vertex_elevations_and_extrapolates_beyond() {
        let made = SeabedProfile::new(&[(0.0, -100.0), (50.0, -95.0), (100.0, -90.0), (200.0, -100.0)]);
        assert_eq!(made.faces(), 2, "two neighbours in one plane are one face");
        for (at, z) in [(-10.0, -101.0), (0.0, -100.0), (50.0, -95.0), (100.0, -90.0), (150.0, -95.0), (300.0, -110.0)]
        {
            assert!((made.elevation(at) - z).abs() < 1e-12, "{at}");
        }
        assert!(made.is_ridge(1) && !made.is_ridge(0) && !made.is_ridge(2));
    }
}
