//! Tables, seeds, and studies that are stopped half way.

#![allow(clippy::unwrap_used)]

mod stopped_studies;
mod tables;
