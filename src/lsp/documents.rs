//! The texts that an editor holds, and which script each of them is a part of.

use super::ContentChange;
use super::check::CheckTask;
use super::positions::{Encoding, LineIndex};
use crate::session::read_text;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A text that an editor holds.
#[derive(Clone, Debug)]
pub struct Document {
    /// As the editor names it.
    pub uri: String,
    /// Its file, whole and without links; of a text without a file a path that leads nowhere.
    pub path: PathBuf,
    /// Counted up with each change.
    pub version: i64,
    /// The text.
    pub text: Arc<str>,
}

/// All of them.
#[derive(Debug, Default)]
pub struct Documents {
    open: BTreeMap<PathBuf, Document>,
}

impl Documents {
    /// Takes a text; returns its path.
    pub fn open(&mut self, uri: String, version: i64, text: String) -> PathBuf {
        let path = path_of(&uri);
        let document = Document { uri, path: path.clone(), version, text: without_mark(text).into() };
        self.open.insert(path.clone(), document);
        path
    }

    /// Changes a text; returns its path, or `None` where it is not open or the change is of an earlier version.
    pub fn change(
        &mut self,
        uri: &str,
        version: Option<i64>,
        changes: &[ContentChange],
        encoding: Encoding,
    ) -> Option<PathBuf> {
        let document = self.open.values_mut().find(|document| document.uri == uri)?;
        let version = version.unwrap_or(document.version + 1);
        if version <= document.version {
            return None;
        }
        let mut text = document.text.to_string();
        for change in changes {
            let Some(range) = change.range else {
                text = without_mark(change.text.clone());
                continue;
            };
            let index = LineIndex::new(&text, encoding);
            let start = index.byte(range.start.line, range.start.character);
            let end = index.byte(range.end.line, range.end.character).max(start);
            text.replace_range(start..end, &change.text);
        }
        document.text = text.into();
        document.version = version;
        Some(document.path.clone())
    }

    /// Lets a text go; returns its path.
    pub fn close(&mut self, uri: &str) -> Option<PathBuf> {
        let path = self.by_uri(uri)?.path.clone();
        self.open.remove(&path);
        Some(path)
    }

    /// The text of a name.
    pub fn by_uri(&self, uri: &str) -> Option<&Document> {
        self.open.values().find(|document| document.uri == uri)
    }

    /// The text of a file.
    pub fn by_path(&self, path: &Path) -> Option<&Document> {
        self.open.get(path)
    }

    /// The files of all texts.
    pub fn paths(&self) -> impl Iterator<Item = &PathBuf> {
        self.open.keys()
    }

    /// How the editor names a file.
    pub fn uri_of(&self, path: &Path) -> String {
        self.by_path(path).map_or_else(|| file_uri(path), |document| document.uri.clone())
    }

    /// The file with which the job begins that a text is a part of: of the model ROOT.dat that is no deck the script ROOT.cif, else itself.
    pub fn root_of(&self, document: &Document) -> PathBuf {
        let is_model = document.path.extension().is_some_and(|end| end.eq_ignore_ascii_case("dat"))
            && !windlass_aqwa::is_deck(&document.text);
        let script = ["cif", "CIF"]
            .map(|end| document.path.with_extension(end))
            .into_iter()
            .find(|script| is_model && (self.open.contains_key(script) || (script.is_file() && !script.is_symlink())));
        script.unwrap_or_else(|| document.path.clone())
    }

    /// What is to be checked of a job; `None` where its script is neither open nor there.
    pub fn task(&self, root: &Path) -> Option<CheckTask> {
        let text = match self.by_path(root) {
            Some(document) => Arc::clone(&document.text),
            None => read_text(root).ok()?.as_str().into(),
        };
        let held = |document: &Document| (document.path.clone(), (document.version, Arc::clone(&document.text)));
        Some(CheckTask { root: root.to_path_buf(), text, held: self.open.values().map(held).collect() })
    }
}

/// Without the byte order mark, which is no part of a script.
fn without_mark(text: String) -> String {
    match text.strip_prefix('\u{feff}') {
        Some(rest) => rest.to_string(),
        None => text,
    }
}

/// The file of a name; of one that is no file a path that does not exist, below which nothing is read.
fn path_of(uri: &str) -> PathBuf {
    let decoded = uri.strip_prefix("file://").and_then(decode);
    match decoded.map(PathBuf::from).filter(|path| path.is_absolute()) {
        Some(path) => path.canonicalize().unwrap_or(path),
        None => Path::new("without a file").join(uri.replace(['/', '\\', ':'], "_")),
    }
}

/// The bytes behind `%` put in; a host before the path is taken off.
fn decode(encoded: &str) -> Option<String> {
    let path = encoded.get(encoded.find('/')?..)?;
    let mut bytes = Vec::with_capacity(path.len());
    let mut rest = path.bytes();
    while let Some(byte) = rest.next() {
        if byte != b'%' {
            bytes.push(byte);
            continue;
        }
        let digit = |byte: Option<u8>| char::from(byte?).to_digit(16);
        let value = digit(rest.next())? * 16 + digit(rest.next())?;
        bytes.push(u8::try_from(value).ok()?);
    }
    let text = String::from_utf8(bytes).ok()?;
    // a drive of Windows stands behind a slash
    let is_drive = cfg!(windows) && text.as_bytes().get(2) == Some(&b':');
    Some(if is_drive { text.get(1..)?.to_string() } else { text })
}

/// A file as a name.
fn file_uri(path: &Path) -> String {
    let text = path.to_string_lossy().replace('\\', "/");
    let mut uri = String::from(if text.starts_with('/') { "file://" } else { "file:///" });
    for byte in text.bytes() {
        if byte.is_ascii_alphanumeric() || b"/-._~".contains(&byte) {
            uri.push(char::from(byte));
        } else {
            uri.push_str(&format!("%{byte:02X}"));
        }
    }
    uri
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_become_paths_and_come_back() {
        let path = Path::new("/tmp/a b/\u{e9}.cif");
        assert_eq!(file_uri(path), "file:///tmp/a%20b/%C3%A9.cif");
        assert_eq!(decode("/tmp/a%20b/%C3%A9.cif").unwrap(), path.to_str().unwrap());
        assert_eq!(decode("localhost/tmp/x").unwrap(), "/tmp/x");
        assert_eq!((decode("/a%2"), decode("/%FF"), decode("none")), (None, None, None));
        assert!(!path_of("untitled:Untitled-1").is_absolute());
    }

    #[test]
    fn changes_apply_in_order_and_earlier_versions_do_not() {
        let mut documents = Documents::default();
        documents.open("untitled:a".into(), 1, "\u{feff}a\u{1f6a2}b\n".into());
        let change = |start: u64, end: u64, text: &str| {
            let at = |character| super::super::PositionParams { line: 0, character };
            let range = super::super::RangeParams { start: at(start), end: at(end) };
            ContentChange { range: Some(range), text: text.into() }
        };
        let utf16 = Encoding::Utf16;
        assert!(documents.change("untitled:a", Some(2), &[change(3, 4, "cd"), change(0, 1, "")], utf16).is_some());
        assert_eq!(&*documents.by_uri("untitled:a").unwrap().text, "\u{1f6a2}cd\n");
        let whole = [ContentChange { range: None, text: "old".into() }];
        assert!(documents.change("untitled:a", Some(2), &whole, utf16).is_none());
        assert!(documents.change("untitled:b", Some(9), &whole, utf16).is_none());
        assert_eq!(&*documents.by_uri("untitled:a").unwrap().text, "\u{1f6a2}cd\n");
        assert!(documents.close("untitled:a").is_some() && documents.close("untitled:a").is_none());
    }
}
