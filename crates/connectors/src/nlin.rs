//! NLIN: a straight weightless line whose tension is a law of its extension, as POLY and SWIR of AQWA decks give it.
//!
//! Source: [AQWA-REF POLY]: T = P1 e + P2 e2 + .. + P5 e5 of the extension e; [AQWA-REF SWIR]: a new steel wire rope,
//! T = k (e - d tanh(e/d)) with the asymptotic stiffness k and the asymptotic offset d. A line that is shorter than its unstretched length is slack.

use super::ClassKind;
use super::options::aqwa;
use super::taut_span::{SpanElement, SpanLaw, SpanTension, TautSpan, check_span_ends};
use std::sync::Arc;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec};
use windlass_model::{
    ClassError, ClassRecord, Connection, Connector, ConnectorClass, ConnectorElement, Note, Surroundings,
};

/// The class type.
pub static NLIN: ClassKind = ClassKind { spec: &SPEC, build, idle: &[] };

const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}

const POLY: OptionSpec = aqwa(
    "-POLY",
    &[
        number("P1", Dim::None, "coefficient of the extension (N/m)"),
        number("P2", Dim::None, "of its square (N/m2)").or("0"),
        number("P3", Dim::None, "of its cube (N/m3)").or("0"),
        number("P4", Dim::None, "of its fourth power (N/m4)").or("0"),
        number("P5", Dim::None, "of its fifth power (N/m5)").or("0"),
    ],
    "tension P1 e + P2 e2 + P3 e3 + P4 e4 + P5 e5 of the extension e",
);
const SWIRE: OptionSpec = aqwa(
    "-SWIRE",
    &[
        number("K", Dim::None, "asymptotic stiffness (N/m)").positive(),
        number("D", Dim::Metres, "asymptotic offset").positive(),
    ],
    "steel wire: tension K (e - D tanh(e/D)) of the extension e",
);

static SPEC: CommandSpec = CommandSpec {
    owner: Owner::Aqwa,
    data: &[number("L", Dim::Metres, "unstretched length").not_negative()],
    options: &[POLY, SWIRE],
    detail: "A straight weightless line between two points, in m and N in every unit system, with one of -POLY and -SWIRE. It is slack at \
             and below its unstretched length and never pushes: where a polynomial is negative the tension is zero, and a report warns.",
    example: "MEDIT\n*QUAY 0 0 8\n&DESCRIBE BODY SHIP\n*BITT 12 3 6\n~ROPE NLIN 10 -POLY 2E5 0 4E4\nCONNECTOR H1 ~ROPE *BITT *QUAY\nEND\n\
              &STATUS CLASS ~ROPE",
    ..CommandSpec::new("NLIN", "AQWA nonlinear line: polynomial or steel wire")
};

/// Tension over extension.
#[derive(Clone, Copy, Debug, PartialEq)]
enum ExtensionLaw {
    /// Coefficients of the powers 1 to 5 of the extension (N/m, N/m2, ..).
    Polynomial([f64; 5]),
    /// Asymptotic stiffness (N/m) and offset (m).
    SteelWire(f64, f64),
}

impl ExtensionLaw {
    /// Tension (N) and slope (N/m) at an extension (m).
    fn tension(&self, extension: f64) -> (f64, f64) {
        if extension <= 0.0 {
            return (0.0, 0.0);
        }
        match *self {
            ExtensionLaw::Polynomial(powers) => {
                let (mut value, mut slope) = (0.0, 0.0);
                for p in powers.iter().rev() {
                    slope = slope * extension + value;
                    value = value * extension + p;
                }
                // value is T/e, slope its derivative
                (value * extension, value + slope * extension)
            }
            ExtensionLaw::SteelWire(k, d) => {
                let bend = (extension / d).tanh();
                (k * (extension - d * bend), k * bend * bend)
            }
        }
    }
}

/// A line of a law.
#[derive(Clone, Copy, Debug)]
struct NonlinearLine {
    /// Unstretched length (m).
    length: f64,
    law: ExtensionLaw,
}

fn build(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    let Some(args) = records.last().map(|r| &r.args) else {
        return Err(Diagnostic::error("a class needs a record", windlass_base::span::Span::default()));
    };
    let length = args.number(const { SPEC.number("L") }).unwrap_or(0.0);
    let law = match (args.option(&POLY), args.option(&SWIRE)) {
        (Some(given), None) => {
            ExtensionLaw::Polynomial(given.numbers_or_zero(const { POLY.numbers(["P1", "P2", "P3", "P4", "P5"]) }))
        }
        (None, Some(given)) => {
            let [k, d] = given.numbers_or_zero(const { SWIRE.numbers(["K", "D"]) });
            ExtensionLaw::SteelWire(k, d)
        }
        (Some(poly), Some(wire)) => {
            return Err(Diagnostic::error("an NLIN has one law, and both -POLY and -SWIRE are given", wire.span)
                .other(poly.span, "the other one"));
        }
        (None, None) => {
            return Err(Diagnostic::error("an NLIN needs its law", args.span)
                .help("form: NLIN L -POLY P1 P2 P3 P4 P5 or NLIN L -SWIRE K D"));
        }
    };
    Ok(Arc::new(NonlinearLine { length, law }))
}

impl ConnectorClass for NonlinearLine {
    fn kind(&self) -> &'static str {
        "NLIN"
    }

    fn check_ends(&self, connector: &Connector, _: usize) -> Outcome<()> {
        check_span_ends("NLIN", "an NLIN takes 2 points; its anchor is a point of the ground", connector)
    }

    fn properties(&self, name: &str, _: &Surroundings) -> Table {
        let table = Table::new(format!("Class {name}")).fact("Type", "NLIN (AQWA, in m, N)", Dim::None).fact(
            "Unstretched Length",
            self.length,
            Dim::Metres,
        );
        match self.law {
            ExtensionLaw::Polynomial(powers) => {
                powers.iter().enumerate().fold(table, |table, (i, p)| table.fact(&format!("P{}", i + 1), *p, Dim::None))
            }
            ExtensionLaw::SteelWire(k, d) => {
                table.fact("Asymptotic Stiffness", k, Dim::None).fact("Asymptotic Offset", d, Dim::Metres)
            }
        }
    }

    fn element(&self, _: &Connection) -> Result<Box<dyn ConnectorElement>, ClassError> {
        Ok(Box::new(SpanElement(*self)))
    }
}

impl SpanLaw for NonlinearLine {
    fn tension_of(&self, span: &TautSpan) -> SpanTension {
        let (tension, slope) = self.law.tension(span.length - self.length);
        let by_length = if tension > 0.0 { slope } else { 0.0 };
        SpanTension { tension: tension.max(0.0), by_length, by_rate: 0.0 }
    }

    fn notes(&self, span: &TautSpan) -> Vec<Note> {
        let extension = span.length - self.length;
        if extension <= 0.0 {
            return vec!["the line is slack".into()];
        }
        if self.law.tension(extension).0 < 0.0 {
            let text = "its polynomial is negative at this extension; a line does not push: no tension";
            return vec![Note::warning(text)];
        }
        Vec::new()
    }
}
