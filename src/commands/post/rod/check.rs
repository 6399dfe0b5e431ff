//! `CHECK` of ROD: the largest utilisation of each node, and when.

use super::{RodQuery, RodReport, plain};
use crate::commands::post::report::Tables;
use windlass_base::choice::Choice;
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::units::Dim;
use windlass_base::values::Args;
use windlass_language::spec::{Kind, OptionSpec, ValueSpec};
use windlass_signal::line::lrfd::{LrfdFactors, SafetyClass};
use windlass_signal::line::working_stress::DesignCase;
use windlass_solve::results::along::{self, Code};

/// CHECK.
pub(super) static CHECK: RodReport =
    RodReport::new("CHECK", "the largest utilisation of each node and when, by -CODE", tables).with_options(&[
        CODE,
        SAFETY_OPTION,
        FACTORS,
        PIPE,
        CASE,
        CORROSION,
    ]);

choices! {
    /// What CHECK checks tubes by.
    #[derive(Default)]
    enum CheckCode {
        /// DNV-ST-F201.
        #[default]
        F201 = "F201",
        /// API RP 2RD.
        Api2rd = "2RD",
        /// Tension over breaking tension.
        Break = "BREAK",
    }
}

const CODE: OptionSpec = OptionSpec::ours(
    "-CODE",
    &[ValueSpec::choice::<CheckCode>("C", "F201: DNV-ST-F201, 2RD: API RP 2RD, BREAK: tension over break")],
    "what CHECK checks tubes by; other sections go by tension over break",
)
.default("F201");
const SAFETY_OPTION: OptionSpec =
    OptionSpec::ours("-SAFETY", &[ValueSpec::choice::<SafetyClass>("C", "safety class")], "safety class of F201")
        .default("NORMAL");
const FACTORS: OptionSpec = OptionSpec::ours(
    "-FACTORS",
    &[
        plain("GF", "gamma_F, on what acts at rest").positive(),
        plain("GE", "gamma_E, on what the environment adds").or("1.3").positive(),
        plain("GM", "gamma_m, on resistance").or("1.15").positive(),
    ],
    "factors of F201; a load that relieves takes the inverse",
)
.default("1.1 1.3 1.15");
const PIPE: OptionSpec = OptionSpec::ours(
    "-PIPE",
    &[
        plain("F0", "ovality, at least 0.005").in_range(0.0, 0.1),
        plain("AFAB", "fabrication factor: 1 seamless, 0.925 UO, 0.85 UOE").or("1").in_range(0.1, 1.0),
    ],
    "how round the tubes of F201 are and how they were made",
)
.default("0.005 1");
const CASE: OptionSpec = OptionSpec::ours(
    "-CASE",
    &[ValueSpec::choice::<DesignCase>("C", "design case")],
    "design case of 2RD: 1, 1.2 or 1.5",
)
.default("OPERATING");
const CORROSION: OptionSpec = OptionSpec::ours(
    "-CORROSION",
    &[ValueSpec::new("T", Kind::Number(Dim::Section), "of the wall").not_negative()],
    "what CHECK takes from the walls",
)
.default("0");

fn tables(query: &RodQuery) -> Tables {
    refuse_options_of_other_codes(query.args())?;
    query.to_tables(along::check(&query.line, &code(query.args()), &query.events_after_transient()?))
}

/// Refuses an option that belongs to another code.
fn refuse_options_of_other_codes(args: &Args) -> Outcome<()> {
    let code = chosen_code(args);
    const BY: [(OptionSpec, &[CheckCode]); 5] = [
        (SAFETY_OPTION, &[CheckCode::F201]),
        (FACTORS, &[CheckCode::F201]),
        (PIPE, &[CheckCode::F201]),
        (CASE, &[CheckCode::Api2rd]),
        (CORROSION, &[CheckCode::F201, CheckCode::Api2rd]),
    ];
    for (option, codes) in BY {
        if let Some(given) = args.option(&option).filter(|_| !codes.contains(&code)) {
            let codes: Vec<&str> = codes.iter().map(|code| code.word()).collect();
            let text = format!("{} goes with -CODE {}, not with {}", option.name, codes.join(" and "), code.word());
            return Err(Diagnostic::error(text, given.span));
        }
    }
    Ok(())
}

/// The code that CHECK goes by.
fn chosen_code(args: &Args) -> CheckCode {
    args.option_choice(&CODE, const { CODE.choice("C") }).unwrap_or_default()
}

/// What CHECK checks by.
fn code(args: &Args) -> Code {
    let corroded = args.option_number(&CORROSION).unwrap_or(0.0);
    let number = |option: &OptionSpec, key| args.option(option).and_then(|given| given.number(key));
    match chosen_code(args) {
        CheckCode::Api2rd => {
            let case = args.option_choice(&CASE, const { CASE.choice("C") });
            Code::WorkingStress(case.unwrap_or(DesignCase::Operating), corroded)
        }
        CheckCode::Break => Code::Break,
        CheckCode::F201 => {
            let usual = LrfdFactors::default();
            let class = args.option_choice(&SAFETY_OPTION, const { SAFETY_OPTION.choice("C") });
            let class = class.unwrap_or(SafetyClass::Normal);
            let factors = LrfdFactors {
                class,
                functional: number(&FACTORS, const { FACTORS.number("GF") }).unwrap_or(usual.functional),
                environmental: number(&FACTORS, const { FACTORS.number("GE") }).unwrap_or(usual.environmental),
                material: number(&FACTORS, const { FACTORS.number("GM") }).unwrap_or(usual.material),
                ovality: number(&PIPE, const { PIPE.number("F0") }).unwrap_or(usual.ovality),
                fabrication: number(&PIPE, const { PIPE.number("AFAB") }).unwrap_or(usual.fabrication),
            };
            Code::Lrfd(factors, corroded)
        }
    }
}
