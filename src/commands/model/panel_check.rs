//! `G_PRESSURE -CHECK`: what the panels and the results of them are worth: the panels of each body at their worst, the relations that exact results
//! fulfil, and the change of every result with a finer mesh.

use crate::commands::Job;
use crate::commands::model::panel_forces::{MeshedBodies, PanelRequest, Quality, solve_bodies};
use nalgebra::Matrix6;
use std::f64::consts::TAU;
use windlass_base::diagnostic::Outcome;
use windlass_base::span::Span;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_hydro::database::checks::MODES;
use windlass_model::{Amplitudes, Database};

/// Sides of the finer panels over those of the present ones, where panels divide all: twice as many. Sides are divided by whole panels, so that smaller ones
/// follow, by steps, until there are as many.
const FINER: f64 = std::f64::consts::FRAC_1_SQRT_2;
const FINER_STEP: f64 = 0.97;
const MAX_FINER_TRIES: usize = 40;
/// Panels of the finer mesh over those of the present one, at least.
const MORE_PANELS: f64 = 2.0;
/// A corner out of the plane of its panel by more than this share of the diagonal is warned of.
const CROOKED: f64 = 0.05;
/// Panels with a longer diagonal over the root of twice their area are warned of: sides of one to eight.
const SLENDER: f64 = 2.0;
/// A part of the solid angle of a sphere that is open: more is warned of.
const OPEN: f64 = 0.01;
/// Differences over the largest result that are warned of: of Haskind's relation, energy, symmetry and the finer mesh.
const POOR: f64 = 0.05;
/// Results below this share of the largest of their kind are nothing: planes of symmetry.
const NOTHING: f64 = 1e-4;

/// A result over all periods: its name, the largest of it and its largest change (SI).
struct Change {
    name: String,
    kind: &'static str,
    largest: f64,
    change: f64,
    /// At which frequency (rad/s).
    at: f64,
}

/// Checks what was computed of bodies, and shows it.
///
/// # Errors
/// An interrupt; a finer mesh that cannot be solved.
pub fn check(
    job: &mut Job,
    names: &[String],
    request: &PanelRequest,
    meshed: &MeshedBodies,
    (databases, quality): (&[Database], &Quality),
) -> Outcome<()> {
    let span = request.span;
    let mesh = mesh_table(job, meshed, span);
    job.say_tables(&[mesh]);
    let (finer, finer_meshed) = match finer_mesh(job, names, request, meshed) {
        Ok(finer) => finer,
        Err(error) => {
            job.warn(format!("{}: no finer mesh: {}", meshed.names(), error.message), span);
            let table = relations_table(meshed, quality, None);
            job.say_tables(&[table]);
            return Ok(());
        }
    };
    let finer = solve_bodies(job, &finer_meshed, &finer)?;
    let mut changes = Vec::new();
    for ((body, own), other) in meshed.bodies.iter().zip(databases).zip(&finer) {
        changes.extend(body_changes(&body.name, own, other));
    }
    let worst = worst_by_frequency(meshed, databases, &finer);
    let relations = relations_table(meshed, quality, Some(&worst));
    let table = change_table(meshed, &finer_meshed, &changes);
    if let Some(change) = changes
        .iter()
        .filter(|change| change.change > POOR * change.largest)
        .max_by(|a, b| (a.change / a.largest).total_cmp(&(b.change / b.largest)))
    {
        let text = format!(
            "{} {} changes by {:.1} % with panels of {:.2} m: the panels are too large for it",
            change.kind,
            change.name,
            100.0 * change.change / change.largest,
            finer_meshed.size
        );
        job.warn(format!("{}: {text}", meshed.names()), span);
    }
    let largest = |list: &[f64]| list.iter().copied().fold(0.0, f64::max);
    for (difference, what) in [
        (largest(&quality.energy), "radiation damping differs from the energy of the waves far away"),
        (largest(&quality.asymmetry), "added mass or damping is not symmetric: it differs from its transpose"),
    ] {
        if difference > POOR {
            job.warn(format!("{}: {what} by {:.1} % of the largest", meshed.names(), 100.0 * difference), span);
        }
    }
    job.say_tables(&[relations, table]);
    Ok(())
}

/// The mesh with twice as many panels, or with what memory has room for.
///
/// # Errors
/// Not one that is finer.
fn finer_mesh(
    job: &Job,
    names: &[String],
    request: &PanelRequest,
    meshed: &MeshedBodies,
) -> Outcome<(PanelRequest, MeshedBodies)> {
    let made = |size: f64| {
        let finer = PanelRequest {
            headings: request.headings.clone(),
            periods: meshed.frequencies.iter().map(|w| TAU / w).collect(),
            size: Some(size),
            edge_share: meshed.edge_share,
            depth: request.depth,
            lids: request.lids.clone(),
            has_drift: request.has_drift,
            is_checked: false,
            kept: None,
            span: request.span,
        };
        MeshedBodies::new(&job.model, names, &finer).map(|meshed| (finer, meshed))
    };
    let wanted = (MORE_PANELS * meshed.panel_count() as f64) as usize;
    let mut size = FINER * meshed.size;
    let mut best = made(three_digits(size))?;
    for _ in 0..MAX_FINER_TRIES {
        if best.1.panel_count() >= wanted {
            break;
        }
        size *= FINER_STEP;
        match made(three_digits(size)) {
            Ok(next) => best = next,
            // more than memory
            Err(_) => break,
        }
    }
    Ok(best)
}

/// A length to three digits, with which a run can be made again.
fn three_digits(length: f64) -> f64 {
    let digit = 10_f64.powf(length.log10().floor() - 2.0);
    let rounded = (length / digit).round() * digit;
    if rounded.is_finite() { rounded } else { length }
}

/// The panels of each body at their worst.
fn mesh_table(job: &mut Job, meshed: &MeshedBodies, span: Span) -> Table {
    let shortest = meshed.shortest_wave();
    let rows = meshed.qualities();
    for (name, quality, _) in &rows {
        let mut warn = |text: String| job.warn(format!("{name}: {text}"), span);
        if !quality.turned.is_empty() {
            let list: Vec<String> = quality.turned.iter().take(5).map(usize::to_string).collect();
            warn(format!("panels face into the hull: {} of them, the first {}", quality.turned.len(), list.join(" ")));
        }
        if quality.opening > OPEN {
            warn(format!(
                "its panels leave {:.1} % of the sphere about a point beside one open",
                100.0 * quality.opening
            ));
        }
        if quality.crookedness > CROOKED {
            warn(format!(
                "a corner is {:.1} % of the diagonal out of the plane of its panel",
                100.0 * quality.crookedness
            ));
        }
        if quality.slenderness > SLENDER {
            warn(format!("a panel is slender: its diagonal is {:.1} times that of a square", quality.slenderness));
        }
    }
    let mut table = Table::new(format!("Panels of {}", meshed.names()))
        .with_rows(&rows)
        .text("Body", |row| row.0.as_str())
        .column("", "Panels", Dim::None, Digits::Usual, |row| row.2)
        .column("Size", "Least", Dim::Length, Digits::Decimals(2), |row| row.1.sizes[0])
        .column("Size", "Largest", Dim::Length, Digits::Decimals(2), |row| row.1.sizes[1])
        .column("", "Panels a Wave", Dim::None, Digits::Decimals(1), |row| shortest / row.1.sizes[1])
        .column("", "Crooked", Dim::None, Digits::Decimals(3), |row| 100.0 * row.1.crookedness)
        .column("", "Slender", Dim::None, Digits::Decimals(2), |row| row.1.slenderness)
        .column("", "Inside Out", Dim::None, Digits::Usual, |row| row.1.turned.len())
        .column("", "Open", Dim::None, Digits::Decimals(3), |row| 100.0 * row.1.opening)
        .build();
    table.note("Size: diagonal over the root of 2; Panels a Wave: of the shortest wave, by the largest panel");
    table.note("Crooked: farthest corner from the plane of its panel, per cent of the diagonal; Slender: diagonal over that of a square of the same area");
    table.note("Inside Out: panels that face into the hull; Open: solid angle beside a panel that the others leave open, per cent of a sphere");
    table
}

/// Largest changes of a frequency over the largest result of its kind: added mass, damping, exciting forces, drift.
type WorstChange = [f64; 4];

/// The relations that exact results fulfil, and the changes with a finer mesh, period by period.
fn relations_table(meshed: &MeshedBodies, quality: &Quality, worst: Option<&[WorstChange]>) -> Table {
    let at = |list: &[f64], i: usize| list.get(i).map_or(f64::NAN, |value| 100.0 * value);
    let rows: Vec<usize> = (0..meshed.frequencies.len()).rev().collect();
    let period = |i: usize| meshed.frequencies.get(i).map_or(f64::NAN, |w| TAU / w);
    let mut builder = Table::new(format!("Relations of {}", meshed.names()))
        .with_rows(&rows)
        .column("", "Period", Dim::Time, Digits::Decimals(2), |i| period(*i))
        .column("Relations", "Haskind", Dim::None, Digits::Decimals(3), |i| 100.0 * quality.haskind(*i))
        .column("Relations", "Energy", Dim::None, Digits::Decimals(3), |i| at(&quality.energy, *i))
        .column("Relations", "Symmetry", Dim::None, Digits::Decimals(3), |i| at(&quality.asymmetry, *i));
    if let Some(worst) = worst {
        for (which, name) in ["Added Mass", "Damping", "Force", "Drift"].into_iter().enumerate() {
            builder = builder.column("Change with Finer Panels", name, Dim::None, Digits::Decimals(3), move |i| {
                worst.get(*i).and_then(|all| all.get(which)).map_or(f64::NAN, |value| 100.0 * value)
            });
        }
    }
    let mut table = builder.build();
    table
        .note("per cent of the largest of its kind; Haskind: of exciting forces by pressure and by Haskind's relation");
    table.note("Energy: of damping and the energy of the waves far away; Symmetry: of added mass and damping and their transposes");
    table
}

/// The change of every result.
fn change_table(meshed: &MeshedBodies, finer: &MeshedBodies, changes: &[Change]) -> Table {
    let mut table = Table::new(format!("Change of Results of {}", meshed.names()))
        .with_rows(changes)
        .text("Kind", |row| row.kind)
        .text("Result", |row| row.name.as_str())
        .column("", "Largest", Dim::None, Digits::Scientific(4), |row| row.largest)
        .column("", "Change", Dim::None, Digits::Decimals(3), |row| 100.0 * row.change / row.largest)
        .column("", "Period", Dim::Time, Digits::Decimals(2), |row| TAU / row.at)
        .build();
    table = table.fact("Size of Panels", meshed.size, Dim::Length);
    table = table.fact("Finer Panels", finer.size, Dim::Length);
    table = table.fact("Panels", meshed.panel_count(), Dim::None);
    table = table.fact("Panels of the Finer Mesh", finer.panel_count(), Dim::None);
    table.note("Largest in kg, N, m, s and rad; Change: largest over the periods, per cent of it, at the period given");
    // errors that go as the inverse of the number of panels differ by the change
    let [own, more] = [meshed.panel_count(), finer.panel_count()].map(|panels| panels as f64);
    let left = own / (more - own);
    if left.is_finite() && left > 0.0 {
        table.note(format!(
            "the error falls as the square of the panel size: that of these results is about {:.1} times the change, that of the finer panels {left:.1} times",
            1.0 + left
        ));
    }
    table
}

/// The results of a body that are not nothing, with their changes.
fn body_changes(name: &str, own: &Database, other: &Database) -> Vec<Change> {
    let mut list = Vec::new();
    let frequencies = &own.frequencies;
    let mode = |i: usize| MODES.get(i).copied().unwrap_or_default();
    for (kind, one, two) in
        [("added mass", &own.added_mass, &other.added_mass), ("damping", &own.damping, &other.damping)]
    {
        let size = |i: usize, j: usize| one.iter().map(|m| m[(i, j)].abs()).fold(0.0, f64::max);
        for i in 0..6 {
            for j in i..6 {
                let largest = size(i, j);
                if largest <= NOTHING * (size(i, i) * size(j, j)).sqrt() || largest == 0.0 {
                    continue;
                }
                let pairs = one.iter().zip(two).map(|(a, b)| (a[(i, j)] - b[(i, j)]).abs());
                list.push(largest_change(format!("{name} {}-{}", mode(i), mode(j)), kind, largest, pairs, frequencies));
            }
        }
    }
    let all = |data: &Database, i: usize| -> Vec<f64> {
        data.excitation.iter().flatten().filter_map(|six| six.get(i)).map(|x| x.norm()).collect()
    };
    let peak = |i: usize| all(own, i).into_iter().fold(0.0, f64::max);
    for i in 0..6 {
        let kind = if i < 3 { 0..3 } else { 3..6 };
        let largest = peak(i);
        if largest <= NOTHING * kind.map(peak).fold(0.0, f64::max) {
            continue;
        }
        let off = (0..frequencies.len()).map(|w| {
            let rows = own.excitation.iter().zip(&other.excitation);
            let one =
                |(a, b): (&Vec<Amplitudes>, &Vec<Amplitudes>)| Some((a.get(w)?.get(i)? - b.get(w)?.get(i)?).norm());
            rows.filter_map(one).fold(0.0, f64::max)
        });
        list.push(largest_change(format!("{name} {}", mode(i)), "exciting force", largest, off, frequencies));
    }
    if let (Some(one), Some(two)) = (&own.drift, &other.drift) {
        let peak = |i: usize| one.values.iter().flatten().map(|six| six[i].abs()).fold(0.0, f64::max);
        for i in [0, 1, 5] {
            let largest = peak(i);
            if largest <= NOTHING * peak(0).max(peak(1)) {
                continue;
            }
            let off = (0..frequencies.len()).map(|w| {
                let rows = one.values.iter().zip(&two.values);
                rows.filter_map(|(a, b)| Some((a.get(w)?[i] - b.get(w)?[i]).abs())).fold(0.0, f64::max)
            });
            list.push(largest_change(format!("{name} {}", mode(i)), "mean drift", largest, off, frequencies));
        }
    }
    list
}

fn largest_change(
    name: String,
    kind: &'static str,
    largest: f64,
    changes: impl Iterator<Item = f64>,
    frequencies: &[f64],
) -> Change {
    let worst = changes.zip(frequencies).max_by(|a, b| a.0.total_cmp(&b.0));
    let (change, at) = worst.map_or((0.0, f64::NAN), |(change, at)| (change, *at));
    Change { name, kind, largest, change, at }
}

/// Frequency by frequency, of all bodies.
fn worst_by_frequency(meshed: &MeshedBodies, own: &[Database], other: &[Database]) -> Vec<WorstChange> {
    let mut worst = vec![WorstChange::default(); meshed.frequencies.len()];
    for (own, other) in own.iter().zip(other) {
        let kinds = [
            matrix_changes(&own.added_mass, &other.added_mass),
            matrix_changes(&own.damping, &other.damping),
            force_changes(own, other),
            drift_changes(own, other),
        ];
        for (which, of_kind) in kinds.iter().enumerate() {
            for (row, found) in worst.iter_mut().zip(of_kind) {
                row[which] = row[which].max(*found);
            }
        }
    }
    worst
}

/// Largest changes frequency by frequency, over the largest result of each of some groups.
struct Groups {
    largest: [f64; 3],
    changes: Vec<[f64; 3]>,
}

impl Groups {
    fn new(frequencies: usize) -> Self {
        Groups { largest: [0.0; 3], changes: vec![[0.0; 3]; frequencies] }
    }

    fn add(&mut self, at: usize, group: usize, size: f64, change: f64) {
        self.largest[group] = self.largest[group].max(size);
        if let Some(row) = self.changes.get_mut(at) {
            row[group] = row[group].max(change);
        }
    }

    fn shares(&self) -> Vec<f64> {
        let share = |row: &[f64; 3]| {
            let groups = row.iter().zip(&self.largest).filter(|(_, largest)| **largest > 0.0);
            groups.map(|(change, largest)| change / largest).fold(0.0, f64::max)
        };
        self.changes.iter().map(share).collect()
    }
}

/// Of matrices: forces by translations, moments by rotations and what couples them apart.
fn matrix_changes(own: &[Matrix6<f64>], other: &[Matrix6<f64>]) -> Vec<f64> {
    let mut groups = Groups::new(own.len());
    for (at, (a, b)) in own.iter().zip(other).enumerate() {
        for i in 0..6 {
            for j in 0..6 {
                let group = usize::from(i > 2) + usize::from(j > 2);
                groups.add(at, group, a[(i, j)].abs(), (a[(i, j)] - b[(i, j)]).abs());
            }
        }
    }
    groups.shares()
}

/// Of exciting forces and moments.
fn force_changes(own: &Database, other: &Database) -> Vec<f64> {
    let mut groups = Groups::new(own.frequencies.len());
    for (a, b) in own.excitation.iter().zip(&other.excitation) {
        for (at, (a, b)) in a.iter().zip(b).enumerate() {
            for (i, (a, b)) in a.iter().zip(b).enumerate() {
                groups.add(at, usize::from(i > 2), a.norm(), (a - b).norm());
            }
        }
    }
    groups.shares()
}

/// Of mean drift in surge and sway.
fn drift_changes(own: &Database, other: &Database) -> Vec<f64> {
    let mut groups = Groups::new(own.frequencies.len());
    let (Some(own), Some(other)) = (&own.drift, &other.drift) else { return Vec::new() };
    for (a, b) in own.values.iter().zip(&other.values) {
        for (at, (a, b)) in a.iter().zip(b).enumerate() {
            for i in [0, 1] {
                groups.add(at, 0, a[i].abs(), (a[i] - b[i]).abs());
            }
        }
    }
    groups.shares()
}
