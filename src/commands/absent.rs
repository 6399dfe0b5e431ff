//! What MOSES has and windlass does not: menus, records, classes, reports, libraries of macros. One table, from which the session answers a script that
//! has them, `&HELP` explains them, and lists are made.
//!
//! A word of this table is looked at where no command and no macro has it. A menu gives one message, and its records are passed over up to its END.
//! A record that would change a mass, a buoyancy, a stiffness, a damping, a load, a length or a place stops the next solve it matters to
//! ([`Loss::Solves`]); one that asks for results is an error; one for pictures, devices or layout is noted.

use crate::commands::menu;
use windlass_language::spec::MenuSpec;
use windlass_model::SolveKind;

/// What a script loses with a record that windlass does not have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Loss {
    /// Nothing that is computed: it draws or lays out, or acts in a stress analysis alone.
    Nothing,
    /// Results that it asks for.
    Results,
    /// Its effect on solves of a kind.
    Solves(SolveKind),
}

/// A menu or a record of MOSES that windlass does not have.
#[derive(Debug)]
pub struct Absent {
    /// Its word.
    pub name: &'static str,
    /// The menus it belongs to; empty means every menu.
    pub menus: &'static [&'static MenuSpec],
    /// The menu it opens, which an `END` of its own leaves.
    pub opens: Option<&'static MenuSpec>,
    /// What is lost with it.
    pub loss: Loss,
    /// What it is or does, as a phrase.
    pub what: &'static str,
    /// What windlass has instead; empty where it has nothing.
    pub instead: &'static str,
}

impl Absent {
    const fn new(name: &'static str, loss: Loss, what: &'static str) -> Self {
        Absent { name, menus: &[], opens: None, loss, what, instead: "" }
    }

    /// One in these menus alone.
    const fn in_menus(self, menus: &'static [&'static MenuSpec]) -> Self {
        Absent { menus, ..self }
    }

    /// One that opens a menu.
    const fn opens(self, menu: &'static MenuSpec) -> Self {
        Absent { opens: Some(menu), ..self }
    }

    /// The same, with what windlass has instead.
    const fn instead(self, instead: &'static str) -> Self {
        Absent { instead, ..self }
    }

    /// What is said of it, without what windlass has instead.
    pub fn sentence(&self) -> String {
        match self.loss {
            Loss::Nothing => format!("{} of MOSES has no effect in windlass: {} (said once)", self.name, self.what),
            Loss::Results => format!("{} of MOSES is not in windlass: {}", self.name, self.what),
            Loss::Solves(_) => {
                format!(
                    "{} of MOSES is not in windlass: {}; solves it matters to will stop (said once)",
                    self.name, self.what
                )
            }
        }
    }
}

const HYDROSTATICS: Loss = Loss::Solves(SolveKind::Hydrostatics);
const STATICS: Loss = Loss::Solves(SolveKind::Statics);
const MOTIONS: Loss = Loss::Solves(SolveKind::Motions);

const MAIN: &[&MenuSpec] = &[&menu::MAIN];
const MODEL: &[&MenuSpec] = &[&menu::INMODEL, &menu::MEDIT];
const FREQUENCY: &[&MenuSpec] = &[&menu::FREQ_RESPONSE];
const HYDRODYNAMIC: &[&MenuSpec] = &[&menu::HYDRODYNAMICS];

static STRUCTURAL: MenuSpec = MenuSpec { name: "STRUCTURAL", end: "END_STRUCTURAL" };
static STRPOST: MenuSpec = MenuSpec { name: "STRPOST", end: "END_STRPOST" };
static LAUNCH: MenuSpec = MenuSpec { name: "LAUNCH", end: "END_LAUNCH" };
static STATIC_PROCESS: MenuSpec = MenuSpec { name: "STATIC_PROCESS", end: "END_STATIC_PROCESS" };
static I_PRESSURE: MenuSpec = MenuSpec { name: "I_PRESSURE", end: "END_I_PRESSURE" };
static I_MDRIFT: MenuSpec = MenuSpec { name: "I_MDRIFT", end: "END_I_MDRIFT" };
static UGX: MenuSpec = MenuSpec { name: "&UGX", end: "END_&UGX" };
static TABLES: MenuSpec = MenuSpec { name: "&TABLE", end: "END_&TABLE" };
static DOCUMENTS: MenuSpec = MenuSpec { name: "&D_GENERATE", end: "END_&D_GENERATE" };
static PLTMODE: MenuSpec = MenuSpec { name: "&PLTMODE", end: "END_&PLTMODE" };
/// The disposition menu of a table that is not made.
static DISPOSITION: MenuSpec = MenuSpec { name: "DISPOSITION", end: "END_DISPOSE" };

const TOTAL: &str = "I_TOTAL gives added mass, damping and wave forces by records, DATABASE reads them";
const DRIFT: &str = "G_MDRIFT makes mean drift of a hull, #DRIFT gives it by records, DATABASE reads it";
const NO_STRESS: &str = "a stress analysis, which windlass does not make";
const LAUNCH_LEGS: &str = "launch legs, on which a jacket slides from its barge";
const TUBE_INSTEAD: &str = "TUBE of &SURFACE, #WEIGHT and #AREA give members, weights and areas";

/// A table of FREQ_RESPONSE that is not made.
const fn frequency(name: &'static str, what: &'static str) -> Absent {
    Absent::new(name, Loss::Results, what).in_menus(FREQUENCY).opens(&DISPOSITION)
}

/// All of them. What a later version of windlass has goes from here.
pub static ABSENT: &[Absent] = &[
    Absent::new("STRUCTURAL", Loss::Results, NO_STRESS).in_menus(MAIN).opens(&STRUCTURAL),
    Absent::new("STRPOST", Loss::Results, NO_STRESS).in_menus(MAIN).opens(&STRPOST),
    Absent::new("LCASE", Loss::Results, NO_STRESS),
    Absent::new("LAUNCH", Loss::Results, "the launch of a structure from a barge").in_menus(MAIN).opens(&LAUNCH),
    Absent::new("STATIC_PROCESS", Loss::Results, "lifting, flooding and upending of a body step by step")
        .in_menus(MAIN)
        .opens(&STATIC_PROCESS)
        .instead("&EQUI finds each equilibrium; &DESCRIBE PROCESS keeps configurations apart"),
    Absent::new("I_PRESSURE", MOTIONS, "hydrodynamic data of panels")
        .in_menus(HYDRODYNAMIC)
        .opens(&I_PRESSURE)
        .instead(TOTAL),
    Absent::new("E_PRESSURE", Loss::Results, "hydrodynamic data of panels").in_menus(HYDRODYNAMIC),
    Absent::new("I_MDRIFT", MOTIONS, "mean wave drift by records")
        .in_menus(HYDRODYNAMIC)
        .opens(&I_MDRIFT)
        .instead(DRIFT),
    Absent::new("E_MDRIFT", Loss::Results, "a file of mean wave drift")
        .in_menus(HYDRODYNAMIC)
        .instead("V_MDRIFT shows it, STORE of its menu writes it"),
    Absent::new("&UGX", Loss::Nothing, "it draws").opens(&UGX),
    Absent::new("&TABLE", Loss::Nothing, "it lays out tables; STORE and REPORT of the disposition menu write them")
        .opens(&TABLES),
    Absent::new("&D_GENERATE", Loss::Nothing, "it formats documents").opens(&DOCUMENTS),
    Absent::new("&PLTMODE", Loss::Nothing, "it draws; &PICTURE draws the system").opens(&PLTMODE),
    Absent::new("&EVENT_STORE", Loss::Results, "events stored by hand")
        .instead("&INFO and string functions give values to keep"),
    Absent::new("SP_BEAM", Loss::Nothing, "it reports stresses of other members, and adds nothing to the model")
        .in_menus(MODEL),
    Absent::new("SP_PLATE", Loss::Nothing, "it reports stresses of other members, and adds nothing to the model")
        .in_menus(MODEL),
    Absent::new("ED_ELEMENT", HYDROSTATICS, "changes of structural members").in_menus(MODEL),
    Absent::new("RESTRAINT", Loss::Nothing, "it acts in a stress analysis alone").in_menus(MODEL),
    Absent::new("REST", Loss::Nothing, "it acts in a stress analysis alone").in_menus(MODEL),
    Absent::new("RELEASES", Loss::Nothing, "it acts in a stress analysis alone").in_menus(MODEL),
    Absent::new("JOINT", Loss::Nothing, "it acts in a stress analysis alone").in_menus(MODEL),
    Absent::new("ASSEMBLY LLEG", STATICS, LAUNCH_LEGS).in_menus(MODEL),
    Absent::new("&LWAY", STATICS, LAUNCH_LEGS),
    Absent::new("ASSEMBLY CONTROL", STATICS, "a control of lengths and forces").in_menus(MODEL),
    Absent::new(
        "TKR_MODEL",
        HYDROSTATICS,
        "the hull, weight, wind and current of a tanker of MOSES's macro library V_MODEL, whose ships are not public",
    )
    .instead(TUBE_INSTEAD),
    Absent::new("JGEN_INIT", HYDROSTATICS, "a jackup of MOSES's macro library V_MODEL, whose forms are not public"),
    Absent::new("TKR_GEN", HYDROSTATICS, "a moored tanker, by a macro library of MOSES"),
    Absent::new("TKR_SIM", Loss::Results, "simulations of a moored tanker, by a macro library of MOSES"),
    Absent::new("JKT_GEN", HYDROSTATICS, "a jacket, by a macro library of MOSES"),
    Absent::new("SU_SHOW", Loss::Nothing, "it draws"),
    Absent::new("SUPLOT", Loss::Nothing, "it draws"),
    frequency("TD_POINT", "one realisation of the motion of a point").instead("TDOM gives motions in time"),
    frequency("FR_PANPRESS", "pressures on panels in unit waves")
        .instead("hydrodynamic databases hold forces on whole bodies, and no pressures"),
    frequency("ST_PANPRESS", "statistics of pressures on panels")
        .instead("hydrodynamic databases hold forces on whole bodies, and no pressures"),
    Absent::new("FP_STD", Loss::Results, "the standard set of tables of a point")
        .in_menus(FREQUENCY)
        .instead("FR_POINT, ST_POINT and EQU_SUM make tables of a point one by one"),
    Absent::new("BEAM_SUM", Loss::Results, NO_STRESS).in_menus(&[&menu::SUMMARY]),
];

/// A class type of MOSES that windlass does not have.
#[derive(Debug)]
pub struct AbsentClass {
    /// Its word.
    pub name: &'static str,
    /// What its connectors would do.
    pub of_connectors: &'static str,
}

/// The class types.
pub static CLASSES: &[AbsentClass] = &[
    AbsentClass { name: "PROPULSION", of_connectors: "the thrust of a propeller" },
    AbsentClass { name: "PILE", of_connectors: "the resistance of a pile" },
];

/// Kinds of `&STATUS` that MOSES has and windlass does not, with what to ask for instead.
pub static REPORTS: &[(&str, &str)] = &[
    ("PILE", "windlass has no piles"),
    ("LLEG", "windlass has no launch legs"),
    ("NOTE", "messages stand in the log"),
    ("T_CONVOLUTION", "CURVES reports curves"),
    ("F_CONVOLUTION", "CURVES reports curves"),
];

/// Libraries of macros that ship with MOSES, each with the macros that scripts call.
pub static LIBRARIES: &[(&str, &str)] = &[("AUTO_TKR", "TKR_GEN, TKR_SIM"), ("JKTGEN", "JKT_GEN")];

/// The entry of a word in a menu: by its whole name, else by a beginning of four letters or more that one alone has.
pub fn find(word: &str, menu: &MenuSpec) -> Option<&'static Absent> {
    const SHORTEST: usize = 4;
    let here = || ABSENT.iter().filter(|entry| entry.menus.is_empty() || entry.menus.contains(&menu));
    let begins = |entry: &&Absent| entry.name.get(..word.len()).is_some_and(|head| head.eq_ignore_ascii_case(word));
    here().find(|entry| entry.name.eq_ignore_ascii_case(word)).or_else(|| {
        let mut hits = here().filter(begins).filter(|_| word.len() >= SHORTEST);
        hits.next().filter(|_| hits.next().is_none())
    })
}

/// The entry of a command of windlass with a second word that it does not have.
pub fn find_form(command: &str, second: &str) -> Option<&'static Absent> {
    ABSENT.iter().find(|entry| {
        entry.name.split_once(' ').is_some_and(|(name, form)| name == command && form.eq_ignore_ascii_case(second))
    })
}

/// The class type of a word.
pub fn find_class(word: &str) -> Option<&'static AbsentClass> {
    CLASSES.iter().find(|class| class.name.eq_ignore_ascii_case(word))
}

/// Whether a word is the name of a rolled shape: `W14X140`.
pub fn is_rolled_shape(word: &str) -> bool {
    let letters = word.bytes().take_while(u8::is_ascii_alphabetic).count();
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit() || b == b'.');
    let sizes = word.get(letters..).and_then(|sizes| sizes.split_once(['X', 'x']));
    (1..=3).contains(&letters) && sizes.is_some_and(|(depth, weight)| is_number(depth) && is_number(weight))
}

/// What windlass has instead of a kind of `&STATUS`.
pub fn find_report(word: &str) -> Option<&'static (&'static str, &'static str)> {
    REPORTS.iter().find(|(name, _)| name.eq_ignore_ascii_case(word))
}
