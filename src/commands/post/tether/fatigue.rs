//! `RANGES` and `FATIGUE` of TETHER: rainflow ranges of a towed tether, and the life they leave.

use super::records::{STEPS, find_statistics};
use super::{EVENTS, TetherQuery, TetherReport, WHAT};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_base::values::Args;
use windlass_language::spec::{Kind, OptionSpec, ValueSpec};
use windlass_signal::tether::fatigue::{Endurance, FatigueSettings};

/// RANGES.
pub(super) static RANGES: TetherReport =
    TetherReport::new("RANGES", "of a towed tether: rainflow ranges of stress, as AQWA-TETHER has them", |query| {
        Ok(vec![ranges_and_fatigue(query)?.0])
    })
    .with_options(&[EVENTS, STEPS, SN]);
/// FATIGUE.
pub(super) static FATIGUE: TetherReport =
    TetherReport::new("FATIGUE", "of a towed tether: life in days, peak expected", |query| {
        Ok(vec![ranges_and_fatigue(query)?.1])
    })
    .with_options(&[EVENTS, STEPS, SN, HOURS]);

const SN: OptionSpec = OptionSpec::ours(
    "-SN",
    &[
        ValueSpec::new("SCF", Kind::Number(Dim::None), "stress concentration factor").positive(),
        ValueSpec::new("A", Kind::Number(Dim::None), "intercept of N = A / R**m, R in kN/m2").positive(),
        ValueSpec::new("M", Kind::Number(Dim::None), "slope").positive(),
    ],
    "fatigue curve",
)
.default("1.24 1.3367E24 3.5");
const HOURS: OptionSpec = OptionSpec::ours(
    "-HOURS",
    &[ValueSpec::new("H", Kind::Number(Dim::None), "hours").positive()],
    "time in which the peak stress is expected",
)
.default("3");

/// The table of ranges and that of fatigue.
fn ranges_and_fatigue(query: &TetherQuery) -> Outcome<(Table, Table)> {
    let (tether, args) = (query.tether, query.args());
    if !tether.towed {
        let name = &tether.name;
        let text = format!("tether {name} is installed: ranges and fatigue are of towed tethers [AQWA-TETHER 3.7]");
        return Err(Diagnostic::error(text, args.position(WHAT)));
    }
    let made = find_statistics(query)?.fatigue(query.run, tether, fatigue_settings(args));
    let [ranges, fatigue] = query.to_outcome(made)?;
    Ok((ranges, fatigue))
}

/// Curve and hours of FATIGUE.
fn fatigue_settings(args: &Args) -> FatigueSettings {
    let usual = Endurance::KILONEWTONS;
    let curve = args.option(&SN).map_or(usual, |g| Endurance {
        concentration: g.number(const { SN.number("SCF") }).unwrap_or(usual.concentration),
        intercept: g.number(const { SN.number("A") }).unwrap_or(usual.intercept),
        slope: g.number(const { SN.number("M") }).unwrap_or(usual.slope),
    });
    let hours = args.option_number(&HOURS).unwrap_or(3.0);
    FatigueSettings { duration: 1.0, curve: curve.in_unit(1000.0), peak_time: hours * 3600.0 }
}
