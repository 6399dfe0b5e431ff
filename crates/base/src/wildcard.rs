//! Patterns with wild characters.
//!
//! Source: [MOSES-REF men_select].

/// Whether a pattern with `@` (any run, also none) and `/` (exactly one character) fits a name, upper and lower case
/// alike. Linear in both lengths for one `@`, their product at worst.
pub fn matches(pattern: &str, name: &str) -> bool {
    let pattern: Vec<char> = pattern.chars().flat_map(char::to_uppercase).collect();
    let name: Vec<char> = name.chars().flat_map(char::to_uppercase).collect();
    let (mut p, mut n) = (0, 0);
    let mut back: Option<(usize, usize)> = None;
    while n < name.len() {
        match pattern.get(p) {
            Some('@') => {
                back = Some((p, n));
                p += 1;
            }
            Some(c) if *c == '/' || Some(c) == name.get(n) => {
                p += 1;
                n += 1;
            }
            _ => match back {
                Some((star, from)) => {
                    back = Some((star, from + 1));
                    p = star + 1;
                    n = from + 1;
                }
                None => return false,
            },
        }
    }
    pattern.iter().skip(p).all(|c| *c == '@')
}

/// Whether a word holds wild characters.
pub fn is_wild(word: &str) -> bool {
    word.contains(['@', '/'])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wildcards_match_any_characters() {
        assert!(matches("@", ""));
        assert!(matches("ML@", "mla"));
        assert!(matches("/LA", "MLA"));
        assert!(!matches("/LA", "LA"));
        assert!(matches("@A@B", "xAyAzB"));
        assert!(!matches("A@B", "ABC"));
    }
}
