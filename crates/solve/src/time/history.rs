//! What a run keeps: a row of numbers for every stored instant, in the order of a layout that does not change during the run.
//!
//! A row holds the motions of the bodies, the wrenches of the connectors, and the nodes of dynamic lines. What else is reported of an instant (line on the bottom,
//! pull on the anchor, share of the break) follows from these when it is asked for.

use super::along::AlongColumns;
use super::compression::CompressionOnset;
use super::ends::end_of;
use super::forces::{BodyForces, BodyMotion, CATEGORY_COUNT};
use crate::link::{EndAttachment, Link};
use crate::system::{SolveError, System, SystemBody};
use nalgebra::Vector3;
use windlass_base::geometry::Place;
use windlass_base::pose::Six;
use windlass_hydro::Category;
use windlass_model::{ClassError, LineNode, Situation, SolverCache, TimeStep};

/// Values of a body in a row: place (m), roll, pitch, yaw (rad), velocity (m/s, rad/s), acceleration (m/s2, rad/s2), global.
pub const VALUES_PER_BODY: usize = 18;

/// A connector in the rows.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkColumns {
    /// Its name as written.
    pub name: String,
    /// The body at each end; none in the ground.
    pub ends: Vec<Option<usize>>,
    /// The end by whose force its pull is reported, where that is on a body.
    pub pulling: usize,
    /// Where the wrenches on its ends on bodies begin, six each, in the order of the ends.
    pub wrench: usize,
    /// Where it says whether it acts, 1 or 0, and the length of its first segment (m; not a number without one).
    pub active: usize,
    /// Where its nodes stand, where it reports them and they are kept.
    pub along: Option<AlongColumns>,
    /// Of one that may push, where it does.
    pub pushing: Option<CompressionOnset>,
}

impl LinkColumns {
    /// The unstretched length of its first segment (m) in a stored row, which a winch changes; none while it does not act, or
    /// without a length.
    pub fn length(&self, row: &[f64]) -> Option<f64> {
        let acts = row.get(self.active).is_some_and(|active| *active > 0.0);
        row.get(self.active + 1).copied().filter(|length| acts && length.is_finite())
    }
}

/// A connector as a layout is made of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LinkEnds {
    /// Its name as written.
    pub name: String,
    /// The body at each end; none in the ground.
    pub ends: Vec<Option<usize>>,
    /// The end by whose force its pull is reported, where that is on a body.
    pub pulling: usize,
    /// How many nodes it reports at most, and whether they bend.
    pub nodes: (usize, bool),
    /// Of one that may push, where it does.
    pub pushing: Option<CompressionOnset>,
}

/// Which number of a row is what.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RowLayout {
    /// Bodies as written, each with its key in the model.
    pub bodies: Vec<(String, String)>,
    /// Which degrees of freedom of each body move: the others stay as they are.
    pub moves: Vec<[bool; 6]>,
    /// Connectors.
    pub links: Vec<LinkColumns>,
    /// Categories of force that are kept.
    pub categories: Vec<Category>,
    /// Numbers of a row.
    pub width: usize,
    forces: usize,
}

impl RowLayout {
    /// That of a system; `links` are the connectors that act at some time; of their nodes every so manieth is kept, 0 for none.
    /// `later` are the loads of bodies in environments that come during the run: their categories have a place from the start.
    pub fn new(system: &System, later: &[SystemBody], links: Vec<LinkEnds>, every: usize) -> Self {
        let bodies: Vec<_> = system.nodes.iter().map(|n| (n.name.clone(), n.key.clone())).collect();
        let moves = system.nodes.iter().map(|n| n.free.map(|free| free || n.prescribed.is_some())).collect();
        let mut at = 1 + VALUES_PER_BODY * bodies.len();
        let mut columns = Vec::new();
        for LinkEnds { name, ends, pulling, nodes, pushing } in links {
            let (active, wrench) = (at, at + 2);
            at = wrench + 6 * ends.iter().flatten().count();
            let along = AlongColumns::new(at, nodes, every);
            at += along.as_ref().map_or(0, AlongColumns::width);
            columns.push(LinkColumns { name, ends, pulling, wrench, active, along, pushing });
        }
        let mut categories = vec![Category::Inertia, Category::Coriolis];
        let loads = system.nodes.iter().chain(later).flat_map(|n| &n.floating.loads);
        let loads = loads.flat_map(|l| {
            let others = l.as_divided().map_or(&[][..], |divided| divided.other_categories());
            std::iter::once(l.category()).chain(others.iter().copied())
        });
        let connectors = [Category::FlexConnectors, Category::RigidConnectors].into_iter();
        let damped = system.nodes.iter().chain(later).filter(|n| n.damped).map(|_| Category::RadiationDrag);
        let added = system.nodes.iter().chain(later).filter(|n| n.added).map(|_| Category::AddedInertia);
        let applied = system.applied.iter().map(|_| Category::Applied);
        categories
            .extend(loads.chain(connectors.take(2 * usize::from(!columns.is_empty()))).chain(damped).chain(added));
        categories.extend(applied);
        let categories: Vec<Category> = Category::ALL.into_iter().filter(|c| categories.contains(c)).collect();
        let width = at + 6 * categories.len() * bodies.len();
        RowLayout { bodies, moves, links: columns, categories, width, forces: at }
    }

    /// Where the numbers of a body begin.
    pub fn body(&self, body: usize) -> usize {
        1 + VALUES_PER_BODY * body
    }

    /// Where the force of a category on a body begins: six numbers about its origin, global axes.
    pub fn category(&self, body: usize, category: Category) -> Option<usize> {
        let at = self.categories.iter().position(|c| *c == category)?;
        Some(self.forces + 6 * (body * self.categories.len() + at))
    }

    /// Where the wrench stands by which the pull of a connector is reported: on the end that its element says, or else the first of its ends
    /// that is on a body; `None` where all are in the ground.
    pub fn pull(&self, link: usize) -> Option<usize> {
        let columns = self.links.get(link)?;
        let of = |end: usize| self.wrench(link, end);
        of(columns.pulling).or_else(|| (0..columns.ends.len()).find_map(of))
    }

    /// The pull of a connector in a row (N), negative where it pushes; none of one whose ends are all in the ground.
    pub fn tension(&self, link: usize, row: &[f64]) -> Option<f64> {
        let at = self.pull(link)?;
        let force = Vector3::from_column_slice(row.get(at..at + 3)?);
        let pushing = self.links.get(link).and_then(|l| l.pushing.as_ref());
        Some(pushing.map_or_else(|| force.norm(), |p| p.pull(&force, row)))
    }

    /// Where the wrench on an end of a connector begins; none of an end in the ground.
    pub fn wrench(&self, link: usize, end: usize) -> Option<usize> {
        let columns = self.links.get(link)?;
        columns.ends.get(end).copied().flatten()?;
        Some(columns.wrench + 6 * columns.ends.iter().take(end).flatten().count())
    }
}

/// What a row is made of beside motions and forces.
#[derive(Clone, Debug, Default)]
pub struct RowSources {
    /// Inertia, added inertia and turning of each body, as forces.
    pub inertia: Vec<[Six; 3]>,
    /// Length of the first segment of each connector of the layout (m).
    pub lengths: Vec<Option<f64>>,
    /// Nodes of a line, made anew for each.
    nodes: Vec<LineNode>,
}

/// Rows of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct History {
    /// Which number is what.
    pub layout: RowLayout,
    /// All rows, one behind the other.
    pub values: Vec<f64>,
}

impl History {
    /// Without rows.
    pub fn new(layout: RowLayout) -> Self {
        History { layout, values: Vec::new() }
    }

    /// The rows (SI), each of the layout's width.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &[f64]> + Clone {
        self.values.chunks_exact(self.layout.width.max(1))
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.rows().len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// One number of every row.
    pub fn series(&self, at: usize) -> Vec<f64> {
        self.rows().map(|row| row.get(at).copied().unwrap_or(f64::NAN)).collect()
    }

    /// The instants (s).
    pub fn times(&self) -> Vec<f64> {
        self.series(0)
    }
}

impl RowLayout {
    /// Writes the row of an instant. `near` are the places of the row before: angles go on from them without a jump.
    ///
    /// # Errors
    /// A line that cannot report its nodes.
    pub fn write(
        &self,
        (system, time): (&System, f64),
        (motions, forces, sources): (&[BodyMotion], &mut BodyForces, &mut RowSources),
        near: &mut [Place],
        row: &mut Vec<f64>,
    ) -> Result<(), SolveError> {
        row.clear();
        row.push(time);
        for (motion, near) in motions.iter().zip(near) {
            *near = motion.pose.position(near);
            row.extend_from_slice(&near.shift);
            row.extend_from_slice(&near.turn);
            row.extend_from_slice(motion.velocity.as_slice());
            row.extend_from_slice(motion.acceleration.as_slice());
        }
        row.resize(self.width, 0.0);
        // a line that does not act has no nodes
        for along in self.links.iter().filter_map(|l| l.along.as_ref()) {
            if let Some(own) = row.get_mut(along.at..along.at + along.width()) {
                own.fill(f64::NAN);
            }
        }
        let mut first = 0;
        for (index, link) in system.links.iter().enumerate() {
            // in the same place unless a connector has gone
            let same = |l: &LinkColumns| l.name == link.name;
            let found = match self.links.get(index) {
                Some(columns) if same(columns) => Some(index),
                _ => self.links.iter().position(same),
            };
            if let (Some(number), Some(columns)) = (found, found.and_then(|n| self.links.get(n))) {
                let length = match link.reeving {
                    Some(_) => running_length((system, link), time, motions)?,
                    None => sources.lengths.get(number).copied().flatten(),
                };
                if let Some([active, long]) = row.get_mut(columns.active..columns.active + 2) {
                    (*active, *long) = (1.0, length.unwrap_or(f64::NAN));
                }
                let mut at = columns.wrench;
                for (end, wrench) in link.acting_ends().iter().zip(forces.wrenches.iter().skip(first)) {
                    if let (EndAttachment::Body(..), Some(position)) = (end, row.get_mut(at..at + 6)) {
                        position.copy_from_slice(wrench.as_slice());
                        at += 6;
                    }
                }
                if let Some(along) = &columns.along {
                    let mut none = SolverCache::new();
                    let cache = forces.caches.get_mut(index).unwrap_or(&mut none);
                    nodes_of((system, link, cache), (time, motions), &mut sources.nodes)
                        .and_then(|()| along.write(&sources.nodes, row))
                        .map_err(|e| SolveError::error_about(&link.name)(at_time(e, time)))?;
                }
            }
            first += link.ends.len();
        }
        for body in 0..self.bodies.len() {
            for category in &self.categories {
                let of_inertia = |i: usize| sources.inertia.get(body).and_then(|t| t.get(i)).copied();
                let sums = forces.categories.get(body);
                let of_loads = sums.and_then(|c: &[Six; CATEGORY_COUNT]| c.get(category.index())).copied();
                let force = match category {
                    Category::Inertia => of_inertia(0),
                    Category::AddedInertia => of_inertia(1).zip(of_loads).map(|(own, more)| own + more),
                    Category::Coriolis => of_inertia(2),
                    _ => of_loads,
                };
                if let (Some(force), Some(at)) = (force, self.category(body, *category)) {
                    row[at..at + 6].copy_from_slice(force.as_slice());
                }
            }
        }
        Ok(())
    }
}

/// The length of the first segment of a span of a line over pulleys or off a drum at an instant (m).
fn running_length(
    (system, link): (&System, &Link),
    time: f64,
    motions: &[BodyMotion],
) -> Result<Option<f64>, SolveError> {
    let ends: Vec<_> = link.ends.iter().map(|end| end_of(end, motions, false).0).collect();
    let at = Situation { ends: &ends, step: None, surroundings: &system.surroundings };
    let found = link.element.running_length(&at, &system.states[link.states.clone()]);
    found.map_err(|e| SolveError::error_about(&link.name)(at_time(e, time)))
}

/// The nodes of a line at an instant.
fn nodes_of(
    (system, link, cache): (&System, &Link, &mut SolverCache),
    (time, motions): (f64, &[BodyMotion]),
    nodes: &mut Vec<LineNode>,
) -> Result<(), ClassError> {
    let ends: Vec<_> = link.ends.iter().map(|end| end_of(end, motions, true).0).collect();
    let step = Some(TimeStep { time, dt: 0.0 });
    let at = Situation { ends: &ends, step, surroundings: &system.surroundings };
    match link.element.as_nodal() {
        Some(nodal) => nodal.find_row_nodes(&at, &system.states[link.states.clone()], cache, nodes),
        None => {
            nodes.clear();
            Ok(())
        }
    }
}

fn at_time(error: ClassError, time: f64) -> ClassError {
    error.with_subject(format!("at {time} s"))
}
