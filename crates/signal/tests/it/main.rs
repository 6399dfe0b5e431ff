//! Series against numpy, scipy and published rainflow and fatigue.

#![allow(clippy::unwrap_used)]

mod post;
