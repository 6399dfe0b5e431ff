//! The equations at one frequency: the wave part of the Green function, added to the Rankine part.

use crate::gmres::Columns;
use crate::green::{FiniteDepthTable, FrequencyPart, WavePartTable};
use crate::mesh::HullMesh;
use crate::panel::Panel;
use crate::rankine::{RankinePart, mirrored};
use crate::symmetry::{MAX_CLASSES, SymmetryClass};
use multiversion::multiversion;
use nalgebra::{Complex, Vector3};
use rayon::prelude::*;

type C = Complex<f64>;

/// Rows of one block: so many panels are worked on together.
const BLOCK: usize = 64;
/// Vectors that go through the matrix side by side: six motions and two headings.
const LANES: usize = 8;
/// Distance from the image of a panel, in its diagonals, within which the wave part is taken at four points.
const NEAR_DIAGONALS: f64 = 3.0;

/// The system of a symmetry class: matrix and right sides of the radiation problems.
#[derive(Clone, Debug)]
pub struct WaveSystem {
    count: usize,
    /// Row by row, real and imaginary parts.
    matrix: Vec<Complex<f32>>,
    /// Right sides of the motions of the class.
    pub radiation: Columns,
}

/// What one panel does to another, and the other to it, by an image: the potential of a unit source density and the derivative along the
/// normal out of the water, over the panel.
#[derive(Clone, Copy, Default)]
struct Pair {
    potential: [C; 2],
    derivative: [C; 2],
}

/// The part of the Green function that depends on the frequency.
pub struct WaveKernel {
    nu: f64,
    deep: &'static WavePartTable,
    bottom: Option<FiniteDepthTable>,
}

impl WaveKernel {
    /// That of `nu = omega2/g` (1/m), over points at most `reach` (m) apart horizontally and `draught` (m) deep.
    pub fn new(nu: f64, depth: Option<f64>, reach: f64, draught: f64) -> Self {
        let bottom = depth.map(|depth| FiniteDepthTable::new(nu, depth, reach, draught));
        WaveKernel { nu, deep: WavePartTable::shared(), bottom }
    }

    /// The wave number of the propagating wave (1/m).
    pub fn wave_number(&self) -> f64 {
        self.bottom.as_ref().map_or(self.nu, FiniteDepthTable::wave_number)
    }

    /// Of the wave far away: `nu` in deep water, with the depth `k/(k h sech2(k h) + tanh(k h))` (1/m).
    pub fn amplitude(&self) -> f64 {
        self.bottom.as_ref().map_or(self.nu, FiniteDepthTable::amplitude)
    }

    fn part(&self, distance: f64, heights: [f64; 2]) -> FrequencyPart {
        match &self.bottom {
            None => FrequencyPart::in_deep_water(self.deep, self.nu, distance, heights),
            Some(bottom) => bottom.evaluate(self.deep, distance, heights),
        }
    }

    /// Over a panel at four points: the potential, and the derivative along its normal into the water.
    fn over_points(&self, from: &Vector3<f64>, panel: &Panel) -> (C, C) {
        panel.rule().iter().fold((C::default(), C::default()), |(potential, derivative), (point, area)| {
            let (dx, dy) = (point.x - from.x, point.y - from.y);
            let distance = (dx * dx + dy * dy).sqrt();
            let part = self.part(distance, [from.z, point.z]);
            let normal = &panel.normal;
            let across = if distance > 0.0 { (dx * normal.x + dy * normal.y) / distance } else { 0.0 };
            let by_normal = part.by_distance * across + part.by_heights[1] * normal.z;
            (potential + part.value * *area, derivative + by_normal * *area)
        })
    }

    fn is_near(from: &Vector3<f64>, panel: &Panel) -> bool {
        let arm = panel.centroid - from;
        let above = panel.centroid.z + from.z;
        arm.x * arm.x + arm.y * arm.y + above * above < (NEAR_DIAGONALS * panel.diagonal).powi(2)
    }

    /// Both ways between two panels: the second seen from an image of the first, and the first from that image of the second.
    fn pair(&self, one: &Panel, other: &Panel, image: [f64; 2]) -> Pair {
        let (from, back) = (mirrored(&one.centroid, image), mirrored(&other.centroid, image));
        if Self::is_near(&from, other) || Self::is_near(&back, one) {
            let (to, to_slope) = self.over_points(&from, other);
            let (fro, fro_slope) = self.over_points(&back, one);
            return Pair { potential: [to, fro], derivative: [-to_slope, -fro_slope] };
        }
        let (dx, dy) = (other.centroid.x - from.x, other.centroid.y - from.y);
        let distance = (dx * dx + dy * dy).sqrt();
        let part = self.part(distance, [one.centroid.z, other.centroid.z]);
        let unit = if distance > 0.0 { [dx / distance, dy / distance] } else { [0.0; 2] };
        // seen from the other side the arm is the mirrored one, turned round
        let across = unit[0] * other.normal.x + unit[1] * other.normal.y;
        let across_back = -(image[0] * unit[0] * one.normal.x + image[1] * unit[1] * one.normal.y);
        let derivative = |across: f64, by_height: C, panel: &Panel| {
            -(part.by_distance * across + by_height * panel.normal.z) * panel.area
        };
        Pair {
            potential: [part.value * other.area, part.value * one.area],
            derivative: [
                derivative(across, part.by_heights[1], other),
                derivative(across_back, part.by_heights[0], one),
            ],
        }
    }
}

/// What a block of panels and another do to each other, class by class.
struct BlockPair {
    blocks: [usize; 2],
    classes: Vec<ClassPair>,
}

/// The same for one class: entries of the matrix and parts of the right sides, both ways.
struct ClassPair {
    entries: [Vec<Complex<f32>>; 2],
    sides: [Vec<C>; 2],
}

/// The systems of all classes at a frequency.
pub fn wave_systems(
    kernel: &WaveKernel,
    mesh: &HullMesh,
    classes: &[SymmetryClass],
    velocities: &[Vec<f64>],
    rankine: &[RankinePart],
) -> Vec<WaveSystem> {
    let count = mesh.panels().len();
    let hull = mesh.hull_count();
    // on the lid the derivative along the normal, which points down, is -nu times the potential
    let lid_factor = kernel.nu as f32;
    let blocks = count.div_ceil(BLOCK);
    let pairs: Vec<[usize; 2]> = (0..blocks).flat_map(|i| (i..blocks).map(move |j| [i, j])).collect();
    let mut systems: Vec<WaveSystem> = rankine
        .iter()
        .map(|part| {
            let motions = part.single_layer.len() / count;
            let mut radiation = Columns::zeros(count, motions);
            for motion in 0..motions {
                for (value, part) in
                    radiation.column_mut(motion).iter_mut().zip(part.single_layer.iter().skip(motion).step_by(motions))
                {
                    *value = C::new(*part, 0.0);
                }
            }
            let mut matrix: Vec<_> = part.double_layer.iter().map(|re| Complex::new(*re, 0.0)).collect();
            for (i, row) in matrix.chunks_exact_mut(count).enumerate() {
                for entry in row.iter_mut().skip(hull) {
                    *entry *= lid_factor;
                }
                row[i] += if i < hull { 2.0 * std::f32::consts::PI } else { 4.0 * std::f32::consts::PI };
            }
            WaveSystem { count, matrix, radiation }
        })
        .collect();
    // so many pairs at a time that what waits to be added stays small
    for some in pairs.chunks(4 * rayon::current_num_threads().max(1)) {
        let made: Vec<BlockPair> =
            some.par_iter().map(|blocks| block_pair(kernel, mesh, classes, velocities, *blocks)).collect();
        for pair in made {
            for (system, class) in systems.iter_mut().zip(pair.classes) {
                system.add(pair.blocks, &class);
            }
        }
    }
    systems
}

fn block_pair(
    kernel: &WaveKernel,
    mesh: &HullMesh,
    classes: &[SymmetryClass],
    velocities: &[Vec<f64>],
    blocks: [usize; 2],
) -> BlockPair {
    let panels = mesh.panels();
    let hull = mesh.hull_count();
    let images = mesh.mirrors().images();
    let [rows, columns] = blocks.map(|block| block * BLOCK..((block + 1) * BLOCK).min(panels.len()));
    let sizes = [rows.len(), columns.len()];
    let motions: Vec<usize> = velocities.iter().map(|v| v.len() / panels.len()).collect();
    let mut made: Vec<ClassPair> = motions
        .iter()
        .map(|motions| {
            let entries = || vec![Complex::default(); sizes[0] * sizes[1]];
            ClassPair {
                entries: [entries(), entries()],
                sides: [vec![C::default(); sizes[0] * motions], vec![C::default(); sizes[1] * motions]],
            }
        })
        .collect();
    for (row, i) in rows.clone().enumerate() {
        for (column, j) in columns.clone().enumerate() {
            if blocks[0] == blocks[1] && j < i {
                continue;
            }
            let mut sums = [Pair::default(); MAX_CLASSES];
            for image in &images {
                let pair = kernel.pair(&panels[i], &panels[j], *image);
                for (class, sum) in classes.iter().zip(&mut sums) {
                    let factor = class.factor(*image);
                    for way in 0..2 {
                        sum.potential[way] += pair.potential[way] * factor;
                        sum.derivative[way] += pair.derivative[way] * factor;
                    }
                }
            }
            for (index, sum) in sums.iter().take(classes.len()).enumerate() {
                let narrow = |value: C| Complex::new(value.re as f32, value.im as f32);
                // on the lid the derivative is that of the condition at the surface
                let by_normal = |way: usize, source: usize| {
                    if source < hull { sum.derivative[way] } else { sum.potential[way] * kernel.nu }
                };
                let ClassPair { entries, sides } = &mut made[index];
                let count = motions[index];
                entries[0][row * sizes[1] + column] = narrow(by_normal(0, j));
                entries[1][column * sizes[0] + row] = narrow(by_normal(1, i));
                for motion in 0..count {
                    sides[0][row * count + motion] += sum.potential[0] * velocities[index][j * count + motion];
                    if i != j {
                        sides[1][column * count + motion] += sum.potential[1] * velocities[index][i * count + motion];
                    }
                }
            }
        }
    }
    if blocks[0] == blocks[1] {
        // one block: what was found both ways stands in one square
        for ClassPair { entries, .. } in &mut made {
            let size = sizes[0];
            for row in 0..size {
                for column in 0..row {
                    entries[0][row * size + column] = entries[1][row * size + column];
                }
            }
        }
    }
    BlockPair { blocks, classes: made }
}

impl WaveSystem {
    fn add(&mut self, blocks: [usize; 2], ClassPair { entries, sides }: &ClassPair) {
        let motions = self.radiation.count();
        let ways: &[usize] = if blocks[0] == blocks[1] { &[0] } else { &[0, 1] };
        for way in ways {
            let (first_row, first_column) = (blocks[*way] * BLOCK, blocks[1 - *way] * BLOCK);
            let width = (first_column + BLOCK).min(self.count) - first_column;
            for (row, values) in entries[*way].chunks_exact(width).enumerate() {
                let start = (first_row + row) * self.count + first_column;
                for (entry, value) in self.matrix[start..start + width].iter_mut().zip(values) {
                    *entry += value;
                }
            }
        }
        for way in 0..2 {
            let first = blocks[way] * BLOCK;
            for (index, value) in sides[way].iter().enumerate() {
                let (row, motion) = (first + index / motions, index % motions);
                self.radiation.column_mut(motion)[row] += value;
            }
        }
    }

    /// The products of the matrix with vectors.
    pub fn multiply(&self, vectors: &Columns) -> Columns {
        let mut made = Columns::zeros(self.count, vectors.count());
        for first in (0..vectors.count()).step_by(LANES) {
            let lanes = first..(first + LANES).min(vectors.count());
            let packed: Vec<[[f64; LANES]; 2]> = (0..self.count)
                .map(|panel| {
                    let mut parts = [[0.0; LANES]; 2];
                    for (lane, column) in lanes.clone().enumerate() {
                        let value = vectors.column(column)[panel];
                        (parts[0][lane], parts[1][lane]) = (value.re, value.im);
                    }
                    parts
                })
                .collect();
            let products: Vec<[[f64; LANES]; 2]> = self
                .matrix
                .par_chunks(self.count * BLOCK)
                .flat_map_iter(|rows| {
                    let mut products = vec![[[0.0; LANES]; 2]; rows.len() / self.count];
                    multiply_rows(rows, &packed, &mut products);
                    products
                })
                .collect();
            for (lane, column) in lanes.enumerate() {
                for (value, [re, im]) in made.column_mut(column).iter_mut().zip(&products) {
                    *value = C::new(re[lane], im[lane]);
                }
            }
        }
        made
    }
}

/// The products of rows of a matrix with vectors side by side, real and imaginary parts apart. Compiled for several widths of vector register;
/// no product is contracted with its sum, so all give the same digits.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn multiply_rows(rows: &[Complex<f32>], vectors: &[[[f64; LANES]; 2]], products: &mut [[[f64; LANES]; 2]]) {
    let count = vectors.len();
    for (pair, products) in rows.chunks(2 * count).zip(products.chunks_mut(2)) {
        let (one, other) = pair.split_at(count);
        if let [first, second] = products {
            let mut sums = [[[0.0; LANES]; 2]; 2];
            for ((a, b), [re, im]) in one.iter().zip(other).zip(vectors) {
                let [a_re, a_im, b_re, b_im] = [a.re, a.im, b.re, b.im].map(f64::from);
                for lane in 0..LANES {
                    sums[0][0][lane] += a_re * re[lane] - a_im * im[lane];
                    sums[0][1][lane] += a_re * im[lane] + a_im * re[lane];
                    sums[1][0][lane] += b_re * re[lane] - b_im * im[lane];
                    sums[1][1][lane] += b_re * im[lane] + b_im * re[lane];
                }
            }
            [*first, *second] = sums;
        } else if let [last] = products {
            for (a, [re, im]) in one.iter().zip(vectors) {
                let [a_re, a_im] = [a.re, a.im].map(f64::from);
                for lane in 0..LANES {
                    last[0][lane] += a_re * re[lane] - a_im * im[lane];
                    last[1][lane] += a_re * im[lane] + a_im * re[lane];
                }
            }
        }
    }
}
