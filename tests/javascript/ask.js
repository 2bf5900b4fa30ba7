// node ask.js PAGE.html REQUESTS.json
//
// Asks the solver of a page what stands in a list of requests, one after another, and prints the
// list of answers. Bytes of a request are those of the file that it names with `$bytes`, or of the text `$text`;
// columns of answers are lists.
"use strict";
const fs = require("node:fs");
const { solversOf } = require("./page.js");

const [page, list] = process.argv.slice(2);
const ask = solversOf(page)();
const answers = JSON.parse(fs.readFileSync(list, "utf8")).map(({ $bytes, $text, ...request }) => {
  const bytes = $bytes === undefined ? Buffer.from($text || "") : fs.readFileSync($bytes);
  const answer = ask(request, new Uint8Array(bytes));
  const columns = Object.entries(answer.columns).map(([name, values]) => [name, [...values]]);
  return { ...answer, columns: Object.fromEntries(columns) };
});
process.stdout.write(JSON.stringify(answers));
