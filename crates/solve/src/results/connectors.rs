//! What connectors exert.

use super::super::link::{EndAttachment, end_attachments, pose_of};
use super::super::system::SolveError;
use super::super::time::{LinkColumns, RowLayout, Run};
use super::forces::{add, no_wrench, wrench_columns};
use super::rest_state::{RestSolver, SettledConnector};
use super::{EventTable, Magnitude, RunEvent, group_head};
use nalgebra::{Matrix3, Vector3};
use windlass_base::geometry::Place;
use windlass_base::pose::Pose;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_hydro::Category;
use windlass_model::{ClassError, Model};

/// Least distance of the ends of an element that has axes of its own (m).
const NO_LENGTH_M: f64 = 1e-9;
/// Sine of its angle to the vertical below which an element is upright.
const UPRIGHT_SINE: f64 = 1e-9;

/// The force of a connector by which its pull is reported ([`RowLayout::pull`]), global axes (N); none while the connector does not act.
pub(super) fn force(layout: &RowLayout, link: usize, row: &[f64]) -> Option<Vector3<f64>> {
    let columns = layout.links.get(link)?;
    let acts = row.get(columns.active).is_some_and(|a| *a > 0.0);
    let at = layout.pull(link).filter(|_| acts)?;
    row.get(at..at + 3).map(Vector3::from_column_slice)
}

/// Where the bodies are in a row.
pub(super) fn poses(layout: &RowLayout, row: &[f64], list: &mut Vec<Pose>) {
    list.clear();
    for body in 0..layout.bodies.len() {
        let at = layout.body(body);
        let pose = match row.get(at..at + 6) {
            Some([x, y, z, roll, pitch, yaw]) => {
                Pose::from_place(&Place { shift: [*x, *y, *z], turn: [*roll, *pitch, *yaw] })
            }
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
    events: &[RunEvent],
) -> Result<Table, SolveError> {
    let layout = &run.history.layout;
    let several = links.len() > 1;
    let chosen: Vec<_> =
        links.iter().filter_map(|link| layout.links.get(*link).map(|columns| (*link, columns))).collect();
    let (mut settling, mut remembering) = (Vec::new(), Vec::new());
    for (_, columns) in &chosen {
        let made = RestSolver::new(&run.model, &columns.name)?;
        if made.is_none() {
            remembering.push(columns.name.as_str());
        }
        settling.push(made);
    }
    let mut positions = Vec::new();
    let mut table = EventTable::new("Connector Forces", (&run.history, events), |row| {
        poses(layout, row, &mut positions);
        let mut list = Vec::new();
        for ((link, columns), settling) in chosen.iter().zip(&mut settling) {
            let acting = force(layout, *link, row);
            let length = row.get(columns.active + 1).copied().filter(|l| l.is_finite());
            let rest = match settling {
                Some(settling) if acting.is_some() => {
                    settling.solve_at(&positions, length).map_err(|e| at_time(e, row))?
                }
                _ => SettledConnector::NONE,
            };
            list.push((acting.unwrap_or(Vector3::repeat(f64::NAN)), rest));
        }
        Ok(list)
    })?;
    for (index, (_, columns)) in chosen.iter().enumerate() {
        let name = columns.name.as_str();
        if !several {
            table = table.fact("Connector", name, Dim::None).fact("Model", run.model.idealisation(name), Dim::None);
        }
        let rest = |all: &Vec<(Vector3<f64>, SettledConnector)>| {
            all.get(index).map_or(SettledConnector::NONE, |(_, rest)| *rest)
        };
        let group = group_head(several, name, "Force");
        table = table
            .columns(&group, ["FX", "FY", "FZ", "Mag."], Dim::Force, |all| {
                all.get(index).map_or([f64::NAN; 4], |(force, _)| magnitude.components_and_magnitude(force))
            })
            .column(&group, "Mag./Break", Dim::None, Digits::Decimals(3), |all| rest(all).ratio)
            .columns(&group_head(several, name, "On Bottom"), ["Length"], Dim::Length, |all| [rest(all).grounded])
            .columns(&group_head(several, name, "Anchor"), ["V. Pull", "H. Pull"], Dim::Force, |all| {
                [rest(all).vertical, rest(all).horizontal]
            });
    }
    let mut table = table.build();
    if !remembering.is_empty() {
        table.note(format!(
            "{}: its force does not follow from where its ends are; Mag./Break, bottom and anchor are left out (of a dynamic \
             line ROD reports what is along it)",
            remembering.join(", ")
        ));
    }
    table.note("the force is that on the first end on a body");
    if several {
        table.add_notes(idealisations(run, links));
    }
    table.note(
        "Mag./Break is the largest tension of a segment over its own break; the length on the bottom is unstretched",
    );
    Ok(table)
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
    SolveError { who, error: error.with_subject(format!("at {time} s")) }
}

/// The magnitude of the force of connectors of a run.
///
/// # Errors
/// None of its own.
pub fn magnitudes(run: &Run, links: &[usize], magnitude: Magnitude, events: &[RunEvent]) -> Result<Table, SolveError> {
    let layout = &run.history.layout;
    let mut table = EventTable::new("Magnitude of Connector Forces", (&run.history, events), |row| {
        let size = |link: &usize| force(layout, *link, row).map_or(f64::NAN, |f| magnitude.evaluate(&f));
        Ok(links.iter().map(size).collect::<Vec<f64>>())
    })?;
    for (index, link) in links.iter().enumerate() {
        let Some(columns) = layout.links.get(*link) else { continue };
        table = table.column("Force Magnitude", &columns.name, Dim::Force, Digits::Usual, |sizes| {
            sizes.get(index).copied().unwrap_or(f64::NAN)
        });
    }
    let mut table = table.build();
    table.add_notes(idealisations(run, links));
    Ok(table)
}

/// The sum of the forces of all connectors on bodies of a run, about their origins, global axes.
///
/// # Errors
/// None of its own.
pub fn total_forces(
    run: &Run,
    bodies: &[usize],
    magnitude: Magnitude,
    events: &[RunEvent],
) -> Result<Table, SolveError> {
    let layout = &run.history.layout;
    let several = bodies.len() > 1;
    let mut table = EventTable::new("Total Force of Connectors", (&run.history, events), |row| {
        let of_body = |body: &usize| {
            let mut sum = [Vector3::zeros(); 2];
            for category in [Category::FlexConnectors, Category::RigidConnectors] {
                add(row, layout.category(*body, category), &mut sum);
            }
            sum
        };
        Ok(bodies.iter().map(of_body).collect::<Vec<_>>())
    })?
    .fact("Moments About", "the origins of the bodies", Dim::None);
    for (index, body) in bodies.iter().enumerate() {
        let Some((name, _)) = layout.bodies.get(*body) else { continue };
        if !several {
            table = table.fact("Body", name.as_str(), Dim::None);
        }
        table = wrench_columns(table, &group_head(several, name, "Connectors"), magnitude, |sums| {
            sums.get(index).copied().unwrap_or_else(no_wrench)
        });
    }
    Ok(table.build())
}

/// Axes of an element in columns: x from its first end to the second, y level, z upward across; global axes where it has no length.
fn element_axes(from: &Vector3<f64>, to: &Vector3<f64>) -> Matrix3<f64> {
    let apart = to - from;
    let Some(x) = apart.try_normalize(NO_LENGTH_M) else { return Matrix3::identity() };
    // one that stands upright has its y along that of the globe
    let y = Vector3::z().cross(&x).try_normalize(UPRIGHT_SINE).unwrap_or_else(Vector3::y);
    let y = (y - x * x.dot(&y)).try_normalize(0.0).unwrap_or_else(Vector3::y);
    Matrix3::from_columns(&[x, y, x.cross(&y)])
}

/// The forces and moments of connectors of a run, by their numbers, on their ends: in global axes, and in those of the element.
///
/// # Errors
/// A line that lies on supports, which has no two ends.
pub fn element_forces(run: &Run, links: &[usize], events: &[RunEvent]) -> Result<Table, SolveError> {
    let layout = &run.history.layout;
    let mut chosen = Vec::new();
    for link in links {
        let Some(columns) = layout.links.get(*link) else { continue };
        let Some(connector) = run.model.connectors.get(&Model::key(&columns.name)) else {
            let error = ClassError::new("it lies on supports, and is no element between two ends");
            return Err(SolveError::error_about(&columns.name)(error.help("ROD reports what is along it")));
        };
        chosen.push((*link, columns, end_attachments(&run.model, connector)));
    }
    let (mut positions, several) = (Vec::new(), chosen.len() > 1);
    let mut table = EventTable::new("Forces of Elements", (&run.history, events), |row| {
        poses(layout, row, &mut positions);
        let of = |(link, columns, ends): &(usize, &LinkColumns, [EndAttachment; 2])| {
            let acts = row.get(columns.active).is_some_and(|a| *a > 0.0);
            let [from, to] = [&ends[0], &ends[1]].map(|end| pose_of(end, &positions).origin);
            let axes = element_axes(&from, &to);
            [0, 1].map(|end| {
                let mut wrench = [Vector3::zeros(); 2];
                let at = layout.wrench(*link, end).filter(|_| acts);
                add(row, at, &mut wrench);
                if at.is_none() {
                    wrench = no_wrench();
                }
                [wrench, wrench.map(|v| axes.transpose() * v)]
            })
        };
        Ok(chosen.iter().map(of).collect::<Vec<_>>())
    })?;
    for (index, (link, columns, _)) in chosen.iter().enumerate() {
        if !several {
            table = table.fact("Element", columns.name.as_str(), Dim::None);
        }
        for end in [0, 1].into_iter().filter(|end| layout.wrench(*link, *end).is_some()) {
            for (which, axes) in ["Global", "Element"].into_iter().enumerate() {
                let group = group_head(several, &columns.name, &format!("End {} {axes}", end + 1));
                let own = move |all: &Vec<[[[Vector3<f64>; 2]; 2]; 2]>| {
                    all.get(index).map_or_else(no_wrench, |ends| ends[end][which])
                };
                table = table.columns(&group, ["FX", "FY", "FZ"], Dim::Force, move |all| own(all)[0].into()).columns(
                    &group,
                    ["MX", "MY", "MZ"],
                    Dim::Moment,
                    move |all| own(all)[1].into(),
                );
            }
        }
    }
    let mut table = table.build();
    table.note("forces of the element on what its ends are fixed to, moments about the ends; an end in the ground is not stored");
    table.note("axes of the element: x from its first end to the second, y level, z across them; global ones of an element without length");
    Ok(table)
}
