//! The least, mean and largest of many quantities as a run goes, in flat memory.

use crate::SeriesError;
use crate::statistics::Peak;

/// What was seen of a quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnvelopeValue {
    /// Samples.
    pub count: u64,
    /// Their mean.
    pub mean: f64,
    /// Their standard deviation (divided by the number).
    pub deviation: f64,
    /// The least with its time.
    pub least: Peak,
    /// The largest with its time.
    pub most: Peak,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Track {
    count: u64,
    mean: f64,
    squares: f64,
    least: Peak,
    most: Peak,
}

/// Quantities side by side, a sample of each at a time; what is not there at a time (not a number) does not count.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Envelope {
    tracks: Vec<Option<Track>>,
}

impl Envelope {
    /// Takes a sample of each quantity, always in the same order. Mean and deviation by the update of
    /// [WELFORD-1962].
    ///
    /// # Errors
    /// An infinite sample; those before it are taken.
    pub fn take(&mut self, time: f64, samples: impl IntoIterator<Item = f64>) -> Result<(), SeriesError> {
        for (position, value) in samples.into_iter().enumerate() {
            if self.tracks.len() <= position {
                self.tracks.resize(position + 1, None);
            }
            if value.is_nan() {
                continue;
            }
            if value.is_infinite() {
                return Err(SeriesError::NotFinite { row: position + 1 });
            }
            let Some(track) = self.tracks.get_mut(position) else { continue };
            let now = Peak { time, value };
            match track {
                None => *track = Some(Track { count: 1, mean: value, squares: 0.0, least: now, most: now }),
                Some(track) => {
                    track.count += 1;
                    let off = value - track.mean;
                    track.mean += off / track.count as f64;
                    track.squares += off * (value - track.mean);
                    if value < track.least.value {
                        track.least = now;
                    }
                    if value > track.most.value {
                        track.most = now;
                    }
                }
            }
        }
        Ok(())
    }

    /// What was seen of a quantity by its place; none where it never was there.
    pub fn extremes(&self, position: usize) -> Option<EnvelopeValue> {
        let Track { count, mean, squares, least, most } = *self.tracks.get(position)?.as_ref()?;
        Some(EnvelopeValue { count, mean, deviation: (squares / count as f64).max(0.0).sqrt(), least, most })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics;

    #[test]
    fn envelope_matches_statistics_of_each_series() {
        let wave = |i: i32, k: f64| 1e6 + (f64::from(i) * k).sin();
        let mut envelope = Envelope::default();
        for i in 0..200 {
            envelope.take(f64::from(i), [wave(i, 0.3), wave(i, 0.7)]).unwrap();
        }
        for (position, k) in [0.3, 0.7].into_iter().enumerate() {
            let series: Vec<f64> = (0..200).map(|i| wave(i, k)).collect();
            let (want, found) = (statistics::moments(&series).unwrap(), envelope.extremes(position).unwrap());
            assert!((found.mean - want.mean).abs() < 1e-8 && (found.deviation - want.deviation).abs() < 1e-8);
            assert_eq!(found.most.value, want.maximum.1);
            assert_eq!(found.count, 200);
        }
    }

    #[test]
    fn missing_value_is_skipped_and_infinite_value_is_error() {
        let mut envelope = Envelope::default();
        envelope.take(0.0, [f64::NAN, 2.0, f64::NAN]).unwrap();
        envelope.take(1.0, [5.0, 4.0, f64::NAN]).unwrap();
        assert_eq!(envelope.extremes(0).unwrap().count, 1);
        assert_eq!(envelope.extremes(1).unwrap().mean, 3.0);
        assert_eq!((envelope.extremes(2), envelope.extremes(9)), (None, None));
        assert!(envelope.take(2.0, [f64::INFINITY]).is_err());
    }
}
