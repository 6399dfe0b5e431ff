//! Connectors of a film: their shape at every instant.

use crate::model::{ClassError, Condition, Connector, Model, Placement, Position};
use crate::solve::time::{Layout, LinkColumns};
use crate::table::{Cell, Table};

/// How a connector is at an instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// It does not act.
    Inactive,
    /// It acts.
    Acting,
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
    pub states: Vec<State>,
    /// Elevation of the bottom below it (m), where that is known.
    pub(super) bottom: Option<f64>,
    /// Why it was last without a shape.
    pub(super) error: Option<String>,
    link: usize,
}

/// The points of a line at an instant with what it bears there.
struct Shape {
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
        Some(Strand {
            name: connector.name.clone(),
            line: class.object.is_line(),
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
    pub(super) fn shoot(&mut self, model: &mut Model, layout: &Layout, row: &[f64], points: usize) {
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
        let (shape, state) = match (active, self.line) {
            (false, _) => (self.straight(model, connector, 0.0), State::Inactive),
            (true, false) => (self.straight(model, connector, pull), State::Acting),
            (true, true) => match hanging(model, connector, self.count) {
                Ok(Some(shape)) => (shape, State::Acting),
                Ok(None) => (self.straight(model, connector, pull), State::Acting),
                Err(error) => {
                    self.error = Some(error.to_string());
                    (self.straight(model, connector, pull), State::Unsolved)
                }
            },
        };
        self.bottom = self.bottom.or(shape.bottom);
        self.points.extend(shape.points);
        self.tensions.extend(shape.tensions);
        self.shares.extend(shape.shares);
        self.states.push(state);
    }

    /// Straight between the ends.
    fn straight(&self, model: &Model, connector: &Connector, tension: f64) -> Shape {
        let [from, to] = model.end_poses(connector).map(|p| Position::from(p.origin));
        let along = |n: usize| {
            let share = n as f64 / (self.count - 1).max(1) as f64;
            let [x, y, z] = from;
            [x + share * (to[0] - x), y + share * (to[1] - y), z + share * (to[2] - z)]
        };
        Shape {
            points: (0..self.count).map(along).collect(),
            tensions: vec![tension; self.count],
            // where a line is straight its share of the break is not known: as before
            shares: if self.line { vec![self.shares.last().copied().unwrap_or(f64::NAN); self.count] } else { Vec::new() },
            bottom: None,
        }
    }

    /// The points of an instant (m, global).
    pub fn at(&self, frame: usize) -> &[Position] {
        self.points.get(frame * self.count..(frame + 1) * self.count).unwrap_or_default()
    }
}

/// A mooring line as it hangs between its ends; `None` of one that is straight.
fn hanging(model: &Model, connector: &Connector, count: usize) -> Result<Option<Shape>, ClassError> {
    let placement = model.placement(connector);
    let class = model.classes.get(&Model::key(&connector.class));
    let class = class.ok_or_else(|| ClassError::new(format!("there is no class {}", connector.class)))?;
    let line = class.object.line(&placement, &model.surroundings())?;
    match line.geometry(&connector.name, Condition::Placed) {
        Ok(table) => Ok(resampled(&table, &placement, count)),
        // a spring that is pushed together is straight
        Err(_) if line.configuration(Condition::Placed).is_ok_and(|c| c.tension < 0.0) => Ok(None),
        Err(error) => Err(error),
    }
}

/// A number of points evenly along the rows of a line's geometry.
fn resampled(table: &Table, placement: &Placement, count: usize) -> Option<Shape> {
    let column = |name: &str| -> Vec<Option<f64>> {
        table.get(name).map_or(Vec::new(), |c| c.cells.iter().map(Cell::number).collect())
    };
    let numbers = [column("X"), column("Z"), column("Tension"), column("T/Break")];
    let [xs, zs, tensions, shares] = &numbers;
    // a row: x, z, tension, share
    let rows: Vec<[f64; 4]> = xs
        .iter()
        .zip(zs)
        .enumerate()
        .filter_map(|(n, (x, z))| {
            let of = |list: &[Option<f64>]| list.get(n).copied().flatten().unwrap_or(f64::NAN);
            Some([(*x)?, (*z)?, of(tensions), of(shares)])
        })
        .collect();
    let mut arcs = Vec::with_capacity(rows.len());
    let mut arc = 0.0;
    for (n, row) in rows.iter().enumerate() {
        if let Some(before) = n.checked_sub(1).and_then(|b| rows.get(b)) {
            arc += (row[0] - before[0]).hypot(row[1] - before[1]);
        }
        arcs.push(arc);
    }
    let (_, [ux, uy]) = placement.span();
    let [x0, y0, _] = placement.fairlead;
    let mut shape = Shape { points: Vec::new(), tensions: Vec::new(), shares: Vec::new(), bottom: None };
    for n in 0..count {
        let wanted = if n + 1 == count { arc } else { arc * n as f64 / (count - 1).max(1) as f64 };
        let behind = arcs.partition_point(|a| *a < wanted).min(rows.len().checked_sub(1)?);
        let before = behind.saturating_sub(1);
        let (a, b) = (rows.get(before)?, rows.get(behind)?);
        let room = arcs.get(behind)? - arcs.get(before)?;
        let share = if room > 0.0 { (wanted - arcs.get(before)?) / room } else { 1.0 };
        let [x, z, tension, ratio] = std::array::from_fn(|i| a[i] + share * (b[i] - a[i]));
        shape.points.push([x0 + ux * x, y0 + uy * x, z]);
        shape.tensions.push(tension);
        shape.shares.push(ratio);
    }
    shape.bottom = column("Bottom").into_iter().flatten().next();
    Some(shape)
}
