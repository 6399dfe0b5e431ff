//! Fatigue at a node of a line: of a tube by the stress round its circumference, of a chain or rope by its tension.
//!
//! Cycles are those of rainflow, damage is Palmgren's and Miner's sum, as for lines of the catenary classes ([`crate::fatigue`]).

use crate::fatigue::{Loaded, SnCurve, cycle_damage, line_damage};
use crate::rainflow::{RainflowCycle, cycles};
use crate::{SeriesError, finite, statistics};
use std::f64::consts::{FRAC_PI_4, TAU};
use windlass_model::{FatigueKind, FatigueSegment, ThicknessCorrection};

/// A node with its record.
#[derive(Clone, Copy, Debug)]
pub struct NodeRecord<'a> {
    /// Its section.
    pub segment: &'a FatigueSegment,
    /// Its curve.
    pub curve: &'a SnCurve,
    /// Tension (N): in the wall of a tube, else effective.
    pub tension: &'a [f64],
    /// Moments about two directions across the line (N m); none where nothing bends.
    pub bends: Option<[&'a [f64]; 2]>,
}

/// How a tube is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TubeCircumference {
    /// Points round its circumference, the first in the direction that the first moment is about.
    pub points: usize,
    /// Stress concentration factor.
    pub concentration: f64,
}

impl Default for TubeCircumference {
    fn default() -> Self {
        TubeCircumference { points: 8, concentration: 1.0 }
    }
}

/// Most points round a circumference.
pub const MAX_CIRCUMFERENCE_POINTS: usize = 360;

/// What a record comes to at a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeDamage {
    /// Damage of the record; round a tube that of the worst point.
    pub damage: f64,
    /// Cycles counted there.
    pub cycles: f64,
    /// The worst point round a tube (rad from the direction that the first moment is about); none of a chain or rope.
    pub angle: Option<f64>,
    /// Largest range there: of stress (Pa), or of tension over breaking tension.
    pub largest: f64,
}

/// Damage at a node. A tube with moments goes by the stress at the outer surface where its curve is one of stress; else the
/// tension counts, as for the segments of a mooring line.
///
/// # Errors
/// Numbers that are not finite, series of unlike length, a section without strength, points or a factor out of range.
pub fn node_damage(
    node: &NodeRecord,
    thickness: Option<&ThicknessCorrection>,
    round: &TubeCircumference,
) -> Result<NodeDamage, SeriesError> {
    match (node.segment.thickness, node.bends, node.curve.kind) {
        (Some(wall), Some(bends), FatigueKind::Stress) => of_tube(node, (wall, bends), thickness, round),
        _ => of_tension(node, thickness),
    }
}

fn of_tension(node: &NodeRecord, thickness: Option<&ThicknessCorrection>) -> Result<NodeDamage, SeriesError> {
    let loaded = Loaded { segment: node.segment, curve: node.curve, tension: node.tension };
    let made = line_damage(&[loaded], thickness)?;
    let (damage, counted) = made.segments.first().map_or((0.0, 0.0), |s| (s.damage, s.cycles));
    let largest = cycles(node.tension)?.iter().map(|c| c.range).fold(0.0, f64::max);
    let scale = match node.curve.kind {
        FatigueKind::Tension => node.segment.breaking,
        FatigueKind::Stress => node.segment.area() * node.curve.legs,
    };
    Ok(NodeDamage { damage, cycles: counted, angle: None, largest: largest / scale })
}

fn of_tube(
    node: &NodeRecord,
    (wall, [about_one, about_other]): (f64, [&[f64]; 2]),
    thickness: Option<&ThicknessCorrection>,
    round: &TubeCircumference,
) -> Result<NodeDamage, SeriesError> {
    if !(1..=MAX_CIRCUMFERENCE_POINTS).contains(&round.points) {
        let expected = "between 1 and 360";
        return Err(SeriesError::Setting { what: "the points round a tube", expected, value: round.points as f64 });
    }
    let diameter = node.segment.od;
    let bore = (diameter - 2.0 * wall).max(0.0);
    let second_moment = FRAC_PI_4 / 16.0 * (diameter.powi(4) - bore.powi(4));
    for (what, value) in [
        ("the stress concentration factor", round.concentration),
        ("the wall of a segment", wall),
        ("the second moment of area of a segment", second_moment),
        ("the breaking tension of a segment", node.segment.breaking),
    ] {
        if !(value.is_finite() && value > 0.0) {
            return Err(SeriesError::Setting { what, expected: "greater than zero", value });
        }
    }
    for moments in [about_one, about_other] {
        if moments.len() != node.tension.len() {
            return Err(SeriesError::Lengths { times: node.tension.len(), values: moments.len() });
        }
        finite(moments)?;
    }
    let mean = statistics::moments(node.tension)?.mean / node.segment.breaking;
    // curves of stress are in MPa
    let factor = 1e-6 * round.concentration * thickness.map_or(1.0, |t| t.factor(wall));
    let (pull, bend) = (1.0 / node.segment.area(), 0.5 * diameter / second_moment);
    let mut worst = NodeDamage { damage: -1.0, cycles: 0.0, angle: None, largest: 0.0 };
    let mut stress = Vec::with_capacity(node.tension.len());
    for point in 0..round.points {
        let angle = TAU * point as f64 / round.points as f64;
        let (sine, cosine) = angle.sin_cos();
        stress.clear();
        let all = node.tension.iter().zip(about_one.iter().zip(about_other));
        // a moment about the first direction pulls where the second points
        stress.extend(all.map(|(t, (one, other))| t * pull + bend * (one * sine - other * cosine)));
        let found = cycles(&stress)?;
        let ranges: Vec<RainflowCycle> = found
            .iter()
            .map(|c| RainflowCycle { range: c.range * factor, mean: c.mean * factor, count: c.count })
            .collect();
        let damage = cycle_damage(&ranges, node.curve, mean)?;
        if damage.sum > worst.damage {
            let largest = found.iter().map(|c| c.range * round.concentration).fold(0.0, f64::max);
            worst = NodeDamage { damage: damage.sum, cycles: damage.cycles, angle: Some(angle), largest };
        }
    }
    Ok(worst)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fatigue::find;
    use windlass_model::FatigueSelection;

    const WAVE: [f64; 2] = [-1.0, 1.0];

    fn segment() -> FatigueSegment {
        FatigueSegment {
            curve: None,
            breaking: 5e6,
            break_is_given: true,
            od: 0.3,
            thickness: Some(0.02),
            length: 100.0,
        }
    }

    fn curve() -> SnCurve {
        find("DNV_D_FREE", &FatigueSelection::default()).unwrap()
    }

    /// 101 samples from trough to trough: 50 cycles, scaled.
    fn record(scale: f64, shift: f64) -> Vec<f64> {
        (0..101).map(|i| shift + scale * WAVE[i % 2]).collect()
    }

    #[test]
    fn in_plane_bending_damages_fibres_in_that_plane() {
        let (segment, curve) = (segment(), curve());
        let (sine, cosine) = 60f64.to_radians().sin_cos();
        // a moment about the direction at 60 degrees pulls at 150 and 330
        let (one, other) = (record(1e5 * cosine, 0.0), record(1e5 * sine, 0.0));
        let tension = vec![1e6; 101];
        let node = NodeRecord { segment: &segment, curve: &curve, tension: &tension, bends: Some([&one, &other]) };
        let found =
            node_damage(&node, None, &TubeCircumference { points: 12, ..TubeCircumference::default() }).unwrap();
        let range = 2e5 * 0.15 / (std::f64::consts::PI / 64.0 * (0.3f64.powi(4) - 0.26f64.powi(4)));
        assert!((found.largest / range - 1.0).abs() < 1e-12);
        // S-N curve D in sea water with free corrosion: log10 a 11.687, slope 3 [DNV-RP-C203]
        let want = 50.0 * (range * 1e-6).powi(3) / 10f64.powf(11.687);
        assert!((found.damage / want - 1.0).abs() < 1e-12, "{found:?}");
        let degrees = found.angle.unwrap().to_degrees();
        assert!((degrees - 150.0).abs() < 1e-9 || (degrees - 330.0).abs() < 1e-9, "{degrees}");
        // stress twice as large, by the slope of 3
        let twice = node_damage(&node, None, &TubeCircumference { points: 12, concentration: 2.0 }).unwrap();
        assert!((twice.damage / found.damage - 8.0).abs() < 1e-9);
    }

    #[test]
    fn rotating_bend_damages_all_points_equally() {
        let (segment, curve) = (segment(), curve());
        let turn = |i: usize| std::f64::consts::TAU * i as f64 / 8.0;
        let one: Vec<f64> = (0..161).map(|i| 1e5 * turn(i).cos()).collect();
        let other: Vec<f64> = (0..161).map(|i| 1e5 * turn(i).sin()).collect();
        let tension = vec![1e6; 161];
        let node = NodeRecord { segment: &segment, curve: &curve, tension: &tension, bends: Some([&one, &other]) };
        let [first, all] = [1, 8].map(|points| {
            node_damage(&node, None, &TubeCircumference { points, ..TubeCircumference::default() }).unwrap()
        });
        // of twenty turns the part that is not whole differs from point to point
        assert!((all.damage / first.damage - 1.0).abs() < 0.05, "{first:?} {all:?}");
    }

    #[test]
    fn tube_in_tension_only_is_damaged_like_line_of_its_area() {
        let (segment, curve) = (segment(), curve());
        let (tension, still) = (record(2e5, 1e6), vec![0.0; 101]);
        let bends: Option<[&[f64]; 2]> = Some([&still, &still]);
        let node = NodeRecord { segment: &segment, curve: &curve, tension: &tension, bends };
        let thick = ThicknessCorrection { reference: 0.01, power: 0.25, most: 2.0 };
        for correction in [None, Some(&thick)] {
            let round = node_damage(&node, correction, &TubeCircumference::default()).unwrap();
            let line =
                node_damage(&NodeRecord { bends: None, ..node }, correction, &TubeCircumference::default()).unwrap();
            assert!((round.damage / line.damage - 1.0).abs() < 1e-9, "{round:?} {line:?}");
            assert!((round.largest / line.largest - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn chain_damage_uses_tension_ranges() {
        let segment = FatigueSegment { thickness: None, ..segment() };
        let curve = find("CHAIN", &FatigueSelection::default()).unwrap();
        let tension = record(1e5, 1e6);
        let node = NodeRecord { segment: &segment, curve: &curve, tension: &tension, bends: None };
        let found = node_damage(&node, None, &TubeCircumference::default()).unwrap();
        // [API-RP-2SK]: K 1000, M 3
        assert!((found.damage / (50.0 * 0.04f64.powi(3) / 1000.0) - 1.0).abs() < 1e-12);
        assert!((found.largest - 0.04).abs() < 1e-12 && found.angle.is_none());
    }

    #[test]
    fn invalid_fatigue_input_is_refused() {
        let (segment, curve) = (segment(), curve());
        let (tension, short) = (record(2e5, 1e6), vec![0.0; 100]);
        let bends: Option<[&[f64]; 2]> = Some([&short, &short]);
        let node = NodeRecord { segment: &segment, curve: &curve, tension: &tension, bends };
        assert!(node_damage(&node, None, &TubeCircumference::default()).is_err());
        let bends: Option<[&[f64]; 2]> = Some([&tension, &tension]);
        let node = NodeRecord { bends, ..node };
        assert!(node_damage(&node, None, &TubeCircumference { points: 0, ..TubeCircumference::default() }).is_err());
        assert!(
            node_damage(&node, None, &TubeCircumference { concentration: 0.0, ..TubeCircumference::default() })
                .is_err()
        );
    }
}
