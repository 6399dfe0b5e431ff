//! Units, parameters and how the program behaves.

pub(crate) mod accepted;
pub(crate) mod device;
pub(crate) mod history;
pub(crate) mod name_list;
pub(crate) mod parameter;
pub(crate) mod units;
