//! What a report of ROD, TETHER or STRUCTURE declares: its word, the options it alone takes, and the tables it makes.

use windlass_base::choice::Choice;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::spec::OptionSpec;
use windlass_base::table::Table;
use windlass_base::values::{Args, Value};

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

/// Reports differ by their words, which are unique among those of a command.
impl<Q> PartialEq for Report<Q> {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

/// The reports of a command, by the function that makes their tables. Words, options and help follow from them.
pub(crate) trait ReportRegistry: Sized + 'static {
    /// The reports, in the order of the help.
    const REPORTS: &'static [&'static Report<Self>];
    /// The options that all of them take.
    const SHARED: &'static [OptionSpec];
}

/// More reports than a command has, and more options.
const MAX_ENTRIES: usize = 32;

impl<Q: ReportRegistry> Choice for &'static Report<Q> {
    const WORDS: &'static [&'static str] = Report::<Q>::PADDED_WORDS.split_at(Q::REPORTS.len()).0;
    const ALL: &'static [Self] = Q::REPORTS;

    fn word(self) -> &'static str {
        self.name
    }
}

impl<Q: ReportRegistry> Report<Q> {
    const PADDED_WORDS: &'static [&'static str; MAX_ENTRIES] = &{
        let mut words = [""; MAX_ENTRIES];
        let mut i = 0;
        while i < Q::REPORTS.len() {
            words[i] = Q::REPORTS[i].name;
            i += 1;
        }
        words
    };

    /// The options, each once, and how many they are.
    const PADDED_OPTIONS: &'static ([OptionSpec; MAX_ENTRIES], usize) = &{
        let mut all = [OptionSpec::new("", &[], ""); MAX_ENTRIES];
        let mut count = 0;
        while count < Q::SHARED.len() {
            all[count] = Q::SHARED[count];
            count += 1;
        }
        let mut i = 0;
        while i < Q::REPORTS.len() {
            let own = Q::REPORTS[i].options;
            let mut j = 0;
            while j < own.len() {
                if !contains(&all, own[j].name) {
                    all[count] = own[j];
                    count += 1;
                }
                j += 1;
            }
            i += 1;
        }
        (all, count)
    };

    /// The options of the command: those that all reports take, then their own in the order of the reports.
    pub const OPTIONS: &'static [OptionSpec] = Self::PADDED_OPTIONS.0.split_at(Self::PADDED_OPTIONS.1).0;

    /// Names and help of the reports, for the help of their command.
    pub fn help_rows() -> Vec<(&'static str, String)> {
        Q::REPORTS.iter().map(|report| (report.name, report.help.to_string())).collect()
    }

    /// Refuses options that belong to other reports, and data (`what`) behind the word of a report that takes none.
    ///
    /// # Errors
    /// Such an option or datum, at its place.
    pub fn check_record(&self, args: &Args, surplus: Option<&Value>, what: &str) -> Outcome<()> {
        let takes = |report: &Report<Q>, name: &str| report.options.iter().any(|option| option.name == name);
        for given in args.options.iter().filter(|given| !takes(self, given.option.name)) {
            let name = given.option.name;
            let owners: Vec<&str> =
                Q::REPORTS.iter().filter(|report| takes(report, name)).map(|report| report.name).collect();
            if !owners.is_empty() {
                let text = format!("{name} goes with {}, not with {}", owners.join(", "), self.name);
                return Err(Diagnostic::error(text, given.span));
            }
        }
        match surplus.filter(|_| !self.takes_data) {
            Some(surplus) => Err(Diagnostic::error(format!("{} takes no {what}", self.name), surplus.span)),
            None => Ok(()),
        }
    }
}

/// Whether an option is among some.
const fn contains(options: &[OptionSpec], name: &str) -> bool {
    let mut i = 0;
    while i < options.len() {
        if options[i].is_named(name) {
            return true;
        }
        i += 1;
    }
    false
}

/// The tables of a record as its report makes them.
pub(crate) type Tables = Outcome<Vec<Table>>;
