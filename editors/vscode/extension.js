// Starts `lapwing lsp` for open mission scripts, and offers to check, plan and run them. Without vscode-languageclient
// highlighting, snippets and the commands remain.
"use strict";

const { execFile } = require("node:child_process");
const fs = require("node:fs/promises");
const os = require("node:os");
const path = require("node:path");
const vscode = require("vscode");
const { jobs, wrongVehicles, planPage } = require("./lapwing");

let client;
let planPanel;

const setting = (name, fallback) => vscode.workspace.getConfiguration("lapwing").get(name, fallback);
const program = () => setting("path", "lapwing") || "lapwing";

// ---- the language server

function languageClient() {
  try {
    return require("vscode-languageclient/node").LanguageClient;
  } catch {
    return undefined;
  }
}

async function start() {
  const LanguageClient = languageClient();
  if (!LanguageClient) {
    vscode.window.showWarningMessage("Lapwing: run `npm install` in the extension's folder for diagnostics and completion.");
    return;
  }
  const command = program();
  client = new LanguageClient("lapwing", "Lapwing", { command, args: ["lsp"] }, { documentSelector: [{ language: "dolphin" }] });
  try {
    await client.start();
  } catch (error) {
    client = undefined;
    vscode.window.showErrorMessage(`Lapwing: cannot start '${command} lsp' (${error.message}). Set lapwing.path to the program.`);
  }
}

async function stop() {
  const running = client;
  client = undefined;
  if (running) await running.stop();
}

/** One after the other, however often it is asked for. */
let restarting = Promise.resolve();
function restart() {
  restarting = restarting.then(stop).then(start);
  return restarting;
}

// ---- commands

/** The script in front, saved; undefined, with a word about it, when there is none or this folder is not trusted. */
async function scriptInFront() {
  if (!vscode.workspace.isTrusted) {
    vscode.window.showWarningMessage("Lapwing: trust this workspace to check, plan and run its scripts.");
    return undefined;
  }
  const document = vscode.window.activeTextEditor?.document;
  if (document?.languageId !== "dolphin" || document.uri.scheme !== "file") {
    vscode.window.showWarningMessage("Lapwing: open a mission script (a .dolphin file) first.");
    return undefined;
  }
  if (document.isDirty && !(await document.save())) return undefined;
  return document.uri.fsPath;
}

/** In a terminal that stays when the program has ended. */
function inTerminal(name, script, args) {
  const folder = vscode.workspace.getWorkspaceFolder(vscode.Uri.file(script)) ?? vscode.TaskScope.Workspace;
  const execution = new vscode.ProcessExecution(program(), args, { cwd: path.dirname(script) });
  const task = new vscode.Task({ type: "lapwing", job: args[0] }, folder, name, "lapwing", execution);
  task.presentationOptions = { reveal: vscode.TaskRevealKind.Always, clear: true };
  return vscode.tasks.executeTask(task);
}

async function check() {
  const script = await scriptInFront();
  if (script) await inTerminal("check", script, jobs.check(script));
}

async function run() {
  const script = await scriptInFront();
  if (!script) return;
  const vehicles = await vscode.window.showInputBox({
    prompt: "Simulated vehicles",
    value: setting("simulatedVehicles", "copter:1"),
    validateInput: wrongVehicles,
  });
  if (vehicles) await inTerminal("run on simulator", script, jobs.run(script, vehicles));
}

/** Exit codes 1 and 3 are about the flight: there is a picture all the same. */
async function plan() {
  const script = await scriptInFront();
  if (!script) return;
  const folder = await fs.mkdtemp(path.join(os.tmpdir(), "lapwing-"));
  try {
    const picture = path.join(folder, "plan.svg");
    const words = await new Promise((resolve) => {
      execFile(program(), jobs.plan(script, picture), { cwd: path.dirname(script) }, (error, out, err) =>
        resolve(out + err || (error ? `cannot start '${program()}': ${error.message}` : "")));
    });
    const drawn = await fs.readFile(picture).catch(() => undefined);
    if (!planPanel) {
      planPanel = vscode.window.createWebviewPanel("lapwing.plan", "Lapwing: dry run", vscode.ViewColumn.Beside, {});
      planPanel.onDidDispose(() => (planPanel = undefined));
    }
    planPanel.webview.html = planPage(drawn, words);
    planPanel.reveal(undefined, true);
  } finally {
    await fs.rm(folder, { recursive: true, force: true });
  }
}

// ---- life

async function activate(context) {
  const commands = { check, plan, run, restartServer: restart };
  for (const [name, action] of Object.entries(commands)) {
    context.subscriptions.push(vscode.commands.registerCommand(`lapwing.${name}`, action));
  }
  context.subscriptions.push(
    vscode.workspace.onDidChangeConfiguration((change) => {
      if (change.affectsConfiguration("lapwing.path")) return restart();
    }),
  );
  await restart();
}

function deactivate() {
  return restarting.then(stop);
}

module.exports = { activate, deactivate };
