"use strict";
// The buildings in motion. The run may be another at any moment: the time stays.
const motion = (() => {
  const { part, svg, shown, counted } = elements;
  const MAGNIFICATIONS = [1, 2, 5, 10, 20, 50, 100, 200, 500];
  // A contact that is over stays in sight for this part of a second of the reader.
  const LASTING = 1 / 6;
  let run = null;
  let scene = null;
  let time = null;
  let playing = false;

  // Elements for these bodies and contacts.
  const prepare = (given) => {
    const picture = part("elevation");
    const radius = 0.02 * given.height;
    picture.replaceChildren(
      svg("path", { class: "ground", "data-part": "ground" }),
      ...given.bodies.flatMap((body, i) => [
        svg("path", { class: body.building === null ? "wall" : "building", "data-body": i }),
        svg("text", { "data-name": i, class: given.names.turned ? "turned" : null }, svg("title", {}, body.title), body.shown),
      ]),
      ...given.contacts.flatMap((contact, i) => [
        svg("path", { class: "edge", "data-edge": i }),
        svg("circle", { class: "contact", "data-contact": i, r: radius }, svg("title", {}, contact.name)),
      ]),
    );
  };
  const magnification = () => Number(part("magnification").value) || run.scene.magnification;

  const draw = () => {
    if (!run) return;
    const { time: times, displacement } = run.columns;
    const rows = times.length;
    const k = scene.place(times, time);
    const next = Math.min(k + 1, rows - 1);
    const step = times[next] - times[k];
    const share = step > 0 ? Math.min(1, Math.max(0, (time - times[k]) / step)) : 0;
    const floors = displacement.length / rows;
    let column = 0;
    for (const body of scene.bodies) {
      if (body.building === null) continue;
      for (let i = 0; i < body.elevation.length; i++, column++) {
        const before = displacement[k * floors + column];
        const after = displacement[next * floors + column];
        body.now[i + 1] = before + share * (after - before);
      }
    }
    const { impact_t_close: closes, impact_t_open: opens, impact_level: levels } = run.columns;
    const lasting = playing ? Number(part("speed").value) * LASTING : 0;
    const closed = new Set();
    for (let i = 0; i < closes.length && closes[i] <= time; i++) {
      const end = Number.isNaN(opens[i]) ? Infinity : opens[i];
      if (time <= Math.max(end, closes[i] + lasting)) closed.add(levels[i]);
    }
    const factor = magnification();
    scene.draw(factor, closed);
    part("instant").textContent = time.toFixed(3);
    part("factor").textContent = factor === 1 ? "to scale too" : `${shown(factor)} times as wide as they are`;
    part("elevation").dataset.time = String(time);
    part("time").value = String(time);
    part("time").setAttribute("aria-valuetext", `${time.toFixed(2)} s`);
    part("now").textContent = `${time.toFixed(2)} s`;
  };

  let before = 0;
  const tick = (stamp) => {
    if (!playing || !run) return;
    const end = run.columns.time[run.columns.time.length - 1];
    time += before ? ((stamp - before) / 1000) * Number(part("speed").value) : 0;
    if (time >= end) time = 0;
    before = stamp;
    draw();
    requestAnimationFrame(tick);
  };
  const play = (wanted) => {
    playing = wanted;
    part("play").textContent = wanted ? "Pause" : "Play";
    before = 0;
    if (wanted) requestAnimationFrame(tick);
    draw();
  };
  const jump = (forward) => {
    const closes = run ? [...run.columns.impact_t_close] : [];
    if (!closes.length) return;
    play(false);
    const later = closes.find((t) => t > time + 1e-9);
    const earlier = closes.filter((t) => t < time - 1e-9).pop();
    // As on the page of a run: behind the last impact there is no other.
    time = forward ? (later ?? closes[closes.length - 1]) : (earlier ?? closes[0]);
    draw();
  };

  const begin = () => {
    for (const m of MAGNIFICATIONS) part("magnification").append(new Option(String(m), String(m)));
    part("play").addEventListener("click", () => play(!playing));
    part("previous").addEventListener("click", () => jump(false));
    part("next").addEventListener("click", () => jump(true));
    part("magnification").addEventListener("change", draw);
    addEventListener("resize", draw);
    part("time").addEventListener("input", (event) => {
      // Before anything is drawn, which moves the bar to the time that was.
      time = Number(event.target.value);
      play(false);
    });
  };

  // Shows another run of the case, from where the last one stood.
  const show = (answer) => {
    const first = !run;
    const shape = (r) => JSON.stringify([r.scene.bodies.map((b) => [b.title, b.elevation]), r.scene.names, r.scene.contacts.map((c) => c.name)]);
    if (first || shape(run) !== shape(answer)) prepare(answer.scene);
    run = answer;
    scene = elevation(answer.scene, part("elevation"));
    const { time: times, impact_t_close: closes, impact_peak_force: forces } = answer.columns;
    const end = times[times.length - 1];
    if (time === null) {
      // The hardest impact.
      let hardest = 0;
      forces.forEach((force, i) => {
        if (force > forces[hardest]) hardest = i;
      });
      time = closes.length ? closes[hardest] : 0;
    }
    time = Math.min(time, end);
    part("time").max = String(end);
    part("automatic").textContent = `automatic (${shown(answer.scene.magnification)})`;
    const names = answer.scene.bodies.map((body) => body.title).join(", ");
    part("elevation").setAttribute("aria-label", `Elevation of ${names}, moving; ${counted(closes.length, "impact")}`);
    if (first && !matchMedia("(prefers-reduced-motion: reduce)").matches) play(true);
    else draw();
  };
  return { begin, show };
})();
