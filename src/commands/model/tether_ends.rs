//! The options of `CONNECTOR` that say how a tether is held.
//!
//! Source: [AQWA-TETHER Appendix A] (cards TSPA, TSPV, TCAP, TIFL, TIMP, TLOW, TEGR, TLAC, TROC, TLAV, TROV).

use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::spec::ValueKey;
use windlass_base::units::Dim;
use windlass_base::values::{Args, Given};
use windlass_language::select::Owner;
use windlass_language::spec::{Kind, OptionSpec, ValueSpec};
use windlass_model::{TetherConstraint, TetherEnds, TetherHold, TetherUse};

const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}

const fn option(name: &'static str, values: &'static [ValueSpec], help: &'static str) -> OptionSpec {
    OptionSpec::new(name, values, help).owner(Owner::Ours)
}

const SPRINGS: &[ValueSpec] = &[
    number("IN", Dim::ForcePerLength, "along the tether; 0 or less is rigid"),
    number("RX", Dim::MomentPerRadian, "against turning about X of the tether; less than 0 is none"),
    number("RY", Dim::MomentPerRadian, "against turning about Y of the tether; less than 0 is none"),
];
const MOORING: &[ValueSpec] = &[
    number("KX", Dim::ForcePerLength, "along the tether; without effect: it does not move along").not_negative(),
    number("KY", Dim::ForcePerLength, "sideways").not_negative(),
    number("KZ", Dim::ForcePerLength, "vertical").not_negative(),
];
const STRESS_OF_SPEED: Dim = Dim::Derived { force: 1, length: -3, seconds: 1 };
const PRESSURE: Dim = Dim::Derived { force: 1, length: -2, seconds: 0 };

choices! {
    /// What a constraint holds, and by what.
    enum EndConstraint {
        LateralFixed = "LATERAL_FIXED",
        RotationalFixed = "ROTATIONAL_FIXED",
        LateralVessel = "LATERAL_VESSEL",
        RotationalVessel = "ROTATIONAL_VESSEL",
    }
}

/// A tether between a structure and its anchor (the default of class TETHER).
pub const INSTALLED: OptionSpec = option("-INSTALLED", &[], "a tether from a structure to its anchor");
/// A towed tether.
pub const TOWED: OptionSpec =
    option("-TOWED", &[], "a tether afloat along the surface; the second point is its trailing end");
/// Card TSPV of an installed tether.
pub const V_SPRINGS: OptionSpec = option("-V_SPRINGS", SPRINGS, "springs at the vessel").default("rigid");
/// Card TSPA of an installed tether.
pub const A_SPRINGS: OptionSpec = option("-A_SPRINGS", SPRINGS, "springs at the anchor").default("rigid");
/// Card TSPV of a towed tether.
pub const V_MOORING: OptionSpec =
    option("-V_MOORING", MOORING, "soft mooring of a towed tether's vessel end").default("rigid");
/// Card TSPA of a towed tether.
pub const A_MOORING: OptionSpec =
    option("-A_MOORING", MOORING, "soft mooring of a towed tether's trailing end").default("rigid");
/// Card TCAP.
pub const CAPS: OptionSpec = option(
    "-CAPS",
    &[
        number("AREA_A", Dim::Area, "at the anchor").not_negative(),
        number("AREA_V", Dim::Area, "at the vessel").not_negative(),
    ],
    "areas of the ends that no water presses on",
)
.default("0 0");
/// Card TIFL.
pub const FLUID: OptionSpec = option(
    "-FLUID",
    &[number("P", PRESSURE, "pressure at sea level"), number("RHO", Dim::Density, "density").not_negative()],
    "fluid inside",
)
.default("0 0: empty");
/// Card TIMP.
pub const IMPACT: OptionSpec = option(
    "-IMPACT",
    &[
        number("FACTOR", STRESS_OF_SPEED, "axial stress at unit closing velocity").not_negative(),
        number("HALF_LIFE", Dim::Time, "time after which half of it is left").positive(),
    ],
    "stress when a slack tether is taken up; no effect on a towed one",
)
.default("none");
/// Card TLOW.
pub const LOW_STOP: OptionSpec = option(
    "-LOW_STOP",
    &[number("D", Dim::Length, "distance below the anchor").not_negative()],
    "lower stop of a tether that hangs free; a warning says when it is passed; no effect on a towed one",
)
.default("none");
/// Cards TLAC, TROC, TLAV, TROV.
pub const CONSTRAINT: OptionSpec = OptionSpec {
    many: true,
    ..option(
        "-CONSTRAINT",
        &[
            ValueSpec::choice::<EndConstraint>("KIND", "what is held, and by what"),
            ValueSpec::new("NODE", Kind::Integer, "the node, 1 at the anchor").in_range(1.0, 1e5),
            number("GAP", Dim::Length, "free radius of LATERAL_VESSEL").or("0").not_negative(),
        ],
        "holds a node of a tether, five constraints at most",
    )
};
/// Card TEGR.
pub const GROUP: OptionSpec = option(
    "-GROUP",
    &[ValueSpec::new("N", Kind::Integer, "how many").in_range(1.0, 1e6)],
    "identical tethers side by side: forces on the structure count so many times",
)
.default("1");

/// Place of the vessel's node as it was given.
pub const GIVEN: OptionSpec = option(
    "-GIVEN",
    &[number("X", Dim::Length, "X"), number("Y", Dim::Length, "Y"), number("Z", Dim::Length, "Z")],
    "place of the node at the vessel as a deck gives it; &STATUS TETHERS lists it",
)
.default("where the model has it");

/// Most constraints of a tether [AQWA-TETHER A.14].
const MAX_CONSTRAINTS: usize = 5;

const OF_INSTALLED: [OptionSpec; 6] = [INSTALLED, V_SPRINGS, A_SPRINGS, CAPS, FLUID, CONSTRAINT];
/// Options of installed tethers that a towed one lists and does not use, as the listing of [AQWA-TETHER 8.1] has them.
const OF_BOTH: [OptionSpec; 4] = [IMPACT, LOW_STOP, GROUP, GIVEN];
const OF_TOWED: [OptionSpec; 3] = [TOWED, V_MOORING, A_MOORING];

fn first_of<'a>(args: &'a Args, options: &[OptionSpec]) -> Option<&'a Given> {
    options.iter().find_map(|option| args.option(option))
}

/// How a record holds its tether; `None` when it says nothing of one.
///
/// # Errors
/// Options of a towed and of an installed tether together, too many constraints, a gap of what has none.
pub fn read(args: &Args) -> Outcome<Option<TetherEnds>> {
    let (installed, towed) = (first_of(args, &OF_INSTALLED), first_of(args, &OF_TOWED));
    if let (Some(one), Some(other)) = (installed, towed) {
        let text = format!("{} is of a towed tether, {} of an installed one", other.name(), one.name());
        return Err(Diagnostic::error(text, other.span).other(one.span, "given here"));
    }
    if installed.is_none() && towed.is_none() && first_of(args, &OF_BOTH).is_none() {
        return Ok(None);
    }
    let three =
        |option: &OptionSpec, keys: [ValueKey<f64>; 3]| args.option(option).map(|given| given.numbers_or_zero(keys));
    let two =
        |option: &OptionSpec, keys: [ValueKey<f64>; 2]| args.option(option).map(|given| given.numbers_or_zero(keys));
    let swapped = |[first, second]: [f64; 2]| [second, first];
    let (used, springs) = if towed.is_some() {
        (
            TetherUse::Towed,
            [&V_MOORING, &A_MOORING].map(|option| three(option, const { V_MOORING.numbers(["KX", "KY", "KZ"]) })),
        )
    } else {
        (
            TetherUse::Installed,
            [&V_SPRINGS, &A_SPRINGS].map(|option| three(option, const { V_SPRINGS.numbers(["IN", "RX", "RY"]) })),
        )
    };
    let group = args.option_integer(&GROUP);
    Ok(Some(TetherEnds {
        used,
        springs,
        caps: two(&CAPS, const { CAPS.numbers(["AREA_A", "AREA_V"]) }).map(swapped).unwrap_or_default(),
        fluid: two(&FLUID, const { FLUID.numbers(["P", "RHO"]) }).unwrap_or_default(),
        impact: two(&IMPACT, const { IMPACT.numbers(["FACTOR", "HALF_LIFE"]) }),
        low_stop: args.option_number(&LOW_STOP),
        constraints: constraints(args)?,
        group: group.and_then(|n| usize::try_from(n).ok()).unwrap_or(1),
        given: args.option(&GIVEN).map(|given| given.numbers_or_zero(const { GIVEN.numbers(["X", "Y", "Z"]) })),
    }))
}

fn constraints(args: &Args) -> Outcome<Vec<TetherConstraint>> {
    let mut found = Vec::new();
    for given in args.occurrences(&CONSTRAINT) {
        let gap = given.number(const { CONSTRAINT.number("GAP") });
        let Some(kind) = given.choice(const { CONSTRAINT.choice("KIND") }) else { continue };
        if gap.is_some_and(|g| g > 0.0) && kind != EndConstraint::LateralVessel {
            return Err(Diagnostic::error("only LATERAL_VESSEL has a gap", given.span));
        }
        let node =
            given.integer(const { CONSTRAINT.integer("NODE") }).and_then(|n| usize::try_from(n).ok()).unwrap_or(1);
        let hold = match kind {
            EndConstraint::LateralFixed => TetherHold::LateralFixed,
            EndConstraint::RotationalFixed => TetherHold::RotationalFixed,
            EndConstraint::LateralVessel => TetherHold::LateralVessel { gap: gap.unwrap_or(0.0) },
            EndConstraint::RotationalVessel => TetherHold::RotationalVessel,
        };
        found.push(TetherConstraint { node, hold });
        if found.len() > MAX_CONSTRAINTS {
            return Err(Diagnostic::error(format!("a tether has {MAX_CONSTRAINTS} constraints at most"), given.span));
        }
    }
    Ok(found)
}
