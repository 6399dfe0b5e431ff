//! A pipe in a vertical plane: an elastic beam of large displacement and rotation under its weight, on a bottom that
//! pushes back.
//!
//! Corotational two-node elements: small strains along and across a chord that moves freely (Crisfield, Non-linear Finite
//! Element Analysis of Solids and Structures 1, 7.3). A node has x, z and the slope angle from x toward z. The weight acts by
//! its potential along the bent shape, w L ((z1 + z2) / 2 + (x2 - x1)(t1 - t2) / 12). Tension is the effective one. The stiffness is
//! block-tridiagonal: a solution takes time in proportion to the number of elements.

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

type Vector = SVector<f64, 6>;
type Matrix = SMatrix<f64, 6, 6>;

/// An element of pipe between two nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Unstretched length (m).
    pub length: f64,
    /// AE (N).
    pub ea: f64,
    /// EI (N m2).
    pub ei: f64,
    /// Submerged weight per length (N/m).
    pub weight: f64,
}

/// The bottom: it pushes up in proportion to how far a node is below it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foundation {
    /// Its elevation (m).
    pub elevation: f64,
    /// Force per length of pipe and depth (N/m2).
    pub stiffness: f64,
}

/// A planar pipe.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanarBeam {
    /// Its elements, in order.
    pub pieces: Vec<Piece>,
    /// What it may lie on.
    pub bottom: Option<Foundation>,
    /// Node, freedom (0 x, 1 z, 2 angle) that do not move.
    pub held: Vec<(usize, usize)>,
}

/// Forces on the nodes (x, z, moment from x toward z) and -d(force)/d(motion): diagonal blocks, and those of each node with the next.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Assembled {
    /// Force on each node.
    pub force: Vec<Vector3<f64>>,
    /// Blocks of the nodes.
    pub diagonal: Vec<Matrix3<f64>>,
    /// Blocks of force on node n and motion of node n + 1; the stiffness is symmetric.
    pub upper: Vec<Matrix3<f64>>,
}

/// What an element bears.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Borne {
    /// Effective tension (N).
    pub tension: f64,
    /// Bending moments at its two nodes (N m): what they exert on it, from x toward z.
    pub moments: [f64; 2],
}

/// A turn nearest to none.
fn wrapped(angle: f64) -> f64 {
    angle - std::f64::consts::TAU * (angle / std::f64::consts::TAU).round()
}

impl Piece {
    fn strains(&self, a: &Vector3<f64>, b: &Vector3<f64>) -> (f64, f64, f64, Borne) {
        let (dx, dz) = (b.x - a.x, b.y - a.y);
        let (length, angle) = (dx.hypot(dz), dz.atan2(dx));
        let (t1, t2) = (wrapped(a.z - angle), wrapped(b.z - angle));
        let bend = 2.0 * self.ei / self.length;
        let tension = self.ea * (length - self.length) / self.length;
        let moments = [bend * (2.0 * t1 + t2), bend * (t1 + 2.0 * t2)];
        (dx / length, dz / length, length, Borne { tension, moments })
    }

    /// What it bears between its nodes.
    pub fn borne(&self, a: &Vector3<f64>, b: &Vector3<f64>) -> Borne {
        self.strains(a, b).3
    }

    /// Forces on its nodes, and -d(force)/d(motion).
    fn answer(&self, a: &Vector3<f64>, b: &Vector3<f64>) -> (Vector, Matrix) {
        let (c, s, length, Borne { tension, moments: [m1, m2] }) = self.strains(a, b);
        let r = Vector::from([-c, -s, 0.0, c, s, 0.0]);
        let z = Vector::from([s, -c, 0.0, -s, c, 0.0]);
        let (mut b1, mut b2) = (-z / length, -z / length);
        b1[2] += 1.0;
        b2[5] += 1.0;
        let mut force = -(r * tension + b1 * m1 + b2 * m2);
        let (axial, bend) = (self.ea / self.length, 2.0 * self.ei / self.length);
        let mut k = r * r.transpose() * axial
            + (b1 * b1.transpose() + b2 * b2.transpose()) * (2.0 * bend)
            + (b1 * b2.transpose() + b2 * b1.transpose()) * bend
            + z * z.transpose() * (tension / length)
            + (r * z.transpose() + z * r.transpose()) * ((m1 + m2) / (length * length));
        let w = self.weight * self.length;
        let (dx, dt) = (b.x - a.x, a.z - b.z);
        force -= Vector::from([-dt / 12.0, 0.5, dx / 12.0, dt / 12.0, 0.5, -dx / 12.0]) * w;
        for (i, j, sign) in [(0, 2, -1.0), (0, 5, 1.0), (3, 2, 1.0), (3, 5, -1.0)] {
            k[(i, j)] += sign * w / 12.0;
            k[(j, i)] += sign * w / 12.0;
        }
        (force, k)
    }
}

impl PlanarBeam {
    /// Forces and stiffness with the nodes at places (x, z, angle).
    pub fn assemble(&self, nodes: &[Vector3<f64>], out: &mut Assembled) {
        let count = nodes.len();
        out.force.clear();
        out.force.resize(count, Vector3::zeros());
        out.diagonal.clear();
        out.diagonal.resize(count, Matrix3::zeros());
        out.upper.clear();
        out.upper.resize(count.saturating_sub(1), Matrix3::zeros());
        for (i, piece) in self.pieces.iter().enumerate() {
            let [Some(a), Some(b)] = [nodes.get(i), nodes.get(i + 1)] else { continue };
            let (force, k) = piece.answer(a, b);
            for (at, row) in [(i, 0), (i + 1, 3)] {
                if let (Some(f), Some(d)) = (out.force.get_mut(at), out.diagonal.get_mut(at)) {
                    *f += force.fixed_rows::<3>(row);
                    *d += k.fixed_view::<3, 3>(row, row);
                    self.carry(nodes.get(at), piece.length / 2.0, f, d);
                }
            }
            if let Some(upper) = out.upper.get_mut(i) {
                upper.copy_from(&k.fixed_view::<3, 3>(0, 3));
            }
        }
    }

    /// What the bottom does to a node with so much pipe.
    fn carry(&self, node: Option<&Vector3<f64>>, length: f64, force: &mut Vector3<f64>, block: &mut Matrix3<f64>) {
        let (Some(bottom), Some(node)) = (self.bottom, node) else { return };
        let below = bottom.elevation - node.y;
        if below > 0.0 {
            force.y += bottom.stiffness * length * below;
            block[(1, 1)] += bottom.stiffness * length;
        }
    }

    /// Solves the stiffness for several right sides; held freedoms do not move. `None` of a singular one.
    pub fn solve(&self, k: &Assembled, right: &[Vec<Vector3<f64>>]) -> Option<Vec<Vec<Vector3<f64>>>> {
        let (mut diagonal, mut upper) = (k.diagonal.clone(), k.upper.clone());
        let mut solved = right.to_vec();
        for (node, freedom) in &self.held {
            let d = diagonal.get_mut(*node)?;
            d.fill_row(*freedom, 0.0);
            d.fill_column(*freedom, 0.0);
            d[(*freedom, *freedom)] = 1.0;
            if let Some(u) = upper.get_mut(*node) {
                u.fill_row(*freedom, 0.0);
            }
            if let Some(u) = node.checked_sub(1).and_then(|n| upper.get_mut(n)) {
                u.fill_column(*freedom, 0.0);
            }
            for side in &mut solved {
                side.get_mut(*node)?[*freedom] = 0.0;
            }
        }
        let mut inverse: Vec<Matrix3<f64>> = Vec::with_capacity(diagonal.len());
        for i in 0..diagonal.len() {
            let mut d = *diagonal.get(i)?;
            if let Some((before, u)) = i.checked_sub(1).and_then(|n| Some((*inverse.get(n)?, *upper.get(n)?))) {
                d -= u.transpose() * before * u;
                for side in &mut solved {
                    let carried = u.transpose() * before * *side.get(i - 1)?;
                    *side.get_mut(i)? -= carried;
                }
            }
            inverse.push(d.try_inverse()?);
        }
        for i in (0..diagonal.len()).rev() {
            for side in &mut solved {
                let after = match (upper.get(i), side.get(i + 1)) {
                    (Some(u), Some(next)) => u * next,
                    _ => Vector3::zeros(),
                };
                let at = side.get_mut(i)?;
                *at = inverse.get(i)? * (*at - after);
            }
        }
        solved.iter().flatten().all(|v| v.iter().all(|x| x.is_finite())).then_some(solved)
    }

    /// Brings the nodes to rest; `more` adds the forces and stiffness of what holds the pipe. Returns the steps, `None` where it
    /// did not come to rest within `most`.
    pub fn settle(
        &self,
        nodes: &mut Vec<Vector3<f64>>,
        most: usize,
        more: &mut dyn FnMut(&[Vector3<f64>], &mut Assembled),
    ) -> Option<usize> {
        /// Longest step (rad), and share of the element's length.
        const LONGEST: f64 = 0.2;
        let weight = self.pieces.iter().map(|p| (p.weight * p.length).abs()).fold(0.0, f64::max).max(1e-9);
        let size = self.pieces.iter().map(|p| p.length).fold(0.0, f64::max);
        let mut k = Assembled::default();
        let evaluate =
            |nodes: &[Vector3<f64>], k: &mut Assembled, more: &mut dyn FnMut(&[Vector3<f64>], &mut Assembled)| {
                self.assemble(nodes, k);
                more(nodes, k);
                for (node, freedom) in &self.held {
                    if let Some(f) = k.force.get_mut(*node) {
                        f[*freedom] = 0.0;
                    }
                }
                k.force.iter().map(|f| f.x.abs().max(f.y.abs()).max(f.z.abs() / size)).fold(0.0, f64::max)
            };
        let mut left = evaluate(nodes, &mut k, more);
        let mut help = 0.0;
        let mut tried = Assembled::default();
        for step in 0..most {
            if !left.is_finite() {
                return None;
            }
            let mut held = k.clone();
            if help > 0.0 {
                for d in &mut held.diagonal {
                    d[(0, 0)] += help;
                    d[(1, 1)] += help;
                    d[(2, 2)] += help * size * size;
                }
            }
            let Some(motion) = self.solve(&held, std::slice::from_ref(&k.force)).and_then(|mut s| s.pop()) else {
                help = (10.0 * help).max(1e-3 * weight / size);
                continue;
            };
            let work: f64 = motion.iter().zip(&k.force).map(|(m, f)| m.dot(f)).sum();
            let far =
                motion.iter().map(|m| (m.x.abs().max(m.y.abs()) / (10.0 * size)).max(m.z.abs())).fold(0.0, f64::max);
            if work < 0.0 {
                // not stable here: more of a step downhill
                help = (10.0 * help).max(1e-3 * weight / size);
                continue;
            }
            let mut share = (LONGEST / far.max(1e-300)).min(1.0);
            let mut taken = false;
            for _ in 0..12 {
                let moved: Vec<_> = nodes.iter().zip(&motion).map(|(n, m)| n + m * share).collect();
                let now = evaluate(&moved, &mut tried, more);
                let after: f64 = motion.iter().zip(&tried.force).map(|(m, f)| m.dot(f)).sum();
                if now.is_finite() && (now < left || after >= -0.5 * work.abs()) {
                    *nodes = moved;
                    std::mem::swap(&mut k, &mut tried);
                    help = if now < left { help * 0.2 } else { help };
                    let settled = share == 1.0 && far < 1e-9;
                    left = now;
                    taken = true;
                    if settled {
                        return Some(step + 1);
                    }
                    break;
                }
                share *= 0.4;
            }
            if !taken {
                if left <= 1e-7 * weight {
                    return Some(step);
                }
                help = (10.0 * help).max(1e-2 * weight / size);
            }
            if help < 1e-9 * weight / size {
                help = 0.0;
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn uniform(count: usize, piece: Piece) -> PlanarBeam {
        PlanarBeam { pieces: vec![piece; count], bottom: None, held: Vec::new() }
    }

    fn along_x(count: usize, length: f64) -> Vec<Vector3<f64>> {
        (0..=count).map(|i| Vector3::new(i as f64 * length, 0.0, 0.0)).collect()
    }

    /// Forces on the nodes without what holds them.
    fn forces(beam: &PlanarBeam, nodes: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
        let mut k = Assembled::default();
        beam.assemble(nodes, &mut k);
        k.force
    }

    #[test]
    fn the_stiffness_is_the_difference_of_the_forces() {
        let piece = Piece { length: 2.0, ea: 5e4, ei: 3e3, weight: 70.0 };
        let mut beam = uniform(2, piece);
        beam.bottom = Some(Foundation { elevation: 0.3, stiffness: 400.0 });
        let nodes = [Vector3::new(0.1, 0.2, 0.4), Vector3::new(1.7, 1.3, -0.2), Vector3::new(3.5, 1.1, 0.5)];
        let mut k = Assembled::default();
        beam.assemble(&nodes, &mut k);
        for column in 0..9 {
            let step = 1e-6;
            let at = |sign: f64| {
                let mut moved = nodes;
                moved[column / 3][column % 3] += sign * step;
                forces(&beam, &moved)
            };
            let (plus, minus) = (at(1.0), at(-1.0));
            for row in 0..9 {
                let slope = -(plus[row / 3][row % 3] - minus[row / 3][row % 3]) / (2.0 * step);
                let own = match (row / 3, column / 3) {
                    (a, b) if a == b => k.diagonal[a][(row % 3, column % 3)],
                    (a, b) if b == a + 1 => k.upper[a][(row % 3, column % 3)],
                    (a, b) if a == b + 1 => k.upper[b][(column % 3, row % 3)],
                    _ => 0.0,
                };
                assert!((slope - own).abs() < 1e-4 * 5e4_f64.max(own.abs()) * 1e-2, "{row} {column} {slope} {own}");
            }
        }
    }

    #[test]
    fn five_supports_share_a_uniform_load_as_the_three_moment_equation_says() {
        // deflection of a thousandth of the span: the beam is as good as straight
        let (span, each) = (10.0, 8);
        let piece = Piece { length: span / each as f64, ea: 1e8, ei: 1e7, weight: 100.0 };
        let mut beam = uniform(4 * each, piece);
        beam.held = (0..5).map(|i| (i * each, 1)).chain([(0, 0)]).collect();
        let mut nodes = along_x(4 * each, piece.length);
        beam.settle(&mut nodes, 100, &mut |_, _| {}).unwrap();
        let all = forces(&beam, &nodes);
        for (i, want) in [11.0 / 28.0, 32.0 / 28.0, 26.0 / 28.0, 32.0 / 28.0, 11.0 / 28.0].into_iter().enumerate() {
            let got = -all[i * each].y / (100.0 * span);
            assert!((got - want).abs() < 1e-5, "{i} {got} {want}");
        }
        // moments 3/28, 2/28, 3/28 w L2 over the inner supports
        for (i, want) in [(1, 3.0 / 28.0), (2, 2.0 / 28.0), (3, 3.0 / 28.0)] {
            let node = i * each;
            let got = beam.pieces[node].borne(&nodes[node], &nodes[node + 1]).moments[0] / (100.0 * span * span);
            assert!((got.abs() - want).abs() < 2e-3, "{i} {got} {want}");
        }
    }

    #[test]
    fn a_tensioned_beam_on_two_supports_sags_as_its_cosh_solution() {
        // EI z'''' - T z'' = -w, hinged: z(mid) = -w/(T k2) (k2 L2/8 - 1 + 1/cosh(kL/2)), k2 = T/EI
        let (span, count, tension, ei, w) = (40.0, 40, 4e5, 2e7, 50.0);
        let piece = Piece { length: span / f64::from(count), ea: 1e12, ei, weight: w };
        let mut beam = uniform(count as usize, piece);
        let last = count as usize;
        beam.held = vec![(0, 0), (0, 1), (last, 1)];
        let mut nodes = along_x(last, piece.length);
        beam.settle(&mut nodes, 200, &mut |_, k| k.force[last].x += tension).unwrap();
        let k2: f64 = tension / ei;
        let want = -w / (tension * k2) * (k2 * span * span / 8.0 - 1.0 + 1.0 / (k2.sqrt() * span / 2.0).cosh());
        let got = nodes[last / 2].y;
        // four elements a length sqrt(EI/T) make some 1e-4
        assert!((got / want - 1.0).abs() < 5e-4, "{got} {want}");
    }

    #[test]
    fn a_cantilever_bent_by_an_end_moment_is_a_circle() {
        let piece = Piece { length: 1.0, ea: 1e6, ei: 1e4, weight: 0.0 };
        let mut beam = uniform(20, piece);
        beam.held = vec![(0, 0), (0, 1), (0, 2)];
        let mut nodes = along_x(20, 1.0);
        let moment = 1e4 * std::f64::consts::PI / 20.0;
        beam.settle(&mut nodes, 500, &mut |_, k| k.force[20].z += moment).unwrap();
        let radius = 20.0 / std::f64::consts::PI;
        assert!(nodes[20].x.abs() < 1e-6, "{}", nodes[20]);
        // of chords of an arc, a polygon: the share (a/2)/sin(a/2) of the radius
        assert!((nodes[20].y / (2.0 * radius) - 1.0).abs() < 2e-3, "{}", nodes[20]);
        assert!((nodes[20].z - std::f64::consts::PI).abs() < 1e-6);
    }

    #[test]
    fn far_from_its_ends_a_laid_pipe_is_a_catenary() {
        // top pulled by T at the departure angle of the catenary; h w H; boundary layer sqrt(EI/H)
        let (w, height, horizontal, ei) = (1000.0_f64, 100.0_f64, 2e5_f64, 2e7);
        let a = horizontal / w;
        let arc = (height * height + 2.0 * height * a).sqrt();
        let (lay, count) = (100.0, 300);
        let piece = Piece { length: (arc + lay) / f64::from(count), ea: 1e11, ei, weight: w };
        let mut beam = uniform(count as usize, piece);
        beam.bottom = Some(Foundation { elevation: 0.0, stiffness: 100.0 * w });
        let last = count as usize;
        beam.held = vec![(0, 0), (0, 1), (last, 1)];
        let mut nodes: Vec<_> = (0..=last)
            .map(|i| {
                let s = (i as f64 * piece.length - lay).max(0.0);
                let flat = (i as f64 * piece.length).min(lay);
                Vector3::new(flat + a * (s / a).asinh(), (a * a + s * s).sqrt() - a, (s / a).atan())
            })
            .collect();
        beam.settle(&mut nodes, 500, &mut |_, k| k.force[last].x += horizontal).unwrap();
        // half way up, five boundary layers of 10 m from both ends: shape and slope by the catenary through its own height
        let middle = nodes.iter().position(|n| n.y > height / 2.0).unwrap();
        let (z, angle) = (nodes[middle].y, nodes[middle].z);
        let slope = ((1.0 + z / a).powi(2) - 1.0).sqrt();
        assert!((angle.tan() / slope - 1.0).abs() < 0.01, "{} {slope}", angle.tan());
        // tension there: H + w z
        let tension = beam.pieces[middle].borne(&nodes[middle], &nodes[middle + 1]).tension;
        assert!((tension / (horizontal + w * z) - 1.0).abs() < 0.01, "{tension}");
    }
}
