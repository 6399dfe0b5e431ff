//! Damage of a mooring line's segments from a record of their tension.

use super::curve::SnCurve;
use super::damage::{ScatterState, cycle_damage, life, sum_damage};
use crate::rainflow::{RainflowCycle, cycles};
use crate::{SeriesError, statistics};
use windlass_model::{FatigueKind, FatigueSegment, ThicknessCorrection};

/// What a record comes to in one segment.
#[derive(Clone, Debug, PartialEq)]
pub struct SegmentDamage {
    /// Number of the segment, from 1 at the fairlead.
    pub segment: usize,
    /// Name of its curve.
    pub curve: String,
    /// Whether the curve's numbers are unconfirmed.
    pub unconfirmed: bool,
    /// Damage of the record.
    pub damage: f64,
    /// Cycles counted.
    pub cycles: f64,
    /// Largest tension over its breaking tension.
    pub most_used: f64,
    /// Largest stress (MPa), on the area that its curve goes by.
    pub largest_stress: f64,
    /// Mean tension over its breaking tension.
    pub mean: f64,
}

/// What a record comes to in a line.
#[derive(Clone, Debug, PartialEq)]
pub struct LineDamage {
    /// Its segments, from the fairlead.
    pub segments: Vec<SegmentDamage>,
    /// Place in the list of the segment that [MOSES-FLEX -C_SN] goes by: that with the largest tension over breaking tension where its
    /// curve is one of tension, else that with the largest stress.
    pub governing: usize,
    /// Place of the segment with the largest damage.
    pub worst: usize,
}

/// A segment with its curve and its own record of tension.
#[derive(Clone, Copy, Debug)]
pub struct Loaded<'a> {
    /// What it is.
    pub segment: &'a FatigueSegment,
    /// Its curve.
    pub curve: &'a SnCurve,
    /// Its tension (N), at its upper end.
    pub tension: &'a [f64],
}

/// Damage of each segment by rainflow cycles of its tension: over the breaking tension for a curve of tension; for one of
/// stress over the area of the section (times the legs of a chain's link, as the curve says), with the thickness correction.
///
/// # Errors
/// No segments; a tension that is not finite; a breaking tension or a diameter that is not greater than zero.
pub fn line_damage(segments: &[Loaded], thickness: Option<&ThicknessCorrection>) -> Result<LineDamage, SeriesError> {
    let mut made = Vec::new();
    for (index, loaded) in segments.iter().enumerate() {
        made.push(segment_damage(index + 1, loaded, thickness)?);
    }
    let position = |of: &dyn Fn(&SegmentDamage) -> f64| {
        let mut best = (0, f64::MIN);
        for (index, segment) in made.iter().enumerate() {
            if of(segment) > best.1 {
                best = (index, of(segment));
            }
        }
        best.0
    };
    let critical = position(&|s| s.most_used);
    let Some(kind) = segments.get(critical).map(|s| s.curve.kind) else {
        return Err(SeriesError::TooFew { what: "fatigue of a line with segments", need: 1, got: 0 });
    };
    let governing = match kind {
        FatigueKind::Tension => critical,
        FatigueKind::Stress => position(&|s| s.largest_stress),
    };
    let worst = position(&|s| s.damage);
    Ok(LineDamage { segments: made, governing, worst })
}

fn segment_damage(
    number: usize,
    loaded: &Loaded,
    thickness: Option<&ThicknessCorrection>,
) -> Result<SegmentDamage, SeriesError> {
    let (segment, curve) = (loaded.segment, loaded.curve);
    let area = segment.area();
    for (what, value) in [("the breaking tension of a segment", segment.breaking), ("the area of a segment", area)] {
        if !(value.is_finite() && value > 0.0) {
            return Err(SeriesError::Setting { what, expected: "greater than zero", value });
        }
    }
    let moments = statistics::moments(loaded.tension)?;
    let found = cycles(loaded.tension)?;
    // MPa of the section that bears the tension; of a chain the curve counts both legs
    let stress = 1e-6 / (area * curve.legs);
    let factor = match curve.kind {
        FatigueKind::Tension => 1.0 / segment.breaking,
        FatigueKind::Stress => stress * thickness.map_or(1.0, |t| t.factor(segment.thickness.unwrap_or(segment.od))),
    };
    let mean = moments.mean / segment.breaking;
    let ranges: Vec<RainflowCycle> = found
        .iter()
        .map(|c| RainflowCycle { range: c.range * factor, mean: c.mean * factor, count: c.count })
        .collect();
    let damage = cycle_damage(&ranges, curve, mean)?;
    Ok(SegmentDamage {
        segment: number,
        curve: curve.name.clone(),
        unconfirmed: curve.unconfirmed,
        damage: damage.sum,
        cycles: damage.cycles,
        most_used: moments.maximum.1 / segment.breaking,
        largest_stress: moments.maximum.1 * stress,
        mean,
    })
}

/// A record of a line in one environment of a scatter.
#[derive(Clone, Copy, Debug)]
pub struct Exposure<'a> {
    /// What the record comes to.
    pub line: &'a LineDamage,
    /// Length of the record (s).
    pub record: f64,
    /// How long the environment lasts (s): its `-DURATION`.
    pub duration: f64,
}

/// What a scatter of environments comes to in a segment.
#[derive(Clone, Debug, PartialEq)]
pub struct SegmentLife {
    /// Number of the segment, from 1 at the fairlead.
    pub segment: usize,
    /// Name of its curve.
    pub curve: String,
    /// Damage of all environments together.
    pub damage: f64,
    /// Life (years) when they repeat for ever, with the design factor; `None` without damage.
    pub years: Option<f64>,
}

/// Damage and life of each segment of a line over a scatter of environments, with a design fatigue factor (at least 1). Each
/// segment goes by its own curve; the governing one of [MOSES-FLEX -C_SN] is reported by [`LineDamage`].
///
/// # Errors
/// No environment; records of unlike numbers of segments; a record or duration without length; a factor below 1.
pub fn line_life(scatter: &[Exposure], factor: f64) -> Result<Vec<SegmentLife>, SeriesError> {
    let Some(first) = scatter.first() else {
        return Err(SeriesError::TooFew { what: "a scatter of environments", need: 1, got: 0 });
    };
    if scatter.iter().any(|e| e.line.segments.len() != first.line.segments.len()) {
        return Err(SeriesError::Refused("the records are not of one line: their segments differ in number".into()));
    }
    let total: f64 = scatter.iter().map(|e| e.duration).sum();
    let mut out = Vec::new();
    for (index, segment) in first.line.segments.iter().enumerate() {
        let states: Vec<ScatterState> = scatter
            .iter()
            .filter_map(|e| {
                let damage = e.line.segments.get(index)?.damage;
                Some(ScatterState { damage, record: e.record, duration: e.duration })
            })
            .collect();
        let damage = sum_damage(&states)?;
        let years = life(damage, total, factor)?;
        out.push(SegmentLife { segment: segment.segment, curve: segment.curve.clone(), damage, years });
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fatigue::find;
    use windlass_model::FatigueSelection;

    fn find_curve(name: &str) -> SnCurve {
        find(name, &FatigueSelection::default()).unwrap()
    }

    fn segment(breaking: f64, od: f64) -> FatigueSegment {
        FatigueSegment { curve: None, breaking, break_is_given: true, od, thickness: None, length: 100.0 }
    }

    /// 101 samples from trough to trough: 50 cycles of 200 kN about 1000 kN.
    fn record() -> Vec<f64> {
        (0..101).map(|i| if i % 2 == 0 { 0.9e6 } else { 1.1e6 }).collect()
    }

    #[test]
    fn equal_cycles_give_number_over_life() {
        let (chain, wire, tension) = (find_curve("CHAIN"), find_curve("WIRE"), record());
        let (a, b) = (segment(5e6, 0.1), segment(4e6, 0.08));
        let made = line_damage(
            &[
                Loaded { segment: &a, curve: &chain, tension: &tension },
                Loaded { segment: &b, curve: &wire, tension: &tension },
            ],
            None,
        )
        .unwrap();
        // chain: R 0.04, 50 cycles (half cycles from end to end), K 1000, M 3
        assert!((made.segments[0].damage - 50.0 * 0.04f64.powi(3) / 1000.0).abs() < 1e-15, "{made:?}");
        // rope: R 0.05, mean tension 0.25 of the break but for the last sample
        let mean = tension.iter().sum::<f64>() / 101.0 / 4e6;
        let want = 50.0 * 0.05f64.powf(4.09) / 10f64.powf(3.20 - 2.79 * mean);
        assert!((made.segments[1].damage / want - 1.0).abs() < 1e-12);
        assert_eq!((made.governing, made.worst), (1, 0));
    }

    #[test]
    fn stress_uses_both_chain_legs_and_thickness_factor() {
        let (chain, plain, tension) = (find_curve("DNV_STUDLESS"), find_curve("DNV_D_FREE"), record());
        let a = segment(5e6, 0.1);
        let of = |curve: &SnCurve, t: Option<&ThicknessCorrection>| {
            line_damage(&[Loaded { segment: &a, curve, tension: &tension }], t).unwrap().segments[0].damage
        };
        let stress = 0.2 / (std::f64::consts::FRAC_PI_2 * 0.01);
        assert!((of(&chain, None) / (50.0 * stress.powi(3) / 6.0e10) - 1.0).abs() < 1e-3);
        let bare = of(&plain, None);
        assert!((bare / (50.0 * (2.0 * stress).powi(3) / 10f64.powf(11.687)) - 1.0).abs() < 1e-12);
        // (0.1 / 0.025)^0.25 is 1.41, held to 1.2
        let t = ThicknessCorrection { reference: 0.025, power: 0.25, most: 1.2 };
        assert!((of(&plain, Some(&t)) / bare - 1.2f64.powi(3)).abs() < 1e-12);
    }

    #[test]
    fn largest_stress_segment_governs_where_a_stress_curve_exists() {
        let (stress, tension) = (find_curve("DNV_D_FREE"), record());
        // the first is nearer its break, the second has the higher stress
        let (a, b) = (segment(2e6, 0.2), segment(9e6, 0.05));
        let load = |segment| Loaded { segment, curve: &stress, tension: &tension };
        assert_eq!(line_damage(&[load(&a), load(&b)], None).unwrap().governing, 1);
        let chain = find_curve("CHAIN");
        let made = line_damage(&[Loaded { segment: &a, curve: &chain, tension: &tension }, load(&b)], None).unwrap();
        assert_eq!(made.governing, 0);
    }

    #[test]
    fn segment_without_strength_is_refused() {
        let (chain, tension) = (find_curve("CHAIN"), record());
        let a = segment(0.0, 0.1);
        assert!(line_damage(&[Loaded { segment: &a, curve: &chain, tension: &tension }], None).is_err());
        assert!(line_damage(&[], None).is_err());
    }

    #[test]
    fn segment_life_weights_environments_by_duration() {
        let (chain, tension) = (find_curve("CHAIN"), record());
        let a = segment(5e6, 0.1);
        let storm = line_damage(&[Loaded { segment: &a, curve: &chain, tension: &tension }], None).unwrap();
        let calm: Vec<f64> = tension.iter().map(|t| 1e6 + (t - 1e6) / 2.0).collect();
        let calm = line_damage(&[Loaded { segment: &a, curve: &chain, tension: &calm }], None).unwrap();
        let day = 86_400.0;
        let scatter = [
            Exposure { line: &storm, record: 1000.0, duration: 65.25 * day },
            Exposure { line: &calm, record: 1000.0, duration: 300.0 * day },
        ];
        let found = line_life(&scatter, 3.0).unwrap();
        // half the range is an eighth of the damage
        let want = storm.segments[0].damage * (65.25 + 300.0 / 8.0) * 86.4;
        assert!((found[0].damage / want - 1.0).abs() < 1e-12);
        assert!((found[0].years.unwrap() * 3.0 * want - 1.0).abs() < 1e-12);
        assert!(line_life(&[], 1.0).is_err() && line_life(&scatter, 0.0).is_err());
    }
}
