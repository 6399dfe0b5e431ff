//! Righting and heeling arms of a body rolled in steps, with the areas under them and the heights of its down-flooding points.
//!
//! Source: [MOSES-REF rarm], [MOSES-HELP hystat]. Angles grow in the direction the body is rolled; a righting arm is positive where it
//! turns the body back, a heeling arm where it turns it on. The wind blows across the roll axis, onto the side that rises.

use super::balance::{Attitude, BalanceLimits, BalancedBody, StillBody};
use crate::{BodyLoad, Category, Floating};
use nalgebra::Vector3;
use windlass_base::pose::Six;
use windlass_model::{Body, ClassError, Current, Environment, HoleKind, Model, Wind};

/// Speed of the current whose drag is scaled to hold the wind (m/s): drag is quadratic, so that any will do.
const TRIAL_CURRENT: f64 = 1.0;

/// A point by which water comes in when it is under water.
#[derive(Clone, Debug, PartialEq)]
pub struct DownFloodingPoint {
    /// The name of its hole.
    pub name: String,
    /// Where it is, in the body (m).
    pub at: Vector3<f64>,
    /// Whether it keeps water out.
    pub is_weathertight: bool,
}

/// The down-flooding points of a body: its holes with a point. Vents and vent valves are not weathertight, watertight vents are; mast vents
/// never come under water and flood valves are closed.
pub fn find_down_flooding_points(model: &Model, body: &Body) -> Vec<DownFloodingPoint> {
    let found = |hole: &windlass_model::Hole| {
        let is_weathertight = match hole.kind {
            HoleKind::Vent | HoleKind::VentValve => false,
            HoleKind::WatertightVent => true,
            HoleKind::MastVent | HoleKind::FloodValve => return None,
        };
        let point = model.points.get(&Model::key(hole.point.as_ref()?))?;
        let part = model.parts.get(&Model::key(&point.part))?;
        let own = Model::key(&part.body) == Model::key(&body.name);
        let at = Vector3::from(part.position.apply(point.at));
        own.then(|| DownFloodingPoint { name: hole.name.clone(), at, is_weathertight })
    };
    model.holes.values().filter_map(found).collect()
}

/// What holds the body against the wind.
#[derive(Debug)]
pub enum ResistanceCentre {
    /// A force through the center of buoyancy.
    Buoyancy,
    /// A force through a point of the body (m).
    Point(Vector3<f64>),
    /// The drag of a current as strong as to hold the wind: at each roll, or of the speed it has upright.
    Current {
        /// The drag of the trial current.
        drag: Vec<Box<dyn BodyLoad>>,
        /// Whether it keeps the speed it has upright.
        is_initial: bool,
    },
}

/// What heels the body.
#[derive(Debug)]
pub struct Heeling {
    wind: Vec<Box<dyn BodyLoad>>,
    centre: ResistanceCentre,
    /// The horizontal direction the wind blows toward.
    toward: Vector3<f64>,
}

impl Heeling {
    /// A wind of a speed (m/s, as `&ENV -WIND`) across the roll axis of an attitude, onto the side that rises as the body rolls by
    /// positive (`side` 1) or negative angles (-1). With its profile and design wind of the environment in force.
    ///
    /// # Errors
    /// A wind that cannot be computed.
    pub fn from_wind(
        model: &Model,
        body: &Body,
        speed: f64,
        side: f64,
        attitude: &Attitude,
        centre: ResistanceCentre,
    ) -> Result<Self, ClassError> {
        let toward = downwind(attitude, side);
        let direction = (-toward.y).atan2(-toward.x);
        let wind = loads_in(
            model,
            body,
            Category::Wind,
            Environment { wind: Some(Wind { speed, direction }), ..calm(&model.environment) },
        )?;
        Ok(Heeling { wind, centre, toward })
    }

    /// The drag of a current against that wind.
    ///
    /// # Errors
    /// Loads that contradict themselves.
    pub fn drag_of_current(
        model: &Model,
        body: &Body,
        side: f64,
        attitude: &Attitude,
    ) -> Result<Vec<Box<dyn BodyLoad>>, ClassError> {
        let toward = downwind(attitude, side);
        let current = Current::Uniform { velocity: TRIAL_CURRENT, direction: toward.y.atan2(toward.x) };
        loads_in(model, body, Category::ViscousDrag, Environment { current: Some(current), ..calm(&model.environment) })
    }

    /// The moment about the roll axis (N m, positive for a positive roll), and the factor of the trial current.
    fn moment(&self, body: &StillBody, at: &Attitude, factor: Option<f64>) -> Result<(f64, f64), ClassError> {
        let pose = at.pose();
        let sum = |loads: &[Box<dyn BodyLoad>]| {
            loads.iter().try_fold(Six::zeros(), |sum, load| Ok::<_, ClassError>(sum + load.mean_load(&pose)?.wrench))
        };
        let wind = sum(&self.wind)?;
        let [along, _] = at.level_axes();
        let about = |wrench: &Six, arm: Vector3<f64>| {
            let (force, turn) = (wrench.fixed_rows::<3>(0).into_owned(), wrench.fixed_rows::<3>(3).into_owned());
            (turn - arm.cross(&force)).dot(&along)
        };
        Ok(match &self.centre {
            ResistanceCentre::Buoyancy => {
                let wet = body.wet(at)?;
                let arm = if wet.volume > 0.0 { wet.moment / wet.volume } else { Vector3::zeros() };
                (about(&wind, arm), 0.0)
            }
            ResistanceCentre::Point(point) => (about(&wind, pose.axes * point), 0.0),
            ResistanceCentre::Current { drag, .. } => {
                let drag = sum(drag)?;
                let across = |wrench: &Six| wrench.fixed_rows::<3>(0).dot(&self.toward);
                let held = across(&drag);
                let factor = factor.unwrap_or(-across(&wind) / held);
                if across(&wind) != 0.0 && !(held < 0.0 && factor.is_finite()) {
                    return Err(ClassError::new(format!(
                        "no current holds {} against the wind: nothing of it has drag",
                        body.name
                    ))
                    .help("pieces have -CS_CURRENT; -CEN_LATERAL gives the point that holds it instead"));
                }
                let factor = if factor.is_finite() { factor } else { 0.0 };
                (about(&(wind + drag * factor), pose.axes * body.mass().centre), factor)
            }
        })
    }
}

/// The horizontal direction of a wind that rolls a body on.
fn downwind(attitude: &Attitude, side: f64) -> Vector3<f64> {
    let [along, _] = attitude.level_axes();
    along.cross(&Vector3::z()) * side
}

/// An environment without sea, wind and current.
fn calm(environment: &Environment) -> Environment {
    Environment { current: None, ..environment.clone().without_sea() }
}

/// The loads of a category on a body in an environment.
fn loads_in(
    model: &Model,
    body: &Body,
    category: Category,
    environment: Environment,
) -> Result<Vec<Box<dyn BodyLoad>>, ClassError> {
    let model = Model { environment, ..model.clone() };
    let floating = Floating::at_rest(&model, body)?;
    Ok(floating.loads.into_iter().filter(|load| load.category() == category).collect())
}

/// Where a table of arms ends before its last step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StopRule {
    /// Where the righting arm has been positive and no longer is.
    Righting,
    /// Where the righting arm has been greater than the heeling arm and no longer is.
    Net,
}

/// How a table of arms is made.
#[derive(Debug)]
pub struct Arms<'b> {
    /// The body.
    pub body: &'b StillBody,
    /// What heels it.
    pub heeling: Option<&'b Heeling>,
    /// Its down-flooding points.
    pub points: &'b [DownFloodingPoint],
    /// The attitude it is rolled from, and its roll axis.
    pub start: Attitude,
    /// Whether its trim is held.
    pub holds_trim: bool,
    /// When a balance is found.
    pub limits: BalanceLimits,
    /// Coefficients of 1, a, a^2, a^3 added to the righting arm and to the heeling arm (m), a being the roll in degrees.
    pub polynomials: [[f64; 4]; 2],
    /// Step of the roll (rad); its sign is the direction the body is rolled in.
    pub step: f64,
    /// Factor of the trial current upright.
    initial: Option<f64>,
    /// A row a step.
    pub rows: Vec<ArmPoint>,
    /// Areas under the righting and the heeling arm from the first row to each row (m rad).
    pub areas: Vec<[f64; 2]>,
    /// Why there is no further row.
    pub ended: Option<ClassError>,
}

/// One roll.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArmPoint {
    /// Roll in the direction the body is rolled (rad).
    pub angle: f64,
    /// Righting arm (m).
    pub righting: f64,
    /// Heeling arm (m).
    pub heeling: f64,
    /// The balance.
    pub balance: BalancedBody,
    /// Least heights over the water of points that are not weathertight and of those that are (m), each with the point's index.
    pub heights: [Option<(f64, usize)>; 2],
}

impl<'b> Arms<'b> {
    /// A table of one body before its rows are found, with a step of roll (rad).
    pub fn new(body: &'b StillBody, start: Attitude, step: f64) -> Self {
        Arms {
            body,
            heeling: None,
            points: &[],
            start,
            holds_trim: false,
            limits: BalanceLimits::default(),
            polynomials: [[0.0; 4]; 2],
            step,
            initial: None,
            rows: Vec::new(),
            areas: Vec::new(),
            ended: None,
        }
    }

    /// The same with its rows: upright and so many steps. Areas are by Simpson's rule, with a balance amid each step. A step without a
    /// balance ends it.
    ///
    /// # Errors
    /// No balance upright, or a load that cannot be computed.
    pub fn with_rows(mut self, steps: usize, stop: Option<StopRule>) -> Result<Self, ClassError> {
        let first = self.find(0.0, &self.start)?;
        if let Some(heeling) = self.heeling
            && matches!(heeling.centre, ResistanceCentre::Current { is_initial: true, .. })
        {
            self.initial = Some(heeling.moment(self.body, &first.balance.attitude, None)?.1);
        }
        self.rows.push(first);
        self.areas.push([0.0; 2]);
        let mut was_positive = false;
        for n in 1..=steps {
            let Some((before, area)) = self.rows.last().copied().zip(self.areas.last().copied()) else { break };
            let angle = self.step.abs() * n as f64;
            let made = self
                .find(0.5 * (before.angle + angle), &before.balance.attitude)
                .and_then(|middle| Ok((middle, self.find(angle, &middle.balance.attitude)?)));
            let (middle, row) = match made {
                Ok(made) => made,
                Err(error) => {
                    self.ended = Some(error);
                    break;
                }
            };
            let sixth = (angle - before.angle) / 6.0;
            self.areas.push([
                area[0] + sixth * (before.righting + 4.0 * middle.righting + row.righting),
                area[1] + sixth * (before.heeling + 4.0 * middle.heeling + row.heeling),
            ]);
            self.rows.push(row);
            let net = match stop {
                Some(StopRule::Righting) => row.righting,
                Some(StopRule::Net) => row.righting - row.heeling,
                None => continue,
            };
            if was_positive && net <= 0.0 {
                break;
            }
            was_positive |= net > 0.0;
        }
        Ok(self)
    }

    /// The direction the body is rolled in: 1 or -1.
    pub fn side(&self) -> f64 {
        if self.step < 0.0 { -1.0 } else { 1.0 }
    }

    /// The arms at a roll (rad), found from the nearest row.
    ///
    /// # Errors
    /// No balance there.
    pub fn evaluate(&self, angle: f64) -> Result<ArmPoint, ClassError> {
        let nearest = self.rows.iter().min_by(|a, b| (a.angle - angle).abs().total_cmp(&(b.angle - angle).abs()));
        self.find(angle, nearest.map_or(&self.start, |row| &row.balance.attitude))
    }

    fn find(&self, angle: f64, from: &Attitude) -> Result<ArmPoint, ClassError> {
        let side = self.side();
        let from = Attitude { roll: side * angle, ..*from };
        let balance = self.body.balance(&from, [true, false, !self.holds_trim], &self.limits)?;
        let polynomial = |[a, b, c, d]: [f64; 4]| {
            let x = angle.to_degrees();
            a + x * (b + x * (c + x * d))
        };
        let moment = match self.heeling {
            Some(heeling) => heeling.moment(self.body, &balance.attitude, self.initial)?.0,
            None => 0.0,
        };
        let pose = balance.attitude.pose();
        let least = |weathertight: bool| {
            let points = self.points.iter().enumerate().filter(|(_, p)| p.is_weathertight == weathertight);
            let heights = points.map(|(n, point)| {
                let arm = pose.axes * point.at;
                (pose.origin.z + arm.z - self.body.water_at(&balance.attitude, &arm), n)
            });
            heights.min_by(|a, b| a.0.total_cmp(&b.0))
        };
        Ok(ArmPoint {
            angle,
            righting: side * balance.arm + polynomial(self.polynomials[0]),
            heeling: side * moment / balance.weight + polynomial(self.polynomials[1]),
            balance,
            heights: [least(false), least(true)],
        })
    }

    /// The areas under the righting and the heeling arm between two rolls (m rad).
    ///
    /// # Errors
    /// No balance on the way.
    pub fn area_between(&self, from: f64, to: f64) -> Result<[f64; 2], ClassError> {
        let (start, end) = (self.area_to(from)?, self.area_to(to)?);
        Ok([end[0] - start[0], end[1] - start[1]])
    }

    /// The areas from the first row to a roll: those of the row before it, and Simpson's rule from there in steps of the table.
    fn area_to(&self, angle: f64) -> Result<[f64; 2], ClassError> {
        let behind = self.rows.partition_point(|row| row.angle <= angle).saturating_sub(1);
        let (Some(row), Some(area)) = (self.rows.get(behind), self.areas.get(behind)) else { return Ok([0.0; 2]) };
        let (mut sum, mut left) = (*area, *row);
        let whole = angle - row.angle;
        let pieces = (whole.abs() / self.step.abs()).ceil().max(1.0);
        for n in 1..=pieces as usize {
            let right = self.evaluate(row.angle + whole * n as f64 / pieces)?;
            let middle = self.evaluate(0.5 * (left.angle + right.angle))?;
            let sixth = (right.angle - left.angle) / 6.0;
            sum[0] += sixth * (left.righting + 4.0 * middle.righting + right.righting);
            sum[1] += sixth * (left.heeling + 4.0 * middle.heeling + right.heeling);
            left = right;
        }
        Ok(sum)
    }
}
