//! What goes through records: the program as its user meets it.

#![allow(clippy::unwrap_used)]

mod common;

/// The terminal, files and wrong input.
mod program {
    mod command_line;
    mod disk_full;
    mod editor;
    mod file_names;
    mod film;
    mod fuzzed;
    mod hostile;
    mod lines;
    mod menus;
    mod names;
    mod never_panics;
    mod picture;
    mod varied;
}

/// Springs, lines, pipes: forces and laws.
mod connectors {
    mod along;
    mod appended_segments;
    mod bathymetry_lines;
    mod class_records;
    mod closed_form_lines;
    mod connector_closed_form;
    mod element_laws;
    mod force_on_body;
    mod laws;
    mod lift;
    mod line_classes;
    mod line_types;
    mod lmu_stages;
    mod one_catenary;
    mod pipe;
    mod pipe_under_way;
    mod pistons;
    mod pushing;
    mod rod_cantilever;
    mod rod_events;
    mod rod_growth;
    mod rod_judged;
    mod rod_loads;
    mod rod_modes;
    mod rod_program;
    mod rod_restart;
    mod rod_sections;
    mod rod_slope;
    mod rod_tethers;
    mod springs_closed_form;
}

/// Loads on bodies, equilibrium, stiffness.
mod floating {
    mod ambient;
    mod aqwa_tether_platform;
    mod bodies;
    mod equilibrium;
    mod excursion;
    mod far_starts;
    mod members;
    mod moorpy_equilibrium;
    mod moving_streams;
    mod networks;
    mod piece_loads;
    mod side_by_side;
    mod steady_loads;
    mod trial_places;
}

/// Frequency domain and time domain.
mod time {
    mod categories;
    mod drift_in_time;
    mod foretold_steps;
    mod frequency;
    mod line_scheme;
    mod low_frequency_place;
    mod members_under_way;
    mod missing_added_mass;
    mod prcpost;
    mod prescribed;
    mod screening;
    mod step_accuracy;
    mod stiff_ties;
    mod time_domain;
    mod time_runs;
    mod transient;
    mod wave_mean;
}

/// AQWA decks run by the session.
mod aqwa {
    mod aqwa_decks;
    mod aqwa_tether_fatigue;
}
