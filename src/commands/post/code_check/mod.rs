//! CODE_CHECK of the CONN_DESIGN and PRCPOST menus: lines, anchors, fatigue life and limits by a design code.

mod loads;
mod tables;

use crate::commands::menu;
use crate::commands::name_filter::NameFilter;
use crate::commands::output::disposition::{BOTH, DISPOSE, HARD, WIDE, print_or_dispose};
use crate::commands::post::prcpost::{CONNECTORS, EVENTS, transient_of};
use crate::commands::settings::device::{existing, read_input};
use crate::commands::{Call, Command, Effect, Job, Menu};
use loads::{Characteristic, CheckedMooring};
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::units::Dim;
use windlass_base::values::{Args, Given, Noun};
use windlass_design_checks::codes::{
    AnchorKind, Code, CodeError, CodeLibrary, CodeOptions, MAX_FILE_BYTES, Mooring, PullDirection,
};
use windlass_design_checks::strength::CorrosionLaw;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, Kind, Opens, OptionSpec, ValueSpec};

/// CODE_CHECK.
pub static CODE_CHECK: Command = Command { spec: &SPEC, edits: false, run };

/// The codes that ship.
const SHIPPED: &str = include_str!("../../../../share/codes.toml");

choices! {
    /// The strength that a corroded diameter has.
    enum CorrosionWord {
        Area = "AREA",
        Chain = "CHAIN",
    }
}

const CODE: OptionSpec = OptionSpec::new(
    "-CODE",
    &[ValueSpec::new("NAME", Kind::Text, "code with its edition; -LIST lists them")],
    "the code",
);
const LIST: OptionSpec =
    OptionSpec::new("-LIST", &[], "lists the factors of -CODE, or of all codes, and checks nothing");
const FILE: OptionSpec = OptionSpec::new(
    "-FILE",
    &[ValueSpec::new("FILE", Kind::File, "TOML file of codes; looked for where it says, then beside the script")],
    "codes of your own, which go before those that ship",
);
const UNCONFIRMED: OptionSpec =
    OptionSpec::new("-UNCONFIRMED", &[], "takes factors from memory too: such a check never passes");
const CLASS: OptionSpec = OptionSpec::new(
    "-CLASS",
    &[ValueSpec::new("CLASS", Kind::Text, "consequence class, as the code names it")],
    "the consequence class, of codes that have some",
);
const MOORING: OptionSpec = OptionSpec::new(
    "-MOORING",
    &[ValueSpec::choice::<Mooring>("HOW", "PERMANENT or MOBILE")],
    "how long the mooring stays, of codes that tell the two apart",
);
const SPARE: OptionSpec = OptionSpec::new(
    "-SPARE",
    &[ValueSpec::new(":C", Kind::Name(Noun::Selector), "connector, pattern or selector").among(&[Noun::Connector])],
    "inactive lines that do not belong to the mooring: they do not count as lost",
)
.repeating(1);
const CHARACTERISTIC: OptionSpec = OptionSpec::new(
    "-CHARACTERISTIC",
    &[ValueSpec::choice::<Characteristic>("WHAT", "MPM or LARGEST")],
    "what of the tension over a run is checked",
)
.default("MPM; LARGEST of a transient run");
const DURATION: OptionSpec = OptionSpec::new(
    "-DURATION",
    &[ValueSpec::new("HOURS", Kind::Number(Dim::None), "hours").positive()],
    "time that the most probable maximum is sought in",
)
.default("3 hours");
const PRETENSION: OptionSpec = OptionSpec::new(
    "-PRETENSION",
    &[
        ValueSpec::new(":C", Kind::Name(Noun::Selector), "connector, pattern or selector").among(&[Noun::Connector]),
        ValueSpec::new("F", Kind::Number(Dim::Force), "tension without environment").not_negative(),
    ],
    "pretension of lines, of codes that take it apart",
)
.many();
const CORROSION: OptionSpec = OptionSpec::new(
    "-CORROSION",
    &[
        ValueSpec::new("D", Kind::Number(Dim::Section), "allowance on the diameter").not_negative(),
        ValueSpec::choice::<CorrosionWord>("LAW", "AREA: strength by the area left; CHAIN: by d^2 (44 - 0.08 d)")
            .or("AREA"),
    ],
    "allowance off the diameter, and the strength that is left",
)
.default("0");
const CORRODED: OptionSpec = OptionSpec::new(
    "-CORRODED",
    &[ValueSpec::new("N", Kind::Integer, "segment from 1, from the fairlead").in_range(1.0, 1000.0)],
    "the segments that -CORROSION is for",
)
.repeating(1)
.default("all");
const ANCHOR: OptionSpec = OptionSpec::new(
    "-ANCHOR",
    &[
        ValueSpec::choice::<AnchorKind>("KIND", "PILE, SUCTION, DRAG or PLATE"),
        ValueSpec::choice::<PullDirection>("DIRECTION", "LATERAL, AXIAL or LINE: the direction of the capacity"),
        ValueSpec::new("CAPACITY", Kind::Number(Dim::Force), "holding capacity").positive(),
    ],
    "checks the anchors of the lines; once for each direction",
)
.many();
const OFFSET: OptionSpec = OptionSpec::new(
    "-OFFSET",
    &[
        ValueSpec::new("BODY", Kind::Name(Noun::Body), "body"),
        ValueSpec::new("LIMIT", Kind::Number(Dim::Length), "largest horizontal offset of its origin").positive(),
        ValueSpec::new("X", Kind::Number(Dim::Length), "X from where").or("where the run began; 0 in CONN_DESIGN"),
        ValueSpec::new("Y", Kind::Number(Dim::Length), "Y from where").or("where the run began; 0 in CONN_DESIGN"),
    ],
    "checks the offset of a body",
)
.many();
const GROUNDED: OptionSpec = OptionSpec::new(
    "-GROUNDED",
    &[ValueSpec::new("LEAST", Kind::Number(Dim::Length), "least unstretched length on the bottom").not_negative()],
    "checks the length of each line on the bottom",
);
const CLEARANCE: OptionSpec = OptionSpec::new(
    "-CLEARANCE",
    &[
        ValueSpec::new("LINE", Kind::Name(Noun::Connector), "connector"),
        ValueSpec::new("OTHER", Kind::Text, "another connector, a body, or BOTTOM"),
        ValueSpec::new("LEAST", Kind::Number(Dim::Length), "least distance").not_negative(),
        ValueSpec::new("SEGMENT", Kind::Integer, "segment of LINE, from 1").in_range(1.0, 1000.0).or("all of it"),
    ],
    "checks the distance of a line from another line, a body or the bottom",
)
.many();
const LIFE: OptionSpec = OptionSpec::new(
    "-LIFE",
    &[
        ValueSpec::new("YEARS", Kind::Number(Dim::None), "design life").positive(),
        ValueSpec::new(
            "RATIO",
            Kind::Number(Dim::None),
            "damage of the less over that of the more damaged of neighbours",
        )
        .in_range(0.0, 1.0)
        .or("not given"),
    ],
    "checks the fatigue life of the environments that FATIGUE has added up, weighted by their durations",
);

const OPTIONS: &[OptionSpec] = &[
    CODE,
    LIST,
    FILE,
    UNCONFIRMED,
    CLASS,
    MOORING,
    SPARE,
    EVENTS,
    CHARACTERISTIC,
    DURATION,
    PRETENSION,
    CORROSION,
    CORRODED,
    ANCHOR,
    OFFSET,
    GROUNDED,
    CLEARANCE,
    LIFE,
    DISPOSE,
    HARD,
    BOTH,
    WIDE,
];

static SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: &[&menu::CONN_DESIGN, &menu::PRCPOST],
    opens: Opens::WithOption(&menu::DISPOSITION, &DISPOSE),
    data: CONNECTORS,
    repeat: 1,
    options: OPTIONS,
    detail: "In PRCPOST the lines of the last TDOM, but TTRA_SET: of each segment the mean tension T Mean, the characteristic tension less \
             that, T Dyn, the breaking load with its corrosion, and safety factor or utilisation. The characteristic tension is the most \
             probable maximum of a Weibull distribution of the maxima between crossings of the mean, with its 95 per cent interval and the \
             number n of maxima, or the largest one where these do not do. In CONN_DESIGN the lines between their ends as they \
             are, as a quasi-static analysis. The factors follow from how the lines were run, quasi-static or dynamic, and from the lines \
             lost: none is intact, some before the run is damaged, some during it is transient. Lines of both kinds are refused together: \
             name those of one. Factors from memory are refused without -UNCONFIRMED. A code whose numbers are not known takes them from \
             -FILE (docs/design-checks.md has its form). Limits of -OFFSET, -GROUNDED and -CLEARANCE are your own. -DISPOSE \
             opens the disposition menu over a table. Rows of lines are kept for a study.",
    example: "MEDIT\n&DESCRIBE BODY BUOY -IGNORE Z RX RY RZ\n*P 0 0 0\n#WEIGHT *P 2000 10 10 10\n~W B_CAT 4 -LEN 4000 -DEP 500\n\
              CONNECTOR A -ANC 0 3900 ~W *P\nCONNECTOR B -ANC 180 3900 ~W *P\nEND\nCONN_DESIGN\nCODE_CHECK -CODE API_RP_2SK_3\n\
              CODE_CHECK -CODE DNV_OS_E301_2015 -LIST -DISPOSE\nVLIST\nEND\nEND\n&INSTATE -LOCATE BUOY 5\n&ENV -TIME 60 1\nTDOM\nPRCPOST\n\
              CODE_CHECK -CODE API_RP_2SK_3 -CORROSION 0.1 -ANCHOR DRAG LATERAL 900 -MOORING PERMANENT -UNCONFIRMED -OFFSET BUOY 20\n\
              CODE_CHECK -CODE API_RP_2SK_3 -EVENTS 10 60\nEND",
    ..CommandSpec::new("CODE_CHECK", "checks lines, anchors and limits by a design code")
};

/// What a record asks for.
struct CheckQuery<'a> {
    args: &'a Args,
    code: &'a Code,
    options: CodeOptions,
}

impl CheckQuery<'_> {
    /// Corrosion allowance (m), its law, and the segments it is for; none of them means all.
    fn corrosion(&self) -> (f64, CorrosionLaw, Vec<i64>) {
        let given = self.args.option(&CORROSION);
        let allowance = given.and_then(|g| g.number(const { CORROSION.number("D") })).unwrap_or(0.0);
        let law = match given.and_then(|g| g.choice::<CorrosionWord>(const { CORROSION.choice("LAW") })) {
            Some(CorrosionWord::Chain) => CorrosionLaw::ChainFormula,
            Some(CorrosionWord::Area) | None => CorrosionLaw::Area,
        };
        let segments = self
            .args
            .option(&CORRODED)
            .map_or_else(Vec::new, |g| g.values.iter().filter_map(|v| v.integer()).collect());
        (allowance, law, segments)
    }

    /// Each time that an option is given.
    fn each(&self, option: &OptionSpec) -> impl Iterator<Item = &Given> {
        let name = option.name;
        self.args.options.iter().filter(move |given| given.name() == name)
    }
}

/// The codes that ship, with those of -FILE before.
fn library(job: &Job, args: &Args) -> Outcome<CodeLibrary> {
    let shipped = CodeLibrary::parse_shipped(SHIPPED)
        .map_err(|error| Diagnostic::error(format!("the codes that ship cannot be read: {error}"), args.span))?;
    let Some(given) = args.option(&FILE) else { return Ok(shipped) };
    let name = given.word(const { FILE.word("FILE") }).unwrap_or_default();
    let path = existing(job, name, given.span)?;
    let bytes = read_input(job, &path, MAX_FILE_BYTES as u64)
        .map_err(|error| Diagnostic::error(format!("{name} cannot be read: {error}"), given.span))?;
    let text = String::from_utf8(bytes)
        .map_err(|error| Diagnostic::error(format!("{name} is not UTF-8: {error}"), given.span))?;
    let own =
        CodeLibrary::parse_own(&text).map_err(|error| Diagnostic::error(format!("{name}, {error}"), given.span))?;
    Ok(shipped.with_own(own))
}

/// An error of a code at the place of an option.
fn refused(error: &CodeError, args: &Args) -> Box<Diagnostic> {
    let span = args.option(&CODE).map_or(args.span, |given| given.position(const { CODE.word("NAME") }));
    let mut made = Diagnostic::error(error.to_string(), span);
    if let CodeError::NoCode { near, .. } = error {
        made.help.push(format!("codes: {}", near.join(", ")));
    }
    made
}

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let library = library(job, args)?;
    let code = match args.option_word(&CODE) {
        Some(name) => Some(library.find(name).map_err(|error| refused(&error, args))?),
        None => None,
    };
    if args.has(&LIST) {
        let codes: Vec<&Code> = code.map_or_else(|| library.codes().iter().collect(), |code| vec![code]);
        let tables = [tables::code_list(&codes)];
        return print_or_dispose(job, args, &tables, (None, args.span));
    }
    let Some(code) = code else {
        let names: Vec<&str> = library.codes().iter().map(|code| code.name.as_str()).collect();
        return Err(Diagnostic::error("the code to check by is not said: -CODE names it", args.span)
            .help(format!("codes: {}; -LIST lists their factors", names.join(", "))));
    };
    let options = CodeOptions {
        class: args.option_word(&CLASS).map(str::to_string),
        mooring: args.option_choice(&MOORING, const { MOORING.choice("HOW") }),
        unconfirmed: args.has(&UNCONFIRMED),
    };
    let query = CheckQuery { args, code, options };
    let over_run = matches!(job.menus.last(), Some(Menu::Post));
    if let Some(given) = args.option(&EVENTS).filter(|_| !over_run) {
        return Err(Diagnostic::error("-EVENTS chooses instants of a run", given.span)
            .help("CODE_CHECK of CONN_DESIGN checks the lines between their ends as they are; that of PRCPOST a run"));
    }
    let mooring = if over_run { loads::of_run(job, call, &query)? } else { loads::of_state(job, call, &query)? };
    let (tables, rows) = tables::check(job, &query, &mooring)?;
    let transient = if over_run { transient_of(job, args) } else { None };
    let effect = print_or_dispose(job, args, &tables, (transient, args.span))?;
    job.kept.lines.extend(rows);
    Ok(effect)
}

/// The names of lines that do not belong to the mooring.
fn is_spare(job: &Job, query: &CheckQuery, name: &str) -> bool {
    query.args.option(&SPARE).is_some_and(|given| NameFilter::new(&given.values, &job.model).matches(name))
}

/// What of a mooring is checked: see [`loads`].
type Checked = Outcome<CheckedMooring>;
