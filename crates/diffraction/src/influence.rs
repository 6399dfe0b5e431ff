//! Velocities in the water by the panels of the hulls, for all headings at once.
//!
//! The gradient of `1/(4 pi) int (phi_n G - phi G_n) dS` by the position of the point: the Rankine part exact, by the field of a current round each panel
//! and the logarithms of its sides; the wave part by second derivatives of the Green function, which its tables give with the equation of
//! Laplace. What the panels do to a point is found once and multiplied with the strengths of all headings.

use crate::green::{FrequencySlopes, WavePart, WavePartBatch};
use crate::panel::Panel;
use crate::rankine::LevelImage;
use crate::wave_system::WaveKernel;
use multiversion::multiversion;
use nalgebra::{Complex, Vector3};

type C = Complex<f64>;

/// Headings that are worked on side by side.
const LANES: usize = 8;

/// Velocity at a point by a panel: by its sources of unit strength, and by its dipoles along the normal into the water; real and imaginary
/// parts of x, y and z.
#[derive(Clone, Copy, Debug, Default)]
pub struct PanelFlow {
    source: [[f64; 2]; 3],
    dipole: [[f64; 2]; 3],
}

impl PanelFlow {
    fn add(&mut self, source: Vector3<C>, dipole: Vector3<C>) {
        for axis in 0..3 {
            self.source[axis][0] += source[axis].re;
            self.source[axis][1] += source[axis].im;
            self.dipole[axis][0] += dipole[axis].re;
            self.dipole[axis][1] += dipole[axis].im;
        }
    }

    /// Reflects it at x = 0 and y = 0.
    fn reflect(&mut self, image: [f64; 2]) {
        for (axis, sign) in image.into_iter().enumerate() {
            self.source[axis].iter_mut().chain(&mut self.dipole[axis]).for_each(|part| *part *= sign);
        }
    }
}

/// Room for the flows of one point after the other.
#[derive(Debug, Default)]
pub struct FlowRoom {
    flows: Vec<PanelFlow>,
    batch: WavePartBatch,
    x: Vec<f64>,
    y: Vec<f64>,
}

impl WaveKernel {
    /// The flows of all panels at a point that is seen in a mirror, in axes of the mirror's image.
    pub fn flows<'a>(
        &self,
        from: &Vector3<f64>,
        image: [f64; 2],
        panels: &[Panel],
        levels: &[LevelImage],
        room: &'a mut FlowRoom,
    ) -> &'a [PanelFlow] {
        let FlowRoom { flows, batch, x, y } = room;
        x.clear();
        y.clear();
        for panel in panels {
            let arm = panel.centroid - from;
            x.push(self.nu() * arm.x.hypot(arm.y));
            y.push((-self.nu() * (panel.centroid.z + from.z)).max(f64::MIN_POSITIVE));
        }
        self.deep().evaluate_batch(x, y, batch);
        flows.clear();
        for (index, panel) in panels.iter().enumerate() {
            let mut flow = PanelFlow::default();
            if self.is_near(from, panel) {
                for (point, area) in panel.rule() {
                    let (dx, dy) = (point.x - from.x, point.y - from.y);
                    let at = [self.nu() * dx.hypot(dy), -self.nu() * (point.z + from.z)];
                    let part = self.deep().evaluate(at[0], at[1]);
                    let [source, dipole] = self.wave_flow(part, at, from, panel, point);
                    flow.add(source * C::from(*area), dipole * C::from(*area));
                }
            } else {
                let part = WavePart {
                    value: C::new(batch.re[index], batch.im[index]),
                    by_x: C::new(batch.re_by_x[index], batch.im_by_x[index]),
                };
                let [source, dipole] = self.wave_flow(part, [x[index], y[index]], from, panel, &panel.centroid);
                flow.add(source * C::from(panel.area), dipole * C::from(panel.area));
            }
            for level in levels {
                let z = level.sign * from.z + level.shift;
                let [source, dipole] = panel.rankine_gradients(&Vector3::new(from.x, from.y, z));
                let turned = |v: Vector3<f64>| {
                    Vector3::new(v.x, v.y, v.z * level.sign).map(|part| C::from(part * level.strength))
                };
                flow.add(turned(source), turned(dipole));
            }
            flow.reflect(image);
            flows.push(flow);
        }
        flows
    }

    /// Velocities at a point by the wave part of a source and of a dipole of unit strength at a point of a panel.
    fn wave_flow(
        &self,
        part: WavePart,
        at: [f64; 2],
        from: &Vector3<f64>,
        panel: &Panel,
        point: &Vector3<f64>,
    ) -> [Vector3<C>; 2] {
        let (dx, dy) = (point.x - from.x, point.y - from.y);
        let distance = dx.hypot(dy);
        let deep = FrequencySlopes::from_wave_part(part, self.nu(), at);
        let slopes = match self.bottom() {
            None => deep,
            Some(bottom) => bottom.correct_slopes(deep, distance, [from.z, point.z]),
        };
        let [ux, uy] = if distance > 0.0 { [dx / distance, dy / distance] } else { [0.0; 2] };
        let normal = &panel.normal;
        let across = ux * normal.x + uy * normal.y;
        // toward the panel the distance shrinks
        let source = Vector3::new(-slopes.by_distance * ux, -slopes.by_distance * uy, slopes.by_heights[0]);
        let along = slopes.by_distance_twice * across + slopes.by_distance_and_heights[1] * normal.z;
        let beside = |n: f64, u: f64| -(along * u + slopes.over_distance * (n - across * u));
        let up = slopes.by_distance_and_heights[0] * across + slopes.by_both_heights * normal.z;
        [source, Vector3::new(beside(normal.x, ux), beside(normal.y, uy), up)]
    }
}

/// Strengths of the sources and dipoles of all panels with their images, headings side by side.
pub struct Strengths {
    headings: usize,
    /// By eight headings, then panel by panel: real and imaginary part of the sources, and of the dipoles.
    lanes: Vec<Vec<[[f64; LANES]; 4]>>,
}

impl Strengths {
    /// From those of each heading: potentials, which are the dipoles, and derivatives along the normal, which are the sources.
    pub fn new(headings: &[(Vec<C>, Vec<C>)]) -> Self {
        let panels = headings.first().map_or(0, |(potential, _)| potential.len());
        let lanes = headings
            .chunks(LANES)
            .map(|some| {
                let of_panel = |panel: usize| {
                    let mut made = [[0.0; LANES]; 4];
                    for (lane, (potential, by_normal)) in some.iter().enumerate() {
                        let (source, dipole) = (by_normal[panel], potential[panel]);
                        for (part, value) in made.iter_mut().zip([source.re, source.im, dipole.re, dipole.im]) {
                            part[lane] = value;
                        }
                    }
                    made
                };
                (0..panels).map(of_panel).collect()
            })
            .collect();
        Strengths { headings: headings.len(), lanes }
    }

    /// Adds the velocities by panels, the first of them by its place among all with their images; heading by heading.
    pub fn add_velocities(&self, flows: &[PanelFlow], first: usize, velocities: &mut [[C; 3]]) {
        for (lanes, made) in self.lanes.iter().zip(velocities.chunks_mut(LANES)) {
            let mut sums = [[0.0; LANES]; 6];
            add_flows(flows, &lanes[first..first + flows.len()], &mut sums);
            for (lane, velocity) in made.iter_mut().enumerate() {
                for (axis, value) in velocity.iter_mut().enumerate() {
                    *value += C::new(sums[2 * axis][lane], sums[2 * axis + 1][lane]);
                }
            }
        }
    }

    /// How many headings.
    pub fn headings(&self) -> usize {
        self.headings
    }
}

/// Sums of flows times strengths, headings side by side; compiled for several widths of vector register, products and sums rounded once, so that all give
/// the same digits.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+fma", "x86_64+avx2+fma"))]
fn add_flows(flows: &[PanelFlow], strengths: &[[[f64; LANES]; 4]], sums: &mut [[f64; LANES]; 6]) {
    for axis in 0..3 {
        let (mut re, mut im) = ([0.0_f64; LANES], [0.0_f64; LANES]);
        for (flow, [source_re, source_im, dipole_re, dipole_im]) in flows.iter().zip(strengths) {
            let ([a, b], [c, d]) = (flow.source[axis], flow.dipole[axis]);
            for lane in 0..LANES {
                let by_source = (-b).mul_add(source_im[lane], re[lane]);
                let by_dipole = (-d).mul_add(dipole_im[lane], a.mul_add(source_re[lane], by_source));
                re[lane] = c.mul_add(dipole_re[lane], by_dipole);
                let by_source = b.mul_add(source_re[lane], im[lane]);
                let by_dipole = d.mul_add(dipole_re[lane], a.mul_add(source_im[lane], by_source));
                im[lane] = c.mul_add(dipole_im[lane], by_dipole);
            }
        }
        for lane in 0..LANES {
            sums[2 * axis][lane] += re[lane];
            sums[2 * axis + 1][lane] += im[lane];
        }
    }
}
