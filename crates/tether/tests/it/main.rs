//! Tethers against the listings of the AQWA-TETHER manual and closed forms.

#![allow(clippy::unwrap_used)]

mod installed_afloat;
mod installed_allocations;
mod installed_example;
mod installed_tethers;
mod seed_003_installed;
mod seed_003_towed;
mod towed_closed_form;
