//! What columns mean: every column that a script or an example prints or writes is in the list that `&HELP` and the reference read.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use windlass::commands::report_columns::{find_report_column, report_columns};
use windlass::commands::{COLUMNS_OF_LINES, COMMANDS};
use windlass::report::columns::long_name;
use windlass::report::files::JobFolder;
use windlass::report::output::Output;
use windlass::session::Session;
use windlass_base::table::{Column, Digits, Table};
use windlass_base::units::Dim;
use windlass_connectors::class_specs;

/// Records whose tables have columns that no script or example prints: trim varied, a weight to be added.
const RARE_COLUMNS: &str = "MEDIT\n&DESCRIBE BODY TBRG\n*C 200 0 10\n&SURFACE\nBLOCK HULL 0 -50 0 400 50 20\nEND\n\
                            #WEIGHT *C 20000 30 100 100\nEND\n&INSTATE -CONDITION 9\nHSTATICS\nCFORM 9 -PITCH 0.5 3\nREPORT\nEND\n\
                            KG_ALLOW 5 12 -GM 1\nREPORT\nEND\nEND\n";

/// A job to be run: a script, or the example of a help.
enum ColumnSource {
    Script(PathBuf),
    Example(&'static str),
}

/// The tables that a job prints or opens a menu over.
fn tables_of(source: &ColumnSource) -> Vec<Table> {
    let folder = tempfile::tempdir().unwrap();
    let start = |job: JobFolder| {
        let mut session = Session::new(Output::new(job, Box::new(std::io::sink()), Box::new(std::io::sink()), false));
        session.job.kept_tables = Some(Vec::new());
        session
    };
    let mut session = match source {
        ColumnSource::Script(script) => {
            let out = Some(folder.path().join("out"));
            let mut session = start(JobFolder::new(script.with_extension(""), out, false));
            session.open_job(&script.display().to_string(), fs::read_to_string(script).unwrap());
            session
        }
        ColumnSource::Example(example) => {
            let mut session = start(JobFolder::new(folder.path().join("job"), None, false));
            session.open("example", (*example).to_string());
            session
        }
    };
    session.run();
    session.finish();
    session.job.kept_tables.take().unwrap().into_iter().map(|kept| kept.table).collect()
}

/// What was found of the columns of many jobs.
#[derive(Default)]
struct FoundColumns {
    /// Title, head and dimension of columns that are in no list.
    unexplained: BTreeSet<(String, String, String)>,
    /// The report and the head of the entries that explained one.
    used: BTreeSet<(usize, &'static str)>,
}

impl FoundColumns {
    fn take(&mut self, title: &str, column: &Column) {
        match find_report_column(title, column) {
            Some(found) => drop(self.used.insert((std::ptr::from_ref(found) as usize, found.head))),
            None => {
                let known = (title.to_string(), long_name(column), format!("{:?}", column.dim));
                self.unexplained.insert(known);
            }
        }
    }
}

#[test]
fn every_column_that_is_printed_is_explained() {
    let scripts = fs::read_dir("scripts").unwrap().flatten().map(|entry| entry.path());
    // he01.dat is he01_phases.dat with random phases
    let is_run =
        |path: &Path| path.extension().is_some_and(|e| e == "cif" || e == "dat") && !path.ends_with("he01.dat");
    let examples = COMMANDS.iter().map(|command| command.spec).chain(class_specs()).map(|spec| spec.example);
    let examples = examples.chain([RARE_COLUMNS]);
    let sources =
        examples.map(ColumnSource::Example).chain(scripts.filter(|path| is_run(path)).map(ColumnSource::Script));
    let waiting = Mutex::new(sources.collect::<Vec<_>>());
    let found = Mutex::new(FoundColumns::default());
    for name in COLUMNS_OF_LINES {
        let column = Column::new("", name, Dim::None, Digits::Usual, [0.0]);
        found.lock().unwrap().take("LINES", &column);
    }
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                loop {
                    let next = waiting.lock().unwrap().pop();
                    let Some(source) = next else { break };
                    for table in tables_of(&source) {
                        table.columns().iter().for_each(|column| found.lock().unwrap().take(&table.title, column));
                    }
                }
            });
        }
    });
    let FoundColumns { unexplained, used } = found.into_inner().unwrap();
    let entries =
        report_columns().flat_map(|report| report.columns.iter().map(move |column| (report.printed_by, column)));
    let idle: Vec<(&str, &str)> = entries
        .filter(|(_, column)| !used.contains(&(std::ptr::from_ref(*column) as usize, column.head)))
        .map(|(report, column)| (report, column.head))
        .collect();
    assert!(
        unexplained.is_empty() && idle.is_empty(),
        "columns in no list of src/commands/report_columns: {unexplained:#?}; explained ones that nothing prints: {idle:#?}"
    );
}

#[test]
fn explanations_of_columns_are_phrases() {
    for report in report_columns() {
        let mut heads = BTreeSet::new();
        for column in report.columns {
            let (head, meaning) = (column.head, column.meaning);
            assert!(!meaning.is_empty() && !meaning.ends_with('.'), "{head} of {}: {meaning}", report.printed_by);
            assert!(
                heads.insert((head, format!("{:?}", column.units))),
                "{head} of {} stands twice",
                report.printed_by
            );
        }
    }
}

#[test]
fn help_finds_a_column_with_its_meaning_and_unit() {
    let folder = tempfile::tempdir().unwrap();
    let job = JobFolder::new(folder.path().join("job"), None, false);
    let mut session = Session::new(Output::new(job, Box::new(std::io::sink()), Box::new(std::io::sink()), false));
    session.open("records", "&HELP 'Line on Bottom'\n&HELP declination\n");
    session.run();
    session.finish();
    let log = fs::read_to_string(folder.path().join("job.ans/LOG00001.TXT")).unwrap();
    let words = log.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        words.contains("column of TABLE of CONN_DESIGN; TABLE -VARY of CONN_DESIGN: length on the seabed, stretched"),
        "{words}"
    );
    assert!(
        words.contains("angle of the line from straight down at its fairlead: 90 degrees are horizontal (deg)"),
        "{words}"
    );
}
