//! Restart stages and DATA runs of decks [AQWA-TETHER chapter 5]: the deck of the platform cut after stage 2, and gone on with.

#![allow(clippy::unwrap_used)]

use crate::common;
use windlass::session::Session;

fn whole() -> String {
    std::fs::read_to_string("scripts/mint.dat").unwrap().replace("16TIME       101", "16TIME        11")
}

/// The deck with its options and a RESTART line, from one text of it up to another.
fn part(restart: &str, from: &str, to: Option<&str>) -> String {
    let text = whole();
    let head = &text[..text.find("    01    COOR").unwrap()];
    let head = head.replace("OPTIONS END", &format!("OPTIONS REST END\n{restart}"));
    let start = text.find(from).unwrap();
    let end = to.map_or(text.len(), |to| text.find(to).unwrap());
    format!("{head}{}", &text[start..end])
}

fn positions(session: &Session) -> Vec<u64> {
    let run = session.job.tethered.as_ref().unwrap();
    run.structure.iter().flat_map(|structure| structure.rows.iter().map(|value| value.to_bits())).collect()
}

/// Stages 1 to 3 list their decks and run nothing; stages 4 and 5 take the decks before from that file and come to the numbers of the whole deck.
#[test]
fn stages_of_two_files_match_whole_deck_bit_for_bit() {
    let first = part("RESTART   1  3", "    01    COOR", Some("    09    NONE"));
    let (mut session, screen, _folder) = common::session();
    session.open_job("mint1.dat", first.as_str());
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    let text = screen.text();
    assert!(session.job.tethered.is_none() && text.contains("G L O B A L   P A R A M E T E R S"));
    assert!(!text.contains("C O N S T R A I N T S") && !text.contains("T I M E   I N T E G R A T I O N"), "{text}");
    let (mut session, screen, folder) = common::session();
    std::fs::write(folder.path().join("mint1.dat"), first).unwrap();
    session.open_job("mint.dat", part("RESTART   4  5      mint1", "    09    NONE", None));
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    // the echo is that of the decks of this file
    let text = screen.text();
    assert!(text.contains(" DECK 14\n") && !text.contains(" DECK 5\n"), "{text}");
    let (mut all, _, _folder) = common::session();
    all.open_job("mint.dat", whole());
    all.run();
    assert_eq!(positions(&session), positions(&all));
}

#[test]
fn stages_without_file_of_earlier_ones_are_refused() {
    for (restart, said) in
        [("RESTART   4  5", "this file begins after stage 1"), ("RESTART   4  5      nothing", "there is no file")]
    {
        let (mut session, _, _folder) = common::session();
        session.open_job("mint.dat", part(restart, "    09    NONE", None));
        session.run();
        assert!(session.job.tethered.is_none());
        assert!(
            session.reports.iter().any(|r| r.message.contains(said) && !r.help.is_empty()),
            "{:?}",
            session.reports
        );
    }
}

/// Stages 1, 2 and 4: the data, the tethers and their modes, how the analysis starts; no motion.
#[test]
fn data_run_lists_tethers_modes_and_start_and_runs_nothing() {
    let (mut session, screen, _folder) = common::session();
    session.open_job("mint.dat", whole().replace("OPTIONS END", "OPTIONS DATA END"));
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    let text = screen.text();
    for title in [
        "D E S C R I P T I O N   O F   T E N S I O N   L E G   T E T H E R   T 4",
        "E I G E N S O L U T I O N   M O D E   1 2   -   T E T H E R   T 1",
        "I N I T I A L   P O S I T I O N",
        "T I M E   I N T E G R A T I O N",
    ] {
        assert!(text.contains(title), "{title}");
    }
    assert!(session.job.tethered.is_none() && !text.contains("T E T H E R S   I N   T I M E"));
}
