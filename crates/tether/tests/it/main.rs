//! Tethers against the listings of the AQWA-TETHER manual and closed forms.

#![allow(clippy::unwrap_used)]

mod aqwa_tether_installed;
mod aqwa_tether_towed;
mod installed_afloat;
mod installed_allocations;
mod installed_example;
mod installed_tethers;
mod towed_closed_form;
