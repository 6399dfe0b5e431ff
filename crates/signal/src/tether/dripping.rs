//! The rainflow of AQWATM-TETHER: one half cycle from each turning point to where its flow ends.
//!
//! The manual [AQWA-TETHER 3.7] says "rainflow method" and no more; the rules are those that reproduce the listing's fatigue
//! table [W-TOWED 6]. They are not those of [ASTM-E1049] ([`crate::rainflow`]): there the
//! effective stress ranges come out 2 to 5 % larger.

use crate::rainflow::reversals;

/// The range, in the series' unit, of the half cycle that begins at each turning point but the last, in their order; the first and the last value
/// of the series are turning points.
///
/// The flow from a turning point goes along the roof to the next one. It ends
/// - at the level of the turning point before its start, if an earlier flow drips from that one onto this roof;
/// - at a tip from which the series turns back beyond the flow's start;
/// - at a tip that the next roof on this side does not pass; else it drips on that roof and goes on.
pub fn half_cycles(values: &[f64]) -> Vec<f64> {
    ranges(&reversals(values))
}

fn ranges(points: &[f64]) -> Vec<f64> {
    // whether a flow goes on from the tip onto the next roof of its side
    let mut drips = vec![false; points.len()];
    let mut out = Vec::with_capacity(points.len().saturating_sub(1));
    for start in 0..points.len().saturating_sub(1) {
        let at = |position: usize| points.get(position).copied();
        let (Some(from), Some(next)) = (at(start), at(start + 1)) else { break };
        let before = start.checked_sub(1);
        if before.and_then(|b| drips.get(b)).copied().unwrap_or(false) {
            let level = before.and_then(at).unwrap_or(next);
            out.push((level - from).abs());
            continue;
        }
        let up = next > from;
        let beyond = |value: f64, than: f64| if up { value > than } else { value < than };
        let (mut tip, mut level) = (start + 1, next);
        while let (Some(back), Some(further)) = (at(tip + 1), at(tip + 2)) {
            if !beyond(back, from) || !beyond(further, level) {
                break;
            }
            if let Some(mark) = drips.get_mut(tip) {
                *mark = true;
            }
            (tip, level) = (tip + 2, further);
        }
        out.push((level - from).abs());
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_turning_point_except_last_starts_one_half_cycle() {
        let values: Vec<f64> =
            (0..500).map(|i| (f64::from(i) * 0.7).sin() + 0.4 * (f64::from(i) * 1.9).cos()).collect();
        assert_eq!(half_cycles(&values).len(), reversals(&values).len() - 1);
    }

    #[test]
    fn small_wave_on_flank_leaves_large_range_whole() {
        // 0 up to 5, back to 4, up to 10, down to 0: the flow from 0 drips at 5 and reaches 10; that from 4 ends at 5's level
        assert_eq!(half_cycles(&[0.0, 5.0, 4.0, 10.0, 0.0]), [10.0, 1.0, 1.0, 10.0]);
    }

    #[test]
    fn constant_series_gives_zero_half_cycles() {
        assert!(half_cycles(&[3.0, 3.0, 3.0]).is_empty());
        assert!(half_cycles(&[]).is_empty());
    }
}
