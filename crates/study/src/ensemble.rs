//! Ensembles: cases that differ in nothing but their seed, one extreme of a result each.

use crate::record::CaseStatus;
use crate::records::{RecordView, Records};
use crate::table::{MEMBER, SEED, SEED_OF};
use indexmap::IndexMap;
use std::collections::{HashMap, HashSet};

/// Cases of one row but for their seeds.
#[derive(Clone, Debug)]
pub struct Ensemble<'a> {
    records: &'a Records,
    /// Places of its cases.
    places: Vec<usize>,
    /// How many cases are left out because a case before them has the same seed.
    pub repeated: usize,
}

/// A result over the cases of an ensemble, one extreme of each.
#[derive(Clone, Debug, PartialEq)]
pub struct EnsembleResult {
    /// Its name; of the tension of a segment `tension of LINE SEGMENT`.
    pub name: String,
    /// Its unit, that of the first case which kept it.
    pub unit: String,
    /// Its values, a case each, in `unit`.
    pub values: Vec<f64>,
    /// How many cases have not failed and yet do not have it in this unit.
    pub missing: usize,
    /// Whether they are the least of each storm, not the largest.
    pub is_least: bool,
}

/// Whether a column has no other meaning than the seed of its case.
pub fn is_seed_column(name: &str) -> bool {
    [MEMBER, SEED, SEED_OF].iter().any(|known| known.eq_ignore_ascii_case(name))
}

/// The ensembles of the cases of a study, in the order of their first cases. Cases are of one ensemble where all columns but `member`,
/// `seed` and `seed_of` have the same values; a case that no other goes with is an ensemble of one.
pub fn ensembles(records: &Records) -> Vec<Ensemble<'_>> {
    let mut places: HashMap<Vec<(&str, &str)>, usize> = HashMap::new();
    let mut made: Vec<Ensemble<'_>> = Vec::new();
    let mut seeds: HashSet<(usize, u64)> = HashSet::new();
    for (at, record) in records.iter().enumerate() {
        let key = record.values().filter(|(name, _)| !is_seed_column(name)).collect();
        let place = *places.entry(key).or_insert(made.len());
        if place == made.len() {
            made.push(Ensemble { records, places: Vec::new(), repeated: 0 });
        }
        let Some(ensemble) = made.get_mut(place) else { continue };
        if seeds.insert((place, record.seed())) {
            ensemble.places.push(at);
        } else {
            ensemble.repeated += 1;
        }
    }
    made
}

impl<'a> Ensemble<'a> {
    /// Its cases, in the order of the study. Of those with the same seed only the first is here.
    pub fn cases(&self) -> impl Iterator<Item = RecordView<'a>> + Clone + use<'a, '_> {
        let records = self.records;
        self.places.iter().filter_map(move |place| records.get(*place))
    }

    /// How many cases it has.
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// Whether it has none.
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// How many of its cases ended so.
    pub fn count(&self, status: CaseStatus) -> usize {
        self.cases().filter(|case| case.status() == status).count()
    }

    /// The results that its cases have kept, in the order of the scripts; behind them the largest and the least tension of each segment of
    /// a line. Failed cases are left out: what they kept may be of half a run.
    pub fn results(&self) -> Vec<EnsembleResult> {
        let ended = || self.cases().filter(|case| case.status() != CaseStatus::Failed);
        let count = ended().count();
        let mut made: Vec<EnsembleResult> = Vec::new();
        for ((name, unit, is_least), value) in ended().flat_map(|case| case.results()) {
            match made.iter_mut().find(|known| known.name.eq_ignore_ascii_case(name)) {
                // of another unit it is no value of this result
                Some(known) if known.unit == *unit => known.values.push(value),
                Some(_) => {}
                None => made.push(EnsembleResult {
                    name: name.clone(),
                    unit: unit.clone(),
                    values: vec![value],
                    missing: 0,
                    is_least: *is_least,
                }),
            }
        }
        // of each segment its largest and its least tensions
        type OfSegments = IndexMap<(String, Option<usize>), Vec<f64>>;
        let mut tensions: [OfSegments; 2] = Default::default();
        for case in ended() {
            let mut seen: [HashSet<(String, Option<usize>)>; 2] = Default::default();
            for row in case.lines() {
                for ((known, seen), tension) in
                    tensions.iter_mut().zip(&mut seen).zip([row.largest_tension, row.least_tension])
                {
                    let segment = (row.line.clone(), row.segment);
                    // a script that checks twice has two rows of a segment, with one tension
                    if let Some(tension) = tension.filter(|_| seen.insert(segment.clone())) {
                        known.entry(segment).or_default().push(tension);
                    }
                }
            }
        }
        for (known, is_least) in tensions.into_iter().zip([false, true]) {
            made.extend(known.into_iter().map(|((line, segment), values)| EnsembleResult {
                name: segment.map_or_else(|| format!("tension of {line}"), |n| format!("tension of {line} {n}")),
                unit: "N".to_owned(),
                values,
                missing: 0,
                is_least,
            }));
        }
        for result in &mut made {
            result.missing = count.saturating_sub(result.values.len());
        }
        made
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kept::{KeptResult, LineRow};
    use crate::record::CaseRecord;

    fn case(
        name: &str,
        (hs, member, seed): (&str, &str, u64),
        status: CaseStatus,
        kept: &[(&str, f64, &str)],
    ) -> CaseRecord {
        let result = |(name, value, unit): &(&str, f64, &str)| KeptResult::new(*name, *value, *unit).ok();
        CaseRecord {
            case: name.into(),
            values: vec![("HS".into(), hs.into()), ("member".into(), member.into())],
            seed,
            status,
            seconds: 1.0,
            results: kept.iter().filter_map(result).collect(),
            start: 1,
            ..CaseRecord::default()
        }
    }

    #[test]
    fn cases_that_differ_in_their_seed_are_one_ensemble() {
        use CaseStatus::{Done, Failed, Overloaded};
        let records = [
            case("a1", ("9", "1", 11), Done, &[("T", 5.0, "kN"), ("X", 1.0, "m")]),
            case("b1", ("12", "1", 12), Done, &[("T", 9.0, "kN")]),
            case("a2", ("9", "2", 13), Failed, &[("T", 900.0, "kN")]),
            case("a3", ("9", "3", 14), Overloaded, &[("t", 6.0, "kN")]),
            case("a4", ("9", "4", 11), Done, &[("T", 5.0, "kN")]),
            case("a5", ("9", "5", 15), Done, &[("T", 7.0, "N")]),
        ];
        let records: Records = records.into_iter().collect();
        let found = ensembles(&records);
        assert_eq!(found.len(), 2);
        assert_eq!((found[0].len(), found[0].repeated, found[0].count(Failed)), (4, 1, 1));
        let results = found[0].results();
        assert_eq!((results[0].name.as_str(), results[0].unit.as_str()), ("T", "kN"));
        assert_eq!((results[0].values.as_slice(), results[0].missing), (&[5.0, 6.0][..], 1));
        assert_eq!((results[1].values.as_slice(), results[1].missing), (&[1.0][..], 2));
        assert_eq!(results.len(), 2);
        assert_eq!(found[1].cases().map(|case| case.case()).collect::<Vec<_>>(), ["b1"]);
    }

    #[test]
    fn tensions_of_segments_are_results_once_a_case() {
        let row = |segment, largest, least| LineRow {
            line: "L1".into(),
            segment: Some(segment),
            largest_tension: Some(largest),
            least_tension: least,
            ..LineRow::default()
        };
        let mut records = [1, 2].map(|seed| case(&format!("a{seed}"), ("9", "1", seed), CaseStatus::Done, &[]));
        records[0].lines = vec![row(1, 5.0, Some(1.0)), row(2, 4.0, None), row(1, 5.0, Some(1.0))];
        records[1].lines = vec![row(1, 6.0, Some(0.5))];
        let records: Records = records.into_iter().collect();
        let found = ensembles(&records)[0].results();
        let found: Vec<_> = found.iter().map(|r| (r.name.as_str(), r.is_least, r.values.clone(), r.missing)).collect();
        assert_eq!(
            found,
            [
                ("tension of L1 1", false, vec![5.0, 6.0], 0),
                ("tension of L1 2", false, vec![4.0], 1),
                ("tension of L1 1", true, vec![1.0, 0.5], 0)
            ]
        );
    }
}
