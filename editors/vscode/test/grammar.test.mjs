// The grammar read by the engine that editors use: each word of sample.dolphin with its innermost scope, compared with
// sample.scopes. To accept new scopes: LAPWING_REFRESH_GOLDEN=1 npm test, and read the diff.

import assert from "node:assert/strict";
import fs from "node:fs/promises";
import { createRequire } from "node:module";
import test from "node:test";

const require = createRequire(import.meta.url);
const oniguruma = require("vscode-oniguruma");
const textmate = require("vscode-textmate");
const here = new URL("./", import.meta.url);

async function loadGrammar() {
  const wasm = await fs.readFile(require.resolve("vscode-oniguruma/release/onig.wasm"));
  await oniguruma.loadWASM(wasm);
  const registry = new textmate.Registry({
    onigLib: Promise.resolve({
      createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
      createOnigString: (text) => new oniguruma.OnigString(text),
    }),
    loadGrammar: async () => {
      const path = new URL("../syntaxes/dolphin.tmLanguage.json", here);
      return textmate.parseRawGrammar(await fs.readFile(path, "utf8"), path.pathname);
    },
  });
  return registry.loadGrammar("source.dolphin");
}

function scopesOf(grammar, text) {
  const out = [];
  let state = textmate.INITIAL;
  for (const line of text.trimEnd().split("\n")) {
    out.push(`> ${line}`);
    const result = grammar.tokenizeLine(line, state);
    state = result.ruleStack;
    for (const token of result.tokens) {
      const word = line.slice(token.startIndex, token.endIndex).trim();
      if (word) out.push(`${word}\t${token.scopes.at(-1)}`);
    }
  }
  return `${out.join("\n")}\n`;
}

test("every word of the sample has its scope", async () => {
  const grammar = await loadGrammar();
  const actual = scopesOf(grammar, await fs.readFile(new URL("sample.dolphin", here), "utf8"));
  const golden = new URL("sample.scopes", here);
  if (process.env.LAPWING_REFRESH_GOLDEN) await fs.writeFile(golden, actual);
  assert.equal(actual, await fs.readFile(golden, "utf8"));
});

test("snippets and configuration are JSON that the manifest names", async () => {
  const manifest = JSON.parse(await fs.readFile(new URL("../package.json", here), "utf8"));
  const { languages, grammars, snippets } = manifest.contributes;
  for (const path of [languages[0].configuration, grammars[0].path, snippets[0].path]) {
    assert.ok(JSON.parse(await fs.readFile(new URL(`../${path}`, here), "utf8")));
  }
});
