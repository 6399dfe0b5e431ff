//! YAML as a tree whose nodes have places. Anchors and aliases, tags and second documents are errors, so that a tree is never larger than its
//! text.

use saphyr_parser::{Event, Parser, ScalarStyle};
use std::collections::BTreeMap;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::{SourceId, Span};

/// Deepest nesting: text models have six levels or so.
const MAX_DEPTH: usize = 40;

/// A node of the tree.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// What it is.
    pub content: Content,
    /// Its place; of a list or a map that of its first word.
    pub span: Span,
}

/// What a node is.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// A word.
    Scalar {
        /// Its text.
        text: String,
        /// Whether it stands in quotes.
        is_quoted: bool,
    },
    /// A list.
    List(Vec<Node>),
    /// Names with what they name, in order.
    Map(Vec<Entry>),
}

/// A name and what it names.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The name.
    pub name: String,
    /// Its place.
    pub span: Span,
    /// What it names.
    pub value: Node,
}

impl Node {
    /// The entries of a map; none of another node.
    pub fn entries(&self) -> &[Entry] {
        match &self.content {
            Content::Map(entries) => entries,
            _ => &[],
        }
    }

    /// The items of a list; none of another node.
    pub fn items(&self) -> &[Node] {
        match &self.content {
            Content::List(items) => items,
            _ => &[],
        }
    }

    /// The text of a word; none of another node.
    pub fn text(&self) -> Option<&str> {
        match &self.content {
            Content::Scalar { text, .. } => Some(text),
            _ => None,
        }
    }

    /// Whether it says nothing: `~`, or no word at all.
    pub fn is_default(&self) -> bool {
        matches!(&self.content, Content::Scalar { text, is_quoted: false } if text == "~" || text.is_empty())
    }
}

/// A list or a map that is being read.
enum Open {
    List(Vec<Node>, Span),
    Map { entries: Vec<Entry>, known: BTreeMap<String, Span>, name: Option<(String, Span)>, span: Span },
}

/// Characters and bytes of a text, passed over once.
struct Bytes<'a> {
    rest: std::iter::Peekable<std::str::CharIndices<'a>>,
    character: usize,
    length: usize,
}

impl Bytes<'_> {
    /// The byte at which a character begins; characters are asked for in growing order, but for those of one word.
    fn at(&mut self, character: usize) -> usize {
        while self.character < character && self.rest.next().is_some() {
            self.character += 1;
        }
        self.rest.peek().map_or(self.length, |(byte, _)| *byte)
    }
}

/// Reads a text.
///
/// # Errors
/// What is no YAML, at its place; anchors, aliases, tags, a second document, a name given twice, nesting deeper than 40.
pub fn read(text: &str, source: SourceId) -> Outcome<Node> {
    let mut bytes = Bytes { rest: text.char_indices().peekable(), character: 0, length: text.len() };
    let mut open: Vec<Open> = Vec::new();
    let mut done: Option<Node> = None;
    let mut parser = Parser::new_from_str(text);
    while let Some(event) = parser.next_event() {
        let (event, at) = event.map_err(|error| {
            let start = Bytes { rest: text.char_indices().peekable(), character: 0, length: text.len() }
                .at(error.marker().index());
            let end = text.get(start..).and_then(|rest| rest.chars().next()).map_or(start, |c| start + c.len_utf8());
            Diagnostic::error(format!("the file is no YAML: {}", error.info()), Span::new(source, start, end))
        })?;
        let start = bytes.at(at.start.index());
        let end = if at.end.index() > at.start.index() { bytes.at(at.end.index()) } else { start };
        let span = Span::new(source, start, end);
        let first = text.get(start..).and_then(|rest| rest.chars().next()).map_or(start, |c| start + c.len_utf8());
        let here = Span::new(source, start, first);
        let node = match event {
            Event::Alias(_) => {
                let error = Diagnostic::error("an alias of YAML is not read", span);
                return Err(error.help("write what it stands for"));
            }
            Event::Scalar(text, style, anchor, tag) => {
                plain(anchor, tag.is_some(), span)?;
                let is_quoted = style != ScalarStyle::Plain;
                Some(Node { content: Content::Scalar { text: text.into_owned(), is_quoted }, span })
            }
            Event::SequenceStart(anchor, tag) => {
                plain(anchor, tag.is_some(), here)?;
                open.push(Open::List(Vec::new(), here));
                None
            }
            Event::MappingStart(anchor, tag) => {
                plain(anchor, tag.is_some(), here)?;
                open.push(Open::Map { entries: Vec::new(), known: BTreeMap::new(), name: None, span: here });
                None
            }
            Event::SequenceEnd | Event::MappingEnd => open.pop().map(close),
            Event::DocumentStart(_) if done.is_some() => {
                return Err(Diagnostic::error("a second document of YAML is not read", here));
            }
            Event::Nothing | Event::StreamStart | Event::StreamEnd | Event::DocumentStart(_) | Event::DocumentEnd => {
                None
            }
        };
        if open.len() > MAX_DEPTH {
            return Err(Diagnostic::error(format!("nested deeper than {MAX_DEPTH}"), here));
        }
        let Some(node) = node else { continue };
        match open.last_mut() {
            None => done = Some(node),
            Some(Open::List(items, _)) => items.push(node),
            Some(Open::Map { entries, known, name, .. }) => match name.take() {
                Some((name, span)) => entries.push(Entry { name, span, value: node }),
                None => {
                    let Some(text) = node.text() else {
                        return Err(Diagnostic::error("a name is a list or a map", node.span).label("expected a word"));
                    };
                    if let Some(earlier) = known.insert(text.to_string(), node.span) {
                        let error = Diagnostic::error(format!("{text} is given twice"), node.span);
                        return Err(error.other(earlier, "given here first"));
                    }
                    *name = Some((text.to_string(), node.span));
                }
            },
        }
    }
    done.ok_or_else(|| Diagnostic::error("the file is empty", Span::new(source, 0, 0)))
}

fn plain(anchor: usize, has_tag: bool, span: Span) -> Outcome<()> {
    if anchor > 0 {
        return Err(Diagnostic::error("an anchor of YAML is not read", span));
    }
    if has_tag { Err(Diagnostic::error("a tag of YAML is not read", span)) } else { Ok(()) }
}

fn close(open: Open) -> Node {
    match open {
        Open::List(items, span) => Node { content: Content::List(items), span },
        Open::Map { entries, span, .. } => Node { content: Content::Map(entries), span },
    }
}
