//! Stiff ties, whose force an engine may hold as an unknown of its own.
//!
//! A tie of 1e12 N/m makes a newton of the rounding of places five kilometres from the origin. With its force held, places enter by the
//! deflection alone, `q(places) - force / k`, which rounding changes by a picometre: the mixed form of an elastic constraint
//! [BATHE-1996 4.4; GEAR-1985].

use nalgebra::Matrix6;
use windlass_base::pose::Six;

/// What a stiff linear tie answers while an engine holds its force. Forces are conjugate to the displacement and rotation of its second end
/// against its first, or the reverse, in axes of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct TieResponse {
    /// The force (N) and moment (N m) that its law has at its ends.
    pub force: Six,
    /// How they change with the translation (m) and rotation vector (rad) of each end, global axes.
    pub slopes: [Matrix6<f64>; 2],
    /// Wrench on each end (N, N m; about its point, global axes) of what the law has beyond the force that is held.
    pub excess: [Six; 2],
    /// Largest deflection that the force held does not explain, beyond what rounding makes (m, rad).
    pub gap: f64,
}
