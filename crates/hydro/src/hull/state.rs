//! What a naval architect reads from the displaced volume: centres and metacentric heights.

use super::SubmergedVolume;
use nalgebra::{Matrix2, Vector2, Vector3};
use windlass_base::pose::Pose;

/// Hydrostatics of a body in a pose. Heights are vertical and above the body's origin, so that KB, KM and KG have one
/// base in any heel and trim; with the origin on the keel and the body upright they are those of the textbooks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hydrostatics {
    /// Displaced volume (m3).
    pub volume: f64,
    /// Weight of the displaced water (N).
    pub displacement: f64,
    /// Centre of buoyancy (m, global).
    pub centre_of_buoyancy: Vector3<f64>,
    /// Area of the waterplane (m2); zero of a submerged body.
    pub plane_area: f64,
    /// Centroid of the waterplane (m, global x and y); none of a submerged body.
    pub centre_of_flotation: Option<[f64; 2]>,
    /// Wetted area (m2).
    pub wetted_area: f64,
    /// Centre of buoyancy above the body's origin (m).
    pub kb: f64,
    /// Centre of gravity above the body's origin (m).
    pub kg: f64,
    /// Transverse metacentre above the centre of buoyancy (m): second moment of the waterplane about the longitudinal axis
    /// through its centroid, over the volume.
    pub bm_t: f64,
    /// Longitudinal metacentre above the centre of buoyancy (m).
    pub bm_l: f64,
    /// Transverse metacentre above the centre of gravity (m): KB + BM - KG.
    pub gm_t: f64,
    /// Longitudinal metacentre above the centre of gravity (m).
    pub gm_l: f64,
}

impl Hydrostatics {
    /// Those of what is wet in a pose, with the centre of mass (m, body coordinates), in water of a weight (N/m3).
    /// The longitudinal axis is the body's x axis as seen from above; where that stands upright, its z axis.
    /// None of a body that displaces nothing.
    pub fn new(wet: &SubmergedVolume, pose: &Pose, mass_centre: Vector3<f64>, water_weight: f64) -> Option<Self> {
        if wet.volume.is_nan() || wet.volume <= 0.0 {
            return None;
        }
        let centre = wet.moment / wet.volume;
        let gravity = pose.axes * mass_centre;
        let along = longitudinal(pose);
        let area = wet.plane_area;
        let flotation = (area > 0.0).then(|| Vector2::from(wet.plane_moment) / area);
        let [xx, xy, yy] = wet.plane_second;
        let mut second = Matrix2::new(xx, xy, xy, yy);
        if let Some(f) = flotation {
            second -= f * f.transpose() * area;
        }
        let across = Vector2::new(-along.y, along.x);
        let bm_t = across.dot(&(second * across)) / wet.volume;
        let bm_l = along.dot(&(second * along)) / wet.volume;
        Some(Hydrostatics {
            volume: wet.volume,
            displacement: wet.volume * water_weight,
            centre_of_buoyancy: pose.origin + centre,
            plane_area: area,
            centre_of_flotation: flotation.map(|f| [pose.origin.x + f.x, pose.origin.y + f.y]),
            wetted_area: wet.wetted_area,
            kb: centre.z,
            kg: gravity.z,
            bm_t,
            bm_l,
            gm_t: centre.z + bm_t - gravity.z,
            gm_l: centre.z + bm_l - gravity.z,
        })
    }
}

/// The body's x axis seen from above, or its z axis where that one stands upright.
fn longitudinal(pose: &Pose) -> Vector2<f64> {
    let x = pose.axes.column(0);
    let flat = Vector2::new(x[0], x[1]);
    let z = pose.axes.column(2);
    let axis = if flat.norm() > 1e-6 { flat } else { Vector2::new(z[0], z[1]) };
    axis.try_normalize(0.0).unwrap_or_else(Vector2::x)
}
