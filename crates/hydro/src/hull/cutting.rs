//! Whether two triangles cut each other.

use nalgebra::Vector3;

type Triangle = [Vector3<f64>; 3];
/// A point and its height over a plane.
type HeightedPoint<'a> = (&'a Vector3<f64>, &'a f64);

/// A point common to two triangles that pass through each other, or that lie on each other in one plane with normals to the
/// same side, by more than `margin` (m); none where they only touch, as neighbours do along an edge.
///
/// Two convex bodies are apart if an axis among their normals, the normals of their edges, and the cross products of edges
/// shows their projections apart (separating axis theorem). Here an axis parts them unless each reaches past the other by
/// the margin.
pub fn intersect_triangles(a: &Triangle, b: &Triangle, margin: f64) -> Option<Vector3<f64>> {
    let (edges_a, edges_b) = (edges(a), edges(b));
    let normal = |e: &Triangle| e[0].cross(&e[1]).try_normalize(0.0);
    let (na, nb) = (normal(&edges_a)?, normal(&edges_b)?);
    let in_plane = |n: Vector3<f64>, e: &Triangle| e.map(|e| n.cross(&e));
    let sides = in_plane(na, &edges_a).into_iter().chain(in_plane(nb, &edges_b));
    let apart = |axis: Vector3<f64>| {
        // the length of two edges' product is their sine: a direction from rounding alone parts nothing wrongly, as any axis may
        let Some(axis) = axis.try_normalize(0.0) else { return false };
        let (low_a, high_a) = reach(a, axis);
        let (low_b, high_b) = reach(b, axis);
        (high_a - low_b).min(high_b - low_a) <= margin
    };
    let (low, high) = reach(b, na);
    let height = na.dot(&a[0]);
    if (height - low).abs().max((height - high).abs()) <= margin {
        let same_side = na.dot(&nb) > 0.0;
        return (same_side && !sides.into_iter().any(apart)).then(|| common(a, b, na));
    }
    let products = edges_a.iter().flat_map(|p| edges_b.iter().map(move |q| p.cross(q)));
    let parted = [na, nb].into_iter().chain(sides).chain(products).any(apart);
    (!parted).then(|| common(a, b, na))
}

fn edges(t: &Triangle) -> Triangle {
    [t[1] - t[0], t[2] - t[1], t[0] - t[2]]
}

fn reach(t: &Triangle, axis: Vector3<f64>) -> (f64, f64) {
    let [p, q, r] = t.map(|v| v.dot(&axis));
    (p.min(q).min(r), p.max(q).max(r))
}

/// The middle of what of `b` lies between the sides of `a`, in `a`'s plane where `b` passes through it.
fn common(a: &Triangle, b: &Triangle, normal: Vector3<f64>) -> Vector3<f64> {
    let mut shape: Vec<Vector3<f64>> = b.to_vec();
    let height = normal.dot(&a[0]);
    let heights: Vec<f64> = shape.iter().map(|p| normal.dot(p) - height).collect();
    if heights.iter().any(|h| *h < 0.0) && heights.iter().any(|h| *h > 0.0) {
        let next = shape.iter().zip(&heights).cycle().skip(1);
        let through = |((p, h), (q, k)): (HeightedPoint, HeightedPoint)| {
            (h * k < 0.0).then(|| p + (q - p) * (h / (h - k))).or((*h == 0.0).then_some(*p))
        };
        shape = shape.iter().zip(&heights).zip(next).filter_map(through).collect();
    }
    for (corner, edge) in a.iter().zip(edges(a)) {
        let inward = normal.cross(&edge);
        let depth = |p: &Vector3<f64>| inward.dot(&(p - corner));
        let mut kept = Vec::new();
        for (p, q) in shape.iter().zip(shape.iter().cycle().skip(1)) {
            let (h, k) = (depth(p), depth(q));
            if h >= 0.0 {
                kept.push(*p);
            }
            if h * k < 0.0 {
                kept.push(p + (q - p) * (h / (h - k)));
            }
        }
        if !kept.is_empty() {
            shape = kept;
        }
    }
    shape.iter().sum::<Vector3<f64>>() / shape.len().max(1) as f64
}
