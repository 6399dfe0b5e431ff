//! The tension of an element.

use super::mesh::{Element, Rod};
use super::surroundings::Fluid;

/// Tension of an element (N) with its derivatives by strain, by strain rate and by the height of its middle.
pub(super) struct Tension {
    pub value: f64,
    pub by_strain: f64,
    pub by_rate: f64,
    pub by_height: f64,
}

/// Effective tension: the law of the segment at the mechanical strain, internal damping, and what pressure does through Poisson's
/// ratio, (1 - 2 nu)(p_e A_e - p_i A_i) (Sparks, Fundamentals of Marine Riser Mechanics, 2007, section 2.4).
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "the tension of an element has that many causes")]
pub(super) fn tension(
    rod: &Rod,
    element: &Element,
    compression: bool,
    strain: f64,
    rate: f64,
    height: f64,
    fluid: &Fluid,
    gravity: f64,
) -> Tension {
    let segment = &rod.segments[element.segment];
    let free = segment.tube.as_ref().map_or(0.0, |t| t.expansion * t.warmer);
    let mechanical = strain - free;
    if mechanical < 0.0 && !compression {
        return Tension { value: 0.0, by_strain: 0.0, by_rate: 0.0, by_height: 0.0 };
    }
    let (value, by_strain) =
        if element.ea > 0.0 { (element.ea * mechanical, element.ea) } else { segment.axial.at(mechanical) };
    let mut made =
        Tension { value: value + element.damping * rate, by_strain, by_rate: element.damping, by_height: 0.0 };
    if let Some(tube) = &segment.tube {
        let share = 1.0 - 2.0 * tube.poisson;
        let [outside, inside] = tube.areas();
        let outer = fluid.density * gravity * (fluid.surface - height).max(0.0);
        let inner = tube.pressure + tube.contents * gravity * (tube.at - height);
        made.value += share * (outer * outside - inner * inside);
        let wet = if height < fluid.surface { fluid.density } else { 0.0 };
        made.by_height = share * gravity * (tube.contents * inside - wet * outside);
    }
    made
}
