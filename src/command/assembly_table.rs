//! `&STATUS ASSEMBLIES`: where hooks are and what their lines bear.

use super::status::push;
use nalgebra::Vector3;
use windlass_base::table::{Cell, Digits, Table};
use windlass_base::units::{Dim, UnitSystem};
use windlass_hydro::ambient;
use windlass_model::{
    Assembly, AssemblyKind, ClassError, Connector, End, LaidPipe, Model, Response, RunRequirement, Situation, Summary,
};

/// One table of the tip-hook sets: the hook, then its lines.
pub fn assemblies(model: &Model, fits: &dyn Fn(&str) -> bool, units: UnitSystem) -> Vec<Table> {
    let mut table = Table::new("Tip-Hook Sets")
        .column("", "Set", Dim::None, Digits::Usual)
        .column("", "Element", Dim::None, Digits::Usual)
        .column("", "Role", Dim::None, Digits::Usual)
        .column("", "Status", Dim::None, Digits::Usual);
    for name in ["X", "Y", "Z"] {
        table = table.column("Hook or Node", name, Dim::Length, Digits::Usual);
    }
    let mut table = table
        .column("Length", "Unstretched", Dim::Length, Digits::Decimals(4))
        .column("Length", "Distance", Dim::Length, Digits::Decimals(4))
        .column("", "Tension", Dim::Force, Digits::Usual)
        .column("", "T/TB", Dim::None, Digits::Decimals(3))
        .column("To Vertical", "Angle", Dim::Angle, Digits::Usual);
    let mut pipes = Vec::new();
    for assembly in model.assemblies.values().filter(|a| fits(&a.name)) {
        match &assembly.kind {
            AssemblyKind::TipHook { .. } => rows(&mut table, model, assembly, units),
            AssemblyKind::Pipe { .. } => pipes.push(pipe(model, assembly, units)),
        }
    }
    Some(table).filter(|t| t.rows() > 0 || pipes.is_empty()).into_iter().chain(pipes).collect()
}

/// The table of a pipe: what it exerts on its supports.
fn pipe(model: &Model, assembly: &Assembly, units: UnitSystem) -> Table {
    let mut table = Table::new("Pipe Assembly").fact("Name", assembly.name.as_str(), Dim::None);
    let found = on_supports(model, assembly);
    if let Ok(Some((_, summary))) = &found {
        table = table.fact("Tension at the Top", summary.tension, Dim::Force);
        table = table.fact("Length on Bottom", summary.grounded, Dim::Length);
    }
    table = table.column("", "Element", Dim::None, Digits::Usual).column("", "Status", Dim::None, Digits::Usual);
    for name in ["X", "Y", "Z"] {
        table = table.column("Node", name, Dim::Length, Digits::Usual);
    }
    for name in ["FX", "FY", "FZ"] {
        table = table.column("Force on Node", name, Dim::Force, Digits::Usual);
    }
    let mut forces = match found {
        Ok(found) => found.map(|(forces, _)| forces).unwrap_or_default(),
        Err(error) => {
            table.note_absent(format!("{}: {}", assembly.name, error.text(units)));
            Vec::new()
        }
    }
    .into_iter();
    for name in assembly.members() {
        let Some(connector) = model.connectors.get(&Model::key(name)) else { continue };
        let status = if connector.active { "Active" } else { "Inactive" };
        let mut row: Vec<Cell> = vec![name.as_str().into(), status.into()];
        row.extend(model.end(connector, 0).unwrap_or_default().map(Cell::Number));
        match forces.next().filter(|_| connector.active) {
            Some(force) => row.extend(force.map(Cell::Number)),
            None => row.extend([const { Cell::Missing }; 3]),
        }
        push(&mut table, row);
    }
    table
}

/// Forces on nodes (N), and a summary.
type OnSupports = (Vec<[f64; 3]>, Summary);

/// The forces of a pipe on the nodes of its active supports (N), and what it tells of itself.
fn on_supports(model: &Model, assembly: &Assembly) -> Result<Option<OnSupports>, ClassError> {
    let around = ambient(model, None)?;
    let Some(LaidPipe { supports, element }) = model.pipe(assembly, Some(&around), RunRequirement::default())? else {
        return Ok(None);
    };
    let ends: Vec<End> = supports.iter().map(|c| End::still(model.end_pose(c, 0).unwrap_or_default())).collect();
    let surroundings = model.surroundings();
    let at = Situation { ends: &ends, step: None, surroundings: &surroundings };
    let mut out = Response::default();
    let mut state = vec![0.0; element.states()];
    element.evaluate(&at, &state.clone(), &mut state, &mut None, &mut out)?;
    let forces = out.wrench.iter().map(|w| [w[0], w[1], w[2]]).collect();
    Ok(Some((forces, element.summary(&at, &state)?)))
}

fn rows(table: &mut Table, model: &Model, assembly: &Assembly, units: UnitSystem) {
    let AssemblyKind::TipHook { boom, .. } = &assembly.kind else { return };
    let hook = model.bodies.get(&Model::key(&assembly.name)).map(|b| b.place.shift).unwrap_or_default();
    let mut row = vec![Cell::from(assembly.name.as_str()), Cell::Missing, "HOOK".into(), Cell::Missing];
    row.extend(hook.map(Cell::Number));
    row.extend([const { Cell::Missing }; 5]);
    push(table, row);
    for name in assembly.members() {
        let Some(connector) = model.connectors.get(&Model::key(name)) else { continue };
        let [node, end] = model.end_poses(connector).map(|p| p.origin);
        let role = if name == boom { "BOOM" } else { "SLING" };
        let status = if connector.active { "Active" } else { "Inactive" };
        let mut row = vec![Cell::Missing, name.as_str().into(), role.into(), status.into()];
        row.extend(node.iter().map(|v| Cell::Number(*v)));
        row.extend([model.first_length(connector).into(), Cell::Number((end - node).norm())]);
        match connector.active.then(|| borne(model, connector)) {
            Some(Ok(summary)) => row.extend([summary.tension.into(), summary.ratio.into()]),
            Some(Err(error)) => {
                table.note_absent(format!("{name}: {}", error.text(units)));
                row.extend([Cell::Missing, Cell::Missing]);
            }
            None => row.extend([Cell::Missing, Cell::Missing]),
        }
        let apart: Vector3<f64> = end - node;
        row.push(Cell::Number(apart.xy().norm().atan2(apart.z.abs())));
        push(table, row);
    }
}

/// What a line bears between its ends.
fn borne(model: &Model, connector: &Connector) -> Result<Summary, ClassError> {
    let element = model.element(connector)?;
    let ends = model.end_poses(connector).map(End::still);
    let mut state = vec![0.0; element.states()];
    element.start(&mut state);
    let surroundings = model.surroundings();
    let at = Situation { ends: &ends, step: None, surroundings: &surroundings };
    element.evaluate(&at, &state.clone(), &mut state, &mut None, &mut Response::default())?;
    element.summary(&at, &state)
}
