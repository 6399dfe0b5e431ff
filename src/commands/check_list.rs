//! What a check of a script does with each command: it runs what makes the model, and reads the words of everything else.

use super::{
    Call, Command, accepted, action, alter, apply, assembly, bathymetry, block_combination, buildg, class, compartment,
    connector, curves, database, describe, device, disposition, element, env, file, hydrodynamics, hydrostatic,
    junction, loads, menus, message, name_list, names, parameter, pgen, piece, pipe, prescribe, rep_select, select,
    status, surface, t_pressure, units, weight,
};
use crate::commands::solve::hstatics::equi_h;
use crate::commands::solve::{equilibrium, tdom};
use windlass_base::diagnostic::Outcome;

/// Commands that a check runs: they change the model or say what is read next, and neither solve for a place, nor write, nor print.
static RUN: &[&Command] = &[
    &menus::INMODEL,
    &menus::MEDIT,
    &describe::DESCRIBE,
    &describe::POINT,
    &describe::INSTATE,
    &loads::AREA,
    &loads::PLATE,
    &loads::TABLE,
    &loads::DRIFT,
    &loads::DRAG,
    &loads::DAMP,
    &loads::AMASS,
    &loads::BUOY,
    &loads::FORCE,
    &loads::LUMP,
    &loads::TANAKA,
    &loads::ROLL_DAMPING,
    &loads::TANKER,
    &apply::APPLY,
    &weight::ITEM,
    &weight::WEIGHT,
    &hydrostatic::HYDROSTATIC,
    &database::DATABASE,
    &piece::PANEL,
    &pgen::PGEN,
    &pgen::PLANE,
    &surface::SURFACE,
    &surface::BLOCK,
    &surface::MESH,
    &surface::TUBE,
    &surface::VERTEX,
    &block_combination::UNION,
    &block_combination::INTERSECT,
    &block_combination::DIFFERENCE,
    &block_combination::RENAME_BLOCK,
    &block_combination::DELETE_BLOCK,
    &block_combination::TUBTANK,
    &surface::MOVE_BLOCK,
    &surface::COPY_BLOCK,
    &surface::REFLECT_BLOCK,
    &surface::EMIT,
    &surface::EMIT_ANYWHERE,
    &compartment::COMPARTMENT,
    &hydrodynamics::HYDRODYNAMICS,
    &hydrodynamics::G_PRESSURE,
    &hydrodynamics::G_MDRIFT,
    &hydrodynamics::I_TOTAL,
    &hydrodynamics::H_ORIGIN,
    &hydrodynamics::H_EULERA,
    &hydrodynamics::H_PERIOD,
    &hydrodynamics::H_AMASS,
    &hydrodynamics::H_DAMP,
    &hydrodynamics::H_FORCE,
    &class::CLASS,
    &connector::CONNECTOR,
    &element::BEAM,
    &element::PLATE,
    &junction::JUNCTION,
    &assembly::ASSEMBLY,
    &pipe::PIPE_COMMAND,
    &prescribe::PRESCRIBE,
    &names::DELETE,
    &names::RENAME,
    &alter::ALTER,
    &action::ACTION,
    &select::SELECT,
    &select::SELECTOR,
    &env::ENV,
    &env::NAMED_ENV,
    &curves::DATA,
    &curves::C_PROFILE,
    &curves::P_SPECTRUM,
    &curves::F_SPECTRUM,
    &curves::M_GROWTH,
    &curves::W_HISTORY,
    &curves::C_HISTORY,
    &curves::S_HISTORY,
    &curves::LT_MULTIPLIER,
    &curves::CT_LENGTH,
    &curves::EFFICIENCY,
    &curves::CS_VELOCITY,
    &curves::AM_PRESSURE,
    &bathymetry::BATHYMETRY,
    &bathymetry::X,
    &bathymetry::Y,
    &t_pressure::T_PRESSURE,
    &rep_select::REP_SELECT,
    &units::DIMEN,
    &units::DEFAULT,
    &parameter::PARAMETER,
    &device::DEVICE,
    &name_list::VARIABLE,
    &message::TITLE,
    &message::SUBTITLE,
    &message::FINISH,
    &file::INSERT,
    &file::USE_MAC,
];

/// Commands whose places and forces functions ask for afterwards.
static SOLVE: &[&Command] = &[&equilibrium::EQUI, &tdom::TDOM, &compartment::CMP_BAL, &equi_h::EQUI_H];

/// Commands whose rows follow, or stand in a file that the script itself may have written.
static WITH_ROWS: &[&Command] = &[&buildg::BUILDG];

/// Commands that put results into a variable, their first word.
static SET_VARIABLE: &[&Command] = &[&disposition::SET_VARIABLE];

/// Commands that are accepted and change nothing.
static WITHOUT_EFFECT: &[&Command] = &[&accepted::LOGDEVICE, &accepted::CHANNEL, &accepted::PI_VIEW];

/// What a command is to a check.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CheckedAs {
    /// It is run.
    Run,
    /// Its words are read, and what is known of places and forces is so no longer.
    Solve,
    /// Its words are read, and the variable it sets is not known.
    SetVariable,
    /// It is run where its rows follow; those of a file may be results, and are not read.
    RunWithRows,
    /// Its words are read; it changes nothing in a run either.
    WithoutEffect,
    /// Its words are read.
    Read,
}

impl CheckedAs {
    /// That of a command.
    pub fn from_command(command: &'static Command) -> Self {
        let lists = [
            (RUN, CheckedAs::Run),
            (SOLVE, CheckedAs::Solve),
            (SET_VARIABLE, CheckedAs::SetVariable),
            (WITH_ROWS, CheckedAs::RunWithRows),
            (WITHOUT_EFFECT, CheckedAs::WithoutEffect),
        ];
        let listed = lists.into_iter().find(|(list, _)| list.contains(&command));
        listed.map_or(CheckedAs::Read, |(_, how)| how)
    }
}

/// What a command that is not run in a check would refuse, beside what its spec says.
///
/// # Errors
/// A word that names nothing.
pub fn check_words(command: &Command, call: &Call) -> Outcome<()> {
    if *command == status::STATUS { status::check_kind(call) } else { Ok(()) }
}
