//! Elements of a line, and those that a winch lets out or takes in.

use super::describe::{JointMass, LinePart};
use super::environment::BUOYANT_LINE_WEIGHT_SHARE;
use nalgebra::Vector3;
use std::f64::consts::PI;
use windlass_base::units::Dim;
use windlass_line_dynamics::{self as rod, Attachment, Rod, RodError, RodSegment, RodState};
use windlass_model::{Ambient, ClassError};

/// An element at the winch is divided when it is longer than this share of those of its part as the class has them.
const DIVIDE_ABOVE_SHARE: f64 = 1.5;
/// It becomes one with the next when it would be shorter than this.
pub(super) const JOIN_BELOW_SHARE: f64 = 0.5;

/// An error of a rod for the user, who sees its name elsewhere.
pub(super) fn to_class_error(error: RodError) -> ClassError {
    // what a winch does to a line within a step it may do in two
    let lasting = matches!(error, RodError::Property { .. } | RodError::TooLarge { .. } | RodError::Interrupted { .. });
    let made = ClassError::new(match error {
        RodError::Property { segment, what, value, expected, .. } => {
            format!("in segment {segment} {what} is {value}; {expected}")
        }
        RodError::TooLarge { elements, megabytes, most, .. } => {
            format!("{elements} elements would take about {megabytes:.0} MB; at most {most} are allowed")
        }
        RodError::Shape { why, .. } => why,
        RodError::Step { time, step, element, why, .. } => {
            format!(
                "its rod has no solution at {time} s by steps down to {step:.1e} s; worst at element {element}: {why}"
            )
        }
        RodError::Interrupted { .. } => "interrupted".to_string(),
        RodError::Statics { element, residual, .. } if !residual.is_finite() => {
            format!("no static equilibrium of the dynamic line: the force at element {element} is not finite")
        }
        RodError::Statics { iterations, residual, element, .. } => {
            let text = format!(
                "no static equilibrium of the dynamic line in {iterations} iterations: {{}} is left at element {element}"
            );
            return ClassError::with_values(text, &[(residual, Dim::Force)]);
        }
    });
    ClassError { lasting, ..made }
}

/// Elements of a part as it is wound to a length (m) other than that of its class.
fn count_wound_elements(part: &LinePart, length: f64) -> f64 {
    (length / part.segment.length * part.segment.elements as f64).round().max(1.0)
}

/// Refuses more elements than a rod may have before any of them takes memory: those of the class, and those of a first part with a
/// length (m).
pub(super) fn check_element_count(parts: &[LinePart], first: f64) -> Result<(), ClassError> {
    let own = |part: &LinePart| part.segment.elements as f64;
    let whole: f64 = parts.iter().map(own).sum();
    let longer = parts.first().map_or(0.0, |part| count_wound_elements(part, first) - own(part));
    let most = whole.max(whole + longer);
    if most <= rod::MAX_ELEMENTS as f64 {
        return Ok(());
    }
    Err(to_class_error(RodError::TooLarge {
        rod: String::new(),
        elements: most as usize,
        megabytes: most * rod::BYTES_PER_ELEMENT / 1e6,
        most: rod::MAX_ELEMENTS,
    }))
}

/// Segments of a line: one a part, or one an element of the class where properties change along a part.
pub(super) struct Cut {
    pub segments: Vec<RodSegment>,
    pub bands: Bands,
}

impl Cut {
    /// As the class says; with growth along the line, which is at `shape` when it is made, by element. The parts have these lengths (m)
    /// as they are wound.
    pub fn new(parts: &[LinePart], lengths: &[f64], ambient: Option<&dyn Ambient>, shape: &[Vector3<f64>]) -> Cut {
        let mut made = Cut { segments: Vec::new(), bands: Bands::default() };
        let whole: f64 = lengths.iter().sum();
        let mut behind = whole;
        for (index, (part, now)) in parts.iter().zip(lengths).enumerate() {
            behind -= now;
            let count = if shape.is_empty() { 1 } else { part.segment.elements.max(1) };
            let long = part.segment.length;
            made.bands.each.push(EqualLengths { from: made.segments.len(), count, long });
            for band in 0..count {
                let back = behind + long * (1.0 - (band as f64 + 0.5) / count as f64);
                let segment = part.with_growth(ambient, elevation(shape, (1.0 - back / whole).max(0.0)));
                let (length, elements) = (long / count as f64, part.segment.elements / count);
                made.segments.push(RodSegment { length, elements, ..segment });
                made.bands.part.push(index);
            }
        }
        made
    }
}

/// Equal lengths of a part, each a segment of the rod.
#[derive(Clone, Copy, Debug)]
struct EqualLengths {
    /// First of the segments.
    from: usize,
    count: usize,
    /// Length of the part as the class has it (m).
    long: f64,
}

/// The segments of each part. How many there are is up to the environment; a mesh is one of parts, the same in all of them.
#[derive(Clone, Debug, Default)]
pub(super) struct Bands {
    each: Vec<EqualLengths>,
    /// Part of each segment.
    part: Vec<usize>,
}

impl Bands {
    /// The part of a segment of the rod that was cut with these.
    pub fn part_of(&self, segment: usize) -> usize {
        self.part[segment]
    }

    /// Whether a part has several segments.
    pub fn several(&self) -> bool {
        self.part.len() > self.each.len()
    }

    /// Gives the elements of a mesh of parts their segments, by what of the part lies behind the middle of each: what is wound at the
    /// first end leaves the others where they are.
    pub fn lay(&self, mesh: &mut [(f64, f64, usize)]) {
        let (mut part, mut behind) = (usize::MAX, 0.0);
        for (rest, _, position) in mesh.iter_mut().rev() {
            if *position != part {
                (part, behind) = (*position, 0.0);
            }
            let Some(EqualLengths { from, count, long }) = self.each.get(part) else { continue };
            let back = ((behind + 0.5 * *rest) / long * *count as f64) as usize;
            *position = from + count.saturating_sub(1 + back);
            behind += *rest;
        }
    }
}

/// The mesh of a line whose first part has a length (m): unstretched length, rate and part of each element.
pub(super) fn mesh(parts: &[LinePart], first: f64) -> Vec<(f64, f64, usize)> {
    let mut made = Vec::new();
    for (index, part) in parts.iter().enumerate() {
        let (mut length, mut count) = (part.segment.length, part.segment.elements);
        if index == 0 && first != length {
            count = count_wound_elements(part, first) as usize;
            length = first;
        }
        made.extend((0..count).map(|_| (length / count as f64, 0.0, index)));
    }
    made
}

/// Elevation (m) at a share of the length of a row of points.
fn elevation(shape: &[Vector3<f64>], share: f64) -> f64 {
    let long: f64 = shape.windows(2).map(|p| (p[1] - p[0]).norm()).sum();
    let mut left = share * long;
    for pair in shape.windows(2) {
        let piece = (pair[1] - pair[0]).norm();
        if left <= piece && piece > 0.0 {
            return pair[0].z + (pair[1].z - pair[0].z) * left / piece;
        }
        left -= piece;
    }
    shape.last().map_or(0.0, |p| p.z)
}

/// Water that what displaces nothing is taken to displace, as a share of its added mass, so that a coefficient on it makes that: it
/// lifts by as small a share of the weight of the added mass.
const MIN_DISPLACED_SHARE: f64 = 1e-9;
/// Height over which what has neither volume nor drag nor added mass meets the surface (m): nothing asks for it.
const NO_HEIGHT: f64 = 1.0;
/// Drag coefficient of a sphere below the critical Reynolds number [DNV-RP-C205 appendix E].
const SPHERE_CD: f64 = 0.5;
/// Added mass of a sphere as a share of what it displaces (Lamb, Hydrodynamics, section 92).
const SPHERE_CA: f64 = 0.5;

/// Height over which a joint meets the surface (m): that of a sphere that displaces as much; of what is said to displace nothing that of
/// the larger of two spheres, with its drag and with its added mass.
fn height(joint: &JointMass, density: f64) -> f64 {
    let of_volume = |volume: f64| (6.0 * volume / PI).cbrt();
    if joint.volume > 0.0 {
        return of_volume(joint.volume);
    }
    let by_drag = (4.0 * joint.drag / (PI * SPHERE_CD)).sqrt();
    let by_added = if density > 0.0 { of_volume(joint.added / (SPHERE_CA * density)) } else { 0.0 };
    let most = by_drag.max(by_added);
    if most > 0.0 { most } else { NO_HEIGHT }
}

/// What is attached at the ends of parts, on a mesh.
pub(super) fn attachments(parts: &[LinePart], counts: &[usize], density: f64) -> Vec<Attachment> {
    let mut node = 0;
    let mut made = Vec::new();
    for (part, count) in parts.iter().zip(counts) {
        node += count;
        let Some(joint) = part.joint else { continue };
        let (volume, added) = if joint.volume > 0.0 || density <= 0.0 {
            (joint.volume, joint.added)
        } else {
            (MIN_DISPLACED_SHARE * joint.added / density, 1.0 / MIN_DISPLACED_SHARE)
        };
        let height = height(&joint, density);
        // it presses itself in as deep as the line beside it, by whatever mesh
        let beside = part.submerged_weight(density, 1.0).max(BUOYANT_LINE_WEIGHT_SHARE * part.segment.mass)
            / part.segment.contact_diameter;
        let bearing = (joint.mass - density * joint.volume).max(0.0) / beside;
        made.push(Attachment {
            node,
            mass: joint.mass,
            volume,
            height,
            pendant: joint.pendant,
            drag: joint.drag,
            added,
            bearing: if bearing.is_finite() { bearing } else { 0.0 },
        });
    }
    made
}

/// Takes the first part of a line to another length (m) over a step (s): elements appear at its first end or go. Of a change by more than
/// [`max_payout_step`] the element there stays longer than it should. Whether anything changed.
pub(super) fn wind(
    rod: &mut Rod,
    state: &mut RodState,
    (first, nominal, dt): (f64, f64, f64),
    bands: &Bands,
) -> Result<bool, ClassError> {
    let own = rod.each_of_mesh().take_while(|e| bands.part_of(e.2) == 0);
    let (count, now) = own.fold((0, 0.0), |(count, sum), e| (count + 1, sum + e.0));
    let change = first - now;
    let Some((mut rest, rate, _)) = rod.each_of_mesh().next() else { return Ok(false) };
    if change.abs() <= 1e-12 * now {
        if rate != 0.0 {
            rod.set_length(0, rest, 0.0).map_err(to_class_error)?;
        }
        return Ok(rate != 0.0);
    }
    if change > 0.0 && rest + change > DIVIDE_ABOVE_SHARE * nominal {
        rod.divide(0, state).map_err(to_class_error)?;
        rest *= 0.5;
    }
    if change < 0.0 && rest + change < JOIN_BELOW_SHARE * nominal && count > 1 {
        let next = rod.each_of_mesh().nth(1).map_or(0.0, |e| e.0);
        rod.join(0, state).map_err(to_class_error)?;
        rest += next;
    }
    rod.set_length(0, rest + change, change / dt).map_err(to_class_error)?;
    if bands.several() {
        // what is wound may lie in another band than it did
        let mut mesh: Vec<_> = rod.each_of_mesh().map(|(rest, rate, at)| (rest, rate, bands.part_of(at))).collect();
        bands.lay(&mut mesh);
        if !rod.each_of_mesh().eq(mesh.iter().copied()) {
            let attached = rod.attachments().to_vec();
            *rod = Rod::with_mesh(rod.name(), rod.segments().to_vec(), attached, &mesh).map_err(to_class_error)?;
        }
    }
    Ok(true)
}

/// The most by which a winch may change a line in one step (m): an element at the winch is divided or taken in once, and is then as long as
/// [`DIVIDE_ABOVE_SHARE`] and [`JOIN_BELOW_SHARE`] say.
pub(super) fn max_payout_step(nominal: f64) -> f64 {
    JOIN_BELOW_SHARE * nominal
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clump_enters_surface_over_sphere_height_with_drag_or_added_mass() {
        let joint = JointMass { mass: 5000.0, ..JointMass::default() };
        // a sphere of 2 m: volume 4/3 pi, drag area pi/2 at 0.5, added mass of half of what it displaces
        let volume = 4.0 / 3.0 * PI;
        for sphere in [
            JointMass { volume, ..joint },
            JointMass { drag: 0.5 * PI, ..joint },
            JointMass { added: 0.5 * 1025.0 * volume, drag: 0.1, ..joint },
        ] {
            assert!((height(&sphere, 1025.0) - 2.0).abs() < 1e-12, "{sphere:?}");
        }
        assert_eq!(height(&joint, 1025.0), NO_HEIGHT);
    }

    #[test]
    fn only_errors_beyond_smaller_steps_are_lasting() {
        let rod = || "R".to_string();
        let step = RodError::Step { rod: rod(), time: 1.0, step: 0.1, element: 1, why: String::new() };
        let large = RodError::TooLarge { rod: rod(), elements: 1, megabytes: 1.0, most: 1 };
        assert!(!to_class_error(step).lasting && to_class_error(large).lasting);
        assert!(!to_class_error(RodError::Shape { rod: rod(), why: String::new() }).lasting);
    }
}
