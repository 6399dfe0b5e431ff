//! Declarations: what a command or a class record looks like. Parsing, abbreviation, units, `&HELP`, completion, hints
//! and the printed manual all read these; nothing about a record's form is written twice.

use super::select::Owner;
use windlass_base::choice::Choice;
use windlass_base::spec::values_syntax;
pub use windlass_base::spec::{DatumKey, Kind, Need, OptionEffect, OptionSpec, Range, SolveKind, ValueSpec};
use windlass_base::units::{Dim, UnitSystem};
use windlass_base::values::Noun;

/// How the text behind a command word is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextForm {
    /// Words, as data and options.
    Words,
    /// Text as typed, to the end of the record.
    Text,
}

/// The options of one list and then those of another, for a spec that shares one of them; `N` is their number together.
///
/// # Panics
/// While compiling, when `N` is another number.
pub const fn join_options<const N: usize>(first: &[OptionSpec], second: &[OptionSpec]) -> [OptionSpec; N] {
    join_lists(&[first, second])
}

/// How many options lists have together.
pub const fn count_options(lists: &[&[OptionSpec]]) -> usize {
    let (mut count, mut list) = (0, 0);
    while list < lists.len() {
        count += lists[list].len();
        list += 1;
    }
    count
}

/// The options of several lists in their order; `N` is their number together, [`count_options`].
///
/// # Panics
/// While compiling, when `N` is another number.
pub const fn join_lists<const N: usize>(lists: &[&[OptionSpec]]) -> [OptionSpec; N] {
    assert!(N == count_options(lists), "N is the number of all lists");
    let mut all = [OptionSpec::new("", &[], ""); N];
    let (mut at, mut list) = (0, 0);
    while list < lists.len() {
        let mut i = 0;
        while i < lists[list].len() {
            all[at] = lists[list][i];
            (at, i) = (at + 1, i + 1);
        }
        list += 1;
    }
    all
}

/// A menu: what commands belong to, until a word leaves it. Two menus are the same when their names are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MenuSpec {
    /// Its name, as prompts, help and messages use it.
    pub name: &'static str,
    /// The long form of `END`.
    pub end: &'static str,
}

/// Whether a record of a command opens a menu, which an `END` of its own leaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Opens {
    /// It opens none.
    Nothing,
    /// This menu.
    Menu(&'static MenuSpec),
    /// This menu when at most this many words follow the command; with more it is complete in itself.
    AtMost(&'static MenuSpec, usize),
    /// The first menu when at most this many words follow the command; with more the second.
    AtMostElse(&'static MenuSpec, usize, &'static MenuSpec),
    /// This menu when it has this option, in full or not.
    WithOption(&'static MenuSpec, &'static OptionSpec),
    /// This menu when it has the one option or the other, in full or not.
    WithEither(&'static MenuSpec, [&'static OptionSpec; 2]),
    /// This menu when at most this many words stand between the command and its first option; with more it is
    /// complete in itself.
    Short(&'static MenuSpec, usize),
    /// The first menu, unless it has this option, in full or not.
    WithoutOption(&'static MenuSpec, &'static OptionSpec),
    /// This menu, unless a file of the job's gives the menu's records.
    UnlessFile(&'static MenuSpec),
}

/// A command or a class record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CommandSpec {
    /// Its name; internal commands begin with `&`.
    pub name: &'static str,
    /// Whose name it is.
    pub owner: Owner,
    /// Menus it belongs to; empty means every menu.
    pub menus: &'static [&'static MenuSpec],
    /// The menu it opens.
    pub opens: Opens,
    /// Words or raw text.
    pub form: TextForm,
    /// Positional data in order.
    pub data: &'static [ValueSpec],
    /// The last this-many data repeat as a group (0: none do).
    pub repeat: usize,
    /// Whether options act on the data before them, so that data stand between options.
    pub interleaved: bool,
    /// Options in the order of the manual.
    pub options: &'static [OptionSpec],
    /// Options of other programs that are not offered, each with why: asked for, they are refused with that.
    pub absent: &'static [(&'static str, &'static str)],
    /// Which solves stop behind the record for lack of what it asks for, and until when; empty: it acts.
    pub stops: &'static str,
    /// One line of help.
    pub help: &'static str,
    /// More help: readings, conventions, what is checked.
    pub detail: &'static str,
    /// Records that show it at work; they run as a test.
    pub example: &'static str,
}

impl CommandSpec {
    /// A spec with nothing but a name and a line of help; fill in the rest with `..`.
    pub const fn new(name: &'static str, help: &'static str) -> Self {
        CommandSpec {
            name,
            owner: Owner::Moses,
            menus: &[],
            opens: Opens::Nothing,
            form: TextForm::Words,
            data: &[],
            repeat: 0,
            interleaved: false,
            options: &[],
            absent: &[],
            stops: "",
            help,
            detail: "",
            example: "",
        }
    }

    /// The positional number of this name.
    ///
    /// # Panics
    /// While compiling, in a `const`: no datum has this name, or it is no number.
    pub const fn number(&self, name: &str) -> DatumKey<f64> {
        DatumKey::number(self.data, name)
    }

    /// The positional numbers of these names.
    ///
    /// # Panics
    /// As [`Self::number`].
    pub const fn numbers<const N: usize>(&self, names: [&str; N]) -> [DatumKey<f64>; N] {
        let mut keys = [self.number(names[0]); N];
        let mut i = 0;
        while i < N {
            keys[i] = self.number(names[i]);
            i += 1;
        }
        keys
    }

    /// The positional whole number of this name.
    ///
    /// # Panics
    /// While compiling, in a `const`: no datum has this name, or it is no whole number.
    pub const fn integer(&self, name: &str) -> DatumKey<i64> {
        DatumKey::integer(self.data, name)
    }

    /// The positional word of this name: a name, a text or a file.
    ///
    /// # Panics
    /// While compiling, in a `const`: no datum has this name, or it is no text.
    pub const fn word(&self, name: &str) -> DatumKey<str> {
        DatumKey::word(self.data, name)
    }

    /// The positional word of this name, one of an enum's.
    ///
    /// # Panics
    /// While compiling, in a `const`: no datum has this name, or its words are not those of the enum.
    pub const fn choice<T: Choice>(&self, name: &str) -> DatumKey<T> {
        DatumKey::choice(self.data, name)
    }

    /// The names its options answer to, aliases included.
    pub fn option_names(&self) -> impl Iterator<Item = (&'static str, Owner, &'static OptionSpec)> + Clone + use<> {
        let options: &'static [OptionSpec] = self.options;
        options.iter().flat_map(|option| {
            std::iter::once(option.name)
                .chain(option.aliases.iter().copied())
                .map(move |name| (name, option.owner, option))
        })
    }

    /// The record's form as one line, e.g. `B_CAT OD [FLAG] -LEN L ...`.
    pub fn syntax(&self) -> String {
        let mut text = self.name.to_string();
        text.push_str(&values_syntax(self.data, self.repeat));
        if self.form == TextForm::Text {
            text.push_str(" text");
        }
        if !self.options.is_empty() {
            text.push_str(" -OPTIONS");
        }
        text
    }
}

/// What a value is, in words, for help and errors: `a number (kips)`, `TENSION or COMPRESSION`.
pub fn describe_expected(kind: Kind, units: UnitSystem) -> String {
    let number = |label: String| if label.is_empty() { "a number".to_string() } else { format!("a number ({label})") };
    match kind {
        Kind::Number(dim) => number(dim.label(units)),
        Kind::Integer => "a whole number".into(),
        Kind::Choice(words) => match words {
            [one] => (*one).to_string(),
            [first @ .., last] => format!("{} or {last}", first.join(", ")),
            [] => "a word".into(),
        },
        Kind::ChoiceOrName(words, noun) => {
            format!("{} or {}", words.join(", "), describe_expected(Kind::Name(noun), units))
        }
        Kind::Name(noun) => match noun {
            Noun::Class => "a class (~NAME)",
            Noun::Point => "a point (*NAME)",
            Noun::Body => "a body",
            Noun::Part => "a part",
            Noun::Connector => "a connector",
            Noun::Line => "a connector or &PIPE",
            Noun::Curve => "a curve",
            Noun::Environment => "an environment",
            Noun::Selector => "a name or selector",
            Noun::Macro => "a macro",
            Noun::Bathymetry => "a bathymetry",
            Noun::Filling => "a set of T_PRESSURE data",
            Noun::Compartment => "a compartment",
            Noun::Hole => "a hole",
            Noun::DraftMark => "a draft mark",
            Noun::Sensor => "a sensor",
            Noun::LineType => "a line type",
            Noun::New => "a name",
        }
        .into(),
        Kind::Text => "a word".into(),
        Kind::Item => "a name, a selector or a number".into(),
        Kind::File => "a file name".into(),
        Kind::StiffnessOfDof => {
            format!("a stiffness ({} or {})", Dim::ForcePerLength.label(units), Dim::MomentPerRadian.label(units))
        }
        Kind::ForceOfDof => format!("a force or moment ({} or {})", Dim::Force.label(units), Dim::Moment.label(units)),
        Kind::DampingCoefficient => "a dashpot coefficient".into(),
    }
}
