// The module: a request in, an answer out. docs of requests: `Explorer::answer`. Before this stands
// the script of the module, by `wasm-bindgen`, whose name is `pounding`.
// A module that was trapped is thrown away and made anew by whoever asks next.

// Answers of an instance of the module, which was compiled before.
const explorerOf = (compiled) => {
  pounding.initSync({ module: compiled });
  const explorer = new pounding.Explorer();

  // Asks for what `request` says, with the bytes that belong to it.
  return (request, bytes = new Uint8Array()) => {
    const answer = explorer.answer(JSON.stringify(request), bytes);
    const columns = Object.fromEntries(answer.columnNames().map((name) => [name, answer.column(name)]));
    const object = JSON.parse(answer.text());
    answer.free();
    return { ...object, columns };
  };
};
