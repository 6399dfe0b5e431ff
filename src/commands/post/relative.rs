//! `REL_MOTION` and `P_MIN_DISTANCE` of the PRCPOST menu: how points move relative to each other.

use crate::commands::Command;
use crate::commands::name_filter::NameFilter;
use crate::commands::post::points::track;
use crate::commands::post::prcpost::{EVENTS, MAG_DEFINE, PostQuery, show, spec};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::Table;
use windlass_base::values::{Noun, Value};
use windlass_language::spec::{CommandSpec, DatumKey, Kind, ValueSpec};
use windlass_model::{EntityKind, find};
use windlass_solve::results::{self, TrackedPoint};

/// REL_MOTION.
pub static REL_MOTION: Command =
    Command { spec: &REL_MOTION_SPEC, edits: false, run: |job, call| show(job, call, relative) };
/// P_MIN_DISTANCE.
pub static P_MIN_DISTANCE: Command =
    Command { spec: &DISTANCE_SPEC, edits: false, run: |job, call| show(job, call, least) };

/// Most pairs of points whose distance is sought.
const MAX_PAIRS: usize = 100_000;

static REL_MOTION_SPEC: CommandSpec = CommandSpec {
    options: &[EVENTS, MAG_DEFINE],
    repeat: 2,
    detail: "Of each pair of points the location, velocity and acceleration of the first less those of the second, global axes (our reading of \
             which is taken from which). Points need not be marked by INTEREST. Points are taken where they stand in their bodies now.",
    ..spec(
        "REL_MOTION",
        &[
            ValueSpec::new("*A", Kind::Name(Noun::Point), "a point"),
            ValueSpec::new("*B", Kind::Name(Noun::Point), "the point whose motion is taken off; further pairs follow"),
        ],
        "motions of points relative to other points",
    )
};

static DISTANCE_SPEC: CommandSpec = CommandSpec {
    options: &[EVENTS, MAG_DEFINE],
    detail: "The distance of two points, its rate, and the vector from the second to the first; with patterns or selectors that of the two points, \
             one of each set, that are nearest at each event (our reading). -MAG_DEFINE takes the distance in a plane or along an axis. The least \
             of the events stands above the table.",
    ..spec(
        "P_MIN_DISTANCE",
        &[
            ValueSpec::new("*A", Kind::Name(Noun::Selector), "a point, pattern or selector").among(&[Noun::Point]),
            ValueSpec::new("*B", Kind::Name(Noun::Selector), "points they are measured from").among(&[Noun::Point]),
        ],
        "least distances of points",
    )
};

fn relative(query: &PostQuery) -> Outcome<Table> {
    let model = &query.job.model;
    let tracked = |value: &Value| -> Outcome<TrackedPoint> {
        track(query, find(&model.points, value.word().unwrap_or_default(), "point", value.span)?)
    };
    const FIRST: DatumKey<str> = REL_MOTION_SPEC.word("*A");
    let mut pairs = Vec::new();
    for pair in query.args().groups_from(FIRST) {
        let points = [pair.value(FIRST), pair.value(const { REL_MOTION_SPEC.word("*B") })];
        let [Some(first), Some(second)] = points.map(|value| value.filter(|value| value.is_given())) else {
            return Err(Diagnostic::error("a point without another to be relative to", pair.position(FIRST))
                .help("form: REL_MOTION *A *B [*A *B ..]"));
        };
        pairs.push([tracked(first)?, tracked(second)?]);
    }
    query.to_outcome(results::relative_motions(query.run, &pairs, query.magnitude(), &query.events()?))
}

fn least(query: &PostQuery) -> Outcome<Table> {
    let model = &query.job.model;
    let [first, rest @ ..] = query.args().data.as_slice() else {
        return Err(Diagnostic::error("P_MIN_DISTANCE takes two points", query.span()));
    };
    let set = |values: &[Value]| -> Outcome<Vec<TrackedPoint>> {
        let chosen = NameFilter::new(values, model);
        let points: Vec<_> = model.points.values().filter(|point| chosen.matches(&point.name)).collect();
        chosen.check_used("the points", &[EntityKind::Point])?;
        points.into_iter().map(|point| track(query, point)).collect()
    };
    let (first, second) = (set(std::slice::from_ref(first))?, set(rest)?);
    let pairs = first.len().saturating_mul(second.len());
    if pairs > MAX_PAIRS {
        return Err(Diagnostic::error(format!("{pairs} pairs of points are more than {MAX_PAIRS}"), query.span()));
    }
    query.to_outcome(results::least_distance(query.run, [&first, &second], query.magnitude(), &query.events()?))
}
