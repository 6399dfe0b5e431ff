//! Pages of HTML that hold their data: numbers as base64, text as JSON that no markup can end.

use minijinja::{Environment, Value};
use std::collections::BTreeMap;

/// The letters of base64 (RFC 4648, table 1).
const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Bytes as base64 (RFC 4648, section 4).
pub fn base64(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let of = |n: usize| u32::from(group.get(n).copied().unwrap_or(0));
        let whole = of(0) << 16 | of(1) << 8 | of(2);
        for n in 0..4 {
            let letter = LETTERS.get((whole >> (18 - 6 * n) & 63) as usize).copied().unwrap_or(b'=');
            text.push(if n <= group.len() { char::from(letter) } else { '=' });
        }
    }
    text
}

/// Numbers of 64 bits, little end first, as base64 in quotes.
pub fn doubles(values: impl IntoIterator<Item = f64>) -> String {
    quote_base64(values.into_iter().flat_map(f64::to_le_bytes))
}

/// Numbers of 32 bits, little end first, as base64 in quotes.
pub fn singles(values: impl IntoIterator<Item = f64>) -> String {
    quote_base64(values.into_iter().flat_map(|v| (v as f32).to_le_bytes()))
}

/// Whole numbers of 32 bits, little end first, as base64 in quotes.
pub fn wholes(values: impl IntoIterator<Item = u32>) -> String {
    quote_base64(values.into_iter().flat_map(u32::to_le_bytes))
}

/// Whole numbers of 16 bits, little end first, as base64 in quotes.
pub fn shorts(values: impl IntoIterator<Item = u16>) -> String {
    quote_base64(values.into_iter().flat_map(u16::to_le_bytes))
}

/// Bytes as base64 in quotes.
pub fn quote_base64(bytes: impl IntoIterator<Item = u8>) -> String {
    let bytes: Vec<u8> = bytes.into_iter().collect();
    format!("\"{}\"", base64(&bytes))
}

/// Text as a JSON string (RFC 8259, section 7). Letters that could end a script, and those that end a line of JavaScript, are
/// written by their number.
pub fn string(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 2);
    out.push('"');
    for letter in text.chars() {
        match letter {
            '"' | '\\' => out.extend(['\\', letter]),
            '<' | '>' | '&' | '\u{2028}' | '\u{2029}' | '\0'..='\u{1f}' | '\u{7f}' => {
                out.push_str(&format!("\\u{:04x}", u32::from(letter)));
            }
            other => out.push(other),
        }
    }
    out.push('"');
    out
}

/// A number as JSON; null of what is no number.
pub fn number(value: f64) -> String {
    // the shortest digits that read back to it
    if value.is_finite() { format!("{value:?}") } else { "null".into() }
}

/// A list of JSON values.
pub fn list(values: impl IntoIterator<Item = String>) -> String {
    format!("[{}]", values.into_iter().collect::<Vec<_>>().join(","))
}

/// An object of JSON values.
pub fn object<const N: usize>(pairs: [(&str, String); N]) -> String {
    let pairs: Vec<String> = pairs.into_iter().map(|(name, value)| format!("{}:{value}", string(name))).collect();
    format!("{{{}}}", pairs.join(","))
}

/// A page made of its parts, the first of which takes in the others, the title and the data by their names.
///
/// # Errors
/// What the template library reports.
pub fn page(parts: &[(&'static str, &'static str)], title: &str, data: String) -> Result<String, minijinja::Error> {
    let (mut env, mut values) = (Environment::new(), BTreeMap::new());
    for (name, text) in parts {
        // what stands in scripts and styles is ours, and the data have no letter that ends them
        values.insert(name.replace('.', "_"), Value::from_safe_string((*text).to_string()));
    }
    values.insert("title".into(), Value::from(title));
    values.insert("data".into(), Value::from_safe_string(data));
    let (name, text) = parts.first().copied().unwrap_or_default();
    env.add_template(name, text)?;
    env.get_template(name)?.render(values)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn base64_matches_standard() {
        // RFC 4648, section 10
        let pairs =
            [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foob", "Zm9vYg=="), ("foobar", "Zm9vYmFy")];
        assert!(pairs.iter().all(|(bytes, text)| base64(bytes.as_bytes()) == *text));
    }

    proptest! {
        #[test]
        fn embedded_text_and_numbers_read_back_and_end_no_script(text in "\\PC{0,20}|[<>&\"\\\\/\u{0}-\u{1f}\u{2028}]{0,9}", value in any::<f64>()) {
            let made = list([string(&text), number(value)]);
            prop_assert!(!made.contains(['<', '>', '&', '\n']));
            let read: serde_json::Value = serde_json::from_str(&made).unwrap();
            prop_assert_eq!(read[0].as_str().unwrap(), text);
            prop_assert_eq!(read[1].is_number(), value.is_finite());
            // the reader of serde_json rounds; that of the standard library and of a browser do not
            prop_assert!(!value.is_finite() || number(value).parse() == Ok(value));
        }
    }
}
