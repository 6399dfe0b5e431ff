//! `&APPLY`: multipliers of loads.
//!
//! Source: [MOSES-HELP general, modeling]: multipliers compound.

use crate::commands::{Call, Command, Effect, Job};
use windlass_base::choice::Choice;
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome, did_you_mean};
use windlass_base::units::Dim;
use windlass_base::values::{Given, Value};
use windlass_base::wildcard::matches;
use windlass_hydro::Category;
use windlass_language::number::evaluate;
use windlass_language::select::choose_word;
use windlass_language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec};
use windlass_model::{Attribute, AttributeMultiplier, EntityKind, Model, Multipliers, SolveKind, UnmodelledEffect};

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

choices! {
    /// Attributes of load categories that have a multiplier.
    enum AttributeWord {
        Dead = "#DEAD",
        Buoyancy = "#BUOY",
        Wind = "#WIND",
        Drag = "#DRAG",
        AddedMass = "#AMASS",
    }
}

impl AttributeWord {
    fn attribute(self) -> Attribute {
        match self {
            AttributeWord::Dead => Attribute::Dead,
            AttributeWord::Buoyancy => Attribute::Buoyancy,
            AttributeWord::Wind => Attribute::Wind,
            AttributeWord::Drag => Attribute::Drag,
            AttributeWord::AddedMass => Attribute::AddedMass,
        }
    }
}

/// The word of an attribute.
pub fn attribute_word(attribute: Attribute) -> &'static str {
    AttributeWord::ALL.iter().find(|word| word.attribute() == attribute).map_or("", |word| word.word())
}

const WORDS: &[ValueSpec] = &[ValueSpec::new(
    "WORD",
    Kind::Item,
    "a selector of load categories, then #ATTRIBUTE VALUE ..; or VALUE, of all attributes",
)];
const GROUPS: &[ValueSpec] =
    &[ValueSpec::new("WORD", Kind::Item, "a selector of load groups and VALUE, in turn; without it nothing")
        .or("nothing")];
const FORCES: &[ValueSpec] =
    &[ValueSpec::new("CATEGORY", Kind::Item, "WIND, V_DRAG or W_DRIFT, or the #SET of a set of forces"), VALUE];

const FRACTION: OptionSpec =
    OptionSpec::new("-FRACTION", GROUPS, "values are fractions; values of its own are those of load groups")
        .repeating(1)
        .default("as with -FRACTION");
const PERCENT: OptionSpec =
    OptionSpec::new("-PERCENT", GROUPS, "values are percent; values of its own are those of load groups").repeating(1);
const CATEGORY_OPTION: OptionSpec =
    OptionSpec::new("-CATEGORY", WORDS, "multipliers of attributes of load categories").repeating(1).many();
const FORCE: OptionSpec =
    OptionSpec::new("-FORCE", FORCES, "multiplier of a category of force; that of a #SET stops the next solve").many();
const LOAD_GROUP: OptionSpec =
    OptionSpec::new("-LOAD_GROUP", GROUPS, "multipliers of load groups; each body and part has one of its name")
        .repeating(1)
        .many();
const MARGIN: OptionSpec = OptionSpec::new(
    "-MARGIN",
    &[ValueSpec::new("WORD", Kind::Item, "a selector of load categories and a percent, in turn")],
    "what is added to the weights of load categories, in percent whatever the values of other options are",
)
.repeating(1)
.many();

static SPEC: CommandSpec = CommandSpec {
    options: &[FRACTION, PERCENT, CATEGORY_OPTION, FORCE, LOAD_GROUP, MARGIN],
    detail: "Each record sets multipliers anew; a load has the product of that of its force category, of its load group and of its load category: 0.5 of \
             two leave a quarter. -CATEGORY names load categories (-CATEGORY of #WEIGHT, #AREA ..; EXTRA where none was given) by a name, a \
             pattern or a selector, and attributes: #DEAD weights, with their inertia, #BUOY the buoyancy of #BUOY and of members, with the pressure of waves on them, #WIND, #DRAG current, linear drag and damping, \
             #AMASS added mass; a value without attribute is that of all. BEAM and PLATE are of category STR_MODEL, TUBE of EXTRA, unless their records say; hulls of other pieces are of none. Of several that fit a load the last counts. -FORCE acts on all wind \
             (WIND), current (V_DRAG) or mean wave drift (W_DRIFT). -CATEGORY WIND 50 is read as -FORCE WIND 50. A load group \
             multiplies its weights too; that of a part its members. A -FORCE of a #SET, which no record here defines, stops the next solve unless it is 0. -PERCENT @ 100 sets all load groups. -MARGIN STR@ 6 adds 6 % to the weights of the \
             categories that fit, for mill tolerance and weld metal, beside their multipliers (our reading).",
    example: "MEDIT\n&DESCRIBE BODY TBRG\n*CG 200 0 8\n#WEIGHT *CG 100 -CATEGORY STEEL\nEND\n\
              &APPLY -PERCENT -CATEGORY @ #DEAD 110 #BUOY 100 -CATEGORY STEEL #DEAD 105 #BUOY 100\n\
              &APPLY -PERCENT -FORCE WIND 50 -LOAD_GROUP TBRG 120\n&STATUS LOADS",
    ..CommandSpec::new("&APPLY", "sets multipliers of loads")
};

/// A multiplier among the words of an option.
fn multiplier(value: &Value, unit: f64) -> Outcome<f64> {
    let word = value.word().unwrap_or_default();
    match evaluate(word) {
        Ok(number) if number.abs() <= 1e6 => Ok(number * unit),
        Ok(_) => Err(Diagnostic::error("a multiplier is between -1000000 and 1000000", value.span)),
        Err(_) => Err(Diagnostic::error(format!("expected a multiplier, not {word}"), value.span)),
    }
}

/// Pairs of a selector of load groups and a value.
fn set_groups(job: &Job, made: &mut Multipliers, given: &Given, unit: f64) -> Outcome<()> {
    let model = &job.model;
    for pair in given.values.chunks(2) {
        let [name, value] = pair else {
            let lacking = pair.first().filter(|v| v.word().is_some());
            return lacking.map_or(Ok(()), |name| {
                Err(Diagnostic::error(format!("{} lacks its value", name.word().unwrap_or_default()), name.span))
            });
        };
        let word = name.word().unwrap_or_default();
        let factor = multiplier(value, unit)?;
        let known: Vec<&str> = model
            .names(EntityKind::Part)
            .into_iter()
            .chain(model.load_groups.values().map(|g| g.name.as_str()))
            .collect();
        let fits = |group: &&&str| match model.selectors.get(&Model::key(word)) {
            Some(selector) => selector.matches(group, model),
            None => matches(word, group),
        };
        let chosen: Vec<String> = known.iter().filter(fits).map(|group| Model::key(group)).collect();
        if chosen.is_empty() && word != "@" {
            let mut error = Diagnostic::error(format!("unknown part or load group {word}"), name.span);
            error.help.extend(did_you_mean(word, known.iter().copied()));
            return Err(error);
        }
        made.parts.extend(chosen.into_iter().map(|group| (group, factor)));
    }
    Ok(())
}

/// A selector of load categories, and attributes with their values.
fn set_categories(made: &mut Multipliers, given: &Given, unit: f64) -> Outcome<()> {
    let [name, rest @ ..] = given.values.as_slice() else { return Ok(()) };
    let categories = Model::key(name.word().unwrap_or_default());
    if let ([value], Some(force)) = (rest, LoadCategory::from_word(&categories)) {
        made.categories.insert(force.category().name().to_string(), multiplier(value, unit)?);
        return Ok(());
    }
    if rest.is_empty() {
        return Err(Diagnostic::error(format!("-CATEGORY {categories} lacks #ATTRIBUTE VALUE"), name.span));
    }
    if let [value] = rest {
        let factor = multiplier(value, unit)?;
        made.attributes.push(AttributeMultiplier { categories, attribute: None, factor });
        return Ok(());
    }
    for pair in rest.chunks(2) {
        let [word, value] = pair else {
            let at = pair.first().map_or(given.span, |v| v.span);
            return Err(Diagnostic::error("an attribute lacks its value", at));
        };
        let chosen: AttributeWord =
            choose_word(word.word().unwrap_or_default(), word.span, "attribute of a load category")?;
        let factor = multiplier(value, unit)?;
        made.attributes.push(AttributeMultiplier {
            categories: categories.clone(),
            attribute: Some(chosen.attribute()),
            factor,
        });
    }
    Ok(())
}

/// Pairs of a selector of load categories and a percent of their weights.
fn set_margins(made: &mut Multipliers, given: &Given) -> Outcome<()> {
    for pair in given.values.chunks(2) {
        let [name, value] = pair else {
            let lacking = pair.first().map_or(given.span, |v| v.span);
            return Err(Diagnostic::error("a load category of -MARGIN lacks its percent", lacking));
        };
        let factor = 1.0 + multiplier(value, 0.01)?;
        if factor < 0.0 {
            return Err(Diagnostic::error("a margin below -100 % leaves a negative weight", value.span));
        }
        let categories = Model::key(name.word().unwrap_or_default());
        made.margins.push(AttributeMultiplier { categories, attribute: Some(Attribute::Dead), factor });
    }
    Ok(())
}

/// Whether a category, a pattern or a selector chooses a category of a load, or is that of a force.
fn is_known(model: &Model, word: &str) -> bool {
    if LoadCategory::from_word(&Model::key(word)).is_some() {
        return true;
    }
    let of_parts = model.parts.values().flat_map(|part| {
        part.weights.iter().map(|w| w.category.as_str()).chain(part.pieces.iter().filter_map(|p| p.category.as_deref()))
    });
    let mut all = of_parts.chain(model.loads.iter().map(|load| load.category.as_str()));
    match model.selectors.get(&Model::key(word)) {
        Some(selector) => all.any(|category| selector.matches(category, model)),
        None => all.any(|category| matches(word, category)),
    }
}

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let unit = match (args.option(&FRACTION), args.option(&PERCENT)) {
        (Some(_), Some(given)) => {
            return Err(Diagnostic::error("-FRACTION and -PERCENT contradict each other", given.span));
        }
        (_, Some(_)) => 0.01,
        _ => 1.0,
    };
    let mut made = job.model.multipliers.clone();
    if args.options.iter().any(|given| given.is(&CATEGORY_OPTION)) {
        made.attributes.clear();
    }
    if args.has(&MARGIN) {
        made.margins.clear();
    }
    let mut sets = Vec::new();
    for given in &args.options {
        match given {
            _ if given.is(&CATEGORY_OPTION) => set_categories(&mut made, given, unit)?,
            _ if given.is(&MARGIN) => set_margins(&mut made, given)?,
            _ if given.is(&FORCE) => {
                let value = given.number(const { FORCE.number("VALUE") }).unwrap_or_default();
                let word = given.first_word().unwrap_or_default();
                if word.starts_with('#') {
                    sets.push((word, value, given.span));
                } else {
                    let chosen: LoadCategory = choose_word(word, given.first_place(), "category of force")?;
                    made.categories.insert(chosen.category().name().to_string(), value * unit);
                }
            }
            _ => set_groups(job, &mut made, given, unit)?,
        }
    }
    for (word, value, span) in sets {
        let record = format!("&APPLY -FORCE {}", word.to_ascii_uppercase());
        job.model.unmodelled.retain(|kept| kept.record != record);
        if value != 0.0 {
            let effect = "a set of forces on points".to_string();
            let kept = UnmodelledEffect { record, effect, matters_to: SolveKind::Statics, span };
            job.warn(format!("not computed: {}; solves it matters to will stop", kept.sentence()), span);
            job.model.keep_unmodelled(kept);
        }
    }
    for given in args.options.iter().filter(|given| given.is_any(&[CATEGORY_OPTION, MARGIN])) {
        if let Some(word) = given.first_word().filter(|word| *word != "@" && !is_known(&job.model, word)) {
            job.warn(format!("no load is of category {word}: its multipliers wait for one"), given.first_place());
        }
    }
    job.model.multipliers = made;
    job.model.refresh_weight_multipliers();
    Ok(Effect::Done)
}
