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
from collections.abc import Iterator
from contextlib import contextmanager
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


def look_at(page: Path, width: int = 1100, picture: Path | None = None, *, dark: bool = False) -> Seen:
    """Opens a page in a window of that width and tells what happened; with `picture`, draws it whole."""
    with opened(page, width, dark=dark) as tab:
        if picture is not None:
            tab.draw(picture)
        return tab.seen()


@contextmanager
def opened(page: Path, width: int = 1100, *, dark: bool = False, downloads: Path | None = None) -> Iterator[Tab]:
    """A page in a window of that width, loaded, to be used; what it hands out goes to `downloads`."""
    with tempfile.TemporaryDirectory(prefix="browser-", ignore_cleanup_errors=True) as home:
        with _Chromium(browser(), home) as chromium:
            yield Tab(chromium, page.resolve().as_uri(), width, dark, downloads)


class Tab:
    """An open page, with a keyboard and a pointer."""

    KEYS = {"ArrowLeft": 37, "ArrowRight": 39, "Home": 36, "End": 35, "Escape": 27, "Enter": 13, "Tab": 9, " ": 32, "+": 187, "-": 189}

    def __init__(self, chromium: _Chromium, address: str, width: int, dark: bool, downloads: Path | None) -> None:
        self._chromium, self._address = chromium, address
        target = chromium.ask("Target.createTarget", url="about:blank")["targetId"]
        self._session = chromium.ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self._ask(f"{domain}.enable")
        self._ask("Emulation.setDeviceMetricsOverride", width=width, height=800, deviceScaleFactor=1, mobile=False)
        if dark:
            self._ask("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
        if downloads is not None:
            chromium.ask("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(downloads))
        chromium.events.clear()
        failed = self._ask("Page.navigate", url=address).get("errorText")
        assert not failed, f"{address}: {failed}"
        while not any(event["method"] == "Page.loadEventFired" for event in chromium.events):
            chromium.events.append(chromium.message())
        # Images may be decoded after they are loaded, and what scripts do late is said late. Charts are drawn once the page is laid out,
        # which a busy machine does late, too: it is within the second frame.
        self.value("Promise.all([...document.images].map(i => i.decode().catch(() => null)))"
                   ".then(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done))))"
                   ".then(() => new Promise(done => setTimeout(() => done('ready'), 100)))")

    def value(self, expression: str) -> Any:
        """What an expression comes to, once it is there."""
        answer = self._ask("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        assert "exceptionDetails" not in answer, answer
        return answer["result"].get("value")

    def until(self, expression: str) -> None:
        """Waits until an expression is true."""
        end = time.monotonic() + 10.0
        while not self.value(expression):
            assert time.monotonic() < end, f"not within 10 s: {expression}"
            time.sleep(0.02)

    def press(self, key: str) -> None:
        """Presses a key and lets it go."""
        text = {"text": {"Enter": "\r"}.get(key, key)} if len(key) == 1 or key == "Enter" else {}
        for kind in ("keyDown", "keyUp"):
            self._ask("Input.dispatchKeyEvent", type=kind, key=key, code=key, windowsVirtualKeyCode=self.KEYS[key],
                      **(text if kind == "keyDown" else {}))

    def point(self, kind: str, x: float, y: float, **more: Any) -> None:
        """Moves the pointer, or what else `kind` is: `mousePressed`, `mouseReleased`, `mouseWheel`."""
        button = {} if kind in ("mouseMoved", "mouseWheel") and "button" not in more else {"button": "left", "clickCount": 1}
        self._ask("Input.dispatchMouseEvent", type=kind, x=x, y=y, **{**button, **more})

    def click(self, x: float, y: float, times: int = 1) -> None:
        """Clicks, or double-clicks."""
        for count in range(1, times + 1):
            for kind in ("mousePressed", "mouseReleased"):
                self.point(kind, x, y, clickCount=count)

    def drag(self, x: float, y: float, to: float) -> None:
        """Drags along x."""
        self.point("mousePressed", x, y)
        for step in range(1, 6):
            self.point("mouseMoved", x + (to - x) * step / 5, y, button="left", buttons=1)
        self.point("mouseReleased", to, y)

    def place(self, selector: str) -> dict[str, float]:
        """Where an element is in the window, after it has been brought there: x, y, width, height."""
        found = self.value(f"(() => {{ const e = document.querySelector({json.dumps(selector)}); e.scrollIntoView({{block: 'center'}});"
                           " const b = e.getBoundingClientRect(); return {x: b.x, y: b.y, width: b.width, height: b.height}; })()")
        return dict(found)

    def as_printed(self, dark: bool = False) -> None:
        """Shows the page as paper has it, whatever the screen is like."""
        self._ask("Emulation.setEmulatedMedia", media="print", features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])
        self.value("new Promise(done => setTimeout(() => done('ready'), 100))")

    def draw(self, picture: Path) -> None:
        """A picture of the whole page."""
        picture.write_bytes(base64.b64decode(self._ask("Page.captureScreenshot", captureBeyondViewport=True)["data"]))

    def seen(self) -> Seen:
        """What there is to be seen, and what has been said up to now."""
        state = json.loads(self.value(STATE))
        seen = Seen(state["title"], state["images"], state["wide"])
        for event in self._chromium.events:
            _note(event, self._address, seen)
        return seen

    def _ask(self, method: str, **arguments: object) -> dict[str, Any]:
        return self._chromium.ask(method, self._session, **arguments)


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
        self.events: list[dict[str, Any]] = []
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

    def ask(self, method: str, session: str | None = None, **arguments: object) -> dict[str, Any]:
        self._count += 1
        message = {"id": self._count, "method": method, "params": arguments} | ({"sessionId": session} if session else {})
        try:
            os.write(self._write, json.dumps(message).encode() + b"\0")
        except BrokenPipeError:
            self._fail("has ended")
        while True:
            answer = self.message()
            if answer.get("id") == self._count:
                assert "error" not in answer, (method, answer["error"])
                return dict(answer["result"])
            self.events.append(answer)

    def message(self) -> dict[str, Any]:
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
        if address != page and not address.startswith(("data:", "blob:")):
            seen.requests.append(address)
