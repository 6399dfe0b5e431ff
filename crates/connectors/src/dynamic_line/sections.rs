//! Parts of a line from the records of ROD, B_CAT and H_CAT.

use super::describe::{BreakingStrength, EndFixity, JointMass, LineDescription, LinePart, Seabed};
use crate::options as o;
use crate::per_line::PerLineOptions;
use crate::section::LineSection;
use std::f64::consts::{FRAC_PI_4, PI};
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::spec::ValueKey;
use windlass_base::units::Dim;
use windlass_base::values::{Args, Given};
use windlass_language::spec::{Kind, OptionSpec, ValueSpec};
use windlass_line_dynamics::{RodSegment, SeabedPush, TensionLaw, TubeSection, ViscoelasticRope};
use windlass_model::{ClassError, ClassRecord, RopeStiffness, Surroundings};

/// Drag, inline drag of the skin and added mass where nothing is given: those of AQWA's cable dynamics [AQWA-CONN 5.8.3.1].
const AQWA_CD: f64 = 1.0;
/// `0.5 rho Cx V2 De`, per diameter.
const AQWA_CX: f64 = 0.025;
/// Added mass across the line.
const AQWA_CA: f64 = 1.0;
/// Drag of the wind on a cylinder ([DNV-RP-C205 5.4.3]: infinitely long, circular, rough or below the critical Reynolds number).
const WIND_CD: f64 = 1.2;

const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}

/// Relaxation time of a fibre rope (s) where none is given: beyond waves, within the slow drift of a vessel.
const DEFAULT_RELAXATION_TIME_S: f64 = 100.0;

/// Force per rate of strain.
const PER_RATE: Dim = Dim::Derived { force: 1, length: 0, seconds: 1 };
/// Force per area and depth.
const PER_DEPTH: Dim = Dim::Derived { force: 1, length: -3, seconds: 0 };
/// Force per area and speed.
const PER_SPEED: Dim = Dim::Derived { force: 1, length: -3, seconds: 1 };

/// `-CD`.
pub const CD: OptionSpec = OptionSpec::ours(
    "-CD",
    &[
        number("CDN", Dim::None, "drag coefficient across").not_negative(),
        number("CDT", Dim::None, "drag coefficient of the skin, on pi times the diameter")
            .or("0.025/pi")
            .not_negative(),
        number("CDW", Dim::None, "drag coefficient of the wind across what is dry").or("1.2").not_negative(),
    ],
    "drag coefficients of the segment",
)
.default("CDN of -TYPE, else 1.0; CDT 0.025/pi; CDW 1.2");
/// `-CA`.
pub const CA: OptionSpec = OptionSpec::ours(
    "-CA",
    &[
        number("CAN", Dim::None, "added mass coefficient across").not_negative(),
        number("CAT", Dim::None, "added mass coefficient along").or("0").not_negative(),
    ],
    "added mass coefficients of the segment",
)
.default("1.0 0");
/// `-EA`.
pub const EA: OptionSpec = OptionSpec::ours(
    "-EA",
    &[
        number("K1", Dim::Force, "coefficient of strain").positive(),
        number("K2", Dim::Force, "coefficient of strain squared").or("0"),
        number("K3", Dim::Force, "coefficient of strain cubed").or("0"),
    ],
    "tension by strain e: K1 e + K2 e2 + K3 e3, in place of the tube's",
)
.default("that of the tube");
/// What a line with a class of static lines takes as a dynamic one.
pub const LINE_OPTIONS: [OptionSpec; 5] = [CD, CA, AX_DAMPING, SEABED, ROPE];
/// `-STRETCH`.
pub const STRETCH: OptionSpec = OptionSpec::ours(
    "-STRETCH",
    &[number("T", Dim::Force, "tension"), number("E", Dim::None, "strain at it")],
    "tension by strain as a table, straight between its points",
)
.repeating(2);
/// `-ROPE`.
pub const ROPE: OptionSpec = OptionSpec::ours(
    "-ROPE",
    &[
        number("EAD", Dim::Force, "stiffness when pulled fast, without load").positive(),
        number("B", Dim::None, "how that grows with the mean tension").or("0").not_negative(),
        number("TAU", Dim::Time, "relaxation time").or("100").positive(),
    ],
    "fibre rope: -EA, -STRETCH or EAL of -EA_BOUNDS is its static stiffness, EAD + B T its dynamic one",
);
/// `-CLUMP_DRAG`.
pub const CLUMP_DRAG: OptionSpec = OptionSpec::ours(
    "-CLUMP_DRAG",
    &[
        number("CDA", Dim::Area, "drag coefficient times area, the same in all directions").not_negative(),
        number("ADDED", Dim::Force, "weight of its added mass")
            .or("none; of a buoy half of what it displaces")
            .not_negative(),
    ],
    "drag and added mass of what -CLUMP attaches",
);
/// `-SLAM`.
pub const SLAM: OptionSpec = OptionSpec::ours("-SLAM", &[], "the line is slammed where it enters the water");
/// `-MID_TENSION`.
pub const MID_TENSION: OptionSpec = OptionSpec::ours(
    "-MID_TENSION",
    &[],
    "the tension reported at its ends is that in the middle of its end elements, as FairTen of MoorDyn; forces stay",
)
.default("the tension at the ends");
/// `-AX_DAMPING`.
pub const AX_DAMPING: OptionSpec = OptionSpec::ours(
    "-AX_DAMPING",
    &[number("C", PER_RATE, "tension per rate of strain").not_negative()],
    "axial internal damping",
)
.default("0");
choices! {
    /// Which ends of a line are held in their direction.
    pub enum ClampedEnd {
        /// The first.
        First = "FIRST",
        /// The second.
        Second = "SECOND",
        /// Both.
        Both = "BOTH",
    }
}

/// `-CLAMP`.
pub const CLAMP: OptionSpec = OptionSpec::ours(
    "-CLAMP",
    &[
        ValueSpec::choice::<ClampedEnd>("WHICH", "which end is held in its direction"),
        number("DEC", Dim::Angle, "declination from straight down at the first end, in the plane of the ends")
            .or("along the chord of the ends as defined"),
        number("K", Dim::MomentPerRadian, "rotational stiffness").or("rigid").positive(),
    ],
    "ends that what they are fixed to keeps from turning",
)
.default("both turn freely")
.many();
/// `-SEABED`.
pub const SEABED: OptionSpec = OptionSpec::ours(
    "-SEABED",
    &[
        number("K", PER_DEPTH, "normal stiffness per area of the line's shadow").positive(),
        number("C", PER_SPEED, "normal damping per area").or("half of critical").not_negative(),
        number("MUX", Dim::None, "friction across the line").or("that of -FRICTION").not_negative(),
        number("CF", PER_SPEED, "friction by speed alone, as in MoorDyn: per area and speed times the coefficient, up to Coulomb's; none at rest")
            .or("Coulomb's, also at rest")
            .not_negative(),
    ],
    "how the bottom answers the line",
)
.default("the heaviest segment sinks in by 2% of its diameter, under a tenth of its weight in air at least");

/// `-VERTICAL_PUSH`.
pub const VERTICAL_PUSH: OptionSpec =
    OptionSpec::ours("-VERTICAL_PUSH", &[], "the bottom pushes straight up on slopes too, as in MoorDyn")
        .default("along its normal");

/// What a record says beyond its section.
#[derive(Clone, Debug, PartialEq)]
pub struct Flexure {
    drag: f64,
    wind: f64,
    added: f64,
    /// Across, of the skin, of the wind.
    cd: [f64; 3],
    ca: [f64; 2],
    axial: TensionLaw,
    damping: f64,
    bending: f64,
    /// Poisson's ratio and thermal expansion of a tube.
    tube: Option<[f64; 2]>,
    /// Drag area (m2) and weight of the added mass (N) of what is attached, where given.
    clump: [Option<f64>; 2],
}

/// The values of an option, as far as they are given.
fn given_or<const N: usize>(given: Option<&Given>, keys: [ValueKey<f64>; N], default: [f64; N]) -> [f64; N] {
    let mut made = default;
    for (value, key) in made.iter_mut().zip(keys) {
        *value = given.and_then(|given| given.number(key)).unwrap_or(*value);
    }
    made
}

impl Flexure {
    /// Of a record and its section; `tube` where it has a wall.
    ///
    /// # Errors
    /// A law of stretch that does not rise.
    pub fn read(record: &ClassRecord, section: &LineSection) -> Outcome<Flexure> {
        let args = &record.args;
        let material = &record.defaults.material;
        let option = |option: &OptionSpec| args.number_if_declared(option);
        let typed = section.of_type.as_ref();
        if let (Some(given), 0.0) = (args.option_if_declared(&CLUMP_DRAG), section.clump) {
            return Err(Diagnostic::error("there is no clump or buoy whose drag this could be", given.span)
                .help("-CLUMP of the same record has its weight"));
        }
        let inner = section.thickness.map(|t| section.od - 2.0 * t);
        // EI of the tube from its EA: I/A is (D2 + d2)/16
        let bending = inner.map(|d| section.ea * (section.od * section.od + d * d) / 16.0);
        let bending = option(&o::EI).or(bending).unwrap_or(0.0);
        // a bar that does not bend is a chain or rope: there is nothing in it, and no wall
        let tube = inner.is_some_and(|d| d > 0.0) || bending > 0.0;
        Ok(Flexure {
            drag: option(&o::DRAGDIAMETER).or(typed.map(|t| t.drag)).unwrap_or(section.od),
            wind: option(&o::WINDDIAMETER).or(typed.map(|t| t.wind)).unwrap_or(section.od),
            added: option(&o::AMASDIAMETER).or(typed.map(|t| t.added_mass)).unwrap_or(section.od),
            cd: given_or(
                args.option_if_declared(&CD),
                const { CD.numbers(["CDN", "CDT", "CDW"]) },
                [typed.map_or(AQWA_CD, |t| t.line_type.drag.coefficient), AQWA_CX / PI, WIND_CD],
            ),
            ca: given_or(args.option_if_declared(&CA), const { CA.numbers(["CAN", "CAT"]) }, [AQWA_CA, 0.0]),
            axial: axial_law(record, section.ea)?,
            damping: option(&AX_DAMPING).unwrap_or(0.0),
            bending,
            tube: tube.then(|| {
                [option(&o::POI_RAT).unwrap_or(material.poisson), option(&o::ALPHA).unwrap_or(material.expansion)]
            }),
            clump: const { CLUMP_DRAG.numbers(["CDA", "ADDED"]) }
                .map(|key| args.option_if_declared(&CLUMP_DRAG).and_then(|given| given.number(key))),
        })
    }

    /// Tension over strain at no strain (N).
    pub fn ea(&self) -> f64 {
        self.axial.evaluate(0.0).1
    }

    /// What `-CLUMP` attaches: a weight in water without volume, or a buoy without mass on its pendant.
    fn joint(&self, section: &LineSection, around: &Surroundings) -> Option<JointMass> {
        let clump = section.clump;
        let [drag, added] = self.clump;
        let added = added.map(|weight| weight / around.gravity);
        let made = JointMass { drag: drag.unwrap_or(0.0), pendant: section.pendant, ..JointMass::default() };
        if clump > 0.0 {
            return Some(JointMass { mass: clump / around.gravity, added: added.unwrap_or(0.0), pendant: 0.0, ..made });
        }
        let displaced = -clump / around.gravity;
        let share = added.map_or(0.5, |added| added / displaced);
        (clump < 0.0).then_some(JointMass { volume: displaced / around.water_density, added: share, ..made })
    }

    /// The part of a section.
    pub fn part(&self, section: &LineSection, elements: usize, around: &Surroundings) -> LinePart {
        let area = |d: f64| FRAC_PI_4 * d * d;
        let displaced = area(section.buoyancy_diameter) + section.displacement / around.water_weight();
        let inner = section.thickness.map_or(0.0, |t| section.od - 2.0 * t);
        let tube = self.tube.map(|[poisson, expansion]| TubeSection {
            poisson,
            expansion,
            ..TubeSection::empty(section.od, inner.max(0.0))
        });
        let segment = RodSegment {
            axial: self.axial.clone(),
            axial_damping: self.damping,
            compression: self.bending > 0.0,
            bending: self.bending,
            displaced,
            drag_diameter: self.drag,
            drag_normal: self.cd[0],
            drag_tangential: self.cd[1],
            wind_diameter: self.wind,
            wind_drag: self.cd[2],
            added_area: area(self.added),
            added_normal: self.ca[0],
            added_tangential: self.ca[1],
            tube,
            ..RodSegment::line(section.length, elements, section.weight / around.gravity, section.ea, section.od)
        };
        let strength = BreakingStrength { breaking: section.breaking, is_given: section.break_is_given };
        LinePart { segment, strength, joint: self.joint(section, around) }
    }
}

/// Tension by strain of a record: of a fibre rope one of its bounds, or its static and dynamic stiffness.
fn axial_law(record: &ClassRecord, ea: f64) -> Outcome<TensionLaw> {
    let (args, chosen) = (&record.args, record.defaults.rope_stiffness);
    let slow = law(args, ea)?;
    match chosen {
        Some(RopeStiffness::Lower | RopeStiffness::Upper) => Ok(slow),
        Some(RopeStiffness::Dynamic) | None => rope(args, slow),
    }
}

/// The law of a fibre rope, whose static one is given; that itself of another line.
fn rope(args: &Args, slow: TensionLaw) -> Outcome<TensionLaw> {
    let Some(given) = args.option_if_declared(&ROPE) else { return Ok(slow) };
    let fast = given.numbers_or_zero(const { ROPE.numbers(["EAD", "B"]) });
    let stiffest = slow.evaluate(0.0).1;
    if fast[0] <= stiffest {
        return Err(Diagnostic::error("the dynamic stiffness EAD must be larger than the static one", given.span)
            .help("-EA K1 or -STRETCH gives the static stiffness of the rope; without them it is that of OD and T"));
    }
    Ok(TensionLaw::Viscoelastic(Box::new(ViscoelasticRope {
        slow,
        fast,
        relaxation: given.number(const { ROPE.number("TAU") }).unwrap_or(DEFAULT_RELAXATION_TIME_S),
    })))
}

/// Tension by strain.
fn law(args: &Args, ea: f64) -> Outcome<TensionLaw> {
    let (polynomial, table) = (args.option_if_declared(&EA), args.option_if_declared(&STRETCH));
    match (polynomial, table) {
        (Some(given), Some(other)) => {
            Err(Diagnostic::error("tension by strain is given twice", other.span).other(given.span, "and here"))
        }
        (Some(given), None) => {
            Ok(TensionLaw::from_powers(given.numbers_or_zero(const { EA.numbers(["K1", "K2", "K3"]) }).to_vec()))
        }
        (None, Some(given)) => {
            let mut points = vec![(0.0, 0.0)];
            for pair in given.groups() {
                let [tension, strain] = const { STRETCH.numbers(["T", "E"]) };
                let (Some(t), Some(e)) = (pair.number(tension), pair.number(strain)) else { continue };
                if (t, e) == (0.0, 0.0) && points.len() == 1 {
                    continue;
                }
                if points.last().is_some_and(|(last, pull)| e <= *last || t <= *pull) {
                    return Err(Diagnostic::error(
                        "tension and strain must both grow from point to point",
                        pair.position(strain),
                    )
                    .label("not beyond the point before, or zero"));
                }
                points.push((e, t));
            }
            Ok(TensionLaw::Table(points))
        }
        (None, None) => Ok(TensionLaw::Linear(ea)),
    }
}

/// The bottom under a line, of its options.
pub fn parse_seabed(options: &PerLineOptions) -> Seabed {
    let own = options.option(&SEABED);
    Seabed {
        stiffness: own.and_then(|given| given.number(const { SEABED.number("K") })),
        damping: own.and_then(|given| given.number(const { SEABED.number("C") })),
        along: options.number(&o::FRICTION).unwrap_or(0.0),
        across: own.and_then(|given| given.number(const { SEABED.number("MUX") })),
        friction_damping: own.and_then(|given| given.number(const { SEABED.number("CF") })),
        push: if options.option(&VERTICAL_PUSH).is_some() { SeabedPush::Vertical } else { SeabedPush::Normal },
        // -SLOPE is positive where the depth increases toward the anchor
        slope: options.number(&o::SLOPE),
        depth: options.number(&o::DEPANCHOR),
        with_anchor: false,
    }
}

/// How the ends are held, of every `-CLAMP` of a ROD and of its first and last segment.
///
/// # Errors
/// An end held twice, or one that does not bend.
pub fn read_end_fixities(clamps: &[Given], ends: [&Flexure; 2]) -> Outcome<[Option<EndFixity>; 2]> {
    let mut made = [None, None];
    let bends = ends.map(|f| f.bending > 0.0);
    for given in clamps {
        let held = match given.choice(const { CLAMP.choice("WHICH") }) {
            Some(ClampedEnd::First) => [true, false],
            Some(ClampedEnd::Second) => [false, true],
            Some(ClampedEnd::Both) => [true, true],
            None => [false, false],
        };
        const DECLINATION: ValueKey<f64> = CLAMP.number("DEC");
        const STIFFNESS: ValueKey<f64> = CLAMP.number("K");
        let hold = EndFixity { declination: given.number(DECLINATION), stiffness: given.number(STIFFNESS) };
        if let (Some(value), true) =
            (given.value(DECLINATION), hold.declination.is_some_and(|d| !(0.0..=PI).contains(&d)))
        {
            return Err(Diagnostic::error(
                "DEC of -CLAMP is 0 straight down and 180 straight up, and between",
                value.span,
            ));
        }
        for (((position, name), bends), held) in made.iter_mut().zip(["first", "second"]).zip(bends).zip(held) {
            if held {
                if !bends {
                    let text = format!("nothing holds the {name} end in its direction: its segment does not bend");
                    return Err(Diagnostic::error(text, given.span).help("-EI above zero, or no -CLAMP"));
                }
                if position.is_some() {
                    let text = format!("the {name} end is held twice");
                    return Err(Diagnostic::error(text, given.span));
                }
                *position = Some(hold);
            }
        }
    }
    Ok(made)
}

/// The line of sections without bending, cut into about so many elements by their lengths.
///
/// # Errors
/// Springs or devices at its ends, which a dynamic line does not have.
pub fn describe_chain(
    (kind, plain): (&'static str, bool),
    (sections, flexures): (&[LineSection], &[Flexure]),
    seabed: Seabed,
    elements: usize,
    around: &Surroundings,
) -> Result<LineDescription, ClassError> {
    if !plain {
        let text = "springs, dashpots, convolutions and pistons of a class do not go with dynamics of the line";
        return Err(ClassError::new(text).help("take -DYNAMICS 0, or a class without them"));
    }
    let whole: f64 = sections.iter().map(|s| s.length).sum();
    let share = |s: &LineSection| ((elements as f64 * s.length / whole).round() as usize).max(1);
    let count = |s: &LineSection| share(s).max(usize::try_from(s.refine).unwrap_or(1));
    let parts = sections.iter().zip(flexures).map(|(s, f)| f.part(s, count(s), around)).collect();
    Ok(description(kind, parts, seabed, [None, None]))
}

/// A line of these parts.
pub fn description(
    kind: &'static str,
    parts: Vec<LinePart>,
    seabed: Seabed,
    holds: [Option<EndFixity>; 2],
) -> LineDescription {
    let mut notes = Vec::new();
    if seabed.friction_damping.is_some() && seabed.along > 0.0 {
        notes.push("friction of the seabed rises with speed and holds nothing at rest: CF of -SEABED".to_string());
    }
    if seabed.push == SeabedPush::Vertical {
        notes.push("the bottom pushes straight up: -VERTICAL_PUSH".to_string());
    }
    LineDescription { kind, parts, seabed, holds, slam: false, has_middle_end_tension: false, notes }
}
