"use strict";
// What pounding does at many widths, in the background: a curve for the law of the gap, and one
// for each model beside it. Widths grow from right to left of what is known: the curve is drawn as
// it comes.
const sweepOf = (state, background, dashes, collapse, actions) => {
  const { part, html, svg, shown, shownAtLeast, clean, ticks, save, quoted, counted } = elements;
  // What a quantity is called, what its unit is in SI, its values, and whether it is of the whole
  // row where one gap of several varies.
  const QUANTITIES = {
    impacts: ["impacts", 1, (columns) => columns.impacts],
    peak_force: ["peak contact force (kN)", 1e-3, (columns) => columns.peak_force],
    amplification: [
      "amplification of the displacement (-)",
      1,
      (columns) => {
        const buildings = Object.keys(columns).filter((name) => name.startsWith("displacement_"));
        return columns.width.map((_, i) => Math.max(...buildings.map((name) => columns[name][i])));
      },
      true,
    ],
    impact_energy: ["energy dissipated in contacts (kJ)", 1e-3, (columns) => columns.impact_energy],
  };
  // Seven dashes and six colours in turn: up to 42 curves no two have the same of both.
  const COLOURS = 6;
  // Widths of one request: few enough to be stopped soon.
  const AT_ONCE = 10;
  let job = 0;
  // What was asked for last, and what is done.
  let asked = null;
  let finished = null;
  let widths = null;
  // Names of the gaps, as controls have them.
  let named = [];
  // Curves by the name of their model, and the case that they are of.
  let curves = new Map();
  // Runs without an end by the name of their model, each with its width, and names of the buildings.
  let failed = new Map();
  let buildings = [];
  let done = [0, 0];
  // What is said where there are no runs to count.
  let waiting = "";

  // Dashes and spaces as figures have them (pt), on the screen.
  const pixels = dashes.map((dash) => dash.split(" ").map((length) => length && clean((length * 4) / 3)).join(" "));
  // How curve number so many is drawn, and a piece of a line as it stands in the legend.
  const looks = (i) => ({ class: `curve curve-${i % COLOURS}`, "stroke-dasharray": pixels[i % pixels.length] || null });
  const SAMPLE = 40;
  const sample = (look) => svg("svg", { class: "key", width: SAMPLE, height: 8, viewBox: `0 0 ${SAMPLE} 8`, "aria-hidden": "true" }, svg("path", { ...look, d: `M0 4H${SAMPLE}` }));
  const mark = (kind) => ({ class: `mark ${kind}` });

  const join = (columns, more) => {
    const out = {};
    for (const name of Object.keys(more)) out[name] = columns ? Float64Array.of(...columns[name], ...more[name]) : more[name];
    return out;
  };
  // Every so many widths first, then those between: the whole range is seen early.
  const order = (count) => {
    const out = [];
    const seen = new Set();
    for (let step = 16; step >= 1; step /= 2) {
      for (let i = 0; i < count; i += step) {
        if (!seen.has(i)) out.push(i);
        seen.add(i);
      }
    }
    return out;
  };
  const sorted = (columns) => {
    const places = [...columns.width.keys()].sort((a, b) => columns.width[a] - columns.width[b]);
    return Object.fromEntries(Object.entries(columns).map(([name, values]) => [name, Float64Array.from(places, (i) => values[i])]));
  };

  // A gap of several is named wherever the curves are: what is chosen is not on paper, and the
  // largest of a row is not that of the gap.
  const several = () => named.length > 1;
  const nameOf = (gap) => (several() ? (named[gap] || "").replace(/^Gap/, "gap") : "the gap");
  // A text of a picture so wide, whole where it is pointed at.
  const fitting = (text, width, place) => {
    const most = Math.max(12, Math.floor(width / 6.6));
    const short = text.length > most ? `${text.slice(0, most - 1)}…` : text;
    return svg("text", place, short, short === text ? null : svg("title", {}, text));
  };

  // Where pounding brings a building to collapse there are no peaks, and no curve.
  const collapses = () => {
    const [head, rest] = collapse;
    const filled = (text, words) => text.replace(/\{(\w+)\}/g, (_, word) => words[word]);
    return [...failed].flatMap(([name, runs]) =>
      buildings.flatMap((building) => {
        const fallen = runs.filter((run) => run.collapsed === building).map((run) => run.width);
        if (!fallen.length) return [];
        const [first, last] = [Math.min(...fallen), Math.max(...fallen)].map((width) => shown(1e3 * width));
        const widths = counted(curves.get(name).width.length, "width");
        const said = filled(rest, { count: fallen.length, widths, first, last });
        return [[curves.size > 1 ? `${name}: ` : "", html("strong", {}, filled(head, { building })), said]];
      }),
    );
  };

  const draw = () => {
    const { quantity, gap } = state.get();
    const [what, factor, of, ofRow] = QUANTITIES[quantity] || QUANTITIES.impacts;
    const title = several() ? `${what}${ofRow ? ", largest of the whole row" : ` of ${nameOf(gap)} alone`}` : what;
    part("heading-sweep").textContent = `All widths of ${nameOf(gap)}`;
    const picture = part("sweep");
    const [width, height] = [picture.clientWidth || 640, 380];
    const [left, right, top, bottom] = [64, 24, 24, height - 40];
    const provided = actions.provided(gap);
    const marks = widths ? marksOf(widths.gaps[gap]) : [];
    let far = Math.max(provided || 0, ...marks.map(([x]) => x));
    let high = 0;
    const lines = [...curves].map(([name, columns]) => {
      const values = of(columns);
      far = Math.max(far, columns.width[columns.width.length - 1] || 0);
      values.forEach((y) => {
        if (factor * y > high) high = factor * y;
      });
      return { name, columns, values };
    });
    far = far || 0.1;
    high = high || 1;
    const across = (x) => left + (x / far) * (width - left - right);
    const up = (y) => bottom - (y / high) * (bottom - top);
    const drawn = [fitting(title, width - left - right, { x: left, y: 14 })];
    for (const y of ticks(0, high, 5)) {
      drawn.push(svg("path", { class: "axis", d: `M${left} ${up(y)}H${width - right}` }));
      drawn.push(svg("text", { x: left - 6, y: up(y) + 4, "text-anchor": "end" }, shown(y)));
    }
    for (const x of ticks(0, 1e3 * far, Math.max(3, Math.floor(width / 90)))) {
      drawn.push(svg("text", { x: across(1e-3 * x), y: bottom + 16, "text-anchor": "middle" }, String(x)));
    }
    drawn.push(fitting(`width of ${nameOf(gap)} (mm)`, width - left - right, { x: (left + width) / 2, y: height - 6, "text-anchor": "middle" }));
    marks.forEach(([x, name, kind]) => {
      const line = svg("path", { ...mark(kind), d: `M${across(x)} ${top}V${bottom}` });
      drawn.push(svg("g", {}, svg("title", {}, `${name}: ${shownAtLeast(1e3 * x)} mm`), line));
    });
    lines.forEach(({ columns, values }, i) => {
      let path = "";
      let pen = "M";
      values.forEach((y, k) => {
        if (!Number.isFinite(y)) pen = "M";
        else {
          path += `${pen}${across(columns.width[k]).toFixed(1)} ${up(factor * y).toFixed(1)}`;
          pen = "L";
        }
      });
      drawn.push(svg("path", { ...looks(i), d: path }));
    });
    if (Number.isFinite(provided)) {
      drawn.push(svg("path", { class: "now", d: `M${across(provided)} ${top}V${bottom}` }));
    }
    picture.setAttribute("viewBox", `0 0 ${width} ${height}`);
    picture.replaceChildren(...drawn);
    picture.setAttribute("aria-label", `${title} over widths of ${nameOf(gap)} up to ${shown(1e3 * far)} mm, ${counted(lines.length, "model")}`);
    const legend = lines.map(({ name }, i) => [looks(i), name]);
    if (Number.isFinite(provided)) legend.push([{ class: "now" }, `provided, ${shown(1e3 * provided)} mm`]);
    if (marks.length) {
      for (const [kind, text] of [["demand", "demand of this record"], ["code", "by codes"], ["rule", "by combination rules"]]) {
        legend.push([mark(kind), text]);
      }
    }
    const remarks = [];
    if (actions.differ(gap)) remarks.push("The levels of this gap have different widths: a curve is of one width at all levels, and the widths of the case have no place on it.");
    const jump = [...curves].filter(([, columns]) => columns.impacts.some((count, i) => count > 0 && Number.isNaN(columns.peak_force[i])));
    if (quantity === "peak_force" && jump.length) {
      remarks.push(`With ${jump.map(([name]) => name).join(", ")} velocities jump at impacts, which have no force: no curve is drawn where there are some.`);
    }
    remarks.push(...collapses());
    part("remarks").replaceChildren(...remarks.map((pieces) => html("p", { class: "note" }, ...[pieces].flat())));
    part("legend").replaceChildren(...legend.map(([look, text]) => html("li", {}, sample(look), text)));
    part("progress").textContent = done[0] < done[1] ? `${done[0]} of ${counted(done[1], "run")}` : done[1] ? counted(done[1], "run") : waiting;
    picture.dataset.done = String(done[0]);
    picture.dataset.all = String(done[1]);
  };

  // What stands at the axis: demand and widths by codes and rules.
  const marksOf = (gap) => {
    if (!gap) return [];
    const codes = gap.codes.filter((code) => code.width !== null).map((code) => [code.width, code.name, "code"]);
    const rules = gap.combinations.map((rule) => [rule.width, rule.name, "rule"]);
    return [[gap.demand, "demand of this record", "demand"], ...codes, ...rules];
  };
  const listed = () => {
    const gap = widths && widths.gaps[state.get().gap];
    if (!gap) {
      part("widths").replaceChildren();
      return;
    }
    const row = (name, width, note, kind) =>
      html("tr", {}, html("th", { scope: "row" }, sample(mark(kind)), name), html("td", {}, width === null ? "–" : shownAtLeast(1e3 * width)), html("td", { class: "words" }, note || ""));
    const code = (c) => row(`${c.edition || c.name}${c.clause ? `, ${c.clause}` : ""}`, c.width, c.caution || c.refusal || c.formula, "code");
    const known = gap.codes.filter((c) => c.width !== null);
    const others = gap.codes.filter((c) => c.width === null);
    const table = (rows) =>
      html(
        "table",
        {},
        html("thead", {}, html("tr", {}, html("th", { scope: "col" }, "width by"), html("th", { scope: "col" }, "mm"), html("th", { scope: "col", class: "words" }, "how"))),
        html("tbody", {}, ...rows),
      );
    const open = [...part("widths").querySelectorAll("details")].map((details) => details.open);
    part("widths").replaceChildren(
      html(
        "details",
        { open: open[0] },
        html("summary", {}, `Widths by ${counted(known.length, "provision")} of codes and ${counted(gap.combinations.length, "rule")}: the dashed lines`),
        table([
          row("this record", gap.demand, "maximum approach of the buildings without contact", "demand"),
          ...known.map(code),
          ...gap.combinations.map((rule) => row(rule.name, rule.width, "combination of the peak displacements", "rule")),
        ]),
      ),
      html("details", { open: open[1] }, html("summary", {}, `${others.length === 1 ? "1 provision gives" : `${others.length} provisions give`} no width`), table(others.map(code))),
    );
  };

  // All that a sweep depends on: anything but the width of the gap.
  const wantedNow = () => {
    const { gap, overlays } = state.get();
    return JSON.stringify([state.changesOfSweep(gap), gap, overlays, actions.opened()]);
  };
  // Whether all runs of the sweep of the state are done.
  const whole = () => finished !== null && finished === wantedNow();
  // Whether there are curves of this quantity.
  const has = (quantity) => Object.hasOwn(QUANTITIES, quantity);
  // Begins again where that was changed.
  const begin = async () => {
    const { gap, overlays } = state.get();
    const wanted = wantedNow();
    draw();
    if (wanted === asked) return;
    asked = wanted;
    finished = null;
    actions.changed();
    const mine = ++job;
    const stopped = () => mine !== job;
    // Nothing has a width.
    if (!named.length) {
      [done, curves, failed, widths] = [[0, 0], new Map(), new Map(), null];
      finished = wanted;
      return;
    }
    const told = (answer) => {
      if (answer.faults && !stopped()) part("progress").textContent = answer.faults[0].message;
      return answer.faults || stopped();
    };
    done = [0, 0];
    waiting = "what the record demands, and codes with it, is worked out …";
    draw();
    const answer = await background.ask({ do: "widths", changes: state.changes() });
    if (stopped()) return;
    waiting = "";
    [curves, failed] = [new Map(), new Map()];
    widths = answer.faults ? null : answer;
    listed();
    draw();
    if (told(answer)) return;
    const all = answer.columns[`sweep_${gap}`] || new Float64Array();
    actions.demanded(answer.gaps);
    const laws = [[null, actions.model(gap)], ...overlays.filter((name) => name !== actions.model(gap)).map((name) => [name, name])];
    done = [0, laws.length * all.length];
    const calibrations = [];
    part("calibrations").replaceChildren();
    waiting = all.length ? "" : "the record demands no gap: no widths are run";
    for (const [model, name] of laws) {
      let keys = null;
      if (model) {
        const calibrated = await background.ask({ do: "calibrate", changes: state.changes(), gap, model });
        if (told(calibrated)) return;
        keys = calibrated.keys;
        if (calibrated.notes.length) {
          calibrations.push(html("p", { class: "note" }, html("code", {}, model), `: ${calibrated.notes.join("; ")}`));
          part("calibrations").replaceChildren(...calibrations);
        }
      }
      const changes = state.changesOfSweep(gap, keys);
      const places = order(all.length);
      for (let first = 0; first < places.length; ) {
        const some = places.slice(first, first + AT_ONCE).map((i) => all[i]);
        const runs = await background.ask({ do: "sweep", changes, gap, widths: some });
        if (told(runs)) return;
        first += runs.columns.width.length;
        done[0] += runs.columns.width.length;
        curves.set(name, sorted(join(curves.get(name), runs.columns)));
        failed.set(name, [...(failed.get(name) || []), ...runs.failed]);
        ({ buildings } = runs);
        draw();
      }
    }
    finished = wanted;
    draw();
    actions.changed();
  };

  // The picture with its title above and its legend below: the styles of the page are not in a
  // picture of its own.
  const png = () => {
    const FACE = "12px system-ui, sans-serif";
    const canvas = html("canvas", {});
    const context = canvas.getContext("2d");
    context.font = FACE;
    const styled = (element, from) => {
      const copy = element.cloneNode(true);
      const parts = [from, ...from.querySelectorAll("*")];
      [copy, ...copy.querySelectorAll("*")].forEach((one, i) => {
        const style = getComputedStyle(parts[i]);
        for (const name of ["fill", "stroke", "stroke-width", "stroke-dasharray", "font-size", "font-family"]) {
          one.style.setProperty(name, style.getPropertyValue(name));
        }
      });
      return copy;
    };
    const plot = part("sweep");
    const [width, height] = plot.getAttribute("viewBox").split(" ").slice(2).map(Number);
    const ink = getComputedStyle(document.body).color;
    const words = (x, y, weight, text) => svg("text", { x, y, style: `font:${weight} ${FACE};fill:${ink}` }, text);
    const inside = [];
    // Lines of words, none wider than the picture unless a word is.
    const { selectedOptions } = part("gap");
    const of = selectedOptions.length ? `${document.querySelector("h1").textContent}, ${selectedOptions[0].textContent}` : document.title;
    let y = 0;
    let line = "";
    const LINE = 18;
    context.font = `bold ${FACE}`;
    for (const word of of.split(/\s+/)) {
      if (line && context.measureText(`${line} ${word}`).width > width - 16) {
        inside.push(words(8, (y += LINE), "bold", line));
        line = word;
      } else line = line ? `${line} ${word}` : word;
    }
    inside.push(words(8, (y += LINE), "bold", line));
    context.font = FACE;
    const picture = styled(plot, plot);
    for (const [name, value] of Object.entries({ x: 0, y: y + 6, width, height })) picture.setAttribute(name, value);
    inside.push(picture);
    y += 6 + height + LINE;
    let x = 8;
    for (const entry of part("legend").children) {
      const wide = SAMPLE + 6 + context.measureText(entry.textContent).width;
      if (x > 8 && x + wide > width - 8) [x, y] = [8, y + LINE];
      const key = styled(entry.firstChild, entry.firstChild);
      for (const [name, value] of Object.entries({ x, y: y - 8 })) key.setAttribute(name, value);
      inside.push(key, words(x + SAMPLE + 6, y, "normal", entry.textContent));
      x += wide + 18;
    }
    const high = y + 10;
    const whole = svg("svg", { xmlns: "http://www.w3.org/2000/svg", width, height: high, viewBox: `0 0 ${width} ${high}` }, ...inside);
    const image = new Image();
    image.onload = () => {
      canvas.width = 2 * width;
      canvas.height = 2 * high;
      context.fillStyle = getComputedStyle(document.body).backgroundColor;
      context.fillRect(0, 0, canvas.width, canvas.height);
      context.drawImage(image, 0, 0, canvas.width, canvas.height);
      canvas.toBlob((blob) => save("sweep.png", "image/png", blob));
    };
    image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(new XMLSerializer().serializeToString(whole))}`;
  };
  const csv = () => {
    const of = (named[state.get().gap] || "").replace(/^Gap /, "");
    // Columns have the names that `pounding gap --csv` gives them; a row a width, model and building.
    const lines = ["gap,model,width_m,building,displacement_amplification,impacts,peak_force_n,impact_energy_j,failure"];
    const number = (x) => (Number.isFinite(x) ? x : "");
    for (const [name, columns] of curves) {
      const messages = new Map(failed.get(name).map((run) => [run.width, run.message]));
      columns.width.forEach((width, i) => {
        if (messages.has(width)) {
          lines.push([quoted(of), name, width, "", "", "", "", "", quoted(messages.get(width))].join(","));
          return;
        }
        const after = [columns.impacts, columns.peak_force, columns.impact_energy].map((column) => number(column[i]));
        buildings.forEach((building, b) =>
          lines.push([quoted(of), name, width, quoted(building), number(columns[`displacement_${b}`][i]), ...after, ""].join(",")),
        );
      });
    }
    return `${lines.join("\n")}\n`;
  };

  const prepare = () => {
    for (const [name, [title]] of Object.entries(QUANTITIES)) part("quantity").append(new Option(title, name));
    part("quantity").addEventListener("change", (event) => state.look({ quantity: event.target.value }));
    part("gap").addEventListener("change", (event) => state.look({ gap: Number(event.target.value) }));
    part("png").addEventListener("click", png);
    part("sweep-csv").addEventListener("click", () => save("sweep.csv", "text/csv", csv()));
    addEventListener("resize", draw);
  };
  // The models that can be drawn beside the gap's own, and the gaps.
  const choices = (models, gaps) => {
    const { overlays, quantity, gap } = state.get();
    named = gaps;
    part("widths-section").hidden = !gaps.length;
    const boxes = models.map((model) => {
      const box = html("input", { type: "checkbox", value: model.name });
      box.checked = overlays.includes(model.name);
      box.addEventListener("change", () => {
        const others = state.get().overlays.filter((name) => name !== model.name);
        state.look({ overlays: box.checked ? [...others, model.name] : others });
      });
      return html("label", { title: model.title }, box, model.name);
    });
    part("overlays").replaceChildren(...boxes);
    part("quantity").value = QUANTITIES[quantity] ? quantity : "impacts";
    part("gap").replaceChildren(...gaps.map((name, i) => new Option(name, String(i), false, i === gap)));
    part("gap").closest("label").hidden = gaps.length < 2;
  };
  return { prepare, choices, begin, draw, whole, has };
};
