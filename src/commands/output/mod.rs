//! What becomes of a result: printed, plotted, stored, reduced; titles and messages.

pub(crate) mod add_column;
pub(crate) mod animate;
pub(crate) mod buildg;
pub(crate) mod disposition;
pub(crate) mod message;
pub(crate) mod moordyn_deck;
pub(crate) mod picture;
pub(crate) mod plot;
pub(crate) mod report_menu;
pub(crate) mod result;
pub(crate) mod series;
pub(crate) mod statistic;
pub(crate) mod store;
