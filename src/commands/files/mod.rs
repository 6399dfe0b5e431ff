//! Files that records read and write.

pub(crate) mod file;
pub(crate) mod number_rows;
