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

/// The parts of a matrix between two blocks of panels: the rows of the first with the columns of the second, and the other way round, which a
/// block with itself has not. Each row by row.
type Tiles = [Vec<Complex<f32>>; 2];

/// The system of a symmetry class: matrix and right sides of the radiation problems.
#[derive(Clone, Debug)]
pub struct WaveSystem {
    count: usize,
    /// Of the pairs of blocks in the order of [`block_pairs`].
    tiles: Vec<Tiles>,
    /// Right sides of the motions of the class.
    pub radiation: Columns,
}

/// The panels of a block.
fn block_range(block: usize, count: usize) -> Range<usize> {
    block * BLOCK..((block + 1) * BLOCK).min(count)
}

/// All pairs of blocks of so many panels, the first not behind the second.
fn block_pairs(count: usize) -> Vec<[usize; 2]> {
    let blocks = count.div_ceil(BLOCK);
    (0..blocks).flat_map(|i| (i..blocks).map(move |j| [i, j])).collect()
}

/// The place of a pair in [`block_pairs`].
fn pair_index([first, second]: [usize; 2], count: usize) -> usize {
    let blocks = count.div_ceil(BLOCK);
    first * blocks - first * first.saturating_sub(1) / 2 + second - first
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

    /// omega2/g (1/m).
    pub fn nu(&self) -> f64 {
        self.nu
    }

    /// The tables of deep water.
    pub fn deep(&self) -> &'static WavePartTable {
        self.deep
    }

    /// What the bottom adds.
    pub fn bottom(&self) -> Option<&FiniteDepthTable> {
        self.bottom.as_ref()
    }

    /// Whether a point is so near the image of a panel that its wave part is taken at four points.
    pub fn is_near(&self, from: &Vector3<f64>, panel: &Panel) -> bool {
        let arm = panel.centroid - from;
        let above = panel.centroid.z + from.z;
        arm.x * arm.x + arm.y * arm.y + above * above < (NEAR_DIAGONALS * panel.diagonal).powi(2)
    }

    fn part(&self, distance: f64, heights: [f64; 2]) -> FrequencyPart {
        match &self.bottom {
            None => FrequencyPart::in_deep_water(self.deep, self.nu, distance, heights),
            Some(bottom) => bottom.evaluate(self.deep, distance, heights),
        }
    }

    /// The potentials over panels from one point, and the derivatives along their normals into the water: at their centroids, or near their images
    /// at four points.
    pub fn over_panels(&self, from: &Vector3<f64>, panels: &[Panel]) -> Vec<(C, C)> {
        let (mut x, mut y) = (Vec::with_capacity(panels.len()), Vec::with_capacity(panels.len()));
        for panel in panels {
            let arm = panel.centroid - from;
            x.push(self.nu * (arm.x * arm.x + arm.y * arm.y).sqrt());
            // at the surface itself the wave part has no limit: those panels are near
            y.push((-self.nu * (panel.centroid.z + from.z)).max(f64::MIN_POSITIVE));
        }
        let mut batch = WavePartBatch::default();
        self.deep.evaluate_batch(&x, &y, &mut batch);
        let distance = |panel: &Panel| {
            let arm = panel.centroid - from;
            (arm.x * arm.x + arm.y * arm.y).sqrt()
        };
        let of = |(index, panel): (usize, &Panel)| {
            let distance = distance(panel);
            if self.is_near(from, panel) {
                return self.over_points(from, panel);
            }
            let part = WavePart {
                value: C::new(batch.re[index], batch.im[index]),
                by_x: C::new(batch.re_by_x[index], batch.im_by_x[index]),
            };
            let found = FrequencyPart::from_wave_part(part, self.nu, [x[index], y[index]]);
            let found = match &self.bottom {
                None => found,
                Some(bottom) => bottom.correct(found, distance, [from.z, panel.centroid.z]),
            };
            let (value, by_normal) = Self::on_panel(&found, from, panel, &panel.centroid);
            (value * panel.area, by_normal * panel.area)
        };
        panels.iter().enumerate().map(of).collect()
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

/// What a block of panels and another do to each other in one class.
struct ClassPair {
    tiles: Tiles,
    /// Parts of the right sides of the first block and of the second, panel by panel and then motion by motion.
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

/// Real and imaginary parts of a quantity between the panels of two blocks, by rows of the first.
type BlockValues = [Vec<f64>; 2];

/// The frequency's part of the Green function between the panels of two blocks; its room serves one pair after the other.
#[derive(Default)]
struct BlockKernel {
    value: BlockValues,
    by_distance: BlockValues,
    /// By the height of the panel of the first block, and of the second where that differs.
    by_heights: [BlockValues; 2],
    /// Horizontal unit vector from the first to the second.
    direction: [Vec<f64>; 2],
    /// Panels too near each other's image for one point.
    near: Vec<[usize; 2]>,
    /// Derivatives along the normal over the panels of the second block, and over those of the first.
    derivatives: [BlockValues; 2],
    /// X and Y of the wave part, horizontal distances (m), and the wave part.
    x: Vec<f64>,
    y: Vec<f64>,
    distances: Vec<f64>,
    batch: WavePartBatch,
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
    let arrays = PanelArrays::new(mesh, kernel.nu, velocities);
    let pairs = block_pairs(count);
    let made: Vec<Vec<ClassPair>> = pairs
        .par_iter()
        .map_init(BlockKernel::default, |room, blocks| {
            block_pair(room, kernel, mesh, classes, &arrays, rankine, *blocks)
        })
        .collect();
    let mut systems: Vec<WaveSystem> =
        rankine.iter().map(|part| WaveSystem::without_tiles(part, count, pairs.len())).collect();
    for (blocks, of_classes) in pairs.iter().zip(made) {
        for (system, class) in systems.iter_mut().zip(of_classes) {
            system.add_sides(*blocks, &class.sides);
            system.tiles.push(class.tiles);
        }
    }
    systems
}

fn block_pair(
    block: &mut BlockKernel,
    kernel: &WaveKernel,
    mesh: &HullMesh,
    classes: &[SymmetryClass],
    arrays: &PanelArrays,
    rankine: &[RankinePart],
    blocks: [usize; 2],
) -> Vec<ClassPair> {
    let panels = mesh.panels();
    let [rows, columns] = blocks.map(|block| block_range(block, panels.len()));
    let width = columns.len();
    // within one block each panel is a row, and the other way is the same once more
    let ways = if blocks[0] == blocks[1] { 1 } else { 2 };
    let motions: Vec<usize> = arrays.fluxes.iter().map(|fluxes| fluxes.len() / panels.len()).collect();
    // on the lid the derivative along the normal, which points down, is -nu times the potential
    let lid_factor = kernel.nu as f32;
    let mut made: Vec<ClassPair> = motions
        .iter()
        .zip(rankine)
        .map(|(motions, part)| ClassPair {
            tiles: rankine_tiles(part, [panels.len(), mesh.hull_count()], lid_factor, blocks),
            sides: [vec![C::default(); rows.len() * motions], vec![C::default(); width * motions]],
        })
        .collect();
    for image in mesh.mirrors().images() {
        kernel.over_block(block, arrays, &rows, &columns, image);
        block.differentiate(arrays, &rows, &columns, image, ways);
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
            let [first, second] = &mut made.tiles;
            add_tile(first, &block.derivatives[0], factor);
            if ways == 2 {
                add_turned_tile(second, &block.derivatives[1], width, factor);
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
                    let at = if way == 0 { row * width + column } else { column * rows.len() + row };
                    made.tiles[way][at] += Complex::new((factor * by_normal.re) as f32, (factor * by_normal.im) as f32);
                    let area = panels[source].area;
                    for motion in 0..motions {
                        made.sides[way][own * motions + motion] +=
                            potential * (factor * fluxes[source * motions + motion] / area);
                    }
                }
            }
        }
    }
    damp_patches(&mut made, mesh, blocks);
    made
}

/// Makes columns of damped patches, which are as those of a lid, those of the damped condition: `-i epsilon nu int G dS` for `nu int G dS`. The diagonal keeps
/// the angle that is not of the column.
fn damp_patches(pairs: &mut [ClassPair], mesh: &HullMesh, blocks: [usize; 2]) {
    let (first, (_, damping)) = (mesh.hull_count(), mesh.patches());
    if damping.is_empty() {
        return;
    }
    let [rows, columns] = blocks.map(|block| block_range(block, mesh.panels().len()));
    let own = Complex::from(4.0 * std::f32::consts::PI);
    for [one, other] in pairs.iter_mut().map(|pair| &mut pair.tiles) {
        for (tile, rows, columns) in [(one, &rows, &columns), (other, &columns, &rows)] {
            for (row, entries) in rows.clone().zip(tile.chunks_mut(columns.len())) {
                for (column, entry) in columns.clone().zip(entries) {
                    if let Some(epsilon) = column.checked_sub(first).and_then(|patch| damping.get(patch)) {
                        let factor = Complex::new(0.0, -epsilon as f32);
                        *entry = if row == column { (*entry - own) * factor + own } else { *entry * factor };
                    }
                }
            }
        }
    }
}

/// The part of the tiles of a pair that does not depend on the frequency but by the factor of the lid; `counts` are those of all panels and of
/// those of the hull.
fn rankine_tiles(part: &RankinePart, [count, hull]: [usize; 2], lid_factor: f32, blocks: [usize; 2]) -> Tiles {
    let [first, second] = blocks.map(|block| block_range(block, count));
    let tile = |rows: &Range<usize>, columns: &Range<usize>| {
        let mut tile = Vec::with_capacity(rows.len() * columns.len());
        let on_hull = hull.clamp(columns.start, columns.end);
        for i in rows.clone() {
            let row = &part.double_layer[i * count..(i + 1) * count];
            tile.extend(row[columns.start..on_hull].iter().map(|value| Complex::from(*value)));
            tile.extend(row[on_hull..columns.end].iter().map(|value| Complex::from(value * lid_factor)));
            if columns.contains(&i) {
                let own = if i < hull { 2.0 * std::f32::consts::PI } else { 4.0 * std::f32::consts::PI };
                let at = tile.len() - columns.len() + i - columns.start;
                tile[at].re += own;
            }
        }
        tile
    };
    [tile(&first, &second), if blocks[0] == blocks[1] { Vec::new() } else { tile(&second, &first) }]
}

/// Adds real and imaginary parts times a factor to a tile.
fn add_tile(tile: &mut [Complex<f32>], [re, im]: &[Vec<f64>; 2], factor: f64) {
    for ((entry, re), im) in tile.iter_mut().zip(re).zip(im) {
        *entry += Complex::new((factor * re) as f32, (factor * im) as f32);
    }
}

/// The same with parts that lie by the columns of the tile, `width` of them a column.
fn add_turned_tile(tile: &mut [Complex<f32>], [re, im]: &[Vec<f64>; 2], width: usize, factor: f64) {
    let height = re.len() / width;
    for (row, entries) in tile.chunks_exact_mut(height).enumerate() {
        let parts = re[row..].iter().step_by(width).zip(im[row..].iter().step_by(width));
        for (entry, (re, im)) in entries.iter_mut().zip(parts) {
            *entry += Complex::new((factor * re) as f32, (factor * im) as f32);
        }
    }
}

/// Adds to right sides the potentials of the fluxes of the other block: of rows of the kernel, or turned of its columns. Compiled as
/// [`add_products`].
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+fma", "x86_64+avx2+fma"))]
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
        made: &mut BlockKernel,
        arrays: &PanelArrays,
        rows: &Range<usize>,
        columns: &Range<usize>,
        image: [f64; 2],
    ) {
        let width = columns.len();
        let size = rows.len() * width;
        made.resize(size, self.bottom.is_some());
        let BlockKernel { value, by_distance, by_heights, direction, near, x, y, distances, batch, .. } = made;
        let [xs, ys, zs] = &arrays.centroid;
        let [along, across] = direction;
        let others = ColumnPoints {
            x: &xs[columns.clone()],
            y: &ys[columns.clone()],
            z: &zs[columns.clone()],
            near: &arrays.near[columns.clone()],
        };
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
            see_columns(&others, from, self.nu, out);
            let nears = y[own].iter().zip(columns.clone()).filter(|(y, _)| **y < 0.0);
            near.extend(nears.map(|(_, j)| [i, j]));
        }
        // what is near is taken elsewhere
        let place = |[i, j]: &[usize; 2]| (i - rows.start) * width + j - columns.start;
        for at in near.iter().map(place) {
            (x[at], y[at]) = (1.0, 1.0);
        }
        self.deep.evaluate_batch(x, y, batch);
        let [first, second] = by_heights;
        scale_wave_part([x, y], batch, self.nu, [value, by_distance, first]);
        if let Some(bottom) = &self.bottom {
            second.clone_from(first);
            for (row, i) in rows.clone().enumerate() {
                for (column, j) in columns.clone().enumerate() {
                    let at = row * width + column;
                    let deep = made.part(at);
                    let corrected = bottom.correct(deep, made.distances[at], [zs[i], zs[j]]);
                    made.set(at, corrected);
                }
            }
        }
        for index in 0..made.near.len() {
            made.set(place(&made.near[index]), FrequencyPart::default());
        }
    }
}

/// Scales the wave part at X and Y: the part of deep water, its derivatives by the distance and by a height.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+fma", "x86_64+avx2+fma"))]
fn scale_wave_part(
    [x, y]: [&[f64]; 2],
    batch: &WavePartBatch,
    nu: f64,
    [value, by_distance, by_height]: [&mut BlockValues; 3],
) {
    let count = x.len();
    let square = nu * nu;
    let [re, im, re_by_x, im_by_x] = [&batch.re, &batch.im, &batch.re_by_x, &batch.im_by_x].map(|part| &part[..count]);
    let y = &y[..count];
    let [[value, value_im], [slope, slope_im], [height, height_im]] =
        [value, by_distance, by_height].map(|[re, im]| [&mut re[..count], &mut im[..count]]);
    for at in 0..count {
        value[at] = nu * re[at];
        value_im[at] = nu * im[at];
        slope[at] = square * re_by_x[at];
        slope_im[at] = square * im_by_x[at];
        height[at] = square * (re[at] + 2.0 / (x[at] * x[at] + y[at] * y[at]).sqrt());
        height_im[at] = square * im[at];
    }
}

impl BlockKernel {
    /// Makes room for so many pairs of panels; those of a bottom have derivatives by both heights.
    fn resize(&mut self, size: usize, has_bottom: bool) {
        let [first, second] = &mut self.by_heights;
        let values = [&mut self.value, &mut self.by_distance, first, &mut self.direction].into_iter().flatten();
        for part in values.chain([&mut self.x, &mut self.y, &mut self.distances]) {
            part.resize(size, 0.0);
        }
        for part in second {
            part.resize(if has_bottom { size } else { 0 }, 0.0);
        }
        self.near.clear();
    }

    fn part(&self, at: usize) -> FrequencyPart {
        let of = |[re, im]: &BlockValues| C::new(re[at], im[at]);
        FrequencyPart {
            value: of(&self.value),
            by_distance: of(&self.by_distance),
            by_heights: [of(&self.by_heights[0]), of(self.by_height(1))],
        }
    }

    /// The derivative by the height of the panel of the first block, or of the second.
    fn by_height(&self, which: usize) -> &BlockValues {
        &self.by_heights[if self.by_heights[1][0].is_empty() { 0 } else { which }]
    }

    fn set(&mut self, at: usize, part: FrequencyPart) {
        let [first, second] = &mut self.by_heights;
        for ([re, im], value) in [
            (&mut self.value, part.value),
            (&mut self.by_distance, part.by_distance),
            (first, part.by_heights[0]),
            (second, part.by_heights[1]),
        ] {
            // there is no second where it is the first
            if let (Some(re), Some(im)) = (re.get_mut(at), im.get_mut(at)) {
                (*re, *im) = (value.re, value.im);
            }
        }
    }

    /// The derivatives along the normals out of the water over the panels of the second block, and with two ways over those of the first, seen
    /// from the other. Row by row of the first block, which is seen in a mirror.
    fn differentiate(
        &mut self,
        arrays: &PanelArrays,
        rows: &Range<usize>,
        columns: &Range<usize>,
        image: [f64; 2],
        ways: usize,
    ) {
        let width = columns.len();
        let mut made = std::mem::take(&mut self.derivatives);
        for (way, made) in made.iter_mut().enumerate().take(ways) {
            made.iter_mut().for_each(|part| part.resize(rows.len() * width, 0.0));
            let [re, im] = made;
            for (row, i) in rows.clone().enumerate() {
                let own = row * width..(row + 1) * width;
                let kernel = KernelRow {
                    value: [0, 1].map(|part| &self.value[part][own.clone()]),
                    by_distance: [0, 1].map(|part| &self.by_distance[part][own.clone()]),
                    by_height: [0, 1].map(|part| &self.by_height(1 - way)[part][own.clone()]),
                    direction: [0, 1].map(|axis| &self.direction[axis][own.clone()]),
                };
                let out = [&mut re[own.clone()], &mut im[own.clone()]];
                if way == 0 {
                    let vectors = [0, 1, 2].map(|axis| &arrays.area_vector[axis][columns.clone()]);
                    toward_columns(&kernel, vectors, &arrays.lid[columns.clone()], out);
                } else {
                    // seen from the other side the arm is the mirrored one, turned round
                    let [x, y, z] = [0, 1, 2].map(|axis| arrays.area_vector[axis][i]);
                    toward_row(&kernel, [-image[0] * x, -image[1] * y, z], arrays.lid[i], out);
                }
            }
        }
        self.derivatives = made;
    }
}

/// Centroids of the second block, and how near they are too near.
struct ColumnPoints<'a> {
    x: &'a [f64],
    y: &'a [f64],
    z: &'a [f64],
    near: &'a [f64],
}

/// From a point x, y, z that is too near within the root of its fourth number: X, Y, the horizontal distance, and the unit vector along
/// it. Y is -1 where it is too near.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+fma", "x86_64+avx2+fma"))]
fn see_columns(others: &ColumnPoints, [px, py, pz, near]: [f64; 4], nu: f64, out: [&mut [f64]; 5]) {
    let count = others.x.len();
    let (xs, ys, zs, nears) = (&others.x[..count], &others.y[..count], &others.z[..count], &others.near[..count]);
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

/// A row of a block: real and imaginary parts.
struct KernelRow<'a> {
    value: [&'a [f64]; 2],
    by_distance: [&'a [f64]; 2],
    by_height: [&'a [f64]; 2],
    direction: [&'a [f64]; 2],
}

/// Derivatives along the normals of the columns.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+fma", "x86_64+avx2+fma"))]
fn toward_columns(kernel: &KernelRow, [x, y, z]: [&[f64]; 3], lid: &[f64], out: [&mut [f64]; 2]) {
    let count = lid.len();
    let [along, across] = kernel.direction.map(|part| &part[..count]);
    let (x, y, z, lid) = (&x[..count], &y[..count], &z[..count], &lid[..count]);
    let parts = [kernel.value, kernel.by_distance, kernel.by_height].map(|of| of.map(|part| &part[..count]));
    let [re, im] = out.map(|part| &mut part[..count]);
    for j in 0..count {
        let normal = along[j] * x[j] + across[j] * y[j];
        re[j] = parts[0][0][j] * lid[j] - parts[1][0][j] * normal - parts[2][0][j] * z[j];
        im[j] = parts[0][1][j] * lid[j] - parts[1][1][j] * normal - parts[2][1][j] * z[j];
    }
}

/// Derivatives along the normal of the row.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+fma", "x86_64+avx2+fma"))]
fn toward_row(kernel: &KernelRow, [x, y, z]: [f64; 3], lid: f64, out: [&mut [f64]; 2]) {
    let [re, im] = out;
    let count = re.len();
    let [along, across] = kernel.direction.map(|part| &part[..count]);
    let parts = [kernel.value, kernel.by_distance, kernel.by_height].map(|of| of.map(|part| &part[..count]));
    let (re, im) = (&mut re[..count], &mut im[..count]);
    for j in 0..count {
        let normal = along[j] * x + across[j] * y;
        re[j] = parts[0][0][j] * lid - parts[1][0][j] * normal - parts[2][0][j] * z;
        im[j] = parts[0][1][j] * lid - parts[1][1][j] * normal - parts[2][1][j] * z;
    }
}

impl WaveSystem {
    /// The system without waves.
    pub fn from_rankine(part: &RankinePart, count: usize) -> Self {
        let pairs = block_pairs(count);
        let mut system = Self::without_tiles(part, count, pairs.len());
        system.tiles = pairs.par_iter().map(|blocks| rankine_tiles(part, [count, count], 0.0, *blocks)).collect();
        system
    }

    /// Its right sides, and room for tiles.
    fn without_tiles(part: &RankinePart, count: usize, pairs: usize) -> Self {
        let motions = part.single_layer.len() / count;
        let mut radiation = Columns::zeros(count, motions);
        for motion in 0..motions {
            for (value, part) in
                radiation.column_mut(motion).iter_mut().zip(part.single_layer.iter().skip(motion).step_by(motions))
            {
                *value = C::new(*part, 0.0);
            }
        }
        WaveSystem { count, tiles: Vec::with_capacity(pairs), radiation }
    }

    fn add_sides(&mut self, blocks: [usize; 2], sides: &[Vec<C>; 2]) {
        let motions = self.radiation.count();
        let ranges = blocks.map(|block| block_range(block, self.count));
        for (range, sides) in ranges.into_iter().zip(sides) {
            for (index, value) in sides.iter().enumerate() {
                self.radiation.column_mut(index % motions)[range.start + index / motions] += value;
            }
        }
    }

    /// The tile of a row and a column of blocks.
    fn tile(&self, row: usize, column: usize) -> &[Complex<f32>] {
        if row <= column {
            &self.tiles[pair_index([row, column], self.count)][0]
        } else {
            &self.tiles[pair_index([column, row], self.count)][1]
        }
    }

    /// The products of the matrix with vectors.
    pub fn multiply(&self, vectors: &Columns, accuracy: Accuracy) -> Columns {
        let mut made = Columns::zeros(self.count, vectors.count());
        let blocks = self.count.div_ceil(BLOCK);
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
            let products: Vec<[[f64; LANES]; 2]> = (0..blocks)
                .into_par_iter()
                .flat_map_iter(|row| {
                    let mut products = vec![[[0.0; LANES]; 2]; block_range(row, self.count).len()];
                    for column in 0..blocks {
                        let (tile, range) = (self.tile(row, column), block_range(column, self.count));
                        match accuracy {
                            Accuracy::Full => add_products(tile, &packed[range], &mut products),
                            Accuracy::Rough => add_rough_products(tile, &narrow[range], &mut products),
                        }
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

/// As [`add_products`] to single precision, real parts of the vectors before their imaginary parts.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+fma", "x86_64+avx2+fma"))]
fn add_rough_products(tile: &[Complex<f32>], vectors: &[[f32; 2 * LANES]], products: &mut [[[f64; LANES]; 2]]) {
    let count = vectors.len();
    for (pair, products) in tile.chunks(2 * count).zip(products.chunks_mut(2)) {
        let (one, other) = pair.split_at(count);
        // a row that is left over goes with itself
        let other = if other.is_empty() { one } else { other };
        let mut sums = [[[0.0_f32; 2 * LANES]; 2]; 2];
        for ((a, b), vector) in one.iter().zip(other).zip(vectors) {
            for lane in 0..2 * LANES {
                sums[0][0][lane] = a.re.mul_add(vector[lane], sums[0][0][lane]);
                sums[0][1][lane] = a.im.mul_add(vector[lane], sums[0][1][lane]);
                sums[1][0][lane] = b.re.mul_add(vector[lane], sums[1][0][lane]);
                sums[1][1][lane] = b.im.mul_add(vector[lane], sums[1][1][lane]);
            }
        }
        for (product, [by_re, by_im]) in products.iter_mut().zip(&sums) {
            for lane in 0..LANES {
                product[0][lane] += f64::from(by_re[lane]) - f64::from(by_im[LANES + lane]);
                product[1][lane] += f64::from(by_re[LANES + lane]) + f64::from(by_im[lane]);
            }
        }
    }
}

/// Adds the products of a tile with vectors side by side, real and imaginary parts apart. Compiled for several widths of vector register, with
/// products and sums that are rounded once, so that all give the same digits; a processor without such an instruction takes long.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+fma", "x86_64+avx2+fma"))]
fn add_products(tile: &[Complex<f32>], vectors: &[[[f64; LANES]; 2]], products: &mut [[[f64; LANES]; 2]]) {
    let count = vectors.len();
    for (pair, products) in tile.chunks(2 * count).zip(products.chunks_mut(2)) {
        let (one, other) = pair.split_at(count);
        let other = if other.is_empty() { one } else { other };
        let mut sums = [[[0.0_f64; LANES]; 4]; 2];
        for ((a, b), [re, im]) in one.iter().zip(other).zip(vectors) {
            let [a_re, a_im, b_re, b_im] = [a.re, a.im, b.re, b.im].map(f64::from);
            for lane in 0..LANES {
                sums[0][0][lane] = a_re.mul_add(re[lane], sums[0][0][lane]);
                sums[0][1][lane] = a_im.mul_add(im[lane], sums[0][1][lane]);
                sums[0][2][lane] = a_re.mul_add(im[lane], sums[0][2][lane]);
                sums[0][3][lane] = a_im.mul_add(re[lane], sums[0][3][lane]);
                sums[1][0][lane] = b_re.mul_add(re[lane], sums[1][0][lane]);
                sums[1][1][lane] = b_im.mul_add(im[lane], sums[1][1][lane]);
                sums[1][2][lane] = b_re.mul_add(im[lane], sums[1][2][lane]);
                sums[1][3][lane] = b_im.mul_add(re[lane], sums[1][3][lane]);
            }
        }
        for (product, sums) in products.iter_mut().zip(&sums) {
            for lane in 0..LANES {
                product[0][lane] += sums[0][lane] - sums[1][lane];
                product[1][lane] += sums[2][lane] + sums[3][lane];
            }
        }
    }
}
