//! Sensors of `&DESCRIBE SENSOR`: what they read of a run, as the record names it.

use windlass_base::span::Span;

/// The signal of a sensor [MOSES-REF sensor].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SensorSignal {
    /// The time.
    Time,
    /// The place of a point.
    Point,
    /// The vector from a point to another.
    Vector,
    /// The length of a connector.
    Length,
    /// The force of a connector.
    Force,
    /// The least height of the holes of a body above the water: of watertight ones.
    WatertightHeight,
    /// The same of holes that let water in.
    DownFloodingHeight,
    /// Roll, pitch and yaw of a body.
    Angles,
}

/// A sensor. Its sources are names, looked up when it is reported.
#[derive(Clone, Debug, PartialEq)]
pub struct SensorRecord {
    /// Its name as written.
    pub name: String,
    /// What it reads.
    pub signal: SensorSignal,
    /// The point, the two points, the connector or the body it reads; none of time.
    pub sources: Vec<String>,
    /// Which number of a signal of three it takes, from 0; none: their norm.
    pub component: Option<usize>,
    /// Whether it reads the rate of a place instead of the place.
    pub is_rate: bool,
    /// The values outside of which it raises an alarm (SI).
    pub limits: Option<[f64; 2]>,
    /// Whether it is on: one that is off is not reported.
    pub is_on: bool,
    /// Where it was described.
    pub span: Span,
}
