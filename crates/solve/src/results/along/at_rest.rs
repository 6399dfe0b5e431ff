//! A line at rest between its ends where they stand.

use super::summary::LineSummary;
use super::{CLEARANCE, sections};
use crate::link::{EndAttachment, build_pipe_link, end_attachments, pose_of};
use crate::system::SolveError;
use crate::time::RunRequirements;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_hydro::ambient;
use windlass_model::{ConnectorElement, DynamicConnector, End, Idealisation, LineNode, Model, Situation};

/// Visits each dynamic line whose name fits, between its ends where they stand: with its name, its element, how its ends
/// stand, and its state before anything has happened.
///
/// # Errors
/// A line that makes no element, and what `tell` returns.
pub(crate) fn visit_lines_at_rest(
    model: &Model,
    fits: &dyn Fn(&str) -> bool,
    mut tell: impl FnMut(&str, &dyn DynamicConnector, &Situation, &[f64]) -> Result<(), SolveError>,
) -> Result<(), SolveError> {
    let around = ambient(model, None).map_err(SolveError::new)?;
    let poses: Vec<_> = model.bodies.values().map(|b| windlass_base::pose::Pose::from_place(&b.position)).collect();
    let surroundings = model.surroundings();
    let mut report = |name: &str, element: &dyn ConnectorElement, ends: &[EndAttachment]| {
        let Some(line) = element.as_dynamic() else { return Ok(()) };
        let ends: Vec<End> = ends.iter().map(|end| End::at_rest(pose_of(end, &poses))).collect();
        let at = Situation { ends: &ends, step: None, surroundings: &surroundings };
        let mut state = vec![0.0; element.states()];
        element.start(&mut state);
        tell(name, line, &at, &state)
    };
    for connector in model.connectors.values().filter(|c| c.active && fits(&c.name) && !model.holds_pipe(&c.name)) {
        let element = match model.element_in(connector, Some(&around)) {
            Ok(element) => element,
            Err(error) if model.is_dynamic_line(connector) => {
                return Err(SolveError::error_about(&connector.name)(error));
            }
            // what makes no element here reports no nodes; who needs its force says why
            Err(_) => continue,
        };
        report(&connector.name, element.as_ref(), &end_attachments(model, connector))?;
    }
    for assembly in model.assemblies.values().filter(|a| fits(&a.name)) {
        if let Some((element, ends)) = build_pipe_link(model, &around, &RunRequirements::default(), assembly)? {
            report(&assembly.name, element.as_ref(), &ends)?;
        }
    }
    Ok(())
}

/// What is to be known of the dynamic lines where they rest between their ends as they stand: their names with the text.
pub fn static_cautions(model: &Model) -> Vec<(String, &'static str)> {
    let mut made = Vec::new();
    // of others nothing is to be said
    let is_dynamic = |name: &str| model.connectors.get(&Model::key(name)).is_some_and(|c| model.is_dynamic_line(c));
    let reported = visit_lines_at_rest(model, &is_dynamic, |name, line, at, _| {
        made.extend(line.static_caution(at).map(|text| (name.to_string(), text)));
        Ok(())
    });
    // who solves says why a line cannot be made
    reported.map_or_else(|_| Vec::new(), |()| made)
}

/// The dynamic lines and whose names fit, at rest between their ends as they stand: a table each, a row a node.
///
/// # Errors
/// A line that has no answer there.
pub fn lines_at_rest(model: &Model, fits: &dyn Fn(&str) -> bool) -> Result<Vec<Table>, SolveError> {
    let mut tables = Vec::new();
    visit_lines_at_rest(model, fits, |name, line, at, state| {
        let mut nodes = Vec::new();
        line.find_nodes(at, state, &mut nodes).map_err(SolveError::error_about(name))?;
        let sections = sections(model, name);
        let tube = sections.iter().any(|s| s.tube.is_some());
        let rows: Vec<(usize, &LineNode)> = nodes.iter().enumerate().collect();
        let finite = |v: f64| v.is_finite().then_some(v + 0.0);
        let utilisation = |node: &LineNode| {
            let used = node.sides().filter_map(|side| {
                let stress = side.stress.map(|s| s.von_mises);
                Some(sections.get(side.segment)?.utilisation(node.effective, stress))
            });
            used.reduce(f64::max)
        };
        let most_used = nodes.iter().filter_map(|node| Some((utilisation(node)?, node.arc)));
        let most_used = most_used.filter(|(used, _)| used.is_finite()).reduce(|a, b| if b.0 > a.0 { b } else { a });
        let head =
            Table::new("Line at Rest").fact("Line", name, Dim::None).fact("Model", Idealisation::Dynamic, Dim::None);
        let mut table = LineSummary::new(&nodes, &sections, line.has_bending())
            .add_to(head, most_used)
            .with_rows(&rows)
            .column("", "Node", Dim::None, Digits::Usual, |(index, _)| index + 1)
            .column("", "Arc", Dim::Length, Digits::Usual, |(_, node)| finite(node.arc))
            .columns("", ["X", "Y", "Z"], Dim::Length, Digits::Usual, |(_, node)| {
                <[f64; 3]>::from(node.position).map(finite)
            })
            .column("", "Clearance", Dim::Length, CLEARANCE, |(_, node)| finite(node.clearance))
            .column("", "Tension", Dim::Force, Digits::Usual, |(_, node)| finite(node.effective));
        if line.has_bending() {
            let per_length = Dim::Derived { force: 0, length: -1, seconds: 0 };
            table = table
                .column("", "Shear", Dim::Force, Digits::Usual, |(_, node)| node.shear)
                .column("", "Moment", Dim::Moment, Digits::Usual, |(_, node)| node.moment)
                .column("", "Curvature", per_length, Digits::Scientific(4), |(_, node)| node.curvature);
        }
        if tube {
            let names = ["Axial", "Bending", "Hoop", "Von Mises"];
            table = table.column("", "Wall", Dim::Force, Digits::Usual, |(_, node)| node.worse().wall).columns(
                "Stress",
                names,
                Dim::Stress,
                Digits::Usual,
                |(_, node)| {
                    let stress = node.worse().stress;
                    stress.map_or([None; 4], |s| [s.axial, s.bending, s.hoop, s.von_mises].map(Some))
                },
            );
        }
        let mut table =
            table.column("", "Utilisation", Dim::None, Digits::Decimals(3), |(_, node)| utilisation(node)).build();
        table.note(
            "Departure Angle is the largest inclination below the horizontal of what does not lie on the bottom; Layback is the \
             horizontal distance from the higher end to its touchdown point",
        );
        table.note("between its ends where they stand, in the mean current, without waves");
        table.note(if tube {
            "Utilisation is von Mises stress over yield stress of a tube, tension over breaking tension of other sections"
        } else {
            "Utilisation is tension over breaking tension"
        });
        tables.push(table);
        Ok(())
    })?;
    Ok(tables)
}
