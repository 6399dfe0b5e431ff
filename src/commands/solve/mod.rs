//! Commands that compute: equilibrium, offsets, frequency and time domain, tables of lines.

pub(crate) mod action;
pub(crate) mod conn_design;
pub(crate) mod equilibrium;
pub(crate) mod excursion;
pub(crate) mod frequency;
pub(crate) mod hstatics;
pub(crate) mod line_loss;
pub(crate) mod lines;
pub(crate) mod prescribe;
pub(crate) mod restart;
pub(crate) mod stored;
pub(crate) mod summary;
pub(crate) mod tdom;
pub(crate) mod tether_run;
pub(crate) mod vary;
