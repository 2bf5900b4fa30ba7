"""Opens pages in Chromium and compares them with what they were made from.

python open_pages.py [--brief] PAGE=SOURCE...   SOURCE: result (HDF5) or answer of the command (JSON)

--brief leaves paper and the tree of names out, which take minutes on the largest pages.
"""

import base64
import json
import pathlib
import re
import sys
import tempfile
import unicodedata

import h5py
import numpy
from chromium import Chromium
from pypdfium2 import PdfDocument, raw
from sources import Result, walk

# Columns of numbers that are of no single place in the result: counted or computed from a table.
FREE = {"number", "storey", "mode", "level", "left", "right", "at (s)", "restitution"}
PAPER = {"A4": (8.27, 11.69), "Letter": (8.5, 11.0)}
MARGIN = 2 * 12 / 25.4


# Texts of the curves of a run that pass an edge of their picture, once that has its new size.
CUT = (
    "(async () => { for (let i = 0; i < 2; i++) await new Promise((next) => requestAnimationFrame(next));"
    "return [...document.querySelectorAll('[data-part=chart] text')].filter((e) => {"
    " const [text, all] = [e, e.closest('svg')].map((e) => e.getBoundingClientRect());"
    " return text.right > all.right + 0.5 || text.left < all.left - 0.5; }).map((e) => e.textContent); })()"
)

# Options of lists whose text is wider than the list.
CUT_OPTIONS = (
    "[...document.querySelectorAll('select[size]')].filter((e) => e.scrollWidth > e.clientWidth)"
    ".map((e) => [e.dataset.part, e.scrollWidth, e.clientWidth])"
)


def bare(text):
    """Without blanks and line ends, and with the letters of ligatures."""
    return re.sub(r"\s|\u00ad", "", unicodedata.normalize("NFKC", text))


def looks(page):
    """Nothing sticks out on a screen, wide or narrow, in light and dark."""
    # Sections out of sight are not laid out otherwise.
    page.value(
        "document.querySelectorAll('main > section').forEach(s => { s.style.contentVisibility = 'visible' })"
    )
    for width in (1280, 400, 390):
        for dark in (False, True):
            page.wide(width, dark=dark, touch=width < 500)
            shown = page.value("[document.documentElement.scrollWidth, document.body.scrollWidth]")
            assert max(shown) <= width, (width, shown)
            cut = page.value(CUT)
            assert cut == [], (width, cut)
            cut = page.value(CUT_OPTIONS)
            assert cut == [], (width, cut)
            colours = page.value(
                "['backgroundColor','color'].map(n => getComputedStyle(document.body)[n])"
            )
            paper, ink = (sum(map(int, re.findall(r"\d+", c)[:3])) for c in colours)
            assert (paper < 150 < 450 < ink) if dark else (ink < 150 < 450 < paper), colours
    page.wide(1280)


def text_of(paper):
    """The text of a page of a PDF, in the order in which it was written there: that of the page's own cells."""
    words = paper.get_textpage()
    text = "".join(o.extract() for o in paper.get_objects(filter=(raw.FPDF_PAGEOBJ_TEXT,), textpage=words))
    # PDFium marks hyphens at the end of a line by these.
    return text.replace("\ufffe", "-").replace("\x02", "-")


def prints(page, folder):
    """All of the page is on paper: every cell, every line of the case, and page numbers."""
    cells = page.value("[...document.querySelectorAll('th,td')].map(c => c.textContent)")
    lines = page.value("[...document.querySelectorAll('pre')].map(c => c.textContent)")
    for name, size in PAPER.items():
        path = pathlib.Path(folder) / f"{name}.pdf"
        page.pdf(path, *size)
        pages = [text_of(p) for p in PdfDocument(path)]
        numbers = [bare(f"{i + 1}/{len(pages)}") for i in range(len(pages))]
        assert all(n in bare(p) for n, p in zip(numbers, pages)), "page numbers"
        printed = bare(" ".join(pages))
        for number in sorted(numbers, key=len, reverse=True):
            printed = printed.replace(number, "", 1)
        missing = {c for c in cells if bare(c) not in printed}
        assert not missing, (name, sorted(missing)[:20])
        whole = {line for text in lines for line in text.splitlines()}
        missing = {line for line in whole if bare(line) not in printed}
        assert not missing, (name, sorted(missing)[:5])
        # What is wider than the paper would be cut.
        wide = round((size[0] - MARGIN) * 96)
        page.call(
            "Emulation.setDeviceMetricsOverride",
            width=wide,
            height=1000,
            deviceScaleFactor=1,
            mobile=False,
        )
        page.call("Emulation.setEmulatedMedia", media="print")
        beyond = page.value(
            "[...document.querySelectorAll('table,figure,pre,p,li')]"
            f".filter(e => e.getBoundingClientRect().right > {wide} + 1)"
            ".map(e => e.tagName + ' ' + e.textContent.slice(0, 80))"
        )
        assert not beyond, (name, beyond[:5])
        page.call("Emulation.setEmulatedMedia", media="")
    page.wide(1280)


def reads(page):
    """What a screen reader needs: names of pictures, heads of tables, names of controls."""
    nameless = page.value(
        "[...document.querySelectorAll('figure svg:not(svg svg)')].filter(e => !e.getAttribute('aria-label')).length"
    )
    assert nameless == 0
    heads = page.value("[...document.querySelectorAll('th')].filter(e => !e.scope).length")
    assert heads == 0
    tree = page.call("Accessibility.getFullAXTree")["nodes"]
    for node in tree:
        focusable = any(p["name"] == "focusable" and p["value"].get("value") for p in node.get("properties", []))
        role = node.get("role", {}).get("value")
        if focusable and role not in ("RootWebArea", "option", "menuitem", "MenuListOption"):
            assert node.get("name", {}).get("value"), node


def packed(value):
    raw = base64.b64decode(value["data"])
    if value["type"] == "int16":
        words = numpy.frombuffer(raw, "<i2").astype(float)
        return numpy.where(words == -32768, numpy.nan, words * value["scale"]), value["scale"]
    kind = {"float32": "<f4", "float64": "<f8"}[value["type"]]
    numbers = numpy.frombuffer(raw, kind).astype(float)
    most = numpy.nanmax(numpy.abs(numbers), initial=0.0)
    return numbers, most * (1e-7 if kind == "<f4" else 0.0)


def change(page, part, value, event):
    page.value(
        f"(() => {{ const e = document.querySelector('[data-part={part}]');"
        f" e.value = {json.dumps(str(value))}; e.dispatchEvent(new Event('{event}')); }})()"
    )


def moves(page, file):
    """The animation stands where the result says, plays, stops, and jumps to impacts."""
    data = json.loads(page.value("document.getElementById('data').textContent"))
    frames, _ = packed(data["frames"])
    times = file["time"][:]
    for magnification in (data["magnification"], 1):
        change(page, "magnification", f"{magnification:g}", "change")
        for part in (0.11, 0.5, 0.83):
            instant = frames[int(part * len(frames))]
            row = int(numpy.flatnonzero(times == instant)[0])
            change(page, "time", repr(float(instant)), "input")
            for number, body in enumerate(data["scene"]["bodies"]):
                if body["building"] is None:
                    continue
                path = page.value(f"document.querySelector('[data-body=\"{number}\"]').getAttribute('d')")
                count = len(body["elevation"]) + 1
                points = re.findall(r"[ML](-?[\d.]+) (-?[\d.]+)", path)[:count]
                across = numpy.array([float(x) for x, _ in points])
                heights = [data["scene"]["height"] - float(y) for _, y in points]
                rest = body["left"] + magnification * body["offset"]
                moved = (across - rest) / magnification
                truth = file[f"building/{body['title']}/displacement"][row]
                _, quantum = packed(data["displacements"][number])
                most = quantum + 2e-6 / magnification
                assert numpy.abs(moved[1:] - truth).max() <= most, (body["title"], instant)
                assert moved[0] == 0 or abs(moved[0]) < most
                storeys = file[f"building/{body['title']}/storey"][:]
                assert numpy.abs(numpy.array(heights[1:]) - storeys).max() < 1e-3
    now = "Number(document.querySelector('[data-part=elevation]').dataset.time)"
    change(page, "time", repr(float(frames[0])), "input")
    wait = "new Promise(r => setTimeout(r, {}))"
    page.value("document.querySelector('[data-part=play]').click()")
    page.value(wait.format(400))
    first = page.value(now)
    page.value(wait.format(200))
    second = page.value(now)
    assert frames[0] < first < second, (first, second)
    page.value("document.querySelector('[data-part=play]').click()")
    stopped = page.value(now)
    page.value(wait.format(250))
    assert page.value(now) == stopped >= second
    impacts = data["impacts"]
    if not impacts["contact"]:
        return
    closes, _ = packed(impacts["closes"])
    all_closes = numpy.sort(numpy.concatenate([g["impacts"]["t_close"] for g in file["gap"].values()]))
    assert numpy.array_equal(closes, all_closes)
    listed = page.value("[...document.querySelectorAll('[data-part=impacts] option')].map(o => o.textContent)")
    assert len(listed) == len(closes)
    for number in (0, len(closes) // 2):
        change(page, "impacts", number, "change")
        assert page.value(now) == closes[number]
        contact = impacts["contact"][number]
        closed = page.value(
            f"document.querySelector('[data-contact=\"{contact}\"]').classList.contains('closed')"
        )
        assert closed
    page.value("document.querySelector('[data-part=next]').click()")
    assert page.value(now) >= closes[len(closes) // 2]
    ends = "['previous', 'next'].map((n) => document.querySelector(`[data-part=${n}]`).disabled)"
    for number, which in ((0, 0), (len(closes) - 1, 1)):
        change(page, "impacts", number, "change")
        assert page.value(ends)[which], (number, which)
    reaches(page, file, data)
    curves(page, file, data)


def reaches(page, file, data):
    """The curve of the hardest impact rises to its peak, and the distance is zero where it closes."""
    impacts = data["impacts"]
    columns = {name: packed(impacts[name])[0] for name in ("closes", "force", "impulse")}
    rigid = not (columns["force"] > 0).any()
    sizes = columns["impulse" if rigid else "force"]
    hardest = int(numpy.nanargmax(sizes))
    change(page, "impacts", hardest, "change")
    kind = "impulse" if rigid else "force"
    path = f"document.querySelector('[data-part=chart] path.{kind}')"
    top = page.value(f"{path}.getBBox().y")
    scale = (
        "(() => { const t = [...document.querySelectorAll('[data-part=chart] text')];"
        f" const h = t.findIndex((e) => e.dataset.heading === '{kind}');"
        " return t.slice(h + 1).map((e) => [e.textContent, Number(e.getAttribute('y'))]); })()"
    )
    ticks = [(text, y) for text, y in page.value(scale) if re.fullmatch(r"[\d.]+", text)][:2]
    (low, zero), (high, above) = ((float(text), y) for text, y in ticks)
    assert low == 0, ticks
    # Labels stand 4 below what they name; a force may be negative before a contact ends.
    drawn = (zero - 4 - top) * (high - low) / (zero - above)
    most = 1e-3 * numpy.nanmax(sizes)
    assert abs(drawn - most) < 0.02 * most, (drawn, most)


def curves(page, file, data):
    """Curves are those of the result, with every output time around an impact; keys zoom."""
    times = file["time"][:]
    gaps = {name: file[f"gap/{name}"] for name in file["gap"]}
    for series in data["series"]:
        name, _, label = series["name"].rpartition("level ")
        gap = gaps[name[:-2]] if name else next(iter(gaps.values()))
        level = [t.decode() if isinstance(t, bytes) else t for t in gap["level"][:]].index(label)
        at, _ = packed(series["time"])
        rows = numpy.array([int(numpy.abs(times - t).argmin()) for t in at])
        for part, column, sign in (("opening", "penetration", -1), ("force", "force", 1)):
            values, quantum = packed(series[part])
            truth = sign * gap[column][:, level][rows]
            assert numpy.abs(values - truth).max() <= quantum, (series["name"], part)
        impacts = gap["impacts"][:]
        for impact in impacts[impacts["level"] == level + 1]:
            if numpy.isfinite(impact["t_open"]):
                inside = numpy.flatnonzero((times >= impact["t_close"]) & (times <= impact["t_open"]))
                assert set(inside) <= set(rows), (series["name"], impact["t_close"])
    chart = "document.querySelector('[data-part=chart]')"
    span = f"Number({chart}.dataset.to) - Number({chart}.dataset.from)"
    page.value("document.querySelector('[data-part=everything]').click()")
    page.value(f"{chart}.focus()")
    whole = page.value(span)
    assert abs(whole - (times[-1] - times[0])) < 1e-9
    for kind in ("keyDown", "keyUp"):
        page.call("Input.dispatchKeyEvent", type=kind, key="+", text="+" if kind == "keyDown" else "")
    assert abs(page.value(span) / whole - 0.5) < 1e-9
    drawn = page.value(f"{chart}.querySelectorAll('path.opening, path.force, path.impulse').length")
    assert drawn >= 2
    caption = (
        "((factor, select) => { select.value = factor; select.dispatchEvent(new Event('change'));"
        "return document.querySelector('[data-part=factor]').parentElement.textContent; })"
    )
    for factor, words in (("10", "gaps are drawn 10 times as wide as they are."), ("1", "gaps are drawn to scale too.")):
        told = page.value(f"{caption}('{factor}', document.querySelector('[data-part=magnification]'))")
        assert words in told, told


def stands(browser, url):
    """Without scripts the page is whole and shows nothing that does not work."""
    page = browser.open("about:blank")
    page.call("Emulation.setScriptExecutionDisabled", value=True)
    page.loaded = False
    page.call("Page.navigate", url=url)
    browser.until(lambda: page.loaded)
    controls = "[...document.querySelectorAll('.live')].filter(e => e.offsetParent !== null).length"
    assert page.value(controls) == 0
    pictures = page.value("document.querySelectorAll('figure svg').length")
    assert pictures > 0
    still = page.value("[...document.querySelectorAll('[data-body]')].every(e => e.getAttribute('d').length > 10)")
    assert still


def main(arguments):
    brief = "--brief" in arguments
    arguments = [a for a in arguments if a != "--brief"]
    with Chromium() as browser, tempfile.TemporaryDirectory() as folder:
        for argument in arguments:
            name, source = argument.split("=")
            url = pathlib.Path(name).resolve().as_uri()
            page = browser.open(url)
            seconds = page.seconds
            looks(page)
            if not brief:
                reads(page)
                prints(page, folder)
            result = Result(source)
            html = pathlib.Path(name).read_text()
            numbers = walk(html, result, FREE)
            assert numbers > 10, numbers
            if result.file is not None and page.value("!!document.querySelector('[data-part=elevation]')"):
                moves(page, result.file)
            stands(browser, url)
            assert page.requests == [url], page.requests
            assert not page.complaints, page.complaints
            size = pathlib.Path(name).stat().st_size
            print(f"{name}: {numbers} numbers, {size / 1e6:.2f} MB, opened in {seconds:.2f} s")


if __name__ == "__main__":
    main(sys.argv[1:])
