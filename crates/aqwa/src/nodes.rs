//! Deck 1: the nodes, with generation.
//!
//! A card holds a node, the number of nodes to generate, the step of their numbers, the coordinates of the first and
//! the steps of the coordinates. Nodes are shared by all structures; each moves with the structure that refers to it.
//!
//! Source: [AQWA-REF deck 1]; [AQWA-TETHER 8.1.1] and the listing's card echo.

use super::card::Field;
use super::layout::{CardLayout, CardRecord, Slot, int, num};
use super::remarks::Remarks;
use indexmap::IndexMap;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;

/// Most nodes of a deck, as of AQWA.
pub const MAX_NODES: usize = 60_000;

const NODE_NUMBER: &str = "node number";
const NODE_COUNT: &str = "how many nodes to generate";

const SLOTS: &[Slot] = &[
    Slot { width: 4, ..int(NODE_NUMBER, 7) },
    int(NODE_COUNT, 11),
    int("step of the node numbers", 16),
    num("X", 21),
    num("Y", 31),
    num("Z", 41),
    num("step of X", 51).often_blank(),
    num("step of Y", 61).often_blank(),
    num("step of Z", 71).often_blank(),
];
/// The same behind NOD5: numbers of nodes are five columns wide.
const WIDE_SLOTS: &[Slot] = &[
    int(NODE_NUMBER, 7),
    Slot { width: 4, ..int(NODE_COUNT, 12) },
    int("step of the node numbers", 16),
    num("X", 21),
    num("Y", 31),
    num("Z", 41),
    num("step of X", 51).often_blank(),
    num("step of Y", 61).often_blank(),
    num("step of Z", 71).often_blank(),
];
const UNPUBLISHED_CARD_REASON: &str = "the columns of this card are published nowhere; give the nodes one by one";

/// The card behind which numbers of nodes are five columns wide.
pub const WIDE_NUMBERS: &str = "NOD5";
/// The card that says of which structure the nodes behind it are.
const OF_STRUCTURE: &str = "STRC";
const STRUCTURE: &[Slot] = &[int("structure", 16).required()];

/// Cards of deck 1.
pub const LAYOUTS: &[CardLayout] = &[
    CardLayout::new("", SLOTS).freely(),
    CardLayout::new(WIDE_NUMBERS, &[]),
    CardLayout::assume(OF_STRUCTURE, STRUCTURE).freely(),
    CardLayout::refuse("NODE", UNPUBLISHED_CARD_REASON),
];
/// Cards of deck 1 behind NOD5.
pub const WIDE_LAYOUTS: &[CardLayout] = &[
    CardLayout::new("", WIDE_SLOTS).freely(),
    CardLayout::assume(OF_STRUCTURE, STRUCTURE).freely(),
    CardLayout::refuse("NODE", UNPUBLISHED_CARD_REASON),
];

/// A node of deck 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeckNode {
    /// X, Y, Z as given.
    pub position: [f64; 3],
    /// The card that made it.
    pub span: Span,
}

/// The nodes by number, in the order of input.
pub type NodeTable = IndexMap<i64, DeckNode>;

/// The nodes of the cards of deck 1.
pub fn read(records: &[CardRecord], remarks: &mut Remarks) -> NodeTable {
    let mut nodes = NodeTable::new();
    let mut is_wide = false;
    for record in records {
        match record.keyword.as_str() {
            WIDE_NUMBERS => is_wide = true,
            // numbers of nodes are unique in a deck, whose structure they are of or not
            OF_STRUCTURE => {}
            _ => read_node(record, is_wide, &mut nodes, remarks),
        }
    }
    nodes
}

/// The nodes of one card.
fn read_node(record: &CardRecord, is_wide: bool, nodes: &mut NodeTable, remarks: &mut Remarks) {
    let (first, count, step) = (record.int(7), record.int(if is_wide { 12 } else { 11 }), record.int(16));
    if first.value <= 0 {
        remarks.add(
            Diagnostic::error(format!("deck 1, columns 7-10: {} is no node number", first.value), first.span)
                .label("a node number from 1 on belongs here"),
        );
        return;
    }
    let Some(count) = check_count(count, nodes.len(), remarks) else { return };
    let step = step.value_or(1);
    let from: [Field<f64>; 3] = record.reals(21);
    let by: [Field<f64>; 3] = record.reals(51);
    if let (true, true, Some(blank)) = (from[0].given, from[1].given, from.last().filter(|field| !field.given)) {
        let message = "deck 1, columns 41-50: this field is blank and reads as 0";
        remarks.add(Diagnostic::remark(message, blank.span).label("Z belongs here"));
    }
    if let (1, Some(idle)) = (count, by.iter().find(|field| field.value != 0.0)) {
        remarks.add(
            Diagnostic::error("deck 1, columns 51-80: this card generates no nodes and has an increment", idle.span)
                .label("coordinates belong in columns 21-50")
                .help("columns 11-15 have the number of nodes to generate"),
        );
    }
    for k in 0..count {
        let number = first.value + k * step;
        let position = std::array::from_fn(|axis| from[axis].value + k as f64 * by[axis].value);
        if number <= 0 || position.iter().any(|x: &f64| !x.is_finite()) {
            let message = format!("deck 1: generation from node {} leads to node {number}", first.value);
            remarks.add(
                Diagnostic::error(message, record.span).label("numbers from 1 on and finite coordinates are wanted"),
            );
            break;
        }
        if let Some(earlier) = nodes.get(&number) {
            remarks.add(
                Diagnostic::error(format!("deck 1: node {number} is given twice"), record.span)
                    .label(if count > 1 { "this card generates it" } else { "node numbers are unique" })
                    .other(earlier.span, "given here first"),
            );
            break;
        }
        nodes.insert(number, DeckNode { position, span: record.span });
    }
}

/// The number of nodes that a card makes; none, with an error, when they would be too many.
fn check_count(count: Field<i64>, present: usize, remarks: &mut Remarks) -> Option<i64> {
    let wanted = count.value.max(1);
    let room = i64::try_from(MAX_NODES.saturating_sub(present)).unwrap_or(0);
    if count.value < 0 || wanted > room {
        remarks.add(
            Diagnostic::error(format!("deck 1, columns 11-15: {} nodes cannot be generated", count.value), count.span)
                .label(format!("a deck has at most {MAX_NODES} nodes; {present} stand before this card")),
        );
        return None;
    }
    Some(wanted)
}
