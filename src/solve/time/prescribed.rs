//! Bodies whose motion is given.

use super::forces::Motion;
use crate::model::ClassError;
use std::fmt::Debug;

/// A motion that is given for all times.
pub trait Prescribed: Debug + Send + Sync {
    /// The motion at a time (s); its auxiliary acceleration is its acceleration.
    ///
    /// # Errors
    /// A time for which there is none.
    fn at(&self, time: f64) -> Result<Motion, ClassError>;
}
