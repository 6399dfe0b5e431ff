//! `TDOM -TETHERS` that goes on from its file, and that keeps statistics alone: against the run that was not interrupted.

#![allow(clippy::unwrap_used)]

use crate::common;
use windlass::session::Session;
use windlass_signal::tether::global::spread;
use windlass_solve::tethered::Tethered;

/// The two decks as scripts without pages, run for shorter times.
fn script(name: &str, seconds: f64, options: &str) -> String {
    let text = std::fs::read_to_string(format!("scripts/{name}.cif")).unwrap();
    let mut made = String::new();
    for line in text.lines() {
        let trimmed = line.trim_start();
        if trimmed.starts_with("PRCPOST") {
            break;
        }
        if trimmed.starts_with("&STATUS") {
            continue;
        }
        if let Some(rest) = trimmed.strip_prefix("TDOM") {
            made.push_str(&format!("TDOM{rest} {options}\n"));
        } else if let Some((before, behind)) = line.split_once("-TIME ") {
            let mut words = behind.split_whitespace();
            let (_, step) = (words.next().unwrap(), words.next().unwrap());
            made.push_str(&format!("{before}-TIME {seconds} {step}\n"));
        } else {
            made.push_str(&format!("{line}\n"));
        }
    }
    made
}

/// The record of a script that begins with a word, with the lines that it goes on over.
fn record(text: &str, word: &str) -> String {
    let mut lines = text.lines().skip_while(|line| !line.trim_start().starts_with(word));
    let mut made = String::new();
    for line in lines.by_ref() {
        made.push_str(line);
        made.push('\n');
        if !line.trim_end().ends_with('\\') {
            break;
        }
    }
    made
}

/// Runs a script in the folder of answers of a session.
fn run(session: &mut Session, text: &str) {
    session.open("test.cif", text);
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
}

fn bits(run: &Tethered) -> Vec<u64> {
    let mut all = run.times.clone();
    for tether in &run.tethers {
        all.extend(tether.nodes.iter().chain(&tether.ends));
    }
    all.extend(run.structure.iter().flat_map(|structure| structure.rows.iter().copied()));
    all.iter().map(|value| value.to_bits()).collect()
}

/// A run to a time that goes on to a later one has every number of the run to the later time, and what happened on the way.
#[test]
fn restarted_run_matches_uninterrupted_run_bit_for_bit() {
    for (name, first, last) in [("towed_tether", 40.0, 60.0), ("installed_tether", 7.0, 12.0)] {
        let (mut whole, _, _folder) = common::session();
        run(&mut whole, &script(name, last, ""));
        let (mut parts, _, folder) = common::session();
        run(&mut parts, &script(name, first, ""));
        assert!(folder.path().join("job.ans/TETHERS.run").exists());
        let begun = parts.job.tethered.as_ref().unwrap().times.len();
        let again = script(name, last, "-RESTART");
        // the model stands already
        // the model stands already: the environment with its longer time, and the run
        let restart = format!("{}\n{}\n", record(&again, "&ENV"), record(&again, "TDOM"));
        run(&mut parts, &restart);
        let (one, other) = (whole.job.tethered.as_ref().unwrap(), parts.job.tethered.as_ref().unwrap());
        assert!(begun < other.times.len() && one.times == other.times, "{name}");
        assert_eq!(one.happened, other.happened);
        assert!(bits(one) == bits(other), "{name}");
    }
}

#[test]
fn restart_of_another_run_is_refused() {
    let (mut session, _, _folder) = common::session();
    run(&mut session, &script("installed_tether", 2.0, ""));
    session.open("again.cif", "&ENV -TIME 4 0.125\nTDOM -TETHERS AQWA -RESTART\n");
    session.run();
    assert!(session.reports.iter().any(|r| r.message.contains("of another model, environment, step or scheme")));
    let (mut session, _, _folder) = common::session();
    session.open("test.cif", script("installed_tether", 2.0, "-RESTART"));
    session.run();
    assert!(session.errors > 0);
}

/// Means, deviations and extremes of a run without instants are those of the instants, to the rounding of one pass.
#[test]
fn statistics_alone_match_those_of_kept_instants() {
    for name in ["towed_tether", "installed_tether"] {
        let (mut kept, _, _folder) = common::session();
        run(&mut kept, &script(name, 10.0, ""));
        let (mut lean, screen, folder) = common::session();
        run(&mut lean, &script(name, 10.0, "-STATISTICS"));
        assert!(!folder.path().join("job.ans/TETHERS.run").exists());
        let (one, other) = (kept.job.tethered.as_ref().unwrap(), lean.job.tethered.as_ref().unwrap());
        assert!(other.times.is_empty() && other.tethers.iter().all(|t| t.nodes.is_empty() && t.ends.is_empty()));
        assert!(screen.text().contains("S T A T I S T I C S"), "{}", screen.text());
        let mut at = 0;
        let check = |at: usize, series: Vec<f64>| {
            let found = other.running[at].summary().unwrap();
            let (mean, deviation) = spread(&series);
            let size = series.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
            let near = |a: f64, b: f64| (a - b).abs() <= 1e-9 * size;
            assert_eq!(found.count as usize, series.len());
            // the deviation of one pass is that of the squares: half the digits where nothing moves
            assert!(near(found.mean, mean) && (found.deviation - deviation).abs() <= 1e-7 * size, "{name} {at}");
            let most = series.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            assert!(found.maximum.value == most, "{name} {at}");
        };
        if let Some(structure) = &one.structure {
            (0..structure.width()).for_each(|column| check(column, structure.series(column)));
            at += structure.width();
        }
        for tether in &one.tethers {
            let quantities = tether.node_quantities().len();
            for node in 0..tether.line.nodes() {
                (0..quantities).for_each(|q| check(at + node * quantities + q, tether.node(node, q)));
            }
            at += tether.line.nodes() * quantities;
            let each = tether.end_quantities().len();
            for end in 0..2 * tether.line.elements().len() {
                (0..each).for_each(|q| check(at + end * each + q, tether.end(end, q)));
            }
            at += 2 * tether.line.elements().len() * each;
        }
        assert_eq!(at, other.running.len());
        lean.open("post.cif", "PRCPOST\nTETHER T1 EVENTS\nEND\n");
        lean.run();
        assert!(lean.reports.iter().any(|r| r.message.contains("kept statistics alone")));
    }
}
