//! What sensors read over a run.
//!
//! Source: [MOSES-REF sensor] for the signals. How a signal of several numbers becomes one is known in part: the norm of all, or
//! one of them, which is our reading.

use super::super::system::SolveError;
use super::super::time::Run;
use super::points::{TrackedPoint, water_at};
use super::{EventTable, RunEvent};
use nalgebra::Vector3;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;

/// What is taken of a signal of three numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SignalComponent {
    /// The norm of them all.
    #[default]
    Norm,
    /// One of them, from 0.
    Single(usize),
}

impl SignalComponent {
    fn value(self, numbers: Vector3<f64>) -> f64 {
        match self {
            SignalComponent::Norm => numbers.norm(),
            SignalComponent::Single(which) => numbers.get(which).copied().unwrap_or(f64::NAN),
        }
    }

    /// Its rate by the rates of the numbers.
    fn rate(self, numbers: Vector3<f64>, rates: Vector3<f64>) -> f64 {
        match self {
            SignalComponent::Norm => numbers.dot(&rates) / numbers.norm(),
            SignalComponent::Single(_) => self.value(rates),
        }
    }
}

/// The signal a sensor reads.
#[derive(Clone, Debug, PartialEq)]
pub enum Signal {
    /// The time (s).
    Time,
    /// The place of a point, global (m).
    Point(TrackedPoint),
    /// The place of the second point less that of the first, global (m).
    Vector([TrackedPoint; 2]),
    /// The length of the first segment of a connector, by its number in the run (m).
    Length(usize),
    /// The force of a connector on its first end on a body, by its number in the run (N).
    Force(usize),
    /// Roll, pitch and yaw of a body, by its number in the run (rad).
    Angles(usize),
    /// The least height of points above the water with its waves (m).
    LeastHeight(Vec<TrackedPoint>),
}

/// A sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensor {
    /// Its name as written.
    pub name: String,
    /// What it reads.
    pub signal: Signal,
    /// What it takes of a signal of three numbers.
    pub component: SignalComponent,
    /// Whether it reads the rate of a place instead of the place.
    pub is_rate: bool,
    /// The values outside of which it raises an alarm (SI).
    pub limits: Option<[f64; 2]>,
}

impl Sensor {
    /// The dimension of its reading.
    pub fn dim(&self) -> Dim {
        match &self.signal {
            Signal::Time => Dim::Time,
            Signal::Point(_) | Signal::Vector(_) if self.is_rate => Dim::Velocity,
            Signal::Point(_) | Signal::Vector(_) | Signal::Length(_) | Signal::LeastHeight(_) => Dim::Length,
            Signal::Force(_) => Dim::Force,
            Signal::Angles(_) => Dim::Angle,
        }
    }

    /// Its reading of a stored row, SI; not a number where there is none.
    fn read(&self, run: &Run, row: &[f64]) -> f64 {
        let layout = &run.history.layout;
        let of_place = |numbers: Vector3<f64>, rates: Vector3<f64>| match self.is_rate {
            true => self.component.rate(numbers, rates),
            false => self.component.value(numbers),
        };
        let three = |at: usize| row.get(at..at + 3).map(Vector3::from_column_slice);
        let time = row.first().copied().unwrap_or(f64::NAN);
        match &self.signal {
            Signal::Time => time,
            Signal::Point(point) => {
                let [at, velocity, _] = point.motion(row, layout);
                of_place(at, velocity)
            }
            Signal::Vector([from, to]) => {
                let ([a, v, _], [b, w, _]) = (from.motion(row, layout), to.motion(row, layout));
                of_place(b - a, w - v)
            }
            Signal::Length(link) => layout.links.get(*link).and_then(|l| l.length(row)).unwrap_or(f64::NAN),
            Signal::Force(link) => match self.component {
                SignalComponent::Norm => layout.tension(*link, row).unwrap_or(f64::NAN),
                SignalComponent::Single(_) => {
                    layout.pull(*link).and_then(three).map_or(f64::NAN, |force| self.component.value(force))
                }
            },
            Signal::Angles(body) => {
                three(layout.body(*body) + 3).map_or(f64::NAN, |angles| self.component.value(angles))
            }
            Signal::LeastHeight(points) => {
                let (level, waves) = water_at(run, time);
                let above = |point: &TrackedPoint| {
                    let [at, ..] = point.motion(row, layout);
                    at.z - level - waves(at.x, at.y)
                };
                points.iter().map(above).reduce(f64::min).unwrap_or(f64::NAN)
            }
        }
    }
}

/// Readings of sensors, and whether each raises its alarm: 1 outside of its limits, else 0.
///
/// # Errors
/// Rows that make no table.
pub fn sensors(run: &Run, chosen: &[Sensor], events: &[RunEvent]) -> Result<Table, SolveError> {
    let mut table = EventTable::new("Sensors", (&run.history, events), |row| {
        Ok(chosen.iter().map(|sensor| sensor.read(run, row)).collect::<Vec<f64>>())
    })?;
    for (index, sensor) in chosen.iter().enumerate() {
        let value = |all: &Vec<f64>| all.get(index).copied().unwrap_or(f64::NAN);
        table = table.column(&sensor.name, "Value", sensor.dim(), Digits::Usual, value);
        if let Some([low, high]) = sensor.limits {
            let alarm = |all: &Vec<f64>| f64::from(u8::from(!(low..=high).contains(&value(all))));
            table = table.column(&sensor.name, "Alarm", Dim::None, Digits::Decimals(0), alarm);
        }
    }
    Ok(table.build())
}
