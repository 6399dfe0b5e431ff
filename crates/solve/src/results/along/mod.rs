//! What a run found along a dynamic line, as tables by node and over time.
//!
//! Nodes are numbered from 1 at the first end, as many as were ever there and are kept: -ALONG of TDOM keeps fewer, and a winch makes new
//! ones behind the first end.

mod at_rest;
mod check;
mod envelope;
mod fatigue;
mod line_loads;
mod modes;
mod shape;
mod summary;
mod supports;
mod touchdown;

pub(crate) use at_rest::visit_lines_at_rest;
pub use at_rest::{lines_at_rest, static_cautions};
pub use check::{Code, check};
pub use envelope::envelope;
pub use fatigue::fatigue_table as fatigue_along;
pub(crate) use line_loads::{dynamic_path, line_loads as dynamic_line_loads};
pub use modes::natural_modes;
pub use shape::{LinePosition, histories, shape};
pub use summary::{LineExtreme, RunSummary};
pub use supports::supports;
pub use touchdown::touchdown;

use super::super::system::SolveError;
use super::super::time::{AlongColumns, NodeQuantity, NodeRow, Run};
use super::RunEvent;
use std::f64::consts::PI;
use windlass_base::message::Message;
use windlass_base::table::Digits;
use windlass_model::{AssemblyKind, ClassError, FatigueSegment, Model, WallMaterial, line_name};
use windlass_signal::line::CheckedTube;

/// Digits of the height over the bottom, into which a line that lies presses itself by millimetres.
pub(super) const CLEARANCE: Digits = Digits::Decimals(3);

/// A segment of the line.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ResultSection {
    /// What fatigue and break go by.
    pub segment: FatigueSegment,
    /// Its tube, where it has a wall.
    pub tube: Option<CheckedTube>,
    /// Bending stiffness (N m2): that of `-EI`, else of the section.
    pub bending_stiffness: f64,
}

impl ResultSection {
    /// Largest von Mises stress of a tube over yield, or tension over break of another section.
    pub(crate) fn utilisation(&self, tension: f64, von_mises: Option<f64>) -> f64 {
        match (&self.tube, von_mises) {
            (Some(tube), Some(stress)) => stress / tube.yield_stress,
            _ => (tension / self.segment.breaking).max(0.0),
        }
    }

    /// Tension (N) by which its stress goes: in the wall of a tube, effective of another section.
    pub(super) fn stress_tension(&self, node: &NodeRow) -> f64 {
        self.tube.as_ref().map_or(node.effective, |tube| wall_tension(tube, node))
    }
}

/// Tension in the wall of a tube at a node (N).
pub(super) fn wall_tension(tube: &CheckedTube, node: &NodeRow) -> f64 {
    let Some(bent) = &node.bent else { return node.effective };
    let ([outer, bore], [outside, inside]) = (tube.areas(), bent.pressures);
    node.effective - outside * outer + inside * bore
}

/// The segments of the class of a line, from its first end; of a pipe the one it is made of.
pub(crate) fn sections(model: &Model, name: &str) -> Vec<ResultSection> {
    let connector = model.connectors.get(&Model::key(name)).map(|c| (&c.class, usize::MAX));
    let pipe = model.assemblies.get(&Model::key(name)).and_then(|a| match &a.kind {
        AssemblyKind::Pipe { class, .. } => Some((class, 1)),
        AssemblyKind::TipHook { .. } | AssemblyKind::Pulley { .. } | AssemblyKind::Winch { .. } => None,
    });
    let class = connector.or(pipe).and_then(|(class, few)| Some((model.classes.get(&Model::key(class))?, few)));
    let Some((class, few)) = class else { return Vec::new() };
    let bends = class.given_bending_stiffnesses();
    let made = class.fatigue_segments().into_iter().zip(class.wall_materials()).zip(bends);
    let of = |((segment, material), given): ((FatigueSegment, WallMaterial), Option<f64>)| {
        // a bar that does not bend is a chain or rope
        let bends = given != Some(0.0);
        let inside = segment.thickness.map_or(0.0, |wall| (segment.od - 2.0 * wall).max(0.0));
        let second_moment = PI / 64.0 * (segment.od.powi(4) - inside.powi(4));
        let bending_stiffness = given.unwrap_or(material.modulus * second_moment);
        let tube = segment.thickness.filter(|wall| bends || 2.0 * wall < segment.od).map(|wall| CheckedTube {
            diameter: segment.od,
            wall,
            yield_stress: material.yield_stress,
            tensile: material.tensile,
            modulus: material.modulus,
            poisson: material.poisson,
        });
        ResultSection { segment, tube, bending_stiffness }
    };
    made.map(of).take(few).collect()
}

/// The numbers of the segments (from 0) that a place is in, by its unstretched distance from the second end (m): toward the first end
/// and toward the second, which differ where two meet. The first segment is as long as a winch has made it.
pub(crate) fn segments_at(sections: &[ResultSection], from_second: f64) -> [usize; 2] {
    let mut left = from_second;
    for (index, section) in sections.iter().enumerate().skip(1).rev() {
        left -= section.segment.length;
        // a length added up of those of elements has their rounding
        let near = 1e-6 * section.segment.length;
        if left <= near {
            return [if left >= -near { index - 1 } else { index }, index];
        }
    }
    [0; 2]
}

/// The sides of such a place, from the first end: 0 toward the first end, only where two segments meet, and 1 toward the second, with
/// the number of the segment and the segment.
pub(crate) fn sides(
    sections: &[ResultSection],
    [before, behind]: [usize; 2],
) -> impl Iterator<Item = (usize, usize, &ResultSection)> {
    let both = [(before != behind).then_some((0, before)), Some((1, behind))];
    both.into_iter().flatten().filter_map(|(side, index)| Some((side, index, sections.get(index)?)))
}

/// A line of a run.
#[derive(Debug)]
pub struct LineResults<'a> {
    run: &'a Run,
    /// Its name as written.
    pub name: &'a str,
    link: usize,
    columns: &'a AlongColumns,
    sections: Vec<ResultSection>,
    /// Places of the nodes that were ever there, among those that are kept.
    positions: Vec<usize>,
}

impl<'a> LineResults<'a> {
    /// The line of a name.
    ///
    /// # Errors
    /// No such connector in the run, one that reports no nodes, or whose nodes the run did not keep.
    pub fn find(run: &'a Run, name: &str) -> Result<Self, ClassError> {
        let layout = &run.history.layout;
        let name = line_name(name);
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
            return Err(ClassError::new(format!("{name} has no nodes along its length")).help(help));
        };
        let there = |position: &usize| match run.history.is_empty() {
            true => run.envelopes.get(link).is_some_and(|e| e.extremes(*position, NodeQuantity::Arc).is_some()),
            false => run.history.rows().any(|row| columns.node(*position, row).is_some()),
        };
        let positions: Vec<usize> = (0..columns.numbers.len()).filter(there).collect();
        if positions.is_empty() {
            return Err(ClassError::new(format!("{name} did not act at any stored instant")));
        }
        let sections = sections(&run.model, &found.name);
        Ok(LineResults { run, name: &found.name, link, columns, sections, positions })
    }

    /// How many nodes it has.
    pub fn nodes(&self) -> usize {
        self.positions.len()
    }

    /// Numbers of the nodes with their places.
    fn numbered_nodes(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.positions.iter().enumerate().map(|(index, position)| (index + 1, *position))
    }

    /// The row of an event: between two stored ones on the straight line.
    fn row(&self, event: &RunEvent, row: &mut Vec<f64>) {
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

    /// The sides of a node in a row on which it is judged: see [`sides`].
    fn sides(&self, node: &NodeRow, row: &[f64]) -> impl Iterator<Item = (usize, usize, &ResultSection)> {
        sides(&self.sections, segments_at(&self.sections, self.length(row) - node.arc))
    }

    /// The most a node uses in a row, of its sides.
    fn node_utilisation(&self, node: &NodeRow, row: &[f64]) -> Option<f64> {
        let used = |(side, _, section): (usize, usize, &ResultSection)| {
            let stress = node.bent.and_then(|b| b.von_mises.get(side).copied());
            section.utilisation(node.effective, stress)
        };
        self.sides(node, row).map(used).reduce(f64::max)
    }

    fn error(&self, text: impl Into<Message>) -> SolveError {
        SolveError { who: Some(self.name.to_string()), error: ClassError::new(text) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn point_is_in_segment_at_its_distance_from_second_end() {
        let segment = |length: f64| ResultSection {
            segment: FatigueSegment {
                curve: None,
                breaking: 1.0,
                break_is_given: true,
                od: 0.1,
                thickness: None,
                length,
            },
            tube: None,
            bending_stiffness: 0.0,
        };
        let all = [100.0, 50.0, 20.0].map(segment);
        // the last node, one in the last, where two meet, in the first, beyond what the class says of it
        for (from_second, want) in [
            (0.0, [2, 2]),
            (10.0, [2, 2]),
            (20.0, [1, 2]),
            (20.5, [1, 1]),
            (70.0, [0, 1]),
            (71.0, [0, 0]),
            (500.0, [0, 0]),
        ] {
            assert_eq!(segments_at(&all, from_second), want, "{from_second}");
        }
        assert_eq!(segments_at(&[], 3.0), [0, 0]);
        let judged: Vec<_> = sides(&all, [1, 2]).map(|(side, index, _)| (side, index)).collect();
        assert_eq!(judged, [(0, 1), (1, 2)]);
        assert_eq!(sides(&all, [1, 1]).count(), 1);
        assert_eq!(all[0].utilisation(-5.0, None), 0.0);
    }
}
