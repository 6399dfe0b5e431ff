//! `&NAMES`: the names of things of one sort.
//!
//! MOSES has words in the singular and in the plural; either is taken. Which words it has beyond PI_VIEW and SHAPES no source at hand says.

use crate::commands::Job;
use crate::commands::model::process;
use indexmap::IndexSet;
use windlass_base::diagnostic::Outcome;
use windlass_base::wildcard::matches;
use windlass_language::record::Word;
use windlass_language::select::{Owner, choose};
use windlass_model::{EntityKind, Model};

/// What a word of `&NAMES` lists.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Listed {
    /// Things of the model of a sort.
    Entity(EntityKind),
    LoadGroups,
    Holes,
    Sensors,
    /// Load categories.
    Categories,
    /// Connectors, beams, plates and tubes.
    Elements,
    /// Shapes of `&DATA SHAPES`.
    Shapes,
    Processes,
    /// Views of pictures, which are not kept.
    Views,
}

/// The words, each in the plural and in the singular.
const KINDS: &[(&str, Listed)] = &[
    ("BODIES", Listed::Entity(EntityKind::Body)),
    ("BODY", Listed::Entity(EntityKind::Body)),
    ("PARTS", Listed::Entity(EntityKind::Part)),
    ("PART", Listed::Entity(EntityKind::Part)),
    ("POINTS", Listed::Entity(EntityKind::Point)),
    ("POINT", Listed::Entity(EntityKind::Point)),
    ("NODES", Listed::Entity(EntityKind::Point)),
    ("NODE", Listed::Entity(EntityKind::Point)),
    ("CLASSES", Listed::Entity(EntityKind::Class)),
    ("CLASS", Listed::Entity(EntityKind::Class)),
    ("CONNECTORS", Listed::Entity(EntityKind::Connector)),
    ("CONNECTOR", Listed::Entity(EntityKind::Connector)),
    ("ELEMENTS", Listed::Elements),
    ("ELEMENT", Listed::Elements),
    ("CURVES", Listed::Entity(EntityKind::Curve)),
    ("CURVE", Listed::Entity(EntityKind::Curve)),
    ("ENVIRONMENTS", Listed::Entity(EntityKind::Environment)),
    ("ENVIRONMENT", Listed::Entity(EntityKind::Environment)),
    ("SELECTORS", Listed::Entity(EntityKind::Selector)),
    ("SELECTOR", Listed::Entity(EntityKind::Selector)),
    ("PIECES", Listed::Entity(EntityKind::Piece)),
    ("PIECE", Listed::Entity(EntityKind::Piece)),
    ("COMPARTMENTS", Listed::Entity(EntityKind::Compartment)),
    ("COMPARTMENT", Listed::Entity(EntityKind::Compartment)),
    ("HOLES", Listed::Holes),
    ("HOLE", Listed::Holes),
    ("DMARKS", Listed::Entity(EntityKind::DraftMark)),
    ("DMARK", Listed::Entity(EntityKind::DraftMark)),
    ("SENSORS", Listed::Sensors),
    ("SENSOR", Listed::Sensors),
    ("ASSEMBLIES", Listed::Entity(EntityKind::Assembly)),
    ("ASSEMBLY", Listed::Entity(EntityKind::Assembly)),
    ("LOAD_GROUPS", Listed::LoadGroups),
    ("LOAD_GROUP", Listed::LoadGroups),
    ("CATEGORIES", Listed::Categories),
    ("CATEGORY", Listed::Categories),
    ("PROCESSES", Listed::Processes),
    ("PROCESS", Listed::Processes),
    ("SHAPES", Listed::Shapes),
    ("SHAPE", Listed::Shapes),
    ("PI_VIEWS", Listed::Views),
    ("PI_VIEW", Listed::Views),
];

/// The value of `&NAMES(KIND patterns)`.
pub(super) fn names(job: &Job, kind: &Word, rest: &[Word]) -> Outcome<String> {
    let model = &job.model;
    let known = KINDS.iter().map(|(word, listed)| (*word, Owner::Moses, *listed));
    let all = list(job, choose(&kind.text, kind.span, "kind of &NAMES", known)?);
    let fits = |name: &&str| {
        rest.is_empty()
            || rest.iter().any(|w| match model.selectors.get(&Model::key(&w.text)) {
                Some(selector) => selector.matches(name, model),
                None => matches(&w.text, name),
            })
    };
    Ok(all.into_iter().filter(fits).collect::<Vec<_>>().join(" "))
}

/// The names of what a word lists, each once, in the order of their records.
fn list(job: &Job, listed: Listed) -> IndexSet<&str> {
    let model = &job.model;
    let pieces = || model.parts.values().flat_map(|part| &part.pieces);
    match listed {
        Listed::Entity(kind) => model.names(kind).into_iter().collect(),
        // each body and part has one of its name
        Listed::LoadGroups => {
            let own = model.names(EntityKind::Part).into_iter();
            own.chain(model.load_groups.values().map(|group| group.name.as_str())).collect()
        }
        Listed::Holes => model.holes.values().map(|hole| hole.name.as_str()).collect(),
        Listed::Sensors => model.sensors.values().map(|sensor| sensor.name.as_str()).collect(),
        Listed::Categories => {
            let weights = model.parts.values().flat_map(|part| &part.weights).map(|weight| weight.category.as_str());
            let loads = model.loads.iter().map(|load| load.category.as_str());
            weights.chain(pieces().filter_map(|piece| piece.category.as_deref())).chain(loads).collect()
        }
        Listed::Elements => {
            let members = pieces().filter_map(|piece| piece.element.as_ref()).map(|element| element.name.as_str());
            model.names(EntityKind::Connector).into_iter().chain(members).collect()
        }
        Listed::Shapes => job.shapes.keys().map(String::as_str).collect(),
        Listed::Processes => process::names(job).map(|(name, _)| name).collect(),
        Listed::Views => IndexSet::new(),
    }
}
