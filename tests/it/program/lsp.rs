//! `windlass lsp` as an editor meets it: the program over pipes, a scripted client.

use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

/// A client with its server.
struct Client {
    server: Child,
    to: ChildStdin,
    from: BufReader<ChildStdout>,
    sent: i64,
    /// Messages that came while an answer was waited for.
    kept: Vec<Value>,
}

impl Client {
    /// A client that has not said anything yet; the server runs in a folder.
    fn silent(folder: &Path) -> Client {
        let mut server = Command::new(env!("CARGO_BIN_EXE_windlass"))
            .arg("lsp")
            .current_dir(folder)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let (to, from) = (server.stdin.take().unwrap(), BufReader::new(server.stdout.take().unwrap()));
        Client { server, to, from, sent: 0, kept: Vec::new() }
    }

    fn new(folder: &Path) -> Client {
        Client::with_encodings(folder, &["utf-16"]).0
    }

    /// A client that offers encodings of positions, and the one that was chosen.
    fn with_encodings(folder: &Path, offered: &[&str]) -> (Client, String) {
        let mut client = Client::silent(folder);
        let capabilities = json!({"general": {"positionEncodings": offered}});
        let answer = client.request("initialize", json!({"capabilities": capabilities}));
        client.notify("initialized", json!({}));
        (client, answer["result"]["capabilities"]["positionEncoding"].as_str().unwrap().to_string())
    }

    fn write(&mut self, body: &str) {
        write!(self.to, "Content-Length: {}\r\n\r\n{body}", body.len()).unwrap();
        self.to.flush().unwrap();
    }

    fn notify(&mut self, method: &str, params: Value) {
        self.write(&json!({"jsonrpc": "2.0", "method": method, "params": params}).to_string());
    }

    fn read(&mut self) -> Value {
        let mut length = 0;
        loop {
            let mut line = String::new();
            assert!(self.from.read_line(&mut line).unwrap() > 0, "the server has gone");
            if line.trim().is_empty() {
                break;
            }
            length = line.trim().strip_prefix("Content-Length: ").unwrap().parse().unwrap();
        }
        let mut body = vec![0; length];
        self.from.read_exact(&mut body).unwrap();
        serde_json::from_slice(&body).unwrap()
    }

    /// The whole answer to a request.
    fn request(&mut self, method: &str, params: Value) -> Value {
        self.sent += 1;
        let id = self.sent;
        self.write(&json!({"jsonrpc": "2.0", "id": id, "method": method, "params": params}).to_string());
        self.answer(id)
    }

    fn answer(&mut self, id: i64) -> Value {
        loop {
            let message = self.read();
            if message.get("id") == Some(&json!(id)) {
                return message;
            }
            self.kept.push(message);
        }
    }

    fn ask(&mut self, method: &str, uri: &str, position: Value) -> Value {
        let params = json!({"textDocument": {"uri": uri}, "position": position});
        self.request(&format!("textDocument/{method}"), params)["result"].take()
    }

    fn open(&mut self, uri: &str, text: &str) {
        let document = json!({"uri": uri, "languageId": "windlass", "version": 1, "text": text});
        self.notify("textDocument/didOpen", json!({"textDocument": document}));
    }

    fn change(&mut self, uri: &str, version: i64, text: &str) {
        let params = json!({"textDocument": {"uri": uri, "version": version}, "contentChanges": [{"text": text}]});
        self.notify("textDocument/didChange", params);
    }

    /// The messages next published of a text.
    fn diagnostics(&mut self, uri: &str) -> Value {
        loop {
            let message = if self.kept.is_empty() { self.read() } else { self.kept.remove(0) };
            if message["method"] == "textDocument/publishDiagnostics" && message["params"]["uri"] == uri {
                return message["params"].clone();
            }
        }
    }

    /// The messages of a text that was just opened: each as line, character of its beginning and of its end, and its first line.
    fn said(&mut self, uri: &str) -> Vec<(u64, u64, u64, String)> {
        listed(&self.diagnostics(uri))
    }

    /// The same of a version of a text.
    fn said_of(&mut self, uri: &str, version: i64) -> Vec<(u64, u64, u64, String)> {
        loop {
            let published = self.diagnostics(uri);
            if published["version"] == version {
                return listed(&published);
            }
        }
    }

    /// Leaves in order; the exit code.
    fn leave(mut self) -> Option<i32> {
        assert_eq!(self.request("shutdown", Value::Null)["result"], Value::Null);
        self.notify("exit", Value::Null);
        self.server.wait().unwrap().code()
    }
}

fn listed(published: &Value) -> Vec<(u64, u64, u64, String)> {
    let number = |value: &Value| value.as_u64().unwrap();
    let one = |said: &Value| {
        let (start, end) = (&said["range"]["start"], &said["range"]["end"]);
        let message = said["message"].as_str().unwrap().lines().next().unwrap().to_string();
        (number(&start["line"]), number(&start["character"]), number(&end["character"]), message)
    };
    published["diagnostics"].as_array().unwrap().iter().map(one).collect()
}

fn uri(path: &Path) -> String {
    format!("file://{}", path.canonicalize().unwrap_or(path.to_path_buf()).display())
}

/// A file in a folder, and its name for an editor.
fn file(folder: &Path, name: &str, text: &str) -> String {
    std::fs::write(folder.join(name), text).unwrap();
    uri(&folder.join(name))
}

fn at(line: u64, character: u64) -> Value {
    json!({"line": line, "character": character})
}

const MODEL: &str = "MEDIT\n&DESCRIBE BODY TBRG\n*MLA 400 50 20\n~WIRE B_CAT 4.19 -DEP 500 -LEN 4000 -BUOY 0 -WTPL .0125\n\
                     CONNECTOR A -ANC 45 3990 ~WIRE *MLA\nEND\n";

#[test]
fn errors_of_unsaved_text_stand_at_their_word_and_fixes_mend_them() {
    let folder = tempfile::tempdir().unwrap();
    let uri = file(folder.path(), "m.cif", MODEL);
    let mut client = Client::new(folder.path());
    client.open(&uri, MODEL);
    assert_eq!(client.said(&uri), []);
    // the file itself is not changed
    let wrong = MODEL.replace("-ANC 45", "-ANX 45");
    client.change(&uri, 2, &wrong);
    let published = client.diagnostics(&uri);
    assert_eq!(published["version"], 2);
    assert_eq!(listed(&published), [(4, 12, 16, "unknown option of CONNECTOR `-ANX`".into())]);
    let range = published["diagnostics"][0]["range"].clone();
    let params = json!({"textDocument": {"uri": uri}, "range": range, "context": {"diagnostics": []}});
    let fixes = client.request("textDocument/codeAction", params)["result"].take();
    assert_eq!(fixes[0]["title"], "Write -ANCHOR for -ANX");
    assert_eq!(fixes[0]["edit"]["changes"][&uri], json!([{"range": range, "newText": "-ANCHOR"}]));
    let mend = json!([{"range": range, "text": "-ANCHOR"}]);
    client
        .notify("textDocument/didChange", json!({"textDocument": {"uri": uri, "version": 3}, "contentChanges": mend}));
    assert_eq!(client.said(&uri), []);
    client.notify("textDocument/didClose", json!({"textDocument": {"uri": uri}}));
    assert_eq!(client.said(&uri), []);
    assert_eq!(client.leave(), Some(0));
}

#[test]
fn characters_are_counted_in_utf16_or_in_bytes_where_offered() {
    let folder = tempfile::tempdir().unwrap();
    // the anchor is 4 bytes and 2 units of UTF-16, e acute 2 bytes and 1 unit
    let text = "&TYPE \u{1f6a2}\u{e9}\r\n$ \u{1f6a2}\r\n&STATUS \u{1f6a2}\u{e9}\r\n";
    for (offered, chosen, end) in [(&["utf-16"][..], "utf-16", 11), (&["utf-32", "utf-8"][..], "utf-8", 14)] {
        let (mut client, encoding) = Client::with_encodings(folder.path(), offered);
        assert_eq!(encoding, chosen);
        client.open("untitled:a", text);
        let said = client.said("untitled:a");
        assert_eq!(said.iter().map(|one| (one.0, one.1, one.2)).collect::<Vec<_>>(), [(2, 8, end)], "{said:?}");
        assert_eq!(client.leave(), Some(0));
    }
}

#[test]
fn pairs_and_inserted_files_are_checked_with_what_is_not_saved() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let script = file(path, "m.cif", "INMODEL\n&INSERT part.txt\nCONN_DESIGN\nEND\n");
    let model = file(path, "m.dat", "&DESCRIBE BODY B\n*P 0 0 0\n");
    let part = file(path, "part.txt", "&TITLE one\n");
    let mut client = Client::new(path);
    client.open(&script, "INMODEL\n&INSERT part.txt\nCONN_DESIGN\nEND\n");
    assert_eq!(client.said(&script), []);
    // the model of the pair, as the editor holds it
    client.open(&model, "&DESCRIBE BODY B\n*P 0 x 0\n");
    assert_eq!(client.said_of(&model, 1).iter().map(|one| (one.0, one.1)).collect::<Vec<_>>(), [(1, 5)]);
    client.open(&part, "&TITEL one\n");
    let said = client.said_of(&part, 1);
    assert_eq!((said[0].0, said[0].1, said[0].2), (0, 0, 6), "{said:?}");
    client.change(&part, 2, "&TITLE one\n");
    assert_eq!(client.said_of(&part, 2), []);
    // a model by itself is checked with the script beside it
    let mut second = Client::new(path);
    second.open(&model, "&DESCRIBE BODY B\n*P 0 0 0\n~C NOTHING\n");
    let said = second.said(&model);
    assert_eq!((said.len(), said[0].0), (1, 2), "{said:?}");
    assert_eq!((client.leave(), second.leave()), (Some(0), Some(0)));
}

#[test]
fn help_and_completion_come_from_specs_and_names() {
    let folder = tempfile::tempdir().unwrap();
    let text = format!(
        "&DIMEN -DIMEN METERS KN\n{MODEL}MEDIT\nCONNECTOR B ~W\nCONNECTOR B ~WIRE *\n~X \n~X B_CAT 1 -L\nEND\nPRC\n&INSERT pa\n"
    );
    let uri = file(folder.path(), "m.cif", &text);
    file(folder.path(), "part.txt", "");
    let mut client = Client::new(folder.path());
    client.open(&uri, &text);
    client.diagnostics(&uri);
    let mut help = |line, character| {
        let answer = client.ask("hover", &uri, at(line, character));
        answer["contents"]["value"].as_str().unwrap_or("").to_string()
    };
    // a length in metres, as &DIMEN has it above; the default of an anchor; the record of a point
    assert!(help(4, 27).contains("length of the segment: a number (m)"), "{}", help(4, 27));
    assert!(help(5, 2).contains("*N2") && help(5, 2).contains("[default: ground]"), "{}", help(5, 2));
    assert!(help(5, 34).starts_with("```text\npoint of m.cif:4\n   *MLA 400 50 20"), "{}", help(5, 34));
    assert!(help(4, 8).contains("B_CAT"), "{}", help(4, 8));
    assert_eq!(help(4, 200), "");
    let mut offered = |line, character| -> Vec<String> {
        let items = client.ask("completion", &uri, at(line, character))["items"].take();
        items.as_array().unwrap().iter().map(|item| item["label"].as_str().unwrap().to_string()).collect()
    };
    assert_eq!(offered(8, 14), ["~WIRE"]);
    assert_eq!(offered(9, 19), ["*MLA"]);
    assert!(offered(10, 3).contains(&"B_CAT".to_string()));
    assert_eq!(offered(11, 13), ["-LEN"]);
    assert_eq!(offered(13, 3), ["PRCPOST"]);
    assert_eq!(offered(14, 10), ["part.txt"]);
    assert_eq!(client.leave(), Some(0));
}

#[test]
fn names_are_found_and_renamed_across_files() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let part_text = "&DESCRIBE BODY B\n*P 0 0 0 $ *P here\n";
    let part = file(path, "part.txt", part_text);
    let text = "MEDIT\n&INSERT part.txt\n~W B_CAT 4 -LEN 500\nCONNECTOR A ~w *p\nEND\n&TYPE &POINT(COORD *P)\n";
    let uri = file(path, "m.cif", text);
    let mut client = Client::new(path);
    client.open(&uri, text);
    client.diagnostics(&uri);
    let place = client.ask("definition", &uri, at(3, 16));
    assert_eq!(place, json!({"uri": part, "range": {"start": at(1, 0), "end": at(1, 2)}}));
    assert_eq!(client.ask("references", &uri, at(2, 1)).as_array().unwrap().len(), 2);
    let rename = |client: &mut Client, name: &str| {
        let params = json!({"textDocument": {"uri": uri}, "position": at(3, 16), "newName": name});
        client.request("textDocument/rename", params)
    };
    let edits = rename(&mut client, "*BOW")["result"]["changes"].take();
    let edit = |line, start, end| json!({"range": {"start": at(line, start), "end": at(line, end)}, "newText": "*BOW"});
    assert_eq!(edits[&part], json!([edit(1, 0, 2)]));
    assert_eq!(edits[&uri][0], edit(3, 15, 17));
    for wrong in ["", "a b", "*", "a,b", "'x'"] {
        assert_eq!(rename(&mut client, wrong)["error"]["code"], -32602, "{wrong}");
    }
    assert_eq!(client.ask("definition", &uri, at(0, 1)), Value::Null);
    // symbols of the part, menus of the script
    let symbols = client.ask("documentSymbol", &uri, at(0, 0));
    let names: Vec<&str> = symbols.as_array().unwrap().iter().map(|one| one["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["~W", "A"]);
    let folds = client.ask("foldingRange", &uri, at(0, 0));
    assert_eq!(folds, json!([{"startLine": 0, "endLine": 4, "kind": "region"}]));
    assert_eq!(client.leave(), Some(0));
}

#[test]
fn abbreviated_calls_of_a_macro_are_renamed_with_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    // LINE_ alone could be either: it is no call of one
    let text =
        "&MACRO LINE_PAIR N\n&TYPE %N\n&ENDMACRO\n&MACRO LINE_END\n&TYPE x\n&ENDMACRO\nline_p 1\nLINE_\nLINE_PAIR 2\n";
    let uri = file(path, "m.cif", text);
    let mut client = Client::new(path);
    client.open(&uri, text);
    client.diagnostics(&uri);
    let edit = |line, start, end| json!({"range": {"start": at(line, start), "end": at(line, end)}, "newText": "PAIR"});
    for at_call in [at(0, 9), at(6, 2), at(8, 9)] {
        let params = json!({"textDocument": {"uri": uri}, "position": at_call, "newName": "PAIR"});
        let edits = client.request("textDocument/rename", params)["result"]["changes"].take();
        assert_eq!(edits[&uri], json!([edit(0, 7, 16), edit(6, 0, 6), edit(8, 0, 9)]));
    }
    assert_eq!(client.ask("definition", &uri, at(6, 1))["range"]["start"], at(0, 7));
    assert_eq!(client.leave(), Some(0));
}

#[test]
fn names_that_would_change_the_run_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let text = "MEDIT\n&DESCRIBE BODY B\n*CG 0 0 0\n~W B_CAT 100 -LEN 300 -WTPLEN 1\nCONNECTOR LA -ANC 0 250 ~W *CG\nEND\n\
                &CONNECTOR L@ -INACTIVE\n&MACRO LEG A\n&TYPE %A%\n&ENDMACRO\nLEG 1\n";
    let uri = file(path, "m.cif", text);
    let mut client = Client::new(path);
    client.open(&uri, text);
    client.diagnostics(&uri);
    let mut rename = |line: u32, character: u32, name: &str| {
        let params =
            json!({"textDocument": {"uri": uri}, "position": at(line.into(), character.into()), "newName": name});
        client.request("textDocument/rename", params)
    };
    let said = rename(4, 11, "FORE")["error"]["message"].as_str().unwrap().to_string();
    assert!(said.contains("the pattern L@") && said.contains("LA and FORE"), "{said}");
    // another name that the pattern matches too
    assert_eq!(rename(4, 11, "LB")["result"]["changes"][&uri].as_array().unwrap().len(), 1);
    for (name, command) in [("TDOM", "TDOM"), ("medit", "MEDIT"), ("&SET", "")] {
        let answer = rename(7, 8, name);
        let said = answer["error"]["message"].as_str().unwrap_or_else(|| panic!("{answer}"));
        assert!(command.is_empty() || said.contains(&format!("the command {command}")), "{said}");
    }
    assert_eq!(rename(7, 8, "ARM")["result"]["changes"][&uri].as_array().unwrap().len(), 2);
    assert_eq!(client.leave(), Some(0));
}

#[test]
fn layout_is_an_edit_and_decks_have_none() {
    let folder = tempfile::tempdir().unwrap();
    let mut client = Client::new(folder.path());
    client.open("untitled:a", "END\n&LOOP I 1 2\n*A  1 2\n&ENDLOOP\nEND\n");
    let edits = client.ask("formatting", "untitled:a", at(0, 0));
    assert_eq!(edits, json!([{"range": {"start": at(2, 0), "end": at(3, 0)}, "newText": "  *A 1 2\n"}]));
    client.open("untitled:b", "END\n");
    assert_eq!(client.ask("formatting", "untitled:b", at(0, 0)), json!([]));
    client.open("untitled:d", "JOB TEST  NAUT  TIME\nTITLE   a   b\n");
    assert_eq!(client.ask("formatting", "untitled:d", at(0, 0)), Value::Null);
    client.open("untitled:y.yml", "General:\n  UnitsSystem:   SI\n");
    assert_eq!(client.ask("formatting", "untitled:y.yml", at(0, 0)), Value::Null);
    assert_eq!(client.leave(), Some(0));
}

#[test]
fn cards_of_a_deck_are_named_by_deck_and_columns() {
    let folder = tempfile::tempdir().unwrap();
    let shipped = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("scripts/he01.dat")).unwrap();
    // the x of node 2 has a letter in it, on line 6
    let wrong = shipped.replace("    01   2               1.053", "    01   2               1.o53");
    assert_ne!(wrong, shipped);
    let uri = file(folder.path(), "he01.dat", &shipped);
    let mut client = Client::new(folder.path());
    client.open(&uri, &shipped);
    assert_eq!(client.said(&uri), []);
    client.change(&uri, 2, &wrong);
    let said = client.said(&uri);
    let (line, start, end, message) = said.first().unwrap();
    assert_eq!((*line, *start, *end), (5, 25, 30), "{said:?}");
    assert_eq!(message, "deck 1 COOR, columns 21-30: `1.o53` is not a number");
    assert_eq!(client.leave(), Some(0));
}

#[test]
fn strangers_file_reads_below_its_folder_and_writes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let (inside, outside) = (folder.path().join("inside"), folder.path().join("outside"));
    std::fs::create_dir(&inside).unwrap();
    std::fs::create_dir(&outside).unwrap();
    std::fs::write(outside.join("secret.txt"), "&TITEL secret\n").unwrap();
    let text = "&INSERT ../outside/secret.txt\n&INSERT link.txt\n&FILE MKDIR made\n&FILE RM own.txt\nMEDIT\n&DESCRIBE BODY B\n*P 0 0 0\nEND\n\
                &EQUI\nPRCPOST\nEND\n&TYPE &F_READ(../outside/secret.txt X)\n&INSERT ../outs\nINMODEL -MOORDYN ../outside/secrets.txt\n";
    let uri = file(&inside, "m.cif", text);
    std::fs::write(inside.join("own.txt"), "own\n").unwrap();
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("../outside/secret.txt", inside.join("link.txt")).unwrap();
        std::os::unix::fs::symlink("../outside/secret.txt", inside.join("m.dat")).unwrap();
    }
    let names = || {
        let mut list: Vec<_> = std::fs::read_dir(&inside).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        list.sort();
        list
    };
    let before = names();
    let mut client = Client::new(&inside);
    client.open(&uri, text);
    let said = client.diagnostics(&uri);
    assert!(!said.to_string().contains("TITEL"), "nothing of a file outside is shown: {said}");
    assert!(listed(&said).iter().any(|one| one.0 == 0 && one.3.contains("outside of the script's folder")), "{said}");
    #[cfg(unix)]
    assert!(listed(&said).iter().any(|one| one.0 == 1 && one.3.contains("outside of the script's folder")), "{said}");
    // a file that is not there is named no other way, and no name beside it is offered
    assert!(listed(&said).iter().any(|one| one.0 == 13 && one.3.contains("outside of the script's folder")), "{said}");
    assert!(!said.to_string().contains("did you mean"), "{said}");
    assert_eq!(client.ask("completion", &uri, at(12, 15))["items"], json!([]));
    // the link that leads out is no model of the pair either
    client.change(&uri, 2, "INMODEL\nEND\n");
    assert!(!client.diagnostics(&uri).to_string().contains("TITEL"));
    assert_eq!(client.leave(), Some(0));
    assert_eq!(names(), before);
    assert_eq!(std::fs::read_to_string(inside.join("own.txt")).unwrap(), "own\n");
}

#[test]
fn malformed_messages_are_answered_and_the_server_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let mut client = Client::silent(folder.path());
    assert_eq!(client.request("textDocument/hover", json!({}))["error"]["code"], -32002, "initialize comes first");
    client.write("{\"jsonrpc\": ");
    assert_eq!(client.read()["error"]["code"], -32700);
    client.write("[]");
    assert_eq!(client.read()["error"]["code"], -32600);
    client.to.write_all(b"nonsense\r\n\r\n").unwrap();
    assert_eq!(client.read()["error"]["code"], -32700);
    client.request("initialize", json!({"capabilities": {}}));
    assert_eq!(client.request("initialize", json!({}))["error"]["code"], -32600);
    assert_eq!(client.request("textDocument/nothing", json!({}))["error"]["code"], -32601);
    assert_eq!(client.request("textDocument/hover", json!({"textDocument": 3}))["error"]["code"], -32602);
    let unopened = json!({"textDocument": {"uri": "file:///none.cif"}, "position": at(0, 0)});
    assert_eq!(client.request("textDocument/hover", unopened)["error"]["code"], -32602);
    client.notify("textDocument/didOpen", json!({"textDocument": "x"}));
    client.notify("textDocument/didChange", json!(null));
    client.notify("$/setTrace", json!({"value": "off"}));
    client.open("untitled:a", "MEDIT\n*P 1 2 x\nEND\n");
    assert_eq!(client.said("untitled:a").len(), 1);
    let far = json!({"textDocument": {"uri": "untitled:a"}, "position": at(u64::MAX, u64::MAX)});
    assert_eq!(client.request("textDocument/hover", far)["result"], Value::Null);
    assert_eq!(client.request("shutdown", Value::Null)["result"], Value::Null);
    assert_eq!(
        client.request("textDocument/hover", json!({}))["error"]["code"],
        -32600,
        "nothing comes after shutdown"
    );
    client.notify("exit", Value::Null);
    assert_eq!(client.server.wait().unwrap().code(), Some(0));
    // a client that breaks off
    let mut rude = Client::new(folder.path());
    rude.notify("exit", Value::Null);
    assert_eq!(rude.server.wait().unwrap().code(), Some(1));
    let mut gone = Client::new(folder.path());
    gone.to.write_all(b"Content-Length: 999\r\n\r\n{").unwrap();
    drop(gone.to);
    assert_eq!(gone.server.wait().unwrap().code(), Some(1));
}

#[test]
fn last_version_is_checked_and_earlier_ones_are_not_taken() {
    let folder = tempfile::tempdir().unwrap();
    let mut client = Client::new(folder.path());
    client.open("untitled:a", "&TITEL a\n");
    for version in 2..200 {
        client.change("untitled:a", version, &format!("{}&TITEL a\n", "\n".repeat(usize::try_from(version).unwrap())));
    }
    // an older version that comes late
    client.change("untitled:a", 7, "&TITLE old\n");
    loop {
        let published = client.diagnostics("untitled:a");
        let version = published["version"].as_u64().unwrap();
        let lines: Vec<u64> = listed(&published).iter().map(|one| one.0).collect();
        assert_eq!(lines, [if version == 1 { 0 } else { version }], "what is said is said of its version");
        if version == 199 {
            break;
        }
    }
    assert_eq!(client.leave(), Some(0));
}

#[test]
fn every_request_is_answered_once_also_when_cancelled() {
    let folder = tempfile::tempdir().unwrap();
    let mut client = Client::new(folder.path());
    client.open("untitled:a", &"*P 1 2 3\n".repeat(2000));
    let mut batch = String::new();
    let mut push = |message: Value| {
        let body = message.to_string();
        batch.push_str(&format!("Content-Length: {}\r\n\r\n{body}", body.len()));
    };
    let params = json!({"textDocument": {"uri": "untitled:a"}, "position": at(1999, 1)});
    for id in 100..140 {
        push(json!({"jsonrpc": "2.0", "id": id, "method": "textDocument/references", "params": params}));
    }
    for id in 101..140 {
        push(json!({"jsonrpc": "2.0", "method": "$/cancelRequest", "params": {"id": id}}));
    }
    push(json!({"jsonrpc": "2.0", "method": "$/cancelRequest", "params": {"id": 7777}}));
    client.to.write_all(batch.as_bytes()).unwrap();
    client.to.flush().unwrap();
    let mut answered = Vec::new();
    while answered.len() < 40 {
        let message = client.read();
        if let Some(id) = message["id"].as_i64() {
            let is_good = message["result"].is_array() || message["error"]["code"] == -32800;
            assert!(is_good, "{message}");
            answered.push(id);
        }
    }
    answered.sort_unstable();
    assert_eq!(answered, (100..140).collect::<Vec<i64>>());
    assert_eq!(client.leave(), Some(0));
}

#[test]
fn huge_text_is_not_checked_and_long_ones_come_to_an_end() {
    let folder = tempfile::tempdir().unwrap();
    let mut client = Client::new(folder.path());
    client.open("untitled:huge", &"$ nothing\n".repeat(900_000));
    let said = client.said("untitled:huge");
    assert_eq!((said.len(), said[0].3.contains("is not checked as one types")), (1, true), "{said:?}");
    assert_eq!(client.ask("hover", "untitled:huge", at(3, 3)), Value::Null);
    // a loop without an end, and errors without number
    client.open("untitled:loop", "&LOOP\n&TITLE a\n&ENDLOOP\n&TITEL b\n");
    let said = client.said("untitled:loop");
    assert!(said.iter().any(|one| one.3.contains("what follows is not checked")), "{said:?}");
    client.open("untitled:errors", &"&TITEL b\n".repeat(5000));
    let said = client.said("untitled:errors");
    assert!(said.len() <= 201 && said.last().unwrap().3.contains("more messages"), "{}", said.len());
    assert_eq!(client.leave(), Some(0));
}
