//! Deck 2: the elements of the structures.
//!
//! A structure is one rigid body made of all elements of its deck ELMn. A card holds the kind of element and, from
//! column 21 on, groups in brackets: the number of elements to make, then for each node `(node, step)`, then the
//! material group and the geometry group where the kind has them, each with a step of its own if wanted.
//!
//! SYMX mirrors the panels of a structure at Y = 0, SYMY at X = 0. HYDI names the first of the structures that are solved together with this one.
//! Text behind the brackets is a remark, as programs that write decks leave it.
//!
//! Source: [AQWA-REF deck 2]; [AQWA-TETHER 8.1.2 and 8.2.2]; the planes of SYMX and SYMY, and the remarks, by decks of [BEMROSETTA-AQWA].

use super::card::{Field, integer, real};
use super::layout::{CardLayout, CardRecord, int};
use super::remarks::Remarks;
use std::collections::HashMap;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;

/// Most elements of a deck.
pub const MAX_ELEMENTS: usize = 60_000;

/// Kinds of element.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ElementShape {
    /// Morison tube between two nodes.
    Tube,
    /// Point mass.
    PointMass,
    /// Slender element of three nodes with given properties.
    Stub,
    /// Disc with drag and added mass normal to it.
    Disc,
    /// Point buoyancy.
    PointBuoyancy,
    /// Panel of four nodes.
    Quad,
    /// Panel of three nodes.
    Triangle,
    /// Point of the field.
    FieldPoint,
}

/// Keyword, kind, number of nodes, whether a material and whether a geometry follow.
const KINDS: &[(&str, ElementShape, usize, bool, bool)] = &[
    ("TUBE", ElementShape::Tube, 2, true, true),
    ("PMAS", ElementShape::PointMass, 1, true, true),
    ("STUB", ElementShape::Stub, 3, true, true),
    ("DISC", ElementShape::Disc, 2, false, true),
    ("PBOY", ElementShape::PointBuoyancy, 1, true, false),
    ("QPPL", ElementShape::Quad, 4, false, false),
    ("TPPL", ElementShape::Triangle, 3, false, false),
    ("FPNT", ElementShape::FieldPoint, 1, false, false),
];

const UNPUBLISHED_CARD_REASON: &str =
    "the effect of this card is published nowhere; give all panels in deck 2, where they are";
const EXTERNAL_LID_REASON: &str =
    "a lid that takes energy from the water outside a hull is not read; leave the card out, and its panels";
const PROFILE_REASON: &str = "panels of a profile that is turned about Z are not made; give them by QPPL and TPPL";

/// Cards of deck 2.
pub const LAYOUTS: &[CardLayout] = &[
    CardLayout::brackets("TUBE").freely(),
    CardLayout::brackets("PMAS").freely(),
    CardLayout::brackets("STUB").freely(),
    CardLayout::brackets("DISC").freely(),
    CardLayout::brackets("PBOY").freely(),
    CardLayout::brackets("QPPL").freely(),
    CardLayout::brackets("TPPL").freely(),
    CardLayout::brackets("FPNT").freely(),
    CardLayout::brackets("ZLWL"),
    CardLayout::new("FIXD", &[]),
    CardLayout::new("SYMX", &[]),
    CardLayout::new("SYMY", &[]),
    CardLayout::refuse("RMXS", UNPUBLISHED_CARD_REASON),
    CardLayout::refuse("RMYS", UNPUBLISHED_CARD_REASON),
    CardLayout::new(
        "HYDI",
        &[int("first structure of those that are solved together", 16).required().not_below_zero()],
    ),
    CardLayout::brackets("ILID"),
    CardLayout::refuse("VLID", EXTERNAL_LID_REASON),
    CardLayout::pass_over("SEAG", "the grid of the sea is for pictures of AQWA and has no effect"),
    CardLayout::refuse("MSTR", UNPUBLISHED_CARD_REASON),
    CardLayout::refuse("ASYM", PROFILE_REASON),
];

/// An element of a structure.
#[derive(Clone, Debug, PartialEq)]
pub struct StructureElement {
    /// What it is.
    pub shape: ElementShape,
    /// Its nodes.
    pub nodes: Vec<i64>,
    /// Material group; 0 where the kind has none.
    pub material: i64,
    /// Geometry group; 0 where the kind has none.
    pub geometry: i64,
    /// Number of its group of elements; 0 where none is given.
    pub group: i64,
    /// Whether it is a panel that diffracts waves (DIFF).
    pub is_diffracting: bool,
    /// The card that made it.
    pub span: Span,
}

/// A structure: the elements of one deck ELMn.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct StructureDeck {
    /// Its number, 1 for ELM1.
    pub number: i64,
    /// Its elements in the order of input.
    pub elements: Vec<StructureElement>,
    /// Height of the water line in the axes of deck 1 (ZLWL), where given.
    pub waterline: Option<(f64, Span)>,
    /// The cards that mirror its panels at Y = 0 (SYMX) and at X = 0 (SYMY).
    pub mirrors: [Option<Span>; 2],
    /// The card that fixes it in AQWA-LINE (FIXD).
    pub fixed: Option<Span>,
    /// First of the structures that are solved together with it (HYDI).
    pub solved_with: Option<Field<i64>>,
    /// The card of its lid (ILID), with the group of the panels that are it; 0 where they are made by the program.
    pub lid: Option<(i64, Span)>,
    /// Header of its deck.
    pub span: Span,
}

impl ElementShape {
    /// The kind of a keyword.
    pub fn from_keyword(keyword: &str) -> Option<ElementShape> {
        KINDS.iter().find(|(name, ..)| *name == keyword).map(|(_, shape, ..)| *shape)
    }

    /// The keyword of the kind.
    pub fn keyword(self) -> &'static str {
        KINDS.iter().find(|(_, shape, ..)| *shape == self).map_or("", |(name, ..)| name)
    }
}

impl StructureDeck {
    /// The panels of its hull: QPPL and TPPL, without those of its lid.
    pub fn hull_elements(&self) -> impl Iterator<Item = &StructureElement> {
        let lid = self.lid.map_or(0, |(group, _)| group);
        let is_panel =
            |element: &&StructureElement| matches!(element.shape, ElementShape::Quad | ElementShape::Triangle);
        self.elements.iter().filter(is_panel).filter(move |element| lid == 0 || element.group != lid)
    }

    /// Whether waves are diffracted by panels of it.
    pub fn is_diffracting(&self) -> bool {
        self.hull_elements().any(|element| element.is_diffracting)
    }
}

/// The structure of the cards of one deck ELMn; `present` elements were made before.
pub fn read(number: i64, span: Span, records: &[CardRecord], present: usize, remarks: &mut Remarks) -> StructureDeck {
    let mut structure = StructureDeck { number, span, ..StructureDeck::default() };
    // elements by kind, nodes and groups, with their cards
    let mut there: HashMap<(ElementShape, Vec<i64>, i64, i64), Span> = HashMap::new();
    for record in records {
        match record.keyword.as_str() {
            "SYMX" => structure.mirrors[0] = Some(record.span),
            "SYMY" => structure.mirrors[1] = Some(record.span),
            "FIXD" => structure.fixed = Some(record.span),
            "HYDI" => structure.solved_with = Some(record.int(16)),
            "ILID" => structure.lid = remarks.keep(lid(record)).map(|group| (group, record.span)),
            _ => {}
        }
        if record.keyword == "ZLWL" {
            let height = groups(record).and_then(|(_, list)| match list.as_slice() {
                [one] => match one.as_slice() {
                    [value] => Ok(*value),
                    _ => Err(misread(record, "(height)")),
                },
                _ => Err(misread(record, "(height)")),
            });
            structure.waterline = remarks.keep(height).map(|height| (height, record.span));
            continue;
        }
        let Some((name, shape, count, material, geometry)) = KINDS.iter().find(|(name, ..)| *name == record.keyword)
        else {
            continue;
        };
        let made = present + structure.elements.len();
        match elements(record, *shape, *count, *material, *geometry, made) {
            Ok(list) => {
                for element in list {
                    let key = (element.shape, element.nodes.clone(), element.material, element.geometry);
                    if let Some(earlier) = there.insert(key, element.span) {
                        let message = format!("deck 2, {name}: this element is given twice");
                        remarks.add(
                            Diagnostic::error(message, element.span)
                                .label("leave out one of the two")
                                .other(earlier, "given here first"),
                        );
                    }
                    structure.elements.push(element);
                }
            }
            Err(mut error) => {
                let groups = ["(node,step)"].repeat(*count).join(" ");
                let material = if *material { " (material)" } else { "" };
                let geometry = if *geometry { " (geometry)" } else { "" };
                error.help.push(format!("form: {name} (count) {groups}{material}{geometry}"));
                remarks.add(error);
            }
        }
    }
    structure
}

fn elements(
    record: &CardRecord,
    shape: ElementShape,
    nodes: usize,
    material: bool,
    geometry: bool,
    made: usize,
) -> Result<Vec<StructureElement>, Box<Diagnostic>> {
    let (Head { group, is_diffracting }, list) = groups(record)?;
    let wanted = 1 + nodes + usize::from(material) + usize::from(geometry);
    if list.len() != wanted {
        let message =
            format!("deck 2, {}: {wanted} bracketed groups are wanted, {} are there", record.keyword, list.len());
        return Err(Diagnostic::error(message, record.text_place).label("from column 21 on"));
    }
    let whole = |group: &Vec<f64>| -> Option<(i64, i64)> {
        let int = |value: &f64| (value.fract() == 0.0).then_some(*value as i64);
        match group.as_slice() {
            [first] => Some((int(first)?, 0)),
            [first, step] => Some((int(first)?, int(step)?)),
            _ => None,
        }
    };
    let mut pairs = Vec::with_capacity(list.len());
    for group in &list {
        pairs.push(whole(group).ok_or_else(|| misread(record, "groups of one or two whole numbers"))?);
    }
    let count = pairs.first().map_or(0, |(count, _)| *count);
    let room = MAX_ELEMENTS.saturating_sub(made);
    if count < 1 || count > i64::try_from(room).unwrap_or(0) {
        let message = format!("deck 2, {}: {count} elements cannot be made", record.keyword);
        let label = format!("a deck has 1 to {MAX_ELEMENTS} elements; {made} stand before this card");
        return Err(Diagnostic::error(message, record.text_place).label(label));
    }
    let at = |index: usize, k: i64| pairs.get(index).map_or(0, |(first, step)| first + k * step);
    let element = |k: i64| StructureElement {
        shape,
        nodes: (1..=nodes).map(|index| at(index, k)).collect(),
        material: if material { at(1 + nodes, k) } else { 0 },
        geometry: if geometry { at(1 + nodes + usize::from(material), k) } else { 0 },
        group,
        is_diffracting,
        span: record.span,
    };
    Ok((0..count).map(element).collect())
}

fn misread(record: &CardRecord, wanted: &str) -> Box<Diagnostic> {
    Diagnostic::error(format!("deck 2, {}: `{}` is not understood", record.keyword, record.text), record.text_place)
        .label(format!("{wanted} belong from column 21 on"))
}

/// What stands before the brackets.
struct Head {
    /// The group of elements; 0 for none.
    group: i64,
    is_diffracting: bool,
}

/// The group of the panels that are the lid of a structure; 0 where the program makes it.
fn lid(record: &CardRecord) -> Result<i64, Box<Diagnostic>> {
    let head = record.text.split('(').next().unwrap_or_default().trim();
    let wrong = || {
        Diagnostic::error(format!("deck 2, ILID: `{}` is not understood", record.text), record.text_place)
            .label("AUTO in columns 12-15, or the group of the panels of the lid in columns 16-20")
    };
    match head.strip_prefix("AUTO").or_else(|| head.strip_prefix("auto")) {
        Some(group) if group.trim().is_empty() || integer(group.trim()).is_some() => Ok(0),
        Some(_) => Err(wrong()),
        None => integer(head).filter(|group| *group > 0).ok_or_else(wrong),
    }
}

/// What stands before the brackets, and the numbers of each bracket. Text behind them is a remark.
fn groups(record: &CardRecord) -> Result<(Head, Vec<Vec<f64>>), Box<Diagnostic>> {
    let wrong = || misread(record, "numbers in brackets");
    let text = record.text.as_str();
    let open = text.find('(').ok_or_else(wrong)?;
    let head = text.get(..open).unwrap_or_default().trim();
    let named = head.strip_prefix("DIFF").or_else(|| head.strip_prefix("diff"));
    let (is_diffracting, head) = (named.is_some(), named.unwrap_or(head).trim());
    let group = if head.is_empty() { 0 } else { integer(head).ok_or_else(wrong)? };
    let mut rest = text.get(open..).unwrap_or_default();
    let mut list = Vec::new();
    while let Some(after) = rest.strip_prefix('(') {
        let close = after.find(')').ok_or_else(wrong)?;
        let inside = after.get(..close).unwrap_or_default();
        let numbers: Option<Vec<f64>> = inside.split(',').map(|word| real(word.trim())).collect();
        list.push(numbers.ok_or_else(wrong)?);
        rest = after.get(close + 1..).unwrap_or_default().trim_start_matches([' ', ',']);
    }
    let is_remark = rest.starts_with(|c: char| c.is_alphabetic()) && !rest.contains(['(', ')']);
    if rest.is_empty() || is_remark { Ok((Head { group, is_diffracting }, list)) } else { Err(wrong()) }
}
