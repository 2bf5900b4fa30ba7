"use strict";
// The module: a request in, an answer out. docs of requests: `Explorer::answer`.
// A module that was trapped is thrown away and made anew by whoever asks next.

// Answers of an instance of the module, which was compiled before.
const explorerOf = (compiled) => {
  const encoder = new TextEncoder();
  const decoder = new TextDecoder();
  const host = { pounding: { pounding_now: () => performance.timeOrigin + performance.now() } };
  const { exports } = new WebAssembly.Instance(compiled, host);
  const tooLong = (bytes) => ({
    faults: [{ message: `${bytes} bytes are more than a page takes`, help: "run the case with `pounding run`", line: "" }],
  });

  // Asks for what `request` says, with the bytes that belong to it.
  return (request, bytes = new Uint8Array()) => {
    const text = encoder.encode(JSON.stringify(request));
    const length = 4 + text.length + bytes.length;
    const at = exports.pounding_reserve(length);
    if (at === 0) return tooLong(length);
    const memory = new Uint8Array(exports.memory.buffer, at, length);
    new DataView(exports.memory.buffer, at).setUint32(0, text.length, true);
    memory.set(text, 4);
    memory.set(bytes, 4 + text.length);
    const from = exports.pounding_answer();
    const view = new DataView(exports.memory.buffer, from, exports.pounding_answer_length());
    const [textLength, numbersAt] = [view.getUint32(0, true), view.getUint32(4, true)];
    const answer = JSON.parse(decoder.decode(new Uint8Array(exports.memory.buffer, from + 8, textLength)));
    const numbers = new Float64Array(exports.memory.buffer.slice(from + numbersAt, from + view.byteLength));
    const columns = {};
    for (const [name, [first, count]] of Object.entries(answer.columns || {})) {
      columns[name] = numbers.slice(first, first + count);
    }
    return { ...answer, columns };
  };
};
