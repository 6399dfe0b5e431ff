//! Peculiarities of the program behind the listing of [AQWA-TETHER 8.1], each of which can be switched.
//!
//! What each makes in the towed example [AQWA-TETHER 8.1] (significant height 6.3 m, 375 s), as the change when it is
//! switched off (`crates/tether/tests/it/aqwa_tether_towed.rs` pins the first column):
//!
//! | switched off | error of the accelerations at the start (m/s2 of 2.86) | 2 x RMS of position | mean position | 2 x RMS of acceleration | 2 x RMS of moment |
//! |--|--|--|--|--|--|
//! | none | 0.0015 | | | | |
//! | `exit_slam` | 0.116 | -2 to +1 % | -0.01 to +0.02 m | -7 to -19 % | -1 to -16 % |
//! | `unstretched_crests` | 0.157 | -13 to 0 % | +0.22 to +0.43 m | +3 to +17 % | -8 to +9 % |
//! | `acceleration_of_step_before` | above 0.2 | none | none | -1.5 to +0.7 % | none |
//! | all | | -15 to -1 % | +0.23 to +0.43 m | -17 to +6 % | -13 to 0 % |

/// Which peculiarities of AQWATM-TETHER are kept. [`TowedCompatibility::native`] keeps none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TowedCompatibility {
    /// Slam `dm/ds v^2` pushes up when the tube leaves the water, too. Natively it acts on entry alone: added mass that is
    /// left behind takes its momentum along [VON-KARMAN-1929; DNV-RP-C205 8.6].
    pub exit_slam: bool,
    /// Wave kinematics grow with `e^(kz)` above the mean level, too. Natively depths are stretched to the actual surface
    /// [WHEELER-1970].
    pub unstretched_crests: bool,
    /// The acceleration of a record belongs to the step that ends there (the first record: to the first stage of the first
    /// step), while its forces belong to the step that starts there. Natively both belong to the step that starts there, and
    /// forces and accelerations of a record are in equilibrium.
    pub acceleration_of_step_before: bool,
}

impl TowedCompatibility {
    /// None of them.
    pub fn native() -> Self {
        TowedCompatibility { exit_slam: false, unstretched_crests: false, acceleration_of_step_before: false }
    }

    /// All of them: the listing of [AQWA-TETHER 8.1] (AQWA-DRIFT with the tether enhancement), and every deck.
    pub fn aqwa_5_4() -> Self {
        TowedCompatibility { exit_slam: true, unstretched_crests: true, acceleration_of_step_before: true }
    }
}

impl Default for TowedCompatibility {
    fn default() -> Self {
        TowedCompatibility::native()
    }
}
