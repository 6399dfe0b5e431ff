//! Options of records which the model and the engines read back, each declared once: those of classes, whatever their type,
//! and those of the environment.

use windlass_base::spec::{Kind, OptionSpec, Owner, ValueSpec};
use windlass_base::units::Dim;

const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}

/// `-IG_STIFF`.
pub const IG_STIFF: OptionSpec =
    OptionSpec::new("-IG_STIFF", &[], "leaves the connector's stiffness out of the results of other bodies");
/// `-EMODULUS`.
pub const EMODULUS: OptionSpec =
    OptionSpec::new("-EMODULUS", &[number("EMOD", Dim::Stress, "Young's modulus").positive()], "Young's modulus")
        .default("&DEFAULT");
/// `-POI_RAT`.
pub const POI_RAT: OptionSpec = OptionSpec::new(
    "-POI_RAT",
    &[number("POIRAT", Dim::None, "Poisson's ratio").in_range(0.0, 0.5)],
    "Poisson's ratio",
)
.default("&DEFAULT");
/// `-FYIELD`.
pub const FYIELD: OptionSpec =
    OptionSpec::new("-FYIELD", &[number("FYIELD", Dim::Stress, "yield stress").positive()], "yield stress")
        .default("&DEFAULT");
/// `-TENSTR`.
pub const TENSTR: OptionSpec = OptionSpec::new(
    "-TENSTR",
    &[number("TENSTR", Dim::Stress, "ultimate stress").positive()],
    "ultimate tensile stress",
)
.default("yield / 0.6");
/// `-C_SN`.
pub const C_SN: OptionSpec = OptionSpec::new(
    "-C_SN",
    &[ValueSpec::new("CSN", Kind::Text, "CHAIN, WIRE, or the name of an SN curve")],
    "fatigue curve of the segment",
);
/// `-EI`.
pub const EI: OptionSpec = OptionSpec::new(
    "-EI",
    &[number(
        "EI",
        Dim::Derived { force: 1, length: 2, seconds: 0 },
        "bending stiffness; 0: a chain or rope, which cannot push",
    )
    .not_negative()],
    "bending stiffness in place of the tube's",
)
.default("that of the tube")
.owner(Owner::Ours);
/// -PHASES.
pub const PHASES: OptionSpec = OptionSpec::new(
    "-PHASES",
    &[ValueSpec::new("P", Kind::Number(Dim::Angle), "phase, one a component")],
    "phases of the wave components",
)
.repeating(1)
.default("random, of -SEED")
.owner(Owner::Ours);
