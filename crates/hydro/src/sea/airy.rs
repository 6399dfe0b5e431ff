//! Linear waves added up: elevation, velocity, acceleration and pressure.
//!
//! Of a component [FALTINSEN-1990 table 2.1], with q = k (toward . (x, y)) - w t + phase:
//! u = a w C cos q, w = a w S sin q, p = rho g a cosh(k(z+d))/cosh(kd) cos q; C and S are cosh and sinh of k(z+d) over sinh(kd).

use super::deep_places::{DeepWaveSum, Places};
use super::simd_math::{Lanes8, MAX_REDUCIBLE_ANGLE, exp, sin_cos};
use super::{Component, Kinematics, Sea};
use multiversion::multiversion;
use nalgebra::Vector3;
use windlass_model::Stretching;

/// Water this deep (k d) is deep to the last digit: exp(-2 k d) < 1e-17.
const DEEP_WATER_KD: f64 = 20.0;
/// At this power of e, and below, nothing of a wave is left in sixteen digits.
const VANISHED_EXPONENT: f64 = -40.0;
/// The factor of delta stretching [RODENBUSCH-FORRISTALL-1986].
const DELTA_STRETCHING: f64 = 0.3;

/// Components in blocks of eight, with what does not change.
#[derive(Clone, Debug, Default)]
pub(super) struct WaveLanes {
    blocks: Vec<ComponentBlock>,
    /// The one direction of travel of a long-crested sea.
    toward: Option<[f64; 2]>,
    /// Depth of delta stretching: two standard deviations of the surface (m).
    stretch: f64,
    /// The sum of the amplitudes: the surface is never farther from the mean level (m).
    highest: f64,
    /// The same components, summed at depth.
    far: DeepWaveSum,
}

/// Lanes8 components; those that fill up the last block have no amplitude.
#[derive(Clone, Copy, Debug)]
struct ComponentBlock {
    /// Wave number along x and y, and itself (1/m).
    kx: Lanes8,
    ky: Lanes8,
    k: Lanes8,
    /// Frequency (rad/s), amplitude (m), phase (rad).
    w: Lanes8,
    amplitude: Lanes8,
    phase: Lanes8,
    /// Travel along x and y.
    x: Lanes8,
    y: Lanes8,
    /// exp(-2 k d), one over one less it, and tanh(k d).
    q: Lanes8,
    whole: Lanes8,
    tanh: Lanes8,
    /// Wave number of the longest of them (1/m).
    longest: f64,
}

impl WaveLanes {
    /// Those of components in a depth (m).
    pub(super) fn new(components: &[Component], depth: Option<f64>) -> Self {
        let block = |list: &[Component]| {
            let each = |value: &dyn Fn(&Component) -> f64| {
                let mut lanes = [0.0; 8];
                lanes.iter_mut().zip(list).for_each(|(lane, c)| *lane = value(c));
                lanes
            };
            let kd = |c: &Component| depth.map_or(f64::INFINITY, |d| c.number * d);
            ComponentBlock {
                kx: each(&|c| c.number * c.toward[0]),
                ky: each(&|c| c.number * c.toward[1]),
                k: each(&|c| c.number),
                w: each(&|c| c.frequency),
                amplitude: each(&|c| c.amplitude),
                phase: each(&|c| c.phase),
                x: each(&|c| c.toward[0]),
                y: each(&|c| c.toward[1]),
                q: each(&|c| if kd(c) > DEEP_WATER_KD { 0.0 } else { (-2.0 * kd(c)).exp() }),
                whole: each(&|c| -1.0 / (-2.0 * kd(c)).exp_m1()),
                tanh: each(&|c| kd(c).tanh()),
                longest: list.iter().map(|c| c.number).fold(f64::INFINITY, f64::min),
            }
        };
        let variance: f64 = components.iter().map(|c| 0.5 * c.amplitude * c.amplitude).sum();
        let toward = components.first().map(|c| c.toward).filter(|first| components.iter().all(|c| c.toward == *first));
        WaveLanes {
            blocks: components.chunks(8).map(block).collect(),
            far: DeepWaveSum::new(components, depth, toward.is_some(), MAX_REDUCIBLE_ANGLE),
            toward,
            stretch: 2.0 * variance.sqrt(),
            highest: components.iter().map(|c| c.amplitude.abs()).sum(),
        }
    }
}

/// Places far down, up to eight, until their waves are added up together.
#[derive(Clone, Debug, Default)]
struct DeepPlaces {
    indices: [usize; 8],
    positions: Places,
    count: usize,
}

impl DeepPlaces {
    /// Takes a place at a height over the mean level (m); of waves that all go one way its way along them is enough.
    fn push(&mut self, index: usize, at: &Vector3<f64>, height: f64, toward: Option<[f64; 2]>) {
        let [x, y] = toward.map_or([at.x, at.y], |[x, y]| [at.x * x + at.y * y, 0.0]);
        let i = self.count;
        self.indices[i] = index;
        (self.positions.x[i], self.positions.y[i], self.positions.height[i]) = (x, y, height);
        self.count += 1;
    }

    /// The places, those that are missing like the first.
    fn fill_batch(&mut self, count: usize) -> &Places {
        let Places { x, y, height } = &mut self.positions;
        for of in [x, y, height] {
            let (own, missing) = of.split_at_mut(count);
            missing.fill(own[0]);
        }
        &self.positions
    }
}

/// A sea at one time, prepared for many places.
#[derive(Clone, Debug)]
pub struct SeaAt<'a> {
    sea: &'a Sea,
    time: f64,
    /// The ramp.
    factor: f64,
    /// The ramp's rate over its value (1/s).
    growth: f64,
    /// Amplitude, ramp in it, times cosine and sine of `phase - w t`.
    phasors: Vec<[Lanes8; 2]>,
}

/// What a sea at one time was prepared for, without the sea: for the next who asks for it at that time.
#[derive(Clone, Debug)]
pub struct Prepared {
    time: f64,
    factor: f64,
    growth: f64,
    phasors: Vec<[Lanes8; 2]>,
}

impl<'a> SeaAt<'a> {
    /// A sea at a time (s), in what was prepared for it at some time.
    pub(super) fn from_prepared(
        sea: &'a Sea,
        time: f64,
        Prepared { time: then, factor, growth, phasors }: Prepared,
    ) -> Self {
        let mut made = SeaAt { sea, time: then, factor, growth, phasors };
        if then != time {
            made.move_to(time);
        }
        made
    }

    /// What it was prepared for.
    pub fn into_prepared(self) -> Prepared {
        let SeaAt { time, factor, growth, phasors, .. } = self;
        Prepared { time, factor, growth, phasors }
    }

    /// A sea at a time (s).
    pub(super) fn new(sea: &'a Sea, time: f64) -> Self {
        let mut made =
            SeaAt { sea, time, factor: 0.0, growth: 0.0, phasors: Vec::with_capacity(sea.lanes.blocks.len()) };
        made.move_to(time);
        made
    }

    /// Goes to another time (s), without another allocation.
    pub fn move_to(&mut self, time: f64) {
        let (factor, rate) = self.sea.factor_and_rate(time);
        (self.time, self.factor) = (time, factor);
        self.growth = if factor > 0.0 { rate / factor } else { 0.0 };
        self.phasors.clear();
        self.phasors.extend(self.sea.lanes.blocks.iter().map(|block| {
            let (sin, cos) = sin_cos(&lanes8(|i| block.phase[i] - block.w[i] * time));
            [lanes8(|i| factor * block.amplitude[i] * cos[i]), lanes8(|i| factor * block.amplitude[i] * sin[i])]
        }));
    }

    /// Height of the surface above the mean level (m).
    pub fn elevation(&self, x: f64, y: f64) -> f64 {
        if let Some(wave) = &self.sea.stokes {
            return self.factor * wave.elevation(x, y, self.time);
        }
        sum_elevation(&self.sea.lanes.blocks, &self.phasors, [x, y])
    }

    /// The water at a global place (m); nothing above the surface, but with [`Stretching::Exponential`]. Below the bottom it
    /// is as on it.
    pub fn kinematics(&self, at: Vector3<f64>) -> Kinematics {
        let height = at.z - self.sea.level;
        match (&self.sea.stokes, self.sea.stretching) {
            (None, Stretching::Exponential) => self.inside(at, height, 0.0),
            (None, Stretching::Wheeler | Stretching::Delta) => {
                let elevation = self.elevation(at.x, at.y);
                if height > elevation { Kinematics::still_water(elevation) } else { self.inside(at, height, elevation) }
            }
            _ => {
                let found = self.inside(at, height, 0.0);
                if height > found.elevation { Kinematics::still_water(found.elevation) } else { found }
            }
        }
    }

    /// The same, but above the surface it is the water at the surface.
    pub fn kinematics_to_surface(&self, at: Vector3<f64>) -> Kinematics {
        let height = at.z - self.sea.level;
        if self.sea.stokes.is_none() && self.sea.stretching == Stretching::Linear {
            let found = self.inside(at, height, 0.0);
            return if height > found.elevation { self.inside(at, found.elevation, 0.0) } else { found };
        }
        let elevation = self.elevation(at.x, at.y);
        self.inside(at, height.min(elevation), elevation)
    }

    /// The same at many places, given by their indices, for lines, of which most lies far down. Where no wave comes down to a
    /// place the surface above it is taken at the mean level, the head of the pressure over it; waves that are less than a millionth of
    /// what they are at the mean level are left out, and the mirror term of finite depth where it is less than a thousand-millionth.
    /// Velocity, acceleration and pressure err by no more than twice these shares of the sums of those that the left out waves have there,
    /// and by 2e-9 of the others.
    pub fn wetted_lines(&self, positions: &[Vector3<f64>], mut take: impl FnMut(usize, Kinematics)) {
        let sea = self.sea;
        let (reach, near) = (sea.lanes.far.reach, -sea.lanes.highest);
        let airy = sea.stokes.is_none() && sea.stretching == Stretching::Linear;
        let mut groups = [DeepPlaces::default(), DeepPlaces::default()];
        for (index, at) in positions.iter().enumerate() {
            let height = at.z - sea.level;
            // a place that is no number is not far down
            if !(airy && height < near && at.x.abs() + at.y.abs() <= reach) {
                take(index, self.kinematics_to_surface(*at));
                continue;
            }
            let bottom = sea.depth.map_or(f64::NEG_INFINITY, |d| -d);
            let lies = height <= bottom;
            let group = &mut groups[usize::from(lies)];
            group.push(index, at, height.max(bottom), sea.lanes.toward);
            if group.count == 8 {
                self.visit_deep_places(group, lies, &mut take);
            }
        }
        let [above, lying] = &mut groups;
        self.visit_deep_places(above, false, &mut take);
        self.visit_deep_places(lying, true, &mut take);
    }

    /// The water at places far down, which are then taken off their list.
    fn visit_deep_places(&self, group: &mut DeepPlaces, lies: bool, take: &mut impl FnMut(usize, Kinematics)) {
        let count = std::mem::take(&mut group.count);
        if count == 0 {
            return;
        }
        let (sea, far, positions) = (self.sea, &self.sea.lanes.far, group.fill_batch(count));
        let [pressure, u, v, w, u_rate, v_rate, w_rate] = match (sea.lanes.toward.is_none(), lies) {
            (true, true) => far.sums_on_bottom::<true>(self.time, positions),
            (true, false) => far.sums::<true>(self.time, positions),
            (false, true) => far.sums_on_bottom::<false>(self.time, positions),
            (false, false) => far.sums::<false>(self.time, positions),
        };
        let weight = sea.density * sea.gravity * self.factor;
        for (i, index) in group.indices.iter().enumerate().take(count) {
            let (velocity, rate) = match sea.lanes.toward {
                Some([x, y]) => {
                    (Vector3::new(u[i] * x, u[i] * y, w[i]), Vector3::new(u_rate[i] * x, u_rate[i] * y, w_rate[i]))
                }
                None => (Vector3::new(u[i], v[i], w[i]), Vector3::new(u_rate[i], v_rate[i], w_rate[i])),
            };
            let velocity = velocity * self.factor;
            let acceleration = rate * self.factor + velocity * self.growth;
            take(*index, Kinematics { velocity, acceleration, pressure: pressure[i] * weight, elevation: 0.0 });
        }
    }

    /// The same, but above the surface it goes on as its formula does, where that has an end of its own.
    pub fn kinematics_beyond_surface(&self, at: Vector3<f64>) -> Kinematics {
        let height = at.z - self.sea.level;
        match (&self.sea.stokes, self.sea.stretching) {
            (None, Stretching::Linear) => self.inside(at, height, 0.0),
            (None, Stretching::Wheeler | Stretching::Delta) => self.inside(at, height, self.elevation(at.x, at.y)),
            _ => self.kinematics_to_surface(at),
        }
    }

    /// The water at a height over the mean level (m) that is not above the surface; its elevation (m) is used by Wheeler and
    /// delta stretching.
    fn inside(&self, at: Vector3<f64>, height: f64, elevation: f64) -> Kinematics {
        let sea = self.sea;
        if let Some(wave) = &sea.stokes {
            return self.apply_ramp(wave.kinematics(Vector3::new(at.x, at.y, sea.level + height), self.time));
        }
        let [height, rise] = self.stretched_height(height, elevation);
        self.sums(at, height, rise)
    }

    /// The height over the mean level at which the waves are summed for a height (m) and an elevation (m), and the rise above it over which they
    /// go on straight.
    pub fn stretched_height(&self, height: f64, elevation: f64) -> [f64; 2] {
        let sea = self.sea;
        match sea.stretching {
            Stretching::Exponential => [height, 0.0],
            Stretching::Linear => [height.min(0.0), height.max(0.0)],
            Stretching::Wheeler => {
                // [WHEELER-1970]: the surface is taken for the mean level, the bottom stays
                let scale = sea.depth.map_or(1.0, |d| d / (d + elevation).max(f64::MIN_POSITIVE));
                [((height - elevation) * scale).min(0.0), 0.0]
            }
            Stretching::Delta => {
                let deep = sea.lanes.stretch;
                let mapped = if height > -deep && deep + elevation > 0.0 {
                    (height + deep) * (deep + DELTA_STRETCHING * elevation) / (deep + elevation) - deep
                } else {
                    height
                };
                [mapped.min(0.0), mapped.max(0.0)]
            }
        }
    }

    /// Whether what [`SeaAt::stretched_height`] gives at a height (m) depends on the elevation.
    pub fn needs_elevation(&self, height: f64) -> bool {
        match self.sea.stretching {
            Stretching::Exponential | Stretching::Linear => false,
            Stretching::Wheeler => true,
            Stretching::Delta => height > -self.sea.lanes.stretch,
        }
    }

    /// Whether the kinematics are smooth up to the surface of the waves, not up to where [`SeaAt::stretched_height`] begins to rise.
    pub fn ends_at_surface(&self) -> bool {
        self.sea.stokes.is_some() || matches!(self.sea.stretching, Stretching::Wheeler | Stretching::Exponential)
    }

    /// The surface is never farther from the mean level (m).
    pub fn highest(&self) -> f64 {
        // a crest of Stokes' is lower than its wave is high, twice the amplitude
        if self.sea.stokes.is_some() { 2.0 * self.sea.lanes.highest } else { self.sea.lanes.highest }
    }

    /// A wave of full height as the ramp has it.
    fn apply_ramp(&self, full: Kinematics) -> Kinematics {
        let velocity = full.velocity * self.factor;
        Kinematics {
            velocity,
            acceleration: full.acceleration * self.factor + velocity * self.growth,
            pressure: full.pressure * self.factor,
            elevation: full.elevation * self.factor,
        }
    }

    /// The waves added up at a height over the mean level (m), and straight on by a rise above it (m).
    fn sums(&self, at: Vector3<f64>, height: f64, rise: f64) -> Kinematics {
        let sea = self.sea;
        let height = sea.depth.map_or(height, |d| height.max(-d));
        let [elevation, pressure, u, v, w, u_rate, v_rate, w_rate] =
            sum_components(&sea.lanes.blocks, &self.phasors, [at.x, at.y], [height, rise]);
        let velocity = Vector3::new(u, v, w);
        let acceleration = Vector3::new(u_rate, v_rate, w_rate) + velocity * self.growth;
        Kinematics { velocity, acceleration, pressure: pressure * sea.density * sea.gravity, elevation }
    }
}

/// Elevation at a place (m).
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn sum_elevation(blocks: &[ComponentBlock], phasors: &[[Lanes8; 2]], [x, y]: [f64; 2]) -> f64 {
    let mut sums = [0.0; 8];
    for (block, [c, s]) in blocks.iter().zip(phasors) {
        let (sin, cos) = sin_cos(&lanes8(|i| block.kx[i] * x + block.ky[i] * y));
        sums = lanes8(|i| sums[i] + c[i] * cos[i] - s[i] * sin[i]);
    }
    sums.iter().sum()
}

/// Elevation, pressure over rho g, velocity and acceleration, each added up over the waves, at a place, a height over the mean
/// level and a rise above it (m).
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn sum_components(
    blocks: &[ComponentBlock],
    phasors: &[[Lanes8; 2]],
    [x, y]: [f64; 2],
    [height, rise]: [f64; 2],
) -> [f64; 8] {
    let mut sums = [[0.0; 8]; 8];
    for (block, [c, s]) in blocks.iter().zip(phasors) {
        let (sin, cos) = sin_cos(&lanes8(|i| block.kx[i] * x + block.ky[i] * y));
        if block.longest * height < VANISHED_EXPONENT {
            sums[0] = lanes8(|i| sums[0][i] + (c[i] * cos[i] - s[i] * sin[i]));
            continue;
        }
        let decay = exp(&lanes8(|i| block.k[i] * height));
        for i in 0..8 {
            let (a_cos, a_sin) = (c[i] * cos[i] - s[i] * sin[i], s[i] * cos[i] + c[i] * sin[i]);
            // cosh(k(z+d)) / sinh(kd) = exp(kz) (1 + exp(-2k(z+d))) / (1 - exp(-2kd)), and so the sine; in deep water
            // exp(-2kd) is 0, and the square of the smallest decay is kept above that
            let mirror = block.q[i] / (decay[i] * decay[i]).max(f64::MIN_POSITIVE);
            let scale = decay[i] * block.whole[i];
            let (cosh, sinh) = (scale * (1.0 + mirror), scale * (1.0 - mirror));
            let along = rise * block.k[i];
            let (w, u) = (block.w[i] * (sinh + along * cosh), block.w[i] * (cosh + along * sinh));
            let rate = block.w[i] * a_sin;
            sums[0][i] += a_cos;
            sums[1][i] += cosh * block.tanh[i] * a_cos;
            sums[2][i] += u * a_cos * block.x[i];
            sums[3][i] += u * a_cos * block.y[i];
            sums[4][i] += w * a_sin;
            sums[5][i] += u * rate * block.x[i];
            sums[6][i] += u * rate * block.y[i];
            sums[7][i] -= w * block.w[i] * a_cos;
        }
    }
    sums.map(|lanes| lanes.iter().sum::<f64>())
}

/// Lanes8 numbers by their index.
#[inline(always)]
fn lanes8(value: impl FnMut(usize) -> f64) -> Lanes8 {
    std::array::from_fn(value)
}
