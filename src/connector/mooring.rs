//! A mooring line between two places: what every class made of catenary segments answers.

use super::catenary::{
    Aim, FromTable, Interpolated, Joint, Law, Line, LineError, Row, Segment, SegmentState, ShapePoint, State, table,
};
use super::checks;
use super::line_report::{buoy_word, report};
use super::section::LineSection;
use crate::language::diagnostic::Outcome;
use crate::language::source::Span;
use crate::language::units::Dim;
use crate::model::{ClassError, ClassRecord, Condition, LineLoads, LineModel, Placement};
use crate::table::{Cell, Digits, Table};

/// Points inside each segment in a shape table.
const SHAPE_POINTS: usize = 9;

/// A line ready to be solved, with what is told of it.
#[derive(Clone, Debug)]
pub struct Mooring {
    /// The line.
    pub line: Line,
    /// Breaking tensions, fairlead first (N).
    pub breaks: Vec<f64>,
    /// Largest horizontal force of the table (N).
    pub largest: f64,
    /// Whether forces come from the exact solution, or from the table of thirty points.
    pub exact: bool,
    /// Its ends.
    pub place: Placement,
    /// Water surface and, where known, bottom at the anchor (m), for warnings of lines that see neither.
    pub surface: f64,
    /// Elevation of the sea bottom (m).
    pub bottom: Option<f64>,
    /// Records of the segments, for errors.
    pub places: Vec<Span>,
    /// What is always told of it.
    pub notes: Vec<String>,
}

impl Mooring {
    /// Elevation of the first end (m).
    pub fn fairlead(&self) -> f64 {
        let [_, _, z] = self.place.fairlead;
        z
    }

    fn error(&self, error: &LineError) -> ClassError {
        line_error(error, &self.places)
    }

    fn state(&self, condition: Condition) -> Result<State, ClassError> {
        let (placed, _) = self.place.span();
        let z = self.fairlead();
        let found = match condition {
            Condition::Placed => self.line.at_distance(placed, z),
            Condition::Distance(x) => self.line.at_distance(x, z),
            Condition::Horizontal(force) => self.line.at_horizontal_force(force, z),
            Condition::Tension(tension) => self.line.at_tension(tension, z),
        };
        found.map_err(|e| self.error(&e))
    }

    /// The largest tension over own break, and the segment that has it, from 1.
    fn ratio(&self, state: &State) -> (f64, usize) {
        let one = |s: &SegmentState| s.top_tension.max(s.bottom_tension);
        state.segments.iter().zip(&self.breaks).enumerate().fold((0.0, 1), |best, (i, (s, limit))| {
            let ratio = one(s) / limit;
            if ratio > best.0 { (ratio, i + 1) } else { best }
        })
    }

    /// What is dangerous or surprising about a state.
    fn remarks(&self, state: &State) -> Vec<String> {
        let mut notes = self.notes.clone();
        for (segment, _) in &state.below_bottom {
            notes.push(format!(
                "warning: segment {segment} hangs below the bottom, which it does not see above a spring buoy"
            ));
        }
        for (segment, _) in &state.above_surface {
            notes.push(format!("warning: segment {segment} or the buoy at its end rises above the water surface"));
        }
        if self.line.floor().is_none() {
            let shape = self.line.shape(state, SHAPE_POINTS);
            let lowest = shape.iter().fold(f64::INFINITY, |m, p| m.min(p.z));
            let (wet, dry) = (shape.iter().any(|p| p.z < self.surface), shape.iter().any(|p| p.z > self.surface));
            if self.bottom.is_some_and(|b| lowest < b) {
                notes.push("warning: the line passes below the sea bottom, which it does not see".into());
            }
            if wet && dry {
                notes.push("warning: the line crosses the water surface, which it does not see".into());
            }
        }
        if self.ratio(state).0 > 1.0 {
            notes.push("warning: the line is beyond its breaking tension".into());
        }
        notes
    }

    fn rows(&self) -> Result<Vec<Row>, ClassError> {
        table(&self.line, &self.breaks, self.largest, self.fairlead()).map_err(|e| self.error(&e))
    }
}

/// Segments and joints of a line's sections; the first is as long as the placement says, where it does.
pub fn parts(
    sections: &[LineSection],
    place: &Placement,
    weight: impl Fn(&LineSection) -> f64,
) -> (Vec<Segment>, Vec<Joint>) {
    let length = |i: usize, s: &LineSection| place.first_length.filter(|_| i == 0).unwrap_or(s.length);
    let segment = |(i, s): (usize, &LineSection)| Segment { length: length(i, s), weight: weight(s), ea: s.ea };
    let joint = |s: &LineSection| match s.clump {
        0.0 => Joint::Free,
        c if c < 0.0 => Joint::SpringBuoy { capacity: -c, depth: s.pendant },
        c => Joint::Weight(c),
    };
    let before = sections.split_last().map_or(&[][..], |(_, before)| before);
    (sections.iter().enumerate().map(segment).collect(), before.iter().map(joint).collect())
}

/// The springs of -SEND and -X_PY at the two ends; the curve is in series at the first.
///
/// # Errors
/// Options given twice with unlike values, curves that do not rise.
pub fn end_springs(records: &[ClassRecord]) -> Outcome<[Option<Law>; 2]> {
    let send = checks::once(records, "-SEND")?;
    let spring = |i: usize| send.and_then(|g| g.number(i)).map(Law::Linear);
    let curve = checks::once(records, "-X_PY")?.map(|given| {
        let numbers: Vec<f64> = given.values.iter().filter_map(|v| v.number()).collect();
        let points = numbers.chunks_exact(2).filter_map(|pair| pair.first().copied().zip(pair.get(1).copied()));
        Law::Curve(points.filter(|(p, y)| *p > 0.0 || *y > 0.0).collect())
    });
    let first = match (spring(0), curve) {
        (Some(spring), Some(curve)) => Some(Law::Series(vec![spring, curve])),
        (spring, curve) => spring.or(curve),
    };
    Ok([first, spring(1)])
}

/// The end springs with the long-term stiffness of a viscoelastic one in series at the first end (seed 001,
/// `-CONVOLUTION`; statics: reference/model.md).
///
/// # Errors
/// A curve that is not defined, or is no convolution.
pub fn with_series(
    springs: &[Option<Law>; 2],
    curve: Option<&(String, Span)>,
    place: &Placement,
) -> Result<[Option<Law>; 2], ClassError> {
    let [first, last] = springs.clone();
    let Some((name, span)) = curve else { return Ok([first, last]) };
    let stiffness = place.series.ok_or_else(|| {
        ClassError::new(format!("no convolution curve is called {name}"))
            .at(*span)
            .help(format!("define it: &DATA CONVOLUTION TIME {name} T1 K1 T2 K2 .."))
    })?;
    let spring = Law::Linear(stiffness);
    let first = first.map_or(spring.clone(), |law| Law::Series(vec![law, spring]));
    Ok([Some(first), last])
}

/// The curve that -CONVOLUTION names, with its place.
///
/// # Errors
/// Two unlike ones.
pub fn convolution(records: &[ClassRecord]) -> Outcome<Option<(String, Span)>> {
    let given = checks::once(records, "-CONVOLUTION")?;
    Ok(given.and_then(|g| g.values.first().and_then(|v| v.word()).map(|name| (name.to_string(), g.span))))
}

/// The error of a line, at the record of the segment it is about.
pub fn line_error(error: &LineError, places: &[Span]) -> ClassError {
    let segment = match error {
        LineError::Value { segment, .. } | LineError::Pendant { segment, .. } | LineError::Law(segment) => {
            Some(*segment)
        }
        _ => None,
    };
    let made = ClassError::new(error.to_string());
    let made = match error {
        LineError::BelowBottom(_) => made.help("check &INSTATE and -DEPANCHOR"),
        LineError::Undetermined => made.help("give it weight, or pull it tight"),
        LineError::Pendant { .. } => made.help("make CLEN shorter than the depth"),
        _ => made,
    };
    match segment.and_then(|n| places.get(n.saturating_sub(1))) {
        Some(span) => made.at(*span),
        None => made,
    }
}

impl LineModel for Mooring {
    fn tabulate(&self, connector: &str) -> Result<Table, ClassError> {
        let rows = self.rows()?;
        if let Some(first) = rows.first().filter(|r| r.ratio > 1.0) {
            let text = format!(
                "{connector} breaks before its table begins: hanging straight down, segment {} bears {:.3} of its break",
                first.critical, first.ratio
            );
            return Err(ClassError::new(text).help("a line shorter than the depth at its anchor cannot reach it"));
        }
        Ok(report(self, connector, &rows))
    }

    fn geometry(&self, connector: &str, condition: Condition) -> Result<Table, ClassError> {
        let state = self.state(condition)?;
        let mut out = Table::new(format!("Geometry of Line {connector}"))
            .fact("Horizontal Distance", state.x, Dim::Length)
            .fact("Horizontal Force", state.force, Dim::Force)
            .fact("Vertical Force", state.top_vertical, Dim::Force)
            .fact("Tension at Top", state.top_tension, Dim::Force)
            .fact("H. Pull at Anchor", state.anchor_horizontal, Dim::Force)
            .fact("V. Pull at Anchor", state.anchor_vertical, Dim::Force)
            .fact("Unstretched on Bottom", state.grounded, Dim::Length)
            .fact("Stretched on Bottom", state.grounded_stretched, Dim::Length);
        if let Some((x, z)) = state.touchdown {
            out = out.fact("Touchdown at X", x, Dim::Length).fact("Touchdown at Z", z, Dim::Length);
        }
        let mut out = out
            .column("", "X", Dim::Length, Digits::Usual)
            .column("", "Z", Dim::Length, Digits::Usual)
            .column("", "Arc Length", Dim::Length, Digits::Usual)
            .column("", "Segment", Dim::None, Digits::Usual)
            .column("", "Tension", Dim::Force, Digits::Usual)
            .column("Force", "Horizontal", Dim::Force, Digits::Usual)
            .column("Force", "Vertical", Dim::Force, Digits::Usual)
            .column("", "Angle", Dim::Angle, Digits::Usual)
            .column("", "T/Break", Dim::None, Digits::Decimals(3))
            .column("", "Bottom", Dim::Length, Digits::Usual)
            .column("", "Surface", Dim::Length, Digits::Usual)
            .column("", "Touchdown", Dim::Length, Digits::Usual)
            .column("", "Joint", Dim::Length, Digits::Usual);
        let shape = self.line.shape(&state, SHAPE_POINTS);
        let last = shape.last().map_or(0.0, |p| p.x);
        for (index, point) in shape.iter().enumerate() {
            // the row has one cell a column, made just above
            let _ = out.push(self.shape_row(&state, point, shape.get(index + 1), last));
        }
        out.notes = self.remarks(&state);
        out.notes.extend(state.joints.iter().enumerate().filter_map(|(i, j)| {
            j.buoy.map(|b| format!("the buoy at the end of segment {} is {}", i + 1, buoy_word(b)))
        }));
        if state.slack {
            out.note("the line needs no horizontal force to reach so far");
        }
        Ok(out)
    }

    fn loads(&self) -> Result<LineLoads, ClassError> {
        let (distance, along) = self.place.span();
        if self.exact {
            let state = match self.state(Condition::Placed) {
                Ok(state) => state,
                Err(error) => return self.limp(distance).ok_or(error),
            };
            let (ratio, critical) = self.ratio(&state);
            let kept = state.stiffness;
            let across = if distance > 0.0 { state.force / distance } else { kept[0][0] };
            return Ok(LineLoads {
                fairlead: [state.force * along[0], state.force * along[1], -state.top_vertical],
                other: [
                    -state.anchor_horizontal * along[0],
                    -state.anchor_horizontal * along[1],
                    state.anchor_vertical,
                ],
                stiffness: stiffness(along, kept, across),
                distance,
                tension: state.top_tension,
                ratio,
                critical,
                grounded: state.grounded,
                solution: "exact",
                notes: self.remarks(&state),
            });
        }
        let rows = self.rows()?;
        let FromTable { force, stiffness: slope, vertical, anchor, grounded, ratio, critical, beyond } =
            Interpolated::new(&rows).at(distance, &rows);
        let mut notes = self.notes.clone();
        if beyond {
            notes.push("warning: beyond the table; its last slope is continued".into());
        }
        if ratio > 1.0 {
            notes.push("warning: the line is beyond its breaking tension".into());
        }
        let across = if distance > 0.0 { force / distance } else { slope };
        Ok(LineLoads {
            fairlead: [force * along[0], force * along[1], -vertical],
            other: [-anchor[0] * along[0], -anchor[0] * along[1], anchor[1]],
            stiffness: stiffness(along, [[slope, 0.0], [0.0, 0.0]], across),
            distance,
            tension: force.hypot(vertical),
            ratio,
            critical,
            grounded,
            solution: "table",
            notes,
        })
    }

    fn distance(&self, condition: Condition) -> Result<f64, ClassError> {
        self.state(condition).map(|s| s.x)
    }

    fn first_length(&self, condition: Condition) -> Result<f64, ClassError> {
        let (x, _) = self.place.span();
        let z = self.fairlead();
        self.line.first_length(x, z, condition_value(condition)).map_err(|e| self.error(&e))
    }
}

/// Which force is asked for: the horizontal one or the tension, and its value; none for a distance.
fn condition_value(condition: Condition) -> Option<Aim> {
    match condition {
        Condition::Horizontal(force) => Some(Aim::Horizontal(force)),
        Condition::Tension(tension) => Some(Aim::Tension(tension)),
        Condition::Placed | Condition::Distance(_) => None,
    }
}

impl Mooring {
    /// A weightless line that is not tight: no force.
    fn limp(&self, distance: f64) -> Option<LineLoads> {
        let z = self.fairlead();
        let weightless = self.line.segments().iter().all(|s| s.weight == 0.0);
        let limp = weightless && matches!(self.line.at_distance(distance, z), Err(LineError::Undetermined));
        limp.then(|| LineLoads {
            fairlead: [0.0; 3],
            other: [0.0; 3],
            stiffness: [[0.0; 3]; 3],
            distance,
            tension: 0.0,
            ratio: 0.0,
            critical: 1,
            grounded: 0.0,
            solution: "exact",
            notes: self.notes.clone(),
        })
    }

    fn shape_row(&self, state: &State, point: &ShapePoint, next: Option<&ShapePoint>, last: f64) -> Vec<Cell> {
        let bottom = self.line.floor().map(|f| f.elevation + (last - point.x) * f.slope).or(self.bottom);
        let near = |x: f64, z: f64| (point.x - x).abs() + (point.z - z).abs() <= 1e-9 * (self.line.length() + x.abs());
        let touchdown = state.touchdown.is_some_and(|(x, z)| near(x, z));
        let joint = next.is_some_and(|n| n.segment > point.segment);
        let limit = self.breaks.get(point.segment.saturating_sub(1)).copied();
        vec![
            point.x.into(),
            point.z.into(),
            point.arc.into(),
            point.segment.into(),
            point.tension().into(),
            point.horizontal.into(),
            point.vertical.into(),
            point.angle().into(),
            limit.map(|l| point.tension() / l).into(),
            bottom.into(),
            self.surface.into(),
            touchdown.then_some(point.z).into(),
            joint.then_some(point.z).into(),
        ]
    }
}

/// d(force on the first end)/d(its position): `k` is d(H, V)/d(x, z), `across` H over the distance.
fn stiffness(along: [f64; 2], k: [[f64; 2]; 2], across: f64) -> [[f64; 3]; 3] {
    let [ux, uy] = along;
    let [[xx, xz], [zx, zz]] = k;
    let plane = |a: f64, b: f64, same: f64| -xx * a * b - across * (same - a * b);
    [
        [plane(ux, ux, 1.0), plane(ux, uy, 0.0), xz * ux],
        [plane(ux, uy, 0.0), plane(uy, uy, 1.0), xz * uy],
        [zx * ux, zx * uy, -zz],
    ]
}
