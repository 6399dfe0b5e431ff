//! `windlass report`: what an engineer sends out of a study, as one page of HTML and as Markdown.

mod cases;
mod fatigue;
mod kept_run;
mod lines;
mod page;
mod seeds;

pub use kept_run::script_of_case;

use self::kept_run::KeptRun;
use self::lines::{Governing, Replayed};
use self::page::{Block, GENERATOR, MARKDOWN_GENERATOR, Report, ReportTable, Section, Tone};
use super::StudyExit;
use crate::report::files::read_regular;
use std::collections::BTreeMap;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use windlass_base::printable::printable;
use windlass_base::units::{Dim, ForceUnit, LengthUnit, UnitSystem};
use windlass_study::kept::{LineAnalysis, LineVerdict};
use windlass_study::record::{CaseRecord, CaseStatus};
use windlass_study::store::{Files, Study, StudyError, SystemFiles};

/// Extremes over seeds, where the study has them.
const ENSEMBLES: &str = "ensembles.csv";
/// Most bytes of it that are read.
const LARGEST_ENSEMBLES: u64 = 1 << 26;

/// What stands at the end of `windlass report --help`.
pub const HELP: &str = "\
The page needs nothing from elsewhere and prints to PDF from a browser (A4, landscape). Beside it stands the same report in Markdown,
report.md, with its figures in report-figures. Histories around peaks and pictures come from the answers of the governing cases, which
a study keeps unless --keep says otherwise; quasi-static lines of runs that were not screened are replayed as dynamic ones.

    windlass report STUDY
    windlass report STUDY --out review.html --title \"Mooring of the semi, rev B\"

Exit codes:
  0    the report is written, whatever its verdict
  1    a file cannot be read or written
  2    wrong use of the command line";

/// The study to report, and how.
#[derive(clap::Args, Debug)]
pub struct ReportArgs {
    /// The folder of the study
    pub study: PathBuf,
    /// The page; the Markdown file and its folder of figures take its name [default: DIR/report.html of the study]
    #[arg(long, value_name = "FILE.html")]
    pub out: Option<PathBuf>,
    /// Title of the report [default: the title of the model, or the name of the folder]
    #[arg(long, value_name = "TEXT")]
    pub title: Option<String>,
    /// Column of the cases that holds the direction (degrees) [default: HEADING, DIRECTION or a like name]
    #[arg(long, value_name = "COLUMN")]
    pub direction: Option<String>,
}

/// A study as a report sees it.
pub struct StudyView<'a> {
    study: &'a Study,
    records: &'a [CaseRecord],
    units: UnitSystem,
    /// Whether a factor of the study is not confirmed: then nothing is a pass.
    is_unconfirmed: bool,
    direction: Option<String>,
}

impl<'a> StudyView<'a> {
    /// The cases by which tensions, anchors and fatigue are judged: with fibre ropes not those at their least stiffness.
    fn judging_tension(&self) -> impl Iterator<Item = &'a CaseRecord> + Clone + use<'a> {
        self.ended().filter(|record| record.judges_tension())
    }

    /// The cases that have not failed.
    fn ended(&self) -> impl Iterator<Item = &'a CaseRecord> + Clone + use<'a> {
        self.records.iter().filter(|record| record.status != CaseStatus::Failed)
    }
}

/// Why there is no report.
enum ReportError {
    Usage(String),
    Failed(String),
}

/// Writes the report of a study; `complain` takes what is wrong, `out` what is written.
pub fn run(args: &ReportArgs, out: &mut impl Write, complain: &dyn Fn(&str)) -> StudyExit {
    let (text, exit) = match write_report(args) {
        Ok(written) => (written, StudyExit::Done),
        Err(ReportError::Usage(text)) => {
            complain(&text);
            return StudyExit::Usage;
        }
        Err(ReportError::Failed(text)) => {
            complain(&text);
            return StudyExit::Failed;
        }
    };
    // a reader that has gone wants no more of it
    let _ = out.write_all(text.as_bytes()).and_then(|()| out.flush());
    exit
}

/// Where the report goes.
struct Place {
    page: PathBuf,
    markdown: PathBuf,
    figures: PathBuf,
    /// Name of the folder of figures, as the Markdown file has it.
    figures_name: String,
}

impl Place {
    /// # Errors
    /// Another ending than .html; files in the way that are no reports.
    fn new(args: &ReportArgs) -> Result<Self, String> {
        let page = args.out.clone().unwrap_or_else(|| args.study.join("report.html"));
        let shown = |path: &Path| path.display().to_string();
        if !page.extension().is_some_and(|end| end.eq_ignore_ascii_case("html")) {
            return Err(format!("--out {}: a report ends in .html", shown(&page)));
        }
        let stem = page.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        let figures_name = format!("{stem}-figures");
        let (markdown, figures) = (page.with_extension("md"), page.with_file_name(&figures_name));
        if let Some(folder) = page.parent().filter(|folder| !folder.as_os_str().is_empty() && !folder.is_dir()) {
            return Err(format!("there is no folder {}", shown(folder)));
        }
        for (path, mark) in [(&page, GENERATOR), (&markdown, MARKDOWN_GENERATOR)] {
            match std::fs::read_to_string(path) {
                Ok(text) if text.contains(mark) => {}
                Err(error) if error.kind() == ErrorKind::NotFound => {}
                _ => {
                    return Err(format!(
                        "{} is there already and is no report of windlass: --out names another",
                        shown(path)
                    ));
                }
            }
        }
        let foreign = match std::fs::read_dir(&figures) {
            Ok(mut entries) => {
                entries.any(|entry| !entry.is_ok_and(|e| e.path().extension().is_some_and(|end| end == "svg")))
            }
            Err(error) => error.kind() != ErrorKind::NotFound,
        };
        if foreign {
            return Err(format!("{} holds what is no figure of a report: --out names another", shown(&figures)));
        }
        Ok(Place { page, markdown, figures, figures_name })
    }

    /// Writes the page, the Markdown file and its figures, each whole or not at all.
    fn write(&self, report: &Report) -> Result<(), String> {
        let html = report.html().map_err(|error| format!("the page cannot be made: {error}"))?;
        let wrong = |path: &Path| {
            let shown = path.display().to_string();
            move |error: std::io::Error| format!("{shown} cannot be written: {error}")
        };
        let files = SystemFiles;
        let fresh = self.figures.with_file_name(format!(".{}.{}", self.figures_name, std::process::id()));
        let make = || -> Result<(), String> {
            files.make_folder(&fresh).map_err(wrong(&self.figures))?;
            for (name, bytes) in report.figures() {
                files.write(&fresh.join(name), bytes).map_err(wrong(&self.figures.join(name)))?;
            }
            files.move_folder(&fresh, &self.figures).map_err(wrong(&self.figures))
        };
        if let Err(error) = make() {
            // what is left of the attempt; there may be nothing
            let _ = files.remove_folder(&fresh);
            return Err(error);
        }
        files.write(&self.markdown, report.markdown(&self.figures_name).as_bytes()).map_err(wrong(&self.markdown))?;
        files.write(&self.page, html.as_bytes()).map_err(wrong(&self.page))
    }
}

fn write_report(args: &ReportArgs) -> Result<String, ReportError> {
    let study = Study::open(&args.study).map_err(|error| match error {
        StudyError::System { ref source, .. } if source.kind() == ErrorKind::NotFound => {
            ReportError::Usage(format!("{} is no folder of a study: windlass study makes one", args.study.display()))
        }
        other => ReportError::Usage(other.to_string()),
    })?;
    if study.records.is_empty() {
        return Err(ReportError::Usage(format!("{}: no case of the study is finished yet", args.study.display())));
    }
    let place = Place::new(args).map_err(ReportError::Usage)?;
    let records: Vec<CaseRecord> = study.records.iter().map(|record| record.to_record()).collect();
    let mut view = StudyView {
        study: &study,
        records: &records,
        units: units_of(&study),
        is_unconfirmed: records.iter().flat_map(|record| &record.lines).any(|row| {
            let is_unconfirmed = [row.verdict, row.anchor_verdict].contains(&Some(LineVerdict::Unconfirmed));
            is_unconfirmed || row.fatigue_confirmed == Some(false)
        }),
        direction: None,
    };
    view.direction = cases::direction_column(&view, args.direction.as_deref()).map_err(ReportError::Usage)?;
    let ensembles = args.study.join(ENSEMBLES);
    let ensembles = ensembles.exists().then(|| {
        let bytes = read_regular(&ensembles, LARGEST_ENSEMBLES).map_err(|error| error.to_string())?;
        cases::read_csv(&bytes)
    });
    let report = build(args, &mut view, ensembles);
    place.write(&report).map_err(ReportError::Failed)?;
    let mut text = String::new();
    for block in &report.banner {
        if let Block::Text { text: said, .. } = block {
            text.push_str(&format!("{}\n", printable(said).replace('\n', " ")));
        }
    }
    for path in [&place.page, &place.markdown] {
        text.push_str(&format!("   {}\n", printable(&path.display().to_string())));
    }
    Ok(text)
}

/// The units of the script; metres and kilonewtons where no case says them.
fn units_of(study: &Study) -> UnitSystem {
    let forces = [
        ForceUnit::Kilonewtons,
        ForceUnit::Kips,
        ForceUnit::LongTons,
        ForceUnit::ShortTons,
        ForceUnit::MetricTons,
        ForceUnit::Newtons,
    ];
    let all = forces
        .into_iter()
        .flat_map(|force| [LengthUnit::Meters, LengthUnit::Feet].map(|length| UnitSystem { length, force }));
    let said = study.records.iter().find_map(|record| record.units());
    let is_said = |units: &UnitSystem| {
        said.is_some_and(|(length, force)| Dim::Length.label(*units) == *length && Dim::Force.label(*units) == *force)
    };
    { all }.find(is_said).unwrap_or(UnitSystem { length: LengthUnit::Meters, force: ForceUnit::Kilonewtons })
}

/// The case that a picture of the model is of: that of the most severe row, else the first whose answers are kept.
fn pictured_case<'a>(study: &'a Path, view: &StudyView<'a>, rows: &[Governing<'a>]) -> Option<&'a str> {
    let severity = |found: &Governing| found.row.severity().map_or(f64::NEG_INFINITY, |(_, value)| value);
    let is_kept = |case: &str| KeptRun::is_kept(study, case);
    let kept = rows.iter().filter(|found| is_kept(&found.record.case));
    let worst = kept.reduce(|a, b| if severity(b) > severity(a) { b } else { a });
    let any = || view.ended().map(|record| record.case.as_str()).find(|case| is_kept(case));
    worst.map(|found| found.record.case.as_str()).or_else(any)
}

fn build(args: &ReportArgs, view: &mut StudyView, ensembles: Option<Result<ReportTable, String>>) -> Report {
    let study = args.study.as_path();
    let rows = lines::governing_rows(view);
    let mut model = Section::new("model", "Model");
    let mut environment = Section::new("environment", "Environment");
    let mut report = Report::default();
    let pictured = pictured_case(study, view, &rows).map(|case| (case, KeptRun::open(study, case)));
    match pictured {
        None => model.say(
            "No run of TDOM is kept: the model is not drawn and there are no histories. windlass study --keep governing, as it is set, keeps \
             those of the governing cases.",
        ),
        Some((case, Err(error))) => {
            model.say_in(Tone::Unconfirmed, format!("The model is not drawn: the run of case {case} cannot be opened: {error}."));
        }
        Some((case, Ok(mut kept))) => {
            let line = rows.iter().filter(|found| found.record.case == case).map(|found| found.row).reduce(|a, b| {
                let value = |row: &windlass_study::kept::LineRow| row.severity().map_or(0.0, |(_, value)| value);
                if value(b) > value(a) { b } else { a }
            });
            // the tables first: a picture moves the bodies
            for kept in kept.tables(&["&STATUS B_W", "&STATUS SPREAD", "&STATUS CL_FLEX"]) {
                model.show_record(&kept.table, kept.units);
            }
            let mut tables = kept.tables(&["&STATUS ENVIRONMENT"]);
            environment.say(format!("The environment of case {case}, and below what the cases vary."));
            if let Some(kept) = (!tables.is_empty()).then(|| tables.remove(0)) {
                environment.show_record(&kept.table, kept.units);
            }
            if let Some((row, (time, _))) = line.and_then(|row| Some((row, kept.peak(&row.line).ok()?))) {
                let caption = format!("Case {case} at {time} s, when the tension of {} is largest", row.line);
                let svg = kept.picture(time, &caption);
                let mut drawn = Section::new("model", "Model");
                drawn.draw("model", caption, svg);
                model.blocks.splice(0..0, drawn.blocks);
            }
        }
    }
    environment.head("What the cases vary");
    environment.show(cases::environment_table(view));

    let mut governing = Section::new("governing", "Governing cases of the lines");
    governing.say(
        "For each segment of a line and each condition the case with the largest utilisation (without a code: the largest tension over \
         strength). T char is the characteristic tension that is checked, largest T that of the record, n the maxima behind the most \
         probable maximum (MPM). Failed cases govern nothing.",
    );
    if rows.is_empty() {
        governing.say("No case keeps rows of lines: CODE_CHECK in the script does.");
    }
    governing.show(lines::governing_table(view, &rows));
    let mut histories: BTreeMap<usize, Block> = BTreeMap::new();
    let mut replayed: Vec<Replayed> = Vec::new();
    // of a transient case each instant of the loss is a run of its own
    let mut by_case: BTreeMap<(&str, Option<usize>), Vec<usize>> = BTreeMap::new();
    for (at, found) in rows.iter().enumerate() {
        let instant = found.row.loss.as_ref().map(|loss| loss.number);
        by_case.entry((&found.record.case, instant)).or_default().push(at);
    }
    let to_replay = cases_to_replay(view, &rows);
    by_case.retain(|(case, _), _| KeptRun::is_kept(study, case));
    for ((case, instant), numbers) in by_case {
        let opened = KeptRun::open_instant(study, case, instant);
        if let (Ok(kept), true) = (&opened, to_replay.contains(&case)) {
            replayed.extend(kept.replay(case));
        }
        for at in numbers {
            let Some(found) = rows.get(at) else { continue };
            let row = found.row;
            let verdict = view.verdict(row.verdict).text;
            let factor = row.safety_factor.map_or_else(String::new, |f| format!(", safety factor {f:.2}"));
            let asked = row.required_safety_factor.map_or_else(String::new, |f| format!(" (required {f})"));
            let caption = format!("{}, {}: case {case}{factor}{asked}: {verdict}", row.label(), row.condition.word());
            let file = format!("history-{}-{}", row.condition.word(), at + 1);
            let mut part = Section::default();
            match opened.as_ref().map_err(Clone::clone).and_then(|kept| kept.history(found)) {
                Ok(svg) => part.draw(&file, caption, svg),
                Err(error) => part.say(format!("{caption}. No history: {error}.")),
            }
            histories.extend(part.blocks.into_iter().map(|block| (at, block)));
        }
    }
    if !histories.is_empty() {
        governing.head("Histories around the peaks");
        governing.blocks.extend(histories.into_values());
    }

    let mut summary = Section::new("summary", "Summary");
    lines::summary(view, &rows, &mut summary);
    let folder =
        study.canonicalize().ok().and_then(|path| path.file_name().map(|name| name.to_string_lossy().into_owned()));
    let of_job = view.records.iter().map(|record| record.title.trim()).find(|title| !title.is_empty());
    report.title = args.title.clone().or_else(|| of_job.map(str::to_owned)).or(folder).unwrap_or_default();
    let seed_rows = seeds::seed_rows(view);
    report.banner = banner(view, &seed_rows);
    report.sections = vec![
        summary,
        model,
        environment,
        lines::analysis_section(view, &replayed),
        governing,
        seeds::seed_section(view, &seed_rows),
        cases::direction_section(view),
        cases::result_section(view),
        cases::ensemble_section(ensembles),
        lines::anchor_section(view),
        fatigue::fatigue_section(view, &fatigue::fatigue_lives(view)),
        cases::failed_section(view),
        cases::message_section(view),
        cases::case_section(view, &rows),
        cases::file_section(view),
    ];
    report
}

/// The governing case of each condition, where it has quasi-static lines and its run was not screened.
fn cases_to_replay<'a>(view: &StudyView<'a>, rows: &[Governing<'a>]) -> Vec<&'a str> {
    let mut worst: BTreeMap<windlass_study::kept::MooringCondition, (f64, &'a CaseRecord)> = BTreeMap::new();
    for found in rows {
        let Some((_, value)) = found.row.severity() else { continue };
        let known = worst.entry(found.row.condition).or_insert((value, found.record));
        if value > known.0 {
            *known = (value, found.record);
        }
    }
    let is_screened = view.ended().flat_map(|record| &record.lines).any(|row| row.screening_ratio.is_some());
    let is_quasi_static =
        |record: &CaseRecord| record.lines.iter().any(|row| row.analysis == Some(LineAnalysis::QuasiStatic));
    let cases = worst.values().map(|(_, record)| *record).filter(|record| !is_screened && is_quasi_static(record));
    cases.map(|record| record.case.as_str()).collect()
}

/// What stands on top: the verdict of the whole, and what a reader must know before it.
fn banner(view: &StudyView, seed_rows: &[seeds::SeedRow]) -> Vec<Block> {
    let mut section = Section::default();
    let study = view.study;
    if view.is_unconfirmed {
        section.say_in(
            Tone::Unconfirmed,
            "UNCONFIRMED: factors or curves of this study are not confirmed by their source. No check of this report is a pass.",
        );
    }
    let rows = || view.judging_tension().flat_map(|record| &record.lines);
    let failing = rows().filter(|row| [row.verdict, row.anchor_verdict].contains(&Some(LineVerdict::Fail))).count();
    let checked = rows().filter(|row| row.verdict.is_some()).count();
    let failed = study.count(CaseStatus::Failed);
    let missing = study.info.cases.len().saturating_sub(study.records.len());
    let whole = failed == 0 && missing == 0;
    match (failing, checked) {
        (_, 0) => section.say("No tension is checked by a code."),
        (0, _) if view.is_unconfirmed => {
            section.say(format!("All {checked} checks of line tension are met, by factors that are not confirmed."))
        }
        (0, _) if whole => section.say_in(Tone::Pass, format!("All {checked} checks of line tension are met.")),
        (0, _) => section.say(format!("All {checked} checks of line tension of the cases that have ended are met.")),
        (n, _) => section.say_in(Tone::Fail, format!("{n} of {checked} checks of lines are NOT met.")),
    }
    let short =
        fatigue::fatigue_lives(view).iter().filter(|(_, life)| life.verdict() == Some(LineVerdict::Fail)).count();
    if short > 0 {
        section.say_in(
            Tone::Fail,
            format!("{short} {} too short a fatigue life.", if short == 1 { "segment has" } else { "segments have" }),
        );
    }
    seeds::say_verdict(view, seed_rows, &mut section);
    if failed > 0 {
        section.say_in(
            Tone::Fail,
            format!("{failed} of {} cases have failed: they have no part in these results.", study.info.cases.len()),
        );
    }
    if missing > 0 {
        section.say_in(Tone::Fail, format!("{missing} of {} cases have not been run.", study.info.cases.len()));
    }
    let overloaded = study.count(CaseStatus::Overloaded);
    if overloaded > 0 {
        section.say_in(Tone::Fail, format!("{overloaded} cases have a tension beyond its break."));
    }
    let accepting = cases::accepts_missing(view);
    if accepting > 0 {
        section.say_in(
            Tone::Unconfirmed,
            format!("{accepting} cases leave out what is missing in their model (-ACCEPT_MISSING): see Caveats and messages."),
        );
    }
    section.say(format!("{} cases, script {}, table {}.", study.info.cases.len(), study.info.model, study.info.table));
    section.blocks
}
