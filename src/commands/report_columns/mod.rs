//! What the columns of reports, tables and files mean: the one list that `&HELP`, the reference and a test of every script read.
//!
//! A report is known by the titles of its tables, a column by its head, `Group: Name` as `VLIST` prints it, and by what it measures. `@`
//! stands for any text: the name of a body, a connector or a column.

mod bodies;
mod frequency;
mod lines;
mod model;
mod series;
mod tethers;
mod time;

use windlass_base::table::Column;
use windlass_base::units::{Dim, UnitSystem};
use windlass_base::wildcard::matches;

use crate::report::columns::long_name;

/// The columns of one report.
pub struct ReportColumns {
    /// What prints it: a command, with its report or option.
    pub printed_by: &'static str,
    /// Titles of its tables.
    pub titles: &'static [&'static str],
    /// The columns.
    pub columns: &'static [ReportColumn],
}

/// A column of reports.
pub struct ReportColumn {
    /// Its head.
    pub head: &'static str,
    /// What it measures: one of these; of none it is the unit of the column that the row or the group names.
    pub units: &'static [Dim],
    /// What it is, with its sign or direction.
    pub meaning: &'static str,
}

impl ReportColumn {
    /// The name of the column, without its group.
    pub fn name(&self) -> &'static str {
        self.head.rsplit(": ").next().unwrap_or(self.head)
    }

    /// Its unit in a system, for help.
    pub fn unit(&self, units: UnitSystem) -> String {
        if self.units.is_empty() {
            return "that of the column described".into();
        }
        let mut labels: Vec<String> = self.units.iter().map(|dim| dim.label(units)).collect();
        labels.dedup();
        labels.join(", ")
    }

    fn is_of(&self, column: &Column, long: &str) -> bool {
        matches(self.head, long) && (self.units.is_empty() || self.units.contains(&column.dim))
    }
}

const fn column(head: &'static str, units: &'static [Dim], meaning: &'static str) -> ReportColumn {
    ReportColumn { head, units, meaning }
}

/// What every report may have, last.
static COMMON: ReportColumns = ReportColumns {
    printed_by: "all reports",
    titles: &["@"],
    columns: &[
        column("Name", NONE, "the name of what the row is about"),
        column("Line", NONE, "the name of the line"),
        column("Body", NONE, "the name of the body"),
        column("Class", NONE, "the class of the connector"),
        column("Type", NONE, "the type of the class, element or joint"),
        column("Segment", NONE, "number of the segment, from the first end"),
        column("Node", NONE, "number of the node, from 1 at the first end"),
        column("Model", NONE, "how the line is idealised: quasi-static or dynamic"),
        column("Time", TIME, "time since the beginning of the run"),
        column("Frequency", FREQUENCY, "circular frequency"),
        column("Period", TIME, "period"),
        column("Heading", ANGLE, "where the waves come from, from +X toward +Y"),
    ],
};

/// Every report with its columns, in the order of the reference.
pub fn report_columns() -> impl Iterator<Item = &'static ReportColumns> {
    lines::REPORTS
        .iter()
        .chain(bodies::REPORTS)
        .chain(model::REPORTS)
        .chain(time::REPORTS)
        .chain(frequency::REPORTS)
        .chain(tethers::REPORTS)
        .chain(series::REPORTS)
        .chain([&COMMON])
}

/// What a column of a table means.
pub fn find_report_column(title: &str, column: &Column) -> Option<&'static ReportColumn> {
    let long = long_name(column);
    report_columns()
        .filter(|report| report.titles.iter().any(|pattern| matches(pattern, title)))
        .find_map(|report| report.columns.iter().find(|entry| entry.is_of(column, &long)))
}

const NONE: &[Dim] = &[Dim::None];
const LENGTH: &[Dim] = &[Dim::Length];
const SECTION: &[Dim] = &[Dim::Section];
const AREA: &[Dim] = &[Dim::Area];
const VOLUME: &[Dim] = &[Dim::Volume];
const FORCE: &[Dim] = &[Dim::Force];
const PER_LENGTH: &[Dim] = &[Dim::ForcePerLength];
const MOMENT: &[Dim] = &[Dim::Moment];
const STRESS: &[Dim] = &[Dim::Stress];
const ANGLE: &[Dim] = &[Dim::Angle];
const TIME: &[Dim] = &[Dim::Time];
const VELOCITY: &[Dim] = &[Dim::Velocity];
const ACCELERATION: &[Dim] = &[Dim::Acceleration];
const TURN_VELOCITY: &[Dim] = &[Dim::AngularVelocity];
const TURN_ACCELERATION: &[Dim] = &[Dim::AngularAcceleration];
const FREQUENCY: &[Dim] = &[Dim::Frequency];
const ENERGY: &[Dim] = &[derived(1, 1, 0)];
const SECOND_MOMENT: &[Dim] = &[derived(0, 4, 0)];
const PRESSURE: &[Dim] = &[derived(1, -2, 0)];
/// The unit of the column that the row or the group names.
const DESCRIBED: &[Dim] = &[];

const fn derived(force: i8, length: i8, seconds: i8) -> Dim {
    Dim::Derived { force, length, seconds }
}
