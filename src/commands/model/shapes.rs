//! `&DATA SHAPES`: sections under a name, which a class names instead of a type.
//!
//! Source: [MOSES-REF cls_shp].

use crate::commands::{Effect, Job};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::values::Args;
use windlass_connectors::{SECTIONS, SectionKind, class_specs};
use windlass_language::args;
use windlass_language::name as rule;
use windlass_language::record::Word;
use windlass_language::select::choose;
use windlass_model::{ClassRecord, Model};

/// A section under a name.
#[derive(Clone)]
pub struct SectionShape {
    /// Its type.
    pub kind: &'static SectionKind,
    args: Args,
}

impl std::fmt::Debug for SectionShape {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SectionShape").field("kind", &self.kind.spec.name).field("args", &self.args).finish()
    }
}

impl SectionShape {
    /// Its record with the options of a class behind its own.
    pub fn with_options(self, class: Args) -> Args {
        let own =
            self.args.options.into_iter().filter(|given| !class.options.iter().any(|other| other.is(given.option)));
        let options = own.chain(class.options.iter().cloned()).collect();
        Args { options, span: class.span, ..self.args }
    }
}

/// Takes a record of the menu of `&DATA SHAPES`: NAME TYPE A B .. -OPTIONS.
///
/// # Errors
/// A name that cannot be one or is a type; an unknown type; dimensions that make no section.
pub fn take_shape(job: &mut Job, words: &[Word]) -> Outcome<Effect> {
    let [name, rest @ ..] = words else { return Ok(Effect::Done) };
    rule::check(&name.text, None, "shape", name.span)?;
    let Some(kind) = rest.first() else {
        return Err(Diagnostic::error(format!("shape {} lacks its type", name.text), name.span)
            .help("form: NAME TYPE A B .. -OPTIONS"));
    };
    if class_specs().any(|spec| spec.name.eq_ignore_ascii_case(&name.text)) {
        return Err(Diagnostic::error(format!("{} is a class type", name.text), name.span));
    }
    let kind =
        choose(&kind.text, kind.span, "type of section", SECTIONS.iter().map(|k| (k.spec.name, k.spec.owner, *k)))?;
    let args = args::read(kind.spec, name.span, rest.get(1..).unwrap_or_default(), job.units)?;
    (kind.read)(&ClassRecord { args: args.clone(), defaults: job.model.defaults })?;
    job.shapes.insert(Model::key(&name.text), SectionShape { kind, args });
    Ok(Effect::Done)
}
