//! What a line is made of, and what is refused.

use super::element::LinePiece;
use super::end_forces::{EndForces, FlatBottom};
use super::error::LineError;
use super::multi_segment::{JointPull, MultiSegmentLine};
use super::profile::{SeabedProfile, Tilt};
use super::stretch_law::StretchLaw;

/// A piece of line with the same properties all along.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Unstretched length (m).
    pub length: f64,
    /// Submerged weight per unstretched length (N/m); negative when buoyant.
    pub weight: f64,
    /// Axial stiffness (N).
    pub ea: f64,
}

/// What acts where a segment ends and the next begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Joint {
    /// Nothing.
    Free,
    /// A submerged weight (N); negative is a lift that does not know the surface.
    Weight(f64),
    /// A buoy on a pendant: it keeps the joint from sinking below `depth` until its capacity is used up.
    SpringBuoy {
        /// Largest pull (N).
        capacity: f64,
        /// Depth of the held joint below the water surface (m): the length of the pendant.
        depth: f64,
    },
    /// A buoy fixed to the line: under water it lifts, above it weighs.
    Buoy {
        /// Displaced water less its weight (N).
        lift: f64,
        /// Weight in air (N).
        weight: f64,
    },
}

/// The sea bottom under a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeabedModel {
    /// Elevation under the anchor (m).
    pub elevation: f64,
    /// Vertical over horizontal distance, positive when it rises from the anchor toward the fairlead
    /// [MOSES-FLEX -SLOPE].
    pub slope: f64,
    /// Friction coefficient, zero or more.
    pub friction: f64,
}

/// A line from a fairlead to an anchor on the bottom.
#[derive(Clone, Debug)]
pub struct Line {
    pub(super) segments: Vec<Segment>,
    pub(super) laws: Vec<Option<StretchLaw>>,
    pub(super) springs: [Option<StretchLaw>; 2],
    pub(super) joints: Vec<Joint>,
    pub(super) anchor: f64,
    pub(super) surface: f64,
    pub(super) floor: Option<SeabedModel>,
    pub(super) profile: SeabedProfile,
    pub(super) chain: MultiSegmentLine,
    /// Its segment and bottom, when both are so plain that its forces need no more: see [`Line::solve_forces`].
    pub(super) lone_segment: Option<(Segment, Option<FlatBottom>)>,
}

/// Lengths (m) and forces (N) from which on the squares that are formed of them have no room in a double.
pub(super) const MAX_MAGNITUDE: f64 = 1e140;

/// Segments up to which all contacts of a line are found at once; more are laid down one after the other.
const MAX_JOINT_SEGMENTS: usize = 30;

impl Segment {
    /// The forces when the fairlead lies `x` >= 0 beside and `z` above the anchor (m); with a `bottom` at the anchor's
    /// elevation, or with none anywhere.
    ///
    /// # Errors
    /// [`LineError`]; forces that are returned have been proven.
    pub fn solve_end_forces(&self, x: f64, z: f64, bottom: Option<FlatBottom>) -> Result<EndForces, LineError> {
        super::end_forces_cold::solve_end_forces(self, x, z, bottom)
    }

    /// The same as [`Segment::solve_end_forces`], sooner: for a fairlead that has moved a little since `last`. What `last` holds
    /// decides how long the search takes, and the answer only within the proof.
    ///
    /// # Errors
    /// Those of [`Segment::solve_end_forces`].
    pub fn solve_warm_start(
        &self,
        x: f64,
        z: f64,
        bottom: Option<FlatBottom>,
        last: &EndForces,
    ) -> Result<EndForces, LineError> {
        super::end_forces_warm::solve_warm_start(self, x, z, bottom, last)
    }

    /// The same segment upside down: a buoyant one for a heavy one.
    pub(super) fn upside_down(&self) -> Segment {
        Segment { weight: -self.weight, ..*self }
    }

    /// Refuses values that no segment can have; `number` is the segment's, from 1.
    pub(super) fn check(&self, number: usize) -> Result<(), LineError> {
        for (what, value, good) in [
            ("the length", self.length, self.length > 0.0 && self.length < MAX_MAGNITUDE),
            ("the axial stiffness", self.ea, self.ea > 0.0 && self.ea < MAX_MAGNITUDE),
            ("the weight", self.weight, (self.weight * self.length).abs() < MAX_MAGNITUDE),
        ] {
            if !(good && value.is_finite()) {
                return Err(LineError::Value { what, segment: number, value });
            }
        }
        Ok(())
    }
}

impl Line {
    /// A line from its fairlead to its anchor.
    ///
    /// `anchor` is the elevation of the anchor and of the flat, frictionless bottom (m, usually negative), `surface`
    /// that of the water surface (m, the tide).
    ///
    /// # Errors
    /// No segments, a number of joints other than one fewer than segments, values that are not finite, a length or
    /// stiffness that is not positive.
    pub fn new(segments: Vec<Segment>, joints: Vec<Joint>, anchor: f64, surface: f64) -> Result<Line, LineError> {
        if segments.is_empty() {
            return Err(LineError::Empty);
        }
        if joints.len() + 1 != segments.len() {
            return Err(LineError::Joints { segments: segments.len(), joints: joints.len() });
        }
        for (index, s) in segments.iter().enumerate() {
            s.check(index + 1)?;
        }
        for (index, joint) in joints.iter().enumerate() {
            let bad = match joint {
                Joint::Free => None,
                Joint::Weight(w) => (!w.is_finite()).then_some(("the clump weight", *w)),
                Joint::SpringBuoy { capacity, depth } => [("the buoy capacity", *capacity), ("the pendant", *depth)]
                    .into_iter()
                    .find(|(_, v)| !(v.is_finite() && *v >= 0.0)),
                Joint::Buoy { lift, weight } => [("the buoy's lift", *lift), ("the buoy's weight", *weight)]
                    .into_iter()
                    .find(|(_, v)| !(v.is_finite() && *v >= 0.0)),
            };
            if let Some((what, value)) = bad {
                return Err(LineError::Value { what, segment: index + 1, value });
            }
        }
        for (what, value) in [("the anchor elevation", anchor), ("the water level", surface)] {
            if !value.is_finite() {
                return Err(LineError::Value { what, segment: segments.len(), value });
            }
        }
        let floor = SeabedModel { elevation: anchor, slope: 0.0, friction: 0.0 };
        let laws = vec![None; segments.len()];
        let chain = MultiSegmentLine { elements: Vec::new(), pulls: Vec::new(), least: 0.0 };
        let springs = [None, None];
        let profile = SeabedProfile::plane(anchor, 0.0);
        let floor = Some(floor);
        Line { segments, laws, springs, joints, anchor, surface, floor, profile, chain, lone_segment: None }.assemble()
    }

    /// The line over another bottom, or over none.
    ///
    /// # Errors
    /// Values that are not finite, negative friction, an anchor below the bottom, a pendant longer than the depth.
    pub fn with_seabed(self, floor: Option<SeabedModel>) -> Result<Line, LineError> {
        let profile =
            floor.map_or(SeabedProfile::plane(self.anchor, 0.0), |f| SeabedProfile::plane(f.elevation, f.slope));
        let line = self.with_profile(floor, profile)?;
        line.check_pendants()?;
        Ok(line)
    }

    fn with_profile(self, floor: Option<SeabedModel>, profile: SeabedProfile) -> Result<Line, LineError> {
        if let Some(SeabedModel { elevation, slope, friction }) = floor {
            for (what, value, good) in [
                ("the bottom's elevation", elevation, true),
                ("the bottom's slope", slope, true),
                ("the friction coefficient", friction, friction >= 0.0),
            ] {
                if !(good && value.is_finite()) {
                    return Err(LineError::Value { what, segment: self.segments.len(), value });
                }
            }
            if self.anchor < elevation {
                return Err(LineError::AnchorBelow(elevation - self.anchor));
            }
        }
        Line { floor, profile, ..self }.assemble()
    }

    /// The line over a bottom of plane faces: `places` are distances from the anchor toward the fairlead and elevations
    /// there (m), the distances growing from 0. Beyond the last one its face goes on.
    ///
    /// # Errors
    /// Fewer than two places, distances that do not grow from 0, values that are not finite, negative friction, an anchor
    /// below the bottom.
    pub fn over_profile(self, positions: &[(f64, f64)], friction: f64) -> Result<Line, LineError> {
        let number = self.segments.len();
        let refused = |what, value| LineError::Value { what, segment: number, value };
        let (Some(&(from, elevation)), Some(&(last, _))) = (positions.first(), positions.get(1)) else {
            return Err(refused("the number of places of the bottom", positions.len() as f64));
        };
        for (at, z) in positions {
            if !z.is_finite() || !at.is_finite() || z.abs().max(at.abs()) >= MAX_MAGNITUDE {
                return Err(refused("a place of the bottom", if z.is_finite() { *at } else { *z }));
            }
        }
        if from != 0.0 || positions.iter().zip(positions.iter().skip(1)).any(|(a, b)| b.0 <= a.0) {
            return Err(refused("a distance along the bottom", last));
        }
        let profile = SeabedProfile::new(positions);
        let floor = SeabedModel { elevation, slope: profile.tilt(0).slope(), friction };
        self.with_profile(Some(floor), profile)
    }

    /// The elevation of the bottom at a distance from the anchor toward the fairlead (m), if there is one.
    pub fn bottom_at(&self, distance: f64) -> Option<f64> {
        self.floor.map(|_| self.profile.elevation(distance))
    }

    /// The line with springs in series at the fairlead and at the anchor, stretching along the tension there
    /// [MOSES-FLEX -SEND, -X_PY]; `None` is rigid.
    ///
    /// # Errors
    /// A spring that does not stretch with its tension.
    pub fn with_springs(self, springs: [Option<StretchLaw>; 2]) -> Result<Line, LineError> {
        if springs.iter().flatten().any(|law| !law.grows()) {
            return Err(LineError::StretchLaw(1));
        }
        Line { springs, ..self }.assemble()
    }

    /// The line with stretch laws in place of the stiffness of its segments, one a segment.
    ///
    /// # Errors
    /// A law whose tension does not grow with the strain; another number of laws than segments.
    pub fn with_laws(self, laws: Vec<Option<StretchLaw>>) -> Result<Line, LineError> {
        if laws.len() != self.segments.len() {
            return Err(LineError::Joints { segments: self.segments.len(), joints: laws.len() });
        }
        if let Some(bad) = laws.iter().position(|l| l.as_ref().is_some_and(|l| !l.grows())) {
            return Err(LineError::StretchLaw(bad + 1));
        }
        Line { laws, ..self }.assemble()
    }

    /// The line with another length of its first segment (m).
    ///
    /// # Errors
    /// A length that is not positive.
    pub fn with_first_length(mut self, length: f64) -> Result<Line, LineError> {
        if let Some(first) = self.segments.first_mut() {
            first.length = length;
            first.check(1)?;
        }
        self.assemble()
    }

    /// The line with its weights and its axial stiffnesses times factors; `None` when a segment stretches by a law of its
    /// own and the stiffness is asked for.
    ///
    /// # Errors
    /// Factors that make no line.
    pub fn with_factors(mut self, weight: f64, stiffness: f64) -> Option<Result<Line, LineError>> {
        if stiffness != 1.0 && self.laws.iter().any(Option::is_some) {
            return None;
        }
        for (index, segment) in self.segments.iter_mut().enumerate() {
            segment.weight *= weight;
            segment.ea *= stiffness;
            if let Err(error) = segment.check(index + 1) {
                return Some(Err(error));
            }
        }
        Some(self.assemble())
    }

    /// Elevation of the anchor (m).
    pub fn anchor(&self) -> f64 {
        self.anchor
    }

    /// The bottom, if there is one.
    pub fn floor(&self) -> Option<SeabedModel> {
        self.floor
    }

    /// Whether its bottom is flat.
    pub(super) fn is_flat(&self) -> bool {
        self.profile.faces() == 1 && self.profile.tilt(0) == Tilt::FLAT
    }

    /// Whether its bottom is flat and smooth, and its parts so few that they are best solved all at once.
    pub(super) fn is_plain(&self) -> bool {
        self.is_flat() && self.floor.is_none_or(|f| f.friction == 0.0) && self.segments.len() <= MAX_JOINT_SEGMENTS
    }

    /// Elevation from which heights above the bottom are counted (m).
    pub(super) fn datum(&self) -> f64 {
        self.floor.map_or(self.anchor, |f| f.elevation)
    }

    /// The first joint's number in the chain: one further when a spring is before it.
    pub(super) fn first_joint(&self) -> usize {
        usize::from(self.springs[0].is_some())
    }

    /// Refuses pendants that would hold their joint below a flat bottom. Over any other the joint may be elsewhere.
    pub(super) fn check_pendants(&self) -> Result<(), LineError> {
        let depth = self.surface - self.datum();
        let pulls = self.chain.pulls.iter().skip(self.first_joint());
        for (index, (joint, pull)) in self.joints.iter().zip(pulls).enumerate() {
            let Joint::SpringBuoy { depth: pendant, .. } = joint else { continue };
            if *pendant > depth && pull.on_bottom && self.is_flat() {
                return Err(LineError::Pendant { segment: index + 1, by: pendant - depth });
            }
        }
        Ok(())
    }

    /// Makes the chain that is solved.
    fn assemble(mut self) -> Result<Line, LineError> {
        // grounding between the fairlead and a spring buoy at the end of the first segment is not considered
        // [MOSES-FLEX -CLUMP]
        let blind = matches!(self.joints.first(), Some(Joint::SpringBuoy { .. }));
        let sees = |index: usize| self.floor.is_some() && !(blind && index == 0);
        let surface = self.surface - self.datum();
        let [first, last] = self.springs.clone();
        let mut elements: Vec<LinePiece> = first.map(LinePiece::Link).into_iter().collect();
        let mut pulls: Vec<JointPull> =
            elements.iter().map(|_| JointPull { on_bottom: sees(0), ..JointPull::default() }).collect();
        for (index, (segment, law)) in self.segments.iter().zip(&self.laws).enumerate() {
            elements.push(LinePiece::Length { segment: *segment, law: law.clone(), sees_bottom: sees(index) });
            let Some(joint) = self.joints.get(index) else { continue };
            let on_bottom = sees(index) || sees(index + 1);
            let (lift, steps) = match joint {
                Joint::Free => (0.0, Vec::new()),
                Joint::Weight(w) => (-w, Vec::new()),
                Joint::SpringBuoy { capacity, depth } => {
                    let held = surface - depth;
                    (*capacity, if *capacity > 0.0 { vec![(held, *capacity)] } else { Vec::new() })
                }
                Joint::Buoy { lift, weight } => (*lift, vec![(surface, lift + weight)]),
            };
            pulls.push(JointPull { lift, steps, on_bottom });
        }
        if let Some(law) = last {
            elements.push(LinePiece::Link(law));
            pulls.push(JointPull { on_bottom: sees(self.segments.len()), ..JointPull::default() });
        }
        let weight: f64 =
            elements.iter().map(|e| e.weight().abs()).sum::<f64>() + pulls.iter().map(|p| p.lift.abs()).sum::<f64>();
        let stiffest = self.segments.iter().fold(f64::INFINITY, |m, s| s.ea.min(m));
        let least = if weight > 0.0 { 1e-11 * weight } else { 1e-11 * stiffest };
        self.chain = MultiSegmentLine { elements, pulls, least };
        self.lone_segment = self.find_lone_segment();
        Ok(self)
    }

    /// Its segment and bottom, when it has one segment alone that stretches by its stiffness, no springs at its ends, and no bottom or a
    /// flat one at the anchor.
    fn find_lone_segment(&self) -> Option<(Segment, Option<FlatBottom>)> {
        let [segment] = self.segments[..] else { return None };
        let plain = self.laws.iter().chain(&self.springs).all(Option::is_none);
        let flat = self.floor.is_none_or(|f| f.elevation == self.anchor && self.is_flat());
        (plain && flat).then(|| (segment, self.floor.map(|f| FlatBottom { friction: f.friction })))
    }

    /// The segments, fairlead first.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// Unstretched length (m).
    pub fn length(&self) -> f64 {
        self.segments.iter().map(|s| s.length).sum()
    }
}
