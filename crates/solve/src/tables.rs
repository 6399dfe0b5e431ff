//! What engines found, as tables.

use super::equilibrium::is_unstable;
use super::modes::{SystemMode, modes};
use super::rebuild::EquilibriumResult;
use super::system::{Contribution, DOFS, SolveError, System, SystemState};
use nalgebra::{Matrix6, Vector3};
use windlass_base::geometry::{Place, Position};
use windlass_base::pose::Six;
use windlass_base::table::{Digits, Table, TableBuilder};
use windlass_base::units::Dim;
use windlass_hydro::{Category, Load};
use windlass_model::Model;

const COMPONENTS: [&str; 6] = ["FX", "FY", "FZ", "MX", "MY", "MZ"];

/// The columns of a force and a moment.
fn with_components<'r, R>(table: TableBuilder<'r, R>, wrench: impl Fn(&'r R) -> &'r Six) -> TableBuilder<'r, R> {
    let [fx, fy, fz, mx, my, mz] = COMPONENTS;
    let part = |row: &'r R, first: usize| [0, 1, 2].map(|i| wrench(row)[first + i]);
    table.columns("Force", [fx, fy, fz], Dim::Force, Digits::Usual, |row| part(row, 0)).columns(
        "Moment",
        [mx, my, mz],
        Dim::Moment,
        Digits::Usual,
        |row| part(row, 3),
    )
}

/// Acceleration left, as a share of gravity, that is more than rounding.
const STALLED_ACCELERATION_SHARE: f64 = 1e-6;

/// Where the bodies are at rest, and what is left on them.
pub fn rest(model: &Model, settled: &EquilibriumResult) -> Table {
    let rows: Vec<RestRow> = settled
        .system
        .nodes
        .iter()
        .enumerate()
        .filter_map(|(index, node)| {
            let left = settled.state.residual.rows(6 * index, 6);
            let moving = |from: usize| {
                let held = left.iter().zip(node.free).skip(from).take(3).filter(|(_, free)| *free);
                held.fold(0.0_f64, |sum, (v, _)| sum.hypot(*v))
            };
            let (force, mass) = (moving(0), node.floating.mass.mass);
            Some(RestRow {
                name: &node.name,
                position: model.bodies.get(&node.key)?.position,
                force,
                moment: moving(3),
                share: (mass > 0.0).then(|| force / (mass * settled.system.gravity)),
            })
        })
        .collect();
    let mut table = Table::new("Equilibrium")
        .fact("Steps", settled.found.search.iterations, Dim::None)
        .fact("Evaluations", settled.found.search.evaluations, Dim::None)
        .with_rows(&rows)
        .text("Body", |row| row.name)
        .columns("Location", ["X", "Y", "Z"], Dim::Length, Digits::Usual, |row| row.position.shift)
        .columns("Rotation", ["Roll", "Pitch", "Yaw"], Dim::Angle, Digits::Usual, |row| row.position.turn)
        .column("Left", "Force", Dim::Force, Digits::Scientific(2), |row| row.force)
        .column("Left", "Moment", Dim::Moment, Digits::Scientific(2), |row| row.moment)
        .column("Left", "Accel/g", Dim::None, Digits::Scientific(2), |row| row.share)
        .build();
    if settled.found.search.residual > STALLED_ACCELERATION_SHARE {
        table.warn(format!(
            "the search came no nearer: {:.1e} of gravity is left, within the tolerance; -TOLERANCE asks for less",
            settled.found.search.residual
        ));
    }
    for (body, dof) in &settled.found.loose {
        table.warn(format!("nothing holds {body} in {dof} where it rests: other places there are as good"));
    }
    table
}

/// A body at rest.
struct RestRow<'m> {
    name: &'m str,
    position: Place,
    /// The force (N) and the moment (N m) left on its degrees of freedom.
    force: f64,
    moment: f64,
    /// The residual acceleration over gravity, of a body with mass.
    share: Option<f64>,
}

/// The forces on each body that fits, by category, about its origin, global axes.
///
/// # Errors
/// A connector that cannot be evaluated.
pub fn by_category(system: &System, state: &SystemState, fits: &dyn Fn(&str) -> bool) -> Result<Table, SolveError> {
    let all = system.contributions(&state.poses)?;
    let mut rows: Vec<(&str, &str, Six)> = Vec::new();
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
                rows.push((&node.name, category.name(), without_rounding(&sum, &size)));
            }
        }
        rows.push((&node.name, "TOTAL", without_rounding(&total, &size)));
    }
    let table = Table::new("Forces on Bodies by Category")
        .fact("Moments About", "the origins of the bodies", Dim::None)
        .with_rows(&rows)
        .text("Body", |(body, ..)| *body)
        .text("Category", |(_, category, _)| *category);
    Ok(with_components(table, |(.., wrench)| wrench).build())
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

/// Eigenvalues of the stiffness against the mass, and natural periods.
///
/// # Errors
/// As [`modes`].
pub fn periods(system: &System, state: &SystemState) -> Result<Table, SolveError> {
    let mut table = Table::new("Natural Periods");
    let list = modes(system, state)?;
    let largest = list.iter().map(|m| m.eigenvalue.abs()).fold(0.0, f64::max);
    for (index, mode) in list.iter().enumerate() {
        if is_unstable(mode.eigenvalue, largest) {
            let (body, dof) = &mode.most;
            table.warn(format!("not stable: mode {} moves {body} in {dof}", index + 1));
        }
        // what half a hundredth of critical damping does not hold
        if mode.beside.abs() > 1e-2 * mode.eigenvalue.abs().max(1e-6) {
            let (body, dof) = &mode.most;
            table.warn(format!(
                "mode {} of {body} in {dof} is coupled by forces without an energy: without damping it grows",
                index + 1
            ));
        }
    }
    table.note(
        "eigenvalues in rad2/s2, of the stiffness against mass and the added mass of #AMASS and members; undamped",
    );
    // a period of 17 hours holds nothing
    let held = |mode: &SystemMode| mode.eigenvalue.abs() > 1e-8;
    let rows: Vec<_> = list.iter().enumerate().collect();
    let table = table
        .with_rows(&rows)
        .column("", "Mode", Dim::None, Digits::Usual, |(index, _)| index + 1)
        .column(
            "",
            "Eigenvalue",
            Dim::None,
            Digits::Scientific(5),
            |(_, mode)| {
                if held(mode) { mode.eigenvalue } else { 0.0 }
            },
        )
        .column("", "Period", Dim::Time, Digits::Usual, |(_, mode)| mode.period.filter(|_| held(mode)))
        .column("Moves Most", "Body", Dim::None, Digits::Usual, |(_, mode)| &mode.most.0)
        .column("Moves Most", "DOF", Dim::None, Digits::Usual, |(_, mode)| mode.most.1)
        .build();
    Ok(table)
}

/// Connectors of a stiffness report.
pub struct ReportedConnectors<'a> {
    /// Those reported one by one.
    pub reported: &'a [&'a str],
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
    state: &SystemState,
    about: Option<Position>,
    fits: &dyn Fn(&str) -> bool,
    connectors: &ReportedConnectors,
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
            let mut made =
                stiffness(&format!("Stiffness of {}", node.name), &all.about_point(arm).stiffness).map(point);
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
            let Some(name) = c.connector.as_deref().filter(|name| connectors.reported.contains(name)) else { continue };
            let title = format!("Stiffness of {name} on {}", node.name);
            list.extend(stiffness(&title, &c.load.about_point(arm).stiffness).map(point));
        }
    }
    Ok(list)
}

/// A six by six stiffness: rows are forces, columns motions.
fn stiffness(title: &str, matrix: &Matrix6<f64>) -> [Table; 2] {
    let rows: Vec<(&str, [f64; 6])> = COMPONENTS
        .into_iter()
        .enumerate()
        .map(|(row, name)| (name, [0, 1, 2, 3, 4, 5].map(|column| matrix[(row, column)])))
        .collect();
    let (forces, moments) = rows.split_at(3);
    let [x, y, z, rx, ry, rz] = DOFS;
    let half = |what: &str, rows: &[(&str, [f64; 6])], [by_shift, by_turn]: [Dim; 2]| {
        Table::new(format!("{title}: {what}s"))
            .with_rows(rows)
            .text(what, |(name, _)| *name)
            .columns("Translation", [x, y, z], by_shift, Digits::Scientific(6), |(_, [x, y, z, ..])| [*x, *y, *z])
            .columns("Rotation", [rx, ry, rz], by_turn, Digits::Scientific(6), |(_, [.., x, y, z])| [*x, *y, *z])
            .build()
    };
    [
        half("Force", forces, [Dim::ForcePerLength, Dim::Force]),
        half("Moment", moments, [Dim::Force, Dim::MomentPerRadian]),
    ]
}
