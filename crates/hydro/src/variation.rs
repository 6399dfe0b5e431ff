//! How wind and current vary about their means, for bodies under way.
//!
//! Source: [MOSES-REF env, curv]. Where it is silent: a history is straight between its points and
//! keeps the values of its ends beyond them; that of wind takes the place of the speed of `-WIND`, with its direction and profile;
//! that of current (ours) multiplies the current. All grow with the ramp of the environment from the means, on which statics stands.

use super::gusts::Gusts;
use super::ramp::ramp;
use windlass_model::{ClassError, CurveKind, CurveReference, Environment, Model};

/// What wind and current have beside their means at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StreamVariation {
    /// Speed that a history adds to the mean wind 10 m above the water (m/s).
    pub wind: f64,
    /// Gust along the mean wind, the same everywhere (m/s).
    pub gust: f64,
    /// Factor of the current.
    pub current: f64,
}

impl Default for StreamVariation {
    fn default() -> Self {
        StreamVariation { wind: 0.0, gust: 0.0, current: 1.0 }
    }
}

/// A value over time, straight between its points.
#[derive(Clone, Debug, PartialEq)]
pub struct TimeCurve {
    /// Time (s), value; times grow.
    points: Vec<(f64, f64)>,
}

impl TimeCurve {
    /// That of a curve of a kind that an environment names.
    ///
    /// # Errors
    /// A curve that is not there.
    fn new(model: &Model, named: &CurveReference, kind: CurveKind) -> Result<Self, ClassError> {
        match model.curves.get(&Model::key(&named.kind)) {
            Some(curve) if curve.kind == kind => Ok(TimeCurve { points: curve.points.clone() }),
            _ => {
                Err(ClassError::new(format!("there is no {} curve {}", kind.name(), named.kind)).with_span(named.span))
            }
        }
    }

    /// Its value at a time (s).
    pub fn value_at_time(&self, time: f64) -> f64 {
        let next = self.points.partition_point(|p| p.0 <= time);
        match (next.checked_sub(1).and_then(|i| self.points.get(i)), self.points.get(next)) {
            (Some((low, at_low)), Some((high, at_high))) => at_low + (at_high - at_low) * (time - low) / (high - low),
            (Some(end), None) | (None, Some(end)) => end.1,
            (None, None) => 0.0,
        }
    }
}

/// What varies in time in an environment.
#[derive(Debug)]
pub struct Variation {
    /// Mean speed of the wind (m/s), and its history.
    wind: Option<(f64, TimeCurve)>,
    gusts: Option<Gusts>,
    current: Option<TimeCurve>,
    /// Time over which it grows (s), and at which it begins to.
    ramp: f64,
    ramp_start: f64,
}

impl Variation {
    /// That of an environment; `None` when nothing varies.
    ///
    /// # Errors
    /// A curve that is not there, wind that varies without a direction, a correlation that has no meaning.
    pub fn new(model: &Model, env: &Environment) -> Result<Option<Self>, ClassError> {
        if let Some(given) = env.drift_correlation.as_ref().filter(|g| g.value != Some(0.0)) {
            let text = "no source says how -W_MD_CORRELATION makes gusts and mean drift depend on each other in time";
            return Err(ClassError::new(text)
                .with_span(given.span)
                .help("leave it out: gusts and drift are then independent"));
        }
        let wind = match &env.wind_history {
            None => None,
            Some(named) => {
                let history = TimeCurve::new(model, named, CurveKind::WindHistory)?;
                let Some(mean) = env.wind else {
                    let text = format!("the wind history {} has no direction", named.kind);
                    return Err(ClassError::new(text).with_span(named.span).help(
                        "give -WIND SPEED DIR: its direction, and the \
                                                                          speed of statics",
                    ));
                };
                Some((mean.speed, history))
            }
        };
        let current = env
            .current_history
            .as_ref()
            .map(|named| TimeCurve::new(model, named, CurveKind::CurrentHistory))
            .transpose()?;
        let gusts = Gusts::new(model, env)?;
        if wind.is_none() && gusts.is_none() && current.is_none() {
            return Ok(None);
        }
        let ramp = env.ramp.unwrap_or(model.defaults.ramp);
        Ok(Some(Variation { wind, gusts, current, ramp, ramp_start: env.run_start }))
    }

    /// What there is at a time (s).
    pub fn sample(&self, time: f64) -> StreamVariation {
        let (grown, _) = ramp(self.ramp, time - self.ramp_start);
        let wind = self.wind.as_ref().map_or(0.0, |(mean, history)| grown * (history.value_at_time(time) - mean));
        let current = self.current.as_ref().map_or(1.0, |history| 1.0 + grown * (history.value_at_time(time) - 1.0));
        let gust = self.gusts.as_ref().map_or(0.0, |gusts| grown * gusts.speed_at_time(time));
        StreamVariation { wind, gust, current }
    }
}
