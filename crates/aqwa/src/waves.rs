//! Deck 13: a spectrum (SPEC), a regular wave (WAVE), or still water (NONE).
//!
//! Settings (NSPL, SPDN, SEED, ..) stand before the spectrum they are for and stay in force for the next. Directions are
//! those towards which the waves travel, in degrees. PHAS is a card of this program: it gives the phases of the spectral
//! lines, so that a sea whose listing prints them can be had again.
//!
//! Source: [AQWA-TETHER 8.1.13 and 8.2.13], the listings' card echoes (gamma stands before alpha on JONS; the prose of 8.1.13
//! has the names the other way round); [AQWA-REF deck 13].

use super::card::Field;
use super::layout::{CardLayout, CardRecord, Slot, int, num};
use super::remarks::Remarks;
use super::surroundings::UniformStream;
use std::f64::consts::PI;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;

/// Most spectra of a deck.
const MAX_SPECTRA: usize = 20;
/// Most spectral lines of a spectrum.
pub const MAX_SPECTRAL_LINES: i64 = 10_000;
/// Spectral lines when NSPL is not given (assumed; newer versions of AQWA have 200).
const USUAL_LINES: i64 = 50;

const START: Slot = num("first frequency", 21).not_below_zero();
const FINISH: Slot = num("last frequency", 31).not_below_zero();
const UNPUBLISHED_CARD_REASON: &str = "the columns of this card are published nowhere";

/// Cards that give a spectrum; settings stand before them.
const FORMS: &[&str] = &["PSMZ", "JONS", "JONH", "GAUS", "UDEF"];

/// Cards of deck 13 SPEC.
pub const SPECTRA: &[CardLayout] = &[
    CardLayout::new("HRTZ", &[]).freely(),
    CardLayout::new("RADS", &[]).freely(),
    CardLayout::new("SPGR", &[]).freely(),
    CardLayout::new("NSPL", &[int("number of spectral lines", 16)]).repeatable_after(FORMS),
    CardLayout::new("SPDN", &[int("spreading", 11), int("number of directions", 16), num("direction", 21)])
        .repeatable_after(FORMS),
    CardLayout::assume("SEED", &[int("seed of the phases", 11), int("seed of the phases", 16)]).repeatable_after(FORMS),
    CardLayout::new(
        "PHAS",
        &[
            int("first spectral line of this card", 16),
            num("phase 1 (deg)", 21),
            num("phase 2 (deg)", 31),
            num("phase 3 (deg)", 41),
            num("phase 4 (deg)", 51),
            num("phase 5 (deg)", 61),
            num("phase 6 (deg)", 71),
        ],
    )
    .freely(),
    CardLayout::new("PSMZ", &[START, FINISH, num("significant height", 41), num("zero crossing period", 51)]).freely(),
    CardLayout::new("JONS", &[START, FINISH, num("gamma", 41), num("alpha", 51), num("peak frequency", 61)]).freely(),
    CardLayout::new(
        "JONH",
        &[START, FINISH, num("gamma", 41), num("significant height", 51), num("peak frequency", 61)],
    )
    .freely(),
    CardLayout::new(
        "GAUS",
        &[START, FINISH, num("sigma (rad/s)", 41), num("significant height", 51), num("peak frequency", 61)],
    )
    .freely(),
    CardLayout::assume("UDEF", &[num("frequency", 21), num("ordinate", 31)]).freely(),
    CardLayout::new("CURR", &[num("speed", 21), num("direction", 31)]).repeatable_after(FORMS),
    CardLayout::new("WIND", &[num("speed", 21), num("direction", 31), num("reference height", 41)])
        .repeatable_after(FORMS),
    CardLayout::new("TOWS", &[num("towing speed", 31), num("towing direction", 41)]).repeatable_after(FORMS),
    CardLayout::refuse("OHBS", "the Ochi-Hubble spectrum is not read; give it as UDEF"),
    CardLayout::refuse("XSWL", "a second spectrum of swell is not read"),
    CardLayout::refuse("UDWS", "a wind spectrum is not read"),
    CardLayout::refuse("UDWD", "a wind spectrum is not read"),
    CardLayout::refuse("IWHT", "an imported wave history is not read"),
    CardLayout::pass_over("NAME", "the name of the spectrum has no effect"),
    CardLayout::refuse("NODR", UNPUBLISHED_CARD_REASON),
    CardLayout::refuse("GRAV", UNPUBLISHED_CARD_REASON),
];

/// Cards of deck 13 WAVE.
pub const REGULAR: &[CardLayout] = &[
    CardLayout::new("WAMP", &[num("wave amplitude", 21)]).one_of("amplitude", &[]),
    CardLayout::new("PERD", &[num("wave period", 21)]).one_of("period", &[]),
    CardLayout::new("WVDN", &[num("wave direction", 21)]),
    CardLayout::assume("HGHT", &[num("wave height", 21)]).one_of("amplitude", &[]),
    CardLayout::assume("FREQ", &[num("wave frequency (rad/s)", 21)]).one_of("period", &[]),
    CardLayout::assume("AIRY", &[]),
    CardLayout::assume("WRMP", &[num("time of the ramp", 21)]),
    CardLayout::assume("CURR", &[num("speed", 21), num("direction", 31)]),
    CardLayout::assume("WIND", &[num("speed", 21), num("direction", 31), num("reference height", 41)]),
];

/// The form of a spectrum; frequencies in rad/s.
#[derive(Clone, Debug, PartialEq)]
pub enum SpectrumForm {
    /// Pierson-Moskowitz of a significant height and a zero crossing period.
    PiersonMoskowitz {
        /// Significant height.
        height: f64,
        /// Mean zero crossing period (s).
        period: f64,
    },
    /// JONSWAP of gamma, alpha and the peak frequency.
    Jonswap {
        /// Peak enhancement.
        gamma: f64,
        /// Alpha of the high frequency end.
        alpha: f64,
        /// Peak frequency.
        peak: f64,
    },
    /// JONSWAP of gamma, significant height and the peak frequency.
    JonswapHeight {
        /// Peak enhancement.
        gamma: f64,
        /// Significant height.
        height: f64,
        /// Peak frequency.
        peak: f64,
    },
    /// Gaussian.
    Gaussian {
        /// Standard deviation (rad/s).
        sigma: f64,
        /// Significant height.
        height: f64,
        /// Peak frequency.
        peak: f64,
    },
    /// Frequencies and ordinates given one by one (ordinate a rad/s).
    Given(Vec<(f64, f64)>),
}

/// A spectrum with the settings in force at its card.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectrumCard {
    /// Its form.
    pub form: SpectrumForm,
    /// First and last frequency (rad/s); zero where left to the default.
    pub range: (f64, f64),
    /// Number of spectral lines.
    pub lines: i64,
    /// Whether NSPL gave it.
    pub lines_given: bool,
    /// Direction towards which the waves travel (degrees).
    pub direction: f64,
    /// Seed of the phases; 1 by default.
    pub seed: i64,
    /// Phases of the spectral lines (degrees), where given (PHAS).
    pub phases: Vec<f64>,
    /// Current of this spectrum.
    pub current: Option<UniformStream>,
    /// Wind of this spectrum.
    pub wind: Option<UniformStream>,
    /// Speed and direction of towing (TOWS), the direction in degrees within 30 of the tether.
    pub towing: Option<(f64, f64)>,
    /// The card.
    pub span: Span,
}

/// A regular wave.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct RegularWave {
    /// Amplitude.
    pub amplitude: f64,
    /// Period (s).
    pub period: f64,
    /// Direction towards which it travels (degrees).
    pub direction: f64,
    /// Whether the wave is linear (AIRY); else of second order in deep water.
    pub linear: bool,
    /// Time over which the wave grows (s); 0 for none.
    pub ramp: f64,
    /// Current.
    pub current: Option<UniformStream>,
    /// Wind.
    pub wind: Option<UniformStream>,
    /// The first card.
    pub span: Span,
}

/// Deck 13.
#[derive(Clone, Debug, PartialEq, Default)]
pub enum WaveDeck {
    /// No waves.
    #[default]
    Still,
    /// Irregular waves.
    Spectra(Vec<SpectrumCard>),
    /// A regular wave.
    Regular(RegularWave),
}

fn stream(record: &CardRecord) -> Option<UniformStream> {
    Some(UniformStream { speed: record.real(21), direction: record.real(31), span: record.span })
}

/// The spectra of the cards of deck 13 SPEC.
pub fn read_spectra(records: &[CardRecord], remarks: &mut Remarks) -> WaveDeck {
    let mut list: Vec<SpectrumCard> = Vec::new();
    let mut unit = 1.0;
    // the last setting that no spectrum has come after
    let mut idle: Option<&CardRecord> = None;
    let mut now = SpectrumCard {
        form: SpectrumForm::Given(Vec::new()),
        range: (0.0, 0.0),
        lines: USUAL_LINES,
        lines_given: false,
        direction: 0.0,
        seed: 1,
        phases: Vec::new(),
        current: None,
        wind: None,
        towing: None,
        span: records.first().map(|record| record.span).unwrap_or_default(),
    };
    for record in records {
        let third = |column: usize| record.real(column).value;
        idle = match record.keyword.as_str() {
            "HRTZ" | "RADS" | "SPGR" => idle,
            keyword if FORMS.contains(&keyword) => None,
            _ => Some(record),
        };
        let form = match record.keyword.as_str() {
            "HRTZ" | "RADS" => {
                unit = if record.keyword == "HRTZ" { 2.0 * PI } else { 1.0 };
                continue;
            }
            "NSPL" => {
                now.lines = lines(record.int(16), remarks);
                now.lines_given = record.int(16).value != 0;
                continue;
            }
            "SPDN" => {
                if let Some(spread) = [record.int(11), record.int(16)].into_iter().find(|field| field.value != 0) {
                    remarks.add(
                        Diagnostic::error(
                            "deck 13, SPDN, columns 11-20: directional spreading is not read",
                            spread.span,
                        )
                        .label("leave these columns blank"),
                    );
                }
                now.direction = third(21);
                continue;
            }
            "SEED" => {
                now.seed = record.int(11).value_or(record.int(16).value_or(1));
                continue;
            }
            "PHAS" => {
                phases(&mut now.phases, record, remarks);
                continue;
            }
            "CURR" | "WIND" => {
                let flow = stream(record);
                if record.keyword == "CURR" {
                    now.current = flow
                } else {
                    now.wind = flow
                }
                continue;
            }
            "TOWS" => {
                now.towing = towing(record, remarks);
                continue;
            }
            "PSMZ" => SpectrumForm::PiersonMoskowitz { height: third(41), period: third(51) },
            "JONS" => SpectrumForm::Jonswap { gamma: third(41), alpha: third(51), peak: unit * third(61) },
            "JONH" => SpectrumForm::JonswapHeight { gamma: third(41), height: third(51), peak: unit * third(61) },
            "GAUS" => SpectrumForm::Gaussian { sigma: third(41), height: third(51), peak: unit * third(61) },
            "UDEF" => {
                given_pair(&mut list, &now, record, unit, remarks);
                continue;
            }
            _ => continue,
        };
        let range = (unit * third(21), unit * third(31));
        if range.1 != 0.0 && range.0 >= range.1 {
            remarks.add(
                Diagnostic::error(
                    format!("deck 13, {}: the last frequency is not above the first", record.keyword),
                    record.real(31).span,
                )
                .label("last frequency, columns 31-40"),
            );
        }
        check_wave_card(record, remarks);
        if list.len() == MAX_SPECTRA {
            let message = format!("deck 13: a deck has at most {MAX_SPECTRA} spectra");
            remarks.add_once("many spectra", || Diagnostic::error(message, record.span));
            continue;
        }
        list.push(SpectrumCard { form, range, span: record.span, ..now.clone() });
    }
    if list.is_empty() {
        remarks.add(
            Diagnostic::error("deck 13 SPEC has no spectrum", now.span)
                .label("settings come before a PSMZ, JONS, JONH, GAUS or UDEF card")
                .help("still water is NONE in the place of SPEC"),
        );
    }
    if let (Some(setting), Some(last)) = (idle, list.last()) {
        let message = format!("deck 13, {}: no spectrum comes after this card", setting.keyword);
        remarks.add(
            Diagnostic::error(message, setting.span)
                .label("settings come before the spectrum they are for")
                .other(last.span, "the last spectrum"),
        );
    }
    WaveDeck::Spectra(list)
}

fn check_wave_card(record: &CardRecord, remarks: &mut Remarks) {
    let columns: &[usize] = if record.keyword == "PSMZ" { &[41, 51] } else { &[41, 51, 61] };
    for column in columns {
        let field = record.real(*column);
        if field.value <= 0.0 {
            let message =
                format!("deck 13, {}, columns {column}-{}: a value above 0 is wanted", record.keyword, column + 9);
            remarks.add(Diagnostic::error(message, field.span));
        }
    }
}

fn lines(field: Field<i64>, remarks: &mut Remarks) -> i64 {
    if (1..=MAX_SPECTRAL_LINES).contains(&field.value) {
        return field.value;
    }
    if field.given && field.value != 0 {
        remarks.add(
            Diagnostic::error(
                format!("deck 13, NSPL: {} is not a valid number of spectral lines", field.value),
                field.span,
            )
            .label(format!("1 to {MAX_SPECTRAL_LINES} belongs in columns 16-20")),
        );
    }
    USUAL_LINES
}

fn towing(record: &CardRecord, remarks: &mut Remarks) -> Option<(f64, f64)> {
    let (speed, direction) = (record.real(31), record.real(41));
    if direction.value.abs() > 30.0 {
        remarks.add(
            Diagnostic::error(
                "deck 13, TOWS, columns 41-50: the tow is within 30 degrees of the tether",
                direction.span,
            )
            .label("-30 to 30"),
        );
    }
    Some((speed.value, direction.value))
}

fn phases(list: &mut Vec<f64>, record: &CardRecord, remarks: &mut Remarks) {
    let first = record.int(16);
    let next = i64::try_from(list.len()).unwrap_or(i64::MAX).saturating_add(1);
    if first.value != next {
        remarks.add(
            Diagnostic::error(
                format!("deck 13, PHAS, columns 16-20: the next phase is that of line {next}"),
                first.span,
            )
            .label("phases are given line by line, six a card"),
        );
        return;
    }
    let given: Vec<f64> =
        record.reals::<6>(21).iter().take_while(|field| field.given).map(|field| field.value).collect();
    if next.saturating_add(6) > MAX_SPECTRAL_LINES {
        let message = format!("deck 13, PHAS: a spectrum has at most {MAX_SPECTRAL_LINES} lines");
        remarks.add_once("too many phases", || Diagnostic::error(message, record.span));
        return;
    }
    list.extend(given);
}

fn given_pair(list: &mut Vec<SpectrumCard>, now: &SpectrumCard, record: &CardRecord, unit: f64, remarks: &mut Remarks) {
    let (frequency, ordinate) = (unit * record.real(21).value, record.real(31).value / unit);
    if let Some(SpectrumCard { form: SpectrumForm::Given(pairs), range, .. }) = list.last_mut() {
        if frequency <= range.1 {
            remarks.add(
                Diagnostic::error("deck 13, UDEF, columns 21-30: frequencies ascend", record.real(21).span)
                    .label("a frequency above that of the card before"),
            );
            return;
        }
        pairs.push((frequency, ordinate));
        range.1 = frequency;
        return;
    }
    let form = SpectrumForm::Given(vec![(frequency, ordinate)]);
    list.push(SpectrumCard { form, range: (frequency, frequency), span: record.span, ..now.clone() });
}

/// The wave of the cards of deck 13 WAVE.
pub fn read_regular(records: &[CardRecord], remarks: &mut Remarks) -> WaveDeck {
    let span = records.first().map(|record| record.span).unwrap_or_default();
    let mut wave = RegularWave { span, ..RegularWave::default() };
    for record in records {
        let value = record.real(21).value;
        if !record.real(21).given && matches!(record.keyword.as_str(), "WAMP" | "HGHT") {
            let message = format!("deck 13, {}, columns 21-30: this field is blank", record.keyword);
            remarks.add(
                Diagnostic::error(message, record.real(21).span)
                    .label("the size of the wave belongs here")
                    .help("still water is NONE in the place of WAVE"),
            );
        }
        match record.keyword.as_str() {
            "WAMP" => wave.amplitude = value,
            "HGHT" => wave.amplitude = value / 2.0,
            "PERD" => wave.period = value,
            "FREQ" => wave.period = if value > 0.0 { 2.0 * PI / value } else { 0.0 },
            "WVDN" => wave.direction = value,
            "AIRY" => wave.linear = true,
            "WRMP" => wave.ramp = value,
            "CURR" => wave.current = stream(record),
            _ => wave.wind = stream(record),
        }
    }
    if !(wave.period > 0.0 && wave.period.is_finite()) || wave.amplitude < 0.0 {
        remarks.add(
            Diagnostic::error("deck 13 WAVE has no wave", span)
                .label("an amplitude (WAMP) and a period (PERD) above 0 are wanted")
                .help("still water is NONE in the place of WAVE"),
        );
    }
    WaveDeck::Regular(wave)
}
