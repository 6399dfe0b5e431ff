//! `&NAMES`: the names of things of one sort.
//!
//! MOSES has words in the singular and in the plural; either is taken. Which words it has beyond PI_VIEW and SHAPES no source at hand says.

use crate::commands::Job;
use windlass_base::diagnostic::Outcome;
use windlass_base::wildcard::matches;
use windlass_language::record::Word;
use windlass_language::select::{Owner, choose};
use windlass_model::{EntityKind, Model};

/// A word of `&NAMES`, and what it lists.
type Listed = (&'static str, EntityKind);

/// The words, each in the plural and in the singular.
const KINDS: &[Listed] = &[
    ("BODIES", EntityKind::Body),
    ("BODY", EntityKind::Body),
    ("PARTS", EntityKind::Part),
    ("PART", EntityKind::Part),
    ("POINTS", EntityKind::Point),
    ("POINT", EntityKind::Point),
    ("NODES", EntityKind::Point),
    ("NODE", EntityKind::Point),
    ("CLASSES", EntityKind::Class),
    ("CLASS", EntityKind::Class),
    ("CONNECTORS", EntityKind::Connector),
    ("CONNECTOR", EntityKind::Connector),
    ("CURVES", EntityKind::Curve),
    ("CURVE", EntityKind::Curve),
    ("ENVIRONMENTS", EntityKind::Environment),
    ("ENVIRONMENT", EntityKind::Environment),
    ("SELECTORS", EntityKind::Selector),
    ("SELECTOR", EntityKind::Selector),
    ("PIECES", EntityKind::Piece),
    ("PIECE", EntityKind::Piece),
    ("COMPARTMENTS", EntityKind::Compartment),
    ("COMPARTMENT", EntityKind::Compartment),
    ("DMARKS", EntityKind::DraftMark),
    ("DMARK", EntityKind::DraftMark),
    ("ASSEMBLIES", EntityKind::Assembly),
    ("ASSEMBLY", EntityKind::Assembly),
];

/// The value of `&NAMES(KIND patterns)`.
pub(super) fn names(job: &Job, kind: &Word, rest: &[Word]) -> Outcome<String> {
    // views of pictures are not kept
    if kind.text.eq_ignore_ascii_case("PI_VIEW") {
        return Ok(String::new());
    }
    let model = &job.model;
    let known = KINDS.iter().map(|(word, kind)| (*word, Owner::Moses, *kind));
    let all = model.names(choose(&kind.text, kind.span, "kind of &NAMES", known)?);
    let fits = |name: &&str| {
        rest.is_empty()
            || rest.iter().any(|w| match model.selectors.get(&Model::key(&w.text)) {
                Some(selector) => selector.matches(name, model),
                None => matches(&w.text, name),
            })
    };
    Ok(all.into_iter().filter(fits).collect::<Vec<_>>().join(" "))
}
