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
  // Four figures, as tables have them.
  const shown = (x) => {
    if (!Number.isFinite(x)) return "–";
    const size = Math.abs(x);
    if (size < 1e-12) return "0";
    if (size < 1e-4 || size >= 1e7) return x.toExponential(3).replace("e+", "e");
    return x.toFixed(Math.max(0, 3 - Number(size.toExponential(3).split("e")[1])));
  };
  const frames = numbers(data.frames);
  const picture = part("elevation");
  const scene = elevation(data.scene, picture);
  const { contacts, place } = scene;
  const bodies = scene.bodies.map((body, i) => ({
    ...body,
    displacement: data.displacements[i] ? numbers(data.displacements[i]) : null,
  }));
  const columns = Object.fromEntries(
    ["closes", "opens", "peak", "force", "impulse"].map((name) => [name, numbers(data.impacts[name])]),
  );
  const impacts = data.impacts.contact.map((contact, i) => ({
    contact,
    closes: columns.closes[i],
    // A contact that outlasts the run has no end.
    opens: Number.isNaN(columns.opens[i]) ? Infinity : columns.opens[i],
    peak: columns.peak[i],
    force: columns.force[i],
    impulse: columns.impulse[i],
    // Velocities jump: an impulse without a force.
    jumps: !(columns.force[i] > 0) && !Number.isNaN(columns.opens[i]),
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
    part("previous").disabled = !impacts.length || impacts[0].closes >= time;
    part("next").disabled = !impacts.length || impacts[impacts.length - 1].closes <= time;
    part("factor").textContent = magnification === 1 ? "to scale too" : `${magnification} times as wide as they are`;
    chart.mark();
  };
  // Opening and force of one level over time, drawn for the range that is looked at.
  const chart = (() => {
    const svg = part("chart");
    const space = "http://www.w3.org/2000/svg";
    // Samples and the instants of impacts as one curve, in order of time.
    const merged = (time, values, instants) => {
      const points = Array.from(time, (t, i) => [t, values[i]]).concat(instants.filter(([t]) => Number.isFinite(t)));
      points.sort((a, b) => a[0] - b[0]);
      return { time: points.map(([t]) => t), values: points.map(([, y]) => y) };
    };
    const series = data.series.map((s) => {
      const time = numbers(s.time);
      const here = impacts.filter((impact) => impact.contact === s.contact && s.contact !== null);
      const forced = here.filter((impact) => impact.force > 0);
      const jumps = here.filter((impact) => impact.jumps);
      const samples = s.force && numbers(s.force);
      // A gap closes at zero. How deep a contact goes that no sample is of, the curve does not know.
      const unseen = ({ closes, opens }) => !(time[place(time, opens)] >= closes);
      const touches = here.flatMap((impact) => (unseen(impact) ? [[impact.closes, 0], [impact.opens, 0]] : [[impact.closes, 0]]));
      const instants = forced.flatMap(({ closes, peak, force, opens }) => [[closes, 0], [peak, force], [opens, 0]]);
      const stems = jumps.flatMap(({ closes, impulse }) => [[closes, 0], [closes, impulse], [closes, 0]]);
      return {
        ...s,
        opening: merged(time, numbers(s.opening), touches),
        // Rigid impacts have no force but that which holds floors together.
        force: samples && (!jumps.length || forced.length || samples.some((x) => x !== 0)) ? merged(time, samples, instants) : null,
        impulse: jumps.length ? merged([start, end], [0, 0], stems) : null,
      };
    });
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
    // Labels of values an even step apart, as the figures of the page have them.
    const raised = (x) => {
      const [digits, power] = x.toExponential(1).replace(".0", "").split("e");
      const above = String(Number(power)).replace(/./g, (c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]);
      return (Math.abs(Number(digits)) === 1 ? digits.replace("1", "") : `${digits}×`) + `10${above}`;
    };
    const labels = (values) => {
      const step = values.length > 1 ? values[1] - values[0] : Math.abs(values[0]) || 1;
      const decimals = Math.max(0, Math.ceil(-Math.log10(step) - 1e-9));
      const far = Math.max(...values.map(Math.abs)) >= 1e6 || decimals > 5;
      return values.map((x) => (x === 0 ? "0" : far ? raised(x) : x.toFixed(decimals)).replace("-", "−"));
    };
    const panel = (curve, factor, [top, bottom], names, kind) => {
      const { time: times, values } = curve;
      const first = place(times, range[0]);
      const last = Math.min(place(times, range[1]) + 1, times.length - 1);
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
      const even = ticks(low, high, 4);
      const words = labels(even);
      even.forEach((y, i) => {
        add("path", { class: y === 0 ? "zero" : "axis", d: `M${margin.left} ${up(y)}H${width - margin.right}` });
        add("text", { x: margin.left - 6, y: up(y) + 4, "text-anchor": "end" }, words[i]);
      });
      let path = "";
      let pen = "M";
      for (let i = first; i <= last; i++) {
        const y = factor * values[i];
        if (Number.isFinite(y)) {
          path += `${pen}${across(times[i]).toFixed(2)} ${up(y).toFixed(2)}`;
          pen = "L";
        } else pen = "M";
      }
      const clip = document.createElementNS(space, "svg");
      clip.setAttribute("x", margin.left);
      clip.setAttribute("y", top - 2);
      clip.setAttribute("width", Math.max(1, width - margin.left - margin.right));
      clip.setAttribute("height", bottom - top + 4);
      clip.setAttribute("viewBox", `${margin.left} ${top - 2} ${Math.max(1, width - margin.left - margin.right)} ${bottom - top + 4}`);
      const line = document.createElementNS(space, "path");
      line.setAttribute("class", kind);
      line.setAttribute("d", path);
      clip.append(line);
      svg.append(clip);
    };
    const redraw = () => {
      if (!series.length) return;
      const [width, height] = size();
      svg.replaceChildren();
      svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
      const s = series[chosen];
      const panels = [
        [s.opening, 1e3, ["Distance across the gap (mm), 0 and below: contact", "Distance (mm), 0 and below: contact", "Distance (mm)"], "opening"],
        [s.force, 1e-3, ["Contact force (kN)"], "force"],
        [s.impulse, 1e-3, ["Impulse (kN s): velocities jump, without a force", "Impulse (kN s)"], "impulse"],
      ].filter(([curve]) => curve);
      const high = (height - 40) / panels.length;
      panels.forEach(([curve, factor, names, kind], i) => panel(curve, factor, [i * high + 24 + 8 * (i > 0), (i + 1) * high - 4 + 8 * (i > 0)], names, kind));
      for (const t of ticks(range[0], range[1], Math.max(2, Math.floor(width / 110)))) {
        // A label at the end has room to its right.
        const label = String(t);
        add("text", { x: Math.min(across(t), width - 3.6 * label.length), y: height - 18, "text-anchor": "middle" }, label);
      }
      add("text", { x: width / 2, y: height - 3, "text-anchor": "middle" }, "time (s)");
      // Behind the curves, of which it would hide the impact at its time.
      now = add("path", { class: "now" });
      svg.prepend(now);
      mark();
      const digits = Math.min(12, Math.max(3, 2 - Math.floor(Math.log10(range[1] - range[0]))));
      svg.setAttribute(
        "aria-label",
        `Opening and ${s.impulse ? "impulses" : "contact force"} of ${s.name} from ${range[0].toFixed(digits)} to ${range[1].toFixed(digits)} s`,
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
    // As close as to see the shortest contact.
    const lasts = impacts.map(({ closes, opens }) => opens - closes).filter((x) => x > 0);
    const least = lasts.reduce((a, b) => Math.min(a, 4 * b), 20 * data.step);
    const show = (low, high) => {
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
