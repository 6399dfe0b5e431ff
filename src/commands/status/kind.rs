//! What a kind of `&STATUS` declares: its name, whose names it takes, and the tables it makes.

use crate::commands::name_filter::NameFilter;
use crate::commands::verdict::Verdict;
use crate::commands::{Call, Job};
use windlass_base::diagnostic::Outcome;
use windlass_base::span::Span;
use windlass_base::table::Table;
use windlass_base::values::Args;
use windlass_language::select::Owner;
use windlass_model::{EntityKind, Model};

/// A kind of `&STATUS`. One is declared in the file that makes its tables, and listed in `KINDS`.
pub struct StatusKind {
    /// The word that asks for it.
    pub name: &'static str,
    /// Other words of MOSES that ask for it.
    pub aliases: &'static [&'static str],
    /// Whose word it is.
    pub owner: Owner,
    /// One line of help.
    pub help: &'static str,
    /// The sorts of things whose names it takes behind its word; none: names are not looked up.
    pub names: &'static [EntityKind],
    /// Whether what the model leaves out is noted under its tables.
    pub caveats: bool,
    /// Its tables; what a job has to report besides is added to the verdict.
    pub tables: fn(&Query, &mut Verdict) -> Outcome<Vec<Table>>,
    /// What `-PLOT` draws of it, from its tables or anew; `None`: it is not plotted.
    pub charts: Option<ChartsOf>,
}

/// Makes the tables that `-PLOT` draws, from the tables of a kind or anew.
pub type ChartsOf = fn(&Query, &[Table]) -> Outcome<Vec<Table>>;

impl StatusKind {
    /// A kind of windlass' own that takes no names and is not plotted; fill in the rest with `..`.
    pub const fn new(
        name: &'static str,
        help: &'static str,
        tables: fn(&Query, &mut Verdict) -> Outcome<Vec<Table>>,
    ) -> Self {
        let (owner, aliases, names) = (Owner::Ours, &[], &[]);
        StatusKind { name, aliases, owner, help, names, caveats: false, tables, charts: None }
    }

    /// The same, drawn by `-PLOT`.
    pub const fn plotted(self, charts: ChartsOf) -> Self {
        StatusKind { charts: Some(charts), ..self }
    }

    /// The same, with the names of these sorts of things behind its word.
    pub const fn with_names(self, names: &'static [EntityKind]) -> Self {
        StatusKind { names, ..self }
    }

    /// The same, which these words of MOSES ask for too.
    pub const fn also(self, aliases: &'static [&'static str]) -> Self {
        StatusKind { aliases, ..self }
    }

    /// The same, a word of MOSES.
    pub const fn of_moses(self) -> Self {
        StatusKind { owner: Owner::Moses, ..self }
    }
}

/// A record of `&STATUS` as its kinds see it.
pub struct Query<'a> {
    /// The job.
    pub job: &'a Job,
    /// The record.
    pub call: &'a Call<'a>,
    /// The names it gives.
    pub names: &'a NameFilter<'a>,
}

impl<'a> Query<'a> {
    /// The model.
    pub fn model(&self) -> &'a Model {
        &self.job.model
    }

    /// Data and options of the record.
    pub fn args(&self) -> &'a Args {
        &self.call.args
    }

    /// Whether the record takes a thing of a name.
    pub fn fits(&self) -> impl Fn(&str) -> bool + use<'a> {
        let names = self.names;
        move |name| names.matches(name)
    }

    /// Whether the record gives names.
    pub fn is_named(&self) -> bool {
        !self.names.chooses_all()
    }

    /// The place of the kind's word.
    pub fn position(&self) -> Span {
        self.call.args.position(super::WHAT)
    }
}
