//! A hydraulic piston that controls the tension of a line: where it stands at the end of a step.
//!
//! Source: [MOSES-FLEX -PISTON]. The piston is a rigid link of length s - LD between the first end and the line, along the tension: at its
//! nominal position it adds nothing. Readings where the manual is silent: VLONG and VSHORT are the fastest it goes, so that a limit is held
//! while it can follow and the tension departs from it while it cannot; of MAX the way back to LD is as fast as VSHORT allows without
//! passing TMAX; in statics it has all the time it needs, and starts at LD.

use super::{ControlState, Device, DeviceAction, DeviceKind, TensionControl};
use crate::options::{self as o, PistonKind};
use std::sync::Arc;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::spec::ValueKey;
use windlass_base::units::Dim;
use windlass_base::values::Given;
use windlass_model::{ClassError, Connection, Note};
use windlass_nonlinear::NewtonBracket;

/// -PISTON.
pub(super) static PISTON: DeviceKind = DeviceKind {
    option: &o::PISTON,
    check,
    read: |given| Piston::read(given).map(|piston| Arc::new(piston) as Arc<dyn Device>),
};

/// The nominal position is within the stroke, the tensions are in order.
///
/// # Errors
/// What contradicts itself, at its value.
fn check(given: &Given) -> Outcome<()> {
    const STROKE: ValueKey<f64> = o::PISTON.number("LT");
    const NOMINAL: ValueKey<f64> = o::PISTON.number("LD");
    const MAX_TENSION: ValueKey<f64> = o::PISTON.number("TMAX");
    const MIN_TENSION: ValueKey<f64> = o::PISTON.number("TMIN");
    if let (Some(stroke), Some(nominal)) = (given.number(STROKE), given.number(NOMINAL))
        && nominal > stroke
    {
        return Err(Diagnostic::error(
            "the nominal position LD of -PISTON lies beyond its stroke LT",
            given.position(NOMINAL),
        ));
    }
    match (given.choice(const { o::PISTON.choice("TYPE") }), given.number(MAX_TENSION), given.number(MIN_TENSION)) {
        (Some(o::PistonKind::MinMax), _, None) => Err(Diagnostic::error("-PISTON MINMAX needs TMIN", given.span)),
        (_, Some(most), Some(least)) if least >= most => {
            Err(Diagnostic::error("TMIN of -PISTON must be smaller than TMAX", given.position(MIN_TENSION)))
        }
        _ => Ok(()),
    }
}

/// What a table or a shape of a line with a piston says of it.
const NOMINAL: &str = "here the piston of -PISTON stands at its nominal position";

/// Most evaluations of a search.
const MAX_EVALUATIONS: usize = 200;
/// How near a held tension comes to its limit, as a share of it.
const TENSION_TOLERANCE: f64 = 1e-11;
/// How far off it may be where the line leaves no better.
const ACCEPTED_TENSION_ERROR: f64 = 1e-8;

/// A piston; positions from 0, the shortest, to its stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piston {
    /// MINMAX: holds TMIN too, and stays where it is between the limits. Else MAX: goes back to its nominal position.
    both: bool,
    /// Total stroke LT (m).
    stroke: f64,
    /// Nominal position LD (m).
    nominal: f64,
    /// Largest velocity of lengthening (m/s).
    lengthening: f64,
    /// Largest velocity of shortening (m/s).
    shortening: f64,
    /// TMAX (N).
    most: f64,
    /// TMIN (N).
    least: f64,
}

/// What a piston does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum PistonState {
    /// The tension is within its limits; the piston stays, or is on its way back.
    Nothing,
    /// It holds TMAX.
    HoldsMost,
    /// It holds TMIN.
    HoldsLeast,
    /// It cannot follow: the tension is beyond TMAX.
    LagsMost,
    /// It cannot follow: the tension is below TMIN.
    LagsLeast,
    /// It is at the end of its stroke, the tension beyond TMAX.
    StopsLong,
    /// It is shortest, the tension below TMIN.
    StopsShort,
}

impl PistonState {
    /// Whether the tension is what a limit says, so that the line has no stiffness along it.
    fn is_holding(self) -> bool {
        matches!(self, PistonState::HoldsMost | PistonState::HoldsLeast)
    }

    /// What is reported to the user.
    fn note(self) -> Note {
        let text = match self {
            PistonState::Nothing => {
                "the piston is at rest or on its way to its nominal position, the tension within its limits"
            }
            PistonState::HoldsMost => "the piston holds TMAX; the line has no stiffness along its tension",
            PistonState::HoldsLeast => "the piston holds TMIN; the line has no stiffness along its tension",
            PistonState::LagsMost => "the piston cannot lengthen fast enough; the tension is beyond TMAX",
            PistonState::LagsLeast => "the piston cannot shorten fast enough; the tension is below TMIN",
            PistonState::StopsLong => "the piston is at the end of its stroke; the tension is beyond TMAX",
            PistonState::StopsShort => "the piston is at its shortest; the tension is below TMIN",
        };
        match self {
            PistonState::Nothing | PistonState::HoldsMost | PistonState::HoldsLeast => text.into(),
            _ => Note::warning(text),
        }
    }
}

impl Device for Piston {
    fn action(&self, _: &Connection) -> Result<DeviceAction, ClassError> {
        Ok(DeviceAction::Control(Box::new(*self)))
    }

    fn note(&self) -> Option<Note> {
        Some(NOMINAL.into())
    }
}

impl TensionControl for Piston {
    fn nominal(&self) -> f64 {
        self.nominal
    }

    fn find_position(
        &self,
        before: f64,
        dt: Option<f64>,
        at: &mut dyn FnMut(f64) -> Result<(f64, f64), ClassError>,
    ) -> Result<(f64, ControlState), ClassError> {
        let (position, does) = self.find_position(before, dt, at)?;
        Ok((position, ControlState { holds: does.is_holding(), note: does.note() }))
    }
}

/// A place of the piston with the tension there (N) and its derivative by the position (N/m, not above zero).
#[derive(Clone, Copy, Debug, PartialEq)]
struct OperatingPoint {
    position: f64,
    tension: f64,
    slope: f64,
}

impl Piston {
    /// From the values of its option, which [`check`] has checked.
    fn read(given: &Given) -> Option<Piston> {
        Some(Piston {
            both: given.choice(const { o::PISTON.choice("TYPE") }) == Some(PistonKind::MinMax),
            stroke: given.number(const { o::PISTON.number("LT") })?,
            nominal: given.number(const { o::PISTON.number("LD") })?,
            lengthening: given.number(const { o::PISTON.number("VLONG") })?,
            shortening: given.number(const { o::PISTON.number("VSHORT") })?,
            most: given.number(const { o::PISTON.number("TMAX") })?,
            least: given.number(const { o::PISTON.number("TMIN") }).unwrap_or(0.0),
        })
    }

    /// The position at the end of a step (s; `None`: in statics) that began at another, and what it does there. `at` gives tension and
    /// slope at a position; the tension falls, or stays, as the piston lengthens.
    ///
    /// All of it is a function of where the step began and where the ends are now: there is no switch that could chatter.
    ///
    /// # Errors
    /// A position at which the line has no answer; a limit that no position holds.
    fn find_position(
        &self,
        before: f64,
        dt: Option<f64>,
        mut at: impl FnMut(f64) -> Result<(f64, f64), ClassError>,
    ) -> Result<(f64, PistonState), ClassError> {
        let from = dt.map_or(self.nominal, |_| before).clamp(0.0, self.stroke);
        let reach = |speed: f64| dt.map_or(f64::INFINITY, |dt| speed * dt);
        let longest = (from + reach(self.lengthening)).min(self.stroke);
        let shortest = (from - reach(self.shortening)).max(if self.both { 0.0 } else { self.nominal.min(from) });
        let mut met = |position: f64| at(position).map(|(tension, slope)| OperatingPoint { position, tension, slope });
        // MAX stands as short as TMAX lets it
        let start = met(if self.both { from } else { shortest })?;
        if start.tension > self.most {
            let (found, held) = seek(&mut met, start, longest, self.most)?;
            let stopped = if longest >= self.stroke { PistonState::StopsLong } else { PistonState::LagsMost };
            return Ok((found, if held { PistonState::HoldsMost } else { stopped }));
        }
        if self.both && start.tension < self.least {
            let (found, held) = seek(&mut met, start, shortest, self.least)?;
            let stopped = if shortest <= 0.0 { PistonState::StopsShort } else { PistonState::LagsLeast };
            return Ok((found, if held { PistonState::HoldsLeast } else { stopped }));
        }
        Ok((start.position, PistonState::Nothing))
    }
}

/// From a place whose tension is not the wanted one toward an end of the way: the position that has it, or the end.
fn seek(
    met: &mut impl FnMut(f64) -> Result<OperatingPoint, ClassError>,
    start: OperatingPoint,
    end: f64,
    wanted: f64,
) -> Result<(f64, bool), ClassError> {
    let side = (start.tension - wanted).signum();
    let close = TENSION_TOLERANCE * (wanted + start.tension.abs());
    let toward = (end - start.position).signum();
    // open toward the end, where nothing has been met yet
    let mut bracket = NewtonBracket::OPEN;
    let mut at = start;
    for _ in 0..MAX_EVALUATIONS {
        let off = at.tension - wanted;
        if off.abs() <= close {
            return Ok((at.position, true));
        }
        if off * side > 0.0 && at.position == end {
            return Ok((end, false));
        }
        bracket.record(at.position, -off * side * toward);
        let newton = at.position - off / at.slope;
        let before_end = (end - newton) * toward > 0.0;
        let next = bracket.step(if before_end { newton } else { f64::NAN }, || end);
        if bracket.is_closed() && (next == bracket.low || next == bracket.high) {
            break;
        }
        at = met(next)?;
    }
    if (at.tension - wanted).abs() <= ACCEPTED_TENSION_ERROR * (wanted + start.tension.abs()) {
        return Ok((at.position, true));
    }
    let text = "the piston finds no position that holds {}; the nearest tension is {}";
    Err(ClassError::with_values(text, &[(wanted, Dim::Force), (at.tension, Dim::Force)]))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// A spring of 1000 N/m that only pulls, stretched by `stretch` when the piston is at its nominal position.
    fn spring(stretch: f64) -> impl FnMut(f64) -> Result<(f64, f64), ClassError> {
        move |s| {
            let taut = stretch - (s - 1.0);
            Ok(if taut > 0.0 { (1000.0 * taut, -1000.0) } else { (0.0, 0.0) })
        }
    }

    const EXAMPLE: Piston =
        Piston { both: true, stroke: 3.0, nominal: 1.0, lengthening: 0.5, shortening: 0.25, most: 800.0, least: 300.0 };

    #[test]
    fn piston_step_is_bounded_by_limit_and_velocity() {
        let after = |both: bool, before: f64, stretch: f64| {
            let (s, does) = Piston { both, ..EXAMPLE }.find_position(before, Some(1.0), spring(stretch)).unwrap();
            ((s * 1e9).round() / 1e9, does)
        };
        // between the limits; held at TMAX; too fast; at the end of the stroke
        assert_eq!(after(true, 1.0, 0.5), (1.0, PistonState::Nothing));
        assert_eq!(after(true, 1.0, 1.0), (1.2, PistonState::HoldsMost));
        assert_eq!(after(true, 1.0, 2.0), (1.5, PistonState::LagsMost));
        assert_eq!(after(true, 2.8, 9.0), (3.0, PistonState::StopsLong));
        // TMIN: held; too fast; slack as well; shortest
        assert_eq!(after(true, 1.0, 0.2), (0.9, PistonState::HoldsLeast));
        assert_eq!(after(true, 1.0, -0.2), (0.75, PistonState::LagsLeast));
        assert_eq!(after(true, 0.1, -5.0), (0.0, PistonState::StopsShort));
        // MINMAX stays where it is, MAX goes back: as fast as it may, no shorter than LD, no tenser than TMAX
        assert_eq!(after(true, 2.0, 1.5), (2.0, PistonState::Nothing));
        assert_eq!(after(false, 2.0, 1.5), (1.75, PistonState::Nothing));
        assert_eq!(after(false, 1.1, 0.5), (1.0, PistonState::Nothing));
        assert_eq!(after(false, 2.0, 1.7), (1.9, PistonState::HoldsMost));
        assert_eq!(after(false, 1.0, -0.5), (1.0, PistonState::Nothing));
    }

    #[test]
    fn static_piston_slides_from_nominal_position_as_needed() {
        let at_rest = |both: bool, stretch: f64| {
            let (s, does) = Piston { both, ..EXAMPLE }.find_position(2.5, None, spring(stretch)).unwrap();
            ((s * 1e9).round() / 1e9, does)
        };
        assert_eq!(at_rest(true, 0.5), (1.0, PistonState::Nothing));
        assert_eq!(at_rest(true, 2.0), (2.2, PistonState::HoldsMost));
        assert_eq!(at_rest(false, 9.0), (3.0, PistonState::StopsLong));
        assert_eq!(at_rest(true, -0.4), (0.3, PistonState::HoldsLeast));
        assert_eq!(at_rest(true, -2.0), (0.0, PistonState::StopsShort));
        assert_eq!(at_rest(false, -2.0), (1.0, PistonState::Nothing));
    }
}
