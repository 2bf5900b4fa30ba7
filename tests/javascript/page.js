// What a page that `pounding explore` wrote holds, for programs of Node.
"use strict";
const fs = require("node:fs");
const zlib = require("node:zlib");

// Makes instances of the solver of a page: each is asked as its workers ask theirs.
const solversOf = (file) => {
  const [, text] = /<script type="application\/json" id="data">(.*?)<\/script>/s.exec(fs.readFileSync(file, "utf8"));
  const { module, worker } = JSON.parse(text);
  const compiled = new WebAssembly.Module(zlib.gunzipSync(Buffer.from(module, "base64")));
  // The script holds the state of one instance: another instance is another evaluation of it. It
  // sets what a worker does with a message, which is nothing here.
  const evaluate = new Function("onmessage", `${worker};return explorerOf;`);
  return () => evaluate()(compiled);
};
module.exports = { solversOf };
