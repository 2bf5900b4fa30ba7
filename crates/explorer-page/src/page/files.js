"use strict";
// Files of the reader: a case, or records of agencies, read by the same readers as those of the
// command line.
const filesOf = (actions) => {
  const { part } = elements;
  const isCase = (name) => name.toLowerCase().endsWith(".toml");
  const take = async (files) => {
    // Records first: a case that is dropped with its record finds it.
    const all = [...files].sort((a, b) => isCase(a.name) - isCase(b.name));
    const withCase = all.some((file) => isCase(file.name));
    for (const file of all) {
      const bytes = new Uint8Array(await file.arrayBuffer());
      if (isCase(file.name)) await actions.openCase(file.name, bytes);
      else await actions.openRecord(file.name, bytes, !withCase);
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
