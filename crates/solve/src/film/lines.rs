//! Connectors of a film: their shape at every instant.

use crate::results::along::{ResultSection, sections, segments_at, sides};
use crate::scene::{CORNER_TURN_RAD, cubic};
use crate::time::{AlongColumns, LinkColumns, RowLayout};
use windlass_base::geometry::Position;
use windlass_base::table::{Cell, Table};
use windlass_model::{ClassError, Condition, Connector, LineSampling, Model, Placement};

/// Points of the shape between which a film's points are found, inside each segment.
const SHAPE_POINTS: LineSampling = LineSampling::Inside(9);

/// How a connector is at an instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConnectorState {
    /// It does not act.
    Inactive,
    /// It acts.
    SectionLoads,
    /// It acts, and no shape was found: straight between its ends.
    Unsolved,
}

/// A connector at every instant of a film.
#[derive(Clone, Debug, PartialEq)]
pub struct Strand {
    /// Its name.
    pub name: String,
    /// Whether it has the shape of a line; others are straight.
    pub line: bool,
    /// Points at each instant.
    pub count: usize,
    /// The points from the first end on, instant by instant (m, global).
    pub points: Vec<Position>,
    /// Tension at each of them (N).
    pub tensions: Vec<f64>,
    /// Tension over the break there; empty where no break is known.
    pub shares: Vec<f64>,
    /// How it is, instant by instant.
    pub states: Vec<ConnectorState>,
    /// Elevation of the bottom below it (m), where that is known.
    pub(super) bottom: Option<f64>,
    /// Why it was last without a shape.
    pub(super) error: Option<String>,
    /// Whether it is a dynamic line and the run kept none of its nodes.
    pub(super) nodeless: bool,
    /// What it is made of, of one whose nodes were kept.
    sections: Vec<ResultSection>,
    link: usize,
}

/// The points of a line at an instant with what it bears there.
struct FilmShape {
    points: Vec<Position>,
    tensions: Vec<f64>,
    shares: Vec<f64>,
    bottom: Option<f64>,
}

impl Strand {
    /// One without an instant; `None` of what is no connector of the model.
    pub(super) fn new(link: usize, columns: &LinkColumns, model: &Model) -> Option<Strand> {
        let connector = model.connectors.get(&Model::key(&columns.name))?;
        let class = model.classes.get(&Model::key(&connector.class))?;
        let kept = columns.along.is_some();
        Some(Strand {
            name: connector.name.clone(),
            line: kept || class.object.as_line().is_some(),
            nodeless: !kept && model.is_dynamic_line(connector),
            sections: if kept { sections(model, &connector.name) } else { Vec::new() },
            count: 0,
            points: Vec::new(),
            tensions: Vec::new(),
            shares: Vec::new(),
            states: Vec::new(),
            bottom: None,
            error: None,
            link,
        })
    }

    /// Adds an instant: the bodies of the model stand where they are then.
    pub(super) fn shoot(&mut self, model: &mut Model, layout: &RowLayout, row: &[f64], points: usize) {
        let columns = layout.links.get(self.link);
        let number = |at: Option<usize>| at.and_then(|at| row.get(at)).copied();
        let active = number(columns.map(|c| c.active)).unwrap_or(0.0) > 0.5;
        let length = number(columns.map(|c| c.active + 1)).filter(|l| l.is_finite() && *l > 0.0);
        if let Some(connector) = model.connectors.get_mut(&Model::key(&self.name)) {
            connector.active = active;
            if length.is_some() {
                connector.first_length = length;
            }
        }
        let Some(connector) = model.connectors.get(&Model::key(&self.name)) else { return };
        let pull = columns.and_then(|c| {
            let at = (0..c.ends.len()).find_map(|end| layout.wrench(self.link, end))?;
            Some(row.get(at..at + 3)?.iter().map(|v| v * v).sum::<f64>().sqrt())
        });
        let pull = pull.unwrap_or(0.0);
        self.count = if self.line { points.max(2) } else { 2 };
        let moved = || dynamic_shape(columns?.along.as_ref()?, row, &self.sections, self.count);
        let (shape, state) = match (active, self.line) {
            (false, _) => (self.straight(model, connector, 0.0), ConnectorState::Inactive),
            (true, _) if self.has_stored_nodes(columns) => match moved() {
                Some(shape) => (shape, ConnectorState::SectionLoads),
                None => (self.straight(model, connector, pull), ConnectorState::Unsolved),
            },
            (true, false) => (self.straight(model, connector, pull), ConnectorState::SectionLoads),
            (true, true) => match hanging(model, connector, self.count) {
                Ok(Some(shape)) => (shape, ConnectorState::SectionLoads),
                Ok(None) => (self.straight(model, connector, pull), ConnectorState::SectionLoads),
                Err(error) => {
                    self.error = Some(error.to_string());
                    (self.straight(model, connector, pull), ConnectorState::Unsolved)
                }
            },
        };
        self.bottom = self.bottom.or(shape.bottom);
        self.points.extend(shape.points);
        self.tensions.extend(shape.tensions);
        self.shares.extend(shape.shares);
        self.states.push(state);
    }

    /// Whether its nodes were kept.
    fn has_stored_nodes(&self, columns: Option<&LinkColumns>) -> bool {
        columns.is_some_and(|c| c.along.is_some())
    }

    /// Straight between the ends.
    fn straight(&self, model: &Model, connector: &Connector, tension: f64) -> FilmShape {
        let [from, to] = model.end_poses(connector).map(|p| Position::from(p.origin));
        let along = |n: usize| {
            let share = n as f64 / (self.count - 1).max(1) as f64;
            let [x, y, z] = from;
            [x + share * (to[0] - x), y + share * (to[1] - y), z + share * (to[2] - z)]
        };
        FilmShape {
            points: (0..self.count).map(along).collect(),
            tensions: vec![tension; self.count],
            // where a line is straight its share of the break is not known: as before
            shares: if self.line {
                vec![self.shares.last().copied().unwrap_or(f64::NAN); self.count]
            } else {
                Vec::new()
            },
            bottom: None,
        }
    }

    /// The points of an instant (m, global).
    pub fn points_at(&self, frame: usize) -> &[Position] {
        self.points.get(frame * self.count..(frame + 1) * self.count).unwrap_or_default()
    }
}

/// A dynamic line as its nodes were, a number of points evenly along its length, straight between nodes; `None` where none
/// of them is there.
fn dynamic_shape(along: &AlongColumns, row: &[f64], sections: &[ResultSection], count: usize) -> Option<FilmShape> {
    let nodes: Vec<_> = along.nodes(row).map(|(_, node)| node).collect();
    let (first, last) = (nodes.first()?.arc, nodes.last()?.arc);
    let mut shape = FilmShape { points: Vec::new(), tensions: Vec::new(), shares: Vec::new(), bottom: None };
    for n in 0..count {
        let share = n as f64 / (count - 1).max(1) as f64;
        let wanted = if n + 1 == count { last } else { first + (last - first) * share };
        let behind = nodes.partition_point(|node| node.arc < wanted).min(nodes.len() - 1);
        let (a, b) = (nodes.get(behind.saturating_sub(1))?, nodes.get(behind)?);
        let room = b.arc - a.arc;
        let t = if room > 0.0 { (wanted - a.arc) / room } else { 1.0 };
        let tension = a.effective + t * (b.effective - a.effective);
        let meeting = sides(sections, segments_at(sections, last - wanted));
        shape.points.push(std::array::from_fn(|i| a.position[i] + t * (b.position[i] - a.position[i])));
        shape.tensions.push(tension);
        shape.shares.push(meeting.map(|(.., section)| section.utilisation(tension, None)).fold(f64::NAN, f64::max));
    }
    let over = nodes.iter().find(|node| node.clearance.is_finite());
    shape.bottom = over.map(|node| node.position[2] - node.clearance);
    Some(shape)
}

/// A mooring line as it hangs between its ends; `None` of one that is straight.
fn hanging(model: &Model, connector: &Connector, count: usize) -> Result<Option<FilmShape>, ClassError> {
    let placement = model.placement(connector);
    let class = model.classes.get(&Model::key(&connector.class));
    let class = class.ok_or_else(|| ClassError::new(format!("there is no class {}", connector.class)))?;
    let line = class.line(&placement, &model.surroundings())?;
    match line.geometry(&connector.name, Condition::Placed, SHAPE_POINTS) {
        Ok(table) => Ok(resample_shape(&table, &placement, count)),
        // a spring that is pushed together is straight
        Err(_) if line.configuration(Condition::Placed).is_ok_and(|c| c.tension < 0.0) => Ok(None),
        Err(error) => Err(error),
    }
}

/// A number of points evenly along the length of a line, between the rows of its geometry.
fn resample_shape(table: &Table, placement: &Placement, count: usize) -> Option<FilmShape> {
    let column = |name: &str| -> Vec<Option<f64>> {
        table.get(name).map_or(Vec::new(), |c| c.cells.iter().map(Cell::number).collect())
    };
    let numbers = ["X", "Z", "Arc Length", "Angle", "Tension", "T/Break"].map(column);
    let count_of_rows = numbers.first().map_or(0, Vec::len);
    let row = |n: usize| -> Option<[f64; 6]> {
        let found: [Option<f64>; 6] = std::array::from_fn(|i| numbers.get(i).and_then(|c| c.get(n)).copied().flatten());
        let [x, z, arc, angle, tension, share] = found;
        let or = |v: Option<f64>| v.unwrap_or(f64::NAN);
        Some([x?, z?, arc?, or(angle), or(tension), or(share)])
    };
    let rows: Vec<[f64; 6]> = (0..count_of_rows).filter_map(row).collect();
    let arc_of = |row: &[f64; 6]| row[2];
    let (first, last) = (arc_of(rows.first()?), arc_of(rows.last()?));
    let (_, [ux, uy]) = placement.span();
    let [x0, y0, _] = placement.fairlead;
    let mut shape = FilmShape { points: Vec::new(), tensions: Vec::new(), shares: Vec::new(), bottom: None };
    for n in 0..count {
        let share = n as f64 / (count - 1).max(1) as f64;
        let wanted = if n + 1 == count { last } else { first + (last - first) * share };
        let behind = rows.partition_point(|row| arc_of(row) < wanted).min(rows.len() - 1);
        let (a, b) = (rows.get(behind.saturating_sub(1))?, rows.get(behind)?);
        let room = arc_of(b) - arc_of(a);
        let t = if room > 0.0 { (wanted - arc_of(a)) / room } else { 1.0 };
        let [x, z, _, _, tension, ratio] = std::array::from_fn(|i| a[i] + t * (b[i] - a[i]));
        // as the picture draws it: a cubic with the directions at both rows, but for a corner
        let turns = (b[3] - a[3]).abs() < CORNER_TURN_RAD;
        let (x, z) = if turns { cubic(((a[0], a[1]), (b[0], b[1])), (a[3], b[3]), room, t) } else { (x, z) };
        shape.points.push([x0 + ux * x, y0 + uy * x, z]);
        shape.tensions.push(tension);
        shape.shares.push(ratio);
    }
    shape.bottom = column("Bottom").into_iter().flatten().next();
    Some(shape)
}
