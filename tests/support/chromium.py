"""Debian's Chromium, driven by Playwright: `make browser` installs both."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

CHROMIUM = Path("/usr/bin/chromium")
FLAGS = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-background-networking",
    "--disable-dev-shm-usage",  # containers have little of it
]

PATIENCE = 120_000
"""How long a machine that is busy with other work may take for anything, milliseconds. Playwright
waits for 5 s where it expects something and for 30 s elsewhere, which a loaded machine needs for
less than building a scene."""


def playwright_or_skip() -> Any:
    """The module of Playwright; without it, or without Chromium, the test module is skipped."""
    driver = pytest.importorskip("playwright.sync_api", reason="no Playwright: make browser")
    if not CHROMIUM.exists():
        pytest.skip(f"there is no {CHROMIUM}: make browser", allow_module_level=True)
    return driver


@contextmanager
def opened_browser(playwright: Any) -> Iterator[Any]:
    """A running browser; whatever is expected of its pages may take `PATIENCE`."""
    playwright.expect.set_options(timeout=PATIENCE)
    with playwright.sync_playwright() as driver:
        try:
            browser = driver.chromium.launch(executable_path=CHROMIUM, args=FLAGS, timeout=PATIENCE)
        except playwright.Error as error:
            pytest.skip(f"{CHROMIUM} does not start here: {error}")
        try:
            yield browser
        finally:
            browser.close()


def new_page(browser: Any, **settings: Any) -> tuple[Any, list[str]]:
    """An empty page, and the errors of its scripts as they come."""
    page, faults = browser.new_page(**settings), list[str]()
    page.set_default_timeout(PATIENCE)
    page.on("pageerror", lambda error: faults.append(str(error)))
    page.on("console", lambda said: said.type == "error" and faults.append(said.text))
    return page, faults


def serious_findings(page: Any) -> list[Any]:
    """What axe, Deque's checker of accessibility, finds serious or critical on a page."""
    axe = pytest.importorskip("axe_playwright_python", reason="no axe: make browser")
    page.evaluate((Path(axe.__file__).parent / "axe.min.js").read_text("utf-8"))
    found = page.evaluate("axe.run()")
    assert len(found["passes"]) > 10
    serious = [each for each in found["violations"] if each["impact"] in ("serious", "critical")]
    return [(each["id"], [node["html"] for node in each["nodes"]]) for each in serious]
