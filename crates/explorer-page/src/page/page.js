"use strict";
// The page: one state, one run that is looked at, a sweep behind it.
(async () => {
  const { part, html, save } = elements;
  const data = JSON.parse(document.getElementById("data").textContent);
  // Times of the motion while something is moved, and at rest.
  const [FEW, MANY] = [400, 3000];
  // After this pause (ms) of the reader the sweep begins again.
  const PAUSE = 250;
  const encoder = new TextEncoder();
  // What is said below the title behind the name of the case.
  const origin = document.querySelector("header .what").textContent.slice(data.name.length);

  let solver = null;
  let models = [];
  // The case that is open: its name and text, whether the reader brought it, and how many were open
  // before.
  let opened = { name: data.name, text: data.case, own: false, number: 0 };
  let base = null;
  let run = null;
  let sweep = null;
  let dragging = false;
  // Records by their names, with the names of their components where there are several, and the
  // names of those that the reader brought.
  const records = new Map();
  const dropped = new Set();
  // Rules of the reader, or those that the page was written with.
  const given = data.rules || null;
  let rules = given;

  // Impact models by the paths of their gaps that the reader chose and that are not in the state yet: a
  // model is made like the one before, which takes a case that can be run.
  const wishes = new Map();

  // What is wrong with the run that is looked at, and with what the reader asked for before. A run
  // that succeeds says nothing of the second.
  const wrong = { run: [], asked: [] };
  const told = (faults, of = "asked") => {
    wrong[of] = faults;
    // What both say is said once.
    const same = (one) => (other) => other.message === one.message && other.line === one.line;
    const all = [...wrong.asked, ...wrong.run].filter((fault, i, every) => every.findIndex(same(fault)) === i);
    const blocks = all.slice(0, 20).map((fault) =>
      html(
        "div",
        { class: "fault" },
        html("p", {}, fault.message),
        fault.line ? html("pre", {}, fault.line) : null,
        fault.help ? html("p", { class: "note" }, `help: ${fault.help}`) : null,
      ),
    );
    part("faults").replaceChildren(...blocks);
    part("faults").hidden = !blocks.length;
    // Answers of another state than that of the controls are not taken for its own.
    part("main").classList.toggle("stale", wrong.run.length > 0);
    const words = ofStale();
    part("stale").textContent = words;
    part("stale").hidden = words === "";
    downloads();
  };
  // A case that collapses, or takes longer than a page waits, is sound: it has no numbers here.
  const isSound = () => wrong.run.every((fault) => fault.sound);
  // What is said above answers that are not those of the controls.
  const ofStale = () => {
    if (!wrong.run.length) return "";
    const models = [...wishes.values()].join(", ");
    const sentences = isSound()
      ? ["This input has no peaks, for the reason above; Case file and Share give it all the same.", run && "The answers below are of the last input that ran to its end, and there are no files of them."]
      : [run && "The present input cannot be run, see above: the answers below are of the last input that could, and there are no files of them until it is corrected."];
    if (models) sentences.push(`The impact model ${models} is taken up as soon as the input can be run.`);
    return sentences.filter(Boolean).join(" ");
  };
  // Whoever changes something else has read what was told of what they asked for before.
  const heard = () => {
    if (wrong.asked.length) told([]);
  };
  // There are no files of answers of another state than that of the controls, nor of a part of them.
  const downloads = () => {
    const stale = wrong.run.length > 0;
    for (const name of ["case", "share"]) part(name).disabled = !isSound();
    part("peaks-csv").disabled = stale;
    for (const name of ["sweep-csv", "png"]) part(name).disabled = stale || !sweep || !sweep.whole();
  };

  // Says for how long a run has been computed, where that takes longer than a blink.
  const working = (() => {
    const BLINK = 400;
    let started = 0;
    let ticking = 0;
    const tick = () => {
      const past = performance.now() - started;
      part("working").textContent = `Computing … ${Math.floor(past / 1000)} s`;
      part("working").hidden = past < BLINK;
    };
    return {
      begin: () => {
        started = performance.now();
        ticking = setInterval(tick, 200);
        part("main").setAttribute("aria-busy", "true");
      },
      end: () => {
        clearInterval(ticking);
        part("working").hidden = true;
        part("main").removeAttribute("aria-busy");
      },
    };
  })();

  // Runs: of all states that come while one is computed, the last is next.
  let wanted = false;
  let busy = false;
  let settled = Promise.resolve();
  let timer = 0;
  const update = () => {
    wanted = true;
    if (!busy && solver) settled = compute();
  };
  // Takes up a model that was chosen, in the place of the one of these changes: whether it was, or why
  // it cannot be.
  const takeUp = async (changes) => {
    const [path, model] = wishes.entries().next().value;
    const gap = Number(path.split(".")[1]);
    const answer = await solver.live.ask({ do: "calibrate", changes, gap, model });
    // Something else was changed.
    if (wanted || wishes.get(path) !== model) return { taken: true };
    if (answer.faults) return { path, refused: answer.faults };
    wishes.delete(path);
    part("notes").textContent = answer.notes.join("; ");
    state.model(path, answer.keys);
    await describe();
    return { taken: true };
  };
  // Whether controls are those of another state, as that which was chosen could not be run.
  let undescribed = false;
  const compute = async () => {
    busy = true;
    while (wanted) {
      wanted = false;
      // New controls would end the drag.
      if (wishes.size && dragging) break;
      const changes = state.changes();
      working.begin();
      const wish = wishes.size ? await takeUp(changes) : {};
      if (wish.taken) {
        working.end();
        wanted = true;
        continue;
      }
      const answer = await solver.live.ask({ do: "run", changes, frames: dragging ? FEW : MANY });
      working.end();
      if (answer.faults) {
        // What is wrong with a state that is no longer wanted helps nobody.
        if (!wanted) {
          told(answer.faults, "run");
          if (undescribed && isSound() && !dragging) await describe();
        }
        continue;
      }
      if (wish.refused) {
        if (wanted) continue;
        // The case can be run, with the model that it has.
        wishes.delete(wish.path);
        undescribed = true;
      }
      told([], "run");
      run = answer;
      if (undescribed && !dragging) await describe();
      if (wish.refused) told(wish.refused);
      part("main").hidden = false;
      results.show(run);
      motion.show(run);
      part("milliseconds").textContent = `${run.milliseconds.toFixed(0)} ms`;
      document.documentElement.dataset.runs = String(Number(document.documentElement.dataset.runs || 0) + 1);
      sweep.draw();
      if (!wanted && !dragging) part("status").textContent = results.words(run);
    }
    busy = false;
  };
  const later = () => {
    clearTimeout(timer);
    timer = setTimeout(async () => {
      sweep.begin();
      await settled;
      // An address is one of what can be run, and one that was refused stays until something is changed.
      if (busy || !isSound() || state.text({}) === untouched) return;
      untouched = null;
      written = `#${address()}`;
      history.replaceState(null, "", written);
    }, PAUSE);
  };
  let written = location.hash;
  let untouched = null;
  // The state behind the sign #, with what the reader brought.
  const address = () =>
    state.text({
      case: opened.own ? { name: opened.name, text: opened.text } : null,
      rules: rules === given ? null : rules,
    });
  const state = stateOf(() => {
    update();
    later();
    downloads();
  });

  const set = (path, value) => {
    heard();
    state.set(path, value);
  };
  const controls = controlsOf({ ...state, set }, data.documentation, {
    dragged: () => {
      dragging = true;
    },
    released: () => {
      dragging = false;
      update();
    },
    // Values of a list in the case as it was opened.
    original: (path) => base.controls.find((c) => c.path === path && c.kind === "list")?.value,
    models: () => models,
    records: () => records.keys(),
    components: () => records.get(recordInUse()) || [],
    chooseModel: (path, model) => {
      heard();
      if (model === modelOf(path.split(".")[1])) wishes.delete(path);
      else wishes.set(path, model);
      told(wrong.run, "run");
      update();
    },
    chooseRecord: async (name) => {
      heard();
      const own = base.files.find(([what]) => what === "record");
      await useRecord(own && own[1] === name ? null : name);
    },
  });
  const recordInUse = () => {
    const changed = state.get().record;
    const own = base && base.files.find(([what]) => what === "record");
    return changed ? changed.find(([key]) => key === "file")[1] : own ? own[1] : "";
  };
  const results = resultsOf(data.documentation);
  const modelOf = (gap) => {
    const path = `gap.${gap}`;
    const changed = state.get().models[path];
    if (changed) return changed.find(([key]) => key === "model")[1];
    const control = base && base.controls.find((c) => c.path === path && c.kind === "model");
    return control ? control.value : "";
  };

  // The controls of the state, with their values.
  const describe = async () => {
    const answer = await solver.live.ask({ do: "controls", changes: state.changes() });
    undescribed = Boolean(answer.faults);
    if (answer.faults) {
      told(answer.faults);
      return false;
    }
    told([]);
    models = answer.models;
    controls.show(answer.controls);
    const gaps = answer.controls.filter((c) => c.kind === "model").map((c) => c.group);
    sweep.choices(models, gaps);
    return true;
  };

  const useRecord = async (name) => {
    const before = state.get();
    const component = before.entries["ground_motion.component"];
    const { record } = before;
    const [first] = (name !== null && records.get(name)) || [];
    const faulty = (await solver.live.ask({ do: "controls", changes: state.changes() })).faults;
    // Of several components the first, until another is chosen.
    state.record(name === null ? null : [["file", name], ...(first ? [["component", first]] : [])]);
    // Of an input that is wrong without it the record stays chosen, like all else.
    if ((await describe()) || faulty) return;
    state.record(record);
    if (component !== undefined) state.set("ground_motion.component", component);
    // The faults of the record are told, not those of the run before it.
    await describeQuietly();
  };
  const describeQuietly = async () => {
    const answer = await solver.live.ask({ do: "controls", changes: state.changes() });
    if (!answer.faults) controls.show(answer.controls);
  };

  const open = async (name, bytes, own) => {
    const answer = await solver.open(name, bytes);
    if (answer.faults) {
      told(answer.faults);
      return false;
    }
    const text = answer.case;
    opened = { name, text, own, number: opened.number + 1 };
    base = answer;
    for (const [what, path] of answer.files) if (what === "record" && !records.has(path)) records.set(path, []);
    document.title = answer.title || name;
    document.querySelector("h1").textContent = answer.title || name;
    document.querySelector("header .what").textContent = name + origin;
    part("notes").textContent = "";
    return true;
  };

  // Rules for the gap in the place of those before; null for none.
  const useRules = async (file) => {
    const answer = await solver.rules(file ? file.name : "", encoder.encode(file ? file.text : ""));
    if (answer.faults) {
      told(answer.faults);
      return;
    }
    told([]);
    rules = file;
    opened.number += 1;
    const names = answer.rules.join(", ");
    part("rules").textContent = file ? `Rules of ${file.name}, beside the codes: ${names}.` : "";
    later();
  };

  const refresh = async () => {
    if (await describe()) {
      update();
      later();
    }
  };
  // What stands behind the sign # of the address.
  const restore = async (hash) => {
    const refused = [];
    let ignored = [];
    state.clear();
    wishes.clear();
    told([]);
    written = hash;
    untouched = null;
    if (hash.length > 1) {
      try {
        const own = state.read(hash.slice(1));
        ({ ignored } = own);
        if (own.case && !(await open(own.case.name, encoder.encode(own.case.text), true))) {
          // What it changes is of that case.
          refused.push(...wrong.asked);
          state.clear();
        }
        if (own.rules) await useRules(own.rules);
        if (own.rules) refused.push(...wrong.asked);
        const { faults, controls: shown } = await solver.live.ask({ do: "controls", changes: state.changes() });
        if (!faults) ignored.push(...state.shownAlone(shown));
        if (faults) {
          refused.push(...faults.map((fault) => ({ ...fault, message: `what the address changes is left out: ${fault.message}` })));
          state.clear();
        }
      } catch (error) {
        refused.push({ message: `the address holds no state of this page: ${error.message}`, help: "open the page without what follows the sign #", line: "" });
      }
    }
    await refresh();
    const { overlays, quantity, gap } = state.get();
    const gaps = base.controls.filter((control) => control.kind === "model").length;
    const known = overlays.filter((name) => models.some((model) => model.name === name));
    ignored.push(...overlays.filter((name) => !known.includes(name)).map((name) => `overlays ${name}`));
    if (!sweep.has(quantity)) ignored.push(`quantity ${quantity}`);
    if (gap >= Math.max(1, gaps)) ignored.push(`gap ${gap}`);
    if (ignored.length) {
      state.look({ overlays: known, quantity: sweep.has(quantity) ? quantity : "impacts", gap: gap < gaps ? gap : 0 });
      await describe();
      refused.push({ message: `of the address is ignored, as this page has nothing of the kind: ${ignored.join("; ")}`.slice(0, 500), help: null, line: "" });
    }
    if (refused.length) {
      untouched = state.text({});
      told(refused);
    }
  };

  try {
    solver = await workers(data);
  } catch (error) {
    told([{ message: `the solver cannot start here: ${error.message}`, help: "open the page in a current browser", line: "" }]);
    return;
  }
  sweep = sweepOf(state, solver.background, data.dashes, data.collapse, {
    changed: downloads,
    // The width of all levels of a gap; none where they differ.
    provided: (gap) => {
      const [first, ...others] = (run && run.summary.gaps[gap]?.levels) || [];
      return first && others.every((level) => level.width === first.width) ? first.width : NaN;
    },
    differ: (gap) => run !== null && results.differ(run.summary.gaps[gap]?.levels || []),
    model: modelOf,
    opened: () => opened.number,
    demanded: (gaps) =>
      gaps.forEach((gap, i) => controls.reach(`gap.${i}.width`, Math.ceil(130 * gap.demand) / 100)),
  });
  sweep.prepare();
  motion.begin();
  // A file that the page was written with.
  const keep = async (file) => {
    const kept = await solver.file(file.name, await solver.unpacked(file.data));
    records.set(file.name, kept.components || []);
  };
  for (const file of data.files) await keep(file);
  filesOf({
    openCase: async (name, bytes) => {
      if (!(await open(name, bytes, true))) return;
      state.clear();
      wishes.clear();
      await refresh();
    },
    openRecord: async (name, bytes, use) => {
      const answer = await solver.file(name, bytes);
      if (answer.faults) {
        told(answer.faults);
        return;
      }
      records.set(name, answer.components);
      dropped.add(name);
      // Runs that used another file of this name are no longer those of the state.
      opened.number += 1;
      told([]);
      if (use) await useRecord(name);
    },
    openRules: (name, bytes) => useRules({ name, text: new TextDecoder().decode(bytes) }),
  }).prepare();
  part("reset").addEventListener("click", async () => {
    told([]);
    const replaced = data.files.filter(({ name }) => dropped.delete(name));
    for (const file of replaced) await keep(file);
    if (replaced.length) opened.number += 1;
    if (opened.own) await open(data.name, encoder.encode(data.case), false);
    if (rules !== given) await useRules(given);
    part("notes").textContent = "";
    wishes.clear();
    untouched = null;
    state.reset();
    await describe();
  });
  part("share").addEventListener("click", async () => {
    const used = dropped.has(recordInUse());
    const text = address();
    history.replaceState(null, "", `#${text}`);
    let copied = "copy it from the address bar";
    try {
      await navigator.clipboard.writeText(`${location.href.split("#")[0]}#${text}`);
      copied = "it is in the clipboard";
    } catch {
      // Nobody has to let a page write there.
    }
    part("status").textContent = `The address of the page holds this state: ${copied}.${used ? " The record that you dropped is not in it: give it along." : ""}`;
  });
  // A file of the run of the state that is shown, which may still be computed.
  const saveOfRun = async (name, kind, text) => {
    await settled;
    if (run && !wrong.run.length) save(name, kind, text(run));
  };
  part("case").addEventListener("click", async () => {
    await settled;
    if (!wrong.run.length) return saveOfRun(opened.name, "text/plain", (run) => run.case);
    const answer = await solver.live.ask({ do: "controls", changes: state.changes() });
    if (!answer.faults) save(opened.name, "text/plain", answer.case);
  });
  part("peaks-csv").addEventListener("click", () => saveOfRun("peaks.csv", "text/csv", results.csv));
  addEventListener("resize", results.redraw);
  addEventListener("hashchange", () => {
    if (location.hash !== written) restore(location.hash);
  });
  if (await open(data.name, encoder.encode(data.case), false)) {
    part("explorer").hidden = false;
    part("loading").hidden = true;
    if (given) await useRules(given);
    await restore(location.hash);
  }
  document.documentElement.dataset.ready = "true";
})();
