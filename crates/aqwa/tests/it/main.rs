//! The example decks of the AQWA-TETHER manual, card by card.

mod seed_003_decks;
