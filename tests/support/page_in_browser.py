"""What a visitor does on the page of `semnav serve` in a browser, and the server that it needs."""

from __future__ import annotations

import re
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest

from semnav_scripts.page.listening import listening
from tests.support.chromium import PATIENCE, playwright_or_skip

uvicorn = pytest.importorskip("uvicorn", reason='needs pip install "semnav-env[serve]"')
expect = playwright_or_skip().expect
COMMAND = "go through the second door on the right"


@contextmanager
def served() -> Iterator[str]:
    """The address of a running server."""
    from semnav_scripts.page.app import page_app

    with listening("127.0.0.1", 0) as place:
        server = uvicorn.Server(uvicorn.Config(page_app(sessions=12), log_level="warning"))
        thread = threading.Thread(target=server.run, kwargs={"sockets": [place]})
        thread.start()
        try:
            while not server.started:
                time.sleep(0.01)
            yield f"http://127.0.0.1:{place.getsockname()[1]}/"
        finally:
            server.should_exit = True
            thread.join()


def visit(page: Any, address: str) -> None:
    page.goto(address)
    expect(page.locator("#suggestion")).to_be_visible()


LATER = re.compile(r"^(0\.[2-9]|[1-9])")
"""What the clock shows once a run has several moments."""


def say(page: Any, text: str) -> None:
    page.fill("#command", text)
    page.keyboard.press("Enter")


def hurry(page: Any) -> None:
    page.select_option("#speed", "8")


def drive_and_pause(page: Any) -> None:
    """Begin to drive, and stop the time: a busy machine is in time for whatever follows."""
    page.select_option("#speed", "0.25")
    say(page, COMMAND)
    expect(page.locator("#clock")).to_have_text(LATER)
    page.click("#pause")
    expect(page.locator("#pause")).to_have_text("Go on")


def go_on(page: Any) -> None:
    hurry(page)
    page.click("#pause")


def expect_verdict(page: Any, words: str | re.Pattern[str]) -> None:
    expect(page.locator("#verdict")).to_contain_text(words)


def seconds(page: Any) -> float:
    """What the clock of the run shows."""
    return float(page.inner_text("#clock").split()[0])


def painted(page: Any) -> str:
    """The picture of the plan, once nothing more is to be drawn."""
    drawn = "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"
    page.evaluate(drawn)
    return str(page.evaluate("document.getElementById('canvas').toDataURL()"))


def becomes(page: Any, picture: str, same: bool) -> None:
    """Wait until the picture of the plan is this one, or another one."""
    for _ in range(PATIENCE // 100):  # the page's policy forbids `wait_for_function`
        if (painted(page) == picture) is same:
            return
        page.wait_for_timeout(100)
    raise AssertionError("the picture of the plan is " + ("another one" if same else "the same"))
