//! Records that build the model: bodies, loads, hulls, classes, connectors, and what changes them.

pub(crate) mod alter;
pub(crate) mod apply;
pub(crate) mod assembly;
pub(crate) mod class;
pub(crate) mod compartment;
pub(crate) mod connector;
pub(crate) mod database;
pub(crate) mod describe;
pub(crate) mod draft_mark;
pub(crate) mod hydrodynamics;
pub(crate) mod hydrostatic;
pub(crate) mod junction;
pub(crate) mod loads;
pub(crate) mod member;
pub(crate) mod names;
pub(crate) mod pgen;
pub(crate) mod piece;
pub(crate) mod pipe;
pub(crate) mod process;
pub(crate) mod rigging;
pub(crate) mod select;
pub(crate) mod sensor;
pub(crate) mod surface;
pub(crate) mod t_pressure;
pub(crate) mod tether_ends;
pub(crate) mod weight;
