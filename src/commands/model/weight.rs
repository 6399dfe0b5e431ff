//! `#WEIGHT` and `&WEIGHT`.
//!
//! Source: [MOSES-HELP lgroup, modeling].

use crate::commands::menu;
use crate::commands::{Call, Command, Effect, Job};
use nalgebra::{Matrix3, Vector3};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::spec::ValueKey;
use windlass_base::units::eight_figures;
use windlass_base::units::{Dim, UnitSystem};
use windlass_base::values::Given;
use windlass_base::values::Noun;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, OptionSpec, ValueSpec};
use windlass_model::{Mass, Model, Weight, find};

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

static ITEM_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::INMODEL, &menu::MEDIT],
    data: &[
        ValueSpec::new("*PT", Kind::Name(Noun::Point), "where it is"),
        number("W", Dim::Force, "the weight"),
        RADII[0],
        RADII[1],
        RADII[2],
    ],
    detail: "A weight of the part that the point belongs to, as many as are wanted. The radii of gyration are about axes through the \
             point, along those of the part; without them it is a point. A negative weight takes off what other records put on. The point is \
             defined before, and what counts is where it stands when the record is read.",
    example: "MEDIT\n&DESCRIBE BODY TBRG\n*CG 200 0 12\n#WEIGHT *CG 23000 35 115 118\nEND\n&STATUS WEIGHT",
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
    &[BODY, number("PERCENT", Dim::None, "percentage of each weight that is added").in_range(-100.0, 1000.0)],
    "makes every weight of a body larger by a percentage; several compound",
)
.many();

/// The radii of gyration of `-TOTAL`.
const RADII_OF_TOTAL: [ValueKey<f64>; 3] = TOTAL.numbers(["KX", "KY", "KZ"]);

static SPEC: CommandSpec = CommandSpec {
    options: &[TOTAL, MARGIN],
    detail: "Options act in the order given. -TOTAL: radii of gyration are those of the whole body about axes through its centre of \
             gravity, along those of the body; one weight is added to the body's own part with the weight, the place and the radii that are \
             missing. Where the weights there already weigh more than the total, or have more inertia about its centre, nothing can be \
             added and the record is refused. Products of inertia are those that result. -MARGIN keeps centres and radii.",
    example: "MEDIT\n&DESCRIBE BODY TBRG\n*CRANE 350 0 60\n#WEIGHT *CRANE 800\nEND\n&WEIGHT -TOTAL TBRG 23000 200 0 12 38 118 120\n\
              &WEIGHT -MARGIN TBRG 3\n&STATUS WEIGHT",
    ..CommandSpec::new("&WEIGHT", "completes or enlarges the weight of a body")
};

fn item(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const POINT: DatumKey<str> = ITEM_SPEC.word("*PT");
    const WEIGHT: DatumKey<f64> = ITEM_SPEC.number("W");
    const OWN_RADII: [DatumKey<f64>; 3] = ITEM_SPEC.numbers(["KX", "KY", "KZ"]);
    let args = &call.args;
    let model = &job.model;
    let point = find(&model.points, args.word(POINT).unwrap_or_default(), "point", args.place(POINT))?;
    if model.body_of(point).is_none() {
        return Err(Diagnostic::error(
            format!("{} is a point of the ground and carries no weight", point.name),
            args.place(POINT),
        )
        .other(point.span, "defined here")
        .help("points behind &DESCRIBE BODY or PART belong to it"));
    }
    let radii = args.numbers_or_zero(OWN_RADII);
    let weight = args.number(WEIGHT).unwrap_or_default();
    if weight == 0.0 {
        return Err(Diagnostic::error("a weight of zero weighs nothing", args.place(WEIGHT))
            .label(if radii == [0.0; 3] { "" } else { "radii of gyration need a weight" }));
    }
    let (at, key, span) = (point.at, Model::key(&point.part), args.place(WEIGHT));
    if let Some(text) = no_body_has(radii, job.units) {
        job.warn(text, args.place(OWN_RADII[0]));
    }
    if let Some(part) = job.model.parts.get_mut(&key) {
        part.weights.push(Weight { at, weight, radii, span });
    }
    Ok(Effect::Done)
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
        return Err(Diagnostic::error("&WEIGHT lacks what to do", call.args.span).help("options: -TOTAL, -MARGIN"));
    }
    for given in &call.args.options {
        let place = given.first_place();
        let body = find(&job.model.bodies, given.first_word().unwrap_or_default(), "body", place)?.clone();
        match given {
            _ if given.is(&TOTAL) => {
                let made =
                    missing(job, given, &Mass::from_parts(job.model.parts_of(&body), job.model.defaults.gravity))?;
                if let [Some(x), Some(y), Some(z)] = RADII_OF_TOTAL.map(|key| given.number(key))
                    && let Some(text) = no_body_has([x, y, z], job.units)
                {
                    job.warn(text, given.span);
                }
                if let Some(part) = job.model.parts.get_mut(&Model::key(&body.name)) {
                    part.weights.extend(made);
                }
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
                    return Err(Diagnostic::error(format!("{} has no weight to enlarge", body.name), place));
                }
            }
        }
    }
    Ok(Effect::Done)
}

/// The weight that a body lacks of a total; `None` when it lacks nothing.
///
/// # Errors
/// Weights there already that no positive weight can bring to the total.
fn missing(job: &Job, given: &Given, now: &Mass) -> Outcome<Option<Weight>> {
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
        return Err(Diagnostic::error("the weights there already weigh more than the total", given.place(WEIGHT))
            .label(format!("they weigh {}", with_unit(now.mass * gravity, Dim::Force))));
    }
    let moment = centre * total - now.centre * now.mass;
    if lacking <= size {
        let off = (now.centre - centre).norm();
        return if off <= 1e-9 * (centre.norm() + now.centre.norm()) {
            Ok(None)
        } else {
            Err(Diagnostic::error("nothing is left to add, and the centre of gravity is elsewhere", given.place(X))
                .label(format!("the weights there already make the total, {} from here", with_unit(off, Dim::Length))))
        };
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
                given.place(key),
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
    let part = job.model.parts.get(&Model::key(given.first_word().unwrap_or_default()));
    let place = part.map(|p| p.place).unwrap_or_default();
    if place.turn != [0.0; 3] {
        let text = "-TOTAL adds to the body's own part, and that is turned within the body";
        return Err(Diagnostic::error(text, given.span).help("&DESCRIBE PART NAME -MOVE turns parts"));
    }
    let at: [f64; 3] = (at - Vector3::from(place.shift)).into();
    Ok(Some(Weight { at, weight: lacking * gravity, radii, span: given.span }))
}
