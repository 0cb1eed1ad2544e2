// The extension in an editor of our own: what it registers, starts, restarts and refuses.

import assert from "node:assert/strict";
import fs from "node:fs/promises";
import Module, { createRequire } from "node:module";
import os from "node:os";
import path from "node:path";
import test from "node:test";

const require = createRequire(import.meta.url);
const manifest = require("../package.json");

/** An editor with one script in front: it remembers what it is asked for. */
function editor({ isTrusted = true, script = "/tmp/my.dolphin", settings = {}, languageId = "dolphin" } = {}) {
  const seen = { commands: {}, servers: [], tasks: [], warnings: [], errors: [], pages: [], listeners: [] };
  const vscode = {
    TaskScope: { Workspace: 2 },
    TaskRevealKind: { Always: 1 },
    ViewColumn: { Beside: -2 },
    Uri: { file: (fsPath) => ({ fsPath, scheme: "file" }) },
    ProcessExecution: class {
      constructor(program, args, options) {
        Object.assign(this, { program, args, options });
      }
    },
    Task: class {
      constructor(definition, scope, name, source, execution) {
        Object.assign(this, { definition, scope, name, source, execution });
      }
    },
    commands: {
      registerCommand: (name, action) => {
        seen.commands[name] = action;
        return { dispose() {} };
      },
    },
    tasks: { executeTask: async (task) => seen.tasks.push(task) },
    window: {
      activeTextEditor: { document: { languageId, uri: { scheme: "file", fsPath: script }, isDirty: false, save: async () => true } },
      showWarningMessage: (words) => seen.warnings.push(words),
      showErrorMessage: (words) => seen.errors.push(words),
      showInputBox: async ({ value, validateInput }) => (validateInput(value) ? undefined : value),
      createWebviewPanel: () => {
        const panel = { webview: {}, onDidDispose() {}, reveal() {} };
        seen.pages.push(panel);
        return panel;
      },
    },
    workspace: {
      isTrusted,
      getConfiguration: () => ({ get: (name, fallback) => settings[name] ?? fallback }),
      getWorkspaceFolder: () => undefined,
      onDidChangeConfiguration: (listener) => {
        seen.listeners.push(listener);
        return { dispose() {} };
      },
    },
  };
  class LanguageClient {
    constructor(id, name, server) {
      Object.assign(this, { id, server, isRunning: false });
      seen.servers.push(this);
    }
    async start() {
      if (this.server.command === "nowhere") throw new Error("ENOENT");
      this.isRunning = true;
    }
    async stop() {
      this.isRunning = false;
    }
  }
  return { vscode, seen, settings, LanguageClient };
}

let aroundNow;
const load = Module._load;
Module._load = function (name, ...rest) {
  if (name === "vscode") return aroundNow.vscode;
  if (name === "vscode-languageclient/node") return { LanguageClient: aroundNow.LanguageClient };
  return load.call(this, name, ...rest);
};

/** The extension, loaded into that editor. */
async function activated(around) {
  aroundNow = around;
  const file = require.resolve("../extension.js");
  delete require.cache[file];
  const extension = require(file);
  const context = { subscriptions: [] };
  await extension.activate(context);
  return { extension, context };
}

test("every command of the manifest is there, and no other", async () => {
  const around = editor();
  await activated(around);
  const named = manifest.contributes.commands.map((one) => one.command).sort();
  assert.deepEqual(Object.keys(around.seen.commands).sort(), named);
  for (const menu of Object.values(manifest.contributes.menus).flat()) assert.ok(named.includes(menu.command), menu.command);
});

test("the server is started with lapwing.path, and again when that changes", async () => {
  const around = editor({ settings: { path: "/opt/lapwing" } });
  const { extension } = await activated(around);
  assert.deepEqual(around.seen.servers[0].server, { command: "/opt/lapwing", args: ["lsp"] });
  assert.equal(around.seen.servers[0].id, "lapwing", "lapwing.trace.server is read by this name");
  around.settings.path = "/usr/bin/lapwing";
  await around.seen.listeners[0]({ affectsConfiguration: (name) => name === "editor.tabSize" });
  assert.equal(around.seen.servers.length, 1, "other settings leave it alone");
  await around.seen.listeners[0]({ affectsConfiguration: (name) => name === "lapwing.path" });
  assert.deepEqual(around.seen.servers.map((one) => one.isRunning), [false, true]);
  assert.equal(around.seen.servers[1].server.command, "/usr/bin/lapwing");
  await Promise.all([around.seen.commands["lapwing.restartServer"](), around.seen.commands["lapwing.restartServer"]()]);
  assert.equal(around.seen.servers.filter((one) => one.isRunning).length, 1, "one server, however often it is restarted");
  await extension.deactivate();
  assert.ok(around.seen.servers.every((one) => !one.isRunning));
});

test("a program that is not there is told, and a right path mends it", async () => {
  const around = editor({ settings: { path: "nowhere" } });
  await activated(around);
  assert.match(around.seen.errors[0], /nowhere lsp.*lapwing\.path/);
  around.settings.path = "/opt/lapwing";
  await around.seen.listeners[0]({ affectsConfiguration: () => true });
  assert.ok(around.seen.servers[1].isRunning);
});

test("check and run start the program with the script in front", async () => {
  const around = editor({ settings: { simulatedVehicles: "copter:2" } });
  await activated(around);
  await around.seen.commands["lapwing.check"]();
  await around.seen.commands["lapwing.run"]();
  assert.deepEqual(around.seen.tasks.map((task) => [task.execution.program, ...task.execution.args]), [
    ["lapwing", "check", "/tmp/my.dolphin"],
    ["lapwing", "run", "/tmp/my.dolphin", "--sim", "copter:2"],
  ]);
  assert.equal(around.seen.tasks[0].definition.type, manifest.contributes.taskDefinitions[0].type);
});

test("nothing is run in a workspace that is not trusted, nor of another language", async () => {
  for (const odd of [{ isTrusted: false }, { languageId: "python" }]) {
    const around = editor(odd);
    await activated(around);
    for (const name of ["check", "plan", "run"]) await around.seen.commands[`lapwing.${name}`]();
    assert.equal(around.seen.tasks.length + around.seen.pages.length, 0);
    assert.equal(around.seen.warnings.length, 3);
  }
});

test("a workspace cannot name the program", () => {
  assert.equal(manifest.contributes.configuration.properties["lapwing.path"].scope, "machine");
  assert.equal(manifest.capabilities.untrustedWorkspaces.supported, "limited");
  assert.ok(manifest.capabilities.untrustedWorkspaces.restrictedConfigurations.includes("lapwing.path"));
});

test("a dry run is shown with its picture, which runs no code", async () => {
  const folder = await fs.mkdtemp(path.join(os.tmpdir(), "lapwing-test-"));
  const program = path.join(folder, "lapwing");
  await fs.writeFile(program, `#!/bin/sh\necho "my.dolphin: done <fast>"\necho "<svg/>" > "$4"\nexit 3\n`, { mode: 0o755 });
  const around = editor({ script: path.join(folder, "my.dolphin"), settings: { path: program } });
  await activated(around);
  await around.seen.commands["lapwing.plan"]();
  await around.seen.commands["lapwing.plan"]();
  assert.equal(around.seen.pages.length, 1, "one page, used again");
  const page = around.seen.pages[0].webview.html;
  assert.ok(page.includes("done &lt;fast&gt;"));
  assert.ok(page.includes(Buffer.from("<svg/>\n").toString("base64")));
  assert.match(page, /default-src 'none'/);
  await fs.rm(folder, { recursive: true });
});

test("vehicles are written as the program reads them", () => {
  const { wrongVehicles } = require("../lapwing.js");
  for (const good of ["copter:1", "copter:2,px4:1", "rover:1@40%"]) assert.equal(wrongVehicles(good), undefined, good);
  for (const bad of ["", "copter", "copter:0", "drone:1", "copter:1;rm", "copter:1 --link x"]) assert.ok(wrongVehicles(bad), bad);
});

test("what a package needs is there", async () => {
  const here = new URL("../", import.meta.url);
  for (const name of ["README.md", "LICENSE", manifest.icon, ".vscodeignore"]) assert.ok((await fs.stat(new URL(name, here))).size > 0, name);
  const icon = await fs.readFile(new URL(manifest.icon, here));
  assert.equal(icon.subarray(1, 4).toString(), "PNG");
  assert.ok(icon.readUInt32BE(16) >= 128 && icon.readUInt32BE(20) >= 128, "at least 128 pixels wide and high");
  assert.equal(await fs.readFile(new URL("LICENSE", here), "utf8"), await fs.readFile(new URL("../../LICENSE", here), "utf8"));
  assert.doesNotMatch(await fs.readFile(new URL("README.md", here), "utf8"), /\]\((?!https:)/, "links of a package lead outside");
});

test("lines that end a comment, and regions, are known", () => {
  const { folding, onEnterRules } = require("../language-configuration.json");
  assert.match("  // region Pads", new RegExp(folding.markers.start));
  assert.match("// #endregion", new RegExp(folding.markers.end));
  const first = (before, after = "") => {
    const fits = (rule) => new RegExp(rule.beforeText).test(before) && (!rule.afterText || new RegExp(rule.afterText).test(after));
    return onEnterRules.find((rule) => !rule.previousLineText && fits(rule))?.action.appendText;
  };
  assert.equal(first("/* long"), " * ");
  assert.equal(first("// a comment that ", "is broken"), "// ");
  assert.equal(first("// a comment"), undefined, "at its end a comment is over");
  assert.equal(first("x = 1 /* done */"), undefined);
});
