//! Networks of bodies, bridles, clumps, buoys and shared lines: forces at rest by catenaries in closed form that stand here.
//!
//! A line of unstretched length L, weight w a length and axial stiffness EA, whose upper end is pulled by H along and V up, reaches
//! ([IRVINE-1981 2.3]; with a part on a bottom without friction: [JONKMAN-2007 eq. 2-35 to 2-38])
//!     x = H/w (asinh(V/H) - asinh((V - wL)/H)) + HL/EA                                    hanging freely
//!     z = H/w (sqrt(1 + (V/H)^2) - sqrt(1 + ((V - wL)/H)^2)) + (VL - wL^2/2)/EA
//!     x = L - V/w + H/w asinh(V/H) + HL/EA,  z = H/w (sqrt(1 + (V/H)^2) - 1) + V^2/(2 EA w)   with V < wL on the bottom
//! z grows with V at constant H, and x with H along constant z: two bisections, one in the other, find H and V for any ends.

use crate::common;

use nalgebra::{Matrix6, Vector3};
use windlass_base::pose::Pose;
use windlass_model::{LinearHydrostatics, Model};
use windlass_solve::{EquilibriumOptions, find_equilibrium_with_rebuilds, modes};

/// A line by itself.
#[derive(Clone, Copy, Debug)]
struct NetworkLine {
    length: f64,
    weight: f64,
    ea: f64,
    /// Whether its lower end lies on the bottom.
    bottom: bool,
}

impl NetworkLine {
    /// Distances along and up that a pull reaches.
    fn reach(&self, h: f64, v: f64) -> (f64, f64) {
        let NetworkLine { length: l, weight: w, ea, bottom } = *self;
        let root = |t: f64| (1.0 + t * t).sqrt();
        let low = v - w * l;
        if bottom && low < 0.0 {
            let v = v.max(0.0);
            return (
                l - v / w + h / w * (v / h).asinh() + h * l / ea,
                h / w * (root(v / h) - 1.0) + v * v / (2.0 * ea * w),
            );
        }
        // by differences that lose nothing where the line is taut: asinh a - asinh b and sqrt(1 + a^2) - sqrt(1 + b^2)
        let (a, b) = (v / h, low / h);
        let roots = (a * a - b * b) / (root(a) + root(b));
        (h / w * (a.asinh() - b.asinh()) + h * l / ea, h / w * roots + (v * l - 0.5 * w * l * l) / ea)
    }

    /// The pull (H, V) at the upper end for ends `x` apart along and `z` up.
    fn pull(&self, x: f64, z: f64) -> (f64, f64) {
        let most = 1e3 * (self.ea + self.weight * self.length);
        let up = |h: f64| {
            let (mut low, mut high) = (if self.bottom { 0.0 } else { -most }, most);
            for _ in 0..200 {
                let middle = 0.5 * (low + high);
                if self.reach(h, middle).1 < z { low = middle } else { high = middle }
            }
            0.5 * (low + high)
        };
        // by logarithm: a slack line pulls along by next to nothing
        let (mut low, mut high) = ((1e-12 * self.weight * self.length).ln(), most.ln());
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            let h = middle.exp();
            if self.reach(h, up(h)).0 < x { low = middle } else { high = middle }
        }
        let h = (0.5 * (low + high)).exp();
        (h, up(h))
    }

    /// The forces on the upper and on the lower end.
    fn forces(&self, upper: Vector3<f64>, lower: Vector3<f64>) -> [Vector3<f64>; 2] {
        let apart = lower - upper;
        let along = Vector3::new(apart.x, apart.y, 0.0);
        let (h, v) = self.pull(along.norm(), -apart.z);
        let way = along.try_normalize(0.0).unwrap_or_default();
        let (at_upper, low) = (way * h - Vector3::z() * v, v - self.weight * self.length);
        let low = if self.bottom { low.max(0.0) } else { low };
        [at_upper, way * -h + Vector3::z() * low]
    }
}

/// An end of a line of a network.
#[derive(Clone, Debug)]
enum Tip {
    Ground(Vector3<f64>),
    /// A point of a body or junction, by its name without a star: in the body (m).
    On(String, Vector3<f64>),
}

/// A network: its records, its lines, and the bodies that float with their buoyancy.
#[derive(Default)]
struct Network {
    records: String,
    lines: Vec<(NetworkLine, [Tip; 2])>,
    floating: Vec<(String, f64)>,
    junctions: Vec<(String, f64, f64)>,
}

const DEPTH: f64 = 300.0;
/// Heave stiffness (N/m), and roll and pitch stiffness (N m/rad), of a body.
const HEAVE: f64 = 4e6;
const TRIM: f64 = 4e9;

/// Numbers in order: a linear congruential generator (Knuth's MMIX), its upper bits.
struct Seeded(u64);

impl Seeded {
    fn draw(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        low + (high - low) * ((self.0 >> 11) as f64 / (1u64 << 53) as f64)
    }

    fn one_in(&mut self, count: u32) -> bool {
        self.draw(0.0, 1.0) < 1.0 / f64::from(count)
    }
}

impl Network {
    fn class(&mut self, kind: &str, line: &NetworkLine) -> String {
        let name = format!("~L{}", self.lines.len());
        let emod = line.ea / (1e6 * std::f64::consts::FRAC_PI_4 * 0.1 * 0.1);
        let (l, w) = (line.length, line.weight);
        self.records.push_str(&format!("{name} {kind} 100 EXACT -LEN {l} -BUOY 0 -WTPL {w} -EMOD {emod}\n"));
        name
    }

    /// A line from a point to an anchor on the bottom.
    fn add_anchored_line(&mut self, on: (&str, Vector3<f64>, Vector3<f64>), seeded: &mut Seeded) {
        let (name, point, at) = on;
        let angle = seeded.draw(0.0, std::f64::consts::TAU);
        let far = seeded.draw(0.8, 3.0) * (at.z + DEPTH);
        let anchor = Vector3::new(at.x + far * angle.cos(), at.y + far * angle.sin(), -DEPTH);
        let length = (anchor - at).norm() * seeded.draw(1.01, 1.3);
        let line = NetworkLine { length, weight: seeded.draw(200.0, 2000.0), ea: seeded.draw(1e8, 1e9), bottom: true };
        let class = self.class("B_CAT", &line);
        let number = self.lines.len();
        let end = self.point(name, point, number);
        self.records.push_str(&format!("CONNECTOR A{number} -ANC 0 1 {class} *{end}\n"));
        let (x, y) = (anchor.x, anchor.y);
        self.records.push_str(&format!("END\n&CONNECTOR A{number} -ANCHOR {x} {y} {}\nMEDIT\n", -DEPTH));
        self.lines.push((line, [Tip::On(name.to_string(), point), Tip::Ground(anchor)]));
    }

    /// A line between two points of the network, which hangs free of the bottom.
    fn add_shared_line(
        &mut self,
        one: (&str, Vector3<f64>, Vector3<f64>),
        other: (&str, Vector3<f64>, Vector3<f64>),
        seeded: &mut Seeded,
    ) {
        let length = (one.2 - other.2).norm().max(20.0) * seeded.draw(0.97, 1.1);
        let line = NetworkLine { length, weight: seeded.draw(50.0, 800.0), ea: seeded.draw(5e7, 5e8), bottom: false };
        let class = self.class("H_CAT", &line);
        let number = self.lines.len();
        let ends = [self.point(one.0, one.1, 2 * number + 1000), self.point(other.0, other.1, 2 * number + 1001)];
        self.records.push_str(&format!("CONNECTOR S{number} {class} *{} *{}\n", ends[0], ends[1]));
        self.lines.push((line, [Tip::On(one.0.to_string(), one.1), Tip::On(other.0.to_string(), other.1)]));
    }

    /// The name of a point of a body, made where it is needed; a junction's is its own.
    fn point(&mut self, name: &str, at: Vector3<f64>, number: usize) -> String {
        if name.starts_with('J') {
            return name.to_string();
        }
        self.records.push_str(&format!("&DESCRIBE BODY {name}\n*F{number} {} {} {}\n", at.x, at.y, at.z));
        format!("F{number}")
    }

    /// A cluster of one to four bodies and junctions, each joined to the one before, each with lines to anchors; bodies by a bridle now and then.
    fn cluster(&mut self, number: usize, centre: Vector3<f64>, seeded: &mut Seeded) {
        let count = seeded.draw(1.0, 4.99) as usize;
        let mut before: Option<(String, Vector3<f64>, Vector3<f64>)> = None;
        for i in 0..count {
            let mut at = centre + Vector3::new(150.0 * i as f64, seeded.draw(-60.0, 60.0), 0.0);
            let is_body = seeded.one_in(2);
            let name = format!("{}{number}N{i}", if is_body { 'B' } else { 'J' });
            let point = |s: &mut Seeded| {
                if is_body {
                    Vector3::new(s.draw(-20.0, 20.0), s.draw(-10.0, 10.0), s.draw(-8.0, 2.0))
                } else {
                    Vector3::zeros()
                }
            };
            if is_body {
                let weight = seeded.draw(5e6, 5e7);
                self.records
                    .push_str(&format!("&DESCRIBE BODY {name}\n*G{name} 0 0 0\n#WEIGHT *G{name} {weight} 8 9 12\n"));
                self.records.push_str(&format!("END\n&INSTATE -LOCATE {name} {} {} 0\nMEDIT\n", at.x, at.y));
                self.floating.push((name.clone(), weight));
            } else {
                at.z = seeded.draw(-200.0, -10.0);
                let (weight, buoyancy) =
                    (seeded.draw(0.0, 8e4), if seeded.one_in(2) { seeded.draw(2e5, 9e5) } else { 0.0 });
                self.records.push_str(&format!(
                    "JUNCTION {name} {} {} {} -WEIGHT {weight} -DISPLACEMENT {buoyancy}\n",
                    at.x, at.y, at.z
                ));
                self.junctions.push((name.clone(), weight, buoyancy));
            }
            for _ in 0..seeded.draw(1.0, 4.99) as usize {
                let on = point(seeded);
                self.add_anchored_line((&name, on, at + on), seeded);
            }
            if is_body && seeded.one_in(2) {
                let knot = format!("J{number}K{i}");
                let position = at + Vector3::new(seeded.draw(30.0, 60.0), seeded.draw(-30.0, 30.0), -40.0);
                self.records
                    .push_str(&format!("JUNCTION {knot} {} {} {} -WEIGHT 1000\n", position.x, position.y, position.z));
                self.junctions.push((knot.clone(), 1000.0, 0.0));
                for side in [-8.0, 8.0] {
                    let on = Vector3::new(15.0, side, -4.0);
                    self.add_shared_line((&name, on, at + on), (&knot, Vector3::zeros(), position), seeded);
                }
                self.add_anchored_line((&knot, Vector3::zeros(), position), seeded);
            }
            if let Some((other, on, position)) = &before {
                let own = point(seeded);
                self.add_shared_line((&name, own, at + own), (other, *on, *position), seeded);
            }
            let own = point(seeded);
            before = Some((name, own, at + own));
        }
    }

    fn model(&self) -> Model {
        let (mut session, screen, _folder) = common::session();
        let text = format!("&DIMEN -DIMEN METERS N\n&ENV -DEPTH {DEPTH}\nMEDIT\n{}END\n", self.records);
        session.open("records", text);
        session.run();
        let wrong = session.reports.iter().any(|r| r.severity == windlass_base::diagnostic::Severity::Error);
        assert!(!wrong, "{}\n{}", screen.text(), self.records);
        let mut model = session.job.model.clone();
        for (name, weight) in &self.floating {
            let stiffness = Matrix6::from_diagonal(&[0.0, 0.0, HEAVE, TRIM, TRIM, 0.0].into());
            let linear = LinearHydrostatics {
                at: [0.0; 3],
                height: 0.0,
                buoyancy: *weight,
                stiffness,
                span: Default::default(),
            };
            model.bodies.get_mut(name.as_str()).unwrap().linear = Some(linear);
        }
        model
    }

    /// The largest force that is left, over the largest at an end of a line there: in X, Y and Z of all, and the moment about Z of bodies.
    fn residual(&self, model: &Model) -> (f64, String) {
        let pose = |name: &str| Pose::from_place(&model.bodies[name].position);
        let water = model.surroundings().water_weight();
        let mut sums: std::collections::BTreeMap<&str, (Vector3<f64>, f64, f64)> = Default::default();
        for (name, weight) in &self.floating {
            let z = pose(name).origin.z;
            sums.insert(name, (Vector3::z() * -HEAVE * z, 0.0, *weight));
        }
        for (name, weight, buoyancy) in &self.junctions {
            let radius = (0.75 * buoyancy / water / std::f64::consts::PI).cbrt();
            let h = (radius - pose(name).origin.z).clamp(0.0, 2.0 * radius);
            let share = if radius > 0.0 { h * h * (3.0 * radius - h) / (4.0 * radius.powi(3)) } else { 0.0 };
            sums.insert(name, (Vector3::z() * (share * buoyancy - weight), 0.0, weight.max(*buoyancy)));
        }
        for (line, tips) in &self.lines {
            let position = |tip: &Tip| match tip {
                Tip::Ground(at) => *at,
                Tip::On(name, at) => pose(name).point(*at),
            };
            let ends = [position(&tips[0]), position(&tips[1])];
            let forces = if ends[0].z >= ends[1].z {
                line.forces(ends[0], ends[1])
            } else {
                let [upper, lower] = line.forces(ends[1], ends[0]);
                [lower, upper]
            };
            for ((tip, at), force) in tips.iter().zip(ends).zip(forces) {
                if let Tip::On(name, _) = tip {
                    let sum = sums.get_mut(name.as_str()).unwrap();
                    let arm = at - pose(name).origin;
                    sum.0 += force;
                    sum.1 += arm.x * force.y - arm.y * force.x;
                    sum.2 = sum.2.max(force.norm());
                }
            }
        }
        let mut worst = (0.0, String::new());
        for (name, (mut force, moment, size)) in sums {
            // the bottom carries what lies on it
            if pose(name).origin.z < -DEPTH + 0.011 {
                force.z = force.z.max(0.0);
            }
            let moment = if name.starts_with('B') { moment.abs() / 10.0 } else { 0.0 };
            let left = force.norm().max(moment) / size;
            if left > worst.0 {
                worst = (left, format!("{name}: {force:?} and {moment} of {size} at {:?}", pose(name).origin));
            }
        }
        worst
    }
}

#[test]
fn unconnected_junctions_settle_with_one_slow_junction() {
    let records = "&DIMEN -DIMEN METERS N\n&ENV -DEPTH 329\nMEDIT\nJUNCTION J2 -387 171 -109 -WEIGHT 10000 -DISPLACEMENT 1.66E5\n\
                   JUNCTION J1 208 235 -79.8\n~C1 B_CAT 120 EXACT -LEN 1240 -BUOY 0 -WTPL 743 -EMOD 80000\n\
                   CONNECTOR L1 -ANC 0 1 ~C1 *J1\nEND\n&CONNECTOR L1 -ANCHOR 978 1100 -329\n";
    let (mut session, _screen, _folder) = common::session();
    session.open("records", records.to_string());
    session.run();
    let mut model = session.job.model.clone();
    let found = find_equilibrium_with_rebuilds(&mut model, &EquilibriumOptions::default()).unwrap();
    assert!(found.found.search.iterations < 60, "{:?}", found.found);
    // the line hangs straight down from nothing: it lies on the bottom, and so does its end; scipy's fsolve of the catenary above gives
    // H = V = 0 for ends less than 1240 m apart at one height
    let end = Vector3::from(model.bodies["J1"].position.shift);
    assert!((end - Vector3::new(978.0, 1100.0, -329.0)).norm() < 1240.0 && end.z + 329.0 < 0.011, "{end:?}");
    // the buoy floats with 10/166 of its volume in the water: h^2 (3R - h) = 4 R^3 10/166, by scipy.optimize.brentq h/R = 0.29866674520142716
    let water = model.surroundings().water_weight();
    let radius = (0.75 * 1.66e5 / water / std::f64::consts::PI).cbrt();
    let z = model.bodies["J2"].position.shift[2];
    assert!((z - radius * (1.0 - SHARE_OF_RADIUS)).abs() < 1e-6, "{z} {radius}");
}

/// Depth of a floating sphere's lowest point over its radius, with 10/166 of its volume under water.
const SHARE_OF_RADIUS: f64 = 0.29866674520142716;

#[test]
fn random_networks_match_closed_form_catenary_balance() {
    let (mut refused, mut stable) = (Vec::new(), 0);
    let mut worst = (0.0, String::new());
    for number in 0..NETWORKS {
        let mut seeded = Seeded(9_000 + 17 * number);
        let mut network = Network::default();
        for cluster in 0..seeded.draw(1.0, 3.99) as usize {
            network.cluster(cluster, Vector3::new(0.0, 2500.0 * cluster as f64, 0.0), &mut seeded);
        }
        let mut model = network.model();
        // as &EQUI has it; where that is stable, once more to a thousandth of what it leaves
        let mut allowed = 1e-3;
        match find_equilibrium_with_rebuilds(
            &mut model,
            &EquilibriumOptions { most: 200, ..EquilibriumOptions::default() },
        ) {
            Ok(found) => {
                if modes(&found.system, &found.state).unwrap().iter().all(|m| m.eigenvalue > -1e-6) {
                    (allowed, stable) = (TOLERANCE, stable + 1);
                    let fine =
                        EquilibriumOptions { most: 200, tolerance: [TOLERANCE; 2], ..EquilibriumOptions::default() };
                    refused
                        .extend(find_equilibrium_with_rebuilds(&mut model, &fine).err().map(|error| (number, error)));
                }
            }
            Err(error) => refused.push((number, error)),
        }
        let (left, what) = network.residual(&model);
        if left / allowed > worst.0 {
            worst = (left / allowed, format!("network {number}, {what}"));
        }
    }
    assert!(refused.is_empty(), "{} of {NETWORKS} refused: {refused:#?}", refused.len());
    // some bridles rest upside down, where nothing pushes them
    assert!(stable >= STABLE, "{stable}");
    assert!(worst.0 < 1.01, "{worst:?}");
}

/// Networks of the test.
const NETWORKS: u64 = 120;
/// Of them, those that rest where they are stable.
const STABLE: u64 = 110;
/// Largest acceleration left in the second search, as a share of gravity: the forces left over the weight or the largest force there are
/// no more, but for 1e-10 by which the bisections err.
const TOLERANCE: f64 = 1e-6;
