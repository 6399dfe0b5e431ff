//! Decks 15 to 17: where the structures start, the steps in time, and multipliers of the loads on Morison elements.
//!
//! Source: [AQWA-TETHER 8.1.15 to 8.1.17] and the listings' card echoes; [AQWA-REF decks 15, 16, 17].

use super::card::Field;
use super::layout::{CardLayout, CardRecord, Slot, int, num};
use super::remarks::Remarks;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;

const DOF_SLOTS: &[Slot] = &[num("X", 21), num("Y", 31), num("Z", 41), num("RX", 51), num("RY", 61), num("RZ", 71)];
const SLOW_DRIFT_REASON: &str = "slow drift positions are not read apart from the total ones";

/// Cards of deck 15; `n` stands for the number of the structure.
pub const STARTS: &[CardLayout] = &[
    CardLayout::new("POSn", DOF_SLOTS).freely(),
    CardLayout::new("VELn", DOF_SLOTS).freely(),
    CardLayout::refuse("SLPn", SLOW_DRIFT_REASON),
    CardLayout::refuse("SLVn", SLOW_DRIFT_REASON),
];

/// Cards of deck 16.
pub const DECK_16_CARDS: &[CardLayout] = &[
    CardLayout::new("TIME", &[int("number of time steps", 16), num("time step", 21), num("start time", 31)]),
    CardLayout::refuse("HOTS", "a start from an earlier run is not read"),
];

/// Cards of deck 17.
pub const MULTIPLIERS: &[CardLayout] = &[
    CardLayout::new("SLMM", &[int("structure", 11), num("slam multiplier", 21)]).repeated_by(&[11]),
    CardLayout::assume("DRGM", &[int("structure", 11), num("drag multiplier", 21)]).repeated_by(&[11]),
    CardLayout::assume("ADMM", &[int("structure", 11), num("added mass multiplier", 21)]).repeated_by(&[11]),
    CardLayout::refuse("SC1/", "drag that depends on the Reynolds number is not read"),
];

/// Position or velocity of the centre of gravity of a structure at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// Number of the structure.
    pub structure: i64,
    /// Whether these are velocities.
    pub velocity: bool,
    /// X, Y, Z, then RX, RY, RZ in degrees (a second, for velocities).
    pub values: [f64; 6],
    /// The card.
    pub span: Span,
}

/// Steps in time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeSteps {
    /// Number of steps; the first is the start, so that N steps last (N - 1) times the step.
    pub count: Field<i64>,
    /// Length of a step (s).
    pub step: Field<f64>,
    /// Time of the first step (s).
    pub start: f64,
    /// The card.
    pub span: Span,
}

impl TimeSteps {
    /// Time of the last step (s).
    pub fn end(&self) -> f64 {
        self.start + (self.count.value - 1) as f64 * self.step.value
    }
}

/// Most structures of a deck.
pub const MAX_STRUCTURES: i64 = 50;

/// Most time steps of a run.
pub const MAX_TIME_STEPS: i64 = 10_000_000;

/// Multipliers of the loads on the Morison elements of a structure, its tethers among them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MorisonMultipliers {
    /// The structure.
    pub structure: Field<i64>,
    /// Of drag; 1 by default.
    pub drag: f64,
    /// Of added mass; 1 by default.
    pub added_mass: f64,
    /// Of slam; 0 by default, which is no slam.
    pub slam: f64,
}

/// The starts of the cards of deck 15.
pub fn read_starts(records: &[CardRecord], remarks: &mut Remarks) -> Vec<Start> {
    let mut list: Vec<Start> = Vec::new();
    for record in records {
        let number: String = record.keyword.chars().skip_while(|c| !c.is_ascii_digit()).collect();
        let Ok(structure) = number.parse() else { continue };
        let velocity = record.keyword.starts_with('V');
        if let Some(earlier) = list.iter().find(|s| s.structure == structure && s.velocity == velocity) {
            let message = format!("deck 15: {} is given twice", record.keyword);
            remarks.add(Diagnostic::error(message, record.span).other(earlier.span, "given here first"));
        }
        let values = record.reals(21).map(|field| field.value);
        list.push(Start { structure, velocity, values, span: record.span });
    }
    list
}

/// The time steps of the cards of deck 16.
pub fn read_steps(records: &[CardRecord], remarks: &mut Remarks) -> Option<TimeSteps> {
    let record = records.last()?;
    let steps =
        TimeSteps { count: record.int(16), step: record.real(21), start: record.real(31).value, span: record.span };
    if !(1..=MAX_TIME_STEPS).contains(&steps.count.value) {
        remarks.add(
            Diagnostic::error(
                format!("deck 16, TIME, columns 16-20: {} steps cannot be run", steps.count.value),
                steps.count.span,
            )
            .label(format!("number of steps, 1 to {MAX_TIME_STEPS}")),
        );
        return None;
    }
    if steps.step.value <= 0.0 {
        remarks.add(
            Diagnostic::error("deck 16, TIME, columns 21-30: a time step is above 0", steps.step.span)
                .label("time step"),
        );
        return None;
    }
    Some(steps)
}

/// The multipliers of the cards of deck 17.
pub fn read_multipliers(records: &[CardRecord], remarks: &mut Remarks) -> Vec<MorisonMultipliers> {
    let mut list: Vec<MorisonMultipliers> = Vec::new();
    for record in records {
        let (structure, factor) = (record.int(11), record.real(21));
        if !(1..=MAX_STRUCTURES).contains(&structure.value) {
            let message = format!("deck 17, {}, columns 11-15: {} is no structure", record.keyword, structure.value);
            remarks.add(
                Diagnostic::error(message, structure.span).label("the number of a structure of deck 2 belongs here"),
            );
            continue;
        }
        if factor.value < 0.0 {
            let message = format!("deck 17, {}, columns 21-30: a multiplier is not below 0", record.keyword);
            remarks.add(Diagnostic::error(message, factor.span));
            continue;
        }
        let index = list.iter().position(|m| m.structure.value == structure.value).unwrap_or_else(|| {
            list.push(MorisonMultipliers { structure, drag: 1.0, added_mass: 1.0, slam: 0.0 });
            list.len() - 1
        });
        if let Some(multipliers) = list.get_mut(index) {
            match record.keyword.as_str() {
                "SLMM" => multipliers.slam = factor.value,
                "DRGM" => multipliers.drag = factor.value,
                _ => multipliers.added_mass = factor.value,
            }
        }
    }
    list
}
