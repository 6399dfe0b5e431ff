//! What a table of many nodes comes to: where a line is loaded most, where it touches down, how steep it is.

use super::{LineResults, ResultSection};
use crate::results::RunEvent;
use crate::time::{NodeQuantity, NodeRow};
use nalgebra::Vector3;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_model::LineNode;

/// A value and its unstretched distance from the first end (m).
type AtArc = (f64, f64);

/// The summary of a line at rest.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct LineSummary {
    /// Largest effective tension (N).
    largest_tension: Option<AtArc>,
    /// Least effective tension (N).
    least_tension: Option<AtArc>,
    /// Unstretched distance of the touchdown point nearest to the higher end (m).
    touchdown: Option<f64>,
    /// Horizontal distance from the higher end to that touchdown point (m).
    layback: Option<f64>,
    /// Unstretched length that lies on the bottom (m).
    grounded: f64,
    /// Largest inclination of what does not lie on the bottom (rad, below the horizontal seen from the higher end).
    departure: Option<AtArc>,
    /// Largest bending moment where the line curves downward (N m).
    overbend: Option<AtArc>,
    /// Largest bending moment where the line curves upward (N m).
    sagbend: Option<AtArc>,
    /// Largest bending strain at the outer fibre.
    strain: Option<AtArc>,
}

fn keep_larger(best: &mut Option<AtArc>, value: f64, arc: f64) {
    if value.is_finite() && best.is_none_or(|(most, _)| value > most) {
        *best = Some((value, arc));
    }
}

impl LineSummary {
    /// The summary of nodes at rest, from the first end.
    pub(super) fn new(nodes: &[LineNode], sections: &[ResultSection], bends: bool) -> LineSummary {
        let mut made = LineSummary::default();
        let mut least: Option<AtArc> = None;
        for node in nodes {
            keep_larger(&mut made.largest_tension, node.effective, node.arc);
            keep_larger(&mut least, -node.effective, node.arc);
        }
        made.least_tension = least.map(|(value, arc)| (-value, arc));
        made.find_touchdown(nodes);
        made.find_departure(nodes);
        if bends {
            made.find_bends(nodes, sections);
        }
        made
    }

    /// The nodes are taken from the higher end; the first that touches has the touchdown point before it, where the height over the
    /// bottom, taken as linear, is zero.
    fn find_touchdown(&mut self, nodes: &[LineNode]) {
        let from_first = is_first_end_higher(nodes);
        let ordered: Vec<&LineNode> = if from_first { nodes.iter().collect() } else { nodes.iter().rev().collect() };
        let pairs = || ordered.iter().zip(ordered.iter().skip(1));
        self.grounded = pairs().filter(|(a, b)| touches(a) && touches(b)).map(|(a, b)| (b.arc - a.arc).abs()).sum();
        let Some((free, lying)) = pairs().find(|(a, b)| !touches(a) && touches(b)) else { return };
        let share = free.clearance / (free.clearance - lying.clearance);
        let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 1.0 };
        let at = free.position + (lying.position - free.position) * share;
        self.touchdown = Some(free.arc + (lying.arc - free.arc) * share);
        self.layback = ordered.first().map(|end| (at.x - end.position.x).hypot(at.y - end.position.y));
    }

    /// The steepest place: directions at nodes are those of the parabola through them and their neighbours.
    fn find_departure(&mut self, nodes: &[LineNode]) {
        let down = if is_first_end_higher(nodes) { 1.0 } else { -1.0 };
        for window in nodes.windows(3) {
            let [a, b, c] = window else { continue };
            let (before, behind) = (b.arc - a.arc, c.arc - b.arc);
            if before <= 0.0 || behind <= 0.0 || touches(b) {
                continue;
            }
            let [first, second] = [(b.position - a.position) / before, (c.position - b.position) / behind];
            // the direction at an arc of the parabola: the slope of each side belongs to its middle
            let turn = (second - first) / (0.5 * (before + behind));
            let slope = |arc: f64| first + turn * (arc - (a.arc + 0.5 * before));
            let mut take = |arc: f64| {
                let direction = slope(arc);
                let angle = (-down * direction.z).atan2(direction.x.hypot(direction.y));
                keep_larger(&mut self.departure, angle, arc);
            };
            take(b.arc);
            if std::ptr::eq(a, nodes.first().unwrap_or(b)) {
                take(a.arc);
            }
            if std::ptr::eq(c, nodes.last().unwrap_or(b)) {
                take(c.arc);
            }
        }
    }

    fn find_bends(&mut self, nodes: &[LineNode], sections: &[ResultSection]) {
        for window in nodes.windows(3) {
            let [a, b, c] = window else { continue };
            let (before, behind) = (b.arc - a.arc, c.arc - b.arc);
            if before <= 0.0 || behind <= 0.0 {
                continue;
            }
            let turn = (c.position.z - b.position.z) / behind - (b.position.z - a.position.z) / before;
            let side = if turn < 0.0 { &mut self.overbend } else { &mut self.sagbend };
            keep_larger(side, b.moment, b.arc);
        }
        for node in nodes {
            let widest = node.sides().filter_map(|side| Some(sections.get(side.segment)?.segment.od)).reduce(f64::max);
            if let Some(od) = widest {
                keep_larger(&mut self.strain, 0.5 * od * node.curvature, node.arc);
            }
        }
    }

    /// The facts of the summary, and that of the largest utilisation, for the head of a table.
    pub(super) fn add_to(&self, table: Table, utilisation: Option<AtArc>) -> Table {
        let per_cent = |(share, arc): AtArc| (100.0 * share, arc);
        let rows: [(&str, Option<AtArc>, Dim, Digits); 7] = [
            ("Largest Tension", self.largest_tension, Dim::Force, Digits::Usual),
            ("Least Tension", self.least_tension, Dim::Force, Digits::Usual),
            ("Departure Angle", self.departure, Dim::Angle, Digits::Usual),
            ("Overbend Moment", self.overbend, Dim::Moment, Digits::Usual),
            ("Sagbend Moment", self.sagbend, Dim::Moment, Digits::Usual),
            ("Bending Strain (%)", self.strain.map(per_cent), Dim::None, Digits::Decimals(4)),
            ("Utilisation", utilisation, Dim::None, Digits::Decimals(3)),
        ];
        let mut table = table;
        for (name, (value, arc), dim, digits) in
            rows.into_iter().filter_map(|(name, at, dim, digits)| Some((name, at?, dim, digits)))
        {
            table = table.fact_with_digits(name, value + 0.0, dim, digits).fact(
                &format!("  at Arc of {}", short(name)),
                arc,
                Dim::Length,
            );
        }
        if let (Some(touchdown), Some(layback)) = (self.touchdown, self.layback) {
            table = table.fact("Touchdown at Arc", touchdown, Dim::Length).fact("Layback", layback, Dim::Length);
        }
        if self.grounded > 0.0 {
            table = table.fact("Unstretched on Bottom", self.grounded, Dim::Length);
        }
        table
    }
}

/// The largest or least value of a quantity along a line in a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineExtreme {
    /// Its value, SI.
    pub value: f64,
    /// Unstretched distance from the first end (m).
    pub arc: f64,
    /// When (s).
    pub time: f64,
}

/// What a dynamic line comes to over the instants of a run: the largest of what `LineSummary` has of each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunSummary {
    /// Largest effective tension (N).
    pub largest_tension: Option<LineExtreme>,
    /// Least effective tension (N).
    pub least_tension: Option<LineExtreme>,
    /// Largest inclination of what does not lie on the bottom (rad, below the horizontal seen from the higher end).
    pub departure: Option<LineExtreme>,
    /// Largest bending moment where the line curves downward (N m).
    pub overbend: Option<LineExtreme>,
    /// Largest bending moment where the line curves upward (N m).
    pub sagbend: Option<LineExtreme>,
    /// Largest bending strain at the outer fibre: moment over bending stiffness, times half of the diameter.
    pub strain: Option<LineExtreme>,
    /// Largest share of the yield stress of a tube, or of the break of another section.
    pub utilisation: Option<LineExtreme>,
    /// Least and largest unstretched distance of the touchdown point from the first end (m).
    pub touchdown: Option<[f64; 2]>,
    /// Least and largest horizontal distance from the higher end to the touchdown point (m).
    pub layback: Option<[f64; 2]>,
    /// Instants at which the line was looked at.
    pub instants: usize,
    /// The first and the last of these (s).
    pub window: Option<[f64; 2]>,
}

/// Keeps a value that is larger, by `sign` 1, or less, by -1, than the one kept.
fn keep_extreme(best: &mut Option<LineExtreme>, (value, arc): AtArc, time: f64, sign: f64) {
    if value.is_finite() && best.is_none_or(|most| sign * value > sign * most.value) {
        *best = Some(LineExtreme { value, arc, time });
    }
}

fn widen(range: &mut Option<[f64; 2]>, value: f64) {
    let [least, most] = range.unwrap_or([value; 2]);
    *range = Some([least.min(value), most.max(value)]);
}

impl RunSummary {
    /// The summary of a line over some events; of a run without stored instants what its envelope has, which is the tension alone.
    pub fn new(line: &LineResults, events: &[RunEvent]) -> RunSummary {
        let mut made = RunSummary::default();
        let mut row = Vec::new();
        for event in events {
            line.row(event, &mut row);
            made.take(line, &row);
        }
        let kept = line.run.envelopes.get(line.link).filter(|_| line.run.history.is_empty());
        if let Some(kept) = kept {
            for (_, place) in line.numbered_nodes() {
                let of = |quantity| kept.extremes(place, quantity);
                let Some((arc, tension)) = of(NodeQuantity::Arc).zip(of(NodeQuantity::Effective)) else { continue };
                let (least, most) = (tension.least, tension.most);
                keep_extreme(&mut made.largest_tension, (most.value, arc.mean), most.time, 1.0);
                keep_extreme(&mut made.least_tension, (least.value, arc.mean), least.time, -1.0);
            }
        }
        made
    }

    fn take(&mut self, line: &LineResults, row: &[f64]) {
        let time = row.first().copied().unwrap_or(f64::NAN);
        let rows: Vec<NodeRow> = line.columns.nodes(row).map(|(_, node)| node).collect();
        if rows.is_empty() {
            return;
        }
        self.instants += 1;
        widen(&mut self.window, time);
        let node = |row: &NodeRow| LineNode {
            arc: row.arc,
            position: Vector3::from(row.position),
            effective: row.effective,
            clearance: row.clearance,
            moment: row.bent.map_or(0.0, |bent| bent.moment()),
            ..LineNode::default()
        };
        let nodes: Vec<LineNode> = rows.iter().map(node).collect();
        // curvatures are not stored: strains come of the moments below
        let now = LineSummary::new(&nodes, &[], line.columns.bends);
        for (best, found, sign) in [
            (&mut self.largest_tension, now.largest_tension, 1.0),
            (&mut self.least_tension, now.least_tension, -1.0),
            (&mut self.departure, now.departure, 1.0),
            (&mut self.overbend, now.overbend, 1.0),
            (&mut self.sagbend, now.sagbend, 1.0),
        ] {
            if let Some(found) = found {
                keep_extreme(best, found, time, sign);
            }
        }
        now.touchdown.iter().for_each(|arc| widen(&mut self.touchdown, *arc));
        now.layback.iter().for_each(|distance| widen(&mut self.layback, *distance));
        for node in &rows {
            if let Some(used) = line.node_utilisation(node, row) {
                keep_extreme(&mut self.utilisation, (used, node.arc), time, 1.0);
            }
            let Some(moment) = node.bent.map(|bent| bent.moment()) else { continue };
            for (.., section) in line.sides(node, row) {
                let strain = 0.5 * section.segment.od * moment / section.bending_stiffness;
                keep_extreme(&mut self.strain, (strain, node.arc), time, 1.0);
            }
        }
    }
}

/// The name of a fact without its unit.
fn short(name: &str) -> &str {
    name.split(" (").next().unwrap_or(name)
}

fn touches(node: &LineNode) -> bool {
    node.clearance <= 0.0
}

fn is_first_end_higher(nodes: &[LineNode]) -> bool {
    nodes.first().zip(nodes.last()).is_none_or(|(a, b)| a.position.z >= b.position.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    /// A catenary of parameter a (m) that hangs from a height (m) over the bottom, with a length beyond its touchdown point,
    /// as nodes every `step` metres of arc from its upper end, with the moments of a bending stiffness.
    fn catenary(a: f64, height: f64, beyond: f64, (step, ei): (f64, f64)) -> Vec<LineNode> {
        let reach = a * (1.0 + height / a).acosh();
        let hanging = a * (reach / a).sinh();
        let count = ((hanging + beyond) / step) as usize;
        (0..=count)
            .map(|n| {
                let arc = n as f64 * step;
                let from_touchdown = hanging - arc;
                let (x, z) = if from_touchdown > 0.0 {
                    (a * (from_touchdown / a).asinh(), a.hypot(from_touchdown) - a)
                } else {
                    (from_touchdown, -1e-4)
                };
                let curvature = if from_touchdown > 0.0 { a / (a * a + from_touchdown * from_touchdown) } else { 0.0 };
                LineNode {
                    arc,
                    position: Vector3::new(reach - x, 0.0, z - height),
                    effective: 1000.0 * a.hypot(from_touchdown.max(0.0)),
                    clearance: z,
                    moment: ei * curvature,
                    curvature,
                    ..LineNode::default()
                }
            })
            .collect()
    }

    #[test]
    fn summary_of_catenary_meets_its_closed_form() {
        let (a, height) = (150.0, 100.0);
        let nodes = catenary(a, height, 80.0, (0.25, 2e6));
        let reach = a * (1.0f64 + height / a).acosh();
        let hanging = a * (reach / a).sinh();
        let found = LineSummary::new(&nodes, &[], true);
        let near =
            |value: f64, expected: f64, within: f64| assert!((value - expected).abs() < within, "{value} {expected}");
        near(found.layback.unwrap(), reach, 0.15);
        near(found.touchdown.unwrap(), hanging, 0.15);
        near(found.grounded, 80.0, 0.5);
        // tan of the angle at the top is arc over parameter
        near(found.departure.unwrap().0, (hanging / a).atan(), 1e-5);
        assert_eq!(found.departure.unwrap().1, 0.0);
        // the largest moment is that of the least radius, a, at the touchdown point
        near(found.sagbend.unwrap().0, 2e6 / a, 1.0);
        near(found.sagbend.unwrap().1, hanging, 0.3);
        near(found.largest_tension.unwrap().0, 1000.0 * (a + height), 1e-6);
        near(found.least_tension.unwrap().0, 1000.0 * a, 1e-6);
        // turned around it is the same line
        let length = nodes.last().unwrap().arc;
        let turned: Vec<LineNode> =
            nodes.iter().rev().map(|node| LineNode { arc: length - node.arc, ..*node }).collect();
        let other = LineSummary::new(&turned, &[], true);
        near(other.layback.unwrap(), found.layback.unwrap(), 1e-9);
        near(other.departure.unwrap().0, found.departure.unwrap().0, 1e-9);
        near(other.departure.unwrap().1, length, 1e-9);
    }

    #[test]
    fn summary_heads_table_with_values_and_places() {
        let nodes = catenary(150.0, 100.0, 80.0, (0.5, 2e6));
        let made = LineSummary::new(&nodes, &[], true).add_to(Table::new("Line"), Some((0.5, 3.0)));
        let names: Vec<&str> = made.facts.iter().map(|f| f.name.as_str()).collect();
        assert!(names.contains(&"Sagbend Moment") && names.contains(&"Layback"), "{names:?}");
        assert!(!names.contains(&"Bending Strain (%)"));
    }
}
