//! `&PICTURE`: the system as it stands, in plan, elevation or slantwise.

use crate::commands::name_filter::{NameFilter, merge_remarks};
use crate::commands::{Call, Command, Effect, Job};
use crate::report::picture::{Picture, USUAL_WIDTH, View};
use crate::report::plot::PlotError;
use windlass_base::choice::{Choice, YesNo};
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::TableNote;
use windlass_base::units::Dim;
use windlass_base::values::Args;
use windlass_base::values::{Noun, Value};
use windlass_language::number;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, OptionSpec, ValueSpec, join_options};
use windlass_model::EntityKind;
use windlass_solve::scene::{Scene, SceneOptions};

/// &PICTURE.
pub static PICTURE: Command = Command { spec: &SPEC, edits: false, run };

const YES_NO: ValueSpec = ValueSpec::choice::<YesNo>("YES/NO", "shown or not").or("YES");

const NO: OptionSpec =
    OptionSpec::new("-NO", &[], "nothing is asked before drawing").owner(Owner::Ours).without_effect();
const HARD: OptionSpec = OptionSpec::new("-HARD", &[], "to the next figure file, FIGUREn.svg").owner(Owner::Ours);
const FILE: OptionSpec = OptionSpec::new(
    "-FILE",
    &[ValueSpec::new("FILE", Kind::File, "file name; .svg, or that of -FORMAT, is added when it has no ending")],
    "to a file ending in .svg or .png",
)
.owner(Owner::Ours);

choices! {
    /// Forms of a picture.
    enum PictureForm {
        Svg = "SVG",
        Png = "PNG",
        Terminal = "TERMINAL",
    }
}

const FORMAT: OptionSpec = OptionSpec::new(
    "-FORMAT",
    &[ValueSpec::choice::<PictureForm>("FORMAT", "form of the picture")],
    "SVG or PNG: to the next figure file, or the file of -FILE",
)
.default("TERMINAL")
.owner(Owner::Ours);
const FROM: OptionSpec = OptionSpec::new(
    "-FROM",
    &[ValueSpec::new("ANGLE", Kind::Number(Dim::Angle), "direction to the viewer, from +X toward +Y")],
    "where the viewer of ELEVATION, ISO or BOTH stands",
)
.default("-90; of ISO -60")
.owner(Owner::Ours);
const EXAGGERATE: OptionSpec = OptionSpec::new(
    "-EXAGGERATE",
    &[ValueSpec::new("FACTOR", Kind::Number(Dim::None), "factor").in_range(0.1, 100.0)],
    "draws heights so many times as large",
)
.default("1")
.owner(Owner::Ours);
const NAMES: OptionSpec =
    OptionSpec::new("-NAMES", &[YES_NO], "names of bodies, connectors and points").default("YES").owner(Owner::Ours);
const INACTIVE: OptionSpec = OptionSpec::new("-INACTIVE", &[YES_NO], "connectors that do not act, in a light stroke")
    .default("YES")
    .owner(Owner::Ours);
const TENSIONS: OptionSpec =
    OptionSpec::new("-TENSIONS", &[YES_NO], "lines in a file have the colours of their tension")
        .default("YES")
        .owner(Owner::Ours);
const NORTH: OptionSpec = OptionSpec::new(
    "-NORTH",
    &[ValueSpec::new("ANGLE", Kind::Number(Dim::Angle), "where north lies, from +X toward +Y")],
    "a north arrow in the plan",
)
.owner(Owner::Ours);
/// An option of pictures of MOSES that changes nothing here.
const fn idle(name: &'static str, help: &'static str) -> OptionSpec {
    const ANY: &[ValueSpec] = &[ValueSpec::new("DATA", Kind::Item, "as in MOSES").or("none")];
    OptionSpec::new(name, ANY, help).repeating(1).without_effect()
}

/// Options of MOSES that choose colours, styles and views that windlass does not draw.
const IDLE: [OptionSpec; 17] = [
    idle("-CATEGORY", "categories of elements"),
    idle("-RENDER", "how surfaces are drawn"),
    idle("-RESET", "settings of pictures are not remembered"),
    idle("-SUBTITLE", "the picture has one title"),
    idle("-MOVIE", "&ANIMATE makes films"),
    idle("-PLANE", "a slice of the picture"),
    idle("-INC_VIEW", "turns of the view"),
    idle("-EVENTS", "&INSTATE -EVENT puts bodies where they were in a run"),
    idle("-TYPE", "what is drawn"),
    idle("-CONNECTORS", "NAME chooses connectors"),
    idle("-PARTS", "NAME chooses bodies"),
    idle("-BODY", "NAME chooses bodies"),
    idle("-WATER_COLOR", "a colour"),
    idle("-BACK_COLOR", "a colour"),
    idle("-DETAIL", "how much is drawn"),
    idle("-POINTS", "which points are drawn"),
    idle("-ANNOTATE", "what is written on the picture"),
];
const OWN: [OptionSpec; 12] =
    [NO, HARD, FILE, FORMAT, FROM, EXAGGERATE, NAMES, INACTIVE, HEADING, TENSIONS, NORTH, PIXELS];
static OPTIONS: [OptionSpec; OWN.len() + IDLE.len()] = join_options(&OWN, &IDLE);

const PIXELS: OptionSpec = OptionSpec::new(
    "-PIXELS",
    &[ValueSpec::new("WIDTH", Kind::Integer, "width of the picture (pixels)").in_range(300.0, 4000.0)],
    "width of a picture in a file; its height follows from what is drawn",
)
.owner(Owner::Ours)
.default("1000");
const HEADING: OptionSpec = OptionSpec::new(
    "-HEADING",
    &[ValueSpec::new("TEXT", Kind::Text, "title, in quotes when it holds blanks")],
    "title of the picture",
)
.default("that of &TITLE")
.aliases(&["-TITLE"])
.owner(Owner::Ours);

choices! {
    /// Views of a picture.
    #[derive(Default)]
    enum ViewChoice {
        #[default]
        Both = "BOTH",
        Plan = "PLAN",
        Top = "TOP",
        Elevation = "ELEVATION",
        Side = "SIDE",
        Port = "PORT",
        Starboard = "STARBOARD",
        Bow = "BOW",
        Stern = "STERN",
        Isometric = "ISO",
    }
}

const VIEW: DatumKey<ViewChoice> = SPEC.choice("VIEW");

static SPEC: CommandSpec = CommandSpec {
    data: &[
        ValueSpec::choice::<ViewChoice>(
            "VIEW",
            "PLAN (or TOP), ELEVATION (or SIDE, PORT), STARBOARD, BOW, STERN, ISO, or BOTH plan and elevation",
        )
        .or("BOTH"),
        ValueSpec::new("NAME", Kind::Name(Noun::Selector), "connector or body, pattern or selector")
            .among(&[Noun::Connector, Noun::Body])
            .or("all"),
    ],
    repeat: 1,
    options: &OPTIONS,
    detail: "Draws the system as it stands now: bodies as the panels of their hulls with \
             sharp edges and silhouette, or as the convex outline of their points where they have none; lines in the shape they \
             hang in between their ends, dynamic lines, rods and pipes by their nodes at rest; fenders, slings and other connectors straight, \
             with anchors, fairleads, touchdowns, joints and the supports of pipes. In a file the colours of a line are its tension, with a \
             bar below; -TENSIONS NO draws all lines alike. A plan shows a north arrow where -NORTH says where north is. Both \
             directions of a view have the same scale, but for heights with -EXAGGERATE. The viewer of an elevation looks \
             horizontally from the direction of -FROM: from -90 (-Y) X runs to the right. SIDE and PORT look from -Y, \
             STARBOARD from +Y, BOW from -X and STERN from +X, X taken to run aft and Y to starboard. In an elevation the \
             water stands at the tide and the bottom at the depth of &ENV, else at that of the lines. Lines are solved \
             exactly, whatever their forces come from; one without a solution is dashed between its ends, with a warning. \
             A NAME chooses connectors and bodies, and with a connector come its bodies; the VIEW may be left out, but for a NAME \
             that begins one. Without -HARD, -FILE or -FORMAT the \
             picture is drawn in the terminal; in a terminal names that find no place are left out, in a file that is said. \
             Options of MOSES for colours and styles are accepted, and said once to have no effect. A relative file name is inside the job's folder: &HELP &FILE.",
    example: "MEDIT\n&DESCRIBE BODY BARGE\n*BOW 0 0 20\n*STERN 400 0 20\n~W B_CAT 4 -LEN 2200 -DEP 500\n\
              CONNECTOR A -ANC 180 2100 ~W *BOW\nCONNECTOR B -ANC 0 2100 ~W *STERN\nEND\n&PICTURE\n\
              &PICTURE ELEVATION A -EXAGGERATE 2\n&PICTURE ISO -HARD -FROM -45\n&PICTURE BOTH -FILE mooring.png",
    ..CommandSpec::new("&PICTURE", "draws plan and elevation of the system")
};

/// The views a record asks for.
fn views(args: &Args) -> Outcome<Vec<View>> {
    let view = args.choice(VIEW).unwrap_or_default();
    let degrees = |given: f64| given.to_radians();
    let from = args.option(&FROM);
    let fixed = !matches!(view, ViewChoice::Both | ViewChoice::Elevation | ViewChoice::Isometric);
    if let (Some(given), true) = (from, fixed) {
        return Err(Diagnostic::error(
            format!("{} is seen from where it says: -FROM goes with ELEVATION, ISO or BOTH", view.word()),
            given.span,
        ));
    }
    let exaggerate = args.option(&EXAGGERATE);
    if let (Some(given), ViewChoice::Plan | ViewChoice::Top) = (exaggerate, view) {
        return Err(Diagnostic::error("a plan shows no heights to exaggerate", given.span));
    }
    let stretch = exaggerate.and_then(|g| g.first_number()).unwrap_or(1.0);
    let asked = from.and_then(|g| g.first_number());
    let from_degrees = |angle: f64| View::elevation(degrees(angle), stretch);
    let elevation = || View::elevation(asked.unwrap_or(degrees(-90.0)), stretch);
    Ok(match view {
        ViewChoice::Plan | ViewChoice::Top => vec![View::plan()],
        ViewChoice::Side | ViewChoice::Port => vec![from_degrees(-90.0)],
        ViewChoice::Starboard => vec![from_degrees(90.0)],
        ViewChoice::Bow => vec![from_degrees(180.0)],
        ViewChoice::Stern => vec![from_degrees(0.0)],
        ViewChoice::Isometric => vec![View::isometric(asked.unwrap_or(degrees(-60.0)), stretch)],
        ViewChoice::Elevation => vec![elevation()],
        ViewChoice::Both => vec![View::plan(), elevation()],
    })
}

/// The file a record asks for, and whether its name takes the number of a figure; `None` for the terminal.
fn file(job: &Job, args: &Args) -> Outcome<Option<(String, bool)>> {
    let format = args.option(&FORMAT);
    let ending = match format.and_then(|g| g.choice(const { FORMAT.choice("FORMAT") })) {
        Some(PictureForm::Png) => Some("png"),
        Some(PictureForm::Svg) => Some("svg"),
        Some(PictureForm::Terminal) => None,
        None if args.has(&HARD) || args.has(&FILE) => Some("svg"),
        None => return Ok(None),
    };
    let Some(ending) = ending else {
        let other = [FILE, HARD].iter().find_map(|option| args.option(option));
        return match (other, format) {
            (Some(other), Some(format)) => Err(Diagnostic::error(
                format!("a picture for the terminal goes to no file: {}", other.name()),
                other.span,
            )
            .other(format.span, "the terminal is asked for here")),
            _ => Ok(None),
        };
    };
    let Some(given) = args.option(&FILE) else {
        return Ok(Some((format!("{}{}.{ending}", job.settings.figure_name, job.settings.figure_number), true)));
    };
    let name = given.first_word().unwrap_or_default();
    match (std::path::Path::new(name).extension(), format) {
        (None, _) => Ok(Some((format!("{name}.{ending}"), false))),
        (Some(own), Some(format)) if !own.eq_ignore_ascii_case(ending) => {
            Err(Diagnostic::error(format!("`{name}` does not end in .{ending}"), given.span)
                .other(format.span, "the form is asked for here"))
        }
        _ => Ok(Some((name.to_string(), false))),
    }
}

/// What is said of angles behind the view, once.
const ANGLES_SAID: &str =
    "angles after the view have no effect in windlass: -FROM turns an elevation or a view from a corner (said once)";

/// Whether a word behind the view is an angle, as MOSES takes them there.
fn is_angle(value: &Value) -> bool {
    value.word().is_some_and(|word| number::evaluate(word).is_ok())
}

const NOTHING: &str = "there is nothing to draw: no body and no connector";

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    for given in args.options.iter().filter(|given| given.is_any(&IDLE)) {
        let option = given.option.name;
        if !job.absent_said.contains(&option) {
            job.absent_said.push(option);
            job.remark(format!("{option} of &PICTURE has no effect in windlass (said once)"), given.span);
        }
    }
    let (views, file) = (views(args)?, file(job, args)?);
    let angles: Vec<&Value> = args.data_after(VIEW).iter().filter(|value| is_angle(value)).collect();
    if let Some(span) = angles.first().map(|first| first.span)
        && !job.absent_said.contains(&ANGLES_SAID)
    {
        job.absent_said.push(ANGLES_SAID);
        job.remark(ANGLES_SAID, span);
    }
    let names = args.data_after(VIEW).iter().filter(|value| !is_angle(value));
    let (chosen, light) = (NameFilter::new(names, &job.model), args.switch(&INACTIVE, true));
    let choice = SceneOptions {
        connector: &|c| (chosen.matches(&c.name)) && (c.active || light),
        body: &|b| chosen.matches(&b.name),
        stop: &|| job.is_interrupted(),
    };
    let Some((scene, unshaped)) = Scene::build(&job.model, &choice) else {
        return Err(Diagnostic::error("interrupted", args.span));
    };
    chosen.check_used("what can be drawn", &[EntityKind::Connector, EntityKind::Body])?;
    let problems: Vec<(String, Vec<TableNote>)> = unshaped
        .into_iter()
        .map(|(name, error)| {
            let straight = scene.paths.iter().any(|p| p.name == name);
            let how = if straight { "dashed between its ends" } else { "not drawn" };
            (name, vec![format!("{how}: {}", error.text(job.units)).into()])
        })
        .collect();
    let title = args.option_word(&HEADING).unwrap_or(&job.titles[0]).to_string();
    let picture = Picture {
        title,
        scene,
        views,
        names: args.switch(&NAMES, true),
        units: job.units,
        tensions: args.switch(&TENSIONS, true),
        north: args.option_number(&NORTH),
        width: args.option_integer(&PIXELS).and_then(|n| i32::try_from(n).ok()).unwrap_or(USUAL_WIDTH),
    };
    let wrong = |error: PlotError| match error {
        PlotError::Empty => Diagnostic::error(NOTHING, args.span)
            .help("-INACTIVE NO leaves out what does not act; &STATUS counts what the model holds"),
        other => Diagnostic::error(other.to_string(), args.span),
    };
    match file {
        Some((name, numbered)) => {
            let (bytes, left_out) = picture.file(&name).map_err(wrong)?;
            let span = args.option(&FILE).map_or(args.span, |g| g.span);
            let path = job
                .output
                .folder
                .write(&name, &bytes)
                .map_err(|e| crate::commands::files::file::to_diagnostic(&e, span))?;
            job.settings.figure_number += i64::from(numbered);
            job.say(&format!("wrote {}", path.display()));
            if left_out > 0 {
                job.remark(format!("{left_out} names found no place in the picture"), args.span);
            }
        }
        None => {
            let (columns, lines) = job.plot_size();
            match picture.terminal(columns, lines) {
                Ok(text) => job.say(&text),
                // a picture of a script that makes surfaces alone: nothing is lost
                Err(PlotError::Empty) => job.warn(NOTHING, args.span),
                Err(other) => return Err(wrong(other)),
            }
        }
    }
    for note in merge_remarks(&problems) {
        job.warn(note.text, args.span);
    }
    Ok(Effect::Done)
}
