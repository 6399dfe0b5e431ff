//! Messages with values: built in SI, printed in the user's units.

use crate::units::{Dim, UnitSystem};
use std::fmt::Display;

/// A sentence for the user whose values are numbers in SI with what they measure.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Message {
    parts: Vec<MessagePart>,
}

#[derive(Clone, Debug, PartialEq)]
enum MessagePart {
    Text(String),
    Value(f64, Dim),
}

impl Message {
    /// A sentence with values; `{}` in it is the place of each of them, in their order.
    pub fn with_values(sentence: impl AsRef<str>, values: &[(f64, Dim)]) -> Self {
        let sentence = sentence.as_ref();
        if values.is_empty() {
            return Message::from(sentence);
        }
        debug_assert_eq!(sentence.matches("{}").count(), values.len(), "places and values of `{sentence}`");
        let texts = sentence.splitn(values.len() + 1, "{}").map(|text| MessagePart::Text(text.to_string()));
        let mut values = values.iter().map(|(value, dim)| MessagePart::Value(*value, *dim));
        let parts = texts.flat_map(|text| [Some(text), values.next()]).flatten().collect();
        Message { parts }
    }

    /// The sentence in these units, each value with its unit; `digits` writes a number.
    pub fn text<T: Display>(&self, units: UnitSystem, digits: impl Fn(f64) -> T) -> String {
        let part = |part: &MessagePart| match part {
            MessagePart::Text(text) => text.clone(),
            MessagePart::Value(value, dim) => {
                format!("{} {}", digits(dim.from_si(*value, units)), dim.label(units)).trim_end().to_string()
            }
        };
        self.parts.iter().map(part).collect()
    }

    /// Its values in SI, in their order.
    pub fn values(&self) -> impl Iterator<Item = f64> {
        self.parts.iter().filter_map(|part| match part {
            MessagePart::Value(value, _) => Some(*value),
            MessagePart::Text(_) => None,
        })
    }

    /// The sentence without its values, for where no units are known: `..` in the place of each.
    pub fn without_values(&self) -> String {
        let part = |part: &MessagePart| match part {
            MessagePart::Text(text) => text.clone(),
            MessagePart::Value(..) => "..".to_string(),
        };
        self.parts.iter().map(part).collect()
    }

    /// The same sentence about a subject: `subject: sentence`.
    pub fn with_subject(self, subject: impl Into<Message>) -> Self {
        subject.into().then(": ").then(self)
    }

    /// The sentence with another behind it.
    pub fn then(mut self, more: impl Into<Message>) -> Self {
        self.parts.extend(more.into().parts);
        self
    }
}

impl From<String> for Message {
    fn from(text: String) -> Self {
        Message { parts: vec![MessagePart::Text(text)] }
    }
}

impl From<&str> for Message {
    fn from(text: &str) -> Self {
        text.to_string().into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::{ForceUnit, LengthUnit};

    #[test]
    fn message_values_are_in_user_units_and_name_braces_are_kept() {
        let units = UnitSystem { length: LengthUnit::Feet, force: ForceUnit::Kips };
        let message = Message::with_values("it is {} long, not {}", &[(3.048, Dim::Length), (2.0, Dim::None)])
            .with_subject("line {}");
        assert_eq!(message.text(units, |value| format!("{value:.1}")), "line {}: it is 10.0 ft long, not 2.0");
        assert_eq!(message.without_values(), "line {}: it is .. long, not ..");
    }
}
