//! Everything that leaves the program: formatted tables, listings, plots, files, and the channels they go to. It reads
//! tables and knows nothing of commands.

pub mod columns;
pub mod csv;
pub mod disposition;
pub(crate) mod embedded;
pub mod files;
pub mod film;
pub mod format;
pub mod live;
pub mod netcdf;
pub mod output;
pub mod page;
pub mod pager;
pub mod parquet;
pub mod picture;
pub mod plot;
pub mod pressure_file;
pub mod readback;
pub mod run_log;
pub mod statistic;
pub mod stored;
pub mod taken_state;
pub mod wave_picture;
pub mod xlsx;
