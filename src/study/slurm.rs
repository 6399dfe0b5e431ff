//! A study as a job array of Slurm: the scripts, and what is said to sbatch. A task of the array is a part of the study; a job that begins when
//! the array has ended, however it ended, makes the tables.

use super::case_process::CaseProgram;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use windlass_study::parts::{PARTS, newest_division};
use windlass_study::runner::StudyPlan;
use windlass_study::store::{Files, SystemFiles};

/// Largest size of an array where Slurm does not say: its default.
const MAX_ARRAY_SIZE: usize = 1001;

/// What the user says to sbatch.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct SlurmOptions {
    /// Words for sbatch.
    words: Vec<String>,
    /// Tasks of the array at a time, `%N`.
    at_a_time: Option<String>,
    /// Cores of a task.
    pub(super) cores: usize,
}

/// The value of an option in one of its forms, where the words from a place on begin with it; and how many words it takes.
fn option_value<'a>(words: &'a [String], long: &str, short: &str) -> Option<(&'a str, usize)> {
    let word = words.first()?;
    if word == long || word == short {
        return Some((words.get(1).map_or("", String::as_str), 2));
    }
    let behind_sign = word.strip_prefix(long).and_then(|rest| rest.strip_prefix('='));
    let joined = || word.strip_prefix(short).filter(|_| !word.starts_with("--"));
    behind_sign.or_else(joined).map(|value| (value, 1))
}

impl SlurmOptions {
    /// Reads words for sbatch.
    ///
    /// # Errors
    /// What the study itself gives to sbatch; a script.
    pub(super) fn new(words: &[String]) -> Result<Self, String> {
        let (mut kept, mut at_a_time, mut cores) = (Vec::new(), None, 1);
        let mut rest = words;
        while let Some(word) = rest.first() {
            let mut taken = 1;
            if let Some((value, words)) = option_value(rest, "--array", "-a") {
                let number = value.strip_prefix('%').filter(|n| n.parse::<u32>().is_ok_and(|n| n > 0));
                let Some(number) = number else {
                    return Err(format!("`{word}`: the study numbers the tasks; --array=%N is how many run at a time"));
                };
                at_a_time = Some(number.to_owned());
                rest = rest.get(words..).unwrap_or_default();
                continue;
            }
            if let Some((value, words)) = option_value(rest, "--cpus-per-task", "-c") {
                cores = value.parse().ok().filter(|n| *n > 0).ok_or_else(|| format!("`{word}`: a number of cores"))?;
                taken = words;
            }
            for (long, short) in [("--dependency", "-d"), ("--wrap", "--wrap")] {
                if option_value(rest, long, short).is_some() {
                    return Err(format!("`{word}`: the study sets {long} itself"));
                }
            }
            if ["--parsable", "--test-only", "--wait", "-W"].contains(&word.as_str()) {
                return Err(format!("`{word}` cannot be given: the study needs the number of its jobs at once"));
            }
            kept.extend(rest.iter().take(taken).cloned());
            rest = rest.get(taken..).unwrap_or_default();
        }
        Ok(SlurmOptions { words: kept, at_a_time, cores })
    }
}

/// Jobs of a start.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Jobs {
    /// Arrays.
    arrays: Vec<String>,
    /// The job that makes the tables; none where sbatch has refused it.
    collecting: Option<String>,
}

impl Jobs {
    /// What is said of them.
    pub(super) fn text(&self) -> String {
        let all = self.all().join(",");
        let arrays = self.arrays.join(", ");
        let collecting = self.collecting.as_deref().unwrap_or_default();
        format!(
            "   job array {arrays}; job {collecting} makes the tables when it is over\n   squeue --jobs={all} shows them; the same command again \
             submits what is then left\n"
        )
    }

    fn all(&self) -> Vec<String> {
        self.arrays.iter().chain(&self.collecting).cloned().collect()
    }
}

/// A word as a shell takes it for itself.
fn quoted(word: &str) -> String {
    format!("'{}'", word.replace('\'', "'\\''"))
}

/// The file name of a log as sbatch takes it: a sign of per cent stands for itself.
fn log_pattern(path: &Path) -> String {
    path.display().to_string().replace('%', "%%")
}

fn jobs_file(folder: &Path, start: u64) -> PathBuf {
    folder.join(PARTS).join(format!("{start}.jobs"))
}

/// The jobs of the newest division of a study that are not over, as squeue has them; none where there is no squeue.
pub(super) fn find_running(folder: &Path) -> Option<String> {
    let start = newest_division(folder).ok()??;
    let jobs: Jobs = serde_json::from_slice(&std::fs::read(jobs_file(folder, start)).ok()?).ok()?;
    let list = format!("--jobs={}", jobs.all().join(","));
    let asked = Command::new("squeue").args(["--noheader", "--format=%F", &list]).stdin(Stdio::null()).output().ok()?;
    let text = String::from_utf8_lossy(&asked.stdout).into_owned();
    text.lines().map(str::trim).find(|line| jobs.all().iter().any(|job| job == line)).map(str::to_owned)
}

/// Most tasks of an array: one less than MaxArraySize, which bounds the numbers from 0.
fn most_tasks() -> usize {
    let asked = Command::new("scontrol").args(["show", "config"]).stdin(Stdio::null()).output();
    let text = asked.map(|asked| String::from_utf8_lossy(&asked.stdout).into_owned()).unwrap_or_default();
    let size =
        text.lines().find_map(|line| line.strip_prefix("MaxArraySize")?.trim().strip_prefix('=')?.trim().parse().ok());
    size.unwrap_or(MAX_ARRAY_SIZE).saturating_sub(1).max(1)
}

/// Runs sbatch; the number of the job.
fn sbatch(words: &[String]) -> Result<String, String> {
    let asked = Command::new("sbatch").args(words).stdin(Stdio::null()).output();
    let asked = asked.map_err(|error| format!("sbatch cannot be started: {error}"))?;
    let said = String::from_utf8_lossy(&asked.stdout).into_owned();
    // with --parsable: number, or number;cluster
    let job = said.lines().last().and_then(|line| line.split(';').next()).map(str::trim).unwrap_or_default();
    if !asked.status.success() || job.is_empty() || !job.bytes().all(|byte| byte.is_ascii_digit()) {
        let wrong = String::from_utf8_lossy(&asked.stderr);
        let wrong = wrong.lines().map(str::trim).filter(|line| !line.is_empty()).collect::<Vec<_>>().join("; ");
        return Err(format!("sbatch {}: {wrong}", words.join(" ")));
    }
    Ok(job.to_owned())
}

/// Writes the scripts of a start that is divided into so many parts, and submits them.
pub(super) fn submit(
    plan: &StudyPlan,
    (start, parts): (u64, usize),
    options: &SlurmOptions,
    program: Option<&CaseProgram>,
) -> Result<Jobs, String> {
    let wrong = |path: &Path| {
        let path = path.display().to_string();
        move |error: std::io::Error| format!("{path}: {error}")
    };
    let folder = std::path::absolute(&plan.folder).map_err(wrong(&plan.folder))?;
    let program = program.map_or_else(CaseProgram::of_this_process, |program| Ok(program.clone()));
    let program = program.map_err(|error| format!("no process can be started: {error}"))?;
    let words = std::iter::once(program.file.display().to_string()).chain(program.arguments);
    let command = words.map(|word| quoted(&word)).collect::<Vec<_>>().join(" ");
    let study = quoted(&folder.display().to_string());
    let place = folder.join(PARTS);
    let [array, collecting] = ["array", "collect"].map(|kind| place.join(format!("{start}-{kind}.sh")));
    let head = format!("#!/bin/bash\n# Written by windlass study --slurm.\ncd {} || exit 1\n", quoted(&plan.begun_in));
    let cores = "\"${SLURM_CPUS_PER_TASK:-1}\"";
    // the first number of the array is behind those of the arrays before it
    let task = "\"$((SLURM_ARRAY_TASK_ID + ${1:-0}))\"";
    let array_text = format!("{head}exec {command} study part {study} {task} --start {start} --jobs {cores}\n");
    let collecting_text = format!("{head}exec {command} study collect {study} --jobs {cores}\n");
    for (path, text) in [(&array, array_text), (&collecting, collecting_text)] {
        SystemFiles.write(path, text.as_bytes()).map_err(wrong(path))?;
    }
    let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let common = |log: &str| {
        let mut words: Vec<String> =
            ["--parsable", "--open-mode=append", "--cpus-per-task=1"].map(str::to_owned).into();
        words.push(format!("--job-name=windlass-{name}"));
        words.push(format!("--output={}", log_pattern(&place.join(format!("{start}-{log}.log")))));
        words
    };
    let throttle = options.at_a_time.as_ref().map_or_else(String::new, |number| format!("%{number}"));
    let mut jobs = Jobs { arrays: Vec::new(), collecting: None };
    let submitted = submit_jobs(&mut jobs, parts, &|jobs, tasks| {
        let mut words = common(if tasks.is_some() { "array" } else { "collect" });
        match tasks {
            Some((_, count)) => words.push(format!("--array=1-{count}{throttle}")),
            None => words.push(format!("--dependency=afterany:{}", jobs.arrays.join(":"))),
        }
        words.extend(options.words.iter().cloned());
        let script = if tasks.is_some() { &array } else { &collecting };
        words.push(script.display().to_string());
        words.extend(tasks.map(|(before, _)| before.to_string()));
        sbatch(&words)
    });
    // what is submitted is known even where the rest was refused
    if !jobs.arrays.is_empty() {
        let path = jobs_file(&folder, start);
        let text = serde_json::to_vec(&jobs).map_err(|error| error.to_string())?;
        SystemFiles.write(&path, &text).map_err(wrong(&path))?;
    }
    match submitted {
        Ok(()) => Ok(jobs),
        Err(error) if jobs.arrays.is_empty() => Err(error),
        Err(error) => Err(format!("{error}; submitted before: scancel {}", jobs.arrays.join(" "))),
    }
}

/// Says to Slurm, of a job behind those before it, how it is submitted: the tasks before it and its own, or `None` of the job that collects.
type Submit<'a> = &'a dyn Fn(&Jobs, Option<(usize, usize)>) -> Result<String, String>;

/// Submits as many arrays as the parts need, and the job that collects.
fn submit_jobs(jobs: &mut Jobs, parts: usize, submit: Submit) -> Result<(), String> {
    let most = most_tasks();
    for before in (0..parts).step_by(most) {
        let array = submit(jobs, Some((before, most.min(parts - before))))?;
        jobs.arrays.push(array);
    }
    jobs.collecting = Some(submit(jobs, None)?);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn options(text: &str) -> Result<SlurmOptions, String> {
        SlurmOptions::new(&text.split_whitespace().map(str::to_owned).collect::<Vec<_>>())
    }

    #[test]
    fn options_of_sbatch_go_on_but_for_what_the_study_sets() {
        let found = options("-p long --time=2:00:00 --array=%4 -c 8 --mem 4G").unwrap();
        assert_eq!(found.words.join(" "), "-p long --time=2:00:00 -c 8 --mem 4G");
        assert_eq!((found.at_a_time.as_deref(), found.cores), (Some("4"), 8));
        for text in ["-c8", "--cpus-per-task=8", "--cpus-per-task 8"] {
            assert_eq!(options(text).unwrap().cores, 8, "{text}");
        }
        assert_eq!(options("").unwrap(), SlurmOptions { words: Vec::new(), at_a_time: None, cores: 1 });
        for text in ["--array=1-5", "-a 1-5", "-c none", "--cpus-per-task=0", "-d afterok:1", "--wrap=x", "--wait"] {
            assert!(options(text).is_err(), "{text}");
        }
        // a directory and a name that begin as short options do
        assert_eq!(options("--chdir=/a --account=b").unwrap().words.len(), 2);
    }

    #[test]
    fn words_are_quoted_for_the_shell() {
        assert_eq!(quoted("it's %A"), "'it'\\''s %A'");
        assert_eq!(log_pattern(Path::new("/a/50%/log")), "/a/50%%/log");
    }
}
