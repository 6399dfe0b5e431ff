//! Macros: the picture in the header, and the variables a call makes.
//!
//! Source: [MOSES-REF lang_macros].

use crate::record::{Record, Word};
use crate::select::{self, Owner, SearchResult};
use crate::token::TokenKind;
use std::sync::Arc;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;

/// One argument and what it is when it is not given; without a default it must be given.
#[derive(Clone, Debug, PartialEq)]
struct Argument {
    name: String,
    default: Option<String>,
    /// It takes all words up to the next option: `NAME..` in the picture.
    takes_rest: bool,
}

impl Argument {
    /// The local that a word of a call makes; a field left out takes the default.
    fn argument_value(&self, word: &Word) -> (String, String) {
        match word.kind {
            TokenKind::Empty => self.default_value(),
            _ => (self.name.clone(), word.text.to_string()),
        }
    }

    /// The local that all words from a place up to the next option make, and how many they are.
    fn rest_value(&self, words: &[Word]) -> ((String, String), usize) {
        let own: Vec<&str> =
            words.iter().take_while(|w| w.kind != TokenKind::Option).map(|w| w.text.as_ref()).collect();
        ((self.name.clone(), own.join(" ")), own.len())
    }

    /// The local it makes where the call does not give it.
    fn default_value(&self) -> (String, String) {
        (self.name.clone(), self.default.clone().unwrap_or_default())
    }
}

/// An option of the picture: the variable that says whether it was given, and its values.
#[derive(Clone, Debug, PartialEq)]
struct MacroOption {
    name: String,
    flag: Option<String>,
    values: Vec<Argument>,
}

/// A macro as defined.
#[derive(Clone, Debug, PartialEq)]
pub struct Macro {
    /// Its name as written.
    pub name: String,
    /// Where it was defined.
    pub span: Span,
    arguments: Vec<Argument>,
    options: Vec<MacroOption>,
    /// Its records.
    pub body: Arc<[Record]>,
}

impl Macro {
    /// Reads the header `&MACRO NAME ...`.
    ///
    /// # Errors
    /// A missing name, or an `=` without a name before it.
    pub fn header(record: &Record) -> Outcome<Macro> {
        let words = record.words();
        let Some(name) = words.get(1) else {
            return Err(Diagnostic::error("&MACRO lacks its name", record.whole()));
        };
        let fit = matches!(name.kind, TokenKind::Word | TokenKind::Internal) && name.text.chars().count() <= 64;
        if !fit {
            return Err(Diagnostic::error(format!("`{}` cannot name a macro", name.text), name.span));
        }
        let mut made = Macro {
            name: name.text.to_string(),
            span: name.span,
            arguments: Vec::new(),
            options: Vec::new(),
            body: Arc::from([]),
        };
        let mut at = 2;
        while let Some(word) = words.get(at) {
            if word.kind == TokenKind::Option {
                made.options.push(MacroOption { name: word.text.to_string(), flag: None, values: Vec::new() });
                at += 1;
                continue;
            }
            if word.text.as_ref() == "=" {
                return Err(Diagnostic::error("an `=` in a macro header follows a name", word.span));
            }
            let has_default = words.get(at + 1).is_some_and(|w| w.text.as_ref() == "=");
            // nothing between the `=` and the next option is an empty default
            let given = words.get(at + 2).filter(|w| w.kind != TokenKind::Option);
            let default = has_default.then(|| given.map_or(String::new(), |w| w.text.to_string()));
            let (name, takes_rest) = match word.text.strip_suffix("..") {
                Some(name) if !name.is_empty() => (name.to_string(), true),
                _ => (word.text.to_string(), false),
            };
            let values = made.options.last().map_or(&made.arguments, |option| &option.values);
            if let Some(last) = values.last().filter(|last| last.takes_rest) {
                return Err(Diagnostic::error(
                    format!("{}.. takes all values: none can follow it", last.name),
                    word.span,
                ));
            }
            let argument = Argument { name, default, takes_rest };
            match made.options.last_mut() {
                Some(option) if option.flag.is_none() && !has_default && !takes_rest => {
                    option.flag = Some(argument.name)
                }
                Some(option) => option.values.push(argument),
                None => made.arguments.push(argument),
            }
            at += if has_default { 2 + usize::from(given.is_some()) } else { 1 };
        }
        Ok(made)
    }

    /// The macro with the records of its body.
    pub fn with_body(self, body: Arc<[Record]>) -> Macro {
        Macro { body, ..self }
    }

    /// The form of a call, for help and messages.
    pub fn syntax(&self) -> String {
        let mut text = self.name.clone();
        for argument in &self.arguments {
            text.push_str(&format!(" {}{}", argument.name, if argument.takes_rest { ".." } else { "" }));
        }
        for option in &self.options {
            text.push_str(&format!(" {}", option.name));
            for value in &option.values {
                text.push_str(&format!(" {}{}", value.name, if value.takes_rest { ".." } else { "" }));
            }
        }
        text
    }

    /// The locals a call makes: name and value. `words` are those behind the macro's name, `call` is that name.
    ///
    /// # Errors
    /// An unknown or ambiguous option, one given twice, a surplus argument, an argument or a value of an option without a default
    /// that is not given; none of them where the picture is a name alone.
    pub fn locals(&self, call: Span, words: &[Word], argv: &str) -> Outcome<Vec<(String, String)>> {
        let mut locals = vec![("ARGV".to_string(), argv.to_string())];
        if self.arguments.is_empty() && self.options.is_empty() {
            return Ok(locals);
        }
        for option in &self.options {
            if let Some(flag) = &option.flag {
                locals.push((flag.clone(), ".FALSE.".into()));
            }
            locals.extend(option.values.iter().map(Argument::default_value));
        }
        let mut seen: Vec<(&MacroOption, Span)> = Vec::new();
        let mut given = 0;
        let mut at = 0;
        while let Some(word) = words.get(at) {
            at += 1;
            if word.kind == TokenKind::Option {
                let option = self.option(word)?;
                if let Some((_, first)) = seen.iter().find(|(known, _)| *known == option) {
                    let text = format!("{} of macro {} is given twice", option.name, self.name);
                    return Err(Diagnostic::error(text, word.span).other(*first, "first given here"));
                }
                seen.push((option, word.span));
                if let Some(flag) = &option.flag {
                    locals.push((flag.clone(), ".TRUE.".into()));
                }
                for value in &option.values {
                    let next = words.get(at..).unwrap_or_default();
                    if value.takes_rest && next.first().is_some_and(|w| w.kind != TokenKind::Option) {
                        let (local, count) = value.rest_value(next);
                        locals.push(local);
                        at += count;
                        continue;
                    }
                    match words.get(at).filter(|w| w.kind != TokenKind::Option) {
                        Some(word) => {
                            locals.push(value.argument_value(word));
                            at += 1;
                        }
                        None if value.default.is_some() => {}
                        None => return Err(self.lacks(&format!("{} of {}", value.name, option.name), word.span)),
                    }
                }
                continue;
            }
            let Some(argument) = self.arguments.get(given) else {
                return Err(Diagnostic::error(format!("macro {} takes no further argument", self.name), word.span)
                    .help(format!("form: {}", self.syntax())));
            };
            given += 1;
            if argument.takes_rest {
                let (local, count) = argument.rest_value(words.get(at - 1..).unwrap_or_default());
                locals.push(local);
                at += count.max(1) - 1;
                continue;
            }
            locals.push(argument.argument_value(word));
        }
        let rest = self.arguments.get(given..).unwrap_or_default();
        if let Some(missing) = rest.iter().find(|argument| argument.default.is_none()) {
            return Err(self.lacks(&missing.name, call));
        }
        locals.extend(rest.iter().map(Argument::default_value));
        Ok(locals)
    }

    /// The error of a call that leaves out a value without a default.
    fn lacks(&self, what: &str, span: Span) -> Box<Diagnostic> {
        Diagnostic::error(format!("macro {} lacks {what}", self.name), span)
            .help(format!("form: {}; two commas in a row give an empty value", self.syntax()))
    }

    fn option(&self, word: &Word) -> Outcome<&MacroOption> {
        let begins =
            |o: &&MacroOption| o.name.get(..word.text.len()).is_some_and(|head| head.eq_ignore_ascii_case(&word.text));
        if let Some(option) = self.options.iter().find(|o| o.name.eq_ignore_ascii_case(&word.text)) {
            return Ok(option);
        }
        let hits: Vec<&MacroOption> = self.options.iter().filter(begins).collect();
        match hits.as_slice() {
            [one] => Ok(one),
            _ => Err(Diagnostic::error(
                format!("unknown or ambiguous option {} of macro {}", word.text, self.name),
                word.span,
            )
            .help(format!("form: {}", self.syntax()))),
        }
    }
}

/// Chooses among macros by the rule of keywords: exact, else a unique prefix.
pub fn find<'a>(word: &str, macros: impl Iterator<Item = &'a Arc<Macro>>) -> Option<(bool, &'a Arc<Macro>)> {
    let mut prefix = Vec::new();
    for one in macros {
        if one.name.eq_ignore_ascii_case(word) {
            return Some((true, one));
        }
        if one.name.get(..word.len()).is_some_and(|head| head.eq_ignore_ascii_case(word)) {
            prefix.push(one);
        }
    }
    match prefix.as_slice() {
        [one] => Some((false, *one)),
        _ => None,
    }
}

/// The control word a record begins with, if it does (abbreviations allowed as among all `internal` names).
pub fn control_word(word: &str, internal: &[(&'static str, Owner)]) -> Option<&'static str> {
    if !word.starts_with('&') {
        return None;
    }
    match select::keyword(word, internal.iter().map(|(name, owner)| (*name, *owner, *name))) {
        SearchResult::One(name) => Some(name),
        _ => None,
    }
}
