//! What things are called: the sorts of things that have names, which names are taken, and what uses a thing.
//!
//! Connectors, bodies, parts, pieces, curves, bathymetries, sets of T_PRESSURE data, draft marks and environments share one set of names, so that a name means one thing;
//! classes, points and selectors are distinguished by their markers. A body and its own part have one name, and a piece may have
//! that of its body or part.

use super::{Assembly, AssemblyKind, CurveReference, DraftMark, Environment, LOOSE_SURFACES, Model, Piece};
use windlass_base::diagnostic::with_article;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::values::Noun;

/// A sort of thing that has a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EntityKind {
    /// A connector.
    Connector,
    /// A class.
    Class,
    /// A point.
    Point,
    /// A body.
    Body,
    /// An assembly.
    Assembly,
    /// A part.
    Part,
    /// A piece of a hull.
    Piece,
    /// An interior compartment.
    Compartment,
    /// An environment kept under a name.
    Environment,
    /// A curve.
    Curve,
    /// A bottom over a grid.
    Bathymetry,
    /// What pipes hold.
    Filling,
    /// A draft mark.
    DraftMark,
    /// A selector.
    Selector,
}

impl EntityKind {
    /// All sorts.
    pub const ALL: [EntityKind; 14] = [
        EntityKind::Connector,
        EntityKind::Class,
        EntityKind::Point,
        EntityKind::Assembly,
        EntityKind::Body,
        EntityKind::Part,
        EntityKind::Piece,
        EntityKind::Compartment,
        EntityKind::Environment,
        EntityKind::Curve,
        EntityKind::Bathymetry,
        EntityKind::Filling,
        EntityKind::DraftMark,
        EntityKind::Selector,
    ];

    /// The word for it.
    pub const fn word(self) -> &'static str {
        match self {
            EntityKind::Connector => "connector",
            EntityKind::Class => "class",
            EntityKind::Point => "point",
            EntityKind::Assembly => "assembly",
            EntityKind::Body => "body",
            EntityKind::Part => "part",
            EntityKind::Piece => "piece",
            EntityKind::Compartment => "compartment",
            EntityKind::Environment => "environment",
            EntityKind::Curve => "curve",
            EntityKind::Bathymetry => "bathymetry",
            EntityKind::Filling => "set of T_PRESSURE data",
            EntityKind::DraftMark => "draft mark",
            EntityKind::Selector => "selector",
        }
    }
}

/// The sorts without a marker, which share one set of names.
const UNMARKED: [EntityKind; 11] = [
    EntityKind::Connector,
    EntityKind::Assembly,
    EntityKind::Body,
    EntityKind::Part,
    EntityKind::Piece,
    EntityKind::Compartment,
    EntityKind::Environment,
    EntityKind::Curve,
    EntityKind::Bathymetry,
    EntityKind::Filling,
    EntityKind::DraftMark,
];

impl Model {
    /// The names of one sort, as written, in the order of their definition.
    pub fn names(&self, thing: EntityKind) -> Vec<&str> {
        match thing {
            EntityKind::Connector => self.connectors.values().map(|c| c.name.as_str()).collect(),
            EntityKind::Class => self.classes.values().map(|c| c.name.as_str()).collect(),
            EntityKind::Point => self.points.values().map(|p| p.name.as_str()).collect(),
            EntityKind::Assembly => self.assemblies.values().map(|a| a.name.as_str()).collect(),
            EntityKind::Body => self.bodies.values().map(|b| b.name.as_str()).collect(),
            EntityKind::Part => {
                self.parts.values().map(|p| p.name.as_str()).filter(|name| *name != LOOSE_SURFACES).collect()
            }
            EntityKind::Piece => self.parts.values().flat_map(|p| p.pieces.iter().map(|s| s.name.as_str())).collect(),
            EntityKind::Compartment => self.compartments.values().map(|c| c.name.as_str()).collect(),
            EntityKind::Environment => self.environments.values().map(|e| e.name.as_str()).collect(),
            EntityKind::Curve => self.curves.values().map(|c| c.name.as_str()).collect(),
            EntityKind::Bathymetry => self.bathymetries.values().map(|b| b.name.as_str()).collect(),
            EntityKind::Filling => self.fillings.values().map(|f| f.name.as_str()).collect(),
            EntityKind::DraftMark => self.draft_marks.values().map(|m| m.name.as_str()).collect(),
            EntityKind::Selector => self.selectors.values().map(|s| s.name.as_str()).collect(),
        }
    }

    /// Everything that has a name, each with its sort; a body's own part goes with the body, and so does a piece of its name; the
    /// hook of an assembly goes with it.
    pub fn things(&self) -> Vec<(EntityKind, &str)> {
        let list = EntityKind::ALL.into_iter().flat_map(|t| self.names(t).into_iter().map(move |name| (t, name)));
        let taken = |thing: EntityKind, name: &str| match thing {
            EntityKind::Body => self.assemblies.contains_key(&Model::key(name)),
            EntityKind::Point => {
                name.strip_prefix('*').is_some_and(|own| self.assemblies.contains_key(&Model::key(own)))
            }
            EntityKind::Part => self.bodies.contains_key(&Model::key(name)),
            EntityKind::Piece => {
                self.parts.contains_key(&Model::key(name)) || self.compartments.contains_key(&Model::key(name))
            }
            _ => false,
        };
        list.filter(|(thing, name)| !taken(*thing, name)).collect()
    }

    /// Where a thing was defined; `None` when there is no such thing.
    pub fn definition_span(&self, thing: EntityKind, name: &str) -> Option<Span> {
        let key = Model::key(name);
        match thing {
            EntityKind::Connector => self.connectors.get(&key).map(|c| c.span),
            EntityKind::Class => self.classes.get(&key).map(|c| c.span),
            EntityKind::Point => self.points.get(&key).map(|p| p.span),
            EntityKind::Assembly => self.assemblies.get(&key).map(|a| a.span),
            EntityKind::Body => self.bodies.get(&key).map(|b| b.span),
            EntityKind::Part => self.parts.get(&key).map(|p| p.span),
            EntityKind::Piece => self.piece(name).map(|(_, piece)| piece.span),
            EntityKind::Compartment => self.compartments.get(&key).map(|c| c.span),
            EntityKind::Environment => self.environments.get(&key).map(|e| e.span),
            EntityKind::Curve => self.curves.get(&key).map(|c| c.span),
            EntityKind::Bathymetry => self.bathymetries.get(&key).map(|b| b.span),
            EntityKind::Filling => self.fillings.get(&key).map(|f| f.span),
            EntityKind::DraftMark => self.draft_marks.get(&key).map(|m| m.span),
            EntityKind::Selector => self.selectors.get(&key).map(|s| s.span),
        }
    }

    /// Sees that a name without a marker is no other thing's; a thing of one of the sorts `mine` may have it already.
    ///
    /// # Errors
    /// A name that is taken, with the place of its definition.
    pub fn free_name(&self, name: &str, mine: &[EntityKind], span: Span) -> Outcome<()> {
        if mine.iter().any(|thing| self.definition_span(*thing, name).is_some()) {
            return Ok(());
        }
        match UNMARKED.into_iter().find_map(|thing| self.definition_span(thing, name).map(|position| (thing, position))) {
            None => Ok(()),
            Some((thing, position)) => {
                Err(Diagnostic::error(format!("{name} is the name of {} already", with_article(thing.word())), span)
                    .other(position, "defined here")
                    .help("connectors, bodies, parts, pieces, curves, bathymetries, T_PRESSURE data, draft marks and environments all have different names"))
            }
        }
    }

    /// The names of what cannot do without a thing.
    pub fn users(&self, thing: EntityKind, name: &str) -> Vec<&str> {
        let key = Model::key(name);
        match thing {
            EntityKind::Class => {
                let made_of =
                    |a: &&Assembly| matches!(&a.kind, AssemblyKind::Pipe { class, .. } if Model::key(class) == key);
                let pipes = self.assemblies.values().filter(made_of).map(|a| a.name.as_str());
                self.users_of_class(name).into_iter().chain(pipes).collect()
            }
            EntityKind::Point => {
                let on_it = |mark: &&DraftMark| mark.points.iter().any(|p| Model::key(p) == key);
                let marks = self.draft_marks.values().filter(on_it).map(|m| m.name.as_str());
                self.users_of_point(name).into_iter().chain(marks).collect()
            }
            EntityKind::Body => {
                let own = self.points.values().filter(|p| self.body_of(p).is_some_and(|b| Model::key(&b.name) == key));
                own.flat_map(|p| self.users_of_point(&p.name)).collect()
            }
            EntityKind::Part => {
                self.points.values().filter(|p| Model::key(&p.part) == key).map(|p| p.name.as_str()).collect()
            }
            EntityKind::Curve => self.users_of_curve(&key),
            EntityKind::Bathymetry => self.environments_with(|e| e.bathymetry.as_ref(), &key),
            EntityKind::Filling => self.environments_with(|e| e.filling.as_ref(), &key),
            EntityKind::Selector => {
                let names = |list: &[String]| list.iter().any(|n| Model::key(n) == key);
                let users = self.selectors.values().filter(|s| names(&s.select) || names(&s.except));
                users.map(|s| s.name.as_str()).collect()
            }
            EntityKind::Connector => self.assembly_of(name).map(|a| a.name.as_str()).into_iter().collect(),
            EntityKind::Environment
            | EntityKind::Piece
            | EntityKind::Compartment
            | EntityKind::Assembly
            | EntityKind::DraftMark => Vec::new(),
        }
    }

    /// The environments that name a thing of this key, the one in force last.
    fn environments_with(&self, of: impl Fn(&Environment) -> Option<&CurveReference>, key: &str) -> Vec<&str> {
        let uses = |e: &&Environment| of(e).is_some_and(|named| Model::key(&named.kind) == key);
        let kept = self.environments.values().filter(uses).map(|e| e.name.as_str());
        kept.chain(uses(&&self.environment).then_some("the environment in force")).collect()
    }

    fn users_of_curve(&self, key: &str) -> Vec<&str> {
        let uses = |mut curves: Box<dyn Iterator<Item = &str> + '_>| curves.any(|c| Model::key(c) == key);
        let classes = self.classes.values().filter(|class| {
            let options = class.records.iter().flat_map(|r| r.args.options.iter());
            uses(Box::new(options.flat_map(|g| g.names(Noun::Curve)).filter_map(|v| v.word())))
        });
        let kept = self.environments.values().filter(|e| uses(e.curves())).map(|e| e.name.as_str());
        let kept_by = |piece: &&Piece| {
            let curves = piece.kept.iter().flat_map(|g| g.names(Noun::Curve)).filter_map(|v| v.word());
            uses(Box::new(curves))
        };
        let pieces = self.parts.values().flat_map(|p| p.pieces.iter()).filter(kept_by).map(|p| p.name.as_str());
        let in_force = uses(self.environment.curves()).then_some("the environment in force");
        classes.map(|c| c.name.as_str()).chain(kept).chain(pieces).chain(in_force).collect()
    }
}
