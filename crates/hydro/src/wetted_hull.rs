//! Panels of the wetted hull of a body where it stands, for radiation and diffraction of waves.

use crate::buoyancy::skin;
use crate::hull::{Combination, Surface};
use crate::panel_cells::cells;
use crate::rectangles;
use crate::sharp_edges::{edge_at, sharp_edges};
use nalgebra::{Matrix3, Rotation3, Vector3};
use windlass_base::pose::Pose;
use windlass_model::{Body, ClassError, Model, PanelSizes, Part, Piece, Shape, WaveAction};

/// A polygon of a face, counter-clockwise as seen from the water.
pub(crate) type Polygon = Vec<Vector3<f64>>;

/// Halves whose moments agree to this share are mirror images.
const MIRROR_SHARE: f64 = 1e-7;
/// Nearer to the water level than this share of the hull a corner lies in it: slivers of panels between would be worse than what they add.
const WATERLINE_SHARE: f64 = 2e-5;
/// Nearer to a plane than this share of the hull a corner lies in it.
const PLANE_SHARE: f64 = 1e-9;

/// The hull of a body that displaces water, in upright axes: x along the body's heading, z up from the water level, the origin above or below
/// that of the body.
#[derive(Clone, Debug)]
pub struct WettedHull {
    polygons: Vec<Polygon>,
    /// Of each side of each polygon, whether panels are refined toward it: sharp edges that stick out into the water, and the waterline.
    refined: Vec<Vec<bool>>,
    /// From these axes to those of the body.
    pub axes: Matrix3<f64>,
    /// Height of the body's origin over the water level (m).
    pub origin_height: f64,
    /// Whether the hull is the same at -x and at -y.
    pub mirrors: [bool; 2],
    /// Wetted area (m2).
    pub area: f64,
    /// Displaced volume (m3).
    pub volume: f64,
    /// Names of the pieces it is of.
    pub pieces: Vec<String>,
    /// Whether its polygons are the panels of the piece as they are, which a mesh keeps.
    pub has_own_panels: bool,
}

/// Why there is no wetted hull.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum WettedHullError {
    /// No piece that waves act on by a database.
    #[error(
        "{0} has no piece whose hull waves act on: BLOCK, PGEN or PANEL describes one; -DIFTYPE FK and members are not meshed"
    )]
    NoPieces(String),
    /// All of it is above the water.
    #[error("{0} does not touch the water where it stands")]
    Dry(String),
    /// A piece that takes volume away.
    #[error(
        "{piece} of {body} has permeability {permeability}: such a piece is not meshed; DIFFERENCE of blocks makes one hull"
    )]
    Permeability {
        /// The body.
        body: String,
        /// The piece.
        piece: String,
        /// Its permeability.
        permeability: f64,
    },
    /// A piece that is no closed surface.
    #[error("{0}")]
    Piece(String),
    /// A piece that keeps its panels beside another one.
    #[error(
        "{piece} of {body} has -OWN_PANELS, and {other} is of its hull too: panels are taken as they are of a hull of one piece"
    )]
    OwnPanels {
        /// The body.
        body: String,
        /// The piece.
        piece: String,
        /// The other one.
        other: String,
    },
    /// A piece without panels that should keep them.
    #[error("{piece} of {body} has -OWN_PANELS and is not made of panels: PANEL records or a mesh file give them")]
    NoOwnPanels {
        /// The body.
        body: String,
        /// The piece.
        piece: String,
    },
    /// Pieces that cannot be united.
    #[error("the pieces of {body} cannot be made one hull: {why}")]
    Union {
        /// The body.
        body: String,
        /// Why.
        why: String,
    },
}

impl WettedHull {
    /// The hull of a body below a water level (m), its pieces united.
    ///
    /// # Errors
    /// No piece under water; an open piece or one of another permeability than 1; pieces that cannot be united.
    pub fn new(model: &Model, body: &Body, level: f64) -> Result<Self, WettedHullError> {
        let (mut surface, mut names): (Option<Surface>, Vec<String>) = (None, Vec::new());
        let mut keeper: Option<(&Part, &Piece)> = None;
        for part in model.parts_of(body) {
            for piece in &part.pieces {
                if !is_of_hull(piece) {
                    continue;
                }
                if piece.permeability != 1.0 {
                    let (body, piece, permeability) = (body.name.clone(), piece.name.clone(), piece.permeability);
                    return Err(WettedHullError::Permeability { body, piece, permeability });
                }
                let said = |error: ClassError| WettedHullError::Piece(error.to_string());
                let Some(own) = skin(part, piece).map_err(said)? else { continue };
                names.push(piece.name.clone());
                if piece.own_panels {
                    keeper = Some((part, piece));
                }
                surface = Some(match surface {
                    None => own,
                    Some(united) => united
                        .combined(&own, Combination::Union)
                        .map_err(|why| WettedHullError::Union { body: body.name.clone(), why: why.to_string() })?,
                });
            }
        }
        let surface = surface.ok_or_else(|| WettedHullError::NoPieces(body.name.clone()))?;
        let (pose, heading) = (Pose::from_place(&body.position), body.position.turn[2]);
        let mut hull = match keeper {
            None => WettedHull::of_surface(&surface, &pose, heading, level),
            Some((part, piece)) => WettedHull::of_own_panels(body, part, piece, &names)?.placed(&pose, heading, level),
        };
        if hull.polygons.is_empty() {
            return Err(WettedHullError::Dry(body.name.clone()));
        }
        hull.pieces = names;
        Ok(hull)
    }

    /// That of a closed surface in body axes, in a pose with a heading (rad).
    fn of_surface(surface: &Surface, pose: &Pose, heading: f64, level: f64) -> Self {
        FacedHull { polygons: rectangles::faces(surface), has_own_panels: false }.placed(pose, heading, level)
    }

    /// The panels of a closed piece as they are, in body axes, all of them turned where they look inward.
    fn of_own_panels(body: &Body, part: &Part, piece: &Piece, names: &[String]) -> Result<FacedHull, WettedHullError> {
        let (body, name) = (body.name.clone(), piece.name.clone());
        if let Some(other) = names.iter().find(|other| **other != name) {
            return Err(WettedHullError::OwnPanels { body, piece: name, other: other.clone() });
        }
        let Shape::Panels(panels) = piece.shape.with_displacement(&part.position) else {
            return Err(WettedHullError::NoOwnPanels { body, piece: name });
        };
        let mut polygons: Vec<Polygon> =
            panels.iter().map(|panel| panel.iter().map(|at| Vector3::from(*at)).collect()).collect();
        let volume: f64 = polygons.iter().map(|face| integral_of_height(face, &area_vector(face))).sum();
        if volume < 0.0 {
            polygons.iter_mut().for_each(|face| face.reverse());
        }
        Ok(FacedHull { polygons, has_own_panels: true })
    }

    /// The longest side of its faces (m): of own panels their size.
    pub fn longest_side(&self) -> f64 {
        self.polygons.iter().map(longest_side).fold(0.0, f64::max)
    }

    /// How deep it reaches (m).
    pub fn draught(&self) -> f64 {
        self.polygons.iter().flatten().fold(0.0, |most: f64, at| most.max(-at.z))
    }

    /// Takes it as standing on the bottom of water of a depth (m) where faces of it lie there, to `room` (m): there is no water under them, and they are
    /// left out. Whether it stands.
    pub fn stand_on_bottom(&mut self, depth: f64, room: f64) -> bool {
        let is_low = |at: &Vector3<f64>| (at.z + depth).abs() <= room;
        let count = self.polygons.len();
        self.polygons.retain(|face| !face.iter().all(is_low));
        if self.polygons.len() == count {
            return false;
        }
        for at in self.polygons.iter_mut().flatten().filter(|at| is_low(at)) {
            at.z = -depth;
        }
        self.area = self.polygons.iter().map(|face| area_vector(face).norm()).sum();
        let extent = self.polygons.iter().flatten().fold(0.0_f64, |most, p| most.max(p.amax()));
        self.refined = sharp_edges(&self.polygons, PLANE_SHARE * extent);
        true
    }

    /// How many faces it has: of own panels their number.
    pub fn face_count(&self) -> usize {
        self.polygons.len()
    }

    /// Whether panels of sizes are refined: some face that is larger than a panel has an edge for it.
    pub fn is_refined_by(&self, sizes: PanelSizes) -> bool {
        let is_large = |face: &Polygon| longest_side(face) > sizes.largest * (1.0 + 1e-9);
        let mut faces = self.polygons.iter().zip(&self.refined);
        sizes.edge_share < 1.0 && faces.any(|(face, refined)| refined.contains(&true) && is_large(face))
    }

    /// Quadrilaterals of a size at most, a triangle repeating a corner: of the part at positive coordinates where mirror planes are used.
    pub fn panels(&self, sizes: PanelSizes, mirrors: [bool; 2]) -> Vec<[Vector3<f64>; 4]> {
        let extent = self.polygons.iter().flatten().fold(0.0_f64, |most, p| most.max(p.amax()));
        let room = PLANE_SHARE * extent;
        let mut made = Vec::new();
        for (polygon, refined) in self.polygons.iter().zip(&self.refined) {
            let mut part = polygon.clone();
            for (axis, used) in mirrors.into_iter().enumerate() {
                if used {
                    part = below(&part, |p| -p[axis], room);
                }
            }
            // a side along a mirror plane is none of the face's, unless the face ends there
            let next = part.iter().cycle().skip(1);
            let refined: Vec<bool> = part
                .iter()
                .zip(next)
                .map(|(a, b)| {
                    let side = edge_at(polygon, &((a + b) * 0.5), 2.0 * room);
                    side.and_then(|side| refined.get(side)).copied().unwrap_or_default()
                })
                .collect();
            cells(&part, &refined, sizes, &mut made);
        }
        made
    }
}

/// The faces of a hull in body axes, counter-clockwise as seen from outside.
struct FacedHull {
    polygons: Vec<Polygon>,
    has_own_panels: bool,
}

impl FacedHull {
    /// What of it is below a water level, in a pose with a heading (rad).
    fn placed(self, pose: &Pose, heading: f64, level: f64) -> WettedHull {
        let tilt = Rotation3::from_axis_angle(&Vector3::z_axis(), -heading).matrix() * pose.axes;
        let origin_height = pose.origin.z - level;
        let place = |p: &Vector3<f64>| tilt * p + Vector3::new(0.0, 0.0, origin_height);
        let mut placed: Vec<Polygon> = self.polygons.iter().map(|face| face.iter().map(place).collect()).collect();
        let extent = placed.iter().flatten().fold(0.0_f64, |most, p| most.max(p.amax()));
        let room = PLANE_SHARE * extent;
        for at in placed.iter_mut().flatten().filter(|at| at.z.abs() < WATERLINE_SHARE * extent) {
            at.z = 0.0;
        }
        // what lies in the surface itself is dry
        let wet = |face: &&Polygon| face.iter().any(|p| p.z < -room);
        let polygons: Vec<Polygon> =
            placed.iter().filter(wet).map(|face| below(face, |p| p.z, room)).filter(|face| face.len() >= 3).collect();
        let mirrors = [0, 1].map(|axis| is_mirrored(&polygons, axis, room));
        let (mut area, mut volume) = (0.0, 0.0);
        for polygon in &polygons {
            let normal = area_vector(polygon);
            area += normal.norm();
            // the divergence of (0, 0, z), which vanishes in the water plane
            volume += integral_of_height(polygon, &normal);
        }
        let refined = sharp_edges(&polygons, room);
        let (axes, has_own_panels) = (tilt.transpose(), self.has_own_panels);
        WettedHull { polygons, refined, axes, origin_height, mirrors, area, volume, pieces: Vec::new(), has_own_panels }
    }
}

/// The longest side of a face (m).
fn longest_side(face: &Polygon) -> f64 {
    let next = face.iter().cycle().skip(1);
    face.iter().zip(next).map(|(a, b)| (b - a).norm()).fold(0.0, f64::max)
}

/// Whether a piece belongs to the hull that waves act on by a database.
fn is_of_hull(piece: &Piece) -> bool {
    let meshed = match piece.waves {
        WaveAction::Database => true,
        WaveAction::ByForm => piece.member.is_none(),
        WaveAction::Pressure | WaveAction::Nothing => false,
    };
    meshed && piece.permeability != 0.0 && piece.compartment.is_none()
}

/// Whether a body has a piece that can be meshed.
pub fn has_hull(model: &Model, body: &Body) -> bool {
    model.parts_of(body).any(|part| part.pieces.iter().any(is_of_hull))
}

/// What of a convex polygon has a measure of at most zero (Sutherland and Hodgman): corners within `room` of zero are on it.
fn below(polygon: &[Vector3<f64>], measure: impl Fn(&Vector3<f64>) -> f64, room: f64) -> Polygon {
    let mut made = Polygon::new();
    let mut push = |p: Vector3<f64>| {
        if made.last().is_none_or(|last: &Vector3<f64>| (last - p).norm() > room) {
            made.push(p);
        }
    };
    let next = polygon.iter().cycle().skip(1);
    for (a, b) in polygon.iter().zip(next) {
        let (m, n) = (measure(a), measure(b));
        if m <= room {
            push(*a);
        }
        if (m < -room && n > room) || (m > room && n < -room) {
            push(a + (b - a) * (m / (m - n)));
        }
    }
    if made.len() > 1 && made.first().zip(made.last()).is_some_and(|(first, last)| (first - last).norm() <= room) {
        made.pop();
    }
    // what only touches the plane has no area on this side
    if made.iter().all(|p| measure(p) >= -room) && !polygon.iter().all(|p| measure(p).abs() <= room) {
        made.clear();
    }
    made
}

/// Area times the normal of a plane polygon (m2).
pub(crate) fn area_vector(polygon: &[Vector3<f64>]) -> Vector3<f64> {
    let Some((first, rest)) = polygon.split_first() else { return Vector3::zeros() };
    rest.windows(2)
        .map(|pair| if let [b, c] = pair { (b - first).cross(&(c - first)) * 0.5 } else { Vector3::zeros() })
        .sum()
}

/// Integral of z over a plane polygon times the vertical component of its normal (m3).
fn integral_of_height(polygon: &[Vector3<f64>], normal: &Vector3<f64>) -> f64 {
    let Some((first, rest)) = polygon.split_first() else { return 0.0 };
    let up = if normal.norm() > 0.0 { normal.z / normal.norm() } else { 0.0 };
    let part =
        |b: &Vector3<f64>, c: &Vector3<f64>| (b - first).cross(&(c - first)).norm() * 0.5 * (first.z + b.z + c.z) / 3.0;
    up * rest.windows(2).map(|pair| if let [b, c] = pair { part(b, c) } else { 0.0 }).sum::<f64>()
}

/// Whether the halves on both sides of a plane through the origin are mirror images, by their moments up to the third order.
fn is_mirrored(polygons: &[Polygon], axis: usize, room: f64) -> bool {
    let other = 1 - axis;
    let moments = |sign: f64| {
        let mut sums = [0.0; 12];
        for polygon in polygons {
            let half = below(polygon, |p| -sign * p[axis], room);
            let Some((first, rest)) = half.split_first() else { continue };
            for pair in rest.windows(2) {
                let [b, c] = pair else { continue };
                let normal = (b - first).cross(&(c - first)) * 0.5;
                let area = normal.norm();
                // exact to the second degree: middles of the edges
                for p in [(first + b) * 0.5, (b + c) * 0.5, (c + first) * 0.5] {
                    let (a, o, z, w) = (sign * p[axis], p[other], p.z, area / 3.0);
                    let terms = [
                        1.0,
                        a,
                        o,
                        z,
                        a * a,
                        o * o,
                        z * z,
                        a * o,
                        a * z,
                        o * z,
                        normal[other] * a / area.max(f64::MIN_POSITIVE),
                        normal.z * o * a / area.max(f64::MIN_POSITIVE),
                    ];
                    for (sum, term) in sums.iter_mut().zip(terms) {
                        *sum += w * term;
                    }
                }
            }
        }
        sums
    };
    let [left, right] = [moments(1.0), moments(-1.0)];
    let extent = polygons.iter().flatten().fold(0.0_f64, |most, p| most.max(p.amax()));
    let area: f64 = left[0] + right[0];
    let degrees = [0, 1, 1, 1, 2, 2, 2, 2, 2, 2, 1, 2];
    left.iter()
        .zip(right)
        .zip(degrees)
        .all(|((a, b), degree)| (a - b).abs() <= MIRROR_SHARE * area * extent.powi(degree))
}

#[cfg(test)]
mod tests {
    use super::*;
    use windlass_base::geometry::Place;

    fn box_hull(low: [f64; 3], high: [f64; 3], at: [f64; 3]) -> WettedHull {
        let place = Place { shift: at, turn: [0.0; 3] };
        WettedHull::of_surface(&Surface::block(low, high), &Pose::from_place(&place), 0.0, 0.0)
    }

    #[test]
    fn box_is_cut_at_the_water_and_mirrored() {
        // 40 x 10 m, keel 3 m below the water
        let hull = box_hull([-20.0, -5.0, 0.0], [20.0, 5.0, 8.0], [0.0, 0.0, -3.0]);
        assert!((hull.volume - 1200.0).abs() < 1e-9 && (hull.area - (400.0 + 2.0 * 3.0 * 50.0)).abs() < 1e-9);
        assert_eq!(hull.mirrors, [true, true]);
        let panels = hull.panels(PanelSizes::equal(2.5), [false, false]);
        // bottom 16 x 4, sides 16 x 2 and 4 x 2 twice each
        assert_eq!(panels.len(), 64 + 2 * (32 + 8));
        let quarter = hull.panels(PanelSizes::equal(2.5), [true, true]);
        assert_eq!(quarter.len() * 4, panels.len());
        assert!(quarter.iter().flatten().all(|p| p.x > -1e-9 && p.y > -1e-9 && p.z < 1e-9));
        let area: f64 = quarter.iter().map(|[a, b, c, d]| 0.5 * (c - a).cross(&(d - b)).norm()).sum();
        assert!((4.0 * area - hull.area).abs() < 1e-9);
        // normals out of the hull: the bottom looks down
        let outward = panels.iter().all(|[a, b, c, d]| {
            let (normal, middle) = ((c - a).cross(&(d - b)), (a + b + c + d) * 0.25);
            normal.dot(&(middle - Vector3::new(0.0, 0.0, -1.5))) > 0.0
        });
        assert!(outward);
    }

    #[test]
    fn box_on_the_bottom_has_no_panels_below() {
        // two sides of 40 x 3 m and two of 10 x 3 m are left, refined at the waterline alone
        let mut hull = box_hull([-20.0, -5.0, 0.0], [20.0, 5.0, 8.0], [0.0, 0.0, -3.0]);
        assert!(!hull.stand_on_bottom(3.1, 0.003));
        assert!(hull.stand_on_bottom(3.001, 0.003));
        assert!((hull.area - 100.0 * 3.001).abs() < 1e-9 && (hull.draught() - 3.001).abs() < 1e-12);
        assert!(hull.refined.iter().all(|sides| sides.iter().filter(|is| **is).count() == 1 + 2));
        assert!((hull.volume - 1200.0).abs() < 1e-9);
    }

    #[test]
    fn hull_off_its_origin_has_no_mirror_there() {
        let hull = box_hull([-10.0, -5.0, 0.0], [20.0, 5.0, 8.0], [0.0, 0.0, -3.0]);
        assert_eq!(hull.mirrors, [false, true]);
    }
}
