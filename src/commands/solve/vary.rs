//! `TABLE LINE -VARY`: what a line does for each of several values of one parameter.

use crate::commands::Job;
use crate::commands::name_filter::merge_remarks;
use crate::report::format::number_in_full;
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::table::{Digits, Table};
use windlass_base::units::{Dim, UnitSystem};
use windlass_base::values::{Args, Given};
use windlass_language::select::Owner;
use windlass_language::spec::{Kind, OptionSpec, ValueSpec};
use windlass_model::{Class, ClassError, Condition, Connector, Idealisation, LineChange, LineConfiguration, Placement};

/// -VARY.
pub const VARY: OptionSpec = OptionSpec::new(
    "-VARY",
    &[
        ValueSpec::choice::<Parameter>("NAME", "what is varied"),
        ValueSpec::new("V", Kind::Number(Dim::None), "value (user units); of WEIGHT and STIFFNESS a factor"),
    ],
    "one row a value of this parameter",
)
.repeating(1)
.owner(Owner::Ours);

choices! {
    /// What can be varied.
    enum Parameter {
        Length = "LENGTH",
        Fairlead = "FAIRLEAD",
        Depth = "DEPTH",
        Friction = "FRICTION",
        Slope = "SLOPE",
        Weight = "WEIGHT",
        Stiffness = "STIFFNESS",
        Distance = "DISTANCE",
        Horizontal = "HORIZONTAL",
        Tension = "TENSION",
    }
}

impl Parameter {
    /// Name in heads.
    fn name(self) -> &'static str {
        match self {
            Parameter::Length => "Length",
            Parameter::Fairlead => "Fairlead",
            Parameter::Depth => "Depth",
            Parameter::Friction => "Friction",
            Parameter::Slope => "Slope",
            Parameter::Weight => "Weight",
            Parameter::Stiffness => "Stiffness",
            Parameter::Distance => "Distance",
            Parameter::Horizontal => "Horizontal",
            Parameter::Tension => "Tension",
        }
    }

    fn dim(self) -> Dim {
        match self {
            Parameter::Length | Parameter::Fairlead | Parameter::Depth | Parameter::Distance => Dim::Length,
            Parameter::Friction | Parameter::Slope | Parameter::Weight | Parameter::Stiffness => Dim::None,
            Parameter::Horizontal | Parameter::Tension => Dim::Force,
        }
    }

    /// Whether it says itself in which configuration the line is.
    fn is_condition(self) -> bool {
        matches!(self, Parameter::Distance | Parameter::Horizontal | Parameter::Tension)
    }

    /// What it changes of the line itself.
    fn change(self, value: f64) -> Option<LineChange> {
        match self {
            Parameter::Friction => Some(LineChange::Friction(value)),
            Parameter::Slope => Some(LineChange::Slope(value)),
            Parameter::Weight => Some(LineChange::Weight(value)),
            Parameter::Stiffness => Some(LineChange::Stiffness(value)),
            _ => None,
        }
    }

    /// What its values must be where a value is not.
    fn lacks(self, value: f64) -> Option<&'static str> {
        match self {
            Parameter::Fairlead | Parameter::Slope => None,
            Parameter::Distance | Parameter::Friction => (value < 0.0).then_some("zero or more"),
            _ => (value <= 0.0).then_some("greater than zero"),
        }
    }
}

/// A warning about a value, at its place.
type Missing = Vec<(String, Span)>;

/// The table of a connector for the values of -VARY, and a warning for each of them that has no configuration.
///
/// # Errors
/// A value out of range, a condition beside a parameter that is one itself, no configuration for any of the values.
pub fn tabulate(
    job: &Job,
    (connector, class): (&Connector, &Class),
    vary: &Given,
    held: Condition,
    args: &Args,
) -> Outcome<(Table, Missing)> {
    let parameter = vary.choice(const { VARY.choice("NAME") });
    let parameter: Parameter = parameter.ok_or_else(|| Diagnostic::error("-VARY lacks its NAME", vary.span))?;
    let (unit, around) = (parameter.dim().label(job.units), job.model.surroundings());
    let position = job.model.placement(connector);
    if parameter.is_condition()
        && let Some(other) = args.options.iter().find(|given| !given.is(vary.option))
    {
        let text = format!("{} cannot hold while the {} is varied", other.name(), parameter.name().to_lowercase());
        return Err(Diagnostic::error(text, other.span).other(vary.span, "varied here"));
    }
    let (mut rows, mut notes, mut missing) = (Vec::new(), Vec::new(), Missing::new());
    let mut first: Option<(ClassError, Span)> = None;
    for (given, span) in vary.values.iter().filter_map(|v| Some((v.number()?, v.span))) {
        let value = value(parameter, given, span, job)?;
        let named = format!("{} {} {unit}", parameter.name(), number_in_full(given));
        let (position, condition) = apply(parameter, value, &position, held);
        let line = class.line(&position, &around);
        let line = match parameter.change(value) {
            Some(change) => line.and_then(|l| l.with_change(change)),
            None => line,
        };
        let found = line.and_then(|line| line.configuration(condition));
        match found {
            Ok(found) => {
                notes.push((named, found.notes.iter().map(|note| note.for_table(job.units)).collect()));
                rows.push((value, Some(found)));
            }
            Err(error) => {
                missing.push((format!("{named}: {}", error.text(job.units)), span));
                first = first.or(Some((error, span)));
                rows.push((value, None));
            }
        }
    }
    if let (true, Some((error, span))) = (notes.is_empty(), first) {
        return Err(to_diagnostic(error, span, connector, job.units));
    }
    let mut table = with_columns(facts(parameter, class, connector, &position, held), parameter, &rows);
    table.notes = merge_remarks(&notes);
    if position.bathymetry.is_some() && matches!(parameter, Parameter::Depth | Parameter::Slope) {
        table.note("the line lies on a plane through its anchor here, not on the bathymetry");
    }
    table.add_notes(missing.iter().map(|(text, _)| text.clone()));
    table.absent = missing.len();
    Ok((table, missing))
}

/// The error when none of the values has a configuration.
fn to_diagnostic(error: ClassError, span: Span, connector: &Connector, units: UnitSystem) -> Box<Diagnostic> {
    error
        .diagnostic(span, units)
        .help(format!("connector {} has a configuration for none of the values", connector.name))
}

/// A value (user units) in SI.
fn value(parameter: Parameter, given: f64, span: Span, job: &Job) -> Outcome<f64> {
    let name = parameter.name().to_uppercase();
    let si = parameter.dim().checked_si(given, job.units).map_err(|error| {
        Diagnostic::error(format!("a value of -VARY {name} is too {}", error.size()), span).label(error.to_string())
    })?;
    match parameter.lacks(given) {
        Some(want) => Err(Diagnostic::error(format!("a value of -VARY {name} must be {want}"), span)
            .label(format!("this is {given}"))),
        None => Ok(si),
    }
}

/// Where the ends are, and the configuration, with a value of the parameter.
fn apply(parameter: Parameter, value: f64, position: &Placement, held: Condition) -> (Placement, Condition) {
    let [x, y, _] = position.fairlead;
    let position = position.clone();
    match parameter {
        Parameter::Length => (Placement { first_length: Some(value), ..position }, held),
        Parameter::Fairlead => (Placement { fairlead: [x, y, value], ..position }, held),
        Parameter::Depth => {
            let other = position.other.map(|[x, y, _]| [x, y, -value]);
            (Placement { other, bathymetry: None, ..position }, held)
        }
        Parameter::Friction | Parameter::Slope | Parameter::Weight | Parameter::Stiffness => (position, held),
        Parameter::Distance => (position, Condition::Distance(value)),
        Parameter::Horizontal => (position, Condition::Horizontal(value)),
        Parameter::Tension => (position, Condition::Tension(value)),
    }
}

/// The table without columns: what is varied, what is held.
fn facts(parameter: Parameter, class: &Class, connector: &Connector, position: &Placement, held: Condition) -> Table {
    let [_, _, fairlead] = position.fairlead;
    let title = format!("Line {} with Varied {}", connector.name, parameter.name());
    let mut table = Table::new(title).fact("Model", Idealisation::QuasiStatic, Dim::None);
    if parameter != Parameter::Fairlead {
        table = table.fact("Fairlead Above Mean Water", fairlead, Dim::Length);
    }
    if parameter != Parameter::Length {
        let first = position.first_length.or_else(|| class.first_length());
        table = table.fact("Length of First Segment", first, Dim::Length);
    }
    if !parameter.is_condition() {
        table = match held {
            Condition::Placed => table.fact("Horizontal Distance", position.span().0, Dim::Length),
            Condition::Distance(x) => table.fact("Horizontal Distance", x, Dim::Length),
            Condition::Horizontal(force) => table.fact("Horizontal Force", force, Dim::Force),
            Condition::Tension(tension) => table.fact("Tension at Top", tension, Dim::Force),
            Condition::Vertical(force) => table.fact("Vertical Force", force, Dim::Force),
        };
    }
    table
}

/// The columns: the value, and the configuration it has, if any.
fn with_columns(table: Table, parameter: Parameter, rows: &[(f64, Option<LineConfiguration>)]) -> Table {
    table
        .with_rows(rows)
        .column("Varied", parameter.name(), parameter.dim(), Digits::Usual, |(value, _)| *value)
        .column("", "X", Dim::Length, Digits::Usual, |(_, c)| c.as_ref().map(|c| c.distance))
        .column("Horizontal", "Force", Dim::Force, Digits::Usual, |(_, c)| c.as_ref().map(|c| c.horizontal))
        .column("Vertical", "V. Force", Dim::Force, Digits::Usual, |(_, c)| c.as_ref().map(|c| c.vertical))
        .column("Tension", "Ten Top", Dim::Force, Digits::Usual, |(_, c)| c.as_ref().map(|c| c.tension))
        .column("Tension", "Max T/TB", Dim::None, Digits::Decimals(3), |(_, c)| c.as_ref().map(|c| c.ratio))
        .column("Tension", "Crit. Seg", Dim::None, Digits::Usual, |(_, c)| c.as_ref().map(|c| c.critical))
        .columns("Anchor", ["V. Pull", "H. Pull"], Dim::Force, Digits::Usual, |(_, c)| {
            c.as_ref().map_or([None; 2], |c| {
                let [horizontal, vertical] = c.anchor;
                [Some(vertical), Some(horizontal)]
            })
        })
        .column("", "Line on Bottom", Dim::Length, Digits::Usual, |(_, c)| c.as_ref().map(|c| c.on_bottom))
        .build()
}
