//! Falls by which a rod comes to rest: see [`Solver::statics`].

use super::error::RodError;
use super::mesh::{Element, Rod};
use super::step::Solver;
use super::surroundings::World;
use super::tension::{Stretch, Taken, tension};
use super::trial::{largest, sample, turn};
use nalgebra::Vector3;

/// Newton iterations after which one fall is cut short.
const MOST_INNER: usize = 12;
/// Newton iterations after which a loose or softened rod is taken as it lies.
const MOST_LOOSE: usize = 3000;
/// Strain of a softened rod under its own weight.
const EASY: f64 = 0.01;
/// How much stiffer it is taken each time it has come to rest.
const STIFFER: f64 = 30.0;
/// Longest fall, in first falls: Newton's iteration on the forces alone is left, as what the masses add is a
/// million-millionth of what they are in the first one.
const LONGEST: f64 = 1e6;
/// Shortest fall, in first falls: a node moves by a million-million-millionth of what it does in the first one, which is
/// rounding.
const SHORTEST: f64 = 1e-9;
/// Acceleration that falls are paced by where there is next to no weight (m/s2): some number that is not zero, as nothing
/// else than how soon the falls have the right length goes by it.
const LIGHT: f64 = 1.0;
/// Least mass by which the falls of a rod are paced, as a share of that of what is attached to it.
const ATTACHED: f64 = 1e-3;
/// Strain below which a start is too short.
const SHORT: f64 = -0.01;
/// Largest residual of a node as a share of the largest force in the rod.
const PROOF: f64 = 1e-9;

/// Share of the weight of a rod that may be left of its balance where no fall comes any nearer to rest.
const ALMOST: f64 = 1e-7;

impl Solver {
    /// A row of falls from the trial to rest: iterations done so far, and how many there may be.
    ///
    /// With friction it is no looser than it is: the start is near the shape it comes to.
    pub(super) fn fall_to_rest(
        &mut self,
        rod: &Rod,
        world: &World,
        mass: &[f64],
        done: &mut usize,
        most_iterations: usize,
    ) -> Result<(), RodError> {
        let last = rod.elements.len();
        let weight = weight(rod, world);
        if !self.trial.stiff() && !self.trial.held && !self.stands {
            // a start that is much too short would buckle in all its elements at once: it first falls as a chain does
            let strains =
                rod.elements.iter().zip(self.trial.x.windows(2)).map(|(e, x)| (x[1] - x[0]).norm() / e.rest - 1.0);
            self.trial.loose = strains.fold(0.0, f64::min) < SHORT;
            // and one that is stiff by its weight falls more easily as a softer one
            let stiffness = rod.segments.iter().map(|s| s.axial.at(0.0).1).fold(0.0, f64::max);
            self.trial.ease = (weight / (EASY * stiffness)).min(1.0);
            if self.trial.ease == 0.0 {
                self.trial.ease = 1.0;
            }
        }
        let mut from = self.trial.x.clone();
        let mut director = self.trial.director.clone();
        let mut pseudo = first_fall(rod, world);
        // the longest fall that is worth a try
        let (most, least) = (LONGEST * pseudo, SHORTEST * pseudo);
        let mut longest = most;
        let mut worst = (0, f64::INFINITY);
        while *done < most_iterations && pseudo > least {
            if world.fluid.interrupted() {
                (self.trial.loose, self.trial.ease) = (false, 1.0);
                return Err(RodError::Interrupted { rod: rod.name.clone() });
            }
            let mut before = f64::INFINITY;
            let mut settled = None;
            for inner in 1..=MOST_INNER {
                *done += 1;
                match self.fall(rod, world, mass, &from, pseudo) {
                    Fall::Rest | Fall::Unstable if self.trial.loose || self.trial.ease < 1.0 => {
                        self.trial.loose = false;
                        self.trial.ease = (self.trial.ease * STIFFER).min(1.0);
                        from.copy_from_slice(&self.trial.x);
                        director.copy_from_slice(&self.trial.director);
                        pseudo = first_fall(rod, world);
                        break;
                    }
                    Fall::Rest => return Ok(()),
                    Fall::Unstable => {
                        // pushed aside by a hair, the same way every time
                        let hair = 1e-6 * rod.length() / last as f64;
                        for (i, x) in self.trial.x.iter_mut().enumerate().skip(1).take(last - 1) {
                            let s = i as f64;
                            *x += Vector3::new((1.3 * s).sin(), (2.1 * s).cos(), (0.7 * s).sin()) * hair;
                        }
                        from.copy_from_slice(&self.trial.x);
                        director.copy_from_slice(&self.trial.director);
                        pseudo = first_fall(rod, world);
                        break;
                    }
                    Fall::Lost => break,
                    Fall::Moved { share, worst: found } => {
                        worst = found;
                        if share > 0.5 * before && inner > 2 {
                            break;
                        }
                        before = share;
                        if share < 1e-3 {
                            settled = Some(inner);
                            break;
                        }
                    }
                }
            }
            if (self.trial.loose || self.trial.ease < 1.0) && *done > MOST_LOOSE {
                (self.trial.loose, self.trial.ease) = (false, 1.0);
                pseudo = first_fall(rod, world);
            }
            match settled {
                Some(inner) => {
                    self.relay(rod, world);
                    from.copy_from_slice(&self.trial.x);
                    director.copy_from_slice(&self.trial.director);
                    longest = (longest * 1.3f64).min(most);
                    pseudo = (pseudo
                        * if inner <= 3 {
                            4.0
                        } else if inner <= 6 {
                            2.0
                        } else {
                            1.0
                        })
                    .min(longest);
                }
                None => {
                    self.trial.x.copy_from_slice(&from);
                    self.trial.director.copy_from_slice(&director);
                    longest = 0.7 * pseudo;
                    pseudo *= 0.4;
                }
            }
        }
        let whole = !self.trial.loose && self.trial.ease == 1.0;
        (self.trial.loose, self.trial.ease) = (false, 1.0);
        if whole && self.left(rod, world) <= ALMOST * weight {
            return Ok(());
        }
        if let Some(element) = rod.overstretched(&self.trial.x) {
            let why = format!("element {} is stretched beyond the most that its law of tension bears", element + 1);
            return Err(RodError::Shape { rod: rod.name.clone(), why });
        }
        Err(RodError::Statics {
            rod: rod.name.clone(),
            iterations: *done,
            residual: worst.1,
            element: worst.0.clamp(1, last),
        })
    }

    /// Largest force (N) that is out of balance where the trial is.
    pub(super) fn left(&mut self, rod: &Rod, world: &World) -> f64 {
        sample(world, self.trial.time, &mut self.trial);
        self.trial.fluid.iter_mut().for_each(|fluid| fluid.acceleration = Vector3::zeros());
        self.work.forces(rod, world, &self.trial);
        self.work.worst(self.trial.ends.map(|e| e.motion.is_some())).1
    }

    /// One Newton iteration of a fall that began at `from`.
    pub(super) fn fall(&mut self, rod: &Rod, world: &World, mass: &[f64], from: &[Vector3<f64>], pseudo: f64) -> Fall {
        let last = rod.elements.len();
        let known = self.trial.ends.map(|e| e.motion.is_some());
        sample(world, self.trial.time, &mut self.trial);
        for fluid in &mut self.trial.fluid {
            fluid.acceleration = Vector3::zeros();
        }
        self.work.assemble(rod, world, &self.trial, self.weights, 0..last);
        self.work.keep_ends();
        let worst = self.work.worst(known);
        if !worst.1.is_finite() {
            return Fall::Lost;
        }
        let rest = worst.1 <= self.forces_told(rod, world);
        // a state that rests is looked at on its own; what would grow slower than this it may
        let pseudo = if rest { 100.0 * first_fall(rod, world) } else { pseudo };
        for (node, m) in mass.iter().enumerate() {
            let inertia = m / (pseudo * pseudo);
            self.work.stiffen(node, inertia, &((self.trial.x[node] - from[node]) * inertia));
        }
        self.creep(rod, world, from, first_fall(rod, world) / pseudo);
        for (side, node) in [(0, 0), (1, last)] {
            if known[side] {
                self.work.drop_residual(node);
                self.work.fix(node);
            }
        }
        match (self.work.factor(), rest) {
            (Ok(_), true) if self.settings.unstable => return Fall::Rest,
            (Ok(_), false) if self.settings.unstable => {}
            (Ok(0), true) => return Fall::Rest,
            (_, true) => return Fall::Unstable,
            (Ok(0), false) => {}
            // with a negative pivot the step would go up to a saddle of the energy
            (_, false) => return Fall::Lost,
        }
        self.work.newton(&mut self.change);
        let (stride, shortest) = (self.work.stride(), rod.shortest());
        let size = largest(&self.change, stride, shortest);
        if size > 2.0 * rod.length() {
            return Fall::Lost;
        }
        turn(&mut self.trial.director, &self.trial.x, &self.change, stride, known);
        for i in 0..=last {
            let d = &self.change[stride * i..stride * i + 3];
            self.trial.x[i] += Vector3::new(d[0], d[1], d[2]);
        }
        Fall::Moved { share: self.share_moved(rod, size), worst }
    }

    /// The change at hand, of which a coordinate changes by `size` at most (m), as a share of what Newton's iteration follows: of the shortest
    /// element; of a stiff rod, which moves far without bending much, the largest change of an edge as a share of its element.
    pub(super) fn share_moved(&self, rod: &Rod, size: f64) -> f64 {
        if !self.stands {
            return size / rod.shortest();
        }
        let stride = self.work.stride();
        let pairs = self.change.chunks_exact(stride).zip(self.change.chunks_exact(stride).skip(1));
        let edge = |((a, b), element): ((&[f64], &[f64]), &Element)| {
            let square: f64 = a.iter().zip(b).take(3).map(|(a, b)| (b - a) * (b - a)).sum();
            square.sqrt() / element.rest
        };
        let turns = self.change.chunks_exact(stride).flat_map(|node| node[3..].iter().map(|turn| turn.abs()));
        pairs.zip(&rod.elements).map(edge).chain(turns).fold(0.0, f64::max)
    }

    /// Tension (N) of an element of the trial, at rest, with what heat and pressure do to it.
    pub(super) fn pull(&self, rod: &Rod, world: &World, i: usize) -> f64 {
        let (element, trial) = (&rod.elements[i], &self.trial);
        let (a, b) = (&trial.x[i], &trial.x[i + 1]);
        let strain = (b - a).norm() / element.rest - 1.0;
        let stretched = Stretch { strain, rate: 0.0, height: 0.5 * (a.z + b.z), datum: trial.origin.z };
        let taken = Taken { compression: element.compression, ease: 1.0 };
        let fluids = [&trial.fluid[i], &trial.fluid[i + 1]];
        tension(rod, element, taken, &stretched, trial.memory.get(i), fluids, world.gravity).value
    }

    /// The least residual that can be told from nothing (N): a share of the largest force in the rod, or what rounding of
    /// positions makes through its stiffness.
    fn forces_told(&self, rod: &Rod, world: &World) -> f64 {
        let weight = weight(rod, world);
        let place = self.trial.x.iter().fold(0.0, |most: f64, x| most.max(x.amax()));
        let mut told = PROOF * weight;
        for (i, (element, x)) in rod.elements.iter().zip(self.trial.x.windows(2)).enumerate() {
            told = told.max(PROOF * self.pull(rod, world, i).abs());
            // also one that is slack gets taut by the rounding of a position
            let strain = (x[1] - x[0]).norm() / element.rest - 1.0;
            let slope = rod.segments[element.segment].axial.at(strain).1;
            let stiffness = slope / element.rest + 10.0 * element.bending / element.rest.powi(3);
            told = told.max(32.0 * f64::EPSILON * place * stiffness);
        }
        told
    }
}

/// Pseudo-time of the first fall (s): that in which a stone falls some thousandths of the length.
pub(super) fn first_fall(rod: &Rod, world: &World) -> f64 {
    (0.01 * rod.length() / world.gravity.abs().max(LIGHT)).sqrt()
}

/// What an iteration of a fall came to.
pub(super) enum Fall {
    /// Forces are in balance, and any move would meet resistance.
    Rest,
    /// Forces are in balance as those of a strut that is about to buckle.
    Unstable,
    /// No step could be made.
    Lost,
    /// The largest move as a share of the shortest element, and where the largest residual was (N).
    Moved { share: f64, worst: (usize, f64) },
}

/// Weight of a rod in air, with what is attached (N).
pub(super) fn weight(rod: &Rod, world: &World) -> f64 {
    let own = rod.elements.iter().map(|e| 2.0 * e.mass).sum::<f64>();
    (own + rod.attachments.iter().map(|a| a.mass).sum::<f64>()) * world.gravity.abs()
}

/// Mass of each node (kg), by which falls are paced. The water it displaces is left out: falls get as long as they are
/// easily found, and a rope that floats up comes to rest in no more of them than one that sinks.
///
/// Where the rod is loaded or bends by more than its weight, falls that its own mass paces are too long for these forces. Along its
/// length it then has as much mass as they would weigh; and it has no less than a share of what is attached to it.
pub(super) fn masses(rod: &Rod, world: &World) -> Vec<f64> {
    let given: f64 = world.forces.iter().map(|(_, force)| force.norm()).sum();
    let whole = weight(rod, world);
    let attached = rod.attachments.iter().map(|a| a.mass).sum::<f64>() * world.gravity.abs();
    let beyond = (given.max(rod.bending_force()) - whole).max(ATTACHED * attached - (whole - attached)).max(0.0);
    let more = beyond / world.gravity.abs().max(LIGHT) / rod.length();
    let mut mass = vec![0.0; rod.nodes()];
    for (i, element) in rod.elements.iter().enumerate().filter(|_| more > 0.0) {
        mass[i] += 0.5 * more * element.rest;
        mass[i + 1] += 0.5 * more * element.rest;
    }
    for (i, element) in rod.elements.iter().enumerate() {
        mass[i] += element.mass;
        mass[i + 1] += element.mass;
    }
    for a in &rod.attachments {
        mass[a.node] += a.mass;
    }
    mass
}
