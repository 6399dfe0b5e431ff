//! `#WEIGHT` and `&WEIGHT`.
//!
//! Source: [MOSES-HELP lgroup, modeling].

use crate::commands::menu;
use crate::commands::{Call, Command, Effect, Job};
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::pose::{Pose, Six};
use windlass_base::span::Span;
use windlass_base::spec::ValueKey;
use windlass_base::units::eight_figures;
use windlass_base::units::{Dim, UnitSystem};
use windlass_base::values::{Args, Given, Noun};
use windlass_hydro::{Category as HydroCategory, Floating};
use windlass_language::spec::{CommandSpec, DatumKey, Kind, OptionSpec, ValueSpec};
use windlass_model::{Body, ClassError, EXTRA, Mass, Model, SolveKind, Weight, find};

/// #WEIGHT.
pub static ITEM: Command = Command { spec: &ITEM_SPEC, edits: false, run: item };
/// &WEIGHT.
pub static WEIGHT: Command = Command { spec: &SPEC, edits: true, run };

const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}
const BODY: ValueSpec = ValueSpec::new("BODY", Kind::Name(Noun::Body), "body");
const RADII: [ValueSpec; 3] = [
    number("KX", Dim::Length, "radius of gyration about x").not_negative().or("0"),
    number("KY", Dim::Length, "radius of gyration about y").not_negative().or("0"),
    number("KZ", Dim::Length, "radius of gyration about z").not_negative().or("0"),
];

/// `-CATEGORY` of a load.
pub const CATEGORY: OptionSpec = OptionSpec::new(
    "-CATEGORY",
    &[ValueSpec::new("NAME", Kind::Text, "name of a category")],
    "the category it counts in",
)
.default("EXTRA");
const LDIST: OptionSpec = OptionSpec::new(
    "-LDIST",
    &[number("X1", Dim::Length, "first station, x in the part"), number("X2", Dim::Length, "last station")],
    "stations the weight is spread between for longitudinal strength",
);

static ITEM_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::INMODEL, &menu::MEDIT],
    data: &[
        ValueSpec::new("*PT", Kind::Name(Noun::Point), "where it is"),
        number("W", Dim::Force, "the weight"),
        RADII[0],
        RADII[1],
        RADII[2],
    ],
    options: &[CATEGORY, LDIST],
    detail: "A weight of the part that the point belongs to, as many as are wanted. The radii of gyration are about axes through the \
             point, along those of the part; without them it is a point. A negative weight takes off what other records put on. The point is \
             defined before, and what counts is where it stands when the record is read. -LDIST spreads the weight for longitudinal strength alone, \
             evenly where the point is in the middle of its stations, else as a trapezoid with the point's x as its centroid; the centre of \
             gravity stays at the point. &APPLY multiplies categories.",
    example: "MEDIT\n&DESCRIBE BODY TBRG\n*CG 200 0 12\n#WEIGHT *CG 23000 35 115 118 -CATEGORY STEEL -LDIST 0 400\nEND\n&STATUS WEIGHT",
    ..CommandSpec::new("#WEIGHT", "a weight at a point")
};

const TOTAL: OptionSpec = OptionSpec::new(
    "-TOTAL",
    &[
        BODY,
        number("W", Dim::Force, "total weight").positive(),
        number("XCG", Dim::Length, "x of the centre of gravity, in the body"),
        number("YCG", Dim::Length, "y of it"),
        number("ZCG", Dim::Length, "z of it"),
        RADII[0].or("what a point weight makes it"),
        RADII[1].or("what a point weight makes it"),
        RADII[2].or("what a point weight makes it"),
    ],
    "adds to a body the one weight that makes its total this",
)
.many();
const MARGIN: OptionSpec = OptionSpec::new(
    "-MARGIN",
    &[
        BODY.or("all bodies, by a factor"),
        number(
            "PERCENT",
            Dim::None,
            "with a body (ours) the percentage of each weight that is added; alone (MOSES) the factor of each weight",
        )
        .in_range(-100.0, 1000.0),
    ],
    "makes every weight of a body larger by a percentage, or that of all bodies by a factor; several compound",
)
.many();
const COMPUTE: OptionSpec = OptionSpec::new(
    "-COMPUTE",
    &[
        BODY.or("the body described last"),
        number("ZCG", Dim::Length, "z of the centre of gravity, in the body"),
        RADII[0],
        RADII[1],
        RADII[2],
    ],
    "adds to a body the one weight with which it is in equilibrium where it floats",
)
.many();
const DEFINE: OptionSpec = OptionSpec::new(
    "-DEFINE",
    &[
        BODY.or("the body described last"),
        number("W", Dim::Force, "the weight"),
        number("X", Dim::Length, "x of its centre, in the body"),
        number("Y", Dim::Length, "y of it"),
        number("Z", Dim::Length, "z of it"),
        RADII[0],
        RADII[1],
        RADII[2],
    ],
    "adds a weight to a body",
)
.many();

/// The radii of gyration of `-TOTAL`.
const RADII_OF_TOTAL: [ValueKey<f64>; 3] = TOTAL.numbers(["KX", "KY", "KZ"]);

static SPEC: CommandSpec = CommandSpec {
    options: &[COMPUTE, TOTAL, DEFINE, MARGIN],
    detail: "Options act in the order given. -TOTAL: radii of gyration are those of the whole body about axes through its centre of \
             gravity, along those of the body; one weight is added to the body's own part with the weight, the place and the radii that are \
             missing. Where the weights there already make the total and the centre is elsewhere, the pair of weights is added that moves it, \
             and radii that are not given stay. Where they weigh more than the total, or have more inertia about its centre, nothing can be \
             added and the record is refused. Products of inertia are those that result. -COMPUTE: the weight is the buoyancy and the \
             contents of compartments, less the weights there already, in the attitude the body has; x and y of its centre are such that nothing turns the \
             body, for the ZCG given. With weights there already ZCG and the radii are those of the weight added (our reading). Connectors, \
             wind and current are left out. -MARGIN keeps centres and radii.",
    example: "MEDIT\n&DESCRIBE BODY TBRG\n*CRANE 350 0 60\n#WEIGHT *CRANE 800\nEND\n&WEIGHT -TOTAL TBRG 23000 200 0 12 38 118 120\n\
              &WEIGHT -MARGIN TBRG 3\n&STATUS WEIGHT\n&DESCRIBE BODY BOX\n&SURFACE\nBLOCK HULL 0 -25 0 180 25 14\nEND\n&INSTATE -CONDITION 7\n\
              &WEIGHT -COMPUTE 5 32 85 85\n&STATUS WEIGHT",
    ..CommandSpec::new("&WEIGHT", "completes or enlarges the weight of a body")
};

fn item(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const POINT: DatumKey<str> = ITEM_SPEC.word("*PT");
    const WEIGHT: DatumKey<f64> = ITEM_SPEC.number("W");
    const OWN_RADII: [DatumKey<f64>; 3] = ITEM_SPEC.numbers(["KX", "KY", "KZ"]);
    let args = &call.args;
    let model = &job.model;
    let point = find(&model.points, args.word(POINT).unwrap_or_default(), "point", args.position(POINT))?;
    if model.body_of(point).is_none() {
        return Err(Diagnostic::error(
            format!("{} is a point of the ground and carries no weight", point.name),
            args.position(POINT),
        )
        .other(point.span, "defined here")
        .help("points after &DESCRIBE BODY or PART belong to it"));
    }
    let radii = args.numbers_or_zero(OWN_RADII);
    let weight = args.number(WEIGHT).unwrap_or_default();
    if weight == 0.0 {
        return Err(Diagnostic::error("a weight of zero weighs nothing", args.position(WEIGHT))
            .label(if radii == [0.0; 3] { "" } else { "radii of gyration need a weight" }));
    }
    let (at, key, span) = (point.at, Model::key(&point.part), args.position(WEIGHT));
    if let Some(text) = no_body_has(radii, job.units) {
        job.warn(text, args.position(OWN_RADII[0]));
    }
    let spread = stations(args, at[0])?;
    let category = category_of(args);
    let group = group_for(&job.model, args.word(POINT).unwrap_or_default(), args.position(POINT))?;
    if let Some(part) = job.model.parts.get_mut(&key) {
        part.weights.push(Weight { at, weight, radii, category, group, spread, span, ..Weight::default() });
    }
    job.model.refresh_weight_multipliers();
    Ok(Effect::Done)
}

/// The category of a record that takes `-CATEGORY`.
pub fn category_of(args: &Args) -> String {
    args.option_word(&CATEGORY).map_or_else(|| EXTRA.to_string(), str::to_ascii_uppercase)
}

/// The load group that a load at a point belongs to.
///
/// # Errors
/// A point of another part than that of the group being described.
pub fn group_for(model: &Model, point: &str, span: Span) -> Outcome<Option<String>> {
    let Some(group) = model.current_load_group.as_ref().and_then(|name| model.load_groups.get(&Model::key(name)))
    else {
        return Ok(None);
    };
    let of_point = model.points.get(&Model::key(point)).map(|p| Model::key(&p.part));
    if of_point.is_some_and(|part| part != Model::key(&group.part)) {
        return Err(Diagnostic::error(
            format!("load group {} spans parts: {point} is no point of part {}", group.name, group.part),
            span,
        )
        .other(group.span, "the load group")
        .help("&DESCRIBE PART NAME and then &DESCRIBE LOAD_GROUP NAME begin a group of the other part"));
    }
    Ok(Some(group.name.clone()))
}

/// The stations of `-LDIST`.
///
/// # Errors
/// Stations that do not grow, or with the weight beside them.
fn stations(args: &Args, x: f64) -> Outcome<Option<[f64; 2]>> {
    let Some(given) = args.option(&LDIST) else { return Ok(None) };
    let [first, last] = given.numbers_or_zero(const { LDIST.numbers(["X1", "X2"]) });
    if first >= last {
        return Err(Diagnostic::error("X2 of -LDIST must be greater than X1", given.span));
    }
    let (length, off) = (last - first, x - 0.5 * (first + last));
    if off.abs() > length / 6.0 * (1.0 + 1e-9) {
        return Err(Diagnostic::error(
            "no trapezoid between the stations of -LDIST has its centroid at the point",
            given.span,
        )
        .help("the point's x is within the middle third of the stations"));
    }
    Ok(Some([first, last]))
}

/// What is said of radii that no distribution of mass has: the greatest square exceeds the sum of the others.
fn no_body_has(radii: [f64; 3], units: UnitSystem) -> Option<String> {
    let squares = radii.map(|k| k * k);
    let (sum, most) = (squares.iter().sum::<f64>(), squares.iter().copied().fold(0.0, f64::max));
    let lengths = radii.map(|k| eight_figures(Dim::Length.from_si(k, units))).join(" ");
    (2.0 * most > sum * (1.0 + 1e-9)).then(|| {
        format!("no body has the radii of gyration {lengths}: the square of each is at most the sum of the squares of the others")
    })
}

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    if call.args.options.is_empty() {
        return Err(Diagnostic::error("&WEIGHT lacks what to do", call.args.span)
            .help("options: -COMPUTE, -TOTAL, -DEFINE, -MARGIN"));
    }
    for given in &call.args.options {
        let position = given.first_place();
        if given.is(&MARGIN) && given.first_word().is_none() {
            let factor = given.number(const { MARGIN.number("PERCENT") }).unwrap_or(1.0);
            if factor <= 0.0 {
                return Err(Diagnostic::error("the factor of -MARGIN must be greater than zero", position));
            }
            job.model.parts.values_mut().flat_map(|p| p.weights.iter_mut()).for_each(|w| w.weight *= factor);
            continue;
        }
        let body = match given.first_word() {
            Some(name) => find(&job.model.bodies, name, "body", position)?.clone(),
            None => job.model.current_body().cloned().ok_or_else(|| {
                Diagnostic::error("no body is described yet", given.span).help("&DESCRIBE BODY describes one")
            })?,
        };
        let made = match given {
            _ if given.is(&TOTAL) => {
                let now = Mass::from_parts(job.model.parts_of(&body), job.model.defaults.gravity);
                let made = missing(job, given, &now)?;
                if let [Some(x), Some(y), Some(z)] = RADII_OF_TOTAL.map(|key| given.number(key))
                    && let Some(text) = no_body_has([x, y, z], job.units)
                {
                    job.warn(text, given.span);
                }
                made
            }
            _ if given.is(&COMPUTE) => {
                let made = compute_weight(job, given, &body)?;
                note_connectors(job, &body, given.span);
                vec![made]
            }
            _ if given.is(&DEFINE) => {
                let at = given.numbers_or_zero(const { DEFINE.numbers(["X", "Y", "Z"]) });
                let radii = given.numbers_or_zero(const { DEFINE.numbers(["KX", "KY", "KZ"]) });
                let weight = given.number(const { DEFINE.number("W") }).unwrap_or_default();
                if weight == 0.0 {
                    return Err(Diagnostic::error("a weight of zero weighs nothing", given.span));
                }
                vec![Weight {
                    at: in_own_part(job, &body, at.into(), given)?,
                    weight,
                    radii,
                    span: given.span,
                    ..Weight::default()
                }]
            }
            _ => {
                let factor = 1.0 + 0.01 * given.number(const { MARGIN.number("PERCENT") }).unwrap_or(0.0);
                let key = Model::key(&body.name);
                let own = job.model.parts.values_mut().filter(|p| Model::key(&p.body) == key);
                let mut count = 0;
                for weight in own.flat_map(|p| p.weights.iter_mut()) {
                    weight.weight *= factor;
                    count += 1;
                }
                if count == 0 {
                    return Err(Diagnostic::error(format!("{} has no weight to enlarge", body.name), position));
                }
                Vec::new()
            }
        };
        if let Some(part) = job.model.parts.get_mut(&Model::key(&body.name)) {
            part.weights.extend(made);
        }
        job.model.refresh_weight_multipliers();
    }
    Ok(Effect::Done)
}

/// A place of a body in its own part (m).
///
/// # Errors
/// A part that is turned in its body.
fn in_own_part(job: &Job, body: &Body, at: Vector3<f64>, given: &Given) -> Outcome<[f64; 3]> {
    let position = job.model.parts.get(&Model::key(&body.name)).map(|p| p.position).unwrap_or_default();
    if position.turn != [0.0; 3] {
        let text = format!("{} adds to the body's own part, and that is turned within the body", given.name());
        return Err(Diagnostic::error(text, given.span).help("&DESCRIBE PART NAME -MOVE turns parts"));
    }
    Ok((at - Vector3::from(position.shift)).into())
}

/// Notes that what connectors exert on a body is left out of its weight.
fn note_connectors(job: &mut Job, body: &Body, span: Span) {
    let model = &job.model;
    let is_on_body = |name: &String| {
        let own = model.points.get(&Model::key(name)).and_then(|point| model.body_of(point));
        own.is_some_and(|own| Model::key(&own.name) == Model::key(&body.name))
    };
    let count = model.connectors.values().filter(|c| c.active && c.points.iter().any(is_on_body)).count();
    if count > 0 {
        let of = crate::commands::count(count, "connector");
        job.remark(format!("-COMPUTE leaves out {of} of {}: the weight balances the buoyancy alone", body.name), span);
    }
}

/// The weight with which a body is in equilibrium where it floats.
///
/// # Errors
/// A body that displaces no more than it weighs, or that lies on its side, where ZCG does not say where the centre is.
fn compute_weight(job: &Job, given: &Given, body: &Body) -> Outcome<Weight> {
    let to_error = |e: ClassError| e.diagnostic(given.span, job.units);
    job.model.check_effects(SolveKind::Statics).map_err(to_error)?;
    let floating = Floating::at_rest(&job.model, body).map_err(to_error)?;
    let pose = Pose::from_place(&body.position);
    let still = [HydroCategory::Weight, HydroCategory::Contents, HydroCategory::Buoyancy];
    let mut sum = Six::zeros();
    for load in floating.loads.iter().filter(|load| still.contains(&load.category())) {
        sum += load.mean_load(&pose).map_err(to_error)?.wrench;
    }
    let weight = sum[2];
    if weight <= 0.0 {
        let short =
            format!("{} {}", eight_figures(Dim::Force.from_si(-weight, job.units)), Dim::Force.label(job.units));
        return Err(Diagnostic::error(
            format!("{} displaces no more than it weighs where it floats", body.name),
            given.span,
        )
        .label(format!("{short} too little"))
        .help("&INSTATE -CONDITION sets draft, roll and trim"));
    }
    // r x (0, 0, -W) and the moment of the rest add up to nothing
    let (x, y) = (-sum[4] / weight, sum[3] / weight);
    let z = given.number(const { COMPUTE.number("ZCG") }).unwrap_or_default();
    let axes = pose.axes;
    let flat = Matrix2::new(axes[(0, 0)], axes[(0, 1)], axes[(1, 0)], axes[(1, 1)]);
    let beside = Vector2::new(x - axes[(0, 2)] * z, y - axes[(1, 2)] * z);
    let size = flat[(0, 0)] * flat[(1, 1)] - flat[(0, 1)] * flat[(1, 0)];
    if size.abs() < 1e-6 {
        return Err(Diagnostic::error(
            format!("{} lies on its side: z of its centre of gravity does not say where it is", body.name),
            given.span,
        ));
    }
    let at = Vector3::new(
        (flat[(1, 1)] * beside.x - flat[(0, 1)] * beside.y) / size,
        (flat[(0, 0)] * beside.y - flat[(1, 0)] * beside.x) / size,
        z,
    );
    let radii = given.numbers_or_zero(const { COMPUTE.numbers(["KX", "KY", "KZ"]) });
    Ok(Weight { at: in_own_part(job, body, at, given)?, weight, radii, span: given.span, ..Weight::default() })
}

/// The weights that a body lacks of a total; none when it lacks nothing, two that move its centre when only that is elsewhere.
///
/// # Errors
/// Weights there already that no positive weight can bring to the total.
fn missing(job: &Job, given: &Given, now: &Mass) -> Outcome<Vec<Weight>> {
    let (units, gravity) = (job.units, job.model.defaults.gravity);
    const WEIGHT: ValueKey<f64> = TOTAL.number("W");
    const X: ValueKey<f64> = TOTAL.number("XCG");
    const Y: ValueKey<f64> = TOTAL.number("YCG");
    const Z: ValueKey<f64> = TOTAL.number("ZCG");
    let with_unit = |value: f64, dim: Dim| format!("{} {}", eight_figures(dim.from_si(value, units)), dim.label(units));
    let [weight, x, y, z] = given.numbers_or_zero([WEIGHT, X, Y, Z]);
    let (total, centre) = (weight / gravity, Vector3::new(x, y, z));
    let lacking = total - now.mass;
    let size = 1e-9 * total;
    if lacking < -size {
        return Err(Diagnostic::error("the weights there already weigh more than the total", given.position(WEIGHT))
            .label(format!("they weigh {}", with_unit(now.mass * gravity, Dim::Force))));
    }
    let moment = centre * total - now.centre * now.mass;
    if lacking <= size {
        let off = (now.centre - centre).norm();
        let wanted = RADII_OF_TOTAL.map(|key| given.number(key));
        if off <= 1e-9 * (centre.norm() + now.centre.norm()) && wanted == [None; 3] {
            return Ok(Vec::new());
        }
        let Some(body) = job.model.bodies.get(&Model::key(given.first_word().unwrap_or_default())) else {
            return Ok(Vec::new());
        };
        let own = now.radii().map(|k| k.unwrap_or(0.0));
        let radii =
            [0, 1, 2].map(|i: usize| wanted.get(i).copied().flatten().unwrap_or(own.get(i).copied().unwrap_or(0.0)));
        let (from, to) = (in_own_part(job, body, now.centre, given)?, in_own_part(job, body, centre, given)?);
        let pair = |at: [f64; 3], weight: f64, radii: [f64; 3]| Weight {
            at,
            weight,
            radii,
            span: given.span,
            ..Weight::default()
        };
        return Ok(vec![pair(from, -now.mass * gravity, own), pair(to, weight, radii)]);
    }
    let at = moment / lacking;
    let arm = at - centre;
    let there =
        now.inertia_about(centre) + lacking * (Matrix3::identity() * arm.norm_squared() - arm * arm.transpose());
    let mut radii = [0.0; 3];
    for ((i, radius), key) in radii.iter_mut().enumerate().zip(RADII_OF_TOTAL) {
        let Some(wanted) = given.number(key).map(|k| total * k * k) else { continue };
        let own = wanted - there[(i, i)];
        if own < -1e-9 * there[(i, i)] {
            let axis = ["x", "y", "z"].get(i).copied().unwrap_or_default();
            let most = with_unit((there[(i, i)] / total).sqrt(), Dim::Length);
            return Err(Diagnostic::error(
                format!("the weight to be added would need a negative moment of inertia about {axis}"),
                given.position(key),
            )
            .label(format!("with what is there already the radius is at least {most}"))
            .help(format!(
                "it would be {} at {}",
                with_unit(lacking * gravity, Dim::Force),
                [at.x, at.y, at.z].map(|x| with_unit(x, Dim::Length)).join(", ")
            )));
        }
        *radius = (own.max(0.0) / lacking).sqrt();
    }
    let Some(body) = job.model.bodies.get(&Model::key(given.first_word().unwrap_or_default())) else {
        return Ok(Vec::new());
    };
    let at = in_own_part(job, body, at, given)?;
    Ok(vec![Weight { at, weight: lacking * gravity, radii, span: given.span, ..Weight::default() }])
}
