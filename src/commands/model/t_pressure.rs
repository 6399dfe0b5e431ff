//! `T_PRESSURE`: what pipes of class ROD hold, and how warm they are.
//!
//! [MOSES-FLEX ROD] names the command and says what it gives; no source gives its form, which is ours and stands in its help.

use crate::commands::menu;
use crate::commands::{Call, Command, Effect, Job};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_base::values::Noun;
use windlass_language::name as rule;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, OptionSpec, ValueSpec};
use windlass_model::{Contents, EntityKind, Filling, Model};

/// T_PRESSURE.
pub static T_PRESSURE: Command = Command { spec: &SPEC, edits: false, run };

/// Pressure of the standard atmosphere (Pa): that of nothing is as far below it.
const STANDARD_ATMOSPHERE_PA: f64 = 101_325.0;

const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}

const LAID: OptionSpec = OptionSpec::new(
    "-LAID",
    &[number("TEMP", Dim::TemperatureRise, "temperature")],
    "temperature at which the pipe was laid, without strain",
)
.owner(Owner::Ours)
.default("0: TEMP of the data is a rise");
const DENSITY: OptionSpec =
    OptionSpec::new("-DENSITY", &[number("RHO", Dim::Density, "density").not_negative()], "density of the contents")
        .owner(Owner::Ours)
        .default("0");
const SPGRAVITY: OptionSpec = OptionSpec::new(
    "-SPGRAVITY",
    &[number("SG", Dim::None, "specific gravity").not_negative()],
    "the same over that of fresh water, 1000 kg/m3",
)
.owner(Owner::Ours);
const AT: OptionSpec = OptionSpec::new(
    "-AT",
    &[number("Z", Dim::Length, "elevation, global")],
    "where PRESSURE holds; below it the weight of the contents adds to it",
)
.owner(Owner::Ours)
.default("0: at the mean water level");

static SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::INMODEL, &menu::MEDIT],
    data: &[
        ValueSpec::new("NAME", Kind::Name(Noun::New), "name of the data, for -T_PRESSURE of &ENV"),
        number("TEMP", Dim::TemperatureRise, "temperature of the pipe"),
        number("PRESSURE", Dim::Stress, "pressure of the contents above the atmosphere's").or("0"),
    ],
    options: &[LAID, DENSITY, SPGRAVITY, AT],
    detail: "-T_PRESSURE NAME of &ENV puts the data in force, for all pipes of class ROD. Temperatures are in degrees F with feet and C with \
             metres, as -ALPHA is per degree: only the rise of TEMP over -LAID counts, times -ALPHA a strain that the pipe wants to have. Pressure is in \
             ksi or MPa over the atmosphere's. At an elevation z the pressure is PRESSURE + RHO g (Z - z). A name given again is redefined. \
             MOSES names this command; the form is ours, as no source gives it.",
    example: "MEDIT\nT_PRESSURE HOT 180 2.2 -LAID 60 -SPGRAVITY 0.8 -AT 50\nEND\n&ENV -T_PRESSURE HOT\n&STATUS T_PRESSURE",
    ..CommandSpec::new("T_PRESSURE", "temperature, pressure and contents of pipes")
};

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const NAME: DatumKey<str> = SPEC.word("NAME");
    const PRESSURE: DatumKey<f64> = SPEC.number("PRESSURE");
    let args = &call.args;
    let (name, span) = (args.word(NAME).unwrap_or_default(), args.position(NAME));
    rule::check(name, None, "set of T_PRESSURE data", span)?;
    job.model.free_name(name, &[EntityKind::Filling], span)?;
    if let (Some(first), Some(second)) = (args.option(&DENSITY), args.option(&SPGRAVITY)) {
        let text = "the contents have a -DENSITY or a -SPGRAVITY";
        return Err(Diagnostic::error(text, second.span).other(first.span, "given here already"));
    }
    let pressure = args.number(PRESSURE).unwrap_or(0.0);
    if pressure < -STANDARD_ATMOSPHERE_PA {
        let least = Dim::Stress.from_si(-STANDARD_ATMOSPHERE_PA, job.units);
        let text = format!("PRESSURE is over the atmosphere's, and {least:.4} is that of nothing");
        return Err(Diagnostic::error(text, args.position(PRESSURE)).label("less than none"));
    }
    let weight = args.option_number(&SPGRAVITY).map(|s| 1000.0 * s);
    let contents = Contents {
        warmer: args.number(const { SPEC.number("TEMP") }).unwrap_or(0.0) - args.option_number(&LAID).unwrap_or(0.0),
        pressure,
        at: args.option_number(&AT).unwrap_or(0.0),
        density: args.option_number(&DENSITY).or(weight).unwrap_or(0.0),
    };
    let made = Filling { name: name.to_string(), contents, span };
    if job.model.fillings.insert(Model::key(name), made).is_some() {
        job.remark(format!("T_PRESSURE data {name} are redefined"), span);
    }
    job.note_name(name, span);
    Ok(Effect::Done)
}

/// The data whose names fit.
pub(crate) fn table(model: &Model, fits: &dyn Fn(&str) -> bool) -> Table {
    let fillings: Vec<&Filling> = model.fillings.values().filter(|f| fits(&f.name)).collect();
    let mut table = Table::new("Temperature and Pressure of Pipes")
        .with_rows(&fillings)
        .text("Name", |filling| &filling.name)
        .column("", "Warmer by", Dim::TemperatureRise, Digits::Usual, |filling| filling.contents.warmer)
        .column("", "Pressure", Dim::Stress, Digits::Decimals(3), |filling| filling.contents.pressure)
        .column("", "at Z", Dim::Length, Digits::Usual, |filling| filling.contents.at)
        .column("Contents", "Density", Dim::Density, Digits::Usual, |filling| filling.contents.density)
        .build();
    if let Some(named) = &model.environment.filling {
        table.note(format!("the environment in force has {}", named.kind));
    }
    table
}
