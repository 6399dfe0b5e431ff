//! The run of a case whose answers are kept, opened again: pictures, histories, tables of the model.

use super::lines::{Governing, Replayed};
use crate::commands::{KeptTable, file_of_run, find_stored};
use crate::report::files::JobFolder;
use crate::report::output::Output;
use crate::report::picture::{Picture, USUAL_WIDTH, View};
use crate::report::plot::{Chart, PlotError, PlotSeries, PlotSize};
use crate::session::Session;
use std::path::{Path, PathBuf};
use windlass_base::diagnostic::Severity;
use windlass_base::units::{Dim, UnitSystem};
use windlass_solve::results::{self, EventWindow};
use windlass_solve::scene::{Scene, SceneOptions};
use windlass_solve::screening::screen;
use windlass_solve::time::Run;
use windlass_study::store::{INFO, KEPT_CASES, StudyInfo};

/// Time that a history shows on either side of the peak (s).
const HISTORY_SIDE_S: f64 = 150.0;
/// By how much the largest tension of a kept run may differ from that of its record, of itself.
const SAME_TENSION: f64 = 1e-6;

/// The script of the study that a folder of answers is a case of; `None` of another folder.
pub fn script_of_case(folder: &Path) -> Option<PathBuf> {
    let folder = std::path::absolute(folder).ok()?;
    let study = folder.parent()?.parent()?;
    // an instant of a transient case lies a folder deeper
    script_of_study(study).or_else(|| script_of_study(study.parent()?))
}

fn script_of_study(study: &Path) -> Option<PathBuf> {
    let text = std::fs::read_to_string(study.join(INFO)).ok()?;
    let info: StudyInfo = serde_json::from_str(&text).ok()?;
    info.find_script(study)
}

/// A run that is open again.
pub struct KeptRun {
    session: Session,
}

impl KeptRun {
    /// Whether the study keeps a run of a case.
    pub fn is_kept(study: &Path, case: &str) -> bool {
        file_of_run(&study.join(KEPT_CASES).join(case)).is_some()
    }

    /// Opens the run of a case.
    ///
    /// # Errors
    /// A run that cannot be read, or whose records do not make its model again.
    pub fn open(study: &Path, case: &str) -> Result<KeptRun, String> {
        Self::open_folder(study, study.join(KEPT_CASES).join(case))
    }

    /// Opens the run of an instant of a transient case, by its number; that of another case is the case's own.
    ///
    /// # Errors
    /// As [`KeptRun::open`].
    pub fn open_instant(study: &Path, case: &str, instant: Option<usize>) -> Result<KeptRun, String> {
        let folder = study.join(KEPT_CASES).join(case);
        let own = instant.map(|number| folder.join(format!("instant-{number}")));
        Self::open_folder(study, own.filter(|own| own.is_dir()).unwrap_or(folder))
    }

    fn open_folder(study: &Path, folder: PathBuf) -> Result<KeptRun, String> {
        let (kept, records) = find_stored(&folder).map_err(|error| error.to_string())?;
        let root = script_of_study(study).map_or_else(|| folder.clone(), |script| script.with_extension(""));
        let job = JobFolder::new(root, Some(folder), false);
        let mut session = Session::new(Output::new(job, Box::new(std::io::sink()), Box::new(std::io::sink()), false));
        session.keep_reports = true;
        session.job.output.keep_log = false;
        if session.open_stored(kept, &records) {
            return Ok(KeptRun { session });
        }
        let wrong = |severity| matches!(severity, Severity::Error | Severity::Fatal);
        let first = session.reports.iter().find(|said| wrong(said.severity)).map(|said| said.message.clone());
        Err(first.unwrap_or_else(|| "its records do not make its model again".into()))
    }

    /// The user's units.
    fn units(&self) -> UnitSystem {
        self.session.job.units
    }

    fn run(&self) -> Result<&Run, String> {
        self.session.job.run.as_ref().ok_or_else(|| "its run is not there".to_owned())
    }

    /// The tables that records show; nothing of one that is refused.
    pub fn tables(&mut self, records: &[&str]) -> Vec<KeptTable> {
        self.session.job.kept_tables = Some(Vec::new());
        self.session.open("the report", records.join("\n") + "\n");
        self.session.run();
        self.session.job.kept_tables.take().unwrap_or_default()
    }

    /// The model as it was at an instant of the run (s), in plan and elevation.
    ///
    /// # Errors
    /// A model that cannot be drawn.
    pub fn picture(&mut self, time: f64, title: &str) -> Result<Vec<u8>, PlotError> {
        self.session.open("the report", format!("&INSTATE -EVENT {time}\n"));
        self.session.run();
        let choice = SceneOptions { connector: &|_| true, body: &|_| true, stop: &|| false };
        let (scene, _) = Scene::build(&self.session.job.model, &choice).ok_or(PlotError::Empty)?;
        let views = vec![View::plan(), View::elevation(-std::f64::consts::FRAC_PI_2, 1.0)];
        let units = self.units();
        let title = title.to_owned();
        let picture =
            Picture { title, scene, views, names: true, units, tensions: true, north: None, width: USUAL_WIDTH };
        picture.file("model.svg").map(|(bytes, _)| bytes)
    }

    /// When the tension of a line is largest behind the transient (s), and that tension at its first end (N).
    ///
    /// # Errors
    /// A line that the run does not have, a run without instants behind its transient.
    pub fn peak(&self, line: &str) -> Result<(f64, f64), String> {
        let run = self.run()?;
        let layout = &run.history.layout;
        let link = layout.links.iter().position(|link| link.name.eq_ignore_ascii_case(line));
        let link = link.ok_or_else(|| format!("its run has no line {line}"))?;
        let start = run.statistics_start();
        let tension = |row: &[f64]| Some((row.first().copied()?, layout.tension(link, row)?));
        let behind = run.history.rows().filter_map(tension).filter(|(time, _)| *time >= start - 1e-9 * start.abs());
        let most = behind.reduce(|a, b| if b.1 > a.1 { b } else { a });
        most.ok_or_else(|| format!("its run keeps no tension of {line} behind the transient"))
    }

    /// The tension of a segment around its peak, with what is checked and what the code allows.
    ///
    /// # Errors
    /// A run that is not that of the record, a line that it does not have.
    pub fn history(&self, found: &Governing) -> Result<Result<Vec<u8>, PlotError>, String> {
        let (run, row) = (self.run()?, found.row);
        let (time, _) = self.peak(&row.line)?;
        let link = run.history.layout.links.iter().position(|link| link.name.eq_ignore_ascii_case(&row.line));
        let link = link.ok_or_else(|| format!("its run has no line {}", row.line))?;
        let begin = (time - HISTORY_SIDE_S).max(run.statistics_start());
        let window = EventWindow { begin, end: Some(time + HISTORY_SIDE_S), increment: None };
        let events = results::events(&run.history, Some(&window)).map_err(|e| e.text(self.units()))?;
        let records = results::line_records(run, &[link], &events).map_err(|e| e.error.text(self.units()))?;
        let record = records.first().ok_or_else(|| format!("{} is no line of segments", row.line))?;
        let tensions = record.tensions.get(row.segment.map_or(0, |n| n.saturating_sub(1)));
        let tensions = tensions.ok_or_else(|| format!("its run has no segment {}", row.label()))?;
        let most = tensions.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if let Some(recorded) =
            row.largest_tension.filter(|t| row.segment == Some(1) && (most - t).abs() > SAME_TENSION * t.abs())
        {
            return Err(format!(
                "its kept run has the largest tension {most} N, and its record {recorded} N: the study is to be run again"
            ));
        }
        let units = self.units();
        let force = |value: f64| Dim::Force.from_si(value, units);
        let points = record.times.iter().zip(tensions).map(|(t, f)| Some((*t, force(*f)))).collect();
        let mut series = vec![PlotSeries { name: format!("tension of {}", row.label()), points, right: false }];
        let mut level = |name: String, value: Option<f64>| {
            if let Some(value) = value {
                let points = record.times.iter().map(|t| Some((*t, force(value)))).collect();
                series.push(PlotSeries { name, points, right: false });
            }
        };
        level("characteristic tension".into(), row.max_tension);
        let allowed = row.breaking_load.zip(row.required_safety_factor).map(|(load, factor)| load / factor);
        level(row.required_safety_factor.map_or_else(String::new, |f| format!("strength / {f}")), allowed);
        Ok(Chart {
            title: String::new(),
            x_label: "time (s)".into(),
            y_label: format!("tension ({})", Dim::Force.label(units)),
            series,
            size: PlotSize { width: 900, height: 300 },
            ..Chart::default()
        }
        .svg())
    }

    /// The most loaded quasi-static lines of the run, replayed as dynamic lines.
    pub fn replay(&self, case: &str) -> Vec<Replayed> {
        let Ok(run) = self.run() else { return Vec::new() };
        let made = screen(run, &|| true);
        let of = |replay: &windlass_solve::screening::Replay| Replayed {
            case: case.to_owned(),
            line: replay.line.clone(),
            quasi_static: replay.quasi_static,
            dynamic: replay.dynamic.0,
        };
        made.replays.iter().map(of).collect()
    }
}
