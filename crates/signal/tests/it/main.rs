//! Series against numpy, scipy and published rainflow and fatigue.

mod post;
