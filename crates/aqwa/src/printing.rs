//! Deck 18: what is printed, and how often.
//!
//! Source: [AQWA-TETHER Appendix B, 8.1.18 and 8.2.18]; [AQWA-REF deck 18].

use super::card::Field;
use super::job::Program;
use super::layout::{CardLayout, CardRecord, Slot, int};
use super::remarks::Remarks;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;

const STEP_SLOTS: &[Slot] = &[int("number of steps", 11)];
const PARAMETER: &[Slot] = &[int("structure", 11).not_below_zero(), int("parameter", 16).not_below_zero()];

/// Cards of deck 18.
pub const LAYOUTS: &[CardLayout] = &[
    CardLayout::new("PREV", STEP_SLOTS),
    CardLayout::new("TPRV", STEP_SLOTS),
    CardLayout::new("TGRV", STEP_SLOTS),
    CardLayout::pass_over("GREV", "no graphics file is written; plots are had with the reports of the session"),
    CardLayout::pass_over("PPRV", "no file of positions is written; the reports of the session give them"),
    CardLayout::new("TSTS", &[int("first step of the statistics", 11)]),
    CardLayout::new("TSTF", &[int("last step of the statistics", 11)]),
    CardLayout::new("PTEN", &[int("structure", 11).not_below_zero()]).repeated_by(&[11]),
    CardLayout::new(
        "NODE",
        &[int("structure", 11), int("node", 16), int("reference structure", 21), int("reference node", 26)],
    )
    .repeated_by(&[11, 16, 21, 26]),
    CardLayout::new("NOPR", PARAMETER).freely(),
    CardLayout::new("PRNT", PARAMETER).freely(),
    CardLayout::pass_over("PCGP", "not available in AQWA nor here"),
    CardLayout::pass_over("PMST", "tensions along dynamic lines are had with the reports of the session"),
    CardLayout::pass_over("PRTD", "has no effect; PREV says how often a structure is printed"),
    CardLayout::pass_over("SSPC", "is for FER"),
    CardLayout::pass_over("ZRWS", "heights above the wave are had with the reports of the session"),
    CardLayout::pass_over("PTST", "has no effect"),
    CardLayout::pass_over("PTRT", "has no effect"),
];

/// Parameters that both listings of [AQWA-TETHER 8] turn off, or that stand for rows windlass never has: positions, velocities and accelerations by RAO, at wave
/// and at drift frequency, and forces of other programs.
const ROWS_NEVER_PRINTED: [i64; 18] = [4, 5, 6, 7, 8, 9, 10, 11, 12, 20, 26, 27, 28, 29, 30, 31, 32, 34];
/// Gyroscopic, diffraction, linear damping, hydrodynamic and wave frequency forces [AQWA-TETHER 8.2.18]: which number is which is published nowhere, so that they act together.
const FORCES_OF_WAVES: [i64; 6] = [15, 16, 17, 19, 23, 25];
/// Those of them that the deck of DRIF turns off, while its listing has diffraction.
const FORCES_OF_WAVES_DRIFT: [i64; 3] = [17, 19, 25];
/// The expected error of a step: of the two listings the one whose deck asks for it has the row.
const ERROR_OF_STEP: i64 = 49;

/// A node whose position is printed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrintedNode {
    /// The structure that carries it.
    pub structure: Field<i64>,
    /// The node.
    pub node: Field<i64>,
    /// The structure and node it is printed relative to; 0 for the fixed reference.
    pub reference: (Field<i64>, Field<i64>),
}

/// A printed parameter turned on or off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Switch {
    /// The structure.
    pub structure: Field<i64>,
    /// Number of the parameter.
    pub parameter: Field<i64>,
    /// On (PRNT) or off (NOPR).
    pub on: bool,
}

/// Deck 18. Intervals and steps are counts of time steps.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Printing {
    /// Steps between printed states of the structures (PREV).
    pub structures: Option<Field<i64>>,
    /// Steps between printed states of the tethers (TPRV); overrides TSLK.
    pub tethers: Option<Field<i64>>,
    /// Steps between records of the tethers for graphics and statistics (TGRV).
    pub records: Option<Field<i64>>,
    /// First step of the statistics (TSTS).
    pub first: Option<Field<i64>>,
    /// Last step of the statistics (TSTF).
    pub last: Option<Field<i64>>,
    /// Structures whose mooring is printed (PTEN); 0 is all.
    pub tensions: Vec<Field<i64>>,
    /// Nodes whose positions are printed.
    pub nodes: Vec<PrintedNode>,
    /// Parameters turned on and off, in the order given.
    pub switches: Vec<Switch>,
    /// Place of the last card.
    pub span: Span,
}

impl Printing {
    /// Whether a parameter of a structure is printed, given whether it usually is.
    pub fn prints(&self, structure: i64, parameter: i64, usual: bool) -> bool {
        let fits = |s: &&Switch| s.parameter.value == parameter && s.structure.value == structure;
        self.switches.iter().rfind(fits).map_or(usual, |switch| switch.on)
    }
}

/// The printing of the cards of deck 18.
pub fn read(records: &[CardRecord], remarks: &mut Remarks) -> Printing {
    let mut printing = Printing::default();
    for record in records {
        printing.span = record.span;
        let first = record.int(11);
        let keyword = record.keyword.as_str();
        let counts = matches!(keyword, "PREV" | "TPRV" | "TGRV" | "TSTS" | "TSTF");
        if counts && first.value <= 0 && first.given {
            remarks.add(
                Diagnostic::error(
                    format!("deck 18, {keyword}, columns 11-15: {} is not a valid number of steps", first.value),
                    first.span,
                )
                .label("a whole number above 0 belongs here"),
            );
            continue;
        }
        let count = first.given.then_some(first);
        match keyword {
            "PREV" => printing.structures = count,
            "TPRV" => printing.tethers = count,
            "TGRV" => printing.records = count,
            "TSTS" => printing.first = count,
            "TSTF" => printing.last = count,
            "PTEN" => printing.tensions.push(first),
            "NODE" => {
                if first.value <= 0 {
                    remarks.add(
                        Diagnostic::error("deck 18, NODE, columns 11-15: structure 0 carries no node", first.span)
                            .label("the number of a structure of deck 2 belongs here"),
                    );
                }
                let reference = (record.int(21), record.int(26));
                printing.nodes.push(PrintedNode { structure: first, node: record.int(16), reference });
            }
            "NOPR" | "PRNT" => {
                if first.value <= 0 {
                    let message = format!("deck 18, {keyword}, columns 11-15: {} is no structure", first.value);
                    remarks.add(
                        Diagnostic::error(message, first.span)
                            .label("the number of a structure of deck 2 belongs here, 1 for ELM1"),
                    );
                }
                printing.switches.push(Switch { structure: first, parameter: record.int(16), on: keyword == "PRNT" });
            }
            _ => {}
        }
    }
    say_unknown_parameters(&printing, remarks);
    if let (Some(first), Some(last)) = (printing.first, printing.last)
        && first.value > last.value
    {
        remarks.add(
            Diagnostic::error("deck 18: the statistics end before they start", last.span)
                .label("TSTF")
                .other(first.span, "TSTS"),
        );
    }
    printing
}

/// Says which NOPR and PRNT cards have no effect.
fn say_unknown_parameters(printing: &Printing, remarks: &mut Remarks) {
    for switch in &printing.switches {
        let number = switch.parameter.value;
        let keyword = if switch.on { "PRNT" } else { "NOPR" };
        let card = format!("deck 18, {keyword}, columns 16-20: parameter {number}");
        let acts = number == ERROR_OF_STEP || FORCES_OF_WAVES.contains(&number);
        if acts || (!switch.on && ROWS_NEVER_PRINTED.contains(&number)) {
            continue;
        }
        let message = if ROWS_NEVER_PRINTED.contains(&number) {
            Diagnostic::warning(format!("{card} is a row that windlass does not have"), switch.parameter.span)
                .help("it is not printed")
        } else {
            Diagnostic::warning(format!("{card} stands for a row that no source names"), switch.parameter.span)
                .help("the card has no effect; 4-12, 15-17, 19, 20, 23, 25-32, 34 and 49 are known")
        };
        remarks.add_once(&format!("{keyword} {number}"), || message);
    }
}

/// Rows of the pages of a structure that are left out, by the names of `STRUCTURE PAGES -OMIT`.
pub fn omitted_rows(printing: &Printing, structure: i64, program: Program) -> Vec<&'static str> {
    let mut rows = Vec::new();
    let set: &[i64] = if program == Program::Drift { &FORCES_OF_WAVES_DRIFT } else { &FORCES_OF_WAVES };
    if set.iter().all(|number| !printing.prints(structure, *number, true)) {
        rows.push("WAVE_INERTIA");
        if program != Program::Drift {
            rows.push("DIFFRACTION");
        }
        rows.push("GYROSCOPIC");
    }
    if !printing.prints(structure, ERROR_OF_STEP, false) {
        rows.push("ERROR");
    }
    rows
}
