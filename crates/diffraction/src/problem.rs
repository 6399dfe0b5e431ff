//! Bodies in waves: added mass, damping and wave exciting forces at a frequency.

use crate::curvature::normal_slopes;
use crate::error::DiffractionError;
use crate::gmres::{self, Columns};
use crate::incident_wave::IncidentWave;
use crate::mesh::{HullMesh, MirrorPlanes};
use crate::panel::Panel;
use crate::quality::asymmetry;
use crate::rankine::{LevelImage, RankinePart, mirrored, rankine_parts};
use crate::symmetry::SymmetryClass;
use crate::wave_solution::WaveSolution;
use crate::wave_system::{Accuracy, WaveKernel, WaveSystem, wave_systems};
use nalgebra::{Complex, DMatrix, Matrix3, Vector3};
use std::f64::consts::PI;
use std::ops::Range;
use std::sync::Arc;

type C = Complex<f64>;

/// Rigid motions of a body: surge, sway, heave, roll, pitch, yaw.
pub const MOTIONS: usize = 6;
/// Residual of the equations over their right side: well below what the panels leave.
const TOLERANCE: f64 = 4e-7;

/// Displaced volumes by x, y and z that differ by more than this share, or normals that leave as much of the areas, are those of an open mesh:
/// of flat panels that meet there is no difference.
const OPEN_SHARE: f64 = 0.02;

/// Density, gravity and depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Water {
    /// Depth (m); none is deep water.
    pub depth: Option<f64>,
    /// Density (kg/m3).
    pub density: f64,
    /// Acceleration of gravity (m/s2).
    pub gravity: f64,
}

/// A body: its wetted mesh, and the origin of its motions and moments (m).
#[derive(Clone, Debug)]
pub struct DiffractionBody {
    /// Wetted panels in global axes.
    pub mesh: HullMesh,
    /// Where its motions and moments are taken.
    pub origin: Vector3<f64>,
}

/// A patch of the free surface that takes energy from the waves, as sound as the user's choice of it: it stands for the losses of a gap or a moonpool that potential
/// flow leaves out.
#[derive(Clone, Debug, PartialEq)]
pub struct DampedPatch {
    /// Panels at the mean level (m), outside of the hulls.
    pub quads: Vec<[Vector3<f64>; 4]>,
    /// `epsilon` of the condition `d phi/dz = nu (1 + i epsilon) phi`; 0 is the free surface.
    pub epsilon: f64,
}

/// The origin of a body lies on the mirror planes to this share of the size of the meshes.
const ON_PLANE_SHARE: f64 = 1e-6;

/// Bodies in water with all that does not depend on the frequency.
#[derive(Clone, Debug)]
pub struct DiffractionProblem {
    mesh: Arc<HullMesh>,
    water: Water,
    classes: Vec<SymmetryClass>,
    /// Of each class: the motions (six a body) whose velocities are in it.
    motions: Vec<Vec<usize>>,
    /// Of each class: `n_j` on the panels, n out of the water, panel by panel and then motion by motion.
    velocities: Vec<Vec<f64>>,
    rankine: Vec<RankinePart>,
    /// Of each panel of the hulls: how its normal turns along it (1/m).
    normal_slopes: Vec<Matrix3<f64>>,
    motion_count: usize,
    bodies: Arc<[BodyPart]>,
    /// Largest horizontal distance between points of the hulls and their images (m).
    reach: f64,
    draught: f64,
}

/// A body among those of a problem.
#[derive(Clone, Debug)]
pub(crate) struct BodyPart {
    /// Its panels among those of the hulls.
    pub panels: Range<usize>,
    /// Where its motions and moments are taken (m).
    pub origin: Vector3<f64>,
}

/// Frequencies at which waves are not sent out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrequencyLimit {
    /// Motions so slow that the surface stays flat.
    Zero,
    /// Motions so quick that the pressure at the mean level stays zero.
    Infinite,
}

/// Forces at one frequency, for the time factor `exp(-i omega t)`; six motions a body, about its origin.
#[derive(Clone, Debug)]
pub struct FrequencyForces {
    /// Frequency (rad/s).
    pub frequency: f64,
    /// Added mass (kg, kg m, kg m2): row the force, column the motion. It is symmetric, as is the damping.
    ///
    /// What couples a translation and a rotation is the force by the potential of the rotation in the direction of the translation, both ways, as in Haskind's
    /// relation: in long waves, where bodies move with the water, what one is off the other takes back. Others are the mean of both ways.
    pub added_mass: DMatrix<f64>,
    /// Radiation damping (N s/m, N s, N m s).
    pub damping: DMatrix<f64>,
    /// Of each heading: wave exciting forces (N, N m for an amplitude of 1 m) by Haskind's relation, from the radiation potentials.
    pub excitation: Vec<Vec<C>>,
    /// The same by the pressure of the diffraction problem, which panels at sharp edges leave farther off.
    pub pressure_excitation: Vec<Vec<C>>,
    /// Products with the matrices of the classes until the equations were solved.
    pub iterations: usize,
    /// The largest difference of added mass or damping from its transpose before they were made symmetric, over the largest of the same kind: forces by
    /// translations, moments by rotations and what couples them apart. It measures the mesh.
    pub asymmetry: f64,
}

/// Over the depth: what corners of panels on the bottom may be below it.
const ROUNDING: f64 = 1e-9;

impl FrequencyForces {
    /// The force of the radiated waves in one direction by the motions of all bodies (N, N m for motions in waves of amplitude 1 m).
    pub(crate) fn radiation_force(&self, direction: usize, motions: &[C]) -> C {
        let omega = self.frequency;
        let by_motion = |(motion, other): (usize, &C)| {
            let (added_mass, damping) = (self.added_mass[(direction, motion)], self.damping[(direction, motion)]);
            other * C::new(omega * omega * added_mass, omega * damping)
        };
        motions.iter().enumerate().map(by_motion).sum()
    }
}

impl DiffractionProblem {
    /// Prepares bodies in water.
    ///
    /// # Errors
    /// No body; bodies with other mirror planes than the first, or with origins beside them; density, gravity or depth that is not above zero; a bottom above the keel; a mesh that is
    /// open below the water or inside out; bodies that overlap or touch.
    pub fn new(bodies: &[DiffractionBody], water: Water) -> Result<Self, DiffractionError> {
        DiffractionProblem::with_damped_surface(bodies, water, &[])
    }

    /// Prepares bodies in water whose surface is damped on patches: `d phi/dz = nu (1 + i epsilon) phi` there [CHEN-2004].
    ///
    /// # Errors
    /// As of [`DiffractionProblem::new`]; a damping below zero; a patch that is not at the mean level, is beyond a mirror plane or reaches into a hull.
    pub fn with_damped_surface(
        bodies: &[DiffractionBody],
        water: Water,
        patches: &[DampedPatch],
    ) -> Result<Self, DiffractionError> {
        if !(water.density > 0.0 && water.gravity > 0.0 && (water.density * water.gravity).is_finite()) {
            return Err(DiffractionError::Water);
        }
        let mesh = HullMesh::joined(bodies.iter().map(|body| &body.mesh))?;
        let mirrors = mesh.mirrors();
        let panels = checked_patches(patches, bodies, mirrors)?;
        let mesh = Arc::new(mesh.with_patches(panels));
        for (index, body) in bodies.iter().enumerate() {
            let off = |mirrored: bool, x: f64| mirrored && x.abs() > ON_PLANE_SHARE * mesh.size();
            if off(mirrors.x, body.origin.x) || off(mirrors.y, body.origin.y) {
                return Err(DiffractionError::OriginOffMirror(index + 1));
            }
        }
        let classes = SymmetryClass::all(mirrors);
        let motions: Vec<Vec<usize>> = classes
            .iter()
            .map(|class| (0..MOTIONS * bodies.len()).filter(|m| class.has_mode(m % MOTIONS, mirrors)).collect())
            .collect();
        let velocities: Vec<Vec<f64>> = motions
            .iter()
            .map(|motions| {
                let panels =
                    bodies.iter().enumerate().flat_map(|(b, body)| body.mesh.hull().iter().map(move |p| (b, body, p)));
                let on_hull = panels.flat_map(|(b, body, panel)| {
                    let own = normal_velocities(panel, &body.origin);
                    motions.iter().map(move |m| if m / MOTIONS == b { own[m % MOTIONS] } else { 0.0 })
                });
                let on_lid = std::iter::repeat_n(0.0, (mesh.panels().len() - mesh.hull_count()) * motions.len());
                on_hull.chain(on_lid).collect()
            })
            .collect();
        let corners = || mesh.panels().iter().flat_map(|panel| panel.corners());
        let draught = corners().fold(0.0, |most: f64, corner| most.max(-corner.z));
        if let Some(depth) = water.depth
            && !(depth.is_finite() && depth * (1.0 + ROUNDING) >= draught)
        {
            return Err(DiffractionError::Depth { depth, draught });
        }
        for (index, body) in bodies.iter().enumerate() {
            check_closed(index + 1, &body.mesh, water.depth)?;
        }
        check_apart(bodies)?;
        let extent = |axis: usize, mirrored: bool| {
            let (low, high) = corners().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), corner| {
                (low.min(corner[axis]), high.max(corner[axis]))
            });
            if mirrored { 2.0 * high } else { high - low }
        };
        let reach = extent(0, mirrors.x).hypot(extent(1, mirrors.y));
        let rankine = rankine_parts(&mesh, &classes, &velocities, &LevelImage::of_all_frequencies(water.depth));
        let motion_count = MOTIONS * bodies.len();
        let mut first = 0;
        let bodies: Arc<[BodyPart]> = bodies
            .iter()
            .map(|body| {
                let own = first..first + body.mesh.hull().len();
                first = own.end;
                BodyPart { panels: own, origin: body.origin }
            })
            .collect();
        let ranges: Vec<Range<usize>> = bodies.iter().map(|body| body.panels.clone()).collect();
        let normal_slopes = normal_slopes(&mesh, &ranges);
        Ok(DiffractionProblem {
            mesh,
            water,
            classes,
            motions,
            velocities,
            rankine,
            normal_slopes,
            motion_count,
            bodies,
            reach,
            draught,
        })
    }

    /// Density, gravity and depth.
    pub(crate) fn water(&self) -> Water {
        self.water
    }

    /// x and y of the middle of the hulls, their largest distance from it and their draught (m).
    pub(crate) fn extent(&self) -> ([f64; 2], f64, f64) {
        let images = self.mesh.mirrors().images();
        let corners = || {
            let of_image = |image: &[f64; 2]| {
                let image = *image;
                self.mesh.hull().iter().flat_map(|panel| panel.corners()).map(move |corner| mirrored(corner, image))
            };
            images.iter().flat_map(of_image)
        };
        let middle = [0, 1].map(|axis| {
            let (low, high) = corners()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(at[axis]), high.max(at[axis])));
            0.5 * (low + high)
        });
        let radius = corners().map(|at| (at.x - middle[0]).hypot(at.y - middle[1])).fold(0.0, f64::max);
        (middle, radius, self.draught)
    }

    /// The longest diagonal of the panels of a body (m).
    pub(crate) fn largest_panel(&self, body: usize) -> f64 {
        let panels = self.bodies.get(body).and_then(|body| self.mesh.hull().get(body.panels.clone()));
        panels.into_iter().flatten().map(|panel| panel.diagonal).fold(0.0, f64::max)
    }

    /// Corners of the panels of a body and of their images; none where there is no such body.
    pub(crate) fn body_corners(&self, body: usize) -> Option<Vec<Vector3<f64>>> {
        let panels = self.mesh.hull().get(self.bodies.get(body)?.panels.clone())?;
        let images = self.mesh.mirrors().images();
        let corners = || panels.iter().flat_map(|panel| panel.corners());
        Some(images.iter().flat_map(|image| corners().map(|corner| mirrored(corner, *image))).collect())
    }

    /// The added mass (kg, kg m, kg m2) at the zero or the infinite frequency, where there are no waves and no damping.
    ///
    /// # Errors
    /// The zero frequency in water of finite depth, where that of heave has no limit; equations whose solution is not finite.
    pub fn added_mass_limit(&self, limit: FrequencyLimit) -> Result<DMatrix<f64>, DiffractionError> {
        let levels = match (limit, self.water.depth) {
            (FrequencyLimit::Infinite, depth) => LevelImage::of_infinite_frequency(depth),
            (FrequencyLimit::Zero, None) => LevelImage::of_all_frequencies(None),
            (FrequencyLimit::Zero, Some(depth)) => return Err(DiffractionError::ZeroFrequency(depth)),
        };
        // no waves inside of the hull: no lid
        let mesh = HullMesh::from_panels(self.mesh.hull().to_vec(), Vec::new(), self.mesh.mirrors())?;
        let count = mesh.hull_count();
        let velocities: Vec<Vec<f64>> = self
            .velocities
            .iter()
            .zip(&self.motions)
            .map(|(velocities, motions)| velocities[..count * motions.len()].to_vec())
            .collect();
        let parts = rankine_parts(&mesh, &self.classes, &velocities, &levels);
        let images = mesh.mirrors().images().len() as f64;
        let mut added_mass = DMatrix::zeros(self.motion_count, self.motion_count);
        for ((part, motions), velocities) in parts.iter().zip(&self.motions).zip(&velocities) {
            let system = WaveSystem::from_rankine(part, count);
            let (solved, _) = solve_system(&system, &system.radiation).ok_or(DiffractionError::NoLimit)?;
            for (column, motion) in motions.iter().enumerate() {
                for (row, force) in motions.iter().enumerate() {
                    let own = velocities.iter().skip(row).step_by(motions.len());
                    let integral: f64 = solved
                        .column(column)
                        .iter()
                        .zip(own)
                        .zip(mesh.hull())
                        .map(|((potential, n), panel)| potential.re * n * panel.area)
                        .sum();
                    added_mass[(*force, *motion)] = integral * images * self.water.density;
                }
            }
        }
        Ok(symmetric(&added_mass))
    }

    /// Integrals of an incident wave over the hulls. Its pressure varies along a panel, and so do arm and normal of a moment: the middle alone leaves their product
    /// off by the square of the panel, and the roll of a wide hull in long waves is a small rest of such moments.
    fn incident_parts(
        &self,
        wave: &IncidentWave,
        heading: f64,
        (class, motions): (SymmetryClass, &[usize]),
        images: &[[f64; 2]],
    ) -> IncidentParts {
        let panels = self.mesh.panels();
        let count = images.len() as f64;
        let at = |point: &Vector3<f64>, panel: &Panel| wave.in_class((point, &panel.normal), heading, class, images);
        let middles: Vec<(C, C)> = panels.iter().map(|panel| at(&panel.centroid, panel)).collect();
        let mut forces = vec![C::default(); motions.len()];
        for (index, part) in self.bodies.iter().enumerate() {
            let own = panels.iter().zip(&middles).zip(&self.normal_slopes);
            for ((panel, (potential, _)), slopes) in own.take(part.panels.end).skip(part.panels.start) {
                let arm = panel.centroid - part.origin;
                let middle = normal_velocities(panel, &part.origin).map(|velocity| potential * (velocity * panel.area));
                let mut own = middle;
                for (point, area) in panel.rule() {
                    // the normal out of the water turns along a hull that is not flat, which on a sphere takes back what the arm adds
                    let step = point - panel.centroid;
                    let lever = panel.normal.cross(&step) - arm.cross(&(slopes * step));
                    let more = (at(point, panel).0 - potential) * *area;
                    own.iter_mut().skip(3).zip(lever.iter()).for_each(|(sum, lever)| *sum += more * *lever);
                }
                for (force, motion) in forces.iter_mut().zip(motions) {
                    if motion / MOTIONS == index {
                        *force += own[motion % MOTIONS] * count;
                    }
                }
            }
        }
        let hull = self.mesh.hull_count();
        let fluxes = panels.iter().zip(&middles).take(hull).map(|(panel, (_, by))| by * (panel.area * count)).collect();
        IncidentParts { potentials: middles.into_iter().map(|(potential, _)| potential).collect(), forces, fluxes }
    }

    /// Solves the radiation problems and the diffraction problem of each heading (rad, where the waves go to, 0 along x).
    ///
    /// # Errors
    /// A frequency (rad/s) that is not above zero; equations whose solution is not finite.
    pub fn solve(&self, frequency: f64, headings: &[f64]) -> Result<FrequencyForces, DiffractionError> {
        Ok(self.solve_waves(frequency, headings)?.forces)
    }

    /// As [`DiffractionProblem::solve`], with the potentials on the hulls, which mean drift is made from.
    ///
    /// # Errors
    /// As of [`DiffractionProblem::solve`].
    pub fn solve_waves(&self, frequency: f64, headings: &[f64]) -> Result<WaveSolution, DiffractionError> {
        if !(frequency > 0.0 && frequency.is_finite()) {
            return Err(DiffractionError::Frequency(frequency));
        }
        let nu = frequency * frequency / self.water.gravity;
        let kernel = WaveKernel::new(nu, self.water.depth, self.reach, self.draught);
        let systems = wave_systems(&kernel, &self.mesh, &self.classes, &self.velocities, &self.rankine);
        let wave = IncidentWave {
            frequency,
            wave_number: kernel.wave_number(),
            gravity: self.water.gravity,
            depth: self.water.depth,
        };
        let images = self.mesh.mirrors().images();
        let panels = self.mesh.panels();
        let count = self.motion_count;
        let rho = self.water.density;
        let mut made = FrequencyForces {
            frequency,
            added_mass: DMatrix::zeros(count, count),
            damping: DMatrix::zeros(count, count),
            excitation: vec![vec![C::default(); count]; headings.len()],
            pressure_excitation: vec![vec![C::default(); count]; headings.len()],
            iterations: 0,
            asymmetry: 0.0,
        };
        let surface = self.mesh.surface();
        let (_, patch_damping) = self.mesh.patches();
        let mut radiated = vec![Vec::new(); count];
        let mut normal_motions = vec![Vec::new(); count];
        let mut diffracted = vec![vec![C::default(); surface.len()]; headings.len()];
        for (((class, system), motions), velocities) in
            self.classes.iter().zip(&systems).zip(&self.motions).zip(&self.velocities)
        {
            let mut right = Columns::zeros(panels.len(), motions.len() + headings.len());
            for motion in 0..motions.len() {
                right.column_mut(motion).copy_from_slice(system.radiation.column(motion));
            }
            let incident: Vec<IncidentParts> = headings
                .iter()
                .map(|heading| self.incident_parts(&wave, *heading, (*class, motions), &images))
                .collect();
            for (index, parts) in incident.iter().enumerate() {
                let side = right.column_mut(motions.len() + index);
                for (value, potential) in side.iter_mut().zip(&parts.potentials) {
                    *value = potential * (4.0 * PI);
                }
            }
            let (solved, uses) = solve_system(system, &right).ok_or(DiffractionError::NoSolution(frequency))?;
            made.iterations += uses;
            let on_hull = |i: usize| if i < self.mesh.hull_count() { images.len() as f64 } else { 0.0 };
            let weights: Vec<f64> = panels.iter().enumerate().map(|(i, panel)| panel.area * on_hull(i)).collect();
            for (index, motion) in motions.iter().enumerate() {
                let own = |panel: usize| velocities[panel * motions.len() + index];
                radiated[*motion] =
                    surface.iter().map(|at| solved.column(index)[at.panel] * class.factor(at.image)).collect();
                normal_motions[*motion] = surface.iter().map(|at| own(at.panel) * class.factor(at.image)).collect();
            }
            for (index, total) in diffracted.iter_mut().enumerate() {
                let own = solved.column(motions.len() + index);
                for (value, at) in total.iter_mut().zip(&surface) {
                    *value += own[at.panel] * class.factor(at.image);
                }
            }
            let integrate = |potential: &[C], motion: usize| -> C {
                let own = velocities.iter().skip(motion).step_by(motions.len().max(1));
                potential.iter().zip(own).zip(&weights).map(|((p, n), area)| p * (n * area)).sum()
            };
            let scattered: Vec<Vec<C>> = incident
                .iter()
                .enumerate()
                .map(|(index, parts)| {
                    let total = solved.column(motions.len() + index);
                    total.iter().zip(&parts.potentials).map(|(total, own)| total - own).collect()
                })
                .collect();
            for (column, motion) in motions.iter().enumerate() {
                for (row, force) in motions.iter().enumerate() {
                    let integral = integrate(solved.column(column), row) * rho;
                    made.added_mass[(*force, *motion)] = integral.re;
                    made.damping[(*force, *motion)] = integral.im * frequency;
                }
                let radiated = solved.column(column);
                for (index, parts) in incident.iter().enumerate() {
                    let pressure = parts.forces[column] + integrate(&scattered[index], column);
                    let flux: C = radiated.iter().zip(&parts.fluxes).map(|(radiated, flux)| radiated * flux).sum();
                    let haskind = parts.forces[column] - flux;
                    // both waves meet the damped condition, the incident one alone does not
                    let at_patches = |i: usize, epsilon: &f64| -> C {
                        let at = self.mesh.hull_count() + i;
                        let area = panels[at].area * images.len() as f64;
                        parts.potentials[at] * radiated[at] * C::new(0.0, epsilon * nu * area)
                    };
                    let damped: C = patch_damping.iter().enumerate().map(|(i, epsilon)| at_patches(i, epsilon)).sum();
                    let haskind = haskind + damped;
                    let factor = C::new(0.0, frequency * rho);
                    made.excitation[index][*motion] = factor * haskind;
                    made.pressure_excitation[index][*motion] = factor * pressure;
                }
            }
        }
        made.asymmetry = asymmetry(&made.added_mass).max(asymmetry(&made.damping));
        made.added_mass = symmetric(&made.added_mass);
        made.damping = symmetric(&made.damping);
        let amplitude = kernel.amplitude();
        Ok(WaveSolution {
            forces: made,
            wave,
            amplitude,
            mesh: Arc::clone(&self.mesh),
            bodies: Arc::clone(&self.bodies),
            surface,
            headings: headings.to_vec(),
            water: self.water,
            velocities: normal_motions,
            radiated,
            diffracted,
        })
    }
}

/// Integrals of an incident wave over the hulls in a symmetry class.
struct IncidentParts {
    /// Its potential in the middle of each panel, lids included.
    potentials: Vec<C>,
    /// Of its potential times the normal velocity of each motion.
    forces: Vec<C>,
    /// Of each panel of the hulls: of its derivative along the normal out of the water, images included.
    fluxes: Vec<C>,
}

/// A matrix of motions as it is by one potential for both of a pair; see [`FrequencyForces::added_mass`].
fn symmetric(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let turns = |motion: usize| motion % MOTIONS >= MOTIONS / 2;
    DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |force, motion| match (turns(force), turns(motion)) {
        (true, false) => matrix[(motion, force)],
        (false, true) => matrix[(force, motion)],
        _ => 0.5 * (matrix[(force, motion)] + matrix[(motion, force)]),
    })
}

/// The panels of patches that damp, with their damping, looking up.
fn checked_patches(
    patches: &[DampedPatch],
    bodies: &[DiffractionBody],
    mirrors: MirrorPlanes,
) -> Result<Vec<(Panel, f64)>, DiffractionError> {
    let images = mirrors.images();
    let mut made = Vec::new();
    for (number, patch) in (1..).zip(patches) {
        if !(patch.epsilon >= 0.0 && patch.epsilon.is_finite()) {
            return Err(DiffractionError::PatchDamping { patch: number, epsilon: patch.epsilon });
        }
        for quad in &patch.quads {
            let panel = Panel::new(*quad).ok_or(DiffractionError::FlatPatch(number))?;
            let panel = if panel.normal.z < 0.0 {
                let mut turned = *quad;
                turned.reverse();
                Panel::new(turned).ok_or(DiffractionError::FlatPatch(number))?
            } else {
                panel
            };
            let room = ON_PLANE_SHARE * panel.diagonal;
            let beyond = |at: &Vector3<f64>| mirrors.x && at.x < -room || mirrors.y && at.y < -room;
            if let Some(at) = panel.corners().iter().find(|at| at.z.abs() > room || beyond(at)) {
                return Err(DiffractionError::PatchPlace { patch: number, at: [at.x, at.y, at.z] });
            }
            // as in [`check_apart`], seen from the mean level, where a hull and its image above are one
            let points = std::iter::once((&panel.centroid, PI)).chain(panel.corners().iter().map(|at| (at, 3.2 * PI)));
            for (at, most) in points {
                let reaches = |body: &&DiffractionBody| {
                    let angle: f64 = images
                        .iter()
                        .map(|image| {
                            let from = mirrored(at, *image);
                            2.0 * body.mesh.hull().iter().map(|panel| panel.rankine(&from)[1]).sum::<f64>()
                        })
                        .sum();
                    angle < -most
                };
                if let Some(body) = bodies.iter().position(|body| reaches(&body)) {
                    return Err(DiffractionError::PatchInHull { patch: number, body: body + 1, at: [at.x, at.y] });
                }
            }
            // without damping it is the free surface
            if patch.epsilon > 0.0 {
                made.push((panel, patch.epsilon));
            }
        }
    }
    Ok(made)
}

fn solve_system(system: &WaveSystem, right: &Columns) -> Option<(Columns, usize)> {
    gmres::solve(
        right,
        TOLERANCE,
        |vectors| system.multiply(vectors, Accuracy::Rough),
        |vectors| system.multiply(vectors, Accuracy::Full),
    )
}

/// Sees that the panels of a body close it below the water, but for a bottom that it stands on, and face the water.
fn check_closed(number: usize, mesh: &HullMesh, depth: Option<f64>) -> Result<(), DiffractionError> {
    let volumes = mesh.volumes();
    let lowest =
        mesh.hull().iter().flat_map(|panel| panel.corners()).fold(0.0, |most: f64, corner| most.max(-corner.z));
    let stands = depth.is_some_and(|depth| lowest >= depth * (1.0 - 1e-6));
    let seen = if stands { &volumes[..2] } else { &volumes[..] };
    let (low, high) =
        seen.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(*v), high.max(*v)));
    // the horizontal components of the normals cancel; those of a part cancel with its images
    let mirrored = [mesh.mirrors().x, mesh.mirrors().y];
    let is_unbalanced = [0, 1].iter().any(|axis| {
        let (sum, all) = mesh.hull().iter().fold((0.0, 0.0), |(sum, all), panel| {
            let along = panel.normal[*axis] * panel.area;
            (sum + along, all + along.abs())
        });
        !mirrored[*axis] && sum.abs() > OPEN_SHARE * all
    });
    if high <= 0.0 && low < 0.0 && !is_unbalanced {
        Err(DiffractionError::InsideOut(number))
    } else if is_unbalanced || high - low > OPEN_SHARE * high.abs().max(low.abs()) || low <= 0.0 {
        Err(DiffractionError::OpenMesh { body: number, volumes })
    } else {
        Ok(())
    }
}

/// Sees that no body reaches into another: seen from within a hull and its image above the water, their panels fill the sphere.
fn check_apart(bodies: &[DiffractionBody]) -> Result<(), DiffractionError> {
    let limits = |mesh: &HullMesh| {
        let corners = || mesh.hull().iter().flat_map(|panel| panel.corners());
        [0, 1, 2].map(|axis| {
            corners()
                .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| [low.min(at[axis]), high.max(at[axis])])
        })
    };
    let all: Vec<_> = bodies.iter().map(|body| limits(&body.mesh)).collect();
    for (first, body) in bodies.iter().enumerate() {
        for (second, other) in bodies.iter().enumerate().filter(|(second, _)| *second != first) {
            let images = other.mesh.mirrors().images();
            let is_near = |at: &Vector3<f64>| {
                all[second].iter().zip(at.iter()).all(|([low, high], x)| {
                    let room = 1e-9 * (high - low);
                    (low - room..=high + room).contains(x)
                })
            };
            let angle = |at: &Vector3<f64>| -> f64 {
                let seen = images.iter().flat_map(|image| {
                    let from = mirrored(at, *image);
                    [from, Vector3::new(from.x, from.y, -from.z)]
                });
                seen.map(|from| other.mesh.hull().iter().map(|panel| panel.rankine(&from)[1]).sum::<f64>()).sum()
            };
            for panel in body.mesh.hull() {
                // a centroid on a face of the other sees half a sphere; a corner on its edges may see three quarters
                let points =
                    std::iter::once((&panel.centroid, PI)).chain(panel.corners().iter().map(|at| (at, 3.2 * PI)));
                for (at, most) in points {
                    if is_near(at) && angle(at) < -most {
                        let at = [at.x, at.y, at.z];
                        return Err(DiffractionError::Overlap { first: first + 1, second: second + 1, at });
                    }
                }
            }
        }
    }
    Ok(())
}

/// Velocities of the surface along the normal out of the water, for unit velocity of each motion about an origin.
fn normal_velocities(panel: &Panel, origin: &Vector3<f64>) -> [f64; MOTIONS] {
    let normal = -panel.normal;
    let moment = (panel.centroid - origin).cross(&normal);
    [normal.x, normal.y, normal.z, moment.x, moment.y, moment.z]
}
