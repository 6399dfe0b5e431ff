//! `&STATUS ASSEMBLIES`: where hooks are and what their lines bear.

use crate::commands::status::kind::StatusKind;
use nalgebra::Vector3;
use windlass_base::table::{Digits, Table};
use windlass_base::units::{Dim, UnitSystem};
use windlass_hydro::ambient;
use windlass_model::{
    Assembly, AssemblyKind, ClassError, Connector, ConnectorResponse, ConnectorSummary, End, LaidPipe, Model,
    RunRequirement, Situation,
};
use windlass_model::{EntityKind, SolverCache};

/// `&STATUS ASSEMBLIES`.
pub static ASSEMBLIES: StatusKind = StatusKind::new(
    "ASSEMBLIES",
    "tip-hook sets, lines over pulleys and winches: where the hook is, what lines bear",
    |query, _| Ok(assemblies(query.model(), &query.fits(), query.job.units)),
)
.with_names(&[EntityKind::Assembly])
.also(&["TIP-HOOK"]);

/// What a row of the tip-hook sets shows: the hook of a set, or one of its lines.
struct HookRow<'m> {
    /// The set, on the row of its hook.
    set: Option<&'m str>,
    /// Where the hook or the node of a line is (m, global).
    position: [f64; 3],
    /// The line; `None` on the row of the hook.
    line: Option<HookLine<'m>>,
}

/// A line of a tip-hook set.
struct HookLine<'m> {
    name: &'m str,
    role: &'static str,
    status: &'static str,
    /// Unstretched length (m).
    unstretched: Option<f64>,
    /// From the node to the hook (m).
    apart: Vector3<f64>,
    /// What it bears; `None` where it is inactive or has no solution.
    summary: Option<ConnectorSummary>,
}

/// One table of the tip-hook sets: the hook, then its lines.
pub fn assemblies(model: &Model, fits: &dyn Fn(&str) -> bool, units: UnitSystem) -> Vec<Table> {
    let mut table = Table::new("Tip-Hook Sets");
    let (mut rows, mut pipes) = (Vec::new(), Vec::new());
    for assembly in model.assemblies.values().filter(|a| fits(&a.name)) {
        match &assembly.kind {
            AssemblyKind::TipHook { boom, .. } => rows.extend(hook_rows(&mut table, model, assembly, boom, units)),
            AssemblyKind::Pipe { .. } => pipes.push(pipe(model, assembly, units)),
            AssemblyKind::Pulley { .. } | AssemblyKind::Winch { .. } => pipes.push(reeved(model, assembly, units)),
        }
    }
    if rows.is_empty() && !pipes.is_empty() {
        return pipes;
    }
    let summary = |row: &'_ HookRow| row.line.as_ref().and_then(|l| l.summary.as_ref().map(|s| (s.tension, s.ratio)));
    let table = table
        .with_rows(&rows)
        .text("Set", |row| row.set)
        .text("Element", |row| row.line.as_ref().map(|l| l.name))
        .text("Role", |row| row.line.as_ref().map_or("HOOK", |l| l.role))
        .text("Status", |row| row.line.as_ref().map(|l| l.status))
        .columns("Hook or Node", ["X", "Y", "Z"], Dim::Length, Digits::Usual, |row| row.position)
        .column("Length", "Unstretched", Dim::Length, Digits::Decimals(4), |row| {
            row.line.as_ref().and_then(|l| l.unstretched)
        })
        .column("Length", "Distance", Dim::Length, Digits::Decimals(4), |row| row.line.as_ref().map(|l| l.apart.norm()))
        .column("", "Tension", Dim::Force, Digits::Usual, |row| summary(row).and_then(|(tension, _)| tension))
        .column("", "T/TB", Dim::None, Digits::Decimals(3), |row| summary(row).and_then(|(_, ratio)| ratio))
        .column("To Vertical", "Angle", Dim::Angle, Digits::Usual, |row| {
            row.line.as_ref().map(|l| l.apart.xy().norm().atan2(l.apart.z.abs()))
        })
        .build();
    std::iter::once(table).chain(pipes).collect()
}

/// The table of a line over pulleys, or off a drum: its spans.
fn reeved(model: &Model, assembly: &Assembly, units: UnitSystem) -> Table {
    let title = if matches!(assembly.kind, AssemblyKind::Winch { .. }) { "Winch" } else { "Line over Pulleys" };
    let mut table = Table::new(title).fact("Name", assembly.name.as_str(), Dim::None);
    let spans: Vec<&Connector> =
        assembly.members().filter_map(|name| model.connectors.get(&Model::key(name))).collect();
    let whole: f64 = spans.iter().filter_map(|span| model.first_length(span)).sum();
    table = table.fact("Length of First Segments", whole, Dim::Length);
    let mut rows = Vec::new();
    for span in spans {
        let acts = span.active && !model.is_unreeved(&span.name);
        let tension = match acts.then(|| line_summary(model, span)) {
            Some(Ok(summary)) => summary.tension,
            Some(Err(error)) => {
                table.note_absent(format!("{}: {}", span.name, error.text(units)));
                None
            }
            None => None,
        };
        let [from, to] = model.end_poses(span).map(|pose| pose.origin);
        rows.push((span, acts, (to - from).norm(), tension));
    }
    table
        .with_rows(&rows)
        .text("Span", |(span, ..)| &span.name)
        .text("Status", |(_, acts, ..)| if *acts { "Active" } else { "Inactive" })
        .column("", "Distance", Dim::Length, Digits::Decimals(4), |(_, _, distance, _)| *distance)
        .column("", "Tension", Dim::Force, Digits::Usual, |(.., tension)| *tension)
        .build()
}

/// The table of a pipe: what it exerts on its supports.
fn pipe(model: &Model, assembly: &Assembly, units: UnitSystem) -> Table {
    let mut table = Table::new("Pipe Assembly").fact("Name", assembly.name.as_str(), Dim::None);
    let found = on_supports(model, assembly);
    if let Ok(Some((_, summary))) = &found {
        table = table.fact("Tension at the Top", summary.tension, Dim::Force);
        table = table.fact("Length on Bottom", summary.grounded, Dim::Length);
    }
    let mut forces = match found {
        Ok(found) => found.map(|(forces, _)| forces).unwrap_or_default(),
        Err(error) => {
            table.note_absent(format!("{}: {}", assembly.name, error.text(units)));
            Vec::new()
        }
    }
    .into_iter();
    let members = assembly.members().filter_map(|name| Some((name, model.connectors.get(&Model::key(name))?)));
    let supports: Vec<_> =
        members.map(|(name, connector)| (name, connector, forces.next().filter(|_| connector.active))).collect();
    table
        .with_rows(&supports)
        .text("Element", |(name, _, _)| *name)
        .text("Status", |(_, connector, _)| if connector.active { "Active" } else { "Inactive" })
        .columns("Node", ["X", "Y", "Z"], Dim::Length, Digits::Usual, |(_, connector, _)| {
            model.end(connector, 0).unwrap_or_default()
        })
        .columns("Force on Node", ["FX", "FY", "FZ"], Dim::Force, Digits::Usual, |(_, _, force)| {
            force.map_or([None; 3], |f| f.map(Some))
        })
        .build()
}

/// Forces on nodes (N), and a summary.
type OnSupports = (Vec<[f64; 3]>, ConnectorSummary);

/// The forces of a pipe on the nodes of its active supports (N), and its summary.
fn on_supports(model: &Model, assembly: &Assembly) -> Result<Option<OnSupports>, ClassError> {
    let around = ambient(model, None)?;
    let Some(LaidPipe { supports, element }) = model.pipe(assembly, Some(&around), RunRequirement::default())? else {
        return Ok(None);
    };
    let ends: Vec<End> = supports.iter().map(|c| End::at_rest(model.end_pose(c, 0).unwrap_or_default())).collect();
    let surroundings = model.surroundings();
    let at = Situation { ends: &ends, step: None, surroundings: &surroundings };
    let mut out = ConnectorResponse::default();
    let mut state = vec![0.0; element.states()];
    element.evaluate(&at, &state.clone(), &mut state, &mut SolverCache::new(), &mut out)?;
    let forces = out.wrench.iter().map(|w| [w[0], w[1], w[2]]).collect();
    Ok(Some((forces, element.summary(&at, &state)?)))
}

/// The rows of a set: its hook, then its lines.
fn hook_rows<'m>(
    table: &mut Table,
    model: &'m Model,
    assembly: &'m Assembly,
    boom: &str,
    units: UnitSystem,
) -> Vec<HookRow<'m>> {
    let hook = model.bodies.get(&Model::key(&assembly.name)).map(|b| b.position.shift).unwrap_or_default();
    let mut rows = vec![HookRow { set: Some(&assembly.name), position: hook, line: None }];
    for name in assembly.members() {
        let Some(connector) = model.connectors.get(&Model::key(name)) else { continue };
        let [node, end] = model.end_poses(connector).map(|p| p.origin);
        let summary = match connector.active.then(|| line_summary(model, connector)) {
            Some(Ok(summary)) => Some(summary),
            Some(Err(error)) => {
                table.note_absent(format!("{name}: {}", error.text(units)));
                None
            }
            None => None,
        };
        let line = HookLine {
            name,
            role: if name == boom { "BOOM" } else { "SLING" },
            status: if connector.active { "Active" } else { "Inactive" },
            unstretched: model.first_length(connector),
            apart: end - node,
            summary,
        };
        rows.push(HookRow { set: None, position: node.into(), line: Some(line) });
    }
    rows
}

/// What a line bears between its ends.
fn line_summary(model: &Model, connector: &Connector) -> Result<ConnectorSummary, ClassError> {
    let element = model.element(connector)?;
    let ends: Vec<End> = model.element_ends(connector).into_iter().map(End::at_rest).collect();
    let mut state = vec![0.0; element.states()];
    element.start(&mut state);
    let surroundings = model.surroundings();
    let at = Situation { ends: &ends, step: None, surroundings: &surroundings };
    element.evaluate(&at, &state.clone(), &mut state, &mut SolverCache::new(), &mut ConnectorResponse::default())?;
    element.summary(&at, &state)
}
