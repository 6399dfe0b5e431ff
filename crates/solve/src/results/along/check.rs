//! Unity checks along a line.

use super::{LineResults, ResultSection, wall_tension};
use crate::results::RunEvent;
use crate::system::SolveError;
use crate::time::NodeRow;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_model::{ClassError, Idealisation};
use windlass_signal::SeriesError;
use windlass_signal::line::lrfd::{LrfdFactors, TubeResistance};
use windlass_signal::line::working_stress::{self, DesignCase};
use windlass_signal::line::{CheckedTube, SectionLoads, over_break};

/// What a tube is checked by; other sections go by tension over break.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Code {
    /// DNV-ST-F201, with what corrodes of the wall (m).
    Lrfd(LrfdFactors, f64),
    /// API RP 2RD, with what corrodes of the wall (m).
    WorkingStress(DesignCase, f64),
    /// Tension over break for tubes, too.
    Break,
}

impl Code {
    fn name(&self) -> &'static str {
        match self {
            Code::Lrfd(..) => "F201",
            Code::WorkingStress(..) => "2RD",
            Code::Break => "BREAK",
        }
    }
}

/// A segment as it is checked.
#[derive(Debug)]
enum Checked {
    Lrfd(Box<TubeResistance>),
    WorkingStress(CheckedTube, DesignCase),
    Break(f64),
}

impl Checked {
    fn new(section: &ResultSection, code: &Code, bends: bool) -> Result<Checked, ClassError> {
        let tube = section.tube.filter(|_| bends);
        let wrong = |e: SeriesError| ClassError::new(e.to_string());
        let thinner = |tube: CheckedTube, corroded: f64| {
            if corroded < tube.wall {
                return Ok(CheckedTube { wall: tube.wall - corroded, ..tube });
            }
            let values = [(corroded, Dim::Section), (tube.wall, Dim::Section)];
            Err(ClassError::with_values("-CORROSION of {} leaves nothing of a wall of {}", &values))
        };
        Ok(match (code, tube) {
            (Code::Lrfd(factors, corroded), Some(tube)) => {
                Checked::Lrfd(Box::new(TubeResistance::new(thinner(tube, *corroded)?, *factors).map_err(wrong)?))
            }
            (Code::WorkingStress(case, corroded), Some(tube)) => {
                let thinner = thinner(tube, *corroded)?;
                thinner.check().map_err(wrong)?;
                Checked::WorkingStress(thinner, *case)
            }
            _ => Checked::Break(section.segment.breaking),
        })
    }

    fn name(&self) -> &'static str {
        match self {
            Checked::Lrfd(..) => "F201",
            Checked::WorkingStress(..) => "2RD",
            Checked::Break(_) => "BREAK",
        }
    }
}

/// The most a node uses, and what acts then.
#[derive(Clone, Copy, Debug)]
struct Worst {
    used: f64,
    time: f64,
    arc: f64,
    segment: usize,
    acting: SectionLoads,
}

/// The largest use of what each node resists over some events, and when; where two segments meet, of the one that uses more. What acts at the first stored instant, at rest, is functional
/// load, of a node that a winch made later what acted there at the same distance from the first end; what is more or less later is of the
/// environment.
///
/// # Errors
/// A section that is no tube, a factor out of range.
pub fn check(line: &LineResults, code: &Code, events: &[RunEvent]) -> Result<Table, SolveError> {
    let wrong = |e: SeriesError| SolveError { who: Some(line.name.to_string()), error: ClassError::new(e.to_string()) };
    let (run, columns) = (line.run, line.columns);
    let checked: Vec<Checked> = line
        .sections
        .iter()
        .map(|section| Checked::new(section, code, columns.bends))
        .collect::<Result<_, ClassError>>()
        .map_err(|error| SolveError { who: Some(line.name.to_string()), error })?;
    let first = run.history.rows().next().unwrap_or_default();
    let rest: Vec<Option<NodeRow>> = line.positions.iter().map(|p| columns.node(*p, first)).collect();
    let length = line.length(first);
    let lrfd = checked.iter().any(|c| matches!(c, Checked::Lrfd(_)));
    let mut worst: Vec<Option<Worst>> = vec![None; line.positions.len()];
    let mut row = Vec::new();
    for event in events {
        line.row(event, &mut row);
        let time = row.first().copied().unwrap_or(f64::NAN);
        for ((position, rest), worst) in line.positions.iter().zip(&rest).zip(&mut worst) {
            let Some(node) = columns.node(*position, &row) else { continue };
            for (_, segment, section) in line.sides(&node, &row) {
                let Some(how) = checked.get(segment) else { continue };
                let acting = acting(&node, section);
                let used = match how {
                    Checked::Lrfd(resistance) => {
                        // what a winch has made since hangs where something else hung at rest
                        let there = || line.at_arc(node.arc.min(length), first);
                        let at_rest = rest.or_else(there).unwrap_or(node);
                        resistance.used_now(design(&at_rest), design(&node), [acting.inside, acting.outside])
                    }
                    Checked::WorkingStress(tube, case) => {
                        // of the wall that corrosion leaves
                        let acting = SectionLoads { wall: wall_tension(tube, &node), ..acting };
                        working_stress::utilisation(tube, &acting, *case).map_err(wrong)?
                    }
                    Checked::Break(breaking) => over_break(node.effective, *breaking).map_err(wrong)?,
                };
                if !used.is_finite() {
                    return Err(line.error(format!("its check at {time} s is not finite")));
                }
                if worst.is_none_or(|w| used > w.used) {
                    *worst = Some(Worst { used, time, arc: node.arc, segment, acting });
                }
            }
        }
    }
    let mut table = check_table(line, code, &checked, &worst);
    if lrfd && rest.iter().any(Option::is_none) {
        table.note(match length.is_finite() {
            true => {
                "what a winch made later has as functional load what was at its distance from the first end at rest"
            }
            false => "it did not act at rest: all of its load is functional",
        });
    }
    Ok(table)
}

/// Moments about two directions and effective tension.
fn design(node: &NodeRow) -> [f64; 3] {
    let [one, other] = node.bent.map(|b| b.bends).unwrap_or_default();
    [one, other, node.effective]
}

fn acting(node: &NodeRow, section: &ResultSection) -> SectionLoads {
    let Some(bent) = &node.bent else { return SectionLoads { effective: node.effective, ..SectionLoads::default() } };
    let [outside, inside] = bent.pressures;
    SectionLoads {
        moment: bent.moment(),
        effective: node.effective,
        wall: section.stress_tension(node),
        inside,
        outside,
    }
}

fn check_table(line: &LineResults, code: &Code, checked: &[Checked], worst: &[Option<Worst>]) -> Table {
    let bends = line.columns.bends;
    let by_code = checked.iter().any(|c| !matches!(c, Checked::Break(_)));
    let table = Table::new("Unity Checks Along a Line")
        .fact("Line", line.name, Dim::None)
        .fact("Model", Idealisation::Dynamic, Dim::None)
        .fact("Code", if by_code { code.name() } else { Code::Break.name() }, Dim::None);
    let rows: Vec<(usize, &Worst)> =
        worst.iter().enumerate().filter_map(|(index, found)| Some((index + 1, found.as_ref()?))).collect();
    let mut table = table
        .with_rows(&rows)
        .column("", "Node", Dim::None, Digits::Usual, |(number, _)| *number)
        .column("", "Arc", Dim::Length, Digits::Usual, |(_, found)| found.arc)
        .text("Check", |(_, found)| checked.get(found.segment).map(Checked::name))
        .column("Largest", "Utilisation", Dim::None, Digits::Decimals(3), |(_, found)| found.used)
        .column("Largest", "At", Dim::Time, Digits::Usual, |(_, found)| found.time)
        .column("Then", "Tension", Dim::Force, Digits::Usual, |(_, found)| found.acting.effective);
    if bends {
        table = table.column("Then", "Moment", Dim::Moment, Digits::Usual, |(_, found)| found.acting.moment).column(
            "Then",
            "Net Pressure",
            Dim::Stress,
            Digits::Usual,
            |(_, found)| found.acting.inside - found.acting.outside,
        );
    }
    let mut table = table.build();
    let mut most: Option<(usize, Worst)> = None;
    for (number, found) in rows {
        if most.is_none_or(|(_, m)| found.used > m.used) {
            most = Some((number, *found));
        }
    }
    if let Some((node, Worst { used, time, .. })) = most {
        // sums of steps are off in their last digits
        let time = (time * 1e6).round() / 1e6;
        let where_most = format!("most is used at node {node}: {used:.3} at {time} s");
        if used > 1.0 {
            table.warn(format!("it does not hold; {where_most}"));
        } else {
            table.note(where_most);
        }
    }
    match code {
        Code::Lrfd(factors, _) if by_code => table.note(format!(
            "DNV-ST-F201, combined loading, gamma_SC {} gamma_m {} gamma_F {} gamma_E {}: at rest functional, the rest of the environment",
            factors.class.factor(),
            factors.material,
            factors.functional,
            factors.environmental
        )),
        Code::WorkingStress(case, _) if by_code => table.note(format!(
            "API RP 2RD (1998), von Mises stress at the middle of the wall over {} times 2/3 of the yield stress",
            case.factor()
        )),
        _ => {}
    }
    if checked.iter().any(|c| matches!(c, Checked::Break(_))) {
        table.note("BREAK is tension over breaking tension");
    }
    table
}
