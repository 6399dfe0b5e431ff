//! The options that several connector classes share, each declared once.
//!
//! Source: [MOSES-FLEX]; sizes in inches or mm, lengths in feet or metres, `bforce` the user's force.

use super::zero_law::Sense;
use windlass_base::choice::{Dof, YesNo};
use windlass_base::choices;
use windlass_base::units::Dim;
use windlass_base::values::Noun;
use windlass_language::select::Owner;
use windlass_language::spec::{Kind, OptionSpec, ValueSpec, join_options};
pub use windlass_model::options::{C_SN, EI, EMODULUS, FYIELD, IG_STIFF, POI_RAT, TENSTR};

const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}

choices! {
    /// How a piston acts.
    pub enum PistonKind {
        /// It holds the tension below a limit.
        Max = "MAX",
        /// It holds the tension between two limits.
        MinMax = "MINMAX",
    }
}

/// `SENSE`: the direction in which an element acts.
pub const SENSE: ValueSpec = ValueSpec::choice::<Sense>("SENSE", "direction in which the element acts").or("BOTH");
/// `DF`.
pub const DF: ValueSpec = ValueSpec::choice::<Dof>("DF", "degree of freedom restrained, in the element system");
/// `SPV`.
pub const SPV: ValueSpec = ValueSpec::new("SPV", Kind::StiffnessOfDof, "spring value").positive();
/// `AF`.
pub const AF: ValueSpec = ValueSpec::new("AF", Kind::ForceOfDof, "allowable force").or("not checked").positive();
/// `OD`.
pub const OD: ValueSpec = number("OD", Dim::Section, "outside diameter").positive();

/// `T` of a tube.
pub const WALL: ValueSpec = number("T", Dim::Section, "wall thickness").positive();
/// Data of a tube.
pub const TUBE: [ValueSpec; 2] = [OD, WALL];
/// Data of a generalized spring: the last three repeat.
pub const GENERALIZED: [ValueSpec; 4] = [SENSE, DF, SPV, AF];

choices! {
    /// The flag of a catenary.
    pub enum CatenaryFlag {
        /// With its weight, solved exactly.
        Exact = "EXACT",
    }
}

/// `OD` of a line, which `-TYPE` may stand for.
pub const LINE_OD: ValueSpec = OD.or("diameter of -TYPE");
/// `-TYPE NAME D`.
pub const TYPE: OptionSpec = OptionSpec::new(
    "-TYPE",
    &[
        ValueSpec::new("NAME", Kind::Name(Noun::LineType), "name in &STATUS LINE_TYPES"),
        number("D", Dim::Section, "nominal diameter").positive(),
    ],
    "weight, buoyancy, AE, break and diameters of a chain or rope of the library; other options override it",
)
.owner(Owner::Ours);

/// `-LEN L` of a segment.
pub const LEN: OptionSpec =
    OptionSpec::new("-LEN", &[number("L", Dim::Length, "length of the segment").positive()], "length of the segment")
        .aliases(&["-LENGTH"]);
/// `-LEN L` of a GSPR.
pub const LEN_OFFSET: OptionSpec = OptionSpec::new(
    "-LEN",
    &[number("L", Dim::Length, "offset along element X").not_negative()],
    "the spring begins this far along element X",
)
.aliases(&["-LENGTH"])
.default("0");
/// `-REFINE N`.
pub const REFINE: OptionSpec = OptionSpec::new(
    "-REFINE",
    &[ValueSpec::new("N", Kind::Integer, "number of elements").in_range(1.0, 100_000.0)],
    "subdivides the segment into N elements",
)
.default("one element");
/// `-SYMMETRIC YES/NO`.
pub const SYMMETRIC: OptionSpec = OptionSpec::new(
    "-SYMMETRIC",
    &[ValueSpec::choice::<YesNo>("YES/NO", "symmetric about the element X axis").or("YES")],
    "the Z properties are those given for Y",
);

const PY: &[ValueSpec] =
    &[number("P", Dim::Force, "force").not_negative(), number("Y", Dim::Length, "resulting deflection").not_negative()];
/// `-X_PY P Y ..`.
pub const X_PY: OptionSpec =
    OptionSpec::new("-X_PY", PY, "nonlinear spring in series with the x stiffness").repeating(2);
/// `-Y_PY P Y ..`.
pub const Y_PY: OptionSpec =
    OptionSpec::new("-Y_PY", PY, "nonlinear spring in series with the y stiffness").repeating(2);
/// `-Z_PY P Y ..`.
pub const Z_PY: OptionSpec =
    OptionSpec::new("-Z_PY", PY, "nonlinear spring in series with the z stiffness").repeating(2);

const DASHPOT: &[ValueSpec] = &[
    ValueSpec::new("Co", Kind::DampingCoefficient, "coefficient, in force times (time/length)**Ex").not_negative(),
    number("Ex", Dim::None, "exponent of the velocity").positive(),
    number("Fo", Dim::Force, "largest force").or("no limit").positive(),
];
/// `-X_DAMPING Co Ex Fo`.
pub const X_DAMPING: OptionSpec = OptionSpec::new("-X_DAMPING", DASHPOT, "dashpot in x: F = Co v**Ex up to Fo");
/// `-X_DAMPING Co Ex Fo` of lines.
pub const X_DAMPING_LINE: OptionSpec = OptionSpec::new(
    "-X_DAMPING",
    DASHPOT,
    "dashpot between the ends, in time steps: F = Co v**Ex up to Fo, v the rate of their distance, while the line has tension",
);
/// `-Y_DAMPING Co Ex Fo`.
pub const Y_DAMPING: OptionSpec = OptionSpec::new("-Y_DAMPING", DASHPOT, "dashpot in y: F = Co v**Ex up to Fo");
/// `-Z_DAMPING Co Ex Fo`.
pub const Z_DAMPING: OptionSpec = OptionSpec::new("-Z_DAMPING", DASHPOT, "dashpot in z: F = Co v**Ex up to Fo");

/// `-CONVOLUTION DF NAME` of zero-length classes.
pub const CONVOLUTION_DF: OptionSpec = OptionSpec::new(
    "-CONVOLUTION",
    &[DF, ValueSpec::new("CVL_NAME", Kind::Name(Noun::Curve), "convolution curve")],
    "viscoelastic spring in series, in one degree of freedom",
)
.many();
/// `-CONVOLUTION NAME` of lines.
pub const CONVOLUTION: OptionSpec = OptionSpec::new(
    "-CONVOLUTION",
    &[ValueSpec::new("CVL_NAME", Kind::Name(Noun::Curve), "convolution curve")],
    "viscoelastic spring in series at the first end; statics has its last stiffness",
);
/// `-FRICTION MU` of zero-length classes.
pub const FRICTION_MU: OptionSpec = OptionSpec::new(
    "-FRICTION",
    &[number("MU", Dim::None, "coefficient of friction").not_negative()],
    "limits the lateral force by the element x force",
);
/// `-SEND KE1 KE2`.
pub const SEND: OptionSpec = OptionSpec::new(
    "-SEND",
    &[
        number("KE(1)", Dim::ForcePerLength, "spring at the first end").or("rigid").positive(),
        number("KE(2)", Dim::ForcePerLength, "spring at the second end").or("rigid").positive(),
    ],
    "springs at the two ends, in series",
);
/// `-SPGRAVITY`.
pub const SPGRAVITY: OptionSpec = OptionSpec::new(
    "-SPGRAVITY",
    &[number("SPGR", Dim::None, "specific gravity").positive()],
    "specific gravity of the material, against 1000 kg/m3",
);
/// `-DENSITY`.
pub const DENSITY: OptionSpec =
    OptionSpec::new("-DENSITY", &[number("RHO", Dim::Density, "density").positive()], "density of the material")
        .default("&DEFAULT");
/// `-ALPHA`.
pub const ALPHA: OptionSpec =
    OptionSpec::new("-ALPHA", &[number("ALPHA", Dim::ThermalExpansion, "thermal expansion")], "thermal expansion")
        .default("&DEFAULT");
/// `-WTPLEN`.
pub const WTPLEN: OptionSpec = OptionSpec::new(
    "-WTPLEN",
    &[number("WTPFT", Dim::ForcePerLength, "weight per length")],
    "weight per length in air",
)
.default("density times area");
/// `-DISPLEN`.
pub const DISPLEN: OptionSpec = OptionSpec::new(
    "-DISPLEN",
    &[number("DPFT", Dim::ForcePerLength, "displacement per length").not_negative()],
    "displacement per length, taken off the weight",
)
.default("0");
/// `-PISTON TYPE LT LD VLONG VSHORT TMAX TMIN`.
pub const PISTON: OptionSpec = OptionSpec::new(
    "-PISTON",
    &[
        ValueSpec::choice::<PistonKind>("TYPE", "how the piston acts"),
        number("LT", Dim::Section, "total stroke").positive(),
        number("LD", Dim::Section, "nominal position").not_negative(),
        number("VLONG", Dim::Velocity, "lengthening velocity").positive(),
        number("VSHORT", Dim::Velocity, "shortening velocity").positive(),
        number("TMAX", Dim::Force, "largest tension").positive(),
        number("TMIN", Dim::Force, "smallest tension").or("0; needed for MINMAX").not_negative(),
    ],
    "hydraulic piston at the first end that controls the tension; VLONG, VSHORT are the fastest it goes",
);
/// `-B_TENSION`.
pub const B_TENSION: OptionSpec = OptionSpec::new(
    "-B_TENSION",
    &[number("BTEN", Dim::Force, "breaking tension").positive()],
    "breaking tension of the segment",
)
.default("area times ultimate stress");
/// `-EA_BOUNDS`.
pub const EA_BOUNDS: OptionSpec = OptionSpec::ours(
    "-EA_BOUNDS",
    &[
        number("EAL", Dim::Force, "least axial stiffness: of a new rope, pulled slowly").positive(),
        number("EAU", Dim::Force, "largest axial stiffness: of a rope that storms have worked").positive(),
    ],
    "bounds of the axial stiffness of a fibre rope; &PARAMETER -STIFFNESS takes one, EAL without",
);
/// `-TAB_LIM`.
pub const TAB_LIM: OptionSpec = OptionSpec::new(
    "-TAB_LIM",
    &[number("TABLE_LIMIT", Dim::Force, "largest tension of the table").positive()],
    "largest tension of the table",
)
.default("largest breaking tension of all segments");
/// `-TABLE`.
pub const TABLE: OptionSpec =
    OptionSpec::new("-TABLE", &[], "forces are interpolated in the table of thirty points, not solved")
        .owner(Owner::Ours);
/// `-DEPANCHOR`.
pub const DEPANCHOR: OptionSpec = OptionSpec::new(
    "-DEPANCHOR",
    &[number("DEPTH", Dim::Length, "depth of the anchor below the waterplane").positive()],
    "depth at the anchor",
)
.default("depth of &ENV");
/// `-CLUMP CW [CLEN]`.
pub const CLUMP: OptionSpec = OptionSpec::new(
    "-CLUMP",
    &[
        number("CW", Dim::Force, "weight; negative: largest displacement of a spring buoy"),
        number("CLEN", Dim::Length, "length of the buoy's pendant").or("0").not_negative(),
    ],
    "clump weight or spring buoy at the end of the segment",
);
/// `-BUOYDIAMETER`.
pub const BUOYDIAMETER: OptionSpec = OptionSpec::new(
    "-BUOYDIAMETER",
    &[number("BOD", Dim::Section, "diameter for buoyancy").not_negative()],
    "diameter for buoyancy",
)
.default("OD");
/// `-DRAGDIAMETER`.
pub const DRAGDIAMETER: OptionSpec = OptionSpec::new(
    "-DRAGDIAMETER",
    &[number("D_DIAMETER", Dim::Section, "diameter for drag").not_negative()],
    "diameter for drag",
)
.aliases(&["-DRGDIA"])
.default("OD");
/// `-WINDDIAMETER`.
pub const WINDDIAMETER: OptionSpec = OptionSpec::new(
    "-WINDDIAMETER",
    &[number("WOD", Dim::Section, "diameter for wind").not_negative()],
    "diameter for wind",
)
.default("OD");
/// `-AMASDIAMETER`.
pub const AMASDIAMETER: OptionSpec = OptionSpec::new(
    "-AMASDIAMETER",
    &[number("AMOD", Dim::Section, "diameter for added mass").not_negative()],
    "diameter for added mass",
)
.default("OD");
/// `-FRICTION BOTMU` of lines.
pub const FRICTION: OptionSpec = OptionSpec::new(
    "-FRICTION",
    &[number("BOTMU", Dim::None, "coefficient of friction").not_negative()],
    "friction between line and bottom",
)
.default("0");
/// `-SLOPE SLOP`.
pub const SLOPE: OptionSpec = OptionSpec::new(
    "-SLOPE",
    &[number("SLOP", Dim::None, "vertical / horizontal distance").in_range(-10.0, 10.0)],
    "slope of the bottom from vessel to anchor, positive where the depth increases",
)
.default("0");

/// A number of an AQWA item, in the SI unit of its dimension whatever `&DIMEN` says.
pub const fn aqwa(name: &'static str, values: &'static [ValueSpec], help: &'static str) -> OptionSpec {
    OptionSpec::new(name, values, help).owner(Owner::Aqwa)
}

/// The material of a section.
pub const MATERIAL: [OptionSpec; 7] = [SPGRAVITY, DENSITY, EMODULUS, POI_RAT, ALPHA, FYIELD, TENSTR];

/// A segment of a line: its material, weight, displacement and strength.
pub const SEGMENT: [OptionSpec; MATERIAL.len() + 4] = join_options(&MATERIAL, &[WTPLEN, DISPLEN, B_TENSION, C_SN]);

/// Diameters that stand in place of the outer one in buoyancy, drag, wind and added mass.
pub const DIAMETERS: [OptionSpec; 4] = [BUOYDIAMETER, DRAGDIAMETER, WINDDIAMETER, AMASDIAMETER];
