//! What the panels of a mesh and a solution on them are worth.

use crate::mesh::HullMesh;
use crate::rankine::mirrored;
use crate::wave_solution::WaveSolution;
use nalgebra::{Complex, DMatrix, Vector3};
use rayon::prelude::*;
use std::f64::consts::PI;

type C = Complex<f64>;

/// How far from its panel a point is seen from, over the panel's diagonal.
const ASIDE_SHARE: f64 = 0.02;
/// Images below the bottom, and as many above the water, of a body that stands on it.
const BOTTOM_IMAGES: i32 = 8;
/// What is added to a normal for rays that meet no edges of regular meshes.
const RAYS: [[f64; 3]; 3] = [[0.1237, 0.2711, 0.0713], [-0.2193, 0.1571, 0.1879], [0.0547, -0.1933, -0.2377]];
/// Headings over which the waves of a motion are summed, beyond two for each wave length of the hull's circumference.
const SPARE_HEADINGS: usize = 24;

/// The panels of a body, at their worst.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshQuality {
    /// Least and largest of the longest sides or diagonals over the root of two (m): of a square its side.
    pub sizes: [f64; 2],
    /// Farthest that a corner is out of the plane of its panel, over the panel's diagonal.
    pub crookedness: f64,
    /// The largest diagonal over the root of twice the area: 1 for a square.
    pub slenderness: f64,
    /// Panels whose normal points into the hull, by their numbers from 1.
    pub turned: Vec<usize>,
    /// Largest solid angle by which the panels, with their images above the water and below a bottom that they stand on, do not close around a point beside one of them, over that of a
    /// sphere: openings, and panels that overlap.
    pub opening: f64,
    /// Displaced volume by x, y and z (m3), as of [`HullMesh::volumes`]; of a body that stands on the bottom that by z is none.
    pub volumes: [f64; 3],
}

impl MeshQuality {
    /// That of a mesh, which stands on a bottom where its depth (m) is given: it is open there.
    pub fn new(mesh: &HullMesh, bottom: Option<f64>) -> Self {
        let images = mesh.mirrors().images();
        // heights of a point in the mirrors of the water level and of the bottom: of that so many that little is seen of the ends
        let shifts: Vec<f64> = bottom.map_or_else(
            || vec![0.0],
            |depth| (-BOTTOM_IMAGES..=BOTTOM_IMAGES).map(|n| 2.0 * f64::from(n) * depth).collect(),
        );
        // how often the panels go round a point
        let turns = |at: &Vector3<f64>| -> f64 {
            let seen = images.iter().flat_map(|image| {
                let from = mirrored(at, *image);
                let at_height = move |z: f64| Vector3::new(from.x, from.y, z);
                shifts.iter().flat_map(move |shift| [at_height(from.z + shift), at_height(shift - from.z)])
            });
            let angle: f64 =
                seen.map(|from| mesh.hull().iter().map(|panel| panel.rankine(&from)[1]).sum::<f64>()).sum();
            // the angle is positive on the side of the water
            -angle / (4.0 * PI)
        };
        // the panels, their mirror images, and those of both above the water
        let doubled: Vec<[Vector3<f64>; 4]> = images
            .iter()
            .flat_map(|image| mesh.hull().iter().map(|panel| panel.corners().map(|corner| mirrored(&corner, *image))))
            .flat_map(|corners| {
                let of_sign =
                    move |sign: f64, shift: f64| corners.map(|at| Vector3::new(at.x, at.y, sign * at.z + shift));
                shifts.iter().flat_map(move |shift| [of_sign(1.0, *shift), of_sign(-1.0, *shift)])
            })
            .collect();
        let sides: Vec<(f64, bool)> = mesh
            .hull()
            .par_iter()
            .map(|panel| {
                let aside = panel.normal * (ASIDE_SHARE * panel.diagonal);
                let opening = [panel.centroid + aside, panel.centroid - aside]
                    .map(|at| turns(&at))
                    .map(|turns| (turns - turns.round()).abs())
                    .into_iter()
                    .fold(0.0, f64::max);
                // most of three rays from its side of the water leave the hull, or enter it and leave it
                let from = panel.centroid + aside;
                let is_inside = |tilt: &Vector3<f64>| {
                    let ray = panel.normal + tilt;
                    doubled.iter().filter(|corners| crosses(&from, &ray, corners)).count() % 2 == 1
                };
                (opening, RAYS.iter().filter(|[x, y, z]| is_inside(&Vector3::new(*x, *y, *z))).count() > 1)
            })
            .collect();
        let turned = sides.iter().enumerate().filter(|(_, side)| side.1).map(|(i, _)| i + 1).collect();
        let opening = sides.iter().map(|side| side.0).fold(0.0, f64::max);
        let mut made = MeshQuality {
            sizes: [f64::INFINITY, 0.0],
            crookedness: 0.0,
            slenderness: 0.0,
            turned,
            opening,
            volumes: mesh.volumes(),
        };
        for panel in mesh.hull() {
            let size = panel.diagonal * std::f64::consts::FRAC_1_SQRT_2;
            made.sizes = [made.sizes[0].min(size), made.sizes[1].max(size)];
            let off = panel.corners().iter().map(|corner| (corner - panel.centroid).dot(&panel.normal).abs());
            made.crookedness = made.crookedness.max(off.fold(0.0, f64::max) / panel.diagonal);
            made.slenderness = made.slenderness.max(panel.diagonal / (2.0 * panel.area).sqrt());
        }
        made
    }
}

/// Whether a ray from a point meets a panel: one of its two triangles [MOELLER-TRUMBORE-1997].
fn crosses(from: &Vector3<f64>, ray: &Vector3<f64>, [a, b, c, d]: &[Vector3<f64>; 4]) -> bool {
    let meets = |a: &Vector3<f64>, b: &Vector3<f64>, c: &Vector3<f64>| {
        let (one, other) = (b - a, c - a);
        let across = ray.cross(&other);
        let volume = one.dot(&across);
        if volume == 0.0 {
            return false;
        }
        let arm = from - a;
        let u = arm.dot(&across) / volume;
        let turned = arm.cross(&one);
        let v = ray.dot(&turned) / volume;
        u >= 0.0 && v >= 0.0 && u + v <= 1.0 && other.dot(&turned) / volume > 0.0
    };
    meets(a, b, c) || meets(a, c, d)
}

/// The largest difference of a matrix of motions from its transpose, over the largest of the same kind.
pub(crate) fn asymmetry(matrix: &DMatrix<f64>) -> f64 {
    difference(matrix, &matrix.transpose())
}

/// The largest difference of two matrices of motions over the largest entry of the first, kind by kind.
fn difference(one: &DMatrix<f64>, other: &DMatrix<f64>) -> f64 {
    let mut kinds = [[0.0_f64; 2]; 3];
    for row in 0..one.nrows() {
        for column in 0..one.ncols() {
            let kind = usize::from(row % 6 > 2) + usize::from(column % 6 > 2);
            let [off, largest] = &mut kinds[kind];
            *off = off.max((one[(row, column)] - other[(row, column)]).abs());
            *largest = largest.max(one[(row, column)].abs());
        }
    }
    // what couples forces and moments is measured by both where it is little
    kinds[1][1] = kinds[1][1].max((kinds[0][1] * kinds[2][1]).sqrt());
    kinds.iter().filter(|kind| kind[1] > 0.0).map(|[off, largest]| off / largest).fold(0.0, f64::max)
}

impl WaveSolution {
    /// The radiation damping by the energy of the waves far away (N s/m, N s, N m s): `B_ij = k/(8 pi rho g v_g) int X_i X_j* dbeta`, with the
    /// exciting forces by Haskind's relation of waves from all sides [NEWMAN-1977 6.17].
    pub fn damping_by_energy(&self) -> DMatrix<f64> {
        let (k, omega) = (self.wave.wave_number, self.wave.frequency);
        let radius = self.surface.iter().map(|at| at.centroid.x.hypot(at.centroid.y)).fold(0.0, f64::max);
        let count = SPARE_HEADINGS + 2 * (2.0 * k * radius).ceil() as usize;
        let step = 2.0 * PI / count as f64;
        let factor = C::new(0.0, omega * self.water.density);
        let patches: Vec<(usize, f64)> = self.patch_elements().collect();
        let nu = omega * omega / self.wave.gravity;
        let forces: Vec<Vec<C>> = (0..count)
            .into_par_iter()
            .map(|i| {
                let heading = step * i as f64;
                let waves: Vec<(C, C)> = self
                    .surface
                    .iter()
                    .map(|at| {
                        let (potential, gradient) = self.wave.at(&at.centroid, heading);
                        let by_normal: C = gradient.iter().zip(at.normal.iter()).map(|(g, n)| g * *n).sum();
                        (potential * at.area, by_normal * at.area)
                    })
                    .collect();
                let of_motion = |(radiated, velocities): (&Vec<C>, &Vec<f64>)| -> C {
                    let all = waves.iter().zip(radiated).zip(velocities);
                    let sum: C = all.map(|(((potential, by_normal), own), n)| potential * *n - own * by_normal).sum();
                    // on damped patches as in the exciting forces
                    let damped: C = patches
                        .iter()
                        .map(|(at, epsilon)| {
                            let (potential, by_normal) = waves[*at];
                            radiated[*at] * (potential * C::new(0.0, epsilon * nu) + by_normal)
                        })
                        .sum();
                    (sum + damped) * factor
                };
                self.radiated.iter().zip(&self.velocities).map(of_motion).collect()
            })
            .collect();
        let group_velocity = self.wave.group_share() * omega / k;
        let unit = k * step / (8.0 * PI * self.water.density * self.water.gravity * group_velocity);
        let motions = self.radiated.len();
        DMatrix::from_fn(motions, motions, |i, j| {
            unit * forces.iter().map(|forces| (forces[i] * forces[j].conj()).re).sum::<f64>()
        })
    }

    /// The part of the damping that damped patches of the surface take: `rho omega nu int epsilon Re(phi_i phi_j*) dS`.
    pub fn damping_by_patches(&self) -> DMatrix<f64> {
        let omega = self.wave.frequency;
        let unit = self.water.density * omega * omega * omega / self.wave.gravity;
        let patches: Vec<(usize, f64)> =
            self.patch_elements().map(|(at, epsilon)| (at, epsilon * unit * self.surface[at].area)).collect();
        let motions = self.radiated.len();
        DMatrix::from_fn(motions, motions, |i, j| {
            patches.iter().map(|(at, share)| share * (self.radiated[i][*at] * self.radiated[j][*at].conj()).re).sum()
        })
    }

    /// The largest difference of the damping from that by energy, over the largest of the same kind.
    pub fn energy_difference(&self) -> f64 {
        difference(&self.forces.damping, &(self.damping_by_energy() + self.damping_by_patches()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::MirrorPlanes;

    /// A cube of 1 m whose upper side is the water level, without some of its faces.
    fn cube(faces: &[usize]) -> HullMesh {
        let at = Vector3::new;
        let all = [
            [at(0.0, 0.0, -1.0), at(0.0, 1.0, -1.0), at(1.0, 1.0, -1.0), at(1.0, 0.0, -1.0)],
            [at(0.0, 0.0, -1.0), at(1.0, 0.0, -1.0), at(1.0, 0.0, 0.0), at(0.0, 0.0, 0.0)],
            [at(1.0, 0.0, -1.0), at(1.0, 1.0, -1.0), at(1.0, 1.0, 0.0), at(1.0, 0.0, 0.0)],
            [at(1.0, 1.0, -1.0), at(0.0, 1.0, -1.0), at(0.0, 1.0, 0.0), at(1.0, 1.0, 0.0)],
            [at(0.0, 1.0, -1.0), at(0.0, 0.0, -1.0), at(0.0, 0.0, 0.0), at(0.0, 1.0, 0.0)],
        ];
        let quads: Vec<_> = faces.iter().map(|face| all[*face]).collect();
        HullMesh::new(&quads, MirrorPlanes::default()).unwrap()
    }

    #[test]
    fn closed_cube_is_faultless_and_open_one_shows_solid_angle_of_its_opening() {
        let whole = MeshQuality::new(&cube(&[0, 1, 2, 3, 4]), None);
        assert!(whole.turned.is_empty() && whole.opening < 1e-12 && whole.crookedness == 0.0, "{whole:?}");
        assert!((whole.slenderness - 1.0).abs() < 1e-12 && (whole.sizes[1] - 1.0).abs() < 1e-12, "{whole:?}");
        // of a box of 1 x 1 x 2 m without an end of both halves; from beside the middle of that end's opposite nothing near is missing
        let open = MeshQuality::new(&cube(&[0, 1, 2, 3]), None);
        assert!(open.opening > 0.05, "{open:?}");
    }

    #[test]
    fn sides_that_stand_on_the_bottom_are_open_by_what_is_seen_of_the_ends_of_their_images() {
        // squares of 1 m2 from 16 to 17 m away on both sides: 1/(4 pi 16^2) of a sphere each at most
        let sides = MeshQuality::new(&cube(&[1, 2, 3, 4]), Some(1.0));
        let seen = 2.0 / (4.0 * PI * 16.5_f64.powi(2));
        assert!(sides.turned.is_empty() && (sides.opening / seen - 1.0).abs() < 0.1, "{sides:?} {seen}");
    }

    #[test]
    fn panel_that_faces_inward_is_named() {
        let mut quads: Vec<_> = cube(&[0, 1, 2, 3, 4]).hull().iter().map(|panel| *panel.corners()).collect();
        quads[2].reverse();
        let mesh = HullMesh::new(&quads, MirrorPlanes::default()).unwrap();
        assert_eq!(MeshQuality::new(&mesh, None).turned, [3]);
    }

    #[test]
    fn raised_corner_is_crooked_by_its_share() {
        let at = Vector3::new;
        // the corners of a square alternately 0.1 up and down: 0.1 from the plane between them, of a diagonal of sqrt(2)
        let quad = [at(0.0, 0.0, -1.9), at(0.0, 1.0, -2.1), at(1.0, 1.0, -1.9), at(1.0, 0.0, -2.1)];
        let made = MeshQuality::new(&HullMesh::new(&[quad], MirrorPlanes::default()).unwrap(), None);
        assert!((made.crookedness - 0.1 / 2.04_f64.sqrt()).abs() < 0.03, "{made:?}");
    }
}
