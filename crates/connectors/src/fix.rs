//! FIX: a restraint that holds chosen degrees of freedom rigidly.
//!
//! Source: [MOSES-REF cls_res]. The reference restrains only translations in a simulation; here rotations are held as well.

use super::restraint::RestraintClass;
use super::spring::Restraint;
use super::{ClassKind, options as o};
use std::sync::Arc;
use windlass_base::choice::{Choice, Dof};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_language::spec::CommandSpec;
use windlass_model::{ClassRecord, ConnectorClass, TiedBodies};

/// The class type.
pub static FIX: ClassKind = ClassKind { spec: &SPEC, build, idle: &[] };

/// Stiffness of what is rigid (N/m, N m/rad), at least. Engines hold the forces of so stiff a tie, so that rounding of positions makes none.
pub const RIGID_STIFFNESS: f64 = 1e12;
/// Square of the frequency (1/s2) below which nothing swings on a rigid tie: a hundred radians a second, far above waves. The moment of
/// inertia of a tanker on 1E12 N m/rad would swing with the waves.
const RIGID_FREQUENCY_SQUARED: f64 = 1e4;
/// A rigid tie over the hydrostatic stiffness that it holds: what of a load the water bears beside it is below the digits of a report.
const RIGID_SHARE: f64 = 1e6;

static SPEC: CommandSpec = CommandSpec {
    data: &[o::DF.or("all six")],
    repeat: 1,
    options: &[o::IG_STIFF],
    detail: "Holds these degrees of freedom of the second end against the first as they stood when the connector was defined: place the \
             bodies first. Axes are those of the first node's body, turned by -EULER; global on ground. Rigid means 1.0E12 N/m and \
             1.0E12 N m/rad, and more for bodies that ask for it: no body on it swings slower than 100 rad/s, and it is a million times as \
             stiff as the #HYDROSTATIC or the database of its bodies. &EQUI and TDOM solve its force as an unknown, which rounding of positions does not feel; it is unloaded where a \
             run begins: two bodies of 1000 kN each ring by 3.5 per cent of its force at first, by less than 0.2 after 1.3 s. With one node it holds to the \
             ground. Rotations are held in the time domain as well. Its force belongs to RIGID_CONNECTORS.",
    example: "MEDIT\n*P 0 0 0\n~HINGE FIX X Y Z\n~CLAMP FIX\nCONNECTOR H ~HINGE *P\nEND\n&STATUS CLASS ~HINGE",
    ..CommandSpec::new("FIX", "rigid restraint")
};

fn build(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    let given = records.last().map(|r| r.args.data.as_slice()).unwrap_or_default();
    let mut list: Vec<Restraint> = Vec::new();
    for value in given {
        let Some(dof) = value.choice::<Dof>() else { continue };
        if list.iter().any(|r| r.dof == dof) {
            return Err(Diagnostic::error(format!("degree of freedom {} is given twice", dof.word()), value.span));
        }
        list.push(restrain_dof(dof));
    }
    if list.is_empty() {
        list = Dof::SIX.map(restrain_dof).into();
    }
    Ok(Arc::new(RestraintClass::new("FIX", list).rigid()))
}

/// Stiffnesses of a rigid tie between bodies: of translations (N/m) and of rotations (N m/rad).
pub fn rigid_stiffness(tied: &TiedBodies) -> [f64; 2] {
    let of = |(inertia, stiffness): (f64, f64)| {
        RIGID_STIFFNESS.max(RIGID_FREQUENCY_SQUARED * inertia).max(RIGID_SHARE * stiffness)
    };
    let [mass, moment] = tied.inertia;
    let [along, about] = tied.stiffness;
    [of((mass, along)), of((moment, about))]
}

fn restrain_dof(dof: Dof) -> Restraint {
    Restraint { dof, stiffness: RIGID_STIFFNESS, allowable: None }
}
