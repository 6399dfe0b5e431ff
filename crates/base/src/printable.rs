//! Text of the user as it may go to a screen: without characters that a terminal acts on.

use std::borrow::Cow;
use std::fmt::Write;

/// Whether a terminal acts on a character, or orders its line by it: C0 but for newline and tab, DEL, C1, controls of direction.
pub fn is_acted_on(c: char) -> bool {
    match c {
        '\n' | '\t' => false,
        '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' => true,
        _ => c.is_control(),
    }
}

/// Text with every character that a terminal acts on as `\u{..}`.
pub fn printable(text: &str) -> Cow<'_, str> {
    if !text.chars().any(is_acted_on) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        if is_acted_on(c) {
            // writing to a string does not fail
            let _ = write!(out, "\\u{{{:x}}}", u32::from(c));
        } else {
            out.push(c);
        }
    }
    Cow::Owned(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terminal_control_characters_are_escaped_and_letters_kept() {
        // OSC 52 (clipboard), clear screen, C1 CSI, a carriage return, DEL, a right-to-left override, an isolate
        for (text, shown) in [
            ("\u{1b}]52;c;AAAA\u{7}", r"\u{1b}]52;c;AAAA\u{7}"),
            ("a\u{1b}[2Jb", r"a\u{1b}[2Jb"),
            ("\u{9b}31m", r"\u{9b}31m"),
            ("a\rb\u{7f}\u{0}", r"a\u{d}b\u{7f}\u{0}"),
            ("\u{202e}txt\u{2066}\u{200f}\u{61c}", r"\u{202e}txt\u{2066}\u{200f}\u{61c}"),
            ("two\n\tlines", "two\n\tlines"),
            ("anker\u{e9} \u{6d77} \u{a0} \u{2713}", "anker\u{e9} \u{6d77} \u{a0} \u{2713}"),
        ] {
            assert_eq!(printable(text), shown);
        }
    }

    #[test]
    fn characters_match_unicode_tables() {
        // category Cc has 65 characters, of which newline and tab stay; Bidi_Control has 12 (Unicode 16, PropList)
        let acted = ('\0'..=char::MAX).filter(|c| is_acted_on(*c)).count();
        assert_eq!(acted, 65 - 2 + 12);
    }
}
