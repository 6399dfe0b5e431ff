//! The snapshot of a run, its checkpoint for `TDOM -RESTART`: all state needed to continue from an instant to the same digits, and
//! its bytes in the run file. Warm starts of solvers are not part of it; they are discarded when a snapshot is written.

use super::accuracy::Accuracy;
use super::forces::BodyMotion;
use super::run_settings::RunCounts;
use nalgebra::Matrix3;
use windlass_base::geometry::Place;
use windlass_base::pose::{Pose, Six};

/// A run at an instant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Snapshot {
    /// Time (s).
    pub time: f64,
    /// Steps of the run's own length taken.
    pub taken: usize,
    /// Motions of the bodies.
    pub motions: Vec<BodyMotion>,
    /// What loads remember.
    pub loads: Vec<f64>,
    /// What connectors remember.
    pub states: Vec<f64>,
    /// Length of the first segment of each connector of the layout (m), where the connector has one of its own.
    pub lengths: Vec<Option<f64>>,
    /// When each action happened (s).
    pub fired: Vec<Option<f64>>,
    /// Connectors being winched: name, rate (m/s), the length they end at (m).
    pub winches: Vec<(String, f64, Option<f64>)>,
    /// Places of the last row.
    pub near: Vec<Place>,
    /// Rows kept so far.
    pub rows: usize,
    /// What the run did so far.
    pub counts: RunCounts,
    /// What the run has seen of its own steps.
    pub accuracy: Accuracy,
}

/// Writes numbers one behind the other; a text as the number of its bytes and these.
#[derive(Default)]
struct NumberWriter(Vec<u8>);

impl NumberWriter {
    fn number(&mut self, value: f64) {
        self.0.extend_from_slice(&value.to_le_bytes());
    }

    fn count(&mut self, value: usize) {
        self.0.extend_from_slice(&(value as u64).to_le_bytes());
    }

    fn numbers<'a>(&mut self, values: impl IntoIterator<Item = &'a f64>) {
        values.into_iter().for_each(|v| self.number(*v));
    }

    fn list(&mut self, values: &[f64]) {
        self.count(values.len());
        self.numbers(values);
    }

    fn maybe(&mut self, value: Option<f64>) {
        self.count(usize::from(value.is_some()));
        self.number(value.unwrap_or(0.0));
    }
}

/// Reads them back; nothing where they end too soon.
struct Read<'a>(&'a [u8]);

impl Read<'_> {
    fn eight(&mut self) -> Option<[u8; 8]> {
        let (first, rest) = self.0.split_first_chunk::<8>()?;
        self.0 = rest;
        Some(*first)
    }

    fn number(&mut self) -> Option<f64> {
        self.eight().map(f64::from_le_bytes)
    }

    /// A count of things of at least `size` bytes each, of which there cannot be more than are left.
    fn count(&mut self, size: usize) -> Option<usize> {
        let count = usize::try_from(u64::from_le_bytes(self.eight()?)).ok()?;
        (count <= self.0.len() / size.max(1)).then_some(count)
    }

    fn plain(&mut self) -> Option<usize> {
        usize::try_from(u64::from_le_bytes(self.eight()?)).ok()
    }

    fn array<const N: usize>(&mut self) -> Option<[f64; N]> {
        let mut all = [0.0; N];
        for value in &mut all {
            *value = self.number()?;
        }
        Some(all)
    }

    fn list(&mut self) -> Option<Vec<f64>> {
        let count = self.count(8)?;
        (0..count).map(|_| self.number()).collect()
    }

    fn maybe(&mut self) -> Option<Option<f64>> {
        let is = self.plain()? != 0;
        self.number().map(|v| is.then_some(v))
    }
}

impl Snapshot {
    /// As bytes.
    pub fn bytes(&self) -> Vec<u8> {
        let mut out = NumberWriter::default();
        out.number(self.time);
        out.count(self.taken);
        out.count(self.motions.len());
        for motion in &self.motions {
            out.numbers(motion.pose.origin.iter().chain(motion.pose.axes.iter()));
            let BodyMotion { velocity, acceleration, auxiliary, jerk, .. } = motion;
            [velocity, acceleration, auxiliary, jerk].into_iter().for_each(|six| out.numbers(six.iter()));
        }
        out.list(&self.loads);
        out.list(&self.states);
        for list in [&self.lengths, &self.fired] {
            out.count(list.len());
            list.iter().for_each(|v| out.maybe(*v));
        }
        out.count(self.winches.len());
        for (name, rate, to) in &self.winches {
            out.count(name.len());
            out.0.extend_from_slice(name.as_bytes());
            out.number(*rate);
            out.maybe(*to);
        }
        out.count(self.near.len());
        self.near.iter().for_each(|p| out.numbers(p.shift.iter().chain(&p.turn)));
        out.count(self.rows);
        let RunCounts { steps, cut, iterations, evaluations } = self.counts;
        [steps, cut, iterations, evaluations].into_iter().for_each(|n| out.count(n));
        out.list(&self.accuracy.numbers());
        out.0
    }

    /// From bytes; `None` of bytes that are no snapshot.
    pub fn read(bytes: &[u8]) -> Option<Snapshot> {
        let mut from = Read(bytes);
        let (time, taken) = (from.number()?, from.plain()?);
        let count = from.count(288)?;
        let motion = |from: &mut Read| {
            let (origin, axes) = (from.array::<3>()?, from.array::<9>()?);
            let six = |from: &mut Read| from.array::<6>().map(Six::from);
            let pose = Pose { origin: origin.into(), axes: Matrix3::from_column_slice(&axes) };
            let [velocity, acceleration] = [six(from)?, six(from)?];
            Some(BodyMotion { pose, velocity, acceleration, auxiliary: six(from)?, jerk: six(from)? })
        };
        let motions = (0..count).map(|_| motion(&mut from)).collect::<Option<_>>()?;
        let (loads, states) = (from.list()?, from.list()?);
        let mut maybes = || {
            let count = from.count(16)?;
            (0..count).map(|_| from.maybe()).collect::<Option<Vec<_>>>()
        };
        let (lengths, fired) = (maybes()?, maybes()?);
        let count = from.count(32)?;
        let winch = |from: &mut Read| {
            let length = from.count(1)?;
            let (name, rest) = from.0.split_at_checked(length)?;
            from.0 = rest;
            Some((String::from_utf8(name.to_vec()).ok()?, from.number()?, from.maybe()?))
        };
        let winches = (0..count).map(|_| winch(&mut from)).collect::<Option<_>>()?;
        let count = from.count(48)?;
        let position = |from: &mut Read| Some(Place { shift: from.array()?, turn: from.array()? });
        let near = (0..count).map(|_| position(&mut from)).collect::<Option<_>>()?;
        let rows = from.plain()?;
        let [steps, cut, iterations, evaluations] = [from.plain()?, from.plain()?, from.plain()?, from.plain()?];
        let counts = RunCounts { steps, cut, iterations, evaluations };
        let accuracy = Accuracy::from_numbers(&from.list()?)?;
        let whole = from.0.is_empty();
        whole.then_some(Snapshot {
            time,
            taken,
            motions,
            loads,
            states,
            lengths,
            fired,
            winches,
            near,
            rows,
            counts,
            accuracy,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn snapshot_reads_back_from_its_bytes_and_not_from_a_part() {
        let motion = BodyMotion { velocity: Six::repeat(0.25), ..BodyMotion::default() };
        let snapshot = Snapshot {
            time: 12.5,
            taken: 7,
            motions: vec![motion, BodyMotion::default()],
            loads: vec![1.0, f64::MIN_POSITIVE],
            states: vec![],
            lengths: vec![None, Some(3.0)],
            fired: vec![Some(1.0)],
            winches: vec![("A".into(), -0.5, None)],
            near: vec![Place::default(); 2],
            rows: 3,
            counts: RunCounts { steps: 9, cut: 1, iterations: 20, evaluations: 29 },
            accuracy: Accuracy::default(),
        };
        let bytes = snapshot.bytes();
        assert_eq!(Snapshot::read(&bytes), Some(snapshot));
        assert!((0..bytes.len()).all(|n| Snapshot::read(&bytes[..n]).is_none()));
    }
}
