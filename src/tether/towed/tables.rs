//! Tables of the records of a towed tether.
