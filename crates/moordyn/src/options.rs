//! OPTIONS: a value, then the name of the option.

use crate::Given;
use crate::row::{Row, Word, count, number, size};
use windlass_base::diagnostic::{Diagnostic, Outcome, suggest};

/// Options that act on the system. `None`: not given.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// g (m/s2); MoorDyn's default is 9.80665.
    pub gravity: Option<Given<f64>>,
    /// rho, WtrDnsty (kg/m3); MoorDyn's default is 1025; 0: no water.
    pub density: Option<Given<f64>>,
    /// WtrDpth (m).
    pub depth: Option<Given<f64>>,
    /// kBot (Pa/m); MoorDyn's default is 3e6.
    pub seabed_stiffness: Option<Given<f64>>,
    /// cBot (Pa s/m); MoorDyn's default is 3e5.
    pub seabed_damping: Option<Given<f64>>,
    /// FrictionCoefficient; MoorDyn's default is 0.
    pub friction: Option<Given<f64>>,
    /// FricDamp; MoorDyn's default is 200.
    pub friction_damping: Option<Given<f64>>,
    /// StatDynFricScale; MoorDyn's default is 1.
    pub static_friction_scale: Option<Given<f64>>,
    /// WaveKin: 0 none, 1 by the caller, 2, 3 and 7 from files.
    pub wave_kinematics: Option<Given<usize>>,
    /// Currents: 0 none, 1 current_profile.txt.
    pub currents: Option<Given<usize>>,
    /// SeafloorFile.
    pub seafloor_file: Option<Given<String>>,
    /// Options of MoorDyn's own integration, static search and output: name as written, and value.
    pub unused: Vec<(Given<String>, String)>,
}

/// What an option sets.
#[derive(Clone, Copy)]
enum OptionKind {
    Gravity,
    Density,
    Depth,
    SeabedStiffness,
    SeabedDamping,
    Friction,
    FrictionDamping,
    StaticFrictionScale,
    WaveKinematics,
    Currents,
    Seafloor,
    Unused,
}

/// The names of options.
const NAMES: [(&str, OptionKind); 40] = [
    ("g", OptionKind::Gravity),
    ("gravity", OptionKind::Gravity),
    ("rho", OptionKind::Density),
    ("WtrDnsty", OptionKind::Density),
    ("WtrDpth", OptionKind::Depth),
    ("WtrDepth", OptionKind::Depth),
    ("depth", OptionKind::Depth),
    ("kBot", OptionKind::SeabedStiffness),
    ("kb", OptionKind::SeabedStiffness),
    ("cBot", OptionKind::SeabedDamping),
    ("cb", OptionKind::SeabedDamping),
    ("FrictionCoefficient", OptionKind::Friction),
    ("FricDamp", OptionKind::FrictionDamping),
    ("StatDynFricScale", OptionKind::StaticFrictionScale),
    ("WaveKin", OptionKind::WaveKinematics),
    ("Currents", OptionKind::Currents),
    ("SeafloorFile", OptionKind::Seafloor),
    ("dtM", OptionKind::Unused),
    ("DT", OptionKind::Unused),
    ("CFL", OptionKind::Unused),
    ("tScheme", OptionKind::Unused),
    ("dtIC", OptionKind::Unused),
    ("ICdt", OptionKind::Unused),
    ("TmaxIC", OptionKind::Unused),
    ("ICTmax", OptionKind::Unused),
    ("CdScaleIC", OptionKind::Unused),
    ("ICDfac", OptionKind::Unused),
    ("threshIC", OptionKind::Unused),
    ("ICthresh", OptionKind::Unused),
    ("ICgenDynamic", OptionKind::Unused),
    ("fileIC", OptionKind::Unused),
    ("dtWave", OptionKind::Unused),
    ("UnifyCurrentGrid", OptionKind::Unused),
    ("WriteUnits", OptionKind::Unused),
    ("WriteLog", OptionKind::Unused),
    ("dtOut", OptionKind::Unused),
    ("disableOutput", OptionKind::Unused),
    ("disableOutTime", OptionKind::Unused),
    ("OutSwitch", OptionKind::Unused),
    ("inertialF", OptionKind::Unused),
];

pub(crate) fn read(rows: &[Row<'_>], options: &mut Options, messages: &mut Vec<Diagnostic>) {
    for row in rows {
        let read = match row.words.as_slice() {
            [value, name, ..] => {
                messages.extend(doubt(value, name));
                one(value, name, options)
            }
            _ => Err(Diagnostic::error("an option is a value and then its name", row.span)
                .label("expected a value and a name")),
        };
        if let Err(error) = read {
            messages.push(*error);
        }
    }
}

/// Least density that is not warned of but zero (kg/m3): one in t/m3 is below it.
const LEAST_DENSITY: f64 = 100.0;

/// Options of MoorDyn that are words.
const WORDS: [&str; 2] = ["tScheme", "fileIC"];

/// What of an option is read and hardly meant.
fn doubt(value: &Word<'_>, name: &Word<'_>) -> Option<Diagnostic> {
    let (known, kind) = NAMES.iter().find(|(known, _)| known.eq_ignore_ascii_case(name.value))?;
    let parsed = number(value, known).ok();
    match kind {
        OptionKind::Density
            if parsed.as_ref().is_some_and(|given| given.value > 0.0 && given.value < LEAST_DENSITY) =>
        {
            let text = format!("the density of the water is {} kg/m3", value.value);
            let warning = Diagnostic::warning(text, value.span).label("read in kg/m3");
            Some(*warning.help("sea water has 1025; 0 is no water"))
        }
        OptionKind::Unused if parsed.is_none() && !WORDS.contains(known) => {
            let warning = Diagnostic::warning(format!("{known} is not a number: {}", value.value), value.span);
            Some(*warning.label("MoorDyn expects a number").help("windlass does not use it"))
        }
        _ => None,
    }
}

fn one(value: &Word<'_>, name: &Word<'_>, options: &mut Options) -> Outcome<()> {
    let find = |word: &str| NAMES.iter().find(|(known, _)| known.eq_ignore_ascii_case(word));
    let Some(&(known, kind)) = find(name.value) else {
        if find(value.value).is_some() {
            let error = Diagnostic::error(format!("option {} has its name first", value.value), value.span);
            return Err(error.label("expected its value").help(format!("write {} {}", name.value, value.value)));
        }
        let error = Diagnostic::error(format!("option {} is not known", name.value), name.span);
        return Err(match suggest(name.value, NAMES.iter().map(|(known, _)| *known)) {
            Some(help) => error.help(help),
            None => error,
        });
    };
    match kind {
        OptionKind::Gravity => set(&mut options.gravity, size(value, known, true)?),
        OptionKind::Density => set(&mut options.density, size(value, known, false)?),
        OptionKind::Depth => set(&mut options.depth, number(value, known)?),
        OptionKind::SeabedStiffness => set(&mut options.seabed_stiffness, size(value, known, false)?),
        OptionKind::SeabedDamping => set(&mut options.seabed_damping, size(value, known, false)?),
        OptionKind::Friction => set(&mut options.friction, size(value, known, false)?),
        OptionKind::FrictionDamping => set(&mut options.friction_damping, size(value, known, false)?),
        OptionKind::StaticFrictionScale => set(&mut options.static_friction_scale, size(value, known, false)?),
        OptionKind::WaveKinematics => set(&mut options.wave_kinematics, mode(value, known, &[0, 1, 2, 3, 7])?),
        OptionKind::Currents => set(&mut options.currents, mode(value, known, &[0, 1])?),
        OptionKind::Seafloor => {
            set(&mut options.seafloor_file, Given { value: value.value.to_string(), span: value.span })
        }
        OptionKind::Unused => {
            options.unused.push((Given { value: name.value.to_string(), span: name.span }, value.value.to_string()));
            Ok(())
        }
    }
}

/// Sets an option, which a deck may give once.
fn set<T>(slot: &mut Option<Given<T>>, given: Given<T>) -> Outcome<()> {
    if let Some(earlier) = slot {
        let error = Diagnostic::error("the option is given twice", given.span);
        return Err(error.other(earlier.span, "given here first"));
    }
    *slot = Some(given);
    Ok(())
}

fn mode(value: &Word<'_>, name: &str, read: &[usize]) -> Outcome<Given<usize>> {
    let given = count(value, name, 0)?;
    if read.contains(&given.value) {
        return Ok(given);
    }
    let list = read.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ");
    let error = Diagnostic::error(format!("{name} {} is not read: its loads would be lost", value.value), value.span);
    Err(error.label(format!("expected one of {list}")))
}
