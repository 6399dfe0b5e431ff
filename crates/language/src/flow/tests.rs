use super::super::substitution::NoFunctions;
use super::*;

/// Runs a script; macros are called by name; every other record is returned, errors as `! message`.
fn run(text: &str) -> Vec<String> {
    run_with(text, 100_000)
}

fn run_with(text: &str, budget: u64) -> Vec<String> {
    let mut interpreter = Interpreter::new([("&TYPE", Owner::Moses), ("&ENV", Owner::Moses)].into_iter());
    interpreter.budget = budget;
    interpreter.open("t.cif", text, 0, None).unwrap();
    let mut out = Vec::new();
    loop {
        match interpreter.next_step(&mut NoFunctions) {
            Ok(FlowStep::Record(record)) => {
                let known = macros::find(record.first_word(), interpreter.macros()).map(|(_, m)| m.clone());
                match known {
                    Some(found) => {
                        if let Err(error) = interpreter.call(&found, &record) {
                            out.push(format!("! {}", error.message));
                        }
                    }
                    None => out.push(record.text().trim().to_string()),
                }
            }
            Ok(FlowStep::Ended(_)) => {}
            Ok(FlowStep::Done | FlowStep::NeedLine) => return out,
            Err(error) => out.push(format!("! {}", error.message)),
        }
    }
}

#[test]
fn branches_nest_and_skip_untaken_blocks() {
    let script = "&SET A = 3\n&IF %A .EQ. 1 &THEN\nX\n&IF %UNDEFINED &THEN\n&ENDIF\n&ELSEIF %A .EQ. 3 &THEN\nY\n&ELSE\nZ\n&ENDIF\nW";
    assert_eq!(run(script), ["Y", "W"]);
    assert_eq!(run("&IF .FALSE. &THEN\nX\n&ELSE .FALSE. &THEN\nY\n&ELSE\nZ\n&ENDIF"), ["Z"]);
}

#[test]
fn loops_count_iterate_over_lists_and_end_by_exit() {
    assert_eq!(run("&LOOP I 1 7 3\nX %I\n&ENDLOOP"), ["X 1", "X 4", "X 7"]);
    assert_eq!(run("&LOOP I 2 1 -1\nX %I\n&ENDLOOP"), ["X 2", "X 1"]);
    assert_eq!(run("&LOOP I 2 1\nX %I\n&ENDLOOP"), Vec::<String>::new());
    assert_eq!(run("&LOOP V ( A B )\n&LOOP W (1 2)\n%V%W\n&ENDLOOP\n&ENDLOOP").len(), 4);
    assert_eq!(
        run("&SET N = 0\n&LOOP\n&SET N = &NUMBER(REAL %N+1)\n&EXIT %N .GT. 3\n&NEXT %N .EQ. 2\nX %N\n&ENDLOOP\nY"),
        ["X 1", "X 3", "Y"]
    );
}

#[test]
fn last_value_of_macro_takes_all_words_up_to_next_option() {
    let script = "&MACRO M A -W GIVEN WT = 0 NODES.. = -X E\n%A %GIVEN %WT [%NODES%] %E\n&ENDMACRO\nM a -W 5 *N1 *N2 *N3 -X\nM b -W 5\nM c -X";
    assert_eq!(run(script), ["a .TRUE. 5 [*N1 *N2 *N3] .TRUE.", "b .TRUE. 5 [] .FALSE.", "c .FALSE. 0 [] .TRUE."]);
    assert_eq!(run("&MACRO M A B..\n%A [%B%]\n&ENDMACRO\nM 1 2 3 4\nM 1"), ["1 [2 3 4]", "! macro M lacks B"]);
    assert_eq!(run("&MACRO M B.. C\n&ENDMACRO"), ["! B.. takes all values: none can follow it"]);
}

#[test]
fn macros_take_arguments_options_and_defaults() {
    let script = "&MACRO GREET WHO -LOUD YELL MARK = ! TAIL = .\n%WHO %YELL %MARK %TAIL / %ARGV\n&ENDMACRO\n\
                  GREET you\nGREET me, -LO ?\nGREET a b";
    assert_eq!(
        run(script),
        ["you .FALSE. ! . / you", "me .TRUE. ? . / me, -LO ?", "! macro GREET takes no further argument"]
    );
}

#[test]
fn omitted_argument_between_commas_gets_its_default() {
    let script = "&MACRO P A B = 5 -OPT FLAG V = 7 W = 8\n%A|%B|%V|%W\n&ENDMACRO\n";
    for (call, got) in [
        ("P 1,,", "1|5|7|8"),
        ("P ,,2", "|2|7|8"),
        ("P,2", "2|5|7|8"),
        ("P 1,,-OPT ,, 3", "1|5|7|3"),
        ("P ,,", "|5|7|8"),
    ] {
        assert_eq!(run(&format!("{script}{call}")), [got], "{call}");
    }
}

#[test]
fn macro_named_as_control_record_or_its_abbreviation_is_error() {
    for name in ["&LOOP", "&loo", "&LOC"] {
        let script = format!("&MACRO {name} A\nX\n&ENDMACRO\nY");
        assert_eq!(run(&script), [format!("! macro {name} cannot be called"), "Y".into()]);
    }
    assert_eq!(run("&MACRO &MINE\nX\n&ENDMACRO\n&MINE"), ["X"]);
}

#[test]
fn wrong_loop_bound_is_the_error_position() {
    for (header, message, column) in [
        ("&LOOP I 1 5 0", "the increment of &LOOP may not be zero", 13),
        ("&LOOP I 1 2 0.5", "the increment of &LOOP must be a whole number", 13),
        ("&LOOP I 1 2.5", "a bound of &LOOP must be a whole number", 11),
    ] {
        let mut interpreter = Interpreter::new(std::iter::empty());
        interpreter.open("t.cif", format!("{header}\n&ENDLOOP\n"), 0, None).unwrap();
        let error = interpreter.next_step(&mut NoFunctions).unwrap_err();
        assert_eq!(error.message, message);
        assert_eq!(interpreter.sources.location(error.span.unwrap()), format!("t.cif:1:{column}"));
    }
}

#[test]
fn local_variable_ends_with_its_macro_and_hides_global() {
    let script = "&SET A = outer\n&MACRO M\n&LOCAL A = inner\nX %A\n&ENDMACRO\nM\nX %A";
    assert_eq!(run(script), ["X inner", "X outer"]);
}

#[test]
fn unclosed_blocks_are_errors_at_their_beginning() {
    assert_eq!(run("&IF .TRUE. &THEN\nX"), ["X", "! this &IF is not closed"]);
    assert_eq!(run("&LOOP I 1 2\nX"), ["! this &LOOP is not closed"]);
    assert_eq!(run("&MACRO M\nX"), ["! this &MACRO is not closed"]);
    assert_eq!(run("&ENDIF\n&ENDLOOP\n&ENDMACRO\n&EXIT").len(), 4);
}

#[test]
fn error_in_header_keeps_block_whole() {
    assert_eq!(run("&IF 1 .LT. A &THEN\nX\n&ELSE\nY\n&ENDIF\nZ"), ["! the logical phrase cannot be evaluated", "Z"]);
    assert_eq!(run("&LOOP I 1 A\nX\n&ENDLOOP\nZ"), ["! a bound of &LOOP must be a number", "Z"]);
}

#[test]
fn endless_loops_and_macros_end_in_error() {
    assert_eq!(run("&LOOP\n&ENDLOOP\nX").last().unwrap(), "! the run has executed its 100000 records");
    assert_eq!(run("&LOOP\n&SET A = 1\n&ENDLOOP").len(), 1);
    let recursive = run("&MACRO M\nM\n&ENDMACRO\nM\nX");
    assert_eq!(recursive, ["! macros call each other deeper than 64", "X"]);
    let doubling = run("&SET A = 1\n&LOOP I 1 40\n&SET A = %A%A\n&ENDLOOP");
    assert!(doubling.iter().all(|e| e.contains("undefined variable") || e.contains("longer than")));
    let doubling = run("&SET A = 1\n&LOOP I 1 40\n&SET A = %A%%A%\n&ENDLOOP");
    assert!(doubling.iter().all(|e| e.contains("longer than")) && !doubling.is_empty());
}

#[test]
fn eofile_skips_rest_of_file() {
    assert_eq!(run("X\n&IF .TRUE. &THEN\n&LOOP I 1 3\n&EOFILE\n&ENDLOOP\n&ENDIF\nY"), ["X"]);
}
