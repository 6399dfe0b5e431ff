//! The page: data, and a viewer of our own that draws them (share/film), with nothing to be fetched from anywhere.

use crate::report::embedded::{self, doubles, list, number, object, quote_base64, shorts, singles, string, wholes};
use nalgebra::{Rotation3, UnitQuaternion};
use windlass_base::units::{Dim, UnitSystem};
use windlass_solve::film::{Actor, ConnectorState, Film, FilmWaves, Strand, WaveField};

/// The page without its data, and what is put into it.
const PAGE_PARTS: [(&str, &str); 5] = [
    ("page.html", include_str!("../../../share/film/page.html")),
    ("style.css", include_str!("../../../share/film/style.css")),
    ("view.js", include_str!("../../../share/film/view.js")),
    ("water.js", include_str!("../../../share/film/water.js")),
    ("film.js", include_str!("../../../share/film/film.js")),
];
/// The largest number a place in the box of the film is written as.
const MAX_QUANTISED: f64 = 65_535.0;

/// The page of a film, with its title.
///
/// # Errors
/// What the template library reports.
pub fn page(film: &Film, title: &str, units: UnitSystem) -> Result<String, minijinja::Error> {
    embedded::page(&PAGE_PARTS, title, data(film, title, units))
}

/// A share of the steps between two bounds; the lowest where it is no number.
fn step(value: f64, low: f64, high: f64) -> u16 {
    let share = if high > low { (value - low) / (high - low) } else { 0.0 };
    (share.clamp(0.0, 1.0) * MAX_QUANTISED).round() as u16
}

fn data(film: &Film, title: &str, units: UnitSystem) -> String {
    let largest = |of: fn(&Strand) -> &[f64]| {
        film.strands.iter().flat_map(of).copied().filter(|v| v.is_finite()).fold(0.0, f64::max)
    };
    let (tension, share) = (largest(|s| &s.tensions), largest(|s| &s.shares));
    let pressure =
        film.actors.iter().flat_map(|actor| &actor.pressures).map(|[re, im]| re.hypot(*im)).fold(0.0, f64::max);
    let unit = |dim: Dim| object([("name", string(&dim.label(units))), ("per", number(dim.from_si(1.0, units)))]);
    let [low, high] = film.extent;
    let triple = |at: [f64; 3]| list(at.map(number));
    object([
        ("title", string(title)),
        ("length", unit(Dim::Length)),
        ("force", unit(Dim::Force)),
        ("times", doubles(film.times.iter().copied())),
        ("level", number(film.level)),
        ("bottom", film.bottom.map_or("null".into(), number)),
        ("low", triple(low)),
        ("high", triple(high)),
        ("tension", number(tension)),
        ("share", number(share)),
        ("bodies", list(film.actors.iter().map(actor))),
        ("lines", list(film.strands.iter().map(|s| strand(s, film.extent, (tension, share))))),
        ("anchors", list(film.anchors.iter().map(|(name, at)| object([("name", string(name)), ("at", triple(*at))])))),
        ("sea", film.waves.as_ref().map_or("null".into(), sea)),
        ("field", film.field.as_ref().map_or("null".into(), field)),
        ("pressure", number(pressure)),
        ("notes", list(film.notes.iter().map(|n| string(n)))),
    ])
}

fn actor(actor: &Actor) -> String {
    let solid = &actor.solid;
    let pose = |p: &windlass_base::pose::Pose| {
        let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(p.axes));
        [p.origin.x, p.origin.y, p.origin.z, turn.i, turn.j, turn.k, turn.w]
    };
    object([
        ("name", string(&actor.name)),
        ("junction", actor.junction.to_string()),
        ("box", solid.stands_for.to_string()),
        ("points", singles(solid.points.iter().flatten().copied())),
        ("triangles", wholes(solid.triangles.iter().flatten().copied())),
        ("edges", wholes(solid.edges.iter().flatten().copied())),
        ("poses", singles(actor.poses.iter().flat_map(pose))),
        ("pressures", singles(actor.pressures.iter().flatten().copied())),
    ])
}

fn strand(strand: &Strand, [low, high]: [[f64; 3]; 2], (tension, share): (f64, f64)) -> String {
    let position = |at: &[f64; 3]| -> [u16; 3] { std::array::from_fn(|i| step(at[i], low[i], high[i])) };
    let state = |s: &ConnectorState| match s {
        ConnectorState::Inactive => 0u8,
        ConnectorState::SectionLoads => 1,
        ConnectorState::Unsolved => 2,
    };
    object([
        ("name", string(&strand.name)),
        ("line", strand.line.to_string()),
        ("count", strand.count.to_string()),
        ("points", shorts(strand.points.iter().flat_map(position))),
        ("tensions", shorts(strand.tensions.iter().map(|t| step(*t, 0.0, tension)))),
        ("shares", shorts(strand.shares.iter().map(|t| step(*t, 0.0, share)))),
        ("states", quote_base64(strand.states.iter().map(state))),
    ])
}

/// Within a body there is no water: no number, which JSON has not.
fn field(field: &WaveField) -> String {
    object([
        ("low", list(field.low.map(number))),
        ("step", number(field.step)),
        ("columns", field.columns.to_string()),
        ("frequency", number(field.frequency)),
        ("values", singles(field.values.iter().flatten().copied())),
    ])
}

fn sea(waves: &FilmWaves) -> String {
    let numbers = waves.waves.iter().flat_map(|w| {
        let [tx, ty] = w.toward;
        [w.frequency, w.number * tx, w.number * ty, w.amplitude, w.phase]
    });
    object([
        ("waves", doubles(numbers)),
        ("ramp", number(waves.ramp)),
        ("rampStart", number(waves.ramp_start)),
        ("since", number(waves.since)),
    ])
}
