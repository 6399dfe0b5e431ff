//! PRESCRIBE: bodies whose motion is given.

mod input;

use crate::commands::menu;
use crate::commands::{Call, Command, Effect, Job};
use std::f64::consts::TAU;
use std::sync::Arc;
use windlass_base::choice::Dof;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::geometry::Place;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_base::values::Noun;
use windlass_base::values::{Args, Given};
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, OptionSpec, ValueSpec};
use windlass_model::{ClassError, GivenMotion, Model, Prescription, Sinusoid, find};
use windlass_solve::DOFS;
use windlass_solve::time::build_prescribed;

/// PRESCRIBE.
pub static PRESCRIBE: Command = Command { spec: &SPEC, edits: false, run };

const FILE: [ValueSpec; 1] =
    [ValueSpec::new("FILE", Kind::File, "CSV file; looked for beside the script, or where it says")];

const SINUSOID: OptionSpec = OptionSpec::new(
    "-SINUSOID",
    &[
        ValueSpec::choice::<Dof>("DOF", "degree of freedom of its origin, roll, pitch and yaw as RX RY RZ"),
        ValueSpec::new("AMP", Kind::Number(Dim::None), "amplitude: a length, or an angle in degrees"),
        ValueSpec::new("PERIOD", Kind::Number(Dim::Time), "period").positive(),
        ValueSpec::new("PHASE", Kind::Number(Dim::Angle), "phase at the time zero").or("0"),
    ],
    "AMP sin(2 pi t / PERIOD + PHASE) in a degree of freedom; several add up",
)
.many();
const RAMP: OptionSpec = OptionSpec::new(
    "-RAMP",
    &[ValueSpec::new("T", Kind::Number(Dim::Time), "time").not_negative()],
    "time over which sinusoids grow from nothing",
)
.default("0: they are there at once");
const RAO: OptionSpec = OptionSpec::new("-RAO", &FILE, "responses to the waves of the sea");
const SYMMETRIC: OptionSpec =
    OptionSpec::new("-SYMMETRIC", &[], "the responses of -RAO are of one side: those of the other are mirrored");
const FILE_OPTION: OptionSpec = OptionSpec::new("-FILE", &FILE, "places at times");
const FREE: OptionSpec = OptionSpec::new("-FREE", &[], "forces move it again");

static SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: &[&menu::INMODEL, &menu::MEDIT],
    data: &[ValueSpec::new("BODY", Kind::Name(Noun::Body), "the body")],
    options: &[SINUSOID, RAMP, RAO, SYMMETRIC, FILE_OPTION, FREE],
    detail: "The body follows the prescribed motion in TDOM whatever forces act on it; its connectors follow it. In equilibria it \
             stands where it is. -SINUSOID and -RAO move it about the place where it stands when the run begins, in global axes; angles add to \
             roll, pitch and yaw. A row of the -RAO file is a heading from which waves come (degrees, from the body's x axis toward \
             its y axis; 0 comes from ahead of x), a period (s), and for surge, sway, heave, roll, pitch, yaw each an amplitude (length a length, or \
             degrees a length unit of wave amplitude) and the lag in degrees behind the crest at the body's origin: 14 numbers. It is \
             interpolated over frequency and heading; waves longer than the longest have its response, shorter ones than the \
             shortest none. When an action brings another environment, the body rides on its waves at once, as they are there at once. A row of -FILE is a time (s), x, y, z and roll, pitch, yaw (degrees) of the body's origin: a \
             natural cubic spline goes through them, so that velocity and acceleration have no jumps; roll and yaw go the short way \
             from row to row. The record puts the body to its place at the time zero; a run beyond the last row is an error. A first row of \
             words, and rows that begin with #, are passed over.",
    example: "&DIMEN -DIMEN METERS K-NTS\n&FILE OPEN M path.csv\n&FILE WRITE M time,x,y,z,roll,pitch,yaw\n&FILE WRITE M 0,0,0,0,0,0,0\n\
              &FILE WRITE M 10,1,0,0,0,0,5\n&FILE WRITE M 20,0,0,0,0,0,0\n&FILE CLOSE M\nMEDIT\n&DESCRIBE BODY CRANE\n*HOOK 0 0 40\nEND\nMEDIT\n\
              PRESCRIBE CRANE -SINUSOID Z 1.5 9 -SINUSOID RY 2 9 90 -RAMP 20\nPRESCRIBE CRANE -FILE job.ans/path.csv\nPRESCRIBE CRANE -FREE\nEND",
    ..CommandSpec::new("PRESCRIBE", "gives a body its motion")
};

/// Options that say how a body moves.
const KINDS: [OptionSpec; 4] = [SINUSOID, RAO, FILE_OPTION, FREE];

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const BODY: DatumKey<str> = SPEC.word("BODY");
    let args = &call.args;
    let body = find(&job.model.bodies, args.word(BODY).unwrap_or_default(), "body", args.position(BODY))?;
    if body.junction.is_some() {
        return Err(Diagnostic::error(format!("{} is a junction, not a body", body.name), args.position(BODY)));
    }
    let key = Model::key(&body.name);
    let kind = kind(args)?;
    for (option, of) in [(RAMP, SINUSOID), (SYMMETRIC, RAO)] {
        if let Some(given) = args.option(&option).filter(|_| !kind.is(&of)) {
            return Err(Diagnostic::error(format!("{} belongs to {}", option.name, of.name), given.span));
        }
    }
    let file = || (kind.first_word().unwrap_or_default(), kind.first_place());
    let motion = match kind {
        _ if kind.is(&FREE) => None,
        _ if kind.is(&RAO) => {
            Some(GivenMotion::Responses(Arc::new(input::responses(job, file(), args.has(&SYMMETRIC))?)))
        }
        _ if kind.is(&FILE_OPTION) => Some(GivenMotion::Path(Arc::new(input::path(job, file())?))),
        _ => Some(sinusoids(job, args)),
    };
    let mut moved = body.clone();
    moved.prescribed = motion.map(|motion| Prescription { motion, span: args.span });
    if let Some(Prescription { motion: GivenMotion::Path(rows), .. }) = &moved.prescribed {
        let wrong = |e: ClassError| e.diagnostic(args.span, job.units);
        let start = job.model.environment.run_start;
        let given = build_prescribed(&moved, None, start).map_err(wrong)?;
        let placed = given.map(|g| g.motion_at(start)).transpose().map_err(wrong)?.unwrap_or_default();
        let near =
            rows.iter().min_by(|a, b| (a.0 - start).abs().total_cmp(&(b.0 - start).abs())).map(|r| Place::new(r.1));
        moved.previous = moved.position;
        moved.position = placed.pose.position(&near.unwrap_or_default());
    }
    job.model.bodies.insert(key, moved);
    Ok(Effect::Done)
}

/// The one option that says how the body moves; of several sinusoids the first.
fn kind(args: &Args) -> Outcome<&Given> {
    let mut given = args.options.iter().filter(|given| given.is_any(&KINDS));
    let Some(first) = given.next() else {
        return Err(Diagnostic::error("the record does not say how the body moves", args.span)
            .help(KINDS.map(|option| option.name).join(", ")));
    };
    match given.find(|given| !given.is(first.option)) {
        Some(other) => {
            let text = format!("{} and {} are two motions of one body", first.name(), other.name());
            Err(Diagnostic::error(text, other.span).other(first.span, "first given here"))
        }
        None => Ok(first),
    }
}

fn sinusoids(job: &Job, args: &Args) -> GivenMotion {
    let one = |given: &Given| {
        let dof: Dof = given.choice(const { SINUSOID.choice("DOF") }).unwrap_or(Dof::X);
        let dim = if dof.is_rotation() { Dim::Angle } else { Dim::Length };
        let [amplitude, period, phase] = given.numbers_or_zero(const { SINUSOID.numbers(["AMP", "PERIOD", "PHASE"]) });
        Sinusoid { dof: dof.index(), amplitude: dim.to_si(amplitude, job.units), period, phase }
    };
    let list = args.options.iter().filter(|g| g.is(&SINUSOID)).map(one).collect();
    GivenMotion::Sinusoids { list, ramp: args.option_number(&RAMP).unwrap_or(0.0) }
}

/// Motions that bodies are given; `None` where none is.
pub fn motions(model: &Model, fits: &dyn Fn(&str) -> bool) -> Option<Table> {
    let mut rows = Vec::new();
    for body in model.bodies.values().filter(|b| fits(&b.name)) {
        let Some(given) = &body.prescribed else { continue };
        let motion = |by, dof| MotionRow { body: &body.name, by, dof, ..MotionRow::default() };
        match &given.motion {
            GivenMotion::Sinusoids { list, ramp } => rows.extend(list.iter().map(|sine| MotionRow {
                length: (sine.dof <= 2).then_some(sine.amplitude),
                angle: (sine.dof > 2).then_some(sine.amplitude),
                period: Some(sine.period),
                phase: Some(sine.phase),
                to: (*ramp > 0.0).then_some(*ramp),
                ..motion("sinusoid", DOFS.get(sine.dof).copied().unwrap_or_default())
            })),
            GivenMotion::Responses(responses) => {
                let count = responses.headings.iter().map(|(_, r)| r.len()).sum();
                let periods = responses.headings.iter().flat_map(|(_, r)| r.iter().map(|r| TAU / r.frequency));
                let (least, most) = periods.fold((f64::INFINITY, 0.0f64), |(a, b), p| (a.min(p), b.max(p)));
                let (from, to) = (Some(least), Some(most));
                rows.push(MotionRow { rows: Some(count), from, to, ..motion("responses", "all") });
            }
            GivenMotion::Path(path) => {
                let (from, to) = (path.first().map(|r| r.0), path.last().map(|r| r.0));
                rows.push(MotionRow { rows: Some(path.len()), from, to, ..motion("file", "all") });
            }
        }
    }
    let mut table = Table::new("Prescribed Motions")
        .with_rows(&rows)
        .text("Body", |row| row.body)
        .text("By", |row| row.by)
        .text("DOF", |row| row.dof)
        .column("Amplitude", "Length", Dim::Length, Digits::Usual, |row| row.length)
        .column("Amplitude", "Angle", Dim::Angle, Digits::Usual, |row| row.angle)
        .column("", "Period", Dim::Time, Digits::Usual, |row| row.period)
        .column("", "Phase", Dim::Angle, Digits::Usual, |row| row.phase)
        .column("", "Rows", Dim::None, Digits::Usual, |row| row.rows)
        .column("", "From", Dim::Time, Digits::Usual, |row| row.from)
        .column("", "To", Dim::Time, Digits::Usual, |row| row.to)
        .build();
    table.note("From and To: times of a file, periods of responses; of sinusoids To is the time over which they grow");
    (!rows.is_empty()).then_some(table)
}

/// What a row of the prescribed motions shows: a sinusoid, the responses or the file of a body.
#[derive(Default)]
struct MotionRow<'m> {
    body: &'m str,
    by: &'static str,
    dof: &'static str,
    /// Amplitude of a translation (m).
    length: Option<f64>,
    /// Amplitude of a rotation (rad).
    angle: Option<f64>,
    /// Period (s) and phase (rad) of a sinusoid.
    period: Option<f64>,
    phase: Option<f64>,
    /// Rows of the responses or of the file.
    rows: Option<usize>,
    /// The range of a file's times, of periods of responses, of a ramp (s).
    from: Option<f64>,
    to: Option<f64>,
}
