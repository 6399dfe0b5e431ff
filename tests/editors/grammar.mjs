// The colours of a script by vscode-textmate, the engine of VS Code: node tests/editors/grammar.mjs MODULES, the folder of vscode-textmate and
// vscode-oniguruma.
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const require = createRequire(join(process.argv[2], "package.json"));
const textmate = require("vscode-textmate");
const oniguruma = require("vscode-oniguruma");
const root = join(dirname(fileURLToPath(import.meta.url)), "../..");
const wasm = readFileSync(require.resolve("vscode-oniguruma/release/onig.wasm"));
await oniguruma.loadWASM(wasm.buffer.slice(wasm.byteOffset, wasm.byteOffset + wasm.byteLength));
const registry = new textmate.Registry({
  onigLib: Promise.resolve({
    createOnigScanner: (sources) => new oniguruma.OnigScanner(sources),
    createOnigString: (text) => new oniguruma.OnigString(text),
  }),
  loadGrammar: async () =>
    textmate.parseRawGrammar(readFileSync(join(root, "editors/vscode/syntaxes/windlass.tmLanguage.json"), "utf8"), "windlass.json"),
});
const grammar = await registry.loadGrammar("source.windlass");

// a line, and a word of it with the scope it must have, or none
const cases = [
  ["$ a comment", "$ a comment", "comment.line.dollar"],
  ["&EQUI $ rest", "$ rest", "comment.line.dollar"],
  ["COST$5", "COST$5", undefined],
  ["&EQUI", "&EQUI", "keyword.other.command"],
  ["&equi -ITER_MAX 50", "&equi", "keyword.other.command"],
  ["&equi -ITER_MAX 50", "-ITER_MAX", "entity.other.attribute-name"],
  ["&equi -ITER_MAX 50", "50", "constant.numeric"],
  ["  &IF %LOST% .NE. NONE &THEN", "&IF", "keyword.control"],
  ["  &IF %LOST% .NE. NONE &THEN", "%LOST%", "variable.other"],
  ["TDOM -EQUI -STORE 2", "TDOM", "keyword.other.command"],
  ["TDOM -EQUI -STORE 2", "-STORE", "entity.other.attribute-name"],
  ["TDOM -NO_SUCH 2", "-NO_SUCH", undefined],
  ["NO_SUCH_RECORD 1", "NO_SUCH_RECORD", undefined],
  ["INMO", "INMO", "keyword.other.command"],
  ["END_&SURFACE", "END_&SURFACE", "keyword.other.command"],
  ["~CHAIN B_CAT -TYPE CHAIN_R4 100 -LEN 1.2E3", "~CHAIN", "entity.name.type.class"],
  ["~CHAIN B_CAT -TYPE CHAIN_R4 100 -LEN 1.2E3", "B_CAT", "support.type.class"],
  ["~CHAIN B_CAT -TYPE CHAIN_R4 100 -LEN 1.2E3", "1.2E3", "constant.numeric"],
  ["~CHAIN B_CAT -TYPE CHAIN_R4 100 -LEN 1.2E3", "CHAIN_R4", undefined],
  ["CONNECTOR L1 ~CHAIN *F1 -ANC -45 1114.4", "*F1", "entity.name.tag.point"],
  ["CONNECTOR L1 ~CHAIN *F1 -ANC -45 1114.4", "-45", "constant.numeric"],
  ["#WEIGHT *CG 319600 32", "#WEIGHT", "storage.type.load"],
  ["&TITLE 'it is $ here'", "'it is $ here'", "string.quoted.single"],
  ["&SET X = &NUMBER(REAL 2*3)", "&NUMBER", "support.function"],
  ["&ENV -DEPTH 300 \\", "\\", "constant.character.escape.continuation"],
];
let wrong = 0;
for (const [line, word, scope] of cases) {
  const at = line.indexOf(word);
  const token = grammar.tokenizeLine(line, textmate.INITIAL).tokens.find((token) => token.startIndex <= at && at < token.endIndex);
  const found = token.scopes.slice(1).pop();
  const whole = line.slice(token.startIndex, token.endIndex);
  const fits = scope === undefined ? found === undefined : found === `${scope}.windlass` && whole.trim() === word;
  if (!fits) {
    wrong += 1;
    console.log(`${line}: ${word} is \`${whole}\` with ${found}, not ${scope}`);
  }
}
// no line of a shipped script takes long, and each record of it that begins with & or a command has its colour
for (const name of ["scripts/study/semi.cif", "scripts/study/storm.cif", "scripts/moored.cif"]) {
  let state = textmate.INITIAL;
  for (const line of readFileSync(join(root, name), "utf8").split("\n")) {
    const made = grammar.tokenizeLine(line, state, 1000);
    if (made.stoppedEarly) { wrong += 1; console.log(`${name}: ${line} takes more than a second`); }
    const first = made.tokens.find((token) => line.slice(token.startIndex, token.endIndex).trim() !== "");
    if (/^\s*&[A-Z]/.test(line) && !/keyword/.test(first.scopes.at(-1))) {
      wrong += 1;
      console.log(`${name}: ${line} begins with ${first.scopes.at(-1)}`);
    }
    state = made.ruleStack;
  }
}
console.log(`${cases.length} words, ${wrong} wrong`);
process.exit(wrong > 0 ? 1 : 0);
