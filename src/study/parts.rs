//! A study in parts: how it is divided, a part of it, and what is made when all are over.

use super::case_process::{CaseProgram, Processes};
use super::slurm::{self, SlurmOptions};
use super::{StudyArgs, StudyExit, counted, earlier_cases, print, refused, report_end, summary};
use super::{threads_of_each, with_bar};
use std::io::Write;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use windlass_study::packing::{expected_seconds, pack, parts_of, sample};
use windlass_study::parts::{self, Division, Part, divide, newest_division};
use windlass_study::record::CaseStatus;
use windlass_study::runner::{BegunStudy, Keep, StudyEnd, StudyPlan, begin_study};
use windlass_study::store::{Study, StudyError, SystemFiles};

/// Minutes that a task of an array is to take.
const PACK_MINUTES: f64 = 30.0;
/// Cases that are measured first.
const SAMPLE: u16 = 8;

/// Divides what is left of a study into parts, and submits them where Slurm is asked for.
pub(super) fn distribute(
    args: &StudyArgs,
    plan: &StudyPlan,
    options: Option<&SlurmOptions>,
    processes: &Processes,
    stop: &AtomicBool,
    out: &mut impl Write,
    complain: &dyn Fn(&str),
) -> StudyExit {
    let mut begun = match begin_study(plan, &SystemFiles, processes) {
        Ok(begun) => begun,
        Err(error) => return refused(&error, complain),
    };
    let seconds = match (measure(args, plan, &mut begun, processes, stop), stop.load(Ordering::Relaxed)) {
        (Err(error), _) => return refused(&error, complain),
        (Ok(seconds), is_stopped) if is_stopped || begun.pending.is_empty() => {
            drop(seconds);
            return match finish(&plan.folder, plan.keep, plan.jobs, processes, stop) {
                Ok(study) => report_end(&study, &begun.end, &plan.folder, out),
                Err(error) => {
                    complain(&error);
                    StudyExit::Failed
                }
            };
        }
        (Ok(seconds), _) => seconds,
    };
    let is_measured = seconds.is_some();
    let of_cases = seconds.unwrap_or_else(|| vec![1.0; begun.pending.len()]);
    let groups = begun.groups();
    let of_group = |group: &Vec<usize>| group.iter().filter_map(|place| of_cases.get(*place)).sum::<f64>();
    let seconds: Vec<f64> = groups.iter().map(of_group).collect();
    let cores = options.map_or(1, |options| options.cores);
    let wanted = 60.0 * args.pack.unwrap_or(PACK_MINUTES) * cores as f64;
    let parts = args.parts.map_or_else(|| parts_of(&seconds, wanted), |parts| parts as usize);
    let packed = pack(&seconds, parts);
    // transient cases stand behind all others, so that places in ascending order have intact ones before what follows them
    let places = |part: &Vec<usize>| {
        let mut places: Vec<usize> = part.iter().filter_map(|group| groups.get(*group)).flatten().copied().collect();
        places.sort_unstable();
        places
    };
    let places: Vec<Vec<usize>> = packed.iter().map(places).collect();
    if let Err(error) = divide(plan, &begun, &places, &SystemFiles) {
        return refused(&error, complain);
    }
    let sample = begun.end.progress;
    let mut text = format!("{}: ", counted(plan.table.cases.len(), "case"));
    if sample.finished > 0 {
        text.push_str(&format!("{} were run here to measure them, {} failed; ", sample.finished, sample.failed));
    }
    text.push_str(&format!("{} in {}", counted(begun.pending.len(), "case"), counted(parts, "part")));
    if is_measured {
        let longest = packed.iter().map(|part| part.iter().filter_map(|at| seconds.get(*at)).sum::<f64>());
        let longest = longest.fold(0.0, f64::max) / cores as f64;
        text.push_str(&format!(" of {:.1} minutes or less", longest / 60.0));
    }
    text.push('\n');
    text.push_str(&earlier_cases(&begun.end));
    let exit = match options {
        None => {
            let folder = plan.folder.display();
            text.push_str(&format!("   windlass study part {folder} N    runs one of them, N from 1 to {parts}\n"));
            text.push_str(&format!("   windlass study collect {folder}    makes the tables when they are over\n"));
            StudyExit::Done
        }
        Some(options) => match slurm::submit(plan, (begun.start, parts), options, args.program.as_ref()) {
            Ok(jobs) => {
                text.push_str(&jobs.text());
                StudyExit::Done
            }
            Err(error) => {
                complain(&error);
                StudyExit::Failed
            }
        },
    };
    print(out, &text);
    exit
}

/// Expected seconds of the pending cases; a sample of them is run here where Slurm is to have parts of some minutes and none is measured.
fn measure(
    args: &StudyArgs,
    plan: &StudyPlan,
    begun: &mut BegunStudy,
    processes: &Processes,
    stop: &AtomicBool,
) -> Result<Option<Vec<f64>>, StudyError> {
    let expected = |begun: &BegunStudy| expected_seconds(&begun.pending, &plan.table.columns, &begun.records);
    if let Some(seconds) = expected(begun) {
        return Ok(Some(seconds));
    }
    if args.parts.is_some() {
        return Ok(None);
    }
    let places = sample(begun.pending.len(), args.sample.unwrap_or(SAMPLE).into());
    let ran = with_bar(&mut |report| begun.run_sample(&places, plan, &SystemFiles, processes, stop, report));
    ran.map(|()| expected(begun))
}

/// Drops answers that are not kept, makes those of governing cases that no part has kept, and writes the tables.
pub(super) fn finish(
    folder: &Path,
    keep: Keep,
    jobs: usize,
    processes: &Processes,
    stop: &AtomicBool,
) -> Result<Study, String> {
    let scratch = scratch()?;
    let study = parts::collect(folder, keep, (jobs, scratch.path()), &SystemFiles, processes, stop);
    let study = study.map_err(|error| error.to_string())?;
    super::tables::write(&study, folder, &SystemFiles).map_err(|e| format!("{}: {e}", folder.display()))?;
    Ok(study)
}

/// The division of a start, the newest where none is named.
fn division_start(folder: &Path, start: Option<u64>) -> Result<u64, StudyError> {
    if let Some(start) = start {
        return Ok(start);
    }
    newest_division(folder)?.ok_or_else(|| StudyError::Folder {
        path: folder.to_path_buf(),
        message: "it is not divided into parts: windlass study --slurm or --parts does so".into(),
    })
}

fn processes_of(division: &Division, jobs: usize, program: Option<&CaseProgram>) -> Result<Processes, String> {
    let made = Processes::new(Path::new(&division.model), threads_of_each(jobs), program);
    let made = made.map_err(|error| format!("no process can be started: {error}"))?;
    Ok(made.begun_in(&division.begun_in))
}

/// A folder of this process alone for the answers of running cases, where temporary files go.
fn scratch() -> Result<tempfile::TempDir, String> {
    let place = std::path::absolute(std::env::temp_dir()).unwrap_or_else(|_| std::env::temp_dir());
    let made = tempfile::Builder::new().prefix("windlass-study-").tempdir_in(&place);
    made.map_err(|error| format!("{}: {error}", place.display()))
}

/// Runs a part of a study.
pub(super) fn run_part(
    (folder, number, start): (&Path, usize, Option<u64>),
    jobs: usize,
    program: Option<&CaseProgram>,
    stop: &AtomicBool,
    out: &mut impl Write,
    complain: &dyn Fn(&str),
) -> StudyExit {
    let part = match division_start(folder, start).and_then(|start| Part::open(folder, start, number)) {
        Ok(part) => part,
        Err(error) => return refused(&error, complain),
    };
    if part.division.version != env!("CARGO_PKG_VERSION") {
        let version = &part.division.version;
        complain(&format!("{}: it was divided by version {version} of windlass: begin it again", folder.display()));
        return StudyExit::Usage;
    }
    let ready = processes_of(&part.division, jobs, program).and_then(|processes| Ok((processes, scratch()?)));
    let (processes, scratch) = match ready {
        Ok(ready) => ready,
        Err(error) => {
            complain(&error);
            return StudyExit::Failed;
        }
    };
    let ended = with_bar(&mut |report| part.run((jobs, scratch.path()), &SystemFiles, &processes, stop, report));
    let ended = match ended {
        Ok(ended) => ended,
        Err(error) => return refused(&error, complain),
    };
    let progress = ended.progress;
    let mut text = format!("part {number}: {}, {} failed", counted(progress.finished, "case"), progress.failed);
    if ended.kept > 0 {
        text.push_str(&format!(", {} done before", ended.kept));
    }
    print(out, &format!("{text}\n"));
    if progress.finished < progress.total {
        StudyExit::Interrupted
    } else if progress.failed > 0 {
        StudyExit::Failed
    } else {
        StudyExit::Done
    }
}

/// Makes the tables of a study as it stands, and the answers of its governing cases.
pub(super) fn collect(
    folder: &Path,
    jobs: usize,
    program: Option<&CaseProgram>,
    stop: &AtomicBool,
    out: &mut impl Write,
    complain: &dyn Fn(&str),
) -> StudyExit {
    let division = division_start(folder, None).and_then(|start| Division::open(folder, start));
    let division = match division {
        Ok(division) => division,
        Err(error) => return refused(&error, complain),
    };
    let made = processes_of(&division, jobs, program)
        .and_then(|processes| finish(folder, division.keep, jobs, &processes, stop));
    match made {
        Ok(study) => {
            let left = study.info.cases.len().saturating_sub(study.records.len());
            print(out, &summary(&study, (left, &StudyEnd::default()), folder));
            if left > 0 || study.count(CaseStatus::Failed) > 0 { StudyExit::Failed } else { StudyExit::Done }
        }
        Err(error) => {
            complain(&error);
            StudyExit::Failed
        }
    }
}
