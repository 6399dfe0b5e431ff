//! Symmetry classes: functions that are even or odd about each mirror plane have a system of equations of their own.

use crate::mesh::MirrorPlanes;

/// How a function behaves about the planes x = 0 and y = 0: 1 even, -1 odd; 1 where there is no mirror plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SymmetryClass {
    /// About x = 0 and y = 0.
    pub signs: [f64; 2],
}

impl SymmetryClass {
    /// All classes of a mesh.
    pub fn all(mirrors: MirrorPlanes) -> Vec<Self> {
        mirrors.images().into_iter().map(|signs| SymmetryClass { signs }).collect()
    }

    /// The factor of the function at an image: 1, or -1 where the mirroring turns its sign.
    pub fn factor(self, image: [f64; 2]) -> f64 {
        let about = |axis: usize| if image[axis] < 0.0 { self.signs[axis] } else { 1.0 };
        about(0) * about(1)
    }

    /// Whether the normal velocity of a rigid motion (surge, sway, heave, roll, pitch, yaw from 0) is in the class.
    pub fn has_mode(self, mode: usize, mirrors: MirrorPlanes) -> bool {
        // surge, pitch and yaw are odd in x; sway, roll and yaw are odd in y
        let odd = [matches!(mode, 0 | 4 | 5), matches!(mode, 1 | 3 | 5)];
        [mirrors.x, mirrors.y]
            .iter()
            .enumerate()
            .all(|(axis, mirrored)| !mirrored || odd[axis] == (self.signs[axis] < 0.0))
    }
}
