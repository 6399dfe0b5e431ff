//! Decks that are right, by the tables of MoorDyn's input format [MOORDYN-2].

use crate::{SINGLE_LINE, read};
use windlass_base::diagnostic::Severity;
use windlass_base::span::SourceId;
use windlass_moordyn::tables::{Attachment, AxialStiffness, Height, LineEnd};

#[test]
fn single_line_of_version_2_has_its_values_and_places() {
    let reading = read(SINGLE_LINE);
    assert!(reading.messages.is_empty(), "{:#?}", reading.messages);
    let deck = reading.deck;
    let chain = &deck.line_types[0];
    assert_eq!((chain.name.value.as_str(), chain.diameter.value, chain.mass.value), ("chain", 0.1384, 182.3));
    assert_eq!((&chain.stiffness.value, chain.damping.value), (&AxialStiffness::Linear(8.2e8), -0.8));
    let coefficients = [&chain.cd_normal, &chain.ca_normal, &chain.cd_axial, &chain.ca_axial].map(|c| c.value);
    assert_eq!(coefficients, [1.33, 1.0, 0.4, 0.5]);
    let point = &deck.points[0];
    assert_eq!((point.attachment.value, point.horizontal), (Attachment::Fixed, [800.0, 0.0]));
    assert_eq!(point.height.value, Height::Given(-200.0));
    let line = &deck.lines[0];
    assert_eq!((line.length.value, line.segments.value), (850.0, 50));
    assert_eq!(line.ends.each_ref().map(|end| end.value), [LineEnd::Point(1), LineEnd::Point(2)]);
    assert_eq!(&SINGLE_LINE[line.length.span.start as usize..line.length.span.end as usize], "850");
    assert_eq!(deck.options.depth.unwrap().value, 200.0);
    assert_eq!(deck.options.unused[0].0.value, "dtM");
    assert_eq!(deck.outputs.len(), 2);
}

#[test]
fn version_1_columns_are_taken_by_their_names() {
    let text = "\
---------------------- LINE DICTIONARY ---
LineType  Diam  MassDenInAir  EA  BA/-zeta  Can Cat Cdn Cdt
(-) (m) (kg/m) (N) (-) (-) (-) (-) (-)
main  0.0766  113.35  7.536E8  -1.0  1.0  0.25  1.6  0.1
---------------------- CONNECTION PROPERTIES ---
Node Type X Y Z M V FX FY FZ CdA CA
(-) (-) (m) (m) (m) (kg) (m^3) (kN) (kN) (kN) (m2) ()
1 Fixed   418.8 725.383 -200 0 0 0 0 0 0 0
2 Connect 20.434 35.393 -14 100 0.5 1 2 3 4 0.6
---------------------- LINE PROPERTIES ---
Line LineType UnstrLen NumSegs NodeAnch NodeFair Flags/Outputs
(-) (-) (m) (-) (-) (-) (-)
1 main 835.35 20 1 2 pt
";
    let reading = read(text);
    assert!(!reading.is_failed(), "{:#?}", reading.messages);
    let warnings: Vec<&str> = reading.messages.iter().map(|message| message.message.as_str()).collect();
    let (order, unit) = (
        "columns stand in another order than in MoorDyn v2",
        "the line of units has (kN), and MoorDyn takes all numbers in N, m, kg and s: so they are taken",
    );
    assert_eq!(warnings, [order, unit, order]);
    let main = &reading.deck.line_types[0];
    let coefficients = [&main.ca_normal, &main.ca_axial, &main.cd_normal, &main.cd_axial].map(|c| c.value);
    assert_eq!(coefficients, [1.0, 0.25, 1.6, 0.1]);
    assert_eq!(main.bending.value, 0.0);
    let point = &reading.deck.points[1];
    assert_eq!((point.force, point.drag_area.value, point.added_mass.value), ([1.0, 2.0, 3.0], 4.0, 0.6));
    let line = &reading.deck.lines[0];
    assert_eq!((line.length.value, line.segments.value, line.ends[1].value), (835.35, 20, LineEnd::Point(2)));
}

#[test]
fn rows_that_would_be_lost_and_wrong_numbers_are_errors() {
    let deck = |bodies: &str, rods: &str, units: &str, lines: &str| {
        format!(
            "--- BODIES ---\nID Attachment X0 Y0 Z0 r0 p0 y0 Mass CG* I* Volume CdA* Ca*\n(#) (word) (m) (m) (m) (deg) (deg) (deg) (kg) (m) (kg-m^2) (m^3) (m^2) (-)\n{bodies}\n\
             --- RODS ---\nID RodType Attachment Xa Ya Za Xb Yb Zb NumSegs RodOutputs\n(#) (name) (word) (m) (m) (m) (m) (m) (m) (-) (-)\n{rods}\n\
             --- LINES ---\nID LineType AttachA AttachB UnstrLen NumSegs Outputs\n{units}{lines}\n"
        )
    };
    let (body, rod) = ("1 Free 0 0 -40 0 0 0 6e4 0 4e5 100 30 0.5", "1 spar Free 0 0 -50 0 0 -20 10 -");
    let (units, line) = ("(#) (name) (#) (#) (m) (-) (-)\n", "1 chain 1 2 850 50 -");
    let errors = |text: &str| -> Vec<String> {
        let errors = read(text).messages.into_iter().filter(|message| message.severity == Severity::Error);
        errors.map(|message| message.message.clone()).collect()
    };
    let own = |text: &str, wanted: &str| {
        let found = errors(text);
        assert!(found.iter().any(|message| message.contains(wanted)), "{wanted}: {found:?}");
    };
    for (change, wanted) in [("-4e5", "I is -400000"), ("4e5|4e5|-3e5", "I is -300000")] {
        own(&deck(&body.replace("4e5", change), rod, units, line), wanted);
    }
    own(&deck(&body.replace(" 30 ", " 30|-900 "), rod, units, line), "CdA is -900");
    own(&deck(&body.replace("0.5", "-0.5"), rod, units, line), "Ca is -0.5");
    own(
        &deck(body, &rod.replace("10 -", "0 -"), units, line),
        "NumSegs is 0, which makes a rod without length, and its ends are 30 m apart",
    );
    own(&deck(body, rod, "", line), "a row of values stands where the line of units is");
    own(&deck(body, rod, units, &format!("{line}\n2 chain 1 2 860 50 - --- spare leg")), "and this one holds values");
    own(
        &deck(body, rod, units, &format!("{line}\n--- lines of spread B\n2 chain 1 2 860 50 -")),
        "a row of values stands where the line of names of columns is",
    );
    let profile = |text: &str| windlass_moordyn::files::current_profile(text, SourceId::default());
    assert!(
        profile("-200 0.1 0 0\n-100 0.1 0 0\n-50 0.1 0 0\n0 1 0 0\n")
            .unwrap_err()
            .message
            .contains("among the 3 lines of heads")
    );
    assert_eq!(profile("h\nn\nu\n-200 0.1 0 0\n0 1 0 0\n").unwrap().rows.len(), 2);
}

#[test]
fn bodies_and_rods_are_read_with_their_attachments() {
    let text = "\
--- ROD TYPES ---
TypeName Diam Mass/m Cd Ca CdEnd CaEnd
(name) (m) (kg/m) (-) (-) (-) (-)
spar 1.5 400 0.6 1 1.2 0.9
--- BODIES ---
ID Attachment X0 Y0 Z0 r0 p0 y0 Mass CG* I* Volume CdA* Ca*
(#) (word) (m) (m) (m) (deg) (deg) (deg) (kg) (m) (kg-m^2) (m^3) (m^2) (-)
1 Free 1 2 -3 4 5 6 1e4 0|0|-1.5 1e5 9 1|2|3 0.5
--- RODS ---
ID RodType Attachment Xa Ya Za Xb Yb Zb NumSegs RodOutputs
(#) (name) (word) (m) (m) (m) (m) (m) (m) (-) (-)
1 spar Body1Pinned 0 0 0 0 0 12 10 p
2 spar Pinned 0 0 -50 0 0 -50 0 -
";
    let reading = read(text);
    assert!(reading.messages.is_empty(), "{:#?}", reading.messages);
    let body = &reading.deck.bodies[0];
    assert_eq!(body.place, [1.0, 2.0, -3.0, 4.0, 5.0, 6.0]);
    assert_eq!((&body.centre.value[..], &body.inertia.value[..]), (&[0.0, 0.0, -1.5][..], &[1e5][..]));
    assert_eq!(reading.deck.rods[0].attachment.value, Attachment::BodyPinned(1));
    assert_eq!(reading.deck.rods[1].attachment.value, Attachment::Pinned);
    assert_eq!(reading.deck.rods[1].ends, [[0.0, 0.0, -50.0]; 2]);
}

#[test]
fn moorpy_dialect_has_tabs_seabed_points_and_short_line_types() {
    let text = SINGLE_LINE.replace("-200   0 ", "seabed\t0\t").replace("chain      1 ", "chain P1");
    let reading = read(&text);
    assert!(reading.messages.is_empty(), "{:#?}", reading.messages);
    assert_eq!(reading.deck.points[0].height.value, Height::Seabed);
    let short = "--- LINE TYPES ---\nTypeName Diam Mass/m EA\n(-) (m) (kg/m) (N)\nrope 0.2 30 \"rope.txt\"\n";
    let kind = &read(short).deck.line_types[0];
    assert_eq!(kind.stiffness.value, AxialStiffness::Table("rope.txt".to_string()));
}

#[test]
fn ends_of_lines_have_six_forms() {
    let rod = "--- ROD TYPES ---\nTypeName Diam Mass/m Cd Ca CdEnd CaEnd\n-\nr 1 1 0 0 0 0\n--- RODS ---\nID RodType Attachment Xa Ya Za Xb Yb Zb NumSegs\n-\n1 r Free 0 0 0 0 0 9 1\n";
    for (word, end) in [
        ("p2", LineEnd::Point(2)),
        ("Point2", LineEnd::Point(2)),
        ("C2", LineEnd::Point(2)),
        ("Con2", LineEnd::Point(2)),
        ("R1A", LineEnd::RodA(1)),
        ("rod1b", LineEnd::RodB(1)),
    ] {
        let text = SINGLE_LINE.replace("1        2        850", &format!("1 {word} 850")) + rod;
        let reading = read(&text);
        assert!(reading.messages.is_empty(), "{word}: {:#?}", reading.messages);
        assert_eq!(reading.deck.lines[0].ends[1].value, end);
    }
}

#[test]
fn version_1_coefficients_in_a_version_2_table_are_taken_by_name_with_a_warning() {
    // MoorDyn 2 reads Cd 1, Ca 0.25, CdAx 1.6 from this row
    let text =
        SINGLE_LINE.replace("Cd   Ca   CdAx  CaAx", "Can Cat Cdn Cdt").replace("1.33 1.0  0.4   0.5", "1 0.25 1.6 0.1");
    let reading = read(&text);
    assert_eq!(reading.messages.len(), 1);
    let message = &reading.messages[0];
    let span = message.span.unwrap();
    assert_eq!(&text[span.start as usize..span.end as usize], "Cdn");
    assert!(message.message.contains("another order") && !reading.is_failed());
    let kind = &reading.deck.line_types[0];
    assert_eq!((kind.cd_normal.value, kind.ca_normal.value, kind.ca_axial.value), (1.6, 1.0, 0.25));
}

#[test]
fn density_may_be_zero() {
    let reading = read(&SINGLE_LINE.replace("1e6     kBot", "0.0 WtrDnsty"));
    assert!(reading.messages.is_empty());
    assert_eq!(reading.deck.options.density.unwrap().value, 0.0);
}

#[test]
fn written_deck_reads_back_as_the_deck_it_was_written_of() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/data/moordyn");
    for name in [
        "grounded_chain",
        "bridle",
        "point_force",
        "free_body",
        "rod_hung",
        "rod_pinned",
        "seafloor",
        "rope_table",
        "waves",
    ] {
        let text = std::fs::read_to_string(format!("{folder}/{name}.txt")).unwrap();
        let first = read(&text).deck;
        let again = read(&windlass_moordyn::write::text(&first, &["a --- head".to_string()]));
        assert!(!again.is_failed(), "{name}: {:?}", again.messages);
        // the same values at other places: a second writing is the same text
        let written = |deck| windlass_moordyn::write::text(deck, &[]);
        assert_eq!(written(&first), written(&again.deck), "{name}");
        assert_eq!(first.lines.len(), again.deck.lines.len(), "{name}");
        // written by hand in the file
        let last = again.deck.lines.last().map(|line| line.length.value);
        assert_eq!(first.lines.last().map(|line| line.length.value), last, "{name}");
    }
}
