//! Data sets of Capytaine in NetCDF, classic or version 4 (HDF5): what `capytaine.io.xarray.export_dataset` writes.
//!
//! Source: [CAPYTAINE-3 Conventions, Export outputs]: amplitudes go with exp(-i w t) and the wave is `exp(i k (x cos b + y sin b))`, as here;
//! phases refer to the origin, rotations and moments to `rotation_center`; SI and radians. Complex numbers stand on a
//! dimension `complex` of two. `omega` holds zero and infinity as well. A variable that a data set lacks is left out here. A data set of
//! G_PRESSURE has `body_axes` beside: its bodies have origins and headings of their own, to which all is turned, and mean drift.

use super::checks::{MAX_DATABASE_NUMBERS, check_database};
use super::matrices::matrix;
use super::nemoh::refer_phases;
use super::rows::{DatabaseError, heading};
use nalgebra::{Complex, Matrix6, Rotation3, Vector3};
use netcdf_reader::{NcFile, NcOpenOptions};
use std::f64::consts::TAU;
use windlass_model::{Amplitudes, Database, DriftTable, Interaction, Stance};

/// A heading that is less than a whole turn by this (rad) is none.
const HEADING_ROOM: f64 = 1e-9;

/// The attribute of a data set of G_PRESSURE that tells how its mean drift was found, a line a body.
pub const DRIFT_METHOD: &str = "mean_drift_method";

/// Names of the directions in Capytaine.
const DOFS: [&str; 6] = ["SURGE", "SWAY", "HEAVE", "ROLL", "PITCH", "YAW"];

/// Which directions of a data set are those of a body: place in the data set, 0 to 5.
type BodyDirections = Vec<(usize, usize)>;

/// Body and direction of each place on a dimension, and the bodies, in their order.
type NamedDirections = (Vec<(String, String)>, Vec<String>);

/// A variable: its dimensions and its values, the last dimension the fastest.
struct Variable {
    names: Vec<String>,
    sizes: Vec<usize>,
    values: Vec<f64>,
}

impl Variable {
    /// A value by named places; zero for dimensions that are not named.
    fn value_at(&self, positions: &[(&str, usize)]) -> f64 {
        let of = |name: &str| positions.iter().find(|p| p.0 == name).map_or(0, |p| p.1);
        let index = self.names.iter().zip(&self.sizes).fold(0, |sum, (name, size)| sum * size + of(name));
        self.values.get(index).copied().unwrap_or(f64::NAN)
    }

    /// The size of a dimension; one where it has not that dimension.
    fn size(&self, name: &str) -> usize {
        self.names.iter().zip(&self.sizes).find(|(n, _)| *n == name).map_or(1, |(_, size)| *size)
    }
}

/// An open data set.
struct Set<'a> {
    source: &'a str,
    file: NcFile,
}

impl Set<'_> {
    fn error(&self, why: impl Into<String>) -> DatabaseError {
        DatabaseError::File { file: self.source.to_string(), why: why.into() }
    }

    fn has(&self, name: &str) -> bool {
        self.file.variables().is_ok_and(|list| list.iter().any(|v| v.name() == name))
    }

    /// A variable of numbers.
    fn numbers(&self, name: &str) -> Result<Variable, DatabaseError> {
        let to_error = |e: netcdf_reader::Error| self.error(format!("{name}: {e}"));
        let variable = self.file.variable(name).map_err(to_error)?;
        let names = variable.dimensions().iter().map(|d| d.name.clone()).collect();
        let sizes: Vec<usize> = variable.shape().iter().map(|n| usize::try_from(*n).unwrap_or(usize::MAX)).collect();
        self.small(name, &sizes)?;
        let array = self.file.read_variable_as_f64(name).map_err(to_error)?;
        let values: Vec<f64> = array.iter().copied().collect();
        if sizes.iter().product::<usize>() != values.len() {
            return Err(self.error(format!("{name} has {} values on dimensions of other sizes", values.len())));
        }
        Ok(Variable { names, sizes, values })
    }

    /// A variable of one number.
    fn single(&self, name: &str) -> Result<f64, DatabaseError> {
        let variable = self.numbers(name)?;
        match variable.values.as_slice() {
            [value] => Ok(*value),
            list => {
                let text = format!("{name} has {} values: select one before it is exported", list.len());
                Err(self.error(text))
            }
        }
    }

    /// A variable of words.
    fn words(&self, name: &str) -> Result<Vec<String>, DatabaseError> {
        let to_error = |e: netcdf_reader::Error| self.error(format!("{name}: {e}"));
        let variable = self.file.variable(name).map_err(to_error)?;
        let sizes: Vec<usize> = variable.shape().iter().map(|n| usize::try_from(*n).unwrap_or(usize::MAX)).collect();
        self.small(name, &sizes)?;
        let words = self.file.read_variable_as_strings(name).map_err(to_error)?;
        Ok(words.iter().map(|w| w.trim_end_matches('\0').trim().to_string()).collect())
    }

    fn small(&self, name: &str, sizes: &[usize]) -> Result<(), DatabaseError> {
        let cells = sizes.iter().try_fold(1usize, |product, n| product.checked_mul(*n));
        let fits = cells.is_some_and(|n| n <= MAX_DATABASE_NUMBERS);
        if fits { Ok(()) } else { Err(self.error(format!("{name} has more than {MAX_DATABASE_NUMBERS} values"))) }
    }

    /// The directions of the body on a dimension of the data set.
    fn directions(&self, dimension: &str, body: Option<usize>) -> Result<BodyDirections, DatabaseError> {
        let (named, bodies) = self.named_directions(dimension)?;
        let chosen = match (body, bodies.as_slice()) {
            (None, [one]) => one,
            (None, list) => {
                let text = format!("it has {} bodies ({}): -INDEX says which one to take", list.len(), list.join(", "));
                return Err(self.error(text));
            }
            (Some(n), list) => match n.checked_sub(1).and_then(|i| list.get(i)) {
                Some(one) => one,
                None => return Err(self.error(format!("there is no body {n}: it has {}", list.len()))),
            },
        };
        let mut found: BodyDirections = Vec::new();
        for (index, (_, dof)) in named.iter().enumerate().filter(|(_, (b, _))| b == chosen) {
            let Some(mode) = DOFS.iter().position(|d| d == dof) else {
                return Err(self.error(format!("{dof} is none of the six directions of a rigid body")));
            };
            if found.iter().any(|f| f.1 == mode) {
                return Err(self.error(format!("{dof} stands twice on {dimension}")));
            }
            found.push((index, mode));
        }
        Ok(found)
    }

    /// Body and direction of each place on a dimension, and the bodies, in their order.
    fn named_directions(&self, dimension: &str) -> Result<NamedDirections, DatabaseError> {
        let words = self.words(dimension)?;
        let split = |w: &String| match w.rsplit_once("__") {
            Some((body, dof)) => (body.to_string(), dof.to_ascii_uppercase()),
            None => (String::new(), w.to_ascii_uppercase()),
        };
        let named: Vec<(String, String)> = words.iter().map(split).collect();
        let mut bodies: Vec<String> = Vec::new();
        for (name, _) in &named {
            if !bodies.contains(name) {
                bodies.push(name.clone());
            }
        }
        Ok((named, bodies))
    }

    /// A matrix of two dimensions of directions, at places of the others.
    fn matrix(
        &self,
        of: &Variable,
        (rows, columns): (&BodyDirections, &BodyDirections),
        at: usize,
        along: &str,
    ) -> Matrix6<f64> {
        matrix(rows.iter().flat_map(|(r, i)| {
            columns.iter().map(move |(c, j)| {
                (6 * i + j, of.value_at(&[(along, at), ("influenced_dof", *r), ("radiating_dof", *c)]))
            })
        }))
    }
}

/// Reads a data set; of several bodies one is chosen by its number, from 1.
///
/// # Errors
/// A file that is no NetCDF or no data set of Capytaine; frequencies, depths or bodies that are not distinguished.
pub fn read(source: &str, bytes: &[u8], body: Option<usize>) -> Result<Database, DatabaseError> {
    let options = NcOpenOptions {
        max_read_bytes: 8 * MAX_DATABASE_NUMBERS,
        max_chunk_bytes: 8 * MAX_DATABASE_NUMBERS,
        ..NcOpenOptions::default()
    };
    let file = NcFile::from_bytes_with_options(bytes, options).map_err(|e| DatabaseError::File {
        file: source.to_string(),
        why: format!("it is no NetCDF file that can be read: {e}"),
    })?;
    let set = Set { source, file };
    if !set.has("omega") || !(set.has("added_mass") || set.has("excitation_force")) {
        return Err(set.error("it has no omega, added_mass or excitation_force: it is no data set of Capytaine"));
    }
    let omega = set.numbers("omega")?;
    let [along] = omega.names.as_slice() else {
        return Err(set.error("omega stands on several dimensions"));
    };
    let depth = set.single("water_depth")?;
    let mut data = Database {
        source: source.to_string(),
        density: set.single("rho")?,
        gravity: set.single("g")?,
        depth: (depth.is_finite() && depth > 0.0).then_some(depth),
        ..Database::default()
    };
    // places of the frequencies, growing
    let mut order: Vec<(usize, f64)> = omega.values.iter().copied().enumerate().collect();
    order.sort_by(|a, b| a.1.total_cmp(&b.1));
    if order.windows(2).any(|w| matches!(w, [a, b] if a.1 == b.1)) {
        return Err(set.error("a frequency stands twice on omega"));
    }
    if order.iter().any(|(_, w)| w.is_nan() || *w < 0.0) {
        return Err(set.error("omega holds what is no frequency"));
    }
    let rigid = set.directions("influenced_dof", body)?;
    let mut between: Vec<(usize, f64)> = order.iter().copied().filter(|(_, w)| *w > 0.0 && w.is_finite()).collect();
    if set.has("added_mass") && set.has("radiation_damping") {
        let (added, damping) = (set.numbers("added_mass")?, set.numbers("radiation_damping")?);
        let moving = set.directions("radiating_dof", body)?;
        single_places(&set, "added_mass", &added, &[along, "influenced_dof", "radiating_dof"])?;
        let of = |v: &Variable, at: usize| set.matrix(v, (&rigid, &moving), at, along);
        for (position, w) in &order {
            match *w {
                0.0 => data.zero = Some(of(&added, *position)),
                f64::INFINITY => data.infinite = Some(of(&added, *position)),
                _ => {
                    data.added_mass.push(of(&added, *position));
                    data.damping.push(of(&damping, *position));
                }
            }
        }
        let (_, bodies) = set.named_directions("radiating_dof")?;
        let own = body.unwrap_or(1) - 1;
        data.index = own;
        for index in (0..bodies.len()).filter(|index| *index != own) {
            let others = set.directions("radiating_dof", Some(index + 1))?;
            let of = |v: &Variable, at: usize| set.matrix(v, (&rigid, &others), at, along);
            let mut made = Interaction { index, ..Interaction::default() };
            for (position, w) in &order {
                match *w {
                    0.0 => {}
                    f64::INFINITY => {
                        made.infinite = Some(of(&added, *position)).filter(|m| m.iter().all(|v| v.is_finite()));
                    }
                    _ => {
                        made.added_mass.push(of(&added, *position));
                        made.damping.push(of(&damping, *position));
                    }
                }
            }
            data.interactions.push(made);
        }
        if set.has("hydrostatic_stiffness") {
            data.hydrostatics = Some(of(&set.numbers("hydrostatic_stiffness")?, 0));
        }
    }
    if set.has("excitation_force") {
        excitation(&set, &mut data, &rigid, (along, &mut between))?;
    } else if set.has("diffraction_force") {
        data.remarks.push("it has no excitation_force: diffraction and Froude-Krylov forces are not added up".into());
    }
    data.frequencies = between.into_iter().map(|(_, w)| w).collect();
    if set.has("disp_mass") {
        let masses = set.numbers("disp_mass")?.values;
        let own = if masses.len() == 1 { 0 } else { data.index };
        data.mass = masses.get(own).copied().filter(|m| m.is_finite());
    }
    if set.has("damping_lid") {
        let all = set.numbers("damping_lid")?.values;
        data.lids = all.as_chunks::<5>().0.to_vec();
    }
    if set.has("body_axes") {
        let bodies = set.own_axes()?;
        data.drift = set.mean_drift(&data, along)?;
        data.stance = set.stance(data.index)?;
        turn_to_axes(&mut data, &bodies).ok_or_else(|| set.error("body_axes has fewer bodies than added_mass"))?;
    } else if set.has("rotation_center") {
        // of several bodies each has its own
        let centres = set.numbers("rotation_center")?.values;
        let own = if centres.len() == 3 { 0 } else { data.index };
        let Some([x, y, z]) = centres.as_chunks::<3>().0.get(own) else {
            return Err(set.error("rotation_center is no point of this body"));
        };
        data.reference = Vector3::new(*x, *y, *z);
        refer_phases(&mut data, -*x, -*y);
    }
    // limits that Capytaine could not compute are left out by it as NaN
    let whole = |m: &Matrix6<f64>| m.iter().all(|v| v.is_finite());
    (data.zero, data.infinite) = (data.zero.filter(whole), data.infinite.filter(whole));
    check_database(data)
}

/// The value of a text attribute of a data set; none of what is no NetCDF file or has it not.
pub fn attribute(bytes: &[u8], name: &str) -> Option<String> {
    NcFile::from_bytes(bytes).ok()?.global_attribute(name).ok()?.value.as_string()
}

/// The numbers of a variable of a data set, whatever its dimensions.
///
/// # Errors
/// What is no NetCDF file, or has no such numbers.
pub fn numbers(source: &str, bytes: &[u8], name: &str) -> Result<Vec<f64>, DatabaseError> {
    let file = NcFile::from_bytes(bytes).map_err(|e| DatabaseError::File {
        file: source.to_string(),
        why: format!("it is no NetCDF file that can be read: {e}"),
    })?;
    Ok(Set { source, file }.numbers(name)?.values)
}

/// A body of a data set of windlass, which has axes of its own.
struct OwnAxes {
    /// Its origin (m).
    origin: Vector3<f64>,
    /// Its heading in the data set (rad).
    heading: f64,
}

impl OwnAxes {
    /// From forces and moments along the axes of the data set to those along the axes of the heading: of a trimmed body they stay upright.
    fn six(&self) -> Matrix6<f64> {
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), -self.heading);
        let mut made = Matrix6::zeros();
        for at in [0, 3] {
            made.fixed_view_mut::<3, 3>(at, at).copy_from(turn.matrix());
        }
        made
    }
}

impl Set<'_> {
    fn own_axes(&self) -> Result<Vec<OwnAxes>, DatabaseError> {
        let [origins, headings] = [self.numbers("rotation_center")?, self.numbers("body_heading")?];
        let bodies = origins.values.as_chunks::<3>().0.iter().zip(&headings.values);
        Ok(bodies.map(|(origin, heading)| OwnAxes { origin: Vector3::from(*origin), heading: *heading }).collect())
    }

    /// How a body of a data set of windlass floated: the third column of its axes is the vertical.
    fn stance(&self, index: usize) -> Result<Option<Stance>, DatabaseError> {
        let [axes, origins] = [self.numbers("body_axes")?, self.numbers("rotation_center")?];
        let (axes, origins) = (axes.values.as_chunks::<9>().0, origins.values.as_chunks::<3>().0);
        let of = |([_, _, x, _, _, y, _, _, z], [_, _, height]): (&[f64; 9], &[f64; 3])| Stance {
            height: *height,
            up: Vector3::new(*x, *y, *z),
        };
        Ok(axes.get(index).zip(origins.get(index)).map(of))
    }

    /// Mean drift of a data set of windlass along its axes, at the headings and frequencies of its excitation.
    fn mean_drift(&self, data: &Database, along: &str) -> Result<Option<DriftTable>, DatabaseError> {
        if !self.has("mean_drift") {
            return Ok(None);
        }
        let drift = self.numbers("mean_drift")?;
        let directions = self.numbers("wave_direction")?.values;
        // zero and infinity have no drift
        let mut omega = self.numbers(along)?.values;
        omega.retain(|w| *w > 0.0 && w.is_finite());
        let place = |list: &[f64], same: &dyn Fn(f64) -> bool| list.iter().position(|x| same(*x));
        let value = |heading: f64, frequency: f64| -> Option<[f64; 6]> {
            let h = place(&directions, &|x| super::rows::same_heading(rows_heading(x), heading))?;
            let w = place(&omega, &|x| x == frequency)?;
            let at = |component: usize| {
                drift.value_at(&[
                    ("frequency", w),
                    ("wave_direction", h),
                    ("body", data.index),
                    ("component", component),
                ])
            };
            Some([at(0), at(1), 0.0, 0.0, 0.0, at(2)])
        };
        let row = |heading: &f64| data.frequencies.iter().map(|w| value(*heading, *w)).collect::<Option<Vec<_>>>();
        let values: Option<Vec<_>> = data.headings.iter().map(row).collect();
        let values = values.ok_or_else(|| self.error("mean_drift has not the headings of excitation_force"))?;
        // a line a body
        let methods = self.file.global_attribute(DRIFT_METHOD).ok().and_then(|found| found.value.as_string());
        let method = methods.and_then(|list| list.lines().nth(data.index).map(str::to_owned));
        Ok(Some(DriftTable { frequencies: data.frequencies.clone(), headings: data.headings.clone(), values, method }))
    }
}

/// A heading of a data set (rad) as it is kept.
fn rows_heading(direction: f64) -> f64 {
    heading(direction.to_degrees())
}

/// Turns a database to the axes of the heading of its body, about its origin and with phases there; none where there is no such body.
fn turn_to_axes(data: &mut Database, bodies: &[OwnAxes]) -> Option<()> {
    let own = bodies.get(data.index)?;
    refer_phases(data, -own.origin.x, -own.origin.y);
    let six = own.six();
    let turn = |list: &mut [Matrix6<f64>], other: &Matrix6<f64>| {
        list.iter_mut().for_each(|matrix| *matrix = six * *matrix * other.transpose());
    };
    turn(&mut data.added_mass, &six);
    turn(&mut data.damping, &six);
    for one in [&mut data.infinite, &mut data.zero, &mut data.hydrostatics].into_iter().flatten() {
        *one = six * *one * six.transpose();
    }
    for made in &mut data.interactions {
        let other = bodies.get(made.index)?;
        let others = other.six();
        turn(&mut made.added_mass, &others);
        turn(&mut made.damping, &others);
        made.infinite = made.infinite.map(|infinite| six * infinite * others.transpose());
        let between = other.origin - own.origin;
        let (sine, cosine) = own.heading.sin_cos();
        made.place = Some([
            between.x * cosine + between.y * sine,
            between.y * cosine - between.x * sine,
            other.heading - own.heading,
        ]);
    }
    for force in data.excitation.iter_mut().flatten() {
        let old = *force;
        *force = std::array::from_fn(|row| (0..6).map(|column| old[column] * six[(row, column)]).sum());
    }
    // along the heading of the body
    let (sine, cosine) = own.heading.sin_cos();
    for [x, y, ..] in data.drift.iter_mut().flat_map(|drift| &mut drift.values).flatten() {
        (*x, *y) = (*x * cosine + *y * sine, *y * cosine - *x * sine);
    }
    // headings from that of the body, growing again
    let turned = |heading: &f64| {
        let angle = (heading - own.heading).rem_euclid(TAU);
        if angle > TAU - HEADING_ROOM { 0.0 } else { angle }
    };
    let headings: Vec<f64> = data.headings.iter().map(turned).collect();
    let mut order: Vec<usize> = (0..headings.len()).collect();
    order.sort_by(|a, b| headings[*a].total_cmp(&headings[*b]));
    data.headings = order.iter().map(|at| headings[*at]).collect();
    data.excitation = order.iter().filter_map(|at| data.excitation.get(*at).cloned()).collect();
    if let Some(drift) = &mut data.drift {
        drift.headings.clone_from(&data.headings);
        drift.values = order.iter().filter_map(|at| drift.values.get(*at).cloned()).collect();
    }
    Some(())
}

/// Sees that dimensions that are not used have one place only.
fn single_places(set: &Set, name: &str, of: &Variable, used: &[&str]) -> Result<(), DatabaseError> {
    let other = of.names.iter().zip(&of.sizes).find(|(n, size)| **size != 1 && !used.contains(&n.as_str()));
    match other {
        None => Ok(()),
        Some((n, size)) => Err(set.error(format!("{name} has {size} places on {n}: select one before it is exported"))),
    }
}

/// The excitation by heading, then frequency.
fn excitation(
    set: &Set,
    data: &mut Database,
    rigid: &BodyDirections,
    (along, between): (&str, &mut Vec<(usize, f64)>),
) -> Result<(), DatabaseError> {
    let force = set.numbers("excitation_force")?;
    single_places(set, "excitation_force", &force, &[along, "influenced_dof", "wave_direction", "complex"])?;
    if force.size("complex") != 2 {
        return Err(set.error("excitation_force has no dimension complex of two: export it by export_dataset"));
    }
    let directions = set.numbers("wave_direction")?.values;
    if directions.is_empty() || directions.iter().any(|h| !h.is_finite()) {
        return Err(set.error("wave_direction holds what is no heading"));
    }
    let mut headings: Vec<(usize, f64)> = directions.iter().map(|h| heading(h.to_degrees())).enumerate().collect();
    headings.sort_by(|a, b| a.1.total_cmp(&b.1));
    headings.dedup_by(|b, a| super::rows::same_heading(a.1, b.1));
    let table = headings.iter().map(|(h, _)| {
        let at = |w: usize| {
            let mut six = Amplitudes::default();
            for (position, mode) in rigid {
                let part = |part: usize| {
                    force.value_at(&[
                        (along, w),
                        ("influenced_dof", *position),
                        ("wave_direction", *h),
                        ("complex", part),
                    ])
                };
                if let Some(x) = six.get_mut(*mode) {
                    *x = Complex::new(part(0), part(1));
                }
            }
            six
        };
        between.iter().map(|(w, _)| at(*w)).collect()
    });
    data.excitation = table.collect();
    data.headings = headings.into_iter().map(|(_, h)| h).collect();
    Ok(())
}
