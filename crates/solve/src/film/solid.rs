//! A body as a solid: triangles and sharp edges in its own axes, that move with it.

use crate::outline::corners_and_edges;
use nalgebra::Vector3;
use windlass_base::geometry::Position;
use windlass_model::{Body, Model, Shape, bar_panels, box_panels};

/// A surface in the axes of a body (m).
#[derive(Clone, Debug, PartialEq, Default)]
pub struct FilmSolid {
    /// Corners of the triangles and ends of the edges.
    pub points: Vec<Position>,
    /// Triangles, each by its corners' numbers.
    pub triangles: Vec<[u32; 3]>,
    /// Edges that are seen, each by its ends' numbers.
    pub edges: Vec<[u32; 2]>,
    /// A box about the points of a body without a hull, and no form of its own.
    pub stands_for: bool,
}

impl FilmSolid {
    /// That of a body: its hull, or a box about its points, no side shorter than `least` (m).
    pub fn from_body(model: &Model, body: &Body, least: f64) -> FilmSolid {
        let mut made = FilmSolid::default();
        for part in model.parts_of(body) {
            for piece in &part.pieces {
                let position = |at: Position| part.position.apply(at);
                made.add(&piece.shape, &position);
            }
        }
        if made.triangles.is_empty() { FilmSolid::bounding_box(model, body, least) } else { made }
    }

    /// A box about the points and pieces of a body, no side shorter than `least` (m).
    pub fn bounding_box(model: &Model, body: &Body, least: f64) -> FilmSolid {
        let mut positions: Vec<Vector3<f64>> = Vec::new();
        for part in model.parts_of(body) {
            let key = Model::key(&part.name);
            let own = model.points.values().filter(|p| Model::key(&p.part) == key);
            positions.extend(own.map(|p| Vector3::from(part.position.apply(p.at))));
            let corners = part.pieces.iter().flat_map(|p| corners_and_edges(&p.shape).0);
            positions.extend(corners.map(|at| Vector3::from(part.position.apply(at))));
        }
        let first = positions.first().copied().unwrap_or_default();
        let (low, high) = positions.iter().fold((first, first), |(low, high), at| (low.inf(at), high.sup(at)));
        let middle = (low + high) * 0.5;
        let half = ((high - low) * 0.5).map(|h| h.max(0.5 * least));
        let mut made = FilmSolid { stands_for: true, ..FilmSolid::default() };
        made.add(&Shape::Block { low: (middle - half).into(), high: (middle + half).into() }, &|at| at);
        made
    }

    /// Adds a shape, each of its places taken through `place`.
    fn add(&mut self, shape: &Shape, position: &dyn Fn(Position) -> Position) {
        let (corners, edges) = corners_and_edges(shape);
        match shape {
            Shape::Panels(panels) => self.panels(panels, position),
            Shape::Block { low, high } => self.panels(&box_panels(*low, *high), position),
            Shape::Bar { ends, sides } => self.panels(&bar_panels(ends, sides), position),
            Shape::Tube { .. } => {
                // both rings one behind the other, as the outline has them
                let count = corners.len() / 2;
                let at = |i: usize| corners.get(i).copied();
                let mut panels: Vec<Vec<Position>> = Vec::new();
                for i in 0..count {
                    let next = (i + 1) % count.max(1);
                    panels.push([i, next, count + next, count + i].into_iter().filter_map(at).collect());
                }
                panels.push((0..count).rev().filter_map(at).collect());
                panels.push((count..2 * count).filter_map(at).collect());
                self.panels(&panels, position);
            }
        }
        for edge in edges {
            let [a, b] = edge.map(|at| self.point(position(at)));
            self.edges.push([a, b]);
        }
    }

    /// Polygons as fans of triangles.
    fn panels(&mut self, panels: &[Vec<Position>], position: &dyn Fn(Position) -> Position) {
        for panel in panels {
            let numbers: Vec<u32> = panel.iter().map(|at| self.point(position(*at))).collect();
            if let Some((first, rest)) = numbers.split_first() {
                self.triangles.extend(rest.windows(2).filter_map(|pair| Some([*first, *pair.first()?, *pair.last()?])));
            }
        }
    }

    fn point(&mut self, at: Position) -> u32 {
        self.points.push(at);
        u32::try_from(self.points.len() - 1).unwrap_or(u32::MAX)
    }

    /// The farthest any of it is from the body's origin (m).
    pub fn reach(&self) -> f64 {
        self.points.iter().map(|at| Vector3::from(*at).norm()).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The volume triangles enclose, by the divergence of the position: positive when they face outward.
    fn volume(solid: &FilmSolid) -> f64 {
        let at = |n: u32| Vector3::from(solid.points[n as usize]);
        solid.triangles.iter().map(|[a, b, c]| at(*a).dot(&at(*b).cross(&at(*c))) / 6.0).sum()
    }

    #[test]
    fn box_and_tube_solids_are_closed_with_their_volume() {
        let mut block = FilmSolid::default();
        block.add(&Shape::Block { low: [-1.0, 0.0, 2.0], high: [3.0, 2.0, 3.0] }, &|at| at);
        assert!((volume(&block) - 8.0).abs() < 1e-12);
        assert_eq!((block.triangles.len(), block.edges.len()), (12, 12));
        let mut tube = FilmSolid::default();
        tube.add(&Shape::Tube { ends: [[0.0, 0.0, -10.0], [0.0, 0.0, 5.0]], diameter: 4.0 }, &|at| at);
        // a prism over a polygon of 24 corners on the circle
        let want = 15.0 * 0.5 * 24.0 * 4.0 * (std::f64::consts::TAU / 24.0).sin();
        assert!((volume(&tube).abs() - want).abs() < 1e-9, "{} {want}", volume(&tube));
    }
}
