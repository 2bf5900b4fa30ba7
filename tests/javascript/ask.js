// node ask.js MODULE.js MODULE.wasm.gz REQUESTS.json
//
// Asks the module of pages what stands in a list of requests, one after another, and prints the
// list of answers. Bytes of a request are those of the file that it names with `$bytes`, or of the text `$text`;
// columns of answers are lists.
"use strict";
const fs = require("node:fs");
const vm = require("node:vm");
const zlib = require("node:zlib");

const [source, packed, list] = process.argv.slice(2);
const explorerOf = vm.runInThisContext(`${fs.readFileSync(source, "utf8")};explorerOf`);
const ask = explorerOf(new WebAssembly.Module(zlib.gunzipSync(fs.readFileSync(packed))));
const answers = JSON.parse(fs.readFileSync(list, "utf8")).map(({ $bytes, $text, ...request }) => {
  const bytes = $bytes === undefined ? Buffer.from($text || "") : fs.readFileSync($bytes);
  const answer = ask(request, new Uint8Array(bytes));
  const columns = Object.entries(answer.columns).map(([name, values]) => [name, [...values]]);
  return { ...answer, columns: Object.fromEntries(columns) };
});
process.stdout.write(JSON.stringify(answers));
