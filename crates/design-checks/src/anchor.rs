//! Anchors: holding capacity over load, and uplift.

use crate::codes::AnchorRule;
use crate::{CheckError, Verdict, above_zero, finite};

/// What a line does to its anchor: the largest values over the run (N). The friction of the line on the bottom is not in them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AnchorLoad {
    /// Horizontal pull.
    pub horizontal: f64,
    /// Vertical pull, up.
    pub vertical: f64,
}

/// A vertical pull below this share of the horizontal one is rounding of a line that lies on the bottom.
const UPLIFT_SHARE: f64 = 1e-9;

impl AnchorLoad {
    /// Whether it is pulled upward.
    pub fn is_uplifted(&self) -> bool {
        self.vertical > UPLIFT_SHARE * self.horizontal.abs()
    }

    /// The load as one force (N).
    pub fn resultant(&self) -> f64 {
        self.horizontal.hypot(self.vertical.max(0.0))
    }
}

/// What a check of an anchor came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AnchorCheck {
    /// Capacity over load; infinite without load.
    pub safety_factor: f64,
    /// What the code asks for.
    pub required: f64,
    /// Load times factor over capacity; it holds up to 1.
    pub utilisation: f64,
    /// Whether the anchor is pulled upward.
    pub uplift: bool,
    /// Whether it holds: uplift of an anchor that must have none fails.
    pub verdict: Verdict,
}

/// Checks a load in the direction of the rule against a holding capacity (N).
///
/// # Errors
/// A capacity that is not greater than zero, a load that is not finite.
pub fn check_anchor(load: &AnchorLoad, capacity: f64, rule: &AnchorRule) -> Result<AnchorCheck, CheckError> {
    above_zero("the holding capacity", capacity)?;
    finite("the horizontal pull", load.horizontal)?;
    finite("the vertical pull", load.vertical)?;
    let force = rule.direction.force(load);
    let utilisation = rule.factor * force / capacity;
    let uplift = load.is_uplifted();
    let held = Verdict::of(utilisation, rule.is_confirmed());
    let verdict = if uplift && !rule.kind.bears_uplift() { Verdict::Fail } else { held };
    Ok(AnchorCheck { safety_factor: capacity / force, required: rule.factor, utilisation, uplift, verdict })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::codes::{AnchorKind, Provenance, PullDirection, Sureness};

    fn rule(kind: AnchorKind, direction: PullDirection, factor: f64) -> AnchorRule {
        AnchorRule {
            kind,
            direction,
            factor,
            provenance: Provenance { sure: Sureness::SecondHand, ..Provenance::default() },
        }
    }

    #[test]
    fn holding_matches_hand_computation() {
        // pile, lateral 1.6: 1.6 2.5 / 5 = 0.8; axial 2.0 on 0.9 of 2 MN: 0.9
        let load = AnchorLoad { horizontal: 2.5e6, vertical: 0.9e6 };
        let side = check_anchor(&load, 5e6, &rule(AnchorKind::Pile, PullDirection::Lateral, 1.6)).unwrap();
        assert!((side.utilisation - 0.8).abs() < 1e-12 && side.safety_factor == 2.0 && side.verdict == Verdict::Pass);
        let up = check_anchor(&load, 2e6, &rule(AnchorKind::Pile, PullDirection::Axial, 2.0)).unwrap();
        assert!((up.utilisation - 0.9).abs() < 1e-12 && up.uplift);
    }

    #[test]
    fn uplift_of_drag_anchor_fails() {
        let drag = rule(AnchorKind::Drag, PullDirection::Lateral, 1.5);
        let pulled = AnchorLoad { horizontal: 1e6, vertical: 1e3 };
        assert_eq!(check_anchor(&pulled, 9e6, &drag).unwrap().verdict, Verdict::Fail);
        let flat = AnchorLoad { vertical: 1e-4, ..pulled };
        assert_eq!(check_anchor(&flat, 9e6, &drag).unwrap().verdict, Verdict::Pass);
        assert!(check_anchor(&flat, 0.0, &drag).is_err());
        assert!(check_anchor(&AnchorLoad { horizontal: f64::NAN, ..flat }, 1.0, &drag).is_err());
    }
}
