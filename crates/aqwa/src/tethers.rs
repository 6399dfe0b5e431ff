//! Tethers of deck 14.
//!
//! The cards of a tether come in any order; TETH closes it, and a TETH directly after another one copies the tether
//! before it to other nodes. Elements go from the anchor (installed) or the trailing end (towed) to the vessel.
//!
//! Source: [AQWA-TETHER Appendix A, 8.1.14, 8.2.14]; the columns of TEGR, whose page A.7 is lost, from 8.2.14 and the
//! listing's card echo.

use super::card::Field;
use super::end_springs::{EndSpringCard, check, in_force};
use super::layout::CardRecord;
use super::remarks::Remarks;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;

/// Most elements of a tether (AQWA of later years has 24).
const MAX_ELEMENTS: usize = 1000;
/// Most tethers of a deck, as AQWA has 100 lines.
const MAX_TETHERS: usize = 100;
/// Most constraints of an installed tether [AQWA-TETHER A.14].
const MAX_CONSTRAINTS: usize = 5;

/// A TELM card.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TelmCard {
    /// Node nearer to the anchor or trailing end.
    pub node1: Field<i64>,
    /// Node nearer to the vessel.
    pub node2: Field<i64>,
    /// Material group.
    pub material: Field<i64>,
    /// Geometry group.
    pub geometry: Field<i64>,
    /// The card.
    pub span: Span,
}

/// A TFAT card.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fatigue {
    /// Stress concentration factor.
    pub concentration: f64,
    /// Intercept A of the S-N curve N = A / R^m, with stresses in kN/m2.
    pub intercept: f64,
    /// Slope m.
    pub slope: f64,
}

impl Default for Fatigue {
    /// The values of A.4.
    fn default() -> Self {
        Fatigue { concentration: 1.24, intercept: 1.3367e24, slope: 3.5 }
    }
}

/// Kinds of constraint of an installed tether.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConstraintKind {
    /// TLAC: lateral, fixed.
    LateralFixed,
    /// TROC: rotational, fixed.
    RotationalFixed,
    /// TLAV: lateral, on the vessel, in a gap.
    LateralVessel,
    /// TROV: rotational, on the vessel.
    RotationalVessel,
}

/// Everything about a tether but where it is fixed.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct TetherCards {
    /// Elements from the anchor or trailing end upwards.
    pub elements: Vec<TelmCard>,
    /// Springs at the anchor or trailing end.
    pub anchor: Option<EndSpringCard>,
    /// Springs at the vessel.
    pub vessel: Option<EndSpringCard>,
    /// Fatigue parameters; the defaults of A.4 where not given.
    pub fatigue: Fatigue,
    /// Hours for which the expected peak stress is computed; 3 where not given [AQWA-TETHER A.5].
    pub peak_hours: Option<f64>,
    /// Number of identical tethers: forces on the vessel are multiplied by it. 0 when not given, which stands for 1.
    pub group: i64,
    /// Areas of the caps not subject to water pressure, at the anchor and the vessel.
    pub caps: (f64, f64),
    /// Pressure and density of the fluid inside.
    pub fluid: (f64, f64),
    /// Stress factor and half life (s) of impact.
    pub impact: Option<(f64, f64)>,
    /// Distance of the lower stop below the anchor (TLOW); 0 means that the tether can never hang free [AQWA-TETHER A.11], none that it meets
    /// no stop.
    pub lower_stop: Option<f64>,
    /// Constraints with the gap of TLAV and their cards.
    pub constraints: Vec<(ConstraintKind, f64, Span)>,
    /// Keywords and places of its cards.
    pub cards: Vec<(String, Span)>,
}

impl TetherCards {
    /// Place of the card with a keyword, where it was given.
    pub fn card(&self, keyword: &str) -> Option<Span> {
        self.cards.iter().find(|(name, _)| name == keyword).map(|(_, span)| *span)
    }
}

/// A tether, closed by a TETH card.
#[derive(Clone, Debug, PartialEq)]
pub struct Tether {
    /// What it is.
    pub description: TetherCards,
    /// Number (from 1) of the tether that it copies.
    pub copy_of: Option<usize>,
    /// The structure it is fixed to.
    pub structure: Field<i64>,
    /// Node on the structure.
    pub node: Field<i64>,
    /// Node of the anchor, or of the position of the trailing end.
    pub anchor: Field<i64>,
    /// The TETH card.
    pub span: Span,
}

impl Tether {
    /// Whether the tether is towed; else it is installed.
    pub fn is_towed(&self) -> bool {
        [self.description.anchor, self.description.vessel].iter().flatten().any(|spring| spring.towed)
    }

    /// Stiffnesses in force, inline and two rotational in the deck's units, at the anchor or trailing end, and at the vessel; see [`in_force`].
    pub fn springs(&self) -> [[f64; 3]; 2] {
        let towed = self.is_towed();
        [self.description.anchor, self.description.vessel].map(|spring| in_force(spring, towed))
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.description.elements.len() + 1
    }
}

/// A tether whose TETH card has not come yet.
#[derive(Clone, Debug, Default)]
pub struct Builder {
    description: TetherCards,
    first: Option<Span>,
}

impl Builder {
    /// Takes a card.
    pub fn take(&mut self, record: &CardRecord, remarks: &mut Remarks) {
        self.first.get_or_insert(record.span);
        let tether = &mut self.description;
        if record.keyword != "TELM" {
            tether.cards.push((record.keyword.clone(), record.span));
        }
        let value = |column: usize| record.real(column).value;
        match record.keyword.as_str() {
            "TELM" => self.element(record, remarks),
            "TSPA" | "TSPV" => {
                let flag = record.int(11);
                if !(0..=1).contains(&flag.value) {
                    let message = format!("deck 14, {}, columns 11-15: {} is no flag", record.keyword, flag.value);
                    remarks.add(
                        Diagnostic::error(message, flag.span).label("1 for a towed tether, blank for an installed one"),
                    );
                }
                let spring = EndSpringCard { towed: flag.value == 1, stiffness: record.reals(31), span: record.span };
                let position = if record.keyword == "TSPA" { &mut tether.anchor } else { &mut tether.vessel };
                *position = Some(spring);
            }
            "TFAT" => {
                let usual = Fatigue::default();
                tether.fatigue = Fatigue {
                    concentration: record.real(41).value_or(usual.concentration),
                    intercept: record.real(51).value_or(usual.intercept),
                    slope: record.real(61).value_or(usual.slope),
                };
                let Fatigue { concentration, intercept, slope } = tether.fatigue;
                if concentration < 0.0 || intercept < 0.0 || slope < 0.0 {
                    remarks.add(Diagnostic::error("deck 14, TFAT: fatigue parameters are above 0", record.span));
                }
            }
            "TPSH" => {
                // columns 31-40 in [AQWA-TETHER A.5], 11-15 in [AQWA-REF deck 14]
                let hours = if record.real(31).given { value(31) } else { record.int(11).value as f64 };
                if hours < 0.0 {
                    remarks.add(Diagnostic::error("deck 14, TPSH: hours are not below 0", record.span));
                }
                tether.peak_hours = (hours > 0.0).then_some(hours);
            }
            "TEGR" => {
                tether.group = record.int(11).value;
                if tether.group < 0 {
                    remarks.add(
                        Diagnostic::error(
                            "deck 14, TEGR, columns 11-15: a number of tethers is not below 0",
                            record.span,
                        )
                        .label("number of identical tethers"),
                    );
                }
            }
            "TCAP" => tether.caps = (value(31), value(41)),
            "TIFL" => tether.fluid = (value(31), value(41)),
            "TIMP" => {
                if value(31) < 0.0 || value(41) < 0.0 {
                    remarks.add(Diagnostic::error(
                        "deck 14, TIMP: stress factor and half life are not below 0",
                        record.span,
                    ));
                }
                tether.impact = Some((value(31), value(41)));
            }
            "TLOW" => {
                tether.lower_stop = Some(value(31));
                if value(31) < 0.0 {
                    remarks.add(Diagnostic::error(
                        "deck 14, TLOW, columns 31-40: a distance below the anchor is not below 0",
                        record.span,
                    ));
                }
            }
            keyword => {
                let kind = match keyword {
                    "TLAC" => ConstraintKind::LateralFixed,
                    "TROC" => ConstraintKind::RotationalFixed,
                    "TLAV" => ConstraintKind::LateralVessel,
                    _ => ConstraintKind::RotationalVessel,
                };
                if tether.constraints.len() == MAX_CONSTRAINTS {
                    let message = format!("deck 14, {keyword}: a tether has at most {MAX_CONSTRAINTS} constraints");
                    remarks.add(Diagnostic::error(message, record.span));
                } else if value(31) < 0.0 {
                    remarks.add(Diagnostic::error(
                        "deck 14, TLAV, columns 31-40: a gap is not below 0",
                        record.real(31).span,
                    ));
                } else {
                    tether.constraints.push((kind, value(31), record.span));
                }
            }
        }
    }

    fn element(&mut self, record: &CardRecord, remarks: &mut Remarks) {
        let element = TelmCard {
            node1: record.int(11),
            node2: record.int(16),
            material: record.int(21),
            geometry: record.int(26),
            span: record.span,
        };
        if let Some(before) = self.description.elements.last()
            && before.node2.value != element.node1.value
        {
            let message = format!(
                "deck 14, TELM, columns 11-15: elements are not contiguous: node {} after node {}",
                element.node1.value, before.node2.value
            );
            remarks.add(
                Diagnostic::error(message, element.node1.span)
                    .label(format!("{} belongs here", before.node2.value))
                    .other(before.node2.span, "where the element before ends"),
            );
        }
        if self.description.elements.len() < MAX_ELEMENTS {
            self.description.elements.push(element);
        } else {
            let message = format!("deck 14, TELM: a tether has at most {MAX_ELEMENTS} elements");
            remarks.add_once("many elements", || Diagnostic::error(message, record.span));
        }
    }

    /// Closes the tether with its TETH card.
    pub fn close(&mut self, record: &CardRecord, earlier: &[Tether], remarks: &mut Remarks) -> Option<Tether> {
        let (structure, fixed) = (record.int(11), record.int(21));
        if structure.value <= 0 {
            remarks.add(
                Diagnostic::error("deck 14, TETH, columns 11-15: structure 0 is no vessel", structure.span)
                    .label("the number of a structure of deck 2 belongs here, 1 for ELM1"),
            );
        }
        if fixed.value != 0 {
            remarks.add(
                Diagnostic::error("deck 14, TETH, columns 21-25: the other end of a tether is fixed", fixed.span)
                    .label("0 belongs here"),
            );
        }
        let whole = std::mem::take(self);
        if earlier.len() == MAX_TETHERS {
            let message = format!("deck 14, TETH: a deck has at most {MAX_TETHERS} tethers");
            remarks.add_once("many tethers", || Diagnostic::error(message, record.span));
            return None;
        }
        let (description, copy_of) = match (whole.first, earlier.last()) {
            (Some(_), _) if whole.description.elements.is_empty() => {
                remarks.add(
                    Diagnostic::error("deck 14, TETH: this tether has no element", record.span)
                        .label("TELM cards belong before it")
                        .help("a TETH card directly after another one copies that tether"),
                );
                return None;
            }
            (Some(_), _) => (whole.description, None),
            (None, Some(before)) => (before.description.clone(), Some(before.copy_of.unwrap_or(earlier.len()))),
            (None, None) => {
                remarks.add(
                    Diagnostic::error("deck 14, TETH: there is no tether to copy", record.span)
                        .label("a tether is described before its TETH card")
                        .help("a TETH card directly after another one copies that tether"),
                );
                return None;
            }
        };
        let tether =
            Tether { description, copy_of, structure, node: record.int(16), anchor: record.int(26), span: record.span };
        let position = |tether: &Tether| [tether.structure, tether.node, tether.anchor].map(|field| field.value);
        if let Some(same) = earlier.iter().find(|earlier| position(earlier) == position(&tether)) {
            let message = "deck 14, TETH: another tether stands between these nodes";
            let said = if copy_of.is_some() {
                Diagnostic::error(message, record.span).label("leave out one of the two")
            } else {
                Diagnostic::warning(message, record.span).label("both are taken")
            };
            remarks.add(said.other(same.span, "the other one").help("TEGR gives the number of identical tethers"));
        }
        if tether.copy_of.is_none() {
            check(&tether, remarks);
        }
        Some(tether)
    }

    /// Says when cards of a tether are left without TETH.
    pub fn finish(&self, remarks: &mut Remarks) {
        if let Some(span) = self.first {
            remarks.add(
                Diagnostic::error("deck 14: no TETH card closes this tether", span)
                    .label("its first card")
                    .help("TETH is the last card of a tether: structure, node on it, 0, anchor or trailing node"),
            );
        }
    }
}
