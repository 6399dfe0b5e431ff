use super::*;
use crate::flow::specs::CONTROL;
use proptest::prelude::*;

const INTERNAL: [(&str, Owner); 15] = {
    let mut names = [("", Owner::Moses); 15];
    let mut at = 0;
    while at < CONTROL.len() {
        names[at] = (CONTROL[at].name, Owner::Moses);
        at += 1;
    }
    names[CONTROL.len()] = ("&TYPE", Owner::Moses);
    names
};

fn laid_out(text: &str) -> String {
    let spacing = |word: &str| match word {
        "&TYPE" | "&T" | "" => Spacing::AsTyped,
        "BUILDG" => Spacing::RowsAsTyped,
        _ => Spacing::Words,
    };
    format(text, &Commands { internal: &INTERNAL, spacing: &spacing })
}

/// The records of a text as an interpreter reads them, and its comments: all that a layout must keep. The text of a record that counts as
/// typed is kept to the blank.
fn content(text: &str) -> Vec<Vec<String>> {
    let mut list = Vec::new();
    let mut at = 0;
    let mut was_empty = false;
    while at < text.len() {
        let (record, next, open) = record::read(text, SourceId::default(), at);
        let is_empty = record.is_empty_line();
        if !(is_empty && was_empty) {
            let mut words: Vec<String> =
                record.words().iter().map(|word| format!("{:?} {}", word.kind, word.text)).collect();
            if ["&T", "&TYPE"].contains(&record.first_word()) {
                words.push(record.rest().0.to_string());
            }
            words.push(format!("{open} {}", record.is_blank()));
            for line in text.get(at..next).unwrap().split('\n') {
                let all = token::tokens(line);
                words.extend(
                    all.iter()
                        .filter(|t| t.kind == TokenKind::Comment)
                        .map(|t| line[t.range.clone()].trim_end_matches(is_blank).to_string()),
                );
            }
            list.push(words);
        }
        was_empty = is_empty;
        at = next;
    }
    list
}

#[test]
fn words_of_internal_commands_have_one_blank_between_them() {
    // of records that control the flow, and of text, blanks stay
    let names = [("&ENV", Owner::Moses), ("&TYPE", Owner::Moses), ("&SET", Owner::Moses)];
    let spacing = |word: &str| if word == "&TYPE" { Spacing::AsTyped } else { Spacing::Words };
    let typed = "&ENV   -DEPTH    80\n&TYPE  a   b\n&SET  X =  1\n";
    let want = "&ENV -DEPTH 80\n&TYPE  a   b\n&SET  X =  1\n";
    assert_eq!(format(typed, &Commands { internal: &names, spacing: &spacing }), want);
}

#[test]
fn blocks_and_continuations_are_further_in() {
    let typed = "&IF 1 .EQ. 1 &THEN\n*A 0 0 0  \n  &LOOP I 1 2\n~W B_CAT 4\t-LEN   5 \\\n$ why\n-CLUMP \\\n 1 2 \\\n   3\n&ENDL\n&ELSE\nEND\n&ENDIF";
    let want = "&IF 1 .EQ. 1 &THEN\n  *A 0 0 0\n  &LOOP I 1 2\n    ~W B_CAT 4 -LEN 5 \\\n      $ why\n      -CLUMP \\\n        1 2 \\\n        3\n  &ENDL\n&ELSE\n  END\n&ENDIF\n";
    assert_eq!(laid_out(typed), want);
}

#[test]
fn lines_of_one_form_are_a_table_where_blanks_were_put_in() {
    let points = "*MLA 400  50 20\n*MLB 400 -50 20\n*C 0 50 20\n\n*D 1 2 3\n*EE 10 20 30\n";
    assert_eq!(laid_out(points), "*MLA 400  50 20\n*MLB 400 -50 20\n*C     0  50 20\n\n*D 1 2 3\n*EE 10 20 30\n");
    let lines = "CONNECTOR A -ANC   45 860 ~LEG *A  $ bow\nCONNECTOR B -ANC  -135 86 ~L *B $ stern\nCONNECTOR B -LEN 1 2 ~L *B\n";
    let want = "CONNECTOR A -ANC   45 860 ~LEG *A $ bow\nCONNECTOR B -ANC -135  86 ~L   *B $ stern\nCONNECTOR B -LEN 1 2 ~L *B\n";
    assert_eq!(laid_out(lines), want);
}

#[test]
fn numbers_of_a_column_stand_by_their_decimal_points() {
    let typed = "*A -28.3377 47.43 -5  1\n*B 4 -40.5 50.4 1e3\n*C  40 -40 -63.625 10.\n";
    assert_eq!(
        laid_out(typed),
        "*A -28.3377  47.43  -5      1\n*B   4      -40.5   50.4    1e3\n*C  40      -40    -63.625 10.\n"
    );
}

#[test]
fn lines_begun_below_the_second_word_stay_below_it() {
    let typed = " H_AMASS  1 0 \\\n          0 9000 \\\n          $ why\n          0 1\n";
    assert_eq!(laid_out(typed), "H_AMASS 1 0 \\\n        0 9000 \\\n        $ why\n        0 1\n");
    let other = "H_AMASS 1 0 \\\n        0 9000 \\\n         0 1\n";
    assert_eq!(laid_out(other), "H_AMASS 1 0 \\\n  0 9000 \\\n  0 1\n");
}

#[test]
fn groups_of_numbers_and_text_keep_their_blanks() {
    assert_eq!(laid_out("H_DAMP 0 0   0 0  $  a  b \n"), "H_DAMP 0 0  0 0  $  a  b\n");
    assert_eq!(laid_out(" &TYPE  a   b \\ \n   c\n&T  x\n"), "&TYPE  a   b \\\n   c\n&T  x\n");
    assert_eq!(laid_out("CALM  'a  b'   c,,  d\n"), "CALM 'a  b' c,, d\n");
    assert_eq!(laid_out("CALM  &NUMBER(REAL  1)\n"), "CALM  &NUMBER(REAL  1)\n");
    assert_eq!(laid_out("BUILDG\n a   b\n\n\nEND\nA   b\n"), "BUILDG\na   b\n\nEND\nA b\n");
}

#[test]
fn ends_of_lines_stay_those_of_the_first_and_an_open_end_stays_open() {
    assert_eq!(laid_out("A  B\r\nC\nD"), "A B\r\nC\r\nD\r\n");
    assert_eq!(laid_out("A \\"), "A \\");
    assert_eq!(laid_out(""), "");
    assert_eq!(laid_out(" \n\n\t\n"), "\n");
    let nested = "&IF 1 &THEN\n".repeat(5000);
    assert!(laid_out(&nested).len() < 5000 * (12 + STEP * DEEPEST_LEVEL));
}

/// What has a meaning to the lexer, with letters and digits.
const SIGNS: &str = " \t\r\n,$\\'\"%ABCD0123456789*~:#&()=.-";
const PIECES: [&str; 22] = [
    "&IF ",
    "&ENDIF",
    "&LOOP\n",
    "&ENDLOOP\n",
    "&MACRO A\n",
    "&ENDMACRO\n",
    "&ELSE\n",
    "&TYPE  a  b",
    "\n",
    "\n\n",
    " \\\n",
    "  ",
    "END\n",
    "*A 1  2\n*B 10 2\n",
    "*A 1.25 3  4\n*B 1 -30  4.5\n",
    "A 1 \\\n  2\n",
    "-LEN 5",
    " $ x  \n",
    "&NUMBER(REAL  1)",
    "BUILDG\n",
    "1  2 \\\n3  4 \\\n",
    "\u{a0}\u{2028}",
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn layout_keeps_content_and_is_its_own_layout(
        pieces in proptest::collection::vec(prop_oneof![
            8 => proptest::collection::vec(proptest::sample::select(SIGNS.chars().collect::<Vec<_>>()), 1..6),
            4 => proptest::sample::select(PIECES.iter().map(|piece| piece.chars().collect()).collect::<Vec<Vec<char>>>()),
            1 => proptest::collection::vec(any::<char>(), 0..5),
        ], 0..40)
    ) {
        let text: String = pieces.concat().into_iter().collect();
        let once = laid_out(&text);
        prop_assert_eq!(content(&once), content(&text), "{:?}", once);
        prop_assert_eq!(laid_out(&once), once);
    }
}
