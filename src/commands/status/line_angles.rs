//! `&STATUS LINE_ANGLES`: how lines leave their fairleads and reach their anchors.

use crate::commands::status::forces::{ConnectorForces, find_forces};
use crate::commands::status::kind::StatusKind;
use windlass_base::table::{Digits, Table};
use windlass_base::units::{Dim, UnitSystem};
use windlass_model::{Connector, EntityKind, Model, add_model_column};

/// `&STATUS LINE_ANGLES`.
pub static LINE_ANGLES: StatusKind = StatusKind {
    caveats: true,
    ..StatusKind::new(
        "LINE_ANGLES",
        "angles of lines at their fairleads, and of uplift at their anchors",
        |query, _| Ok(vec![angles(query.model(), &query.fits(), query.job.units)]),
    )
    .with_names(&[EntityKind::Connector])
};

/// Uplift from which on a note names the line (rad): a tenth of a degree.
const NOTED_UPLIFT: f64 = 0.1 * std::f64::consts::PI / 180.0;

/// How a line ends.
struct LineEnds<'m> {
    name: &'m str,
    /// Tension at the fairlead (N), negative of a line that pushes.
    tension: f64,
    /// Azimuth of the line at its fairlead, and its declination from straight down (rad); none of a line that does not pull.
    fairlead: Option<[f64; 2]>,
    /// The same at the far end (N).
    anchor_tension: f64,
    /// Angle above the horizontal of the pull at the far end (rad); none of a line that does not pull.
    uplift: Option<f64>,
    grounded: Option<f64>,
}

impl<'m> LineEnds<'m> {
    /// Those of forces on the ends.
    fn new(name: &'m str, found: &ConnectorForces) -> Self {
        let [[fx, fy, fz], [ax, ay, az]] = [found.on_body(), found.on_far_end()];
        let [level, anchor_level] = [fx.hypot(fy), ax.hypot(ay)];
        let tension = level.hypot(fz);
        let pushes = found.summary.tension.is_some_and(|t| t < 0.0);
        let sign = if pushes { -1.0 } else { 1.0 };
        let is_taut = tension > 0.0 && !pushes;
        LineEnds {
            name,
            tension: sign * tension,
            fairlead: is_taut.then(|| [fy.atan2(fx).rem_euclid(std::f64::consts::TAU), level.atan2(-fz)]),
            anchor_tension: sign * anchor_level.hypot(az),
            // no pull is zero without a sign
            uplift: is_taut.then(|| az.atan2(anchor_level) + 0.0),
            grounded: found.summary.grounded,
        }
    }
}

fn angles(model: &Model, fits: &dyn Fn(&str) -> bool, units: UnitSystem) -> Table {
    let mut table = Table::new("Angles of Lines");
    let mut rows = Vec::new();
    let has_line_class =
        |class: &str| model.classes.get(&Model::key(class)).is_some_and(|class| class.object.is_line());
    let is_line = |c: &Connector| has_line_class(&c.class) || model.is_dynamic_line(c);
    for connector in model.connectors.values().filter(|c| c.active && is_line(c) && fits(&c.name)) {
        if model.holds_pipe(&connector.name) {
            continue;
        }
        match find_forces(model, connector) {
            Ok(found) => rows.push(LineEnds::new(&connector.name, &found)),
            Err(error) => table.note_absent(format!("{}: {}", connector.name, error.text(units))),
        }
    }
    let mut table = table
        .with_rows(&rows)
        .text("Name", |line| line.name)
        .column("Fairlead", "Tension", Dim::Force, Digits::Usual, |line| line.tension)
        .column("Fairlead", "Azimuth", Dim::Angle, Digits::Usual, |line| line.fairlead.map(|f| f[0]))
        .column("Fairlead", "Declination", Dim::Angle, Digits::Usual, |line| line.fairlead.map(|f| f[1]))
        .column("Anchor", "Tension", Dim::Force, Digits::Usual, |line| line.anchor_tension)
        .column("Anchor", "Uplift", Dim::Angle, Digits::Usual, |line| line.uplift)
        .column("On Bottom", "Unstretched", Dim::Length, Digits::Usual, |line| line.grounded)
        .build();
    add_model_column(&mut table, |name| model.idealisation(name));
    table.note(
        "azimuth from +X toward +Y; declination from straight down: 90 degrees are horizontal; uplift above the horizontal; \
         all from the forces on the ends",
    );
    let lifted: Vec<&str> =
        rows.iter().filter(|line| line.uplift.is_some_and(|u| u > NOTED_UPLIFT)).map(|line| line.name).collect();
    if !lifted.is_empty() {
        table.note(format!("uplift at the anchor: {}; drag anchors are rated for none", lifted.join(", ")));
    }
    table
}
