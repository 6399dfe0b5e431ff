//! Effective tension of an element of a dynamic line: axial law, internal damping, temperature and pressure [SPARKS-2007 2.4].
//!
//! Wall tension and stress follow from it in `results`.

use super::environment::FluidState;
use super::mesh::{Rod, RodElement};
use super::section::{RodSegment, TensionLaw, TubeSection};
use super::viscoelastic::MaxwellMemory;
use nalgebra::Vector3;

/// Tension of an element (N) with its derivatives by strain, by strain rate and by the height of its middle.
pub(super) struct ElementTension {
    pub value: f64,
    pub by_strain: f64,
    pub by_rate: f64,
    pub by_height: f64,
}

/// How an element is stretched.
pub(super) struct ElementStretch {
    pub strain: f64,
    /// Strain rate (1/s).
    pub rate: f64,
    /// Elevation of its middle over the datum (m).
    pub height: f64,
    /// Elevation of the datum, the origin of positions (m, global).
    pub datum: f64,
}

/// How the tension law of an element is evaluated.
#[derive(Clone, Copy, Debug)]
pub(super) struct TensionOptions {
    /// Whether it resists being shortened.
    pub compression: bool,
    /// Scale of its axial stiffness: below one only on the way to a position of rest.
    pub axial_stiffness_scale: f64,
}

/// Contributions of temperature and pressure to the tension of a tube, through its areas.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct TubeAreas {
    /// Strain free of tension, by temperature.
    pub free_strain: f64,
    /// Tension by the pressure outside (m2).
    pub outside: f64,
    /// Tension that the contents take away at the datum (N), and give back by the way up from there (N/m).
    pub inside: f64,
    pub contents: f64,
}

impl TubeAreas {
    /// Of a tube, heights over a datum (m, global): (1 - 2 nu)(p_e A_e - p_i A_i) [SPARKS-2007 2.4].
    #[inline(always)]
    pub fn from_tube(tube: &TubeSection, gravity: f64, datum: f64) -> Self {
        let share = 1.0 - 2.0 * tube.poisson;
        let [outside, inside] = tube.areas().map(|area| share * area);
        let contents = tube.contents * gravity * inside;
        let free = tube.expansion * tube.warmer;
        TubeAreas {
            free_strain: free,
            outside,
            inside: tube.pressure * inside + contents * (tube.at - datum),
            contents,
        }
    }
}

impl ElementTension {
    const NONE: ElementTension = ElementTension { value: 0.0, by_strain: 0.0, by_rate: 0.0, by_height: 0.0 };
}

/// Effective tension: the law of the segment at the mechanical strain, internal damping, and what pressure does
/// through Poisson's ratio ([`TubeAreas`]), the pressure outside being the mean of what the fluids at its two nodes make it at its
/// middle. A viscoelastic rope with a `memory` adds its Maxwell element.
///
/// What does not resist being shortened never pushes, neither by its stiffness nor by its damper; and its damper does
/// not pull while it is slack.
#[inline(always)]
pub(super) fn tension(
    rod: &Rod,
    element: &RodElement,
    taken: TensionOptions,
    stretch: &ElementStretch,
    memory: Option<&MaxwellMemory>,
    fluids: [&FluidState; 2],
    gravity: f64,
) -> ElementTension {
    let segment = &rod.segments[element.segment];
    let free = segment.tube.as_ref().map_or(0.0, |t| t.expansion * t.warmer);
    let mechanical = stretch.strain - free;
    let shortened = mechanical < 0.0 && !taken.compression;
    if shortened && segment.tube.is_none() {
        return ElementTension::NONE;
    }
    let (value, by_strain) = if element.ea > 0.0 {
        (element.ea * mechanical, element.ea)
    } else if shortened {
        // pressure on its walls may still hold it taut; its law begins with its slope at zero
        let (_, slope) = segment.axial.evaluate(0.0);
        (slope * mechanical, slope)
    } else {
        segment.axial.evaluate(mechanical)
    };
    let mut made = ElementTension {
        value: value * taken.axial_stiffness_scale,
        by_strain: by_strain * taken.axial_stiffness_scale,
        by_rate: element.damping,
        by_height: 0.0,
    };
    if let (Some(memory), Some(rope)) = (memory, rod.viscoelastic_law(element)) {
        let (beside, slope) = rope.maxwell_tension(mechanical, memory);
        made.value += beside;
        made.by_strain += slope;
    }
    if let Some(tube) = &segment.tube {
        let TubeAreas { outside, inside, contents, .. } = TubeAreas::from_tube(tube, gravity, stretch.datum);
        let [a, b] = fluids.map(|fluid| fluid.pressure(stretch.height, gravity));
        let (outer, by_height) = (0.5 * (a.0 + b.0), 0.5 * (a.1 + b.1));
        made.value += outer * outside - (inside - contents * stretch.height);
        made.by_height = contents + by_height * outside;
    }
    let still = made.value;
    made.value += element.damping * stretch.rate;
    if !taken.compression && still.min(made.value) < 0.0 { ElementTension::NONE } else { made }
}

/// The first element of a rod that is stretched beyond the most that its law bears, where that falls again with more strain:
/// nothing would hold it there.
pub(super) fn find_overstretched(rod: &Rod, x: &[Vector3<f64>]) -> Option<usize> {
    let falls = |segment: &RodSegment| matches!(segment.axial, TensionLaw::Polynomial(_));
    if !rod.segments.iter().any(falls) {
        return None;
    }
    let beyond = |(element, x): (&RodElement, &[Vector3<f64>])| {
        let segment = &rod.segments[element.segment];
        let free = segment.tube.as_ref().map_or(0.0, |t| t.expansion * t.warmer);
        let strain = (x[1] - x[0]).norm() / element.rest - 1.0 - free;
        falls(segment) && strain > 0.0 && segment.axial.evaluate(strain).1 <= 0.0
    };
    rod.elements.iter().zip(x.windows(2)).position(beyond)
}
