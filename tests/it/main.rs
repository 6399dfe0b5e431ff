//! What goes through records: the program as its user meets it.

#![allow(clippy::unwrap_used)]

mod common;

/// The terminal, files and wrong input.
mod program {
    mod absent_records;
    mod command_line;
    mod consequences;
    mod disk_full;
    mod editor;
    mod file_names;
    mod film;
    mod format_scripts;
    mod functions;
    mod fuzz_corpus;
    mod hosted;
    mod hostile_input;
    mod lines;
    mod live_page;
    mod lsp;
    mod macro_libraries;
    mod manual_blocks;
    mod menus;
    mod moses_records;
    mod moses_status;
    mod names;
    mod never_panics;
    mod picture;
    mod results;
    mod script_check;
    mod stored_run;
    mod study;
    mod study_losses;
    mod study_parts;
    mod study_tables;
    mod table_vary;
    mod terminal;
    mod undo;
    mod verification;
}

/// Springs, lines, pipes: forces and laws.
mod connectors {
    mod appended_segments;
    mod bathymetry_lines;
    mod class_records;
    mod closed_form_lines;
    mod code_check;
    mod connector_closed_form;
    mod dynamic_line_cantilever;
    mod dynamic_line_checks;
    mod dynamic_line_closed_forms;
    mod dynamic_line_events;
    mod dynamic_line_growth;
    mod dynamic_line_loads;
    mod dynamic_line_modes;
    mod dynamic_line_restart;
    mod dynamic_line_results;
    mod dynamic_line_sections;
    mod dynamic_line_slope;
    mod dynamic_line_tethers;
    mod element_laws;
    mod exact_catenary;
    mod force_on_body;
    mod lift;
    mod line_classes;
    mod line_laws;
    mod line_types;
    mod lmu_stages;
    mod negative_tension;
    mod pipe;
    mod pipe_time_domain;
    mod pistons;
    mod pulleys;
    mod springs_closed_form;
}

/// Loads on bodies, equilibrium, stiffness.
mod floating {
    mod ambient;
    mod aqwa_tether_platform;
    mod bodies;
    mod compartments;
    mod equilibrium;
    mod equilibrium_distant_starts;
    mod equilibrium_trials;
    mod excursion;
    mod hydrostatics_menu;
    mod members;
    mod moordyn_decks;
    mod moordyn_written;
    mod moorpy_equilibrium;
    mod moses_blocks;
    mod moses_hulls;
    mod moses_weights;
    mod networks;
    mod orcaflex_models;
    mod panel_forces;
    mod piece_loads;
    mod quay;
    mod semi_panels;
    mod semi_study;
    mod side_by_side;
    mod steady_loads;
    mod structure;
    mod unmodelled_effects;
    mod wave_pictures;
    mod wind_current_time_domain;
}

/// Frequency domain and time domain.
mod time {
    mod categories;
    mod drift_time_domain;
    mod fix_connectors;
    mod frequency;
    mod given_waves;
    mod line_scheme;
    mod low_frequency_position;
    mod lumps;
    mod members_time_domain;
    mod missing_added_mass;
    mod moses_posts;
    mod prcpost;
    mod prescribed_motion;
    mod run_start;
    mod screening;
    mod step_accuracy;
    mod step_prediction;
    mod tether_restart;
    mod time_domain;
    mod time_runs;
    mod transient;
    mod typed_database;
    mod wave_drift_damping;
    mod wave_mean;
}

/// AQWA decks run by the session.
mod aqwa {
    mod aqwa_decks;
    mod aqwa_listing;
    mod aqwa_stages;
    mod aqwa_tether_fatigue;
    mod aqwa_tether_statistics;
    mod deck_cards;
    mod deck_lines;
    mod deck_panels;
    mod deck_tethers;
}
