"use strict";
// Buildings in elevation that move. `scene` is what `Scene::json` gives; `picture` is an SVG with an
// element `data-body` and `data-name` for every body, `data-contact` and `data-edge` for every
// contact, and the part `ground`.
const elevation = (scene, picture) => {
  // The place of the last entry that is not greater; 0 before all of them.
  const place = (sorted, x) => {
    let low = 0;
    let high = sorted.length;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (sorted[middle] <= x) low = middle;
      else high = middle;
    }
    return low;
  };
  const element = (kind, number) => picture.querySelector(`[data-${kind}="${number}"]`);
  const ground = picture.querySelector('[data-part="ground"]');
  const bodies = scene.bodies.map((body, i) => ({
    ...body,
    element: element("body", i),
    name: element("name", i),
    // Displacements of the base, which is zero, and of the floors.
    now: new Float64Array(body.elevation.length + 1),
  }));
  const contacts = scene.contacts.map((contact, i) => ({
    ...contact,
    element: element("contact", i),
    edge: element("edge", i),
  }));

  // Where the side of a body is that faces a level, in the picture.
  const side = (body, magnification, height, right) => {
    const rest = body.left + (right ? body.width : 0) + magnification * body.offset;
    if (body.building === null) return rest;
    const z = [0, ...body.elevation];
    const k = Math.min(place(z, height), z.length - 2);
    const share = Math.min(1, Math.max(0, (height - z[k]) / (z[k + 1] - z[k] || 1)));
    return rest + magnification * (body.now[k] + share * (body.now[k + 1] - body.now[k]));
  };

  // Names have at least this size (px), however wide the picture of displacements gets.
  const LEAST = 11;
  // Middle of the base of a body.
  const middle = (body, magnification) => body.left + magnification * body.offset + body.width / 2;
  // Width of the picture, and the left end of the ground.
  const across = (magnification) => {
    const reach = magnification * scene.reach;
    return { left: -scene.margin - reach, width: scene.width + magnification * scene.offsets + 2 * (scene.margin + reach) };
  };
  const { size: usual, turned, below } = scene.names;
  let sized = { magnification: 0, window: 0, size: usual };
  const sizeAt = (magnification) => {
    if (sized.magnification === magnification && sized.window === innerWidth) return sized.size;
    const most = parseFloat(getComputedStyle(picture).maxHeight) || Infinity;
    const { width } = across(magnification);
    const scale = Math.min(picture.clientWidth / width, most / (scene.height + scene.margin + below));
    let size = scale > 0 ? Math.max(usual, LEAST / scale) : usual;
    // As far as neighbours have room.
    for (let i = 1; i < bodies.length; i++) {
      const apart = middle(bodies[i], magnification) - middle(bodies[i - 1], magnification);
      const needed = turned ? 1.1 : 0.3 * (bodies[i].shown.length + bodies[i - 1].shown.length + 2);
      size = Math.max(usual, Math.min(size, apart / needed));
    }
    sized = { magnification, window: innerWidth, size };
    return size;
  };

  // Draws what stands in `now` of the bodies, with these contacts closed.
  const draw = (magnification, closed) => {
    // Pictures have numbers of 32 bits.
    if (!(across(magnification).width < 1e30)) return;
    const size = sizeAt(magnification);
    for (const body of bodies) {
      const rest = body.left + magnification * body.offset;
      const points = [0, ...body.elevation].map((z, i) => [
        (rest + magnification * body.now[i]).toFixed(6),
        (scene.height - z).toFixed(4),
      ]);
      const up = points.map(([x, y]) => `${x} ${y}`).join(" L");
      const down = points
        .slice()
        .reverse()
        .map(([x, y]) => `${(Number(x) + body.width).toFixed(6)} ${y}`)
        .join(" L");
      const floors = points.slice(1).map(([x, y]) => `M${x} ${y}h${body.width}`);
      body.element.setAttribute("d", `M${up} L${down}Z${floors.join("")}`);
      const x = middle(body, magnification) + (turned ? 0.35 * size : 0);
      const y = scene.height + (turned ? 0.5 : 0.3) * scene.margin + (turned ? 0 : size);
      body.name.setAttribute("x", x);
      body.name.setAttribute("y", y);
      body.name.setAttribute("font-size", size);
      if (turned) body.name.setAttribute("transform", `rotate(-90 ${x} ${y})`);
    }
    contacts.forEach((contact, i) => {
      const [zl, zr] = contact.elevations;
      const left = side(bodies[contact.left], magnification, zl, true);
      const right = side(bodies[contact.right], magnification, zr, false);
      const nearer = right - magnification * contact.ahead;
      contact.element.setAttribute("cx", (left + nearer) / 2);
      contact.element.setAttribute("cy", scene.height - (zl + zr) / 2);
      contact.element.classList.toggle("closed", closed.has(i));
      contact.edge.setAttribute("d", contact.ahead > 0 ? `M${right} ${scene.height - zr}H${nearer}` : "");
    });
    const { left, width } = across(magnification);
    picture.setAttribute("viewBox", `${left} ${-scene.margin} ${width} ${scene.height + scene.margin + (below * size) / usual}`);
    ground.setAttribute("d", `M${left} ${scene.height}h${width}`);
  };
  return { bodies, contacts, draw, place };
};
