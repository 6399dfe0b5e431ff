//! `KG_ALLOW`: the greatest height of the center of gravity with which stability criteria are met.
//!
//! Source: [MOSES-REF stab_ok], [MOSES-HELP hystat]. The height of all weights is moved along the vertical of the body, and the arms are
//! found anew each time.

use super::arms::ArmRequest;
use super::criteria::{CRITERION_OPTIONS, Limit, STEPS, read_limits};
use super::{body, dispose, keep_wave};
use crate::commands::menu;
use crate::commands::{Call, Command, Effect, Job};
use nalgebra::Vector3;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_hydro::hull::Hydrostatics;
use windlass_hydro::stability::{
    Attitude, BalanceLimits, DownFloodingPoint, Heeling, Stability, StillBody, find_down_flooding_points,
    find_greatest_height,
};
use windlass_language::spec::{CommandSpec, Opens};
use windlass_model::{Body, ClassError, Model, SolveKind};

/// KG_ALLOW.
pub static KG_ALLOW: Command = Command { spec: &SPEC, edits: false, run };

/// The lowest height that is tried: so many times KM - KB below KB.
const DEPTHS_BELOW: f64 = 2.0;
/// A weight that is missing, as a share of the displacement, from which on it is an additional one.
const MISSING_WEIGHT: f64 = 1e-3;
/// An attitude that is upright (rad).
const UPRIGHT: f64 = 1e-6;

static SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::HSTATICS],
    opens: Opens::Menu(&menu::DISPOSITION),
    data: &STEPS,
    options: &CRITERION_OPTIONS,
    detail: "The greatest height of the center of gravity above the origin of the body with which each criterion of STAB_OK is just met, about each roll axis of -YAW, and the least of them; \
             without a criterion that of KM, at which GM is zero, free surfaces included. Contents of compartments stay as they are: what moves is the center of all weight, along the vertical of the body. \
             Where the body displaces more than its weight as it stands upright, or has no weight, the rest is an additional weight in the vertical that balances it, and its height is \
             given beside that of all. The result goes to the disposition menu.",
    example: "&DESCRIBE BODY TBRG\n&SURFACE\nBLOCK HULL 0 -50 0 400 50 20\nEND\n&INSTATE -CONDITION 9\nHSTATICS\nKG_ALLOW\nREPORT\nEND\nKG_ALLOW 5 12 -GM 1 -RANGE 36\nREPORT\nEND\nEND",
    ..CommandSpec::new("KG_ALLOW", "allowable height of the center of gravity")
};

/// A body whose center of gravity is moved.
struct Movable<'m> {
    model: &'m Model,
    body: &'m Body,
    request: &'m ArmRequest,
    points: &'m [DownFloodingPoint],
    /// The additional weight (N) with its place in the body, height zero (m).
    added: Option<(f64, Vector3<f64>)>,
    /// Weight in all (N) and the height of its center without a move (m).
    weight: f64,
    height: f64,
}

/// One row.
struct AllowableKgRow {
    yaw: f64,
    criterion: String,
    limit: String,
    height: Option<f64>,
}

impl Movable<'_> {
    /// The body with its center of gravity at a height (m).
    fn at_height(&self, height: f64) -> Result<StillBody, ClassError> {
        let mut still = StillBody::new(self.model, self.body, self.request.wave)?;
        still.weight_factor = self.request.weight_factor;
        still.added_weights.extend(self.added);
        // a couple of weights raises the center and adds nothing
        let rise = Vector3::new(0.0, 0.0, height - self.height);
        still.added_weights.extend([(self.weight, rise), (-self.weight, Vector3::zeros())]);
        Ok(still)
    }

    /// The height of the center of gravity at which the metacentric height is zero about an axis (m). About a skew axis trim follows the
    /// roll, and the metacentric height is no straight function of that of the center.
    fn metacentre(&self, start: &Attitude) -> Result<f64, ClassError> {
        let still = self.at_height(self.height)?;
        let found = still.balance(start, [true, false, true], &BalanceLimits::default())?;
        let (stiffness, weight) = still.stiffness(&found.attitude)?;
        let highest = self.height + stiffness[(1, 1)] / weight;
        let least = highest - DEPTHS_BELOW * (highest - self.height).abs().max(1.0);
        let height = |center: f64| self.at_height(center)?.metacentric_height(&found.attitude).map(Some);
        find_greatest_height([least, highest], height)?.ok_or_else(|| ClassError::new("nothing holds it upright"))
    }

    /// By how much a limit is met with the center of gravity at a height.
    fn margin(
        &self,
        limit: &Limit,
        height: f64,
        start: &Attitude,
        heeling: Option<&Heeling>,
    ) -> Result<Option<f64>, ClassError> {
        if self.model.is_interrupted() {
            return Err(ClassError::new("interrupted"));
        }
        let still = self.at_height(height)?;
        let arms = self.request.arms(&still, (heeling, self.points), start)?;
        // a body that has no equilibrium meets nothing
        let Ok(stability) = Stability::from_arms(&arms) else { return Ok(None) };
        Ok(limit.margin(stability.value(limit.criterion.quantity, limit.second)?))
    }

    /// The greatest height that meets a limit; none where none does.
    fn allowable(&self, limit: &Limit, start: &Attitude, [low, high]: [f64; 2]) -> Result<Option<f64>, ClassError> {
        let heeling = self.request.heeling(self.model, self.body, start)?;
        find_greatest_height([low, high], |height| self.margin(limit, height, start, heeling.as_ref()))
    }
}

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let (args, span) = (&call.args, call.args.span);
    let step = args.number(const { SPEC.number("INC") }).unwrap_or(5f64.to_radians());
    let steps = args.integer(const { SPEC.integer("NUM") }).unwrap_or(12);
    let request = ArmRequest::read(job, args, step, steps)?;
    let body = body(job, span)?;
    let (model, units) = (&job.model, job.units);
    let to_error = |e: ClassError| e.diagnostic(span, units);
    model.check_effects(SolveKind::Statics).map_err(to_error)?;
    let limits = read_limits(args, model, body);
    let points = find_down_flooding_points(model, body);
    let still = StillBody::new(model, body, request.wave).map_err(to_error)?;
    let standing = Attitude::from_place(&body.position);
    let around = model.surroundings();
    let wet = still.wet(&standing).map_err(to_error)?;
    let pose = standing.pose();
    let lift = around.water_density * around.gravity;
    let Some(form) = Hydrostatics::new(&wet, &pose, still.mass().centre, lift) else {
        return Err(Diagnostic::error(format!("{} displaces nothing as it stands", body.name), span)
            .help("&INSTATE -CONDITION sets its draft"));
    };
    let own = still.mass().mass * around.gravity * request.weight_factor;
    let missing = form.displacement - own;
    let added = if own > 0.0 && missing <= MISSING_WEIGHT * form.displacement {
        None
    } else if standing.roll.abs().max(standing.trim.abs()) > UPRIGHT {
        let text = format!("{} is not upright: the additional weight has no place of its own", body.name);
        return Err(Diagnostic::error(text, span)
            .help("&INSTATE -CONDITION with a draft alone sets it upright, &WEIGHT gives it its whole weight"));
    } else {
        // in one vertical with the center of buoyancy, together with what it weighs
        let buoyant = pose.local(form.centre_of_buoyancy);
        let at = (buoyant * form.displacement - still.mass().centre * own) / missing;
        Some((missing, Vector3::new(at.x, at.y, 0.0)))
    };
    let weight = own + added.map_or(0.0, |(weight, _)| weight);
    let height = still.mass().centre.z * own / weight;
    let movable = Movable { model, body, request: &request, points: &points, added, weight, height };
    let mut rows = Vec::new();
    for yaw in &request.yaws {
        let start = request.start(body, *yaw);
        let high = movable.metacentre(&start).map_err(to_error)?;
        if limits.is_empty() {
            rows.push(AllowableKgRow {
                yaw: *yaw,
                criterion: "KM".into(),
                limit: "GM >= 0".into(),
                height: Some(high),
            });
            continue;
        }
        let low = form.kb - DEPTHS_BELOW * (high - form.kb).abs();
        let mut least = Some(high);
        for limit in &limits {
            let found = movable.allowable(limit, &start, [low, high]).map_err(to_error)?;
            least = least.zip(found).map(|(a, b): (f64, f64)| a.min(b));
            let (criterion, limit) = (limit.criterion.name.to_string(), limit.text(units));
            rows.push(AllowableKgRow { yaw: *yaw, criterion, limit, height: found });
        }
        rows.push(AllowableKgRow { yaw: *yaw, criterion: "all".into(), limit: String::new(), height: least });
    }
    let mut table = request.describe(Table::new(format!("Allowable KG of {}", body.name)), &still, weight);
    table = table.fact("Displacement", form.displacement, Dim::Force);
    if own > 0.0 {
        table = table.fact("KG", still.mass().centre.z, Dim::Length);
    }
    for row in rows.iter().filter(|row| row.height.is_none() && row.criterion != "all") {
        table.note_absent(format!(
            "{}: no height of the center of gravity meets {} {}",
            body.name, row.criterion, row.limit
        ));
    }
    table.add_notes(model.caveats());
    let own_moment = own * still.mass().centre.z;
    let mut made = table
        .with_rows(&rows)
        .column("", "Axis", Dim::Angle, Digits::Usual, |row| row.yaw)
        .text("Criterion", |row| row.criterion.clone())
        .text("Limit", |row| row.limit.clone())
        .column("", "KG", Dim::Length, Digits::Decimals(4), |row| row.height);
    if let Some((added, _)) = added.filter(|_| own > 0.0) {
        made = made.column("Additional", "KG", Dim::Length, Digits::Decimals(4), |row| {
            row.height.map(|height| (height * weight - own_moment) / added)
        });
    }
    let table = made.build();
    keep_wave(job, request.wave);
    Ok(dispose(job, table, span))
}
