//! String functions about the model and the job: `&INFO`, `&GET` and `&F_READ` here, the others in a file each.
//!
//! Source: [MOSES-REF geom_sfun, ele]. What no source says is marked in [`FUNCTION_HELP`] as our reading.

mod body;
mod compartment;
mod connector;
mod environment;
mod names;
mod point;

use crate::commands::job::{Checking, UserFile};
use crate::commands::settings::name_list;
use crate::commands::{COMMANDS, Job};
use crate::report::format::fifteen_figures;
use windlass_base::choice::Choice;
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome, Severity};
use windlass_base::span::Span;
use windlass_base::units::Dim;
use windlass_language::logic;
use windlass_language::number;
use windlass_language::record::Word;
use windlass_language::select::choose_word;
use windlass_language::substitution::{FunctionHost, UNKNOWN};
use windlass_model::{Model, Point};

/// What `&HELP` says of each: name, form, meaning.
pub const FUNCTION_HELP: &[(&str, &str, &str)] = &[
    (
        "&INFO",
        "&INFO(NAME data)",
        "SEVERITY ERROR|WARNING (did the previous record raise it) | MENU DATE T_OF_DAY TITLE SUBTITLE ROOT CWD | units: \
         BFORCE LFORCE BLENGTH LLENGTH | FILE_EXISTS name (in the job's folder, else beside the script, as for &FILE USE)",
    ),
    (
        "&POINT",
        "&POINT(ACTION data)",
        "COORDINATES *P [-BODY|-GLOBAL] (part system by default) | D_NODE *P *Q (distance) | PART *P | NEAREST x y z | \
         N_BOX x1 x2 y1 y2 z1 z2 (points in a global box) | CLOSE *P r (other points within r) | EULER_ANGLES *O *X *XY (degrees) | \
         N_2NODES *P *Q (points on the line from *P to *Q, these two first and last) | HOOK_LOC SET (global x y z of the hook of a \
         tip-hook set: our reading) | RATIO, DEFLECTION, OFFSET, REL_MOTION: refused, windlass has no such values",
    ),
    (
        "&BODY",
        "&BODY(ACTION NAME)",
        "WEIGHT | CG | RADII (center of gravity and radii of gyration, in the body) | LOCATION (x y z roll pitch yaw) | PARTS | POINTS | \
         CURRENT (the body described last; no NAME). Our reading: DRAFT (of the origin below the mean surface, as -CONDITION of &INSTATE takes it) | \
         DISPLACE (weight of the water displaced) | CB (center of buoyancy, in the body) | GM (transverse, longitudinal) | MAX_BUOY \
         (buoyancy of the whole hull) | EXTREMES (x1 x2 y1 y2 z1 z2 of points and pieces, in the body)",
    ),
    (
        "&PART",
        "&PART(ACTION NAME)",
        "our reading: BODY | LOCATION (x y z roll pitch yaw in the body) | POINTS | PIECES | WEIGHT | CG | RADII (in the body) | EXTREMES (x1 \
         x2 y1 y2 z1 z2 of points and pieces, in the part) | CURRENT (the part described last; no NAME)",
    ),
    (
        "&CONNECTOR",
        "&CONNECTOR(ACTION NAME)",
        "CLASS | POINTS | STATUS (ACTIVE or INACTIVE) | ANCHOR (x y) | LENGTH (of the first segment, unstretched) | as &STATUS F_CONNECTOR has \
         them, zero of an inactive one: FORCE (FX FY FZ on the body, global, and its size) | TENSION | RATIO (largest tension over break) \
         | HORIZONTAL (force) | ON_BOTTOM (length) | DISTANCE (horizontal, between the ends). What the actions give is our reading",
    ),
    (
        "&ELEMENT",
        "&ELEMENT(ACTION NAME)",
        "of a connector: EN_NODES | CLASS | ELE_TYPE | LENGTH (between its ends) | DCOSINES (of the way from its first end, global) | RATIO (as \
         of &CONNECTOR); of a tube of a hull: LENGTH | DCOSINES (in its part) | BUOYANCY (all under water) | ELE_TYPE. CATEGORY, WEIGHT, \
         SEG_LENG, STRESS and CDR are refused where windlass has no such value",
    ),
    (
        "&COMPARTMENT",
        "&COMPARTMENT(NAME -OPTION)",
        "-AMOUNT, -PERCENT: name, amount or percent full, specific gravity, to stand after the same option of the record &COMPARTMENT. Our reading: \
         -FRACTION, -SOUNDING likewise | -VOLUME | -CG (of the contents, in the body) | -SPGR | -HOLES (their names)",
    ),
    (
        "&ENV",
        "&ENV(ACTION [NAME])",
        "of the environment in force, or the one kept under a name: NAME | DEPTH | TIDE | WATER (density) | SPGWATER | SEA, A_SEA (name dir \
         height period) | WIND (speed dir) | CURRENT (velocity dir) | TIME (observed step [transient]) | RAMP; empty where it has none. What the \
         actions give is our reading",
    ),
    (
        "&NAMES",
        "&NAMES(KIND [pattern])",
        "BODIES PARTS POINTS NODES CLASSES CONNECTORS ELEMENTS CURVES ENVIRONMENTS SELECTORS PIECES COMPARTMENTS HOLES DMARKS SENSORS ASSEMBLIES \
         LOAD_GROUPS CATEGORIES PROCESSES SHAPES, in the plural or the singular, that fit a pattern or selector; PI_VIEWS are not kept: no names",
    ),
    (
        "&VARIABLE",
        "&VARIABLE(-WHILE <DATABASE>NAME pattern VAR)",
        "puts the next word of a list of &VARIABLE that fits a pattern or selector into VAR: .FALSE. while there is one, else .TRUE.",
    ),
    (
        "&GET",
        "&GET(prompt)",
        "what the user types at the terminal; of a script that runs by itself the next line of standard input: \
         `printf 'YES\\n' | windlass job.cif`; where there is none the value is empty, and one error says so",
    ),
    ("&F_READ", "&F_READ(TYPE VAR)", "reads a line of the file of &FILE USE into VAR; .TRUE. at its end"),
];

const NAMES: &[&str] = &[
    "INFO",
    "POINT",
    "BODY",
    "PART",
    "CONNECTOR",
    "ELEMENT",
    "COMPARTMENT",
    "ENV",
    "NAMES",
    "VARIABLE",
    "GET",
    "F_READ",
];

/// Functions of what is typed or read, which a check of a script does not know.
const OF_INPUT: &[&str] = &["GET", "F_READ"];
/// Functions of places and forces, which it does not know once a solve has been passed over.
const OF_RESULTS: &[&str] = &["POINT", "BODY", "CONNECTOR", "ELEMENT", "COMPARTMENT"];
/// Their actions that do not hang on places.
const OF_MODEL: &[&str] = &[
    "PART", "PARTS", "POINTS", "CURRENT", "WEIGHT", "CG", "RADII", "MAX_BUOY", "EXTREMES", "CLASS", "EN_NODES",
    "ELE_TYPE",
];

fn is_known_to_check(checking: Checking, name: &str, words: &[Word]) -> bool {
    let of_model =
        words.first().is_some_and(|action| OF_MODEL.iter().any(|known| known.eq_ignore_ascii_case(&action.text)));
    !(OF_INPUT.contains(&name) || (checking.solved && OF_RESULTS.contains(&name) && !of_model))
}

impl FunctionHost for Job {
    fn function_names(&self) -> &'static [&'static str] {
        NAMES
    }

    fn is_checking(&self) -> bool {
        self.checking.is_some()
    }

    fn function(&mut self, name: &str, words: &[Word], span: Span) -> Outcome<String> {
        if self.checking.is_some_and(|checking| !is_known_to_check(checking, name, words)) {
            if let ("F_READ", Some(variable)) = (name, words.get(1)) {
                self.assignments.push((variable.text.to_string(), UNKNOWN.into()));
            }
            return Ok(UNKNOWN.into());
        }
        if name == "GET" {
            let prompt: Vec<&str> = words.iter().map(|w| w.text.as_ref()).collect();
            if let Some(answer) = self.ask.as_ref().and_then(|ask| ask(&prompt.join(" "))) {
                return Ok(answer);
            }
            self.say_unanswered(span);
            return Ok(String::new());
        }
        if name == "F_READ" {
            return f_read(self, words, span);
        }
        if name == "VARIABLE" {
            return name_list::next_name(self, words, span);
        }
        let Some((action, rest)) = words.split_first() else {
            let form = FUNCTION_HELP.iter().find(|h| h.0.get(1..) == Some(name)).map_or("", |h| h.1);
            return Err(Diagnostic::error(format!("&{name} lacks its first word"), span).help(format!("form: {form}")));
        };
        match name {
            "INFO" => info(self, action, rest),
            "POINT" => point::point(self, action, rest, span),
            "BODY" => body::body(self, action, rest, span),
            "PART" => body::part(self, action, rest, span),
            "CONNECTOR" => connector::connector(self, action, rest, span),
            "ELEMENT" => connector::element(self, action, rest, span),
            "COMPARTMENT" => compartment::compartment(self, action, rest, span),
            "ENV" => environment::environment(self, action, rest),
            _ => names::names(self, action, rest),
        }
    }

    fn menus_of_command(&self, name: &str) -> Option<Vec<&'static str>> {
        let same: Vec<_> = COMMANDS.iter().filter(|c| c.spec.name.eq_ignore_ascii_case(name)).collect();
        let leaves = name.eq_ignore_ascii_case("END") || name.get(..4).is_some_and(|n| n.eq_ignore_ascii_case("END_"));
        if leaves || same.iter().any(|c| c.spec.menus.is_empty()) {
            return Some(Vec::new());
        }
        let menus: Vec<&str> = same.iter().flat_map(|c| c.spec.menus).map(|menu| menu.name).collect();
        (!menus.is_empty()).then_some(menus)
    }

    fn assignments(&mut self) -> Vec<(String, String)> {
        std::mem::take(&mut self.assignments)
    }
}

impl Job {
    /// Says once that a `&GET` has nobody to ask: the script goes on with an empty answer, and the run counts an error.
    fn say_unanswered(&mut self, span: Span) {
        if !std::mem::replace(&mut self.unanswered, true) {
            let said = Diagnostic::error("&GET got no answer: the script goes on with an empty one (said once)", span)
                .help("in batch each &GET takes a line of standard input: `printf 'YES\\n' | windlass job.cif`");
            self.notices.push(*said);
        }
    }
}

/// The action of a function that a word names.
fn pick<T: Choice>(word: &Word, of: &str) -> Outcome<T> {
    choose_word(&word.text, word.span, &format!("action of &{of}"))
}

/// Numbers in user units, separated by blanks.
fn numbers(values: &[f64], dim: Dim, job: &Job) -> String {
    values.iter().map(|v| fifteen_figures(dim.from_si(*v, job.units))).collect::<Vec<_>>().join(" ")
}

choices! {
    /// What `&INFO` gives.
    enum InfoAction {
        Severity = "SEVERITY",
        Menu = "MENU",
        Date = "DATE",
        TimeOfDay = "T_OF_DAY",
        Title = "TITLE",
        Subtitle = "SUBTITLE",
        Root = "ROOT",
        WorkingFolder = "CWD",
        BigForce = "BFORCE",
        LittleForce = "LFORCE",
        BigLength = "BLENGTH",
        LittleLength = "LLENGTH",
        FileExists = "FILE_EXISTS",
    }
}

fn info(job: &Job, action: &Word, rest: &[Word]) -> Outcome<String> {
    let first = || rest.first().map(|w| w.text.to_string()).unwrap_or_default();
    Ok(match pick(action, "INFO")? {
        InfoAction::Severity => {
            let error = matches!(job.last_severity, Some(Severity::Error | Severity::Fatal));
            let warning = error || job.last_severity == Some(Severity::Warning);
            logic::word(if first().eq_ignore_ascii_case("WARNING") { warning } else { error }).into()
        }
        InfoAction::Menu => job.menu().name().into(),
        InfoAction::Date => job.date(),
        InfoAction::TimeOfDay => {
            let now = time::OffsetDateTime::now_utc().time();
            format!("{:02}:{:02}:{:02}", now.hour(), now.minute(), now.second())
        }
        InfoAction::Title => job.titles[0].clone(),
        InfoAction::Subtitle => job.titles[1].clone(),
        InfoAction::Root => {
            job.output.folder.root.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default()
        }
        InfoAction::WorkingFolder => std::env::current_dir().map(|d| format!("{}/", d.display())).unwrap_or_default(),
        InfoAction::BigForce | InfoAction::LittleForce => job.units.words().1.into(),
        InfoAction::BigLength | InfoAction::LittleLength => job.units.words().0.into(),
        InfoAction::FileExists => {
            logic::word(crate::commands::settings::device::find_file(job, &first()).exists()).into()
        }
    })
}

fn find_point<'a>(job: &'a Job, word: Option<&Word>) -> Option<&'a Point> {
    word.and_then(|w| job.model.points.get(&Model::key(&w.text)))
}

fn number_words(words: &[Word]) -> Outcome<Vec<f64>> {
    words
        .iter()
        .map(|w| {
            number::evaluate(&w.text).map_err(|e| Diagnostic::error("expected a number", w.span).label(e.to_string()))
        })
        .collect()
}

fn f_read(job: &mut Job, words: &[Word], span: Span) -> Outcome<String> {
    let [file, variable] = words else { return Err(Diagnostic::error("&F_READ takes TYPE and VAR", span)) };
    match job.user_files.get_mut(&file.text.to_ascii_uppercase()) {
        Some(UserFile::Reading { lines, .. }) => match lines.pop() {
            Some(line) => {
                job.assignments.push((variable.text.to_string(), line));
                Ok(logic::word(false).into())
            }
            None => Ok(logic::word(true).into()),
        },
        _ => Err(Diagnostic::error(format!("no file of type {} is open for reading", file.text), file.span)
            .help("&FILE USE TYPE FILE opens one")),
    }
}
