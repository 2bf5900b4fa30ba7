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

  // Draws what stands in `now` of the bodies, with these contacts closed.
  const draw = (magnification, closed) => {
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
      body.name.setAttribute("x", rest + body.width / 2);
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
    const reach = magnification * scene.reach;
    const left = -scene.margin - reach;
    const width = scene.width + magnification * scene.offsets + 2 * (scene.margin + reach);
    picture.setAttribute("viewBox", `${left} ${-scene.margin} ${width} ${scene.height + 3 * scene.margin}`);
    ground.setAttribute("d", `M${left} ${scene.height}h${width}`);
  };
  return { bodies, contacts, draw, place };
};
