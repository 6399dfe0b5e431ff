//! A film as files: one page that shows it in any browser, or a series that ParaView reads.

mod page;
mod vtk;

pub use page::page;
pub use vtk::{VtkStep, series, steps};
