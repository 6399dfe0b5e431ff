//! The properties of a rod: its segments and what is attached between them.

use super::error::RodError;
use super::viscoelastic::ViscoelasticRope;

/// Tension by strain.
#[derive(Clone, Debug, PartialEq)]
pub enum TensionLaw {
    /// EA (N): tension is EA times strain.
    Linear(f64),
    /// Coefficients (N) of strain, strain squared, ... The slope at zero must be positive.
    Polynomial(Vec<f64>),
    /// Points (strain, tension in N) by rising strain and tension, straight between and beyond.
    Table(Vec<(f64, f64)>),
    /// A rope with a static and a dynamic stiffness. Its static law is what [`TensionLaw::evaluate`] and [`TensionLaw::energy`] give.
    Viscoelastic(Box<ViscoelasticRope>),
}

impl TensionLaw {
    /// The law of coefficients as of [`TensionLaw::Polynomial`], those of the highest powers left out that are zero: a line of one alone is
    /// linear, and quicker.
    pub fn from_powers(mut coefficients: Vec<f64>) -> Self {
        while coefficients.len() > 1 && coefficients.last() == Some(&0.0) {
            coefficients.pop();
        }
        if let [ea] = coefficients[..] { TensionLaw::Linear(ea) } else { TensionLaw::Polynomial(coefficients) }
    }

    /// Tension (N) and its slope d(tension)/d(strain) (N) at a strain.
    pub fn evaluate(&self, strain: f64) -> (f64, f64) {
        match self {
            TensionLaw::Linear(ea) => (ea * strain, *ea),
            TensionLaw::Polynomial(coefficients) => {
                let (mut sum, mut slope) = (0.0, 0.0);
                for c in coefficients.iter().rev() {
                    slope = slope * strain + sum;
                    sum = sum * strain + c;
                }
                // sum is tension over strain, slope its derivative
                (sum * strain, sum + slope * strain)
            }
            TensionLaw::Table(points) => {
                let after = points.partition_point(|p| p.0 <= strain).clamp(1, points.len() - 1);
                let (a, b) = (points[after - 1], points[after]);
                let slope = (b.1 - a.1) / (b.0 - a.0);
                (a.1 + slope * (strain - a.0), slope)
            }
            TensionLaw::Viscoelastic(rope) => rope.slow.evaluate(strain),
        }
    }

    /// Slope of the slope (N) at a strain.
    pub(super) fn second_derivative(&self, strain: f64) -> f64 {
        match self {
            TensionLaw::Linear(_) | TensionLaw::Table(_) => 0.0,
            TensionLaw::Polynomial(coefficients) => {
                let powers = coefficients.iter().enumerate().skip(1);
                powers.map(|(k, c)| c * (k * (k + 1)) as f64 * strain.powi(k as i32 - 1)).sum()
            }
            TensionLaw::Viscoelastic(rope) => rope.slow.second_derivative(strain),
        }
    }

    /// Energy per unstretched length (J/m) stored at a strain, from zero strain.
    pub fn energy(&self, strain: f64) -> f64 {
        match self {
            TensionLaw::Linear(ea) => 0.5 * ea * strain * strain,
            TensionLaw::Polynomial(coefficients) => {
                let powers = coefficients.iter().enumerate();
                powers.map(|(k, c)| c * strain.powi(k as i32 + 2) / (k as f64 + 2.0)).sum()
            }
            TensionLaw::Table(points) => {
                // the trapezoids between zero and the strain, each end of a piece once
                let (low, high, sign) = if strain < 0.0 { (strain, 0.0, -1.0) } else { (0.0, strain, 1.0) };
                let inner = points.iter().map(|p| p.0).filter(|e| (low..high).contains(e));
                let mut sum = 0.0;
                let mut from = low;
                for to in inner.chain([high]) {
                    sum += 0.5 * (to - from) * (self.evaluate(from).0 + self.evaluate(to).0);
                    from = to;
                }
                sign * sum
            }
            TensionLaw::Viscoelastic(rope) => rope.slow.energy(strain),
        }
    }

    pub(super) fn find_fault(&self) -> Option<(f64, &'static str)> {
        match self {
            TensionLaw::Linear(ea) if !(ea.is_finite() && *ea > 0.0) => Some((*ea, "it must be positive")),
            TensionLaw::Polynomial(c) if !c.first().is_some_and(|c| *c > 0.0) || c.iter().any(|c| !c.is_finite()) => {
                Some((c.first().copied().unwrap_or(0.0), "its first coefficient must be positive and all finite"))
            }
            TensionLaw::Table(points)
                if points.len() < 2
                    || points.windows(2).any(|p| !(p[1].0 > p[0].0 && p[1].1 > p[0].1))
                    || points.iter().any(|p| !(p.0.is_finite() && p.1.is_finite())) =>
            {
                Some((points.len() as f64, "its points must be two or more, with strain and tension both rising"))
            }
            TensionLaw::Viscoelastic(rope) => rope.find_fault(),
            _ => None,
        }
    }
}

/// The section of a tube: what pressure, temperature and bending stress need.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TubeSection {
    /// Outer diameter (m).
    pub outer: f64,
    /// Inner diameter (m).
    pub inner: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Thermal expansion (1/K).
    pub expansion: f64,
    /// Temperature above the one of laying (K).
    pub warmer: f64,
    /// Pressure of the contents (Pa, above the atmosphere's) at the elevation `at`.
    pub pressure: f64,
    /// Elevation of that pressure (m, global z).
    pub at: f64,
    /// Density of the contents (kg/m3); their mass is part of the segment's `mass`.
    pub contents: f64,
}

impl TubeSection {
    /// A tube of outer and inner diameter (m) without contents, pressure or temperature.
    pub fn empty(outer: f64, inner: f64) -> Self {
        TubeSection { outer, inner, poisson: 0.3, expansion: 0.0, warmer: 0.0, pressure: 0.0, at: 0.0, contents: 0.0 }
    }

    /// Outer and inner cross-section (m2).
    pub fn areas(&self) -> [f64; 2] {
        [self.outer, self.inner].map(|d| std::f64::consts::FRAC_PI_4 * d * d)
    }

    /// Second moment of the wall's area (m4).
    pub fn second_moment(&self) -> f64 {
        std::f64::consts::PI / 64.0 * (self.outer.powi(4) - self.inner.powi(4))
    }
}

/// A stretch of rod with one set of properties, cut into equal elements.
#[derive(Clone, Debug, PartialEq)]
pub struct RodSegment {
    /// Unstretched length (m).
    pub length: f64,
    /// Number of elements.
    pub elements: usize,
    /// Mass per unstretched length with contents, growth and coating (kg/m).
    pub mass: f64,
    /// Tension by strain. Without a `tube` it is the effective tension that follows it (Poisson's ratio one half).
    pub axial: TensionLaw,
    /// Axial internal damping (N s): tension per strain rate.
    pub axial_damping: f64,
    /// Whether it resists being shortened; a chain or rope does not.
    pub compression: bool,
    /// Bending stiffness EI (N m2); zero for a chain or rope.
    pub bending: f64,
    /// Torsional stiffness GJ (N m2); zero leaves torsion out.
    pub torsion: f64,
    /// Cross-section that displaces water (m2).
    pub displaced: f64,
    /// Diameter for drag (m).
    pub drag_diameter: f64,
    /// Normal drag coefficient, on the drag diameter.
    pub drag_normal: f64,
    /// Tangential drag coefficient, on pi times the drag diameter (skin).
    pub drag_tangential: f64,
    /// Cross-section of water for added mass (m2).
    pub added_area: f64,
    /// Normal added mass coefficient.
    pub added_normal: f64,
    /// Tangential added mass coefficient.
    pub added_tangential: f64,
    /// Diameter by which it lies on the bottom and meets the surface (m).
    pub contact_diameter: f64,
    /// Diameter for wind on the part above the surface (m).
    pub wind_diameter: f64,
    /// Normal drag coefficient of wind, on the wind diameter.
    pub wind_drag: f64,
    /// Its section, where pressure, temperature or stresses are wanted.
    pub tube: Option<TubeSection>,
}

impl RodSegment {
    /// A chain or rope of a diameter that displaces, drags and lies: no bending, no compression, no hydrodynamic
    /// coefficients.
    pub fn line(length: f64, elements: usize, mass: f64, ea: f64, diameter: f64) -> Self {
        let area = std::f64::consts::FRAC_PI_4 * diameter * diameter;
        RodSegment {
            length,
            elements,
            mass,
            axial: TensionLaw::Linear(ea),
            axial_damping: 0.0,
            compression: false,
            bending: 0.0,
            torsion: 0.0,
            displaced: area,
            drag_diameter: diameter,
            drag_normal: 0.0,
            drag_tangential: 0.0,
            added_area: area,
            added_normal: 0.0,
            added_tangential: 0.0,
            contact_diameter: diameter,
            wind_diameter: diameter,
            wind_drag: 0.0,
            tube: None,
        }
    }

    /// Refuses what makes no rod.
    pub(super) fn check(&self, rod: &str, segment: usize) -> Result<(), RodError> {
        let refuse =
            |what, value, expected| Err(RodError::Property { rod: rod.to_string(), segment, what, value, expected });
        for (what, value) in [("the length", self.length), ("the mass per length", self.mass)] {
            if !(value.is_finite() && value > 0.0) {
                return refuse(what, value, "it must be positive");
            }
        }
        if self.elements == 0 {
            return refuse("the number of elements", 0.0, "at least one is needed");
        }
        if let Some((value, expected)) = self.axial.find_fault() {
            return refuse("the axial stiffness", value, expected);
        }
        for (what, value) in [
            ("the axial damping", self.axial_damping),
            ("the bending stiffness", self.bending),
            ("the torsional stiffness", self.torsion),
            ("the displaced area", self.displaced),
            ("the drag diameter", self.drag_diameter),
            ("the normal drag coefficient", self.drag_normal),
            ("the tangential drag coefficient", self.drag_tangential),
            ("the added mass area", self.added_area),
            ("the normal added mass coefficient", self.added_normal),
            ("the tangential added mass coefficient", self.added_tangential),
            ("the contact diameter", self.contact_diameter),
            ("the wind diameter", self.wind_diameter),
            ("the drag coefficient of wind", self.wind_drag),
        ] {
            if !(value.is_finite() && value >= 0.0) {
                return refuse(what, value, "it must not be negative");
            }
        }
        if self.torsion > 0.0 && self.bending == 0.0 {
            return refuse("the bending stiffness", 0.0, "a segment with torsional stiffness needs it");
        }
        if let Some(tube) = &self.tube {
            if !(tube.outer.is_finite() && tube.outer > 0.0) {
                return refuse("the outer diameter", tube.outer, "it must be positive");
            }
            if !(tube.inner >= 0.0 && tube.inner < tube.outer) {
                return refuse(
                    "the inner diameter",
                    tube.inner,
                    "the wall must be thinner than the radius and not nothing",
                );
            }
            let others = [tube.poisson, tube.expansion, tube.warmer, tube.pressure, tube.at, tube.contents];
            if let Some(value) = others.into_iter().find(|v| !v.is_finite()) {
                return refuse("a property of the tube", value, "it must be a number");
            }
        }
        Ok(())
    }
}

/// A clump, buoy or point mass attached to a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attachment {
    /// Node, from 0 at end A.
    pub node: usize,
    /// Mass (kg).
    pub mass: f64,
    /// Displaced volume (m3).
    pub volume: f64,
    /// Height over which it comes out of the water (m).
    pub height: f64,
    /// Length of the pendant on which it floats above its node (m), taken as plumb.
    pub pendant: f64,
    /// Drag area times coefficient (m2), the same in all directions.
    pub drag: f64,
    /// Added mass coefficient on the volume.
    pub added: f64,
    /// Area by which it lies on the bottom (m2), beside what the rod has there.
    pub bearing: f64,
}

impl Attachment {
    /// A mass (kg) without size at a node.
    pub fn mass(node: usize, mass: f64) -> Self {
        Attachment { node, mass, volume: 0.0, height: 0.0, pendant: 0.0, drag: 0.0, added: 0.0, bearing: 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axial_energy_matches_integral_of_tension() {
        let laws = [
            TensionLaw::Linear(3.0),
            TensionLaw::Polynomial(vec![2.0, 5.0, 7.0]),
            TensionLaw::Table(vec![(-1.0, -2.0), (0.0, 0.0), (0.05, 1.0), (0.2, 9.0)]),
        ];
        for law in laws {
            for strain in [-0.02, 0.03, 0.11] {
                let h = 1e-6;
                let slope = (law.energy(strain + h) - law.energy(strain - h)) / (2.0 * h);
                // central difference: h squared and rounding
                assert!((slope - law.evaluate(strain).0).abs() < 1e-8, "{law:?} {strain}");
                let tangent = (law.evaluate(strain + h).0 - law.evaluate(strain - h).0) / (2.0 * h);
                assert!((tangent - law.evaluate(strain).1).abs() < 1e-7, "{law:?} {strain}");
                let bend = (law.evaluate(strain + h).1 - law.evaluate(strain - h).1) / (2.0 * h);
                assert!((bend - law.second_derivative(strain)).abs() < 1e-7, "{law:?} {strain}");
            }
        }
    }
    #[test]
    fn first_power_law_is_linear() {
        assert_eq!(TensionLaw::from_powers(vec![3.0, 0.0, 0.0]), TensionLaw::Linear(3.0));
        assert_eq!(TensionLaw::from_powers(vec![3.0, 0.0, 5.0, 0.0]), TensionLaw::Polynomial(vec![3.0, 0.0, 5.0]));
        assert_eq!(TensionLaw::from_powers(vec![]), TensionLaw::Polynomial(vec![]));
    }
}
