//! `&APPLY`: multipliers of loads.
//!
//! Source: [MOSES-HELP general, modeling]: multipliers compound.

use crate::commands::{Call, Command, Effect};
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::units::Dim;
use windlass_base::values::Noun;
use windlass_hydro::Category;
use windlass_language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec};
use windlass_model::{Model, find};

/// &APPLY.
pub static APPLY: Command = Command { spec: &SPEC, edits: false, run };

const VALUE: ValueSpec = ValueSpec::new("VALUE", Kind::Number(Dim::None), "multiplier").in_range(-1e6, 1e6);

choices! {
    /// Categories of force that have a multiplier.
    enum LoadCategory {
        Wind = "WIND",
        ViscousDrag = "V_DRAG",
        WaveDrift = "W_DRIFT",
    }
}

impl LoadCategory {
    fn category(self) -> Category {
        match self {
            LoadCategory::Wind => Category::Wind,
            LoadCategory::ViscousDrag => Category::ViscousDrag,
            LoadCategory::WaveDrift => Category::WaveDrift,
        }
    }
}

const CATEGORY: &[ValueSpec] = &[ValueSpec::choice::<LoadCategory>("CATEGORY", "category of force"), VALUE];

const FRACTION: OptionSpec = OptionSpec::new("-FRACTION", &[], "values are fractions").default("as with -FRACTION");
const PERCENT: OptionSpec = OptionSpec::new("-PERCENT", &[], "values are percent");
const CATEGORY_OPTION: OptionSpec = OptionSpec::new("-CATEGORY", CATEGORY, "multiplier of a category of force").many();
const FORCE: OptionSpec = OptionSpec::new("-FORCE", CATEGORY, "the same as -CATEGORY").many();
const LOAD_GROUP: OptionSpec = OptionSpec::new(
    "-LOAD_GROUP",
    &[ValueSpec::new("PART", Kind::Name(Noun::Part), "body or part: each has a group of its name"), VALUE],
    "multiplier of the loads of a part",
)
.many();

static SPEC: CommandSpec = CommandSpec {
    options: &[FRACTION, PERCENT, CATEGORY_OPTION, FORCE, LOAD_GROUP],
    detail: "Each record sets multipliers anew; a load has the product of that of its category and that of its part: 0.5 of \
             both leave a quarter. They act on wind (WIND), current (V_DRAG) and mean wave drift (W_DRIFT); the other \
             categories have no multiplier yet. The sources do not tell -CATEGORY and -FORCE apart.",
    example: "&DESCRIBE BODY TBRG\n&APPLY -PERCENT -FORCE WIND 50 -LOAD_GROUP TBRG 120\n&STATUS LOADS",
    ..CommandSpec::new("&APPLY", "sets multipliers of loads")
};

fn run(job: &mut crate::commands::Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let unit = match (args.has(&FRACTION), args.option(&PERCENT)) {
        (true, Some(given)) => {
            return Err(Diagnostic::error("-FRACTION and -PERCENT contradict each other", given.span));
        }
        (_, Some(_)) => 0.01,
        _ => 1.0,
    };
    let mut made = job.model.multipliers.clone();
    for given in &args.options {
        if given.is_any(&[FRACTION, PERCENT]) {
            continue;
        }
        let Some(value) = given.number(const { FORCE.number("VALUE") }) else { continue };
        if given.is(&LOAD_GROUP) {
            let name = given.word(const { LOAD_GROUP.word("PART") }).unwrap_or_default();
            find(&job.model.parts, name, "part", given.first_place())?;
            made.parts.insert(Model::key(name), value * unit);
        } else if let Some(chosen) = given.choice::<LoadCategory>(const { FORCE.choice("CATEGORY") }) {
            made.categories.insert(chosen.category().name().to_string(), value * unit);
        }
    }
    job.model.multipliers = made;
    Ok(Effect::Done)
}
