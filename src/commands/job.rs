//! The job that commands act on: model, units, menus, titles, settings, output.

use crate::commands::environment::bathymetry::Soundings;
use crate::commands::journal::Journal;
use crate::commands::menu;
use crate::commands::model::element::DeferredElement;
use crate::commands::model::hydrodynamics::TotalData;
use crate::commands::model::pgen::Planes;
use crate::commands::model::process::Process;
use crate::commands::model::shapes::SectionShape;
use crate::commands::output::buildg::Building;
use crate::commands::solve::frequency::FrequencyMenu;
use crate::commands::solve::hstatics::HydrostaticsMenu;
use crate::commands::solve::line_loss::{IntactRun, LossInstant};
use crate::commands::undo::UndoStates;
use crate::commands::verdict::Verdict;
use crate::report::disposition::Disposition;
use crate::report::files::{FilePlace, Question};
use crate::report::live::LivePageFile;
use crate::report::output::Output;
use crate::report::page::{self, PageHead};
use crate::report::run_log::StoredRun;
use crate::report::taken_state::TakenState;
use indexmap::IndexMap;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;
use windlass_base::diagnostic::{Diagnostic, Severity};
use windlass_base::geometry::Position;
use windlass_base::span::Span;
use windlass_base::table::Table;
use windlass_base::units::UnitSystem;
use windlass_base::values::Args;
use windlass_language::spec::MenuSpec;
use windlass_model::Model;
use windlass_solve::EquilibriumOptions;
use windlass_solve::results::ScatterExposure;
use windlass_solve::tethered::Tethered;
use windlass_solve::time::{Action, Run};
use windlass_study::kept::Kept;

/// A menu that is open.
#[derive(Clone, Debug)]
pub enum Menu {
    /// The main menu.
    Main,
    /// Model descriptions; names may be used before they are defined.
    Inmodel,
    /// Model editing; names must be defined before they are used.
    Medit,
    /// Connector design.
    ConnDesign,
    /// Post-processing of the last run.
    Post,
    /// A result being disposed of.
    Disposition(Box<Disposition>),
    /// A report being written: to the screen, to the report file.
    Report {
        /// To the screen.
        screen: bool,
        /// To the report file.
        hard: bool,
    },
    /// Environments being defined by `&DATA ENVIRONMENT`.
    Environments,
    /// Curves being defined by `&DATA CURVES`.
    Curves,
    /// Sections of structural members being defined by `&DATA SHAPES`.
    Shapes,
    /// Selectors being defined by `&SELECT`.
    Selectors,
    /// Surfaces of hulls being defined by `&SURFACE`.
    Surface,
    /// A surface of sections or panels being given by `BLOCK`.
    Block(Box<Planes>),
    /// A surface of panels being given by `MESH`.
    Mesh(MeshVertices),
    /// Hydrostatics of a body.
    Hydrostatics(HydrostaticsMenu),
    /// The frequency domain, with what it has found.
    Frequency(Box<FrequencyMenu>),
    /// Hydrodynamic data.
    Hydrodynamics,
    /// A database being given by the records of `I_TOTAL`.
    Total(Box<TotalData>),
    /// A table being given by the records of `&BUILDG`.
    Building(Box<Building>),
    /// Rows of a bottom being given by the records of `&BATHYMETRY`.
    Soundings(Box<Soundings>),
    /// Summaries of `&SUMMARY`.
    Summary,
    /// Sections of a hull being given by `PGEN`.
    Planes(Box<Planes>),
    /// The menu whose opener was refused: its commands are passed over up to its `END`.
    Refused(&'static MenuSpec),
    /// The menu of a command that a check does not run.
    Checked(&'static MenuSpec),
}

impl Menu {
    /// What it is called and what leaves it.
    pub fn spec(&self) -> &'static MenuSpec {
        match self {
            Menu::Main => &menu::MAIN,
            Menu::Inmodel => &menu::INMODEL,
            Menu::Medit => &menu::MEDIT,
            Menu::ConnDesign => &menu::CONN_DESIGN,
            Menu::Post => &menu::PRCPOST,
            Menu::Disposition(_) => &menu::DISPOSITION,
            Menu::Report { .. } => &menu::REPORT,
            Menu::Environments => &menu::ENVIRONMENT,
            Menu::Shapes => &menu::SHAPES,
            Menu::Curves => &menu::CURVES,
            Menu::Selectors => &menu::SELECT,
            Menu::Surface => &menu::SURFACE,
            Menu::Block(_) => &menu::BLOCK,
            Menu::Mesh(_) => &menu::MESH,
            Menu::Building(_) => &menu::BUILDG,
            Menu::Soundings(_) => &menu::BATHYMETRY,
            Menu::Planes(_) => &menu::PGEN,
            Menu::Hydrostatics(_) => &menu::HSTATICS,
            Menu::Frequency(_) => &menu::FREQ_RESPONSE,
            Menu::Hydrodynamics => &menu::HYDRODYNAMICS,
            Menu::Total(_) => &menu::I_TOTAL,
            Menu::Summary => &menu::SUMMARY,
            Menu::Refused(menu) | Menu::Checked(menu) => menu,
        }
    }

    /// Its name, as specs and prompts use it.
    pub fn name(&self) -> &'static str {
        self.spec().name
    }

    /// The long form of `END`.
    pub fn end(&self) -> &'static str {
        self.spec().end
    }
}

/// What `&DEVICE` sets.
#[derive(Clone, Debug, PartialEq)]
pub struct DeviceSettings {
    /// Stop at the first error.
    pub batch: bool,
    /// Errors after which a script ends.
    pub error_limit: i64,
    /// Date printed in reports instead of today's.
    pub date: Option<String>,
    /// Records are shown as they are executed.
    pub echo: bool,
    /// Nothing goes to the screen but errors.
    pub silent: bool,
    /// Prefix of the names of plot files.
    pub figure_name: String,
    /// Number of the next figure.
    pub figure_number: i64,
    /// The file INMODEL reads instead of ROOT.DAT.
    pub auxiliary: Option<PathBuf>,
    /// Columns and lines of a terminal plot, when they were set.
    pub plot_size: Option<(usize, usize)>,
    /// Reports are as wide as their columns, whatever the screen has.
    pub wide: bool,
    /// What is longer than the screen is shown a screen at a time.
    pub pages: bool,
}

impl Default for DeviceSettings {
    fn default() -> Self {
        DeviceSettings {
            batch: false,
            error_limit: 10,
            date: None,
            echo: false,
            silent: false,
            figure_name: "FIGURE".into(),
            figure_number: 1,
            auxiliary: None,
            plot_size: None,
            wide: false,
            pages: true,
        }
    }
}

/// A user's file opened by `&FILE OPEN` or `USE`.
#[derive(Debug)]
pub enum UserFile {
    /// Being written.
    Writing {
        /// Where it will be.
        position: FilePlace,
        /// The lines so far.
        text: String,
        /// The name in the record that opened it.
        opened: Span,
    },
    /// Being read.
    Reading {
        /// Where it is.
        path: PathBuf,
        /// The lines left, last first.
        lines: Vec<String>,
    },
}

/// Files of `&FILE`, by their type.
#[derive(Debug, Default)]
pub struct UserFiles {
    /// With the number that says in which order they were opened.
    by_type: HashMap<String, (u64, UserFile)>,
    /// The types of those being written, by their places.
    types: HashMap<PathBuf, String>,
    opened: u64,
}

impl UserFiles {
    /// The file of a type.
    pub fn get(&self, kind: &str) -> Option<&UserFile> {
        self.by_type.get(kind).map(|(_, file)| file)
    }

    /// The file of a type.
    pub fn get_mut(&mut self, kind: &str) -> Option<&mut UserFile> {
        self.by_type.get_mut(kind).map(|(_, file)| file)
    }

    /// Gives a type its file.
    pub fn insert(&mut self, kind: String, file: UserFile) {
        self.remove(&kind);
        if let UserFile::Writing { position, .. } = &file {
            self.types.insert(position.path().to_path_buf(), kind.clone());
        }
        self.opened += 1;
        self.by_type.insert(kind, (self.opened, file));
    }

    /// Takes away the file of a type.
    pub fn remove(&mut self, kind: &str) {
        if let Some((_, UserFile::Writing { position, .. })) = self.by_type.remove(kind) {
            self.types.remove(position.path());
        }
    }

    /// The type of the file that is being written at a place.
    pub fn writing_at(&self, path: &Path) -> Option<&str> {
        self.types.get(path).map(String::as_str)
    }

    /// All files with their types, in the order they were opened.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &UserFile)> {
        let mut all: Vec<_> = self.by_type.iter().collect();
        all.sort_by_key(|(_, (order, _))| *order);
        all.into_iter().map(|(kind, (_, file))| (kind.as_str(), file))
    }

    /// Takes away all files, in the order they were opened.
    pub fn take(&mut self) -> Vec<(String, UserFile)> {
        self.types.clear();
        let mut all: Vec<_> = self.by_type.drain().collect();
        all.sort_by_key(|(_, (order, _))| *order);
        all.into_iter().map(|(kind, (_, file))| (kind, file)).collect()
    }
}

/// The vertices of a mesh by name, in the order given (m).
pub type MeshVertices = IndexMap<String, Position>;

/// What a check of a script knows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Checking {
    /// A solve has been passed over: places and forces are not known any more.
    pub solved: bool,
    /// The record at hand asks for what a solve finds.
    pub hangs_on_result: bool,
}

/// A table that a record has shown or opened a menu over, with the user's units of that moment.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptTable {
    /// The table.
    pub table: Table,
    /// The units.
    pub units: UnitSystem,
}

/// One running job.
pub struct Job {
    /// The model.
    pub model: Model,
    /// The user's units.
    pub units: UnitSystem,
    /// Units saved by `&DIMEN -SAVE`.
    pub saved_units: Vec<UnitSystem>,
    /// Open menus, the main one first.
    pub menus: Vec<Menu>,
    /// `&TITLE` and `&SUBTITLE`.
    pub titles: [String; 2],
    /// `&DEVICE`.
    pub settings: DeviceSettings,
    /// The channels.
    pub output: Output,
    /// Warnings and notes a handler raised; the session prints them.
    pub notices: Vec<Diagnostic>,
    /// Options that do nothing in their class type, which the user has been warned of: type and option.
    pub idle_said: Vec<(&'static str, &'static str)>,
    /// Records of MOSES without effect here, or that windlass does not have, which the user has been told of.
    pub absent_said: Vec<&'static str>,
    /// Libraries of macros that USE_MAC did not find, in capitals.
    pub missing_libraries: Vec<String>,
    /// Classes of types that windlass does not have, by key, with what their connectors would do.
    pub absent_classes: HashMap<String, Option<&'static str>>,
    /// The last solve, where it was refused: what asks for its results is no error of its own.
    pub refused_solve: Option<&'static str>,
    /// Set while a script is only checked.
    pub checking: Option<Checking>,
    /// Severity of the last record, for `&INFO(SEVERITY ..)`.
    pub last_severity: Option<Severity>,
    /// CONNECTOR records of an open INMODEL, waiting for names defined later.
    pub deferred: Vec<Args>,
    /// BEAM and PLATE records of an open INMODEL, waiting for their classes and nodes.
    pub deferred_elements: Vec<DeferredElement>,
    /// Sections of `&DATA SHAPES`, by key.
    pub shapes: IndexMap<String, SectionShape>,
    /// ASSEMBLY records of an open INMODEL, waiting for their connectors.
    pub deferred_assemblies: Vec<Args>,
    /// Pieces of an open `&SURFACE`, not yet held against the others of their bodies.
    pub uncompared_pieces: Vec<String>,
    /// Files of `&FILE`.
    pub user_files: UserFiles,
    /// Files that STORE has named by itself.
    pub stored_unnamed: usize,
    /// Variables that `&F_READ` sets.
    pub assignments: Vec<(String, String)>,
    /// Processor time at the last `&DCPTIME`.
    pub clock: Instant,
    /// How `&GET` asks; absent without a terminal.
    pub ask: Option<Question>,
    /// Names longer than MOSES takes have been remarked on.
    pub long_name_said: bool,
    /// What `&EQUI` was last given.
    pub equilibrium: EquilibriumOptions,
    /// What happens during runs.
    pub actions: Vec<Action>,
    /// Lists of `&VARIABLE`.
    pub name_lists: IndexMap<String, Vec<String>>,
    /// How many words of a list that fit a selector have been taken, of each list and selector.
    pub name_walks: IndexMap<(String, String), usize>,
    /// A `&GET` has had no answer, and an error has said so.
    pub unanswered: bool,
    /// The name of the current process.
    pub process: String,
    /// The other processes, by key.
    pub processes: IndexMap<String, Process>,
    /// The last run.
    pub run: Option<Run>,
    /// A run read from its file, which the next TDOM takes instead of running.
    pub stored_run: Option<StoredRun>,
    /// States that records took from earlier runs, with the number of records executed before each.
    pub taken_states: Vec<(usize, TakenState)>,
    /// Those that the records of a stored run took, which its own records take again.
    pub offered_states: Vec<TakenState>,
    /// The quasi-static lines that the last run replayed as dynamic ones, and by how much these pull harder.
    pub screened: Vec<(String, f64)>,
    /// The last run of tethers.
    pub tethered: Option<Tethered>,
    /// The runs that FATIGUE adds up.
    pub scatter: Vec<ScatterExposure>,
    /// What the exit code is to tell.
    pub verdict: Verdict,
    /// The tables that records have shown, where a program reads them.
    pub kept_tables: Option<Vec<KeptTable>>,
    /// Named results and rows of lines, for the record of a study's case.
    pub kept: Kept,
    /// The intact case that a transient case of a study follows.
    pub intact_run: Option<IntactRun>,
    /// When the last run lost lines by `-LOSE`.
    pub line_loss: Option<LossInstant>,
    /// The records that were executed.
    pub journal: Journal,
    /// The page that is written as the job goes, where one was asked for.
    pub page: Option<LivePageFile>,
    /// The tables printed last, for the page.
    pub last_tables: Vec<Table>,
    /// States that `&UNDO` goes back to; none without a terminal.
    pub undo: Option<UndoStates>,
    /// Set by Ctrl-C: a command that takes long gives up, and the run ends behind it.
    pub interrupt: Arc<AtomicBool>,
}

impl Job {
    /// A new job writing to these channels.
    pub fn new(output: Output) -> Self {
        Job {
            model: Model::default(),
            units: UnitSystem::default(),
            saved_units: Vec::new(),
            menus: vec![Menu::Main],
            titles: Default::default(),
            settings: DeviceSettings::default(),
            output,
            notices: Vec::new(),
            idle_said: Vec::new(),
            absent_said: Vec::new(),
            refused_solve: None,
            missing_libraries: Vec::new(),
            absent_classes: HashMap::new(),
            checking: None,
            last_severity: None,
            deferred: Vec::new(),
            deferred_assemblies: Vec::new(),
            uncompared_pieces: Vec::new(),
            deferred_elements: Vec::new(),
            shapes: IndexMap::new(),
            user_files: UserFiles::default(),
            stored_unnamed: 0,
            assignments: Vec::new(),
            clock: Instant::now(),
            ask: None,
            long_name_said: false,
            equilibrium: EquilibriumOptions::default(),
            actions: Vec::new(),
            name_lists: IndexMap::new(),
            name_walks: IndexMap::new(),
            unanswered: false,
            process: "DEFAULT".into(),
            processes: IndexMap::new(),
            run: None,
            stored_run: None,
            taken_states: Vec::new(),
            offered_states: Vec::new(),
            tethered: None,
            scatter: Vec::new(),
            screened: Vec::new(),
            verdict: Verdict::default(),
            kept_tables: None,
            kept: Kept::default(),
            intact_run: None,
            line_loss: None,
            journal: Journal::default(),
            page: None,
            last_tables: Vec::new(),
            undo: None,
            interrupt: Arc::default(),
        }
    }

    /// Keeps a table that a record shows, where a program reads them.
    pub fn keep_table(&mut self, table: &Table) {
        let units = self.units;
        if let Some(kept) = &mut self.kept_tables {
            kept.push(KeptTable { table: table.clone(), units });
        }
    }

    /// The state of the last run at the stored instant nearest to a time (s), for a record that takes it: it is kept for the file of
    /// the run that the record leads to. `None` where there is no run.
    pub fn take_state(&mut self, time: f64) -> Option<TakenState> {
        let state = match &self.run {
            Some(run) => TakenState::from_history(&run.history, time)?,
            None => {
                let offered = self.offered_states.iter().position(|state| state.time == time)?;
                self.offered_states.remove(offered)
            }
        };
        self.taken_states.push((self.journal.records().len(), state.clone()));
        Some(state)
    }

    /// The states that records took from earlier runs, those of records that were taken back left out.
    pub fn states_taken(&self) -> impl Iterator<Item = &TakenState> {
        let undone = |record: &usize| self.journal.records().get(*record).is_some_and(|record| record.is_undone);
        self.taken_states.iter().filter(move |(record, _)| !undone(record)).map(|(_, state)| state)
    }

    /// Whether Ctrl-C has been pressed since the record began.
    pub fn is_interrupted(&self) -> bool {
        self.interrupt.load(Ordering::Relaxed)
    }

    /// The innermost menu.
    pub fn menu(&self) -> &Menu {
        self.menus.last().unwrap_or(&Menu::Main)
    }

    /// Prints text for the user (nothing when silent).
    pub fn say(&mut self, text: &str) {
        if self.settings.silent {
            self.output.log(text);
        } else {
            self.output.text(text);
        }
    }

    /// Prints what `layout` makes of the columns of the screen; without columns it is as wide as it is, which the log always has.
    pub fn say_fitted(&mut self, layout: impl Fn(Option<usize>) -> String) {
        let whole = layout(None);
        if self.settings.silent {
            return self.output.log(&whole);
        }
        match (self.output.columns)().filter(|_| !self.settings.wide) {
            Some(columns) => self.output.laid_out(&layout(Some(columns)), &whole),
            None => self.output.text(&whole),
        }
    }

    /// Keeps tables that are printed for the page of the job, where there is one.
    pub fn keep_for_page(&mut self, tables: &[Table]) {
        if self.page.is_some() {
            self.last_tables = tables.to_vec();
        }
    }

    /// Prints the reports of some tables.
    pub fn say_tables(&mut self, tables: &[Table]) {
        tables.iter().for_each(|table| self.keep_table(table));
        self.keep_for_page(tables);
        let (units, head) = (self.units, self.page_head());
        self.say_fitted(|width| page::render_all(tables, units, &head, width));
    }

    /// What is said where results of a solve are asked for that are not there: a note where one of `solves` has just been refused.
    pub fn lacks_results(&self, text: &str, solves: &[&str], help: &str, span: Span) -> Box<Diagnostic> {
        match self.refused_solve.filter(|refused| solves.contains(refused)) {
            Some(refused) => Diagnostic::remark(format!("{text}: {refused} was refused"), span),
            None => Diagnostic::error(text, span).help(help),
        }
    }

    /// Raises a remark.
    pub fn remark(&mut self, text: impl Into<String>, span: Span) {
        self.notices.push(*Diagnostic::remark(text, span));
    }

    /// The name of the next file of a table that the user gives none.
    pub fn next_unnamed_file(&mut self) -> String {
        self.stored_unnamed += 1;
        format!("PPO{:05}.CSV", self.stored_unnamed)
    }

    /// Raises a warning.
    pub fn warn(&mut self, text: impl Into<String>, span: Span) {
        self.notices.push(*Diagnostic::warning(text, span));
    }

    /// Says once that MOSES itself takes shorter names.
    pub fn note_name(&mut self, name: &str, span: Span) {
        if !self.long_name_said && name.chars().count() > 8 {
            self.long_name_said = true;
            self.remark(format!("{name} is longer than the 8 characters MOSES takes (said once)"), span);
        }
    }

    /// Columns and lines of a terminal plot: those of `&DEVICE -PLOT_SIZE`, else as wide as the terminal, else 90.
    pub fn plot_size(&self) -> (usize, usize) {
        self.settings.plot_size.unwrap_or_else(|| ((self.output.columns)().unwrap_or(90), 26))
    }

    /// What stands at the head of a page.
    pub fn page_head(&self) -> PageHead {
        PageHead { date: Some(self.date()), titles: self.titles.clone(), process: self.process.clone() }
    }

    /// The date of reports: that of `&DEVICE -SET_DATE`, else today (UTC).
    pub fn date(&self) -> String {
        self.settings.date.clone().unwrap_or_else(|| time::OffsetDateTime::now_utc().date().to_string())
    }
}
