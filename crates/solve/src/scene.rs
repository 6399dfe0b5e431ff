//! What the system looks like: bodies, lines in their solved shape, anchors, the water surface and the sea bottom, as
//! polylines and marks in global coordinates.

use super::outline::outline;
pub use super::outline::{Outline, OutlineEdge};
use super::results::along::visit_lines_at_rest;
use super::system::SolveError;
use std::collections::BTreeSet;
use windlass_base::geometry::Position;
use windlass_base::table::{Cell, Table};
use windlass_model::{AssemblyKind, Body, ClassError, ClassRole, Condition, Connector, LineSampling, Model, Placement};

/// Turn beyond which a line is taken to have a corner (rad).
pub(super) const CORNER_TURN_RAD: f64 = 1.0;
/// What a polyline stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stroke {
    /// A line that does not act.
    Inactive,
    /// A connector without a shape of its own, straight between its ends.
    Straight,
    /// A fender between its ends.
    Fender,
    /// A sling of a tip-hook set.
    Sling,
    /// A line in its solved shape.
    Line,
    /// A rod, or a pipe on its supports.
    Pipe,
    /// A line for which no shape was found, straight between its ends.
    Unsolved,
    /// The sea bottom under one line, where it is not level with the others.
    Bottom,
}

/// What a mark stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Sign {
    /// Where a line meets the bottom.
    Touchdown,
    /// Where two segments of a line join.
    Joint,
    /// An end of a connector on a body.
    Fairlead,
    /// An end of a connector in the ground.
    Anchor,
    /// A roller or davit that holds a pipe.
    PipeSupport,
    /// A fender whose ends are in one place.
    Fender,
    /// The origin of a body's axes.
    Origin,
}

/// A polyline in the global system (m).
#[derive(Clone, Debug, PartialEq)]
pub struct Polyline {
    /// What it stands for.
    pub stroke: Stroke,
    /// The connector it belongs to.
    pub name: String,
    /// Its points, from the first end on (m).
    pub points: Vec<Position>,
    /// Tension at each of them (N); none where it is not known.
    pub tensions: Vec<f64>,
    /// Whether its last point is in the ground.
    pub grounded: bool,
}

/// A marked place.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// What it stands for.
    pub sign: Sign,
    /// Its name; empty for one that has none.
    pub name: String,
    /// Where it is (m, global).
    pub at: Position,
}

/// All that is drawn of a system, in global coordinates (m).
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Scene {
    /// Bodies.
    pub bodies: Vec<Outline>,
    /// Lines, other connectors, uneven bottoms.
    pub paths: Vec<Polyline>,
    /// Marked places.
    pub marks: Vec<Mark>,
    /// Elevation of the water surface (m).
    pub surface: f64,
    /// Elevation of the level sea bottom (m), where there is one.
    pub bottom: Option<f64>,
}

/// What a scene is made of.
pub struct SceneOptions<'a> {
    /// Whether a connector is drawn.
    pub connector: &'a dyn Fn(&Connector) -> bool,
    /// Whether a body is drawn; one on which a drawn connector ends always is.
    pub body: &'a dyn Fn(&Body) -> bool,
    /// Whether to give up.
    pub stop: &'a dyn Fn() -> bool,
}

/// A connector that could not be drawn as it is, and why.
pub type Unshaped = (String, ClassError);

impl Scene {
    /// The scene of a model with the connectors whose shape could not be found; `None` when interrupted.
    pub fn build(model: &Model, choice: &SceneOptions) -> Option<(Scene, Vec<Unshaped>)> {
        let surroundings = model.surroundings();
        let mut scene =
            Scene { surface: surroundings.tide, bottom: surroundings.depth.map(|d| -d), ..Scene::default() };
        let (mut unshaped, mut bottoms) = (Vec::new(), Vec::new());
        let (mut held, mut marked) = (BTreeSet::new(), BTreeSet::new());
        for connector in model.connectors.values().filter(|c| (choice.connector)(c)) {
            if (choice.stop)() {
                return None;
            }
            let drawn = shape(model, connector);
            for mark in ends(model, connector, drawn.path.as_ref()).into_iter().chain(drawn.marks) {
                // points are named once, however many connectors end there
                if mark.name.is_empty() || marked.insert(mark.name.clone()) {
                    scene.marks.push(mark);
                }
            }
            held.extend(
                connector
                    .points
                    .iter()
                    .filter_map(|p| model.body_of(model.points.get(&Model::key(p))?).map(|b| b.name.clone())),
            );
            scene.paths.extend(drawn.path);
            bottoms.extend(drawn.bottom.map(|points| (connector.name.clone(), points)));
            unshaped.extend(drawn.error.map(|e| (connector.name.clone(), e)));
        }
        for pipe in model.assemblies.values().filter(|a| matches!(a.kind, AssemblyKind::Pipe { .. })) {
            let mut supports = pipe.members().filter_map(|name| model.connectors.get(&Model::key(name)));
            if !supports.any(|c| c.active && (choice.connector)(c)) {
                continue;
            }
            match at_rest(model, &pipe.name) {
                Ok(shape) => scene.paths.push(Polyline {
                    stroke: Stroke::Pipe,
                    name: pipe.name.clone(),
                    points: shape.points,
                    tensions: shape.tensions,
                    grounded: false,
                }),
                Err(error) => unshaped.push((pipe.name.clone(), error.error)),
            }
        }
        scene.lay(bottoms);
        for body in model.bodies.values().filter(|b| held.contains(&b.name) || (choice.body)(b)) {
            let outline = outline(model, body);
            scene.marks.push(Mark { sign: Sign::Origin, name: String::new(), at: outline.origin });
            scene.bodies.push(outline);
        }
        Some((scene, unshaped))
    }

    /// The bottom under the lines: one level where they all have it, else a line of its own for each that differs.
    fn lay(&mut self, bottoms: Vec<(String, Vec<Position>)>) {
        let level = self.bottom.or_else(|| bottoms.iter().flat_map(|(_, p)| p).map(|[_, _, z]| *z).next());
        let Some(level) = level else { return };
        let near = |z: f64| (z - level).abs() <= 1e-6 * (1.0 + level.abs());
        let uneven: Vec<_> = bottoms.into_iter().filter(|(_, p)| !p.iter().all(|[_, _, z]| near(*z))).collect();
        if self.bottom.is_some() || uneven.is_empty() {
            self.bottom = Some(level);
        }
        let path =
            |(name, points)| Polyline { stroke: Stroke::Bottom, name, points, tensions: Vec::new(), grounded: false };
        self.paths.extend(uneven.into_iter().map(path));
    }

    /// Every place that a picture must show (m).
    pub fn positions(&self) -> impl Iterator<Item = Position> + '_ {
        let bodies = self.bodies.iter().flat_map(|b| b.panels.iter().flatten().chain(&b.points).copied());
        let paths = self.paths.iter().flat_map(|p| p.points.iter().copied());
        bodies.chain(paths).chain(self.marks.iter().map(|m| m.at))
    }
}

/// What is drawn of one connector.
#[derive(Default)]
struct Drawn {
    path: Option<Polyline>,
    marks: Vec<Mark>,
    bottom: Option<Vec<Position>>,
    error: Option<ClassError>,
}

/// A connector as it hangs, or straight where it has no shape or none was found.
fn shape(model: &Model, connector: &Connector) -> Drawn {
    let placement = model.placement(connector);
    let class = model.classes.get(&Model::key(&connector.class)).map(|c| &c.object);
    let role = class.map_or(ClassRole::Connector, |c| c.role());
    let stroke = |active: Stroke| if connector.active { active } else { Stroke::Inactive };
    let grounded = !connector.points.get(1).is_some_and(|p| on_body(model, p));
    let path =
        |stroke, points, tensions| Some(Polyline { stroke, name: connector.name.clone(), points, tensions, grounded });
    if role == ClassRole::PipeRoller || (role == ClassRole::PipeDavit && model.holds_pipe(&connector.name)) {
        return Drawn::default();
    }
    if connector.active && model.is_dynamic_line(connector) {
        let [from, to] = model.end_poses(connector).map(|p| Position::from(p.origin));
        let found = if class.is_some_and(|c| c.as_pipe().is_some()) { Stroke::Pipe } else { Stroke::Line };
        return match at_rest(model, &connector.name) {
            Ok(shape) => Drawn { path: path(found, shape.points, shape.tensions), ..Drawn::default() },
            Err(error) => Drawn {
                path: path(Stroke::Unsolved, vec![from, to], Vec::new()),
                error: Some(error.error),
                ..Drawn::default()
            },
        };
    }
    match solve(model, connector, &placement) {
        Ok(Some(table)) => {
            let shape = LineShape::from_table(&table, &placement);
            Drawn {
                path: path(stroke(Stroke::Line), shape.points, shape.tensions),
                marks: shape.marks,
                bottom: shape.bottom,
                error: None,
            }
        }
        Ok(None) => {
            let [from, to] = model.end_poses(connector).map(|p| Position::from(p.origin));
            let points = if from == to { vec![from] } else { vec![from, to] };
            let kind = match role {
                ClassRole::Fender => Stroke::Fender,
                ClassRole::Sling => Stroke::Sling,
                _ => Stroke::Straight,
            };
            Drawn { path: path(stroke(kind), points, Vec::new()), ..Drawn::default() }
        }
        Err(error) => Drawn {
            path: placement
                .other
                .and_then(|to| path(stroke(Stroke::Unsolved), vec![placement.fairlead, to], Vec::new())),
            error: connector.active.then_some(error),
            ..Drawn::default()
        },
    }
}

/// Where a line is, and its tension there.
#[derive(Default)]
struct RestShape {
    points: Vec<Position>,
    /// Effective tension (N).
    tensions: Vec<f64>,
}

/// The nodes of the dynamic line, or of the pipe, of a name, at rest in the mean current.
fn at_rest(model: &Model, name: &str) -> Result<RestShape, SolveError> {
    let mut nodes = Vec::new();
    visit_lines_at_rest(model, &|candidate| candidate == name, |_, line, at, state| {
        line.find_nodes(at, state, &mut nodes).map_err(SolveError::error_about(name))
    })?;
    let points = nodes.iter().map(|node| node.position.into()).collect();
    Ok(RestShape { points, tensions: nodes.iter().map(|node| node.effective).collect() })
}

/// The shape of a mooring line; `None` of a connector that is straight.
fn solve(model: &Model, connector: &Connector, placement: &Placement) -> Result<Option<Table>, ClassError> {
    let class = model.classes.get(&Model::key(&connector.class)).filter(|c| c.object.as_line().is_some());
    let Some(class) = class else { return Ok(None) };
    let line = class.line(placement, &model.surroundings())?;
    match line.geometry(&connector.name, Condition::Placed, LineSampling::Adaptive) {
        Ok(table) => Ok(Some(table)),
        // a spring that is pushed together is straight
        Err(_) if line.configuration(Condition::Placed).is_ok_and(|c| c.tension < 0.0) => Ok(None),
        Err(error) => Err(error),
    }
}

fn on_body(model: &Model, point: &str) -> bool {
    model.points.get(&Model::key(point)).is_some_and(|p| model.body_of(p).is_some())
}

/// The marks at the ends of a connector: its points, and the anchor behind a single one.
fn ends(model: &Model, connector: &Connector, path: Option<&Polyline>) -> Vec<Mark> {
    let class = model.classes.get(&Model::key(&connector.class));
    let sign = |body: bool| match class.map_or(ClassRole::Connector, |c| c.object.role()) {
        ClassRole::PipeRoller | ClassRole::PipeDavit => Sign::PipeSupport,
        ClassRole::Fender => Sign::Fender,
        _ if body => Sign::Fairlead,
        _ => Sign::Anchor,
    };
    let named = connector.points.iter().enumerate().filter_map(|(index, name)| {
        // an end set off from its point is elsewhere than the name
        let offset = connector.offsets.get(index).is_some_and(|o| *o != [0.0; 3]);
        let name_shown = if offset { String::new() } else { name.clone() };
        Some(Mark { sign: sign(on_body(model, name)), name: name_shown, at: model.end(connector, index)? })
    });
    let mut marks: Vec<Mark> = named.collect();
    if let (1, Some(path)) = (connector.points.len(), path)
        && let [_, .., at] = *path.points.as_slice()
    {
        marks.push(Mark { sign: Sign::Anchor, name: String::new(), at });
    }
    marks
}

/// The shape of a line in the global system.
struct LineShape {
    points: Vec<Position>,
    /// Tension at each point (N).
    tensions: Vec<f64>,
    marks: Vec<Mark>,
    bottom: Option<Vec<Position>>,
}

impl LineShape {
    /// From the table of a line's geometry.
    fn from_table(table: &Table, placement: &Placement) -> LineShape {
        let column = |name: &str| -> Vec<Option<f64>> {
            let found = table.columns().iter().find(|c| c.name == name);
            found.map_or(Vec::new(), |c| c.cells.iter().map(Cell::number).collect())
        };
        let (_, along) = placement.span();
        let [x0, y0, _] = placement.fairlead;
        let position = |x: f64, z: f64| [x0 + along[0] * x, y0 + along[1] * x, z];
        let xs = column("X");
        let at = |heights: Vec<Option<f64>>| -> Vec<(f64, f64)> {
            xs.iter().zip(heights).filter_map(|(x, z)| x.zip(z)).collect()
        };
        let mut marks = Vec::new();
        for (sign, name) in [(Sign::Touchdown, "Touchdown"), (Sign::Joint, "Joint")] {
            let mark = |(x, z)| Mark { sign, name: String::new(), at: position(x, z) };
            marks.extend(at(column(name)).into_iter().map(mark));
        }
        let bottom = at(column("Bottom"));
        let bottom = bottom.first().zip(bottom.last()).map(|(a, b)| vec![position(a.0, a.1), position(b.0, b.1)]);
        let points: Vec<Position> = at(column("Z")).into_iter().map(|(x, z)| position(x, z)).collect();
        let tensions: Vec<f64> = column("Tension").into_iter().flatten().collect();
        let tensions = if tensions.len() == points.len() { tensions } else { Vec::new() };
        LineShape { points, tensions, marks, bottom }
    }
}

/// A place between two rows of a shape, a share `t` of the arc behind the first: by a cubic with their directions.
pub(super) fn cubic((a, b): ((f64, f64), (f64, f64)), (from, to): (f64, f64), arc: f64, t: f64) -> (f64, f64) {
    let (t2, t3) = (t * t, t * t * t);
    let (h00, h10) = (2.0 * t3 - 3.0 * t2 + 1.0, t3 - 2.0 * t2 + t);
    let (h01, h11) = (3.0 * t2 - 2.0 * t3, t3 - t2);
    let x = h00 * a.0 + h01 * b.0 + arc * (h10 * from.cos() + h11 * to.cos());
    let z = h00 * a.1 + h01 * b.1 - arc * (h10 * from.sin() + h11 * to.sin());
    (x, z)
}
