//! STORE: columns of a result as a file, by the ending of its name.

use crate::commands::output::disposition::{MAG_USE, RECORD, VALUES, chosen_columns, open_disposition, write_file};
use crate::commands::{Call, Command, Effect, Job};
use crate::report::{csv, netcdf, parquet, xlsx};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_language::spec::{CommandSpec, DatumKey};

/// STORE.
pub static STORE: Command = Command { spec: &SPEC, edits: false, run };

static SPEC: CommandSpec = CommandSpec {
    data: &[crate::commands::output::disposition::STORED, crate::commands::output::disposition::ANY_COLUMN],
    repeat: 1,
    options: &[RECORD, VALUES, MAG_USE],
    detail: "By the ending of the name; others are refused. CSV: a header of the column names with units, then numbers with full \
             precision. Parquet (.parquet): columns with the same names, of doubles, whole numbers or text, not compressed; title, source, units \
             and notes in the metadata. NetCDF-3 (.nc): a variable for each column over the dimension row, with the same name (but _ for /, \
             which the format does not take), units and long_name; text as characters. Excel (.xlsx): the same heads and numbers on \
             one sheet, title, facts and notes on a second; text is never a formula. All are in user units, and a value that is missing is missing in the \
             file. Without a name, or with columns alone as in MOSES (STORE 1 2 5:8, STORE Time Z), the file is PPO00001.CSV, the next PPO00002.CSV and so on (our \
             reading). A relative file name is inside the job's folder: &HELP &FILE.",
    ..crate::commands::output::disposition::spec("STORE", "writes columns to a CSV, Excel, Parquet or NetCDF file")
};

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const FILE: DatumKey<str> = SPEC.word("FILE");
    let args = &call.args;
    // a word that is a column chooses it: the record is MOSES's, which names no file
    let columns = open_disposition(job, args.span)?.table.columns();
    let is_column = |word: &str| {
        word.bytes().all(|b| b.is_ascii_digit() || b == b':')
            || word.contains('@')
            || columns.iter().any(|column| column.name.eq_ignore_ascii_case(word))
    };
    let named = args.word(FILE).filter(|word| !is_column(word)).map(crate::commands::files::file::with_csv_ending);
    let columns = if named.is_some() { args.data_after(FILE) } else { args.data.as_slice() };
    let table = chosen_columns(job, args, columns)?;
    let name = named.unwrap_or_else(|| job.next_unnamed_file());
    let ending = std::path::Path::new(&name).extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
    let bytes = match ending.as_deref() {
        Some("parquet") => parquet::bytes(&table, job.units).map_err(|e| e.to_string()),
        Some("nc") => netcdf::bytes(&table, job.units).map_err(|e| e.to_string()),
        Some("xlsx") => xlsx::bytes(&table, job.units).map_err(|e| e.to_string()),
        Some("csv") => csv::bytes(&table, job.units).map_err(|e| e.to_string()),
        _ => {
            // a name that no file may have is refused for that
            let position = job.output.folder.position(&name);
            position.map_err(|e| crate::commands::files::file::to_diagnostic(&e, args.position(FILE)))?;
            Err(format!("a table is stored as .csv, .xlsx, .parquet or .nc, not as `{name}`"))
        }
    };
    let bytes = bytes.map_err(|text| Diagnostic::error(text, args.position(FILE)))?;
    write_file(job, &name, &bytes, args.position(FILE))?;
    Ok(Effect::Done)
}
