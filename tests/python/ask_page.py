"""Opens a page of `pounding explore`, waits for its run and its sweep, and prints what is asked of it.

python ask_page.py PAGE.html EXPRESSION...

The expressions are JavaScript; the answers are a JSON list. `@screen` and `@print` in the place of one change the medium, `@400` the width.
Chromium is named by POUNDING_CHROMIUM.
"""

import json
import os
import pathlib
import sys
import time

from chromium import Chromium

READY = (
    "(() => { const { ready, runs } = document.documentElement.dataset;"
    "const { done, all } = document.querySelector('[data-part=sweep]').dataset;"
    "return ready === 'true' && Number(runs) > 0 && (done === all && Number(all) > 0 || document.querySelector('[data-part=widths-section]')?.hidden || document.querySelector('[data-part=progress]').textContent.includes('no widths')); })()"
)


def main(file, *expressions):
    with Chromium(os.environ["POUNDING_CHROMIUM"]) as browser:
        page = browser.open(pathlib.Path(file).resolve().as_uri())
        page.wide(1280)
        end = time.monotonic() + 400
        while not page.value(READY):
            assert time.monotonic() < end, page.value("document.body.innerText")
            time.sleep(0.1)
        answers = []
        for expression in expressions:
            if expression[:1] == "@" and expression[1:].isdigit():
                page.wide(int(expression[1:]))
            elif expression.startswith("@"):
                page.call("Emulation.setEmulatedMedia", media=expression[1:])
            else:
                answers.append(page.value(expression))
        assert not page.complaints, page.complaints
        print(json.dumps(answers))


if __name__ == "__main__":
    main(*sys.argv[1:])
