//! String functions about the model and the job: `&INFO`, `&POINT`, `&BODY`, `&CONNECTOR`, `&NAMES`, `&GET`, `&F_READ`.
//!
//! Source: [MOSES-REF geom_sfun, ele]. An unknown point gives a null string, as there.

use crate::commands::job::UserFile;
use crate::commands::{COMMANDS, Job};
use crate::report::format::fifteen_figures;
use windlass_base::choice::Choice;
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome, Severity};
use windlass_base::geometry::Position;
use windlass_base::span::Span;
use windlass_base::units::Dim;
use windlass_base::wildcard::matches;
use windlass_language::logic;
use windlass_language::number;
use windlass_language::record::Word;
use windlass_language::select::choose_word;
use windlass_language::substitution::FunctionHost;
use windlass_model::{Mass, Model, Point};

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
        "COORDINATES *P [-BODY|-GLOBAL] (part system by default) | D_NODE *P *Q (distance) | PART *P | REL_MOTION, DEFLECTION, \
         HOOK_LOC, OFFSET: with the engines | NEAREST x y z | N_BOX x1 x2 y1 y2 z1 z2 (points in a global box) | CLOSE *P r | \
         EULER_ANGLES *O *X *XY (degrees) | RATIO *P *Q f (point at a share of the way) | N_2NODES *P *Q (nodes between)",
    ),
    (
        "&BODY",
        "&BODY(ACTION NAME)",
        "LOCATION (x y z roll pitch yaw) | PARTS | POINTS | WEIGHT | CG | RADII (center of gravity and radii of gyration, in the body)",
    ),
    ("&CONNECTOR", "&CONNECTOR(ACTION NAME)", "CLASS | POINTS | STATUS | ANCHOR (x y) | LENGTH (of the first segment)"),
    (
        "&NAMES",
        "&NAMES(KIND [pattern])",
        "BODIES PARTS POINTS CLASSES CONNECTORS CURVES ENVIRONMENTS SELECTORS that fit a pattern or selector",
    ),
    ("&GET", "&GET(prompt)", "what the user types at the terminal"),
    ("&F_READ", "&F_READ(TYPE VAR)", "reads a line of the file of &FILE USE into VAR; .TRUE. at its end"),
];

const NAMES: &[&str] = &["INFO", "POINT", "BODY", "CONNECTOR", "NAMES", "GET", "F_READ"];

impl FunctionHost for Job {
    fn function_names(&self) -> &'static [&'static str] {
        NAMES
    }

    fn function(&mut self, name: &str, words: &[Word], span: Span) -> Outcome<String> {
        if name == "GET" {
            let prompt: Vec<&str> = words.iter().map(|w| w.text.as_ref()).collect();
            let ask = self.ask.as_ref().ok_or_else(|| Diagnostic::error("&GET needs a terminal to ask at", span))?;
            return ask(&prompt.join(" ")).ok_or_else(|| Diagnostic::error("&GET got no answer", span));
        }
        if name == "F_READ" {
            return f_read(self, words, span);
        }
        let Some((action, rest)) = words.split_first() else {
            let form = FUNCTION_HELP.iter().find(|h| h.0.get(1..) == Some(name)).map_or("", |h| h.1);
            return Err(Diagnostic::error(format!("&{name} lacks its first word"), span).help(format!("form: {form}")));
        };
        match name {
            "INFO" => info(self, action, rest),
            "POINT" => point(self, action, rest, span),
            "BODY" => body(self, action, rest, span),
            "CONNECTOR" => connector(self, action, rest, span),
            _ => names(self, action, rest),
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

fn distance(a: Position, b: Position) -> f64 {
    a.iter().zip(b).map(|(p, q)| (p - q).powi(2)).sum::<f64>().sqrt()
}

choices! {
    /// What `&POINT` gives.
    enum PointAction {
        Coordinates = "COORDINATES",
        Distance = "D_NODE",
        Part = "PART",
        EulerAngles = "EULER_ANGLES",
        Between = "N_2NODES",
        InBox = "N_BOX",
        Ratio = "RATIO",
        Deflection = "DEFLECTION",
        HookLocation = "HOOK_LOC",
        Offset = "OFFSET",
        Close = "CLOSE",
        Nearest = "NEAREST",
        RelativeMotion = "REL_MOTION",
    }
}

fn point(job: &Job, action: &Word, rest: &[Word], span: Span) -> Outcome<String> {
    let model = &job.model;
    let at = |i: usize| find_point(job, rest.get(i)).map(|p| model.global(p));
    let joined = |list: Vec<&Point>| list.iter().map(|p| p.name.as_str()).collect::<Vec<_>>().join(" ");
    let lengths = |i: usize| {
        number_words(rest.get(i..).unwrap_or_default())
            .map(|v| v.into_iter().map(|x| Dim::Length.to_si(x, job.units)).collect::<Vec<_>>())
    };
    Ok(match pick(action, "POINT")? {
        PointAction::Coordinates => {
            let Some(found) = find_point(job, rest.first()) else { return Ok(String::new()) };
            let system = rest.get(1).map(|w| w.text.to_ascii_uppercase()).unwrap_or_default();
            let place = if !system.is_empty() && "-GLOBAL".starts_with(&system) {
                model.global(found)
            } else if !system.is_empty() && "-BODY".starts_with(&system) {
                model.parts.get(&Model::key(&found.part)).map_or(found.at, |p| p.place.apply(found.at))
            } else {
                found.at
            };
            numbers(&place, Dim::Length, job)
        }
        PointAction::Distance => {
            at(0).zip(at(1)).map_or(String::new(), |(a, b)| numbers(&[distance(a, b)], Dim::Length, job))
        }
        PointAction::Part => find_point(job, rest.first()).map_or(String::new(), |p| p.part.clone()),
        PointAction::EulerAngles => {
            let (Some(o), Some(x), Some(xy)) = (at(0), at(1), at(2)) else { return Ok(String::new()) };
            let v = |p: Position| nalgebra::Vector3::from(p) - nalgebra::Vector3::from(o);
            let (e1, e3) = (v(x), v(x).cross(&v(xy)));
            if e1.norm() == 0.0 || e3.norm() == 0.0 {
                return Err(Diagnostic::error("the three points lie on one line", span));
            }
            let (e1, e3) = (e1.normalize(), e3.normalize());
            let matrix = nalgebra::Matrix3::from_columns(&[e1, e3.cross(&e1), e3]);
            let (roll, pitch, yaw) = nalgebra::Rotation3::from_matrix_unchecked(matrix).euler_angles();
            numbers(&[roll, pitch, yaw], Dim::Angle, job)
        }
        PointAction::Between => {
            let (Some(a), Some(b)) = (at(0), at(1)) else { return Ok(String::new()) };
            let between = |p: &&Point| {
                let g = model.global(p);
                let (da, db, whole) = (distance(a, g), distance(g, b), distance(a, b));
                da > 0.0 && db > 0.0 && da + db <= whole * (1.0 + 1e-9)
            };
            joined(model.points.values().filter(between).collect())
        }
        PointAction::InBox => {
            let b = lengths(0)?;
            let [x1, x2, y1, y2, z1, z2] = b.as_slice() else {
                return Err(Diagnostic::error("N_BOX takes X1 X2 Y1 Y2 Z1 Z2", span));
            };
            let inside = |p: &&Point| {
                let [x, y, z] = model.global(p);
                (*x1..=*x2).contains(&x) && (*y1..=*y2).contains(&y) && (*z1..=*z2).contains(&z)
            };
            joined(model.points.values().filter(inside).collect())
        }
        PointAction::Ratio => {
            let (Some(a), Some(b)) = (at(0), at(1)) else { return Ok(String::new()) };
            let f = number_words(rest.get(2..).unwrap_or_default())?.first().copied().unwrap_or(0.5);
            numbers(&[0, 1, 2].map(|i| a[i] + f * (b[i] - a[i])), Dim::Length, job)
        }
        PointAction::Close => {
            let Some(a) = at(0) else { return Ok(String::new()) };
            let r = lengths(1)?.first().copied().unwrap_or(0.0);
            let own = rest.first().map(|w| Model::key(&w.text)).unwrap_or_default();
            joined(
                model
                    .points
                    .values()
                    .filter(|p| Model::key(&p.name) != own && distance(model.global(p), a) <= r)
                    .collect(),
            )
        }
        PointAction::Nearest => {
            let v = lengths(0)?;
            let [x, y, z] = v.as_slice() else { return Err(Diagnostic::error("NEAREST takes X Y Z", span)) };
            let to = |p: &Point| distance(model.global(p), [*x, *y, *z]);
            model.points.values().min_by(|a, b| to(a).total_cmp(&to(b))).map_or(String::new(), |p| p.name.clone())
        }
        unsupported @ (PointAction::Deflection
        | PointAction::HookLocation
        | PointAction::Offset
        | PointAction::RelativeMotion) => {
            let text = format!("&POINT({} ..) needs results of an engine", unsupported.word());
            return Err(Diagnostic::error(text, action.span)
                .label("there is no time or frequency domain result in this version"));
        }
    })
}

choices! {
    /// What `&BODY` gives.
    enum BodyAction {
        Location = "LOCATION",
        Parts = "PARTS",
        Points = "POINTS",
        Weight = "WEIGHT",
        CentreOfGravity = "CG",
        Radii = "RADII",
    }
}

fn body(job: &Job, action: &Word, rest: &[Word], span: Span) -> Outcome<String> {
    let action_name = pick(action, "BODY")?;
    let Some(name) = rest.first() else { return Err(Diagnostic::error("&BODY lacks the body's name", span)) };
    let model = &job.model;
    let found = windlass_model::find(&model.bodies, &name.text, "body", name.span)?;
    let key = Model::key(&found.name);
    let gravity = model.defaults.gravity;
    let mass = || -> Outcome<Mass> {
        let mass = Mass::from_parts(model.parts_of(found), gravity);
        if mass.mass == 0.0 {
            return Err(Diagnostic::error(format!("{} has no weight", found.name), name.span)
                .help("#WEIGHT and &WEIGHT -TOTAL give one"));
        }
        Ok(mass)
    };
    Ok(match action_name {
        BodyAction::Location => {
            let [x, y, z, roll, pitch, yaw] = found.place.values();
            format!("{} {}", numbers(&[x, y, z], Dim::Length, job), numbers(&[roll, pitch, yaw], Dim::Angle, job))
        }
        BodyAction::Parts => model
            .parts
            .values()
            .filter(|p| Model::key(&p.body) == key)
            .map(|p| p.name.as_str())
            .collect::<Vec<_>>()
            .join(" "),
        BodyAction::Points => {
            let own = |p: &&Point| model.body_of(p).is_some_and(|b| Model::key(&b.name) == key);
            model.points.values().filter(own).map(|p| p.name.as_str()).collect::<Vec<_>>().join(" ")
        }
        BodyAction::Weight => numbers(&[mass()?.mass * gravity], Dim::Force, job),
        BodyAction::CentreOfGravity => numbers(mass()?.centre.as_slice(), Dim::Length, job),
        BodyAction::Radii => numbers(&mass()?.radii().map(|k| k.unwrap_or(0.0)), Dim::Length, job),
    })
}

choices! {
    /// What `&CONNECTOR` gives.
    enum ConnectorAction {
        Class = "CLASS",
        Points = "POINTS",
        Status = "STATUS",
        Anchor = "ANCHOR",
        Length = "LENGTH",
    }
}

fn connector(job: &Job, action: &Word, rest: &[Word], span: Span) -> Outcome<String> {
    let action = pick(action, "CONNECTOR")?;
    let Some(name) = rest.first() else { return Err(Diagnostic::error("&CONNECTOR lacks the connector's name", span)) };
    let found = windlass_model::find(&job.model.connectors, &name.text, "connector", name.span)?;
    Ok(match action {
        ConnectorAction::Class => found.class.clone(),
        ConnectorAction::Points => found.points.join(" "),
        ConnectorAction::Status => if found.active { "ACTIVE" } else { "INACTIVE" }.into(),
        ConnectorAction::Anchor => found.anchor.map_or(String::new(), |a| numbers(&a.at, Dim::Length, job)),
        ConnectorAction::Length => {
            job.model.first_length(found).map_or(String::new(), |l| numbers(&[l], Dim::Length, job))
        }
    })
}

choices! {
    /// What `&NAMES` lists.
    enum NamesKind {
        Bodies = "BODIES",
        Parts = "PARTS",
        Points = "POINTS",
        Classes = "CLASSES",
        Connectors = "CONNECTORS",
        Curves = "CURVES",
        Environments = "ENVIRONMENTS",
        Selectors = "SELECTORS",
    }
}

fn names(job: &Job, kind: &Word, rest: &[Word]) -> Outcome<String> {
    let m = &job.model;
    let all: Vec<&str> = match pick(kind, "NAMES")? {
        NamesKind::Bodies => m.bodies.values().map(|b| b.name.as_str()).collect(),
        NamesKind::Parts => m.parts.values().map(|p| p.name.as_str()).collect(),
        NamesKind::Points => m.points.values().map(|p| p.name.as_str()).collect(),
        NamesKind::Classes => m.classes.values().map(|c| c.name.as_str()).collect(),
        NamesKind::Connectors => m.connectors.values().map(|c| c.name.as_str()).collect(),
        NamesKind::Curves => m.curves.values().map(|c| c.name.as_str()).collect(),
        NamesKind::Environments => m.environments.values().map(|e| e.name.as_str()).collect(),
        NamesKind::Selectors => m.selectors.values().map(|s| s.name.as_str()).collect(),
    };
    let fits = |name: &&str| {
        rest.is_empty()
            || rest.iter().any(|w| match m.selectors.get(&Model::key(&w.text)) {
                Some(selector) => selector.takes(name, m),
                None => matches(&w.text, name),
            })
    };
    Ok(all.into_iter().filter(fits).collect::<Vec<_>>().join(" "))
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
