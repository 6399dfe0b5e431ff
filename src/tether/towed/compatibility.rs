//! Peculiarities of the program behind the listing of seed 003, each of which can be switched.

/// Which peculiarities of AQWATM-TETHER are kept. [`Compatibility::native`] keeps none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Compatibility {
    /// Slam `dm/ds v^2` pushes up when the tube leaves the water, too. Natively it acts on entry alone: added mass that is
    /// left behind takes its momentum along (von Karman 1929; DNV-RP-C205, 8.6).
    pub exit_slam: bool,
    /// Wave kinematics grow with `e^(kz)` above the mean level, too. Natively depths are stretched to the actual surface
    /// (Wheeler 1970).
    pub unstretched_crests: bool,
    /// The acceleration of a record belongs to the step that ends there (the first record: to the first stage of the first
    /// step), while its forces belong to the step that starts there. Natively both belong to the step that starts there, and
    /// forces and accelerations of a record are in equilibrium.
    pub acceleration_of_step_before: bool,
}

impl Compatibility {
    /// None of them.
    pub fn native() -> Self {
        Compatibility { exit_slam: false, unstretched_crests: false, acceleration_of_step_before: false }
    }

    /// All of them: the listing of seed 003 (AQWA-DRIFT with the tether enhancement), and every deck.
    pub fn aqwa_5_4() -> Self {
        Compatibility { exit_slam: true, unstretched_crests: true, acceleration_of_step_before: true }
    }
}

impl Default for Compatibility {
    fn default() -> Self {
        Compatibility::native()
    }
}
