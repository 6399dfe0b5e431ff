//! The example decks of the AQWA-TETHER manual, card by card.

#![allow(clippy::unwrap_used)]

mod columns;
mod seed_003_decks;
