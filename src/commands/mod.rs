//! What a user can type: one file a family of commands, each command one spec and one handler.
//!
//! A handler changes the [`Job`] only after everything that can fail has been checked, so that a record that is refused
//! changes nothing; a command that edits in several steps says so with [`Command::edits`], and the session restores the
//! model when it fails.

pub mod absent;
pub mod check_list;
mod environment;
mod files;
pub mod functions;
pub mod help;
mod help_search;
mod job;
pub mod journal;
pub mod menu;
mod menus;
mod model;
mod model_values;
mod name_filter;
mod output;
mod post;
pub mod report_columns;
mod settings;
mod solve;
mod status;
pub mod undo;
pub mod verdict;

use environment::{bathymetry, curves, env};
use files::file;
pub use files::file::{LIBRARIES as SHIPPED_LIBRARIES, ShippedLibrary, write_open_files};
pub use functions::FUNCTION_HELP;
pub use job::{Checking, DeviceSettings, Job, KeptTable, Menu, MeshVertices};
pub use menus::{find_opened_menu, finish};
pub use model::block_combination::assign as assign_block;
pub use model::class::keep_refused as keep_refused_class;
pub use model::pgen::keep_refused as keep_refused_surface;
pub use model::shapes::take_shape;
use model::{
    alter, apply, assembly, block_combination, class, compartment, connector, database, describe, element,
    hydrodynamics, hydrostatic, junction, loads, names, pgen, piece, pipe, select, surface, t_pressure, wave_picture,
    weight,
};
pub use output::animate::DEFAULT_LINE_POINTS as FILM_LINE_POINTS;
pub use output::buildg::take as take_row;
use output::{
    add_column, animate, buildg, disposition, message, moordyn_deck, picture, plot, report_menu, result, series,
    statistic, store,
};
use post::{code_check, frequency_equations, frequency_posts, frequency_statistics, rep_select};
pub(crate) use settings::device::{existing, within_check};
use settings::{accepted, device, history, name_list, parameter, units};
pub(crate) use solve::line_loss::{IntactRun, check_damaged_start};
pub use solve::lines::ADDED as COLUMNS_OF_LINES;
pub use solve::stored::{StoredError, file_of_run, find_stored};
pub(crate) use solve::summary::count;
use solve::{action, conn_design, equilibrium, excursion, frequency, hstatics, lines, prescribe, tdom};
use status::summary_menu;
pub use status::{kinds as status_kinds, names as status_names, rows as status_rows};

use std::path::PathBuf;
use windlass_base::diagnostic::Outcome;
use windlass_base::values::Args;
use windlass_language::record::{Record, Word};
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, MenuSpec};
use windlass_moordyn::records::{Like, LineModel};
use windlass_orcaflex::records as orcaflex;

/// A record on its way to a handler.
pub struct Call<'a> {
    /// The record, substituted.
    pub record: &'a Record,
    /// Its words, the command word first.
    pub words: &'a [Word],
    /// Data and options, read by the command's spec (empty when the spec takes text).
    pub args: Args,
}

/// What the session has to do after a handler.
#[derive(Debug, PartialEq)]
pub enum Effect {
    /// Nothing.
    Done,
    /// Read a file next; the tag comes back when it ends.
    Insert {
        /// Name for messages.
        name: String,
        /// Where it is.
        path: PathBuf,
        /// [`PLAIN`] or [`INMODEL_FILE`].
        tag: u32,
    },
    /// Read a library of macros that ships with the program next.
    Library {
        /// Name for messages.
        name: &'static str,
        /// Its records.
        text: &'static str,
    },
    /// Read the model of a deck next.
    Deck {
        /// Name for messages.
        name: String,
        /// Where it is.
        path: PathBuf,
        /// Whose deck it is.
        format: DeckFormat,
    },
    /// End the job.
    Finish,
    /// Set the number of records a run may execute.
    Budget(u64),
    /// Set a variable.
    Set(String, String),
    /// Print this after the notices.
    Say(String),
}

/// Tag of a file that is simply inserted.
pub const PLAIN: u32 = 0;
/// Whose deck INMODEL reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DeckFormat {
    /// AQWA's card images.
    Aqwa,
    /// MoorDyn's tables, with how their lines are read and whose answer is taken where MoorDyn's is another.
    MoorDyn(LineModel, Like),
    /// OrcaFlex's text models, with how their lines are read.
    OrcaFlex(orcaflex::LineModel),
}

/// Tag of the model file INMODEL reads; its end closes the menu.
pub const INMODEL_FILE: u32 = 1;
/// Tag of the job's own script.
pub const SCRIPT: u32 = 2;
/// Tag of the records of a deck up to its motion.
pub const DECK_HEAD: u32 = 3;

/// A command: its declaration and what it does.
pub struct Command {
    /// The declaration.
    pub spec: &'static CommandSpec,
    /// True when it edits the model in several steps that may fail half way.
    pub edits: bool,
    /// What it does.
    pub run: fn(&mut Job, &Call) -> Outcome<Effect>,
}

impl PartialEq for Command {
    /// A command is its spec.
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self.spec, other.spec)
    }
}

/// Every command: those listed here and the tables of PRCPOST.
pub static COMMANDS: &[&Command] = &join_commands();

const fn join_commands() -> [&'static Command; LISTED.len() + post::TABLES.len()] {
    let mut all = [&help::HELP; LISTED.len() + post::TABLES.len()];
    let mut i = 0;
    while i < all.len() {
        all[i] = if i < LISTED.len() { LISTED[i] } else { post::TABLES[i - LISTED.len()] };
        i += 1;
    }
    all
}

/// The commands but the tables of PRCPOST, in the order of the manual.
static LISTED: &[&Command] = &[
    &menus::INMODEL,
    &menus::MEDIT,
    &menus::CONN_DESIGN,
    &menus::PRCPOST,
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
    &surface::LIST_BLOCK,
    &surface::COPY_BLOCK,
    &surface::REFLECT_BLOCK,
    &surface::EMIT,
    &surface::EMIT_ANYWHERE,
    &compartment::COMPARTMENT,
    &compartment::CMP_BAL,
    &hstatics::HSTATICS,
    &hstatics::cform::CFORM,
    &hstatics::arms::RARM,
    &hstatics::criteria::STAB_OK,
    &hstatics::kg_allow::KG_ALLOW,
    &hstatics::equi_h::EQUI_H,
    &hstatics::moment::MOMENT,
    &hstatics::tank_capacity::TANK_CAPACITY,
    &hydrodynamics::HYDRODYNAMICS,
    &hydrodynamics::G_PRESSURE,
    &hydrodynamics::G_MDRIFT,
    &hydrodynamics::I_TOTAL,
    &hydrodynamics::E_TOTAL,
    &hydrodynamics::H_ORIGIN,
    &hydrodynamics::H_EULERA,
    &hydrodynamics::H_PERIOD,
    &hydrodynamics::H_AMASS,
    &hydrodynamics::H_DAMP,
    &hydrodynamics::H_FORCE,
    &hydrodynamics::V_MATRICES,
    &hydrodynamics::V_EXFORCES,
    &hydrodynamics::V_MDRIFT,
    &wave_picture::V_WAVES,
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
    &equilibrium::EQUI,
    &frequency::FREQ_RESPONSE,
    &frequency::RAO,
    &frequency::SRESPONSE,
    &frequency_posts::MOTION,
    &frequency_posts::FR_POINT,
    &frequency_posts::CONFORCE,
    &frequency_posts::STATISTICS,
    &frequency_statistics::FR_CFORCE,
    &frequency_statistics::ST_POINT,
    &frequency_statistics::ST_CFORCE,
    &frequency_statistics::FR_FCARGO,
    &frequency_statistics::ST_FCARGO,
    &frequency_statistics::ST_CARGO,
    &frequency_equations::EXFORCE,
    &frequency_equations::MATRICES,
    &frequency_equations::EQU_SUM,
    &tdom::TDOM,
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
    &conn_design::TABLE,
    &conn_design::GEOMETRY,
    &code_check::CODE_CHECK,
    &conn_design::PROPERTIES,
    &excursion::MOVE,
    &excursion::WATCH,
    &lines::LINES,
    &disposition::REPORT,
    &disposition::VLIST,
    &disposition::VIEW,
    &store::STORE,
    &moordyn_deck::STORE_DECK,
    &plot::PLOT,
    &statistic::STATISTIC,
    &disposition::SET_VARIABLE,
    &disposition::C_SCALE,
    &disposition::C_SHIFT,
    &disposition::CULL,
    &add_column::ADD_COLUMN,
    &series::SPECTRUM,
    &series::FFT,
    &series::EXTREMES,
    &series::EXCEEDANCE,
    &series::HISTOGRAM,
    &series::RAINFLOW,
    &series::HARMONIC,
    &buildg::BUILDG,
    &rep_select::REP_SELECT,
    &status::STATUS,
    &summary_menu::SUMMARY,
    &summary_menu::CATEG_SUM,
    &summary_menu::LOADG_SUM,
    &summary_menu::POINT_SUM,
    &summary_menu::PIECE_SUM,
    &summary_menu::COMPART_SUM,
    &summary_menu::CLASS_SUM,
    &summary_menu::N_COINCIDENT,
    &summary_menu::GEOM,
    &picture::PICTURE,
    &animate::ANIMATE,
    &units::DIMEN,
    &units::DEFAULT,
    &parameter::PARAMETER,
    &name_list::VARIABLE,
    &device::DEVICE,
    &accepted::LOGDEVICE,
    &accepted::CHANNEL,
    &accepted::PI_VIEW,
    &file::FILE,
    &message::TITLE,
    &message::SUBTITLE,
    &message::TYPE,
    &message::S_BACK,
    &message::CTYPE,
    &message::CUTYPE,
    &result::RESULT,
    &message::ERROR,
    &message::DCPTIME,
    &report_menu::REPORT,
    &report_menu::TYPE,
    &report_menu::CTYPE,
    &report_menu::CUTYPE,
    &file::INSERT,
    &file::USE_MAC,
    &history::UNDO,
    &history::HISTORY,
    &history::SAVE,
    &message::FINISH,
    &help::HELP,
];

/// The internal commands, whose names the language's control records share.
pub fn internal_names() -> impl Iterator<Item = (&'static str, Owner)> {
    COMMANDS.iter().filter(|c| c.spec.name.starts_with('&')).map(|c| (c.spec.name, c.spec.owner))
}

/// The commands a menu offers: its own and those of every menu.
pub fn commands_of_menu(menu: &'static MenuSpec) -> impl Iterator<Item = &'static Command> + Clone {
    COMMANDS.iter().copied().filter(move |c| c.spec.menus.is_empty() || c.spec.menus.contains(&menu))
}
