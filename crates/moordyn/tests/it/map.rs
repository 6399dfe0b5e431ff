//! Files of MAP++, by the tables of its documents and its source [MAP-PP].

use crate::read;
use windlass_moordyn::tables::{Attachment, AxialStiffness, Height, LineEnd};

const BRIDLE: &str = "\
--------------- LINE DICTIONARY ---------------
LineType  Diam  MassDenInAir  EA  CB  CIntDamp  Ca  Cdn  Cdt
(-)  (m)  (kg/m)  (N)  (-)  (Pa-s)  (-)  (-)  (-)
Steel  0.25  320  9.8e9  0.5  -999.9  -999.9  -999.9  -999.9
--------------- NODE PROPERTIES ---------------
Node Type X Y Z M B FX FY FZ
[-] [-] [m] [m] [m] [kg] [m^3] [N] [N] [N]
1 fix 400 30 depth 0 0 # # #
2 CONNECT #90 #10 #-80 50 0.2 1000 200 -300
3 vessel 20 20 -10 0 0 #5 # #
--------------- LINE PROPERTIES ---------------
Line LineType UnstrLen NodeAnch NodeFair Flags
(-) (-) (m) (-) (-) (-)
1 steel 450 1 2 plot gx_pos seg_size 10
2 STEEL 90 2 3 omit_contact
--------------- SOLVER OPTIONS ---------------
Option
(-)
help
repeat 90
";

#[test]
fn file_of_map_has_its_values_and_the_copies_of_repeat() {
    let reading = read(BRIDLE);
    assert!(reading.messages.is_empty(), "{:#?}", reading.messages);
    let deck = reading.deck;
    let steel = &deck.line_types[0];
    assert_eq!((&steel.stiffness.value, steel.friction.as_ref().unwrap().value), (&AxialStiffness::Linear(9.8e9), 0.5));
    assert_eq!(deck.points.len(), 6);
    let kinds: Vec<Attachment> = deck.points.iter().map(|point| point.attachment.value).collect();
    assert_eq!(kinds[..3], [Attachment::Fixed, Attachment::Free, Attachment::Coupled]);
    assert_eq!(deck.points[0].height.value, Height::Seabed);
    assert_eq!((deck.points[1].mass.value, deck.points[1].volume.value), (50.0, 0.2));
    // a turn of 90 degrees is clockwise seen from above: x to -y
    let [x, y] = deck.points[4].horizontal;
    assert!((x - 10.0).abs() < 1e-9 && (y + 90.0).abs() < 1e-9, "{x} {y}");
    let [fx, fy, fz] = deck.points[4].force;
    assert!((fx - 200.0).abs() < 1e-9 && (fy + 1000.0).abs() < 1e-9 && fz == -300.0);
    assert_eq!(deck.lines[3].ends.each_ref().map(|end| end.value), [LineEnd::Point(5), LineEnd::Point(6)]);
    assert_eq!(deck.lines[3].id.value, 4);
    assert!(deck.lines[0].has_contact && !deck.lines[1].has_contact);
    // names of types are the same in any case
    assert_eq!(deck.lines[1].line_type.value, "Steel");
}

/// The one message of a file after a replacement: the word it stands at, and all that it says.
fn said(from: &str, to: &str, is_failed: bool) -> (String, String) {
    assert!(BRIDLE.contains(from), "{from}");
    let text = BRIDLE.replacen(from, to, 1);
    let reading = read(&text);
    assert_eq!(reading.is_failed(), is_failed, "{to}: {:#?}", reading.messages);
    assert_eq!(reading.messages.len(), 1, "{to}: {:#?}", reading.messages);
    let message = &reading.messages[0];
    let span = message.span.unwrap();
    let word = text[span.start as usize..span.end as usize].to_string();
    (word, format!("{}; {}; {}", message.message, message.label, message.help.join(" ")))
}

#[test]
fn wrong_words_of_a_file_of_map_are_errors_at_the_word() {
    for (from, to, word, says) in [
        ("9.8e9", "kevlar", "kevlar", "EA is not a number"),
        ("0.5  -999.9", "-999.9  -999.9", "-999.9", "0 or more"),
        ("1 fix 400", "1 fixed 400", "fixed", "expected Fix, Connect or Vessel"),
        ("vessel 20 20 -10", "vessel 20 20 depth", "depth", "only a Fix node"),
        ("fix 400", "fix #400", "#400", "to be found"),
        ("0.2 1000", "0.2 #", "#", "of type Fix"),
        ("0.2 1000", "-0.2 1000", "-0.2", "0 or more"),
        ("omit_contact", "omit_contacts", "omit_contacts", "did you mean OMIT_CONTACT"),
        ("omit_contact", "linear_spring", "linear_spring", "not read"),
        ("omit_contact", "damage_time 30", "damage_time", "&ACTION"),
        ("seg_size 10", "seg_size", "seg_size", "has no number"),
        ("help\n", "hepl\n", "hepl", "did you mean HELP"),
        ("repeat 90", "repeat", "repeat", "has no angle"),
        ("repeat 90", "repeat x", "x", "not a number"),
        ("1 steel 450", "1 steal 450", "steal", "did you mean Steel"),
        ("1 steel 450", "1 steel 0", "0", "must be greater than 0"),
        ("2 3 omit", "2 9 omit", "9", "the last point is 3"),
        ("Option\n(-)\n", "repeat 90\n(-)\n", "repeat", "passes over the two lines"),
    ] {
        let (found, text) = said(from, to, true);
        assert_eq!(found, word, "{text}");
        assert!(text.contains(says), "{to}: {text}");
    }
}

#[test]
fn what_map_passes_over_is_remarked() {
    let (word, text) = said("repeat 90", " repeat 90", false);
    assert!(word == "repeat" && text.contains("begins with a blank"), "{text}");
    let (word, text) = said("steel 450", "steel #450", false);
    assert!(word == "#450" && text.contains("has no unknown lengths"), "{text}");
    let (word, text) = said("#90 #10", "# #10", false);
    assert!(word == "#" && text.contains("begins at 0"), "{text}");
}

#[test]
fn any_beginning_of_a_file_of_map_is_answered() {
    for end in 0..BRIDLE.len() {
        read(&BRIDLE[..end]);
    }
    let many = format!("repeat{}", " 1".repeat(30_000));
    assert!(read(&BRIDLE.replace("repeat 90", &many)).is_failed());
}
