// The extension starts `windlass lsp` for scripts, and runs a script in a terminal where the user says so.
"use strict";

const vscode = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

let client;
let starting = false;

// While the server starts, start() alone shows why it cannot.
class Client extends LanguageClient {
  error(message, data, show) {
    super.error(message, data, starting ? false : show);
  }
}

function program() {
  return vscode.workspace.getConfiguration("windlass").get("path") || "windlass";
}

async function start() {
  const server = { command: program(), args: ["lsp"] };
  const options = { documentSelector: [{ language: "windlass" }], initializationFailedHandler: () => false };
  client = new Client("windlass", "windlass", server, options);
  starting = true;
  try {
    await client.start();
  } catch (error) {
    const reason = String(error?.message ?? error).replace(/\.?$/, ".");
    vscode.window.showErrorMessage(`windlass lsp cannot be started (${program()}): ${reason} The setting windlass.path names the program.`);
  } finally {
    starting = false;
  }
}

// A task with the words apart: no shell reads the name of the file.
async function run() {
  const editor = vscode.window.activeTextEditor;
  if (!editor || editor.document.languageId !== "windlass") return;
  if (!vscode.workspace.isTrusted) {
    vscode.window.showWarningMessage("A script writes files: it is run in a trusted folder alone.");
    return;
  }
  if (editor.document.isUntitled || (editor.document.isDirty && !(await editor.document.save()))) {
    vscode.window.showWarningMessage("Save the script first.");
    return;
  }
  const file = editor.document.uri.fsPath;
  const folder = vscode.workspace.getWorkspaceFolder(editor.document.uri);
  const name = require("path").basename(file);
  const execution = new vscode.ProcessExecution(program(), ["run", file], { cwd: require("path").dirname(file) });
  const task = new vscode.Task({ type: "windlass", file }, folder || vscode.TaskScope.Workspace, name, "windlass", execution);
  await vscode.tasks.executeTask(task);
}

exports.activate = async (context) => {
  context.subscriptions.push(
    vscode.commands.registerCommand("windlass.run", run),
    vscode.commands.registerCommand("windlass.restart", async () => {
      if (client) await client.stop().catch(() => {});
      await start();
    }),
  );
  await start();
};

exports.deactivate = () => (client ? client.stop() : undefined);
