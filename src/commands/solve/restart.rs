//! TDOM -RESTART: a run that is kept in a file goes on.

use crate::commands::Job;
use crate::commands::solve::equilibrium::to_diagnostic;
use crate::commands::solve::tdom::FILE;
use crate::report::run_log::{self, RunLog};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::values::Given;
use windlass_solve::time::Run;

/// Takes a run that begins to where the one in the file was, by the option that says so of the record at `span`; the file, to go on with.
pub(crate) fn resume(job: &mut Job, made: &mut Run, again: &Given, span: Span) -> Outcome<RunLog> {
    let refused = |text: String| Diagnostic::error(text, again.span).help("TDOM without -RESTART begins a run");
    let folder = &mut job.output.folder;
    let path = folder.folder.join(FILE);
    let mut file = folder.reopen(FILE).map_err(|e| refused(e.to_string()))?;
    let kept = run_log::read(&mut file, again.first_number().unwrap_or(f64::INFINITY));
    let kept = kept.map_err(|e| refused(format!("{}: {e}", path.display())))?;
    let balance = made.settings.balance;
    if kept.fingerprint != made.fingerprint() && kept.fingerprint == made.fingerprint_with(!balance) {
        let [before, now] = if balance { ["without", "with"] } else { ["with", "without"] };
        return Err(refused(format!(
            "the run kept in {} was begun {before} -BALANCE, and goes on {now}",
            path.display()
        ))
        .help("-BALANCE must be as it was: the balance is kept with the lines"));
    }
    if kept.fingerprint != made.fingerprint() || kept.width != made.history.layout.width {
        let text = format!("the run kept in {} is of another model, environment, step or scheme", path.display());
        return Err(refused(text).help(
            "all must be as they were, -ALONG too, but for the time observed; a winch without a LENGTH has room for as much as it winds in that time",
        ));
    }
    let log = RunLog::resume(file, path, &kept).map_err(|e| refused(e.to_string()))?;
    made.resume_from(&kept.snapshot, kept.rows).map_err(|e| to_diagnostic(e, &job.model, span, job.units))?;
    job.remark(format!("goes on from {} s", kept.snapshot.time), again.span);
    Ok(log)
}
