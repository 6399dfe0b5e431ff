//! The CONN_DESIGN menu.

use super::{Call, Command, Effect, Job, Menu};
use crate::language::diagnostic::Outcome;
use crate::language::spec::{CommandSpec, Kind, Noun, Opens, ValueSpec};
use crate::model::find;
use crate::report::disposition::Disposition;

/// TABLE.
pub static TABLE: Command = Command { spec: &TABLE_SPEC, edits: false, run: table };

static TABLE_SPEC: CommandSpec = CommandSpec {
    opens: Opens::Menu("DISPOSITION"),
    menus: &["CONN_DESIGN"],
    data: &[ValueSpec::new("LINE", Kind::Name(Noun::Connector), "connector")],
    detail: "Thirty rows with horizontal forces T (n/29)**2 up to T, the table limit or the largest breaking tension of all \
             segments; the fairlead stays at its present height. Rows beyond the breaking tension are kept and said. The \
             result goes to the disposition menu, which ends with END.",
    example: "MEDIT\n&DESCRIBE BODY TBRG\n*MLA 400 50 20\n~WIRE b_cat 4.19 -DEP 500 -LEN 4000 -BUOY 0 -WTPL .0125\n\
              CONNECTOR A -ANC -45 20 ~WIRE *MLA\nEND\nCONN_DESIGN\nTABLE A\nVIEW X Force\nEND\nEND",
    ..CommandSpec::new("TABLE", "tabulates a line")
};

fn table(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let model = &job.model;
    let connector = find(&model.connectors, call.args.word(0).unwrap_or_default(), "connector", call.args.place(0))?;
    let class = find(&model.classes, &connector.class, "class", call.args.place(0))?;
    let place = model.placement(connector);
    let line = class.object.line(&place, &model.surroundings());
    let mut made = line
        .and_then(|l| l.tabulate(&connector.name))
        .map_err(|e| e.diagnostic(call.args.place(0)).help(format!("while tabulating connector {}", connector.name)))?;
    made.facts.insert(0, ("Line Class".into(), class.name.as_str().into(), crate::language::units::Dim::None));
    // what concerns the whole table is said at once, whatever is then printed of it
    let warnings: Vec<String> =
        made.notes.iter().filter_map(|n| n.strip_prefix("warning: ")).map(str::to_string).collect();
    let span = call.args.place(0);
    warnings.into_iter().for_each(|text| job.warn(text, span));
    job.menus.push(Menu::Disposition(Box::new(Disposition::new(made))));
    Ok(Effect::Done)
}
