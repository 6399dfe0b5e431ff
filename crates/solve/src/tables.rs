//! What engines found, as tables.

use super::equilibrium::is_unstable;
use super::modes::modes;
use super::settle::EquilibriumResult;
use super::system::{Contribution, DOFS, SolveError, State, System};
use nalgebra::{Matrix6, Vector3};
use windlass_base::geometry::Position;
use windlass_base::pose::Six;
use windlass_base::table::{Cell, Digits, Table};
use windlass_base::units::Dim;
use windlass_hydro::{Category, Load};
use windlass_model::Model;

const COMPONENTS: [&str; 6] = ["FX", "FY", "FZ", "MX", "MY", "MZ"];

fn with_components(mut table: Table) -> Table {
    for (index, name) in COMPONENTS.into_iter().enumerate() {
        let (group, dim) = if index < 3 { ("Force", Dim::Force) } else { ("Moment", Dim::Moment) };
        table = table.column(group, name, dim, Digits::Usual);
    }
    table
}

fn push(table: &mut Table, row: Vec<Cell>) {
    let fits = table.push(row);
    debug_assert!(fits.is_ok(), "a row must fit its table");
}

/// Acceleration left, as a share of gravity, that is more than rounding.
const STALLED: f64 = 1e-6;

/// Where the bodies are at rest, and what is left on them.
pub fn rest(model: &Model, settled: &EquilibriumResult) -> Table {
    let mut table = Table::new("Equilibrium")
        .fact("Steps", settled.found.steps, Dim::None)
        .fact("Evaluations", settled.found.evaluations, Dim::None)
        .column("", "Body", Dim::None, Digits::Usual);
    for name in ["X", "Y", "Z"] {
        table = table.column("Location", name, Dim::Length, Digits::Usual);
    }
    for name in ["Roll", "Pitch", "Yaw"] {
        table = table.column("Rotation", name, Dim::Angle, Digits::Usual);
    }
    for (name, dim) in [("Force", Dim::Force), ("Moment", Dim::Moment), ("Accel/g", Dim::None)] {
        table = table.column("Left", name, dim, Digits::Scientific(2));
    }
    for (index, node) in settled.system.nodes.iter().enumerate() {
        let Some(body) = model.bodies.get(&node.key) else { continue };
        let left = settled.state.residual.rows(6 * index, 6);
        let moving = |from: usize| {
            let held = left.iter().zip(node.free).skip(from).take(3).filter(|(_, free)| *free);
            held.fold(0.0_f64, |sum, (v, _)| sum.hypot(*v))
        };
        let mass = node.floating.mass.mass;
        let share = if mass > 0.0 { Cell::from(moving(0) / (mass * settled.system.gravity)) } else { Cell::Missing };
        let mut row = vec![Cell::from(node.name.as_str())];
        row.extend(body.place.values().map(Cell::Number));
        row.extend([moving(0).into(), moving(3).into(), share]);
        push(&mut table, row);
    }
    if settled.found.measure > STALLED {
        table.note(format!(
            "warning: the search came no nearer: {:.1e} of gravity is left, within the tolerance; -TOLERANCE asks for less",
            settled.found.measure
        ));
    }
    for (body, dof) in &settled.found.loose {
        table.note(format!("warning: nothing holds {body} in {dof} where it rests: other places there are as good"));
    }
    table
}

/// The forces on each body that fits, by category, about its origin, global axes.
///
/// # Errors
/// A connector that cannot be evaluated.
pub fn by_category(system: &System, state: &State, fits: &dyn Fn(&str) -> bool) -> Result<Table, SolveError> {
    let all = system.contributions(&state.poses)?;
    let table =
        Table::new("Forces on Bodies by Category").fact("Moments About", "the origins of the bodies", Dim::None);
    let mut table = with_components(table.column("", "Body", Dim::None, Digits::Usual).column(
        "",
        "Category",
        Dim::None,
        Digits::Usual,
    ));
    for (body, node) in system.nodes.iter().enumerate().filter(|(_, n)| fits(&n.name)) {
        let (mut total, mut size) = (Six::zeros(), Six::zeros());
        for category in Category::ALL {
            let of = |c: &&Contribution| c.body == body && c.category == category;
            let mut any = false;
            let sum = all.iter().filter(of).fold(Six::zeros(), |sum, c| {
                any = true;
                size = size.sup(&c.load.wrench.abs());
                sum + c.load.wrench
            });
            if any {
                total += sum;
                push(&mut table, wrench_row(&node.name, category.name(), &without_rounding(&sum, &size)));
            }
        }
        push(&mut table, wrench_row(&node.name, "TOTAL", &without_rounding(&total, &size)));
    }
    Ok(table)
}

/// What is less than a solution leaves of the largest force or moment is nothing.
fn without_rounding(wrench: &Six, size: &Six) -> Six {
    let (force, moment) = (size.fixed_rows::<3>(0).amax(), size.fixed_rows::<3>(3).amax());
    // nor has a force that large an arm of less than that share of a metre
    let moment = moment.max(force);
    let mut kept = *wrench;
    for (index, value) in kept.iter_mut().enumerate() {
        let largest = if index < 3 { force } else { moment };
        if value.abs() <= 1e-10 * largest {
            *value = 0.0;
        }
    }
    kept
}

fn wrench_row(body: &str, what: &str, wrench: &Six) -> Vec<Cell> {
    let mut row = vec![Cell::from(body), Cell::from(what)];
    row.extend(wrench.iter().map(|v| Cell::Number(*v)));
    row
}

/// Eigenvalues of the stiffness against the mass, and natural periods.
///
/// # Errors
/// As [`modes`].
pub fn periods(system: &System, state: &State) -> Result<Table, SolveError> {
    let mut table = Table::new("Natural Periods")
        .column("", "Mode", Dim::None, Digits::Usual)
        .column("", "Eigenvalue", Dim::None, Digits::Scientific(5))
        .column("", "Period", Dim::Time, Digits::Usual)
        .column("Moves Most", "Body", Dim::None, Digits::Usual)
        .column("Moves Most", "Freedom", Dim::None, Digits::Usual);
    let list = modes(system, state)?;
    let largest = list.iter().map(|m| m.eigenvalue.abs()).fold(0.0, f64::max);
    for (index, mode) in list.into_iter().enumerate() {
        // a period of 17 hours holds nothing
        let held = mode.eigenvalue.abs() > 1e-8;
        let period = mode.period.filter(|_| held);
        if is_unstable(mode.eigenvalue, largest) {
            let (body, dof) = &mode.most;
            table.note(format!("warning: not stable: mode {} moves {body} in {dof}", index + 1));
        }
        // what half a hundredth of critical damping does not hold
        if mode.beside.abs() > 1e-2 * mode.eigenvalue.abs().max(1e-6) {
            let (body, dof) = &mode.most;
            table.note(format!(
                "warning: mode {} of {body} in {dof} is coupled by forces without an energy: without damping it grows",
                index + 1
            ));
        }
        push(
            &mut table,
            vec![
                (index + 1).into(),
                if held { mode.eigenvalue } else { 0.0 }.into(),
                period.into(),
                mode.most.0.into(),
                mode.most.1.into(),
            ],
        );
    }
    table.note(
        "eigenvalues in rad2/s2, of the stiffness against mass and the added mass of #AMASS and members; undamped",
    );
    Ok(table)
}

/// Connectors of a stiffness report.
pub struct Connectors<'a> {
    /// Those told one by one.
    pub told: &'a [&'a str],
    /// Whether the stiffness of one of this name is left out of that of a body.
    pub left_out: &'a dyn Fn(&str) -> bool,
}

/// The stiffness, in an evaluated state, of the bodies that fit, with all that acts on them, and of each of the connectors named, about a point (m,
/// global), else about the bodies' origins. A connector between two bodies has one for each.
///
/// # Errors
/// A connector that cannot be evaluated.
pub fn stiffnesses(
    system: &System,
    state: &State,
    about: Option<Position>,
    fits: &dyn Fn(&str) -> bool,
    connectors: &Connectors,
) -> Result<Vec<Table>, SolveError> {
    let all = system.contributions(&state.poses)?;
    let mut list = Vec::new();
    for (body, (node, pose)) in system.nodes.iter().zip(&state.poses).enumerate() {
        let arm = about.map_or(Vector3::zeros(), |at| Vector3::from(at) - pose.origin);
        let own = || all.iter().filter(move |c| c.body == body);
        let point = |table: Table| {
            let [x, y, z]: Position = (pose.origin + arm).into();
            let table = table.fact("About X", x, Dim::Length).fact("Y", y, Dim::Length);
            table.fact("Z", z, Dim::Length)
        };
        if fits(&node.name) {
            let wrench = own().fold(Six::zeros(), |sum, c| sum + c.load.wrench);
            let left_out = own().filter(|c| c.connector.as_deref().is_some_and(|name| (connectors.left_out)(name)));
            let mut names: Vec<&str> = Vec::new();
            let mut followed = system.followed_stiffness(state, body)?;
            for c in left_out {
                followed -= c.load.stiffness;
                names.extend(c.connector.as_deref());
            }
            let all = Load { wrench, stiffness: followed };
            let mut made = stiffness(&format!("Stiffness of {}", node.name), &all.about(arm).stiffness).map(point);
            if !node.junction && system.nodes.iter().any(|n| n.junction) {
                made.iter_mut()
                    .for_each(|t| t.note("junctions follow the body to their own equilibrium; other bodies are held"));
            }
            if !names.is_empty() {
                made.iter_mut().for_each(|t| t.note(format!("without {} (-IG_STIFF)", names.join(", "))));
            }
            list.extend(made);
        }
        for c in own() {
            let Some(name) = c.connector.as_deref().filter(|name| connectors.told.contains(name)) else { continue };
            let title = format!("Stiffness of {name} on {}", node.name);
            list.extend(stiffness(&title, &c.load.about(arm).stiffness).map(point));
        }
    }
    Ok(list)
}

/// A six by six stiffness: rows are forces, columns motions.
fn stiffness(title: &str, matrix: &Matrix6<f64>) -> [Table; 2] {
    let mut forces = Table::new(format!("{title}: Forces")).column("", "Force", Dim::None, Digits::Usual);
    let mut moments = Table::new(format!("{title}: Moments")).column("", "Moment", Dim::None, Digits::Usual);
    for (index, name) in DOFS.into_iter().enumerate() {
        let (group, force, moment) = if index < 3 {
            ("Translation", Dim::ForcePerLength, Dim::Force)
        } else {
            ("Rotation", Dim::Force, Dim::MomentPerRadian)
        };
        forces = forces.column(group, name, force, Digits::Scientific(6));
        moments = moments.column(group, name, moment, Digits::Scientific(6));
    }
    for (row, name) in COMPONENTS.into_iter().enumerate() {
        let mut cells = vec![Cell::from(name)];
        cells.extend(matrix.row(row).iter().map(|v| Cell::Number(*v)));
        push(if row < 3 { &mut forces } else { &mut moments }, cells);
    }
    [forces, moments]
}
