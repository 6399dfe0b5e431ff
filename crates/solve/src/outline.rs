//! The outline of a body: shapes whose convex hulls are filled in a picture, and the edges seen on them.

use nalgebra::Vector3;
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use windlass_base::geometry::Position;
use windlass_model::{Body, Model, Shape, bar_panels, box_panels};

/// Cosine of the angle between two panels beyond which their common edge is sharp: 30 degrees.
const SHARP_EDGE_COSINE: f64 = 0.866;
/// Corners of a drawn circle, and lines along a tube.
const CIRCLE_CORNERS: (usize, usize) = (24, 4);

/// How a body looks (m, global).
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Outline {
    /// The body.
    pub name: String,
    /// The origin of its axes.
    pub origin: Position,
    /// Places each of its pieces reaches; in a picture a piece is filled within their convex hull.
    pub shapes: Vec<Vec<Position>>,
    /// Sharp edges, each between two places.
    pub edges: Vec<[Position; 2]>,
}

/// The outline of a body: its hull pieces, or where it has none all points of its parts.
pub fn outline(model: &Model, body: &Body) -> Outline {
    let mut made = Outline { name: body.name.clone(), origin: body.place.apply([0.0; 3]), ..Outline::default() };
    for part in model.parts_of(body) {
        let global = |at: Position| body.place.apply(part.place.apply(at));
        for piece in &part.pieces {
            let (corners, edges) = corners_and_edges(&piece.shape);
            made.shapes.push(corners.into_iter().map(global).collect());
            made.edges.extend(edges.into_iter().map(|edge| edge.map(global)));
        }
    }
    if made.shapes.is_empty() {
        let parts: Vec<String> = model.parts_of(body).map(|p| Model::key(&p.name)).collect();
        let points = model.points.values().filter(|p| parts.contains(&Model::key(&p.part)));
        made.shapes.push(points.map(|p| model.global(p)).collect());
    }
    made
}

/// The corners and the sharp edges of a shape.
pub(super) fn corners_and_edges(shape: &Shape) -> (Vec<Position>, Vec<[Position; 2]>) {
    match shape {
        Shape::Panels(panels) => (panels.iter().flatten().copied().collect(), sharp_edges(panels)),
        Shape::Block { low, high } => {
            let panels = box_panels(*low, *high);
            (panels.iter().flatten().copied().collect(), sharp_edges(&panels))
        }
        Shape::Bar { ends, sides } => {
            let panels = bar_panels(ends, sides);
            (panels.iter().flatten().copied().collect(), sharp_edges(&panels))
        }
        Shape::Tube { ends: [a, b], diameter } => {
            let (a, b) = (Vector3::from(*a), Vector3::from(*b));
            let Some(axis) = (b - a).try_normalize(0.0) else { return (vec![a.into(), b.into()], Vec::new()) };
            let across = if axis.z.abs() < 0.9 { Vector3::z() } else { Vector3::x() };
            let u = axis.cross(&across).normalize() * (0.5 * diameter);
            let v = axis.cross(&u);
            let (count, along) = CIRCLE_CORNERS;
            let ring = |centre: Vector3<f64>| -> Vec<Position> {
                let angle = |i: usize| TAU * i as f64 / count as f64;
                (0..count).map(|i| (centre + u * angle(i).cos() + v * angle(i).sin()).into()).collect()
            };
            let (first, last) = (ring(a), ring(b));
            let mut edges: Vec<[Position; 2]> = Vec::new();
            for circle in [&first, &last] {
                edges.extend(circle.iter().zip(circle.iter().cycle().skip(1)).map(|(p, q)| [*p, *q]));
            }
            edges.extend(first.iter().zip(&last).step_by(count / along).map(|(p, q)| [*p, *q]));
            (first.into_iter().chain(last).collect(), edges)
        }
    }
}

/// The edges of a mesh that are seen: those of one panel alone, and those where two panels meet at an angle. A mesh of
/// many panels is not drawn black with the others.
fn sharp_edges(panels: &[Vec<Position>]) -> Vec<[Position; 2]> {
    /// An edge with the normals of the panels that have it.
    type Edge = ([Position; 2], Vec<Vector3<f64>>);
    let mut edges: BTreeMap<[[u64; 3]; 2], Edge> = BTreeMap::new();
    // no zero has a sign here
    let key = |at: &Position| at.map(|c| (c + 0.0).to_bits());
    for panel in panels {
        let normal = normal(panel);
        for (a, b) in panel.iter().zip(panel.iter().cycle().skip(1)).filter(|(a, b)| a != b) {
            let (p, q) = (key(a), key(b));
            edges.entry([p.min(q), p.max(q)]).or_insert(([*a, *b], Vec::new())).1.push(normal);
        }
    }
    let seen = |normals: &[Vector3<f64>]| match normals {
        // panels turned the other way around are as smooth
        [a, b] => a.dot(b).abs() < SHARP_EDGE_COSINE,
        _ => true,
    };
    edges.into_values().filter(|(_, normals)| seen(normals)).map(|(edge, _)| edge).collect()
}

/// The unit normal of a polygon (Newell's sum); zero of one without area.
fn normal(panel: &[Position]) -> Vector3<f64> {
    let pairs = panel.iter().zip(panel.iter().cycle().skip(1));
    let sum: Vector3<f64> = pairs.map(|(a, b)| Vector3::from(*a).cross(&Vector3::from(*b))).sum();
    sum.try_normalize(0.0).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn box_outline_has_twelve_edges_and_flat_mesh_its_border_alone() {
        let (corners, edges) = corners_and_edges(&Shape::Block { low: [0.0; 3], high: [4.0, 2.0, 1.0] });
        assert_eq!((corners.len(), edges.len()), (24, 12));
        let at = |i: u32, j: u32| [f64::from(i), f64::from(j), 0.0];
        let mesh: Vec<Vec<Position>> = (0..5)
            .flat_map(|i| (0..5).map(move |j| (i, j)))
            .map(|(i, j)| vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])
            .collect();
        assert_eq!(sharp_edges(&mesh).len(), 20);
    }

    #[test]
    fn tube_outline_has_its_radius() {
        let (corners, _) =
            corners_and_edges(&Shape::Tube { ends: [[1.0, 0.0, -20.0], [1.0, 0.0, 5.0]], diameter: 6.0 });
        assert!(corners.iter().all(|[x, y, _]| ((x - 1.0).hypot(*y) - 3.0).abs() < 1e-12));
    }
}
