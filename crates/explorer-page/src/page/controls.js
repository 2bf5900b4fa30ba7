"use strict";
// Controls, as the module names them. A value that is moved goes into the state as the case file
// would say it: with the unit in which it is shown, or as a number in SI.
const controlsOf = (state, documentation, actions) => {
  const { html, shown, clean, more, part } = elements;
  // Ends of sliders that were widened to what a gap demands, by their paths (SI).
  const widened = new Map();
  let fields = new Map();

  const word = (control, x) => {
    const display = clean(x / control.factor);
    return control.unit ? `${display} ${control.unit}` : clean(x);
  };
  // A number as a field has room for it.
  const written = (x) => (x !== 0 && (Math.abs(x) >= 1e6 || Math.abs(x) < 1e-4) ? x.toExponential() : String(x));

  // A slider between two values (SI), with the value that it stands at.
  const slider = (control, [low, high], now, labels) => {
    const { factor, logarithmic } = control;
    const ends = logarithmic ? [0, 1000] : [clean(low / factor), clean(high / factor)];
    const step = logarithmic ? 1 : 10 ** Math.floor(Math.log10((ends[1] - ends[0]) / 200));
    const input = html("input", { type: "range", min: ends[0], max: ends[1], step, ...labels });
    const to = (x) => (logarithmic ? (1000 * Math.log(x / low)) / Math.log(high / low) : x / factor);
    const from = () =>
      logarithmic ? Number((low * (high / low) ** (Number(input.value) / 1000)).toPrecision(3)) : Number(input.value) * factor;
    const stand = (x) => {
      // Where nothing holds it stands at its left end.
      input.value = Number.isFinite(x) ? String(to(x)) : input.min;
      input.setAttribute("aria-valuetext", Number.isFinite(x) ? `${shown(x / factor, 6)} ${control.unit}`.trim() : "left out");
    };
    stand(now);
    return { input, from, stand };
  };

  const number = (control) => {
    const id = `control-${control.path}`;
    const note = `${id}-note`;
    const field = html("input", { id, type: "number", step: "any", "aria-describedby": note });
    const show = (x) => {
      field.value = x === null || !Number.isFinite(x) ? "" : written(clean(x / control.factor));
    };
    show(control.value);
    // What holds where the case leaves it out stands in the empty field.
    if (control.default !== null) field.placeholder = written(clean(control.default / control.factor));
    let inForce = control.value;
    const ends = control.slider && [control.slider[0], Math.max(control.slider[1], widened.get(control.path) || 0)];
    const moved = ends && slider(control, ends, control.value === null ? NaN : control.value, {
      "aria-label": `${control.group}, ${control.label}`,
      "aria-describedby": note,
      "data-control": control.path,
    });
    field.addEventListener("change", () => {
      // An empty field leaves out what the case may leave out; a text that is no number, which looks empty here, nothing.
      const typed = Number(field.value) * control.factor;
      if ((field.value === "" && (field.validity.badInput || !control.optional)) || !Number.isFinite(typed)) {
        show(inForce);
        return;
      }
      inForce = field.value === "" ? null : typed;
      if (moved) moved.stand(inForce ?? control.default ?? NaN);
      state.set(control.path, inForce === null ? null : word(control, inForce));
    });
    if (moved) {
      moved.input.addEventListener("input", () => {
        const x = moved.from();
        inForce = x;
        show(x);
        moved.input.setAttribute("aria-valuetext", `${shown(x / control.factor, 6)} ${control.unit}`.trim());
        actions.dragged();
        state.set(control.path, word(control, x));
      });
      moved.input.addEventListener("change", actions.released);
    }
    fields.set(control.path, (high) => {
      if (!moved || control.logarithmic || Number(moved.input.max) >= high / control.factor) return;
      widened.set(control.path, high);
      const at = field.value;
      moved.input.max = String(clean(high / control.factor));
      moved.input.value = at;
    });
    return html(
      "div",
      { class: "control" },
      html("label", { for: id }, control.label.replaceAll("_", " ")),
      html("span", { class: "value" }, field, html("span", { class: "unit" }, control.unit || unitOf(control))),
      moved ? moved.input : null,
      line(control, note),
    );
  };

  // The unit that stands behind the range of a parameter.
  const unitOf = (control) => (/^[[(][^\])]*[\])](.*)$/.exec(control.allowed) || ["", ""])[1].trim();

  const line = (control, id) =>
    html("p", { class: "note", id }, ...explained(control), " ", more(documentation, control.page));

  // The explanation of a key, whose unit is that of the control; names of keys and files are code.
  const explained = ({ explanation, unit }) =>
    (unit ? explanation.replace(/ \((m|kg|N\/m|m\/s2)\)/, "") : explanation)
      .split("`")
      .map((words, i) => (i % 2 ? html("code", {}, words) : words));

  // What values of storeys are a multiple of: the original, or themselves.
  const factored = ({ value, slider: [low, high] }, original) => {
    const times = original && original.length === value.length ? Number((value[0] / original[0]).toPrecision(3)) : NaN;
    const same = times > 0 && value.every((x, i) => Math.abs(x - original[i] * times) <= 1e-5 * x);
    return same && times >= low && times <= high ? { base: original.slice(), times } : { base: value.slice(), times: 1 };
  };

  // A value for every storey: one slider for all, and a field for each.
  const list = (control) => {
    const id = `control-${control.path}`;
    const note = `${id}-note`;
    const values = control.value.slice();
    // Values that are those of the opened case times one factor stand at that factor.
    const { base, times: start } = factored(control, actions.original(control.path));
    const inputs = values.map((x, i) => {
      const field = html("input", { id: `${id}-${i}`, type: "number", step: "any", min: 0 });
      field.value = String(clean(x / control.factor));
      field.addEventListener("change", () => {
        const typed = Number(field.value) * control.factor;
        // Emptied, or no number.
        if (field.value === "" || !Number.isFinite(typed)) {
          field.value = String(clean(values[i] / control.factor));
          return;
        }
        values[i] = typed;
        base[i] = values[i] / factorNow();
        tell();
      });
      return field;
    });
    // On paper, where nothing opens, the values stand in a line.
    const printed = html("p", { class: "printed", "data-printed": control.path });
    const print = () => {
      const all = values.map((x) => clean(x / control.factor));
      const same = all.length > 1 && all.every((x) => x === all[0]);
      const where = all.length === 1 ? "storey 1" : same ? `each of ${all.length} storeys` : "storeys from the bottom";
      printed.textContent = `${control.label} (${control.unit}), ${where}: ${same ? all[0] : all.join(", ")}`;
    };
    print();
    const tell = () => {
      print();
      state.set(control.path, values.map((x) => word(control, x)));
    };
    const all = slider({ factor: 1, logarithmic: true, unit: "times" }, control.slider, start, {
      id,
      "aria-describedby": note,
      "data-control": control.path,
    });
    const factor = html("output", { for: id }, shown(start, 3));
    const factorNow = () => Number(factor.textContent);
    all.input.addEventListener("input", () => {
      const times = all.from();
      factor.textContent = shown(times, 3);
      all.input.setAttribute("aria-valuetext", `${shown(times, 3)} times`);
      base.forEach((x, i) => {
        values[i] = Number((x * times).toPrecision(6));
        inputs[i].value = String(clean(values[i] / control.factor));
      });
      actions.dragged();
      tell();
    });
    all.input.addEventListener("change", actions.released);
    const storeys = inputs.map((field, i) =>
      html("label", { class: "storey" }, `storey ${i + 1} `, field, html("span", { class: "unit" }, control.unit)),
    );
    return html(
      "div",
      { class: "control" },
      html("label", { for: id }, `${control.label}, all storeys times`),
      html("span", { class: "value" }, factor),
      all.input,
      html("details", { class: "storeys" }, html("summary", {}, `${control.label} of each storey (${control.unit})`), ...storeys),
      printed,
      line(control, note),
    );
  };

  const choice = (control, options, chosen) => {
    const id = `control-${control.path}-${control.kind}`;
    const note = `${id}-note`;
    const select = html("select", { id, "aria-describedby": note, "data-control": control.path });
    for (const [name, text] of options) select.append(new Option(text, name, false, name === control.value));
    select.addEventListener("change", () => chosen(select.value));
    return html(
      "div",
      { class: "control" },
      html("label", { for: id }, control.kind === "record" ? "record" : control.label),
      select,
      line(control, note),
    );
  };

  // Values that the page shows and does not move.
  const fixed = (control) =>
    html(
      "div",
      { class: "control", "data-fixed": control.path },
      html("span", {}, `${control.label}, by level`),
      html("span", { class: "value" }, `${control.value.map((x) => clean(x / control.factor)).join(", ")} ${control.unit}`),
      html("p", { class: "note" }, "Values that differ by level are not moved here, the case file says them. ", more(documentation, control.page)),
    );

  // What is no number, and stays as the case file says it.
  const said = (control) =>
    html(
      "div",
      { class: "control", "data-fixed": control.path },
      html("span", {}, control.label),
      html("span", { class: "value" }, control.value),
      html("p", { class: "note" }, "Not moved here, the case file says it. ", more(documentation, control.page)),
    );

  const made = {
    number,
    list,
    fixed,
    said,
    model: (control) => {
      const options = actions.models().map((model) => [model.name, model.recommended ? `${model.name} (recommended)` : model.name]);
      const chosen = actions.models().find((model) => model.name === control.value);
      const element = choice(control, options, (name) => actions.chooseModel(control.path, name));
      if (chosen) element.append(about(chosen));
      return element;
    },
    record: (control) => {
      const names = [...new Set([control.value, ...actions.records()])];
      const last = (name) => name.split("/").pop();
      // Of two with one name of a file, the folders tell which is which.
      const shared = (name) => names.some((other) => other !== name && last(other) === last(name));
      return choice(control, names.map((name) => [name, shared(name) ? name : last(name)]), actions.chooseRecord);
    },
    component: (control) => {
      // The case may name a component by the first word of its name alone.
      const others = actions.components().filter((name) => name.split(/\s/)[0] !== control.value);
      const names = new Set([control.value, ...others]);
      return choice(control, [...names].map((name) => [name, name]), (name) => state.set(control.path, name));
    },
  };

  // What the descriptor of a model says of it.
  const about = (model) =>
    html(
      "details",
      {},
      html("summary", {}, `About ${model.name}`),
      html("p", {}, model.title),
      html("p", {}, html("code", {}, model.formula)),
      html("p", { class: "note" }, `${model.citation}; ${model.verification}`),
      model.traps.length ? html("ul", { class: "note" }, ...model.traps.map((trap) => html("li", {}, trap))) : null,
    );

  return {
    show: (controls) => {
      fields = new Map();
      const groups = new Map();
      for (const control of controls) {
        if (!groups.has(control.group)) groups.set(control.group, []);
        groups.get(control.group).push(made[control.kind](control));
      }
      const sets = [...groups].map(([name, inside]) => html("fieldset", {}, html("legend", {}, name), ...inside));
      // Who chose by keys goes on from there.
      const { id } = document.activeElement;
      part("controls").replaceChildren(...sets);
      if (id) document.getElementById(id)?.focus({ preventScroll: true });
    },
    // Lets the slider of a width reach what the gap demands.
    reach: (path, high) => fields.has(path) && fields.get(path)(high),
  };
};
