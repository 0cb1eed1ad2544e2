// Starts `lapwing lsp` for open mission scripts. Without vscode-languageclient highlighting and snippets remain.
"use strict";

const vscode = require("vscode");

let client;

function languageClient() {
  try {
    return require("vscode-languageclient/node").LanguageClient;
  } catch {
    return undefined;
  }
}

async function activate() {
  const LanguageClient = languageClient();
  if (!LanguageClient) {
    vscode.window.showWarningMessage("Lapwing: run `npm install` in the extension's folder for diagnostics and completion.");
    return;
  }
  const command = vscode.workspace.getConfiguration("lapwing").get("path", "lapwing");
  const server = { command, args: ["lsp"] };
  client = new LanguageClient("lapwing", "Lapwing", server, { documentSelector: [{ language: "dolphin" }] });
  try {
    await client.start();
  } catch (error) {
    vscode.window.showErrorMessage(`Lapwing: cannot start '${command} lsp' (${error.message}). Set lapwing.path to the program.`);
  }
}

function deactivate() {
  return client?.stop();
}

module.exports = { activate, deactivate };
