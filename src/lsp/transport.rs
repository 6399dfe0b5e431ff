//! Messages of the Language Server Protocol on a stream: a head with the length, then JSON.
//!
//! What is no message is told apart from the end of the stream, so that a client that sends nonsense gets an answer and goes on; this is why
//! the crate lsp-server is not used, which ends with the first such message.

use serde_json::Value;
use std::io::{BufRead, Read, Result, Write};

/// Longest message taken (bytes); what is longer is read past.
const LONGEST_MESSAGE: u64 = 64 << 20;
/// Longest line of a head (bytes).
const LONGEST_HEAD: u64 = 4096;

/// What came.
#[derive(Debug)]
pub enum Incoming {
    /// A message.
    Message(Value),
    /// Bytes that are none, and why.
    Malformed(String),
}

/// The next message; `None` at the end of the stream.
///
/// # Errors
/// A stream that breaks.
pub fn read_message(from: &mut impl BufRead) -> Result<Option<Incoming>> {
    let mut length: Option<u64> = None;
    let mut has_head = false;
    loop {
        let mut line = Vec::new();
        if from.by_ref().take(LONGEST_HEAD).read_until(b'\n', &mut line)? == 0 {
            return Ok(None);
        }
        let line = String::from_utf8_lossy(&line);
        let line = line.trim();
        if line.is_empty() {
            if has_head {
                break;
            }
            continue;
        }
        has_head = true;
        if let Some((name, value)) = line.split_once(':')
            && name.trim().eq_ignore_ascii_case("Content-Length")
        {
            length = value.trim().parse().ok();
        }
    }
    let Some(length) = length else {
        return Ok(Some(Incoming::Malformed("the head of a message lacks its Content-Length".into())));
    };
    if length > LONGEST_MESSAGE {
        let skipped = std::io::copy(&mut from.by_ref().take(length), &mut std::io::sink())?;
        let text = format!("a message of {length} bytes; at most {LONGEST_MESSAGE} are taken");
        return Ok((skipped == length).then_some(Incoming::Malformed(text)));
    }
    let mut body = Vec::new();
    if from.by_ref().take(length).read_to_end(&mut body)? as u64 != length {
        return Ok(None);
    }
    Ok(Some(match serde_json::from_slice(&body) {
        Ok(message) => Incoming::Message(message),
        Err(error) => Incoming::Malformed(format!("a message is no JSON: {error}")),
    }))
}

/// Writes a message.
///
/// # Errors
/// A stream that breaks.
pub fn write_message(to: &mut impl Write, message: &Value) -> Result<()> {
    let body = message.to_string();
    write!(to, "Content-Length: {}\r\n\r\n{body}", body.len())?;
    to.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nonsense_is_told_and_what_follows_is_read() {
        let stream = b"Content-Length: 5\r\n\r\n{\"a\":nonsense\r\n\r\nContent-Length: x\r\n\r\ncontent-length: 2\r\nContent-Type: y\r\n\r\n{}Content-Length: 9\r\n\r\n{";
        let mut from = stream.as_slice();
        let mut kinds = Vec::new();
        while let Some(incoming) = read_message(&mut from).unwrap() {
            kinds.push(match incoming {
                Incoming::Message(value) => value.to_string(),
                Incoming::Malformed(why) => why.split(':').next().unwrap().to_string(),
            });
        }
        let lacks = "the head of a message lacks its Content-Length";
        assert_eq!(kinds, ["a message is no JSON", lacks, lacks, "{}"]);
        let mut written = Vec::new();
        write_message(&mut written, &serde_json::json!({"a": "\u{e9}"})).unwrap();
        assert!(String::from_utf8(written).unwrap().starts_with("Content-Length: 10\r\n\r\n{"));
    }
}
