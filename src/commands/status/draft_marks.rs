//! `&STATUS DRAFT`: the drafts of bodies at their draft marks.

use crate::commands::status::kind::StatusKind;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_model::{DraftMark, EntityKind, Model};

/// `&STATUS DRAFT`.
pub static DRAFT: StatusKind =
    StatusKind::new("DRAFT", "drafts read at the draft marks of &DESCRIBE DMARK", |query, _| {
        Ok(vec![drafts(query.model(), &query.fits())])
    })
    .with_names(&[EntityKind::DraftMark])
    .of_moses();

/// One row a mark: where it runs, and the draft along it.
fn drafts(model: &Model, fits: &dyn Fn(&str) -> bool) -> Table {
    let marks: Vec<&DraftMark> = model.draft_marks.values().filter(|m| fits(&m.name)).collect();
    let point = |mark: &DraftMark, end: usize| mark.points.get(end).and_then(|p| model.points.get(&Model::key(p)));
    let mut table = Table::new("Drafts");
    table.note("the length along the line of a mark from its first point to the water's surface; less than 0: that point is above it");
    for mark in marks.iter().filter(|mark| model.draft_at(mark).is_none()) {
        table.note_absent(format!("the line of {} is level: there is no draft along it", mark.name));
    }
    table
        .with_rows(&marks)
        .text("Mark", |mark| &mark.name)
        .text("Body", |mark| point(mark, 0).and_then(|p| model.body_of(p)).map(|b| b.name.as_str()))
        .text("From", |mark| &mark.points[0])
        .text("To", |mark| &mark.points[1])
        .columns("First Point, Global", ["X", "Y", "Z"], Dim::Length, Digits::Usual, |mark| {
            point(mark, 0).map_or([None; 3], |p| model.global(p).map(Some))
        })
        .column("", "Draft", Dim::Length, Digits::Decimals(4), |mark| model.draft_at(mark))
        .build()
}
