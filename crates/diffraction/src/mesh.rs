//! Meshes of wetted hulls.

use crate::error::DiffractionError;
use crate::panel::Panel;
use crate::rankine::mirrored;
use nalgebra::{Rotation3, Vector3};

/// How far above the mean level a corner may be, as a share of its panel's diagonal: rounding of a cut.
const LEVEL_SHARE: f64 = 1e-6;

/// Mirror planes of a hull whose mesh is the half or quarter with positive coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MirrorPlanes {
    /// The hull is the same at x and -x.
    pub x: bool,
    /// The hull is the same at y and -y.
    pub y: bool,
}

impl MirrorPlanes {
    /// Signs of x and y of each image, the mesh itself first.
    pub fn images(self) -> Vec<[f64; 2]> {
        let signs = |mirrored: bool| if mirrored { &[1.0, -1.0][..] } else { &[1.0][..] };
        signs(self.x).iter().flat_map(|x| signs(self.y).iter().map(move |y| [*x, *y])).collect()
    }
}

/// The wetted panels of a body, or of the part of it on one side of its mirror planes.
#[derive(Clone, Debug)]
pub struct HullMesh {
    /// Those of the hull, then of damped patches of the surface, then those of the lid.
    panels: Vec<Panel>,
    hull_count: usize,
    /// Of the panels of damped patches: their damping.
    patch_damping: Vec<f64>,
    mirrors: MirrorPlanes,
}

impl HullMesh {
    /// A mesh by the corners of its panels (m; z = 0 is the mean level, a triangle repeats a corner), counter-clockwise as seen from the
    /// water.
    ///
    /// # Errors
    /// No panels; one without area, with a coordinate that is not finite, above the water, or beyond a mirror plane.
    pub fn new(quads: &[[Vector3<f64>; 4]], mirrors: MirrorPlanes) -> Result<Self, DiffractionError> {
        let panels: Vec<Panel> = quads
            .iter()
            .enumerate()
            .map(|(i, corners)| checked_panel(i + 1, corners, mirrors))
            .collect::<Result<_, _>>()?;
        HullMesh::from_panels(panels, Vec::new(), mirrors)
    }

    /// A mesh of panels that were checked: those of the hull and of a lid.
    pub(crate) fn from_panels(
        mut panels: Vec<Panel>,
        lid: Vec<Panel>,
        mirrors: MirrorPlanes,
    ) -> Result<Self, DiffractionError> {
        let hull_count = panels.len();
        panels.extend(lid);
        if hull_count == 0 {
            Err(DiffractionError::NoPanels)
        } else {
            Ok(HullMesh { panels, hull_count, patch_damping: Vec::new(), mirrors })
        }
    }

    /// The same with panels of damped patches of the surface, each with its damping.
    pub(crate) fn with_patches(mut self, patches: Vec<(Panel, f64)>) -> Self {
        let (panels, damping): (Vec<Panel>, Vec<f64>) = patches.into_iter().unzip();
        self.patch_damping = damping;
        self.panels.splice(self.hull_count..self.hull_count, panels);
        self
    }

    /// The panels of damped patches of the surface, and the damping of each.
    pub(crate) fn patches(&self) -> (&[Panel], &[f64]) {
        (&self.panels[self.hull_count..self.emitter_count()], &self.patch_damping)
    }

    /// The panels that send out waves: those of the hull, then those of damped patches.
    pub(crate) fn emitters(&self) -> &[Panel] {
        &self.panels[..self.emitter_count()]
    }

    /// How many panels send out waves.
    pub(crate) fn emitter_count(&self) -> usize {
        self.hull_count + self.patch_damping.len()
    }

    /// Meshes of several bodies as one.
    ///
    /// # Errors
    /// No body; bodies with other mirror planes than the first.
    pub(crate) fn joined<'a>(meshes: impl Iterator<Item = &'a HullMesh>) -> Result<Self, DiffractionError> {
        let (mut panels, mut lids) = (Vec::new(), Vec::new());
        let mut mirrors = MirrorPlanes::default();
        for (index, mesh) in meshes.enumerate() {
            if index > 0 && mesh.mirrors() != mirrors {
                return Err(DiffractionError::OtherMirrors(index + 1));
            }
            mirrors = mesh.mirrors();
            panels.extend_from_slice(mesh.hull());
            lids.extend_from_slice(mesh.lid());
        }
        HullMesh::from_panels(panels, lids, mirrors)
    }

    /// The same hull with its inner waterplane closed by a lid, which takes irregular frequencies away [LEE-NEWMAN-ZHU-1996]: that of every
    /// column; a moonpool stays open, and a hull below the water has none. `None` where the waterline does not close.
    pub fn with_lid(&self) -> Option<Self> {
        let hull: Vec<Panel> = self.hull().to_vec();
        let lid = crate::lid::close_waterplane(&hull, self.mirrors)?;
        HullMesh::from_panels(hull, lid, self.mirrors).ok()
    }

    /// The same hull with its lid, turned about the vertical through its origin (rad) and then moved (m), along mirror planes or where it has none.
    ///
    /// # Errors
    /// Panels that are no longer finite.
    pub fn moved(&self, turn: f64, shift: Vector3<f64>) -> Result<Self, DiffractionError> {
        let axes = Rotation3::from_axis_angle(&Vector3::z_axis(), turn);
        let place = |(i, panel): (usize, &Panel)| {
            Panel::new(panel.corners().map(|corner| axes * corner + shift)).ok_or(DiffractionError::FlatPanel(i + 1))
        };
        let mut hull = self.panels.iter().enumerate().map(place).collect::<Result<Vec<_>, _>>()?;
        let lid = hull.split_off(self.hull_count);
        HullMesh::from_panels(hull, lid, self.mirrors)
    }

    /// The panels of the hull.
    pub fn hull(&self) -> &[Panel] {
        &self.panels[..self.hull_count]
    }

    /// The panels of the lid.
    pub fn lid(&self) -> &[Panel] {
        &self.panels[self.emitter_count()..]
    }

    /// How many panels are of the hull; those of damped patches and of the lid follow.
    pub(crate) fn hull_count(&self) -> usize {
        self.hull_count
    }

    /// Those of the hull, of damped patches and of the lid.
    pub(crate) fn panels(&self) -> &[Panel] {
        &self.panels
    }

    /// The whole hull and the damped patches: their panels and those of the images.
    pub(crate) fn surface(&self) -> Vec<SurfaceElement> {
        let of_image = |image: [f64; 2]| {
            self.emitters().iter().enumerate().map(move |(panel, own)| SurfaceElement {
                panel,
                image,
                centroid: mirrored(&own.centroid, image),
                normal: -mirrored(&own.normal, image),
                area: own.area,
            })
        };
        self.mirrors.images().into_iter().flat_map(of_image).collect()
    }

    /// The largest coordinate of its corners (m).
    pub(crate) fn size(&self) -> f64 {
        self.hull().iter().flat_map(|panel| panel.corners()).map(|corner| corner.amax()).fold(0.0, f64::max)
    }

    /// The distance to another hull (m) where it is less than `room`, both without their mirror images: from corners of each to panels of the other.
    pub fn gap_within(&self, other: &HullMesh, room: f64) -> Option<f64> {
        let least = self.gap_from_corners(other, room).min(other.gap_from_corners(self, room));
        (least < room).then_some(least)
    }

    /// The least distance (m) of corners of its panels from those of another hull, of those that are within `room` of the box around the other.
    fn gap_from_corners(&self, other: &HullMesh, room: f64) -> f64 {
        let corners = || other.hull().iter().flat_map(|panel| panel.corners());
        let none = [f64::INFINITY, f64::NEG_INFINITY];
        let bounds = [0, 1, 2]
            .map(|axis| corners().fold(none, |[low, high], at| [low.min(at[axis] - room), high.max(at[axis] + room)]));
        let is_near =
            |at: &&Vector3<f64>| bounds.iter().zip(at.iter()).all(|([low, high], x)| (*low..=*high).contains(x));
        let near = self.hull().iter().flat_map(|panel| panel.corners()).filter(is_near);
        near.flat_map(|at| other.hull().iter().map(move |panel| panel.distance(at))).fold(f64::INFINITY, f64::min)
    }

    /// Its mirror planes.
    pub fn mirrors(&self) -> MirrorPlanes {
        self.mirrors
    }

    /// The displaced volume (m3) by the x, y and z components of the normals, of the mesh as given: they agree where it is closed but for
    /// the waterplane and lies on both sides of x = 0 and y = 0.
    pub fn volumes(&self) -> [f64; 3] {
        let mut sums = [0.0; 3];
        for panel in self.hull() {
            for (axis, sum) in sums.iter_mut().enumerate() {
                *sum += panel.normal[axis] * panel.centroid[axis] * panel.area;
            }
        }
        sums
    }
}

/// A panel of the hull or of a damped patch, or an image of one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SurfaceElement {
    /// Index of the panel.
    pub panel: usize,
    /// Signs of x and y.
    pub image: [f64; 2],
    /// Centroid (m).
    pub centroid: Vector3<f64>,
    /// Unit normal out of the water.
    pub normal: Vector3<f64>,
    /// Area (m2).
    pub area: f64,
}

fn checked_panel(number: usize, corners: &[Vector3<f64>; 4], mirrors: MirrorPlanes) -> Result<Panel, DiffractionError> {
    if corners.iter().any(|corner| corner.iter().any(|x| !x.is_finite())) {
        return Err(DiffractionError::NotFinite(number));
    }
    let panel = Panel::new(*corners).ok_or(DiffractionError::FlatPanel(number))?;
    let room = LEVEL_SHARE * panel.diagonal;
    let height = corners.iter().fold(f64::NEG_INFINITY, |most: f64, corner| most.max(corner.z));
    if height > room {
        return Err(DiffractionError::AboveWater { panel: number, height });
    }
    let beyond = |mirrored: bool, axis: usize| mirrored && corners.iter().any(|corner| corner[axis] < -room);
    if beyond(mirrors.x, 0) || beyond(mirrors.y, 1) {
        return Err(DiffractionError::BeyondMirror(number));
    }
    Ok(panel)
}
