//! What a mooring line does to what it is attached to: exactly, or from its table.

use super::mooring::{Mooring, line_error};
use windlass_catenary::{FromTable, Interpolated, LineError, SeabedModel};
use windlass_model::Note;
use windlass_model::{ClassError, Condition, LineChange, LineLoads};

impl Mooring {
    /// The loads of the exact solution.
    ///
    /// # Errors
    /// A line for which no configuration could be proven.
    pub fn exact_loads(&self) -> Result<LineLoads, ClassError> {
        let (distance, along) = self.distance_and_direction()?;
        let state = match self.state(Condition::Placed) {
            Ok(state) => state,
            Err(error) => return self.slack_loads(distance).ok_or(error),
        };
        let (ratio, critical) = self.ratio(&state);
        let kept = state.stiffness;
        let across = if distance > 0.0 { state.force / distance } else { kept[0][0] };
        Ok(LineLoads {
            fairlead: [state.force * along[0], state.force * along[1], -state.top_vertical],
            other: [-state.anchor_horizontal * along[0], -state.anchor_horizontal * along[1], state.anchor_vertical],
            stiffness: stiffness(along, kept, across),
            distance,
            tension: state.top_tension,
            ratio,
            critical,
            over_given_break: self.over_given_break(&state),
            grounded: state.grounded,
            solution: "exact",
            notes: self.remarks(&state),
        })
    }

    /// The loads by interpolation in the table of thirty points at the elevation of its fairlead; nearer than its first row those of
    /// the exact solution.
    ///
    /// # Errors
    /// A line for which no table could be made; no exact solution, nearer than the first row.
    pub fn tabled_loads(&self) -> Result<LineLoads, ClassError> {
        let (rows, missing) = self.rows()?;
        let (distance, along) = self.distance_and_direction()?;
        if rows.first().is_some_and(|first| distance < first.state.x) {
            let mut loads = self.exact_loads()?;
            loads.notes.push("nearer than the first row of its table, and solved exactly there".into());
            return Ok(loads);
        }
        let table = Interpolated::new(&rows).map_err(|e| self.error(&e))?;
        let FromTable { forces, grounded, ratio, critical, beyond } = table.evaluate(distance, &rows);
        let ([force, vertical], [anchor_horizontal, anchor_vertical]) = (forces.fairlead, forces.anchor);
        let mut notes = self.notes.clone();
        if !missing.is_empty() {
            let numbers: Vec<String> = missing.iter().map(|row| row.number.to_string()).collect();
            notes
                .push(format!("rows of its table without a configuration are left out: {}", numbers.join(", ")).into());
        }
        if beyond {
            notes.push(Note::warning("beyond the table; its last slope is continued"));
        }
        if rows.iter().any(|r| !r.state.below_bottom.is_empty()) {
            notes.push(Note::warning(
                "a segment above the spring buoy hangs below the bottom in some rows of its table",
            ));
        }
        if ratio > 1.0 {
            notes.push(Note::warning("the line is beyond its breaking tension"));
        }
        let across = if distance > 0.0 { force / distance } else { forces.stiffness[0][0] };
        Ok(LineLoads {
            fairlead: [force * along[0], force * along[1], -vertical],
            other: [-anchor_horizontal * along[0], -anchor_horizontal * along[1], anchor_vertical],
            stiffness: stiffness(along, forces.stiffness, across),
            distance,
            tension: force.hypot(vertical),
            ratio,
            critical,
            over_given_break: self
                .breaks_given
                .get(critical.saturating_sub(1))
                .and_then(|g| g.then_some((ratio, critical))),
            grounded,
            solution: "table",
            notes,
        })
    }

    /// The mooring with a change of its line or of the bottom.
    ///
    /// # Errors
    /// A change of what it does not have.
    pub fn with_change(&self, change: LineChange) -> Result<Mooring, ClassError> {
        let line = self.line.clone();
        let floor = |of: fn(f64, SeabedModel) -> SeabedModel, value: f64| {
            line.floor().map(|f| of(value, f)).ok_or_else(|| ClassError::new("the line sees no bottom"))
        };
        let mut profile = self.profile.clone();
        let made = match change {
            LineChange::Friction(value) => {
                let floor = floor(|friction, f| SeabedModel { friction, ..f }, value)?;
                profile = profile.map(|p| p.with_friction(value));
                match &profile {
                    Some(profile) => profile.lay(line),
                    None => line.with_seabed(Some(floor)),
                }
            }
            LineChange::Slope(value) => {
                let floor = floor(|slope, f| SeabedModel { slope, ..f }, value)?;
                profile = None;
                line.with_seabed(Some(floor))
            }
            LineChange::Weight(factor) => line.with_factors(factor, 1.0).unwrap_or(Err(LineError::Empty)),
            LineChange::Stiffness(factor) => line
                .with_factors(1.0, factor)
                .ok_or_else(|| ClassError::new("the line stretches by a law of its own, not by one stiffness"))?,
        };
        Ok(Mooring { line: made.map_err(|e| line_error(&e, &self.positions))?, profile, ..self.clone() })
    }

    /// A weightless line that is not tight: no force.
    fn slack_loads(&self, distance: f64) -> Option<LineLoads> {
        let z = self.fairlead();
        let limp = self.weightless() && matches!(self.line.at_distance(distance, z), Err(LineError::Undetermined));
        limp.then(|| LineLoads {
            fairlead: [0.0; 3],
            other: [0.0; 3],
            stiffness: [[0.0; 3]; 3],
            distance,
            tension: 0.0,
            ratio: 0.0,
            over_given_break: None,
            critical: 1,
            grounded: 0.0,
            solution: "exact",
            notes: self.notes.clone(),
        })
    }
}

/// d(force on the first end)/d(its position): `k` is d(H, V)/d(x, z), `across` H over the distance.
fn stiffness(along: [f64; 2], k: [[f64; 2]; 2], across: f64) -> [[f64; 3]; 3] {
    let [ux, uy] = along;
    let [[xx, xz], [zx, zz]] = k;
    let plane = |a: f64, b: f64, same: f64| -xx * a * b - across * (same - a * b);
    [
        [plane(ux, ux, 1.0), plane(ux, uy, 0.0), xz * ux],
        [plane(ux, uy, 0.0), plane(uy, uy, 1.0), xz * uy],
        [zx * ux, zx * uy, -zz],
    ]
}
