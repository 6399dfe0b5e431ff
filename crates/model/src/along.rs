//! What a dynamic line reports of its nodes, and of how it swings.

use nalgebra::Vector3;

/// Stresses of a tube at a node (Pa).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LineStress {
    /// Axial, of the wall tension.
    pub axial: f64,
    /// Bending, at the outer surface.
    pub bending: f64,
    /// Hoop, at the inner surface (Lame).
    pub hoop: f64,
    /// Largest von Mises stress over both surfaces and both sides of the bend.
    pub von_mises: f64,
}

/// The energy and momentum balance of a dynamic line, since its run began.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EnergyBalance {
    /// Energy now: of motion, of stretch and bending, of height in air, in what it lies on (J).
    pub energy: [f64; 4],
    /// Work done on it: by what holds its first and its second end, by water and air, by internal damping, by the bottom (J).
    pub work: [f64; 5],
    /// Energy gained beyond the work done (J); negative is what the scheme has damped.
    pub energy_error: f64,
    /// The most energy or work in the balance (J): what the error is to be seen against.
    pub turnover: f64,
    /// Momentum gained beyond the impulse of all outer forces (N s, global).
    pub momentum_error: Vector3<f64>,
}

/// A side of a node of a line where two segments meet.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LineSide {
    /// Segment, from 0.
    pub segment: usize,
    /// Tension in the wall (N).
    pub wall: f64,
    /// Stresses, for a tube.
    pub stress: Option<LineStress>,
}

impl LineSide {
    /// Largest von Mises stress (Pa); 0 without a wall.
    pub fn von_mises(&self) -> f64 {
        self.stress.map_or(0.0, |s| s.von_mises)
    }
}

/// A node of a line, numbered from its first end.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LineNode {
    /// Unstretched distance from the first end (m).
    pub arc: f64,
    /// Segment of the element behind it, from 0; of the last node the last one.
    pub segment: usize,
    /// Position (m, global).
    pub position: Vector3<f64>,
    /// Velocity (m/s).
    pub velocity: Vector3<f64>,
    /// Effective tension (N): what balances the submerged weight.
    pub effective: f64,
    /// Tension in the wall (N): effective tension less outer pressure times outer area plus inner pressure times inner area.
    pub wall: f64,
    /// Shear force (N).
    pub shear: f64,
    /// Bending moment (N m).
    pub moment: f64,
    /// Its components about two directions across the line that are carried along it without twist from the first end (N m): the first
    /// starts from the holder's side, where it has one, otherwise from a direction fixed in space, taken to the line by the shortest
    /// turn.
    pub bends: [f64; 2],
    /// Torsional moment (N m).
    pub torque: f64,
    /// Curvature (1/m), from the shape free of load.
    pub curvature: f64,
    /// Height over the bottom (m); infinite without one.
    pub clearance: f64,
    /// Pressure outside and inside above the atmosphere's (Pa), for a tube.
    pub pressures: [f64; 2],
    /// Stresses, for a tube.
    pub stress: Option<LineStress>,
    /// The side toward the first end, where another segment ends there; `segment`, `wall` and `stress` are of the other side.
    pub before: Option<LineSide>,
}

impl LineNode {
    /// The side toward the second end; where two segments do not meet it is the only one.
    pub fn side_after(&self) -> LineSide {
        LineSide { segment: self.segment, wall: self.wall, stress: self.stress }
    }

    /// The sides on which it is judged, from the first end: two where two segments meet.
    pub fn sides(&self) -> impl Iterator<Item = LineSide> {
        self.before.into_iter().chain([self.side_after()])
    }

    /// The side with the larger von Mises stress.
    pub fn worse(&self) -> LineSide {
        let behind = self.side_after();
        self.before.filter(|b| b.von_mises() > behind.von_mises()).unwrap_or(behind)
    }
}

/// A natural mode of a line between ends that stand still.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LineMode {
    /// Circular frequency without damping (rad/s); zero of a motion that nothing holds.
    pub frequency: f64,
    /// Displacement of each node, numbered from the first end (global axes); its largest is 1.
    pub shape: Vec<Vector3<f64>>,
}

impl LineMode {
    /// Natural period (s), of a mode that something holds.
    pub fn period(&self) -> Option<f64> {
        (self.frequency > 0.0).then(|| std::f64::consts::TAU / self.frequency)
    }
}
