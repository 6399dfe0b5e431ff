//! The quantities that stability criteria ask for, of a table of righting and heeling arms.
//!
//! Source: [MOSES-REF stab_ok]. R(a) and H(a) are the righting and the heeling arm, RA(a) and HA(a) the areas under them from the
//! equilibrium without wind to a. All angles but that of the equilibrium are from there. Crossings, the peak and areas are found with
//! balances of their own, and are not read between the steps of the table.

use super::arms::{ArmPoint, Arms};
use windlass_model::ClassError;
use windlass_nonlinear::{BracketedRoot, Halvings};

/// Width to which a crossing is found (rad).
const ANGLE_TOLERANCE: f64 = 1e-10;
/// Most evaluations of a crossing.
const MAX_ROOT_EVALUATIONS: usize = 80;
/// Most evaluations of the search for the peak: its interval shrinks to 0.618 of itself with each.
const MAX_PEAK_EVALUATIONS: usize = 40;
/// Most steps of the table to the other side on which an equilibrium is looked for.
const MAX_STEPS_BACK: usize = 90;
/// An arm that is none (m).
const NO_ARM: f64 = 1e-9;
/// Width to which a greatest height is found, as a share of the range it is looked for in.
const HEIGHT_TOLERANCE: f64 = 1e-8;
/// Most heights that are tried.
const MAX_HEIGHTS: usize = 80;

/// A quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Metacentric height at the equilibrium (m).
    MetacentricHeight,
    /// Height of the lowest point that is not weathertight at the equilibrium (m).
    DownFloodingHeight,
    /// The equilibrium without wind (rad, from upright).
    Equilibrium,
    /// The first angle at which R = H (rad).
    FirstIntercept,
    /// The second angle at which R = H (rad).
    SecondIntercept,
    /// The second angle at which R = 0 (rad).
    Range,
    /// Range less a factor times the equilibrium (rad).
    RangeLessEquilibrium,
    /// The angle at which a point that is not weathertight goes under water (rad).
    DownFloodingAngle,
    /// That less the first intercept (rad).
    DownFloodingLessFirst,
    /// The angle at which a weathertight point goes under water less the first intercept (rad).
    WeathertightLessFirst,
    /// Second less first intercept (rad).
    InterceptDifference,
    /// The angle of the greatest righting arm (rad).
    PeakAngle,
    /// RA / HA, both to the second intercept or the down-flooding angle.
    AreaRatio,
    /// RA / HA, both to the second intercept, the down-flooding angle or 30 degrees.
    AreaRatioTo30,
    /// The area between R and H from the first intercept to the second one or down-flooding, over that between H and R from a roll
    /// angle to windward of the first intercept up to it.
    WaveAreaRatio,
    /// R over H at the greatest righting arm.
    ArmRatio,
    /// RA(T) - RA(first) - (HA(T) - HA(first)), T being the down-flooding angle or the second intercept (m rad).
    ResidualArea,
    /// The greatest righting arm at 30 degrees or more (m).
    ArmBeyond30,
    /// R(30 degrees) (m).
    ArmAt30,
    /// RA at the second intercept (m rad).
    AreaToSecond,
    /// The lesser of RA at the down-flooding angle and at the second intercept (m rad).
    AreaToFlooding,
    /// RA at the angle of the greatest righting arm (m rad).
    AreaToPeak,
    /// RA at 30 degrees (m rad).
    AreaTo30,
    /// RA at 40 degrees or the down-flooding angle (m rad).
    AreaTo40,
    /// RA between 30 degrees and 40 degrees or the down-flooding angle (m rad).
    AreaFrom30To40,
}

/// What criteria ask of a table of arms.
#[derive(Debug)]
pub struct Stability<'a> {
    arms: &'a Arms<'a>,
    /// The equilibrium without wind (rad, from upright).
    pub equilibrium: f64,
    /// The arms there.
    at_rest: ArmPoint,
    /// First and second angle at which R = H (rad, from upright).
    intercepts: [Option<f64>; 2],
    /// The second angle at which R = 0 (rad, from upright).
    vanishing: Option<f64>,
    /// The angle of the greatest righting arm (rad, from upright).
    peak: f64,
    /// Angles at which a point that is not weathertight, and one that is, goes under water (rad, from upright).
    flooding: [Option<f64>; 2],
}

impl<'a> Stability<'a> {
    /// Finds the crossings of a table.
    ///
    /// # Errors
    /// No equilibrium, or a balance that is not found.
    pub fn from_arms(arms: &'a Arms<'a>) -> Result<Self, ClassError> {
        let equilibrium = find_equilibrium(arms)?;
        let at_rest = arms.evaluate(equilibrium)?;
        let net = |row: &ArmPoint| row.righting - row.heeling;
        let first = if net(&at_rest) >= -NO_ARM {
            Some(equilibrium)
        } else {
            find_crossing(arms, equilibrium, |row| -net(row))?
        };
        let behind = |angle: f64, value: &dyn Fn(&ArmPoint) -> f64| find_crossing(arms, angle, value);
        let second = first.map(|first| behind(first, &net)).transpose()?.flatten();
        let vanishing = behind(equilibrium, &|row| row.righting)?;
        let flooding = |kind: usize| {
            let height =
                move |row: &ArmPoint| row.heights.get(kind).copied().flatten().map_or(1.0, |(height, _)| height);
            if height(&at_rest) <= 0.0 { Ok(Some(equilibrium)) } else { behind(equilibrium, &height) }
        };
        Ok(Stability {
            arms,
            equilibrium,
            at_rest,
            intercepts: [first, second],
            vanishing,
            peak: find_peak(arms, equilibrium)?,
            flooding: [flooding(0)?, flooding(1)?],
        })
    }

    /// Whether an angle that a quantity needs lies beyond the table, whose end stands for it.
    pub fn is_cut_short(&self, quantity: Quantity) -> bool {
        let ends_with_arms = self.intercepts[1].is_none() && self.flooding[0].is_none();
        match quantity {
            Quantity::Range | Quantity::RangeLessEquilibrium => self.vanishing.is_none(),
            Quantity::SecondIntercept | Quantity::InterceptDifference | Quantity::AreaToSecond => {
                self.intercepts[1].is_none()
            }
            Quantity::DownFloodingAngle | Quantity::DownFloodingLessFirst => self.flooding[0].is_none(),
            Quantity::WeathertightLessFirst => self.flooding[1].is_none(),
            Quantity::AreaRatio | Quantity::ResidualArea | Quantity::AreaToFlooding | Quantity::WaveAreaRatio => {
                ends_with_arms
            }
            Quantity::AreaRatioTo30 => ends_with_arms && self.end() < self.equilibrium + 30f64.to_radians(),
            Quantity::PeakAngle => self.peak >= self.end(),
            _ => false,
        }
    }

    /// The last angle of the table (rad, from upright).
    fn end(&self) -> f64 {
        self.arms.rows.last().map_or(0.0, |row| row.angle)
    }

    /// A quantity; `second` is the factor of the equilibrium or the roll angle to windward (rad) where it needs one. `None` of one that does
    /// not exist: without wind, down-flooding points, or an intercept, or beyond the table.
    ///
    /// # Errors
    /// A balance that is not found.
    pub fn value(&self, quantity: Quantity, second: f64) -> Result<Option<f64>, ClassError> {
        let (rest, end) = (self.equilibrium, self.end());
        let from_rest = |angle: Option<f64>| angle.map(|angle| angle - rest);
        let area = |to: f64| self.arms.area_between(rest, to);
        let [first, other] = self.intercepts;
        let down = self.flooding[0];
        // the angle at which righting ends
        let last = other.unwrap_or(end).min(down.unwrap_or(end));
        let degrees = |angle: f64| rest + angle.to_radians();
        let within = |angle: f64| (angle <= end * (1.0 + 1e-12)).then_some(angle.min(end));
        let ratio = |to: f64| -> Result<Option<f64>, ClassError> {
            let [righting, heeling] = area(to)?;
            Ok((heeling > 0.0).then(|| righting / heeling))
        };
        let righting = |to: Option<f64>| to.map(|to| Ok::<f64, ClassError>(area(to)?[0])).transpose();
        Ok(match quantity {
            Quantity::MetacentricHeight => Some(self.arms.body.metacentric_height(&self.at_rest.balance.attitude)?),
            Quantity::DownFloodingHeight => self.at_rest.heights[0].map(|(height, _)| height),
            Quantity::Equilibrium => Some(rest),
            Quantity::FirstIntercept => from_rest(first),
            Quantity::SecondIntercept => first.map(|_| other.unwrap_or(end) - rest),
            Quantity::Range => Some(self.vanishing.unwrap_or(end) - rest),
            Quantity::RangeLessEquilibrium => Some(self.vanishing.unwrap_or(end) - rest - second * rest),
            Quantity::DownFloodingAngle => self.has_points(false).then(|| down.unwrap_or(end) - rest),
            Quantity::DownFloodingLessFirst => {
                first.filter(|_| self.has_points(false)).map(|first| down.unwrap_or(end) - first)
            }
            Quantity::WeathertightLessFirst => {
                first.filter(|_| self.has_points(true)).map(|first| self.flooding[1].unwrap_or(end) - first)
            }
            Quantity::InterceptDifference => first.map(|first| other.unwrap_or(end) - first),
            Quantity::PeakAngle => Some(self.peak - rest),
            Quantity::AreaRatio => first.map(|_| ratio(last)).transpose()?.flatten(),
            Quantity::AreaRatioTo30 => first.map(|_| ratio(last.min(degrees(30.0)))).transpose()?.flatten(),
            Quantity::WaveAreaRatio => match first {
                None => None,
                Some(first) => {
                    let [righting, heeling] = self.arms.area_between(first, last)?;
                    let [back, pushed] = self.arms.area_between(first - second, first)?;
                    (pushed - back > 0.0).then(|| (righting - heeling) / (pushed - back))
                }
            },
            Quantity::ArmRatio => {
                let row = self.arms.evaluate(self.peak)?;
                (row.heeling > 0.0).then(|| row.righting / row.heeling)
            }
            Quantity::ResidualArea => match first {
                None => None,
                Some(first) => {
                    let [righting, heeling] = self.arms.area_between(first, last)?;
                    Some(righting - heeling)
                }
            },
            Quantity::ArmBeyond30 => match within(degrees(30.0)) {
                Some(from) if from > self.peak => Some(self.arms.evaluate(from)?.righting),
                Some(_) => Some(self.arms.evaluate(self.peak)?.righting),
                None => None,
            },
            Quantity::ArmAt30 => {
                within(degrees(30.0)).map(|at| self.arms.evaluate(at)).transpose()?.map(|row| row.righting)
            }
            Quantity::AreaToSecond => righting(first.map(|_| other.unwrap_or(end)))?,
            Quantity::AreaToFlooding => righting(first.map(|_| last))?,
            Quantity::AreaToPeak => righting(Some(self.peak))?,
            Quantity::AreaTo30 => righting(within(degrees(30.0)))?,
            Quantity::AreaTo40 => righting(within(degrees(40.0).min(down.unwrap_or(f64::INFINITY))))?,
            Quantity::AreaFrom30To40 => match within(degrees(40.0).min(down.unwrap_or(f64::INFINITY))) {
                Some(to) => {
                    let from = degrees(30.0).min(to);
                    Some(self.arms.area_between(from, to)?[0])
                }
                None => None,
            },
        })
    }

    fn has_points(&self, weathertight: bool) -> bool {
        self.arms.points.iter().any(|point| point.is_weathertight == weathertight)
    }
}

/// The greatest height (m) between two at which a margin is not negative, where it falls with the height; none where it is negative at the
/// lowest. A margin that does not exist counts as negative.
///
/// # Errors
/// What the margin says.
pub fn find_greatest_height(
    [low, high]: [f64; 2],
    margin: impl Fn(f64) -> Result<Option<f64>, ClassError>,
) -> Result<Option<f64>, ClassError> {
    let failure = -(high - low).abs();
    let tolerance = HEIGHT_TOLERANCE * (high - low);
    let below_high = high - tolerance;
    let (at_low, at_high) = (margin(low)?.unwrap_or(failure), margin(below_high)?.unwrap_or(failure));
    if at_high >= 0.0 {
        return Ok(Some(high));
    }
    if at_low < 0.0 {
        return Ok(None);
    }
    let mut root = BracketedRoot::new([low, below_high], [at_low, at_high], Halvings::EveryThird);
    for _ in 0..MAX_HEIGHTS {
        let Some(next) = root.propose() else { break };
        root.record(next, margin(next)?.unwrap_or(failure));
        if root.width() <= tolerance {
            break;
        }
    }
    Ok(Some(root.ends()[0]))
}

/// The equilibrium without wind: where the righting arm grows through zero, from upright on or, where the body leans the other way, back.
fn find_equilibrium(arms: &Arms) -> Result<f64, ClassError> {
    let Some(first) = arms.rows.first() else { return Err(ClassError::new("the table of arms has no row")) };
    if first.righting.abs() <= NO_ARM {
        // upright is an equilibrium; an unstable one has the body loll
        let leans = arms.rows.get(1).is_some_and(|row| row.righting < -NO_ARM);
        if !leans {
            return Ok(first.angle);
        }
    }
    if first.righting > NO_ARM {
        let mut near = *first;
        for _ in 0..MAX_STEPS_BACK {
            let far = arms.evaluate(near.angle - arms.step.abs())?;
            if far.righting <= 0.0 {
                return refine(arms, &far, &near, |row| row.righting);
            }
            near = far;
        }
    } else {
        for pair in arms.rows.windows(2) {
            let [near, far] = pair else { continue };
            if near.righting <= 0.0 && far.righting > 0.0 && (near.righting < -NO_ARM || near.angle > first.angle) {
                return refine(arms, near, far, |row| row.righting);
            }
        }
    }
    Err(ClassError::new(format!("{} has no equilibrium in the rolls of the table", arms.body.name))
        .help("more or larger steps of roll reach further"))
}

/// The first angle behind another at which a value falls through zero.
fn find_crossing(arms: &Arms, behind: f64, value: impl Fn(&ArmPoint) -> f64) -> Result<Option<f64>, ClassError> {
    let start = arms.evaluate(behind)?;
    let later: Vec<ArmPoint> = arms.rows.iter().filter(|row| row.angle > behind + ANGLE_TOLERANCE).copied().collect();
    let mut near = start;
    let mut was_positive = value(&start) > NO_ARM;
    for far in later {
        // at a crossing itself the value is zero: what matters is its sign behind it
        if was_positive && value(&far) <= 0.0 {
            return refine(arms, &near, &far, value).map(Some);
        }
        was_positive |= value(&far) > 0.0;
        near = far;
    }
    Ok(None)
}

/// The angle between two rows at which a value of opposite signs is zero.
fn refine(arms: &Arms, near: &ArmPoint, far: &ArmPoint, value: impl Fn(&ArmPoint) -> f64) -> Result<f64, ClassError> {
    let mut root = BracketedRoot::new([near.angle, far.angle], [value(near), value(far)], Halvings::EveryThird);
    for _ in 0..MAX_ROOT_EVALUATIONS {
        let Some(next) = root.propose() else { break };
        root.record(next, value(&arms.evaluate(next)?));
        if root.width() <= ANGLE_TOLERANCE {
            break;
        }
    }
    Ok(root.best().0)
}

/// The angle of the greatest righting arm behind the equilibrium: by golden sections between the rows beside the greatest.
fn find_peak(arms: &Arms, equilibrium: f64) -> Result<f64, ClassError> {
    let share = 0.5 * (5f64.sqrt() - 1.0);
    let rows: Vec<&ArmPoint> = arms.rows.iter().filter(|row| row.angle >= equilibrium).collect();
    let best = rows.iter().enumerate().max_by(|a, b| a.1.righting.total_cmp(&b.1.righting)).map(|(n, _)| n);
    let Some((best, row)) = best.and_then(|n| Some((n, *rows.get(n)?))) else { return Ok(equilibrium) };
    let Some(next) = rows.get(best + 1) else { return Ok(row.angle) };
    let before = best.checked_sub(1).and_then(|n| rows.get(n)).map_or(equilibrium, |row| row.angle);
    let (mut low, mut high) = (before, next.angle);
    let inner = |low: f64, high: f64| [high - share * (high - low), low + share * (high - low)];
    let arm = |angle: f64| arms.evaluate(angle).map(|row| row.righting);
    let [mut a, mut b] = inner(low, high);
    let (mut at_a, mut at_b) = (arm(a)?, arm(b)?);
    for _ in 0..MAX_PEAK_EVALUATIONS {
        if at_a > at_b {
            (high, b, at_b) = (b, a, at_a);
            a = inner(low, high)[0];
            at_a = arm(a)?;
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = inner(low, high)[1];
            at_b = arm(b)?;
        }
    }
    Ok(0.5 * (low + high))
}
