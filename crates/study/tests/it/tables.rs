//! Tables of cases: what they come to by hand, and what is wrong with them.

use windlass_study::kept::MooringCondition;
use windlass_study::seeds::seed_of_case;
use windlass_study::table::{CaseTable, MOST_CASES};

fn cells(table: &CaseTable) -> Vec<String> {
    table.cases.iter().map(|case| format!("{}: {}", case.name, case.values.join(" "))).collect()
}

#[test]
fn seeds_are_those_of_an_independent_program() {
    // FNV-1a and SplitMix64 in 20 lines of Python
    let seeds = [(1, "A", 1), (1, "B", 1), (1, "C", 2), (7, "Y100_180", 5)].map(|(s, n, m)| seed_of_case(s, n, m));
    assert_eq!(seeds, [1_368_167_165, 1_745_373_773, 303_044_457, 1_570_507_677]);
}

#[test]
fn lists_are_multiplied_zipped_and_excluded() {
    let text = "case = \"{SEA}_{HEADING}_{member}\"\nseed_of = \"{SEA}\"\n[grid]\nHEADING = [0, 22.5]\nmember = [1, 2]\n\
                [[zip]]\nSEA = [\"low\", \"high\"]\nHS = [4, 9.5]\n[[exclude]]\nHEADING = 22.5\nSEA = \"high\"\n";
    let table = CaseTable::parse("cases.toml", text, 1, MOST_CASES).unwrap();
    assert_eq!(table.columns, ["HEADING", "member", "SEA", "HS", "seed_of"]);
    // two headings, two members, two seas: eight, less the two of the high sea from 22.5 degrees
    assert_eq!(
        cells(&table),
        [
            "low_0_1: 0 1 low 4 low",
            "high_0_1: 0 1 high 9.5 high",
            "low_0_2: 0 2 low 4 low",
            "high_0_2: 0 2 high 9.5 high",
            "low_22.5_1: 22.5 1 low 4 low",
            "low_22.5_2: 22.5 2 low 4 low",
        ]
    );
    assert_eq!(table.cases[0].seed, table.cases[4].seed, "one sea, one member");
    assert_ne!(table.cases[0].seed, table.cases[2].seed);
    assert_eq!(table.cases[0].seed, seed_of_case(1, "low", 1));
}

#[test]
fn every_line_and_pair_is_lost_in_each_condition() {
    let text = "case = \"{HS}_{LOST}_{CONDITION}\"\nseed_of = \"{HS}\"\n[grid]\nHS = [4, 9]\n\
                [lost]\nlines = [\"L1\", \"L2\", \"L3\"]\nat_once = [0, 1, 2]\nconditions = [\"damaged\", \"transient\"]\n";
    let table = CaseTable::parse("cases.toml", text, 1, MOST_CASES).unwrap();
    assert_eq!(table.columns, ["HS", "LOST", "CONDITION", "seed_of"]);
    // two seas; intact, three single and three double losses, each damaged and transient
    assert_eq!(table.cases.len(), 2 * (1 + 2 * (3 + 3)));
    let names: Vec<&str> = table.cases.iter().take(13).map(|case| case.name.as_str()).collect();
    assert_eq!(
        names,
        [
            "4_NONE_intact",
            "4_L1_damaged",
            "4_L1_transient",
            "4_L2_damaged",
            "4_L2_transient",
            "4_L3_damaged",
            "4_L3_transient",
            "4_L1+L2_damaged",
            "4_L1+L2_transient",
            "4_L1+L3_damaged",
            "4_L1+L3_transient",
            "4_L2+L3_damaged",
            "4_L2+L3_transient",
        ]
    );
    let case = |name: &str| table.cases.iter().find(|case| case.name == name).unwrap();
    assert_eq!(case("9_L1+L3_transient").intact.as_deref(), Some("9_NONE_intact"));
    assert_eq!(case("9_L1+L3_damaged").intact, None);
    assert_eq!(case("4_NONE_intact").peaks_of, ["L1", "L2", "L3"]);
    let lost = case("4_L1+L3_damaged").lost.as_ref().unwrap();
    assert_eq!((lost.variable().as_str(), lost.condition), ("L1 L3", MooringCondition::Damaged));
    // of a table without conditions, lines lost are damage
    let table = CaseTable::parse("cases.csv", "case,LOST\nA,none\nB,L1+L2\n", 1, MOST_CASES).unwrap();
    let conditions: Vec<_> = table.cases.iter().map(|case| case.lost.as_ref().unwrap().condition).collect();
    assert_eq!(conditions, [MooringCondition::Intact, MooringCondition::Damaged]);
}

#[test]
fn rows_of_csv_keep_their_order_and_seeds_go_by_name() {
    let first = CaseTable::parse("cases.csv", "case,HS\r\nB,2\r\nA,\"3\"\r\n", 5, MOST_CASES).unwrap();
    let second = CaseTable::parse("cases.csv", "HS,case\n3,A\n9,C\n2,B\n", 5, MOST_CASES).unwrap();
    assert_eq!(cells(&first), ["B: 2", "A: 3"]);
    let seed = |table: &CaseTable, name: &str| table.cases.iter().find(|case| case.name == name).unwrap().seed;
    assert_eq!(["A", "B"].map(|n| seed(&first, n)), ["A", "B"].map(|n| seed(&second, n)));
    let given = CaseTable::parse("cases.csv", "case,seed\nA,17\n", 5, MOST_CASES).unwrap();
    assert_eq!(given.cases[0].seed, 17);
}

#[test]
fn wrong_tables_say_where_and_what() {
    let said = |name: &str, text: &str| CaseTable::parse(name, text, 1, MOST_CASES).unwrap_err().to_string();
    for (text, wanted) in [
        ("HS\n1\n", "cases.csv:1: there is no column case, which names the rows; there are HS"),
        ("case,HS\n", "cases.csv: it has no cases"),
        (
            "case,2HS\nA,1\n",
            "cases.csv:1: column 2HS: a column is a variable of the script: a letter, then letters, digits and _",
        ),
        ("case,HS,hs\nA,1,2\n", "cases.csv:1: column hs: it stands twice"),
        ("case,HS\nA,1\na,2\n", "cases.csv:3: column case: `a` stands twice, first in line 2"),
        ("case,HS\nA,\n", "cases.csv:2: column HS: the cell is empty"),
        ("case,HS\nA,1\nB,NaN\n", "cases.csv:3: column HS: `NaN` is not a finite number"),
        ("case,HS\nA,-inf\n", "cases.csv:2: column HS: `-inf` is not a finite number"),
        ("case,HS\nA,1e999\n", "cases.csv:2: column HS: `1e999` is not a finite number"),
        ("case,HS\nA,1,2\n", "cases.csv:2: 3 cells under 2 heads"),
        (
            "case,HS\n../A,1\n",
            "cases.csv:2: column case: `../A` cannot name a case: letters, digits and _ - + ., 80 at most, not a . first",
        ),
        ("case,HS\nA,%X%\n", "cases.csv:2: column HS: `%X%` has `%`, which a record reads as something else"),
        (
            "case,lost\nA,L1 L2\n",
            "cases.csv:2: column lost: `L1 L2` is no list of lines: NONE, or names with + between them",
        ),
        ("case,lost\nA,L1+l1\n", "cases.csv:2: column lost: `L1+l1` names l1 twice"),
        (
            "case,lost,condition\nA,L1,broken\n",
            "cases.csv:2: column condition: `broken` is no condition: intact, damaged or transient",
        ),
        (
            "case,lost,condition\nA,NONE,damaged\n",
            "cases.csv:2: column condition: damaged does not go with `NONE` of lost",
        ),
        (
            "case,HS,lost,condition,seed\nA,1,NONE,intact,3\nB,1,L1,transient,4\n",
            "cases.csv:3: column condition: there is no intact case with the same seed whose other columns are the same: seed_of \
             gives cases the same seas",
        ),
        ("case,stiffness\nA,2\n", "cases.csv:2: column stiffness: `2` is no stiffness: lower, upper or dynamic"),
        ("case,member\nA,-1\n", "cases.csv:2: column member: `-1` is not a whole number from 0 on"),
    ] {
        assert_eq!(said("cases.csv", text), wanted);
    }
    for (text, wanted) in [
        ("case = \"{X}\"\n[grid]\nHS = [1]\n", "cases.toml: column case: `{X}` is no column of the grid"),
        ("case = \"A\"\n[grid]\nHS = [1, 2]\n", "cases.toml: column case: `A` stands twice"),
        ("case = \"A\"\n[grid]\nHS = []\n", "cases.toml: column HS: the list is empty"),
        (
            "case = \"{HS}\"\n[[zip]]\nHS = [1, 2]\nTP = [1]\n",
            "cases.toml: column TP: 1 values beside 2 of HS: lists of [[zip]] have one length",
        ),
        (
            "case = \"{HS}\"\n[grid]\nHS = [1]\n[[exclude]]\nTP = 1\n",
            "cases.toml: column TP: [[exclude]] names no list; there are HS",
        ),
        (
            "case = \"{HS}\"\n[grid]\nHS = [1]\n[lost]\nlines = [\"A\"]\nat_once = [2]\n",
            "cases.toml: column lost: at_once loses 2 of 1 lines",
        ),
        (
            "case = \"{HS}\"\n[grid]\nHS = [1]\n[lost]\nlines = [\"A\"]\nconditions = [\"intact\"]\n",
            "cases.toml: column lost: `intact` of conditions is neither damaged nor transient",
        ),
        (
            "case = \"{HS}\"\n[grid]\nHS = [1]\n[lost]\nlines = [\"A\"]\nat_once = [1]\nconditions = [\"transient\"]\n",
            "cases.toml: column lost: a transient case follows an intact one: at_once = [0, ..]",
        ),
        (
            "case = \"{lost}\"\n[grid]\nlost = [1]\n[lost]\nlines = [\"A\"]\n",
            "cases.toml: column LOST: it stands twice, in [lost] and in a list",
        ),
        ("case = \"{HS}\"\n[grid]\nHS = [true]\n", "cases.toml: column HS: a value is a number or a text"),
    ] {
        assert_eq!(said("cases.toml", text), wanted);
    }
    assert!(said("cases.toml", "case = \"A\"\nlists = 3\n").starts_with("cases.toml:2: unknown field `lists`"));
    let many = format!("case = \"{{A}}{{B}}\"\n[grid]\nA = {0:?}\nB = {0:?}\n", (0..4000).collect::<Vec<_>>());
    assert_eq!(
        said("cases.toml", &many),
        "cases.toml: the lists multiply to more than 1000000 cases: --max-cases allows more"
    );
    let rows = CaseTable::parse("cases.csv", "case\nA\nB\nC\n", 1, 2).unwrap_err().to_string();
    assert_eq!(rows, "cases.csv:4: more than 2 cases: --max-cases allows more");
}
