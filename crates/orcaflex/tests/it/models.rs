//! What is read of a good model.

use super::{GOOD, read};
use windlass_orcaflex::model::Holder;
use windlass_orcaflex::records::{LineModel, records};

#[test]
fn good_model_has_the_values_of_its_file() {
    let reading = read(GOOD);
    assert!(!reading.is_failed(), "{:?}", reading.messages);
    let model = reading.model;
    assert_eq!(model.environment.depth.as_ref().map(|given| given.value), Some(100.0));
    let chain = &model.line_types[0];
    assert_eq!((chain.outer.value, chain.mass.value, chain.ea.value), (0.15, 0.2, 800e3));
    assert_eq!((chain.drag, chain.added, chain.friction), ([1.2, 0.4], [1.0, 0.07], 0.5));
    assert_eq!(model.vessels[0].position, [-35.0, 0.0, 0.0]);
    let hose = &model.lines[1];
    assert_eq!(hose.ends[0].holder.value, Holder::Vessel("FPSO".to_string()));
    assert_eq!(hose.ends[1].holder.value, Holder::Fixed);
    assert_eq!(hose.sections.iter().map(|section| section.segments).collect::<Vec<_>>(), [30, 40]);
    assert_eq!(hose.contents, 1.0);
}

#[test]
fn data_that_load_nothing_are_named_in_notes() {
    let reading = read(GOOD);
    let text: String = reading.messages.iter().map(|message| message.message.as_str()).collect();
    for name in ["LayAzimuth", "ContactPen", "GJ", "VesselType", "Groups", "DefaultViewMode"] {
        assert!(text.contains(name), "{name}: {text}");
    }
}

#[test]
fn records_of_a_model_have_its_lines_and_water() {
    let reading = read(GOOD);
    let made = records(&reading.model, LineModel::Dynamic).unwrap();
    for record in [
        "&DEFAULT -WATER 1025 -GRAVITY 9.80665 -DEPTH 100",
        "CONNECTOR CHAIN_LEG ~CHAIN_LEG *L1A *L1B",
        "CONNECTOR HOSE ~HOSE *L2A *L2B",
        "&INSTATE -LOCATE FPSO -35 0 0 0 0 0",
        "*L2A 37 0 -7.5",
    ] {
        assert!(made.text.lines().any(|line| line == record), "{record}: {}", made.text);
    }
}
