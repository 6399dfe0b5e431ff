//! CT_LINE: a line of constant tension, as a winch keeps that pays out and heaves in at its set tension.
//!
//! The force on each end is T toward the other; with the unit vector n from the first end to the second and their distance L its
//! stiffness is T/L (1 - n n'), which is the chord's of [MOSES-REF cls_flex] without an elastic part. It is the line FORC of AQWA decks, and
//! with -LENGTH and -FRICTION the winch of [AQWA-REF WNCH] and of the workbench's constant-tension cable winch [AQWA-WINCH]. It is straight: sag and a
//! stall are not modelled.

use super::ClassKind;
use super::taut_span::{SpanElement, SpanLaw, SpanTension, TautSpan, check_span_ends, smooth_step};
use std::sync::Arc;
use windlass_base::diagnostic::Outcome;
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec};
use windlass_model::{
    ClassError, ClassRecord, Connection, Connector, ConnectorClass, ConnectorElement, Note, Surroundings,
};

/// The class type.
pub static CT_LINE: ClassKind = ClassKind { spec: &SPEC, build, idle: &[] };

/// Speed of the drum (m/s) at which its friction is fully mobilised: slower than a winch turns in service, and no jump for an implicit step.
const FULL_FRICTION_SPEED: f64 = 0.01;
/// Share of -LENGTH over which the tension rises from slack: the line is not a switch.
const TAUTENING_SHARE: f64 = 1e-3;

const LENGTH: OptionSpec = OptionSpec::new(
    "-LENGTH",
    &[ValueSpec::new("L", Kind::Number(Dim::Length), "length").positive()],
    "shorter than this the line is slack; its tension rises over the first thousandth beyond",
)
.owner(Owner::Ours)
.default("never slack");
const FRICTION: OptionSpec = OptionSpec::new(
    "-FRICTION",
    &[
        ValueSpec::new(
            "FW",
            Kind::Number(Dim::None),
            "winding in: the tension is TENSION (1 - |FW|); at rest too, unless FW is negative",
        )
        .in_range(-0.99, 0.99),
        ValueSpec::new(
            "FP",
            Kind::Number(Dim::None),
            "paying out: it is TENSION (1 + FP), at rest where FW is negative",
        )
        .not_negative(),
    ],
    "friction of the drum",
)
.owner(Owner::Ours)
.default("0 0");

static SPEC: CommandSpec = CommandSpec {
    data: &[ValueSpec::new("TENSION", Kind::Number(Dim::Force), "tension it keeps").not_negative()],
    options: &[LENGTH, FRICTION],
    detail: "A straight line between two points that keeps its tension at any length, as a constant-tension winch does: it pulls each \
             end toward the other with TENSION. A point of the ground is its anchor. It has no elastic stiffness; its direction gives \
             it TENSION over its length across itself. -FRICTION acts in full from 1 cm/s on.",
    example: "MEDIT\n*QUAY 0 0 8\n&DESCRIBE BODY SHIP\n*BITT 12 3 6\n~WINCH CT_LINE 300 -FRICTION 0.3 0.1\nCONNECTOR W1 ~WINCH *BITT *QUAY\nEND\n\
              &STATUS CLASS ~WINCH",
    ..CommandSpec::new("CT_LINE", "line of constant tension")
};

/// A line of constant tension.
#[derive(Clone, Copy, Debug)]
struct ConstantTensionLine {
    /// Tension of the winch (N).
    tension: f64,
    /// Length below which it is slack (m); 0 where it never is.
    length: f64,
    /// Friction factors winding in and paying out.
    friction: [f64; 2],
    /// Whether the tension at rest is that of paying out.
    rests_paying_out: bool,
}

fn build(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    let args = records.last().map(|r| &r.args);
    let tension = args.and_then(|args| args.number(const { SPEC.number("TENSION") })).unwrap_or(0.0);
    let length = args.and_then(|args| args.option_number(&LENGTH)).unwrap_or(0.0);
    let [winding, paying] = args
        .and_then(|args| args.option(&FRICTION))
        .map_or([0.0; 2], |given| given.numbers_or_zero(const { FRICTION.numbers(["FW", "FP"]) }));
    Ok(Arc::new(ConstantTensionLine {
        tension,
        length,
        friction: [winding.abs(), paying],
        rests_paying_out: winding < 0.0,
    }))
}

impl ConnectorClass for ConstantTensionLine {
    fn kind(&self) -> &'static str {
        "CT_LINE"
    }

    fn check_ends(&self, connector: &Connector, _: usize) -> Outcome<()> {
        check_span_ends("CT_LINE", "a CT_LINE takes 2 points; its anchor is a point of the ground", connector)
    }

    fn is_line(&self) -> bool {
        true
    }

    fn properties(&self, name: &str, _: &Surroundings) -> Table {
        let mut table = Table::new(format!("Class {name}")).fact("Type", "CT_LINE", Dim::None).fact(
            "Tension",
            self.tension,
            Dim::Force,
        );
        if self.length > 0.0 {
            table = table.fact("Slack Below", self.length, Dim::Length);
        }
        let [winding, paying] = self.friction;
        if winding + paying > 0.0 {
            table = table.fact("Winding In", self.tension * (1.0 - winding), Dim::Force).fact(
                "Paying Out",
                self.tension * (1.0 + paying),
                Dim::Force,
            );
        }
        table
    }

    fn element(&self, _: &Connection) -> Result<Box<dyn ConnectorElement>, ClassError> {
        Ok(Box::new(SpanElement(*self)))
    }
}

impl SpanLaw for ConstantTensionLine {
    fn notes(&self, span: &TautSpan) -> Vec<Note> {
        let is_slack = self.tension > 0.0 && self.tension_of(span).tension == 0.0;
        if is_slack { vec!["the line is slack".into()] } else { Vec::new() }
    }

    fn tension_of(&self, span: &TautSpan) -> SpanTension {
        let [winding, paying] = self.friction;
        let sign = if self.rests_paying_out { -1.0 } else { 1.0 };
        // 0 at rest, 1 where the drum turns the other way
        let (turned, slope) = smooth_step(sign * span.rate / FULL_FRICTION_SPEED);
        let (out, by_rate) = if self.rests_paying_out { (1.0 - turned, slope) } else { (turned, slope) };
        let factor = 1.0 - winding + (winding + paying) * out;
        let factor_by_rate = (winding + paying) * by_rate / FULL_FRICTION_SPEED;
        let (taut, by_length) = if self.length > 0.0 {
            let ramp = TAUTENING_SHARE * self.length;
            let (taut, slope) = smooth_step((span.length - self.length) / ramp);
            (taut, slope / ramp)
        } else {
            (1.0, 0.0)
        };
        SpanTension {
            tension: self.tension * factor * taut,
            by_length: self.tension * factor * by_length,
            by_rate: self.tension * taut * factor_by_rate,
        }
    }
}
