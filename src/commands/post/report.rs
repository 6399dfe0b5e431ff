//! What a report of ROD, TETHER or STRUCTURE declares: its word, the options it alone takes, and the tables it makes.

use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::spec::OptionSpec;
use windlass_base::table::Table;
use windlass_base::values::Args;

/// A report of a command that has several, which one `WHAT` chooses. One is declared in the file that makes its tables, and
/// listed in the `REPORTS` of its command. `Q` is the function that makes its tables of a record.
pub(crate) struct Report<Q: 'static> {
    /// The word that asks for it.
    pub name: &'static str,
    /// One line of help.
    pub help: &'static str,
    /// The options it takes beside those that all reports of its command take.
    pub options: &'static [OptionSpec],
    /// Whether it takes the data behind its word.
    pub takes_data: bool,
    /// Its tables.
    pub tables: Q,
}

impl<Q: Copy> Report<Q> {
    /// A report that takes no data and no options of its own; fill in the rest with `..`.
    pub const fn new(name: &'static str, help: &'static str, tables: Q) -> Self {
        Report { name, help, options: &[], takes_data: false, tables }
    }

    /// The same, with options beside those that all reports of its command take.
    pub const fn with_options(self, options: &'static [OptionSpec]) -> Self {
        Report { options, ..self }
    }

    /// The same, with the data behind its word.
    pub const fn with_data(self) -> Self {
        Report { takes_data: true, ..self }
    }
}

/// Reports are told apart by their words, which are unique among those of a command.
impl<Q> PartialEq for Report<Q> {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

/// More options than a command with reports has.
const MAX_OPTIONS: usize = 32;

/// The words of some reports.
pub(crate) const fn words<Q, const N: usize>(reports: &[&Report<Q>]) -> [&'static str; N] {
    let mut words = [""; N];
    let mut i = 0;
    while i < N {
        words[i] = reports[i].name;
        i += 1;
    }
    words
}

/// Whether an option is among the first `count` of some.
const fn contains(options: &[OptionSpec], count: usize, name: &str) -> bool {
    let mut i = 0;
    while i < count {
        if options[i].is_named(name) {
            return true;
        }
        i += 1;
    }
    false
}

/// The options of a command, each once: those that its reports share, then their own in the order of the reports. The second
/// is how many there are; the rest of the array is not used.
const fn collect_options<Q>(shared: &[OptionSpec], reports: &[&Report<Q>]) -> ([OptionSpec; MAX_OPTIONS], usize) {
    let mut all = [OptionSpec::new("", &[], ""); MAX_OPTIONS];
    let mut count = 0;
    while count < shared.len() {
        all[count] = shared[count];
        count += 1;
    }
    let mut i = 0;
    while i < reports.len() {
        let own = reports[i].options;
        let mut j = 0;
        while j < own.len() {
            if !contains(&all, count, own[j].name) {
                all[count] = own[j];
                count += 1;
            }
            j += 1;
        }
        i += 1;
    }
    (all, count)
}

/// How many options a command has: those that its reports share and their own.
pub(crate) const fn count_options<Q>(shared: &[OptionSpec], reports: &[&Report<Q>]) -> usize {
    collect_options(shared, reports).1
}

/// The options of a command: those that its reports share, then their own in the order of the reports.
pub(crate) const fn options<Q, const N: usize>(shared: &[OptionSpec], reports: &[&Report<Q>]) -> [OptionSpec; N] {
    let (all, _) = collect_options(shared, reports);
    let mut options = [OptionSpec::new("", &[], ""); N];
    let mut i = 0;
    while i < N {
        options[i] = all[i];
        i += 1;
    }
    options
}

/// Refuses an option that belongs to other reports.
///
/// # Errors
/// Such an option, at its place.
pub(crate) fn refuse_options_of_others<Q>(args: &Args, chosen: &Report<Q>, reports: &[&Report<Q>]) -> Outcome<()> {
    let takes = |report: &Report<Q>, name: &str| report.options.iter().any(|option| option.name == name);
    for given in args.options.iter().filter(|given| !takes(chosen, given.option.name)) {
        let name = given.option.name;
        let owners: Vec<&str> = reports.iter().filter(|report| takes(report, name)).map(|report| report.name).collect();
        if !owners.is_empty() {
            let text = format!("{name} goes with {}, not with {}", owners.join(", "), chosen.name);
            return Err(Diagnostic::error(text, given.span));
        }
    }
    Ok(())
}

/// Names and help of some reports, for the help of their command.
pub(crate) fn help_rows<Q>(reports: &[&Report<Q>]) -> Vec<(&'static str, String)> {
    reports.iter().map(|report| (report.name, report.help.to_string())).collect()
}

/// The tables of a record as its report makes them.
pub(crate) type Tables = Outcome<Vec<Table>>;
