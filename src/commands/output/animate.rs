//! `&ANIMATE`: the last run as a film.

use crate::commands::name_filter::NameFilter;
use crate::commands::{Call, Command, Effect, Job};
use crate::report::files::JobFolder;
use crate::report::film;
use std::path::PathBuf;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::units::Dim;
use windlass_base::values::Args;
use windlass_base::values::Noun;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, OptionSpec, ValueSpec};
use windlass_model::EntityKind;
use windlass_solve::film::{Film, FilmSelection};
use windlass_solve::results::EventWindow;

/// &ANIMATE.
pub static ANIMATE: Command = Command { spec: &SPEC, edits: false, run };

/// Points of a line where none are asked for.
pub const DEFAULT_LINE_POINTS: usize = 40;
/// Most bytes of all the files of a series.
const MAX_SERIES_BYTES: usize = 1 << 30;

const EVENTS: OptionSpec = OptionSpec::new(
    "-EVENTS",
    &[
        ValueSpec::new("BEG", Kind::Number(Dim::Time), "time of the first instant"),
        ValueSpec::new("END", Kind::Number(Dim::Time), "time of the last; one after the run is its end")
            .or("the end of the run"),
        ValueSpec::new("INC", Kind::Number(Dim::Time), "time from one to the next; 0: the stored instants")
            .or("the stored instants")
            .not_negative(),
    ],
    "the instants that are shown",
)
.owner(Owner::Ours)
.default("all stored instants");
const POINTS_OPTION: OptionSpec = OptionSpec::new(
    "-POINTS",
    &[ValueSpec::new("N", Kind::Integer, "points").in_range(2.0, 400.0)],
    "points of each mooring line",
)
.owner(Owner::Ours)
.default("40");
const HEADING: OptionSpec = OptionSpec::new(
    "-HEADING",
    &[ValueSpec::new("TEXT", Kind::Text, "title, in quotes when it holds blanks")],
    "title of the film",
)
.owner(Owner::Ours)
.default("that of &TITLE");

static SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    data: &[
        ValueSpec::new("FILE", Kind::File, "file name ending in .html or .vtk; .html is added when it has no ending"),
        ValueSpec::new("NAME", Kind::Name(Noun::Selector), "connector or body, pattern or selector")
            .among(&[Noun::Connector, Noun::Body])
            .or("all"),
    ],
    repeat: 1,
    options: &[EVENTS, POINTS_OPTION, HEADING],
    detail: "Shows the last TDOM. A file ending in .html is one page for any browser, with nothing to be fetched from elsewhere: bodies as \
             their hulls, or as a box about their points, connectors coloured by tension over break or by tension, the waves of the run, \
             bottom and anchors; it plays, turns, shifts and zooms by mouse, finger and keys (space, arrows, Home, End), and an address that \
             ends in #t=12.5&view=top opens there. A file ending in .vtk is a series for ParaView: FILE_0000.vtk and so on, one an instant, and \
             FILE.vtk.series, which opens them with their times. In it points carry the tension (N) and its share of the break, and the cell \
             array owner numbers lines from 1 up and bodies from -1 down; all is in metres. \
             A dynamic line is where its nodes were. Each other line hangs in the shape that is solved exactly between its ends at the instant; one without a solution is straight, which is said. \
             Between stored instants bodies are interpolated. A film has at most 2000 instants and 4 million numbers, and 60000 triangles: \
             beyond, instants are left out evenly and hulls become boxes, which is said. On the page places are kept to 1/65535 of the \
             extent, tensions to 1/65535 of the largest. A relative file name is inside the job's folder: &HELP &FILE.",
    example: "&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH 100 -TIME 2 0.1\nMEDIT\n&DESCRIBE BODY BUOY -IGNORE Z RX RY RZ\n*CG 0 0 0\n*F 2 0 0\n\
              #WEIGHT *CG 5000 2 2 2\n~W B_CAT 100 -LEN 300 -DEPANCHOR 100\nCONNECTOR A -ANC 0 270 ~W *F\nEND\n\
              &INSTATE -LOCATE BUOY 1\nTDOM\n&ANIMATE buoy.html\n&ANIMATE buoy.vtk A -EVENTS 0 2 0.5 -POINTS 20",
    ..CommandSpec::new("&ANIMATE", "shows the last run as a film")
};

const FILE: DatumKey<str> = SPEC.word("FILE");

/// The form of a file, by the ending of its name.
enum FileForm {
    Page,
    Series,
}

/// The name of the file with its ending, and its form.
fn form(args: &Args) -> Outcome<(String, FileForm)> {
    let name = args.word(FILE).unwrap_or_default();
    let ending = std::path::Path::new(name).extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
    match ending.as_deref() {
        None => Ok((format!("{name}.html"), FileForm::Page)),
        Some("html" | "htm") => Ok((name.to_string(), FileForm::Page)),
        Some("vtk") => Ok((name.to_string(), FileForm::Series)),
        Some(_) => Err(Diagnostic::error(format!("a film ends in .html or .vtk, not `{name}`"), args.position(FILE))),
    }
}

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let (name, form) = form(args)?;
    let run =
        job.run.as_ref().ok_or_else(|| Diagnostic::error("there is no run yet", args.span).help("TDOM makes one"))?;
    let events = args.option(&EVENTS);
    let [begin, end, increment] =
        const { EVENTS.numbers(["BEG", "END", "INC"]) }.map(|key| events.and_then(|given| given.number(key)));
    let points = args.option_integer(&POINTS_OPTION);
    let chosen = NameFilter::new(args.data_after(FILE), &job.model);
    let take = FilmSelection {
        connector: &|c| chosen.matches(c),
        body: &|b| chosen.matches(b),
        window: begin.map(|begin| EventWindow { begin, end, increment }),
        points: points.and_then(|n| usize::try_from(n).ok()).unwrap_or(DEFAULT_LINE_POINTS),
        stop: &|| job.is_interrupted(),
    };
    let film = Film::build(run, &take);
    chosen.check_used("what moves in the run", &[EntityKind::Connector, EntityKind::Body])?;
    let span = events.map_or(args.span, |g| g.span);
    let film = film.map_err(|e| e.diagnostic(span, job.units))?;
    let title = match args.option_word(&HEADING) {
        Some(heading) => heading,
        None if job.titles[0].is_empty() => "Time Domain",
        None => &job.titles[0],
    };
    let frames = film.times.len();
    let text = match form {
        FileForm::Page => {
            let page = film::page(&film, title, job.units);
            let page = page.map_err(|e| Diagnostic::error(format!("the page could not be made: {e:#}"), args.span))?;
            let path = job.output.folder.write(&name, page.as_bytes());
            let path = path.map_err(|e| crate::commands::files::file::to_diagnostic(&e, args.position(FILE)))?;
            format!("wrote {}: {frames} instants", path.display())
        }
        FileForm::Series => {
            let path = series(&job.output.folder, &film, (title, &name), args.position(FILE))?;
            format!("wrote {}, a series of {frames} files", path.display())
        }
    };
    job.say(&text);
    for note in film.notes {
        job.warn(note, args.span);
    }
    Ok(Effect::Done)
}

/// Writes a series, its list last: there is no list of files that are not there. Where one cannot be written those before it
/// are taken away again.
fn series(folder: &JobFolder, film: &Film, (title, name): (&str, &str), span: Span) -> Outcome<PathBuf> {
    let mut written: Vec<(String, PathBuf)> = Vec::new();
    let mut size = 0;
    for step in film::steps(film, title, name).chain(std::iter::once_with(|| film::series(film, name))) {
        size += step.text.len();
        let done = if size > MAX_SERIES_BYTES {
            Err(Diagnostic::error(format!("the series would be larger than {} MB", MAX_SERIES_BYTES >> 20), span)
                .help("-EVENTS takes a part of the run, -POINTS fewer points"))
        } else {
            folder
                .write(&step.name, step.text.as_bytes())
                .map_err(|e| crate::commands::files::file::to_diagnostic(&e, span))
        };
        match done {
            Ok(path) => written.push((step.name, path)),
            Err(error) => {
                for (name, _) in &written {
                    // what cannot be taken away is left; the error below is the one that counts
                    let _ = folder.remove(name);
                }
                return Err(error);
            }
        }
    }
    written.pop().map(|(_, path)| path).ok_or_else(|| Diagnostic::error("there is no instant to write", span))
}
