//! The static line against exact lines, closed forms and its own laws.

#![allow(clippy::unwrap_used)]

mod catenary_2000;
mod catenary_bottoms;
mod catenary_four_segment;
mod catenary_integration;
mod catenary_lines;
mod catenary_properties;
mod catenary_shape;
mod catenary_two_ways;
mod line_forces;
mod random;
