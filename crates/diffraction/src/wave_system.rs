//! The equations at one frequency: the wave part of the Green function, added to the Rankine part.

use crate::gmres::Columns;
use crate::green::{FiniteDepthTable, FrequencyPart, WavePart, WavePartBatch, WavePartTable};
use crate::mesh::HullMesh;
use crate::panel::Panel;
use crate::rankine::{RankinePart, mirrored};
use crate::symmetry::SymmetryClass;
use multiversion::multiversion;
use nalgebra::{Complex, Vector3};
use rayon::prelude::*;
use std::ops::Range;

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

    /// The potential over a panel, and the derivative along its normal into the water: at its centroid, or near its image at four points.
    pub fn over_panel(&self, from: &Vector3<f64>, panel: &Panel) -> (C, C) {
        let arm = panel.centroid - from;
        let above = panel.centroid.z + from.z;
        let distance2 = arm.x * arm.x + arm.y * arm.y;
        if distance2 + above * above < (NEAR_DIAGONALS * panel.diagonal).powi(2) {
            return self.over_points(from, panel);
        }
        self.over_point(from, panel, &panel.centroid, panel.area)
    }

    /// Over a panel at four points: the potential, and the derivative along its normal into the water.
    fn over_points(&self, from: &Vector3<f64>, panel: &Panel) -> (C, C) {
        panel.rule().iter().fold((C::default(), C::default()), |(potential, derivative), (point, area)| {
            let (value, by_normal) = self.over_point(from, panel, point, *area);
            (potential + value, derivative + by_normal)
        })
    }

    /// As [`WaveKernel::over_points`] of many panels, each seen from a point of its own.
    fn over_points_batch(&self, views: &[(Vector3<f64>, &Panel)]) -> Vec<(C, C)> {
        let points = || views.iter().flat_map(|(from, panel)| panel.rule().iter().map(move |(at, _)| (from, at)));
        let distance = |(from, at): (&Vector3<f64>, &Vector3<f64>)| {
            let (dx, dy) = (at.x - from.x, at.y - from.y);
            (dx * dx + dy * dy).sqrt()
        };
        let x: Vec<f64> = points().map(|pair| self.nu * distance(pair)).collect();
        let y: Vec<f64> = points().map(|(from, at)| -self.nu * (from.z + at.z)).collect();
        let mut batch = WavePartBatch::default();
        self.deep.evaluate_batch(&x, &y, &mut batch);
        let part = |index: usize| WavePart {
            value: C::new(batch.re[index], batch.im[index]),
            by_x: C::new(batch.re_by_x[index], batch.im_by_x[index]),
        };
        views
            .iter()
            .enumerate()
            .map(|(view, (from, panel))| {
                let mut sums = (C::default(), C::default());
                for (i, (point, area)) in panel.rule().iter().enumerate() {
                    let index = view * panel.rule().len() + i;
                    let found = FrequencyPart::from_wave_part(part(index), self.nu, [x[index], y[index]]);
                    let distance = distance((from, point));
                    let found = match &self.bottom {
                        None => found,
                        Some(bottom) => bottom.correct(found, distance, [from.z, point.z]),
                    };
                    let (value, by_normal) = Self::on_panel(&found, from, panel, point);
                    sums = (sums.0 + value * *area, sums.1 + by_normal * *area);
                }
                sums
            })
            .collect()
    }

    fn over_point(&self, from: &Vector3<f64>, panel: &Panel, point: &Vector3<f64>, area: f64) -> (C, C) {
        let (dx, dy) = (point.x - from.x, point.y - from.y);
        let distance = (dx * dx + dy * dy).sqrt();
        let part = self.part(distance, [from.z, point.z]);
        let (value, by_normal) = Self::on_panel(&part, from, panel, point);
        (value * area, by_normal * area)
    }

    /// The potential at a point of a panel, and the derivative along its normal into the water.
    fn on_panel(part: &FrequencyPart, from: &Vector3<f64>, panel: &Panel, point: &Vector3<f64>) -> (C, C) {
        let (dx, dy) = (point.x - from.x, point.y - from.y);
        let distance = (dx * dx + dy * dy).sqrt();
        let normal = &panel.normal;
        let across = if distance > 0.0 { (dx * normal.x + dy * normal.y) / distance } else { 0.0 };
        (part.value, part.by_distance * across + part.by_heights[1] * normal.z)
    }
}

/// What a block of panels and another do to each other, class by class.
struct BlockPair {
    blocks: [usize; 2],
    classes: Vec<ClassPair>,
}

/// The same for one class: entries of the matrix and parts of the right sides, of the first block and of the second.
struct ClassPair {
    /// Both by rows of the first block.
    entries: [Vec<Complex<f32>>; 2],
    /// Panel by panel and then motion by motion.
    sides: [Vec<C>; 2],
}

/// The panels, quantity by quantity.
struct PanelArrays {
    /// Centroids (m), x, y and z.
    centroid: [Vec<f64>; 3],
    /// Area times the normal into the water, zero of the lid (m2).
    area_vector: [Vec<f64>; 3],
    /// Of panels of the lid `nu` times the area, zero of the hull (m).
    lid: Vec<f64>,
    /// Square of the distance within which the wave part is taken at four points (m2).
    near: Vec<f64>,
    /// Of each class: velocities times areas, panel by panel and then motion by motion.
    fluxes: Vec<Vec<f64>>,
}

impl PanelArrays {
    fn new(mesh: &HullMesh, nu: f64, velocities: &[Vec<f64>]) -> Self {
        let panels = mesh.panels();
        let hull = mesh.hull_count();
        let centroid = [0, 1, 2].map(|axis| panels.iter().map(|panel| panel.centroid[axis]).collect());
        let area_vector = [0, 1, 2].map(|axis| {
            let of_hull = |(i, panel): (usize, &Panel)| if i < hull { panel.area * panel.normal[axis] } else { 0.0 };
            panels.iter().enumerate().map(of_hull).collect()
        });
        let lid = panels.iter().enumerate().map(|(i, panel)| if i < hull { 0.0 } else { nu * panel.area }).collect();
        let near = panels.iter().map(|panel| (NEAR_DIAGONALS * panel.diagonal).powi(2)).collect();
        let fluxes = velocities
            .iter()
            .map(|velocities| {
                let motions = velocities.len() / panels.len();
                velocities.iter().enumerate().map(|(i, v)| v * panels[i / motions.max(1)].area).collect()
            })
            .collect();
        PanelArrays { centroid, area_vector, lid, near, fluxes }
    }
}

/// The frequency's part of the Green function between the panels of two blocks, row by row; real and imaginary parts.
#[derive(Default)]
struct BlockKernel {
    value: [Vec<f64>; 2],
    by_distance: [Vec<f64>; 2],
    /// By the height of the panel of the first block, and of the second.
    by_heights: [[Vec<f64>; 2]; 2],
    /// Horizontal unit vector from the first to the second.
    direction: [Vec<f64>; 2],
    /// Panels too near each other's image for one point.
    near: Vec<[usize; 2]>,
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
    let mut systems: Vec<WaveSystem> =
        rankine.iter().map(|part| WaveSystem::from_rankine(part, count, hull, lid_factor)).collect();
    let arrays = PanelArrays::new(mesh, kernel.nu, velocities);
    // so many pairs at a time that what waits to be added stays small
    for some in pairs.chunks(4 * rayon::current_num_threads().max(1)) {
        let made: Vec<BlockPair> =
            some.par_iter().map(|blocks| block_pair(kernel, mesh, classes, &arrays, *blocks)).collect();
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
    arrays: &PanelArrays,
    blocks: [usize; 2],
) -> BlockPair {
    let panels = mesh.panels();
    let [rows, columns] = blocks.map(|block| block * BLOCK..((block + 1) * BLOCK).min(panels.len()));
    let width = columns.len();
    let size = rows.len() * width;
    // within one block each panel is a row, and the other way is the same once more
    let ways = if blocks[0] == blocks[1] { 1 } else { 2 };
    let motions: Vec<usize> = arrays.fluxes.iter().map(|fluxes| fluxes.len() / panels.len()).collect();
    let mut made: Vec<ClassPair> = motions
        .iter()
        .map(|motions| ClassPair {
            entries: [vec![Complex::default(); size], vec![Complex::default(); if ways == 2 { size } else { 0 }]],
            sides: [vec![C::default(); rows.len() * motions], vec![C::default(); width * motions]],
        })
        .collect();
    for image in mesh.mirrors().images() {
        let mut block = kernel.over_block(arrays, &rows, &columns, image);
        let derivatives = [
            block.derivatives(arrays, &rows, &columns, [1.0; 2], 0),
            if ways == 2 { block.derivatives(arrays, &rows, &columns, image, 1) } else { Default::default() },
        ];
        let near_pairs = std::mem::take(&mut block.near);
        let views: Vec<_> = near_pairs
            .iter()
            .flat_map(|[i, j]| [(i, j), (j, i)])
            .map(|(from, to)| (mirrored(&panels[*from].centroid, image), &panels[*to]))
            .collect();
        let near: Vec<_> = near_pairs
            .iter()
            .zip(kernel.over_points_batch(&views).chunks_exact(2))
            .map(|([i, j], parts)| ([i - rows.start, j - columns.start], [*i, *j], [parts[0], parts[1]]))
            .collect();
        for ((class, made), (fluxes, motions)) in
            classes.iter().zip(&mut made).zip(arrays.fluxes.iter().zip(motions.iter().copied()))
        {
            let factor = class.factor(image);
            for (entries, [re, im]) in made.entries.iter_mut().zip(&derivatives) {
                for ((entry, re), im) in entries.iter_mut().zip(re).zip(im) {
                    *entry += Complex::new((factor * re) as f32, (factor * im) as f32);
                }
            }
            let [first, second] = [&rows, &columns].map(|range| &fluxes[range.start * motions..range.end * motions]);
            add_sides(&block.value, width, second, factor, &mut made.sides[0], false);
            if ways == 2 {
                add_sides(&block.value, width, first, factor, &mut made.sides[1], true);
            }
            for ([row, column], indices, parts) in &near {
                for way in 0..ways {
                    let (own, source) = ([row, column][way], indices[1 - way]);
                    let (potential, derivative) = parts[way];
                    // on the lid the derivative is that of the condition at the surface
                    let by_normal = if source < mesh.hull_count() { -derivative } else { potential * kernel.nu };
                    made.entries[way][row * width + column] +=
                        Complex::new((factor * by_normal.re) as f32, (factor * by_normal.im) as f32);
                    let area = panels[source].area;
                    for motion in 0..motions {
                        made.sides[way][own * motions + motion] +=
                            potential * (factor * fluxes[source * motions + motion] / area);
                    }
                }
            }
        }
    }
    BlockPair { blocks, classes: made }
}

/// Adds to right sides the potentials of the fluxes of the other block: of rows of the kernel, or turned of its columns. Compiled as
/// [`multiply_rows`].
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn add_sides(values: &[Vec<f64>; 2], width: usize, fluxes: &[f64], factor: f64, sides: &mut [C], turned: bool) {
    let height = values[0].len() / width;
    let (count, others) = if turned { (width, height) } else { (height, width) };
    let motions = fluxes.len() / others;
    for first in (0..motions).step_by(LANES) {
        let lanes = (first + LANES).min(motions) - first;
        let packed: Vec<[f64; LANES]> = (0..others)
            .map(|other| {
                let own = &fluxes[other * motions + first..][..lanes];
                std::array::from_fn(|lane| own.get(lane).map_or(0.0, |flux| factor * flux))
            })
            .collect();
        for own in 0..count {
            let (start, step) = if turned { (own, width) } else { (own * width, 1) };
            let [re, im] = [&values[0], &values[1]].map(|part| part[start..].iter().step_by(step));
            let mut sums = [[0.0; LANES]; 2];
            for ((re, im), fluxes) in re.zip(im).zip(&packed) {
                for lane in 0..LANES {
                    sums[0][lane] += re * fluxes[lane];
                    sums[1][lane] += im * fluxes[lane];
                }
            }
            for lane in 0..lanes {
                sides[own * motions + first + lane] += C::new(sums[0][lane], sums[1][lane]);
            }
        }
    }
}

impl WaveKernel {
    /// Between the centroids of two blocks, the first seen in a mirror.
    fn over_block(
        &self,
        arrays: &PanelArrays,
        rows: &Range<usize>,
        columns: &Range<usize>,
        image: [f64; 2],
    ) -> BlockKernel {
        let size = rows.len() * columns.len();
        let mut made = BlockKernel::default();
        let (mut x, mut y, mut distances) = (Vec::new(), Vec::new(), Vec::new());
        let [xs, ys, zs] = &arrays.centroid;
        let [along, across] = &mut made.direction;
        for part in [&mut x, &mut y, &mut distances, along, across] {
            part.resize(size, 0.0);
        }
        let others = ColumnPoints {
            x: &xs[columns.clone()],
            y: &ys[columns.clone()],
            z: &zs[columns.clone()],
            near: &arrays.near[columns.clone()],
        };
        let width = columns.len();
        for (row, i) in rows.clone().enumerate() {
            let own = row * width..(row + 1) * width;
            let from = [image[0] * xs[i], image[1] * ys[i], zs[i], arrays.near[i]];
            let out = [
                &mut x[own.clone()],
                &mut y[own.clone()],
                &mut distances[own.clone()],
                &mut along[own.clone()],
                &mut across[own.clone()],
            ];
            others.seen_from(from, self.nu, out);
            made.near.extend(y[own].iter().zip(columns.clone()).filter(|(y, _)| **y < 0.0).map(|(_, j)| [i, j]));
        }
        // what is near is taken elsewhere
        for [i, j] in &made.near {
            let at = (i - rows.start) * width + j - columns.start;
            (x[at], y[at]) = (1.0, 1.0);
        }
        let mut batch = WavePartBatch::default();
        self.deep.evaluate_batch(&x, &y, &mut batch);
        let (nu, square) = (self.nu, self.nu * self.nu);
        let height: Vec<f64> =
            x.iter().zip(&y).zip(&batch.re).map(|((x, y), re)| square * (re + 2.0 / (x * x + y * y).sqrt())).collect();
        let scaled = |part: Vec<f64>, factor: f64| -> Vec<f64> { part.into_iter().map(|v| v * factor).collect() };
        let im_by_height = scaled(batch.im.clone(), square);
        made.value = [scaled(batch.re, nu), scaled(batch.im, nu)];
        made.by_distance = [scaled(batch.re_by_x, square), scaled(batch.im_by_x, square)];
        made.by_heights = [[height.clone(), im_by_height.clone()], [height, im_by_height]];
        if let Some(bottom) = &self.bottom {
            for (row, i) in rows.clone().enumerate() {
                for (column, j) in columns.clone().enumerate() {
                    let at = row * columns.len() + column;
                    let deep = made.part(at);
                    made.set(at, bottom.correct(deep, distances[at], [zs[i], zs[j]]));
                }
            }
        }
        for [i, j] in std::mem::take(&mut made.near) {
            made.set((i - rows.start) * columns.len() + j - columns.start, FrequencyPart::default());
            made.near.push([i, j]);
        }
        made
    }
}

impl BlockKernel {
    fn part(&self, at: usize) -> FrequencyPart {
        let of = |[re, im]: &[Vec<f64>; 2]| C::new(re[at], im[at]);
        FrequencyPart {
            value: of(&self.value),
            by_distance: of(&self.by_distance),
            by_heights: [of(&self.by_heights[0]), of(&self.by_heights[1])],
        }
    }

    fn set(&mut self, at: usize, part: FrequencyPart) {
        let [first, second] = &mut self.by_heights;
        for ([re, im], value) in [
            (&mut self.value, part.value),
            (&mut self.by_distance, part.by_distance),
            (first, part.by_heights[0]),
            (second, part.by_heights[1]),
        ] {
            (re[at], im[at]) = (value.re, value.im);
        }
    }

    /// The derivatives along the normals out of the water over the panels of the second block (way 0), or over those of the first (way 1),
    /// seen from the other; `signs` are those of the direction. Row by row of the first block.
    fn derivatives(
        &self,
        arrays: &PanelArrays,
        rows: &Range<usize>,
        columns: &Range<usize>,
        signs: [f64; 2],
        way: usize,
    ) -> [Vec<f64>; 2] {
        let by_height = &self.by_heights[1 - way];
        [0, 1].map(|part| {
            let mut made = vec![0.0; self.value[part].len()];
            let width = columns.len();
            for (row, i) in rows.clone().enumerate() {
                let own = row * width..(row + 1) * width;
                let kernel = KernelRow {
                    value: &self.value[part][own.clone()],
                    by_distance: &self.by_distance[part][own.clone()],
                    by_height: &by_height[part][own.clone()],
                    direction: [&self.direction[0][own.clone()], &self.direction[1][own.clone()]],
                };
                let out = &mut made[own];
                if way == 0 {
                    let vectors = [0, 1, 2].map(|axis| &arrays.area_vector[axis][columns.clone()]);
                    kernel.toward_columns(vectors, &arrays.lid[columns.clone()], out);
                } else {
                    // seen from the other side the arm is the mirrored one, turned round
                    let [x, y, z] = [0, 1, 2].map(|axis| arrays.area_vector[axis][i]);
                    kernel.toward_row([-signs[0] * x, -signs[1] * y, z], arrays.lid[i], out);
                }
            }
            made
        })
    }
}

/// Centroids of the second block, and how near they are too near.
struct ColumnPoints<'a> {
    x: &'a [f64],
    y: &'a [f64],
    z: &'a [f64],
    near: &'a [f64],
}

impl ColumnPoints<'_> {
    /// From a point x, y, z that is too near within the root of its fourth number: X, Y, the horizontal distance, and the unit vector along
    /// it. Y is -1 where it is too near.
    fn seen_from(&self, [px, py, pz, near]: [f64; 4], nu: f64, out: [&mut [f64]; 5]) {
        let count = self.x.len();
        let (xs, ys, zs, nears) = (&self.x[..count], &self.y[..count], &self.z[..count], &self.near[..count]);
        let [x, y, distances, along, across] = out.map(|part| &mut part[..count]);
        for j in 0..count {
            let (dx, dy, above) = (xs[j] - px, ys[j] - py, pz + zs[j]);
            let distance2 = dx * dx + dy * dy;
            let distance = distance2.sqrt();
            let over = if distance > 0.0 { 1.0 / distance } else { 0.0 };
            let is_near = distance2 + above * above < near.max(nears[j]);
            x[j] = nu * distance;
            y[j] = if is_near { -1.0 } else { -nu * above };
            distances[j] = distance;
            along[j] = dx * over;
            across[j] = dy * over;
        }
    }
}

/// A row of a block.
struct KernelRow<'a> {
    value: &'a [f64],
    by_distance: &'a [f64],
    by_height: &'a [f64],
    direction: [&'a [f64]; 2],
}

impl KernelRow<'_> {
    fn toward_columns(&self, [x, y, z]: [&[f64]; 3], lid: &[f64], out: &mut [f64]) {
        let count = out.len();
        let (value, by_distance, by_height) =
            (&self.value[..count], &self.by_distance[..count], &self.by_height[..count]);
        let (along, across) = (&self.direction[0][..count], &self.direction[1][..count]);
        let (x, y, z, lid) = (&x[..count], &y[..count], &z[..count], &lid[..count]);
        for j in 0..count {
            let normal = along[j] * x[j] + across[j] * y[j];
            out[j] = value[j] * lid[j] - by_distance[j] * normal - by_height[j] * z[j];
        }
    }

    fn toward_row(&self, [x, y, z]: [f64; 3], lid: f64, out: &mut [f64]) {
        let count = out.len();
        let (value, by_distance, by_height) =
            (&self.value[..count], &self.by_distance[..count], &self.by_height[..count]);
        let (along, across) = (&self.direction[0][..count], &self.direction[1][..count]);
        for j in 0..count {
            let normal = along[j] * x + across[j] * y;
            out[j] = value[j] * lid - by_distance[j] * normal - by_height[j] * z;
        }
    }
}

impl WaveSystem {
    /// The part that does not depend on the frequency; `lid_factor` is `nu` (1/m).
    pub fn from_rankine(part: &RankinePart, count: usize, hull: usize, lid_factor: f32) -> Self {
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
    }

    fn add(&mut self, blocks: [usize; 2], ClassPair { entries, sides }: &ClassPair) {
        let motions = self.radiation.count();
        let [rows, columns] = blocks.map(|block| block * BLOCK..((block + 1) * BLOCK).min(self.count));
        let width = columns.len();
        for (row, values) in rows.clone().zip(entries[0].chunks_exact(width)) {
            for (entry, value) in self.matrix[row * self.count..][columns.clone()].iter_mut().zip(values) {
                *entry += value;
            }
        }
        for (row, column) in columns.clone().zip(0..if entries[1].is_empty() { 0 } else { width }) {
            let values = entries[1].iter().skip(column).step_by(width);
            for (entry, value) in self.matrix[row * self.count..][rows.clone()].iter_mut().zip(values) {
                *entry += value;
            }
        }
        for (range, sides) in [rows, columns].into_iter().zip(sides) {
            for (index, value) in sides.iter().enumerate() {
                self.radiation.column_mut(index % motions)[range.start + index / motions] += value;
            }
        }
    }

    /// The products of the matrix with vectors.
    pub fn multiply(&self, vectors: &Columns, accuracy: Accuracy) -> Columns {
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
            let narrow: Vec<[f32; 2 * LANES]> = if accuracy == Accuracy::Rough {
                packed.iter().map(|[re, im]| std::array::from_fn(|i| [re, im][i / LANES][i % LANES] as f32)).collect()
            } else {
                Vec::new()
            };
            let products: Vec<[[f64; LANES]; 2]> = self
                .matrix
                .par_chunks(self.count * BLOCK)
                .flat_map_iter(|rows| {
                    let mut products = vec![[[0.0; LANES]; 2]; rows.len() / self.count];
                    match accuracy {
                        Accuracy::Full => multiply_rows(rows, &packed, &mut products),
                        Accuracy::Rough => multiply_rows_roughly(rows, &narrow, &mut products),
                    }
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

/// How products of the matrix are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Accuracy {
    /// In double precision.
    Full,
    /// Products in single precision, their sums in double precision after every block: to 1e-7 of the largest.
    Rough,
}

/// As [`multiply_rows`] to single precision, real parts of the vectors before their imaginary parts.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn multiply_rows_roughly(rows: &[Complex<f32>], vectors: &[[f32; 2 * LANES]], products: &mut [[[f64; LANES]; 2]]) {
    let count = vectors.len();
    for (pair, products) in rows.chunks(2 * count).zip(products.chunks_mut(2)) {
        let (one, other) = pair.split_at(count);
        // a row that is left over goes with itself
        let other = if other.is_empty() { one } else { other };
        let mut sums = [[[0.0; 2 * LANES]; 2]; 2];
        for ((one, other), vectors) in one.chunks(BLOCK).zip(other.chunks(BLOCK)).zip(vectors.chunks(BLOCK)) {
            let mut parts = [[[0.0_f32; 2 * LANES]; 2]; 2];
            for ((a, b), vector) in one.iter().zip(other).zip(vectors) {
                for lane in 0..2 * LANES {
                    parts[0][0][lane] += a.re * vector[lane];
                    parts[0][1][lane] += a.im * vector[lane];
                    parts[1][0][lane] += b.re * vector[lane];
                    parts[1][1][lane] += b.im * vector[lane];
                }
            }
            for (sums, parts) in sums.iter_mut().flatten().zip(parts.iter().flatten()) {
                for (sum, part) in sums.iter_mut().zip(parts) {
                    *sum += f64::from(*part);
                }
            }
        }
        for (product, [by_re, by_im]) in products.iter_mut().zip(&sums) {
            for lane in 0..LANES {
                product[0][lane] = by_re[lane] - by_im[LANES + lane];
                product[1][lane] = by_re[LANES + lane] + by_im[lane];
            }
        }
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
