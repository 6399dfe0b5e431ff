//! The example decks of the AQWA-TETHER manual, card by card.

#![allow(clippy::unwrap_used)]

mod aqwa_tether_decks;
mod bad_input;
mod columns;
mod deck_messages;
mod listing;
