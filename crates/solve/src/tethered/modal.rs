//! What is reported of a tether before it runs: its description and its natural modes.

use super::case::{TetherCaseKind, case, sections};
use super::{TetherRunSettings, case::Installed};
use crate::SolveError;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_model::{ClassError, Model};
use windlass_tether::installed::description::InstalledDescription;
use windlass_tether::installed::modes::modes as installed_modes;

/// Settings under which a case is made to be reported, not to be run.
const AT_REST: TetherRunSettings = TetherRunSettings {
    start: 0.0,
    observed: 1.0,
    step: 1.0,
    store: 1,
    compatible: false,
    slam: 0.0,
    tow: [0.0; 2],
    transient: 0.0,
    keep: true,
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
    let made = case(model, &[], &AT_REST)?;
    let connector = model.connectors.get(&Model::key(name));
    let point = |end: usize| connector.and_then(|c| c.points.get(end)).map_or("", String::as_str);
    let nodes = [point(1), point(0)];
    let ends = connector.and_then(|c| c.tether.clone()).unwrap_or_default();
    let mut table = match &made.kind {
        TetherCaseKind::Towed(towed) => {
            let mut description = towed.tether.description(1, nodes);
            // a towed tether has no stop and no impact: the listing has them as they were given
            description.stop = ends.low_stop.unwrap_or(0.0);
            description.impact = ends.impact.unwrap_or_default();
            description.ends[1].given = ends.given.unwrap_or(description.ends[1].given);
            description.table()
        }
        TetherCaseKind::Installed(case) => {
            let tether = find_tether(case, name)?;
            let attachment = case.course.pose.point(tether.attachment);
            let description = InstalledDescription::new(tether, attachment, &case.flow).map_err(SolveError::new)?;
            let mut listed = description.to_listing(tether, (1, nodes), case.centre, &case.flow);
            listed.ends[1].given = ends.given.unwrap_or(listed.ends[1].given);
            let table = listed.table();
            table.fact_with_digits(
                "EFFECTIVE TENSION IN THE MIDDLE",
                description.tension,
                Dim::Force,
                Digits::Scientific(4),
            )
        }
    };
    table.title = format!("Description of Tension Leg Tether {name}");
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

/// Frequencies (rad/s) from which on modes are not listed.
const LARGEST_LISTED_FREQUENCY: f64 = 999.999;

/// A mode as it is listed.
struct ListedMode {
    frequency: Option<f64>,
    period: Option<f64>,
    position: Option<usize>,
    /// Place of each node along the tether (m), and its shape.
    nodes: Vec<(f64, [f64; 4])>,
}

/// A page for each of the lowest natural modes of a tether where it stands [AQWA-TETHER 7.2]: place in the matrices, frequency, period and the shape,
/// of largest deflection one or, without one, of largest slope ten degrees. The last page says how many modes are not listed. `compatible` keeps the
/// peculiarities of AQWA.
///
/// # Errors
/// As [`case`]; a name that is no tether's; modes that cannot be found.
pub fn natural(model: &Model, name: &str, number: usize, compatible: bool) -> Result<Vec<Table>, SolveError> {
    let made = case(model, &[], &TetherRunSettings { compatible, ..AT_REST })?;
    // one more: the first that is not listed
    let asked = number.saturating_add(1);
    let towed = matches!(made.kind, TetherCaseKind::Towed(_));
    let (dofs, modes): (usize, Vec<ListedMode>) = match &made.kind {
        TetherCaseKind::Towed(towed) => {
            let distances = towed.tether.line.distances();
            let list = towed.tether.modes(asked).map_err(SolveError::new)?;
            let listed = |m: &windlass_tether::modes::NaturalMode| ListedMode {
                frequency: m.frequency(),
                period: m.period(),
                position: m.freedom_position(),
                nodes: distances.iter().enumerate().map(|(i, d)| (*d, m.node(i))).collect(),
            };
            (4 * towed.tether.line.nodes(), list.iter().map(listed).collect())
        }
        TetherCaseKind::Installed(case) => {
            let tether = find_tether(case, name)?;
            let attachment = case.course.pose.point(tether.attachment);
            let list = installed_modes(tether, attachment, &case.flow, asked, &case.compatibility);
            let listed = |m: &windlass_tether::installed::modes::InstalledMode| ListedMode {
                frequency: m.mode.frequency(),
                period: m.mode.period(),
                position: m.freedom_position(),
                nodes: m.heights.iter().enumerate().map(|(i, h)| (*h, m.node(i))).collect(),
            };
            (4 * tether.line.nodes(), list.map_err(SolveError::new)?.iter().map(listed).collect())
        }
    };
    let is_listed = |mode: &ListedMode| mode.frequency.is_none_or(|w| w <= LARGEST_LISTED_FREQUENCY);
    let listed = modes.iter().take(number).take_while(|mode| is_listed(mode)).count();
    let mut tables: Vec<Table> =
        modes.iter().take(listed).zip(1..).map(|(mode, order)| mode_page(mode, order, name, towed)).collect();
    if dofs > listed
        && let Some(last) = tables.last_mut()
    {
        let next = modes.get(listed).and_then(|mode| mode.frequency);
        let next = next.map_or(LARGEST_LISTED_FREQUENCY, |w| w.min(LARGEST_LISTED_FREQUENCY));
        let period = std::f64::consts::TAU / next;
        last.note(format!("{} MODES> {next:.3} RAD/SEC (PERIOD= {period:.4} SECS) NOT PRINTED", dofs - listed));
    }
    Ok(tables)
}

/// The page of a mode.
fn mode_page(mode: &ListedMode, order: usize, name: &str, towed: bool) -> Table {
    let four = Digits::Decimals(4);
    let (position, displacement, [u, v, ru, rv]) = match towed {
        true => ("DISTANCE ALONG TETHER", "VERT/HORIZONTAL DISPLACEMENT", ["Y", "Z", "RY", "RZ"]),
        false => ("HEIGHT ABOVE ANCHOR", "LATERAL DISPLACEMENT", ["X", "Y", "RX", "RY"]),
    };
    let nodes: Vec<(usize, &(f64, [f64; 4]))> = mode.nodes.iter().enumerate().rev().collect();
    Table::new(format!("Eigensolution Mode {order} - Tether {name}"))
        .fact("MODE FREEDOM POSN", mode.position, Dim::None)
        .fact_with_digits("FREQUENCY (RAD/SEC)", mode.frequency, Dim::None, four)
        .fact_with_digits("FREQUENCY (HERTZ)", mode.frequency.map(|w| w / std::f64::consts::TAU), Dim::None, four)
        .fact_with_digits("PERIOD", mode.period, Dim::Time, Digits::Decimals(2))
        .with_rows(&nodes)
        .column("", "NODE", Dim::None, Digits::Usual, |(node, _)| node + 1)
        .column("", position, Dim::Length, Digits::Decimals(2), |(_, (position, _))| *position)
        .columns(displacement, [u, v], Dim::None, four, |(_, (_, shape))| [shape[0], shape[1]])
        .columns("SLOPE", [ru, rv], Dim::Angle, four, |(_, (_, shape))| [shape[2], shape[3]])
        .build()
}
