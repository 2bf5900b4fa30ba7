"use strict";
// The workers: each has an instance of the module, and answers one request after another. One
// that is trapped, or does not answer in time, is ended; another takes its place, with the same
// case and files.
const workers = (() => {
  // Time for an answer (ms): the module stops a run by itself before.
  const LONGEST_ANSWER = 45000;
  const unpacked = async (text) => {
    const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  };
  const fault = (message, help) => ({ faults: [{ message, help, line: "" }], columns: {} });

  // A worker of this source. `opened` are the requests that every new one gets first.
  const worker = (source, compiled) => {
    const address = URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
    const opened = new Map();
    let current = null;
    let waiting = new Map();
    let last = 0;

    const post = (message, transfer) =>
      new Promise((resolve) => {
        const number = ++last;
        const timer = setTimeout(() => {
          restart();
          resolve(fault(`no answer within ${LONGEST_ANSWER / 1000} s`, "run the case with `pounding run`"));
        }, LONGEST_ANSWER);
        waiting.set(number, (answer) => {
          clearTimeout(timer);
          resolve(answer);
        });
        current.postMessage({ ...message, number }, transfer || []);
      });
    const start = () => {
      current = new Worker(address);
      current.onmessage = ({ data: { number, answer, trapped } }) => {
        const answered = waiting.get(number);
        waiting.delete(number);
        if (trapped !== undefined) restart();
        if (answered) {
          answered(
            trapped === undefined
              ? answer
              : fault(`the solver stopped: ${trapped}`, "this is a fault of the program: keep the case, and report it"),
          );
        }
      };
      post({ compiled });
      for (const message of opened.values()) post(message);
    };
    // What was asked of a worker that is ended has no answer.
    const restart = () => {
      current.terminate();
      const lost = waiting;
      waiting = new Map();
      start();
      for (const answered of lost.values()) answered(fault("the solver was started again", null));
    };
    start();
    return {
      ask: (request) => post({ request }),
      // A file, or a case: kept for workers to come if it is accepted.
      open: async (key, request, bytes) => {
        const answer = await post({ request, bytes });
        if (!answer.faults) opened.set(key, { request, bytes });
        return answer;
      },
      restart,
    };
  };

  return async (data) => {
    const compiled = await WebAssembly.compile(await unpacked(data.module));
    const [live, background] = [worker(data.worker, compiled), worker(data.worker, compiled)];
    const both = async (key, request, bytes) => {
      const [answer] = await Promise.all([live, background].map((w) => w.open(key, request, bytes)));
      return answer;
    };
    // Beside `ready` and `runs` for whoever drives the page: while nothing is asked it is at rest, but for its sweep.
    let asked = 0;
    const counted =
      (ask) =>
      async (...given) => {
        const count = (by) => {
          document.documentElement.dataset.asked = String((asked += by));
        };
        count(1);
        try {
          return await ask(...given);
        } finally {
          count(-1);
        }
      };
    return {
      live: { ...live, ask: counted(live.ask) },
      background,
      file: counted((name, bytes) => both(`file ${name}`, { do: "file", name }, bytes)),
      rules: counted((name, text) => both("rules", { do: "rules", name }, text)),
      open: counted((name, text) => both("case", { do: "open", name }, text)),
      unpacked: counted(unpacked),
    };
  };
})();
