//! Units: what a number measures ([`Dim`]) and the system the user speaks ([`UnitSystem`]).
//!
//! Inside the program everything is SI (m, kg, s, N, rad, K). A number is converted once where a command reads it and
//! once where a report writes it; both go through [`Dim::factor`].
//!
//! Source: [W-UNITS]; [MOSES-REF dfl].

use std::fmt;

/// The smallest size but zero that is taken as input, in SI of any dimension: its fourth power stays a number.
pub const MIN_INPUT_MAGNITUDE: f64 = 1e-36;

/// Why a number of a record cannot be reckoned with.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SizeError {
    /// Smaller than [`MIN_INPUT_MAGNITUDE`] in SI, and not zero.
    #[error("smaller than {MIN_INPUT_MAGNITUDE:e}, which is zero here: write 0")]
    TooSmall,
    /// Larger than [`Dim::most`].
    #[error("{}", largest_size(*dim, *units))]
    TooLarge {
        /// What it measures.
        dim: Dim,
        /// The units it was given in.
        units: UnitSystem,
    },
}

impl SizeError {
    /// `small` or `large`.
    pub fn size(self) -> &'static str {
        match self {
            SizeError::TooSmall => "small",
            SizeError::TooLarge { .. } => "large",
        }
    }
}

fn largest_size(dim: Dim, units: UnitSystem) -> String {
    let most = dim.from_si(dim.most(), units);
    format!("the largest size taken is {} {}", eight_figures(most), dim.label(units)).trim_end().to_string()
}
/// One international foot (m).
pub const METRES_PER_FOOT: f64 = 0.3048;
/// One inch (m).
pub const METRES_PER_INCH: f64 = 0.0254;
/// One pound-force (N).
pub const POUND_FORCE: f64 = 4.448_221_615_260_5;
/// One kip (N).
pub const NEWTONS_PER_KIP: f64 = 1000.0 * POUND_FORCE;
/// One metric ton-force (N).
pub const METRIC_TON_FORCE: f64 = 9806.65;
/// One international knot (m/s).
pub const METRES_PER_SECOND_PER_KNOT: f64 = 1852.0 / 3600.0;
/// Standard gravity (m/s2); converts a mass density to a weight density.
pub const STANDARD_GRAVITY: f64 = 9.80665;

/// The user's long length unit; it fixes the short one (inches with feet, millimetres with metres).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LengthUnit {
    /// Feet, with inches for sections.
    Feet,
    /// Metres, with millimetres for sections.
    Meters,
}

/// The user's force unit (`bforce` of the MOSES manuals).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ForceUnit {
    /// 1000 pounds-force.
    Kips,
    /// Long tons-force, 2240 lbf.
    LongTons,
    /// Short tons-force, 2000 lbf.
    ShortTons,
    /// Kilonewtons.
    Kilonewtons,
    /// Metric tons-force.
    MetricTons,
    /// Newtons (ours).
    Newtons,
}

/// The pair of units a user has chosen with `&DIMEN`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnitSystem {
    /// Long length unit.
    pub length: LengthUnit,
    /// Force unit.
    pub force: ForceUnit,
}

impl Default for UnitSystem {
    /// Feet and kips, as MOSES.
    fn default() -> Self {
        UnitSystem { length: LengthUnit::Feet, force: ForceUnit::Kips }
    }
}

impl UnitSystem {
    /// SI with plain newtons: what engines use, and what tests compare in.
    pub const SI: UnitSystem = UnitSystem { length: LengthUnit::Meters, force: ForceUnit::Newtons };

    /// The two words `&DIMEN -DIMEN` takes for this system.
    pub fn words(self) -> (&'static str, &'static str) {
        let length = match self.length {
            LengthUnit::Feet => "FEET",
            LengthUnit::Meters => "METERS",
        };
        let force = match self.force {
            ForceUnit::Kips => "KIPS",
            ForceUnit::LongTons => "L-TONS",
            ForceUnit::ShortTons => "S-TONS",
            ForceUnit::Kilonewtons => "K-NTS",
            ForceUnit::MetricTons => "M-TONS",
            ForceUnit::Newtons => "N",
        };
        (length, force)
    }

    /// Metres in one long length unit.
    pub fn metres(self) -> f64 {
        match self.length {
            LengthUnit::Feet => METRES_PER_FOOT,
            LengthUnit::Meters => 1.0,
        }
    }

    /// Newtons in one force unit.
    pub fn newtons(self) -> f64 {
        match self.force {
            ForceUnit::Kips => NEWTONS_PER_KIP,
            ForceUnit::LongTons => 2240.0 * POUND_FORCE,
            ForceUnit::ShortTons => 2000.0 * POUND_FORCE,
            ForceUnit::Kilonewtons => 1000.0,
            ForceUnit::MetricTons => METRIC_TON_FORCE,
            ForceUnit::Newtons => 1.0,
        }
    }
}

/// The sentence every report carries, e.g. `Degrees, Feet, and Kips`.
impl fmt::Display for UnitSystem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let length = match self.length {
            LengthUnit::Feet => "Feet",
            LengthUnit::Meters => "Meters",
        };
        let force = match self.force {
            ForceUnit::Kips => "Kips",
            ForceUnit::LongTons => "Long Tons",
            ForceUnit::ShortTons => "Short Tons",
            ForceUnit::Kilonewtons => "Kilonewtons",
            ForceUnit::MetricTons => "Metric Tons",
            ForceUnit::Newtons => "Newtons",
        };
        write!(f, "Degrees, {length}, and {force}")
    }
}

/// What a number measures. The user's unit of each depends on the [`UnitSystem`]; the SI unit is in the comment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Dim {
    /// A ratio, a count, an exponent: no unit.
    None,
    /// Geometry (m).
    Length,
    /// Section sizes and piston strokes, inches or mm (m).
    Section,
    /// Areas of sections, in2 or mm2 (m2).
    SectionArea,
    /// Force, `bforce` (N).
    Force,
    /// Weight per length, line or spring stiffness, `bforce/blength` (N/m).
    ForcePerLength,
    /// Moment, `bforce-blength` (N m).
    Moment,
    /// Rotational stiffness, `bforce-blength/radian` (N m/rad).
    MomentPerRadian,
    /// Stress and moduli, ksi or MPa (Pa).
    Stress,
    /// Mass density of a material or of water, lb/ft3 or kg/m3 (kg/m3).
    Density,
    /// Angle, degrees (rad).
    Angle,
    /// Time, seconds (s).
    Time,
    /// Days (s).
    Days,
    /// Velocity, ft/s or m/s (m/s).
    Velocity,
    /// Rotation, deg/s (rad/s).
    AngularVelocity,
    /// Change of a rotation, deg/s2 (rad/s2).
    AngularAcceleration,
    /// Wind speed, knots (m/s).
    WindSpeed,
    /// Acceleration, ft/s2 or m/s2 (m/s2).
    Acceleration,
    /// Thermal expansion, 1/F with feet and 1/C with metres (1/K).
    ThermalExpansion,
    /// Change of temperature, degrees F with feet and C with metres (K); no temperature from a zero.
    TemperatureRise,
    /// Frequency, rad/s (rad/s).
    Frequency,
    /// Area, ft2 or m2 (m2).
    Area,
    /// Volume, ft3 or m3 (m3).
    Volume,
    /// Spectral density of elevation, ft2 s or m2 s (m2 s).
    SpectralDensity,
    /// Spectral density of an angle, deg2 s (rad2 s).
    AngleDensity,
    /// Nonlinear dashpot coefficient, `bforce (s/blength)**Ex` (N (s/m)**Ex); the exponent is carried.
    Damping(f64),
    /// `bforce`, `blength` and seconds to whole powers (N, m and s to the same): coefficients and matrices.
    Derived {
        /// Power of force.
        force: i8,
        /// Power of length.
        length: i8,
        /// Power of seconds.
        seconds: i8,
    },
    /// Mass, kg in every system (AQWA items).
    Mass,
    /// Mass per length, kg/m in every system (AQWA items).
    MassPerLength,
    /// Area, m2 in every system (AQWA items).
    SquareMetres,
    /// Length, m in every system (AQWA items).
    Metres,
    /// Force, N in every system (AQWA items).
    Newtons,
    /// Bending stiffness, N m2 in every system (AQWA items).
    NewtonSquareMetres,
    /// Stress, Pa in every system (AQWA items).
    Pascals,
    /// Mass density, kg/m3 in every system (AQWA items).
    KilogramsPerCubicMetre,
    /// In SI whatever the user's units are: what [`Dim::in_si`] makes of dimensions with units of their own, with the unit.
    InSi(&'static str),
}

impl Dim {
    /// SI value of one user unit of this dimension.
    pub fn factor(self, units: UnitSystem) -> f64 {
        let (m, n) = (units.metres(), units.newtons());
        let feet = units.length == LengthUnit::Feet;
        match self {
            Dim::Length => m,
            Dim::Section => {
                if feet {
                    METRES_PER_INCH
                } else {
                    1e-3
                }
            }
            Dim::Force => n,
            Dim::ForcePerLength => n / m,
            Dim::Moment | Dim::MomentPerRadian => n * m,
            Dim::Stress => {
                if feet {
                    NEWTONS_PER_KIP / (METRES_PER_INCH * METRES_PER_INCH)
                } else {
                    1e6
                }
            }
            Dim::Density => {
                if feet {
                    POUND_FORCE / STANDARD_GRAVITY / (METRES_PER_FOOT * METRES_PER_FOOT * METRES_PER_FOOT)
                } else {
                    1.0
                }
            }
            Dim::Angle | Dim::AngularVelocity | Dim::AngularAcceleration => std::f64::consts::PI / 180.0,
            Dim::AngleDensity => (std::f64::consts::PI / 180.0).powi(2),
            Dim::Days => 86_400.0,
            Dim::Velocity | Dim::Acceleration => m,
            Dim::WindSpeed => METRES_PER_SECOND_PER_KNOT,
            Dim::ThermalExpansion => {
                if feet {
                    1.8
                } else {
                    1.0
                }
            }
            Dim::TemperatureRise => {
                if feet {
                    1.0 / 1.8
                } else {
                    1.0
                }
            }
            Dim::SectionArea => {
                let length = if feet { METRES_PER_INCH } else { 1e-3 };
                length * length
            }
            Dim::Area | Dim::SpectralDensity => m * m,
            Dim::Volume => m * m * m,
            Dim::Damping(exponent) => n / m.powf(exponent),
            Dim::Derived { force, length, .. } => n.powi(force.into()) * m.powi(length.into()),
            Dim::None
            | Dim::Time
            | Dim::Frequency
            | Dim::Mass
            | Dim::MassPerLength
            | Dim::SquareMetres
            | Dim::Metres
            | Dim::Newtons
            | Dim::NewtonSquareMetres
            | Dim::Pascals
            | Dim::KilogramsPerCubicMetre
            | Dim::InSi(_) => 1.0,
        }
    }

    /// The largest size that is taken as input (SI). No ship, sea or line comes near it, and what an engine makes of it, its fourth power
    /// among others, stays a number.
    pub fn most(self) -> f64 {
        match self {
            Dim::Length | Dim::Section | Dim::Metres => 1e9,
            Dim::Angle | Dim::AngularVelocity | Dim::AngularAcceleration => 1e6,
            Dim::Velocity | Dim::WindSpeed | Dim::Acceleration => 1e6,
            Dim::Frequency | Dim::ThermalExpansion | Dim::TemperatureRise => 1e6,
            Dim::Density | Dim::KilogramsPerCubicMetre => 1e9,
            Dim::Time | Dim::Days => 1e12,
            Dim::Area | Dim::SectionArea | Dim::SquareMetres => 1e18,
            Dim::Volume => 1e27,
            Dim::None
            | Dim::Force
            | Dim::ForcePerLength
            | Dim::Moment
            | Dim::MomentPerRadian
            | Dim::Stress
            | Dim::SpectralDensity
            | Dim::AngleDensity
            | Dim::Damping(_)
            | Dim::Derived { .. }
            | Dim::Mass
            | Dim::MassPerLength
            | Dim::Newtons
            | Dim::NewtonSquareMetres
            | Dim::Pascals
            | Dim::InSi(_) => 1e36,
        }
    }

    /// The number in SI, where it is one that can be reckoned with: zero, or of a size between [`MIN_INPUT_MAGNITUDE`] and [`Dim::most`].
    ///
    /// # Errors
    /// A size beyond these.
    pub fn checked_si(self, value: f64, units: UnitSystem) -> Result<f64, SizeError> {
        let si = self.to_si(value, units);
        if si != 0.0 && si.abs() < MIN_INPUT_MAGNITUDE {
            return Err(SizeError::TooSmall);
        }
        if si.abs() <= self.most() {
            return Ok(si);
        }
        Err(SizeError::TooLarge { dim: self, units })
    }

    /// SI value of `value` user units.
    pub fn to_si(self, value: f64, units: UnitSystem) -> f64 {
        value * self.factor(units)
    }

    /// User units in `value` SI units.
    pub fn from_si(self, value: f64, units: UnitSystem) -> f64 {
        value / self.factor(units)
    }

    /// The dimension whose numbers in [`UnitSystem::SI`] are those of SI: degrees, knots, days, millimetres and megapascals are replaced.
    pub fn in_si(self) -> Dim {
        match self {
            Dim::Angle => Dim::InSi("rad"),
            Dim::AngularVelocity => Dim::InSi("rad/s"),
            Dim::AngularAcceleration => Dim::InSi("rad/s2"),
            Dim::AngleDensity => Dim::InSi("rad2-s"),
            Dim::WindSpeed => Dim::InSi("m/s"),
            Dim::Days => Dim::InSi("s"),
            Dim::ThermalExpansion => Dim::InSi("1/K"),
            Dim::TemperatureRise => Dim::InSi("K"),
            Dim::Section => Dim::Metres,
            Dim::SectionArea => Dim::SquareMetres,
            Dim::Stress => Dim::Pascals,
            other => other,
        }
    }

    /// The user unit as printed in a column head or an axis label; empty for a plain number.
    pub fn label(self, units: UnitSystem) -> String {
        let feet = units.length == LengthUnit::Feet;
        let length = if feet { "ft" } else { "m" };
        let force = match units.force {
            ForceUnit::Kips => "kips",
            ForceUnit::LongTons => "l-tons",
            ForceUnit::ShortTons => "s-tons",
            ForceUnit::Kilonewtons => "kN",
            ForceUnit::MetricTons => "m-tons",
            ForceUnit::Newtons => "N",
        };
        match self {
            Dim::None => String::new(),
            Dim::Length => length.into(),
            Dim::Section => if feet { "in" } else { "mm" }.into(),
            Dim::SectionArea => if feet { "in2" } else { "mm2" }.into(),
            Dim::Force => force.into(),
            Dim::ForcePerLength => format!("{force}/{length}"),
            Dim::Moment => format!("{force}-{length}"),
            Dim::MomentPerRadian => format!("{force}-{length}/rad"),
            Dim::Stress => if feet { "ksi" } else { "MPa" }.into(),
            Dim::Density => if feet { "lb/ft3" } else { "kg/m3" }.into(),
            Dim::Angle => "deg".into(),
            Dim::AngularVelocity => "deg/s".into(),
            Dim::AngularAcceleration => "deg/s2".into(),
            Dim::Time => "s".into(),
            Dim::Days => "days".into(),
            Dim::Velocity => format!("{length}/s"),
            Dim::WindSpeed => "knots".into(),
            Dim::Acceleration => format!("{length}/s2"),
            Dim::ThermalExpansion => if feet { "1/F" } else { "1/C" }.into(),
            Dim::TemperatureRise => if feet { "F" } else { "C" }.into(),
            Dim::Frequency => "rad/s".into(),
            Dim::Area => format!("{length}2"),
            Dim::Volume => format!("{length}3"),
            Dim::SpectralDensity => format!("{length}2-s"),
            Dim::AngleDensity => "deg2-s".into(),
            Dim::Damping(exponent) => format!("{force}-(s/{length})**{exponent}"),
            Dim::Derived { force: f, length: l, seconds: s } => derived_unit([(force, f), (length, l), ("s", s)]),
            Dim::Mass => "kg".into(),
            Dim::MassPerLength => "kg/m".into(),
            Dim::SquareMetres => "m2".into(),
            Dim::Metres => "m".into(),
            Dim::Newtons => "N".into(),
            Dim::NewtonSquareMetres => "N-m2".into(),
            Dim::Pascals => "Pa".into(),
            Dim::KilogramsPerCubicMetre => "kg/m3".into(),
            Dim::InSi(unit) => unit.into(),
        }
    }
}

/// Units to powers, as `kips-s2/ft2`.
fn derived_unit(units: [(&str, i8); 3]) -> String {
    let of = |sign: i8| {
        let some = units.iter().filter(|(_, power)| power.signum() == sign);
        let text = some.map(|(unit, power)| match power.abs() {
            1 => (*unit).to_string(),
            n => format!("{unit}{n}"),
        });
        text.collect::<Vec<_>>().join("-")
    };
    let (over, under) = (of(1), of(-1));
    match (over.is_empty(), under.is_empty()) {
        (_, true) => over,
        (true, _) => format!("1/{under}"),
        _ => format!("{over}/{under}"),
    }
}

/// A number with at most eight significant figures and no more digits than it needs.
pub fn eight_figures(value: f64) -> String {
    // adding zero turns -0 into 0
    let rounded: f64 = format!("{value:.7e}").parse().unwrap_or(value) + 0.0;
    if rounded != 0.0 && !(1e-5..1e15).contains(&rounded.abs()) { format!("{rounded:E}") } else { format!("{rounded}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn feet_and_kips_convert_as_reference_model_states() {
        let us = UnitSystem::default();
        assert_eq!(Dim::Force.to_si(1.0, us), 4448.2216152605);
        assert_eq!(Dim::Length.to_si(1.0, us), 0.3048);
        // 29,000 ksi is 199.948 GPa (NIST SP 811, ksi to Pa)
        assert!((Dim::Stress.to_si(29_000.0, us) - 1.999_479_615e11).abs() < 1e5);
        // sea water 1025 kg/m3 is 63.99 lb/ft3
        assert!((Dim::Density.from_si(1025.0, us) - 63.989).abs() < 1e-3);
    }

    #[test]
    fn derived_units_are_products_of_powers() {
        let us = UnitSystem::default();
        let dim = Dim::Derived { force: 1, length: -2, seconds: 2 };
        assert_eq!(dim.to_si(1.0, us), NEWTONS_PER_KIP / (METRES_PER_FOOT * METRES_PER_FOOT));
        assert_eq!(dim.label(us), "kips-s2/ft2");
        assert_eq!(Dim::Derived { force: 0, length: -1, seconds: -2 }.label(us), "1/ft-s2");
    }

    #[test]
    fn expansion_coefficient_is_same_in_fahrenheit_and_celsius() {
        // steel, 6.5e-6 per F over 90 F, is 11.7e-6 per C over 50 C
        let (us, si) = (UnitSystem::default(), UnitSystem::SI);
        let strain =
            |a: f64, rise: f64, units| Dim::ThermalExpansion.to_si(a, units) * Dim::TemperatureRise.to_si(rise, units);
        assert!((strain(6.5e-6, 90.0, us) - strain(11.7e-6, 50.0, si)).abs() < 1e-18);
    }

    #[test]
    fn conversion_to_si_and_back_returns_number() {
        for force in [ForceUnit::LongTons, ForceUnit::MetricTons, ForceUnit::Newtons] {
            let units = UnitSystem { length: LengthUnit::Meters, force };
            for dim in [Dim::Section, Dim::Damping(1.5), Dim::MomentPerRadian, Dim::Angle, Dim::Days] {
                assert!((dim.from_si(dim.to_si(12.5, units), units) - 12.5).abs() < 1e-12);
            }
        }
    }
}
