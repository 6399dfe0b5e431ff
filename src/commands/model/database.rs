//! `DATABASE`: the hydrodynamic database of a body, read from the files of another program.

use crate::commands::menu;
use crate::commands::model::hydrodynamics;
use crate::commands::settings::device::find_file;
use crate::commands::{Call, Command, Effect, Job};
use nalgebra::Vector3;
use std::f64::consts::TAU;
use std::ops::RangeInclusive;
use std::path::Path;
use std::sync::Arc;
use windlass_base::choice::YesNo;
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::geometry::Place;
use windlass_base::span::Span;
use windlass_base::units::Dim;
use windlass_base::values::Args;
use windlass_base::values::Noun;
use windlass_hydro::database::mirror_headings;
use windlass_hydro::database::rao::RaoConvention;
use windlass_hydro::database::wamit::WamitScale;
use windlass_hydro::database::{Database, DatabaseError, SourceFile, aqwa, capytaine, nemoh, rao, wamit};
use windlass_language::select::Owner;
use windlass_language::source::LARGEST_FILE;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, OptionSpec, ValueSpec};
use windlass_model::{AttachedDatabase, Body, DriftMethod, Mass, Model, find};

/// DATABASE.
pub static DATABASE: Command = Command { spec: &SPEC, edits: false, run };

/// Endings of the files of WAMIT that are read.
const WAMIT_ENDINGS: [&str; 9] = ["1", "2", "3", "4", "8", "9", "12d", "12s", "hst"];
/// The largest added mass of a translation in long waves over the mass of the body: generous on both sides, a slender ship along its
/// length being let pass by its heave and a plate under water by its size.
const ADDED: RangeInclusive<f64> = 0.02..=50.0;
/// Natural periods of heave that are let pass (s): from a small buoy to a slender spar.
const HEAVE: RangeInclusive<f64> = 0.5..=200.0;

const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}
const YES_NO: &[ValueSpec] = &[ValueSpec::choice::<YesNo>("YES/NO", "yes or no").or("YES")];

choices! {
    /// What phases of motions are.
    enum PhaseSense {
        /// Behind the crest.
        Lag = "LAG",
        /// Before it.
        Lead = "LEAD",
    }
}

choices! {
    /// Units of angles.
    enum AngleUnit {
        Degrees = "DEG",
        Radians = "RAD",
    }
}

choices! {
    /// Slow drift as a record asks for it.
    enum DriftChoice {
        Newman = "NEWMAN",
        Mean = "MEAN",
        Qtf = "QTF",
        None = "NONE",
    }
}

const WAMIT: OptionSpec = OptionSpec::ours(
    "-WAMIT",
    &[ValueSpec::new("ROOT", Kind::File, "name of the files without their endings")],
    "reads ROOT.1, .3, .4, .8, .9, .12d, .hst, those that there are",
);
const ULEN: OptionSpec = OptionSpec::ours(
    "-ULEN",
    &[number("L", Dim::Length, "length").positive()],
    "length by which WAMIT made its output dimensionless",
)
.default("one metre");
const XBODY: OptionSpec = OptionSpec::ours(
    "-XBODY",
    &[number("X", Dim::Length, "along the x axis of the run"), number("Y", Dim::Length, "along its y axis")],
    "where WAMIT has the origin of the body, XBODY of its run: phases refer to the global origin there, moments to the body",
)
.default("0 0; of a run of several bodies that is warned of");
const NEMOH: OptionSpec = OptionSpec::ours(
    "-NEMOH",
    &[ValueSpec::new("FOLDER", Kind::File, "folder of Nemoh.cal")],
    "reads results of NEMOH 2 or 3",
);
const CAPYTAINE: OptionSpec = OptionSpec::ours(
    "-CAPYTAINE",
    &[ValueSpec::new("FILE", Kind::File, "NetCDF file, classic or version 4")],
    "reads a data set of Capytaine",
);
const AQWA: OptionSpec = OptionSpec::ours(
    "-AQWA",
    &[ValueSpec::new("FILE", Kind::File, "text file of ending AH1")],
    "reads the hydrodynamic database that AQWA-LINE writes with OPTIONS AHD1",
);
const RAO: OptionSpec = OptionSpec::ours(
    "-RAO",
    &[ValueSpec::new("FILE", Kind::File, "text or CSV file")],
    "reads a table of motions, with the columns of OrcaFlex",
);
const PHASE: OptionSpec = OptionSpec::ours(
    "-PHASE",
    &[ValueSpec::choice::<PhaseSense>("LAG/LEAD", "sense")],
    "whether phases of -RAO lag behind the crest or lead it",
)
.default("LAG");
const ROTATION: OptionSpec = OptionSpec::ours(
    "-ROTATION",
    &[ValueSpec::choice::<AngleUnit>("DEG/RAD", "unit")],
    "unit of rotations of -RAO a metre of wave amplitude",
)
.default("DEG");
const INDEX: OptionSpec = OptionSpec::ours(
    "-INDEX",
    &[ValueSpec::new("N", Kind::Integer, "number").in_range(1.0, 1000.0)],
    "which body of a source of several, from 1",
);
const AT: OptionSpec = OptionSpec::ours(
    "-AT",
    &[
        number("X", Dim::Length, "in the body"),
        number("Y", Dim::Length, "in the body"),
        number("Z", Dim::Length, "in the body"),
    ],
    "where the origin of the source stands in the body, of -WAMIT that of the body in its run, of a file of G_PRESSURE the origin that the body had there; axes are those of the body",
)
.default("the body's origin; of -AQWA where its centre of gravity is that of the body");
const SYMMETRIC: OptionSpec =
    OptionSpec::ours("-SYMMETRIC", YES_NO, "adds the headings of the other side of a body with port like starboard")
        .default("NO");
const INFINITE: OptionSpec = OptionSpec::ours(
    "-INFINITE",
    YES_NO,
    "uses the added mass at infinite frequency of the source; NO finds it by Ogilvie's relation",
)
.default("YES, where the source has it");
const MEMORY: OptionSpec =
    OptionSpec::ours("-MEMORY", &[number("T", Dim::Time, "length").positive()], "memory of radiated waves")
        .default("60 s, or up to 300 s until the kernel has died away");
const DRIFT: OptionSpec = OptionSpec::ours(
    "-DRIFT",
    &[ValueSpec::choice::<DriftChoice>("METHOD", "method")],
    "slow drift in time: by Newman's approximation, the mean only, by the QTF of the source, or none",
)
.default("QTF where the source has one, else NEWMAN");
const DD_MULT: OptionSpec = OptionSpec::ours(
    "-DD_MULT",
    &[number("F", Dim::None, "factor").not_negative()],
    "factor of wave drift damping, and of what a current changes of the mean drift; 0 leaves both out",
)
.default("that of the pieces of the body, else 1");
const HYDROSTATICS: OptionSpec = OptionSpec::ours(
    "-HYDROSTATICS",
    YES_NO,
    "whether the hydrostatic stiffness of the source bears the body, which then has no hull",
)
.default("NO");

static SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: &[&menu::INMODEL, &menu::MEDIT],
    data: &[ValueSpec::new("BODY", Kind::Name(Noun::Body), "the body")],
    options: &[
        WAMIT,
        ULEN,
        XBODY,
        NEMOH,
        CAPYTAINE,
        AQWA,
        RAO,
        PHASE,
        ROTATION,
        INDEX,
        AT,
        SYMMETRIC,
        INFINITE,
        MEMORY,
        DRIFT,
        DD_MULT,
        HYDROSTATICS,
    ],
    detail: "One of -WAMIT, -NEMOH, -CAPYTAINE, -AQWA and -RAO is given; a second DATABASE of a body replaces the first. The matrices make added \
             mass at infinite frequency and a memory of radiated waves, the excitation wave forces by the heading of the body, \
             drift coefficients mean and slow drift; a table of motions makes no force. In deep water \
             the mean drift has wave drift damping in surge and sway by the formula of Aranha, which acts on velocities in TDOM, on slow drift in SRESPONSE and on the damping of &STATUS MODES; \
             by the same formula the current of the environment changes the mean drift, in &EQUI too. TDOM prints both, and warns of waves for which the water is not deep: they \
             have no part in it. #DRIFT of the same body would count twice, and is refused but with -DRIFT NONE. Headings of a source are the direction waves travel toward, from its x axis; gaps of more than 90 degrees \
             between them are refused when waves come from there. Density and gravity of WAMIT and RAO are those in force. \
             &STATUS DATABASE reports what was read.",
    example: "&FILE OPEN R ship.rao\n&FILE WRITE R WD WP XA XP ZA ZP RYA RYP\n&FILE WRITE R 0 8 .3 90 .5 20 1.1 -80\n\
              &FILE WRITE R 0 12 .7 90 .9 5 1.4 -85\n&FILE CLOSE R\nMEDIT\n&DESCRIBE BODY SHIP\nDATABASE SHIP -RAO job.ans/ship.rao -AT 100 0 0\nEND\n\
              &STATUS DATABASE",
    ..CommandSpec::new("DATABASE", "the hydrodynamic database of a body")
};

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const BODY: DatumKey<str> = SPEC.word("BODY");
    let args = &call.args;
    let body = find(&job.model.bodies, args.word(BODY).unwrap_or_default(), "body", args.position(BODY))?;
    let name = body.name.clone();
    let weight = Mass::from_parts(job.model.parts_of(body), job.model.defaults.gravity);
    let (source, mut data) = read(job, args)?;
    // AQWA gives the centre of gravity, which is that of the body
    let usual = if args.has(&AQWA) { weight.centre - data.reference } else { Vector3::zeros() };
    let at =
        args.option(&AT).map_or(usual.into(), |given| given.numbers_or_zero(const { AT.numbers(["X", "Y", "Z"]) }));
    data.reference += Vector3::from(at);
    if args.switch(&SYMMETRIC, false) {
        data = mirror_headings(data);
    }
    if !args.switch(&INFINITE, true) {
        data.infinite = None;
    }
    let drift = method(args, &data)?;
    let hydrostatics = args.switch(&HYDROSTATICS, false);
    if hydrostatics && data.hydrostatics.is_none() {
        return Err(Diagnostic::error(format!("{} has no hydrostatics", data.source), source)
            .help("leave out -HYDROSTATICS YES, and give the body a hull or #HYDROSTATIC"));
    }
    let memory = args.option_number(&MEMORY);
    let drift_damping = args.option_number(&DD_MULT);
    let made =
        AttachedDatabase { data: Arc::new(data), at, memory, drift, drift_damping, hydrostatics, span: args.span };
    attach(job, &name, made, source);
    Ok(Effect::Done)
}

/// Gives a body a database, and warns of what looks wrong with it.
pub(super) fn attach(job: &mut Job, body: &str, made: AttachedDatabase, source: Span) {
    let key = Model::key(body);
    let Some(name) = job.model.bodies.get(&key).map(|b| b.name.clone()) else { return };
    let mass = job
        .model
        .bodies
        .get(&key)
        .map_or(0.0, |b| Mass::from_parts(job.model.parts_of(b), job.model.defaults.gravity).mass);
    let data = &made.data;
    let radiation = windlass_hydro::database::radiation::Radiation::new(data);
    // of bodies that were solved together each has its own
    let from = if data.interactions.is_empty() { data.source.clone() } else { format!("{name}, {}", data.source) };
    for text in &data.remarks {
        job.warn(format!("{from}: {text}"), source);
    }
    if radiation.as_ref().is_some_and(|radiation| radiation.has_one_frequency) {
        job.remark(format!("{from}: one frequency serves motions at it; runs in time need more"), source);
    } else if let Some(radiation) = radiation {
        let (text, is_warning) = radiation.quality.sentence(data.infinite.is_some());
        let text = format!("{from}: {text}");
        match (is_warning, data.infinite) {
            (true, _) => job.warn(text, source),
            (false, None) => job.remark(text, source),
            (false, Some(_)) => {}
        }
    }
    if let Some(text) = unlike(data, mass) {
        job.warn(format!("{name}: {text}"), source);
    }
    let span = made.span;
    let old = job.model.bodies.get_mut(&key).and_then(|b| b.database.replace(made));
    if old.is_some() {
        job.remark(format!("the database of {name} is replaced"), span);
    }
    hydrodynamics::settle_pressure(&mut job.model, &name);
    // a body that still stands where it was described may be placed yet: solves say how it stands
    let placed = job.model.bodies.get(&key).filter(|body| {
        let has_stance = body.database.as_ref().is_some_and(|made| made.data.stance.is_some());
        !has_stance || body.position != Place::default()
    });
    for text in placed.map(|body| job.model.stance_warnings_of(body)).unwrap_or_default() {
        job.warn(text, source);
    }
    // of bodies that are given one by one the others may follow: solves say what is left of it
    let alone = |body: &&Body| body.database.as_ref().is_some_and(|made| made.data.interactions.is_empty());
    let body = job.model.bodies.get(&key).filter(alone);
    let caveats = body.map(|body| job.model.database_caveats(body)).unwrap_or_default();
    for text in caveats {
        job.warn(text, source);
    }
}

/// The sign that a database belongs to a body of another size, where its source does not say the mass it was computed for: added
/// mass in no proportion to the mass (kg) of the body, or a stiffness by which it would heave like nothing that floats.
fn unlike(data: &Database, mass: f64) -> Option<String> {
    if data.mass.is_some() || mass <= 0.0 {
        return None;
    }
    let long = data.zero.as_ref().or(data.added_mass.first()).or(data.infinite.as_ref())?;
    let largest = (0..3).map(|i| long[(i, i)].abs()).fold(0.0, f64::max);
    let help = "is it another body's, or are -ULEN or the weight of the body in another unit?";
    let share = largest / mass;
    if !ADDED.contains(&share) {
        return Some(format!(
            "the largest added mass of {} is {share:.2e} of the mass of the body: {help}",
            data.source
        ));
    }
    let stiffness = data.hydrostatics.as_ref().map(|c| c[(2, 2)]).filter(|c| *c > 0.0)?;
    let period = TAU * ((mass + long[(2, 2)].max(0.0)) / stiffness).sqrt();
    (!HEAVE.contains(&period)).then(|| {
        format!(
            "by the stiffness and added mass of {} the body heaves with a period of {period:.2e} s: {help}",
            data.source
        )
    })
}

/// How slow drift is found.
fn method(args: &Args, data: &Database) -> Outcome<DriftMethod> {
    let given = args.option(&DRIFT).and_then(|given| Some((given, given.choice(const { DRIFT.choice("METHOD") })?)));
    let Some((given, method)) = given else {
        return Ok(if data.qtf.is_some() { DriftMethod::Full } else { DriftMethod::Newman });
    };
    let lacks = |what: &str| Diagnostic::error(format!("{} has no {what}", data.source), given.span);
    match method {
        DriftChoice::None => Ok(DriftMethod::None),
        DriftChoice::Qtf if data.qtf.is_none() => Err(lacks("QTF")),
        DriftChoice::Qtf => Ok(DriftMethod::Full),
        DriftChoice::Mean | DriftChoice::Newman if data.drift.is_none() && data.qtf.is_none() => {
            Err(lacks("mean drift"))
        }
        DriftChoice::Mean => Ok(DriftMethod::Mean),
        DriftChoice::Newman => Ok(DriftMethod::Newman),
    }
}

/// Reads the source that is given, with its place.
fn read(job: &Job, args: &Args) -> Outcome<(Span, Database)> {
    const SOURCES: [OptionSpec; 5] = [WAMIT, NEMOH, CAPYTAINE, AQWA, RAO];
    let mut given = args.options.iter().filter(|given| given.is_any(&SOURCES));
    let Some(source) = given.next() else {
        return Err(Diagnostic::error("DATABASE lacks its source", args.span)
            .help("form: DATABASE BODY -WAMIT ROOT | -NEMOH FOLDER | -CAPYTAINE FILE | -AQWA FILE | -RAO FILE"));
    };
    if let Some(second) = given.next() {
        return Err(Diagnostic::error("a body has one database", second.span).other(source.span, "first given here"));
    }
    for (option, of) in [(&ULEN, &WAMIT), (&XBODY, &WAMIT), (&PHASE, &RAO), (&ROTATION, &RAO)] {
        if let Some(other) = args.option(option).filter(|_| !source.is(of)) {
            let text = format!("{} goes with {}, not with {}", option.name, of.name, source.option.name);
            return Err(Diagnostic::error(text, other.span).other(source.span, "the source"));
        }
    }
    let name = source.first_word().unwrap_or_default();
    let span = source.first_place();
    let body = args.option_integer(&INDEX).and_then(|n| usize::try_from(n).ok());
    let around = job.model.surroundings();
    let (density, gravity, depth) = (around.water_density, around.gravity, around.depth);
    let made = match source {
        _ if source.is(&WAMIT) => {
            let files = files(job, WAMIT_ENDINGS.iter().map(|e| format!("{name}.{e}")), span)?;
            if files.is_empty() {
                return Err(Diagnostic::error(
                    format!("there is no file {name}.1, {name}.3 or of another ending"),
                    span,
                ));
            }
            let length = args.option_number(&ULEN).unwrap_or(1.0);
            let origin = args.option(&XBODY).map(|given| given.numbers_or_zero(const { XBODY.numbers(["X", "Y"]) }));
            wamit::read(name, &files, &WamitScale { length, density, gravity, depth, body, origin })
        }
        _ if source.is(&NEMOH) => {
            let n = body.unwrap_or(1) - 1;
            let inner = ["results", "Results"]
                .iter()
                .flat_map(|f| ["RadiationCoefficients.tec", "ExcitationForce.tec"].map(|e| format!("{name}/{f}/{e}")));
            let hull = ["mesh", "Mesh"].iter().flat_map(|f| {
                [
                    format!("{name}/{f}/KH.dat"),
                    format!("{name}/{f}/KH_{n}.dat"),
                    format!("{name}/{f}/Hydrostatics.dat"),
                    format!("{name}/{f}/Hydrostatics_{n}.dat"),
                ]
            });
            let names = std::iter::once(format!("{name}/Nemoh.cal")).chain(inner).chain(hull);
            nemoh::read(name, &files(job, names, span)?, body)
        }
        _ if source.is(&CAPYTAINE) => capytaine::read(
            name,
            &bytes(job, &crate::commands::settings::device::readable(job, name, span)?, name, span)?,
            body,
        ),
        _ if source.is(&AQWA) => {
            refuse_binary(name, span)?;
            let file = text(job, &crate::commands::settings::device::readable(job, name, span)?, name, span)?;
            aqwa::read(name, &file, body)
        }
        _ => {
            let file = text(job, &crate::commands::settings::device::readable(job, name, span)?, name, span)?;
            let phase = args.option_choice(&PHASE, const { PHASE.choice("LAG/LEAD") });
            let rotation = args.option_choice(&ROTATION, const { ROTATION.choice("DEG/RAD") });
            let lag = phase.unwrap_or(PhaseSense::Lag) == PhaseSense::Lag;
            let degrees = rotation.unwrap_or(AngleUnit::Degrees) == AngleUnit::Degrees;
            rao::read(name, &file, &RaoConvention { lag, degrees, density, gravity, depth })
        }
    };
    Ok((span, made.map_err(|e: DatabaseError| Diagnostic::error(format!("{e}"), span))?))
}

/// Refuses the binary files of AQWA by their endings.
fn refuse_binary(name: &str, span: Span) -> Outcome<()> {
    let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending).to_ascii_uppercase();
    if ["HYD", "RES", "PLT", "POT", "USS", "EQP"].contains(&ending.as_str()) {
        return Err(Diagnostic::error(format!("{name} is a binary file of AQWA, whose form is not public"), span)
            .help("run the deck of AQWA-LINE with OPTIONS AHD1 END: it then writes the same database as text, in a file of ending AH1"));
    }
    Ok(())
}

/// Those files that there are.
fn files(job: &Job, names: impl Iterator<Item = String>, span: Span) -> Outcome<Vec<SourceFile>> {
    let mut list = Vec::new();
    for name in names {
        let path = find_file(job, &name);
        if path.is_file() {
            list.push(text(job, &path, &name, span)?);
        }
    }
    Ok(list)
}

/// A file as text; what is no UTF-8 is replaced, and then refused as no number where it matters.
fn text(job: &Job, path: &Path, name: &str, span: Span) -> Outcome<SourceFile> {
    let bytes = bytes(job, path, name, span)?;
    Ok(SourceFile { name: name.to_string(), text: String::from_utf8_lossy(&bytes).into_owned() })
}

/// The bytes of a file that is not too large.
fn bytes(job: &Job, path: &Path, name: &str, span: Span) -> Outcome<Vec<u8>> {
    let unusable = |why: String| Diagnostic::error(format!("{name} cannot be used: {why}"), span);
    crate::commands::settings::device::read_input(job, path, LARGEST_FILE).map_err(|e| unusable(e.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix6, Vector6};

    #[test]
    fn database_of_another_body_size_is_detected() {
        // a hemisphere of 10 m: 2.1E6 kg, added mass of 0.83 of it in long waves, 3.2E6 N/m
        let data = |size: f64, stiffness: f64| Database {
            zero: Some(Matrix6::identity() * 1.8e6 * size.powi(3)),
            hydrostatics: Some(Matrix6::from_diagonal(&Vector6::new(0.0, 0.0, 3.2e6 * stiffness, 0.0, 0.0, 0.0))),
            ..Database::default()
        };
        assert_eq!(unlike(&data(1.0, 1.0), 2.1e6), None);
        assert!(unlike(&data(0.1, 0.01), 2.1e6).is_some_and(|t| t.contains("8.57e-4 of the mass")));
        assert!(unlike(&data(10.0, 100.0), 2.1e6).is_some_and(|t| t.contains("8.57e2 of the mass")));
        // 2 pi sqrt(3.9E6 / 32)
        assert!(unlike(&data(1.0, 1e-5), 2.1e6).is_some_and(|t| t.contains("period of 2.19e3 s")));
        assert_eq!(unlike(&data(0.1, 1.0), 0.0), None);
    }
}
