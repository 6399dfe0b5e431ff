//! Mean wind over the height above the water.
//!
//! The speed of `&ENV -WIND` is the mean over the averaging time of its formula, 10 m above the water. `-W_PROFILE` gives
//! the growth with height; `-W_DESIGN` turns the mean into that of another averaging time. The formulas and their
//! constants are written from memory of the standards named, but for that of ISO, which was compared with a published
//! program (ckunte.net/2016/wind).

use nalgebra::Vector3;
use windlass_base::choice::Choice;
use windlass_base::units::Dim;
use windlass_model::{ClassError, Environment, WindCode, WindLaw};

/// Height at which the wind of `&ENV` blows (m).
pub const REFERENCE_HEIGHT_M: f64 = 10.0;
/// Below this height (m) the wind is that of this height: the formulas do not hold among the waves.
pub const MIN_WIND_HEIGHT_M: f64 = 1.0;

/// Height of the surface layer of [API-RP-2A] (m).
const SURFACE_LAYER: f64 = 20.0;

/// How the mean wind grows with height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WindProfile {
    /// `(z/10)^exponent`.
    Power(f64),
    /// `ln(z/z0) / ln(10/z0)` with this roughness (m).
    Logarithmic(f64),
    /// `1 + C ln(z/10)` with this C.
    Logarithm(f64),
    /// ABS: the square root of the height coefficient of pressure.
    Abs,
}

/// How the mean over another time follows from the mean over the time of the formula.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Gust {
    None,
    /// API: `1 + g I(z)`, with this g.
    Api(f64),
    /// ISO and NPD: `1 - 0.41 Iu(z) ln(t/3600)`, with 0.06 (1 + 0.043 U), and the logarithm.
    Froya(f64, f64),
    /// DNV: `1 - 0.047 ln(t/600) / (1 + 0.137 ln(z/10))`, with the logarithm.
    Dnv(f64),
}

/// Middle of each band of height of the ABS rules (m) and its coefficient of pressure.
///
/// Source: [ABS-MODU], height coefficients (bands of 50 ft; the same as 46 CFR 174.055, Table (a)).
const ABS_BANDS: [(f64, f64); 18] = [
    (7.62, 1.00),
    (22.86, 1.10),
    (38.10, 1.20),
    (53.34, 1.30),
    (68.58, 1.37),
    (83.82, 1.43),
    (99.06, 1.48),
    (114.30, 1.52),
    (129.54, 1.56),
    (144.78, 1.60),
    (160.02, 1.63),
    (175.26, 1.67),
    (190.50, 1.70),
    (205.74, 1.72),
    (220.98, 1.75),
    (236.22, 1.77),
    (251.46, 1.79),
    (266.70, 1.80),
];

/// The wind of an environment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WindField {
    /// Mean speed 10 m above the water, over the averaging time of the formula (m/s).
    pub speed: f64,
    /// Horizontal direction it blows toward.
    pub toward: Vector3<f64>,
    /// Its growth with height.
    pub profile: WindProfile,
    gust: Gust,
}

impl WindField {
    /// The wind of an environment; `None` when it has none.
    ///
    /// # Errors
    /// An exponent for a formula that has none, or an averaging time that the formula of the design wind does not reach.
    pub fn from_environment(env: &Environment) -> Result<Option<Self>, ClassError> {
        let Some(wind) = env.wind else { return Ok(None) };
        let (profile, design) = (env.wind_profile.as_ref(), env.design_wind.as_ref());
        let kind = profile.map(|g| g.kind).or(design.map(|g| g.kind.law())).unwrap_or(WindLaw::Power);
        let exponent = profile.and_then(|g| g.value);
        let law = law(kind, exponent, wind.speed).map_err(|e| profile.map_or(e.clone(), |g| e.with_span(g.span)))?;
        let gust = match design {
            None => Gust::None,
            Some(g) => gust(g.kind, g.value, wind.speed).map_err(|e| e.with_span(g.span))?,
        };
        Ok(Some(WindField::new(wind.speed, wind.direction, law, gust)))
    }

    /// A wind of a speed (m/s, 10 m above the water) from a direction (rad), with a profile.
    pub fn steady(speed: f64, from: f64, profile: WindProfile) -> Self {
        WindField::new(speed, from, profile, Gust::None)
    }

    fn new(speed: f64, from: f64, profile: WindProfile, gust: Gust) -> Self {
        let (cos, sin) = windlass_base::geometry::unit_vector(from);
        WindField { speed, toward: Vector3::new(-cos, -sin, 0.0), profile, gust }
    }

    /// Heights above the water (m) at which its formula has a kink.
    pub fn kinks(&self) -> Vec<f64> {
        let mut heights = vec![MIN_WIND_HEIGHT_M];
        if self.profile == WindProfile::Abs {
            heights.extend(ABS_BANDS.map(|band| band.0));
        }
        if matches!(self.gust, Gust::Api(_)) {
            heights.push(SURFACE_LAYER);
        }
        heights
    }

    /// Speed (m/s) at a height above the water (m), and its change with the height (1/s).
    pub fn speed(&self, height: f64) -> (f64, f64) {
        let z = height.max(MIN_WIND_HEIGHT_M);
        let log = (z / REFERENCE_HEIGHT_M).ln();
        let (factor, rise) = match self.profile {
            WindProfile::Power(a) => {
                let f = (a * log).exp();
                (f, a * f / z)
            }
            WindProfile::Logarithmic(z0) => {
                let whole = (REFERENCE_HEIGHT_M / z0).ln();
                (1.0 + log / whole, 1.0 / (whole * z))
            }
            WindProfile::Logarithm(c) => (1.0 + c * log, c / z),
            WindProfile::Abs => abs(z),
        };
        let (gust, growth) = self.gust.factor(z);
        let change = if height > MIN_WIND_HEIGHT_M { rise * gust + factor * growth } else { 0.0 };
        (self.speed * factor * gust, self.speed * change)
    }
}

impl Gust {
    /// The factor at a height (m), and its change with the height.
    fn factor(self, z: f64) -> (f64, f64) {
        match self {
            Gust::None => (1.0, 0.0),
            Gust::Api(g) => {
                // turbulence intensity of [API-RP-2A]
                let exponent: f64 = if z <= SURFACE_LAYER { -0.125 } else { -0.275 };
                let intensity = 0.15 * (z / SURFACE_LAYER).powf(exponent);
                (1.0 + g * intensity, g * intensity * exponent / z)
            }
            Gust::Froya(level, log) => {
                let intensity = level * (z / REFERENCE_HEIGHT_M).powf(-0.22);
                (1.0 - 0.41 * intensity * log, 0.41 * 0.22 * intensity * log / z)
            }
            Gust::Dnv(log) => {
                let whole = 1.0 + 0.137 * (z / REFERENCE_HEIGHT_M).ln();
                (1.0 - 0.047 * log / whole, 0.047 * log * 0.137 / (whole * whole * z))
            }
        }
    }
}

/// The profile of a law.
///
/// - POWER: exponent 1/7 unless given ([DNV-RP-C205 2.3.2.9] has 0.12 to 0.14 for open sea).
/// - LOGARITHMIC: [DNV-RP-C205 2.3.2.5] with the roughness of Charnock, `z0 = Ac/g (0.4 U10 / ln(10/z0))^2`, Ac 0.014.
/// - API: [API-RP-2A 2.3.2], 20th edition: power of 0.125, hourly mean. Later editions have the formula of ISO.
/// - NPD: Froya wind [DNV-RP-C205 2.3.2.13]: C = 0.0573 sqrt(1 + 0.148 U), hourly mean.
/// - ISO: [ISO-19901-1 A.7.3]: C = 0.0573 sqrt(1 + 0.15 U), hourly mean.
/// - DNV: [DNV-RP-C205 2.3.2.11]: C = 0.137, mean over 10 minutes.
/// - ABS: MODU Rules, mean over one minute; its steps are joined by straight lines between the middles of the bands.
fn law(kind: WindLaw, exponent: Option<f64>, speed: f64) -> Result<WindProfile, ClassError> {
    let logarithm = |c: f64| {
        if exponent.is_none() {
            return Ok(WindProfile::Logarithm(c));
        }
        Err(no_exponent(kind))
    };
    match kind {
        WindLaw::Power => Ok(WindProfile::Power(exponent.unwrap_or(1.0 / 7.0))),
        WindLaw::Api => Ok(WindProfile::Power(exponent.unwrap_or(0.125))),
        WindLaw::Logarithmic | WindLaw::Abs if exponent.is_some() => Err(no_exponent(kind)),
        WindLaw::Logarithmic => Ok(WindProfile::Logarithmic(roughness(speed))),
        WindLaw::Abs => Ok(WindProfile::Abs),
        WindLaw::Npd => logarithm(0.0573 * (1.0 + 0.148 * speed).sqrt()),
        WindLaw::Iso => logarithm(0.0573 * (1.0 + 0.15 * speed).sqrt()),
        WindLaw::Dnv => logarithm(0.137),
    }
}

fn no_exponent(kind: WindLaw) -> ClassError {
    ClassError::new(format!("the {} wind profile has no exponent", kind.word()))
        .help("-W_PROFILE POWER and API take one")
}

/// Charnock's roughness of the sea under a wind of this speed at 10 m (m).
fn roughness(speed: f64) -> f64 {
    const CHARNOCK: f64 = 0.014;
    const KARMAN: f64 = 0.4;
    let mut z0: f64 = 1e-4;
    // the logarithm changes slowly: each turn gains a figure or more
    for _ in 0..60 {
        let shear = KARMAN * speed / (REFERENCE_HEIGHT_M / z0).ln();
        z0 = (CHARNOCK / windlass_base::units::STANDARD_GRAVITY * shear * shear).clamp(1e-7, 0.1);
    }
    z0
}

/// The conversion of a design wind.
///
/// - API: [API-RP-2A 2.3.2], 20th edition: `1 + g(t) I(z)`, `g = 3 + ln((3/t)^0.6)` for t up to 60 s.
/// - NPD, ISO: `1 - 0.41 Iu(z) ln(t/3600)`, `Iu = 0.06 (1 + 0.043 U) (z/10)^-0.22`, for t up to an hour.
/// - DNV: `U(T, z) = U10 (1 + 0.137 ln(z/10) - 0.047 ln(T/600))`.
/// - ABS: none.
fn gust(code: WindCode, duration: Option<f64>, speed: f64) -> Result<Gust, ClassError> {
    let refuse = |text: &str, limit: f64| Err(ClassError::with_values(text, &[(limit, Dim::Time)]));
    let Some(t) = duration else { return Ok(Gust::None) };
    match code {
        WindCode::Api if t == 3600.0 => Ok(Gust::None),
        WindCode::Api if t <= 60.0 => Ok(Gust::Api(3.0 + 0.6 * (3.0 / t).ln())),
        WindCode::Api => {
            refuse("the gust factor of API reaches an averaging time of {}, and has the mean over 3600 s", 60.0)
        }
        WindCode::Npd | WindCode::Iso | WindCode::Dnv if t > 3600.0 => {
            refuse("the formula of the design wind reaches an averaging time of {}", 3600.0)
        }
        WindCode::Npd | WindCode::Iso => Ok(Gust::Froya(0.06 * (1.0 + 0.043 * speed), (t / 3600.0).ln())),
        WindCode::Dnv => Ok(Gust::Dnv((t / 600.0).ln())),
        WindCode::Abs if t == 60.0 => Ok(Gust::None),
        WindCode::Abs => refuse("the rules of ABS have no other averaging time than {}", 60.0),
    }
}

/// Factor of speed of ABS at a height, and its change.
fn abs(z: f64) -> (f64, f64) {
    let (mut pressure, mut rise) = (1.0, 0.0);
    for pair in ABS_BANDS.windows(2) {
        let [(low, at_low), (high, at_high)] = pair else { continue };
        if z >= *high {
            (pressure, rise) = (*at_high, 0.0);
        } else if z >= *low {
            rise = (at_high - at_low) / (high - low);
            pressure = at_low + rise * (z - low);
        }
    }
    let root = f64::sqrt(pressure);
    (root, 0.5 * rise / root)
}
