//! The commands that open menus, and the end of INMODEL.

use super::connector::build_connector;
use super::{Call, Command, Effect, INMODEL_FILE, Job, Menu};
use crate::language::diagnostic::{Diagnostic, Outcome};
use crate::language::spec::CommandSpec;

/// INMODEL.
pub static INMODEL: Command = Command { spec: &INMODEL_SPEC, edits: false, run: inmodel };
/// MEDIT.
pub static MEDIT: Command = Command { spec: &MEDIT_SPEC, edits: false, run: medit };
/// CONN_DESIGN.
pub static CONN_DESIGN: Command = Command { spec: &CONN_DESIGN_SPEC, edits: false, run: conn_design };

static INMODEL_SPEC: CommandSpec = CommandSpec {
    menus: &["MAIN"],
    detail: "Reads model descriptions from ROOT.DAT, or from the file of &DEVICE -AUXIN; without either the records follow \
             up to END. A CONNECTOR may name classes and points that are defined later.",
    example: "INMODEL\n&DESCRIBE BODY TBRG\nCONNECTOR A ~W *P\n*P 0 0 0\n~W B_CAT 4 -LEN 500\nEND",
    ..CommandSpec::new("INMODEL", "reads the model")
};
static MEDIT_SPEC: CommandSpec = CommandSpec {
    menus: &["MAIN"],
    detail: "Names must be defined before they are used.",
    example: "MEDIT\n*P 0 0 0\nEND",
    ..CommandSpec::new("MEDIT", "edits the model, up to END")
};
static CONN_DESIGN_SPEC: CommandSpec = CommandSpec {
    menus: &["MAIN"],
    detail: "TABLE tabulates a line.",
    example: "CONN_DESIGN\nEND",
    ..CommandSpec::new("CONN_DESIGN", "connector design, up to END")
};

fn inmodel(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let root = job.output.folder.root.clone();
    let found = match &job.settings.auxiliary {
        Some(path) if !path.exists() => {
            let text = format!("the auxiliary input {} does not exist", path.display());
            return Err(Diagnostic::error(text, call.args.span).help("set by &DEVICE -AUXIN"));
        }
        Some(path) => Some(path.clone()),
        None => ["dat", "DAT"].iter().map(|e| root.with_extension(e)).find(|p| p.exists()),
    };
    job.menus.push(Menu::Inmodel);
    Ok(match found {
        Some(path) => Effect::Insert { name: path.display().to_string(), path, tag: INMODEL_FILE },
        None => Effect::Done,
    })
}

fn medit(job: &mut Job, _: &Call) -> Outcome<Effect> {
    job.menus.push(Menu::Medit);
    Ok(Effect::Done)
}

fn conn_design(job: &mut Job, _: &Call) -> Outcome<Effect> {
    job.menus.push(Menu::ConnDesign);
    Ok(Effect::Done)
}

/// Builds the connectors that waited for names defined later; returns what is wrong with each that cannot be built.
pub fn finish_inmodel(job: &mut Job) -> Vec<Box<Diagnostic>> {
    let waiting = std::mem::take(&mut job.deferred);
    waiting.iter().filter_map(|args| build_connector(job, args).err()).collect()
}
