//! A mooring line between two places: what every class made of catenary segments answers.

use super::line_element::LineElement;
use super::line_profile::LineProfile;
use super::mooring_table::{buoy_word, report};
use super::options as o;
use super::per_line::PerLineOptions;
use super::section::LineSection;
use windlass_base::message::Message;
use windlass_base::span::Span;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_catenary::{
    Aim, Heap, Joint, Line, LineError, LineState, MissingRow, Segment, SegmentState, ShapePoint, StretchLaw, TableRow,
    table,
};
use windlass_model::{
    AbsentRow, ClassError, Condition, ConnectorElement, FoundLength, Idealisation, LineChange, LineConfiguration,
    LineLoads, LineModel, LineSampling, Note, Placement,
};

/// Turn of a line between two points of its shape (rad): a polyline of a thousand pixels is then within half a pixel of the curve.
const MAX_TURN_RAD: f64 = 0.04;
/// The same where the extremes of a shape are looked for: within 1e-4 of its sag.
const CROSSING_POINTS: usize = 63;

/// A line ready to be solved, with what is reported of it.
#[derive(Clone, Debug)]
pub struct Mooring {
    /// The line.
    pub line: Line,
    /// Breaking tensions, fairlead first (N).
    pub breaks: Vec<f64>,
    /// Of each segment whether its break was given.
    pub breaks_given: Vec<bool>,
    /// Largest horizontal force of the table (N).
    pub largest: f64,
    /// Whether forces are interpolated in the table of thirty points (-TABLE); else they are solved exactly.
    pub tabulated: bool,
    /// The bathymetry below it, where it does not lie on a plane.
    pub profile: Option<LineProfile>,
    /// Its ends.
    pub position: Placement,
    /// Water surface and, where known, bottom at the anchor (m), for warnings of lines that see neither.
    pub surface: f64,
    /// Elevation of the sea bottom (m).
    pub bottom: Option<f64>,
    /// Records of the segments, for errors.
    pub positions: Vec<Span>,
    /// What is always reported of it.
    pub notes: Vec<Note>,
}

impl Mooring {
    /// Elevation of its fairlead (m).
    pub fn fairlead(&self) -> f64 {
        let [_, _, z] = self.position.fairlead;
        z
    }

    pub(super) fn error(&self, error: &LineError) -> ClassError {
        line_error(error, &self.positions)
    }

    /// Horizontal distance of the ends as they are (m), and the direction from the first to the other.
    pub(super) fn distance_and_direction(&self) -> Result<(f64, [f64; 2]), ClassError> {
        if self.position.other.is_none() {
            return Err(no_other_end());
        }
        Ok(self.position.span())
    }

    pub(super) fn state(&self, condition: Condition) -> Result<LineState, ClassError> {
        let z = self.fairlead();
        let found = match condition {
            Condition::Placed => self.line.at_distance(self.distance_and_direction()?.0, z),
            Condition::Distance(x) => self.line.at_distance(x, z),
            Condition::Horizontal(force) => self.line.at_horizontal_force(force, z),
            Condition::Tension(tension) => self.line.at_tension(tension, z),
            Condition::Vertical(force) => self.line.at_vertical_force(force, z),
        };
        found.map_err(|e| self.error(&e))
    }

    /// The largest tension over own break, and the segment that has it, from 1.
    pub(super) fn ratio(&self, state: &LineState) -> (f64, usize) {
        let one = |s: &SegmentState| s.top_tension.max(s.bottom_tension);
        state.segments.iter().zip(&self.breaks).enumerate().fold((0.0, 1), |best, (i, (s, limit))| {
            let ratio = one(s) / limit;
            if ratio > best.0 { (ratio, i + 1) } else { best }
        })
    }

    /// As [`Self::ratio`], of the segments whose break was given.
    pub(super) fn over_given_break(&self, state: &LineState) -> Option<(f64, usize)> {
        let limits = self.breaks.iter().zip(&self.breaks_given);
        let ratios = state.segments.iter().zip(limits).enumerate().filter(|(_, (_, (_, given)))| **given);
        let one = |(i, (s, (limit, _))): (usize, (&SegmentState, (&f64, _)))| {
            (s.top_tension.max(s.bottom_tension) / limit, i + 1)
        };
        ratios.map(one).max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// What is dangerous or surprising about a state.
    pub(super) fn remarks(&self, state: &LineState) -> Vec<Note> {
        let mut notes = self.notes.clone();
        for (segment, _) in &state.below_bottom {
            let text = format!(
                "segment {segment} hangs below the bottom, which it does not see above the spring buoy at its end"
            );
            notes.push(Note::warning(text));
        }
        if let Some((heap, _)) = state.heap {
            notes.push(
                match heap {
                    Heap::Touchdown => {
                        "idealised: the spare length lies in a heap at the touchdown; the line beyond it hangs on the anchor"
                    }
                    Heap::Anchor => "idealised: the spare length slides down the slope and lies in a heap at the anchor",
                    Heap::Hollow(_) => "idealised: the spare length lies in a heap in a hollow of the bottom",
                }
                .into(),
            );
        }
        for (segment, _) in &state.above_surface {
            let text = format!("segment {segment} or the buoy at its end rises above the water surface");
            notes.push(Note::warning(text));
        }
        if self.line.floor().is_none() {
            notes.extend(self.crossings(state));
        }
        if self.ratio(state).0 > 1.0 {
            notes.push(Note::warning("the line is beyond its breaking tension"));
        }
        notes
    }

    /// Where and by how much a line that sees neither passes below the bottom, and above the water surface.
    fn crossings(&self, state: &LineState) -> Vec<Note> {
        let shape = self.line.shape(state, CROSSING_POINTS);
        let Some(first) = shape.first() else { return Vec::new() };
        // an end at an elevation is computed with rounding
        let rounding = 1e-9 * (self.line.length() + self.surface.abs());
        let extreme = |sign: f64| {
            let high = shape.iter().fold(first, |best, p| if sign * p.z > sign * best.z { p } else { best });
            (high.x, high.z)
        };
        let ((low_x, low), (high_x, high)) = (extreme(-1.0), extreme(1.0));
        let note = |by: f64, what: &str, x: f64| {
            let text = format!("the line passes up to {{}} {what}, {{}} beside its first end, which it does not see");
            Note::warning(Message::with_values(text, &[(by, Dim::Length), (x, Dim::Length)]))
        };
        let below = self.bottom.map(|bottom| bottom - low).filter(|by| *by > rounding);
        let above = Some(high - self.surface).filter(|by| *by > rounding && low < self.surface - rounding);
        let below = below.map(|by| note(by, "below the sea bottom", low_x));
        below.into_iter().chain(above.map(|by| note(by, "above the water surface", high_x))).collect()
    }

    /// The rows of its table, and those without a configuration.
    pub(super) fn rows(&self) -> Result<(Vec<TableRow>, Vec<MissingRow>), ClassError> {
        self.table(self.fairlead()).map_err(|e| self.error(&e))
    }

    /// The same with its fairlead at an elevation (m).
    pub(super) fn table(&self, fairlead: f64) -> Result<(Vec<TableRow>, Vec<MissingRow>), LineError> {
        table(&self.line, &self.breaks, self.largest, fairlead)
    }
}

/// Segments and joints of a line's sections (m, N, N/m); the first is as long as the placement says, where it does.
pub fn segments_and_joints(
    sections: &[LineSection],
    position: &Placement,
    weight: impl Fn(&LineSection) -> f64,
) -> (Vec<Segment>, Vec<Joint>) {
    let length = |i: usize, s: &LineSection| position.first_length.filter(|_| i == 0).unwrap_or(s.length);
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
pub fn end_springs(options: &PerLineOptions) -> [Option<StretchLaw>; 2] {
    let send = options.option(&o::SEND);
    let [first, second] = const { o::SEND.numbers(["KE(1)", "KE(2)"]) }
        .map(|key| send.and_then(|given| given.number(key)).map(StretchLaw::Linear));
    let curve = options.option(&o::X_PY).map(|given| {
        let [force, deflection] = const { o::X_PY.numbers(["P", "Y"]) };
        let points = given.groups().filter_map(|pair| pair.number(force).zip(pair.number(deflection)));
        StretchLaw::Curve(points.filter(|(p, y)| *p > 0.0 || *y > 0.0).collect())
    });
    let first = match (first, curve) {
        (Some(spring), Some(curve)) => Some(StretchLaw::Series(vec![spring, curve])),
        (spring, curve) => spring.or(curve),
    };
    [first, second]
}

/// The end springs with the long-term stiffness of a viscoelastic one in series at the first end
/// ([MOSES-FLEX -CONVOLUTION]; statics: [W-VISCOUS]).
///
/// # Errors
/// A curve that is not defined, or is no convolution.
pub fn with_series(
    springs: &[Option<StretchLaw>; 2],
    curve: Option<&(String, Span)>,
    position: &Placement,
) -> Result<[Option<StretchLaw>; 2], ClassError> {
    let [first, last] = springs.clone();
    let Some((name, span)) = curve else { return Ok([first, last]) };
    let stiffness = position.series.ok_or_else(|| no_curve(name, *span))?;
    let spring = StretchLaw::Linear(stiffness);
    let first = first.map_or(spring.clone(), |law| StretchLaw::Series(vec![law, spring]));
    Ok([Some(first), last])
}

/// A curve that is not defined, or is no convolution.
pub fn no_curve(name: &str, at: Span) -> ClassError {
    ClassError::new(format!("no convolution curve is called {name}"))
        .with_span(at)
        .help(format!("define it: &DATA CONVOLUTION TIME {name} T1 K1 T2 K2 .."))
}

/// A line whose other end is not known.
pub fn no_other_end() -> ClassError {
    ClassError::new("the other end of the line has no place")
        .help("with -ANCHOR on the connector: give the depth there, by -DEPANCHOR or by -DEPTH on &ENV")
        .help("without: give -ANCHOR or a second point")
}

/// The error of a line, at the record of the segment it is about.
pub fn line_error(error: &LineError, positions: &[Span]) -> ClassError {
    let segment = match error {
        LineError::Value { segment, value, .. } if value.abs() < 1e100 => Some(*segment),
        LineError::Pendant { segment, .. } | LineError::StretchLaw(segment) => Some(*segment),
        _ => None,
    };
    let (length, force) = (Dim::Length, Dim::Force);
    let made = match error {
        LineError::BelowBottom(by) => {
            ClassError::with_values("the fairlead lies {} below the bottom", &[(*by, length)])
        }
        LineError::AnchorBelow(by) => ClassError::with_values("the anchor lies {} below the bottom", &[(*by, length)]),
        LineError::Pendant { segment, by } => {
            let text = format!("the pendant of segment {segment} is {{}} longer than the water is deep there");
            ClassError::with_values(text, &[(*by, length)])
        }
        LineError::Weight { what, wanted, least } => ClassError::with_values(
            format!("no position has the {what} {{}}: the line hanging straight down has {{}}"),
            &[(*wanted, force), (*least, force)],
        ),
        LineError::NoLength { wanted, nearest } => ClassError::with_values(
            "no length of the first segment gives {}; the nearest is {}",
            &[(*wanted, force), (*nearest, force)],
        ),
        LineError::Unproven { tension, .. } if tension.is_finite() => ClassError::with_values(
            "no configuration between the ends could be proven, near a tension of {}",
            &[(*tension, force)],
        ),
        LineError::NotConverged { force: at, .. } if at.is_finite() => {
            ClassError::with_values("no configuration found, near a force of {}", &[(*at, force)])
        }
        _ => ClassError::new(error.to_string()),
    };
    let made = match error {
        LineError::BelowBottom(_) => made.help("check &INSTATE and -DEPANCHOR"),
        LineError::Undetermined => made.help("give it weight, or pull it tight"),
        LineError::Pendant { .. } => made.help("make CLEN shorter than the depth"),
        LineError::Unproven { .. } | LineError::NotConverged { .. } => made
            .help("change the length, the place of the anchor or the buoys a little; without friction more is solved"),
        _ => made,
    };
    match segment.and_then(|n| positions.get(n.saturating_sub(1))) {
        Some(span) => made.with_span(*span),
        None => made,
    }
}

impl LineModel for Mooring {
    fn tabulate(&self, connector: &str) -> Result<(Table, Vec<AbsentRow>), ClassError> {
        let (rows, missing) = self.rows()?;
        if let Some(first) = rows.first().filter(|r| r.ratio > 1.0) {
            let text = format!(
                "{connector} breaks before its table begins: hanging straight down, segment {} bears {:.3} of its break",
                first.critical, first.ratio
            );
            return Err(ClassError::new(text)
                .help("a line too short for the depth at its anchor, or with too small a break, cannot hang there"));
        }
        Ok((report(self, connector, &rows, &missing), missing.iter().map(|row| self.absent(row)).collect()))
    }

    fn geometry(&self, connector: &str, condition: Condition, sampling: LineSampling) -> Result<Table, ClassError> {
        let state = self.state(condition)?;
        let mut out = Table::new(format!("Geometry of Line {connector}"))
            .fact("Model", Idealisation::QuasiStatic, Dim::None)
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
        let shape = match sampling {
            LineSampling::Adaptive => self.line.adaptive_shape(&state, MAX_TURN_RAD),
            LineSampling::Inside(points) => self.line.shape(&state, points),
        };
        let points: Vec<ProfilePoint> =
            shape.iter().enumerate().map(|(i, point)| self.profile_point(&state, point, shape.get(i + 1))).collect();
        let mut out = out
            .with_rows(&points)
            .column("", "X", Dim::Length, Digits::Usual, |p| p.point.x)
            .column("", "Z", Dim::Length, Digits::Usual, |p| p.point.z)
            .column("", "Arc Length", Dim::Length, Digits::Usual, |p| p.point.arc)
            .column("", "Segment", Dim::None, Digits::Usual, |p| p.point.segment)
            .column("", "Tension", Dim::Force, Digits::Usual, |p| p.point.tension())
            .column("Force", "Horizontal", Dim::Force, Digits::Usual, |p| p.point.horizontal)
            .column("Force", "Vertical", Dim::Force, Digits::Usual, |p| p.point.vertical)
            .column("", "Angle", Dim::Angle, Digits::Usual, |p| p.point.angle())
            .column("", "T/Break", Dim::None, Digits::Decimals(3), |p| p.breaking.map(|b| p.point.tension() / b))
            .column("", "Bottom", Dim::Length, Digits::Usual, |p| p.bottom)
            .column("", "Surface", Dim::Length, Digits::Usual, |_| self.surface)
            .column("", "Touchdown", Dim::Length, Digits::Usual, |p| p.is_touchdown.then_some(p.point.z))
            .column("", "Joint", Dim::Length, Digits::Usual, |p| p.is_joint.then_some(p.point.z))
            .build();
        out.add_notes(state.joints.iter().enumerate().filter_map(|(i, j)| {
            j.buoy.map(|b| format!("the buoy at the end of segment {} is {}", i + 1, buoy_word(b)))
        }));
        if state.slack {
            out.note("the line needs no horizontal force to reach so far");
        }
        if self.tabulated && condition == Condition::Placed {
            out.note(
                "solved exactly; the forces of this class between its ends are interpolated in its table (-TABLE)",
            );
        }
        Ok(out)
    }

    fn configuration(&self, condition: Condition) -> Result<LineConfiguration, ClassError> {
        let state = self.state(condition)?;
        let (ratio, critical) = self.ratio(&state);
        Ok(LineConfiguration {
            distance: state.x,
            horizontal: state.force,
            vertical: state.top_vertical,
            tension: state.top_tension,
            ratio,
            critical,
            anchor: [state.anchor_horizontal, state.anchor_vertical],
            on_bottom: state.grounded_stretched,
            notes: self.remarks(&state),
        })
    }

    fn loads(&self) -> Result<LineLoads, ClassError> {
        if self.tabulated { self.tabled_loads() } else { self.exact_loads() }
    }

    fn element(&self) -> Result<Box<dyn ConnectorElement>, ClassError> {
        Ok(Box::new(LineElement::new(self.clone())?))
    }

    fn with_change(&self, change: LineChange) -> Result<Box<dyn LineModel>, ClassError> {
        Ok(Box::new(self.with_change(change)?))
    }

    fn distance(&self, condition: Condition) -> Result<f64, ClassError> {
        self.state(condition).map(|s| s.x)
    }

    fn first_length(&self, condition: Condition) -> Result<FoundLength, ClassError> {
        let (x, _) = self.distance_and_direction()?;
        let present = self.line.segments().first().map_or(0.0, |s| s.length);
        let aim = match condition {
            Condition::Tension(tension) => Aim::Tension(tension),
            Condition::Horizontal(force) => Aim::Horizontal(force),
            Condition::Vertical(_) => {
                return Err(ClassError::new("a length is solved for a horizontal force or a tension"));
            }
            Condition::Placed | Condition::Distance(_) => return Ok(FoundLength::single(present)),
        };
        let lengths = self.line.first_lengths(x, self.fairlead(), aim).map_err(|e| self.error(&e))?;
        let (length, others) = lengths.nearest(present).unwrap_or((present, Vec::new()));
        Ok(FoundLength { length, others, unsolved: lengths.unsolved })
    }
}

impl Mooring {
    fn absent(&self, row: &MissingRow) -> AbsentRow {
        AbsentRow { number: row.number, error: self.error(&row.error) }
    }

    fn profile_point(&self, state: &LineState, point: &ShapePoint, next: Option<&ShapePoint>) -> ProfilePoint {
        let near = |x: f64, z: f64| (point.x - x).abs() + (point.z - z).abs() <= 1e-9 * (self.line.length() + x.abs());
        // less than what a solution is proven to is no force
        let force = |f: f64| if f.abs() <= 1e-9 * state.top_tension { 0.0 } else { f };
        ProfilePoint {
            point: ShapePoint { horizontal: force(point.horizontal), vertical: force(point.vertical), ..*point },
            breaking: self.breaks.get(point.segment.saturating_sub(1)).copied(),
            bottom: self.line.bottom_at(state.x - point.x).or(self.bottom),
            is_touchdown: state.touchdown.is_some_and(|(x, z)| near(x, z)),
            is_joint: next.is_some_and(|n| n.segment > point.segment),
        }
    }
}

/// A point of the table of a line's geometry.
struct ProfilePoint {
    point: ShapePoint,
    /// Breaking tension of its segment (N).
    breaking: Option<f64>,
    /// Elevation of the bottom under it (m).
    bottom: Option<f64>,
    /// Whether the line touches the bottom here.
    is_touchdown: bool,
    /// Whether a segment ends here.
    is_joint: bool,
}

/// Stretch beyond which a line over its break is too short for its ends: steel breaks below 0.02, nylon above 0.2, and that has its break
/// given.
const MAX_STRAIN_OVER_BREAK: f64 = 0.05;

/// By what share of its length a line is too short for its ends, by their distance over its length and its tension over its break.
pub fn too_short(taut: f64, ratio: f64) -> Option<f64> {
    (taut > 1.0 + MAX_STRAIN_OVER_BREAK && ratio > 1.0).then_some(taut - 1.0)
}

/// What is said of it.
pub fn too_short_note(share: f64) -> Note {
    Note::warning(format!("it is {:.1} per cent too short for its ends", 100.0 * share))
}
