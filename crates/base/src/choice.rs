//! Words of which a record takes one, as enums. The declaration lists the words of the enum, and a handler receives the
//! enum: a word that is misspelt or left out of a `match` does not compile.

/// An enum of which each variant is a word of a record. [`choices!`](crate::choices) writes one.
pub trait Choice: Copy + PartialEq + 'static {
    /// Its words, in the order of help.
    const WORDS: &'static [&'static str];
    /// Its variants, in the order of their words.
    const ALL: &'static [Self];

    /// Its word.
    fn word(self) -> &'static str;

    /// The variant of a word, which is given in full.
    fn from_word(word: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|choice| choice.word() == word)
    }
}

/// An enum of words: `choices! { pub enum Form { Svg = "SVG", Png = "PNG" } }`.
///
/// ```
/// use windlass_base::choice::Choice;
/// use windlass_base::spec::{OptionSpec, ValueSpec};
///
/// windlass_base::choices! {
///     /// Form of a picture.
///     pub enum Form { Svg = "SVG", Png = "PNG" }
/// }
/// const FORMAT: OptionSpec = OptionSpec::new("-FORMAT", &[ValueSpec::choice::<Form>("FORM", "its form")], "the form");
/// let key = const { FORMAT.choice::<Form>("FORM") };
/// assert_eq!((Form::WORDS, Form::from_word("PNG")), (&["SVG", "PNG"][..], Some(Form::Png)));
/// # let _ = key;
/// ```
///
/// A key for another enum's words does not compile, nor one for a value that the declaration does not have:
///
/// ```compile_fail,E0080
/// # use windlass_base::choice::YesNo;
/// # use windlass_base::spec::{OptionSpec, ValueSpec};
/// # windlass_base::choices! { pub enum Form { Svg = "SVG", Png = "PNG" } }
/// const FORMAT: OptionSpec = OptionSpec::new("-FORMAT", &[ValueSpec::choice::<Form>("FORM", "its form")], "the form");
/// let key = const { FORMAT.choice::<YesNo>("FORM") };
/// ```
///
/// ```compile_fail,E0080
/// # use windlass_base::spec::{OptionSpec, ValueSpec};
/// # windlass_base::choices! { pub enum Form { Svg = "SVG", Png = "PNG" } }
/// const FORMAT: OptionSpec = OptionSpec::new("-FORMAT", &[ValueSpec::choice::<Form>("FORM", "its form")], "the form");
/// let key = const { FORMAT.choice::<Form>("FROM") };
/// ```
#[macro_export]
macro_rules! choices {
    ($(#[$meta:meta])* $visibility:vis enum $name:ident { $($(#[$detail:meta])* $variant:ident = $word:literal),+ $(,)? }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        $visibility enum $name {
            $($(#[$detail])* $variant),+
        }

        impl $crate::choice::Choice for $name {
            const WORDS: &'static [&'static str] = &[$($word),+];
            const ALL: &'static [Self] = &[$(Self::$variant),+];

            fn word(self) -> &'static str {
                match self {
                    $(Self::$variant => $word),+
                }
            }
        }
    };
}

choices! {
    /// The answer of a switch.
    pub enum YesNo {
        /// On.
        Yes = "YES",
        /// Off.
        No = "NO",
    }
}

impl YesNo {
    /// True of YES.
    pub fn is_yes(self) -> bool {
        self == YesNo::Yes
    }
}

choices! {
    /// A degree of freedom: along an axis, or about it.
    #[derive(Hash, PartialOrd, Ord)]
    pub enum Dof {
        /// Along X.
        X = "X",
        /// Along Y.
        Y = "Y",
        /// Along Z.
        Z = "Z",
        /// About X.
        Rx = "RX",
        /// About Y.
        Ry = "RY",
        /// About Z.
        Rz = "RZ",
    }
}

impl Dof {
    /// All six, in order.
    pub const SIX: [Dof; 6] = [Dof::X, Dof::Y, Dof::Z, Dof::Rx, Dof::Ry, Dof::Rz];

    /// Its place among the six, from 0.
    pub fn index(self) -> usize {
        self as usize
    }

    /// Whether it is a rotation.
    pub fn is_rotation(self) -> bool {
        matches!(self, Dof::Rx | Dof::Ry | Dof::Rz)
    }
}
