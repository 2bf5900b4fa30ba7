"""Firefox without a window, driven over WebDriver BiDi: JSON over a WebSocket."""

import json
import os
import shutil
import signal
import subprocess
import tempfile
import time

import websocket


class Page:
    """A page that was opened, with all that it asked for and complained of."""

    def __init__(self, firefox, url):
        self.firefox = firefox
        self.requests, self.complaints = [], []
        firefox.page = self
        tree = firefox.call("browsingContext.getTree")
        self.context = tree["contexts"][0]["context"]
        firefox.call("browsingContext.navigate", context=self.context, url=url, wait="complete")

    def event(self, method, data):
        if method == "network.beforeRequestSent":
            self.requests.append(data["request"]["url"])
        elif method == "log.entryAdded" and data["level"] in ("error", "warn"):
            self.complaints.append(json.dumps(data)[:2000])

    def value(self, expression):
        """What a JavaScript expression gives; a promise is waited for."""
        answer = self.firefox.call(
            "script.evaluate",
            expression=f"(async () => JSON.stringify((await ({expression})) ?? null))()",
            target={"context": self.context},
            awaitPromise=True,
        )
        assert answer["type"] == "success", answer
        return json.loads(answer["result"]["value"])


class Firefox:
    """The browser; `with` ends it."""

    PATIENCE = 120

    def __init__(self, program):
        self.folder = tempfile.mkdtemp()
        self.process = subprocess.Popen(
            [program, "--headless", "--no-remote", "--profile", self.folder, "--remote-debugging-port", "0", "about:blank"],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            env={**os.environ, "HOME": self.folder},
            start_new_session=True,
        )
        address = None
        for line in self.process.stderr:
            if "WebDriver BiDi listening on " in line:
                address = line.rsplit(" ", 1)[1].strip()
                break
        assert address, "Firefox did not say where it listens"
        self.socket = websocket.create_connection(f"{address}/session", timeout=self.PATIENCE, suppress_origin=True)
        self.number, self.page = 0, None
        self.call("session.new", capabilities={})
        self.call("session.subscribe", events=["log.entryAdded", "network.beforeRequestSent"])

    def call(self, method, **arguments):
        self.number += 1
        self.socket.send(json.dumps({"id": self.number, "method": method, "params": arguments}))
        end = time.monotonic() + self.PATIENCE
        while time.monotonic() < end:
            message = json.loads(self.socket.recv())
            if message.get("id") == self.number:
                assert message["type"] == "success", message
                return message["result"]
            if self.page and "method" in message:
                self.page.event(message["method"], message["params"])
        raise TimeoutError(method)

    def open(self, url):
        return Page(self, url)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self.socket.close()
        finally:
            # With the processes that it has started.
            os.killpg(self.process.pid, signal.SIGTERM)
            self.process.wait(30)
            shutil.rmtree(self.folder, ignore_errors=True)
