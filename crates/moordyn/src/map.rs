//! Tables of MAP++ [MAP-PP], and the copies that REPEAT makes.
//!
//! A file of MAP++ has four tables with the names of MoorDyn version 1 and columns of its own: friction CB in LINE DICTIONARY, no number of
//! segments in LINE PROPERTIES, and options whose name comes first. `#` before a number of a node says that MAP++ finds it from that guess.
//! Depth, density and gravity are not in the file: the program that calls MAP++ has them.

use crate::layout::{Column, Dialect, Layout, column, optional};
use crate::row::{Row, Word, number, size};
use crate::section::{Section, SectionKind};
use crate::tables::{Attachment, AxialStiffness, Cells, Height, Line, LineEnd, LineType, Point, line_end};
use crate::{Deck, Given};
use windlass_base::diagnostic::{Diagnostic, Outcome, suggest};

/// Most nodes and lines that REPEAT makes: more than any model takes.
const MAX_COPIES: usize = 100_000;

/// What only a file of MAP++ has.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MapOptions {
    /// REPEAT: angles (deg) of the copies of all nodes and lines about the vertical, clockwise seen from above.
    pub repeats: Vec<Given<f64>>,
    /// Options of MAP++'s own search and output, as written.
    pub unused: Vec<Given<String>>,
}

const LINE_DICTIONARY: [Column; 9] = [
    column(&["LineType", "TypeName", "Name"]),
    column(&["Diam", "Diameter"]),
    column(&["MassDenInAir", "MassDen", "Mass/m"]),
    column(&["EA"]),
    column(&["CB"]),
    optional(&["CIntDamp"]),
    optional(&["Ca"]),
    optional(&["Cdn"]),
    optional(&["Cdt"]),
];

const NODES: [Column; 10] = [
    column(&["Node"]),
    column(&["Type"]),
    column(&["X"]),
    column(&["Y"]),
    column(&["Z"]),
    column(&["M", "Mass"]),
    column(&["B", "V", "Volume"]),
    column(&["FX"]),
    column(&["FY"]),
    column(&["FZ"]),
];

const LINES: [Column; 6] = [
    column(&["Line"]),
    column(&["LineType", "Type"]),
    column(&["UnstrLen", "Length"]),
    column(&["NodeAnch", "NodeA"]),
    column(&["NodeFair", "NodeB"]),
    optional(&["Flags", "Outputs"]),
];

/// The types of nodes.
const NODE_TYPES: [(&str, Attachment); 3] =
    [("Fix", Attachment::Fixed), ("Connect", Attachment::Free), ("Vessel", Attachment::Coupled)];

/// What a flag of a line does.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Flag {
    /// Asks for output.
    Output,
    /// Takes the seabed away.
    OmitContact,
    /// Has a number behind it, and no effect on the system.
    Numbered,
    /// Changes the system in a way that is not read.
    Refused(&'static str, &'static str),
}

const FLAGS: [(&str, Flag); 28] = [
    ("GX_POS", Flag::Output),
    ("GY_POS", Flag::Output),
    ("GZ_POS", Flag::Output),
    ("GX_A_POS", Flag::Output),
    ("GY_A_POS", Flag::Output),
    ("GZ_A_POS", Flag::Output),
    ("GX_FORCE", Flag::Output),
    ("GY_FORCE", Flag::Output),
    ("GZ_FORCE", Flag::Output),
    ("H_FAIR", Flag::Output),
    ("H_ANCH", Flag::Output),
    ("V_FAIR", Flag::Output),
    ("V_ANCH", Flag::Output),
    ("TENSION_FAIR", Flag::Output),
    ("TENSION_ANCH", Flag::Output),
    ("X_EXCURSION", Flag::Output),
    ("Z_EXCURSION", Flag::Output),
    ("AZIMUTH", Flag::Output),
    ("ALTITUDE", Flag::Output),
    ("ALTITUDE_ANCH", Flag::Output),
    ("LINE_TENSION", Flag::Output),
    ("LAY_LENGTH", Flag::Output),
    ("PLOT", Flag::Output),
    ("OMIT_CONTACT", Flag::OmitContact),
    ("SEG_SIZE", Flag::Numbered),
    ("DIAGNOSTIC", Flag::Numbered),
    (
        "LINEAR_SPRING",
        Flag::Refused(
            "a line as a weightless linear spring is not read",
            "take LINEAR_SPRING out: the line is then an elastic catenary",
        ),
    ),
    (
        "DAMAGE_TIME",
        Flag::Refused("a line that is let go at a time is not read", "take DAMAGE_TIME out, and let it go by &ACTION"),
    ),
];

/// What an option does.
#[derive(Clone, Copy, PartialEq, Eq)]
enum OptionKind {
    Repeat,
    Unused,
}

const OPTIONS: [(&str, OptionKind); 21] = [
    ("REPEAT", OptionKind::Repeat),
    ("HELP", OptionKind::Unused),
    ("INNER_FTOL", OptionKind::Unused),
    ("INNER_GTOL", OptionKind::Unused),
    ("INNER_XTOL", OptionKind::Unused),
    ("INNER_MAX_ITS", OptionKind::Unused),
    ("OUTER_MAX_ITS", OptionKind::Unused),
    ("OUTER_TOL", OptionKind::Unused),
    ("OUTER_EPSILON", OptionKind::Unused),
    ("OUTER_BD", OptionKind::Unused),
    ("OUTER_CD", OptionKind::Unused),
    ("OUTER_FD", OptionKind::Unused),
    ("INTEGRATION_DT", OptionKind::Unused),
    ("KB_DEFAULT", OptionKind::Unused),
    ("CB_DEFAULT", OptionKind::Unused),
    ("WAVE_KINEMATICS", OptionKind::Unused),
    ("LM_MODEL", OptionKind::Unused),
    ("PG_COOKED", OptionKind::Unused),
    ("KRYLOV_ACCELERATOR", OptionKind::Unused),
    ("POWELL", OptionKind::Unused),
    ("REF_POSITION", OptionKind::Unused),
];

/// A number that may be a guess; `None`: `#` alone.
fn guess(word: &Word<'_>, what: &str) -> Outcome<Option<f64>> {
    match word.value.strip_prefix('#') {
        Some("") => Ok(None),
        Some(rest) => number(&Given { value: rest, span: word.span }, what).map(|given| Some(given.value)),
        None => number(word, what).map(|given| Some(given.value)),
    }
}

/// A number that MAP++ may not be left to find.
fn known(word: &Word<'_>, what: &str) -> Outcome<Given<f64>> {
    match word.value.strip_prefix('#') {
        Some(_) => {
            let error = Diagnostic::error(format!("{what} is to be found: {}", word.value), word.span);
            Err(error.label("expected a number without #"))
        }
        None => number(word, what),
    }
}

fn line_type(cells: &Cells<'_>) -> Outcome<LineType> {
    let zero = Given { value: 0.0, span: cells.span };
    let ea = cells.size(3, true)?;
    Ok(LineType {
        name: cells.text(0),
        diameter: cells.size(1, true)?,
        mass: cells.size(2, true)?,
        stiffness: Given { value: AxialStiffness::Linear(ea.value), span: ea.span },
        damping: zero.clone(),
        bending: zero.clone(),
        cd_normal: zero.clone(),
        ca_normal: zero.clone(),
        cd_axial: zero.clone(),
        ca_axial: zero,
        friction: Some(cells.size(4, false)?),
    })
}

fn node(cells: &Cells<'_>, messages: &mut Vec<Diagnostic>) -> Outcome<Point> {
    let kind = cells.word_or(1, "-");
    let found = NODE_TYPES.iter().find(|(name, _)| name.eq_ignore_ascii_case(kind.value));
    let Some(&(_, attachment)) = found else {
        let error = Diagnostic::error(format!("node type {} is not known", kind.value), kind.span);
        let error = error.label("expected Fix, Connect or Vessel");
        return Err(match suggest(kind.value, NODE_TYPES.iter().map(|(name, _)| *name)) {
            Some(help) => error.help(help),
            None => error,
        });
    };
    let is_free = attachment == Attachment::Free;
    let z = cells.word_or(4, "-");
    let given = [(2, "X"), (3, "Y"), (4, "Z")].map(|(index, what)| (cells.word_or(index, "-"), what));
    if let Some((word, what)) = given.iter().find(|(word, _)| is_free && word.value == "#") {
        let text = format!("{what} of the node has no guess: the search begins at 0");
        messages.push(*Diagnostic::remark(text, word.span));
    }
    let height = if z.value.eq_ignore_ascii_case("depth") {
        if attachment != Attachment::Fixed {
            return Err(Diagnostic::error("only a Fix node stands at the depth", z.span).label("expected Z (m)"));
        }
        Height::Seabed
    } else if is_free {
        Height::Given(guess(&z, "Z")?.unwrap_or(0.0))
    } else {
        Height::Given(known(&z, "Z")?.value)
    };
    let mut horizontal = [0.0; 2];
    for (value, (index, what)) in horizontal.iter_mut().zip([(2, "X"), (3, "Y")]) {
        let word = cells.word_or(index, "-");
        *value = if is_free { guess(&word, what)?.unwrap_or(0.0) } else { known(&word, what)?.value };
    }
    let mut force = [0.0; 3];
    for (value, (index, what)) in force.iter_mut().zip([(7, "FX"), (8, "FY"), (9, "FZ")]) {
        let word = cells.word_or(index, "-");
        if is_free {
            *value = known(&word, what).map_err(|error| error.help("a node that is held is of type Fix"))?.value;
        } else {
            // what holds the node, to be found
            guess(&word, what)?;
        }
    }
    let applied = |index: usize, what: &str| known(&cells.word_or(index, "0"), what);
    let (mass, volume) = (applied(5, "M")?, applied(6, "B")?);
    for (given, what) in [(&mass, "M"), (&volume, "B")] {
        if given.value < 0.0 {
            let error = Diagnostic::error(format!("{what} is {}", given.value), given.span);
            return Err(error.label("must be 0 or more"));
        }
    }
    let zero = Given { value: 0.0, span: cells.span };
    Ok(Point {
        id: cells.count(0, 1)?,
        attachment: Given { value: attachment, span: kind.span },
        horizontal,
        height: Given { value: height, span: z.span },
        mass,
        volume,
        force,
        drag_area: zero.clone(),
        added_mass: zero,
    })
}

/// A row of LINE PROPERTIES: five columns, then flags.
fn line(cells: &Cells<'_>, flags: &[Word<'_>], messages: &mut Vec<Diagnostic>) -> Outcome<Line> {
    let length = cells.word_or(2, "-");
    if length.value.starts_with('#') {
        let text = format!("MAP++ has no unknown lengths: of {} the number is the length", length.value);
        messages.push(*Diagnostic::remark(text, length.span));
    }
    let bare = Given { value: length.value.strip_prefix('#').unwrap_or(length.value), span: length.span };
    let mut has_contact = true;
    let mut words = flags.iter();
    while let Some(word) = words.next() {
        let found = FLAGS.iter().find(|(name, _)| name.eq_ignore_ascii_case(word.value));
        match found.map(|(_, flag)| *flag) {
            Some(Flag::Output) => {}
            Some(Flag::OmitContact) => has_contact = false,
            Some(Flag::Numbered) => {
                let missing = || Diagnostic::error(format!("{} has no number", word.value), word.span);
                number(words.next().ok_or_else(missing)?, word.value)?;
            }
            Some(Flag::Refused(what, help)) => return Err(Diagnostic::error(what, word.span).help(help)),
            None => {
                let error = Diagnostic::error(format!("flag {} is not known", word.value), word.span);
                return Err(match suggest(word.value, FLAGS.iter().map(|(name, _)| *name)) {
                    Some(help) => error.help(help),
                    None => error,
                });
            }
        }
    }
    Ok(Line {
        id: cells.count(0, 1)?,
        line_type: cells.text(1),
        ends: [line_end(&cells.word_or(3, "-"))?, line_end(&cells.word_or(4, "-"))?],
        length: size(&bare, "UnstrLen", true)?,
        segments: Given { value: 0, span: cells.span },
        outputs: Given { value: "-".to_string(), span: cells.span },
        has_contact,
    })
}

/// Reads a section into the deck.
pub(crate) fn read(section: &Section<'_>, deck: &mut Deck, messages: &mut Vec<Diagnostic>) {
    let columns: &'static [Column] = match section.kind {
        SectionKind::LineTypes => &LINE_DICTIONARY,
        SectionKind::Points => &NODES,
        SectionKind::Lines => &LINES,
        SectionKind::Options => {
            if let Some(options) = &mut deck.map {
                read_options(section, options, messages);
            }
            return;
        }
        SectionKind::Refused => return,
        SectionKind::RodTypes | SectionKind::Bodies | SectionKind::Rods | SectionKind::Outputs => {
            let error = Diagnostic::error("MAP++ has no such section, and the file is one of MAP++", section.head);
            messages.push(*error.help("a deck of MoorDyn has BA/-zeta and EI in LINE TYPES, and no CB"));
            return;
        }
    };
    let layout = Layout::new(section, columns, Dialect::Map, messages);
    for row in &section.rows {
        // behind the fifth column of a line are its flags, any number of them
        let count =
            if section.kind == SectionKind::Lines { row.words.len().min(LINES.len() - 1) } else { row.words.len() };
        let (words, flags) = row.words.split_at(count);
        let own = Row { words: words.to_vec(), ..row.clone() };
        let read = layout.place(&own).and_then(|words| {
            let cells = Cells::new(words, &own, columns);
            match section.kind {
                SectionKind::LineTypes => line_type(&cells).map(|kind| deck.line_types.push(kind)),
                SectionKind::Points => node(&cells, messages).map(|point| deck.points.push(point)),
                _ => line(&cells, flags, messages).map(|line| deck.lines.push(line)),
            }
        });
        if let Err(error) = read {
            messages.push(*error);
        }
    }
    if section.rows.is_empty() {
        messages.push(*Diagnostic::remark("the section has no rows", section.head));
    }
}

fn read_options(section: &Section<'_>, options: &mut MapOptions, messages: &mut Vec<Diagnostic>) {
    for row in [&section.columns, &section.units] {
        let first =
            row.words.first().filter(|word| OPTIONS.iter().any(|(known, _)| known.eq_ignore_ascii_case(word.value)));
        if let Some(word) = first {
            let error = Diagnostic::error(
                format!("option {} stands where its table has names and units", word.value),
                word.span,
            );
            messages.push(*error.help("MAP++ passes over the two lines behind SOLVER OPTIONS"));
        }
    }
    for row in &section.rows {
        if let Err(error) = option(row, options, messages) {
            messages.push(*error);
        }
    }
}

fn option(row: &Row<'_>, options: &mut MapOptions, messages: &mut Vec<Diagnostic>) -> Outcome<()> {
    let Some((name, values)) = row.words.split_first() else { return Ok(()) };
    if name.value.starts_with('!') {
        return Ok(());
    }
    let found = OPTIONS.iter().find(|(known, _)| known.eq_ignore_ascii_case(name.value));
    let Some(&(known, kind)) = found else {
        let error = Diagnostic::error(format!("option {} is not known", name.value), name.span);
        return Err(match suggest(name.value, OPTIONS.iter().map(|(known, _)| *known)) {
            Some(help) => error.help(help),
            None => error,
        });
    };
    if row.is_indented {
        let text = format!("{known} does nothing: its row begins with a blank, and MAP++ passes over such rows");
        messages.push(*Diagnostic::remark(text, name.span));
        return Ok(());
    }
    match kind {
        OptionKind::Repeat => {
            if values.is_empty() {
                return Err(Diagnostic::error("REPEAT has no angle", name.span).label("expected angles (deg)"));
            }
            for value in values {
                options.repeats.push(number(value, known)?);
            }
        }
        OptionKind::Unused => options.unused.push(Given { value: name.value.to_string(), span: name.span }),
    }
    Ok(())
}

/// Types of lines by their names in the dictionary, in any case.
pub(crate) fn match_names(deck: &mut Deck) {
    for line in &mut deck.lines {
        let same = |kind: &&LineType| kind.name.value.eq_ignore_ascii_case(&line.line_type.value);
        if let Some(kind) = deck.line_types.iter().find(same) {
            line.line_type.value.clone_from(&kind.name.value);
        }
    }
}

/// The copies of REPEAT: for each angle all nodes and lines again.
pub(crate) fn copy(deck: &mut Deck, messages: &mut Vec<Diagnostic>) {
    let (points, lines) = (deck.points.clone(), deck.lines.clone());
    let repeats = deck.map.as_ref().map_or_else(Vec::new, |options| options.repeats.clone());
    if let Some(last) = repeats.last().filter(|_| repeats.len() * (points.len() + lines.len()) > MAX_COPIES) {
        let text = format!("REPEAT makes more than {MAX_COPIES} nodes and lines");
        messages.push(*Diagnostic::error(text, last.span));
        return;
    }
    for (copy, angle) in (1..).zip(&repeats) {
        let (sin, cos) = angle.value.to_radians().sin_cos();
        let turned = |[x, y]: [f64; 2]| [x * cos + y * sin, y * cos - x * sin];
        let moved = |id: &Given<usize>, count: usize| Given { value: id.value + copy * count, span: id.span };
        deck.points.extend(points.iter().map(|point| {
            let [fx, fy, fz] = point.force;
            let [fx, fy] = turned([fx, fy]);
            Point {
                id: moved(&point.id, points.len()),
                horizontal: turned(point.horizontal),
                force: [fx, fy, fz],
                ..point.clone()
            }
        }));
        deck.lines.extend(lines.iter().map(|line| {
            let end = |given: &Given<LineEnd>| match given.value {
                LineEnd::Point(id) => Given { value: LineEnd::Point(id + copy * points.len()), span: given.span },
                LineEnd::RodA(_) | LineEnd::RodB(_) => given.clone(),
            };
            Line { id: moved(&line.id, lines.len()), ends: line.ends.each_ref().map(end), ..line.clone() }
        }));
    }
}

/// Whether a text is a file of MAP++: the names below LINE DICTIONARY have a CB, which no deck of MoorDyn has.
pub(crate) fn is_map(text: &str) -> bool {
    let mut lines = text
        .lines()
        .skip_while(|line| !(line.contains("---") && line.to_ascii_uppercase().contains("LINE DICTIONARY")));
    lines.nth(1).is_some_and(|names| {
        names.split_whitespace().any(|name| name.trim_matches(['(', ')', '[', ']']).eq_ignore_ascii_case("CB"))
    })
}
