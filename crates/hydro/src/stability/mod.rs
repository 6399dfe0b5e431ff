//! Static stability and longitudinal strength of one body by itself: its balance in heave, roll and trim in still water or under a static
//! wave, righting and heeling arms, the quantities stability criteria ask for, shear and bending along it.
//!
//! Source: [MOSES-REF hstatic, rarm, equi_h, stab_ok, moment]. Connectors, current and waves in motion have no part in it.

mod arms;
mod balance;
mod criteria;
mod slabs;
mod static_wave;
mod strength;

pub use arms::{ArmPoint, Arms, DownFloodingPoint, Heeling, ResistanceCentre, StopRule, find_down_flooding_points};
pub use balance::{Attitude, BalanceLimits, BalancedBody, StillBody};
pub use criteria::{Quantity, Stability, find_greatest_height};
pub use slabs::WaterSlabs;
pub use static_wave::StaticWave;
pub use strength::{LoadAlong, LongitudinalStrength, StrengthRow, find_strength};
