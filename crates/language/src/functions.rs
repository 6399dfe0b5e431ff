//! String functions that need no model: `&NUMBER`, `&FORMAT`, `&STRING`, `&TOKEN`, `&LOGICAL`, `&V_EXIST`.
//!
//! Source: [MOSES-REF lang_sfun, lang_number, lang_info]. Where that text leaves a choice, the reading is in `&HELP` of the function
//! ([`FUNCTION_HELP`]).

use super::logic;
use super::number;
use super::record::{Record, Word};
use super::select::{self, Owner};
use super::token::TokenKind;
use super::variables::Variables;
use windlass_base::choice::Choice;
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::units::eight_figures;
use windlass_base::wildcard::matches;

/// The functions answered here, without `&`.
pub const NAMES: &[&str] = &["NUMBER", "FORMAT", "STRING", "TOKEN", "LOGICAL", "V_EXIST"];

/// What `&HELP` says of each: name, form, meaning.
pub const FUNCTION_HELP: &[(&str, &str, &str)] = &[
    (
        "&NUMBER",
        "&NUMBER(TYPE a b ..)",
        "? | REAL | INTEGER (nearest) | SIN SIND COS COSD TAN TAND ACOS ASIN ATAN (D: degrees in) | ATAN2 x y | SQRT LN \
         EXP ABS | MIN MAX MEAN SORT | INTERPOLATE x x1 y1 x2 y2 .. | NORM | DOT v1 v2 | UNIT_VEC | CROSS v1 v2 | SCALE f \
         v | ADDV f v1 v2 (v1 + f v2) | 3PTS2Q p1 p2 p3 (origin, on x, in xy; rows are the local axes) | VECG2L q v | \
         VECL2G q v. Ours: ASIND ACOSD ATAND (degrees out) | ATAN2D x y | LOG10 | ROUND x [n] (to n decimals, 0 without; halves \
         away from zero) | FLOOR CEILING | MOD a b (remainder with the sign of a, as in Fortran) | SUM PRODUCT",
    ),
    (
        "&FORMAT",
        "&FORMAT(FMT text)",
        "Fw.d, Ew.d or Iw for a number; UPPER, LOWER, FIRST (capital first letters) or COMMA (commas between words, and `and` before the last)",
    ),
    (
        "&STRING",
        "&STRING(ACTION words ..)",
        "MATCH a b: .TRUE. when the two are equal up to the wild characters @ and / in either. The other actions are our reading: LENGTH text \
         (characters) | UPPER text | LOWER text | CONCAT a b .. (joined without blanks) | SUBSTRING i j text (characters i to j, from 1) | \
         POSITION part text (of its first character, 0 where it is not there) | REPLACE old new text. Blanks between words count as one; \
         quotes keep them",
    ),
    ("&TOKEN", "&TOKEN(n words ..)", "the n-th word; N gives their number, a:b a range, LAST the last"),
    ("&LOGICAL", "&LOGICAL(phrase)", ".TRUE. or .FALSE."),
    ("&V_EXIST", "&V_EXIST(VAR)", ".TRUE. when the variable exists"),
];

/// The value of a function; `None` when it is not one of [`NAMES`].
pub fn call(
    name: &str,
    arguments: &Record,
    words: &[Word],
    variables: &Variables,
    span: Span,
) -> Option<Outcome<String>> {
    Some(match name {
        "NUMBER" => number_function(words, span),
        "FORMAT" => format_function(arguments, words, span),
        "STRING" => string_function(words, span),
        "TOKEN" => token_function(words, span),
        "LOGICAL" => logic::evaluate(arguments.text(), span).map(|b| logic::word(b).to_string()),
        "V_EXIST" => match words {
            [one] => Ok(logic::word(variables.get(&one.text).is_some()).to_string()),
            _ => Err(Diagnostic::error("&V_EXIST takes one name", span)),
        },
        _ => return None,
    })
}

fn list(values: &[f64]) -> String {
    values.iter().map(|v| eight_figures(*v)).collect::<Vec<_>>().join(" ")
}

choices! {
    /// What `&NUMBER` makes of its numbers.
    enum NumberAction {
        IsNumber = "?",
        Real = "REAL",
        Integer = "INTEGER",
        Sin = "SIN",
        SinDegrees = "SIND",
        Cos = "COS",
        CosDegrees = "COSD",
        Tan = "TAN",
        TanDegrees = "TAND",
        Acos = "ACOS",
        Asin = "ASIN",
        Atan = "ATAN",
        AtanOfTwo = "ATAN2",
        Sqrt = "SQRT",
        Logarithm = "LN",
        Exponential = "EXP",
        Absolute = "ABS",
        Min = "MIN",
        Max = "MAX",
        Mean = "MEAN",
        Sort = "SORT",
        Interpolate = "INTERPOLATE",
        Norm = "NORM",
        Dot = "DOT",
        Unit = "UNIT_VEC",
        Cross = "CROSS",
        Scale = "SCALE",
        Add = "ADDV",
        AxesOfPoints = "3PTS2Q",
        ToLocal = "VECG2L",
        ToGlobal = "VECL2G",
        AsinDegrees = "ASIND",
        AcosDegrees = "ACOSD",
        AtanDegrees = "ATAND",
        AtanOfTwoDegrees = "ATAN2D",
        CommonLogarithm = "LOG10",
        Round = "ROUND",
        Floor = "FLOOR",
        Ceiling = "CEILING",
        Modulo = "MOD",
        Sum = "SUM",
        Product = "PRODUCT",
    }
}

impl NumberAction {
    /// Whose name it is: those of MOSES keep their abbreviations [MOSES-REF lang_number].
    fn owner(self) -> Owner {
        match self {
            NumberAction::AsinDegrees
            | NumberAction::AcosDegrees
            | NumberAction::AtanDegrees
            | NumberAction::AtanOfTwoDegrees
            | NumberAction::CommonLogarithm
            | NumberAction::Round
            | NumberAction::Floor
            | NumberAction::Ceiling
            | NumberAction::Modulo
            | NumberAction::Sum
            | NumberAction::Product => Owner::Ours,
            _ => Owner::Moses,
        }
    }
}

fn number_function(words: &[Word], span: Span) -> Outcome<String> {
    let Some((action, rest)) = words.split_first() else {
        return Err(
            Diagnostic::error("&NUMBER lacks its type", span).help(format!("known: {}", NumberAction::WORDS.join(" ")))
        );
    };
    let known = NumberAction::ALL.iter().map(|known| (known.word(), known.owner(), *known));
    let action = select::choose(&action.text, action.span, "type of &NUMBER", known)?;
    let name = action.word();
    if action == NumberAction::IsNumber {
        return Ok(logic::word(!rest.is_empty() && rest.iter().all(|w| number::evaluate(&w.text).is_ok())).to_string());
    }
    let mut x = Vec::with_capacity(rest.len());
    for word in rest {
        x.push(number::evaluate(&word.text).map_err(|e| {
            Diagnostic::error(format!("&NUMBER({name} ..) needs numbers"), word.span).label(e.to_string())
        })?);
    }
    let value = vector_action(action, &x).ok_or_else(|| {
        Diagnostic::error(format!("&NUMBER({name} ..) cannot be formed from these {} numbers", x.len()), span)
            .help(FUNCTION_HELP.first().map_or("", |h| h.2))
    })?;
    if let Some(bad) = value.iter().find(|v| !v.is_finite()) {
        return Err(Diagnostic::error(format!("&NUMBER({name} ..) has no finite result"), span).label(bad.to_string()));
    }
    Ok(if action == NumberAction::Integer {
        format!("{:.0}", value.first().copied().unwrap_or(0.0) + 0.0)
    } else {
        list(&value)
    })
}

/// The numbers an action makes of its arguments; `None` when their number does not fit.
fn vector_action(action: NumberAction, x: &[f64]) -> Option<Vec<f64>> {
    let one = |f: fn(f64) -> f64| match x {
        [a] => Some(vec![f(*a)]),
        _ => None,
    };
    let halves = || (x.len() >= 2 && x.len().is_multiple_of(2)).then(|| x.split_at(x.len() / 2));
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(p, q)| p * q).sum::<f64>();
    let some = (!x.is_empty()).then_some(x);
    match action {
        NumberAction::Real => one(|a| a),
        NumberAction::Integer => one(f64::round),
        NumberAction::Sin => one(f64::sin),
        NumberAction::SinDegrees => one(number::sine_of_degrees),
        NumberAction::Cos => one(f64::cos),
        NumberAction::CosDegrees => one(number::cosine_of_degrees),
        NumberAction::Tan => one(f64::tan),
        NumberAction::TanDegrees => one(number::tangent_of_degrees),
        NumberAction::Acos => one(f64::acos),
        NumberAction::Asin => one(f64::asin),
        NumberAction::Atan => one(f64::atan),
        NumberAction::Sqrt => one(f64::sqrt),
        NumberAction::Logarithm => one(f64::ln),
        NumberAction::Exponential => one(f64::exp),
        NumberAction::Absolute => one(f64::abs),
        NumberAction::AsinDegrees => one(|a| a.asin().to_degrees()),
        NumberAction::AcosDegrees => one(|a| a.acos().to_degrees()),
        NumberAction::AtanDegrees => one(|a| a.atan().to_degrees()),
        NumberAction::AtanOfTwoDegrees => match x {
            [across, up] => Some(vec![up.atan2(*across).to_degrees()]),
            _ => None,
        },
        NumberAction::CommonLogarithm => one(f64::log10),
        NumberAction::Round => match x {
            [a] => round_to_decimals(*a, 0.0).map(|a| vec![a]),
            [a, decimals] => round_to_decimals(*a, *decimals).map(|a| vec![a]),
            _ => None,
        },
        NumberAction::Floor => one(f64::floor),
        NumberAction::Ceiling => one(f64::ceil),
        NumberAction::Modulo => match x {
            [a, b] => Some(vec![a % b]),
            _ => None,
        },
        NumberAction::Sum => some.map(|v| vec![v.iter().sum()]),
        NumberAction::Product => some.map(|v| vec![v.iter().product()]),
        NumberAction::AtanOfTwo => match x {
            [across, up] => Some(vec![up.atan2(*across)]),
            _ => None,
        },
        NumberAction::Min => some.map(|v| vec![v.iter().copied().fold(f64::INFINITY, f64::min)]),
        NumberAction::Max => some.map(|v| vec![v.iter().copied().fold(f64::NEG_INFINITY, f64::max)]),
        NumberAction::Mean => some.map(|v| vec![v.iter().sum::<f64>() / v.len() as f64]),
        NumberAction::Sort => some.map(|v| {
            let mut sorted = v.to_vec();
            sorted.sort_by(f64::total_cmp);
            sorted
        }),
        NumberAction::Interpolate => interpolate(x).map(|v| vec![v]),
        NumberAction::Norm => some.map(|v| vec![dot(v, v).sqrt()]),
        NumberAction::Dot => halves().map(|(a, b)| vec![dot(a, b)]),
        NumberAction::Unit => some.map(|v| v.iter().map(|c| c / dot(v, v).sqrt()).collect()),
        NumberAction::Cross => match x {
            [a, b, c, d, e, f] => Some(cross([*a, *b, *c], [*d, *e, *f]).to_vec()),
            _ => None,
        },
        NumberAction::Scale => {
            x.split_first().filter(|(_, v)| !v.is_empty()).map(|(f, v)| v.iter().map(|c| f * c).collect())
        }
        NumberAction::Add => {
            let (factor, v) = x.split_first()?;
            let half = v.len() / 2;
            (half > 0 && v.len() == 2 * half)
                .then(|| v.iter().zip(v.iter().skip(half)).map(|(a, b)| a + factor * b).collect())
        }
        NumberAction::AxesOfPoints => rotation(x),
        NumberAction::ToLocal | NumberAction::ToGlobal => {
            let (q, v) = (x.len() == 12).then(|| x.split_at(9))?;
            let at = |i: usize| q.get(i).copied().unwrap_or(0.0);
            let element = |row: usize, column: usize| {
                if action == NumberAction::ToLocal { at(3 * row + column) } else { at(3 * column + row) }
            };
            Some((0..3).map(|r| v.iter().enumerate().map(|(c, value)| element(r, c) * value).sum()).collect())
        }
        NumberAction::IsNumber => None,
    }
}

/// A number to so many decimals, from -15 to 15, halves away from zero; `None` of another number of decimals.
fn round_to_decimals(value: f64, decimals: f64) -> Option<f64> {
    const MAX_DECIMALS: f64 = 15.0;
    let scale = 10f64.powi(decimals.abs() as i32);
    // of fifteen figures: 2.345 as written has its half, as a binary number it is a little less
    let nearest = |x: f64| format!("{x:.14e}").parse().unwrap_or(x).round();
    (decimals.fract() == 0.0 && decimals.abs() <= MAX_DECIMALS)
        .then(|| if decimals < 0.0 { nearest(value / scale) * scale } else { nearest(value * scale) / scale })
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Linear interpolation in pairs x1 y1 x2 y2 ..; the end values hold outside.
fn interpolate(x: &[f64]) -> Option<f64> {
    let (at, pairs) = x.split_first()?;
    if pairs.len() < 2 || !pairs.len().is_multiple_of(2) {
        return None;
    }
    let points: Vec<(f64, f64)> = pairs.chunks_exact(2).filter_map(|p| Some((*p.first()?, *p.get(1)?))).collect();
    if points.windows(2).any(|w| matches!(w, [a, b] if a.0 >= b.0)) {
        return None;
    }
    let after = points.partition_point(|p| p.0 <= *at);
    match (after.checked_sub(1).and_then(|i| points.get(i)), points.get(after)) {
        (Some(low), Some(high)) => Some(low.1 + (high.1 - low.1) * (at - low.0) / (high.0 - low.0)),
        (Some(end), None) | (None, Some(end)) => Some(end.1),
        (None, None) => None,
    }
}

/// The rotation whose rows are the axes of a frame given by its origin, a point on x and a point in the xy plane.
fn rotation(x: &[f64]) -> Option<Vec<f64>> {
    let [a, b, c, d, e, f, g, h, i] = x else { return None };
    let unit = |v: [f64; 3]| {
        let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
        (length > 0.0).then(|| v.map(|c| c / length))
    };
    let first = unit([d - a, e - b, f - c])?;
    let third = unit(cross(first, [g - a, h - b, i - c]))?;
    let second = cross(third, first);
    Some([first, second, third].concat())
}

fn format_function(arguments: &Record, words: &[Word], span: Span) -> Outcome<String> {
    let Some((format, rest)) = words.split_first() else {
        return Err(Diagnostic::error("&FORMAT lacks its format", span));
    };
    let text = arguments.rest().0;
    match format.text.to_ascii_uppercase().as_str() {
        "UPPER" => return Ok(text.to_uppercase()),
        "LOWER" => return Ok(text.to_lowercase()),
        "FIRST" => return Ok(rest.iter().map(|w| capital(&w.text)).collect::<Vec<_>>().join(" ")),
        "COMMA" => {
            let mut words: Vec<String> = rest.iter().map(|w| w.text.to_string()).collect();
            if let (true, Some(last)) = (words.len() > 1, words.last_mut()) {
                last.insert_str(0, "and ");
            }
            return Ok(words.join(", "));
        }
        _ => {}
    }
    let bad = || {
        Diagnostic::error(format!("unknown format `{}`", format.text), format.span)
            .label("expected Fw.d, Ew.d, Iw, UPPER, LOWER, FIRST or COMMA")
    };
    if format.text.len() > 8 {
        return Err(bad());
    }
    let letter = format.text.chars().next().unwrap_or(' ').to_ascii_uppercase();
    let sizes = format.text.get(1..).unwrap_or_default();
    let (width, decimals) = sizes.split_once('.').unwrap_or((sizes, "0"));
    let (Ok(width), Ok(decimals)) = (width.parse::<usize>(), decimals.parse::<usize>()) else { return Err(bad()) };
    if width > 256 || decimals > 64 || !"FEI".contains(letter) {
        return Err(bad());
    }
    let mut out = String::new();
    for word in rest {
        let value = number::evaluate(&word.text)
            .map_err(|e| Diagnostic::error("&FORMAT needs a number", word.span).label(e.to_string()))?;
        let shown = match letter {
            'F' => format!("{value:.decimals$}"),
            'I' => format!("{value:.0}"),
            _ => exponent(value, decimals),
        };
        let shown = if letter == 'F' && decimals == 0 { format!("{shown}.") } else { shown };
        // as Fortran: a number that does not fit fills its field with asterisks
        let shown = if shown.len() > width && width > 0 { "*".repeat(width) } else { shown };
        out.push_str(&format!("{shown:>width$}"));
    }
    Ok(out)
}

fn capital(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map_or(String::new(), |c| c.to_uppercase().collect::<String>() + &letters.as_str().to_lowercase())
}

/// A number as `1.234E+05`.
pub fn exponent(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$E}");
    match text.split_once('E') {
        Some((mantissa, power)) => match power.strip_prefix('-') {
            Some(digits) => format!("{mantissa}E-{digits:0>2}"),
            None => format!("{mantissa}E+{power:0>2}"),
        },
        None => text,
    }
}

choices! {
    /// What `&STRING` does with its words.
    enum StringAction {
        Match = "MATCH",
        Length = "LENGTH",
        Upper = "UPPER",
        Lower = "LOWER",
        Concatenate = "CONCAT",
        Substring = "SUBSTRING",
        Position = "POSITION",
        Replace = "REPLACE",
    }
}

fn string_function(words: &[Word], span: Span) -> Outcome<String> {
    let Some((action, rest)) = words.split_first() else {
        return Err(Diagnostic::error("&STRING lacks its action", span)
            .help(format!("known: {}", StringAction::WORDS.join(" "))));
    };
    let action: StringAction = select::choose_word(&action.text, action.span, "action of &STRING")?;
    let text = |from: usize| {
        rest.get(from..).unwrap_or_default().iter().map(|w| w.text.as_ref()).collect::<Vec<_>>().join(" ")
    };
    let lacks = |form: &str| Diagnostic::error(format!("&STRING has the form &STRING({} {form})", action.word()), span);
    Ok(match (action, rest) {
        (StringAction::Match, [a, b]) => {
            logic::word(matches(&a.text, &b.text) || matches(&b.text, &a.text)).to_string()
        }
        (StringAction::Match, _) => return Err(lacks("a b")),
        (StringAction::Length, _) => text(0).chars().count().to_string(),
        (StringAction::Upper, _) => text(0).to_uppercase(),
        (StringAction::Lower, _) => text(0).to_lowercase(),
        (StringAction::Concatenate, _) => rest.iter().map(|w| w.text.as_ref()).collect(),
        (StringAction::Substring, [first, last, _, ..]) => {
            let [first, last] = [character_number(first)?, character_number(last)?];
            text(2).chars().skip(first - 1).take((last + 1).saturating_sub(first)).collect()
        }
        (StringAction::Substring, _) => return Err(lacks("i j text")),
        (StringAction::Position, [part, _, ..]) => {
            let whole = text(1);
            let found = whole.find(part.text.as_ref()).and_then(|at| whole.get(..at));
            found.map_or(0, |before| before.chars().count() + 1).to_string()
        }
        (StringAction::Position, _) => return Err(lacks("part text")),
        (StringAction::Replace, [old, new, _, ..]) if !old.text.is_empty() => {
            text(2).replace(old.text.as_ref(), &new.text)
        }
        (StringAction::Replace, _) => return Err(lacks("old new text")),
    })
}

/// The number of a character, from 1.
fn character_number(word: &Word) -> Outcome<usize> {
    let number = number::evaluate(&word.text).ok().filter(|n| *n >= 1.0 && n.fract() == 0.0 && *n < 1e9);
    number.map(|n| n as usize).ok_or_else(|| {
        Diagnostic::error("&STRING(SUBSTRING ..) needs the numbers of two characters", word.span)
            .label("expected a whole number from 1")
    })
}

fn token_function(words: &[Word], span: Span) -> Outcome<String> {
    let Some((which, list)) = words.split_first() else {
        return Err(Diagnostic::error("&TOKEN lacks the number of the word", span));
    };
    let text = |w: &Word| if w.kind == TokenKind::Quoted { format!("'{}'", w.text) } else { w.text.to_string() };
    let index = |s: &str| number::evaluate(s).ok().filter(|v| *v >= 1.0 && v.fract() == 0.0).map(|v| v as usize);
    if which.text.eq_ignore_ascii_case("N") {
        return Ok(list.len().to_string());
    }
    if which.text.eq_ignore_ascii_case("LAST") {
        return Ok(list.last().map(text).unwrap_or_default());
    }
    let range = match which.text.split_once(':') {
        Some((from, to)) => index(from).zip(index(to)),
        None => index(&which.text).map(|n| (n, n)),
    };
    let Some((from, to)) = range else {
        return Err(Diagnostic::error("&TOKEN needs a word number", which.span).label("expected N, LAST, n or a:b"));
    };
    let count = (to + 1).saturating_sub(from);
    Ok(list.iter().skip(from - 1).take(count).map(text).collect::<Vec<_>>().join(" "))
}
