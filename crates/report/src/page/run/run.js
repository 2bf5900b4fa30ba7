"use strict";
// The buildings of a run in motion, and histories around its impacts. All that it shows stands in
// the element `data`; without this script the page is complete, with a figure in its place.
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);

  // Numbers that were written as base64, in the order of bytes of all current machines.
  const numbers = (packed) => {
    const text = atob(packed.data);
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
    if (packed.type === "float64") return new Float64Array(bytes.buffer);
    if (packed.type === "float32") return new Float32Array(bytes.buffer);
    const words = new Int16Array(bytes.buffer);
    return Float64Array.from(words, (w) => (w === -32768 ? NaN : w * packed.scale));
  };
  const known = new Map();
  const part = (name) => {
    if (!known.has(name)) known.set(name, document.querySelector(`[data-part="${name}"]`));
    return known.get(name);
  };
  const shown = (x) => (Number.isFinite(x) ? String(Number(x.toPrecision(4))) : "–");
  const frames = numbers(data.frames);
  const picture = part("elevation");
  const scene = elevation(data.scene, picture);
  const { contacts, place } = scene;
  const bodies = scene.bodies.map((body, i) => ({
    ...body,
    displacement: data.displacements[i] ? numbers(data.displacements[i]) : null,
  }));
  const columns = Object.fromEntries(
    ["closes", "opens", "force", "impulse"].map((name) => [name, numbers(data.impacts[name])]),
  );
  const impacts = data.impacts.contact.map((contact, i) => ({
    contact,
    closes: columns.closes[i],
    // A contact that outlasts the run has no end.
    opens: Number.isNaN(columns.opens[i]) ? Infinity : columns.opens[i],
    force: columns.force[i],
    impulse: columns.impulse[i],
  }));
  const [start, end] = [frames[0], frames[frames.length - 1]];
  let time = data.time;
  let magnification = data.magnification;
  let playing = false;

  const draw = () => {
    const k = place(frames, time);
    const next = Math.min(k + 1, frames.length - 1);
    const step = frames[next] - frames[k];
    const share = step > 0 ? Math.min(1, Math.max(0, (time - frames[k]) / step)) : 0;
    for (const body of bodies) {
      const storeys = body.elevation.length;
      if (body.displacement) {
        for (let i = 0; i < storeys; i++) {
          const before = body.displacement[k * storeys + i];
          const after = body.displacement[next * storeys + i];
          body.now[i + 1] = share === 0 ? before : before + share * (after - before);
        }
      }
    }
    // While it plays a contact stays in sight for a sixth of a second.
    const lasting = playing ? Number(part("speed").value) / 6 : 0;
    const closed = new Set();
    for (let i = 0; i < impacts.length; i++) {
      const impact = impacts[i];
      if (impact.closes > time) break;
      if (time <= Math.max(impact.opens, impact.closes + lasting)) closed.add(impact.contact);
    }
    scene.draw(magnification, closed);
    picture.dataset.time = String(time);
    part("time").value = String(time);
    part("time").setAttribute("aria-valuetext", `${time.toFixed(3)} s`);
    part("now").textContent = `${time.toFixed(3)} s`;
    part("instant").textContent = time.toFixed(3);
    part("factor").textContent = magnification === 1 ? "to scale too" : `${magnification} times as wide as they are`;
    chart.mark();
  };
  // Opening and force of one level over time, drawn for the range that is looked at.
  const chart = (() => {
    const svg = part("chart");
    const space = "http://www.w3.org/2000/svg";
    const series = data.series.map((s) => ({
      ...s,
      time: numbers(s.time),
      opening: numbers(s.opening),
      force: s.force ? numbers(s.force) : null,
    }));
    const margin = { left: 64, right: 12 };
    let range = [start, end];
    let chosen = Math.max(0, series.findIndex((s) => s.contact === data.contact));
    let now = null;
    const add = (name, attributes, text) => {
      const element = document.createElementNS(space, name);
      for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
      if (text !== undefined) element.textContent = text;
      svg.append(element);
      return element;
    };
    const size = () => [svg.clientWidth || 320, svg.clientHeight || 416];
    const across = (t) => {
      const [width] = size();
      return margin.left + ((t - range[0]) / (range[1] - range[0])) * (width - margin.left - margin.right);
    };
    const ticks = (low, high, count) => {
      const rough = (high - low) / count || 1;
      const power = 10 ** Math.floor(Math.log10(rough));
      const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= rough);
      const out = [];
      for (let i = Math.ceil(low / step); i * step <= high; i++) out.push(Number((i * step).toPrecision(12)));
      return out;
    };
    const panel = (values, factor, [top, bottom], names, kind) => {
      const s = series[chosen];
      const first = place(s.time, range[0]);
      const last = Math.min(place(s.time, range[1]) + 1, s.time.length - 1);
      let [low, high] = [0, 0];
      for (let i = first; i <= last; i++) {
        const y = factor * values[i];
        if (y < low) low = y;
        if (y > high) high = y;
      }
      if (high === low) high = low + 1;
      const up = (y) => bottom - ((y - low) / (high - low)) * (bottom - top);
      const [width] = size();
      // The longest of its names that has room.
      const heading = add("text", { x: margin.left, y: top - 8, "data-heading": kind }, "");
      for (const words of names) {
        heading.textContent = words;
        if (heading.getComputedTextLength() <= width - margin.left) break;
      }
      for (const y of ticks(low, high, 4)) {
        add("path", { class: y === 0 ? "zero" : "axis", d: `M${margin.left} ${up(y)}H${width - margin.right}` });
        add("text", { x: margin.left - 6, y: up(y) + 4, "text-anchor": "end" }, shown(y));
      }
      let path = "";
      let pen = "M";
      for (let i = first; i <= last; i++) {
        const y = factor * values[i];
        if (Number.isFinite(y)) {
          path += `${pen}${across(s.time[i]).toFixed(2)} ${up(y).toFixed(2)}`;
          pen = "L";
        } else pen = "M";
      }
      const clip = document.createElementNS(space, "svg");
      clip.setAttribute("x", margin.left);
      clip.setAttribute("y", top - 2);
      clip.setAttribute("width", Math.max(1, width - margin.left - margin.right));
      clip.setAttribute("height", bottom - top + 4);
      clip.setAttribute("viewBox", `${margin.left} ${top - 2} ${Math.max(1, width - margin.left - margin.right)} ${bottom - top + 4}`);
      const curve = document.createElementNS(space, "path");
      curve.setAttribute("class", kind);
      curve.setAttribute("d", path);
      clip.append(curve);
      svg.append(clip);
    };
    const redraw = () => {
      if (!series.length) return;
      const [width, height] = size();
      svg.replaceChildren();
      svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
      const s = series[chosen];
      const middle = s.force ? (height - 40) / 2 : height - 40;
      panel(s.opening, 1e3, [24, middle - 4], ["Distance across the gap (mm), 0 and below: contact", "Distance (mm), 0 and below: contact", "Distance (mm)"], "opening");
      if (s.force) panel(s.force, 1e-3, [middle + 32, height - 36], ["Contact force (kN)"], "force");
      for (const t of ticks(range[0], range[1], Math.max(2, Math.floor(width / 110)))) {
        add("text", { x: across(t), y: height - 18, "text-anchor": "middle" }, String(t));
      }
      add("text", { x: width / 2, y: height - 3, "text-anchor": "middle" }, "time (s)");
      now = add("path", { class: "now" });
      mark();
      svg.setAttribute(
        "aria-label",
        `Opening and contact force of ${s.name} from ${range[0].toFixed(3)} to ${range[1].toFixed(3)} s`,
      );
      svg.dataset.from = String(range[0]);
      svg.dataset.to = String(range[1]);
    };
    const mark = () => {
      if (!now) return;
      const x = across(time);
      const [width, height] = size();
      const inside = x >= margin.left - 1 && x <= width - margin.right + 1;
      now.setAttribute("d", inside ? `M${x} 20V${height - 34}` : "");
    };
    const show = (low, high) => {
      const least = 20 * data.step;
      const wide = Math.min(Math.max(high - low, least), end - start);
      low = Math.min(Math.max((low + high - wide) / 2, start), end - wide);
      range = [low, low + wide];
      redraw();
    };
    const zoom = (factor, about) => {
      const [low, high] = range;
      show(about - factor * (about - low), about + factor * (high - about));
    };
    const shift = (parts) => {
      const by = parts * (range[1] - range[0]);
      show(range[0] + by, range[1] + by);
    };
    const centre = () => (time >= range[0] && time <= range[1] ? time : (range[0] + range[1]) / 2);
    const commands = {
      closer: () => zoom(0.5, centre()),
      farther: () => zoom(2, centre()),
      earlier: () => shift(-0.25),
      later: () => shift(0.25),
      everything: () => show(start, end),
    };
    for (const [name, command] of Object.entries(commands)) part(name).addEventListener("click", command);
    const keys = { "+": "closer", "=": "closer", "-": "farther", ArrowLeft: "earlier", ArrowRight: "later", Home: "everything" };
    svg.addEventListener("keydown", (event) => {
      const command = keys[event.key];
      if (command && !event.ctrlKey && !event.altKey && !event.metaKey) {
        commands[command]();
        event.preventDefault();
      }
    });
    const at = (event) => {
      const [width] = size();
      const x = event.clientX - svg.getBoundingClientRect().left;
      return range[0] + ((x - margin.left) / (width - margin.left - margin.right)) * (range[1] - range[0]);
    };
    svg.addEventListener(
      "wheel",
      (event) => {
        if (document.activeElement !== svg) return;
        zoom(event.deltaY < 0 ? 0.8 : 1.25, at(event));
        event.preventDefault();
      },
      { passive: false },
    );
    svg.addEventListener("click", (event) => {
      svg.focus();
      go(at(event));
    });
    const select = part("level");
    series.forEach((s, i) => select.append(new Option(s.name, String(i))));
    select.value = String(chosen);
    select.addEventListener("change", () => {
      chosen = Number(select.value);
      redraw();
    });
    addEventListener("resize", redraw);
    const around = (impact) => {
      const found = series.findIndex((s) => s.contact === impact.contact);
      if (found >= 0) {
        chosen = found;
        select.value = String(found);
      }
      const half = data.window;
      show(impact.closes - half, (Number.isFinite(impact.opens) ? impact.opens : impact.closes) + half);
    };
    return { redraw, mark, around, any: series.length > 0 };
  })();

  const go = (t) => {
    time = Math.min(Math.max(t, start), end);
    draw();
  };
  const button = part("play");
  let before = 0;
  const tick = (stamp) => {
    if (!playing) return;
    const passed = before ? (stamp - before) / 1000 : 0;
    before = stamp;
    time = Math.min(time + passed * Number(part("speed").value), end);
    if (time >= end) play(false);
    draw();
    if (playing) requestAnimationFrame(tick);
  };
  const play = (wanted) => {
    playing = wanted;
    button.textContent = wanted ? "Pause" : "Play";
    if (wanted) {
      if (time >= end) time = start;
      before = 0;
      requestAnimationFrame(tick);
    }
  };
  button.addEventListener("click", () => {
    play(!playing);
    draw();
  });
  part("time").addEventListener("input", (event) => {
    play(false);
    go(Number(event.target.value));
  });
  part("magnification").addEventListener("change", (event) => {
    magnification = Number(event.target.value);
    draw();
  });

  const list = part("impacts");
  impacts.forEach((impact, i) => {
    const contact = contacts[impact.contact];
    const size = impact.force > 0 ? `${shown(impact.force / 1e3)} kN` : `${shown(impact.impulse / 1e3)} kN s`;
    list.append(new Option(`${impact.closes.toFixed(4)} s, ${contact.name}, ${size}`, String(i)));
  });
  const jump = (i) => {
    if (!impacts.length) return;
    const chosen = Math.min(Math.max(i, 0), impacts.length - 1);
    play(false);
    list.value = String(chosen);
    go(impacts[chosen].closes);
    chart.around(impacts[chosen]);
  };
  list.addEventListener("change", () => jump(Number(list.value)));
  part("previous").addEventListener("click", () => {
    let i = impacts.length - 1;
    while (i > 0 && impacts[i].closes >= time) i--;
    jump(i);
  });
  part("next").addEventListener("click", () => {
    const i = impacts.findIndex((impact) => impact.closes > time);
    jump(i < 0 ? impacts.length - 1 : i);
  });

  for (const element of document.querySelectorAll(".live")) element.hidden = false;
  part("history").hidden = !chart.any;
  part("jump").hidden = !impacts.length;
  draw();
  chart.redraw();
  addEventListener("resize", draw);
})();
