//! A spring along the chord between two ends: a weightless line, or one that also takes compression.

use super::extension::{EndPull, ExtensibleLine, Extension};
use super::mooring::{Mooring, no_other_end, too_short, too_short_note};
use nalgebra::{Matrix3, Vector3};
use windlass_base::table::Table;
use windlass_catenary::{FunctionPoint, StretchLaw, rising_root};
use windlass_model::{
    AbsentRow, ClassError, Condition, ConnectorElement, ConnectorResponse, ConnectorSummary, End, FoundLength,
    LineChange, LineConfiguration, LineLoads, LineModel, LineSampling, Note, Situation, SolverCache,
};

/// A weightless line between two places.
#[derive(Clone, Debug)]
pub struct Chord {
    /// The line as a mooring: its tables, shapes and lengths under tension.
    pub line: Mooring,
    /// Springs in series with its segments.
    pub springs: [Option<StretchLaw>; 2],
    /// Whether it also takes compression.
    pub takes_compression: bool,
    /// Weight in water that it leaves out (N).
    pub left_out: f64,
}

/// Share of the tension from which on a weight that is left out is reported, and warned of.
const LEFT_OUT: [f64; 2] = [0.01, 0.1];

impl Chord {
    /// From the first end to the other (m, global).
    fn vector(&self) -> [f64; 3] {
        let [x, y, z] = self.line.position.fairlead;
        let [fx, fy, _] = self.line.position.other.unwrap_or(self.line.position.fairlead);
        [fx - x, fy - y, self.line.line.anchor() - z]
    }

    /// Distance between the ends, and its horizontal part (m).
    fn chord(&self) -> (f64, f64) {
        let [x, y, z] = self.vector();
        (x.hypot(y).hypot(z), x.hypot(y))
    }

    /// Force along the chord at an elongation (m), tension positive (N), and its slope (N/m).
    fn force(&self, elongation: f64) -> (f64, f64) {
        self.force_of(&self.law(), elongation)
    }

    /// All that gives way, in series.
    fn law(&self) -> StretchLaw {
        let mut laws: Vec<StretchLaw> =
            self.line.line.segments().iter().map(|s| StretchLaw::Linear(s.ea / s.length)).collect();
        laws.extend(self.springs.iter().flatten().cloned());
        StretchLaw::Series(laws)
    }

    fn force_of(&self, law: &StretchLaw, elongation: f64) -> (f64, f64) {
        if elongation < 0.0 && !self.takes_compression {
            return (0.0, 0.0);
        }
        if elongation == 0.0 {
            return (0.0, if self.takes_compression { 1.0 / law.stretch(0.0).1 } else { 0.0 });
        }
        let start = elongation.abs() / law.stretch(0.0).1;
        let at = |t: f64| {
            let (value, slope) = law.stretch(t);
            FunctionPoint { value, slope }
        };
        let (force, _) = rising_root(start, elongation.abs(), at);
        (force.copysign(elongation), 1.0 / law.stretch(force).1)
    }

    /// Largest tension over own break at a force (N), and the segment that has it, from 1.
    fn ratio(&self, force: f64) -> (f64, usize) {
        let ratios = self.line.breaks.iter().map(|b| force.max(0.0) / b);
        ratios.enumerate().fold((0.0, 1), |best, (i, r)| if r > best.0 { (r, i + 1) } else { best })
    }

    /// As [`Self::ratio`], of the segments whose break was given.
    fn over_given_break(&self, force: f64) -> Option<(f64, usize)> {
        let limits = self.line.breaks.iter().zip(&self.line.breaks_given).enumerate().filter(|(_, (_, given))| **given);
        limits.map(|(i, (limit, _))| (force.max(0.0) / limit, i + 1)).max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// What is reported at a force (N), a distance between the ends, and what of it is left for the line (m).
    fn remarks(&self, force: f64, chord: f64, left: f64, ratio: f64) -> Vec<Note> {
        let mut notes = self.line.notes.clone();
        if ratio > 1.0 {
            notes.push(Note::warning("the line is beyond its breaking tension"));
        }
        if force != 0.0 && chord == 0.0 {
            notes.push(Note::warning("its ends coincide; the direction of its force is not defined, and taken upward"));
        }
        notes.extend(too_short(chord / self.line.line.length(), ratio).map(too_short_note));
        let share = if force == 0.0 { 0.0 } else { self.left_out.abs() / force.abs() };
        if share >= LEFT_OUT[0] {
            let text = format!("it has no weight here: its own in water is {share:.3} of this tension");
            notes.push(if share >= LEFT_OUT[1] { Note::warning(text) } else { text.into() });
        }
        if force == 0.0 && left < self.line.line.length() {
            notes.push("the line is slack".into());
        }
        notes
    }
}

/// A spring along the chord, as an engine sees it.
#[derive(Clone, Debug)]
pub struct ChordElement {
    chord: Chord,
    /// All that gives way, in series.
    law: StretchLaw,
}

impl ChordElement {
    /// The element between two ends.
    ///
    /// # Errors
    /// An end whose place is not known.
    pub fn new(chord: Chord) -> Result<Self, ClassError> {
        if chord.line.position.other.is_none() {
            return Err(no_other_end());
        }
        let law = chord.law();
        Ok(ChordElement { chord, law })
    }

    /// From the first end to the other.
    fn chord_vector(ends: &[End]) -> Result<Vector3<f64>, ClassError> {
        let [from, to] = End::origins(ends)?;
        Ok(to - from)
    }

    /// Force and slope of the spring with a link, over the distance between the ends (m).
    fn with_link(&self, by: Extension, chord: f64) -> (f64, f64) {
        let elongation = chord - by.length - self.chord.line.line.length();
        if by.compliance > 0.0 {
            let law = StretchLaw::Series(vec![self.law.clone(), StretchLaw::Linear(1.0 / by.compliance)]);
            return self.chord.force_of(&law, elongation);
        }
        self.chord.force_of(&self.law, elongation)
    }
}

impl ExtensibleLine for ChordElement {
    fn pull(
        &self,
        ends: &[End],
        by: Extension,
        _: &mut SolverCache,
        out: &mut ConnectorResponse,
    ) -> Result<EndPull, ClassError> {
        out.clear(2);
        let along = ChordElement::chord_vector(ends)?;
        let chord = along.norm();
        let unit = if chord > 0.0 { along / chord } else { -Vector3::z() };
        let (force, slope) = self.with_link(by, chord);
        let across = if chord > 0.0 { force / chord } else { 0.0 };
        let pull = unit * force;
        let k = unit * unit.transpose() * (slope - across) + Matrix3::identity() * across;
        if let [near, far] = out.wrench.as_mut_slice() {
            near.fixed_rows_mut::<3>(0).copy_from(&pull);
            far.fixed_rows_mut::<3>(0).copy_from(&-pull);
        }
        for (index, block) in out.stiffness.iter_mut().enumerate() {
            let sign = if index == 0 || index == 3 { 1.0 } else { -1.0 };
            block.fixed_view_mut::<3, 3>(0, 0).copy_from(&(k * sign));
        }
        Ok(EndPull { tension: force, along: unit })
    }

    fn summary_with_link(&self, ends: &[End], by: Extension) -> Result<ConnectorSummary, ClassError> {
        let chord = ChordElement::chord_vector(ends)?.norm();
        let (force, _) = self.with_link(by, chord);
        let (ratio, critical) = self.chord.ratio(force);
        Ok(ConnectorSummary {
            tension: Some(force),
            ratio: Some(ratio),
            critical: Some(critical),
            over_given_break: self.chord.over_given_break(force),
            too_short: too_short(chord / self.chord.line.line.length(), ratio),
            grounded: Some(0.0),
            solution: "weightless",
            springs: Vec::new(),
            fender: None,
            notes: self.chord.remarks(force, chord, chord - by.length(force), ratio),
        })
    }

    fn compression_onset(&self) -> Option<f64> {
        self.chord.takes_compression.then_some(0.0)
    }
}

impl ConnectorElement for ChordElement {
    fn evaluate(
        &self,
        at: &Situation,
        _committed: &[f64],
        _trial: &mut [f64],
        cache: &mut SolverCache,
        out: &mut ConnectorResponse,
    ) -> Result<(), ClassError> {
        self.pull(at.ends, Extension::NONE, cache, out).map(|_| ())
    }

    fn summary(&self, at: &Situation, _committed: &[f64]) -> Result<ConnectorSummary, ClassError> {
        self.summary_with_link(at.ends, Extension::NONE)
    }

    fn compression_onset(&self) -> Option<f64> {
        ExtensibleLine::compression_onset(self)
    }
}

impl LineModel for Chord {
    fn element(&self) -> Result<Box<dyn ConnectorElement>, ClassError> {
        Ok(Box::new(ChordElement::new(self.clone())?))
    }

    fn tabulate(&self, connector: &str) -> Result<(Table, Vec<AbsentRow>), ClassError> {
        self.line.tabulate(connector)
    }

    fn geometry(&self, connector: &str, condition: Condition, sampling: LineSampling) -> Result<Table, ClassError> {
        if self.configuration(condition)?.tension < 0.0 {
            return Err(ClassError::new("the spring is pushed together: it is straight between its ends"));
        }
        self.line.geometry(connector, condition, sampling)
    }

    fn configuration(&self, condition: Condition) -> Result<LineConfiguration, ClassError> {
        let distance = match condition {
            Condition::Placed => self.line.position.span().0,
            Condition::Distance(x) => x,
            Condition::Horizontal(_) | Condition::Tension(_) | Condition::Vertical(_) => {
                return self.line.configuration(condition);
            }
        };
        let [_, _, fairlead] = self.line.position.fairlead;
        let drop = fairlead - self.line.line.anchor();
        let chord = distance.hypot(drop);
        let (force, _) = self.force(chord - self.line.line.length());
        let (horizontal, vertical) =
            if chord > 0.0 { (force * distance / chord, force * drop / chord) } else { (0.0, force) };
        let (ratio, critical) = self.ratio(force);
        Ok(LineConfiguration {
            distance,
            horizontal,
            vertical,
            tension: force,
            ratio,
            critical,
            anchor: [horizontal, vertical],
            on_bottom: 0.0,
            notes: self.remarks(force, chord, chord, ratio),
        })
    }

    fn loads(&self) -> Result<LineLoads, ClassError> {
        let along = self.vector();
        let (chord, _) = self.chord();
        let unit = if chord > 0.0 { along.map(|v| v / chord) } else { [0.0, 0.0, -1.0] };
        let (force, slope) = self.force(chord - self.line.line.length());
        let across = if chord > 0.0 { force / chord } else { 0.0 };
        let mut stiffness = unit.map(|a| unit.map(|b| -slope * a * b + across * a * b));
        (0..3).for_each(|i| stiffness[i][i] -= across);
        let (ratio, critical) = self.ratio(force);
        Ok(LineLoads {
            fairlead: unit.map(|u| force * u),
            other: unit.map(|u| -force * u),
            stiffness,
            distance: along[0].hypot(along[1]),
            tension: force,
            ratio,
            critical,
            over_given_break: self.over_given_break(force),
            grounded: 0.0,
            solution: "weightless",
            notes: self.remarks(force, chord, chord, ratio),
        })
    }

    fn with_change(&self, change: LineChange) -> Result<Box<dyn LineModel>, ClassError> {
        if matches!(change, LineChange::Weight(_)) {
            return Err(ClassError::new("the line has no weight"));
        }
        let line = self.line.with_change(change)?;
        Ok(Box::new(Chord {
            line,
            springs: self.springs.clone(),
            takes_compression: self.takes_compression,
            left_out: self.left_out,
        }))
    }

    fn distance(&self, condition: Condition) -> Result<f64, ClassError> {
        self.line.distance(condition)
    }

    fn first_length(&self, condition: Condition) -> Result<FoundLength, ClassError> {
        let (chord, horizontal) = self.chord();
        let tension = match condition {
            Condition::Tension(tension) => tension,
            Condition::Horizontal(force) if horizontal > 0.0 => force * chord / horizontal,
            Condition::Horizontal(_) => return Err(ClassError::new("a vertical line has no horizontal force")),
            Condition::Placed | Condition::Distance(_) | Condition::Vertical(_) => {
                return self.line.first_length(condition);
            }
        };
        let segments = self.line.line.segments();
        let (first, others) = segments.split_first().ok_or_else(|| ClassError::new("the line has no segments"))?;
        let stretched = |length: f64, ea: f64| length * (1.0 + tension / ea);
        let others: f64 = others.iter().map(|s| stretched(s.length, s.ea)).sum();
        let springs: f64 = self.springs.iter().flatten().map(|law| law.stretch(tension).0).sum();
        let length = (chord - others - springs) / stretched(1.0, first.ea);
        if length > 0.0 {
            return Ok(FoundLength::single(length));
        }
        Err(ClassError::new("the rest of the line is too long: no length of the first segment makes it so tight"))
    }
}
