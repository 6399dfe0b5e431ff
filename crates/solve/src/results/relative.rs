//! How points move relative to each other, and how near they come.
//!
//! Source: [MOSES-REF ppo_inte] for the tables; which of two points is taken from the other is ours.

use super::super::system::SolveError;
use super::super::time::Run;
use super::points::TrackedPoint;
use super::{EventTable, Magnitude, RunEvent, group_head};
use nalgebra::Vector3;
use windlass_base::table::Table;
use windlass_base::units::Dim;

/// Location, velocity and acceleration of the first point of each pair less those of the second, global axes.
///
/// # Errors
/// Rows that make no table.
pub fn relative_motions(
    run: &Run,
    pairs: &[[TrackedPoint; 2]],
    magnitude: Magnitude,
    events: &[RunEvent],
) -> Result<Table, SolveError> {
    let layout = &run.history.layout;
    let mut table = EventTable::new("Relative Motions", (&run.history, events), |row| {
        let of_pair = |[first, second]: &[TrackedPoint; 2]| {
            let (a, b) = (first.motion(row, layout), second.motion(row, layout));
            [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
        };
        Ok(pairs.iter().map(of_pair).collect::<Vec<[Vector3<f64>; 3]>>())
    })?;
    for (index, [first, second]) in pairs.iter().enumerate() {
        let name = format!("{} less {}", first.name, second.name);
        if pairs.len() == 1 {
            table = table.fact("Points", name.as_str(), Dim::None);
        }
        let head = |group: &str| group_head(pairs.len() > 1, &name, group);
        let with = |all: &Vec<[Vector3<f64>; 3]>, which: usize| {
            all.get(index).map_or([f64::NAN; 4], |found| magnitude.components_and_magnitude(&found[which]))
        };
        table = table
            .columns(&head("Location"), ["X", "Y", "Z", "Mag."], Dim::Length, |all| with(all, 0))
            .columns(&head("Velocity"), ["VX", "VY", "VZ", "V Mag."], Dim::Velocity, |all| with(all, 1))
            .columns(&head("Acceleration"), ["AX", "AY", "AZ", "A Mag."], Dim::Acceleration, |all| with(all, 2));
    }
    Ok(table.fact("Axes", "global", Dim::None).build())
}

/// The two points of two sets that are nearest to each other at each event: their distance, how it changes, and the vector from
/// the second to the first.
///
/// # Errors
/// Rows that make no table.
pub fn least_distance(
    run: &Run,
    [first, second]: [&[TrackedPoint]; 2],
    magnitude: Magnitude,
    events: &[RunEvent],
) -> Result<Table, SolveError> {
    let layout = &run.history.layout;
    let nearest = |row: &[f64]| {
        let others: Vec<_> = second.iter().map(|point| point.motion(row, layout)).collect();
        let pairs = first.iter().flat_map(|point| {
            let [at, velocity, _] = point.motion(row, layout);
            others.iter().map(move |[other, speed, _]| (at - other, velocity - speed))
        });
        let size = |(apart, _): &(Vector3<f64>, Vector3<f64>)| magnitude.evaluate(apart);
        pairs.map(|pair| (size(&pair), pair)).min_by(|a, b| a.0.total_cmp(&b.0))
    };
    let mut table = EventTable::new("Least Distance", (&run.history, events), |row| {
        let Some((distance, (apart, speed))) = nearest(row) else { return Ok([f64::NAN; 5]) };
        // the rate of a length is the velocity along it, of the components it is made of
        let counted = |v: &Vector3<f64>| Vector3::from_fn(|i, _| if magnitude.0[i] { v[i] } else { 0.0 });
        let rate = if distance > 0.0 { counted(&apart).dot(&counted(&speed)) / distance } else { f64::NAN };
        Ok([distance, rate, apart.x, apart.y, apart.z])
    })?;
    let list = |points: &[TrackedPoint]| points.iter().map(|p| p.name.as_str()).collect::<Vec<_>>().join(" ");
    table = table.fact("From", list(second), Dim::None).fact("To", list(first), Dim::None);
    table = table
        .columns("", ["Distance"], Dim::Length, |found| [found[0]])
        .columns("", ["Rate"], Dim::Velocity, |found| [found[1]])
        .columns("Apart", ["DX", "DY", "DZ"], Dim::Length, |found| [found[2], found[3], found[4]]);
    let mut table = table.build();
    let cells = |name: &str| {
        let column = table.columns().iter().find(|c| c.name == name);
        column.map_or(Vec::new(), |c| c.cells.iter().map(|cell| cell.number().unwrap_or(f64::NAN)).collect())
    };
    let least = cells("Distance").into_iter().zip(cells("Time")).filter(|(d, _)| d.is_finite());
    if let Some((distance, time)) = least.min_by(|a, b| a.0.total_cmp(&b.0)) {
        table = table.fact("Least", distance, Dim::Length).fact("At", time, Dim::Time);
    }
    Ok(table)
}
