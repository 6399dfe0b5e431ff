//! LINES: many single lines of a CSV file, each solved between its two given ends.

mod input;

use crate::commands::files::file;
use crate::commands::menu;
use crate::commands::{Call, Command, Effect, Job};
use crate::report::csv::guard_formula;
use crate::report::files::{FilePlace, Growing};
use crate::report::format::number_in_full;
use crate::report::page;
use input::{Input, InputError, InputRow, RowError};
use std::collections::BTreeMap;
use windlass_base::diagnostic::{Diagnostic, Outcome, Severity};
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_catenary::EndForces;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, ValueSpec};

/// LINES.
pub static LINES: Command = Command { spec: &LINES_SPEC, edits: false, run: lines };

static LINES_SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: &[&menu::CONN_DESIGN],
    data: &[
        ValueSpec::new("IN", Kind::File, "CSV file to read; looked for where it says, then beside the script"),
        ValueSpec::new("OUT", Kind::File, "CSV file to write; .csv is added when it has no ending"),
    ],
    detail: "One line of a single segment a row, in SI units whatever &DIMEN says. The columns, in any order: id; x_m and z_m, \
             the fairlead beside (zero or more) and above the anchor; length_m, unstretched; EA_N; w_N_per_m, submerged weight \
             per unstretched length, negative when buoyant; friction; suspended, 1 without a bottom, 0 with a flat one at the \
             anchor that has this friction. Blank or without a column, friction and suspended are 0. Upper and lower case and \
             blanks around names do not matter. OUT has all columns of IN as they are, then fairlead_H_N and fairlead_V_N (the \
             pull on the fairlead, toward the anchor and downward), anchor_H_N and anchor_V_N (the pull on the anchor, toward \
             the fairlead and upward), grounded_length_m (unstretched), regime, residual (N, what is left of the distances \
             mapped through the stiffness) and error, with full precision. A column of IN that has one of these names goes \
             through with _in added to its name. A row that cannot be solved has its reason under error; the first ten are \
             also warned of, by their lines in the file. A relative OUT is inside the job's folder: &HELP &FILE. It is written \
             whole, or not at all after Ctrl-C.",
    example: "&FILE OPEN IN lines.csv\n&FILE WRITE IN id,x_m,z_m,length_m,EA_N,w_N_per_m\n\
              &FILE WRITE IN A1,850,120,900,5E8,1500\n&FILE CLOSE IN\nCONN_DESIGN\nLINES job.ans/lines.csv solved\nEND",
    ..CommandSpec::new("LINES", "solves the single lines of a CSV file")
};

/// The columns added to those of the input.
pub const ADDED: [&str; 8] =
    ["fairlead_H_N", "fairlead_V_N", "anchor_H_N", "anchor_V_N", "grounded_length_m", "regime", "residual", "error"];

/// Refused rows that are reported one by one.
const MAX_REPORTED_ROWS: u64 = 10;

fn lines(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const IN: DatumKey<str> = LINES_SPEC.word("IN");
    const OUT: DatumKey<str> = LINES_SPEC.word("OUT");
    let args = &call.args;
    let (name, span) = (args.word(IN).unwrap_or_default(), args.position(IN));
    let path = crate::commands::settings::device::existing(job, name, span)?;
    let unusable = |error: InputError| {
        let mut made = Diagnostic::error(format!("{name} cannot be used: {error}"), span);
        if let InputError::NoColumn { help, .. } = error {
            made.help.push(help);
        }
        made
    };
    let opened =
        crate::commands::settings::device::open_input(job, &path).map_err(|e| InputError::Unreadable(e.to_string()));
    let mut input = opened.and_then(Input::open).map_err(unusable)?;
    let out = file::with_csv_ending(args.word(OUT).unwrap_or_default());
    let refused = |error| file::to_diagnostic(&error, args.position(OUT));
    let position = job.output.folder.position(&out).map_err(refused)?;
    let lost =
        |error: csv::Error| Diagnostic::error(format!("{}: {error}", position.path().display()), args.position(OUT));
    let mut writer = csv::Writer::from_writer(position.begin().map_err(refused)?);
    writer.write_record(heads(&input.heads).iter().map(|head| guard_formula(head).into_owned())).map_err(lost)?;
    let width = input.heads.len();
    let mut tally = SolvedCounts::default();
    while let Some(row) = input.next_row().map_err(unusable)? {
        if job.is_interrupted() {
            let text = format!("LINES is given up at line {} of {name}: {out} is not written", row.line);
            return Err(Diagnostic::error(text, args.span));
        }
        let solved = solve(&row);
        tally.count(name, &row, &solved);
        write_row(&mut writer, &row, width, &solved).map_err(lost)?;
    }
    if tally.solved + tally.refused == 0 {
        return Err(unusable(InputError::Empty));
    }
    let whole = writer.into_inner().map_err(|e| lost(e.into_error().into()))?;
    whole.finish().map_err(refused)?;
    job.verdict.absent += usize::try_from(tally.refused).unwrap_or(usize::MAX);
    job.notices.append(&mut tally.warnings);
    if tally.refused > MAX_REPORTED_ROWS {
        let text = format!(
            "{} further rows of {name} are refused; the column error of {out} says why",
            tally.refused - MAX_REPORTED_ROWS
        );
        job.notices.push(Diagnostic::plain(Severity::Warning, text));
    }
    Ok(Effect::Say(tally.summary(name, &position, job)))
}

fn solve(row: &InputRow) -> Result<EndForces, RowError> {
    let case = row.case()?;
    Ok(case.segment.solve_end_forces(case.x, case.z, case.bottom)?)
}

/// The header of the output: no two names alike that were not so in the input.
fn heads(given: &[String]) -> Vec<String> {
    let mut heads: Vec<String> = given.to_vec();
    for head in &mut heads {
        if ADDED.iter().any(|added| head.eq_ignore_ascii_case(added)) {
            head.push_str("_in");
            while given.contains(head) {
                head.push_str("_in");
            }
        }
    }
    heads.extend(ADDED.map(String::from));
    heads
}

fn write_row(
    writer: &mut csv::Writer<Growing>,
    row: &InputRow,
    width: usize,
    solved: &Result<EndForces, RowError>,
) -> csv::Result<()> {
    for at in 0..width {
        let cell = row.cells.get(at).unwrap_or_default();
        match std::str::from_utf8(cell) {
            Ok(text) => writer.write_field(guard_formula(text).as_bytes())?,
            Err(_) => writer.write_field(cell)?,
        }
    }
    let added = match solved {
        Ok(forces) => {
            let ([fairlead_h, fairlead_v], [anchor_h, anchor_v]) = (forces.fairlead, forces.anchor);
            let [a, b, c, d, e] = [fairlead_h, fairlead_v, anchor_h, anchor_v, forces.grounded].map(number_in_full);
            [a, b, c, d, e, forces.regime.name().into(), number_in_full(forces.residual), String::new()]
        }
        Err(reason) => {
            let mut added = ADDED.map(|_| String::new());
            if let Some(error) = added.last_mut() {
                *error = reason.to_string();
            }
            added
        }
    };
    for cell in added {
        writer.write_field(cell)?;
    }
    writer.write_record(None::<&[u8]>)
}

/// What came of the rows.
#[derive(Default)]
struct SolvedCounts {
    solved: u64,
    refused: u64,
    regimes: BTreeMap<&'static str, usize>,
    warnings: Vec<Diagnostic>,
}

impl SolvedCounts {
    fn count(&mut self, name: &str, row: &InputRow, solved: &Result<EndForces, RowError>) {
        match solved {
            Ok(forces) => {
                self.solved += 1;
                *self.regimes.entry(forces.regime.name()).or_default() += 1;
            }
            Err(reason) => {
                self.refused += 1;
                if self.refused <= MAX_REPORTED_ROWS {
                    let id = row.id();
                    let id = if id.is_empty() { id } else { format!(" (id {id})") };
                    let text = format!("{name}:{}: {reason}{id}", row.line);
                    self.warnings.push(Diagnostic::plain(Severity::Warning, text));
                }
            }
        }
    }

    /// The lines by regime, and how many rows were solved and refused.
    fn summary(&self, name: &str, position: &FilePlace, job: &Job) -> String {
        let regimes: Vec<_> = self.regimes.iter().collect();
        let table = Table::new("")
            .with_rows(&regimes)
            .text("Regime", |(regime, _)| **regime)
            .column("", "Lines", Dim::None, Digits::Usual, |(_, lines)| **lines)
            .build();
        let mut text = if self.solved > 0 { page::grid(&table, job.units, None) } else { Vec::new() };
        text.push(format!("{name}: {} rows solved, {} refused", self.solved, self.refused));
        text.push(format!("wrote {}", position.path().display()));
        text.join("\n")
    }
}
