//! What is reported of a tether before it runs: its description and its natural modes.

use super::case::{TetherCaseKind, case, sections};
use super::{TetherRunSettings, case::Installed};
use crate::SolveError;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_model::{ClassError, Model};
use windlass_tether::installed::description::InstalledDescription;
use windlass_tether::installed::modes::modes;

/// Settings under which a case is made to be reported, not to be run.
const AT_REST: TetherRunSettings = TetherRunSettings {
    observed: 1.0,
    step: 1.0,
    store: 1,
    compatible: false,
    slam: 0.0,
    tow: [0.0; 2],
    transient: 0.0,
};

/// A tether of the case, by its name.
fn find_tether<'a>(
    case: &'a Installed,
    name: &str,
) -> Result<&'a windlass_tether::installed::InstalledTether, SolveError> {
    let of = case.tethers.iter().find(|t| t.name.eq_ignore_ascii_case(name));
    of.ok_or_else(|| SolveError::new(ClassError::new(format!("{name} is no tether that acts"))))
}

/// The names of the tethers that act, in the order of the model.
pub fn names(model: &Model) -> Vec<String> {
    let acts = model.connectors.values().filter(|c| c.active && !sections(model, c).is_empty());
    acts.map(|c| c.name.clone()).collect()
}

/// The description of a tether [AQWA-TETHER 7.1], and what was taken otherwise than it was given.
///
/// # Errors
/// As [`case`]; a name that is no tether's.
pub fn description_table(model: &Model, name: &str) -> Result<Table, SolveError> {
    let made = case(model, &AT_REST)?;
    let connector = model.connectors.get(&Model::key(name));
    let point = |end: usize| connector.and_then(|c| c.points.get(end)).map_or("", String::as_str);
    let nodes = [point(1), point(0)];
    let mut table = match &made.kind {
        TetherCaseKind::Towed(towed) => towed.1.description(1, nodes).table(),
        TetherCaseKind::Installed(case) => {
            let tether = find_tether(case, name)?;
            let attachment = case.course.pose.point(tether.attachment);
            let description = InstalledDescription::new(tether, attachment, &case.flow).map_err(SolveError::new)?;
            let table = description.to_listing(tether, (1, nodes), case.centre, &case.flow).table();
            table.fact("Effective Tension in the Middle", description.tension, Dim::Force)
        }
    };
    table.title = format!("Description of Tether {name}");
    let named = |note: &str| {
        let list = note.strip_prefix("tether ").and_then(|rest| rest.split([',', ':']).next());
        list.is_none_or(|list| list.split(' ').any(|n| n.eq_ignore_ascii_case(name)))
    };
    let about = |note: &&String| named(note);
    let notes: Vec<&String> = made.notes.iter().filter(about).collect();
    for note in notes {
        table.note(note.clone());
    }
    Ok(table)
}

/// A page for each of the lowest natural modes of a tether where it stands [AQWA-TETHER 7.2]: frequency, period and the shape, of largest
/// deflection one or, without one, of largest slope ten degrees. `compatible` keeps the peculiarities of AQWA.
///
/// # Errors
/// As [`case`]; a name that is no tether's; modes that cannot be found.
pub fn natural(model: &Model, name: &str, number: usize, compatible: bool) -> Result<Vec<Table>, SolveError> {
    let made = case(model, &TetherRunSettings { compatible, ..AT_REST })?;
    type Page = (Option<f64>, Option<f64>, Vec<(f64, [f64; 4])>);
    let (heads, pages): ([&str; 4], Vec<Page>) = match &made.kind {
        TetherCaseKind::Towed(towed) => {
            let distances = towed.1.line.distances();
            let list = towed.1.modes(number).map_err(SolveError::new)?;
            let page = |m: &windlass_tether::modes::NaturalMode| {
                let rows = distances.iter().enumerate().map(|(i, d)| (*d, m.node(i))).collect();
                (m.frequency(), m.period(), rows)
            };
            (["Y", "Z", "RY", "RZ"], list.iter().map(page).collect())
        }
        TetherCaseKind::Installed(case) => {
            let tether = find_tether(case, name)?;
            let attachment = case.course.pose.point(tether.attachment);
            let list = modes(tether, attachment, &case.flow, number, &case.compatibility).map_err(SolveError::new)?;
            let page = |m: &windlass_tether::installed::modes::InstalledMode| {
                let rows = m.heights.iter().enumerate().map(|(i, h)| (*h, m.node(i))).collect();
                (m.mode.frequency(), m.mode.period(), rows)
            };
            (["X", "Y", "RX", "RY"], list.iter().map(page).collect())
        }
    };
    let mut tables = Vec::new();
    for (index, (frequency, period, rows)) in pages.into_iter().enumerate() {
        let nodes: Vec<_> = rows.iter().enumerate().rev().collect();
        let [u, v, ru, rv] = heads;
        let table = Table::new(format!("Mode {} of Tether {name}", index + 1))
            .fact("Frequency", frequency, Dim::Frequency)
            .fact("Frequency in Hertz", frequency.map(|w| w / std::f64::consts::TAU), Dim::None)
            .fact("Period", period, Dim::Time)
            .with_rows(&nodes)
            .column("", "Node", Dim::None, Digits::Usual, |(node, _)| node + 1)
            .column("", "Height", Dim::Length, Digits::Decimals(2), |(_, (height, _))| *height)
            .columns("Displacement", [u, v], Dim::None, Digits::Decimals(4), |(_, (_, shape))| [shape[0], shape[1]])
            .columns("Slope", [ru, rv], Dim::Angle, Digits::Decimals(4), |(_, (_, shape))| [shape[2], shape[3]])
            .build();
        tables.push(table);
    }
    Ok(tables)
}
