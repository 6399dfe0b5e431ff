//! `EXFORCE`, `MATRICES` and `EQU_SUM` of FREQ_RESPONSE: the equations of motion about the point of the last FR_POINT.
//!
//! Source: [MOSES-REF freq_pst].

use crate::commands::menu;
use crate::commands::output::disposition::write_file;
use crate::commands::post::frequency_posts::{body, dispose};
use crate::commands::solve::equilibrium::to_diagnostic;
use crate::commands::solve::frequency::{FrequencyResults, heaving, last_points, open_results};
use crate::commands::{Call, Command, Effect, Job};
use crate::report::csv;
use nalgebra::Vector3;
use std::sync::Arc;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_language::spec::{CommandSpec, Opens, OptionSpec};
use windlass_solve::frequency::tables::modes;
use windlass_solve::frequency::{Frame, LinearSystem, diagonals, exciting_forces, matrices, stiffness};

/// EXFORCE.
pub static EXFORCE: Command = Command { spec: &EXFORCE_SPEC, edits: false, run: exciting };
/// MATRICES.
pub static MATRICES: Command = Command { spec: &MATRICES_SPEC, edits: false, run: print_matrices };
/// EQU_SUM.
pub static EQU_SUM: Command = Command { spec: &EQU_SUM_SPEC, edits: false, run: summarise };

const FILE: OptionSpec = OptionSpec::new(
    "-FILE",
    &[],
    "writes the whole matrices to PPO00001.CSV, PPO00002.CSV .. instead of printing diagonals",
);

const fn spec(name: &'static str, help: &'static str) -> CommandSpec {
    CommandSpec {
        menus: const { &[&menu::FREQ_RESPONSE] },
        example: concat!(
            heaving!(),
            "RAO\nFR_POINT 0 0 0\nEND\nEXFORCE\nREPORT\nEND\nMATRICES\nMATRICES -FILE\nEQU_SUM\nEND"
        ),
        ..CommandSpec::new(name, help)
    }
}

static EXFORCE_SPEC: CommandSpec = CommandSpec {
    opens: Opens::Menu(&menu::DISPOSITION),
    detail: "Forces and moments of unit waves on the body of the last FR_POINT about that point, along the global axes; before any FR_POINT about the \
             origin of the first body. Headings and periods are those of RAO, after SRESPONSE those of the databases.",
    ..spec("EXFORCE", "exciting forces of unit waves")
};
static MATRICES_SPEC: CommandSpec = CommandSpec {
    options: &[FILE],
    detail: "Stiffness, mass with added mass, and damping of the body of the last FR_POINT about that point (before any FR_POINT the origin of the first \
             body), along the global axes, at the periods of RAO, after SRESPONSE those of the databases. Diagonals are printed as they are, not \
             divided by the mass; -FILE writes M11 to M66, B11 to B66 and K11 to K66. Damping has what SRESPONSE has linearised.",
    ..spec("MATRICES", "mass, damping and stiffness of the equations of motion")
};
static EQU_SUM_SPEC: CommandSpec = CommandSpec {
    detail: "All of MATRICES and EXFORCE, with natural periods and damping ratios.",
    ..spec("EQU_SUM", "the equations of motion")
};

/// What equations are of: the system, the point, headings (rad) and frequencies (rad/s).
struct Equations {
    linear: Arc<LinearSystem>,
    frame: Frame,
    about: String,
    headings: Vec<f64>,
    frequencies: Vec<f64>,
}

fn equations(job: &Job, span: Span) -> Outcome<Equations> {
    let results = open_results(job, span)?;
    let (linear, headings, frequencies) = match results {
        FrequencyResults::Operators(linear, made) => (linear, made.headings.clone(), made.frequencies.clone()),
        FrequencyResults::Spectral(linear, ..) => (linear, linear.headings(), linear.frequencies()),
        FrequencyResults::Nothing => return Err(Diagnostic::error("there are no motions yet", span)),
    };
    let point = last_points(job).first();
    let (index, name) = body(job, linear, point.map(|p| p.body.as_str()), span)?;
    let at = point.map_or(Vector3::zeros(), |p| Vector3::from(p.at));
    let about = point.map_or_else(|| format!("the origin of {name}"), |p| p.name.clone());
    Ok(Equations { linear: Arc::clone(linear), frame: Frame { body: index, at }, about, headings, frequencies })
}

impl Equations {
    fn exciting(&self, job: &Job, span: Span) -> Outcome<Table> {
        let unit = Dim::Length.to_si(1.0, job.units);
        let made = exciting_forces(&self.linear, &self.frame, &self.headings, &self.frequencies, unit);
        let made = made.map_err(|e| to_diagnostic(e, &job.model, span, job.units))?;
        Ok(made.fact("About", self.about.as_str(), Dim::None))
    }

    fn print_tables(&self) -> Vec<Table> {
        let [forces, moments] = stiffness(&self.linear, &self.frame);
        let about = |table: Table| table.fact("About", self.about.as_str(), Dim::None);
        [forces, moments, diagonals(&self.linear, &self.frame, &self.frequencies)].into_iter().map(about).collect()
    }
}

fn exciting(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let span = call.args.span;
    let made = equations(job, span)?.exciting(job, span)?;
    Ok(dispose(job, made, span))
}

fn print_matrices(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let span = call.args.span;
    let made = equations(job, span)?;
    if !call.args.has(&FILE) {
        job.say_tables(&made.print_tables());
        return Ok(Effect::Done);
    }
    let table = matrices(&made.linear, &made.frame, &made.frequencies);
    job.keep_table(&table);
    let bytes = csv::bytes(&table, job.units).map_err(|e| Diagnostic::error(e.to_string(), span))?;
    let name = job.next_unnamed_file();
    write_file(job, &name, &bytes, span)?;
    Ok(Effect::Done)
}

fn summarise(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let span = call.args.span;
    let made = equations(job, span)?;
    let mut tables = made.print_tables();
    tables.extend(modes(&made.linear).map_err(|e| to_diagnostic(e, &job.model, span, job.units))?);
    tables.push(made.exciting(job, span)?);
    job.say_tables(&tables);
    Ok(Effect::Done)
}
