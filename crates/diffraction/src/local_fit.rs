//! The potential along a hull from those of its panels: on each panel a sum of functions fitted to the panels around.
//!
//! Polynomials of second degree carry a smooth hull. At an upright waterline the potential has a part with a logarithm where the motion of the hull does not fit
//! the condition of the free surface, which the fit keeps there. Beside sharp edges the slope of the potential has no bound: the panels have to be small there.

use crate::curvature::{SAME_CORNER_SHARE, SMOOTH_COSINE};
use crate::mesh::SurfaceElement;
use crate::near_field::RigidMotion;
use crate::rankine::mirrored;
use crate::wave_solution::WaveSolution;
use nalgebra::{Complex, Matrix5, Vector3, Vector5};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;
use windlass_base::dense::{Cholesky, never};

type C = Complex<f64>;

/// Two linear functions and three of second degree.
type Terms = Vector5<f64>;

/// A side is on the waterline where its ends are below it by less than this share of the diagonal of its panel.
const LEVEL_SHARE: f64 = 1e-5;
/// What of the diagonal keeps equations soluble where there are fewer panels around than functions.
const RIDGE: f64 = 1e-9;
/// A vector is none below this share of what it is a part of.
const FLAT_SHARE: f64 = 1e-6;
/// The normal of an upright hull has a vertical part below this.
const UPRIGHT_SHARE: f64 = 0.2;
/// Weight of the condition of the free surface over that of a neighbour.
const SURFACE_WEIGHT: f64 = 4.0;

/// Functions of a point on the plane of a panel: distances along two axes in units of a length each, and their products.
struct Basis {
    centroid: Vector3<f64>,
    axes: [Vector3<f64>; 2],
    lengths: [f64; 2],
}

impl Basis {
    fn place(&self, at: &Vector3<f64>) -> [f64; 2] {
        let arm = at - self.centroid;
        [0, 1].map(|i| arm.dot(&self.axes[i]) / self.lengths[i])
    }

    fn length(&self) -> f64 {
        self.lengths[0].min(self.lengths[1])
    }

    /// The functions at a point, which are zero at the centroid.
    fn values(&self, at: &Vector3<f64>) -> Terms {
        let [u, v] = self.place(at);
        Terms::new(u, v, 0.5 * u * u, u * v, 0.5 * v * v)
    }

    /// Their slopes along both axes (1/m).
    fn slopes(&self, at: &Vector3<f64>) -> [Terms; 2] {
        let [u, v] = self.place(at);
        let [first, second] = self.lengths;
        [Terms::new(1.0, 0.0, u, v, 0.0) / first, Terms::new(0.0, 1.0, 0.0, u, v) / second]
    }
}

/// The potential on a panel as a sum of functions.
pub(crate) struct LocalFit {
    basis: Basis,
    normal: Vector3<f64>,
    /// The same of the distance of the hull from the plane of the panel (m).
    bend: Terms,
    /// Of each panel around: its element, and what it adds to the coefficients.
    pub(crate) around: Vec<(usize, Terms)>,
    /// Sides on the waterline.
    pub(crate) sides: Vec<WaterlineSide>,
    /// The corner of hull and surface, near an upright waterline.
    pub(crate) corner: Option<Corner>,
}

pub(crate) struct WaterlineSide {
    /// Its ends (m).
    pub(crate) ends: [Vector3<f64>; 2],
    /// Of the damped patch beside it; 0 on the free surface.
    pub(crate) damping: f64,
    /// What its condition adds to the coefficients; none beside a damped patch.
    pub(crate) condition: Option<Terms>,
}

/// Where an upright hull meets the free surface. The velocity along the normal of the hull is that of the surface there, but its slopes down do not fit: the
/// difference makes a part `-c s2 ln s` of the potential at the depth s, whose second derivative has no bound.
pub(crate) struct Corner {
    /// A point of the waterline (m).
    at: Vector3<f64>,
    /// Down along the hull.
    down: Vector3<f64>,
    /// The normal of the hull, and how it turns by the depth (1/m).
    normal: Vector3<f64>,
    turn: Vector3<f64>,
    /// Of the logarithm (m).
    length: f64,
}

impl Corner {
    /// `c` of the motion of a body: of `(dv/ds + nu v)/pi` with the velocity v along the normal.
    pub(crate) fn strength(&self, moving: &RigidMotion, frequency: f64, nu: f64) -> C {
        let along =
            |vector: &[C; 3], axis: &Vector3<f64>| vector.iter().zip(axis.iter()).map(|(x, n)| x * *n).sum::<C>();
        let here = moving.at(&self.at);
        let below = moving.at(&(self.at + self.down));
        let deeper = [0, 1, 2].map(|i| below[i] - here[i]);
        let slope = along(&deeper, &self.normal) + along(&here, &self.turn);
        C::new(0.0, -frequency / PI) * (slope + along(&here, &self.normal) * nu)
    }

    /// The part of the potential over `c`, and its slope down.
    pub(crate) fn part(&self, at: &Vector3<f64>) -> (f64, f64) {
        let depth = (-at.z).max(0.0);
        let log = if depth > 0.0 { (depth / self.length).ln() } else { 0.0 };
        (-depth * depth * log, -depth * (2.0 * log + 1.0))
    }
}

/// A fitted potential.
pub(crate) struct LocalPotential<'a> {
    pub(crate) fit: &'a LocalFit,
    pub(crate) value: C,
    pub(crate) coefficients: Vector5<C>,
    /// Strength of the part of the corner.
    pub(crate) corner: C,
}

impl LocalPotential<'_> {
    fn sum(&self, terms: &Terms) -> C {
        self.coefficients.iter().zip(terms.iter()).map(|(c, term)| c * *term).sum()
    }

    pub(crate) fn value(&self, at: &Vector3<f64>) -> C {
        let part = self.fit.corner.as_ref().map_or(0.0, |corner| corner.part(at).0);
        self.sum(&self.fit.basis.values(at)) + self.value + self.corner * part
    }

    /// The velocity on the curved hull above a point of the panel, by that along its normal.
    pub(crate) fn velocity(&self, at: &Vector3<f64>, by_normal: C) -> Vector3<C> {
        let along = self.fit.basis.slopes(at).map(|terms| self.sum(&terms));
        let [one, other] = self.fit.duals(at);
        let corner = self.fit.corner.as_ref().map_or_else(Vector3::zeros, |corner| corner.down * corner.part(at).1);
        one.map(C::from) * along[0]
            + other.map(C::from) * along[1]
            + self.fit.normal_at(at).map(C::from) * by_normal
            + corner.map(C::from) * self.corner
    }
}

impl LocalFit {
    /// Tangents of the hull above a point of the panel.
    fn tangents(&self, at: &Vector3<f64>) -> [Vector3<f64>; 2] {
        let rise = self.basis.slopes(at).map(|terms| terms.dot(&self.bend));
        [0, 1].map(|i| self.basis.axes[i] + self.normal * rise[i])
    }

    /// Vectors along the hull by which slopes along its tangents make the slope along it.
    fn duals(&self, at: &Vector3<f64>) -> [Vector3<f64>; 2] {
        let [one, other] = self.tangents(at);
        let (a, b, c) = (one.norm_squared(), one.dot(&other), other.norm_squared());
        let area = (a * c - b * b).max(f64::MIN_POSITIVE);
        [(one * c - other * b) / area, (other * a - one * b) / area]
    }

    /// What of the coefficients is the slope along the hull and the vertical.
    fn up(&self, at: &Vector3<f64>) -> Terms {
        let ([one, other], [along, across]) = (self.duals(at), self.basis.slopes(at));
        along * one.z + across * other.z
    }

    /// The unit normal of the hull above a point of the panel.
    pub(crate) fn normal_at(&self, at: &Vector3<f64>) -> Vector3<f64> {
        let [one, other] = self.tangents(at);
        one.cross(&other).try_normalize(0.0).unwrap_or(self.normal)
    }

    /// The corner of hull and surface above the panel; none where the hull is not upright there.
    fn corner_above(&self) -> Option<Corner> {
        let centroid = &self.basis.centroid;
        let up = (Vector3::z() - self.normal * self.normal.z).try_normalize(FLAT_SHARE)?;
        let at = centroid - up * (centroid.z / up.z);
        let normal = self.normal_at(&at);
        let down = (normal * normal.z - Vector3::z()).try_normalize(FLAT_SHARE)?;
        let length = self.basis.length();
        let turn = (self.normal_at(&(at + down * length)) - normal) / length;
        (normal.z.abs() < UPRIGHT_SHARE).then_some(Corner { at, down, normal, turn, length })
    }
}

/// A panel or an image of one as the fits see it.
struct Facet {
    body: usize,
    corners: [Vector3<f64>; 4],
    diagonal: f64,
    /// Whether it reaches the free surface.
    is_at_surface: bool,
}

impl Facet {
    /// Its sides on the waterline.
    fn level_sides(&self) -> impl Iterator<Item = [Vector3<f64>; 2]> + '_ {
        let is_level = |point: &Vector3<f64>| point.z.abs() <= LEVEL_SHARE * self.diagonal;
        let is_long = |[a, b]: &[Vector3<f64>; 2]| (b - a).norm() > LEVEL_SHARE * self.diagonal;
        (0..4)
            .map(|i| [self.corners[i], self.corners[(i + 1) % 4]])
            .filter(move |side| side.iter().all(is_level) && is_long(side))
    }
}

impl WaveSolution {
    /// What fits the potential on each element of the surface of the hulls; none of damped patches.
    pub(crate) fn local_fits(&self) -> Vec<Option<LocalFit>> {
        let room = SAME_CORNER_SHARE * self.mesh.size().max(f64::MIN_POSITIVE);
        let key = |at: &Vector3<f64>| [0, 1, 2].map(|axis| (at[axis] / room).round() as i64);
        let facets: Vec<Option<Facet>> = self.surface.iter().map(|at| self.facet(at)).collect();
        let mut at_corner: BTreeMap<[i64; 3], Vec<usize>> = BTreeMap::new();
        for (at, facet) in facets.iter().enumerate() {
            for corner in facet.iter().flat_map(|facet| &facet.corners) {
                let list = at_corner.entry(key(corner)).or_default();
                if list.last() != Some(&at) {
                    list.push(at);
                }
            }
        }
        let at_point = |at: &Vector3<f64>| at_corner.get(&key(at)).map_or(&[][..], Vec::as_slice);
        let beside = |at: usize, from: usize| -> BTreeSet<usize> {
            let corners = facets[at].iter().flat_map(|facet| &facet.corners);
            corners
                .flat_map(|corner| at_point(corner).iter().copied())
                .filter(|other| self.is_smooth(&facets, [from, *other]))
                .collect()
        };
        (0..self.surface.len())
            .into_par_iter()
            .map(|at| {
                let facet = facets[at].as_ref()?;
                let first = beside(at, at);
                let around: BTreeSet<usize> =
                    first.iter().flat_map(|other| beside(*other, at)).chain(first.iter().copied()).collect();
                Some(self.local_fit(at, facet, (&facets, &around)))
            })
            .collect()
    }

    fn facet(&self, element: &SurfaceElement) -> Option<Facet> {
        let body = self.bodies.iter().position(|part| part.panels.contains(&element.panel))?;
        let panel = self.mesh.panels().get(element.panel)?;
        let corners = panel.corners().map(|corner| mirrored(&corner, element.image));
        let mut made = Facet { body, corners, diagonal: panel.diagonal, is_at_surface: false };
        let is_free = |[a, b]: [Vector3<f64>; 2]| self.damping_at([0.5 * (a.x + b.x), 0.5 * (a.y + b.y)]) == 0.0;
        let is_at_surface = made.level_sides().any(is_free);
        made.is_at_surface = is_at_surface;
        Some(made)
    }

    /// Whether two elements are of one body and meet without an edge.
    fn is_smooth(&self, facets: &[Option<Facet>], [one, other]: [usize; 2]) -> bool {
        let body = |at: usize| facets[at].as_ref().map(|facet| facet.body);
        body(one) == body(other) && self.surface[one].normal.dot(&self.surface[other].normal) > SMOOTH_COSINE
    }

    /// The fit of an element, by the facets that touch it and those beside them.
    fn local_fit(&self, at: usize, facet: &Facet, (facets, around): (&[Option<Facet>], &BTreeSet<usize>)) -> LocalFit {
        let element = &self.surface[at];
        let (normal, centroid) = (element.normal, element.centroid);
        // along the longest side, and across it
        let sides = (0..4).map(|i| facet.corners[(i + 1) % 4] - facet.corners[i]);
        let longest = sides.reduce(|a, b| if b.norm() > a.norm() { b } else { a }).unwrap_or_else(Vector3::x);
        let along = (longest - normal * normal.dot(&longest)).try_normalize(0.0).unwrap_or_else(Vector3::x);
        let axes = [along, normal.cross(&along)];
        let lengths = axes.map(|axis| {
            let places = facet.corners.map(|corner| (corner - centroid).dot(&axis));
            let (low, high) =
                places.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(*x), h.max(*x)));
            (high - low).max(1e-3 * facet.diagonal)
        });
        let basis = Basis { centroid, axes, lengths };
        let rows: Vec<(usize, Terms, f64)> = around
            .iter()
            .filter(|other| **other != at)
            .map(|other| {
                let place = self.surface[*other].centroid;
                let [u, v] = basis.place(&place);
                (*other, basis.values(&place), 1.0 / (u * u + v * v).max(f64::MIN_POSITIVE))
            })
            .collect();
        let mut matrix: Matrix5<f64> = rows.iter().map(|(_, row, weight)| row * row.transpose() * *weight).sum();
        // the hull itself is a polynomial
        let inverse = inverse_of(matrix);
        let height = |other: usize| (self.surface[other].centroid - centroid).dot(&normal);
        let bend = rows.iter().map(|(other, row, weight)| inverse * row * (weight * height(*other))).sum();
        // the condition in units of the potential
        let weight = SURFACE_WEIGHT * basis.length().powi(2);
        let mut made = LocalFit { basis, normal, bend, around: Vec::new(), sides: Vec::new(), corner: None };
        let nu = self.wave.frequency * self.wave.frequency / self.wave.gravity;
        let mut conditions = Vec::new();
        for ends in facet.level_sides() {
            let middle = (ends[0] + ends[1]) * 0.5;
            let damping = self.damping_at([middle.x, middle.y]);
            let row = (damping == 0.0).then(|| made.up(&middle) - made.basis.values(&middle) * nu);
            matrix += row.map_or_else(Matrix5::zeros, |row| row * row.transpose() * weight);
            conditions.push((ends, damping, row));
        }
        let inverse = inverse_of(matrix);
        made.around = rows.into_iter().map(|(other, row, weight)| (other, inverse * row * weight)).collect();
        let side = |(ends, damping, row): ([Vector3<f64>; 2], f64, Option<Terms>)| WaterlineSide {
            ends,
            damping,
            condition: row.map(|row| inverse * row * weight),
        };
        made.sides = conditions.into_iter().map(side).collect();
        if around.iter().any(|other| facets[*other].as_ref().is_some_and(|facet| facet.is_at_surface)) {
            made.corner = made.corner_above();
        }
        made
    }
}

/// The inverse of the matrix of a fit; zeros where nothing is to be fitted.
fn inverse_of(mut matrix: Matrix5<f64>) -> Matrix5<f64> {
    let ridge = RIDGE * matrix.trace();
    matrix += Matrix5::identity() * ridge;
    let inverse = Cholesky::new(matrix, &never).and_then(|factors| factors.solve(&Matrix5::identity()));
    inverse.unwrap_or_else(|_| Matrix5::zeros())
}
