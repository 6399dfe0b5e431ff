//! `&STATUS B_W`: buoyancy and weight of bodies where they stand.
//!
//! MOSES has the report; its columns stand in no source at hand, so that these are ours. Everything is in the system of the body, as the results of
//! &STATUS of MOSES are [MOSES-HELP static].

use crate::commands::status::body_tables::round_to_zero;
use crate::commands::status::kind::StatusKind;
use windlass_base::pose::Pose;
use windlass_base::table::{Digits, Table};
use windlass_base::units::{Dim, UnitSystem};
use windlass_hydro::hull::Hydrostatics;
use windlass_hydro::{Hull, contents_mass};
use windlass_model::{Body, ClassError, EntityKind, Mass, Model};

/// `&STATUS B_W`.
pub static B_W: StatusKind = StatusKind {
    caveats: true,
    ..StatusKind::new("B_W", "weights, buoyancy and metacentric heights of bodies, in their systems", |query, _| {
        Ok(reports(query.model(), &query.fits(), query.job.units))
    })
    .with_names(&[EntityKind::Body])
    .of_moses()
};

/// A row of the report.
struct LoadRow {
    load: String,
    /// Weight, or the force up (N).
    force: f64,
    /// Its centre, in the body (m).
    centre: Option<[f64; 3]>,
    /// Radii of gyration (m).
    radii: [Option<f64>; 3],
}

fn reports(model: &Model, fits: &dyn Fn(&str) -> bool, units: UnitSystem) -> Vec<Table> {
    let bodies = model.bodies.values().filter(|b| b.junction.is_none() && fits(&b.name));
    bodies
        .map(|body| {
            report(model, body).unwrap_or_else(|error| {
                let mut table = Table::new(title(body)).with_rows(&["none"]).text("Load", |word| *word).build();
                table.note_absent(format!("{}: {}", body.name, error.text(units)));
                table
            })
        })
        .collect()
}

fn title(body: &Body) -> String {
    format!("Buoyancy and Weight for {}", body.name)
}

fn report(model: &Model, body: &Body) -> Result<Table, ClassError> {
    let gravity = model.defaults.gravity;
    let of_mass = |load: &str, mass: &Mass| LoadRow {
        load: load.to_string(),
        force: mass.mass * gravity,
        centre: (mass.mass != 0.0).then(|| mass.centre.map(|x| round_to_zero(x, mass.centre.norm())).into()),
        radii: if mass.mass == 0.0 { [None; 3] } else { mass.radii() },
    };
    let weighed = model.parts_of(body).filter(|part| !part.weights.is_empty());
    let mut rows: Vec<LoadRow> = weighed
        .map(|part| of_mass(&format!("Weight of {}", part.name), &Mass::from_parts(std::iter::once(part), gravity)))
        .collect();
    let contents = contents_mass(model, body)?;
    if contents.mass != 0.0 {
        rows.push(of_mass("Contents", &contents));
    }
    let whole = Mass::from_parts(model.parts_of(body), gravity).combine(&contents);
    rows.push(of_mass("Total Weight", &whole));
    let pose = Pose::from_place(&body.position);
    let hull = Hull::new(model, body)?;
    let found = hull.as_ref().and_then(|h| Hydrostatics::new(&h.wet(&pose), &pose, whole.centre, h.water_weight()));
    let mut table = Table::new(title(body));
    let buoyancy = match (&found, &body.linear) {
        (Some(found), _) => {
            let size = found.volume.cbrt();
            let centre = <[f64; 3]>::from(pose.local(found.centre_of_buoyancy)).map(|x| round_to_zero(x, size));
            rows.push(LoadRow {
                load: "Buoyancy".into(),
                force: found.displacement,
                centre: Some(centre),
                radii: [None; 3],
            });
            found.displacement
        }
        (None, Some(_)) => {
            table.note("The buoyancy is that of a linear stiffness (#HYDROSTATIC): &STATUS HYDROSTATICS has it");
            0.0
        }
        (None, None) => {
            rows.push(LoadRow { load: "Buoyancy".into(), force: 0.0, centre: None, radii: [None; 3] });
            table.note(match hull {
                Some(_) => format!("{} displaces no water where it is", body.name),
                None => format!("{} has no hull", body.name),
            });
            0.0
        }
    };
    if found.is_some() || body.linear.is_none() {
        let weight = whole.mass * gravity;
        let left = round_to_zero(buoyancy - weight, buoyancy.max(weight));
        table = table.fact("Buoyancy less Weight", left, Dim::Force);
    }
    if let Some(found) = &found {
        table = table.fact("Displacement", found.displacement, Dim::Force);
        if whole.mass > 0.0 {
            table = table.fact("GM Transverse", found.gm_t, Dim::Length);
            table = table.fact("GM Longitudinal", found.gm_l, Dim::Length);
        }
    }
    if contents.mass != 0.0 {
        table.note("GM without the effect of free surfaces, which &STATUS HYDROSTATICS has");
    }
    table.note("natural periods of roll and pitch, with added mass: &STATUS MODES");
    Ok(table
        .with_rows(&rows)
        .text("Load", |row| &row.load)
        .column("", "Force", Dim::Force, Digits::Usual, |row| row.force)
        .columns("Center, in the Body", ["X", "Y", "Z"], Dim::Length, Digits::Decimals(4), |row| {
            row.centre.map_or([None; 3], |at| at.map(Some))
        })
        .columns("Radii of Gyration", ["KX", "KY", "KZ"], Dim::Length, Digits::Usual, |row| row.radii)
        .build())
}
