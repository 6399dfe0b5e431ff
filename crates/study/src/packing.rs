//! Packing: cases in parts that take about the same time.
//!
//! The longest case comes first, and each goes to the part that has least so far [GRAHAM-1969]: no part is then longer than 4/3 of what the best
//! division has.

use crate::ensemble::is_seed_column;
use crate::record::CaseStatus;
use crate::records::Records;
use crate::table::Case;
use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};

/// Seconds as a key that sorts.
#[derive(Clone, Copy, PartialEq)]
struct Seconds(f64);

impl Eq for Seconds {}

impl PartialOrd for Seconds {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Seconds {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}

/// Divides cases of known seconds into so many parts of about the same time: the places of the cases of each part, ascending. A part is empty
/// where there are more parts than cases. Of parts of the same time the first takes the case.
pub fn pack(seconds: &[f64], parts: usize) -> Vec<Vec<usize>> {
    let mut packed = vec![Vec::new(); parts];
    let mut order: Vec<usize> = (0..seconds.len()).collect();
    let of = |place: usize| Seconds(seconds.get(place).copied().filter(|s| s.is_finite()).unwrap_or_default());
    order.sort_by_key(|place| (Reverse(of(*place)), *place));
    let mut loads: BinaryHeap<Reverse<(Seconds, usize)>> =
        (0..parts).map(|part| Reverse((Seconds(0.0), part))).collect();
    for place in order {
        let Some(Reverse((load, part))) = loads.pop() else { break };
        if let Some(cases) = packed.get_mut(part) {
            cases.push(place);
        }
        loads.push(Reverse((Seconds(load.0 + of(place).0), part)));
    }
    for cases in &mut packed {
        cases.sort_unstable();
    }
    packed
}

/// How many parts of so many seconds hold these cases: one at least, and no more than there are cases.
pub fn parts_of(seconds: &[f64], wanted: f64) -> usize {
    let total: f64 = seconds.iter().filter(|s| s.is_finite()).sum();
    let parts = (total / wanted).ceil();
    // a quotient that is not finite becomes a bound
    (parts as usize).clamp(1, seconds.len().max(1))
}

/// Seconds that cases are expected to take: what the case itself took, else the mean of cases that differ from it in their seeds alone,
/// else the mean of all. Failed cases are left out, unless none has ended otherwise. `None` where no case has been measured.
pub fn expected_seconds(cases: &[&Case], columns: &[String], records: &Records) -> Option<Vec<f64>> {
    let has_ended = records.iter().any(|record| record.status() != CaseStatus::Failed);
    let measured = records
        .iter()
        .filter(|record| record.seconds().is_finite() && (!has_ended || record.status() != CaseStatus::Failed));
    let (mut sum, mut count) = (0.0, 0.0);
    let mut own: HashMap<&str, f64> = HashMap::new();
    let mut alike: HashMap<Vec<(&str, &str)>, (f64, f64)> = HashMap::new();
    for record in measured {
        sum += record.seconds();
        count += 1.0;
        own.insert(record.case(), record.seconds());
        let inputs = record.values().filter(|(name, _)| !is_seed_column(name));
        let known = alike.entry(inputs.collect()).or_default();
        known.0 += record.seconds();
        known.1 += 1.0;
    }
    if count == 0.0 {
        return None;
    }
    let of = |case: &&Case| {
        own.get(case.name.as_str()).copied().unwrap_or_else(|| {
            let inputs = columns.iter().zip(&case.values).filter(|(name, _)| !is_seed_column(name));
            let inputs: Vec<(&str, &str)> = inputs.map(|(name, value)| (name.as_str(), value.as_str())).collect();
            alike.get(&inputs).map_or(sum / count, |(sum, count)| sum / count)
        })
    };
    Some(cases.iter().map(of).collect())
}

/// Places of a sample spread evenly over so many cases.
pub fn sample(cases: usize, wanted: usize) -> Vec<usize> {
    let wanted = wanted.min(cases);
    (0..wanted).map(|n| n * cases / wanted.max(1)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::CaseRecord;

    #[test]
    fn packing_is_that_by_hand() {
        // 7 to A, 6 to B, 5 to C; 4 to C (9), 3 to B (9), 2 to A (9), 1 to A (10), being the first of three nines
        assert_eq!(pack(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0], 3), [vec![0, 1, 6], vec![2, 5], vec![3, 4]]);
        // the worst of two parts: 3 3 2 2 2 has 7 and 5, the best division 6 and 6
        assert_eq!(pack(&[3.0, 3.0, 2.0, 2.0, 2.0], 2), [vec![0, 2, 4], vec![1, 3]]);
        // equal cases are dealt out in turn; more parts than cases leave some empty
        assert_eq!(pack(&[1.0; 5], 2), [vec![0, 2, 4], vec![1, 3]]);
        assert_eq!(pack(&[1.0, 2.0], 3), [vec![1], vec![0], vec![]]);
        assert_eq!(pack(&[f64::NAN, 2.0, 1.0], 1), [vec![0, 1, 2]]);
        assert!(pack(&[1.0], 0).is_empty());
    }

    #[test]
    fn parts_hold_the_wanted_seconds() {
        assert_eq!(parts_of(&[10.0; 200], 300.0), 7);
        assert_eq!(parts_of(&[10.0; 200], 500.0), 4);
        assert_eq!(parts_of(&[10.0; 200], 1e9), 1);
        assert_eq!(parts_of(&[10.0; 200], 0.0), 200);
        assert_eq!(parts_of(&[], 300.0), 1);
    }

    #[test]
    fn sample_is_spread_over_the_table() {
        assert_eq!(sample(200, 4), [0, 50, 100, 150]);
        assert_eq!(sample(3, 8), [0, 1, 2]);
        assert!(sample(0, 8).is_empty() && sample(9, 0).is_empty());
    }

    fn case(name: &str, hs: &str, member: &str) -> Case {
        Case {
            name: name.into(),
            values: vec![hs.into(), member.into()],
            seed: 1,
            lost: None,
            intact: None,
            peaks_of: Vec::new(),
            stiffness: None,
        }
    }

    #[test]
    fn expected_seconds_are_its_own_those_of_other_seeds_or_the_mean() {
        let record = |case: &Case, status, seconds| CaseRecord {
            case: case.name.clone(),
            values: vec![("HS".into(), case.values[0].clone()), ("member".into(), case.values[1].clone())],
            status,
            seconds,
            ..CaseRecord::default()
        };
        use CaseStatus::{Done, Failed};
        let [a, b, c, d, e] =
            [case("a", "9", "1"), case("b", "9", "2"), case("c", "12", "1"), case("d", "9", "3"), case("e", "15", "1")];
        let records = [record(&a, Done, 10.0), record(&b, Done, 20.0), record(&c, Done, 60.0), record(&e, Failed, 0.1)];
        let columns = ["HS".to_owned(), "member".to_owned()];
        // a again, d as a and b, e as the mean of the three that have not failed
        let seconds = |cases: &[&Case], records: &[CaseRecord]| {
            expected_seconds(cases, &columns, &records.iter().cloned().collect())
        };
        assert_eq!(seconds(&[&a, &d, &e], &records), Some(vec![10.0, 15.0, 30.0]));
        assert_eq!(seconds(&[&e], &records[3..]), Some(vec![0.1]));
        assert_eq!(seconds(&[&e], &[]), None);
    }
}
