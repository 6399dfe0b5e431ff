//! Places in the texts the program reads. Every word keeps its [`Span`] through continuation, substitution, macros and
//! insertions, so that a message can always show the file, line and column it speaks of.

/// Identifies one text: a file, a command-line record, a line typed at the terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub struct SourceId(u32);

impl SourceId {
    /// The id of the text at this index of the list of all texts; indices past `u32::MAX` share the last id.
    pub fn new(index: usize) -> Self {
        SourceId(u32::try_from(index).unwrap_or(u32::MAX))
    }

    /// Index of the text in the list of all texts.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A byte range of one source.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Span {
    /// Which text.
    pub source: SourceId,
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

impl Span {
    /// A span of a source; byte offsets past 4 GiB are pinned to the end.
    pub fn new(source: SourceId, start: usize, end: usize) -> Self {
        let pin = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        Span { source, start: pin(start), end: pin(end.max(start)) }
    }

    /// The span from the start of this one to the end of `other` (same source), else this one.
    pub fn join(self, other: Span) -> Span {
        if self.source == other.source && other.end >= self.start { Span { end: other.end, ..self } } else { self }
    }
}
