//! Static stability: a body heeled at constant displacement, balanced in heave and trim.
//!
//! Source: [MOSES-REF static, hstatic]: three degrees of freedom (heave and two angles), connectors left out.

use super::{Category, Floating};
use nalgebra::{Matrix2, Vector2, Vector3};
use windlass_base::dense::{Lu, never};
use windlass_base::geometry::Place;
use windlass_base::pose::Pose;
use windlass_base::units::Dim;
use windlass_model::ClassError;

/// Most Newton steps of one heel.
const MAX_NEWTON_ITERATIONS: usize = 200;
/// Largest change of trim in a step (rad).
const MAX_TRIM_CHANGE_RAD: f64 = 0.1;
/// What may be left of force and moment, as a share of the weight and of the weight times the size.
const RESIDUAL_TOLERANCE: f64 = 1e-10;

/// A body balanced at a heel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Balanced {
    /// Where it stands: x, y, roll and yaw as given, z and pitch found.
    pub place: Place,
    /// Righting arm (m): the moment about the fore-and-aft axis through the centre of gravity that turns the body back from a
    /// positive roll, over the weight.
    pub arm: f64,
    /// The weight it is of, with the contents of compartments (N).
    pub weight: f64,
}

/// Whether a category acts on a body in still water and air by itself.
fn still(category: Category) -> bool {
    matches!(category, Category::Weight | Category::Contents | Category::Buoyancy)
}

/// Balances heave and trim under weight and buoyancy at the roll of a place, from that place.
///
/// Newton's iteration with steps that are limited in length and not searched: the balance is smooth, and without a waterplane the matrix is
/// singular on the way.
///
/// # Errors
/// A body without weight, or for which no balance was found.
pub fn balance_heave_and_trim(floating: &Floating, from: &Place) -> Result<Balanced, ClassError> {
    let loads: Vec<_> = floating.loads.iter().filter(|load| still(load.category())).collect();
    let sum = |pose: &Pose| {
        let mut total = super::Load::none();
        for load in &loads {
            let load = load.mean_load(pose)?;
            total.wrench += load.wrench;
            total.stiffness += load.stiffness;
        }
        Ok::<_, ClassError>(total)
    };
    let heavy = loads.iter().filter(|load| load.category() != Category::Buoyancy);
    let weight =
        -heavy.map(|load| load.mean_load(&Pose::from_place(from)).map(|l| l.wrench[2])).sum::<Result<f64, _>>()?;
    if weight <= 0.0 {
        return Err(ClassError::new("it has no weight"));
    }
    let mut place = *from;
    let [_, _, yaw] = place.turn;
    // the axes of the heading: forward along x, and across, about which the body trims
    let (along, across) = (Vector3::new(yaw.cos(), yaw.sin(), 0.0), Vector3::new(-yaw.sin(), yaw.cos(), 0.0));
    for _ in 0..MAX_NEWTON_ITERATIONS {
        let pose = Pose::from_place(&place);
        let total = sum(&pose)?;
        let arm = pose.axes * floating.mass.centre;
        let (force, turn) =
            (total.wrench.fixed_rows::<3>(0).into_owned(), total.wrench.fixed_rows::<3>(3).into_owned());
        let about = turn - arm.cross(&force);
        // force and moment about the origin by heave and by a turn about the axis across
        let stiffness = &total.stiffness;
        let [by_heave, by_trim] = [stiffness.column(2).into_owned(), stiffness.fixed_columns::<3>(3) * across];
        let size = (by_trim.fixed_rows::<3>(3).dot(&across).abs() / weight).max(arm.norm());
        let trim = about.dot(&across);
        if force.z.abs() <= RESIDUAL_TOLERANCE * weight && trim.abs() <= RESIDUAL_TOLERANCE * weight * size {
            return Ok(Balanced { place, arm: -about.dot(&along) / weight, weight });
        }
        let matrix = Matrix2::new(
            by_heave[2],
            by_trim[2],
            by_heave.fixed_rows::<3>(3).dot(&across),
            by_trim.fixed_rows::<3>(3).dot(&across),
        );
        let step = Lu::new(matrix, &never).and_then(|lu| lu.solve(&Vector2::new(force.z, turn.dot(&across))));
        // without a waterplane nothing holds it: it rises or sinks by a tenth of what it is
        let step = step.unwrap_or_else(|_| Vector2::new(0.1 * size * force.z.signum(), 0.0));
        let cut = (MAX_TRIM_CHANGE_RAD / step[1].abs()).min(0.5 * size / step[0].abs()).min(1.0);
        place.shift[2] += cut * step[0];
        place.turn[1] += cut * step[1];
    }
    let values = [(place.turn[0], Dim::Angle), (place.shift[2], Dim::Length), (place.turn[1], Dim::Angle)];
    Err(ClassError::with_values(
        "no balance of heave and trim was found at a roll of {}; the last try was at z {}, trim {}",
        &values,
    )
    .help("a body that displaces less than it weighs when it is under water does not float"))
}
