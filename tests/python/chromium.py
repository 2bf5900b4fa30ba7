"""Chromium without a window, driven over its debugging pipe: the DevTools protocol, JSON ended by NUL."""

import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time


class Page:
    """A page that was opened, with all that it asked for and complained of."""

    def __init__(self, chromium, session, url):
        self.chromium, self.session = chromium, session
        self.requests, self.complaints = [], []
        self.loaded = False
        for domain in ("Page", "Runtime", "Network", "Log"):
            self.call(f"{domain}.enable")
        started = time.perf_counter()
        self.call("Page.navigate", url=url)
        self.chromium.until(lambda: self.loaded)
        self.seconds = time.perf_counter() - started

    def call(self, method, **arguments):
        return self.chromium.call(method, arguments, self.session)

    def event(self, method, data):
        if method == "Page.loadEventFired":
            self.loaded = True
        elif method == "Network.requestWillBeSent":
            self.requests.append(data["request"]["url"])
        elif method == "Runtime.exceptionThrown":
            self.complaints.append(json.dumps(data["exceptionDetails"])[:2000])
        elif method == "Runtime.consoleAPICalled" and data["type"] in ("error", "warning", "assert"):
            self.complaints.append(json.dumps(data["args"])[:2000])
        elif method == "Log.entryAdded" and data["entry"]["level"] in ("error", "warning"):
            self.complaints.append(json.dumps(data["entry"])[:2000])

    def value(self, expression):
        """What a JavaScript expression gives; a promise is waited for."""
        answer = self.call(
            "Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True
        )
        assert "exceptionDetails" not in answer, answer["exceptionDetails"]
        return answer["result"].get("value")

    def wide(self, width, height=900, dark=False, touch=False):
        """The size of the window (CSS pixels), and whether the reader likes it dark."""
        self.call(
            "Emulation.setDeviceMetricsOverride",
            width=width,
            height=height,
            deviceScaleFactor=1,
            mobile=touch,
        )
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self.call("Emulation.setEmulatedMedia", features=[scheme])

    def picture(self, path):
        """A picture of the whole page."""
        taken = self.call("Page.captureScreenshot", captureBeyondViewport=True)
        with open(path, "wb") as file:
            file.write(base64.b64decode(taken["data"]))

    def pdf(self, path, width, height):
        """The page in print, on paper of this size (inches)."""
        printed = self.call(
            "Page.printToPDF",
            paperWidth=width,
            paperHeight=height,
            printBackground=True,
            preferCSSPageSize=False,
        )
        with open(path, "wb") as file:
            file.write(base64.b64decode(printed["data"]))


class Chromium:
    """The browser; `with` ends it."""

    PATIENCE = 120

    def __init__(self, program=None):
        program = program or shutil.which("chromium") or shutil.which("chromium-browser")
        if program is None:
            raise FileNotFoundError("chromium")
        self.folder = tempfile.mkdtemp()
        there, write = os.pipe()
        read, back = os.pipe()

        def place():
            # The browser reads from 3 and writes to 4.
            high = [os.dup(there), os.dup(back)]
            os.dup2(high[0], 3)
            os.dup2(high[1], 4)

        self.process = subprocess.Popen(
            [
                program,
                "--headless=new",
                "--remote-debugging-pipe",
                "--no-sandbox",
                "--disable-gpu",
                "--hide-scrollbars",
                "--no-first-run",
                "--disable-background-networking",
                "--disable-component-update",
                f"--user-data-dir={self.folder}",
                "about:blank",
            ],
            preexec_fn=place,
            close_fds=False,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        os.close(there)
        os.close(back)
        self.read, self.write = read, write
        self.rest, self.last, self.answers, self.pages = b"", 0, {}, {}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self.call("Browser.close")
            self.process.wait(20)
        except (AssertionError, subprocess.TimeoutExpired, OSError):
            self.process.kill()
            self.process.wait()
        for end in (self.read, self.write):
            os.close(end)
        shutil.rmtree(self.folder, ignore_errors=True)

    def open(self, url):
        target = self.call("Target.createTarget", {"url": "about:blank"})["targetId"]
        arguments = {"targetId": target, "flatten": True}
        session = self.call("Target.attachToTarget", arguments)["sessionId"]
        page = Page.__new__(Page)
        page.target = target
        self.pages[session] = page
        page.__init__(self, session, url)
        return page

    def close(self, page):
        """Ends a page, and what it computes."""
        self.call("Target.closeTarget", {"targetId": page.target})

    def call(self, method, arguments=None, session=None):
        self.last += 1
        number = self.last
        message = {"id": number, "method": method, "params": arguments or {}}
        if session:
            message["sessionId"] = session
        os.write(self.write, json.dumps(message).encode() + b"\0")
        self.until(lambda: number in self.answers)
        answer = self.answers.pop(number)
        assert "error" not in answer, f"{method}: {answer['error']}"
        return answer["result"]

    def until(self, done):
        """Reads what the browser says until something has happened."""
        end = time.monotonic() + self.PATIENCE
        while not done():
            left = end - time.monotonic()
            assert left > 0, "the browser does not answer"
            ready, _, _ = select.select([self.read], [], [], min(left, 1))
            if not ready:
                assert self.process.poll() is None, "the browser has ended"
                continue
            part = os.read(self.read, 1 << 20)
            assert part, "the browser has closed its pipe"
            *messages, self.rest = (self.rest + part).split(b"\0")
            for message in map(json.loads, messages):
                if "id" in message:
                    self.answers[message["id"]] = message
                elif page := self.pages.get(message.get("sessionId")):
                    page.event(message["method"], message["params"])
