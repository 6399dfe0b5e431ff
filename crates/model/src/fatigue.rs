//! Fatigue as the user chose it: curves of `&REP_SELECT -SN`, the correction of `-THICK_SN`, and what a class reports of its
//! segments. The curves that windlass ships are not here: they belong to the post floor.

use super::Model;
use indexmap::IndexMap;
use std::f64::consts::FRAC_PI_4;
use windlass_base::choices;
use windlass_base::span::Span;

choices! {
    /// What the ranges of a fatigue curve are.
    pub enum FatigueKind {
        /// Stress.
        Stress = "STRESS",
        /// Tension over breaking tension.
        Tension = "TENSION",
    }
}

/// A user's fatigue curve.
#[derive(Clone, Debug, PartialEq)]
pub struct FatigueCurve {
    /// Its name as written.
    pub name: String,
    /// What its ranges are.
    pub kind: FatigueKind,
    /// Ranges (Pa, or tension over breaking tension), falling, with the cycles to failure.
    pub points: Vec<(f64, f64)>,
    /// Where it was defined.
    pub span: Span,
}

/// The correction of stress ranges for thickness, `MIN((t / TO)**POWER, MAXCOR)` [MOSES-REF sn_def, sn_bind, fatigue].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThicknessCorrection {
    /// TO (m).
    pub reference: f64,
    /// POWER.
    pub power: f64,
    /// MAXCOR.
    pub most: f64,
}

impl ThicknessCorrection {
    /// The factor on the stress range of a thickness (m), as the formula is written: a section thinner than the reference
    /// has one below 1.
    pub fn factor(&self, thickness: f64) -> f64 {
        (thickness / self.reference).powf(self.power).min(self.most)
    }
}

/// What `&REP_SELECT` has set.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FatigueSelection {
    /// Curves of the user, by name in capitals.
    pub curves: IndexMap<String, FatigueCurve>,
    /// The curves named last, in their order; a segment without `-C_SN` goes by the last of them.
    pub chosen: Vec<String>,
    /// `-THICK_SN`.
    pub thickness: Option<ThicknessCorrection>,
}

impl FatigueSelection {
    /// The name of the curve a segment goes by: its own, else the last that was chosen; `None` when there is neither.
    pub fn curve_of<'a>(&'a self, segment: &'a FatigueSegment) -> Option<&'a str> {
        segment.curve.as_deref().or(self.chosen.last().map(String::as_str))
    }

    /// A curve of the user.
    pub fn get(&self, name: &str) -> Option<&FatigueCurve> {
        self.curves.get(&Model::key(name))
    }
}

/// What fatigue goes by in a segment of line, SI.
#[derive(Clone, Debug, PartialEq)]
pub struct FatigueSegment {
    /// Its curve, `-C_SN`.
    pub curve: Option<String>,
    /// Breaking tension (N).
    pub breaking: f64,
    /// Whether it was given, and is not that of a bare diameter.
    pub break_is_given: bool,
    /// Outside diameter (m).
    pub od: f64,
    /// Wall thickness (m); `None` for a solid section.
    pub thickness: Option<f64>,
    /// Unstretched length (m).
    pub length: f64,
}

impl FatigueSegment {
    /// Area of the section (m2).
    pub fn area(&self) -> f64 {
        let inside = self.thickness.map_or(0.0, |t| (self.od - 2.0 * t).max(0.0));
        FRAC_PI_4 * (self.od * self.od - inside * inside)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn segment_curve_takes_precedence_over_last_chosen_curve() {
        let chosen = vec!["X".to_string(), "WIRE".to_string()];
        let selection = FatigueSelection { chosen, ..FatigueSelection::default() };
        let mut segment = FatigueSegment {
            curve: None,
            breaking: 1.0,
            break_is_given: true,
            od: 0.2,
            thickness: Some(0.1),
            length: 1.0,
        };
        assert_eq!(selection.curve_of(&segment), Some("WIRE"));
        segment.curve = Some("CHAIN".into());
        assert_eq!(selection.curve_of(&segment), Some("CHAIN"));
        assert_eq!(FatigueSelection::default().curve_of(&FatigueSegment { curve: None, ..segment.clone() }), None);
        // a wall of half the diameter is a solid bar
        assert!((segment.area() - FRAC_PI_4 * 0.04).abs() < 1e-15);
    }

    #[test]
    fn thickness_factor_matches_published_formula() {
        let t = ThicknessCorrection { reference: 0.025, power: 0.25, most: 1.3 };
        assert!((t.factor(0.05) - 2f64.powf(0.25)).abs() < 1e-15);
        assert_eq!(t.factor(1.0), 1.3);
        assert!(t.factor(0.0125) < 1.0);
    }
}
