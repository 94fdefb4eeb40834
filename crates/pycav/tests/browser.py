"""A page in a real browser: Chromium without a window, by the DevTools protocol over a pipe.

No driver and no client library is needed: messages are JSON texts that end with a zero byte, on the file descriptors
3 and 4 of the browser.
"""

from __future__ import annotations

import base64
import json
import os
import select
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

NAMES = ("chromium", "chromium-browser", "google-chrome")
LIMIT = 120.0
"""s; how long the browser may take for anything."""

# Puts the two ends of the pipes where the browser looks for them, and becomes the browser.
BECOME = """
import fcntl, os, sys
ends = [fcntl.fcntl(int(end), fcntl.F_DUPFD_CLOEXEC, 10) for end in sys.argv[1:3]]
os.dup2(ends[0], 3)
os.dup2(ends[1], 4)
os.execv(sys.argv[3], sys.argv[3:])
"""

STATE = """JSON.stringify({
    title: document.title,
    images: [...document.images].map(i => ({name: i.alt, complete: i.complete, width: i.naturalWidth, shown: i.clientWidth})),
    wide: document.documentElement.scrollWidth - document.documentElement.clientWidth,
})"""


@dataclass
class Seen:
    """What a browser had to say of a page."""

    title: str
    images: list[dict[str, Any]]
    too_wide: int
    """Pixels by which the page is wider than the window."""
    complaints: list[str] = field(default_factory=list)
    """Errors and warnings of the console, of scripts, of the network."""
    requests: list[str] = field(default_factory=list)
    """Addresses asked for besides the page itself and what is within it."""

    @property
    def faults(self) -> list[str]:
        """What is wrong with the page as one that is to hold everything itself."""
        broken = [f"image {image['name']!r} is not shown" for image in self.images
                  if not (image["complete"] and image["width"] > 0 and image["shown"] > 0)]
        wide = [f"{self.too_wide} pixels wider than the window"] if self.too_wide > 0 else []
        return self.complaints + [f"asks for {address}" for address in self.requests] + broken + wide


def browser() -> str:
    """The program; a test that needs it fails where there is none."""
    found = next(filter(None, map(shutil.which, NAMES)), None)
    assert found, "the report is tested in a browser, and there is none: apt-get install chromium"
    return found


def look_at(page: Path, width: int = 1100, picture: Path | None = None) -> Seen:
    """Opens a page in a window of that width and tells what happened; with `picture`, draws it whole."""
    with tempfile.TemporaryDirectory(prefix="browser-", ignore_cleanup_errors=True) as home:
        with _Chromium(browser(), home) as chromium:
            return chromium.look_at(page.resolve().as_uri(), width, picture)


class _Chromium:
    def __init__(self, program: str, home: str) -> None:
        options = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run",
                   "--disable-extensions", "--disable-background-networking", "--hide-scrollbars",
                   "--remote-debugging-pipe", f"--user-data-dir={home}", "about:blank"]
        from_us, self._write = os.pipe()
        self._read, to_us = os.pipe()
        self._said = open(Path(home) / "said.txt", "w+b")
        self._process = subprocess.Popen(
            [sys.executable, "-c", BECOME, str(from_us), str(to_us), program, *options], pass_fds=(from_us, to_us),
            stdin=subprocess.DEVNULL, stdout=self._said, stderr=self._said, env={**os.environ, "HOME": home})
        os.close(from_us)
        os.close(to_us)
        self._events: list[dict[str, Any]] = []
        self._rest = b""
        self._count = 0

    def __enter__(self) -> _Chromium:
        return self

    def __exit__(self, *_: object) -> None:
        # It ends when nobody talks to it any more.
        os.close(self._write)
        os.close(self._read)
        try:
            self._process.wait(10)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._said.close()

    def look_at(self, address: str, width: int, picture: Path | None) -> Seen:
        target = self._ask("Target.createTarget", url="about:blank")["targetId"]
        session = self._ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self._ask(f"{domain}.enable", session)
        self._ask("Emulation.setDeviceMetricsOverride", session, width=width, height=800, deviceScaleFactor=1, mobile=False)
        self._events.clear()
        failed = self._ask("Page.navigate", session, url=address).get("errorText")
        assert not failed, f"{address}: {failed}"
        while not any(event["method"] == "Page.loadEventFired" for event in self._events):
            self._events.append(self._message())
        # Images may be decoded after they are loaded, and what scripts do late is said late.
        self._evaluate(session, "Promise.all([...document.images].map(i => i.decode().catch(() => null)))"
                                ".then(() => new Promise(done => setTimeout(() => done('ready'), 100)))")
        state = json.loads(self._evaluate(session, STATE))
        if picture is not None:
            image = self._ask("Page.captureScreenshot", session, captureBeyondViewport=True)["data"]
            picture.write_bytes(base64.b64decode(image))
        seen = Seen(state["title"], state["images"], state["wide"])
        for event in self._events:
            _note(event, address, seen)
        return seen

    def _evaluate(self, session: str, expression: str) -> str:
        answer = self._ask("Runtime.evaluate", session, expression=expression, awaitPromise=True, returnByValue=True)
        assert "exceptionDetails" not in answer, answer
        value = answer["result"].get("value")
        assert isinstance(value, str), answer
        return value

    def _ask(self, method: str, session: str | None = None, **arguments: object) -> dict[str, Any]:
        self._count += 1
        message = {"id": self._count, "method": method, "params": arguments} | ({"sessionId": session} if session else {})
        try:
            os.write(self._write, json.dumps(message).encode() + b"\0")
        except BrokenPipeError:
            self._fail("has ended")
        while True:
            answer = self._message()
            if answer.get("id") == self._count:
                assert "error" not in answer, (method, answer["error"])
                return dict(answer["result"])
            self._events.append(answer)

    def _message(self) -> dict[str, Any]:
        end = time.monotonic() + LIMIT
        while b"\0" not in self._rest:
            if not select.select([self._read], [], [], max(0.0, end - time.monotonic()))[0]:
                self._fail(f"said nothing for {LIMIT:g} s")
            if not (more := os.read(self._read, 1 << 20)):
                self._fail("has ended")
            self._rest += more
        message, self._rest = self._rest.split(b"\0", 1)
        found: dict[str, Any] = json.loads(message)
        return found

    def _fail(self, what: str) -> None:
        self._said.seek(0)
        raise AssertionError(f"the browser {what}:\n{self._said.read().decode(errors='replace')}")


def _note(event: dict[str, Any], page: str, seen: Seen) -> None:
    """Sorts what the browser told meanwhile."""
    method, told = event.get("method"), event.get("params", {})
    if method == "Runtime.exceptionThrown":
        details = told["exceptionDetails"]
        seen.complaints.append(details.get("exception", {}).get("description", details["text"]))
    elif method == "Runtime.consoleAPICalled" and told["type"] in ("error", "warning", "assert"):
        seen.complaints.append(" ".join(str(a.get("value", a.get("description"))) for a in told["args"]))
    elif method == "Log.entryAdded" and told["entry"]["level"] in ("error", "warning"):
        seen.complaints.append(told["entry"]["text"])
    elif method == "Network.requestWillBeSent":
        address = told["request"]["url"]
        if address != page and not address.startswith("data:"):
            seen.requests.append(address)
