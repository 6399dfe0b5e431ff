//! What is taken from the results of a run: tables, fatigue, statistics.

pub(crate) mod fatigue;
pub(crate) mod frequency_posts;
pub(crate) mod prcpost;
pub(crate) mod rep_select;
pub(crate) mod rod_post;
pub(crate) mod tether_post;
