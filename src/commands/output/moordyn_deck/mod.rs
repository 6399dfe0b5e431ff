//! `STORE -MOORDYN`: the system as a deck of MoorDyn.

mod bodies;
mod lines;
mod system;
mod water;

use crate::commands::menu;
use crate::commands::output::disposition::write_file;
use crate::commands::{Call, Command, Effect, Job};
use system::DeckWriter;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec};

/// STORE of the main menu.
pub static STORE_DECK: Command = Command { spec: &SPEC, edits: false, run };

const MOORDYN: OptionSpec = OptionSpec::new(
    "-MOORDYN",
    &[ValueSpec::new("FILE", Kind::File, "the deck; a relative name is inside the job's folder")],
    "writes the system as a deck of MoorDyn 2, which MoorPy reads too",
)
.owner(Owner::Ours);

static SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: &[&menu::MAIN],
    options: &[MOORDYN],
    detail: "Lines with their anchors, fairleads, clumps and junctions, free bodies of weights, #LUMP, #FORCE and TUBE, depth, density and g, friction, seabed, current, waves \
             and bathymetry, as they stand. What a program moves has Coupled points: those of the body VESSEL, of bodies with a hull, a database or \
             other loads, where they stand in space; other bodies with PRESCRIBE are Coupled bodies. A line of several segments is as many lines with free points between. \
             Quasi-static lines have 40 segments, or those of -REFINE. Bathymetry, current, waves and tables of stiffness are files beside the deck: current_profile.txt and \
             wave_frequencies.txt have no other name in MoorDyn. What a deck cannot hold is an error that names it, and nothing is written. `INMODEL -MOORDYN` reads the deck back.",
    example: "&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH 100\nMEDIT\n&DESCRIBE BODY VESSEL\n*F 0 0 -5\nPRESCRIBE VESSEL -SINUSOID X 1 12\n~LEG B_CAT 100 -LEN 250 -WTPLEN 1.5\n\
              CONNECTOR L1 -ANC 30 210 ~LEG *F\nEND\nSTORE -MOORDYN lines.txt",
    ..CommandSpec::new("STORE", "writes the system as a deck of another program")
};

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let Some(given) = args.option(&MOORDYN) else {
        let error = Diagnostic::error("STORE of the main menu writes a deck: no -MOORDYN is given", args.span);
        return Err(error.help("columns of a result are stored in the menu that the result opens"));
    };
    let Some((name, span)) = given.values.first().and_then(|value| Some((value.word()?, value.span))) else {
        return Err(Diagnostic::error("-MOORDYN lacks the name of the deck", given.span));
    };
    let written = DeckWriter::new(job, name, args.span)?.write()?;
    // a deck whose files are not there could not be read: it comes last
    for (file, text) in &written.files {
        write_file(job, file, text.as_bytes(), span)?;
    }
    write_file(job, name, written.text.as_bytes(), span)?;
    job.notices.extend(written.notes);
    Ok(Effect::Done)
}
