//! `V_WAVES`: a picture of waves at bodies by their panels: elevation around them and pressure on their hulls, in a wave of unit amplitude with the
//! motions that it gives them.

use crate::commands::menu;
use crate::commands::model::hydrodynamics::{EDGE_SHARE, LID, USUAL_EDGE_SHARE, lids_of, toward};
use crate::commands::model::panel_drift::{self, DriftSource};
use crate::commands::model::panel_forces::{MeshedBodies, PanelRequest, wave_length};
use crate::commands::{Call, Command, Effect, Job};
use crate::report::film;
use crate::report::format;
use crate::report::picture::USUAL_WIDTH;
use crate::report::plot::PlotError;
use crate::report::wave_picture::{WaveGrid, WavePicture, is_within};
use nalgebra::{Complex, Rotation3, Vector3};
use std::f64::consts::{PI, TAU};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::pose::Pose;
use windlass_base::units::Dim;
use windlass_base::values::{Args, Noun};
use windlass_diffraction::{MOTIONS, WaveSolution};
use windlass_language::spec::{CommandSpec, DatumKey, Kind, OptionSpec, ValueSpec};
use windlass_model::{Body, Model, find};
use windlass_solve::film::{Actor, Film, FilmSolid, WaveField};

/// V_WAVES.
pub static V_WAVES: Command = Command { spec: &SPEC, edits: false, run };

/// Points along the longer side of the plan, and the most.
const USUAL_POINTS: usize = 100;
const MAX_POINTS: f64 = 300.0;
/// Room around the bodies over the wave length, and over their extent: the larger one.
const ROOM: [f64; 2] = [1.0, 0.75];
/// Most room over the extent of the bodies: long waves change little beside them.
const MOST_ROOM: f64 = 2.0;
/// Periods of a film, and its instants in one.
const FILM_PERIODS: usize = 3;
const FILM_INSTANTS: usize = 40;
/// Amplitude of the wave of a film over its length.
const FILM_STEEPNESS: f64 = 0.01;
/// How far outside of a hull its panels are shown, over the reach of the body.
const SKIN_SHARE: f64 = 2e-3;
/// Sides this near to the mean level, over the size of the hulls, are in the waterline.
const LEVEL_SHARE: f64 = 1e-6;

const PERIOD: OptionSpec = OptionSpec::ours(
    "-PERIOD",
    &[ValueSpec::new("T", Kind::Number(Dim::Time), "period").positive()],
    "period of the wave",
);
const HEADING: OptionSpec = OptionSpec::ours(
    "-HEADING",
    &[ValueSpec::new("H", Kind::Number(Dim::Angle), "where the wave comes from, from +X toward +Y of the body")],
    "heading of the wave",
)
.default("180");
const WITH: OptionSpec = OptionSpec::ours(
    "-WITH",
    &[ValueSpec::new("BODY", Kind::Name(Noun::Body), "another body")],
    "other bodies that the wave meets",
)
.repeating(1)
.default("those that G_PRESSURE solved with it");
const PHASE: OptionSpec = OptionSpec::ours(
    "-PHASE",
    &[ValueSpec::new(
        "P",
        Kind::Number(Dim::Angle),
        "part of the period behind the crest of the undisturbed wave at the origin of the body",
    )],
    "shows that instant",
)
.default("the largest value in a period");
const HELD: OptionSpec = OptionSpec::ours("-HELD", &[], "the bodies do not move");
const AROUND: OptionSpec = OptionSpec::ours(
    "-AROUND",
    &[ValueSpec::new("D", Kind::Number(Dim::Length), "distance from the bodies").positive()],
    "how far the plan reaches around them",
)
.default("a wave length, three quarters of their extent at least and twice it at most");
const POINTS: OptionSpec = OptionSpec::ours(
    "-POINTS",
    &[ValueSpec::new("N", Kind::Integer, "points").in_range(20.0, MAX_POINTS)],
    "points along the longer side of the plan",
)
.default("100");
const PANEL: OptionSpec = OptionSpec::ours(
    "-PANEL",
    &[ValueSpec::new("SIZE", Kind::Number(Dim::Length), "length of their sides, at most").positive()],
    "size of the panels",
)
.default("that of G_PRESSURE");
const DEPTH: OptionSpec = OptionSpec::ours(
    "-DEPTH",
    &[ValueSpec::new("D", Kind::Number(Dim::Length), "depth").positive()],
    "the depth of the water",
)
.default("that of the environment; deep water where it has none");
const AMPLITUDE: OptionSpec = OptionSpec::ours(
    "-AMPLITUDE",
    &[ValueSpec::new("A", Kind::Number(Dim::Length), "amplitude").positive()],
    "amplitude of the wave of a film",
)
.default("a hundredth of the wave length");
const FILE: OptionSpec = OptionSpec::ours(
    "-FILE",
    &[ValueSpec::new("FILE", Kind::File, "file name; .svg is added when it has no ending")],
    "to a file ending in .svg or .png, or .html for a film",
)
.default("the next figure file, FIGUREn.svg");
const PIXELS: OptionSpec = OptionSpec::ours(
    "-PIXELS",
    &[ValueSpec::new("WIDTH", Kind::Integer, "width of the picture (pixels)").in_range(300.0, 4000.0)],
    "width of the picture; its height follows from what is drawn",
)
.default("1000");

static SPEC: CommandSpec = CommandSpec {
    owner: windlass_language::select::Owner::Ours,
    menus: &[&menu::HYDRODYNAMICS],
    data: &[ValueSpec::new("BODY", Kind::Name(Noun::Body), "the body")],
    options: &[
        PERIOD, HEADING, WITH, LID, PHASE, HELD, AMPLITUDE, AROUND, POINTS, PANEL, EDGE_SHARE, DEPTH, FILE, PIXELS,
    ],
    detail: "Draws what a regular wave of unit amplitude does at bodies, by their panels where they stand, with the motions that it gives them: in plan the \
             elevation of the water around them, by colours with lines between them, and below the pressure on the panels of their hulls, seen \
             from below and from both sides along the wave. Values are over the amplitude, pressures over density, gravity and amplitude. Without -PHASE they are the \
             largest in a period; with it those of an instant. A file ending in .html is a film of three periods: the water around the bodies, their motions and the \
             pressure on their hulls, in a wave of -AMPLITUDE. Within a panel's size of a hull elevations are no better than the panels.",
    example: "&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH 100\nMEDIT\n&DESCRIBE BODY BARGE\n*CG 0 0 0\n#WEIGHT *CG 100552 12 26 26\n#DAMP *CG 0 0 0 2E5\n&SURFACE\n\
              BLOCK HULL -45 -15 -3.7 45 15 4\nEND_&SURFACE\nEND\nHYDRODYNAMICS\nV_WAVES BARGE -PERIOD 9 -PANEL 8 -POINTS 20\n\
              V_WAVES BARGE -PERIOD 9 -HEADING 135 -PHASE 90 -PANEL 8 -POINTS 20 -FILE waves.png\nEND",
    ..CommandSpec::new("V_WAVES", "a picture of waves at bodies and of their pressure")
};

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const NAME: DatumKey<str> = SPEC.word("BODY");
    let (args, span) = (&call.args, call.args.span);
    let body = find(&job.model.bodies, args.word(NAME).unwrap_or_default(), "body", args.position(NAME))?;
    let Some(period) = args.option_number(&PERIOD) else {
        return Err(Diagnostic::error("V_WAVES needs -PERIOD, the period of the wave", span));
    };
    let data = body.database.as_ref().map(|attached| attached.data.clone());
    let mut names = vec![body.name.clone()];
    for value in args.option(&WITH).into_iter().flat_map(|given| &given.values) {
        let (word, place) = (value.word().unwrap_or_default(), value.span);
        let other = find(&job.model.bodies, word, "body", place)?;
        if names.iter().any(|own| own.eq_ignore_ascii_case(&other.name)) {
            return Err(Diagnostic::error(format!("{} is named twice", other.name), place));
        }
        names.push(other.name.clone());
    }
    // those that were solved together name the same source
    if let Some(data) = data.as_ref().filter(|data| !args.has(&WITH) && !data.interactions.is_empty()) {
        let is_same = |other: &Body| other.database.as_ref().is_some_and(|own| own.data.source == data.source);
        let others = job.model.bodies.values().filter(|other| other.name != body.name && is_same(other));
        names.extend(others.map(|other| other.name.clone()));
    }
    let mut lids = lids_of(args);
    if let Some(data) = data.as_ref().filter(|data| !data.lids.is_empty() && !args.has(&LID)) {
        // in axes of the first body of the database
        lids.clone_from(&data.lids);
        let place = |name: &String| {
            let own = job.model.bodies.get(&Model::key(name)).and_then(|body| body.database.as_ref());
            own.map_or(usize::MAX, |own| own.data.index)
        };
        names.sort_by_key(place);
    }
    let panels = data.as_ref().and_then(|data| data.panels);
    let request = PanelRequest {
        headings: toward(vec![args.option_number(&HEADING).unwrap_or(PI)]),
        periods: vec![period],
        size: args.option_number(&PANEL).or(panels.map(|panels| panels.largest)),
        edge_share: args
            .option_number(&EDGE_SHARE)
            .or(panels.map(|panels| panels.edge_share))
            .unwrap_or(USUAL_EDGE_SHARE),
        depth: args.option_number(&DEPTH).or_else(|| data.as_ref().and_then(|data| data.depth)),
        lids,
        has_drift: true,
        is_checked: false,
        kept: None,
        span,
    };
    let meshed = MeshedBodies::new(&job.model, &names, &request)?;
    let wrong = |text: String| Diagnostic::error(format!("{}: {text}", meshed.names()), span);
    let problem = meshed.problem(span)?;
    let frequency = TAU / period;
    let waves = problem.solve_waves(frequency, &request.headings).map_err(|error| wrong(error.to_string()))?;
    let source = if args.has(&HELD) { DriftSource::Fixed } else { panel_drift::source(&job.model, &meshed, true) };
    let motions = panel_drift::motions_in_waves(&source, &meshed, &waves.forces, &request.headings).map_err(wrong)?;
    let motions = match (motions, &source) {
        (Some(motions), _) => motions,
        (None, DriftSource::None(why)) => {
            let text = format!("{}: the bodies are drawn as if they were held: {why}", meshed.names());
            job.warn(text, span);
            vec![vec![Complex::default(); MOTIONS * names.len()]; request.headings.len()]
        }
        (None, _) => return Err(wrong("there are no motions".into())),
    };
    let picture = picture(job, args, &meshed, (&waves, &motions), &request)?;
    let given = args.option(&FILE);
    let ending = given.and_then(|given| given.first_word()).and_then(|name| name.rsplit_once('.')).map(|(_, end)| end);
    if let (Some(given), Some("html" | "htm" | "HTML")) = (given, ending) {
        let name = given.first_word().unwrap_or_default();
        let amplitude =
            args.option_number(&AMPLITUDE).unwrap_or_else(|| FILM_STEEPNESS * wave_length(frequency, meshed.water));
        let own = motions.first().map(Vec::as_slice).unwrap_or_default();
        let shown = film(job, &meshed, &picture, (frequency, amplitude), own);
        // the names of the bodies begin the description of the wave
        let head = if job.titles[0].is_empty() { "Waves at ".to_string() } else { format!("{}: ", picture.title) };
        let title = format!("{head}{}, amplitude {}", picture.waves, metres(job, amplitude));
        let page = film::page(&shown, &title, job.units);
        let page = page.map_err(|error| Diagnostic::error(format!("the page could not be made: {error:#}"), span))?;
        let path = job.output.folder.write(name, page.as_bytes());
        let path = path.map_err(|error| crate::commands::files::file::to_diagnostic(&error, given.span))?;
        job.say(&format!(
            "wrote {}: {FILM_PERIODS} periods of {period:.2} s, of an amplitude of {}",
            path.display(),
            metres(job, amplitude)
        ));
        return Ok(Effect::Done);
    }
    let name = match given.and_then(|given| given.first_word()) {
        Some(name) if std::path::Path::new(name).extension().is_some() => name.to_string(),
        Some(name) => format!("{name}.svg"),
        None => format!("{}{}.svg", job.settings.figure_name, job.settings.figure_number),
    };
    let place = given.map_or(span, |given| given.span);
    let bytes = picture.file(&name).map_err(|error: PlotError| Diagnostic::error(error.to_string(), place))?;
    let path = job.output.folder.write(&name, &bytes);
    let path = path.map_err(|error| crate::commands::files::file::to_diagnostic(&error, place))?;
    job.settings.figure_number += i64::from(given.is_none());
    job.say(&format!("wrote {}", path.display()));
    Ok(Effect::Done)
}

/// A length in words, with three figures.
fn metres(job: &Job, length: f64) -> String {
    let value = Dim::Length.from_si(length, job.units);
    let power = 10f64.powi(2 - value.abs().max(1e-9).log10().floor() as i32);
    let short = format::rounded_to_fifteen_figures((value * power).round() / power);
    format!("{} {}", format::number_in_full(short), Dim::Length.label(job.units))
}

/// The film of a solution: bodies in motion, the pressures on their panels just outside of their hulls, and the water.
fn film(
    job: &Job,
    meshed: &MeshedBodies,
    picture: &WavePicture,
    (frequency, amplitude): (f64, f64),
    motions: &[Complex<f64>],
) -> Film {
    let count = FILM_PERIODS * FILM_INSTANTS;
    let period = TAU / frequency;
    let times: Vec<f64> = (0..=count).map(|i| period * i as f64 / FILM_INSTANTS as f64).collect();
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), meshed.heading);
    let around = job.model.surroundings();
    let level = Vector3::new(0.0, 0.0, around.tide);
    let hull: Vec<usize> = meshed.meshes().map(|(_, mesh)| mesh.hull().len()).collect();
    let whole = hull.iter().sum::<usize>().max(1);
    let mut actors = Vec::new();
    let (mut low, mut high) = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
    let mut first = 0;
    for (number, (body, _)) in meshed.meshes().enumerate() {
        let Some(own) = job.model.bodies.get(&body.key) else { continue };
        let still = Pose::from_place(&own.position);
        let motion = |from: usize, time: f64| {
            let at = |i: usize| motions.get(MOTIONS * number + from + i).copied().unwrap_or_default();
            let of = |i: usize| amplitude * (at(i) * Complex::from_polar(1.0, -frequency * time)).re;
            turn * Vector3::new(of(0), of(1), of(2))
        };
        let pose = |time: &f64| {
            let axes = Rotation3::from_scaled_axis(motion(3, *time)).matrix() * still.axes;
            Pose { origin: still.origin + motion(0, *time), axes }
        };
        let poses: Vec<Pose> = times.iter().map(pose).collect();
        let solid = FilmSolid::from_body(&job.model, own, 1.0);
        let reach = solid.reach();
        low = low.inf(&(still.origin - Vector3::repeat(reach)));
        high = high.sup(&(still.origin + Vector3::repeat(reach)));
        let last = first + hull.get(number).copied().unwrap_or_default();
        let mut skin = FilmSolid::default();
        let mut pressures = Vec::new();
        for (index, (corners, value)) in picture.panels.iter().enumerate() {
            if !(first..last).contains(&(index % whole)) {
                continue;
            }
            let [a, b, c, d] = corners;
            let outward = (c - a).cross(&(d - b)).try_normalize(0.0).unwrap_or_default() * (SKIN_SHARE * reach);
            let start = u32::try_from(skin.points.len()).unwrap_or(u32::MAX);
            skin.points.extend(
                corners
                    .iter()
                    .map(|at| <[f64; 3]>::from(still.axes.transpose() * (at + level + outward - still.origin))),
            );
            skin.triangles.extend([[start, start + 1, start + 2], [start, start + 2, start + 3]]);
            pressures.extend([[value.re, value.im]; 2]);
        }
        first = last;
        actors.push(Actor {
            name: body.name.clone(),
            junction: false,
            solid,
            poses: poses.clone(),
            pressures: Vec::new(),
        });
        actors.push(Actor { name: String::new(), junction: false, solid: skin, poses, pressures });
    }
    let grid = &picture.grid;
    let rows = grid.values.len() / grid.columns.max(1);
    let [right, back] =
        [(0, grid.columns), (1, rows)].map(|(i, n)| grid.low[i] + grid.step * n.saturating_sub(1) as f64);
    let field = WaveField {
        low: grid.low,
        step: grid.step,
        columns: grid.columns,
        values: grid.values.iter().map(|value| [amplitude * value.re, amplitude * value.im]).collect(),
        frequency,
    };
    Film {
        times,
        actors,
        level: around.tide,
        // a bottom far below would leave the bodies small
        bottom: around.depth.map(|depth| -depth).filter(|bottom| *bottom > low.z - 2.0 * (high.z - low.z)),
        field: Some(field),
        extent: [
            [low.x.min(grid.low[0]), low.y.min(grid.low[1]), low.z],
            [high.x.max(right), high.y.max(back), high.z],
        ],
        ..Film::default()
    }
}

/// The picture of a solution.
fn picture(
    job: &Job,
    args: &Args,
    meshed: &MeshedBodies,
    (waves, motions): (&WaveSolution, &[Vec<Complex<f64>>]),
    request: &PanelRequest,
) -> Outcome<WavePicture> {
    let span = args.span;
    let wrong = |text: &str| Diagnostic::error(format!("{}: {text}", meshed.names()), span);
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), meshed.heading);
    let [px, py] = meshed.place;
    let global = |at: &Vector3<f64>| turn * at + Vector3::new(px, py, 0.0);
    let panels: Vec<[Vector3<f64>; 4]> =
        waves.hull_panels().iter().map(|corners| corners.map(|corner| global(&corner))).collect();
    let corners = || panels.iter().flatten();
    let far = f64::INFINITY;
    let (low, high) = corners().fold(([far; 2], [-far; 2]), |(low, high), at| {
        ([low[0].min(at.x), low[1].min(at.y)], [high[0].max(at.x), high[1].max(at.y)])
    });
    let extent = (high[0] - low[0]).max(high[1] - low[1]);
    let length = wave_length(waves.forces.frequency, meshed.water);
    let room =
        args.option_number(&AROUND).unwrap_or_else(|| (ROOM[0] * length).max(ROOM[1] * extent).min(MOST_ROOM * extent));
    let points = args.option_integer(&POINTS).and_then(|n| usize::try_from(n).ok()).unwrap_or(USUAL_POINTS);
    let step = (extent + 2.0 * room) / points as f64;
    let [columns, rows] = [0, 1].map(|i| ((high[i] - low[i] + 2.0 * room) / step).round().max(1.0) as usize + 1);
    let low = [low[0] - room, low[1] - room];
    let near = LEVEL_SHARE * extent;
    let waterlines: Vec<[[f64; 2]; 2]> = panels
        .iter()
        .flat_map(|corners| (0..4).map(move |i| [corners[i], corners[(i + 1) % 4]]))
        .filter(|[a, b]| a.z.abs() <= near && b.z.abs() <= near && (a - b).norm() > near)
        .map(|side| side.map(|at| [at.x, at.y]))
        .collect();
    let places: Vec<[f64; 2]> = (0..columns * rows)
        .map(|i| [low[0] + step * (i % columns) as f64, low[1] + step * (i / columns) as f64])
        .collect();
    let is_wet: Vec<bool> = places.iter().map(|at| !is_within(&waterlines, *at)).collect();
    let back = turn.inverse();
    let wet: Vec<[f64; 2]> = places
        .iter()
        .zip(&is_wet)
        .filter(|(_, is_wet)| **is_wet)
        .map(|([x, y], _)| back * Vector3::new(x - px, y - py, 0.0))
        .map(|at| [at.x, at.y])
        .collect();
    let found = waves.elevations(motions, &wet).ok_or_else(|| wrong("the elevations could not be found"))?;
    let mut found = found.into_iter().next().unwrap_or_default().into_iter();
    let nothing = Complex::new(f64::NAN, f64::NAN);
    let values = is_wet.iter().map(|is_wet| if *is_wet { found.next().unwrap_or(nothing) } else { nothing }).collect();
    let pressures = waves.hull_pressures(motions).and_then(|all| all.into_iter().next());
    let pressures = pressures.ok_or_else(|| wrong("the pressures could not be found"))?;
    let column = meshed.water.density * meshed.water.gravity;
    let units = job.units;
    // a round length of about a fifth of the plan
    let wanted = Dim::Length.from_si(0.2 * step * columns as f64, units);
    let power = 10f64.powf(wanted.log10().floor());
    let round = [5.0, 2.0, 1.0].map(|m| m * power).into_iter().find(|round| *round <= wanted).unwrap_or(wanted);
    let scale = Dim::Length.to_si(round, units);
    let heading = request.headings.first().copied().unwrap_or_default();
    let degrees = |angle: f64| {
        let own = (angle.to_degrees() * 1e6).round() / 1e6;
        format!("{}", own.rem_euclid(360.0))
    };
    let period = TAU / waves.forces.frequency;
    let title = if job.titles[0].is_empty() { format!("Waves at {}", meshed.names()) } else { job.titles[0].clone() };
    let held = if motions.iter().flatten().all(|motion| motion.norm() == 0.0) { ", held" } else { "" };
    Ok(WavePicture {
        title,
        waves: format!(
            "{}{held}: wave of {:.2} s from {} degrees, {:.1} {} long",
            meshed.names(),
            period,
            degrees(heading + PI),
            Dim::Length.from_si(length, units),
            Dim::Length.label(units)
        ),
        grid: WaveGrid { low, step, columns, values },
        waterlines,
        panels: panels.into_iter().zip(pressures).map(|(corners, value)| (corners, value / column)).collect(),
        heading: heading + meshed.heading,
        phase: args.option_number(&PHASE),
        scale: (scale, metres(job, scale)),
        width: args.option_integer(&PIXELS).and_then(|n| i32::try_from(n).ok()).unwrap_or(USUAL_WIDTH),
    })
}
