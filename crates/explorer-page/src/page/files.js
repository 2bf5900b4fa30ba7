"use strict";
// Files of the reader: a case, rules for the gap, or records of agencies, read by the same readers
// as those of the command line.
const filesOf = (actions) => {
  const { part } = elements;
  const isToml = (name) => name.toLowerCase().endsWith(".toml");
  // A case has buildings, a file of rules has none.
  const areRules = (text) => /^\s*\[\[\s*rule\s*\]\]/m.test(text) && !/^\s*\[\[\s*building\s*\]\]/m.test(text);
  const decoder = new TextDecoder();
  const take = async (files) => {
    // Records first: a case that is dropped with its record finds it.
    const all = await Promise.all(
      [...files].map(async (file) => {
        const bytes = new Uint8Array(await file.arrayBuffer());
        const text = isToml(file.name) ? decoder.decode(bytes) : null;
        return { name: file.name, bytes, kind: text === null ? 0 : areRules(text) ? 1 : 2 };
      }),
    );
    all.sort((a, b) => a.kind - b.kind);
    const withCase = all.some(({ kind }) => kind === 2);
    for (const { name, bytes, kind } of all) {
      if (kind === 2) await actions.openCase(name, bytes);
      else if (kind === 1) await actions.openRules(name, bytes);
      else await actions.openRecord(name, bytes, !withCase);
    }
  };
  return {
    prepare: () => {
      part("open").addEventListener("change", (event) => {
        take(event.target.files);
        event.target.value = "";
      });
      const over = (event) => {
        if ([...event.dataTransfer.types].includes("Files")) {
          event.preventDefault();
          document.body.classList.toggle("dropping", event.type !== "dragleave");
        }
      };
      addEventListener("dragover", over);
      addEventListener("dragleave", over);
      addEventListener("drop", (event) => {
        event.preventDefault();
        document.body.classList.remove("dropping");
        take(event.dataTransfer.files);
      });
    },
  };
};
