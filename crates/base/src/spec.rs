//! Declarations of options and values. A record's spec is made of these, a parser reads by them, and a handler looks
//! up by them what records gave: an option is one constant that the spec lists and the lookup takes.

use crate::choice::Choice;
use crate::units::Dim;
use crate::values::Noun;
use std::marker::PhantomData;

/// Whose name a keyword is. A MOSES abbreviation stays valid whatever else is added: names of MOSES are looked at
/// first, the others only where none of MOSES's fits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Owner {
    /// From the MOSES documents.
    Moses,
    /// From the AQWA documents.
    Aqwa,
    /// Ours.
    Ours,
}

/// What a value is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A number or expression with a dimension; becomes SI.
    Number(Dim),
    /// A whole number.
    Integer,
    /// One of these words, by minimum uniqueness.
    Choice(&'static [&'static str]),
    /// A name of this sort.
    Name(Noun),
    /// One of these words, or a name of this sort; as typed.
    ChoiceOrName(&'static [&'static str], Noun),
    /// Any word.
    Text,
    /// A name, a selector, an attribute or a number, in an order that the handler reads.
    Item,
    /// A file name.
    File,
    /// A number whose dimension follows from the degree of freedom before it: stiffness.
    StiffnessOfDof,
    /// A number whose dimension follows from the degree of freedom before it: force or moment.
    ForceOfDof,
    /// A dashpot coefficient; its dimension follows from the exponent after it.
    DampingCoefficient,
}

/// Whether a value must be there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    /// An error without it.
    Required,
    /// May be left out; the text says what holds then.
    Optional(&'static str),
}

/// The range a number must lie in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    /// Anything finite.
    Any,
    /// Greater than zero.
    Positive,
    /// Zero or more.
    NotNegative,
    /// Between these, ends included (user units).
    Within(f64, f64),
}

/// One value of a record or an option.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ValueSpec {
    /// Its name in the manual, e.g. `OD`.
    pub name: &'static str,
    /// What it is.
    pub kind: Kind,
    /// Must it be there.
    pub need: Need,
    /// Where it must lie.
    pub range: Range,
    /// Of a name that may be of several sorts, the sorts that completion offers; none: all.
    pub among: &'static [Noun],
    /// One line of help.
    pub help: &'static str,
}

impl ValueSpec {
    /// A value that must be there.
    pub const fn new(name: &'static str, kind: Kind, help: &'static str) -> Self {
        ValueSpec { name, kind, need: Need::Required, range: Range::Any, among: &[], help }
    }

    /// A word of an enum that must be there.
    pub const fn choice<T: Choice>(name: &'static str, help: &'static str) -> Self {
        ValueSpec::new(name, Kind::Choice(T::WORDS), help)
    }

    /// The same, but it may be left out; `default` says what holds then.
    pub const fn or(self, default: &'static str) -> Self {
        ValueSpec { need: Need::Optional(default), ..self }
    }

    /// The same, but only greater than zero.
    pub const fn positive(self) -> Self {
        ValueSpec { range: Range::Positive, ..self }
    }

    /// The same, but zero or more.
    pub const fn not_negative(self) -> Self {
        ValueSpec { range: Range::NotNegative, ..self }
    }

    /// The same, but between two bounds (user units).
    pub const fn in_range(self, low: f64, high: f64) -> Self {
        ValueSpec { range: Range::Within(low, high), ..self }
    }

    /// The same, a name of one of these sorts, or a selector or pattern that chooses among them.
    pub const fn among(self, nouns: &'static [Noun]) -> Self {
        ValueSpec { among: nouns, ..self }
    }

    /// True when the value must be there.
    pub fn is_required(&self) -> bool {
        self.need == Need::Required
    }
}

/// What a solver finds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SolveKind {
    /// Weight and buoyancy alone: the hydrostatics of a body.
    Hydrostatics,
    /// Forces and rest.
    Statics,
    /// Motions: modes, the frequency domain, the time domain.
    Motions,
}

/// What an option does to results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OptionEffect {
    /// What its help says.
    Acts,
    /// Nothing: it is read, kept and shown.
    Noted,
    /// No solver computes what it asks, named here: the next solve of this kind stops.
    Stops(SolveKind, &'static str),
}

/// An option with its values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OptionSpec {
    /// With its leading `-`.
    pub name: &'static str,
    /// Other spellings of the same, in the documents' words.
    pub aliases: &'static [&'static str],
    /// Whose name it is.
    pub owner: Owner,
    /// Values in order.
    pub values: &'static [ValueSpec],
    /// The last this-many values repeat as a group (0: none do).
    pub repeat: usize,
    /// True when the option may be given more than once in a record.
    pub many: bool,
    /// One line of help.
    pub help: &'static str,
    /// What holds without the option.
    pub default: &'static str,
    /// What it does to results.
    pub effect: OptionEffect,
}

/// A value of an option, by the name its declaration gives it, and the type it is read as: `f64`, `i64`, `str` or an enum
/// of its words. It is found while compiling, in a `const`: a name that the option does not have, or a value of another
/// kind, does not compile.
pub struct ValueKey<T: ?Sized> {
    pub(crate) name: &'static str,
    pub(crate) index: usize,
    read_as: PhantomData<fn() -> Box<T>>,
}

impl<T: ?Sized> Clone for ValueKey<T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T: ?Sized> Copy for ValueKey<T> {}

/// A positional datum of a record, by the name its declaration gives it; as [`ValueKey`] of an option.
pub struct DatumKey<T: ?Sized>(pub(crate) ValueKey<T>);

impl<T: ?Sized> Clone for DatumKey<T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T: ?Sized> Copy for DatumKey<T> {}

impl<T: ?Sized> From<DatumKey<T>> for ValueKey<T> {
    fn from(DatumKey(key): DatumKey<T>) -> Self {
        key
    }
}

impl Kind {
    pub(crate) const fn is_number(self) -> bool {
        matches!(
            self,
            Kind::Number(_) | Kind::Integer | Kind::StiffnessOfDof | Kind::ForceOfDof | Kind::DampingCoefficient
        )
    }

    /// Whether it is read as text; a choice is read as the enum of its words.
    pub(crate) const fn is_text(self) -> bool {
        matches!(self, Kind::Name(_) | Kind::ChoiceOrName(..) | Kind::Text | Kind::Item | Kind::File)
    }
}

/// Whether two names are one; `==` of texts is not for constants.
const fn same(one: &str, other: &str) -> bool {
    let (one, other) = (one.as_bytes(), other.as_bytes());
    let mut i = 0;
    while i < one.len() && i < other.len() && one[i] == other[i] {
        i += 1;
    }
    i == one.len() && i == other.len()
}

/// Whether two lists have the same words in the same order.
const fn same_words(one: &[&str], other: &[&str]) -> bool {
    let mut i = 0;
    while i < one.len() && i < other.len() && same(one[i], other[i]) {
        i += 1;
    }
    i == one.len() && i == other.len()
}

/// The place of a value among others, and what it is.
const fn find(values: &[ValueSpec], name: &str) -> (usize, Kind) {
    let mut i = 0;
    while i < values.len() {
        if same(values[i].name, name) {
            return (i, values[i].kind);
        }
        i += 1;
    }
    panic!("no value has this name")
}

impl<T: ?Sized> ValueKey<T> {
    const fn new(values: &[ValueSpec], index: usize) -> Self {
        ValueKey { name: values[index].name, index, read_as: PhantomData }
    }
}

impl ValueKey<f64> {
    const fn number(values: &[ValueSpec], name: &str) -> Self {
        let (index, kind) = find(values, name);
        assert!(kind.is_number(), "the value is no number");
        ValueKey::new(values, index)
    }
}

impl ValueKey<i64> {
    const fn integer(values: &[ValueSpec], name: &str) -> Self {
        let (index, kind) = find(values, name);
        assert!(matches!(kind, Kind::Integer), "the value is no whole number");
        ValueKey::new(values, index)
    }
}

impl ValueKey<str> {
    const fn word(values: &[ValueSpec], name: &str) -> Self {
        let (index, kind) = find(values, name);
        assert!(kind.is_text(), "the value is no text");
        ValueKey::new(values, index)
    }
}

impl<T: Choice> ValueKey<T> {
    const fn choice(values: &[ValueSpec], name: &str) -> Self {
        let (index, kind) = find(values, name);
        match kind {
            Kind::Choice(words) => assert!(same_words(words, T::WORDS), "the value has other words"),
            _ => panic!("the value is no choice"),
        }
        ValueKey::new(values, index)
    }
}

impl DatumKey<f64> {
    /// The number of this name among declarations of data.
    ///
    /// # Panics
    /// While compiling, in a `const`: no datum has this name, or it is no number.
    pub const fn number(data: &[ValueSpec], name: &str) -> Self {
        DatumKey(ValueKey::number(data, name))
    }
}

impl DatumKey<i64> {
    /// The whole number of this name.
    ///
    /// # Panics
    /// While compiling, in a `const`: no datum has this name, or it is no whole number.
    pub const fn integer(data: &[ValueSpec], name: &str) -> Self {
        DatumKey(ValueKey::integer(data, name))
    }
}

impl DatumKey<str> {
    /// The word of this name: a name, a text or a file.
    ///
    /// # Panics
    /// While compiling, in a `const`: no datum has this name, or it is no text.
    pub const fn word(data: &[ValueSpec], name: &str) -> Self {
        DatumKey(ValueKey::word(data, name))
    }
}

impl<T: Choice> DatumKey<T> {
    /// The word of this name, one of an enum's.
    ///
    /// # Panics
    /// While compiling, in a `const`: no datum has this name, or its words are not those of the enum.
    pub const fn choice(data: &[ValueSpec], name: &str) -> Self {
        DatumKey(ValueKey::choice(data, name))
    }
}

impl OptionSpec {
    /// The number of this name.
    ///
    /// # Panics
    /// While compiling, in a `const`: no value has this name, or it is no number.
    pub const fn number(&self, name: &str) -> ValueKey<f64> {
        ValueKey::number(self.values, name)
    }

    /// The numbers of these names.
    ///
    /// # Panics
    /// As [`Self::number`].
    pub const fn numbers<const N: usize>(&self, names: [&str; N]) -> [ValueKey<f64>; N] {
        let mut keys = [self.number(names[0]); N];
        let mut i = 0;
        while i < N {
            keys[i] = self.number(names[i]);
            i += 1;
        }
        keys
    }

    /// The whole number of this name.
    ///
    /// # Panics
    /// While compiling, in a `const`: no value has this name, or it is no whole number.
    pub const fn integer(&self, name: &str) -> ValueKey<i64> {
        ValueKey::integer(self.values, name)
    }

    /// The word of this name: a name, a text or a file.
    ///
    /// # Panics
    /// While compiling, in a `const`: no value has this name, or it is no text.
    pub const fn word(&self, name: &str) -> ValueKey<str> {
        ValueKey::word(self.values, name)
    }

    /// The word of this name, one of an enum's.
    ///
    /// # Panics
    /// While compiling, in a `const`: no value has this name, or its words are not those of the enum.
    pub const fn choice<T: Choice>(&self, name: &str) -> ValueKey<T> {
        ValueKey::choice(self.values, name)
    }

    /// A MOSES option.
    pub const fn new(name: &'static str, values: &'static [ValueSpec], help: &'static str) -> Self {
        OptionSpec {
            name,
            aliases: &[],
            owner: Owner::Moses,
            values,
            repeat: 0,
            many: false,
            help,
            default: "",
            effect: OptionEffect::Acts,
        }
    }

    /// An option of windlass' own.
    pub const fn ours(name: &'static str, values: &'static [ValueSpec], help: &'static str) -> Self {
        OptionSpec::new(name, values, help).owner(Owner::Ours)
    }

    /// The same with what holds when the option is not given.
    pub const fn default(self, default: &'static str) -> Self {
        OptionSpec { default, ..self }
    }

    /// Whether this is its name.
    pub const fn is_named(&self, name: &str) -> bool {
        same(self.name, name)
    }

    /// The same, owned by somebody else than MOSES.
    pub const fn owner(self, owner: Owner) -> Self {
        OptionSpec { owner, ..self }
    }

    /// The same, without effect on results.
    pub const fn without_effect(self) -> Self {
        OptionSpec { effect: OptionEffect::Noted, ..self }
    }

    /// The same, where no solver computes what it asks: the next solve of this kind stops.
    pub const fn stops(self, kind: SolveKind, effect: &'static str) -> Self {
        OptionSpec { effect: OptionEffect::Stops(kind, effect), ..self }
    }

    /// The same, its last `count` values repeating as a group.
    pub const fn repeating(self, count: usize) -> Self {
        OptionSpec { repeat: count, ..self }
    }

    /// The same, allowed more than once.
    pub const fn many(self) -> Self {
        OptionSpec { many: true, ..self }
    }

    /// The same with other spellings.
    pub const fn aliases(self, aliases: &'static [&'static str]) -> Self {
        OptionSpec { aliases, ..self }
    }
}

impl OptionSpec {
    /// The option's form, e.g. `-CLUMP CW [CLEN]`.
    pub fn syntax(&self) -> String {
        format!("{}{}", self.name, values_syntax(self.values, self.repeat))
    }
}

/// Values in the form a manual gives them: ` CW [CLEN]`, with ` ...` where some repeat.
pub fn values_syntax(values: &[ValueSpec], repeat: usize) -> String {
    let mut text = String::new();
    for value in values {
        if value.is_required() {
            text.push_str(&format!(" {}", value.name));
        } else {
            text.push_str(&format!(" [{}]", value.name));
        }
    }
    if repeat > 0 {
        text.push_str(" ...");
    }
    text
}
