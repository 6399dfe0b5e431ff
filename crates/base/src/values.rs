//! The values of a record, whatever their form was: SI numbers, words and names, each with its place.

use crate::choice::{Choice, YesNo};
use crate::span::Span;
use crate::spec::{DatumKey, Kind, OptionSpec, ValueKey, ValueSpec};
use crate::units::Dim;
use std::sync::Arc;

/// What a name refers to; drives completion and the wording of errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Noun {
    /// A class, `~NAME`.
    Class,
    /// A point, `*NAME`.
    Point,
    /// A body.
    Body,
    /// A part.
    Part,
    /// A connector.
    Connector,
    /// A connector, or a pipe, `&PIPE`.
    Line,
    /// A curve.
    Curve,
    /// An environment.
    Environment,
    /// A selector, `:NAME`, or a name that may hold wild characters.
    Selector,
    /// A macro.
    Macro,
    /// A bottom over a grid.
    Bathymetry,
    /// What pipes hold, kept under a name.
    Filling,
    /// An interior compartment.
    Compartment,
    /// A hole of a compartment.
    Hole,
    /// A draft mark.
    DraftMark,
    /// A sensor.
    Sensor,
    /// A line type of the library.
    LineType,
    /// A new name, not to be looked up.
    New,
}

/// What a value turned out to be.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// Left out between commas.
    Empty,
    /// A number in SI.
    Number(f64),
    /// A whole number.
    Integer(i64),
    /// A word: the full keyword of a choice, or a name or text as typed.
    Word(Arc<str>),
}

/// A value with the place it was written.
#[derive(Clone, Debug, PartialEq)]
pub struct Value {
    /// What it is.
    pub content: Content,
    /// What a number measures.
    pub dim: Dim,
    /// What a name refers to; none of what is no name.
    pub noun: Option<Noun>,
    /// Where it stands.
    pub span: Span,
}

/// An option as given in a record.
#[derive(Clone, Debug, PartialEq)]
pub struct Given {
    /// Its declaration.
    pub option: &'static OptionSpec,
    /// Where its name stands.
    pub span: Span,
    /// Its values.
    pub values: Vec<Value>,
    /// How many positional data came before it in the record.
    pub after: usize,
}

/// A record read: positional data and options in the order given.
#[derive(Clone, Debug, PartialEq)]
pub struct Args {
    /// Where the command word stands.
    pub span: Span,
    /// The options its command takes.
    pub declared: &'static [OptionSpec],
    /// The positional data its command takes; the last may repeat.
    pub declared_data: &'static [ValueSpec],
    /// Positional data.
    pub data: Vec<Value>,
    /// Options in the order given.
    pub options: Vec<Given>,
}

impl Value {
    /// A value left out between commas, at its place.
    pub fn empty(span: Span) -> Self {
        Value { content: Content::Empty, dim: Dim::None, noun: None, span }
    }

    /// The number, if it is one.
    pub fn number(&self) -> Option<f64> {
        match self.content {
            Content::Number(value) => Some(value),
            Content::Integer(value) => Some(value as f64),
            Content::Word(_) | Content::Empty => None,
        }
    }

    /// The word, if it is one.
    pub fn word(&self) -> Option<&str> {
        match &self.content {
            Content::Word(text) => Some(text),
            _ => None,
        }
    }

    /// The word as one of an enum's, if it is one.
    pub fn choice<T: Choice>(&self) -> Option<T> {
        self.word().and_then(T::from_word)
    }

    /// The whole number, if it is one.
    pub fn integer(&self) -> Option<i64> {
        match self.content {
            Content::Integer(value) => Some(value),
            _ => None,
        }
    }

    /// True unless it was left out between commas.
    pub fn is_given(&self) -> bool {
        self.content != Content::Empty
    }
}

impl Given {
    /// Whether this option was given.
    pub fn is(&self, option: &OptionSpec) -> bool {
        self.option.name == option.name
    }

    /// Whether one of these options was given.
    pub fn is_any(&self, options: &[OptionSpec]) -> bool {
        options.iter().any(|option| self.is(option))
    }

    /// Full name of the option, for messages.
    pub fn name(&self) -> &'static str {
        self.option.name
    }

    /// A value of the option; `None` when it is left out. The option must have it.
    pub fn value<T: ?Sized>(&self, key: ValueKey<T>) -> Option<&Value> {
        debug_assert!(
            self.has_value(key),
            "{} is looked up in {}, which has no such value",
            key.name,
            self.option.name
        );
        self.values.get(key.index)
    }

    /// A number; `None` when it is left out.
    pub fn number(&self, key: ValueKey<f64>) -> Option<f64> {
        self.value(key).and_then(Value::number)
    }

    /// A number that only some of the options of this name have; `None` where this one has it not.
    pub fn number_if_declared(&self, key: ValueKey<f64>) -> Option<f64> {
        self.has_value(key).then(|| self.number(key)).flatten()
    }

    /// Whether the option has such a value.
    fn has_value<T: ?Sized>(&self, key: ValueKey<T>) -> bool {
        self.option.values.get(key.index).is_some_and(|value| value.name == key.name)
    }

    /// Numbers; zeros for those that are left out.
    pub fn numbers_or_zero<const N: usize>(&self, keys: [ValueKey<f64>; N]) -> [f64; N] {
        keys.map(|key| self.number(key).unwrap_or(0.0))
    }

    /// A whole number; `None` when it is left out.
    pub fn integer(&self, key: ValueKey<i64>) -> Option<i64> {
        self.value(key).and_then(Value::integer)
    }

    /// A word; `None` when it is left out.
    pub fn word(&self, key: ValueKey<str>) -> Option<&str> {
        self.value(key).and_then(Value::word)
    }

    /// The choice made; `None` when it is left out.
    pub fn choice<T: Choice>(&self, key: ValueKey<T>) -> Option<T> {
        self.value(key).and_then(Value::choice)
    }

    /// The choices made from this value on, of those that repeat.
    pub fn choices<T: Choice>(&self, key: ValueKey<T>) -> impl Iterator<Item = T> {
        debug_assert!(self.has_value(key), "{} is looked up in {}", key.name, self.option.name);
        self.values.iter().skip(key.index).filter_map(Value::choice)
    }

    /// Whether a switch is on: `-NAME` and `-NAME YES` are, `-NAME NO` is not.
    pub fn is_on(&self) -> bool {
        debug_assert!(
            self.option.values.first().is_none_or(|value| value.kind == Kind::Choice(YesNo::WORDS)),
            "{} is read as a switch",
            self.option.name
        );
        self.values.first().and_then(Value::choice).is_none_or(YesNo::is_yes)
    }

    /// Where a value stands, or the option when it is left out.
    pub fn position<T: ?Sized>(&self, key: ValueKey<T>) -> Span {
        self.value(key).map_or(self.span, |value| value.span)
    }

    /// The values from one on: it and what stands behind it.
    pub fn values_from<T: ?Sized>(&self, key: ValueKey<T>) -> &[Value] {
        self.values.get(key.index..).unwrap_or_default()
    }

    /// The first value as a number: that of an option with one value, whichever it is.
    pub fn first_number(&self) -> Option<f64> {
        self.values.first().and_then(Value::number)
    }

    /// The first value as a whole number.
    pub fn first_integer(&self) -> Option<i64> {
        self.values.first().and_then(Value::integer)
    }

    /// The first value as a word: a name, a text or a file, no choice.
    pub fn first_word(&self) -> Option<&str> {
        debug_assert!(
            !matches!(self.option.values.first(), Some(ValueSpec { kind: Kind::Choice(_), .. })),
            "{} is a choice, and read as text",
            self.option.name
        );
        self.values.first().and_then(Value::word)
    }

    /// Where the first value stands, or the option when there is none.
    pub fn first_place(&self) -> Span {
        self.values.first().map_or(self.span, |value| value.span)
    }

    /// The groups of the values that repeat; the last one may be short.
    pub fn groups(&self) -> impl Iterator<Item = Group<'_>> {
        let first = self.option.values.len().saturating_sub(self.option.repeat);
        groups_of(&self.values, self.option.values, first)
    }

    /// The values that name a thing of this sort.
    pub fn names(&self, noun: Noun) -> impl Iterator<Item = &Value> {
        self.values.iter().filter(move |value| value.noun == Some(noun))
    }

    /// All numbers in order.
    pub fn numbers(&self) -> Vec<f64> {
        self.values.iter().filter_map(Value::number).collect()
    }
}

/// One group of values that repeat. Its values are read by the keys of their declarations, of an option or of a record.
#[derive(Clone, Copy, Debug)]
pub struct Group<'a> {
    values: &'a [Value],
    declared: &'static [ValueSpec],
    /// The place of the group's first value among the declarations.
    first: usize,
}

/// The values from one of their declarations on, in groups as long as what is declared from there.
fn groups_of<'a>(values: &'a [Value], declared: &'static [ValueSpec], first: usize) -> impl Iterator<Item = Group<'a>> {
    let size = declared.len().saturating_sub(first).max(1);
    values.get(first..).unwrap_or_default().chunks(size).map(move |values| Group { values, declared, first })
}

impl<'a> Group<'a> {
    /// A value of the group; `None` when it is left out. The group must have it.
    pub fn value<T: ?Sized>(&self, key: impl Into<ValueKey<T>>) -> Option<&'a Value> {
        let key: ValueKey<T> = key.into();
        debug_assert!(
            key.index >= self.first && self.declared.get(key.index).is_some_and(|value| value.name == key.name),
            "{} is looked up in a group that has no such value",
            key.name
        );
        self.values.get(key.index.checked_sub(self.first)?)
    }

    /// A number; `None` when it is left out.
    pub fn number(&self, key: impl Into<ValueKey<f64>>) -> Option<f64> {
        self.value(key).and_then(Value::number)
    }

    /// Numbers; zeros for those that are left out.
    pub fn numbers_or_zero<const N: usize>(&self, keys: [impl Into<ValueKey<f64>>; N]) -> [f64; N] {
        keys.map(|key| self.number(key).unwrap_or(0.0))
    }

    /// A word; `None` when it is left out.
    pub fn word(&self, key: impl Into<ValueKey<str>>) -> Option<&'a str> {
        self.value(key).and_then(Value::word)
    }

    /// The choice made; `None` when it is left out.
    pub fn choice<T: Choice>(&self, key: impl Into<ValueKey<T>>) -> Option<T> {
        self.value(key).and_then(Value::choice)
    }

    /// Where a value stands, or the group's first one when it is left out.
    pub fn position<T: ?Sized>(&self, key: impl Into<ValueKey<T>>) -> Span {
        self.value(key).or(self.values.first()).map_or(Span::default(), |value| value.span)
    }
}

/// Whether the first value of an option is of a kind.
fn begins_with(option: &OptionSpec, is: impl Fn(Kind) -> bool) -> bool {
    option.values.first().is_some_and(|value| is(value.kind))
}

impl Args {
    /// A positional datum; `None` when it is left out. The command must declare it.
    pub fn datum<T: ?Sized>(&self, key: DatumKey<T>) -> Option<&Value> {
        let DatumKey(key) = key;
        debug_assert!(
            self.declared_data.get(key.index).is_some_and(|declared| declared.name == key.name),
            "{} is looked up in a record that has no such datum",
            key.name
        );
        self.data.get(key.index)
    }

    /// A positional number; `None` when it is left out.
    pub fn number(&self, key: DatumKey<f64>) -> Option<f64> {
        self.datum(key).and_then(Value::number)
    }

    /// Positional numbers; zeros for those that are left out.
    pub fn numbers_or_zero<const N: usize>(&self, keys: [DatumKey<f64>; N]) -> [f64; N] {
        keys.map(|key| self.number(key).unwrap_or(0.0))
    }

    /// A positional whole number; `None` when it is left out.
    pub fn integer(&self, key: DatumKey<i64>) -> Option<i64> {
        self.datum(key).and_then(Value::integer)
    }

    /// A positional word; `None` when it is left out.
    pub fn word(&self, key: DatumKey<str>) -> Option<&str> {
        self.datum(key).and_then(Value::word)
    }

    /// The choice that a positional word makes; `None` when it is left out.
    pub fn choice<T: Choice>(&self, key: DatumKey<T>) -> Option<T> {
        self.datum(key).and_then(Value::choice)
    }

    /// The place of a positional datum, or of the command when it is not there.
    pub fn position<T: ?Sized>(&self, key: DatumKey<T>) -> Span {
        self.datum(key).map_or(self.span, |value| value.span)
    }

    /// The positional data behind one: those that repeat.
    pub fn data_after<T: ?Sized>(&self, key: DatumKey<T>) -> &[Value] {
        let DatumKey(ValueKey { index, .. }) = key;
        self.data.get(index + 1..).unwrap_or_default()
    }

    /// The groups of the positional data that repeat, which begin with one; the last group may be short.
    pub fn groups_from<T: ?Sized>(&self, key: DatumKey<T>) -> impl Iterator<Item = Group<'_>> {
        groups_of(&self.data, self.declared_data, ValueKey::from(key).index)
    }

    /// A record without words to read.
    pub fn empty(span: Span) -> Self {
        Args { span, declared: &[], declared_data: &[], data: Vec::new(), options: Vec::new() }
    }

    /// An option, if given (the last, when given more than once). The command must declare it.
    pub fn option(&self, option: &OptionSpec) -> Option<&Given> {
        self.occurrences(option).next_back()
    }

    /// An option that only some of the commands which this record may be of take; none where its command does not.
    pub fn option_if_declared(&self, option: &OptionSpec) -> Option<&Given> {
        self.options.iter().rev().find(|given| given.is(option))
    }

    /// The first number of such an option.
    pub fn number_if_declared(&self, option: &OptionSpec) -> Option<f64> {
        debug_assert!(begins_with(option, Kind::is_number), "{} is read as a number", option.name);
        self.option_if_declared(option).and_then(Given::first_number)
    }

    /// Every occurrence of an option. The command must declare it.
    pub fn occurrences<'a>(&'a self, option: &OptionSpec) -> impl DoubleEndedIterator<Item = &'a Given> + use<'a> {
        debug_assert!(self.declares(option), "{} is looked up in a record that does not take it", option.name);
        let name = option.name;
        self.options.iter().filter(move |given| given.option.name == name)
    }

    /// Whether the command takes this option.
    fn declares(&self, option: &OptionSpec) -> bool {
        self.declared.iter().any(|declared| declared.name == option.name)
    }

    /// True when an option is given.
    pub fn has(&self, option: &OptionSpec) -> bool {
        self.option(option).is_some()
    }

    /// The first number of an option.
    pub fn option_number(&self, option: &OptionSpec) -> Option<f64> {
        debug_assert!(begins_with(option, Kind::is_number), "{} is read as a number", option.name);
        self.option(option).and_then(Given::first_number)
    }

    /// The first whole number of an option.
    pub fn option_integer(&self, option: &OptionSpec) -> Option<i64> {
        debug_assert!(begins_with(option, |kind| kind == Kind::Integer), "{} is read as a whole number", option.name);
        self.option(option).and_then(Given::first_integer)
    }

    /// The first word of an option.
    pub fn option_word(&self, option: &OptionSpec) -> Option<&str> {
        debug_assert!(begins_with(option, Kind::is_text), "{} is read as text", option.name);
        self.option(option).and_then(Given::first_word)
    }

    /// The choice an option makes.
    pub fn option_choice<T: Choice>(&self, option: &OptionSpec, key: ValueKey<T>) -> Option<T> {
        self.option(option).and_then(|given| given.choice(key))
    }

    /// A switch: `-NAME` or `-NAME YES` is true, `-NAME NO` false, absent the default.
    pub fn switch(&self, option: &OptionSpec, default: bool) -> bool {
        self.option(option).map_or(default, Given::is_on)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choices;

    const TAKEN: OptionSpec = OptionSpec::new("-TAKEN", &[], "an option");
    const OTHER: OptionSpec = OptionSpec::new("-OTHER", &[], "an option of another command");

    #[test]
    fn command_option_is_found_where_given() {
        let (span, declared) = (Span::default(), &[TAKEN]);
        let given = Given { option: &TAKEN, span, values: Vec::new(), after: 0 };
        let args = Args { declared, options: vec![given], ..Args::empty(span) };
        assert!(args.has(&TAKEN) && !Args { options: Vec::new(), ..args.clone() }.has(&TAKEN));
        assert!(args.option_if_declared(&OTHER).is_none());
    }

    choices! {
        enum VesselSide {
            Port = "PORT",
            Starboard = "STARBOARD",
        }
    }

    const DATA: &[ValueSpec] = &[
        ValueSpec::choice::<VesselSide>("SIDE", "a side"),
        ValueSpec::new("X", Kind::Number(Dim::Length), "a place"),
        ValueSpec::new("Y", Kind::Number(Dim::Length), "further places"),
    ];

    fn record(words: &[Content]) -> Args {
        let value = |content: &Content| Value { content: content.clone(), ..Value::empty(Span::default()) };
        let data = words.iter().map(value).collect();
        Args { declared_data: DATA, data, ..Args::empty(Span::default()) }
    }

    #[test]
    fn positional_data_are_read_by_name() {
        let args = record(&[Content::Word("STARBOARD".into()), Content::Number(2.0), Content::Empty]);
        let [x, y] = const { [DatumKey::number(DATA, "X"), DatumKey::number(DATA, "Y")] };
        assert_eq!(args.choice(const { DatumKey::choice(DATA, "SIDE") }), Some(VesselSide::Starboard));
        assert_eq!((args.number(x), args.number(y)), (Some(2.0), None));
        assert_eq!((args.numbers_or_zero([x, y]), args.data_after(x).len()), ([2.0, 0.0], 1));
        assert_eq!(record(&[]).choice(const { DatumKey::<VesselSide>::choice(DATA, "SIDE") }), None);
    }

    #[test]
    #[cfg(debug_assertions)]
    #[should_panic(expected = "X is looked up in a record that has no such datum")]
    fn datum_of_another_command_cannot_be_looked_up() {
        Args::empty(Span::default()).number(const { DatumKey::number(DATA, "X") });
    }

    #[test]
    fn switch_without_no_is_on() {
        const SWITCH: OptionSpec =
            OptionSpec::new("-SWITCH", &[ValueSpec::choice::<YesNo>("YES/NO", "on or off").or("YES")], "a switch");
        let given =
            |words: &[Content]| Given { option: &SWITCH, span: Span::default(), values: record(words).data, after: 0 };
        assert!(given(&[]).is_on() && given(&[Content::Word("YES".into())]).is_on());
        assert!(!given(&[Content::Word("NO".into())]).is_on());
    }

    #[test]
    #[cfg(debug_assertions)]
    #[should_panic(expected = "-OTHER is looked up in a record that does not take it")]
    fn option_of_another_command_cannot_be_looked_up() {
        let args = Args { declared: &[TAKEN], ..Args::empty(Span::default()) };
        args.has(&OTHER);
    }
}
