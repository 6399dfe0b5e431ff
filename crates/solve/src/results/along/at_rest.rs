//! A line at rest between its ends where they stand.

use super::{CLEARANCE, sections};
use crate::link::{Attachment, connected, laid, pose_of};
use crate::system::SolveError;
use crate::time::RunRequirements;
use windlass_base::table::{Cell, Digits, Table};
use windlass_base::units::Dim;
use windlass_hydro::ambient;
use windlass_model::{DYNAMIC, Element, End, Model, Situation};

/// Tells of each dynamic line and whose name fits, between its ends where they stand: its name, its element, how its ends
/// stand, and its state before anything has happened.
///
/// # Errors
/// What telling comes to.
pub(crate) fn standing(
    model: &Model,
    fits: &dyn Fn(&str) -> bool,
    mut tell: impl FnMut(&str, &dyn Element, &Situation, &[f64]) -> Result<(), SolveError>,
) -> Result<(), SolveError> {
    let around = ambient(model, None).map_err(SolveError::new)?;
    let poses: Vec<_> = model.bodies.values().map(|b| windlass_base::pose::Pose::of(&b.place)).collect();
    let surroundings = model.surroundings();
    let mut told = |name: &str, element: &dyn Element, ends: &[Attachment]| {
        if element.nodes() == 0 {
            return Ok(());
        }
        let ends: Vec<End> = ends.iter().map(|end| End::still(pose_of(end, &poses))).collect();
        let at = Situation { ends: &ends, step: None, surroundings: &surroundings };
        let mut state = vec![0.0; element.states()];
        element.start(&mut state);
        tell(name, element, &at, &state)
    };
    for connector in model.connectors.values().filter(|c| c.active && fits(&c.name) && !model.holds_pipe(&c.name)) {
        let element = match model.element_in(connector, Some(&around)) {
            Ok(element) => element,
            Err(error) if model.moves(connector) => return Err(SolveError::of(&connector.name)(error)),
            // what makes no element here tells of no nodes; who needs its force says why
            Err(_) => continue,
        };
        told(&connector.name, element.as_ref(), &connected(model, connector))?;
    }
    for assembly in model.assemblies.values().filter(|a| fits(&a.name)) {
        if let Some((element, ends)) = laid((model, &around, &RunRequirements::default()), assembly)? {
            told(&assembly.name, element.as_ref(), &ends)?;
        }
    }
    Ok(())
}

/// What is to be known of the dynamic lines where they rest between their ends as they stand: their names with the text.
pub fn cautions(model: &Model) -> Vec<(String, &'static str)> {
    let mut made = Vec::new();
    // of others nothing is to be said
    let moves = |name: &str| model.connectors.get(&Model::key(name)).is_some_and(|c| model.moves(c));
    let told = standing(model, &moves, |name, element, at, _| {
        made.extend(element.caution(at).map(|text| (name.to_string(), text)));
        Ok(())
    });
    // who solves says why a line cannot be made
    told.map_or_else(|_| Vec::new(), |()| made)
}

/// The dynamic lines and whose names fit, at rest between their ends as they stand: a table each, a row a node.
///
/// # Errors
/// A line that has no answer there.
pub fn lines_at_rest(model: &Model, fits: &dyn Fn(&str) -> bool) -> Result<Vec<Table>, SolveError> {
    let mut tables = Vec::new();
    standing(model, fits, |name, element, at, state| {
        let mut nodes = Vec::new();
        element.along(at, state, &mut nodes).map_err(SolveError::of(name))?;
        let sections = sections(model, name);
        let tube = sections.iter().any(|s| s.tube.is_some());
        let bends = element.bends();
        let mut table = Table::new("Line at Rest")
            .fact("Line", name, Dim::None)
            .fact("Model", DYNAMIC, Dim::None)
            .column("", "Node", Dim::None, Digits::Usual)
            .column("", "Arc", Dim::Length, Digits::Usual);
        for axis in ["X", "Y", "Z"] {
            table = table.column("", axis, Dim::Length, Digits::Usual);
        }
        table = table.column("", "Clearance", Dim::Length, CLEARANCE);
        table = table.column("", "Tension", Dim::Force, Digits::Usual);
        if bends {
            table = table
                .column("", "Shear", Dim::Force, Digits::Usual)
                .column("", "Moment", Dim::Moment, Digits::Usual)
                .column("", "Curvature", Dim::Derived { force: 0, length: -1, seconds: 0 }, Digits::Scientific(4));
        }
        if tube {
            table = table.column("", "Wall", Dim::Force, Digits::Usual);
            for kind in ["Axial", "Bending", "Hoop", "Von Mises"] {
                table = table.column("Stress", kind, Dim::Stress, Digits::Usual);
            }
        }
        let mut table = table.column("", "Used", Dim::None, Digits::Decimals(3));
        for (index, node) in nodes.iter().enumerate() {
            let mut cells: Vec<Cell> = vec![(index + 1).into()];
            let place = [node.arc, node.position.x, node.position.y, node.position.z, node.clearance, node.effective];
            cells.extend(place.map(|v| if v.is_finite() { Cell::Number(v + 0.0) } else { Cell::Missing }));
            if bends {
                cells.extend([node.shear, node.moment, node.curvature].map(Cell::from));
            }
            if tube {
                let worse = node.worse();
                cells.push(worse.wall.into());
                let stress = worse.stress.map(|s| [s.axial, s.bending, s.hoop, s.von_mises]);
                cells.extend((0..4).map(|i| Cell::from(stress.and_then(|s| s.get(i).copied()))));
            }
            let used = node.sides().filter_map(|side| {
                let stress = side.stress.map(|s| s.von_mises);
                Some(sections.get(side.segment)?.used(node.effective, stress))
            });
            cells.push(used.reduce(f64::max).into());
            let text =
                |e: windlass_base::table::TableError| SolveError::new(windlass_model::ClassError::new(e.to_string()));
            table.push(cells).map_err(text)?;
        }
        table.note("between its ends where they stand, in the mean current, without waves");
        table.note(if tube {
            "Used is von Mises stress over yield stress of a tube, tension over breaking tension of other sections"
        } else {
            "Used is tension over breaking tension"
        });
        tables.push(table);
        Ok(())
    })?;
    Ok(tables)
}
