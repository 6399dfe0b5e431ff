//! Pages between the tethers and the motion: initial position, time integration, Morison multipliers, nodes asked for.

use super::{Column, FREEDOMS, THREE_DECIMALS, WHOLE, fact, format_fixed};
use crate::Deck;
use crate::job::Program;
use crate::printing::PrintedNode;
use nalgebra::Rotation3;
use std::f64::consts::TAU;
use windlass_base::table::{Cell, Digits, Table};
use windlass_base::units::Dim;

/// The scheme of a structure with tethers, which is that of AQWA, and the one of a run without tethers.
const SCHEMES: [&str; 2] =
    ["TWO-STAGE PREDICTOR-CORRECTOR WITH THIRD ORDER ERRORS", "IMPLICIT, GENERALISED-ALPHA, SPECTRAL RADIUS 0.900"];
/// Frequencies (rad/s) for which the listing has the errors of the integration.
const ERROR_FREQUENCIES: [f64; 14] = [0.02, 0.03, 0.05, 0.07, 0.1, 0.15, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 5.0];
/// Errors beyond this (per cent, degrees) are listed as `10+`.
const LARGEST_LISTED_ERROR: f64 = 10.0;
/// What AQWA 5.4 prints as the limits of its error estimate for tubes, and as the constants of its Reynolds numbers; nothing here uses them.
const AQWA_LIMITS: [(&str, &str); 6] = [
    ("SIGNIFICANT FROUDE NUMBER SQUARED", "0.040"),
    ("VELOCITY PROFILE RATIO", "0.100"),
    ("VELOCITY ALIGNMENT ANGLE", "5.730"),
    ("SCALE FACTOR", "1.000"),
    ("KINEMATIC VISCOSITY", "1.570E-06"),
    ("UNIT REYNOLDS NUMBER", "6.369E+05"),
];

impl Deck {
    pub(super) fn start_pages(&self) -> Vec<Table> {
        let mut list = vec![self.position_table()];
        list.extend(self.steps.map(|steps| self.integration_table(steps.count.value, steps.step.value, steps.start)));
        // a run without tethers measures the errors of its own scheme
        list.extend(self.steps.filter(|_| self.has_tethers()).map(|steps| error_table(steps.step.value)));
        list.extend([self.multiplier_table(), aqwa_limit_table()]);
        if !self.printing.nodes.is_empty() {
            list.push(self.node_table());
        }
        list
    }

    /// Positions and velocities at the start; DRIF lists them for slow drift (S) and in total (T), which are the same here.
    fn position_table(&self) -> Table {
        let kinds: &[&str] = if self.job.program == Program::Drift { &[" (S)", " (T)"] } else { &[""] };
        let (mut numbers, mut names) = (Vec::new(), Vec::new());
        let mut positions: [Vec<Option<f64>>; 6] = Default::default();
        let mut cosines: [Vec<Option<f64>>; 3] = Default::default();
        for structure in &self.structures {
            let position = self.start(structure);
            let given = self.starts.iter().find(|start| start.structure == structure.number && start.velocity);
            let velocity = given.map_or([0.0; 6], |start| start.values);
            let [_, _, _, rx, ry, rz] = position.map(f64::to_radians);
            let turn = Rotation3::from_euler_angles(rx, ry, rz);
            for kind in kinds {
                for row in 0..4 {
                    let (first, values) = if row == 3 { ("VELOCITY", velocity) } else { ("POSITION", position) };
                    let headed = row == 0 || row == 3;
                    numbers.push(headed.then_some(structure.number));
                    names.push(if headed { format!("{first}{kind}") } else { String::new() });
                    for (list, value) in positions.iter_mut().zip(values) {
                        list.push(headed.then_some(value));
                    }
                    for (axis, list) in cosines.iter_mut().enumerate() {
                        list.push((row < 3).then(|| turn.matrix()[(row.min(2), axis)]));
                    }
                }
            }
        }
        let mut columns = vec![
            Column::new("STRUCTURE", "NUMBER", Dim::None, WHOLE, numbers),
            Column::new("", "PARAMETER", Dim::None, Digits::Usual, names),
        ];
        for ((index, name), values) in FREEDOMS.into_iter().enumerate().zip(positions) {
            let group = if index < 3 { "TRANSLATIONS (FRA)" } else { "ROTATIONS (FRA)" };
            columns.push(Column::new(group, name, Dim::None, THREE_DECIMALS, values));
        }
        for (name, values) in FREEDOMS.into_iter().zip(cosines) {
            columns.push(Column::new("DIRECTION COSINES", name, Dim::None, Digits::Decimals(4), values));
        }
        let mut table = Table::from_columns("Initial Position and Velocity of the Centre of Gravity", columns);
        if kinds.len() > 1 {
            table.note(
                "(S) = SLOW DRIFT MOTION, (T) = TOTAL MOTION (I.E. SLOW DRIFT AND WAVE FREQUENCY MOTION COMBINED)",
            );
        }
        table
    }

    fn integration_table(&self, count: i64, step: f64, start: f64) -> Table {
        let mut table = Table::new("Time Integration Parameters");
        let [with_tethers, without] = SCHEMES;
        let scheme = if self.has_tethers() { with_tethers } else { without };
        if !self.has_tethers() {
            table.note(
                "TDOM of windlass runs a deck without tethers; it reports the largest errors of its steps and periods",
            );
        }
        let table = fact(table, "INTEGRATION SCHEME", scheme.into());
        let table = fact(table, "STARTING RECORD NUMBER", "1".into());
        let table = fact(table, "NUMBER OF TIME STEPS", count.to_string());
        let table = fact(table, "PRESENT TIME STEP", format_fixed(step, 3));
        fact(table, "PRESENT TIME", format_fixed(start, 3))
    }

    fn has_tethers(&self) -> bool {
        !self.mooring.tethers.is_empty()
    }

    fn multiplier_table(&self) -> Table {
        let rows: Vec<_> = self.structures.iter().map(|s| (s.number, self.multipliers(s.number))).collect();
        let group = "MULTIPLYING FACTORS FOR HYDRODYNAMIC PARAMETERS";
        Table::new("Parameters Affecting Hydrodynamic Morison Element Forces")
            .with_rows(&rows)
            .column("", "STRUCTURE", Dim::None, WHOLE, |(number, _)| *number)
            .columns(group, ["DRAG", "ADDED MASS", "SLAM"], Dim::None, Digits::Decimals(2), |(_, m)| {
                [m.drag, m.added_mass, m.slam]
            })
            .build()
    }

    fn node_table(&self) -> Table {
        let position = |printed: &PrintedNode| {
            let structure = self.structure(printed.structure.value)?;
            self.node_position(structure, printed.node.value)
        };
        let centre = |printed: &PrintedNode| {
            let [x, y, z, ..] = self.start(self.structure(printed.structure.value)?);
            Some([x, y, z])
        };
        let rows: Vec<_> =
            self.printing.nodes.iter().map(|printed| (printed, position(printed), centre(printed))).collect();
        let axes = ["X", "Y", "Z"];
        Table::new("Position of User-Requested Nodes")
            .with_rows(&rows)
            .column("STRUCTURE", "NUMBER", Dim::None, WHOLE, |(printed, _, _)| printed.structure.value)
            .column("NODE", "NUMBER", Dim::None, WHOLE, |(printed, _, _)| printed.node.value)
            .text("", |_| "POSITION")
            .columns("WITH RESPECT TO THE FIXED REFERENCE AXES", axes, Dim::None, THREE_DECIMALS, |(_, position, _)| {
                position.map_or([None; 3], |p| p.map(Some))
            })
            .columns("RELATIVE TO THE CENTRE OF GRAVITY", axes, Dim::None, THREE_DECIMALS, |(_, position, centre)| {
                match (position, centre) {
                    (Some(p), Some(c)) => [0, 1, 2].map(|i| Some(p[i] - c[i])),
                    _ => [None; 3],
                }
            })
            .build()
    }
}

/// Amplitude (per cent) and phase (degrees) that a sinusoidal motion of a frequency times the step loses in a cycle.
///
/// The scheme of a structure, `x' = x + v h + (2 a1 + a2) h^2/6` and `v' = v + (a1 + a2) h/2`, with `a = -w^2 x`, is a linear map of a step; its
/// eigenvalues have the modulus and the angle of a step. The phase errors are those of the listing, but 3.5 degrees for its 3.4 at 2 rad/s. Its amplitude
/// errors are about a quarter of these: what they are of is not known.
fn cycle_errors(angle: f64) -> [f64; 2] {
    let square = angle * angle;
    let determinant = 1.0 - square * square / 12.0;
    let half_trace = 1.0 - square / 2.0 + square * square / 24.0;
    if determinant <= 0.0 || half_trace.abs() >= determinant.sqrt() {
        return [f64::INFINITY; 2];
    }
    let modulus = determinant.sqrt();
    let turned = (half_trace / modulus).acos();
    [100.0 * (1.0 - modulus.powf(TAU / angle)), 360.0 * (1.0 - turned / angle)]
}

fn error_table(step: f64) -> Table {
    let errors: Vec<(f64, [f64; 2])> = ERROR_FREQUENCIES.into_iter().map(|w| (w, cycle_errors(w * step))).collect();
    let shown = |value: f64| if value > LARGEST_LISTED_ERROR { "10+".to_string() } else { format_fixed(value, 1) };
    let title =
        format!("Expected Errors for Integration of Sinusoidal Motion for Time-Step of {}", format_fixed(step, 4));
    let cells = |of: fn(&(f64, [f64; 2])) -> f64| errors.iter().map(of).map(Cell::Number).collect::<Vec<Cell>>();
    let mut table = Table::from_columns(
        title,
        vec![
            Column::new("FREQUENCY", "(RAD/SEC)", Dim::None, Digits::Decimals(4), cells(|(w, _)| *w)),
            Column::new("PERIOD", "(SECONDS)", Dim::None, Digits::Decimals(2), cells(|(w, _)| TAU / w)),
            Column::right_aligned(
                "AMPLITUDE ERROR",
                "(PER CENT)",
                errors.iter().map(|(_, [amplitude, _])| shown(*amplitude)),
            ),
            Column::right_aligned("PHASE ERROR", "(DEGREES)", errors.iter().map(|(_, [_, phase])| shown(*phase))),
        ],
    );
    table.note("errors of a cycle; the amplitude errors are those of the scheme, of which AQWA lists about a quarter");
    table
}

fn aqwa_limit_table() -> Table {
    let table = Table::new("Hydrodynamic Error Limits and Reynolds Number Related Parameters");
    let mut table = AQWA_LIMITS.into_iter().fold(table, |table, (name, value)| fact(table, name, value.to_string()));
    table.note("as AQWA 5.4 has them; drag coefficients do not go with the Reynolds number here");
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Printed for a step of 0.25 s [AQWA-TETHER 8.1, 8.2]: phase errors in degrees.
    #[test]
    fn phase_errors_match_listing_and_amplitude_errors_are_four_times_larger() {
        let phases = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.1, 0.2, 0.5, 0.9, 2.0, 3.4];
        for (frequency, printed) in ERROR_FREQUENCIES.into_iter().zip(phases) {
            let [_, phase] = cycle_errors(0.25 * frequency);
            // printed to 0.1; 3.49 is found for 3.4
            let most = if frequency == 2.0 { 0.1 } else { 0.05 };
            assert!((phase - printed).abs() <= most, "{frequency}: {phase}");
        }
        let [amplitude, phase] = cycle_errors(0.25 * 5.0);
        assert!(amplitude > 10.0 && phase > 10.0, "{amplitude} {phase}");
        for (frequency, printed) in [(1.0, 0.1), (1.5, 0.4), (2.0, 0.9)] {
            let [amplitude, _] = cycle_errors(0.25 * frequency);
            let ratio = amplitude / printed;
            assert!((3.0..4.2).contains(&ratio), "{frequency}: {amplitude}");
        }
    }
}
