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
    /// The panels of its pieces.
    pub panels: Vec<Vec<Position>>,
    /// Edges of the panels.
    pub edges: Vec<OutlineEdge>,
    /// All its points where it has no pieces; a picture fills their convex hull.
    pub points: Vec<Position>,
}

/// An edge of a body's panels.
#[derive(Clone, Debug, PartialEq)]
pub struct OutlineEdge {
    /// Its ends (m, global).
    pub ends: [Position; 2],
    /// Unit normals of the panels that meet in it, turned to the same side of the surface.
    pub normals: Vec<Position>,
}

impl OutlineEdge {
    /// Whether it is seen as an edge: of one panel alone, or of two that meet at more than 30 degrees.
    pub fn is_sharp(&self) -> bool {
        is_sharp(&self.normals.iter().map(|n| Vector3::from(*n)).collect::<Vec<_>>())
    }

    /// Whether it is on the silhouette for a viewer in a direction: of the panels that meet in it, one faces the viewer and one does not.
    pub fn is_silhouette(&self, viewer: Position) -> bool {
        let facing = |n: &Position| n.iter().zip(viewer).map(|(a, b)| a * b).sum::<f64>() > 1e-9;
        match self.normals.as_slice() {
            [a, b] => facing(a) != facing(b),
            _ => true,
        }
    }
}

/// The outline of a body: its hull pieces, or where it has none all points of its parts.
pub fn outline(model: &Model, body: &Body) -> Outline {
    let mut made = Outline { name: body.name.clone(), origin: body.position.apply([0.0; 3]), ..Outline::default() };
    for part in model.parts_of(body) {
        let global = |at: Position| body.position.apply(part.position.apply(at));
        for piece in &part.pieces {
            let panels: Vec<Vec<Position>> =
                panels_of(&piece.shape).into_iter().map(|p| p.into_iter().map(global).collect()).collect();
            made.edges.extend(panel_edges(&panels));
            made.panels.extend(panels);
        }
    }
    if made.panels.is_empty() {
        let parts: Vec<String> = model.parts_of(body).map(|p| Model::key(&p.name)).collect();
        let points = model.points.values().filter(|p| parts.contains(&Model::key(&p.part)));
        made.points = points.map(|p| model.global(p)).collect();
    }
    made
}

/// The panels of a shape. A tube has flat ones along its length, and its two ends.
fn panels_of(shape: &Shape) -> Vec<Vec<Position>> {
    match shape {
        Shape::Panels(panels) => panels.clone(),
        Shape::Block { low, high } => box_panels(*low, *high),
        Shape::Bar { ends, sides } => bar_panels(ends, sides),
        Shape::Tube { ends, diameter } => {
            let Some([first, last]) = tube_rings(*ends, *diameter) else { return Vec::new() };
            let next = |ring: &[Position]| ring.iter().copied().cycle().skip(1).take(ring.len()).collect::<Vec<_>>();
            let (first_next, last_next) = (next(&first), next(&last));
            let sides = first.iter().zip(&first_next).zip(last.iter().zip(&last_next));
            let mut panels: Vec<Vec<Position>> = sides.map(|((a, b), (c, d))| vec![*a, *b, *d, *c]).collect();
            panels.push(last);
            panels.push(first.into_iter().rev().collect());
            panels
        }
    }
}

/// The circles at the two ends of a tube; `None` of one without length.
fn tube_rings([a, b]: [Position; 2], diameter: f64) -> Option<[Vec<Position>; 2]> {
    let (a, b) = (Vector3::from(a), Vector3::from(b));
    let axis = (b - a).try_normalize(0.0)?;
    let across = if axis.z.abs() < 0.9 { Vector3::z() } else { Vector3::x() };
    let u = axis.cross(&across).normalize() * (0.5 * diameter);
    let v = axis.cross(&u);
    let angle = |i: usize| TAU * i as f64 / CIRCLE_CORNERS.0 as f64;
    let ring = |centre: Vector3<f64>| -> Vec<Position> {
        (0..CIRCLE_CORNERS.0).map(|i| (centre + u * angle(i).cos() + v * angle(i).sin()).into()).collect()
    };
    Some([ring(a), ring(b)])
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
        Shape::Tube { ends, diameter } => {
            let Some([first, last]) = tube_rings(*ends, *diameter) else { return (ends.to_vec(), Vec::new()) };
            let (count, along) = CIRCLE_CORNERS;
            let mut edges: Vec<[Position; 2]> = Vec::new();
            for circle in [&first, &last] {
                edges.extend(circle.iter().zip(circle.iter().cycle().skip(1)).map(|(p, q)| [*p, *q]));
            }
            edges.extend(first.iter().zip(&last).step_by(count / along).map(|(p, q)| [*p, *q]));
            (first.into_iter().chain(last).collect(), edges)
        }
    }
}

/// Whether panels of these unit normals meet in an edge that is seen: it belongs to one panel alone, or two meet at an angle.
fn is_sharp(normals: &[Vector3<f64>]) -> bool {
    match normals {
        [a, b] => a.dot(b) < SHARP_EDGE_COSINE,
        _ => true,
    }
}

/// The edges of a mesh with the normals of the panels that meet there. Where two panels run along their edge the same way, one of
/// them is turned inside out, and its normal is turned back.
fn panel_edges(panels: &[Vec<Position>]) -> Vec<OutlineEdge> {
    /// An edge, the normals of its panels, and whether each runs along it the way of the first.
    type Edge = ([Position; 2], Vec<(Vector3<f64>, bool)>);
    let mut edges: BTreeMap<[[u64; 3]; 2], Edge> = BTreeMap::new();
    // no zero has a sign here
    let key = |at: &Position| at.map(|c| (c + 0.0).to_bits());
    for panel in panels {
        let normal = normal(panel);
        for (a, b) in panel.iter().zip(panel.iter().cycle().skip(1)).filter(|(a, b)| a != b) {
            let (p, q) = (key(a), key(b));
            let (_, found) = edges.entry([p.min(q), p.max(q)]).or_insert(([*a, *b], Vec::new()));
            found.push((normal, p <= q));
        }
    }
    let edge = |(ends, found): Edge| {
        let normals = match found.as_slice() {
            [(a, along), (b, other)] if along == other => vec![*a, -b],
            _ => found.iter().map(|(normal, _)| *normal).collect(),
        };
        OutlineEdge { ends, normals: normals.into_iter().map(Position::from).collect() }
    };
    edges.into_values().map(edge).collect()
}

/// The edges of a mesh that are seen. A mesh of many panels is not drawn black with the others.
fn sharp_edges(panels: &[Vec<Position>]) -> Vec<[Position; 2]> {
    panel_edges(panels).into_iter().filter(OutlineEdge::is_sharp).map(|edge| edge.ends).collect()
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
