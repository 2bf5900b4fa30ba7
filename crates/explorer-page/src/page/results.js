"use strict";
// The answer of the run: in numbers, storey by storey, and its impacts over time.
const resultsOf = (documentation) => {
  const { part, html, svg, shown, shownBeside, ratio, quoted, counted, ticks, more } = elements;
  const GAP_CHECK = "reference/gap-check.md";
  const RESULT = "reference/result-file.md";
  const most = (values) => values.reduce((m, x) => (x > m ? x : m), 0);

  const differ = (levels) => levels.some((level) => level.width !== levels[0].width);
  // The level of a gap with the least to spare: its demand and its width are those that say whether
  // the gap is wide enough.
  const governing = (run, index) => {
    const spare = run.summary.gaps[index].levels.map((level, i) => level.width - (run.demand[index][i].peak ?? NaN));
    return spare.reduce((least, x, i) => (least < 0 || x < spare[least] ? i : least), -1);
  };

  // Where velocities jump the largest force is none of an impact.
  const forceOf = (force, jumps, impacts) => {
    const kilonewtons = `${shown(1e-3 * force)} kN`;
    const held = force > 0 ? `; floors that stay in touch are held together by ${kilonewtons} at most` : "";
    return [
      "force",
      "Peak contact force",
      jumps ? "none: velocities jump" : impacts && force > 0 ? kilonewtons : "none",
      jumps ? `impacts are jumps of the velocity, which have no force${held}` : "the largest force of all impacts",
      RESULT,
    ];
  };

  // What a gap demands; a building that collapses without contact leaves that unknown.
  const demandOf = (demand, millimetres, name, where) => {
    const known = Number.isFinite(demand);
    const text = known ? `${millimetres} mm` : "not known";
    const means = known
      ? `the width that the buildings without contact would just not close${where}`
      : "without contact a building collapses, or cannot be followed to the end";
    return ["demand", `Gap demand${known ? name : ""}`, text, means, GAP_CHECK];
  };

  // The numbers of a gap, each with what it is.
  const numbersOf = (run, index) => {
    const gap = run.summary.gaps[index];
    const levels = gap.levels;
    const at = governing(run, index);
    const demand = at < 0 ? NaN : run.demand[index][at].peak ?? NaN;
    const width = at < 0 ? NaN : levels[at].width;
    const level = run.levels[index][at];
    const name = differ(levels) ? ` at level ${level}` : "";
    const where = levels.length > 1 ? `, at level ${level}${differ(levels) ? ", which has the least to spare" : ""}` : "";
    const widthOf = differ(levels) ? `the width at rest of level ${level}; those of the others are below` : "the width of the gap at rest";
    const force = most(levels.map((level) => level.peak_force.peak ?? NaN));
    const impacts = levels.reduce((sum, level) => sum + level.impacts, 0);
    const [demanded, provided] = shownBeside(1e3 * demand, 1e3 * width);
    return [
      demandOf(demand, demanded, name, where),
      ["width", `Provided width${name}`, `${provided} mm`, widthOf, "reference/case-file.md"],
      ["impacts", "Impacts", String(impacts), "how often floors came into contact, at all levels", RESULT],
      forceOf(force, run.jumps[index] !== null, impacts),
    ];
  };
  // Widths that differ by level, each with what its level demands and how often it closed.
  const levelsOf = (run, index) => {
    const { levels } = run.summary.gaps[index];
    if (!differ(levels)) return null;
    const head = ["level", "width (mm)", "demand (mm)", "impacts"].map((word) => html("th", { scope: "col" }, word));
    const rows = levels.map((level, i) =>
      html(
        "tr",
        {},
        html("th", { scope: "row" }, run.levels[index][i]),
        ...[...shownBeside(1e3 * (run.demand[index][i].peak ?? NaN), 1e3 * level.width).reverse(), String(level.impacts)].map((text) => html("td", {}, text)),
      ),
    );
    const table = html("table", {}, html("thead", {}, html("tr", {}, ...head)), html("tbody", {}, ...rows));
    return html("div", { class: "wide", "data-levels": index, tabindex: 0, role: "region", "aria-label": "Levels of the gap" }, table);
  };
  // With contact over without; null where nothing moves without, which is no 1.
  const ratioOf = (run, building, storey, key) =>
    run.summary.buildings[building].isolated[storey][key].peak !== 0 ? run.amplification[building][storey][key] : null;
  const whole = (run) => {
    const ratios = run.amplification.flatMap((storeys, b) => storeys.map((_, s) => ratioOf(run, b, s, "displacement")));
    const amplified = Math.max(...ratios.filter((x) => x !== null));
    const input = run.summary.energy.input ?? NaN;
    const sum = run.columns.impact_energy_dissipated.reduce((sum, x) => sum + x, 0);
    // Less than the ledger resolves is round-off, of either sign.
    const dissipated = Math.abs(sum) <= 1e-9 * Math.abs(input) ? 0 : sum;
    return [
      ["amplification", "Amplification", ratio(amplified), "the largest ratio of a displacement to that of the run without contact; below are all ratios", GAP_CHECK],
      ["dissipated", "Energy in contacts", `${shown(1e-3 * dissipated)} kJ`, "energy that contacts dissipated", RESULT],
    ];
  };
  const card = ([name, title, text, what, page], gap) =>
    html(
      "div",
      { class: "number" },
      html("dt", {}, title),
      html("dd", { "data-result": name, "data-gap": gap }, text),
      html("dd", { class: "note" }, `${what} `, more(documentation, page)),
    );

  const QUANTITIES = [
    ["displacement", "displacement", "mm", 1e3],
    ["storey_shear", "storey shear", "kN", 1e-3],
    ["acceleration_absolute", "acceleration", "g", 1 / 9.80665],
  ];
  const storeys = (run) => {
    const head = html(
      "thead",
      {},
      html(
        "tr",
        {},
        html("th", { scope: "col" }, "storey"),
        ...QUANTITIES.map(([, title, unit]) => html("th", { scope: "colgroup", colspan: 3 }, `${title} (${unit})`)),
      ),
      html(
        "tr",
        {},
        html("th", { scope: "col" }, ""),
        ...QUANTITIES.flatMap(() => ["with", "without", "ratio"].map((word) => html("th", { scope: "col" }, word))),
      ),
    );
    const rows = run.summary.buildings.flatMap((building, b) =>
      building.storeys.map((with_, s) =>
        html(
          "tr",
          {},
          html("th", { scope: "row" }, `${building.name} ${s + 1}`),
          ...QUANTITIES.flatMap(([key, , , factor]) => {
            const without = building.isolated[s];
            const value = ratioOf(run, b, s, key);
            const cell = html("td", { "data-amplification": key, class: value > 1.005 ? "more" : value !== null && value < 0.995 ? "less" : null }, ratio(value ?? NaN));
            return [html("td", {}, shown(factor * (with_[key].peak ?? NaN))), html("td", {}, shown(factor * (without[key].peak ?? NaN))), cell];
          }),
        ),
      ),
    );
    return html("table", {}, head, html("tbody", {}, ...rows));
  };

  let last = null;

  // Impacts as lines over time, as high as their force, or their impulse where velocities jump.
  const impacts = (run) => {
    const picture = part("impacts");
    const { impact_t_close: closes, impact_peak_force: forces, impact_impulse: impulses, time } = run.columns;
    const jumps = forces.some((force) => Number.isNaN(force));
    const values = jumps ? impulses : forces;
    const [width, height] = [picture.clientWidth || 640, 200];
    const [left, right, top, bottom] = [64, 24, 24, height - 34];
    const end = time[time.length - 1] || 1;
    const high = 1e-3 * most([...values]) || 1;
    const [what, unit] = jumps ? ["impulses of impacts", "kN s"] : ["peak forces of impacts", "kN"];
    const across = (t) => left + (t / end) * (width - left - right);
    const up = (y) => bottom - (y / high) * (bottom - top);
    // Without impacts there is no scale, as there is nothing to draw.
    const none = !closes.length;
    const levels = none ? [] : ticks(0, high, 3);
    const marks = [
      ...levels.map((y) => [svg("path", { class: "axis", d: `M${left} ${up(y)}H${width - right}` }), svg("text", { x: left - 6, y: up(y) + 4, "text-anchor": "end" }, shown(y))]).flat(),
      ...ticks(0, end, Math.max(2, Math.floor(width / 110))).map((t) => svg("text", { x: across(t), y: bottom + 16, "text-anchor": "middle" }, String(t))),
      svg("text", { x: left, y: 14 }, none ? "impacts: none" : `${what} (${unit})`),
      none ? svg("path", { class: "axis", d: `M${left} ${bottom}H${width - right}` }) : null,
      svg("text", { x: (left + width) / 2, y: height - 4, "text-anchor": "middle" }, "time (s)"),
    ];
    let path = "";
    closes.forEach((t, i) => {
      path += `M${across(t).toFixed(1)} ${bottom}V${up(1e-3 * values[i]).toFixed(1)}`;
    });
    picture.setAttribute("viewBox", `0 0 ${width} ${height}`);
    picture.replaceChildren(...marks.filter((mark) => mark !== null), svg("path", { class: "force", d: path }));
    picture.setAttribute("aria-label", `${none ? "no impacts" : counted(closes.length, "impact")} over ${shown(end)} s${none ? "" : `, the largest ${shown(high)} ${unit}`}`);
  };

  return {
    // Whether levels of a gap have not all the same width.
    differ,
    // For a window of another size.
    redraw: () => last && impacts(last),
    show: (run) => {
      last = run;
      const gaps = run.summary.gaps.map((gap, i) => {
        const cards = numbersOf(run, i).map((number) => card(number, i));
        return html("div", {}, run.summary.gaps.length > 1 ? html("h3", {}, `Gap ${gap.name}`) : null, html("dl", { class: "numbers" }, ...cards), levelsOf(run, i));
      });
      part("numbers").replaceChildren(...gaps, html("dl", { class: "numbers" }, ...whole(run).map((number) => card(number))));
      part("storeys").replaceChildren(storeys(run));
      const jumps = [...new Set(run.jumps.filter((text) => text !== null))];
      part("warnings").replaceChildren(
        ...jumps.map((text) => html("p", { class: "warning", "data-jumps": true }, text)),
        ...run.summary.warnings.map((text) => html("p", { class: "warning" }, `Warning: ${text}`)),
      );
      part("excitation").textContent = run.excitation.join("; ");
      part("impacts").closest(".chart").hidden = !run.summary.gaps.length;
      impacts(run);
    },
    words: (run) =>
      run.summary.gaps
        .map((gap, i) => `${gap.name}: ${numbersOf(run, i).map(([, title, text]) => `${title.toLowerCase()} ${text}`).join(", ")}`)
        .join("; "),
    // Peaks of the run as a table of comma-separated values, in SI.
    csv: (run) => {
      const lines = [["building", "storey", ...QUANTITIES.flatMap(([key]) => [key, `${key}_isolated`, `${key}_amplification`])].join(",")];
      run.summary.buildings.forEach((building, b) =>
        building.storeys.forEach((with_, s) => {
          const cells = QUANTITIES.flatMap(([key]) => [with_[key].peak, building.isolated[s][key].peak, ratioOf(run, b, s, key)]);
          lines.push([quoted(building.name), s + 1, ...cells.map((x) => x ?? "")].join(","));
        }),
      );
      return `${lines.join("\n")}\n`;
    },
  };
};
