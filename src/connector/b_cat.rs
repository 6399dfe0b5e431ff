//! B_CAT: a catenary to ground, of one or more segments.
//!
//! Source: seed 001, "An B_CAT class describes a catenary line"; which options hold per segment and which per line:
//! reference/model.md, last section.

use super::catenary::{Buoy, Joint, Line, LineError, ROWS, Row, Segment, table};
use super::section::{LineSection, properties};
use super::{ClassKind, checks, options as o};
use crate::language::diagnostic::{Diagnostic, Outcome};
use crate::language::source::Span;
use crate::language::spec::{CommandSpec, Kind, ValueSpec};
use crate::language::units::Dim;
use crate::model::{ClassError, ClassRecord, Connector, ConnectorClass, Placement, Surroundings};
use crate::table::{Cell, Digits, Table};
use std::sync::Arc;

/// The class type.
pub static B_CAT: ClassKind = ClassKind { spec: &SPEC, segmented: true, build };

static SPEC: CommandSpec = CommandSpec {
    data: &[
        o::LINE_OD,
        ValueSpec::new("FLAG", Kind::Choice(&["EXACT"]), "solve exactly instead of from a table").or("table"),
    ],
    options: &[
        o::LEN,
        o::TYPE,
        o::DEPANCHOR,
        o::REFINE,
        o::IG_STIFF,
        o::SEND,
        o::X_PY,
        o::X_DAMPING,
        o::SPGRAVITY,
        o::DENSITY,
        o::CONVOLUTION,
        o::EMODULUS,
        o::POI_RAT,
        o::ALPHA,
        o::FYIELD,
        o::TENSTR,
        o::WTPLEN,
        o::DISPLEN,
        o::PISTON,
        o::B_TENSION,
        o::C_SN,
        o::TAB_LIM,
        o::CLUMP,
        o::BUOYDIAMETER,
        o::DRAGDIAMETER,
        o::WINDDIAMETER,
        o::AMASDIAMETER,
        o::FRICTION,
        o::SLOPE,
    ],
    detail: "One record a segment, fairlead first, all with the same class name. A negative -CLUMP is a spring buoy: \
             the joint stays CLEN below the surface until the pull reaches the buoy's displacement, then sinks; the \
             segments above it do not see the bottom. -TYPE NAME D takes a chain or rope of the library (&STATUS LINE_TYPES) \
             instead of OD. Per segment: OD, -TYPE, -LEN, material, diameters, -CLUMP, -B_TENSION, -C_SN. Per line, on any \
             record: FLAG, -DEPANCHOR, -FRICTION, -SLOPE, -TAB_LIM, -SEND, -X_PY, -X_DAMPING, -CONVOLUTION, -PISTON. \
             Connects a body to ground.",
    example: "MEDIT\n~WIRE B_CAT 4.625 -LEN 500 -BUOY 0 -WTPL 37.51/1000 -EMOD 29000*0.1 -CLUMP -100\n\
              ~WIRE B_CAT 4.625 -LEN 4000 -BUOY 0 -WTPL 37.51/1000 -EMOD 29000*0.1 -DEPANCHOR 3000\nEND\n&STATUS CLASS ~WIRE",
    ..CommandSpec::new("B_CAT", "catenary to ground")
};

/// Options that hold for the whole line.
const PER_LINE: [&str; 9] =
    ["-DEPANCHOR", "-FRICTION", "-SLOPE", "-TAB_LIM", "-SEND", "-X_PY", "-X_DAMPING", "-CONVOLUTION", "-PISTON"];

/// Options that would change the table and do not act in it yet: a table without them would be wrong, so none is made.
const NOT_YET: [&str; 5] = ["-FRICTION", "-SLOPE", "-SEND", "-X_PY", "-CONVOLUTION"];

#[derive(Debug)]
struct Catenary {
    sections: Vec<LineSection>,
    places: Vec<Span>,
    exact: bool,
    depth: Option<f64>,
    friction: f64,
    slope: f64,
    limit: Option<f64>,
    /// An option whose action on the table is not made yet, with its place.
    not_yet: Option<(&'static str, Span)>,
    piston: bool,
}

fn build(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    let sections = records.iter().map(|r| LineSection::read(r, "B_CAT", false)).collect::<Outcome<Vec<_>>>()?;
    for name in PER_LINE {
        checks::once(records, name)?;
    }
    let not_yet =
        NOT_YET.into_iter().find_map(|name| checks::once(records, name).ok().flatten().map(|g| (name, g.span)));
    let number = |name: &str| checks::once(records, name).map(|g| g.and_then(|g| g.number(0)));
    Ok(Arc::new(Catenary {
        sections,
        places: records.iter().map(|r| r.args.option("-CLUMP").map_or(r.args.span, |c| c.span)).collect(),
        exact: records.iter().any(|r| r.args.word(1) == Some("EXACT")),
        depth: number("-DEPANCHOR")?,
        friction: number("-FRICTION")?.unwrap_or(0.0),
        slope: number("-SLOPE")?.unwrap_or(0.0),
        limit: number("-TAB_LIM")?,
        not_yet,
        piston: checks::once(records, "-PISTON")?.is_some(),
    }))
}

impl Catenary {
    /// Depth of the anchor below z = 0 (m).
    fn known_depth(&self, surroundings: &Surroundings) -> Result<f64, ClassError> {
        self.anchor_depth(surroundings).ok_or_else(|| {
            ClassError::new("the depth at the anchor is not known")
                .help("give -DEPANCHOR on the class, or -DEPTH on &ENV")
        })
    }

    fn line(&self, surroundings: &Surroundings) -> Result<Line, ClassError> {
        let segments = self
            .sections
            .iter()
            .map(|s| Segment { length: s.length, weight: s.submerged(surroundings), ea: s.ea })
            .collect();
        let joints = self
            .sections
            .split_last()
            .map_or(&[][..], |(_, before)| before)
            .iter()
            .map(|s| match s.clump {
                0.0 => Joint::Free,
                c if c < 0.0 => Joint::SpringBuoy { capacity: -c, depth: s.pendant },
                c => Joint::Weight(c),
            })
            .collect();
        let depth = self.known_depth(surroundings)?;
        Line::new(segments, joints, -depth, surroundings.tide).map_err(|e| self.class_error(&e))
    }

    fn class_error(&self, error: &LineError) -> ClassError {
        let segment = match error {
            LineError::Value { segment, .. } | LineError::Pendant { segment, .. } => Some(*segment),
            LineError::Law(segment) => Some(*segment),
            _ => None,
        };
        let place = segment.and_then(|n| self.places.get(n.saturating_sub(1)));
        let made = ClassError::new(error.to_string());
        place.map_or(made.clone(), |span| made.at(*span))
    }
}

impl ConnectorClass for Catenary {
    fn kind(&self) -> &'static str {
        "B_CAT"
    }

    fn check(&self) -> Outcome<()> {
        if let (Some(last), Some(place)) = (self.sections.last(), self.places.last())
            && last.clump < 0.0
        {
            return Err(Diagnostic::error("a spring buoy cannot be part of the last segment", *place)
                .label("this segment is attached to ground")
                .help("add the next segment with the same class name, or make CW positive"));
        }
        Ok(())
    }

    fn check_ends(&self, connector: &Connector, bodies: usize) -> Outcome<()> {
        checks::ends("B_CAT", connector, bodies, 2, 1)
    }

    fn properties(&self, name: &str, surroundings: &Surroundings) -> Table {
        let mut table = properties(name, "B_CAT", &self.sections, surroundings)
            .fact("Solution", if self.exact { "EXACT" } else { "table of thirty points" }, Dim::None)
            .fact("Depth at Anchor", self.depth.or(surroundings.depth), Dim::Length)
            .fact("Slope of Bottom", self.slope, Dim::None)
            .fact("Friction of Bottom", self.friction, Dim::None)
            .fact("Table Limit", self.limit.or(largest_break(&self.sections)), Dim::Force);
        if self.check().is_err() {
            table.note("a spring buoy ends the last segment: a further segment is needed");
        }
        table
    }

    fn first_length(&self) -> Option<f64> {
        self.sections.first().map(|s| s.length)
    }

    fn anchor_depth(&self, surroundings: &Surroundings) -> Option<f64> {
        self.depth.or(surroundings.depth)
    }

    fn tabulate(&self, connector: &str, place: &Placement, surroundings: &Surroundings) -> Result<Table, ClassError> {
        if let Some((name, span)) = self.not_yet {
            let text = format!("{name} does not act in a table yet, and a table without it would be wrong");
            return Err(ClassError::new(text)
                .at(span)
                .help("this version tabulates lines without end springs on a flat, smooth bottom"));
        }
        let line = self.line(surroundings)?;
        let breaks: Vec<f64> = self.sections.iter().map(|s| s.breaking).collect();
        let largest = self.limit.or(largest_break(&self.sections)).unwrap_or(0.0);
        let [_, _, fairlead] = place.fairlead;
        if fairlead < line_bottom(self, surroundings)? {
            return Err(
                ClassError::new("the fairlead lies below the anchor's depth").help("check &INSTATE and -DEPANCHOR")
            );
        }
        let rows = table(&line, &breaks, largest, fairlead).map_err(|e| self.class_error(&e))?;
        Ok(report(connector, self, &rows, fairlead, line_bottom(self, surroundings)?))
    }
}

fn line_bottom(class: &Catenary, surroundings: &Surroundings) -> Result<f64, ClassError> {
    Ok(-class.known_depth(surroundings)?)
}

fn largest_break(sections: &[LineSection]) -> Option<f64> {
    sections.iter().map(|s| s.breaking).reduce(f64::max)
}

/// The twelve columns of reference/solve.md, CONN_DESIGN.
fn report(connector: &str, class: &Catenary, rows: &[Row], fairlead: f64, bottom: f64) -> Table {
    let mut out = Table::new(format!("Properties of Line {connector}"))
        .fact("Water Depth", -bottom, Dim::Length)
        .fact("Fairlead Above Mean Water", fairlead, Dim::Length)
        .fact("Length of First Segment", class.first_length(), Dim::Length)
        .column("", "X", Dim::Length, Digits::Usual)
        .column("Horizontal", "Force", Dim::Force, Digits::Usual)
        .column("Horizontal", "DF/DX", Dim::ForcePerLength, Digits::Decimals(3))
        .column("Tension", "Ten Top", Dim::Force, Digits::Usual)
        .column("Tension", "Max T/TB", Dim::None, Digits::Decimals(3))
        .column("Tension", "Cri Break", Dim::Force, Digits::Usual)
        .column("Tension", "Crit. Seg", Dim::None, Digits::Usual)
        .column("Anchor", "V. Pull", Dim::Force, Digits::Usual)
        .column("Anchor", "H. Pull", Dim::Force, Digits::Usual)
        .column("", "Line on Bottom", Dim::Length, Digits::Usual)
        .column("1st Connection", "Height Ab Anchor", Dim::Length, Digits::Usual)
        .column("1st Connection", "Net Force Applied", Dim::Force, Digits::Usual);
    for row in rows {
        let s = &row.state;
        let joint = s.joints.first();
        let cells: Vec<Cell> = vec![
            s.x.into(),
            s.force.into(),
            (1.0 / s.dx_dh).into(),
            s.top_tension.into(),
            row.ratio.into(),
            row.critical_break.into(),
            row.critical.into(),
            s.anchor_vertical.into(),
            s.force.into(),
            s.grounded_stretched.into(),
            joint.map(|j| j.z - bottom).into(),
            joint.map(|j| j.lift).into(),
        ];
        // the row has one cell a column, made just above
        let _ = out.push(cells);
    }
    if let Some(first) = rows.iter().position(|r| r.ratio > 1.0) {
        out.note(format!("{} beyond the breaking tension (Max T/TB above 1)", rows_from(first, ROWS - 1)));
    }
    let states: Vec<Option<Buoy>> = rows.iter().map(|r| r.state.joints.iter().find_map(|j| j.buoy)).collect();
    out.notes.extend(buoy_notes(&states));
    if class.piston {
        out.note("the piston of -PISTON stands at its nominal position");
    }
    if rows.iter().any(|r| !r.state.below_bottom.is_empty()) {
        out.note("warning: a segment above the spring buoy hangs below the bottom in some rows (it does not see it)");
    }
    out
}

/// `row 3 is` or `rows 3 to 5 are`, counted from 1.
fn rows_from(first: usize, last: usize) -> String {
    if first == last { format!("row {} is", first + 1) } else { format!("rows {} to {} are", first + 1, last + 1) }
}

/// In which rows a spring buoy floats, hangs slack, or is sunk.
fn buoy_notes(states: &[Option<Buoy>]) -> Vec<String> {
    let word = |b: &Buoy| match b {
        Buoy::Slack => "slack",
        Buoy::Held => "held by its pendant",
        Buoy::Sunk => "sunk",
    };
    let mut notes = Vec::new();
    let mut from = 0;
    while let Some(Some(state)) = states.get(from) {
        let run = states.iter().skip(from).take_while(|s| **s == Some(*state)).count();
        notes.push(format!("{} with the spring buoy {}", rows_from(from, from + run - 1), word(state)));
        from += run;
    }
    notes
}
