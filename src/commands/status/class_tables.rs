//! `&STATUS CL_FLEX`: the property tables of classes.

use crate::commands::Job;
use crate::commands::model_values::{as_written, option_as_written};
use crate::commands::status::kind::Query;
use crate::commands::status::kind::StatusKind;
use windlass_base::table::Table;
use windlass_model::Class;
use windlass_model::EntityKind;

/// `&STATUS CL_FLEX`.
pub static CL_FLEX: StatusKind =
    StatusKind::new("CL_FLEX", "flexible connector classes with W/L, AE, break", |query, _| Ok(tables(query)))
        .with_names(&[EntityKind::Class])
        .of_moses();

/// `&STATUS CLASSES`.
pub static CLASSES: StatusKind =
    StatusKind::new("CLASSES", "the same as CL_FLEX", |query, _| Ok(tables(query))).with_names(&[EntityKind::Class]);

/// The property tables of the classes that fit, with their records as they were given.
pub(crate) fn classes(job: &Job, fits: &dyn Fn(&Class) -> bool) -> Vec<Table> {
    let model = &job.model;
    let surroundings = model.surroundings();
    model
        .classes
        .values()
        .filter(|c| fits(c))
        .map(|class| {
            let mut table = class.object.properties(&class.name, &surroundings);
            for (index, record) in class.records.iter().enumerate() {
                let data = as_written(&record.args.data, job.units);
                let options = record.args.options.iter().map(|g| option_as_written(g, job.units));
                let words: Vec<String> = data.into_iter().chain(options).collect();
                table.note(format!("record {}: {} {}", index + 1, class.object.kind(), words.join(" ")));
            }
            table
        })
        .collect()
}

fn tables(query: &Query) -> Vec<Table> {
    let fits = query.fits();
    classes(query.job, &|class| fits(&class.name))
}
