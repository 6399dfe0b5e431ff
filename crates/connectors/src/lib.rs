//! Connector classes: each file has the spec of its class types and an object that implements
//! [`ConnectorClass`].
//!
//! # Example
//! The break of studless R4 chain of 84 mm, 0.0274 d^2 (44 - 0.08 d) kN:
//! ```
//! let types = &windlass_connectors::line_types::library().types;
//! let chain = types.iter().find(|t| t.name == "CHAIN_R4").ok_or("no such chain")?;
//! let by_hand = 0.0274 * 84.0 * 84.0 * (44.0 - 0.08 * 84.0) * 1e3;
//! assert!((chain.breaking.evaluate(0.084) / by_hand - 1.0).abs() < 1e-9);
//! # Ok::<(), &str>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod aqwa;
mod b_cat;
mod checks;
mod chord;
mod ct_line;
mod davit;
mod devices;
mod dynamic_line;
mod extended_line;
mod extension;
mod fender;
mod fix;
mod foundation;
mod gap;
mod gspr;
mod h_cat;
pub mod hook;
mod line_class;
mod line_element;
mod line_profile;
mod line_properties;
pub mod line_types;
mod lmu;
mod lndw;
mod loads;
mod member_section;
mod mooring;
mod mooring_table;
mod nlin;
pub mod options;
mod per_line;
mod puly;
mod reeved_line;
mod restraint;
mod rod;
mod roller;
mod section;
mod sl_elem;
mod sling;
mod spr;
mod spring;
mod spring_law;
mod taut_span;
mod tether;
mod tie;
mod tug_boat;
pub mod viscous;
mod zero_law;
mod zero_length;

pub use member_section::{SECTIONS, SHAPE_SPEC, SectionKind, check_sections, class_specs, member_class};
pub use section::{has_rope_stiffness, type_notices};

use std::sync::Arc;
use windlass_base::diagnostic::Outcome;
use windlass_language::spec::{CommandSpec, OptionSpec};
use windlass_model::{ClassRecord, ConnectorClass, SegmentedClass};

/// A type of class a user can name in a `~NAME TYPE ...` record.
pub struct ClassKind {
    /// The record's form behind the class name; its name is the type.
    pub spec: &'static CommandSpec,
    /// Options that are read and kept and do nothing here, each with what they act with; empty where nothing is.
    pub idle: &'static [(OptionSpec, &'static str)],
    /// Builds the object from all records of the class so far, fairlead first.
    pub build: fn(&[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>>,
}

/// Builds a class of segments, record by record.
fn append_all<C: ConnectorClass + SegmentedClass + Default + 'static>(
    records: &[ClassRecord],
) -> Outcome<Arc<dyn ConnectorClass>> {
    let mut class = C::default();
    for record in records {
        class.append(record)?;
    }
    Ok(Arc::new(class))
}

impl PartialEq for ClassKind {
    /// A class type is its spec.
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self.spec, other.spec)
    }
}

/// The class types that have an option, as a sentence lists them: `A, B and C`.
pub fn list_kinds_with_option(option: &OptionSpec) -> String {
    let has_option = |kind: &&&ClassKind| kind.spec.options.iter().any(|own| own.name == option.name);
    let names: Vec<&str> = CLASSES.iter().filter(has_option).map(|kind| kind.spec.name).collect();
    match names.as_slice() {
        [] => String::new(),
        [only] => (*only).to_string(),
        [others @ .., last] => format!("{} and {last}", others.join(", ")),
    }
}

/// All class types, in the order of the manual.
pub static CLASSES: &[&ClassKind] = &[
    &foundation::FOUNDATION,
    &gspr::GSPR,
    &lmu::LMU,
    &sling::SLING,
    &davit::DAVIT,
    &roller::ROLLER,
    &rod::ROD,
    &b_cat::B_CAT,
    &h_cat::H_CAT,
    &sl_elem::SL_ELEM,
    &aqwa::CATENARY,
    &tether::TETHER,
    &fix::FIX,
    &spr::SPR,
    &gap::GAP,
    &fender::FENDER,
    &tug_boat::TUG_BOAT,
    &ct_line::CT_LINE,
    &nlin::NLIN,
    &lndw::LNDW,
    &puly::PULY,
];
