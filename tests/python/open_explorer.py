"""Opens the page that computes, moves it, and compares it with what the command line says.

python open_explorer.py PAGE.html POUNDING RECORD BROKEN_CASE COMPONENTS RULES [--pictures FOLDER]

PAGE is that of the README's pair; RECORD, BROKEN_CASE, COMPONENTS, a record with NS, EW and UD, and RULES, one of which is
called office_sum, are dropped on it; the page holds another record under the name of RECORD. Chromium is named by POUNDING_CHROMIUM;
where POUNDING_FIREFOX names Firefox, that opens the page too (over its debugging protocol, WebDriver BiDi).
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

from chromium import Chromium

WIDTH = "document.querySelector('input[type=range][data-control=\"gap.0.width\"]')"
SWEEP_FILES = "['sweep-csv', 'png'].map((name) => !document.querySelector(`[data-part=${name}]`).disabled)"
DATA = "document.documentElement.dataset"


def until(page, expression, seconds=120):
    """Waits until an expression is true."""
    end = time.monotonic() + seconds
    while not page.value(expression):
        assert time.monotonic() < end, expression
        time.sleep(0.1)


def result(page, name):
    return page.value(f"document.querySelector('[data-result=\"{name}\"]').textContent")


def told(page):
    return page.value("document.querySelector('[data-part=faults]').textContent")


def rests(page):
    """Waits until all that was asked of the page is on it; its sweep goes on."""
    until(page, f"{DATA}.asked === '0'")


def resets(page):
    """Back to the case as it was opened: 45 impacts at 20 mm."""
    page.value("document.querySelector('[data-part=reset]').click()")
    rests(page)
    assert (result(page, "impacts"), result(page, "width")) == ("45", "20 mm")
    assert told(page) == "", told(page)


def opened(page):
    until(page, f"{DATA}.ready === 'true' && Number({DATA}.runs) > 0")
    rests(page)
    assert told(page) == "", told(page)
    # The slider reaches what the gap demands as soon as that is known.
    until(page, f"Number({WIDTH}.max) > 118")


def moves(page):
    """A drag from 20 mm to 118 mm: how many frames and runs a second, and where it ends."""
    assert (result(page, "impacts"), result(page, "demand")) == ("45", "117.2 mm")
    page.value(
        "(() => { const bar = document.querySelector('[data-part=time]'); bar.value = '5';"
        "bar.dispatchEvent(new Event('input', { bubbles: true })); })()"
    )
    # The bar stands where it was put, and what is drawn with it.
    assert page.value("Number(document.querySelector('[data-part=elevation]').dataset.time)") == 5
    assert page.value("Number(document.querySelector('[data-part=time]').value)") == 5
    page.value("document.querySelector('[data-part=play]').click()")
    runs = int(page.value(f"{DATA}.runs"))
    took = page.value(
        "(async () => { const slider = " + WIDTH + "; const started = performance.now();"
        "for (let width = 20; width <= 118; width++) {"
        " slider.value = String(width); slider.dispatchEvent(new Event('input', { bubbles: true }));"
        " await new Promise((next) => requestAnimationFrame(next)); }"
        "slider.dispatchEvent(new Event('change', { bubbles: true }));"
        "return (performance.now() - started) / 1000; })()"
    )
    until(page, "document.querySelector('[data-result=width]').textContent === '118 mm'")
    runs = int(page.value(f"{DATA}.runs")) - runs
    assert (result(page, "impacts"), result(page, "demand")) == ("0", "117.2 mm")
    return f"a drag: {99 / took:.0f} frames and {runs / took:.0f} runs a second"


def repeats(page, pounding, folder):
    """The case file that the page gives away is run to the same numbers."""
    page.value("(() => { window.given = null; const made = URL.createObjectURL.bind(URL); URL.createObjectURL = (blob) => { blob.text().then((t) => { window.given = t; }); return made(blob); }; })()")
    page.value("document.querySelector('[data-part=case]').click()")
    until(page, "window.given !== null")
    case = page.value("window.given")
    motions = pathlib.Path(__file__).resolve().parents[2] / "ground_motions"
    path = pathlib.Path(folder) / "given.toml"
    path.write_text(case.replace("../../ground_motions", str(motions)))
    told_ = subprocess.run([pounding, "run", path, "--no-output", "--json"], capture_output=True, text=True, check=True)
    levels = json.loads(told_.stdout)["gaps"][0]["levels"]
    assert str(sum(level["impacts"] for level in levels)) == result(page, "impacts")
    assert f"{1e3 * levels[0]['width']:g} mm" == result(page, "width"), levels[0]["width"]


def drop(page, *paths):
    files = [[pathlib.Path(path).name, pathlib.Path(path).read_text()] for path in paths]
    page.value(
        "(() => { const data = new DataTransfer(); for (const [name, text] of "
        + json.dumps(files)
        + ") data.items.add(new File([text], name));"
        "dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true })); })()"
    )


def chooses(page, record, rules):
    """Of a record with several components one is chosen, and rules stand among the widths."""
    drop(page, record)
    chosen = "document.querySelector('[data-control=\"ground_motion.component\"]')"
    until(page, f"{chosen}?.value === 'NS'")
    assert page.value(f"[...{chosen}.options].map((o) => o.value)") == ["NS", "EW", "UD"]
    runs = page.value(f"Number({DATA}.runs)")
    page.value(f"(() => {{ {chosen}.value = 'EW'; {chosen}.dispatchEvent(new Event('change', {{ bubbles: true }})); }})()")
    until(page, f"Number({DATA}.runs) > {runs} && document.querySelector('[data-part=excitation]').textContent.includes('EW')")
    drop(page, rules)
    until(page, "document.querySelector('[data-part=rules]').textContent.includes('office_sum')")
    until(page, "document.querySelector('[data-part=widths]').textContent.includes('Office standard')")
    assert told(page) == "", told(page)
    resets(page)
    assert page.value("document.querySelector('[data-part=rules]').textContent") == ""
    assert page.value(chosen) is None


def chooses_by_keys(page):
    """Who chooses a model by keys stands where they stood, and files of the sweep wait for all its runs."""
    select = "document.getElementById('control-gap.0-model')"
    page.value(f"(() => {{ {select}.focus(); {select}.value = 'hertz_1882'; {select}.dispatchEvent(new Event('change', {{ bubbles: true }})); }})()")
    rests(page)
    # Its parameters have taken the place of those before.
    assert page.value("document.getElementById('control-gap.0.damping_ratio')") is None
    assert page.value("document.activeElement.id") == "control-gap.0-model"
    assert page.value(f"{select}.value") == "hertz_1882"
    assert page.value(SWEEP_FILES) == [False, False]
    resets(page)


def replaces(page, record):
    """A record that is dropped takes the place of another of its name until the page is reset."""
    name = pathlib.Path(record).name
    select = "document.getElementById('control-ground_motion-record')"

    def demand():
        runs = page.value(f"Number({DATA}.runs)")
        page.value(f"(() => {{ {select}.value = {json.dumps(name)}; {select}.dispatchEvent(new Event('change', {{ bubbles: true }})); }})()")
        until(page, f"Number({DATA}.runs) > {runs} && document.querySelector('[data-part=excitation]').textContent.includes({json.dumps(name)})")
        return result(page, "demand")

    embedded = demand()
    page.value("document.querySelector('[data-part=share]').click()")
    status = "document.querySelector('[data-part=status]').textContent"
    until(page, f"{status}.startsWith('The address')")
    assert "dropped" not in page.value(status), page.value(status)
    runs = page.value(f"Number({DATA}.runs)")
    drop(page, record)
    until(page, f"Number({DATA}.runs) > {runs}")
    until(page, f"document.querySelector('[data-result=demand]').textContent !== {json.dumps(embedded)}")
    page.value("document.querySelector('[data-part=share]').click()")
    until(page, f"{status}.includes('The record that you dropped is not in it')")
    resets(page)
    assert demand() == embedded
    resets(page)


def types(page, name, text):
    """Types into the field of an entry of the gap."""
    field = f"document.getElementById('control-gap.0.{name}')"
    page.value(f"(() => {{ {field}.value = '{text}'; {field}.dispatchEvent(new Event('change', {{ bubbles: true }})); }})()")
    return page.value(f"{field}.value")


def clears(page):
    """A parameter that is cleared is left out, so that another takes its place; a width stays."""
    assert types(page, "damping_ratio", "") == ""
    until(page, "document.querySelector('[data-part=faults]').textContent.includes('damping_ratio')")
    # What is shown beside a fault is of the input before it, and says so.
    stale = "[document.querySelector('.stale') !== null, document.querySelector('[data-part=stale]').checkVisibility(), document.querySelector('[data-part=case]').disabled, document.querySelector('[data-part=peaks-csv]').disabled]"
    assert page.value(stale) == [True] * 4, page.value(stale)
    types(page, "restitution", "0.6")
    until(page, "document.querySelector('[data-part=faults]').textContent === ''")
    assert page.value(stale) == [False] * 4, page.value(stale)
    assert types(page, "width", "") == "20"
    resets(page)
    assert page.value("document.getElementById('control-gap.0.damping_ratio').value") == "0.35"


def computes(page, folder):
    """A run that takes longer says for how long it has been computed."""
    case = pathlib.Path(folder) / "slow.toml"
    case.write_text(page.value("window.given").replace("[analysis]", '[analysis]\nmethod = "newmark"\nstep = "1.5e-4 s"'))
    runs = page.value(f"Number({DATA}.runs)")
    working = "document.querySelector('[data-part=working]')"
    drop(page, case)
    until(page, f"{working}.checkVisibility() && {working}.textContent.startsWith('Computing')")
    until(page, f"Number({DATA}.runs) > {runs} && !{working}.checkVisibility()")
    assert told(page) == "", told(page)
    below_title = "document.querySelector('header .what').textContent"
    assert page.value(below_title).startswith("slow.toml · pounding "), page.value(below_title)
    resets(page)
    assert page.value(below_title).startswith("case.toml · pounding "), page.value(below_title)


def factors(page, browser, url):
    """A factor of all storeys is that of the case as it was opened, also in an address."""
    slider = "document.querySelector('[data-control=\"building.0.mass\"]')"
    factor = f"{slider}.closest('.control').querySelector('output').textContent"
    assert page.value(factor) == "1"
    page.value(f"(() => {{ {slider}.value = '700'; {slider}.dispatchEvent(new Event('input', {{ bubbles: true }})); {slider}.dispatchEvent(new Event('change', {{ bubbles: true }})); }})()")
    times = page.value(factor)
    until(page, "decodeURIComponent(location.hash).includes('building.0.mass')")
    shared = browser.open(url + page.value("location.hash"))
    until(shared, f"{DATA}.ready === 'true'")
    assert shared.value(factor) == times != "1", (shared.value(factor), times)
    assert shared.value("document.getElementById('control-building.0.mass-0').value") == page.value("document.getElementById('control-building.0.mass-0').value")
    # Its sweep would be computed beside all that follows.
    browser.close(shared)
    resets(page)
    assert page.value(factor) == "1"


def words(text):
    return " ".join(text.replace("│", " ").split())


def drops(page, pounding, record, broken):
    """A record is run, a broken case is refused as on the command line, and the rest stays."""
    drop(page, broken)
    until(page, "document.querySelectorAll('.fault').length > 0")
    refused = subprocess.run([pounding, "run", broken, "--no-output"], capture_output=True, text=True, env={**os.environ, "NO_COLOR": "1"})
    folder = str(pathlib.Path(broken).parent) + "/"
    said = words(words(refused.stderr).replace(folder, ""))
    # A page has no system that says why a file is missing.
    said = said.replace("No such file or directory (os error 2)", "this file was not given")
    for text in page.value("[...document.querySelectorAll('.fault')].map((f) => f.querySelector('p').textContent)"):
        assert words(text) in said, (text, said)
    # And no other word.
    assert refused.stderr.count("×") == page.value("document.querySelectorAll('.fault').length")
    name = pathlib.Path(record).name
    drop(page, record)
    until(page, f"document.querySelector('[data-part=excitation]').textContent.includes({json.dumps(name)})")
    until(page, "document.querySelector('[data-part=faults]').textContent === ''")
    resets(page)


def named(page):
    """Every control has a name for those who do not see it."""
    nameless = page.value(
        "[...document.querySelectorAll('input, select, button, svg[role]')].filter((e) => e.offsetParent !== null || e.tagName === 'svg')"
        ".filter((e) => !(e.labels && e.labels.length) && !e.getAttribute('aria-label') && !e.textContent.trim()).map((e) => e.outerHTML.slice(0, 200))"
    )
    assert not nameless, nameless


def prints(page):
    """On paper there are the answer, the pictures and what the case has, and nothing to press."""
    page.call("Emulation.setEmulatedMedia", media="print")
    for what in ("[data-result=impacts]", "[data-part=elevation]", "[data-part=sweep]", "[data-part=storeys] table", "fieldset input[type=number]"):
        assert page.value(f"document.querySelector('{what}').getBoundingClientRect().height > 0"), what
    for what in ("[data-part=reset]", "[data-part=play]", "input[type=range]", "[data-part=overlays]"):
        assert page.value(f"document.querySelector('{what}').getBoundingClientRect().height === 0"), what
    page.call("Emulation.setEmulatedMedia", media="screen")


def complains_of_nothing(page, url):
    """The page asked for nothing else, and wrote no complaint."""
    foreign = [r for r in page.requests if not r.startswith((url, "blob:", "data:"))]
    assert not foreign, foreign
    assert not page.complaints, page.complaints


def in_chromium(arguments, pictures):
    page_file, pounding, record, broken, components, rules = arguments
    url = pathlib.Path(page_file).resolve().as_uri()
    with Chromium(os.environ["POUNDING_CHROMIUM"]) as browser, tempfile.TemporaryDirectory() as folder:
        page = browser.open(url)
        page.wide(1280)
        opened(page)
        drag = moves(page)
        repeats(page, pounding, folder)
        drops(page, pounding, record, broken)
        chooses(page, components, rules)
        replaces(page, record)
        chooses_by_keys(page)
        clears(page)
        factors(page, browser, url)
        computes(page, folder)
        named(page)
        started = time.monotonic()
        # Until a sweep begins anew, the counts are those of the one before it, of which there are no files.
        until(page, f"(({{ done, all }}) => done === all && Number(all) === 400 && {SWEEP_FILES}.every(Boolean))(document.querySelector('[data-part=sweep]').dataset)", 600)
        sweep = time.monotonic() - started
        for width, dark in ((1280, False), (400, False), (1280, True)):
            page.wide(width, dark=dark, touch=width < 500)
            across = page.value("document.documentElement.scrollWidth - document.documentElement.clientWidth")
            assert across <= 0, (width, across)
            if pictures:
                time.sleep(0.5)
                page.picture(f"{pictures}/explorer-{width}{'-dark' if dark else ''}.png")
        prints(page)
        # An address holds the state.
        state = page.value("location.hash")
        complains_of_nothing(page, url)
        browser.close(page)
        shared = browser.open(url + "#" + "%7B%22entries%22%3A%7B%22gap.0.width%22%3A%22118%20mm%22%7D%7D")
        opened_with = f"{DATA}.ready === 'true' && document.querySelector('[data-result=width]')?.textContent === '118 mm'"
        until(shared, opened_with)
        complains_of_nothing(shared, url)
        browser.close(shared)
        garbage = browser.open(url + "#%7Bnothing")
        until(garbage, f"{DATA}.ready === 'true' && document.querySelectorAll('.fault').length === 1")
        complains_of_nothing(garbage, url)
        browser.close(garbage)
        # What cannot be run is left out, and said.
        refused = browser.open(url + "#%7B%22entries%22%3A%7B%22gap.0.width%22%3A%22abc%22%7D%7D")
        until(refused, f"{DATA}.ready === 'true' && Number({DATA}.runs) > 0 && document.querySelectorAll('.fault').length === 1")
        assert "the address" in told(refused) and "abc" in told(refused), told(refused)
        assert refused.value("document.getElementById('control-gap.0.width').value") == "20"
        complains_of_nothing(refused, url)
        size = pathlib.Path(page_file).stat().st_size
        print(f"Chromium: {size / 1e6:.2f} MB, {drag}, the rest of the sweep in {sweep:.1f} s, state {len(state)} characters")


def in_firefox(page_file):
    from firefox import Firefox

    url = pathlib.Path(page_file).resolve().as_uri()
    with Firefox(os.environ["POUNDING_FIREFOX"]) as browser:
        page = browser.open(url)
        opened(page)
        drag = moves(page)
        assert all(r.startswith((url, "blob:", "data:")) for r in page.requests), page.requests
        assert not page.complaints, page.complaints
        print(f"Firefox: {drag}")


def main(arguments):
    pictures = None
    if "--pictures" in arguments:
        at = arguments.index("--pictures")
        pictures = arguments[at + 1]
        del arguments[at : at + 2]
    in_chromium(arguments, pictures)
    if os.environ.get("POUNDING_FIREFOX"):
        in_firefox(arguments[0])


if __name__ == "__main__":
    main(sys.argv[1:])
