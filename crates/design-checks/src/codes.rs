//! Codes as data: which factor for which analysis, condition and consequence class, with its clause, source and how sure it is.
//!
//! A library is TOML text, of the program or of the user; `docs/design-checks.md` has its form. A user's file is read by the same
//! reader; what it gives goes before what is shipped.

use crate::anchor::AnchorLoad;
use crate::{CheckError, above_zero};
use serde::Deserialize;
use std::fmt;
use toml::Spanned;
use windlass_base::choice::Choice;
use windlass_base::choices;
use windlass_base::diagnostic::nearest;

/// Most bytes of a file of codes.
pub const MAX_FILE_BYTES: usize = 1 << 20;

choices! {
    /// How the forces of a line were found.
    pub enum Analysis {
        /// A static line whose ends move.
        QuasiStatic = "quasi-static",
        /// A dynamic line.
        Dynamic = "dynamic",
    }
}

choices! {
    /// The state of the mooring.
    pub enum Condition {
        /// Every line acts.
        Intact = "intact",
        /// Lines are lost, and the unit has come to rest without them.
        Damaged = "damaged",
        /// Lines are lost during the run.
        Transient = "transient",
    }
}

choices! {
    /// How sure a number is.
    #[derive(Default)]
    pub enum Sureness {
        /// Read in the text of the code, or the user's own number.
        Confirmed = "confirmed",
        /// Read in somebody else's program or book that quotes the code.
        SecondHand = "second hand",
        /// From memory.
        #[default]
        FromMemory = "from memory",
        /// The form of the check is known, its numbers are not.
        NotGiven = "not given",
    }
}

choices! {
    /// How long the mooring stays.
    pub enum Mooring {
        /// Permanent.
        Permanent = "PERMANENT",
        /// Mobile.
        Mobile = "MOBILE",
    }
}

choices! {
    /// A kind of anchor.
    pub enum AnchorKind {
        /// Driven or drilled pile.
        Pile = "PILE",
        /// Suction pile.
        Suction = "SUCTION",
        /// Drag embedment anchor, which must not be pulled up.
        Drag = "DRAG",
        /// Plate anchor, loaded vertically.
        Plate = "PLATE",
    }
}

impl AnchorKind {
    /// Whether it may be pulled upward.
    pub fn bears_uplift(self) -> bool {
        self != AnchorKind::Drag
    }
}

choices! {
    /// The direction in which the capacity of an anchor counts.
    pub enum PullDirection {
        /// Horizontal.
        Lateral = "LATERAL",
        /// Vertical.
        Axial = "AXIAL",
        /// That of the line.
        Line = "LINE",
    }
}

impl PullDirection {
    /// The force of a load in this direction (N).
    pub fn force(self, load: &AnchorLoad) -> f64 {
        match self {
            PullDirection::Lateral => load.horizontal,
            PullDirection::Axial => load.vertical.max(0.0),
            PullDirection::Line => load.resultant(),
        }
    }
}

/// Where a number comes from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Provenance {
    /// Clause or table of the code.
    pub clause: String,
    /// Where the number was seen.
    pub source: String,
    /// How sure it is.
    pub sure: Sureness,
    /// Whether the user's own file gives it.
    pub is_own: bool,
}

impl Provenance {
    /// Whether a check by this number may pass.
    pub fn is_confirmed(&self) -> bool {
        matches!(self.sure, Sureness::Confirmed | Sureness::SecondHand)
    }
}

/// A form of check of line tension with its factors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TensionForm {
    /// Least strength over tension.
    SafetyFactor(f64),
    /// One partial factor on the tension.
    SingleFactor(f64),
    /// Partial factors on the mean and on the dynamic tension.
    PartialFactors {
        /// On T_mean.
        mean: f64,
        /// On T_dyn.
        dynamic: f64,
    },
    /// Partial factors on the pretension and on what the environment adds to it.
    PretensionFactors {
        /// On the pretension.
        pretension: f64,
        /// On the rest.
        environment: f64,
    },
}

impl TensionForm {
    /// Whether it takes the characteristic strength, not the breaking load.
    pub fn is_partial(&self) -> bool {
        !matches!(self, TensionForm::SafetyFactor(_))
    }
}

impl fmt::Display for TensionForm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            TensionForm::SafetyFactor(factor) => write!(f, "S / T >= {factor}"),
            TensionForm::SingleFactor(factor) => write!(f, "{factor} T / S_C <= 1"),
            TensionForm::PartialFactors { mean, dynamic } => write!(f, "({mean} T_mean + {dynamic} T_dyn) / S_C <= 1"),
            TensionForm::PretensionFactors { pretension, environment } => {
                write!(f, "({pretension} T_pret + {environment} (T - T_pret)) / S_C <= 1")
            }
        }
    }
}

/// The rule that a line's tension is checked by.
#[derive(Clone, Debug, PartialEq)]
pub struct TensionRule {
    /// The check and its factors.
    pub form: TensionForm,
    /// Where they come from.
    pub provenance: Provenance,
}

impl TensionRule {
    /// Whether a check by it may pass.
    pub fn is_confirmed(&self) -> bool {
        self.provenance.is_confirmed()
    }
}

/// The rule that an anchor is checked by.
#[derive(Clone, Debug, PartialEq)]
pub struct AnchorRule {
    /// Its kind.
    pub kind: AnchorKind,
    /// The direction of its capacity.
    pub direction: PullDirection,
    /// Least capacity over load.
    pub factor: f64,
    /// Where it comes from.
    pub provenance: Provenance,
}

impl AnchorRule {
    /// Whether a check by it may pass.
    pub fn is_confirmed(&self) -> bool {
        self.provenance.is_confirmed()
    }
}

/// A factor that grows with the damage of the neighbouring line: from a ratio on, by so much up to a ratio of 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NeighbourRise {
    /// Ratio (0..1) of the damages of two neighbouring lines from which on it grows.
    pub from: f64,
    /// By how much it has grown at a ratio of 1.
    pub rise: f64,
}

/// The rule that a fatigue life is checked by.
#[derive(Clone, Debug, PartialEq)]
pub struct FatigueRule {
    /// Factor on the design life.
    pub factor: f64,
    /// How it grows with the damage of the neighbouring line.
    pub rise: Option<NeighbourRise>,
    /// Where it comes from.
    pub provenance: Provenance,
}

impl FatigueRule {
    /// Whether a check by it may pass.
    pub fn is_confirmed(&self) -> bool {
        self.provenance.is_confirmed()
    }

    /// The factor with a ratio (0..1) of the damages of neighbouring lines.
    ///
    /// # Errors
    /// A ratio that is missing where the factor depends on it, or not in 0..1.
    pub fn factor_at(&self, ratio: Option<f64>) -> Result<f64, CheckError> {
        let Some(rise) = self.rise else { return Ok(self.factor) };
        let ratio = ratio.ok_or_else(|| {
            CheckError::Lacks(
                "the factor depends on the damage of the neighbouring line: give the ratio of the two".into(),
            )
        })?;
        if !(0.0..=1.0).contains(&ratio) {
            let expected = "between 0 and 1";
            return Err(CheckError::Value {
                what: "the ratio of damages of neighbouring lines",
                expected,
                value: ratio,
            });
        }
        Ok(self.factor + rise.rise * ((ratio - rise.from) / (1.0 - rise.from)).max(0.0))
    }
}

/// The rule of the characteristic strength: a share of the breaking load.
#[derive(Clone, Debug, PartialEq)]
pub struct StrengthRule {
    /// Characteristic strength over breaking load.
    pub share: f64,
    /// Where it comes from.
    pub provenance: Provenance,
}

choices! {
    /// What of the maxima of several seeds a code checks, where it is one of these.
    pub enum SeedsWord {
        /// Their most probable value, the mode of the Gumbel distribution fitted to them.
        Mpm = "mpm",
        /// Their mean.
        Mean = "mean",
    }
}

/// What of the maxima of several seeds is the design tension.
#[derive(Clone, Debug, PartialEq)]
pub enum SeedsStatistic {
    /// The most probable maximum.
    MostProbable,
    /// The mean of the maxima.
    Mean,
    /// Their mean plus so many standard deviations: for each number of seeds, ascending, how many from it on.
    MeanPlus(Vec<(usize, f64)>),
}

/// The rule of the design tension of several seeds.
#[derive(Clone, Debug, PartialEq)]
pub struct SeedsRule {
    /// What is checked.
    pub statistic: SeedsStatistic,
    /// Where it comes from; none where the code does not say it here, so that the most probable maximum is taken.
    pub provenance: Vec<Provenance>,
}

/// What of a code is chosen beside analysis and condition.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CodeOptions {
    /// Consequence class, as the code names it.
    pub class: Option<String>,
    /// Permanent or mobile.
    pub mooring: Option<Mooring>,
    /// Take numbers from memory too: such a check never passes.
    pub unconfirmed: bool,
}

/// Why a code gives no rule.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CodeError {
    /// No code has this name.
    #[error("there is no code {name}")]
    NoCode {
        /// The name.
        name: String,
        /// The nearest names, or all.
        near: Vec<String>,
    },
    /// The code has nothing for this.
    #[error("{code} has no rule for {what}: a file of your own can give it")]
    NoRule {
        /// The code.
        code: String,
        /// What was asked for.
        what: String,
    },
    /// The form is known, its numbers are not.
    #[error("{code}: windlass has the form of the check for {what}, not its numbers: give them in a file of your own")]
    NotGiven {
        /// The code.
        code: String,
        /// What was asked for.
        what: String,
    },
    /// The numbers are from memory.
    #[error(
        "{code}: the numbers for {what} are from memory: give them in a file of your own, or -UNCONFIRMED takes them and the check \
         cannot pass"
    )]
    FromMemory {
        /// The code.
        code: String,
        /// What was asked for.
        what: String,
    },
    /// Something must be chosen.
    #[error("{code} has rules for {what} by {by}: choose one of {choices}")]
    Choose {
        /// The code.
        code: String,
        /// What was asked for.
        what: String,
        /// What it differs by.
        by: &'static str,
        /// What there is.
        choices: String,
    },
}

/// What is wrong with a file of codes.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("line {line}, column {column}: {message}")]
pub struct CodeFileError {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// What is wrong.
    pub message: String,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    code: Vec<Spanned<RawCode>>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawCode {
    name: Spanned<String>,
    title: String,
    edition: String,
    #[serde(default)]
    note: String,
    #[serde(default)]
    tension: Vec<Spanned<RawTension>>,
    #[serde(default)]
    strength: Vec<Spanned<RawNumber>>,
    #[serde(default)]
    anchor: Vec<Spanned<RawAnchor>>,
    #[serde(default)]
    fatigue: Vec<Spanned<RawFatigue>>,
    #[serde(default)]
    mean_plus: Vec<Spanned<RawMeanPlus>>,
    #[serde(default)]
    seeds: Vec<Spanned<RawSeeds>>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawTension {
    form: Spanned<String>,
    analysis: Spanned<String>,
    condition: Spanned<String>,
    class: Option<Spanned<String>>,
    mooring: Option<Spanned<String>>,
    factor: Option<Spanned<f64>>,
    mean: Option<Spanned<f64>>,
    dynamic: Option<Spanned<f64>>,
    pretension: Option<Spanned<f64>>,
    environment: Option<Spanned<f64>>,
    #[serde(default)]
    clause: String,
    #[serde(default)]
    source: String,
    sure: Option<Spanned<String>>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawNumber {
    share: Option<Spanned<f64>>,
    #[serde(default)]
    clause: String,
    #[serde(default)]
    source: String,
    sure: Option<Spanned<String>>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawAnchor {
    kind: Spanned<String>,
    direction: Spanned<String>,
    condition: Spanned<String>,
    analysis: Option<Spanned<String>>,
    mooring: Option<Spanned<String>>,
    factor: Option<Spanned<f64>>,
    #[serde(default)]
    clause: String,
    #[serde(default)]
    source: String,
    sure: Option<Spanned<String>>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawFatigue {
    factor: Option<Spanned<f64>>,
    neighbour_from: Option<Spanned<f64>>,
    neighbour_rise: Option<Spanned<f64>>,
    #[serde(default)]
    clause: String,
    #[serde(default)]
    source: String,
    sure: Option<Spanned<String>>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawMeanPlus {
    analysis: Spanned<String>,
    seeds: Spanned<i64>,
    deviations: Option<Spanned<f64>>,
    #[serde(default)]
    clause: String,
    #[serde(default)]
    source: String,
    sure: Option<Spanned<String>>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawSeeds {
    statistic: Spanned<String>,
    analysis: Option<Spanned<String>>,
    #[serde(default)]
    clause: String,
    #[serde(default)]
    source: String,
    sure: Option<Spanned<String>>,
}

/// An entry of a code: whom it is for, what it says, and where it comes from. What it says is missing where only the form is known.
#[derive(Clone, Debug, PartialEq)]
struct Entry<W, T> {
    whom: W,
    value: Option<T>,
    provenance: Provenance,
}

#[derive(Clone, Debug, PartialEq)]
struct TensionWhom {
    analysis: Analysis,
    condition: Condition,
    class: Option<String>,
    mooring: Option<Mooring>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct AnchorWhom {
    kind: AnchorKind,
    direction: PullDirection,
    condition: Condition,
    analysis: Option<Analysis>,
    mooring: Option<Mooring>,
}

/// A design code.
#[derive(Clone, Debug, PartialEq)]
pub struct Code {
    /// Its name in records, with the edition.
    pub name: String,
    /// The document.
    pub title: String,
    /// The edition.
    pub edition: String,
    /// What a user should know of it.
    pub note: String,
    tension: Vec<Entry<TensionWhom, TensionForm>>,
    strength: Vec<Entry<(), f64>>,
    anchor: Vec<Entry<AnchorWhom, f64>>,
    fatigue: Vec<Entry<(), (f64, Option<NeighbourRise>)>>,
    mean_plus: Vec<Entry<(Analysis, i64), f64>>,
    seeds: Vec<Entry<Option<Analysis>, SeedsWord>>,
}

/// A row of the list of what a code says.
#[derive(Clone, Debug, PartialEq)]
pub struct CodeLine {
    /// Kind of check.
    pub check: &'static str,
    /// Analysis, condition, class and what else it is for.
    pub applies: String,
    /// The check with its factors; empty where they are not given.
    pub value: String,
    /// Where it comes from.
    pub provenance: Provenance,
}

/// Codes by name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CodeLibrary {
    codes: Vec<Code>,
}

impl CodeLibrary {
    /// Reads the codes that a program ships: every number says how sure it is.
    ///
    /// # Errors
    /// The first fault of the text, with its place.
    pub fn parse_shipped(text: &str) -> Result<Self, CodeFileError> {
        Reader { text, is_own: false }.read()
    }

    /// Reads a user's codes: a number that does not say how sure it is is confirmed.
    ///
    /// # Errors
    /// The first fault of the text, with its place.
    pub fn parse_own(text: &str) -> Result<Self, CodeFileError> {
        Reader { text, is_own: true }.read()
    }

    /// The same with a user's codes before: their entries go before those of a code of the same name.
    #[must_use]
    pub fn with_own(mut self, own: CodeLibrary) -> Self {
        for mut code in own.codes {
            match self.codes.iter_mut().find(|known| known.name.eq_ignore_ascii_case(&code.name)) {
                Some(known) => {
                    code.tension.append(&mut known.tension);
                    code.strength.append(&mut known.strength);
                    code.anchor.append(&mut known.anchor);
                    code.fatigue.append(&mut known.fatigue);
                    // a statistic of the user's own takes the place of deviations that ship
                    if code.seeds.is_empty() {
                        code.mean_plus.append(&mut known.mean_plus);
                    }
                    code.seeds.append(&mut known.seeds);
                    *known = code;
                }
                None => self.codes.push(code),
            }
        }
        self
    }

    /// The codes, in the order of the files.
    pub fn codes(&self) -> &[Code] {
        &self.codes
    }

    /// The code of a name, in capitals or not.
    ///
    /// # Errors
    /// None has this name.
    pub fn find(&self, name: &str) -> Result<&Code, CodeError> {
        self.codes.iter().find(|code| code.name.eq_ignore_ascii_case(name)).ok_or_else(|| {
            let known = || self.codes.iter().map(|code| code.name.as_str());
            let close = nearest(&name.to_ascii_uppercase(), known());
            let near = if close.is_empty() {
                known().map(str::to_string).collect()
            } else {
                close.iter().map(ToString::to_string).collect()
            };
            CodeError::NoCode { name: name.to_string(), near }
        })
    }
}

impl Code {
    /// The rule for the tension of a line that was analysed in a way, in a condition of the mooring.
    ///
    /// # Errors
    /// No rule, one without numbers or from memory, or one that a class must be chosen for.
    pub fn tension_rule(
        &self,
        analysis: Analysis,
        condition: Condition,
        options: &CodeOptions,
    ) -> Result<TensionRule, CodeError> {
        let what = format!("line tension, {} analysis, {}", analysis.word(), condition.word());
        let entries: Vec<_> = self
            .tension
            .iter()
            .filter(|e| e.whom.analysis == analysis && e.whom.condition == condition)
            .filter(|e| fits(e.whom.mooring, options.mooring))
            .collect();
        if options.class.is_none() {
            let classes = entries.iter().filter_map(|e| e.whom.class.as_deref());
            self.must_choose(
                &what,
                "consequence class (-CLASS)",
                classes,
                entries.first().is_some_and(|e| e.whom.class.is_none()),
            )?;
        }
        if options.mooring.is_none() {
            let moorings = entries.iter().filter_map(|e| e.whom.mooring.map(Mooring::word));
            self.must_choose(
                &what,
                "mooring (-MOORING)",
                moorings,
                entries.first().is_some_and(|e| e.whom.mooring.is_none()),
            )?;
        }
        let fits_class = |own: &Option<String>| match (own, &options.class) {
            (Some(own), Some(chosen)) => own.eq_ignore_ascii_case(chosen),
            _ => true,
        };
        if let Some(chosen) = &options.class {
            let classes: Vec<&str> = entries.iter().filter_map(|e| e.whom.class.as_deref()).collect();
            if !classes.is_empty() && !entries.iter().any(|e| fits_class(&e.whom.class)) {
                return Err(CodeError::NoRule { code: self.name.clone(), what: format!("{what}, class {chosen}") });
            }
        }
        let found = entries.into_iter().find(|e| fits_class(&e.whom.class));
        let (form, provenance) = self.usable(found, what, options.unconfirmed)?;
        Ok(TensionRule { form, provenance })
    }

    /// The characteristic strength as a share of the breaking load; none of a code that takes the breaking load itself.
    ///
    /// # Errors
    /// A share without number or from memory.
    pub fn strength_rule(&self, options: &CodeOptions) -> Result<Option<StrengthRule>, CodeError> {
        if self.strength.is_empty() {
            return Ok(None);
        }
        let what = "the characteristic strength".to_string();
        let (share, provenance) = self.usable(self.strength.first(), what, options.unconfirmed)?;
        Ok(Some(StrengthRule { share, provenance }))
    }

    /// The rule for an anchor.
    ///
    /// # Errors
    /// No rule, one without numbers or from memory, or one that a mooring must be chosen for.
    pub fn anchor_rule(
        &self,
        (kind, direction): (AnchorKind, PullDirection),
        (analysis, condition): (Analysis, Condition),
        options: &CodeOptions,
    ) -> Result<AnchorRule, CodeError> {
        let what = format!(
            "a {} anchor, {} load, {} analysis, {}",
            kind.word().to_lowercase(),
            direction.word().to_lowercase(),
            analysis.word(),
            condition.word()
        );
        let entries: Vec<_> = self
            .anchor
            .iter()
            .filter(|e| e.whom.kind == kind && e.whom.direction == direction && e.whom.condition == condition)
            .filter(|e| fits(e.whom.analysis, Some(analysis)) && fits(e.whom.mooring, options.mooring))
            .collect();
        if options.mooring.is_none() {
            let moorings = entries.iter().filter_map(|e| e.whom.mooring.map(Mooring::word));
            self.must_choose(
                &what,
                "mooring (-MOORING)",
                moorings,
                entries.first().is_some_and(|e| e.whom.mooring.is_none()),
            )?;
        }
        let (factor, provenance) = self.usable(entries.first().copied(), what, options.unconfirmed)?;
        Ok(AnchorRule { kind, direction, factor, provenance })
    }

    /// The rule for fatigue life.
    ///
    /// # Errors
    /// No rule, or one without numbers or from memory.
    pub fn fatigue_rule(&self, options: &CodeOptions) -> Result<FatigueRule, CodeError> {
        let what = "fatigue life".to_string();
        let ((factor, rise), provenance) = self.usable(self.fatigue.first(), what, options.unconfirmed)?;
        Ok(FatigueRule { factor, rise, provenance })
    }

    /// The rule for the design tension of several seeds.
    ///
    /// # Errors
    /// Numbers that are missing or from memory.
    pub fn seeds_rule(&self, analysis: Analysis, options: &CodeOptions) -> Result<SeedsRule, CodeError> {
        let what = format!("the design tension of several seeds, {} analysis", analysis.word());
        let of_analysis = || self.mean_plus.iter().filter(|entry| entry.whom.0 == analysis);
        if of_analysis().next().is_some() {
            let (mut steps, mut provenance): (Vec<(usize, f64)>, Vec<Provenance>) = (Vec::new(), Vec::new());
            for entry in of_analysis() {
                let Ok(seeds) = usize::try_from(entry.whom.1) else { continue };
                // the user's own, which comes first, goes before what ships
                if steps.iter().any(|(known, _)| *known == seeds) {
                    continue;
                }
                let (deviations, from) = self.usable(Some(entry), what.clone(), options.unconfirmed)?;
                steps.push((seeds, deviations));
                if !provenance.contains(&from) {
                    provenance.push(from);
                }
            }
            steps.sort_unstable_by_key(|(seeds, _)| *seeds);
            return Ok(SeedsRule { statistic: SeedsStatistic::MeanPlus(steps), provenance });
        }
        let Some(found) = self.seeds.iter().find(|entry| fits(entry.whom, Some(analysis))) else {
            return Ok(SeedsRule { statistic: SeedsStatistic::MostProbable, provenance: Vec::new() });
        };
        let (word, provenance) = self.usable(Some(found), what, options.unconfirmed)?;
        let statistic = match word {
            SeedsWord::Mpm => SeedsStatistic::MostProbable,
            SeedsWord::Mean => SeedsStatistic::Mean,
        };
        Ok(SeedsRule { statistic, provenance: vec![provenance] })
    }

    fn must_choose<'e>(
        &self,
        what: &str,
        by: &'static str,
        words: impl Iterator<Item = &'e str>,
        first_fits_all: bool,
    ) -> Result<(), CodeError> {
        let mut known: Vec<&str> = Vec::new();
        words.for_each(|word| {
            if !known.contains(&word) {
                known.push(word);
            }
        });
        if first_fits_all || known.is_empty() {
            return Ok(());
        }
        Err(CodeError::Choose { code: self.name.clone(), what: what.to_string(), by, choices: known.join(", ") })
    }

    fn usable<W, T: Clone>(
        &self,
        entry: Option<&Entry<W, T>>,
        what: String,
        unconfirmed: bool,
    ) -> Result<(T, Provenance), CodeError> {
        let code = self.name.clone();
        let Some(entry) = entry else { return Err(CodeError::NoRule { code, what }) };
        let Some(value) = &entry.value else { return Err(CodeError::NotGiven { code, what }) };
        if !entry.provenance.is_confirmed() && !unconfirmed {
            return Err(CodeError::FromMemory { code, what });
        }
        Ok((value.clone(), entry.provenance.clone()))
    }

    /// What the code says, a line an entry.
    pub fn lines(&self) -> Vec<CodeLine> {
        let mut list = Vec::new();
        for e in &self.tension {
            let mut applies = format!("{}, {}", e.whom.analysis.word(), e.whom.condition.word());
            if let Some(class) = &e.whom.class {
                applies.push_str(&format!(", class {class}"));
            }
            if let Some(mooring) = e.whom.mooring {
                applies.push_str(&format!(", {}", mooring.word().to_lowercase()));
            }
            list.push(line("line tension", applies, e.value.map(|form| form.to_string()), &e.provenance));
        }
        for e in &self.strength {
            list.push(line(
                "strength",
                String::new(),
                e.value.map(|share| format!("S_C = {share} MBL")),
                &e.provenance,
            ));
        }
        for e in &self.anchor {
            let whom = &e.whom;
            let words = [Some(whom.kind.word()), Some(whom.direction.word()), Some(whom.condition.word())];
            let more = [whom.analysis.map(Analysis::word), whom.mooring.map(Mooring::word)];
            let applies: Vec<&str> = words.into_iter().chain(more).flatten().collect();
            list.push(line(
                "anchor",
                applies.join(", ").to_lowercase(),
                e.value.map(|factor| format!("R / F >= {factor}")),
                &e.provenance,
            ));
        }
        for e in &self.fatigue {
            let value = e.value.map(|(factor, rise)| match rise {
                Some(r) => format!("life >= {factor} design lives, up to {} beside a line as damaged", factor + r.rise),
                None => format!("life >= {factor} design lives"),
            });
            list.push(line("fatigue life", String::new(), value, &e.provenance));
        }
        for e in &self.mean_plus {
            let applies = format!("{}, {} seeds or more", e.whom.0.word(), e.whom.1);
            let value = e.value.map(|deviations| format!("T = mean of maxima + {deviations} s"));
            list.push(line("design tension", applies, value, &e.provenance));
        }
        for e in &self.seeds {
            let applies = format!("{}, several seeds", e.whom.map_or("any analysis", Analysis::word));
            let value = e.value.map(|word| match word {
                SeedsWord::Mpm => "T = most probable maximum".to_owned(),
                SeedsWord::Mean => "T = mean of maxima".to_owned(),
            });
            list.push(line("design tension", applies, value, &e.provenance));
        }
        list
    }
}

fn line(check: &'static str, applies: String, value: Option<String>, provenance: &Provenance) -> CodeLine {
    CodeLine { check, applies, value: value.unwrap_or_default(), provenance: provenance.clone() }
}

/// Whether an entry for one kind, or for all, fits what is chosen, or whatever where nothing is.
fn fits<T: PartialEq>(own: Option<T>, chosen: Option<T>) -> bool {
    match (own, chosen) {
        (Some(own), Some(chosen)) => own == chosen,
        _ => true,
    }
}

/// A text of codes being read.
struct Reader<'t> {
    text: &'t str,
    is_own: bool,
}

impl Reader<'_> {
    fn read(&self) -> Result<CodeLibrary, CodeFileError> {
        if self.text.len() > MAX_FILE_BYTES {
            return Err(self.error(0, format!("a file of codes has at most {MAX_FILE_BYTES} bytes")));
        }
        let file: File = toml::from_str(self.text)
            .map_err(|e| self.error(e.span().map_or(0, |span| span.start), e.message().trim().to_string()))?;
        let mut library = CodeLibrary::default();
        for raw in &file.code {
            let code = self.code(raw.get_ref())?;
            if library.codes.iter().any(|known| known.name.eq_ignore_ascii_case(&code.name)) {
                return Err(self.error(raw.get_ref().name.span().start, format!("a second code {}", code.name)));
            }
            library.codes.push(code);
        }
        Ok(library)
    }

    fn error(&self, at: usize, message: String) -> CodeFileError {
        let before = self.text.get(..at).unwrap_or_default();
        let start = before.rfind('\n').map_or(0, |i| i + 1);
        let column = before.get(start..).unwrap_or_default().chars().count() + 1;
        CodeFileError { line: before.matches('\n').count() + 1, column, message }
    }

    fn code(&self, raw: &RawCode) -> Result<Code, CodeFileError> {
        let name = raw.name.get_ref();
        let sound = !name.is_empty() && name.len() <= 40 && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        if !sound {
            let message = "the name of a code is of letters, digits and _, 40 at most".to_string();
            return Err(self.error(raw.name.span().start, message));
        }
        let mut code = Code {
            name: name.to_ascii_uppercase(),
            title: raw.title.clone(),
            edition: raw.edition.clone(),
            note: raw.note.clone(),
            tension: Vec::new(),
            strength: Vec::new(),
            anchor: Vec::new(),
            fatigue: Vec::new(),
            mean_plus: Vec::new(),
            seeds: Vec::new(),
        };
        for entry in &raw.tension {
            code.tension.push(self.tension(entry)?);
        }
        for entry in &raw.strength {
            let (raw, at) = (entry.get_ref(), entry.span().start);
            let value = self.number("share", &raw.share, 1.0)?;
            code.strength.push(self.entry((), value, at, (&raw.clause, &raw.source, &raw.sure))?);
        }
        for entry in &raw.anchor {
            let (raw, at) = (entry.get_ref(), entry.span().start);
            let whom = AnchorWhom {
                kind: self.choice(&raw.kind)?,
                direction: self.choice(&raw.direction)?,
                condition: self.choice(&raw.condition)?,
                analysis: self.optional_choice(&raw.analysis)?,
                mooring: self.optional_choice(&raw.mooring)?,
            };
            let value = self.number("factor", &raw.factor, MAX_FACTOR)?;
            code.anchor.push(self.entry(whom, value, at, (&raw.clause, &raw.source, &raw.sure))?);
        }
        for entry in &raw.fatigue {
            code.fatigue.push(self.fatigue(entry)?);
        }
        for entry in &raw.mean_plus {
            let (raw, at) = (entry.get_ref(), entry.span().start);
            let seeds = *raw.seeds.get_ref();
            if seeds < 1 {
                return Err(self.error(raw.seeds.span().start, format!("seeds must be at least 1, not {seeds}")));
            }
            let value = match &raw.deviations {
                Some(given) if !(0.0..=MAX_FACTOR).contains(given.get_ref()) => {
                    let message = format!("deviations must be between 0 and {MAX_FACTOR}, not {}", given.get_ref());
                    return Err(self.error(given.span().start, message));
                }
                given => given.as_ref().map(|v| *v.get_ref()),
            };
            let whom = (self.choice(&raw.analysis)?, seeds);
            code.mean_plus.push(self.entry(whom, value, at, (&raw.clause, &raw.source, &raw.sure))?);
        }
        for entry in &raw.seeds {
            let (raw, at) = (entry.get_ref(), entry.span().start);
            let whom = self.optional_choice(&raw.analysis)?;
            let word = self.choice(&raw.statistic)?;
            code.seeds.push(self.entry(whom, Some(word), at, (&raw.clause, &raw.source, &raw.sure))?);
        }
        Ok(code)
    }

    fn tension(&self, entry: &Spanned<RawTension>) -> Result<Entry<TensionWhom, TensionForm>, CodeFileError> {
        let (raw, at) = (entry.get_ref(), entry.span().start);
        let whom = TensionWhom {
            analysis: self.choice(&raw.analysis)?,
            condition: self.choice(&raw.condition)?,
            class: raw.class.as_ref().map(|class| class.get_ref().clone()),
            mooring: self.optional_choice(&raw.mooring)?,
        };
        let all = [
            ("factor", &raw.factor),
            ("mean", &raw.mean),
            ("dynamic", &raw.dynamic),
            ("pretension", &raw.pretension),
            ("environment", &raw.environment),
        ];
        let form = raw.form.get_ref().as_str();
        let wanted: &[&str] = match form {
            "safety-factor" | "single-factor" => &["factor"],
            "partial-factors" => &["mean", "dynamic"],
            "pretension-factors" => &["pretension", "environment"],
            _ => {
                let message = format!(
                    "form is safety-factor, single-factor, partial-factors or pretension-factors, not `{form}`"
                );
                return Err(self.error(raw.form.span().start, message));
            }
        };
        let mut numbers = Vec::new();
        for (key, given) in all {
            let value = self.number(key, given, MAX_FACTOR)?;
            match (value, given, wanted.contains(&key)) {
                (Some(_), Some(given), false) => {
                    let message =
                        format!("`{key}` does not belong to a {form} check: it takes {}", wanted.join(" and "));
                    return Err(self.error(given.span().start, message));
                }
                (Some(value), _, true) => numbers.push(value),
                _ => {}
            }
        }
        let value = match (form, numbers.as_slice()) {
            (_, []) => None,
            ("safety-factor", [factor]) => Some(TensionForm::SafetyFactor(*factor)),
            ("single-factor", [factor]) => Some(TensionForm::SingleFactor(*factor)),
            ("partial-factors", [mean, dynamic]) => {
                Some(TensionForm::PartialFactors { mean: *mean, dynamic: *dynamic })
            }
            ("pretension-factors", [pretension, environment]) => {
                Some(TensionForm::PretensionFactors { pretension: *pretension, environment: *environment })
            }
            _ => return Err(self.error(at, format!("a {form} check needs {}", wanted.join(" and ")))),
        };
        self.entry(whom, value, at, (&raw.clause, &raw.source, &raw.sure))
    }

    fn fatigue(&self, entry: &Spanned<RawFatigue>) -> Result<Entry<(), (f64, Option<NeighbourRise>)>, CodeFileError> {
        let (raw, at) = (entry.get_ref(), entry.span().start);
        let factor = self.number("factor", &raw.factor, MAX_LIFE_FACTOR)?;
        let rise = match (&raw.neighbour_from, &raw.neighbour_rise) {
            (None, None) => None,
            (Some(from), Some(rise)) => {
                let (from_value, rise_value) = (*from.get_ref(), *rise.get_ref());
                if !(0.0..1.0).contains(&from_value) {
                    let message = format!("neighbour_from must be at least 0 and below 1, not {from_value}");
                    return Err(self.error(from.span().start, message));
                }
                if !(0.0..=MAX_LIFE_FACTOR).contains(&rise_value) {
                    let message = format!("neighbour_rise must be between 0 and {MAX_LIFE_FACTOR}, not {rise_value}");
                    return Err(self.error(rise.span().start, message));
                }
                Some(NeighbourRise { from: from_value, rise: rise_value })
            }
            _ => return Err(self.error(at, "neighbour_from and neighbour_rise go together".into())),
        };
        self.entry((), factor.map(|factor| (factor, rise)), at, (&raw.clause, &raw.source, &raw.sure))
    }

    fn entry<W, T>(
        &self,
        whom: W,
        value: Option<T>,
        at: usize,
        (clause, source, sure): (&str, &str, &Option<Spanned<String>>),
    ) -> Result<Entry<W, T>, CodeFileError> {
        let said: Option<Sureness> = self.optional_choice(sure)?;
        let sure_at = sure.as_ref().map_or(at, |word| word.span().start);
        let sure = match (said, &value) {
            (Some(Sureness::NotGiven), Some(_)) => {
                return Err(self.error(sure_at, "an entry that is `not given` has no numbers".into()));
            }
            (Some(Sureness::NotGiven) | None, None) if !self.is_own => Sureness::NotGiven,
            (_, None) => return Err(self.error(at, "the entry has no number".into())),
            (Some(said), _) => said,
            (None, _) if self.is_own => Sureness::Confirmed,
            (None, _) => return Err(self.error(at, "the entry does not say how sure it is".into())),
        };
        let provenance =
            Provenance { clause: clause.to_string(), source: source.to_string(), sure, is_own: self.is_own };
        Ok(Entry { whom, value, provenance })
    }

    fn number(&self, key: &'static str, given: &Option<Spanned<f64>>, most: f64) -> Result<Option<f64>, CodeFileError> {
        let Some(given) = given else { return Ok(None) };
        let value = *given.get_ref();
        if above_zero(key, value).is_err() || value > most {
            return Err(
                self.error(given.span().start, format!("{key} must be greater than 0 and at most {most}, not {value}"))
            );
        }
        Ok(Some(value))
    }

    fn choice<T: Choice>(&self, word: &Spanned<String>) -> Result<T, CodeFileError> {
        let found = T::ALL.iter().copied().find(|choice| choice.word().eq_ignore_ascii_case(word.get_ref()));
        found.ok_or_else(|| {
            let known = T::WORDS.join(", ").to_lowercase();
            self.error(word.span().start, format!("expected one of {known}, not `{}`", word.get_ref()))
        })
    }

    fn optional_choice<T: Choice>(&self, word: &Option<Spanned<String>>) -> Result<Option<T>, CodeFileError> {
        word.as_ref().map(|word| self.choice(word)).transpose()
    }
}

/// Largest safety factor or partial factor that a file may give: above is a slip of the pen.
const MAX_FACTOR: f64 = 100.0;
/// Largest factor on fatigue life.
const MAX_LIFE_FACTOR: f64 = 1000.0;

#[cfg(test)]
mod tests {
    use super::*;

    const OWN: &str = r#"
[[code]]
name = "COMPANY"
title = "Company practice"
edition = "2024"

[[code.tension]]
form = "partial-factors"
analysis = "dynamic"
condition = "intact"
class = "A"
mean = 1.2
dynamic = 1.6

[[code.tension]]
form = "safety-factor"
analysis = "dynamic"
condition = "damaged"
factor = 1.3
sure = "from memory"

[[code.anchor]]
kind = "drag"
direction = "lateral"
condition = "intact"
factor = 1.4

[[code.mean_plus]]
analysis = "dynamic"
seeds = 5
deviations = 0.6

[[code.mean_plus]]
analysis = "dynamic"
seeds = 10
deviations = 0.3
"#;

    fn own() -> CodeLibrary {
        CodeLibrary::parse_own(OWN).unwrap()
    }

    fn of_class(class: &str) -> CodeOptions {
        CodeOptions { class: Some(class.into()), ..CodeOptions::default() }
    }

    #[test]
    fn rule_is_chosen_by_analysis_condition_and_class() {
        let library = own();
        let code = library.find("company").unwrap();
        let rule = code.tension_rule(Analysis::Dynamic, Condition::Intact, &of_class("a")).unwrap();
        assert_eq!(rule.form, TensionForm::PartialFactors { mean: 1.2, dynamic: 1.6 });
        assert!(rule.is_confirmed() && rule.provenance.is_own);
        let refused = |analysis, condition, options: &CodeOptions| {
            code.tension_rule(analysis, condition, options).unwrap_err().to_string()
        };
        let none = CodeOptions::default();
        assert!(
            refused(Analysis::Dynamic, Condition::Intact, &none)
                .ends_with("by consequence class (-CLASS): choose one of A")
        );
        assert!(refused(Analysis::Dynamic, Condition::Intact, &of_class("B")).contains("class B"));
        assert!(
            refused(Analysis::QuasiStatic, Condition::Intact, &none)
                .contains("has no rule for line tension, quasi-static")
        );
        assert!(refused(Analysis::Dynamic, Condition::Damaged, &none).contains("are from memory"));
        let anyway = CodeOptions { unconfirmed: true, ..none };
        let rule = code.tension_rule(Analysis::Dynamic, Condition::Damaged, &anyway).unwrap();
        assert!(!rule.is_confirmed());
    }

    #[test]
    fn statistic_of_seeds_is_what_the_code_says_or_the_most_probable_maximum() {
        let library = own();
        let code = library.find("COMPANY").unwrap();
        let statistic = |code: &Code, analysis| code.seeds_rule(analysis, &CodeOptions::default()).map(|r| r.statistic);
        let steps = SeedsStatistic::MeanPlus(vec![(5, 0.6), (10, 0.3)]);
        assert_eq!(statistic(code, Analysis::Dynamic), Ok(steps));
        assert_eq!(statistic(code, Analysis::QuasiStatic), Ok(SeedsStatistic::MostProbable));
        let says = format!("{OWN}\n[[code.seeds]]\nstatistic = \"mean\"\nanalysis = \"quasi-static\"\n");
        let says = CodeLibrary::parse_own(&says).unwrap();
        let code = says.find("COMPANY").unwrap();
        assert_eq!(statistic(code, Analysis::QuasiStatic), Ok(SeedsStatistic::Mean));
        // one of the user's own in the place of deviations that ship without numbers
        let shipped = "[[code]]\nname = \"B\"\ntitle = \"b\"\nedition = \"1\"\n[[code.mean_plus]]\nanalysis = \"dynamic\"\n\
                       seeds = 5\nsure = \"not given\"\n";
        let shipped = CodeLibrary::parse_shipped(shipped).unwrap();
        assert!(
            statistic(shipped.find("B").unwrap(), Analysis::Dynamic)
                .unwrap_err()
                .to_string()
                .contains("not its numbers")
        );
        let own = "[[code]]\nname = \"B\"\ntitle = \"b\"\nedition = \"1\"\n[[code.seeds]]\nstatistic = \"mpm\"\n";
        let both = shipped.with_own(CodeLibrary::parse_own(own).unwrap());
        assert_eq!(statistic(both.find("B").unwrap(), Analysis::Dynamic), Ok(SeedsStatistic::MostProbable));
        assert!(
            library.find("COMPANYY").unwrap_err()
                == CodeError::NoCode { name: "COMPANYY".into(), near: vec!["COMPANY".into()] }
        );
    }

    #[test]
    fn faults_of_a_file_have_line_and_column() {
        let fault = |from: &str, to: &str| CodeLibrary::parse_own(&OWN.replacen(from, to, 1)).unwrap_err();
        for (from, to, line, column, says) in [
            ("mean = 1.2", "mean = -1.2", 12, 8, "mean must be greater than 0 and at most 100, not -1.2"),
            ("mean = 1.2\n", "", 7, 1, "needs mean and dynamic"),
            ("dynamic = 1.6", "factor = 1.6", 13, 10, "`factor` does not belong to a partial-factors check"),
            (
                "analysis = \"dynamic\"",
                "analysis = \"dynamik\"",
                9,
                12,
                "expected one of quasi-static, dynamic, not `dynamik`",
            ),
            ("factor = 1.3", "faktor = 1.3", 19, 1, "unknown field `faktor`"),
            ("form = \"safety-factor\"", "form = \"safety\"", 16, 8, "form is safety-factor"),
            ("factor = 1.3\n", "", 15, 1, "the entry has no number"),
            ("seeds = 5", "seeds = 0", 30, 9, "seeds must be at least 1, not 0"),
            ("name = \"COMPANY\"", "name = \"COMP ANY\"", 3, 8, "letters, digits and _"),
            ("factor = 1.4", "factor = nan", 26, 10, "factor must be greater than 0"),
        ] {
            let found = fault(from, to);
            assert!(found.message.contains(says), "{to}: {found}");
            assert_eq!((found.line, found.column), (line, column), "{to}: {found}");
        }
        assert!(CodeLibrary::parse_own("").is_err() && CodeLibrary::parse_own("code = 3").is_err());
        assert!(CodeLibrary::parse_own(&format!("{OWN}{OWN}")).unwrap_err().message.contains("a second code COMPANY"));
        // what ships says how sure it is
        assert!(CodeLibrary::parse_shipped(OWN).unwrap_err().message.contains("does not say how sure it is"));
    }

    #[test]
    fn own_entries_go_before_shipped_ones() {
        let shipped = "[[code]]\nname = \"COMPANY\"\ntitle = \"t\"\nedition = \"1\"\n[[code.tension]]\nform = \"safety-factor\"\n\
                       analysis = \"dynamic\"\ncondition = \"transient\"\nsure = \"not given\"\n[[code.anchor]]\nkind = \"drag\"\n\
                       direction = \"lateral\"\ncondition = \"intact\"\nfactor = 9.0\nsure = \"second hand\"\n";
        let shipped = CodeLibrary::parse_shipped(shipped).unwrap();
        let options = CodeOptions::default();
        let given = shipped.find("COMPANY").unwrap().tension_rule(Analysis::Dynamic, Condition::Transient, &options);
        assert!(given.unwrap_err().to_string().contains("not its numbers"));
        let both = shipped.with_own(own());
        let code = both.find("COMPANY").unwrap();
        let anchor = code
            .anchor_rule((AnchorKind::Drag, PullDirection::Lateral), (Analysis::Dynamic, Condition::Intact), &options)
            .unwrap();
        assert_eq!(anchor.factor, 1.4);
        assert!(code.lines().len() == 7 && code.lines()[0].provenance.is_own);
    }
}
