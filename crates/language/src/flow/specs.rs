//! The records that steer the interpreter itself: variables, branches, loops, macros.
//!
//! Source: [MOSES-REF lang_local, lang_loop_if, lang_macros].

use crate::select::Owner;
use crate::spec::{CommandSpec, TextForm};

const fn control(name: &'static str, help: &'static str, detail: &'static str, example: &'static str) -> CommandSpec {
    CommandSpec { form: TextForm::Text, owner: Owner::Moses, detail, example, ..CommandSpec::new(name, help) }
}

/// The control records; they act in every menu and before any command is looked up.
pub static CONTROL: &[CommandSpec] = &[
    control(
        "&SET",
        "VAR = value: sets a variable (the visible one, else a new global)",
        "The value is kept as text and put in wherever %VAR, %VAR% or %(VAR) stands; a blank must follow the =.",
        "&SET DOG = 20\n&SET CAT = %DOG%*2000\n&TYPE &NUMBER(REAL %CAT)",
    ),
    control(
        "&SET_VAR",
        "VAR := value: as &SET, in the older form",
        "= may stand for :=; a blank must follow.",
        "&SET_VAR LEN := 215\n&TYPE %LEN",
    ),
    control("&LOCAL", "VAR = value: sets a variable that ends with its macro", "", "&LOCAL A = 1 2 3"),
    control(
        "&IF",
        "phrase &THEN: reads the records up to &ELSEIF, &ELSE or &ENDIF when the phrase is true",
        "Phrases join words by .EQ. .NE. .LT. .LE. .GT. .GE. .AND. .OR. .NOT.",
        "&SET A = 3\n&IF %A .GT. 2 &THEN\n&TYPE large\n&ELSE\n&TYPE small\n&ENDIF",
    ),
    control(
        "&ELSEIF",
        "phrase &THEN: the next branch of an &IF",
        "",
        "&IF 1 .EQ. 2 &THEN\n&ELSEIF 2 .EQ. 2 &THEN\n&ENDIF",
    ),
    control("&ELSE", "the last branch of an &IF", "", "&IF .FALSE. &THEN\n&ELSE\n&ENDIF"),
    control("&ENDIF", "ends an &IF", "", "&IF .FALSE. &THEN\n&ENDIF"),
    control(
        "&LOOP",
        "I BEG END [INCR], or VAR ( A B C ), or nothing: repeats the records up to &ENDLOOP",
        "A loop with nothing ends by &EXIT. The index is a local.",
        "&LOOP I 1 3\n&TYPE %I\n&ENDLOOP\n&LOOP W ( A B )\n&TYPE %W\n&ENDLOOP",
    ),
    control(
        "&NEXT",
        "[phrase]: goes on to the next trip of a loop when the phrase is true",
        "",
        "&LOOP I 1 2\n&NEXT %I .EQ. 1\n&ENDLOOP",
    ),
    control("&EXIT", "[phrase]: leaves a loop when the phrase is true", "", "&LOOP\n&EXIT .TRUE.\n&ENDLOOP"),
    control("&ENDLOOP", "ends a &LOOP", "", "&LOOP I 1 2\n&ENDLOOP"),
    control(
        "&MACRO",
        "NAME ARG .. -OPT FLAG VALUE = default ..: defines a macro up to &ENDMACRO",
        "Called by its name: arguments become locals, FLAG is .TRUE. when -OPT is given. An argument without a default must be given, as a \
         value of an option that is (our reading: an empty value would change what a record means); two commas in a row give an empty \
         one. An option is given once. With a name alone nothing is checked; the text of the call is always in ARGV.",
        "&MACRO HELLO WHO -LOUD YELL MARK = !\n&TYPE Hello %WHO %MARK\n&ENDMACRO\nHELLO you -LOUD !!",
    ),
    control("&ENDMACRO", "ends a &MACRO", "", "&MACRO NOTHING\n&ENDMACRO"),
    control("&EOFILE", "stops reading the current file", "", "&EOFILE"),
];
