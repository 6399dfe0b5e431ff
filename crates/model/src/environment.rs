//! Environments of `&ENV`.
//!
//! Source: [MOSES-REF env]. Directions are where wind, sea and current come from, from +X toward +Y.

use windlass_base::choices;
use windlass_base::span::Span;
use windlass_base::values::Given;
use windlass_base::values::Noun;

/// A sea: spectrum or regular wave.
#[derive(Clone, Debug, PartialEq)]
pub struct SeaDefinition {
    /// Spectrum name.
    pub spectrum: String,
    /// Direction it comes from (rad).
    pub direction: f64,
    /// Significant height, or height of a regular wave (m).
    pub height: f64,
    /// Period (s).
    pub period: f64,
    /// The parameters of the spectrum behind the period, where given (SI).
    pub shape: Vec<Option<f64>>,
    /// Where its name, direction, height and period were written.
    pub positions: [Span; 4],
}

/// A wave given by itself: `zeta = a cos(k x - w t + phase)`, x along its travel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GivenWave {
    /// Frequency (rad/s).
    pub frequency: f64,
    /// Amplitude (m).
    pub amplitude: f64,
    /// Phase (rad).
    pub phase: f64,
    /// Direction it comes from (rad).
    pub direction: f64,
}

/// The elevation over time at x = y = 0: `-S_HISTORY`.
#[derive(Clone, Debug, PartialEq)]
pub struct ElevationHistory {
    /// Its curve.
    pub curve: CurveReference,
    /// Direction its waves come from (rad).
    pub direction: f64,
    /// Highest frequency of its waves (rad/s), where given.
    pub highest: Option<f64>,
}

impl SeaDefinition {
    /// Where one of its values was written, by its position in `-SEA`.
    pub fn position(&self, index: usize) -> Span {
        self.positions.get(index).copied().unwrap_or_default()
    }
}

choices! {
    /// How the components of a sea are cut from its spectrum.
    #[derive(Default)]
    pub enum Division {
        /// All with the same energy.
        #[default]
        EqualEnergy = "EQUAL_ENERGY",
        /// Bands of the same width.
        EqualFrequency = "EQUAL_FREQUENCY",
    }
}

/// `-COMPONENTS N TYPE LOW HIGH`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Components {
    /// How many for each sea.
    pub number: usize,
    /// How they are cut.
    pub division: Division,
    /// Lowest and highest frequency (rad/s), where given; the energy beyond is left out.
    pub limits: Option<[f64; 2]>,
    /// Where it was given.
    pub span: Span,
}

/// What makes the phases of the components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Phasing {
    /// All in phase at x = y = 0 at this time (s): `-T_REINFORCE`.
    Reinforced(f64),
    /// Random, from this seed: `-SEED`.
    Seeded(u64),
}

choices! {
    /// What holds between the mean level and the surface, where linear waves say nothing.
    #[derive(Default)]
    pub enum Stretching {
        /// Straight on from the mean level.
        #[default]
        Linear = "LINEAR",
        /// The profile of the mean level, moved to the surface [WHEELER-1970].
        Wheeler = "WHEELER",
        /// Between the two [RODENBUSCH-FORRISTALL-1986].
        Delta = "DELTA",
        /// The profile itself, also above the surface.
        Exponential = "EXPONENTIAL",
    }
}

choices! {
    /// What the period of a sea is.
    pub enum PeriodType {
        /// That of the highest density.
        Peak = "PEAK",
        /// 2 pi m0/m1.
        Mean = "MEAN",
        /// 2 pi sqrt(m0/m2).
        ZeroCrossing = "ZERO_CROSSING",
    }
}

choices! {
    /// Codes and laws of the mean wind; [MOSES-REF env] names no types, so these are the field's usual ones.
    pub enum WindLaw {
        /// A power of the height.
        Power = "POWER",
        /// The logarithm of the height over a roughness.
        Logarithmic = "LOGARITHMIC",
        /// [API-RP-2A].
        Api = "API",
        /// The Norwegian Petroleum Directorate.
        Npd = "NPD",
        /// [ISO-19901-1].
        Iso = "ISO",
        /// The rules of ABS.
        Abs = "ABS",
        /// [DNV-RP-C205].
        Dnv = "DNV",
    }
}

choices! {
    /// Codes of a design wind.
    pub enum WindCode {
        /// [API-RP-2A].
        Api = "API",
        /// The Norwegian Petroleum Directorate.
        Npd = "NPD",
        /// [ISO-19901-1].
        Iso = "ISO",
        /// The rules of ABS.
        Abs = "ABS",
        /// [DNV-RP-C205].
        Dnv = "DNV",
    }
}

impl WindCode {
    /// The law of the mean wind that the code has.
    pub fn law(self) -> WindLaw {
        match self {
            WindCode::Api => WindLaw::Api,
            WindCode::Npd => WindLaw::Npd,
            WindCode::Iso => WindLaw::Iso,
            WindCode::Abs => WindLaw::Abs,
            WindCode::Dnv => WindLaw::Dnv,
        }
    }
}

/// Steady wind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wind {
    /// Speed (m/s).
    pub speed: f64,
    /// Direction it comes from (rad).
    pub direction: f64,
}

/// A formula that an option of the environment chooses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FormulaChoice<T> {
    /// Which one.
    pub kind: T,
    /// Its number: an exponent, an averaging time (s).
    pub value: Option<f64>,
    /// Where it was given.
    pub span: Span,
}

/// A formula or a curve that an option of the environment names.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveReference {
    /// Its name; that of a formula in upper case.
    pub kind: String,
    /// Its number: a density (kg/m3), a factor.
    pub value: Option<f64>,
    /// Where it was given.
    pub span: Span,
}

/// How gusts are cut from their spectrum: `-W_COMPONENTS N INTENSITY`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GustParts {
    /// How many components.
    pub number: usize,
    /// Standard deviation over the mean speed, where it is not that of the spectrum.
    pub intensity: Option<f64>,
    /// Where it was given.
    pub span: Span,
}

/// Current: one velocity, or profiles with their directions.
#[derive(Clone, Debug, PartialEq)]
pub enum Current {
    /// The same at every depth.
    Uniform {
        /// Velocity (m/s).
        velocity: f64,
        /// Direction it comes from (rad).
        direction: f64,
    },
    /// Curves of type C_PROFILE, each with the direction it comes from (rad).
    Profiles(Vec<(String, f64)>),
}

/// `-TIME TOBSERV DELTA_TIME TTRA_SET NCYCLES`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeWindow {
    /// Length observed (s).
    pub observed: f64,
    /// Step (s).
    pub step: f64,
    /// Time set aside for the transient (s).
    pub transient: Option<f64>,
    /// Number of cycles.
    pub cycles: Option<i64>,
}

/// An environment. What was not given is `None`: the defaults then hold.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Environment {
    /// Its name as written; empty for the unnamed one.
    pub name: String,
    /// Sea.
    pub sea: Option<SeaDefinition>,
    /// Second sea added to the first.
    pub added_sea: Option<SeaDefinition>,
    /// Waves given one by one (`-WAVES`).
    pub waves: Vec<GivenWave>,
    /// Elevation over time (`-S_HISTORY`).
    pub elevation: Option<ElevationHistory>,
    /// Wind.
    pub wind: Option<Wind>,
    /// Profile of the mean wind, with its exponent (`-W_PROFILE`).
    pub wind_profile: Option<FormulaChoice<WindLaw>>,
    /// Design wind, with its averaging time (s) (`-W_DESIGN`).
    pub design_wind: Option<FormulaChoice<WindCode>>,
    /// Gust spectrum (`-W_SPECTRUM`): a code, or a curve.
    pub gusts: Option<CurveReference>,
    /// Periods of the gusts (s) (`-W_PERIOD`); none: as `gust_parts` says.
    pub gust_periods: Vec<f64>,
    /// How gusts are cut from their spectrum (`-W_COMPONENTS`).
    pub gust_parts: Option<GustParts>,
    /// Curve of the wind over time (`-W_HISTORY`).
    pub wind_history: Option<CurveReference>,
    /// Correlation of gusts and mean drift (`-W_MD_CORRELATION`).
    pub drift_correlation: Option<CurveReference>,
    /// What the period of a sea is (`-SP_TYPE`).
    pub sea_period: Option<FormulaChoice<PeriodType>>,
    /// Current.
    pub current: Option<Current>,
    /// Curve of the factor of the current over time (`-C_HISTORY`).
    pub current_history: Option<CurveReference>,
    /// Curve of marine growth (`-M_GROWTH`), with the density of the growth (kg/m3).
    pub growth: Option<CurveReference>,
    /// Bottom over a grid (`-BATHYMETRY`), by its name.
    pub bathymetry: Option<CurveReference>,
    /// What pipes hold (`-T_PRESSURE`), by its name.
    pub filling: Option<CurveReference>,
    /// Water density (kg/m3).
    pub water_density: Option<f64>,
    /// Depth (m).
    pub depth: Option<f64>,
    /// Rise of the mean water level (m).
    pub tide: Option<f64>,
    /// Time window.
    pub time: Option<TimeWindow>,
    /// Time of the first instant of a run (s) (`-START`), from which ramps count.
    pub run_start: f64,
    /// Ramp (s).
    pub ramp: Option<f64>,
    /// Directional spreading exponent; 200 (long-crested) when not given.
    pub spreading: Option<f64>,
    /// Number and kind of the wave components (`-COMPONENTS`).
    pub components: Option<Components>,
    /// Periods of the wave components (s) (`-S_PERIOD`); none: as `components` says.
    pub sea_periods: Vec<f64>,
    /// What makes the phases.
    pub phasing: Option<Phasing>,
    /// Phases of the wave components (rad) (`-PHASES`), those of the added sea behind those of the sea; none: as `phasing` says.
    pub sea_phases: Vec<f64>,
    /// What holds above the mean level (`-STRETCHING`).
    pub stretching: Option<Stretching>,
    /// Order of a STOKES wave (`-STOKES`); 5 when not given.
    pub stokes: Option<u8>,
    /// Every option as last given (SI values with their places), the ones above included, by full name.
    pub options: Vec<Given>,
    /// Where it was defined.
    pub span: Span,
}

impl Environment {
    /// The same without waves.
    pub fn without_sea(self) -> Self {
        Environment { sea: None, added_sea: None, waves: Vec::new(), elevation: None, ..self }
    }

    /// Whether it has waves of some height.
    pub fn has_waves(&self) -> bool {
        [&self.sea, &self.added_sea].into_iter().flatten().any(|sea| sea.height > 0.0)
            || self.waves.iter().any(|wave| wave.amplitude > 0.0)
            || self.elevation.is_some()
    }

    /// The curves it names: current profiles, spectra, those of its options.
    pub fn curves(&self) -> Box<dyn Iterator<Item = &str> + '_> {
        let profiles = match &self.current {
            Some(Current::Profiles(list)) => list.as_slice(),
            _ => &[],
        };
        let seas = [&self.sea, &self.added_sea].into_iter().flatten().map(|s| s.spectrum.as_str());
        let gusts = self.gusts.iter().map(|gusts| gusts.kind.as_str());
        let named = self.options.iter().flat_map(|g| g.names(Noun::Curve)).filter_map(|v| v.word()).chain(gusts);
        Box::new(profiles.iter().map(|(name, _)| name.as_str()).chain(seas).chain(named))
    }
}

/// What surrounds a line or body when it is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surroundings {
    /// Water density (kg/m3).
    pub water_density: f64,
    /// Air density (kg/m3).
    pub air_density: f64,
    /// Gravity (m/s2).
    pub gravity: f64,
    /// Depth below the mean water level without tide (m), where known.
    pub depth: Option<f64>,
    /// Rise of the water level above z = 0 (m).
    pub tide: f64,
}

impl Surroundings {
    /// Weight density of water (N/m3).
    pub fn water_weight(&self) -> f64 {
        self.water_density * self.gravity
    }
}
