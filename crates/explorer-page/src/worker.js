// A worker: it is given the compiled module once, then requests one after another, and tells the
// answer of each by its number. What traps the module is told too: the page then makes another
// worker, as the memory of this one may be anything.
let ask = null;
onmessage = ({ data: { number, compiled, request, bytes } }) => {
  try {
    if (compiled) {
      ask = explorerOf(compiled);
      postMessage({ number, answer: {} });
      return;
    }
    const started = performance.now();
    const answer = ask(request, bytes);
    answer.milliseconds = performance.now() - started;
    postMessage({ number, answer }, Object.values(answer.columns || {}).map((column) => column.buffer));
  } catch (error) {
    postMessage({ number, trapped: String(error) });
  }
};
