//! What is taken from the results of a run: tables, fatigue, statistics.

pub(crate) mod body_forces;
pub(crate) mod code_check;
pub(crate) mod connector_forces;
pub(crate) mod drafts;
pub(crate) mod element_forces;
pub(crate) mod fatigue;
pub(crate) mod force_magnitudes;
pub(crate) mod fractiles;
pub(crate) mod frequency_equations;
pub(crate) mod frequency_posts;
pub(crate) mod frequency_statistics;
pub(crate) mod group_forces;
pub(crate) mod lengths;
pub(crate) mod motions;
pub(crate) mod points;
pub(crate) mod prcpost;
pub(crate) mod relative;
pub(crate) mod rep_select;
pub(crate) mod report;
pub(crate) mod rod;
pub(crate) mod sensors;
pub(crate) mod structure;
pub(crate) mod tanks;
pub(crate) mod tether;
pub(crate) mod total_forces;

use crate::commands::Command;

/// The tables of PRCPOST, in the order of the help.
pub static TABLES: &[&Command] = &[
    &motions::TRAJECTORY,
    &points::POINTS,
    &relative::REL_MOTION,
    &relative::P_MIN_DISTANCE,
    &drafts::DRAFT,
    &sensors::SENSOR,
    &connector_forces::CONFORCE,
    &force_magnitudes::CF_MAGNITUDE,
    &fractiles::CF_FRACTILES,
    &total_forces::TOT_CFORCE,
    &lengths::C_LENGTH,
    &body_forces::BODY_FORCE,
    &element_forces::ELMFORCE,
    &group_forces::LDGFORCE,
    &tanks::TANK_BAL,
    &tanks::TANK_FLD,
    &tanks::HOLE_FLOODING,
    &fatigue::FATIGUE,
    &rod::ROD,
    &tether::TETHER,
    &structure::STRUCTURE,
];
