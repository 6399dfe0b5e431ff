//! What a run found along a line that moves by itself, as tables by node and over time.
//!
//! Nodes are numbered from 1 at the first end, as many as were ever there and are kept: -ALONG of TDOM keeps fewer, and a winch makes new
//! ones behind the first end.

mod at_rest;
mod check;
mod envelope;
mod fatigue;
mod modes;
mod shape;
mod touchdown;

pub use at_rest::lines_at_rest;
pub(in crate::solve) use at_rest::standing;
pub use check::{Code, check};
pub use envelope::envelope;
pub use fatigue::along as fatigue_along;
pub use modes::natural_modes;
pub use shape::{Where, histories, shape};
pub use touchdown::touchdown;

use super::super::system::SolveError;
use super::super::time::{AlongColumns, NodeRow, Quantity, Run};
use super::Event;
use crate::model::{ClassError, FatigueSegment, Model};
use crate::post::line::{Tube, inside_pressure};
use crate::table::Digits;
use std::ops::RangeInclusive;

/// Digits of the height over the bottom, into which a line that lies presses itself by millimetres.
pub(super) const CLEARANCE: Digits = Digits::Decimals(3);

/// A segment of the line.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::solve) struct Section {
    /// What fatigue and break go by.
    pub segment: FatigueSegment,
    /// Its tube, where it has a wall.
    pub tube: Option<Tube>,
}

impl Section {
    /// Tension in the wall of its tube (N) at a node where these meet, with pressures outside and inside (Pa); of another section the
    /// effective tension itself.
    pub(super) fn wall(&self, node: &NodeRow, meeting: &[Section], [outside, inside]: [f64; 2]) -> f64 {
        match (&self.tube, node.bent, meeting) {
            (Some(_), Some(bent), [_]) => bent.wall,
            (Some(tube), Some(_), _) => {
                let [outer, bore] = tube.areas();
                node.effective - outside * outer + inside * bore
            }
            _ => node.effective,
        }
    }

    /// The share of the yield stress that its tube uses, or tension over break of another section.
    pub(in crate::solve) fn used(&self, tension: f64, yields: Option<f64>) -> f64 {
        match (&self.tube, yields) {
            (Some(_), Some(share)) => share,
            _ => (tension / self.segment.breaking).max(0.0),
        }
    }
}

/// The most that sections which meet at a node use; none without sections.
pub(in crate::solve) fn most_used(sections: &[Section], tension: f64, yields: Option<f64>) -> Option<f64> {
    sections.iter().map(|s| s.used(tension, yields)).reduce(f64::max)
}

/// The segments of the class of a connector, from its first end.
pub(in crate::solve) fn sections(model: &Model, name: &str) -> Vec<Section> {
    let connector = model.connectors.get(&Model::key(name));
    let Some(class) = connector.and_then(|c| model.classes.get(&Model::key(&c.class))) else { return Vec::new() };
    // a bar that does not bend is a chain or rope
    let walled = class.records.iter().map(|record| record.args.option_number("-EI") != Some(0.0));
    let made = class.fatigue_segments().into_iter().zip(class.wall_materials()).zip(walled);
    let of = |((segment, material), bends): ((FatigueSegment, crate::model::WallMaterial), bool)| {
        let tube = segment.thickness.filter(|wall| bends || 2.0 * wall < segment.od).map(|wall| Tube {
            diameter: segment.od,
            wall,
            yield_stress: material.yield_stress,
            tensile: material.tensile,
            modulus: material.modulus,
            poisson: material.poisson,
        });
        Section { segment, tube }
    };
    made.map(of).collect()
}

/// The numbers of the segments (from 0) that a place is in, by its unstretched distance from the second end (m): where two meet both,
/// that toward the second end last. The first segment is as long as a winch has made it.
pub(in crate::solve) fn segments_at(sections: &[Section], from_second: f64) -> RangeInclusive<usize> {
    // a length added up of those of elements has their rounding
    let within = |slack: f64| {
        let mut left = from_second;
        for (index, section) in sections.iter().enumerate().skip(1).rev() {
            left -= section.segment.length;
            if left <= slack * section.segment.length {
                return index;
            }
        }
        0
    };
    within(-1e-6)..=within(1e-6)
}

/// A line of a run.
#[derive(Debug)]
pub struct Line<'a> {
    run: &'a Run,
    /// Its name as written.
    pub name: &'a str,
    link: usize,
    columns: &'a AlongColumns,
    sections: Vec<Section>,
    /// Places of the nodes that were ever there, among those that are kept.
    places: Vec<usize>,
}

impl<'a> Line<'a> {
    /// The line of a name.
    ///
    /// # Errors
    /// No such connector in the run, one that tells of no nodes, or whose nodes the run did not keep.
    pub fn of(run: &'a Run, name: &str) -> Result<Self, ClassError> {
        let layout = &run.history.layout;
        let kept = || layout.links.iter().filter(|l| l.along.is_some()).map(|l| l.name.as_str());
        let Some((link, found)) = layout.links.iter().enumerate().find(|(_, l)| l.name.eq_ignore_ascii_case(name))
        else {
            return Err(ClassError::new(format!("{name} is no connector of the run")));
        };
        let Some(columns) = &found.along else {
            let names: Vec<&str> = kept().collect();
            let help = match (run.settings.along, names.as_slice()) {
                (0, _) => "the run kept none: TDOM -ALONG 1 keeps all".to_string(),
                (_, []) => "a ROD does, and a line of &CONNECTOR -DYNAMICS".to_string(),
                (_, some) => format!("of the run these do: {}", some.join(" ")),
            };
            return Err(ClassError::new(format!("{name} tells of no nodes along itself")).help(help));
        };
        let there = |place: &usize| match run.history.is_empty() {
            true => run.envelopes.get(link).is_some_and(|e| e.seen(*place, Quantity::Arc).is_some()),
            false => run.history.rows().any(|row| columns.node(*place, row).is_some()),
        };
        let places: Vec<usize> = (0..columns.numbers.len()).filter(there).collect();
        if places.is_empty() {
            return Err(ClassError::new(format!("{name} did not act at any stored instant")));
        }
        let sections = sections(&run.model, &found.name);
        Ok(Line { run, name: &found.name, link, columns, sections, places })
    }

    /// How many nodes it has.
    pub fn nodes(&self) -> usize {
        self.places.len()
    }

    /// Numbers of the nodes with their places.
    fn numbered(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.places.iter().enumerate().map(|(index, place)| (index + 1, *place))
    }

    /// The row of an event: between two stored ones on the straight line.
    fn row(&self, event: &Event, row: &mut Vec<f64>) {
        let history = &self.run.history;
        let width = history.layout.width.max(1);
        let stored = |at: usize| history.values.get(at * width..(at + 1) * width).unwrap_or_default();
        row.clear();
        row.extend_from_slice(stored(event.row));
        if event.share > 0.0 {
            for (value, next) in row.iter_mut().zip(stored(event.row + 1)) {
                *value += event.share * (next - *value);
            }
        }
    }

    /// Unstretched length in a row (m).
    fn length(&self, row: &[f64]) -> f64 {
        let last = self.columns.numbers.len().saturating_sub(1);
        self.columns.node(last, row).map_or(f64::NAN, |n| n.arc)
    }

    /// The numbers of the sections of a node in a row, from 0: of a junction both, that toward the second end last.
    fn numbers_at(&self, node: &NodeRow, row: &[f64]) -> RangeInclusive<usize> {
        segments_at(&self.sections, self.length(row) - node.arc)
    }

    /// The sections of a node in a row.
    fn sections_at(&self, node: &NodeRow, row: &[f64]) -> &[Section] {
        self.sections.get(self.numbers_at(node, row)).unwrap_or_default()
    }

    /// Pressures outside and inside (Pa) at a node, of whose sections the last with a tube is the one whose wall it tells. Outside is that
    /// of water at rest.
    fn pressures(&self, node: &NodeRow, meeting: &[Section]) -> [f64; 2] {
        let around = self.run.model.surroundings();
        let [.., z] = node.position;
        let outside = around.water_weight() * (around.tide - z).max(0.0);
        let tube = meeting.iter().rev().find_map(|s| s.tube.as_ref());
        let inside = tube.zip(node.bent).and_then(|(t, bent)| inside_pressure(t, (node.effective, bent.wall), outside));
        [outside, inside.unwrap_or(0.0)]
    }

    fn wrong(&self, text: impl Into<String>) -> SolveError {
        SolveError { who: Some(self.name.to_string()), error: ClassError::new(text) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_in_the_segment_that_its_distance_from_the_second_end_says() {
        let segment = |length: f64| Section {
            segment: FatigueSegment { curve: None, breaking: 1.0, od: 0.1, thickness: None, length },
            tube: None,
        };
        let all = [100.0, 50.0, 20.0].map(segment);
        let mut weaker = segment(1.0);
        weaker.segment.breaking = 0.1;
        // the last node, one in the last, where two meet, in the first, beyond what the class says of it
        for (from_second, want) in [
            (0.0, 2..=2),
            (10.0, 2..=2),
            (20.0, 1..=2),
            (20.0 + 1e-9, 1..=2),
            (20.5, 1..=1),
            (70.0, 0..=1),
            (71.0, 0..=0),
            (500.0, 0..=0),
        ] {
            assert_eq!(segments_at(&all, from_second), want, "{from_second}");
        }
        assert_eq!(segments_at(&[], 3.0), 0..=0);
        assert_eq!(most_used(&[], 1.0, None), None);
        assert_eq!(most_used(&[all[0].clone(), weaker], 0.5, None), Some(5.0));
        assert_eq!(all[0].used(-5.0, None), 0.0);
    }
}
