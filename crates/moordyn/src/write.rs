//! A [`Deck`] as text: a deck of MoorDyn 2 that MoorPy reads too.
//!
//! Numbers have the fewest digits that read back as the same number. Points have forces in a deck in which one of them has: MoorPy, which
//! has no columns for them, reads a deck without. What [`Deck`] holds of files of MAP++ alone ([`Deck::map`], friction of a type, lines
//! without contact) has no place in a deck.

use crate::Deck;
use crate::options::Options;
use crate::tables::{Attachment, AxialStiffness, Body, Height, Line, LineEnd, LineType, Point, Rod, RodType};

/// A table of a deck: the name of its section, the names and the units of its columns.
struct Table {
    section: &'static str,
    columns: &'static [(&'static str, &'static str)],
}

const LINE_TYPES: Table = Table {
    section: "LINE TYPES",
    columns: &[
        ("TypeName", "(name)"),
        ("Diam", "(m)"),
        ("Mass/m", "(kg/m)"),
        ("EA", "(N)"),
        ("BA/-zeta", "(N-s/-)"),
        ("EI", "(N-m^2)"),
        ("Cd", "(-)"),
        ("Ca", "(-)"),
        ("CdAx", "(-)"),
        ("CaAx", "(-)"),
    ],
};
const ROD_TYPES: Table = Table {
    section: "ROD TYPES",
    columns: &[
        ("TypeName", "(name)"),
        ("Diam", "(m)"),
        ("Mass/m", "(kg/m)"),
        ("Cd", "(-)"),
        ("Ca", "(-)"),
        ("CdEnd", "(-)"),
        ("CaEnd", "(-)"),
    ],
};
const BODIES: Table = Table {
    section: "BODIES",
    columns: &[
        ("ID", "(#)"),
        ("Attachment", "(word)"),
        ("X0", "(m)"),
        ("Y0", "(m)"),
        ("Z0", "(m)"),
        ("r0", "(deg)"),
        ("p0", "(deg)"),
        ("y0", "(deg)"),
        ("Mass", "(kg)"),
        ("CG", "(m)"),
        ("I", "(kg-m^2)"),
        ("Volume", "(m^3)"),
        ("CdA", "(m^2)"),
        ("Ca", "(-)"),
    ],
};
const RODS: Table = Table {
    section: "RODS",
    columns: &[
        ("ID", "(#)"),
        ("RodType", "(name)"),
        ("Attachment", "(word)"),
        ("Xa", "(m)"),
        ("Ya", "(m)"),
        ("Za", "(m)"),
        ("Xb", "(m)"),
        ("Yb", "(m)"),
        ("Zb", "(m)"),
        ("NumSegs", "(-)"),
        ("RodOutputs", "(-)"),
    ],
};
const POINTS: Table = Table {
    section: "POINTS",
    columns: &[
        ("ID", "(#)"),
        ("Attachment", "(word)"),
        ("X", "(m)"),
        ("Y", "(m)"),
        ("Z", "(m)"),
        ("Mass", "(kg)"),
        ("Volume", "(m^3)"),
        ("CdA", "(m^2)"),
        ("Ca", "(-)"),
    ],
};
const POINTS_WITH_FORCES: Table = Table {
    section: "POINTS",
    columns: &[
        ("ID", "(#)"),
        ("Attachment", "(word)"),
        ("X", "(m)"),
        ("Y", "(m)"),
        ("Z", "(m)"),
        ("Mass", "(kg)"),
        ("Volume", "(m^3)"),
        ("FX", "(N)"),
        ("FY", "(N)"),
        ("FZ", "(N)"),
        ("CdA", "(m^2)"),
        ("Ca", "(-)"),
    ],
};
const LINES: Table = Table {
    section: "LINES",
    columns: &[
        ("ID", "(#)"),
        ("LineType", "(name)"),
        ("AttachA", "(#)"),
        ("AttachB", "(#)"),
        ("UnstrLen", "(m)"),
        ("NumSegs", "(-)"),
        ("LineOutputs", "(-)"),
    ],
};

/// The shortest text of a number that reads back as it.
pub(crate) fn number(value: f64) -> String {
    let value = value + 0.0;
    if value == 0.0 || (1e-4..1e9).contains(&value.abs()) { format!("{value}") } else { format!("{value:E}") }
}

/// Several numbers between `|`.
fn joined(values: &[f64]) -> String {
    values.iter().map(|value| number(*value)).collect::<Vec<_>>().join("|")
}

/// The word of an attachment.
fn attachment(kind: Attachment) -> String {
    match kind {
        Attachment::Fixed => "Fixed".to_string(),
        Attachment::Coupled => "Coupled".to_string(),
        Attachment::CoupledPinned => "CoupledPinned".to_string(),
        Attachment::Free => "Free".to_string(),
        Attachment::Pinned => "Pinned".to_string(),
        Attachment::Body(id) => format!("Body{id}"),
        Attachment::BodyPinned(id) => format!("Body{id}Pinned"),
    }
}

/// The word of an end of a line; a point is its plain number, which alone MoorPy reads.
fn line_end(end: LineEnd) -> String {
    match end {
        LineEnd::Point(id) => id.to_string(),
        LineEnd::RodA(id) => format!("R{id}A"),
        LineEnd::RodB(id) => format!("R{id}B"),
    }
}

impl Table {
    /// Adds the table to a text, its columns aligned; nothing without rows.
    fn write(&self, text: &mut String, rows: &[Vec<String>]) {
        if rows.is_empty() {
            return;
        }
        text.push_str(&format!("--------------------- {} ---------------------\n", self.section));
        let names: Vec<String> = self.columns.iter().map(|(name, _)| (*name).to_string()).collect();
        let units: Vec<String> = self.columns.iter().map(|(_, unit)| (*unit).to_string()).collect();
        let all = [&names, &units].into_iter().chain(rows);
        let mut widths = vec![0; self.columns.len()];
        for row in all.clone() {
            for (width, cell) in widths.iter_mut().zip(row) {
                *width = cell.len().max(*width);
            }
        }
        for row in all {
            let cells: Vec<String> = row.iter().zip(&widths).map(|(cell, width)| format!("{cell:<width$}")).collect();
            text.push_str(cells.join("  ").trim_end());
            text.push('\n');
        }
    }
}

fn line_type(kind: &LineType) -> Vec<String> {
    let stiffness = match &kind.stiffness.value {
        AxialStiffness::Linear(ea) => number(*ea),
        AxialStiffness::Table(file) => file.clone(),
    };
    let [diameter, mass] = [&kind.diameter, &kind.mass].map(|given| number(given.value));
    let rest = [&kind.damping, &kind.bending, &kind.cd_normal, &kind.ca_normal, &kind.cd_axial, &kind.ca_axial];
    let mut row = vec![kind.name.value.clone(), diameter, mass, stiffness];
    row.extend(rest.map(|given| number(given.value)));
    row
}

fn rod_type(kind: &RodType) -> Vec<String> {
    let [[cd, ca], [cd_end, ca_end]] = [&kind.normal, &kind.end];
    let mut row = vec![kind.name.value.clone()];
    row.extend([&kind.diameter, &kind.mass, cd, ca, cd_end, ca_end].map(|given| number(given.value)));
    row
}

fn body(body: &Body) -> Vec<String> {
    let mut row = vec![body.id.value.to_string(), attachment(body.attachment.value)];
    row.extend(body.place.map(number));
    row.push(number(body.mass.value));
    row.extend([&body.centre, &body.inertia].map(|given| joined(&given.value)));
    row.push(number(body.volume.value));
    row.extend([&body.drag_area, &body.added_mass].map(|given| joined(&given.value)));
    row
}

fn rod(rod: &Rod) -> Vec<String> {
    let mut row = vec![rod.id.value.to_string(), rod.rod_type.value.clone(), attachment(rod.attachment.value)];
    row.extend(rod.ends.iter().flatten().map(|value| number(*value)));
    row.extend([rod.segments.value.to_string(), "-".to_string()]);
    row
}

fn point(point: &Point, has_forces: bool) -> Vec<String> {
    let [x, y] = point.horizontal.map(number);
    let z = match point.height.value {
        Height::Given(z) => number(z),
        Height::Seabed => "seabed".to_string(),
    };
    let mut row = vec![point.id.value.to_string(), attachment(point.attachment.value), x, y, z];
    row.extend([&point.mass, &point.volume].map(|given| number(given.value)));
    if has_forces {
        row.extend(point.force.map(number));
    }
    row.extend([&point.drag_area, &point.added_mass].map(|given| number(given.value)));
    row
}

fn line(line: &Line) -> Vec<String> {
    let [a, b] = line.ends.each_ref().map(|end| line_end(end.value));
    let outputs = if line.outputs.value.is_empty() { "-" } else { &line.outputs.value };
    vec![
        line.id.value.to_string(),
        line.line_type.value.clone(),
        a,
        b,
        number(line.length.value),
        line.segments.value.to_string(),
        outputs.to_string(),
    ]
}

/// The options that are given, value first.
fn options(options: &Options) -> Vec<(String, &'static str)> {
    let numbers = [
        (&options.gravity, "g"),
        (&options.density, "rho"),
        (&options.depth, "WtrDpth"),
        (&options.seabed_stiffness, "kBot"),
        (&options.seabed_damping, "cBot"),
        (&options.friction, "FrictionCoefficient"),
        (&options.friction_damping, "FricDamp"),
        (&options.static_friction_scale, "StatDynFricScale"),
    ];
    let modes = [(&options.wave_kinematics, "WaveKin"), (&options.currents, "Currents")];
    let numbers = numbers.into_iter().filter_map(|(given, name)| given.as_ref().map(|g| (number(g.value), name)));
    let modes = modes.into_iter().filter_map(|(given, name)| given.as_ref().map(|g| (g.value.to_string(), name)));
    let floor = options.seafloor_file.as_ref().map(|given| (given.value.clone(), "SeafloorFile"));
    numbers.chain(modes).chain(floor).collect()
}

/// The text of a deck. `heads` are lines before the first section, which nobody reads; a line break within one, or `---`, becomes a blank.
pub fn text(deck: &Deck, heads: &[String]) -> String {
    let mut text = String::new();
    for head in heads {
        text.push_str(head.replace("---", " ").replace(['\n', '\r', '\t'], " ").trim_end());
        text.push('\n');
    }
    LINE_TYPES.write(&mut text, &deck.line_types.iter().map(line_type).collect::<Vec<_>>());
    ROD_TYPES.write(&mut text, &deck.rod_types.iter().map(rod_type).collect::<Vec<_>>());
    BODIES.write(&mut text, &deck.bodies.iter().map(body).collect::<Vec<_>>());
    RODS.write(&mut text, &deck.rods.iter().map(rod).collect::<Vec<_>>());
    let has_forces = deck.points.iter().any(|point| point.force != [0.0; 3]);
    let table = if has_forces { POINTS_WITH_FORCES } else { POINTS };
    table.write(&mut text, &deck.points.iter().map(|p| point(p, has_forces)).collect::<Vec<_>>());
    LINES.write(&mut text, &deck.lines.iter().map(line).collect::<Vec<_>>());
    text.push_str("--------------------- OPTIONS ---------------------\n");
    for (value, name) in options(&deck.options) {
        text.push_str(&format!("{value}  {name}\n"));
    }
    for (name, value) in &deck.options.unused {
        text.push_str(&format!("{value}  {}\n", name.value));
    }
    if !deck.outputs.is_empty() {
        text.push_str("--------------------- OUTPUTS ---------------------\n");
        for output in &deck.outputs {
            text.push_str(&format!("{}\n", output.value));
        }
    }
    // MoorPy needs the end of the last section
    text.push_str("------------------------- need this line -------------------------\n");
    text
}
