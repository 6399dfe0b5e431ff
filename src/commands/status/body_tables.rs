//! Tables of `&STATUS` about bodies: weights, pieces of hulls, hydrostatics.

use crate::commands::model::member;
use crate::commands::status::kind::StatusKind;
use nalgebra::{Matrix3, Matrix6, Vector3};
use windlass_base::pose::{Pose, Six};
use windlass_base::table::{Digits, Table};
use windlass_base::units::{Dim, UnitSystem};
use windlass_hydro::hull::Hydrostatics;
use windlass_hydro::{Category, Floating, Hull, Tank, compartments_of};
use windlass_model::EntityKind;
use windlass_model::{Body, ClassError, FreeSurface, Mass, Model, Shape};

/// `&STATUS WEIGHT`.
pub static WEIGHT: StatusKind =
    StatusKind::new("WEIGHT", "weights, centers and radii of gyration of bodies and parts", |query, _| {
        Ok(vec![weights(query.model(), &query.fits())])
    })
    .with_names(&[EntityKind::Body, EntityKind::Part]);

/// `&STATUS PIECES`.
pub static PIECES: StatusKind = StatusKind::new("PIECES", "pieces of hulls", |query, _| {
    let (model, fits) = (query.model(), query.fits());
    let added = member::added_mass(model, &fits).map_err(|e| e.diagnostic(query.position(), query.job.units))?;
    Ok(std::iter::once(pieces(model, &fits)).chain(member::members(model, &fits)).chain(added).collect())
})
.with_names(&[EntityKind::Piece, EntityKind::Body, EntityKind::Part]);

/// `&STATUS HYDROSTATICS`.
pub static HYDROSTATICS: StatusKind = StatusKind::new(
    "HYDROSTATICS",
    "what bodies displace where they are, and their hydrostatic stiffness",
    |query, _| Ok(hydrostatics(query.model(), &query.fits(), query.job.units)),
)
.with_names(&[EntityKind::Body])
.also(&["DISPLACEMENT"]);

/// Whether a body or part is chosen.
type Fits<'a> = &'a dyn Fn(&str) -> bool;

/// The weight of a part, or of a whole body.
struct WeightRow<'m> {
    body: &'m str,
    part: &'m str,
    /// Records of weight.
    items: usize,
    mass: Mass,
}

/// Weight, centre and radii of each part and each body.
pub fn weights(model: &Model, fits: Fits) -> Table {
    let mut table = Table::new("Weights");
    let gravity = model.defaults.gravity;
    let mut rows = Vec::new();
    for body in model.bodies.values() {
        let parts: Vec<_> = model.parts_of(body).collect();
        let whole = fits(&body.name);
        for part in parts.iter().filter(|p| (whole || fits(&p.name)) && !p.weights.is_empty()) {
            let mass = Mass::from_parts(std::iter::once(*part), gravity);
            rows.push(WeightRow { body: &body.name, part: &part.name, items: part.weights.len(), mass });
        }
        if whole {
            let mass = Mass::from_parts(parts.iter().copied(), gravity);
            note_mass(&mut table, body, &mass);
            let items = parts.iter().map(|p| p.weights.len()).sum();
            rows.push(WeightRow { body: &body.name, part: "(whole)", items, mass });
        }
    }
    table.note("Centers are in the system of the body; radii of gyration are about axes through the center, along those of the body");
    // nothing has no center
    let there = |row: &WeightRow, x: Option<f64>| x.filter(|_| row.mass.mass != 0.0);
    table
        .with_rows(&rows)
        .text("Body", |row| row.body)
        .text("Part", |row| row.part)
        .column("", "Items", Dim::None, Digits::Usual, |row| row.items)
        .column("", "Weight", Dim::Force, Digits::Usual, |row| row.mass.mass * gravity)
        .columns("Center of Gravity", ["X", "Y", "Z"], Dim::Length, Digits::Usual, |row| {
            <[f64; 3]>::from(row.mass.centre).map(|x| there(row, Some(x)))
        })
        .columns("Radii of Gyration", ["KX", "KY", "KZ"], Dim::Length, Digits::Usual, |row| {
            row.mass.radii().map(|k| there(row, k))
        })
        .build()
}

fn note_mass(table: &mut Table, body: &Body, mass: &Mass) {
    if mass.mass == 0.0 {
        table.note(format!("{} has no weight", body.name));
    } else if mass.mass < 0.0 {
        table.warn(format!("{}: the weights take off more than they put on", body.name));
    } else if mass.radii().iter().any(|k| k.is_none_or(|k| k == 0.0)) {
        table.note(format!(
            "{} has a radius of gyration of zero: it can be in equilibrium and cannot be moved in time",
            body.name
        ));
    }
}

/// Pieces with their permeability, volume and reach.
pub fn pieces(model: &Model, fits: Fits) -> Table {
    let all = model.parts.values().flat_map(|part| part.pieces.iter().map(move |piece| (part, piece)));
    let chosen: Vec<_> =
        all.filter(|(part, piece)| fits(&piece.name) || fits(&part.name) || fits(&part.body)).collect();
    let end = |shape: &Shape, end: usize| {
        shape.extent().and_then(|extent| extent.get(end).copied()).map_or([None; 3], |at| at.map(Some))
    };
    let shield = |cs: [f64; 3]| cs.map(|x| x.to_string()).join(" ");
    Table::new("Pieces")
        .with_rows(&chosen)
        .text("Body", |(part, _)| &part.body)
        .text("Part", |(part, _)| &part.name)
        .text("Piece", |(_, piece)| &piece.name)
        .text("Form", |(_, piece)| match &piece.shape {
            Shape::Panels(panels) => format!("{} panels", panels.len()),
            Shape::Block { .. } => "box".into(),
            Shape::Tube { .. } => "tube".into(),
            Shape::Bar { .. } => "bar".into(),
        })
        .column("", "Perm.", Dim::None, Digits::Decimals(3), |(_, piece)| piece.permeability)
        .columns("From", ["X", "Y", "Z"], Dim::Length, Digits::Usual, |(_, piece)| end(&piece.shape, 0))
        .columns("To", ["X", "Y", "Z"], Dim::Length, Digits::Usual, |(_, piece)| end(&piece.shape, 1))
        .column("Wind", "CS", Dim::None, Digits::Usual, |(_, piece)| shield(piece.cs_wind))
        .column("Current", "CS", Dim::None, Digits::Usual, |(_, piece)| shield(piece.cs_current))
        .build()
}

/// Hydrostatics of each body in the present configuration: what it displaces, and the stiffness of weight and buoyancy.
pub fn hydrostatics(model: &Model, fits: Fits, units: UnitSystem) -> Vec<Table> {
    let bodies = model.bodies.values().filter(|b| fits(&b.name));
    bodies
        .flat_map(|body| {
            of_body(model, body).unwrap_or_else(|error| {
                let title = format!("Hydrostatics of {}", body.name);
                let mut table = Table::new(title).with_rows(&["none"]).text("Quantity", |word| *word).build();
                table.note_absent(format!("{}: {}", body.name, error.text(units)));
                vec![table]
            })
        })
        .collect()
}

fn of_body(model: &Model, body: &Body) -> Result<Vec<Table>, ClassError> {
    let (floating, hull, pose) =
        (Floating::at_rest(model, body)?, Hull::new(model, body)?, Pose::from_place(&body.position));
    let mass = floating.mass;
    let weight = mass.mass * model.defaults.gravity;
    let (mut stiffness, mut wrench) = (Matrix6::zeros(), Six::zeros());
    for load in floating
        .loads
        .iter()
        .filter(|l| matches!(l.category(), Category::Weight | Category::Contents | Category::Buoyancy))
    {
        let load = load.mean_load(&pose)?;
        wrench += load.wrench;
        stiffness += load.stiffness;
    }
    let arm = pose.axes * mass.centre;
    let mut table = Table::new(format!("Hydrostatics of {}", body.name)).fact("Weight", weight, Dim::Force);
    table = position(table, "Center of Gravity", (pose.origin + arm).into(), arm.norm());
    let found = hull.as_ref().and_then(|h| Hydrostatics::new(&h.wet(&pose), &pose, mass.centre, h.water_weight()));
    let size = found.map_or(arm.norm(), |f| f.volume.cbrt());
    if let Some(found) = &found {
        table = facts(table, found, size);
        let [transverse, longitudinal] = free_surface(model, body, &pose, found.displacement)?;
        if transverse > 0.0 || longitudinal > 0.0 {
            table = table
                .fact("Free Surface Transverse", transverse, Dim::Length)
                .fact("Free Surface Longitudinal", longitudinal, Dim::Length)
                .fact("Corrected GM Transverse", found.gm_t - transverse, Dim::Length)
                .fact("Corrected GM Longitudinal", found.gm_l - longitudinal, Dim::Length);
        }
    } else if hull.is_some() {
        table.note(format!("{} displaces no water where it is", body.name));
    } else if let Some(linear) = &body.linear {
        table = table.fact("Buoyancy", wrench[2] + weight, Dim::Force).fact("At Rest", linear.buoyancy, Dim::Force);
        table.note("The buoyancy is that of a linear stiffness (#HYDROSTATIC)");
    } else {
        table.note(format!("{} has no hull and no linear stiffness", body.name));
    }
    let force = weight.abs().max((wrench[2] + weight).abs());
    table = table.fact("Buoyancy less Weight", round_to_zero(wrench[2], force), Dim::Force);
    let about = moment_about(&wrench, arm).map(|m| round_to_zero(m, force * size));
    table = table.fact("Moment X", about.x, Dim::Moment).fact("Moment Y", about.y, Dim::Moment);
    table.note("moments and stiffness are about the center of gravity, in global axes; KB, KG and BM are vertical, from the origin of the body");
    let about = about_point(&stiffness, &wrench, arm);
    let [forces, moments] = [(table, 0), (Table::new(format!("Stiffness of {} in Rotation", body.name)), 3)]
        .map(|(table, first)| stiffness_rows(table, &about, first));
    Ok(vec![forces, moments])
}

/// What free surfaces of closed compartments take from the metacentric heights (m): the weight per volume of the liquid times the second
/// moment of its surface, over the displacement.
fn free_surface(model: &Model, body: &Body, pose: &Pose, displacement: f64) -> Result<[f64; 2], ClassError> {
    let mut sum = [0.0; 2];
    for compartment in compartments_of(model, body) {
        let state = compartment.contents;
        if state.surface == FreeSurface::Frozen || state.fraction <= compartment.residual {
            continue;
        }
        let tank = Tank::new(model, compartment)?;
        if state.is_flooded {
            continue;
        }
        let inertia = tank.liquid(pose)?.surface_inertia(pose);
        for (sum, inertia) in sum.iter_mut().zip(inertia) {
            *sum += tank.density() * model.defaults.gravity * inertia / displacement;
        }
    }
    Ok(sum)
}

/// A number that is zero but for rounding as zero; `size` is that of the numbers it was made of.
pub(crate) fn round_to_zero(value: f64, size: f64) -> f64 {
    if value.abs() <= 1e-11 * size { 0.0 } else { value }
}

/// The facts of a place.
fn position(mut table: Table, name: &str, at: [f64; 3], size: f64) -> Table {
    for (axis, value) in ["X", "Y", "Z"].into_iter().zip(at) {
        table = table.fact(&format!("{name} {axis}"), round_to_zero(value, size), Dim::Length);
    }
    table
}

fn facts(mut table: Table, found: &Hydrostatics, size: f64) -> Table {
    table = table.fact("Displacement", found.displacement, Dim::Force).fact("Volume", found.volume, Dim::Volume);
    table = position(table, "Center of Buoyancy", found.centre_of_buoyancy.into(), size);
    table = table.fact("Waterplane Area", found.plane_area, Dim::Area);
    let flotation = found.centre_of_flotation.map_or([None; 2], |at| at.map(|x| Some(round_to_zero(x, size))));
    for (axis, value) in ["X", "Y"].into_iter().zip(flotation) {
        table = table.fact(&format!("Center of Flotation {axis}"), value, Dim::Length);
    }
    // the moment that turns a body of this displacement and GM by one degree
    let trim = found.displacement * found.gm_l * 1f64.to_radians();
    table
        .fact("Wetted Area", found.wetted_area, Dim::Area)
        .fact("KB", found.kb, Dim::Length)
        .fact("KG", found.kg, Dim::Length)
        .fact("BM Transverse", found.bm_t, Dim::Length)
        .fact("BM Longitudinal", found.bm_l, Dim::Length)
        .fact("GM Transverse", found.gm_t, Dim::Length)
        .fact("GM Longitudinal", found.gm_l, Dim::Length)
        .fact("Moment to Trim 1 Degree", trim, Dim::Moment)
}

/// The moment of a wrench about a point (m, from the place the wrench is about).
fn moment_about(wrench: &Six, arm: Vector3<f64>) -> Vector3<f64> {
    let force = Vector3::new(wrench[0], wrench[1], wrench[2]);
    Vector3::new(wrench[3], wrench[4], wrench[5]) - arm.cross(&force)
}

/// A stiffness about the origin as one about a point that moves with the body: -d(wrench about the point)/d(motion of the point).
///
/// The origin moves by d - t x a where the point moves by d and turns by t; the moment about the point is M - a x F.
fn about_point(stiffness: &Matrix6<f64>, wrench: &Six, arm: Vector3<f64>) -> Matrix6<f64> {
    let mut motion = Matrix6::identity();
    motion.fixed_view_mut::<3, 3>(0, 3).copy_from(&arm.cross_matrix());
    let mut moments = Matrix6::identity();
    moments.fixed_view_mut::<3, 3>(3, 0).copy_from(&-arm.cross_matrix());
    let mut about = moments * stiffness * motion;
    // d(a x F) holds (t x a) x F too
    let force: Matrix3<f64> = Vector3::new(wrench[0], wrench[1], wrench[2]).cross_matrix();
    let turned = about.fixed_view::<3, 3>(3, 3) + force * arm.cross_matrix();
    about.fixed_view_mut::<3, 3>(3, 3).copy_from(&turned);
    about
}

/// Three rows of a stiffness: those of the force, or from 3 those of the moment.
fn stiffness_rows(table: Table, matrix: &Matrix6<f64>, first: usize) -> Table {
    let names = ["X", "Y", "Z", "RX", "RY", "RZ"];
    let (by_shift, by_turn) =
        if first == 0 { (Dim::ForcePerLength, Dim::Force) } else { (Dim::Force, Dim::MomentPerRadian) };
    let size = [0, 3].map(|half| matrix.fixed_view::<3, 3>(first, half).amax());
    let whole = size[0].max(size[1]);
    let rows: Vec<(&str, [f64; 6])> = names
        .into_iter()
        .enumerate()
        .skip(first)
        .take(3)
        .map(|(n, name)| (name, [0, 1, 2, 3, 4, 5].map(|i| round_to_zero(matrix[(n, i)], whole))))
        .collect();
    table
        .with_rows(&rows)
        .text(if first == 0 { "Force" } else { "Moment" }, |(name, _)| *name)
        .columns("By Translation", ["X", "Y", "Z"], by_shift, Digits::Scientific(6), |(_, [x, y, z, ..])| [*x, *y, *z])
        .columns("By Rotation, a Radian", ["RX", "RY", "RZ"], by_turn, Digits::Scientific(6), |(_, [.., x, y, z])| {
            [*x, *y, *z]
        })
        .build()
}
