"use strict";
// What was changed of the case: values of entries, models with their keys, the record. It is all
// that an address holds, and all that `changes` of a request say.
const stateOf = (changed) => {
  const empty = () => ({ entries: {}, absent: [], models: {}, record: null, overlays: [], quantity: "impacts", gap: 0 });
  let now = empty();
  const isRecord = (x) => typeof x === "object" && x !== null && !Array.isArray(x);
  const isWord = (x) =>
    typeof x === "string" || (typeof x === "number" && Number.isFinite(x)) || (Array.isArray(x) && x.every(isWord));
  const areKeys = (x) =>
    Array.isArray(x) && x.every((pair) => Array.isArray(pair) && pair.length === 2 && typeof pair[0] === "string" && isWord(pair[1]));

  const changesOf = ({ entries, absent, models, record }) => [
    ...(record ? [{ record }] : []),
    ...Object.entries(models).map(([gap, keys]) => ({ gap, keys })),
    ...absent.map((path) => ({ absent: path })),
    ...Object.entries(entries).map(([path, value]) => ({ path, value })),
  ];
  return {
    get: () => now,
    changes: () => changesOf(now),
    // All that the runs of a sweep of a gap have in common, with another model of the gap or its
    // own.
    changesOfSweep: (gap, keys) => {
      const path = `gap.${gap}`;
      const entries = { ...now.entries };
      delete entries[`${path}.width`];
      const models = { ...now.models };
      let { absent } = now;
      if (keys) {
        models[path] = keys;
        for (const key of Object.keys(entries)) if (key.startsWith(`${path}.`)) delete entries[key];
        absent = absent.filter((key) => !key.startsWith(`${path}.`));
      }
      return changesOf({ entries, absent, models, record: now.record });
    },
    // A value of an entry; null leaves it out of the case, which may have one.
    set: (path, value) => {
      now.absent = now.absent.filter((other) => other !== path);
      if (value === null) {
        delete now.entries[path];
        now.absent.push(path);
      } else now.entries[path] = value;
      changed();
    },
    // Another model of a gap: what was said of the parameters of the last one goes with it.
    model: (path, keys) => {
      for (const key of Object.keys(now.entries)) {
        if (key.startsWith(`${path}.`) && key !== `${path}.width`) delete now.entries[key];
      }
      now.absent = now.absent.filter((key) => !key.startsWith(`${path}.`));
      now.models[path] = keys;
      changed();
    },
    // Another record, with the component of it that is used.
    record: (keys) => {
      delete now.entries["ground_motion.component"];
      now.record = keys;
      changed();
    },
    // Takes out what is of entries without a control, which nothing here would show: what it was.
    shownAlone: (controls) => {
      const shown = new Set(controls.map((control) => control.path));
      const hidden = [...Object.keys(now.entries), ...now.absent].filter((path) => !shown.has(path));
      for (const path of hidden) delete now.entries[path];
      now.absent = now.absent.filter((path) => shown.has(path));
      const others = (now.record || []).map(([key]) => key).filter((key) => key !== "file" && key !== "component");
      if (others.length) now.record = now.record.filter(([key]) => !others.includes(key));
      if (now.record && !now.record.some(([key]) => key === "file")) now.record = null;
      for (const [gap, keys] of Object.entries(now.models)) {
        const path = (key) => `${gap}.${key}`;
        const unseen = keys.filter(([key]) => key !== "model" && !shown.has(path(key)));
        hidden.push(...unseen.map(([key]) => path(key)));
        now.models[gap] = keys.filter((pair) => !unseen.includes(pair));
      }
      return [...hidden, ...others.map((key) => `ground_motion.${key}`)];
    },
    look: (part) => {
      Object.assign(now, part);
      changed();
    },
    reset: () => {
      now = { ...empty(), overlays: now.overlays, quantity: now.quantity };
      changed();
    },
    clear: () => {
      now = empty();
    },
    // The state as a text that an address can hold, with a case and rules of the reader's own,
    // `{ name, text }` each or null.
    text: (own) => encodeURIComponent(JSON.stringify({ ...now, ...own }, (_, x) => (x === null ? undefined : x))),
    // Takes a text back; a case and rules of somebody's own are returned, null where there are
    // none, and what of it says nothing that a state has. Throws what is wrong with it.
    read: (text) => {
      const given = JSON.parse(decodeURIComponent(text));
      if (!isRecord(given)) throw new Error("it is no object");
      const next = empty();
      const own = { case: null, rules: null };
      const isFile = (x) => isRecord(x) && typeof x.name === "string" && typeof x.text === "string";
      const areTexts = (x) => Array.isArray(x) && x.length <= 64 && x.every((y) => typeof y === "string");
      const forms = {
        entries: (x) => isRecord(x) && Object.values(x).every(isWord),
        absent: areTexts,
        models: (x) => isRecord(x) && Object.values(x).every(areKeys),
        record: areKeys,
        overlays: areTexts,
        quantity: (x) => typeof x === "string",
        gap: (x) => Number.isInteger(x) && x >= 0,
        case: isFile,
        rules: isFile,
      };
      const ignored = [];
      for (const [key, value] of Object.entries(given)) {
        if (!Object.hasOwn(forms, key) || !forms[key](value)) ignored.push(`${key} ${JSON.stringify(value)}`.slice(0, 80));
        else if (key in own) own[key] = value;
        else next[key] = value;
      }
      now = next;
      return { ...own, ignored };
    },
  };
};
