//! CT_LINE: a line of constant tension, as a winch keeps that pays out and heaves in at its set tension.
//!
//! The force on each end is T toward the other; with the unit vector n from the first end to the second and their distance L its
//! stiffness is T/L (1 - n n'), which is the chord's of [MOSES-REF cls_flex] without an elastic part. It is the line FORC of AQWA decks.
//! Nothing limits its length, and it is straight: sag, a stall and the drum's friction are not modelled.

use super::ClassKind;
use super::spring::no_anchor;
use std::sync::Arc;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_language::spec::{CommandSpec, Kind, ValueSpec};
use windlass_model::{
    ClassError, ClassRecord, Connection, Connector, ConnectorClass, Element, ElementResponse, ElementSummary,
    Situation, SolverCache, Surroundings,
};

/// The class type.
pub static CT_LINE: ClassKind = ClassKind { spec: &SPEC, build, idle: &[] };

static SPEC: CommandSpec = CommandSpec {
    data: &[ValueSpec::new("TENSION", Kind::Number(Dim::Force), "tension it keeps").not_negative()],
    detail: "A straight line between two points that keeps its tension at any length, as a constant-tension winch does: it pulls each \
             end toward the other with TENSION. A point of the ground is its anchor. It has no elastic stiffness; its direction gives \
             it TENSION over its length across itself.",
    example: "MEDIT\n*QUAY 0 0 8\n&DESCRIBE BODY SHIP\n*BITT 12 3 6\n~WINCH CT_LINE 300\nCONNECTOR W1 ~WINCH *BITT *QUAY\nEND\n\
              &STATUS CLASS ~WINCH",
    ..CommandSpec::new("CT_LINE", "line of constant tension")
};

#[derive(Debug)]
struct ConstantTensionClass {
    /// Tension (N).
    tension: f64,
}

/// The line between two ends: its tension (N).
#[derive(Debug)]
struct ConstantTensionLine(f64);

fn build(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    let tension = records.last().and_then(|r| r.args.number(const { SPEC.number("TENSION") }));
    Ok(Arc::new(ConstantTensionClass { tension: tension.unwrap_or(0.0) }))
}

impl ConnectorClass for ConstantTensionClass {
    fn kind(&self) -> &'static str {
        "CT_LINE"
    }

    fn check_ends(&self, connector: &Connector, _: usize) -> Outcome<()> {
        no_anchor("CT_LINE", connector)?;
        if connector.points.len() != 2 {
            let text = "a CT_LINE takes 2 points; its anchor is a point of the ground";
            return Err(Diagnostic::error(text, connector.span));
        }
        Ok(())
    }

    fn is_line(&self) -> bool {
        true
    }

    fn properties(&self, name: &str, _: &Surroundings) -> Table {
        Table::new(format!("Class {name}")).fact("Type", "CT_LINE", Dim::None).fact("Tension", self.tension, Dim::Force)
    }

    fn element(&self, _: &Connection) -> Result<Box<dyn Element>, ClassError> {
        Ok(Box::new(ConstantTensionLine(self.tension)))
    }
}

impl Element for ConstantTensionLine {
    fn evaluate(
        &self,
        at: &Situation,
        _: &[f64],
        _: &mut [f64],
        _: &mut SolverCache,
        out: &mut ElementResponse,
    ) -> Result<(), ClassError> {
        let ConstantTensionLine(tension) = self;
        let [first, second] = at.ends else { return Err(ClassError::new("a line has two ends").lasting()) };
        let chord = second.pose.origin - first.pose.origin;
        let length = chord.norm();
        if length == 0.0 {
            return Err(ClassError::new("its ends are in one place, where its tension has no direction"));
        }
        let direction = chord / length;
        let across = nalgebra::Matrix3::identity() - direction * direction.transpose();
        let stiffness = across * (tension / length);
        out.clear(2);
        for (wrench, sign) in out.wrench.iter_mut().zip([1.0, -1.0]) {
            wrench.fixed_rows_mut::<3>(0).copy_from(&(direction * (sign * tension)));
        }
        for (block, sign) in out.stiffness.iter_mut().zip([1.0, -1.0, -1.0, 1.0]) {
            block.fixed_view_mut::<3, 3>(0, 0).copy_from(&(stiffness * sign));
        }
        Ok(())
    }

    fn summary(&self, _: &Situation, _: &[f64]) -> Result<ElementSummary, ClassError> {
        let ConstantTensionLine(tension) = self;
        Ok(ElementSummary { tension: Some(*tension), solution: "exact", ..ElementSummary::default() })
    }
}
