//! The frequency domain: small motions about a place, linear in the waves.
//!
//! The equations are `(K - w2 (M + A(w)) - i w (B + B(w))) q = X(w, b)` with `q(t) = Re(q exp(-i w t))`, the signs of
//! [`windlass_model::Database`]: the argument of an amplitude is its lag behind the crest at the global origin. [`LinearSystem`] holds them,
//! [`LinearQuantity`] what is asked of the motions, [`FrequencyResponse`] the motions in a sea with their spectra and statistics.

mod equations;
mod light_modes;
mod linear;
mod linearise;
mod natural;
mod operators;
mod quantity;
mod response;
mod slow;
mod statistics;
pub mod tables;
mod trains;

pub use equations::{Frame, diagonals, exciting_forces, matrices, stiffness};
pub use light_modes::{WaveBand, warnings_of_free_drift, warnings_of_modes};
pub use linear::{LinearSystem, Motions};
pub use natural::{Natural, natural};
pub use operators::{Operator, Operators};
pub use quantity::{Derivative, LinearQuantity};
pub use response::{FrequencyResponse, ResponseOptions, ResponsePoint, respond, sea_response};
pub use statistics::{ExtremeKind, ResponseStatistics};
pub use trains::Trains;
