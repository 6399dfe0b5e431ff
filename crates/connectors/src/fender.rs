//! FENDER: a fender between its base and a flat face, by the points of the maker's force-deflection curve.
//!
//! Source: [PIANC-WG33], which describes a fender by its rated deflection, its reaction and the energy absorbed, the area under the
//! curve; Coulomb friction between panel and hull. The curve may fall between its points, as those of buckling fenders do. The face is an
//! unbounded plane of the second end's body, so that the push acts where the fender stands, wherever the hull has moved along it.

use super::spring::no_anchor;
use super::spring_law::{Dashpot, Elastic, SpringGroup};
use super::zero_law::{ContactGeometry, Friction, Sense, ZeroLaw};
use super::zero_length::ZeroLength;
use super::{ClassKind, checks, options as o};
use nalgebra::{Matrix3, Vector3};
use std::sync::Arc;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::geometry::Place;
use windlass_base::span::Span;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_base::values::Args;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, OptionSpec, ValueSpec};
use windlass_model::Note;
use windlass_model::{
    ClassError, ClassRecord, ClassRole, Connection, Connector, ConnectorCategory, ConnectorClass, ConnectorElement,
    ConnectorResponse, ConnectorSummary, FenderState, LengthClass, Situation, SolverCache, Surroundings,
};

/// The class type.
pub static FENDER: ClassKind = ClassKind { spec: &SPEC, build, idle: &[] };

const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}

const NORMAL: OptionSpec = OptionSpec::new(
    "-NORMAL",
    &[
        number("X", Dim::None, "along element X"),
        number("Y", Dim::None, "along element Y"),
        number("Z", Dim::None, "along element Z"),
    ],
    "direction in which the second end is pushed, in the element axes",
)
.owner(Owner::Ours)
.default("1 0 0");
const RATED: OptionSpec = OptionSpec::new(
    "-RATED",
    &[number("Y", Dim::Length, "deflection").positive()],
    "rated deflection, beyond which reports warn",
)
.owner(Owner::Ours)
.default("that of the last point");
const FRICTION: OptionSpec = OptionSpec::new(
    "-FRICTION",
    &[number("MU", Dim::None, "coefficient of friction").in_range(0.0, 2.0)],
    "friction of the panel on the face, against the velocity; zero in statics",
)
.default("0");

static SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    data: &[
        number("H", Dim::Length, "height without load, from the base to the face").positive(),
        number("P", Dim::Force, "reaction").not_negative(),
        number("Y", Dim::Length, "deflection").not_negative(),
    ],
    repeat: 2,
    options: &[NORMAL, RATED, FRICTION, o::X_DAMPING, o::IG_STIFF],
    detail: "From a base, the first point, to a flat face that the second point lies on and whose body carries it. P Y: the maker's curve from \
             zero, deflections growing; the reaction may fall between two points, and beyond the last one its slope goes on. The fender \
             is deflected by H less the distance of the face from the base along the normal, and never pulls. The element axes are \
             the axes of the first point's body when the connector is defined, turned by -EULER: define it while the two \
             bodies are parallel. They go with the face. The face has no edge. &STATUS F_CONNECTOR and TDOM list deflection, \
             reaction and energy absorbed, the area under the curve, against the rated ones. -FRICTION acts at the first point, and is \
             rounded off under 1 cm/s. -X_DAMPING acts while the fender is deflected, as far as it pushes.",
    example: "MEDIT\n*QUAY 0 0 2\n&DESCRIBE BODY SHIP\n*SIDE 0 1.5 2\n~FENDER FENDER 1.5 200 0.3 210 0.5 260 0.75 -NORMAL 0 1 0 -FRICTION 0.2\n\
              CONNECTOR F1 ~FENDER *QUAY *SIDE\nEND\n&STATUS CLASS ~FENDER",
    ..CommandSpec::new("FENDER", "fender by points of its maker's curve")
};

/// The datum before the points of the curve.
const HEIGHT: DatumKey<f64> = SPEC.number("H");
const REACTION: DatumKey<f64> = SPEC.number("P");
const DEFLECTION: DatumKey<f64> = SPEC.number("Y");

/// Points of a curve, (reaction N, deflection m), the origin among them.
type Points = Vec<(f64, f64)>;

#[derive(Debug)]
struct Fender {
    curve: Arc<Points>,
    height: f64,
    rated: f64,
    normal: Vector3<f64>,
    friction: Friction,
    dashpot: Option<Dashpot>,
}

fn build(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    let Some(record) = records.last() else { return Err(Diagnostic::error("a class needs a record", Span::default())) };
    let args = &record.args;
    let height = args.number(HEIGHT).unwrap_or(0.0);
    let curve = points(args, height)?;
    let last = curve.last().map_or(0.0, |(_, y)| *y);
    let rated = args.option_number(&RATED).unwrap_or(last);
    if let Some(given) = args.option(&RATED).filter(|_| rated > last) {
        return Err(Diagnostic::error("the rated deflection lies beyond the last point of the curve", given.span)
            .help("give the points of the curve up to there"));
    }
    if reaction_and_energy(&curve, rated).1 <= 0.0 {
        let at = args.option(&RATED).map_or(record.args.span, |given| given.span);
        return Err(Diagnostic::error("the fender absorbs no energy up to its rated deflection", at)
            .help("the first reaction of the curve stands before the rated deflection"));
    }
    let mut normal = Vector3::x();
    if let Some(given) = args.option(&NORMAL) {
        normal = Vector3::from(given.numbers_or_zero(const { NORMAL.numbers(["X", "Y", "Z"]) }))
            .try_normalize(f64::MIN_POSITIVE)
            .ok_or_else(|| Diagnostic::error("-NORMAL has no direction: all three values are zero", given.span))?;
    }
    let friction = args.option_number(&FRICTION).filter(|mu| *mu > 0.0).map_or(Friction::None, Friction::Rate);
    Ok(Arc::new(Fender {
        curve: Arc::new(curve),
        height,
        rated,
        normal,
        friction,
        dashpot: Dashpot::read(args, &o::X_DAMPING),
    }))
}

/// The points of a record, checked.
fn points(args: &Args, height: f64) -> Outcome<Points> {
    let mut made: Points = vec![(0.0, 0.0)];
    for pair in args.groups_from(REACTION) {
        let (Some(force), Some(deflection)) = (pair.number(REACTION), pair.number(DEFLECTION)) else { continue };
        let position = pair.position(DEFLECTION);
        if deflection == 0.0 && made.len() == 1 {
            if force > 0.0 {
                return Err(Diagnostic::error("the curve of a FENDER begins at zero", pair.position(REACTION))
                    .label("a reaction without deflection"));
            }
            continue;
        }
        if deflection >= height {
            return Err(Diagnostic::error("a FENDER cannot be deflected by its whole height H", position)
                .help("points are pairs of reaction and deflection, P Y, as of -X_PY"));
        }
        if made.last().is_some_and(|(_, before)| deflection <= *before) {
            return Err(Diagnostic::error("the deflections of a FENDER must grow from point to point", position)
                .label("not larger than the one before"));
        }
        made.push((force, deflection));
    }
    match made.as_slice() {
        [.., before, last] if last.0 <= before.0 => {
            let position = args.groups_from(REACTION).last().map_or(args.span, |point| point.position(REACTION));
            Err(Diagnostic::error(
                "the curve of a FENDER must rise to its last point, beyond which its slope goes on",
                position,
            )
            .label("not larger than the one before"))
        }
        [_, ..] if made.len() > 1 => Ok(made),
        _ => Err(Diagnostic::error("a FENDER needs a point of its curve beyond zero", args.span)),
    }
}

/// Reaction (N) and energy absorbed (N m) at a deflection (m) of a curve; the last slope goes on.
fn reaction_and_energy(points: &[(f64, f64)], deflection: f64) -> (f64, f64) {
    let (mut reaction, mut energy) = (0.0, 0.0);
    let pieces = points.len().saturating_sub(1);
    for (index, piece) in points.windows(2).enumerate() {
        let [(p, y), (next, to)] = piece else { continue };
        let end = if index + 1 == pieces { deflection } else { deflection.min(*to) };
        if end <= *y {
            break;
        }
        reaction = p + (next - p) * (end - y) / (to - y);
        energy += 0.5 * (p + reaction) * (end - y);
    }
    (reaction, energy)
}

/// Axes of which the first is along a direction.
fn axes_along(direction: &Vector3<f64>) -> Matrix3<f64> {
    let least = direction.iamin();
    let mut other = Vector3::zeros();
    other[least] = 1.0;
    let second = direction.cross(&other).normalize();
    Matrix3::from_columns(&[*direction, second, direction.cross(&second)])
}

impl ConnectorClass for Fender {
    fn kind(&self) -> &'static str {
        "FENDER"
    }

    fn check_ends(&self, connector: &Connector, bodies: usize) -> Outcome<()> {
        no_anchor("FENDER", connector)?;
        if connector.points.len() < 2 {
            let text = "a FENDER takes 2 points: its base, and a point of the face that it meets";
            return Err(Diagnostic::error(text, connector.span));
        }
        checks::ends("FENDER", connector, bodies, 2, 2)
    }

    fn properties(&self, name: &str, _: &Surroundings) -> Table {
        let (most, energy) = reaction_and_energy(&self.curve, self.rated);
        let mut table = Table::new(format!("Class {name}"))
            .fact("Type", "FENDER", Dim::None)
            .fact("Height", self.height, Dim::Length)
            .fact("Rated Deflection", self.rated, Dim::Length)
            .fact("Reaction There", most, Dim::Force)
            .fact("Energy There", energy, Dim::Moment);
        if let Friction::Rate(mu) = self.friction {
            table = table.fact("Friction", mu, Dim::None);
        }
        let [x, y, z] = self.normal.into();
        table
            .fact("Normal", format!("{x:.3} {y:.3} {z:.3}"), Dim::None)
            .with_rows(&self.curve)
            .column("", "Deflection", Dim::Length, Digits::Decimals(4), |(_, deflection)| *deflection)
            .column("", "Reaction", Dim::Force, Digits::Usual, |(reaction, _)| *reaction)
            .column("", "Energy", Dim::Moment, Digits::Usual, |(_, deflection)| {
                reaction_and_energy(&self.curve, *deflection).1
            })
            .build()
    }

    fn role(&self) -> ClassRole {
        ClassRole::Fender
    }

    fn element(&self, connection: &Connection) -> Result<Box<dyn ConnectorElement>, ClassError> {
        let euler = connection.connector.euler.map_or(Matrix3::identity(), |turn| {
            let position = Place { turn, ..Default::default() };
            *position.rotation().matrix()
        });
        // X from the face toward the base: the face's body carries the axes
        let other_turn = euler * axes_along(&-self.normal);
        let [first, second] = connection.connector.defined;
        let turn = second.axes.transpose() * first.axes * other_turn;
        let spring = SpringGroup { dofs: vec![0], elastic: Elastic::from_curve(&self.curve), viscous: None };
        let law = ZeroLaw {
            sense: Sense::Compression,
            contact: ContactGeometry::Whole,
            groups: vec![spring],
            dashpots: self.dashpot.map(|d| (d, [true, false, false])).into_iter().collect(),
            friction: self.friction,
            pushes_only: true,
        };
        let rest = Vector3::x() * self.height;
        let spring = ZeroLength {
            holder: 1,
            turn,
            other_turn,
            rest,
            law,
            listed: vec![(0, None)],
            category: ConnectorCategory::Flexible,
        };
        Ok(Box::new(FenderGeometry { spring, curve: Arc::clone(&self.curve), height: self.height, rated: self.rated }))
    }

    fn as_length(&self) -> Option<&dyn LengthClass> {
        Some(self)
    }
}

impl LengthClass for Fender {
    fn first_length(&self) -> Option<f64> {
        Some(self.height)
    }
}

/// A fender between its base and its face.
#[derive(Debug)]
struct FenderGeometry {
    spring: ZeroLength,
    curve: Arc<Points>,
    height: f64,
    rated: f64,
}

impl ConnectorElement for FenderGeometry {
    fn states(&self) -> usize {
        self.spring.states()
    }

    fn evaluate(
        &self,
        at: &Situation,
        committed: &[f64],
        trial: &mut [f64],
        cache: &mut SolverCache,
        out: &mut ConnectorResponse,
    ) -> Result<(), ClassError> {
        self.spring.evaluate(at, committed, trial, cache, out)
    }

    fn summary(&self, at: &Situation, committed: &[f64]) -> Result<ConnectorSummary, ClassError> {
        let mut summary = self.spring.summary(at, committed)?;
        let deflection = summary.springs.first().map_or(0.0, |s| (-s.deflection).max(0.0));
        summary.springs.clear();
        let (reaction, energy) = reaction_and_energy(&self.curve, deflection);
        let rated_energy = reaction_and_energy(&self.curve, self.rated).1;
        if deflection > self.height {
            summary.notes.push(Note::warning(
                "the face stands behind the base of the fender: it is crushed, or its normal points away from the face",
            ));
        } else if deflection > self.rated {
            let share = 100.0 * deflection / self.rated;
            summary
                .notes
                .push(Note::warning(format!("deflected to {share:.0} per cent of the rated deflection of the fender")));
        }
        summary.fender = Some(FenderState { deflection, rated: self.rated, reaction, energy, rated_energy });
        Ok(summary)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fender_energy_is_area_under_curve() {
        // a buckling fender: 100 kN at 0.3 m, 80 kN at 0.5 m, 110 kN at 0.7 m: triangles and trapezia by hand
        let curve = [(0.0, 0.0), (100e3, 0.3), (80e3, 0.5), (110e3, 0.7)];
        for (y, p, e) in
            [(0.15, 50e3, 3.75e3), (0.4, 90e3, 24.5e3), (0.5, 80e3, 33e3), (0.7, 110e3, 52e3), (0.8, 125e3, 63.75e3)]
        {
            let (reaction, energy) = reaction_and_energy(&curve, y);
            assert!((reaction - p).abs() < 1e-6 && (energy - e).abs() < 1e-6, "{y}: {reaction} {energy}");
        }
    }
}
