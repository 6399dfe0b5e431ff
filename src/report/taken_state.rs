//! A state of bodies that a record took from an earlier run, as `TDOM -RESET` and `&INSTATE -EVENT` do. It is kept in the file of
//! the run that began from it, since the earlier run is not.

use windlass_base::geometry::Place;
use windlass_base::pose::Six;
use windlass_model::Model;
use windlass_solve::time::History;

/// Numbers of a body: its place, its velocity.
const BODY_NUMBERS: usize = 12;

/// Where the bodies of a run were at a stored instant, and how they moved.
#[derive(Clone, Debug, PartialEq)]
pub struct TakenState {
    /// The time that was asked for (s).
    pub time: f64,
    /// The key of each body, with its shift (m), turn (rad) and velocity (m/s, rad/s).
    bodies: Vec<(String, [f64; BODY_NUMBERS])>,
}

impl TakenState {
    /// The stored instant of a run that is nearest to a time (s); `None` of a run without rows.
    pub fn from_history(history: &History, time: f64) -> Option<Self> {
        let far = |row: &[f64]| (row.first().copied().unwrap_or(f64::INFINITY) - time).abs();
        let row = history.rows().min_by(|a, b| far(a).total_cmp(&far(b)))?;
        let body = |(index, (_, key)): (usize, &(String, String))| {
            let at = history.layout.body(index);
            Some((key.clone(), row.get(at..at + BODY_NUMBERS)?.try_into().ok()?))
        };
        let bodies: Option<Vec<_>> = history.layout.bodies.iter().enumerate().map(body).collect();
        Some(TakenState { time, bodies: bodies? })
    }

    /// Puts the bodies of a model there; their velocities, by number. `None` where a body is not in the model.
    pub fn put(&self, model: &mut Model) -> Option<Vec<(usize, Six)>> {
        let mut velocities = Vec::new();
        for (key, numbers) in &self.bodies {
            let [x, y, z, roll, pitch, yaw, velocity @ ..] = *numbers;
            let body = model.bodies.get_index_of(key)?;
            model.bodies.get_mut(key)?.position = Place { shift: [x, y, z], turn: [roll, pitch, yaw] };
            velocities.push((body, Six::from_column_slice(&velocity)));
        }
        Some(velocities)
    }

    /// As bytes: the time, then of each body the length of its key, the key and its numbers.
    pub fn bytes(&self) -> Vec<u8> {
        let mut bytes = self.time.to_le_bytes().to_vec();
        for (key, numbers) in &self.bodies {
            bytes.extend((key.len() as u64).to_le_bytes());
            bytes.extend(key.as_bytes());
            bytes.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
        }
        bytes
    }

    /// Reads what [`TakenState::bytes`] made; `None` of other bytes.
    pub fn read(bytes: &[u8]) -> Option<Self> {
        let (time, mut rest) = bytes.split_first_chunk::<8>()?;
        let mut bodies = Vec::new();
        while !rest.is_empty() {
            let (length, behind) = rest.split_first_chunk::<8>()?;
            let (key, behind) = behind.split_at_checked(usize::try_from(u64::from_le_bytes(*length)).ok()?)?;
            let (numbers, behind) = behind.split_at_checked(BODY_NUMBERS * 8)?;
            let mut values = [0.0; BODY_NUMBERS];
            for (value, number) in values.iter_mut().zip(numbers.chunks_exact(8)) {
                *value = f64::from_le_bytes(number.try_into().ok()?);
            }
            bodies.push((std::str::from_utf8(key).ok()?.to_string(), values));
            rest = behind;
        }
        Some(TakenState { time: f64::from_le_bytes(*time), bodies })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn state_reads_back_from_its_bytes_and_from_no_others() {
        let numbers = std::array::from_fn(|index| index as f64 / 7.0);
        let state = TakenState { time: 5.0, bodies: vec![("BARGE".into(), numbers), ("É".into(), [-0.0; 12])] };
        let bytes = state.bytes();
        assert_eq!(TakenState::read(&bytes), Some(state));
        for cut in [0, 7, 9, bytes.len() - 1] {
            assert_eq!(TakenState::read(&bytes[..cut]), None, "{cut}");
        }
        let mut long = bytes.clone();
        long[8..16].copy_from_slice(&u64::MAX.to_le_bytes());
        assert_eq!(TakenState::read(&long), None);
    }
}
