//! Curves of `&DATA CURVES`: pairs of numbers under a name.

use windlass_base::span::Span;
use windlass_base::units::Dim;

/// What a curve describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurveKind {
    /// Current: depth below the surface (m), velocity (m/s).
    CurrentProfile,
    /// Wave spectrum: period (s), density (m2 s).
    PeriodSpectrum,
    /// Wave spectrum: frequency (rad/s), density (m2 s).
    FrequencySpectrum,
    /// Marine growth: elevation (m), added diameter (m).
    MarineGrowth,
    /// Wind: time (s), speed (m/s).
    WindHistory,
    /// Current (ours): time (s), factor.
    CurrentHistory,
    /// Waves (ours): time (s), elevation (m).
    ElevationHistory,
    /// Load multiplier: time (s), factor.
    LoadMultiplier,
    /// Connector length change: time (s), length (m).
    ConnectorLength,
    /// Efficiency: velocity (m/s), factor.
    Efficiency,
    /// Drag coefficient multiplier: velocity (m/s), factor.
    DragVelocity,
    /// Added-mass pressure: draft or elevation (m), factor.
    AddedMassPressure,
    /// Viscoelastic spring: time (s), stiffness (N/m).
    ConvolutionTime,
    /// Viscoelastic spring: frequency (rad/s), stiffness (N/m).
    ConvolutionFrequency,
}

impl CurveKind {
    /// All kinds with their names in records.
    pub const ALL: &'static [(&'static str, CurveKind)] = &[
        ("C_PROFILE", CurveKind::CurrentProfile),
        ("P_SPECTRUM", CurveKind::PeriodSpectrum),
        ("F_SPECTRUM", CurveKind::FrequencySpectrum),
        ("M_GROWTH", CurveKind::MarineGrowth),
        ("W_HISTORY", CurveKind::WindHistory),
        ("C_HISTORY", CurveKind::CurrentHistory),
        ("S_HISTORY", CurveKind::ElevationHistory),
        ("LT_MULTIPLIER", CurveKind::LoadMultiplier),
        ("CT_LENGTH", CurveKind::ConnectorLength),
        ("EFFICIENCY", CurveKind::Efficiency),
        ("CS_VELOCITY", CurveKind::DragVelocity),
        ("AM_PRESSURE", CurveKind::AddedMassPressure),
        ("CONVOLUTION TIME", CurveKind::ConvolutionTime),
        ("CONVOLUTION FREQUENCY", CurveKind::ConvolutionFrequency),
    ];

    /// Its name in records.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, kind)| *kind == self).map_or("", |(name, _)| name)
    }

    /// What the two columns are called, and what they measure.
    pub const fn axes(self) -> [(&'static str, Dim); 2] {
        match self {
            CurveKind::CurrentProfile => [("Depth", Dim::Length), ("Velocity", Dim::Velocity)],
            CurveKind::PeriodSpectrum => [("Period", Dim::Time), ("Density", Dim::SpectralDensity)],
            CurveKind::FrequencySpectrum => [("Frequency", Dim::Frequency), ("Density", Dim::SpectralDensity)],
            CurveKind::MarineGrowth => [("Elevation", Dim::Length), ("Added OD", Dim::Section)],
            CurveKind::WindHistory => [("Time", Dim::Time), ("Speed", Dim::WindSpeed)],
            CurveKind::CurrentHistory | CurveKind::LoadMultiplier => [("Time", Dim::Time), ("Factor", Dim::None)],
            CurveKind::ElevationHistory => [("Time", Dim::Time), ("Elevation", Dim::Length)],
            CurveKind::ConnectorLength => [("Time", Dim::Time), ("Length", Dim::Length)],
            CurveKind::Efficiency | CurveKind::DragVelocity => [("Velocity", Dim::Velocity), ("Factor", Dim::None)],
            CurveKind::AddedMassPressure => [("Elevation", Dim::Length), ("Factor", Dim::None)],
            CurveKind::ConvolutionTime => [("Time", Dim::Time), ("Stiffness", Dim::ForcePerLength)],
            CurveKind::ConvolutionFrequency => [("Frequency", Dim::Frequency), ("Stiffness", Dim::ForcePerLength)],
        }
    }
}

/// A curve: points in the order of a growing first value.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Its name as written.
    pub name: String,
    /// What it describes.
    pub kind: CurveKind,
    /// Pairs in SI.
    pub points: Vec<(f64, f64)>,
    /// Exponentials that stand for a convolution curve in the time domain (`-NDOF`).
    pub exponentials: usize,
    /// Metres in the unit of length it was given in: a stiffness per length of a curve that acts in a rotation is a moment
    /// per radian in the same units.
    pub metres: f64,
    /// Where it was defined.
    pub span: Span,
}

impl Curve {
    /// Its value at an argument, each in the curve's own unit: straight between its points, and that of the first or the last beyond them.
    pub fn value_at(&self, at: f64) -> f64 {
        let after = self.points.partition_point(|(x, _)| *x <= at);
        match (after.checked_sub(1).and_then(|n| self.points.get(n)), self.points.get(after)) {
            (Some((a, from)), Some((b, to))) => from + (to - from) * (at - a) / (b - a),
            (Some((_, value)), None) | (None, Some((_, value))) => *value,
            (None, None) => 0.0,
        }
    }

    /// The integral of that between two arguments, the second not below the first.
    pub fn integral(&self, from: f64, to: f64) -> f64 {
        let inner = self.points.iter().map(|(x, _)| *x).filter(|x| *x > from && *x < to);
        let mut sum = 0.0;
        let mut start = from;
        for end in inner.chain(std::iter::once(to)) {
            sum += 0.5 * (self.value_at(start) + self.value_at(end)) * (end - start);
            start = end;
        }
        sum
    }

    /// The long-term stiffness of a convolution curve (N/m): that of the last time, or of the lowest frequency; `None`
    /// for other curves.
    pub fn long_term_stiffness(&self) -> Option<f64> {
        match self.kind {
            CurveKind::ConvolutionTime => self.points.last().map(|p| p.1),
            CurveKind::ConvolutionFrequency => self.points.first().map(|p| p.1),
            _ => None,
        }
    }
}
