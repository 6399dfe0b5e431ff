//! Deck 0: the JOB, TITLE, OPTIONS and RESTART lines.
//!
//! Source: [AQWA-TETHER chapters 5, 6, 8.1.0 and 8.2.0]; [AQWA-REF deck 0].

use super::card::{CardLine, integer};
use super::reader::CardReader;
use super::remarks::Remarks;
use windlass_base::diagnostic::{Diagnostic, did_you_mean};
use windlass_base::span::Span;

/// The program a deck is written for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Program {
    /// Diffraction and radiation.
    Line,
    /// Equilibrium.
    Librium,
    /// Frequency domain.
    Fer,
    /// Time domain in irregular waves, with drift.
    #[default]
    Drift,
    /// Time domain in regular waves.
    Naut,
}

const PROGRAMS: &[(&str, Program)] = &[
    ("LINE", Program::Line),
    ("LIBR", Program::Librium),
    ("FER", Program::Fer),
    ("DRIF", Program::Drift),
    ("NAUT", Program::Naut),
];
/// Most options that are kept; there are some sixty names.
const MAX_OPTIONS: usize = 200;
/// Codes of an analysis on the JOB line.
const ANALYSES: &[&str] = &["WFRQ", "DRFT", "STAT", "DYNA", "FIXD"];

/// What an option of deck 0 does here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DeckOptionEffect {
    /// It is acted on, or windlass does so anyway.
    Acts,
    /// It asks for pages that are not printed: no result depends on it.
    Prints(&'static str),
    /// It belongs to AQWA-LINE and changes no result here: what it asks for, and what windlass does.
    OfLine(&'static str),
    /// It would change results and is refused: the reason, and what to do instead.
    Refused(&'static str, &'static str),
}

use DeckOptionEffect::{Acts, OfLine, Prints, Refused};

const NO_QTF: &str = "quadratic transfer functions, which are not computed: slow drift is that of Newman's approximation, by the mean drift";

/// Options by name, with what becomes of them.
pub const OPTIONS: &[(&str, DeckOptionEffect)] = &[
    ("REST", Acts),
    ("DATA", Acts),
    ("LSTF", Acts),
    ("PRCE", Acts),
    ("NOST", Acts),
    ("PPEL", Prints("properties of each element")),
    ("PBIS", Prints("forces of each step of an iteration")),
    ("PFLH", Prints("results of low and high frequency apart")),
    ("PRAF", Prints("inactive degrees of freedom")),
    ("PRAS", Prints("spectra of articulation reactions")),
    ("PRFS", Prints("spectra of forces")),
    ("PRCS", Prints("what was withdrawn from AQWA")),
    ("PRTI", Prints("transfer functions")),
    ("PRRI", Prints("response amplitude operators")),
    ("PRRS", Prints("response spectra")),
    ("PRRP", Prints("response spectra")),
    ("PRTS", Prints("tension spectra")),
    ("PRDL", Prints("contents of the restart file")),
    ("PRPT", Prints("potentials of the panels")),
    ("PRPR", Prints("pressures of the panels")),
    ("AHD1", OfLine("a database in text; the results are kept as NetCDF beside the answers")),
    ("AQTF", OfLine(NO_QTF)),
    ("CQTF", OfLine(NO_QTF)),
    ("MQTF", OfLine(NO_QTF)),
    (
        "NQTF",
        OfLine(
            "mean drift by the near field; it is that of the waves far away, of several bodies by a surface around each",
        ),
    ),
    ("GOON", OfLine("errors of the mesh passed over; they are errors here")),
    ("LHFR", OfLine("irregular frequencies removed, which is always done")),
    ("CONV", Acts),
    (
        "NCNV",
        Refused(
            "radiation acts by convolution here, and not by coefficients of one frequency",
            "leave out NCNV: CONV is what windlass does",
        ),
    ),
    ("CRAO", Acts),
    (
        "CRNM",
        Refused("response amplitude operators are those with the lines of the deck", "leave out the lines of deck 14"),
    ),
    ("LDRG", Acts),
    ("NASF", Acts),
    (
        "RDEP",
        Refused(
            "a position file (.EQP) of an earlier run is not read",
            "POS1 of deck 15 puts structure 1 into its place",
        ),
    ),
    ("SUFC", Refused("forces of another program are not taken", "FORC of deck 14 is a constant force")),
];

/// Deck 0.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct JobDeck {
    /// Identifier of the run, up to four characters.
    pub run: String,
    /// The program.
    pub program: Program,
    /// Code of the analysis (`WFRQ`, `DRFT`, ..); empty when left blank.
    pub analysis: String,
    /// The title.
    pub title: String,
    /// Options in the order given, with their places, without END.
    pub options: Vec<(String, Span)>,
    /// First and last stage; 1 to 5 when no RESTART line is given.
    pub stages: (u8, u8),
    /// Name of the database of an earlier run, from the RESTART line; empty for none.
    pub database: String,
    /// The JOB line.
    pub span: Span,
}

impl JobDeck {
    /// Whether an option was given.
    pub fn option(&self, name: &str) -> bool {
        self.options.iter().any(|(option, _)| option == name)
    }

    /// Whether the analysis is run: the motion (stage 5), of LINE radiation and diffraction (stage 3). Not with the option DATA, which only checks the
    /// data.
    pub fn runs(&self) -> bool {
        let (start, finish) = self.stages;
        let of_program = if self.program == Program::Line { finish >= 3 } else { start <= 5 && finish >= 5 };
        of_program && !self.option("DATA")
    }

    /// Whether the decks of radiation and diffraction belong to the stages of this file, or to those before.
    pub fn has_diffraction(&self) -> bool {
        let (_, finish) = self.stages;
        finish >= 3 && !self.option("DATA")
    }

    /// Whether all structures are fixed (FIXD on the JOB line of LINE).
    pub fn is_fixed(&self) -> bool {
        self.program == Program::Line && self.analysis == "FIXD"
    }

    /// Whether the cards of a deck stand in the file: decks 1 to 5 belong to stage 1, 6 to 8 to stage 2, the others to
    /// stage 4.
    pub fn has_deck(&self, deck: u8) -> bool {
        let (start, finish) = self.stages;
        match deck {
            0..=5 => start <= 1,
            6..=8 => start <= 2 && finish >= 2,
            _ => start <= 4 && finish >= 4,
        }
    }
}

impl JobDeck {
    /// Whether a deck belongs to a stage before the first one.
    pub fn is_earlier(&self, deck: u8) -> bool {
        let (start, _) = self.stages;
        start > stage_of(deck)
    }
}

/// The stage that a deck belongs to.
fn stage_of(deck: u8) -> u8 {
    match deck {
        0..=5 => 1,
        6..=8 => 2,
        _ => 4,
    }
}

/// Whether a text is a deck: its first line that is no comment is a JOB line that names a program.
pub fn is_deck(text: &str) -> bool {
    let first = text
        .lines()
        .map(str::trim_start)
        .find(|line| !line.is_empty() && !line.starts_with(['*', '!', '/']))
        .unwrap_or_default()
        .to_ascii_uppercase();
    let mut words = first.split_whitespace();
    words.next() == Some("JOB") && words.any(|word| PROGRAMS.iter().any(|(name, _)| *name == word))
}

/// Reads deck 0.
pub fn read(reader: &mut CardReader<'_>) -> JobDeck {
    let mut job = JobDeck { stages: (1, 5), span: reader.current_span(), ..JobDeck::default() };
    let (mut restart, mut listed) = (None, None);
    let mut met: Vec<(&str, Span)> = Vec::new();
    while let Some(line) = reader.peek().cloned() {
        let Some(word) = CardLine::words(line.text).next() else { break };
        let rest =
            line.text.get(line.place_of(word).end as usize - line.position(0, 0).start as usize..).unwrap_or_default();
        let word = word.to_ascii_uppercase();
        if let Some(once) = ["JOB", "TITLE", "RESTART"].into_iter().find(|name| *name == word) {
            match met.iter().find(|(name, _)| *name == once) {
                Some((_, earlier)) => reader.remarks.add(
                    Diagnostic::error(format!("deck 0, {once}: this line is given twice"), line.whole())
                        .label("leave out one of the two")
                        .other(*earlier, "given here first"),
                ),
                None => met.push((once, line.whole())),
            }
        }
        match word.as_str() {
            "JOB" => {
                job.span = line.whole();
                read_job(&mut job, &line, rest, &mut reader.remarks);
            }
            "TITLE" => job.title = rest.trim().to_string(),
            "OPTIONS" => listed = Some((line.whole(), read_options(&mut job, &line, rest, &mut reader.remarks))),
            "RESTART" => restart = Some(line.clone()),
            "NUM_CORES" => {}
            _ => break,
        }
        reader.take();
    }
    if !met.iter().any(|(name, _)| *name == "JOB") {
        let span = job.span;
        reader.remarks.add(Diagnostic::error("deck 0 has no JOB line", span).label("JOB belongs in columns 1-3"));
    }
    if let Some((span, false)) = listed {
        reader.remarks.add(
            Diagnostic::error("deck 0, OPTIONS: the list has no END", span).label("END belongs after the last option"),
        );
    }
    read_restart(&mut job, restart, &mut reader.remarks);
    job
}

fn read_job(job: &mut JobDeck, line: &CardLine<'_>, rest: &str, remarks: &mut Remarks) {
    let by_columns =
        line.blank(4, 4) && line.blank(9, 10) && line.blank(15, 16) && !line.blank(11, 14) && line.stray().is_none();
    let words: Vec<&str> = if by_columns {
        vec![line.columns(5, 8).trim(), line.columns(11, 14).trim(), line.columns(17, 20).trim()]
    } else {
        CardLine::words(rest).collect()
    };
    let mut words = words.into_iter();
    job.run = words.next().unwrap_or_default().to_string();
    let program = words.next().unwrap_or_default();
    job.analysis = words.next().unwrap_or_default().to_ascii_uppercase();
    let name = program.to_ascii_uppercase();
    match PROGRAMS.iter().find(|(known, _)| *known == name) {
        Some((_, program)) => job.program = *program,
        None => {
            let mut error = Diagnostic::error(format!("deck 0, JOB: `{program}` is no program"), line.whole())
                .label("columns 11-14 name the program: LINE, LIBR, FER, DRIF or NAUT");
            error.help.extend(did_you_mean(program, PROGRAMS.iter().map(|(name, _)| *name)));
            remarks.add(error);
        }
    }
    if !job.analysis.is_empty() && !ANALYSES.contains(&job.analysis.as_str()) {
        let mut error =
            Diagnostic::error(format!("deck 0, JOB: `{}` is no known analysis", job.analysis), line.whole())
                .label("columns 17-20 hold WFRQ or DRFT for DRIF, STAT or DYNA for LIBR, nothing for NAUT");
        error.help.extend(did_you_mean(&job.analysis, ANALYSES.iter().copied()));
        remarks.add(error);
    }
}

/// Adds the options of a line; whether END closed the list.
fn read_options(job: &mut JobDeck, line: &CardLine<'_>, rest: &str, remarks: &mut Remarks) -> bool {
    for word in CardLine::words(rest) {
        let name = word.to_ascii_uppercase();
        if name == "END" {
            return true;
        }
        let span = line.place_of(word);
        if let Some(said) = report_option(&name, span) {
            remarks.add_once(&format!("option {name}"), || said);
        }
        if job.options.len() < MAX_OPTIONS {
            job.options.push((name, span));
        }
    }
    false
}

/// What is said of an option that is not acted on; a name that is not known may be a part of one.
fn report_option(name: &str, span: Span) -> Option<Box<Diagnostic>> {
    let card = format!("deck 0, OPTIONS, {name}");
    match OPTIONS.iter().find(|(known, _)| *known == name).map(|(_, effect)| *effect) {
        Some(Acts) => None,
        Some(Prints(what)) => Some(Diagnostic::remark(format!("{card}: {what}; no page is added or left out"), span)),
        Some(OfLine(what)) => Some(Diagnostic::remark(format!("{card}: {what}"), span)),
        Some(Refused(why, help)) => Some(Diagnostic::error(format!("{card}: {why}"), span).help(help)),
        None => {
            let mut error = Diagnostic::error(format!("deck 0, OPTIONS: {name} is not known"), span)
                .label("a name of four letters belongs here, with blanks between two names");
            error.help.extend(did_you_mean(name, OPTIONS.iter().map(|(known, _)| *known)));
            Some(
                error.help("an option may change results, so that none is passed over: leave it out if it only prints"),
            )
        }
    }
}

fn read_restart(job: &mut JobDeck, restart: Option<CardLine<'_>>, remarks: &mut Remarks) {
    let Some(line) = restart else {
        if let Some((_, span)) = job.options.iter().find(|(name, _)| name == "REST") {
            remarks.add(
                Diagnostic::error("deck 0: option REST asks for a RESTART line, and there is none", *span)
                    .help("RESTART, first stage in columns 9-11, last stage in columns 12-14"),
            );
        }
        return;
    };
    if !job.option("REST") {
        remarks.add(
            Diagnostic::warning("deck 0: the RESTART line has no effect without the option REST", line.whole())
                .help("stages 1 to 5 are run"),
        );
        return;
    }
    let mut words = CardLine::words(line.text).skip(1);
    // the name of the deck of an earlier run may hold blanks
    let behind = CardLine::words(line.text).nth(2).map(|word| line.place_of(word).end - line.position(0, 0).start);
    let mut stage = |name: &str| {
        let word = words.next().unwrap_or_default();
        let value = integer(word).and_then(|n| u8::try_from(n).ok()).filter(|n| (1..=6).contains(n));
        if value.is_none() {
            let span = if word.is_empty() { line.whole() } else { line.place_of(word) };
            remarks.add(
                Diagnostic::error(format!("deck 0, RESTART: `{word}` is no stage of the analysis"), span)
                    .label(format!("the {name} stage belongs here, 1 to 6")),
            );
        }
        value
    };
    let stages = (stage("first"), stage("last"));
    let name = behind.and_then(|from| line.text.get(from as usize..)).unwrap_or_default();
    job.database = name.trim_start_matches(',').trim().to_string();
    let (Some(start), Some(finish)) = stages else { return };
    if start > finish {
        let message = format!("deck 0, RESTART: stage {start} comes after stage {finish}");
        remarks.add(Diagnostic::error(message, line.whole()).label("the first stage, then the last"));
        return;
    }
    job.stages = (start, finish);
}
