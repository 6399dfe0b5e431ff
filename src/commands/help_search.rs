//! `&HELP WORD` where the word names nothing: all that says it, names first.

use crate::commands::help::wrap;
use crate::commands::report_columns::report_columns;
use crate::commands::{COMMANDS, FUNCTION_HELP, Job, absent, status};
use windlass_base::units::{Dim, UnitSystem};
use windlass_connectors::class_specs;
use windlass_hydro::gusts::GUST_SPECTRA;
use windlass_hydro::sea::spectra::SPECTRA;
use windlass_language::flow::specs::CONTROL;
use windlass_language::functions;
use windlass_language::spec::{CommandSpec, OptionSpec};

/// Most places that are listed.
const MAX_HITS: usize = 40;

/// A place that says the word.
struct Hit {
    /// 0: its name is the word; 1: its name holds it; 2: its line of help does; 3: the rest of its help does.
    rank: u8,
    /// How to ask for its help.
    name: String,
    help: String,
}

/// What was looked for, in capitals.
struct Search {
    word: String,
    hits: Vec<Hit>,
}

impl Search {
    fn holds(&self, text: &str) -> bool {
        text.to_ascii_uppercase().contains(&self.word)
    }

    /// Takes a place in, where it says the word.
    fn look_at(&mut self, key: &str, name: String, help: &str, more: &[&str]) {
        let bare = key.trim_start_matches(['&', '-', '~', '*', ':']);
        let rank = match () {
            () if bare.eq_ignore_ascii_case(&self.word) || key.eq_ignore_ascii_case(&self.word) => 0,
            () if self.holds(key) => 1,
            () if self.holds(help) => 2,
            () if more.iter().any(|text| self.holds(text)) => 3,
            () => return,
        };
        self.hits.push(Hit { rank, name, help: help.to_string() });
    }

    fn look_at_spec(&mut self, spec: &CommandSpec, lead: &str) {
        let values: Vec<&str> = spec.data.iter().flat_map(|value| [value.name, value.help]).collect();
        let more: Vec<&str> = values.into_iter().chain([spec.detail]).collect();
        self.look_at(spec.name, format!("{lead}{}", spec.name), spec.help, &more);
        for option in spec.options {
            self.look_at_option(option, &format!("{lead}{}", spec.name));
        }
    }

    fn look_at_option(&mut self, option: &OptionSpec, of: &str) {
        let more: Vec<&str> = option
            .values
            .iter()
            .flat_map(|value| [value.name, value.help])
            .chain(option.aliases.iter().copied())
            .collect();
        self.look_at(option.name, format!("{of} {}", option.name), option.help, &more);
    }
}

/// Every place of the help that says a word, best first; `None` where none does.
pub(super) fn search(job: &Job, word: &str, width: usize) -> Option<String> {
    let mut search = Search { word: word.to_ascii_uppercase(), hits: Vec::new() };
    for spec in COMMANDS.iter().map(|command| command.spec).chain(CONTROL) {
        search.look_at_spec(spec, "");
    }
    for spec in class_specs() {
        search.look_at_spec(spec, "~CLASS ");
    }
    for (name, form, meaning) in functions::FUNCTION_HELP.iter().chain(FUNCTION_HELP) {
        search.look_at(name, (*name).to_string(), meaning, &[form]);
    }
    for (name, help, _) in status::rows() {
        search.look_at(name, format!("&STATUS {name}"), &help, &[]);
    }
    for spectrum in SPECTRA {
        let more: Vec<&str> = spectrum.parameters.iter().map(|parameter| parameter.help).collect();
        search.look_at(spectrum.name, format!("&ENV -SEA {}", spectrum.name), spectrum.help, &more);
    }
    for spectrum in GUST_SPECTRA {
        search.look_at(spectrum.name, format!("&ENV -W_SPECTRUM {}", spectrum.name), spectrum.help, &[]);
    }
    for (dim, what) in UNITS {
        let label = dim.label(job.units);
        search.look_at(
            &label,
            "UNITS".to_string(),
            &format!("{what}: {}", if label.is_empty() { "none" } else { &label }),
            &[],
        );
    }
    for (name, unit, meaning, reports) in explained_columns(job.units) {
        let unit = if unit.is_empty() { unit } else { format!(" ({unit})") };
        let help = format!("column of {}: {meaning}{unit}", reports.join("; "));
        search.look_at(name, format!("'{name}'"), &help, &[]);
    }
    for entry in absent::ABSENT {
        search.look_at(entry.name, entry.name.to_string(), &entry.sentence(), &[entry.instead]);
    }
    let Search { mut hits, .. } = search;
    if hits.is_empty() {
        return None;
    }
    hits.sort_by_key(|hit| hit.rank);
    let found = hits.len();
    let mut lines = vec![format!(
        "{found} {} of the help {} `{word}`:",
        if found == 1 { "place" } else { "places" },
        if found == 1 { "says" } else { "say" }
    )];
    for hit in hits.iter().take(MAX_HITS) {
        let room = width.saturating_sub(32).max(20);
        let mut text = wrap(&hit.help, room).into_iter();
        lines.push(format!("   {:<28} {}", hit.name, text.next().unwrap_or_default()));
        lines.extend(text.map(|line| format!("   {:<28} {line}", "")));
    }
    if found > MAX_HITS {
        lines.push(format!("   .. and {} more; a longer word finds fewer", found - MAX_HITS));
    }
    lines.push("&HELP NAME explains one, &HELP NAME -OPTION an option alone.".into());
    Some(lines.join("\n"))
}

/// A column of reports: its name, its unit, what it is, and what prints it.
type ExplainedColumn = (&'static str, String, &'static str, Vec<&'static str>);

/// The columns of reports; one that several reports have alike stands once.
fn explained_columns(units: UnitSystem) -> Vec<ExplainedColumn> {
    let mut made: Vec<ExplainedColumn> = Vec::new();
    for report in report_columns() {
        for column in report.columns.iter().filter(|column| !matches!(column.name(), "" | "@")) {
            let (name, unit) = (column.name(), column.unit(units));
            let same = |known: &&mut ExplainedColumn| (known.0, &known.1, known.2) == (name, &unit, column.meaning);
            match made.iter_mut().find(same) {
                Some(known) if known.3.contains(&report.printed_by) => {}
                Some(known) => known.3.push(report.printed_by),
                None => made.push((name, unit, column.meaning, vec![report.printed_by])),
            }
        }
    }
    made
}

/// Quantities that records and reports have, for `&HELP UNITS`.
static UNITS: &[(Dim, &str)] = &[
    (Dim::Length, "lengths, depths, places"),
    (Dim::Section, "diameters, wall thicknesses and other sizes of sections"),
    (Dim::SectionArea, "areas of sections"),
    (Dim::Area, "areas of bodies"),
    (Dim::Volume, "volumes"),
    (Dim::Force, "forces, tensions, weights of bodies"),
    (Dim::ForcePerLength, "weights per length, stiffnesses"),
    (Dim::Moment, "moments, energies"),
    (Dim::MomentPerRadian, "rotational stiffnesses"),
    (Dim::Stress, "stresses and moduli (-EMODULUS)"),
    (Dim::Density, "densities"),
    (Dim::Angle, "angles, directions"),
    (Dim::Time, "times, periods"),
    (Dim::Velocity, "velocities, currents"),
    (Dim::WindSpeed, "speeds of wind, unless a record names another unit"),
    (Dim::Acceleration, "accelerations"),
    (Dim::Frequency, "frequencies"),
    (Dim::SpectralDensity, "spectral densities of elevation"),
];

/// The help of units: those in force.
pub(super) fn units(units: UnitSystem) -> String {
    let mut lines = vec![
        format!("Units of records and reports: {units}. &DIMEN changes them; files are written in them too."),
        String::new(),
    ];
    lines.extend(UNITS.iter().map(|(dim, what)| format!("   {:<16} {what}", dim.label(units))));
    lines.push(String::new());
    lines.push("Every head of a report and &HELP NAME name the unit of a value.".into());
    lines.join("\n")
}
