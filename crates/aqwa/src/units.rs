//! The units of a deck. A deck is in any consistent set of units and does not say which: gravity shows the unit of
//! length, and then the density of the water the unit of mass; time is in seconds, force follows.

use super::properties::WaterAndGravity;
use windlass_base::diagnostic::Diagnostic;

/// Units of a deck in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Units {
    /// Metres in the unit of length.
    pub length: f64,
    /// Kilograms in the unit of mass.
    pub mass: f64,
    /// Name of the set, e.g. `m, t, kN, s`.
    pub name: &'static str,
}

/// Standard gravity (m/s2).
const GRAVITY: f64 = 9.806_65;
/// Metres in a foot.
const METRES_PER_FOOT: f64 = 0.3048;
/// Kilograms in a pound.
const KILOGRAMS_PER_POUND: f64 = 0.453_592_37;

const SETS: &[Units] = &[
    Units { length: 1.0, mass: 1.0, name: "m, kg, N, s" },
    Units { length: 1.0, mass: 1000.0, name: "m, t, kN, s" },
    Units { length: 1.0, mass: 1.0e6, name: "m, 1000 t, MN, s" },
    Units { length: 1.0, mass: GRAVITY, name: "m, kgf s2/m, kgf, s" },
    Units { length: 1.0, mass: 1000.0 * GRAVITY, name: "m, tf s2/m, tf, s" },
    Units { length: METRES_PER_FOOT, mass: KILOGRAMS_PER_POUND, name: "ft, lb, pdl, s" },
    Units { length: METRES_PER_FOOT, mass: KILOGRAMS_PER_POUND * GRAVITY / METRES_PER_FOOT, name: "ft, slug, lbf, s" },
    Units {
        length: METRES_PER_FOOT,
        mass: 1000.0 * KILOGRAMS_PER_POUND * GRAVITY / METRES_PER_FOOT,
        name: "ft, kip s2/ft, kip, s",
    },
];

impl Units {
    /// Newtons in the unit of force.
    pub fn force(&self) -> f64 {
        self.mass * self.length
    }
}

/// The units that gravity and the density of the water tell.
///
/// # Errors
/// When gravity is none within 1 % of the earth's in metres or feet, or the density none of water (950 to 1100 kg/m3) in any
/// set known.
pub fn units(global: &WaterAndGravity) -> Result<Units, Box<Diagnostic>> {
    let says = |message: String, span: Option<_>| match span {
        Some(span) => Diagnostic::error(message, span),
        None => Box::new(Diagnostic::plain(windlass_base::diagnostic::Severity::Error, message)),
    };
    let near = |set: &&Units| (global.gravity * set.length / GRAVITY - 1.0).abs() < 0.01;
    if !SETS.iter().any(|set| near(&set)) {
        let message = format!("deck 5: gravity {} is the earth's in no known unit of length", global.gravity);
        return Err(says(message, global.gravity_span).label("about 9.81 for metres, 32.2 for feet"));
    }
    let water = |set: &&Units| (950.0..1100.0).contains(&(global.density * set.mass / set.length.powi(3)));
    SETS.iter().filter(near).find(water).copied().ok_or_else(|| {
        let message = format!("deck 5: a density of {} is that of water in no known unit of mass", global.density);
        says(message, global.density_span).label("about 1025 for kg and m, 1.025 for t and m, 1.99 for slug and ft")
    })
}
