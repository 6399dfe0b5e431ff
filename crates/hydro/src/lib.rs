//! What acts on a body besides its connectors: weight, buoyancy, wind, current, mean wave drift.
//!
//! Each kind of load is one file with a type that implements [`BodyLoad`]; [`Floating`] gathers those of a body.
//!
//! # Example
//! A wave of 10 s in deep water is g T^2 / (2 pi) long:
//! ```
//! use std::f64::consts::TAU;
//! let number = windlass_hydro::sea::dispersion::wave_number(TAU / 10.0, None, 9.81)?;
//! assert!((TAU / number - 9.81 * 100.0 / TAU).abs() < 1e-9);
//! # Ok::<(), windlass_model::ClassError>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod ambient;
pub mod area;
mod body_load;
mod body_loads;
mod buoyancy;
pub mod coefficients;
pub mod current;
pub mod database;
pub mod drag;
pub mod drift;
pub mod growth;
pub mod growth_loads;
pub mod gusts;
pub mod heading;
pub mod hull;
mod junction;
mod linear;
pub mod low_frequency;
mod lump;
pub mod morison;
mod panel_cells;
pub mod parts;
pub mod pieces;
pub mod plate;
pub mod pressure;
pub mod ramp;
mod rectangles;
pub mod roll_damping;
pub mod sea;
mod sharp_edges;
pub mod spectrum;
pub mod stability;
pub mod steady;
pub mod stream;
pub mod strips;
pub mod structure;
pub mod surface_integrals;
mod tank;
pub mod variation;
mod weight;
pub mod wetted_hull;
pub mod wind;

pub use ambient::ambient;
pub use body_load::{BodyLoad, BodyStep, DividedLoad, DynamicLoad, Immersed, InertialLoad, PreparedLoad, StatefulLoad};
pub use buoyancy::{Hull, PieceFault, combine_pieces, piece_faults, piece_overlaps};
pub use tank::{Liquid, Tank, balance_tanks, compartments_of, contents_mass, laden_mass};

use nalgebra::{Matrix3, Matrix6, Rotation3, Vector3};
use sea::Sea;
use std::sync::Arc;
use windlass_base::pose::{Pose, Six};
use windlass_model::{Body, ClassError, ConnectorCategory, Mass, Model};

/// Categories of force that reports tell apart.
///
/// Source: [MOSES-REF forces]. Some of them have no load yet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Category {
    /// Weights.
    Weight,
    /// Contents of compartments.
    Contents,
    /// Hydrostatic pressure.
    Buoyancy,
    /// Wind.
    Wind,
    /// Viscous drag of current.
    ViscousDrag,
    /// Waves of first order: excitation, and pressure and inertia on members and hulls but for what is slow of these.
    Wave,
    /// Radiation and linear damping of the body's own motion.
    RadiationDrag,
    /// Wave drift: its mean, and in time what varies slowly.
    WaveDrift,
    /// What is slow of the pressure and inertia of waves on hulls of Froude and Krylov and on members (ours): their mean, which is no drift
    /// force, as the undisturbed waves alone make it.
    WaveMean,
    /// What the sea bottom carries (ours).
    Bottom,
    /// Forces given by the user.
    Applied,
    /// Flexible connectors.
    FlexConnectors,
    /// Restraints.
    RigidConnectors,
    /// Inertia of the body's own mass, as a force.
    Inertia,
    /// Inertia of the added mass, as a force.
    AddedInertia,
    /// What turning axes add to inertia, as a force.
    Coriolis,
}

impl From<ConnectorCategory> for Category {
    fn from(category: ConnectorCategory) -> Self {
        match category {
            ConnectorCategory::Flexible => Category::FlexConnectors,
            ConnectorCategory::Rigid => Category::RigidConnectors,
        }
    }
}

impl Category {
    /// All, in the order of reports.
    pub const ALL: [Category; 16] = [
        Category::Weight,
        Category::Contents,
        Category::Buoyancy,
        Category::Wind,
        Category::ViscousDrag,
        Category::Wave,
        Category::RadiationDrag,
        Category::WaveDrift,
        Category::WaveMean,
        Category::Bottom,
        Category::Applied,
        Category::FlexConnectors,
        Category::RigidConnectors,
        Category::Inertia,
        Category::AddedInertia,
        Category::Coriolis,
    ];

    /// Its index in [`Category::ALL`] and in lists by category.
    pub const fn index(self) -> usize {
        self as usize
    }

    /// Its name in reports (MOSES).
    pub const fn name(self) -> &'static str {
        match self {
            Category::Weight => "WEIGHT",
            Category::Contents => "CONTENTS",
            Category::Buoyancy => "BUOYANCY",
            Category::Wind => "WIND",
            Category::ViscousDrag => "V_DRAG",
            Category::Wave => "WAVE",
            Category::RadiationDrag => "R_DRAG",
            Category::WaveDrift => "W_DRIFT",
            Category::WaveMean => "W_MEAN",
            Category::Bottom => "BOTTOM",
            Category::FlexConnectors => "FLEX_CONNECTORS",
            Category::RigidConnectors => "RIGID_CONNECTORS",
            Category::Applied => "APPLIED",
            Category::Inertia => "INERTIA",
            Category::AddedInertia => "A_INERTIA",
            Category::Coriolis => "CORIOLIS",
        }
    }
}

const _: () = {
    let mut i = 0;
    while i < Category::ALL.len() {
        assert!(Category::ALL[i].index() == i, "categories are declared in the order of reports");
        i += 1;
    }
};

/// A force on a body at rest, and how it changes with the body's place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    /// Force (N) and moment (N m) about the body's origin, global axes.
    pub wrench: Six,
    /// -d(wrench)/d(translation of the origin, rotation vector), global axes.
    pub stiffness: Matrix6<f64>,
}

impl Load {
    /// Nothing.
    pub fn none() -> Self {
        Load { wrench: Six::zeros(), stiffness: Matrix6::zeros() }
    }

    /// A force (N, global) that does not change, on a point that moves with the body; `arm` is from the origin to it.
    pub fn constant(force: Vector3<f64>, arm: Vector3<f64>) -> Self {
        let moment = arm.cross(&force);
        let mut stiffness = Matrix6::zeros();
        // d(arm x F) = (turn x arm) x F = F x (arm x turn)
        stiffness.fixed_view_mut::<3, 3>(3, 3).copy_from(&(-cross(force) * cross(arm)));
        Load { wrench: Six::new(force.x, force.y, force.z, moment.x, moment.y, moment.z), stiffness }
    }
}

impl Load {
    /// The same about another point that moves with the body; `arm` is from the present one to it (m, global axes).
    pub fn about_point(&self, arm: Vector3<f64>) -> Self {
        let stiffness = move_stiffness(&self.stiffness, -arm, -arm) + turning(&self.wrench, -arm);
        Load { wrench: move_wrench(&self.wrench, -arm), stiffness }
    }
}

/// A wrench (N, N m) about a point as one about the origin from which `arm` leads to the point (m).
pub fn move_wrench(wrench: &Six, arm: Vector3<f64>) -> Six {
    let force = Vector3::new(wrench[0], wrench[1], wrench[2]);
    let moment = arm.cross(&force);
    let mut carried = *wrench;
    carried[3] += moment.x;
    carried[4] += moment.y;
    carried[5] += moment.z;
    carried
}

/// A stiffness block (N/m, N, N m) between two points as one between the origins that the arms lead from, for a wrench that keeps its arm.
pub fn move_stiffness(block: &Matrix6<f64>, row: Vector3<f64>, column: Vector3<f64>) -> Matrix6<f64> {
    let mut moved = *block;
    // the far point moves by turn x arm: columns
    let far = cross(column);
    for rows in [0, 3] {
        let force = block.fixed_view::<3, 3>(rows, 0) * far;
        let mut at = moved.fixed_view_mut::<3, 3>(rows, 3);
        at -= force;
    }
    // moment about the origin: rows
    let near = cross(row);
    for columns in [0, 3] {
        let moment = near * moved.fixed_view::<3, 3>(0, columns);
        let mut at = moved.fixed_view_mut::<3, 3>(3, columns);
        at += moment;
    }
    moved
}

/// What an arm (m) that turns with its body adds to the stiffness: -d(arm x force)/d(rotation vector) (N m/rad).
pub fn turning(wrench: &Six, arm: Vector3<f64>) -> Matrix6<f64> {
    let force = Vector3::new(wrench[0], wrench[1], wrench[2]);
    Load::constant(force, arm).stiffness
}

/// The matrix that makes the cross product `a x b` of a vector b.
pub fn cross(a: Vector3<f64>) -> Matrix3<f64> {
    a.cross_matrix()
}

/// A body with all that acts on it besides its connectors.
#[derive(Debug)]
pub struct Floating {
    /// Its mass, with what is in its compartments.
    pub mass: Mass,
    /// What acts on it.
    pub loads: Vec<Box<dyn BodyLoad>>,
    /// Added mass about its origin, body axes (kg, kg m, kg m2): of `#AMASS`, of members, of a database at infinite frequency, and the
    /// inertia of growth. Under way that of a database is among the loads.
    pub added_mass: Matrix6<f64>,
    /// Linear damping about its origin, body axes (N s/m, N s, N m s), of `#DRAG` and `#DAMP`. Under way that of a body with a database is
    /// among the loads.
    pub damping: Matrix6<f64>,
}

impl Floating {
    /// That of a body of the model, in the environment in force.
    ///
    /// # Errors
    /// Loads that contradict themselves, or need what is not defined.
    pub fn at_rest(model: &Model, body: &Body) -> Result<Self, ClassError> {
        Floating::build(model, body, None)
    }

    /// That of a body under way in the environment in force and its sea: what waves do to it is among its loads.
    ///
    /// # Errors
    /// As [`Floating::at_rest`].
    pub fn under_way(model: &Model, body: &Body, sea: Option<&Arc<Sea>>) -> Result<Self, ClassError> {
        Floating::build(model, body, Some(sea))
    }

    /// At rest without a sea; `Some` is under way, with the sea there is.
    fn build(model: &Model, body: &Body, under_way: Option<Option<&Arc<Sea>>>) -> Result<Self, ClassError> {
        let gravity = model.defaults.gravity;
        let mass = Mass::from_parts(model.parts_of(body), gravity);
        let mut loads: Vec<Box<dyn BodyLoad>> = Vec::new();
        loads.extend(weight::build_weight(&mass, gravity));
        loads.extend(tank::build_tank_loads(model, body)?);
        if let Some(junction) = &body.junction {
            loads.extend(junction::build_junction_loads(junction, &mass, &model.surroundings()));
        }
        let hull = Hull::new(model, body)?;
        if let (Some(_), Some(linear)) = (&hull, &body.linear) {
            let text =
                format!("{} has a hull and a linear hydrostatic stiffness: its buoyancy would count twice", body.name);
            return Err(ClassError::new(text)
                .with_span(linear.span)
                .help("leave out #HYDROSTATIC, or give the pieces -PERMEABILITY 0"));
        }
        loads.extend(hull.map(|hull| Box::new(hull) as Box<dyn BodyLoad>));
        loads.extend(linear::build_linear_buoyancy(body));
        let gathered = body_loads::gather_loads(model, body, under_way)?;
        loads.extend(gathered.loads);
        let grown = growth_loads::build_growth_loads(model, body)?;
        loads.extend(grown.loads);
        let (members, of_members) = morison::build_members(model, body, under_way)?;
        loads.extend(members.map(|load| Box::new(load) as Box<dyn BodyLoad>));
        let pressed = pressure::build_wave_pressure(model, body, under_way.flatten())?;
        loads.extend(pressed.map(|load| Box::new(load) as Box<dyn BodyLoad>));
        let mut added_mass = gathered.added_mass + grown.mass + of_members;
        let mut damping = gathered.damping;
        if let Some(brought) = database::attached::gather_database_loads(model, body, under_way, &mut damping)? {
            loads.extend(brought.loads);
            added_mass += brought.added_mass;
        }
        let mass = mass.combine(&tank::contents_mass(model, body)?);
        Ok(Floating { mass, loads, added_mass, damping })
    }

    /// The added mass about the body's origin in a pose (kg, kg m, kg m2), global axes.
    pub fn added_mass(&self, pose: &Pose) -> Matrix6<f64> {
        in_pose(&self.added_mass, pose)
    }

    /// The linear damping about the body's origin in a pose (N s/m, N s, N m s), global axes.
    pub fn linear_damping(&self, pose: &Pose) -> Matrix6<f64> {
        in_pose(&self.damping, pose)
    }
}

/// The heading of a pose (rad): where its x axis points on the plan, from the global x axis toward y.
pub fn heading_of(pose: &Pose) -> f64 {
    pose.axes[(1, 0)].atan2(pose.axes[(0, 0)])
}

/// The axes of the heading of a pose: z up, x where its own points on the plan. Those of a database.
pub fn heading_axes(pose: &Pose) -> Matrix3<f64> {
    *Rotation3::from_axis_angle(&Vector3::z_axis(), heading_of(pose)).matrix()
}

/// A matrix of a database, of the axes of the heading, in global axes.
pub fn in_heading(matrix: &Matrix6<f64>, pose: &Pose) -> Matrix6<f64> {
    in_pose(matrix, &Pose { axes: heading_axes(pose), ..*pose })
}

/// A matrix of the body's axes in global axes.
pub fn in_pose(matrix: &Matrix6<f64>, pose: &Pose) -> Matrix6<f64> {
    let mut turned = Matrix6::zeros();
    for (row, column) in [(0, 0), (0, 3), (3, 0), (3, 3)] {
        let block = pose.axes * matrix.fixed_view::<3, 3>(row, column) * pose.axes.transpose();
        turned.fixed_view_mut::<3, 3>(row, column).copy_from(&block);
    }
    turned
}
