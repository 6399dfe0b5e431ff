//! The configuration of a whole line: at a given horizontal force or tension, or between two given ends.

use super::element::LinePiece;
use super::error::LineError;
use super::layout;
use super::line::{Line, MAX_MAGNITUDE};
use super::multi_segment::{LineSolution, MultiSegmentLine};
use super::search::{FunctionPoint, rising_root};
use super::state::LineState;

/// Largest accepted residual as a share of the tension at the fairlead.
pub(super) const RESIDUAL_TOLERANCE: f64 = 1e-9;

impl Line {
    /// The configuration in which the fairlead at elevation `fairlead` (m) is pulled with the horizontal force `force`
    /// (N, greater than zero).
    ///
    /// # Errors
    /// [`LineError`]; a state that is returned has been proven.
    pub fn at_horizontal_force(&self, force: f64, fairlead: f64) -> Result<LineState, LineError> {
        self.check_fairlead(fairlead)?;
        positive("the horizontal force", force)?;
        if !self.is_plain() {
            return layout::at_force(self, force, fairlead);
        }
        let found = self.solve_contact(force, fairlead, None).and_then(|rested| self.state(rested, None, fairlead));
        found.or_else(|error| layout::at_force(self, force, fairlead).map_err(|_| error))
    }

    /// The configuration in which the fairlead at elevation `fairlead` (m) is `x` >= 0 beside the anchor (m). When the
    /// line needs no horizontal force to reach so far, the state has none.
    ///
    /// # Errors
    /// [`LineError`]; a state that is returned has been proven.
    pub fn at_distance(&self, x: f64, fairlead: f64) -> Result<LineState, LineError> {
        self.between_ends(x, fairlead, None)
    }

    /// The same as [`Line::at_distance`], begun at a state of this line near it: the same answer, sooner.
    ///
    /// # Errors
    /// As [`Line::at_distance`].
    pub fn solve_warm_start(&self, x: f64, fairlead: f64, last: &LineState) -> Result<LineState, LineError> {
        self.between_ends(x, fairlead, Some(last)).or_else(|_| self.between_ends(x, fairlead, None))
    }

    fn between_ends(&self, x: f64, fairlead: f64, last: Option<&LineState>) -> Result<LineState, LineError> {
        self.check_fairlead(fairlead)?;
        if !(0.0..MAX_MAGNITUDE).contains(&x) {
            return Err(LineError::Value { what: "the horizontal distance", segment: 1, value: x });
        }
        let lost = |error: &LineError| matches!(error, LineError::NotConverged { .. } | LineError::Unproven { .. });
        if self.is_plain() {
            return match self.all_at_once(x, fairlead, last) {
                Err(error) if lost(&error) => layout::between_ends(self, x, fairlead, last).map_err(|_| error),
                found => found,
            };
        }
        layout::between_ends(self, x, fairlead, last)
    }

    /// The line between two ends over a flat and smooth bottom, all its contacts at once.
    fn all_at_once(&self, x: f64, fairlead: f64, last: Option<&LineState>) -> Result<LineState, LineError> {
        let last = last.filter(|s| s.laid.is_none());
        let chain = &self.chain;
        let least = chain.least;
        let weight: f64 = chain.elements.iter().map(|e| e.weight().abs()).sum();
        let start = (0.3 * weight).max(16.0 * least);
        let mut near: Option<LineSolution> = last.map(|s| s.rested.clone());
        let mut failed = None;
        let mut found: Option<LineSolution> = None;
        let begin = last.map_or(start, |last| {
            let h = last.rested.held.first().map_or(start, |held| held.h);
            // the reach changes with the force and with the height
            let [x_h, x_z] = last.rested.x_by;
            let risen = last.rested.z.first().map_or(0.0, |z| fairlead - self.datum() - z);
            let predicted = h + (x - last.rested.x - x_z * risen) / x_h;
            if predicted > 0.1 * h { predicted } else { h.max(least) }
        });
        let (_, steps) = rising_root(begin, x, |h| match self.solve_contact(h.max(least), fairlead, near.as_ref()) {
            Ok(rested) => {
                // without horizontal force nothing changes any more
                let limp = h <= least && rested.x >= x;
                let point = FunctionPoint { value: if limp { x } else { rested.x }, slope: rested.x_by[0] };
                near = Some(rested.clone());
                if found.as_ref().is_none_or(|f| (rested.x - x).abs() <= (f.x - x).abs()) {
                    found = Some(rested);
                }
                point
            }
            Err(error) => {
                failed = Some(error);
                FunctionPoint { value: f64::NAN, slope: f64::NAN }
            }
        });
        let Some(mut rested) = found else {
            return Err(failed.unwrap_or(LineError::NotConverged {
                force: start,
                residual: f64::NAN,
                iterations: steps,
            }));
        };
        // little may hang: without horizontal force means little against that
        let (h, hanging) = rested.held.first().map_or((0.0, 0.0), |held| (held.h, held.v_hi.abs()));
        if rested.x >= x && h <= least && hanging > least && hanging * 1e-11 < least {
            let finer = MultiSegmentLine { least: 1e-11 * hanging, ..chain.clone() };
            let [top, bottom] = self.heights(fairlead);
            rested = finer.solve_contact(finer.least, top, bottom, Some(&rested)).unwrap_or(rested);
        }
        rested.iterations += steps;
        match (self.state(rested, Some(x), fairlead), failed) {
            (Err(LineError::Unproven { .. }), Some(reason)) => Err(reason),
            (outcome, _) => outcome,
        }
    }

    /// The configuration in which the tension at the fairlead, at elevation `fairlead` (m), is `tension` (N).
    ///
    /// # Errors
    /// [`LineError`]; among them a tension less than that of the line hanging straight down.
    pub fn at_tension(&self, tension: f64, fairlead: f64) -> Result<LineState, LineError> {
        positive("the tension", tension)?;
        // T dT = H dH + V dV
        let by = |s: &LineState, turn: f64| (s.top_tension, (s.force + s.top_vertical * turn) / s.top_tension);
        self.at_value(("tension", tension), fairlead, 0.7 * tension, by)
    }

    /// The configuration in which the vertical force of the line on its fairlead, at elevation `fairlead` (m), is
    /// `vertical` (N, downward).
    ///
    /// # Errors
    /// [`LineError`]; among them a force less than that of the line hanging straight down.
    pub fn at_vertical_force(&self, vertical: f64, fairlead: f64) -> Result<LineState, LineError> {
        positive("the vertical force", vertical)?;
        self.at_value(("vertical force", vertical), fairlead, vertical, |s, turn| (s.top_vertical, turn))
    }

    /// The configuration in which a force that grows with the horizontal one is `wanted`; `by` gives it and its
    /// derivative by H, from a state and its dV/dH at a fixed elevation.
    fn at_value(
        &self,
        (what, wanted): (&'static str, f64),
        fairlead: f64,
        start: f64,
        by: impl Fn(&LineState, f64) -> (f64, f64),
    ) -> Result<LineState, LineError> {
        self.check_fairlead(fairlead)?;
        let at = |s: &LineState| by(s, s.stiffness[1][0] / s.stiffness[0][0]);
        let (force, _) = rising_root(start, wanted, |h| match self.at_horizontal_force(h, fairlead) {
            Ok(s) => {
                let (value, slope) = at(&s);
                FunctionPoint { value, slope }
            }
            Err(_) => FunctionPoint { value: f64::NAN, slope: f64::NAN },
        });
        let state = self.at_horizontal_force(force, fairlead)?;
        let off = (at(&state).0 - wanted).abs();
        if off <= RESIDUAL_TOLERANCE * wanted {
            return Ok(state);
        }
        if let Ok(hanging) = self.at_distance(0.0, fairlead)
            && by(&hanging, 0.0).0 > wanted
        {
            return Err(LineError::Weight { what, wanted, least: by(&hanging, 0.0).0 });
        }
        Err(LineError::Unproven { residual: off, tension: state.top_tension })
    }

    /// Heights of the fairlead and of the anchor above the bottom, or above the anchor where there is none (m).
    fn heights(&self, fairlead: f64) -> [f64; 2] {
        [fairlead - self.datum(), self.anchor - self.datum()]
    }

    fn solve_contact(&self, h: f64, fairlead: f64, near: Option<&LineSolution>) -> Result<LineSolution, LineError> {
        let [top, bottom] = self.heights(fairlead);
        if self.elements_see_bottom() && top < 0.0 {
            return Err(LineError::BelowBottom(-top));
        }
        let chain = &self.chain;
        let warm = chain.solve_contact(h, top, bottom, near);
        if warm.is_ok() {
            return warm;
        }
        // begun anew: with what is not lifted on the bottom, then with nothing there
        let cold = if near.is_some() { chain.solve_contact(h, top, bottom, None) } else { warm };
        cold.or_else(|error| chain.solve_contact(h, top, bottom, Some(&chain.afloat(h))).map_err(|_| error))
    }

    /// Whether the bottom carries the first piece.
    fn elements_see_bottom(&self) -> bool {
        let lengths = self.chain.elements.iter().filter_map(|e| match e {
            LinePiece::Length { sees_bottom, segment, .. } => Some(*sees_bottom && segment.weight > 0.0),
            LinePiece::Link(_) => None,
        });
        lengths.take(1).any(|sees| sees)
    }

    /// What a line made without [`Line::with_seabed`] has not been asked yet, and the fairlead.
    fn check_fairlead(&self, fairlead: f64) -> Result<(), LineError> {
        if fairlead.is_finite() {
            return self.check_pendants();
        }
        Err(LineError::Value { what: "the fairlead elevation", segment: 1, value: fairlead })
    }
}

fn positive(what: &'static str, value: f64) -> Result<(), LineError> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(LineError::Value { what, segment: 1, value })
}
