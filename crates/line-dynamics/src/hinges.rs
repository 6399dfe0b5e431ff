//! The hinges of a rod with torsion, and the moments at its ends.

use super::bend::hinge;
use super::ends::RodEnd;
use super::mesh::Rod;
use super::spatial::{HingeSide, Vector8, spatial, transport_director};
use super::state::RodState;
use super::trial::Trial;
use nalgebra::{Matrix3, Matrix4, Matrix4x3, SMatrix, Vector3, Vector4};

/// One hinge: the elements on its two sides, its gradient and stiffness.
pub(super) type SpatialHinge = ([Option<usize>; 2], Vector8, SMatrix<f64, 8, 8>);

/// The sides of the hinge before an element of a rod with torsion, or of that at an end beside it, with its two stiffnesses.
pub(super) fn hinge_sides(
    rod: &Rod,
    x: &[Vector3<f64>],
    directors: &[Vector3<f64>],
    ends: &[RodEnd; 2],
    hinge: HingePlace,
) -> Option<(f64, f64, HingeSide, HingeSide)> {
    let last = rod.elements.len();
    let side = |i: usize, natural: [f64; 2]| {
        let d = x[i + 1] - x[i];
        HingeSide { direction: d.normalize(), length: d.norm(), director: directors[i], natural }
    };
    let held = |end: &RodEnd, i: usize, natural: [f64; 2]| {
        let element = &rod.elements[i];
        let (k, direction) = end.hinge(element)?;
        let across = end.side.and_then(|s| (s - direction * direction.dot(&s)).try_normalize(1e-9));
        let near = side(i, natural);
        let director = across.unwrap_or_else(|| transport_director(&near.director, &near.direction, &direction));
        let kt = if across.is_some() { 2.0 * element.torsion / element.rest } else { 0.0 };
        Some((k, kt, HingeSide { direction, length: 1.0, director, natural }))
    };
    match hinge {
        HingePlace::Inner(i) => {
            let natural = rod.natural_curvature(i);
            Some((rod.hinge(i), rod.twist_hinge(i), side(i - 1, natural[0]), side(i, natural[1])))
        }
        HingePlace::A => {
            let natural = rod.natural_curvature(0);
            let (k, kt, holder) = held(&ends[0], 0, natural[0])?;
            Some((k, kt, holder, side(0, natural[1])))
        }
        HingePlace::B => {
            let natural = rod.natural_curvature(last);
            let (k, kt, holder) = held(&ends[1], last - 1, natural[1])?;
            Some((k, kt, side(last - 1, natural[0]), holder))
        }
    }
}

/// Where a hinge is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum HingePlace {
    /// Between end A's holder and the first element.
    A,
    /// At an inner node.
    Inner(usize),
    /// Between the last element and end B's holder.
    B,
}

/// The hinges to be added with element `i`: the one before it, and those of the ends beside it.
pub(super) fn spatial_hinges(rod: &Rod, trial: &Trial, i: usize) -> impl Iterator<Item = SpatialHinge> {
    let last = rod.elements.len();
    let inner = (i > 0).then_some((HingePlace::Inner(i), [Some(i.wrapping_sub(1)), Some(i)]));
    let first = (i == 0).then_some((HingePlace::A, [None, Some(0)]));
    let end = (i + 1 == last).then_some((HingePlace::B, [Some(i), None]));
    [first, inner, end].into_iter().flatten().filter_map(|(at, sides)| {
        let (k, kt, e, f) = hinge_sides(rod, &trial.x, &trial.director, &trial.ends, at)?;
        let (gradient, matrix) = spatial(k, kt, &e, &f);
        Some((sides, gradient, matrix))
    })
}

/// Moment of the rod on the holder of an end (N m): the hinge turns the rod toward the held direction, and the holder back.
pub(super) fn end_moment(rod: &Rod, state: &RodState, end: &RodEnd, side: usize) -> Vector3<f64> {
    let (i, element) =
        if side == 0 { (0, rod.elements.first()) } else { (rod.elements.len() - 1, rod.elements.last()) };
    if rod.twists() {
        let at = if side == 0 { HingePlace::A } else { HingePlace::B };
        let mut ends = [RodEnd::FREE; 2];
        ends[side] = *end;
        return hinge_sides(rod, &state.position, &state.director, &ends, at).map_or_else(
            Vector3::zeros,
            |(k, kt, e, f)| {
                let gradient = spatial(k, kt, &e, &f).0;
                let (near, first) = if side == 0 { (f, 3) } else { (e, 0) };
                let force = gradient.fixed_rows::<3>(first).into_owned();
                near.direction.cross(&force) * near.length + near.direction * gradient[if side == 0 { 7 } else { 6 }]
            },
        );
    }
    let hinge = element.and_then(|e| end.hinge(e));
    let Some((stiffness, direction)) = hinge else { return Vector3::zeros() };
    let t = (state.position[i + 1] - state.position[i]).normalize();
    let axis = direction.cross(&t);
    let sine = axis.norm();
    if sine > 0.0 { axis * (stiffness * sine.atan2(direction.dot(&t)) / sine) } else { axis }
}

/// How a holder that turns and the rod beside it feel each other. The rod's unknowns are the edge beside the holder
/// and its turn about itself.
pub(super) struct Clamp {
    /// Moment on the holder by the edge and its turn (N, N m).
    pub moment_by_near: SMatrix<f64, 3, 4>,
    /// What edge and turn need from outside by the rotation of the holder (N, N m).
    pub near_by_rotation: Matrix4x3<f64>,
    /// Moment on the holder by its own rotation (N m).
    pub moment_by_rotation: Matrix3<f64>,
}

/// The clamp of an end at a trial; none where a holder that turns turns nothing.
///
/// A holder of direction e that turns by theta moves its direction by theta x e and turns about it by theta.e: these
/// are J theta. With the gradient g of the hinge's energy by the two, the moment on the holder is -J'g.
pub(super) fn clamp(rod: &Rod, trial: &Trial, side: usize) -> Option<Clamp> {
    let last = rod.elements.len();
    let i = if side == 0 { 0 } else { last - 1 };
    let element = rod.elements.get(i).filter(|e| e.bending > 0.0)?;
    let mut gradient = Vector4::zeros();
    let [mut by_own, mut by_near, mut near_by] = [Matrix4::zeros(); 3];
    let direction = if rod.twists() {
        let at = if side == 0 { HingePlace::A } else { HingePlace::B };
        let (k, kt, e, f) = hinge_sides(rod, &trial.x, &trial.director, &trial.ends, at)?;
        let (slopes, matrix) = spatial(k, kt, &e, &f);
        let (own, near) = if side == 0 { ([0, 1, 2, 6], [3, 4, 5, 7]) } else { ([3, 4, 5, 7], [0, 1, 2, 6]) };
        let part = |rows: [usize; 4], columns: [usize; 4]| Matrix4::from_fn(|i, j| matrix[(rows[i], columns[j])]);
        gradient = Vector4::from_fn(|i, _| slopes[own[i]]);
        (by_own, by_near, near_by) = (part(own, own), part(own, near), part(near, own));
        if side == 0 { e.direction } else { f.direction }
    } else {
        let (stiffness, direction) = trial.ends[side].hinge(element)?;
        let d = trial.x[i + 1] - trial.x[i];
        let made = hinge(stiffness, &direction, 1.0, &d.normalize(), d.norm());
        gradient.fixed_rows_mut::<3>(0).copy_from(&made.gradient[0]);
        by_own.fixed_view_mut::<3, 3>(0, 0).copy_from(&made.curvature[0]);
        by_near.fixed_view_mut::<3, 3>(0, 0).copy_from(&made.curvature[1]);
        near_by.fixed_view_mut::<3, 3>(0, 0).copy_from(&made.curvature[1].transpose());
        direction
    };
    let cross = direction.cross_matrix();
    let mut turn = Matrix4x3::zeros();
    turn.fixed_view_mut::<3, 3>(0, 0).copy_from(&-cross);
    turn.fixed_view_mut::<1, 3>(3, 0).copy_from(&direction.transpose());
    let force = gradient.fixed_rows::<3>(0).into_owned();
    Some(Clamp {
        moment_by_near: -turn.transpose() * by_near,
        near_by_rotation: near_by * turn,
        moment_by_rotation: cross * gradient[3] - force.cross_matrix() * cross - turn.transpose() * by_own * turn,
    })
}
