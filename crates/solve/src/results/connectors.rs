//! What connectors exert.

use super::super::system::SolveError;
use super::super::time::{Layout, Run};
use super::forces::{add, wrench_columns};
use super::settled::{Rest, Settling};
use super::{Event, Magnitude, columns, filled, headed, timed};
use nalgebra::Vector3;
use windlass_base::geometry::Place;
use windlass_base::pose::Pose;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_hydro::Category;
use windlass_model::ClassError;

/// The force of a connector by which its pull is told ([`Layout::pull`]), global axes (N); none while the connector does not act.
pub(super) fn force(layout: &Layout, link: usize, row: &[f64]) -> Option<Vector3<f64>> {
    let columns = layout.links.get(link)?;
    let acts = row.get(columns.active).is_some_and(|a| *a > 0.0);
    let at = layout.pull(link).filter(|_| acts)?;
    row.get(at..at + 3).map(Vector3::from_column_slice)
}

/// Where the bodies are in a row.
pub(super) fn poses(layout: &Layout, row: &[f64], list: &mut Vec<Pose>) {
    list.clear();
    for body in 0..layout.bodies.len() {
        let at = layout.body(body);
        let pose = match row.get(at..at + 6) {
            Some([x, y, z, roll, pitch, yaw]) => Pose::of(&Place { shift: [*x, *y, *z], turn: [*roll, *pitch, *yaw] }),
            _ => Pose::default(),
        };
        list.push(pose);
    }
}

/// The forces of connectors of a run, by their numbers: on the first end on a body, its magnitude and the largest share of a
/// break, the length on the bottom, and what an anchor in the ground bears. A connector without an answer for the last four has none
/// there, and so have all while they do not act.
///
/// # Errors
/// A connector that has no answer where the run had its ends.
pub fn connector_forces(
    run: &Run,
    links: &[usize],
    magnitude: Magnitude,
    events: &[Event],
) -> Result<Table, SolveError> {
    let layout = &run.history.layout;
    let several = links.len() > 1;
    let mut table = timed("Connector Forces");
    let (mut settling, mut remembering) = (Vec::new(), Vec::new());
    for columns_of in links.iter().filter_map(|l| layout.links.get(*l)) {
        let name = columns_of.name.as_str();
        if !several {
            table = table.fact("Connector", name, Dim::None).fact("Model", run.model.idealisation(name), Dim::None);
        }
        let group = headed(several, name, "Force");
        table = columns(table, &group, &["FX", "FY", "FZ", "Mag."], Dim::Force).column(
            &group,
            "Mag./Break",
            Dim::None,
            Digits::Decimals(3),
        );
        table = columns(table, &headed(several, name, "On Bottom"), &["Length"], Dim::Length);
        table = columns(table, &headed(several, name, "Anchor"), &["V. Pull", "H. Pull"], Dim::Force);
        let made = Settling::of(&run.model, name)?;
        if made.is_none() {
            remembering.push(name);
        }
        settling.push(made);
    }
    if !remembering.is_empty() {
        table.note(format!(
            "{}: its force does not follow from where its ends are; Mag./Break, bottom and anchor are left out (of a line that moves by \
             itself ROD tells what is along it)",
            remembering.join(", ")
        ));
    }
    table.note("the force is that on the first end on a body");
    if several {
        table.notes.extend(idealisations(run, links));
    }
    table.note(
        "Mag./Break is the largest tension of a segment over its own break; the length on the bottom is unstretched",
    );
    let mut places = Vec::new();
    filled((&run.history, events), table, &mut |row, made| {
        poses(layout, row, &mut places);
        for (link, settling) in links.iter().zip(&mut settling) {
            let Some(columns_of) = layout.links.get(*link) else { continue };
            let acting = force(layout, *link, row);
            magnitude.push(&acting.unwrap_or(Vector3::repeat(f64::NAN)), made);
            let length = row.get(columns_of.active + 1).copied().filter(|l| l.is_finite());
            let rest = match settling {
                Some(settling) if acting.is_some() => settling.at(&places, length).map_err(|e| at_time(e, row))?,
                _ => Rest::NONE,
            };
            made.extend([rest.ratio, rest.grounded, rest.vertical, rest.horizontal]);
        }
        Ok(())
    })
}

/// How connectors of a run, by their numbers, are idealised.
fn idealisations(run: &Run, links: &[usize]) -> Option<String> {
    let layout = &run.history.layout;
    run.model.idealisations(links.iter().filter_map(|link| layout.links.get(*link)).map(|link| link.name.as_str()))
}

/// An error of an instant, with its time.
fn at_time(error: SolveError, row: &[f64]) -> SolveError {
    let time = row.first().copied().unwrap_or(0.0);
    let SolveError { who, error } = error;
    SolveError { who, error: ClassError { message: format!("at {time} s: {}", error.message), ..error } }
}

/// The magnitude of the force of connectors of a run.
///
/// # Errors
/// None of its own.
pub fn magnitudes(run: &Run, links: &[usize], magnitude: Magnitude, events: &[Event]) -> Result<Table, SolveError> {
    let layout = &run.history.layout;
    let names: Vec<&str> = links.iter().filter_map(|l| layout.links.get(*l)).map(|l| l.name.as_str()).collect();
    let mut table = columns(timed("Magnitude of Connector Forces"), "Force Magnitude", &names, Dim::Force);
    table.notes.extend(idealisations(run, links));
    filled((&run.history, events), table, &mut |row, made| {
        made.extend(links.iter().map(|link| force(layout, *link, row).map_or(f64::NAN, |f| magnitude.of(&f))));
        Ok(())
    })
}

/// The sum of the forces of all connectors on bodies of a run, about their origins, global axes.
///
/// # Errors
/// None of its own.
pub fn total_forces(run: &Run, bodies: &[usize], magnitude: Magnitude, events: &[Event]) -> Result<Table, SolveError> {
    let layout = &run.history.layout;
    let several = bodies.len() > 1;
    let mut table = timed("Total Force of Connectors").fact("Moments About", "the origins of the bodies", Dim::None);
    for (name, _) in bodies.iter().filter_map(|b| layout.bodies.get(*b)) {
        if !several {
            table = table.fact("Body", name.as_str(), Dim::None);
        }
        table = wrench_columns(table, &headed(several, name, "Connectors"));
    }
    filled((&run.history, events), table, &mut |row, made| {
        for body in bodies {
            let mut sum = [Vector3::zeros(); 2];
            for category in [Category::FlexConnectors, Category::RigidConnectors] {
                add(row, layout.category(*body, category), &mut sum);
            }
            sum.iter().for_each(|v| magnitude.push(v, made));
        }
        Ok(())
    })
}

/// The length of the first segment of connectors of a run, which a winch changes. One without a length has none.
///
/// # Errors
/// None of its own.
pub fn lengths(run: &Run, links: &[usize], events: &[Event]) -> Result<Table, SolveError> {
    let layout = &run.history.layout;
    let chosen: Vec<_> = links.iter().filter_map(|l| layout.links.get(*l)).collect();
    let names: Vec<&str> = chosen.iter().map(|l| l.name.as_str()).collect();
    let mut table = columns(timed("Lengths of Connectors"), "First Segment", &names, Dim::Length);
    table.note("unstretched; of a connector while it acts");
    filled((&run.history, events), table, &mut |row, made| {
        for link in &chosen {
            let acts = row.get(link.active).is_some_and(|a| *a > 0.0);
            made.push(row.get(link.active + 1).copied().filter(|_| acts).unwrap_or(f64::NAN));
        }
        Ok(())
    })
}
