//! Shear and bending along a body: the forces on what of it lies before a station, and their moment there.
//!
//! Source: [MOSES-REF moment]. Buoyancy and the liquid in compartments are cut by vertical planes across the heading and integrated exactly
//! (under a static wave by its straight pieces); a weight with stations is a trapezoid between them that keeps its weight and center
//! [MOSES-HELP hystat], any other a force at its center. All forces are vertical, and distances are level, along the heading from the
//! origin: in a trimmed body the lever of a high weight counts. Connectors, wind and current have no part.

use super::balance::{Attitude, StillBody};
use super::slabs::WaterSlabs;
use crate::Category;
use crate::hull::SubmergedVolume;
use crate::tank::{Tank, compartments_of};
use nalgebra::Vector3;
use windlass_model::{Body, ClassError, Model};

/// Intervals that the length of a body is cut into for the greatest shear and moment.
const FINE_INTERVALS: usize = 400;
/// A force that is none, as a share of the weight.
const NO_FORCE: f64 = 1e-9;

/// A load along a body (N downward is negative; distances in m along the heading).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LoadAlong {
    /// At a point.
    Point {
        /// Force upward (N).
        force: f64,
        /// Where.
        at: f64,
    },
    /// A trapezoid.
    Trapezoid {
        /// Force upward (N).
        force: f64,
        /// Its center.
        at: f64,
        /// Its ends.
        between: [f64; 2],
    },
}

impl LoadAlong {
    /// The force before a station (N), and its moment there (N m).
    pub fn loads_before(&self, station: f64) -> [f64; 2] {
        match *self {
            LoadAlong::Point { force, at } if at <= station => [force, force * (station - at)],
            LoadAlong::Trapezoid { force, at, between: [_, end] } if end <= station => [force, force * (station - at)],
            LoadAlong::Trapezoid { force, at, between: [start, end] } if start < station => {
                let (length, part) = (end - start, station - start);
                let off = 6.0 * (at - 0.5 * (start + end)) / length;
                let [first, last] = [force / length * (1.0 - off), force / length * (1.0 + off)];
                let growth = (last - first) / length;
                [
                    first * part + 0.5 * growth * part * part,
                    0.5 * first * part * part + growth * part * part * part / 6.0,
                ]
            }
            _ => [0.0; 2],
        }
    }
}

/// What acts before a station.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StrengthRow {
    /// The station (m, along the heading from the origin of the body).
    pub station: f64,
    /// Weight before it (N).
    pub weight: f64,
    /// Weight of liquid in compartments before it (N).
    pub contents: f64,
    /// Buoyancy before it (N).
    pub buoyancy: f64,
    /// Shear: the force upward on what is before it (N).
    pub shear: f64,
    /// Bending moment (N m), positive sagging.
    pub moment: f64,
}

/// Shear and bending along a body.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LongitudinalStrength {
    /// The stations, first to last.
    pub rows: Vec<StrengthRow>,
    /// The greatest shear and the greatest moments of either sign.
    pub extremes: [StrengthRow; 4],
    /// Shear and moment behind all loads: zero in equilibrium (N, N m).
    pub left: [f64; 2],
    /// Its weight with contents (N).
    pub weight: f64,
    /// Its length (m).
    pub length: f64,
    /// Weights that act at a point, for want of stations: how many, and their sum (N).
    pub points: (usize, f64),
    /// Other forces that act at their center: buoyancy of points and members, weight of growth (N upward).
    pub others: f64,
}

/// What acts on a body along its length.
struct Loads {
    weights: Vec<LoadAlong>,
    others: Vec<LoadAlong>,
    /// Liquid and water displaced in each slab: force upward (N), and its moment about the origin (N m).
    slabs: WaterSlabs,
    contents: Vec<[f64; 2]>,
    buoyancy: Vec<[f64; 2]>,
}

/// Finds shear and bending at so many intervals along a body where it stands.
///
/// # Errors
/// A body without a hull; loads that cannot be computed.
pub fn find_strength(
    model: &Model,
    body: &Body,
    still: &StillBody,
    intervals: usize,
) -> Result<LongitudinalStrength, ClassError> {
    let attitude = Attitude::from_place(&body.position);
    let Some([low, high]) = still.reach(&attitude) else {
        return Err(ClassError::new(format!("{} has no hull to bend", body.name))
            .help("PGEN, &SURFACE and &DESCRIBE PIECE give one"));
    };
    let length = high - low;
    let (mut points, mut others) = ((0, 0.0), 0.0);
    let mut weights = Vec::new();
    let pose = attitude.pose();
    let ahead = attitude.ahead();
    let position = |part: &windlass_model::Part, at: [f64; 3]| {
        ahead.dot(&(pose.axes * Vector3::from(part.position.apply(at))).xy())
    };
    for part in model.parts_of(body) {
        for weight in part.weights.iter().filter(|w| w.weight * w.multiplier != 0.0) {
            let (force, at) = (-weight.weight * weight.multiplier, position(part, weight.at));
            let [_, y, z] = weight.at;
            let ends = weight.spread.map(|spread| spread.map(|x| position(part, [x, y, z])));
            weights.push(match ends {
                Some([a, b]) if (a - b).abs() > 1e-9 * length => {
                    LoadAlong::Trapezoid { force, at, between: [a.min(b), a.max(b)] }
                }
                _ => {
                    points = (points.0 + 1, points.1 - force);
                    LoadAlong::Point { force, at }
                }
            });
        }
    }
    // a force by its moment about the level axis across: at a distance s it has the moment -s F
    let [_, across] = attitude.level_axes();
    let (mut heavy, mut own) = ([0.0; 2], [0.0; 2]);
    let mut rest = Vec::new();
    for load in still.loads() {
        let wrench = load.mean_load(&pose)?.wrench;
        let (force, first) = (wrench[2], -wrench.fixed_rows::<3>(3).dot(&across));
        match load.category() {
            Category::Weight => heavy = [heavy[0] + force, heavy[1] + first],
            Category::Buoyancy if load.as_immersed().is_none() && force != 0.0 => {
                rest.push(LoadAlong::Point { force, at: first / force });
                others += force;
            }
            _ => {}
        }
    }
    for weight in &weights {
        let (LoadAlong::Point { force, at } | LoadAlong::Trapezoid { force, at, .. }) = *weight;
        own = [own[0] + force, own[1] + force * at];
    }
    let grown = [heavy[0] - own[0], heavy[1] - own[1]];
    if grown[0].abs() > NO_FORCE * heavy[0].abs() {
        rest.push(LoadAlong::Point { force: grown[0], at: grown[1] / grown[0] });
        others += grown[0];
    }
    let loads = gather(model, body, still, &attitude, [low, high], (weights, rest))?;
    let stations = |count: usize| (0..=count).map(move |n| low + length * n as f64 / count as f64);
    let rows: Vec<StrengthRow> = stations(intervals).map(|at| loads.loads_before(at)).collect();
    let mut found = LongitudinalStrength { rows, length, points, others, ..LongitudinalStrength::default() };
    let ends = loads.weights.iter().chain(&loads.others).flat_map(|load| match *load {
        LoadAlong::Point { at, .. } => [at, at],
        LoadAlong::Trapezoid { between, .. } => between,
    });
    let mut fine: Vec<StrengthRow> = stations(FINE_INTERVALS).chain(ends).map(|at| loads.loads_before(at)).collect();
    // the shear jumps at a force: the greatest may be that just before it
    let jumps: Vec<StrengthRow> = fine.iter().map(|row| loads.without_points_at(row)).collect();
    fine.extend(jumps);
    let extreme = |value: &dyn Fn(&StrengthRow) -> f64| {
        fine.iter().max_by(|a, b| value(a).total_cmp(&value(b))).copied().unwrap_or_default()
    };
    found.extremes = [extreme(&|r| r.shear), extreme(&|r| -r.shear), extreme(&|r| r.moment), extreme(&|r| -r.moment)];
    let furthest = fine.iter().map(|r| r.station).fold(high, f64::max);
    let end = loads.loads_before(furthest);
    found.weight = end.weight + end.contents;
    found.left = [end.shear, end.moment];
    Ok(found)
}

/// The slabs of hull and liquid, cut at every station that is asked for.
fn gather(
    model: &Model,
    body: &Body,
    still: &StillBody,
    attitude: &Attitude,
    [low, high]: [f64; 2],
    (weights, others): (Vec<LoadAlong>, Vec<LoadAlong>),
) -> Result<Loads, ClassError> {
    let (pose, water) = (attitude.pose(), still.water(attitude)?);
    let mut cuts: Vec<f64> =
        (0..=FINE_INTERVALS).map(|n| low + (high - low) * n as f64 / FINE_INTERVALS as f64).collect();
    // a wave is straight between its own stations
    if still.wave().is_some() {
        cuts.extend(water.stations.iter().map(|[at, _]| *at));
    }
    cuts.sort_by(f64::total_cmp);
    cuts.dedup();
    let slabs = WaterSlabs { ahead: water.ahead, stations: cuts.iter().map(|at| [*at, water.level(*at)]).collect() };
    let forces = |wets: &[SubmergedVolume], lift: f64| -> Vec<[f64; 2]> {
        wets.iter().map(|wet| [lift * wet.volume, lift * slabs.ahead.dot(&wet.moment.xy())]).collect()
    };
    let add = |sums: &mut Vec<[f64; 2]>, more: Vec<[f64; 2]>| {
        for (sum, [force, first]) in sums.iter_mut().zip(more) {
            *sum = [sum[0] + force, sum[1] + first];
        }
    };
    let mut buoyancy = vec![[0.0; 2]; slabs.count()];
    let mut contents = buoyancy.clone();
    for load in still.loads().filter(|load| load.category() == Category::Buoyancy) {
        if let Some(immersed) = load.as_immersed() {
            add(&mut buoyancy, forces(&immersed.wet_slabs(&pose, &slabs), immersed.lift()));
        }
    }
    let gravity = model.defaults.gravity;
    for compartment in compartments_of(model, body) {
        let tank = Tank::new(model, compartment)?;
        let liquid = tank.liquid_slabs(&pose, &slabs)?;
        add(&mut contents, forces(&liquid, -tank.density() * gravity));
    }
    Ok(Loads { weights, others, slabs, contents, buoyancy })
}

impl Loads {
    /// A row without the forces at its station.
    fn without_points_at(&self, row: &StrengthRow) -> StrengthRow {
        let here = |load: &LoadAlong| match load {
            LoadAlong::Point { force, at } if *at == row.station => *force,
            _ => 0.0,
        };
        let (weights, others): (f64, f64) = (self.weights.iter().map(here).sum(), self.others.iter().map(here).sum());
        StrengthRow {
            weight: row.weight + weights,
            buoyancy: row.buoyancy - others,
            shear: row.shear - weights - others,
            ..*row
        }
    }

    fn loads_before(&self, station: f64) -> StrengthRow {
        let sum = |loads: &[LoadAlong]| {
            loads.iter().map(|load| load.loads_before(station)).fold([0.0; 2], |a, b| [a[0] + b[0], a[1] + b[1]])
        };
        // stations are ends of slabs, but for those of weights, between which the force of a slab grows evenly
        let part = |slabs: &[[f64; 2]]| {
            let (mut force, mut moment) = (0.0, 0.0);
            for (n, [slab, first]) in slabs.iter().enumerate() {
                let from =
                    n.checked_sub(1).and_then(|n| self.slabs.stations.get(n)).map_or(f64::NEG_INFINITY, |s| s[0]);
                let to = self.slabs.stations.get(n).map_or(f64::INFINITY, |s| s[0]);
                if from >= station {
                    break;
                }
                if to <= station || *slab == 0.0 {
                    force += slab;
                    moment += slab * station - first;
                } else if from.is_finite() && to.is_finite() {
                    let whole = LoadAlong::Trapezoid { force: *slab, at: first / slab, between: [from, to] };
                    let [f, m] = whole.loads_before(station);
                    force += f;
                    moment += m;
                } else {
                    let [f, m] = LoadAlong::Point { force: *slab, at: first / slab }.loads_before(station);
                    force += f;
                    moment += m;
                }
            }
            [force, moment]
        };
        let (weight, other) = (sum(&self.weights), sum(&self.others));
        let (contents, buoyancy) = (part(&self.contents), part(&self.buoyancy));
        StrengthRow {
            station,
            weight: -weight[0],
            contents: -contents[0],
            buoyancy: buoyancy[0] + other[0],
            shear: weight[0] + other[0] + contents[0] + buoyancy[0],
            moment: weight[1] + other[1] + contents[1] + buoyancy[1],
        }
    }
}
