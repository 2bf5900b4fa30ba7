"use strict";
// Elements and numbers of the page.
const elements = (() => {
  const known = new Map();
  const part = (name) => {
    if (!known.has(name)) known.set(name, document.querySelector(`[data-part="${name}"]`));
    return known.get(name);
  };
  const space = "http://www.w3.org/2000/svg";
  const fill = (element, attributes, children) => {
    for (const [key, value] of Object.entries(attributes)) {
      if (value !== undefined && value !== null && value !== false) {
        element.setAttribute(key, value === true ? "" : value);
      }
    }
    element.append(...children.filter((child) => child !== null && child !== undefined));
    return element;
  };
  // Texts stay texts: nothing in the page is made from HTML.
  const html = (name, attributes = {}, ...children) => fill(document.createElement(name), attributes, children);
  const svg = (name, attributes = {}, ...children) => fill(document.createElementNS(space, name), attributes, children);
  const shown = (x, digits = 4) => {
    if (!Number.isFinite(x)) return "–";
    const size = Math.abs(x);
    // Digits before the point are never rounded: zeros would stand for what is known.
    const rounded = Number(x.toPrecision(Math.min(100, Math.max(digits, Math.floor(Math.log10(size)) + 1 || 1))));
    if (size !== 0 && (size < 1e-3 || size >= 1e7)) return x.toExponential(digits - 1).replace("e+", "e");
    return String(rounded);
  };
  // A width that is asked for, so that it suffices as it is shown: rounded up at the last of its digits, also where that is
  // a zero, which is not shown.
  const shownAtLeast = (x, digits = 4) => {
    const text = shown(x, digits);
    if (!(x > 0) || Number(text) >= x * (1 - 1e-9)) return text;
    const last = Math.floor(Math.log10(x)) + 1 - digits;
    return shown(Number(text) + 10 ** (x < 1e7 ? Math.min(0, last) : last), digits);
  };
  // The same beside the width that is provided, both with as many digits as tell which is the larger.
  const shownBeside = (required, provided) => {
    const texts = (digits) => [shownAtLeast(required, digits), shown(provided, digits)];
    const suffices = ([most, width]) => Number(most) <= Number(width);
    const digits = [4, 5, 6, 7, 8, 9, 10].find((digits) => suffices(texts(digits)) === required <= provided);
    return texts(digits ?? 11);
  };
  // A ratio with two decimals, as pages of results have it.
  const ratio = (x) => (!Number.isFinite(x) ? "–" : x >= 1e4 ? x.toExponential(1).replace("e+", "e") : x.toFixed(2));
  // A text as a value of a table of comma-separated values, as those of the command line have it: what a
  // spreadsheet would take for a formula has an apostrophe before it, unless it is a number or the sign of no unit.
  const NUMBER = /^[-+]?((\d+\.?\d*|\.\d+)(e[-+]?\d+)?|inf|infinity|nan)$/i;
  const quoted = (text) => {
    const cell = /^[=+\-@\t\r]/.test(text) && text !== "-" && !NUMBER.test(text) ? `'${text}` : text;
    return /[",\n\r]/.test(cell) ? `"${cell.replaceAll('"', '""')}"` : cell;
  };
  // A number with the noun that it counts.
  const counted = (count, noun) => `${count} ${noun}${count === 1 ? "" : "s"}`;
  // A number without the noise of a change of units.
  const clean = (x) => Number(x.toPrecision(12));
  // At most this many even steps between two values.
  const ticks = (low, high, count) => {
    const rough = (high - low) / count || 1;
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= rough * (1 - 1e-9));
    const out = [];
    for (let i = Math.ceil(low / step - 1e-9); i * step <= high * (1 + 1e-12); i++) out.push(clean(i * step));
    return out;
  };
  // The address of a page: with `{page}` in it of a book, else of files.
  const addressOf = (documentation, page) =>
    documentation.includes("{page}")
      ? documentation.replace("{page}", page.replace(/\.md$/, ""))
      : documentation + page;

  // Where the documentation says more: a link, or the name of the page where nobody said where
  // the documentation is.
  const more = (documentation, page) =>
    documentation
      ? html("a", { href: addressOf(documentation, page), target: "_blank", rel: "noopener" }, "more")
      : html("span", { class: "source" }, `docs/${page}`);
  const save = (name, type, contents) => {
    const address = URL.createObjectURL(new Blob([contents], { type }));
    const link = html("a", { href: address, download: name });
    document.body.append(link);
    link.click();
    link.remove();
    setTimeout(() => URL.revokeObjectURL(address), 60000);
  };
  return { part, html, svg, shown, shownAtLeast, shownBeside, ratio, quoted, counted, clean, ticks, more, save };
})();
