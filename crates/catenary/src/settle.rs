//! The search for the places where a chain touches the bottom or is held, and for the forces between them.

use super::chain::{Chain, Held, Rested, Stand};
use super::element::{Element, Part};
use super::policy::{Policy, Section, first_policy};
use super::refused::LineError;

/// A chain to be rested at given tensions along the bottom.
pub struct Problem<'a> {
    chain: &'a Chain,
    top: f64,
    bottom: f64,
    /// Tension along t at the upper end of each piece, and where it leaves the bottom.
    tensions: Vec<f64>,
    leaves: Vec<f64>,
    /// Heights along n of the steps of each joint's lift.
    steps: Vec<Vec<f64>>,
    places: Vec<f64>,
    policy: Policy,
    /// Forces q of the last solution, to begin with.
    near: Vec<(f64, f64)>,
}

/// Changes of the policy all at once, and after that one at a time.
const MANY: usize = 30;
const MOST_CHANGES: usize = 300;
/// Newton steps after which a search gives up.
const MOST_STEPS: usize = 200;

impl<'a> Problem<'a> {
    pub fn new(chain: &'a Chain, p: f64, top: f64, bottom: f64, near: Option<&Rested>) -> Problem<'a> {
        let count = chain.elements.len();
        let near = near.filter(|n| n.held.len() == count);
        let policy = near.map_or_else(|| first_policy(chain), |n| n.policy.clone());
        let all = |f: fn(&Held) -> f64| near.map_or_else(|| vec![p; count], |n| n.held.iter().map(f).collect());
        let coupled = chain.ground.friction > 0.0 || chain.ground.tilt.sin != 0.0;
        let (mut tensions, mut leaves) =
            if coupled { (all(|h| h.p_hi), all(|h| h.leave)) } else { (vec![p; count], vec![p; count]) };
        if let (Some(first), false) = (tensions.first_mut(), leaves.is_empty()) {
            *first = p;
        }
        if near.is_none() {
            // a slope takes its share before friction is known
            let mut at = p;
            for (i, element) in chain.elements.iter().enumerate() {
                let (_, fall) = element.fall(&chain.ground);
                if let (Some(t), Some(l)) = (tensions.get_mut(i), leaves.get_mut(i)) {
                    (*t, *l) = (at, (at - fall).max(chain.ground.least));
                }
                at -= fall;
            }
        }
        let mut made = Problem {
            chain,
            top,
            bottom,
            tensions,
            leaves,
            steps: Vec::new(),
            places: vec![0.0; count + 1],
            policy,
            near: near.map_or_else(Vec::new, |n| n.held.iter().map(|h| (h.q_hi, h.q_lo)).collect()),
        };
        made.place_steps();
        made
    }

    fn place_steps(&mut self) {
        let tilt = self.chain.ground.tilt;
        let along = |j: usize| self.places.get(j + 1).copied().unwrap_or(0.0) * tilt.sin;
        let one = |(j, pull): (usize, &super::chain::Pull)| {
            pull.steps.iter().map(|(z, _)| (z - along(j)) / tilt.cos).collect::<Vec<f64>>()
        };
        self.steps = self.chain.pulls.iter().enumerate().map(one).collect();
    }

    /// Brings in a share of what friction and slope make of a solution; how much they change.
    pub fn follow(&mut self, rested: &Rested, p: f64, at: f64, share: f64) -> f64 {
        let ground = &self.chain.ground;
        let mut tensions = vec![p];
        for j in 0..self.chain.pulls.len() {
            let value = |list: &[f64]| list.get(j).copied().unwrap_or(0.0);
            let above = rested.held.get(j).map_or(p, |h| h.p_lo);
            let taken = ground.friction * value(&rested.reactions);
            let next = above + value(&rested.lifts) * ground.tilt.sin - taken;
            let lies = rested.policy.stands.get(j) == Some(&Stand::Bottom);
            tensions.push(if lies { next.max(ground.least) } else { next });
        }
        let leaves: Vec<f64> = rested.held.iter().map(|h| h.leave.max(ground.least)).collect();
        let mut places = vec![at];
        let mut place = at;
        for held in rested.held.iter().rev() {
            place += held.t;
            places.push(place);
        }
        places.reverse();
        let off = |a: &[f64], b: &[f64]| a.iter().zip(b).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
        let size = tensions.iter().fold(p.abs() + ground.least, |m: f64, t| m.max(t.abs()));
        let mut change = off(&tensions, &self.tensions).max(off(&leaves, &self.leaves)) / size;
        if ground.tilt.sin != 0.0 {
            change = change.max(off(&places, &self.places) / (self.chain.length() + place.abs()));
        }
        self.near = rested.held.iter().map(|h| (h.q_hi, h.q_lo)).collect();
        for (list, next) in [(&mut self.tensions, tensions), (&mut self.leaves, leaves), (&mut self.places, places)] {
            list.iter_mut().zip(next).for_each(|(old, new)| *old += share * (new - *old));
        }
        self.policy = rested.policy.clone();
        self.place_steps();
        change
    }

    /// Policy iteration.
    pub fn settle(&mut self) -> Result<Rested, LineError> {
        let mut iterations = 0;
        for change in 0..MOST_CHANGES {
            let rested = self.solve()?;
            iterations += rested.iterations;
            let next = self.better(&rested, change >= MANY);
            if next == self.policy {
                return Ok(Rested { iterations, ..rested });
            }
            self.near = rested.held.iter().map(|h| (h.q_hi, h.q_lo)).collect();
            self.policy = next;
        }
        let force = self.tensions.first().copied().unwrap_or(0.0);
        Err(LineError::NotConverged { force, residual: f64::NAN, iterations })
    }

    /// The height of a joint that stands fast.
    fn height(&self, joint: usize) -> f64 {
        match self.policy.stands.get(joint) {
            Some(Stand::Step(k)) => self.steps.get(joint).and_then(|s| s.get(*k)).copied().unwrap_or(0.0),
            _ => 0.0,
        }
    }

    /// The chain under the present policy.
    fn solve(&self) -> Result<Rested, LineError> {
        let ground = &self.chain.ground;
        let count = self.chain.elements.len();
        let mut rested = Rested { policy: self.policy.clone(), ..Rested::default() };
        let start = |i: usize| {
            let p = self.tensions.get(i).copied().unwrap_or(0.0);
            let leave = self.leaves.get(i).copied().unwrap_or(p);
            Held { p_hi: p, leave, rests: self.policy.rests.get(i).copied().unwrap_or(false), ..Held::default() }
        };
        rested.held = (0..count).map(start).collect();
        for section in self.policy.sections(count) {
            let from =
                section.start_joint().map_or(if section.begins_with_leg { 0.0 } else { self.top }, |j| self.height(j));
            let to = match section.end_joint(count) {
                Some(j) => self.height(j),
                None if section.ends_with_leg => 0.0,
                None => self.bottom,
            };
            self.solve_section(&section, from - to, &mut rested)?;
        }
        for (element, held) in self.chain.elements.iter().zip(&mut rested.held) {
            if !held.rests {
                let (_, along) = element.fall(ground);
                held.p_lo = held.p_hi - along;
                held.leave = held.p_lo;
                (held.t, held.above) = (held.upper.t, element.length());
                continue;
            }
            let (_, along) = element.per_length(ground);
            let (above, below) = (element.leg(ground, held.q_hi), element.leg(ground, held.q_lo));
            let touch = (held.p_hi - along * above).max(ground.least);
            held.above = above;
            held.ground = element.length() - above - below;
            let rest = element.rest(ground, touch, held.ground.max(0.0));
            held.lacks = touch + along * above - held.p_hi;
            held.p_hi += held.lacks;
            held.leave = rest.p.max(ground.least);
            held.p_lo = rest.p - along * below;
            held.t = held.upper.t + held.lower.t + rest.t;
            held.ground_stretched = rest.stretched;
        }
        let mut n = self.top;
        rested.n.push(n);
        for (i, held) in rested.held.iter().enumerate() {
            n = match self.policy.stands.get(i) {
                None => self.bottom,
                Some(Stand::Free(_)) if held.rests => -held.lower.n,
                Some(Stand::Free(_)) => n - held.upper.n,
                Some(_) => self.height(i),
            };
            rested.n.push(n);
        }
        for (j, pull) in self.chain.pulls.iter().enumerate() {
            let force = |h: Option<&Held>, f: fn(&Held) -> f64| h.map_or(0.0, f);
            let line = force(rested.held.get(j), |h| h.q_lo) - force(rested.held.get(j + 1), |h| h.q_hi);
            let (lift, reaction) = match self.policy.stands.get(j) {
                Some(Stand::Free(k)) => (pull.passed(*k), 0.0),
                Some(Stand::Step(_)) => (-line / ground.tilt.cos, 0.0),
                _ => (pull.lift, -line - pull.lift * ground.tilt.cos),
            };
            rested.lifts.push(lift);
            rested.reactions.push(reaction);
        }
        rested.t = rested.held.iter().map(|h| h.t).sum();
        Ok(rested)
    }

    /// q at the upper end of a section, from its drop.
    fn solve_section(&self, section: &Section, drop: f64, rested: &mut Rested) -> Result<(), LineError> {
        let elements = &self.chain.elements;
        let ground = &self.chain.ground;
        let run: Vec<(usize, &Element)> =
            elements.iter().enumerate().skip(section.from).take(section.to + 1 - section.from).collect();
        let lone_leg = run.len() == 1 && (section.begins_with_leg || section.ends_with_leg);
        if lone_leg && drop == 0.0 {
            for held in rested.held.iter_mut().skip(section.from).take(1) {
                let none = Part { n_q: f64::INFINITY, ..Part::default() };
                if section.begins_with_leg {
                    (held.q_lo, held.lower) = (0.0, none);
                } else {
                    (held.q_hi, held.upper) = (0.0, none);
                }
            }
            return Ok(());
        }
        let walk = |q: f64, held: &mut [Held]| {
            let (mut q, mut n, mut n_q) = (q, 0.0, 0.0);
            for (i, element) in &run {
                let Some(held) = held.get_mut(*i) else { continue };
                let (p, leave) = (held.p_hi, held.leave);
                let part = if *i == section.from && section.begins_with_leg {
                    held.lower = element.lower_leg(ground, leave, q);
                    held.q_lo = q;
                    held.lower
                } else if *i == section.to && section.ends_with_leg {
                    held.upper = element.upper_leg(ground, p, q);
                    held.q_hi = q;
                    held.upper
                } else {
                    held.upper = element.whole(ground, p, q);
                    held.q_hi = q;
                    held.q_lo = q - element.fall(ground).0;
                    held.upper
                };
                n += part.n;
                n_q += part.n_q;
                if let (Some(Stand::Free(k)), Some(pull)) = (self.policy.stands.get(*i), self.chain.pulls.get(*i)) {
                    q = held.q_lo + pull.passed(*k) * ground.tilt.cos;
                }
            }
            (n, n_q)
        };
        let length: f64 = run.iter().map(|(_, e)| e.length()).sum();
        let weight: f64 = run.iter().map(|(_, e)| e.weight()).sum();
        let pulled: f64 = run.iter().filter_map(|(i, _)| self.chain.pulls.get(*i)).map(|p| p.lift.abs()).sum();
        let p = self.tensions.get(section.from).copied().unwrap_or(0.0);
        let near = self.near.get(section.from).map(|(hi, lo)| if section.begins_with_leg { *lo } else { *hi });
        let steepness = (drop / length.max(f64::MIN_POSITIVE)).clamp(-2.0, 2.0);
        let mut q = near.filter(|q| q.is_finite()).unwrap_or(0.5 * weight + p.abs() * steepness);
        if lone_leg && q == 0.0 {
            q = drop.signum() * (p.abs() + weight.abs()) * 1e-3;
        }
        let fine = 2.0 * f64::EPSILON * (length + drop.abs());
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        let mut grow = weight.abs() + pulled + p.abs();
        let mut best = (f64::INFINITY, q, f64::INFINITY);
        let mut steps = 0;
        while steps < MOST_STEPS {
            steps += 1;
            let (n, n_q) = walk(q, &mut rested.held);
            let off = n - drop;
            if !off.is_finite() {
                break;
            }
            let better = off.abs() < best.0;
            if better {
                best = (off.abs(), q, n_q);
            }
            if best.0 <= fine || (!better && best.0 <= 64.0 * fine) {
                break;
            }
            if off > 0.0 {
                high = high.min(q);
            } else {
                low = low.max(q);
            }
            let newton = q - off / n_q;
            let bracketed = low.is_finite() && high.is_finite();
            let inside = newton.is_finite() && newton > low && newton < high;
            let next = if inside && (bracketed || (newton - q).abs() < grow) {
                newton
            } else if bracketed {
                0.5 * (low + high)
            } else {
                grow *= 2.0;
                if off > 0.0 { q - grow } else { q + grow }
            };
            if next == q || (bracketed && high - low <= 4.0 * f64::EPSILON * (low.abs() + high.abs())) {
                break;
            }
            q = next;
        }
        let (off, q, n_q) = best;
        walk(q, &mut rested.held);
        let tension = rested.held.iter().fold(p.abs(), |m: f64, h| m.max(h.q_hi.abs()));
        rested.iterations += steps;
        rested.left = rested.left.max(off);
        rested.unbalance = rested.unbalance.max(off / n_q);
        if off <= 1e-12 * length || off <= 1e-10 * tension * n_q {
            return Ok(());
        }
        Err(LineError::NotConverged { force: p, residual: off, iterations: steps })
    }

    /// The policy that a solution asks for; `one` changes only what is furthest off.
    fn better(&self, rested: &Rested, one: bool) -> Policy {
        let length = self.chain.length();
        let fine = 1e-12 * length;
        let ground = &self.chain.ground;
        let size = rested.held.iter().fold(ground.least, |m: f64, h| m.max(h.q_hi.abs()).max(h.q_lo.abs()).max(h.p_hi));
        let small = 1e-12 * size;
        // by how much a piece or joint is off, and what it becomes
        let mut pieces: Vec<(f64, usize)> = Vec::new();
        let mut joints: Vec<(f64, usize, Stand)> = Vec::new();
        let end = |i: usize| rested.n.get(i).copied().unwrap_or(0.0);
        for (i, (element, held)) in self.chain.elements.iter().zip(&rested.held).enumerate() {
            if held.rests {
                let broken = held.ground < -fine || held.q_hi < -small || held.q_lo > small;
                if broken {
                    pieces.push(((-held.ground / length).max(1e-12), i));
                }
            } else if element.can_rest() {
                let lowest = lowest(element, ground, held, end(i), end(i + 1));
                if lowest < -fine {
                    pieces.push((-lowest / length, i));
                }
            }
        }
        for (j, stand) in rested.policy.stands.iter().enumerate() {
            let Some(pull) = self.chain.pulls.get(j) else { continue };
            let height = end(j + 1);
            let step = |k: usize| self.steps.get(j).and_then(|s| s.get(k)).copied();
            let lift = rested.lifts.get(j).copied().unwrap_or(0.0);
            match *stand {
                Stand::Free(k) => {
                    let floor = pull.on_bottom.then_some(0.0);
                    let under = k.checked_sub(1).and_then(step);
                    let (low, next) = match (under, floor) {
                        (Some(u), Some(f)) if f > u => (f, Stand::Bottom),
                        (Some(u), _) => (u, Stand::Step(k - 1)),
                        (None, Some(f)) => (f, Stand::Bottom),
                        (None, None) => (f64::NEG_INFINITY, Stand::Bottom),
                    };
                    if height < low - fine {
                        joints.push(((low - height) / length, j, next));
                    } else if let Some(above) = step(k)
                        && height > above + fine
                    {
                        joints.push(((height - above) / length, j, Stand::Step(k)));
                    }
                }
                Stand::Bottom => {
                    let reaction = rested.reactions.get(j).copied().unwrap_or(0.0);
                    if reaction < -small {
                        joints.push((-reaction / size, j, Stand::Free(0)));
                    }
                }
                Stand::Step(k) => {
                    let (most, least) = (pull.passed(k), pull.passed(k + 1));
                    if lift > most + small {
                        joints.push(((lift - most) / size, j, Stand::Free(k)));
                    } else if lift < least - small {
                        joints.push(((least - lift) / size, j, Stand::Free(k + 1)));
                    }
                }
            }
        }
        let mut policy = rested.policy.clone();
        let worst = pieces.iter().map(|p| p.0).chain(joints.iter().map(|j| j.0)).fold(0.0, f64::max);
        let mut left = if one { 1 } else { usize::MAX };
        for (off, i) in pieces {
            if let Some(rests) = policy.rests.get_mut(i).filter(|_| left > 0 && (!one || off >= worst)) {
                *rests = !*rests;
                left -= 1;
            }
        }
        for (off, j, next) in joints {
            if let Some(stand) = policy.stands.get_mut(j).filter(|_| left > 0 && (!one || off >= worst)) {
                *stand = next;
                left -= 1;
            }
        }
        policy
    }
}

/// The height of the lowest point of a free piece.
fn lowest(element: &Element, ground: &super::element::Ground, held: &Held, hi: f64, lo: f64) -> f64 {
    if held.q_lo < 0.0 && held.q_hi > 0.0 { hi - element.upper_leg(ground, held.p_hi, held.q_hi).n } else { hi.min(lo) }
}
