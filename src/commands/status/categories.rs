//! `&STATUS CATEGORY`: weights, and buoyancies of points and members, by load category.
//!
//! MOSES reports weight, buoyancy and their centers by category [MOSES-HELP modeling]; the columns are ours.

use crate::commands::status::kind::StatusKind;
use indexmap::IndexMap;
use nalgebra::Vector3;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_model::{Attribute, EntityKind, LoadKind, Model};

/// `&STATUS CATEGORY`.
pub static CATEGORY: StatusKind =
    StatusKind::new("CATEGORY", "weight and buoyancy of load categories, with their centers", |query, _| {
        Ok(vec![categories(query.model(), &query.fits())])
    })
    .with_names(&[EntityKind::Body])
    .of_moses();

/// A force and its first moment, in the body.
#[derive(Clone, Copy, Default)]
struct ForceMoment {
    /// N.
    force: f64,
    /// N m.
    moment: Vector3<f64>,
}

impl ForceMoment {
    fn add(&mut self, force: f64, at: [f64; 3]) {
        self.force += force;
        self.moment += Vector3::from(at) * force;
    }

    fn centre(&self) -> [Option<f64>; 3] {
        let centre = (self.force != 0.0).then(|| self.moment / self.force);
        centre.map_or([None; 3], |at| <[f64; 3]>::from(at).map(Some))
    }
}

/// One row a body and category that has loads, with the multipliers of `&APPLY`.
fn categories(model: &Model, fits: &dyn Fn(&str) -> bool) -> Table {
    let water_weight = model.surroundings().water_weight();
    let mut sums: IndexMap<(&str, &str), [ForceMoment; 2]> = IndexMap::new();
    for body in model.bodies.values() {
        for part in model.parts_of(body) {
            for weight in &part.weights {
                let [weights, _] = sums.entry((&body.name, &weight.category)).or_default();
                weights.add(weight.weight * weight.multiplier, part.position.apply(weight.at));
            }
            for piece in &part.pieces {
                if let (Some(category), Some((at, volume))) = (&piece.category, piece.shape.member_volume()) {
                    let share = piece.permeability * model.member_factor(&part.name, piece, Attribute::Buoyancy);
                    let [_, buoyancy] = sums.entry((&body.name, category)).or_default();
                    buoyancy.add(water_weight * volume * share, part.position.apply(at));
                }
            }
            for load in model.loads.iter().filter(|l| Model::key(&l.part) == Model::key(&part.name)) {
                if let LoadKind::Buoyancy { force, .. } = &load.kind {
                    let factor =
                        model.load_factor(&part.name, load.group.as_deref(), &load.category, Attribute::Buoyancy);
                    let [_, buoyancy] = sums.entry((&body.name, &load.category)).or_default();
                    buoyancy.add(factor * force, part.position.apply(load.at));
                }
            }
        }
    }
    let rows: Vec<_> = sums.into_iter().filter(|((body, category), _)| fits(body) || fits(category)).collect();
    let mut table = Table::new("Categories");
    table.note("centers are in the system of the body; what &APPLY multiplies is multiplied; buoyancy is that of members and of #BUOY wholly under water; that of other pieces belongs to no category: &STATUS B_W has it");
    table
        .with_rows(&rows)
        .text("Body", |((body, _), _)| *body)
        .text("Category", |((_, category), _)| *category)
        .column("", "Weight", Dim::Force, Digits::Usual, |(_, [weight, _])| weight.force)
        .columns("Center of Gravity", ["X", "Y", "Z"], Dim::Length, Digits::Usual, |(_, [weight, _])| weight.centre())
        .column("", "Buoyancy", Dim::Force, Digits::Usual, |(_, [_, buoyancy])| buoyancy.force)
        .columns("Center of Buoyancy", ["X", "Y", "Z"], Dim::Length, Digits::Usual, |(_, [_, buoyancy])| {
            buoyancy.centre()
        })
        .build()
}
