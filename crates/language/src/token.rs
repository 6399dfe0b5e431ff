//! The one lexer: scripts, completion and the editor's colours all read words through it.
//!
//! Source: [MOSES-REF ams_cmd_menu]. A comma or any run of blanks separates; two commas in a row leave an empty
//! field; `$` where a word could start begins a comment; a lone `\` at the end continues the record; a `-` starts an
//! option only when a letter follows. A word that holds blanks or commas is put in quotes.

use logos::Logos;
use std::ops::Range;

/// What a token is, found from its first characters alone.
#[derive(Logos, Clone, Copy, Debug, PartialEq, Eq)]
pub enum TokenKind {
    /// A run of blanks.
    #[regex(r"[ \t\r\n\u{b}\u{c}]+")]
    Blank,
    /// A separating comma.
    #[token(",")]
    Comma,
    /// `$` and all that follows.
    #[regex(r"\$[^\n]*", allow_greedy = true, priority = 20)]
    Comment,
    /// `\` alone.
    #[token("\\", priority = 20)]
    Continuation,
    /// A quoted word; the quotes are not part of its text.
    #[regex(r#""[^"\n]*""#, priority = 20)]
    #[regex(r"'[^'\n]*'", priority = 20)]
    Quoted,
    /// `&WORD`: an internal command or a string function.
    #[regex(r"&[^\s,]*", priority = 10)]
    Internal,
    /// `~NAME`: a class.
    #[regex(r"~[^\s,]*", priority = 10)]
    Class,
    /// `*NAME`: a point.
    #[regex(r"\*[^\s,]*", priority = 10)]
    Point,
    /// `:NAME`: a selector.
    #[regex(r":[^\s,]*", priority = 10)]
    Selector,
    /// `#NAME`: a load attribute.
    #[regex(r"#[^\s,]*", priority = 10)]
    Load,
    /// `%NAME`: a variable not yet replaced.
    #[regex(r"%[^\s,]*", priority = 10)]
    Variable,
    /// `-NAME`: an option.
    #[regex(r"-[A-Za-z][^\s,]*", priority = 10)]
    Option,
    /// Something that can only be a number or an expression.
    #[regex(r"[-+]*[(]*[-+]*[0-9.][^\s,]*", priority = 9)]
    Number,
    /// Any other word.
    #[regex(r"[^\s,]+", priority = 1)]
    Word,
    /// An empty field between two commas; made by [`words`], never by the lexer.
    Empty,
}

/// A token: its kind and the byte range it has in the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Token {
    /// What it is.
    pub kind: TokenKind,
    /// Where it is.
    pub range: Range<usize>,
}

/// All tokens of a text, blanks and comments included, in order and without gaps that matter.
pub fn tokens(text: &str) -> Vec<Token> {
    TokenKind::lexer(text)
        .spanned()
        .map(|(kind, range)| Token { kind: kind.unwrap_or(TokenKind::Word), range })
        .collect()
}

/// The words of a record: no blanks, commas or comments; an [`TokenKind::Empty`] for each field left out between commas.
/// The range of a quoted word is what stands inside the quotes.
pub fn words(text: &str) -> Vec<Token> {
    let mut list = Vec::with_capacity(8);
    let mut comma_open = false;
    for (kind, range) in TokenKind::lexer(text).spanned() {
        match kind.unwrap_or(TokenKind::Word) {
            TokenKind::Blank | TokenKind::Continuation => {}
            TokenKind::Comment => break,
            TokenKind::Comma => {
                if comma_open || list.is_empty() {
                    list.push(Token { kind: TokenKind::Empty, range: range.start..range.start });
                }
                comma_open = true;
            }
            TokenKind::Quoted => {
                comma_open = false;
                list.push(Token { kind: TokenKind::Quoted, range: range.start + 1..range.end - 1 });
            }
            kind => {
                comma_open = false;
                list.push(Token { kind, range });
            }
        }
    }
    list
}

/// Where a physical line's record text ends (a comment or a continuation mark begins), and whether it goes on in the
/// next line.
pub fn line_end(line: &str) -> (usize, bool) {
    if !line.contains(['$', '\\']) {
        return (line.len(), false);
    }
    let mut mark = None;
    for (kind, range) in TokenKind::lexer(line).spanned() {
        match kind.unwrap_or(TokenKind::Word) {
            TokenKind::Comment => return (mark.unwrap_or(range.start), mark.is_some()),
            TokenKind::Continuation => mark = Some(range.start),
            TokenKind::Blank => {}
            _ => mark = None,
        }
    }
    (mark.unwrap_or(line.len()), mark.is_some())
}

/// Whether the record of a physical line goes on in the next one; `inside`: the line itself continues a record, where a
/// line of comment is passed over.
pub fn is_continued(line: &str, inside: bool) -> bool {
    (inside && line.trim_start().starts_with('$')) || line_end(line).1
}

/// Whether a word can only be read as a number or an arithmetic expression, as opposed to a name.
pub fn is_numeric(kind: TokenKind, text: &str) -> bool {
    match kind {
        TokenKind::Number => true,
        TokenKind::Word => {
            // `SQRT(2)*3`: a name directly followed by a parenthesis
            text.starts_with(['+', '-', '(']) || text.find('(').is_some_and(|at| at > 0 && text.ends_with(')'))
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kinds(text: &str) -> Vec<(TokenKind, String)> {
        words(text).into_iter().map(|t| (t.kind, text[t.range].to_string())).collect()
    }

    #[test]
    fn minus_starts_option_only_before_letter() {
        let got = kinds("A -ANC -45 -.5 -(2+3) ~WIRE *MLB");
        let want = [
            TokenKind::Word,
            TokenKind::Option,
            TokenKind::Number,
            TokenKind::Number,
            TokenKind::Number,
            TokenKind::Class,
            TokenKind::Point,
        ];
        assert_eq!(got.iter().map(|(k, _)| *k).collect::<Vec<_>>(), want);
    }

    #[test]
    fn two_commas_leave_empty_field_and_single_comma_does_not() {
        assert_eq!(kinds("A , B,,C").len(), 4);
        assert_eq!(kinds("A,B , -OPT").len(), 3);
    }

    #[test]
    fn comments_and_continuation_end_record_text() {
        assert_eq!(line_end("A B \\ "), (4, true));
        assert_eq!(line_end("A B \\ $ why"), (4, true));
        assert_eq!(line_end("A $ B \\"), (2, false));
        assert_eq!(line_end("A \\ B"), (5, false));
        assert_eq!(line_end("A 'x $ y' B"), (11, false));
    }

    #[test]
    fn quotes_keep_blanks_but_apostrophe_inside_word_is_letter() {
        assert_eq!(
            kinds("STORE 'my file.csv'"),
            [(TokenKind::Word, "STORE".into()), (TokenKind::Quoted, "my file.csv".into())]
        );
        assert_eq!(kinds("Don't stop").len(), 2);
    }
}
