//! The options of `&ENV` for what lines feel beside water and wind: the bottom, and what pipes hold.

use crate::commands::Job;
use crate::commands::environment::env::formula;
use crate::commands::environment::plausible::format_value;
use windlass_base::diagnostic::Outcome;
use windlass_base::span::Span;
use windlass_base::units::Dim;
use windlass_base::values::Given;
use windlass_base::values::Noun;
use windlass_language::select::Owner;
use windlass_language::spec::{Kind, OptionSpec, ValueSpec};
use windlass_model::{Connector, Environment, Model, StaticSeabed, find};

/// -BATHYMETRY.
pub(crate) const BATHYMETRY: OptionSpec = OptionSpec::new(
    "-BATHYMETRY",
    &[ValueSpec::new("NAME", Kind::Name(Noun::Bathymetry), "a bottom of &BATHYMETRY")],
    "bottom over a grid",
)
.owner(Owner::Ours)
.default("flat, at -DEPTH");

/// -T_PRESSURE.
pub(crate) const T_PRESSURE: OptionSpec = OptionSpec::new(
    "-T_PRESSURE",
    &[ValueSpec::new("NAME", Kind::Name(Noun::Filling), "data of the command T_PRESSURE")],
    "temperature, pressure and contents of pipes of class ROD",
)
.default("none: nothing in them, and no warmer than laid");

/// Takes one of these options.
///
/// # Errors
/// A name that is not there.
pub(crate) fn apply(job: &Job, env: &mut Environment, given: &Given) -> Outcome<()> {
    let name = || given.first_word().unwrap_or_default();
    let span = given.first_place();
    match given {
        _ if given.is(&BATHYMETRY) => {
            find(&job.model.bathymetries, name(), "bathymetry", span)?;
            env.bathymetry = Some(formula(given, None));
        }
        _ if given.is(&T_PRESSURE) => {
            find(&job.model.fillings, name(), "set of T_PRESSURE data", span)?;
            env.filling = Some(formula(given, None));
        }
        _ => {}
    }
    Ok(())
}

/// A plane bottom that a line lies on whatever the environment says.
#[derive(Clone, Copy, PartialEq)]
enum PlaneBottomOption {
    /// Through the anchor, of a line that is not dynamic.
    Anchor,
    /// As -SLOPE of the class says, of one that does.
    Slope,
}

/// The plane of its own that a line lies on, if any.
fn plane_of(model: &Model, connector: &Connector) -> Option<PlaneBottomOption> {
    let class = &model.classes.get(&Model::key(&connector.class))?.object;
    if model.is_dynamic_line(connector) {
        return class.as_dynamic_line().filter(|c| c.has_sloped_seabed()).map(|_| PlaneBottomOption::Slope);
    }
    let has_bottom = class.as_line().is_some_and(|line| line.seabed() != StaticSeabed::None);
    let on_plane = connector.points.len() < 2 && has_bottom && model.bathymetry_under(connector).is_none();
    on_plane.then_some(PlaneBottomOption::Anchor)
}

/// Warns of a connector whose anchor, or whose fairlead where it lies on the bathymetry, is beyond the edges of the grid.
fn warn_outside(job: &mut Job, connector: &str, span: Span) {
    let model = &job.model;
    let Some(connector) = model.connectors.get(&Model::key(connector)) else { return };
    let (Some(grid), Some(anchor)) = (model.bathymetry_in(&model.environment), connector.anchor) else { return };
    let fairlead = model.end(connector, 0).filter(|_| model.bathymetry_under(connector).is_some());
    let ends = [Some(("anchor", anchor.at)), fairlead.map(|[x, y, _]| ("fairlead", [x, y]))];
    let outside = ends.into_iter().flatten().map(|(end, at)| (end, grid.distance_outside(at)));
    let Some((end, by)) = outside.filter(|(_, by)| *by > 0.0).max_by(|a, b| a.1.total_cmp(&b.1)) else { return };
    let by = format_value(by, Dim::Length, job.units);
    let text = format!(
        "the {end} of {} lies {by} beyond the edge of bathymetry {}: the depth at the edge is taken there",
        connector.name, grid.name
    );
    job.warn(text, span);
}

/// Says of lines on a plane bottom of their own that the bottom just put in force is none, and of lines that reach beyond it.
pub(crate) fn planes(job: &mut Job, given: Option<&Given>) {
    let (Some(given), Some(named)) = (given, &job.model.environment.bathymetry) else { return };
    let grid = named.kind.clone();
    let lines: Vec<String> = job.model.connectors.values().map(|c| c.name.clone()).collect();
    for line in lines {
        warn_outside(job, &line, given.span);
    }
    for which in [PlaneBottomOption::Anchor, PlaneBottomOption::Slope] {
        let lies = |c: &&Connector| plane_of(&job.model, c) == Some(which);
        let lines: Vec<&str> = job.model.connectors.values().filter(lies).map(|c| c.name.as_str()).collect();
        let few = match lines.as_slice() {
            [] => continue,
            [first, second, third, others @ ..] if others.len() > 1 => {
                format!("{first}, {second}, {third} and {} more lie", others.len())
            }
            [one] => format!("{one} lies"),
            all => format!("{} lie", all.join(", ")),
        };
        let text = match which {
            PlaneBottomOption::Anchor => {
                format!("{few} on the plane bottom through the anchor, not on bathymetry {grid}")
            }
            PlaneBottomOption::Slope => format!("{few} on the plane bottom of -SLOPE, not on bathymetry {grid}"),
        };
        job.remark(text, given.span);
    }
}

/// The same of a connector just defined, where a bottom over a grid is in force.
pub(crate) fn plane(job: &mut Job, connector: &str, span: Span) {
    warn_outside(job, connector, span);
    let model = &job.model;
    let found = model.connectors.get(&Model::key(connector)).and_then(|c| plane_of(model, c));
    let (Some(which), Some(named)) = (found, &model.environment.bathymetry) else { return };
    let text = match which {
        PlaneBottomOption::Anchor => {
            format!("{connector} lies on the plane bottom through its anchor, not on bathymetry {}", named.kind)
        }
        PlaneBottomOption::Slope => {
            format!("{connector} lies on the plane bottom of its -SLOPE, not on bathymetry {}", named.kind)
        }
    };
    job.remark(text, span);
}
