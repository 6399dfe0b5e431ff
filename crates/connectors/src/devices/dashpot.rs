//! `-X_DAMPING` of a line: a dashpot along its chord (see [`crate::spring_law`]).

use super::{ChordDamper, Device, DeviceAction, DeviceKind};
use crate::options as o;
use crate::spring_law::Dashpot;
use nalgebra::Vector3;
use std::sync::Arc;
use windlass_model::{ClassError, Connection};

/// -X_DAMPING.
pub(super) static X_DAMPING: DeviceKind = DeviceKind {
    option: &o::X_DAMPING_LINE,
    check: |_| Ok(()),
    read: |given| Dashpot::from_given(given).map(|dashpot| Arc::new(dashpot) as Arc<dyn Device>),
};

impl Device for Dashpot {
    fn action(&self, _: &Connection) -> Result<DeviceAction, ClassError> {
        Ok(DeviceAction::Damper(Box::new(*self)))
    }
}

impl ChordDamper for Dashpot {
    fn force(&self, rate: f64) -> (f64, f64) {
        let (force, slope) = self.evaluate(&Vector3::new(rate, 0.0, 0.0), [true, false, false]);
        (force.x, slope[(0, 0)])
    }
}
