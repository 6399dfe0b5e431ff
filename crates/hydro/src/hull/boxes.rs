//! A tree of boxes round triangles: which pairs of them may meet, without asking all pairs.

use super::Surface;
use nalgebra::Vector3;

/// Triangles of a leaf.
const TRIANGLES_PER_LEAF: usize = 4;

/// A box round the triangles of a part of the tree's order.
#[derive(Debug)]
struct BoxNode {
    low: Vector3<f64>,
    high: Vector3<f64>,
    first: usize,
    last: usize,
    /// The two halves; none of a leaf.
    halves: Option<[usize; 2]>,
}

/// The tree: halved at the median across its longest side, so its depth is the logarithm of its size.
#[derive(Debug)]
pub struct Boxes {
    nodes: Vec<BoxNode>,
    order: Vec<usize>,
}

impl Boxes {
    /// That of a surface's faces.
    pub fn new(surface: &Surface) -> Boxes {
        let corners: Vec<Option<[Vector3<f64>; 3]>> = (0..surface.faces.len()).map(|n| surface.corners(n)).collect();
        let order = (0..corners.len()).filter(|&n| corners.get(n).is_some_and(Option::is_some)).collect();
        let mut tree = Boxes { nodes: Vec::new(), order };
        if !tree.order.is_empty() {
            tree.grow(&corners, 0, tree.order.len());
        }
        tree
    }

    fn grow(&mut self, corners: &[Option<[Vector3<f64>; 3]>], first: usize, last: usize) -> usize {
        let part = &mut self.order[first..last];
        let at = |n: usize| corners.get(n).copied().flatten().unwrap_or_default();
        let mut low = Vector3::repeat(f64::INFINITY);
        let mut high = -low;
        for p in part.iter().flat_map(|&n| at(n)) {
            (low, high) = (low.inf(&p), high.sup(&p));
        }
        let own = self.nodes.len();
        let middle = part.len() / 2;
        let split = part.len() > TRIANGLES_PER_LEAF;
        if split {
            let side = (high - low).imax();
            let centre = |n: &usize| at(*n).iter().map(|p| p[side]).sum::<f64>();
            part.select_nth_unstable_by(middle, |a, b| centre(a).total_cmp(&centre(b)).then(a.cmp(b)));
        }
        self.nodes.push(BoxNode { low, high, first, last, halves: None });
        if split {
            let halves = [self.grow(corners, first, first + middle), self.grow(corners, first + middle, last)];
            if let Some(node) = self.nodes.get_mut(own) {
                node.halves = Some(halves);
            }
        }
        own
    }

    /// The pairs of faces, one of each tree, whose leaves are not further apart than `margin`; until one answers true. With
    /// the tree itself each pair comes once or twice, and a face with itself.
    pub fn pairs(&self, other: &Boxes, margin: f64, mut meet: impl FnMut(usize, usize) -> bool) -> bool {
        let itself = std::ptr::eq(self, other);
        let mut open = if self.nodes.is_empty() || other.nodes.is_empty() { vec![] } else { vec![(0, 0)] };
        while let Some((m, n)) = open.pop() {
            let (a, b) = (&self.nodes[m], &other.nodes[n]);
            if (0..3).any(|i| a.low[i] > b.high[i] + margin || b.low[i] > a.high[i] + margin) {
                continue;
            }
            match (a.halves, b.halves) {
                (Some([p, q]), Some(_)) if itself && m == n => open.extend([(q, q), (p, q), (p, p)]),
                (Some(halves), other) if other.is_none() || a.last - a.first >= b.last - b.first => {
                    open.extend(halves.map(|h| (h, n)));
                }
                (_, Some(halves)) => open.extend(halves.map(|h| (m, h))),
                _ => {
                    let (from, with) = (&self.order[a.first..a.last], &other.order[b.first..b.last]);
                    for &f in from {
                        if with.iter().any(|&g| meet(f, g)) {
                            return true;
                        }
                    }
                }
            }
        }
        false
    }
}
