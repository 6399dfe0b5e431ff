//! `windlass lsp`: the language server for editors, on standard input and output.
//!
//! One thread reads messages, one answers them, and one checks what is being edited (module `check`). A check that is overtaken by a change is
//! abandoned, so that answers never wait for it; what it would have said of an old version is not said. A request that was cancelled before
//! it was answered is answered as such.
//!
//! Nothing is solved, run or written, and files are read below the folder of a script alone.

mod answers;
mod check;
mod documents;
mod names;
mod positions;
mod transport;

use self::answers::Answers;
use self::check::{Analysis, RunningCheck};
use self::documents::{Document, Documents};
use self::positions::Encoding;
use self::transport::{Incoming, read_message, write_message};
use serde::Deserialize;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::io::{BufReader, Read, Write};
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, Sender, channel};

/// Errors of the protocol.
#[derive(Clone, Copy)]
enum ErrorCode {
    Parse = -32700,
    InvalidRequest = -32600,
    MethodNotFound = -32601,
    InvalidParams = -32602,
    NotInitialized = -32002,
    Cancelled = -32800,
}

/// What happens to the server.
enum Event {
    Came(Incoming),
    /// A check has ended; `None` where it was abandoned.
    Checked(Option<Box<Analysis>>),
    /// The client has gone.
    Closed,
}

/// How far a client has come with the server.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Phase {
    New,
    Serving,
    ShutDown,
}

/// The server, between two events.
struct Server<W: Write> {
    out: W,
    phase: Phase,
    encoding: Encoding,
    documents: Documents,
    /// The last check of each job, by the file it begins with.
    analyses: BTreeMap<PathBuf, Analysis>,
    /// The jobs that have changed since their last check began.
    unchecked: BTreeSet<PathBuf>,
    running: Option<(PathBuf, RunningCheck)>,
    /// The files that each job has messages of in the editor.
    published: BTreeMap<PathBuf, BTreeSet<PathBuf>>,
    events: Sender<Event>,
}

/// Serves a client until it leaves; the exit code is 0 where it said so before.
pub fn serve(input: impl Read + Send + 'static, output: impl Write) -> u8 {
    let (events, coming) = channel();
    let reader = events.clone();
    let read = move || {
        let mut input = BufReader::new(input);
        while let Ok(Some(incoming)) = read_message(&mut input) {
            if reader.send(Event::Came(incoming)).is_err() {
                return;
            }
        }
        // nobody is left to be told when this fails
        let _ = reader.send(Event::Closed);
    };
    if std::thread::Builder::new().name("messages".into()).spawn(read).is_err() {
        return 1;
    }
    let mut server = Server {
        out: output,
        phase: Phase::New,
        encoding: Encoding::default(),
        documents: Documents::default(),
        analyses: BTreeMap::new(),
        unchecked: BTreeSet::new(),
        running: None,
        published: BTreeMap::new(),
        events,
    };
    server.run(&coming)
}

/// The place in a text that a request is about.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct PlaceParams {
    text_document: DocumentId,
    #[serde(default)]
    position: PositionParams,
    #[serde(default)]
    new_name: String,
    #[serde(default)]
    range: Option<RangeParams>,
}

#[derive(Deserialize)]
struct DocumentId {
    uri: String,
}

/// A position in a text.
#[derive(Clone, Copy, Default, Deserialize)]
struct PositionParams {
    line: u64,
    character: u64,
}

/// A range of a text.
#[derive(Clone, Copy, Deserialize)]
struct RangeParams {
    start: PositionParams,
    end: PositionParams,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct OpenParams {
    text_document: OpenedDocument,
}

#[derive(Deserialize)]
struct OpenedDocument {
    uri: String,
    #[serde(default)]
    version: i64,
    text: String,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct ChangeParams {
    text_document: VersionedDocument,
    content_changes: Vec<ContentChange>,
}

#[derive(Deserialize)]
struct VersionedDocument {
    uri: String,
    #[serde(default)]
    version: Option<i64>,
}

/// A change of a range of a text, or the whole text.
#[derive(Deserialize)]
struct ContentChange {
    #[serde(default)]
    range: Option<RangeParams>,
    text: String,
}

type Answer = Result<Value, (ErrorCode, String)>;

impl<W: Write> Server<W> {
    fn run(&mut self, coming: &Receiver<Event>) -> u8 {
        let mut waiting: VecDeque<Event> = VecDeque::new();
        loop {
            if waiting.is_empty() {
                // a check begins when nothing else is to be done
                self.begin_check();
                match coming.recv() {
                    Ok(event) => waiting.push_back(event),
                    Err(_) => return 1,
                }
            }
            waiting.extend(coming.try_iter());
            self.answer_cancelled(&mut waiting);
            let Some(event) = waiting.pop_front() else { continue };
            match event {
                Event::Came(Incoming::Message(message)) => {
                    if message.get("method").and_then(Value::as_str) == Some("exit") {
                        return u8::from(self.phase != Phase::ShutDown);
                    }
                    self.handle(message);
                }
                Event::Came(Incoming::Malformed(why)) => self.reply_error(Value::Null, ErrorCode::Parse, &why),
                Event::Checked(analysis) => self.take_analysis(analysis),
                Event::Closed => return u8::from(self.phase != Phase::ShutDown),
            }
        }
    }

    /// Answers the requests that are cancelled by messages behind them.
    fn answer_cancelled(&mut self, waiting: &mut VecDeque<Event>) {
        let message = |event: &Event| match event {
            Event::Came(Incoming::Message(message)) => Some(message.clone()),
            _ => None,
        };
        let is_cancel = |message: &Value| message.get("method").and_then(Value::as_str) == Some("$/cancelRequest");
        let cancelled: Vec<Value> = waiting
            .iter()
            .filter(|event| matches!(event, Event::Came(Incoming::Message(message)) if is_cancel(message)))
            .filter_map(message)
            .filter_map(|message| message.get("params")?.get("id").cloned())
            .collect();
        if cancelled.is_empty() {
            return;
        }
        let is_cancelled = |event: &Event| match event {
            Event::Came(Incoming::Message(message)) => message.get("id").is_some_and(|id| cancelled.contains(id)),
            _ => false,
        };
        let (dropped, kept): (VecDeque<Event>, VecDeque<Event>) = waiting.drain(..).partition(is_cancelled);
        *waiting = kept;
        for message in dropped.iter().filter_map(message) {
            if message.get("method").is_some() {
                let id = message.get("id").cloned().unwrap_or_default();
                self.reply_error(id, ErrorCode::Cancelled, "the request was cancelled");
            }
        }
        waiting.retain(|event| !matches!(event, Event::Came(Incoming::Message(message)) if is_cancel(message)));
    }

    fn send(&mut self, message: &Value) {
        // a client that has gone is noticed by what is read
        let _ = write_message(&mut self.out, message);
    }

    fn reply_error(&mut self, id: Value, code: ErrorCode, text: &str) {
        self.send(&json!({"jsonrpc": "2.0", "id": id, "error": {"code": code as i32, "message": text}}));
    }

    fn handle(&mut self, mut message: Value) {
        let id = message.get("id").cloned();
        let method = message.get("method").and_then(Value::as_str).map(str::to_string);
        let params = message.get_mut("params").map(Value::take).unwrap_or_default();
        match (id, method) {
            (Some(id), Some(method)) => match self.request(&method, params) {
                Ok(result) => self.send(&json!({"jsonrpc": "2.0", "id": id, "result": result})),
                Err((code, text)) => self.reply_error(id, code, &text),
            },
            (None, Some(method)) => self.notice(&method, params),
            // an answer: the server asks nothing
            (Some(_), None) if message.get("result").is_some() || message.get("error").is_some() => {}
            (id, None) => {
                let text = "a message has neither a method nor a result";
                self.reply_error(id.unwrap_or_default(), ErrorCode::InvalidRequest, text);
            }
        }
    }

    fn request(&mut self, method: &str, params: Value) -> Answer {
        match (method, self.phase) {
            ("initialize", Phase::New) => return Ok(self.initialize(&params)),
            ("initialize", _) => return Err((ErrorCode::InvalidRequest, "initialize comes once".into())),
            (_, Phase::New) => return Err((ErrorCode::NotInitialized, "initialize comes first".into())),
            (_, Phase::ShutDown) => return Err((ErrorCode::InvalidRequest, "the server was shut down".into())),
            ("shutdown", Phase::Serving) => {
                self.phase = Phase::ShutDown;
                return Ok(Value::Null);
            }
            _ => {}
        }
        let answer: fn(&Answers<'_>, &PlaceParams) -> Answer = match method {
            "textDocument/completion" => |answers, place| Ok(answers.completion(place.position)),
            "textDocument/hover" => |answers, place| Ok(answers.hover(place.position)),
            "textDocument/definition" => |answers, place| Ok(answers.definition(place.position)),
            "textDocument/references" => |answers, place| Ok(answers.references(place.position)),
            "textDocument/prepareRename" => |answers, place| Ok(answers.prepare_rename(place.position)),
            "textDocument/rename" => |answers, place| {
                answers.rename(place.position, &place.new_name).map_err(|why| (ErrorCode::InvalidParams, why))
            },
            "textDocument/documentSymbol" => |answers, _| Ok(answers.symbols()),
            "textDocument/foldingRange" => |answers, _| Ok(answers.folds()),
            "textDocument/codeAction" => |answers, place| Ok(answers.actions(place.range)),
            "textDocument/formatting" => |answers, _| Ok(answers.formatting()),
            _ => return Err((ErrorCode::MethodNotFound, format!("windlass does not have {method}"))),
        };
        let place: PlaceParams =
            serde_json::from_value(params).map_err(|error| (ErrorCode::InvalidParams, error.to_string()))?;
        let Some(document) = self.documents.by_uri(&place.text_document.uri) else {
            return Err((ErrorCode::InvalidParams, format!("{} is not open", place.text_document.uri)));
        };
        let analysis = self.analysis_of(document);
        let answers = Answers { documents: &self.documents, document, analysis, encoding: self.encoding };
        answer(&answers, &place)
    }

    fn initialize(&mut self, params: &Value) -> Value {
        self.phase = Phase::Serving;
        let offered = params.pointer("/capabilities/general/positionEncodings").and_then(Value::as_array);
        let takes_bytes = offered.is_some_and(|list| list.iter().any(|name| name == "utf-8"));
        self.encoding = if takes_bytes { Encoding::Utf8 } else { Encoding::Utf16 };
        json!({
            "serverInfo": {"name": "windlass", "version": env!("CARGO_PKG_VERSION")},
            "capabilities": {
                "positionEncoding": if takes_bytes { "utf-8" } else { "utf-16" },
                "textDocumentSync": {"openClose": true, "change": 2},
                "completionProvider": {"triggerCharacters": ["~", "*", ":", "&", "-", "%", "#"]},
                "hoverProvider": true,
                "definitionProvider": true,
                "referencesProvider": true,
                "renameProvider": {"prepareProvider": true},
                "documentSymbolProvider": true,
                "foldingRangeProvider": true,
                "codeActionProvider": {"codeActionKinds": ["quickfix"]},
                "documentFormattingProvider": true,
            },
        })
    }

    /// A message that wants no answer; one that is wrong is passed over, as the protocol has it.
    fn notice(&mut self, method: &str, params: Value) {
        if self.phase != Phase::Serving {
            return;
        }
        match method {
            "textDocument/didOpen" => {
                let Ok(OpenParams { text_document: opened }) = serde_json::from_value(params) else { return };
                let path = self.documents.open(opened.uri, opened.version, opened.text);
                self.note_change(&path);
            }
            "textDocument/didChange" => {
                let Ok(change) = serde_json::from_value::<ChangeParams>(params) else { return };
                let VersionedDocument { uri, version } = change.text_document;
                if let Some(path) = self.documents.change(&uri, version, &change.content_changes, self.encoding) {
                    self.note_change(&path);
                }
            }
            "textDocument/didClose" => {
                let Ok(place) = serde_json::from_value::<PlaceParams>(params) else { return };
                if let Some(path) = self.documents.close(&place.text_document.uri) {
                    self.note_closing(&path);
                }
            }
            _ => {}
        }
    }

    /// The check that a document takes part in.
    fn analysis_of(&self, document: &Document) -> Option<&Analysis> {
        let own = self.analyses.get(&self.documents.root_of(document));
        own.or_else(|| self.analyses.values().find(|analysis| analysis.source_of(&document.path).is_some()))
    }

    /// A text has changed: the jobs that read it are checked anew.
    fn note_change(&mut self, path: &PathBuf) {
        let Some(document) = self.documents.by_path(path) else { return };
        let own = self.documents.root_of(document);
        let readers: Vec<PathBuf> = self
            .analyses
            .values()
            .filter(|analysis| analysis.source_of(path).is_some() && self.documents.by_path(&analysis.root).is_some())
            .map(|analysis| analysis.root.clone())
            .collect();
        // what another open script reads is checked within it
        let is_read = readers.iter().any(|root| root != path);
        self.unchecked.extend(readers);
        if !is_read || own != *path {
            self.unchecked.insert(own);
        }
        if let Some((root, running)) = &self.running
            && self.unchecked.contains(root)
        {
            running.abandon();
        }
    }

    /// A text is no longer held: what was said of it is taken back, and the jobs that read it are checked with its file.
    fn note_closing(&mut self, path: &PathBuf) {
        self.unchecked.remove(path);
        let is_root = self.analyses.remove(path).is_some();
        if is_root {
            self.publish(path, &BTreeMap::new());
        }
        let readers = self.analyses.values().filter(|analysis| analysis.source_of(path).is_some());
        self.unchecked.extend(readers.map(|analysis| analysis.root.clone()));
        // what this script read and is still open is checked by itself
        let left: Vec<PathBuf> = self.documents.paths().filter(|open| is_root && *open != path).cloned().collect();
        for open in left {
            if self.documents.by_path(&open).and_then(|document| self.analysis_of(document)).is_none() {
                self.note_change(&open);
            }
        }
    }

    fn begin_check(&mut self) {
        while self.running.is_none() {
            let Some(root) = self.unchecked.pop_first() else { return };
            let Some(task) = self.documents.task(&root) else { continue };
            let events = self.events.clone();
            let done = move |analysis: Option<Analysis>| {
                // the server may have gone
                let _ = events.send(Event::Checked(analysis.map(Box::new)));
            };
            self.running = RunningCheck::start(task, done).map(|running| (root, running));
            if self.running.is_none() {
                return;
            }
        }
    }

    /// Takes what a check has found, unless a text has changed meanwhile.
    fn take_analysis(&mut self, analysis: Option<Box<Analysis>>) {
        self.running = None;
        let Some(analysis) = analysis else { return };
        let is_current = analysis
            .versions
            .iter()
            .all(|(path, version)| self.documents.by_path(path).is_none_or(|document| document.version == *version));
        let root = analysis.root.clone();
        if !is_current {
            self.unchecked.insert(root);
            return;
        }
        // a script that is read by this one is not checked by itself
        let read: Vec<PathBuf> = analysis.sources.iter().skip(1).map(|(path, _)| path.clone()).collect();
        for path in read {
            if self.analyses.remove(&path).is_some() {
                self.publish(&path, &BTreeMap::new());
            }
            self.unchecked.remove(&path);
        }
        let mut lists: BTreeMap<PathBuf, Vec<Value>> = BTreeMap::new();
        for (source, (path, _)) in analysis.sources.iter().enumerate() {
            lists.insert(path.clone(), answers::diagnostics(&analysis, source, &self.documents, self.encoding));
        }
        self.publish(&root, &lists);
        self.analyses.insert(root, *analysis);
    }

    /// Sends the messages of a job's files; files that it had messages of before and has no longer are cleared.
    fn publish(&mut self, root: &PathBuf, lists: &BTreeMap<PathBuf, Vec<Value>>) {
        let before = self.published.remove(root).unwrap_or_default();
        let gone = before.into_iter().filter(|path| !lists.contains_key(path)).map(|path| (path, Vec::new()));
        let all: Vec<(PathBuf, Vec<Value>)> =
            lists.iter().map(|(path, list)| (path.clone(), list.clone())).chain(gone).collect();
        for (path, list) in all {
            let version = self.documents.by_path(&path).map(|document| document.version);
            let mut params = json!({"uri": self.documents.uri_of(&path), "diagnostics": list});
            if let (Some(version), Some(object)) = (version, params.as_object_mut()) {
                object.insert("version".into(), version.into());
            }
            self.send(&json!({"jsonrpc": "2.0", "method": "textDocument/publishDiagnostics", "params": params}));
        }
        if !lists.is_empty() {
            self.published.insert(root.clone(), lists.keys().cloned().collect());
        }
    }
}
