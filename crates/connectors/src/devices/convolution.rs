//! `-CONVOLUTION NAME` of a line: a viscoelastic spring in series at its first end (see [`crate::viscous`]).

use super::{Device, DeviceAction, DeviceKind, SeriesSpring};
use crate::mooring::no_curve;
use crate::options as o;
use crate::viscous::{Affine, ViscoelasticLaw};
use std::sync::Arc;
use windlass_base::span::Span;
use windlass_model::{ClassError, Connection};

/// -CONVOLUTION.
pub(super) static CONVOLUTION: DeviceKind = DeviceKind {
    option: &o::CONVOLUTION,
    check: |_| Ok(()),
    read: |given| {
        let name = given.first_word()?.to_string();
        Some(Arc::new(ConvolutionSpring { name, span: given.span }))
    },
};

/// The curve of a spring, with its place.
#[derive(Debug)]
struct ConvolutionSpring {
    name: String,
    span: Span,
}

impl Device for ConvolutionSpring {
    fn action(&self, connection: &Connection) -> Result<DeviceAction, ClassError> {
        let law = (connection.curve)(&self.name).and_then(ViscoelasticLaw::fit).map(|fit| fit.law);
        let law = law.ok_or_else(|| no_curve(&self.name, self.span))?;
        if law.long_term <= 0.0 {
            let text = "a viscoelastic spring in a line must keep some stiffness at last";
            return Err(ClassError::new(text).with_span(self.span));
        }
        Ok(DeviceAction::Spring(Box::new(law)))
    }

    fn curve(&self) -> Option<(String, Span)> {
        Some((self.name.clone(), self.span))
    }
}

impl SeriesSpring for ViscoelasticLaw {
    fn states(&self) -> usize {
        ViscoelasticLaw::states(self)
    }

    fn step(&self, dt: Option<f64>, committed: &[f64]) -> Affine {
        ViscoelasticLaw::step(self, dt, committed)
    }

    fn advance(&self, dt: Option<f64>, committed: &[f64], deflection: f64, trial: &mut [f64]) {
        ViscoelasticLaw::advance(self, dt, committed, deflection, trial);
    }
}
