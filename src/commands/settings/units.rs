//! `&DIMEN` and `&DEFAULT`.

use crate::commands::environment::env;
use crate::commands::environment::probability::{self, PROBABILITY};
use crate::commands::model::describe::PLACE;
use crate::commands::model::element::set_directions;
use crate::commands::{Call, Command, Effect, Job};
use nalgebra::{Matrix3, Rotation3, Vector3};
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::geometry::Place;
use windlass_base::span::Span;
use windlass_base::spec::ValueKey;
use windlass_base::units::{Dim, ForceUnit, LengthUnit, UnitSystem};
use windlass_base::values::Given;
use windlass_language::number::evaluate;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec};
use windlass_model::{Coordinates, Model, find};

/// &DIMEN.
pub static DIMEN: Command = Command { spec: &DIMEN_SPEC, edits: false, run: dimen };
/// &DEFAULT.
pub static DEFAULT: Command = Command { spec: &DEFAULT_SPEC, edits: false, run: default };

const SAVE: OptionSpec = OptionSpec::new("-SAVE", &[], "keeps the present units for -REMEMBER");
const DIMEN_OPTION: OptionSpec = OptionSpec::new(
    "-DIMEN",
    &[
        ValueSpec::choice::<LengthChoice>("LENGTH", "length unit"),
        ValueSpec::choice::<ForceChoice>("FORCE", "force unit"),
    ],
    "sets the units of all that follows",
);
const REMEMBER: OptionSpec = OptionSpec::new("-REMEMBER", &[], "goes back to the units saved last");

static DIMEN_SPEC: CommandSpec = CommandSpec {
    options: &[SAVE, DIMEN_OPTION, REMEMBER],
    detail: "FEET go with KIPS, L-TONS and S-TONS (sections in inches, stress in ksi), METERS with K-NTS and M-TONS (mm, \
             MPa); KN, N and NEWTONS are ours. The model is kept in SI: changing units never changes it.",
    example: "&DIMEN -SAVE -DIMEN METERS K-NTS\n&STATUS DIMENSIONS\n&DIMEN -REMEMBER",
    ..CommandSpec::new("&DIMEN", "sets the units")
};

choices! {
    /// Units of length.
    enum LengthChoice {
        Feet = "FEET",
        Meters = "METERS",
    }
}

choices! {
    /// Units of force, with the names of ours.
    enum ForceChoice {
        Kips = "KIPS",
        LongTons = "L-TONS",
        ShortTons = "S-TONS",
        KNts = "K-NTS",
        MetricTons = "M-TONS",
        Kilonewtons = "KN",
        N = "N",
        Newtons = "NEWTONS",
    }
}

fn dimen(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let mut units = job.units;
    let mut saved = job.saved_units.clone();
    for given in &call.args.options {
        match given {
            _ if given.is(&SAVE) => saved.push(units),
            _ if given.is(&REMEMBER) => {
                units = saved.pop().ok_or_else(|| {
                    Diagnostic::error("no units have been saved", given.span).help("&DIMEN -SAVE saves them")
                })?;
            }
            _ => {
                const FORCE: ValueKey<ForceChoice> = DIMEN_OPTION.choice("FORCE");
                let (Some(length), Some(force)) =
                    (given.choice(const { DIMEN_OPTION.choice("LENGTH") }), given.choice(FORCE))
                else {
                    continue;
                };
                let length = match length {
                    LengthChoice::Feet => LengthUnit::Feet,
                    LengthChoice::Meters => LengthUnit::Meters,
                };
                let force = match force {
                    ForceChoice::Kips => ForceUnit::Kips,
                    ForceChoice::LongTons => ForceUnit::LongTons,
                    ForceChoice::ShortTons => ForceUnit::ShortTons,
                    ForceChoice::MetricTons => ForceUnit::MetricTons,
                    ForceChoice::KNts | ForceChoice::Kilonewtons => ForceUnit::Kilonewtons,
                    ForceChoice::N | ForceChoice::Newtons => ForceUnit::Newtons,
                };
                let feet = matches!(force, ForceUnit::Kips | ForceUnit::LongTons | ForceUnit::ShortTons);
                if feet != (length == LengthUnit::Feet) {
                    let span = given.position(FORCE);
                    let fitting =
                        if length == LengthUnit::Feet { "KIPS, L-TONS or S-TONS" } else { "K-NTS, M-TONS or N" };
                    return Err(Diagnostic::error("this force unit does not go with this length unit", span)
                        .label(format!("expected {fitting}")));
                }
                units = UnitSystem { length, force };
            }
        }
    }
    (job.units, job.saved_units) = (units, saved);
    Ok(Effect::Done)
}

const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}

const SAVE_DEFAULTS: OptionSpec = OptionSpec::new("-SAVE", &[], "keeps the present defaults for -REMEMBER");
const REMEMBER_DEFAULTS: OptionSpec = OptionSpec::new("-REMEMBER", &[], "goes back to the defaults saved last");
const SPGRAVITY: OptionSpec = OptionSpec::new(
    "-SPGRAVITY",
    &[number("SPGR", Dim::None, "specific gravity").positive()],
    "specific gravity of materials",
);
const DENSITY: OptionSpec =
    OptionSpec::new("-DENSITY", &[number("RHO", Dim::Density, "density").positive()], "density of materials");
const EMODULUS: OptionSpec =
    OptionSpec::new("-EMODULUS", &[number("EMOD", Dim::Stress, "Young's modulus").positive()], "Young's modulus");
const POI_RAT: OptionSpec = OptionSpec::new(
    "-POI_RAT",
    &[number("POIRAT", Dim::None, "Poisson's ratio").in_range(0.0, 0.5)],
    "Poisson's ratio",
);
const ALPHA: OptionSpec =
    OptionSpec::new("-ALPHA", &[number("ALPHA", Dim::ThermalExpansion, "thermal expansion")], "thermal expansion");
const FYIELD: OptionSpec =
    OptionSpec::new("-FYIELD", &[number("FYIELD", Dim::Stress, "yield stress").positive()], "yield stress");
const TENSTR: OptionSpec =
    OptionSpec::new("-TENSTR", &[number("TENSTR", Dim::Stress, "ultimate stress").positive()], "ultimate stress")
        .default("yield / 0.6");
const WATER: OptionSpec =
    OptionSpec::new("-WATER", &[number("RHO", Dim::Density, "density").positive()], "density of sea water");
const SPGWATER: OptionSpec = OptionSpec::new(
    "-SPGWATER",
    &[number("SG", Dim::None, "specific gravity").positive()],
    "specific gravity of sea water",
);
const DEPTH: OptionSpec = OptionSpec::new("-DEPTH", &[number("DEPTH", Dim::Length, "depth").positive()], "water depth");
const RAMP: OptionSpec =
    OptionSpec::new("-RAMP", &[number("T", Dim::Time, "time").not_negative()], "ramp of time-domain runs");
/// `-RECT`.
pub(crate) const RECT: OptionSpec = OptionSpec::new("-RECT", &[], "points are given by x y z");
/// `-CYLINDER`.
pub(crate) const CYLINDER: OptionSpec = OptionSpec::new("-CYLINDER", &[], "points are given by radius, angle, z");
/// `-SPHERICAL`.
pub(crate) const SPHERICAL: OptionSpec =
    OptionSpec::new("-SPHERICAL", &[], "points are given by radius, angle, angle above the plane");
/// `-LOCATION`.
pub(crate) const LOCATION: OptionSpec = OptionSpec::new(
    "-LOCATION",
    &[
        PLACE[0],
        PLACE[1],
        PLACE[2],
        ValueSpec::new("RX", Kind::Item, "roll (degrees), or *P1: from *P1 to *P2 is the local x").or("0"),
        ValueSpec::new("RY", Kind::Item, "pitch, or *P2").or("0"),
        ValueSpec::new("RZ", Kind::Item, "yaw, or *P3: the local y is on the side toward which *P3 to *P4 leads")
            .or("0"),
        ValueSpec::new("*P4", Kind::Item, "fourth of the points").or("none"),
    ],
    "points are given by x y z in a system that stands here in the part",
);
const PERIOD: OptionSpec =
    OptionSpec::new("-PERIOD", &[number("T", Dim::Time, "period").positive()], "periods of RAO where it gives none")
        .repeating(1);
const HEADING: OptionSpec = OptionSpec::new(
    "-HEADING",
    &[number("H", Dim::Angle, "where the waves come from, from +X toward +Y")],
    "headings of RAO where it gives none",
)
.repeating(1);
const T_REINF: OptionSpec = OptionSpec::new(
    "-T_REINFORCE",
    &[number("TB", Dim::Time, "time")],
    "time of reinforcement of environments defined after that give none",
);
const SP_ORIENT: OptionSpec = OptionSpec::new(
    "-SP_ORIENT",
    &[number("V", Dim::None, "component")],
    "axes of a STATIC_PROCESS, which is not in windlass",
)
.repeating(1)
.without_effect();
const DIR_BEAM: OptionSpec = OptionSpec::new(
    "-DIR_BEAM",
    &[ValueSpec::new("V", Kind::Item, "X, Y or Z, or three components in the part; of one direction or two")],
    "local z of beams is in the plane of the beam and this direction; the second counts where a beam runs along the first",
)
.repeating(1)
.default("0 0 1 1 0 0 (our reading)");
const DIR_PLATE: OptionSpec = OptionSpec::new(
    "-DIR_PLATE",
    &[ValueSpec::new("V", Kind::Item, "axis or component")],
    "axes of stresses in plates",
)
.repeating(1)
.without_effect();
const AIR: OptionSpec =
    OptionSpec::new("-AIR", &[number("RHO", Dim::Density, "density").positive()], "density of air").owner(Owner::Ours);
const GRAVITY: OptionSpec =
    OptionSpec::new("-GRAVITY", &[number("G", Dim::Acceleration, "gravity").positive()], "gravity").owner(Owner::Ours);

static DEFAULT_SPEC: CommandSpec = CommandSpec {
    options: &[
        SAVE_DEFAULTS,
        REMEMBER_DEFAULTS,
        SPGRAVITY,
        DENSITY,
        EMODULUS,
        POI_RAT,
        ALPHA,
        FYIELD,
        TENSTR,
        WATER,
        SPGWATER,
        DEPTH,
        RAMP,
        RECT,
        CYLINDER,
        SPHERICAL,
        LOCATION,
        PERIOD,
        HEADING,
        PROBABILITY,
        T_REINF,
        SP_ORIENT,
        DIR_BEAM,
        DIR_PLATE,
        AIR,
        GRAVITY,
    ],
    absent: &[("-SN", "&REP_SELECT -SN and -C_SN of a class choose fatigue curves")],
    detail: "What holds where a record gives no value; &STATUS DEFAULTS lists all. Defaults hold for classes and points defined after. The angles \
             of -LOCATION are roll, pitch and yaw, as of a part (our reading). Of -LOCATION X Y Z *P1 *P2 *P3 *P4 the local x leads from *P1 to *P2, the local z is normal to it and to the way from *P3 to *P4, as \
             Z of &POINT(EULER_ANGLES ..) is (our reading).",
    example: "&DEFAULT -SAVE -EMODULUS 12000\n&STATUS DEFAULTS\n&DEFAULT -REMEMBER",
    ..CommandSpec::new("&DEFAULT", "sets defaults")
};

fn default(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let mut defaults = job.model.defaults;
    let mut waves = job.model.wave_defaults.clone();
    let mut saved = job.model.saved_defaults.clone();
    let mut remarks = Vec::new();
    for given in &call.args.options {
        let value = given.values.first().and_then(|v| v.number()).unwrap_or(0.0);
        let material = &mut defaults.material;
        match given {
            _ if given.is(&LOCATION) => {
                let shift = given.numbers_or_zero(const { LOCATION.numbers(["X", "Y", "Z"]) });
                defaults.coordinates = Coordinates::Placed(Place { shift, turn: turn_of_location(job, given)? });
            }
            _ if given.is(&PERIOD) => {
                env::periods(given)?;
                waves.periods = given.numbers();
            }
            _ if given.is(&HEADING) => waves.headings = given.numbers(),
            _ if given.is(&PROBABILITY) => {
                probability::check(given)?;
                waves.probability = Some(given.clone());
            }
            _ if given.is(&T_REINF) => waves.reinforcement = Some(value),
            _ if given.is(&DIR_BEAM) => set_directions(&mut defaults.beam_direction, given)?,
            _ if given.is_any(&[SP_ORIENT, DIR_PLATE]) => {
                remarks.push((format!("{} has no effect in windlass", given.name()), given.span));
            }
            _ if given.is(&SAVE_DEFAULTS) => saved.push((defaults, waves.clone())),
            _ if given.is(&REMEMBER_DEFAULTS) => {
                (defaults, waves) = saved.pop().ok_or_else(|| {
                    Diagnostic::error("no defaults have been saved", given.span).help("&DEFAULT -SAVE saves them")
                })?;
            }
            _ if given.is(&SPGRAVITY) => material.density = 1000.0 * value,
            _ if given.is(&DENSITY) => material.density = value,
            _ if given.is(&EMODULUS) => material.emodulus = value,
            _ if given.is(&POI_RAT) => material.poisson = value,
            _ if given.is(&ALPHA) => material.expansion = value,
            _ if given.is(&FYIELD) => material.yield_stress = value,
            _ if given.is(&TENSTR) => material.ultimate_stress = Some(value),
            _ if given.is(&WATER) => defaults.water_density = value,
            _ if given.is(&SPGWATER) => defaults.water_density = 1000.0 * value,
            _ if given.is(&DEPTH) => defaults.depth = Some(value),
            _ if given.is(&RAMP) => defaults.ramp = value,
            _ if given.is(&RECT) => defaults.coordinates = Coordinates::Rectangular,
            _ if given.is(&CYLINDER) => defaults.coordinates = Coordinates::Cylindrical,
            _ if given.is(&SPHERICAL) => defaults.coordinates = Coordinates::Spherical,
            _ if given.is(&AIR) => defaults.air_density = value,
            _ => defaults.gravity = value,
        }
    }
    (job.model.defaults, job.model.wave_defaults, job.model.saved_defaults) = (defaults, waves, saved);
    remarks.into_iter().for_each(|(text, span)| job.remark(text, span));
    Ok(Effect::Done)
}

/// The turn of the system of -LOCATION (rad): of its angles, or that its four points give.
///
/// # Errors
/// Words that are neither, points that give no axes.
fn turn_of_location(job: &Job, given: &Given) -> Outcome<[f64; 3]> {
    let words: Vec<(&str, Span)> = given.values.iter().filter_map(|v| Some((v.word()?, v.span))).collect();
    if words.iter().all(|(word, _)| !word.starts_with('*')) {
        let mut turn = [0.0; 3];
        if let Some((word, span)) = words.get(turn.len()) {
            return Err(Diagnostic::error(format!("-LOCATION takes three angles; `{word}` is one more"), *span));
        }
        for (angle, (word, span)) in turn.iter_mut().zip(&words) {
            let value = evaluate(word).map_err(|e| {
                Diagnostic::error("an angle of -LOCATION must be a number (degrees), or four points follow Z", *span)
                    .label(e.to_string())
            })?;
            *angle = value.to_radians();
        }
        return Ok(turn);
    }
    let [p1, p2, p3, p4] = words.as_slice() else {
        let text = format!("-LOCATION takes four points after Z, and {} are given", words.len());
        return Err(Diagnostic::error(text, given.span).help("form: -LOCATION X Y Z *P1 *P2 *P3 *P4"));
    };
    let model = &job.model;
    let way = |(from, _): &(&str, Span), (to, at): &(&str, Span), first: Span| -> Outcome<Vector3<f64>> {
        let [from, to] = [find(&model.points, from, "point", first)?, find(&model.points, to, "point", *at)?];
        if Model::key(&from.part) != Model::key(&to.part) {
            return Err(Diagnostic::error(format!("{} and {} are of different parts", from.name, to.name), *at));
        }
        Ok(Vector3::from(to.at) - Vector3::from(from.at))
    };
    let no_axes =
        || Diagnostic::error("these points give no axes: they coincide, or the two ways are parallel", given.span);
    let x = way(p1, p2, p1.1)?.try_normalize(0.0).ok_or_else(no_axes)?;
    let side = way(p3, p4, p3.1)?.try_normalize(0.0).ok_or_else(no_axes)?;
    const LEAST_SINE: f64 = 1e-9;
    let z = x.cross(&side).try_normalize(LEAST_SINE).ok_or_else(no_axes)?;
    let axes = Matrix3::from_columns(&[x, z.cross(&x), z]);
    let (roll, pitch, yaw) = Rotation3::from_matrix_unchecked(axes).euler_angles();
    Ok([roll, pitch, yaw])
}
