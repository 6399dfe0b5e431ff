//! Statistics and fatigue of tether records as the AQWATM-TETHER manual has them
//! [AQWA-TETHER 3.7 and 7.5 to 7.10], with its misprints mended [W-TOWED 6, misprints].
//!
//! They differ from the rest of [`super`]: a significant value is twice the deviation about the mean, peaks are turning
//! points rather than maxima between crossings, and the rainflow is that program's own.

pub mod dripping;
pub mod fatigue;
pub mod global;
pub mod tables;
