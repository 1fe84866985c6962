"""Debian's Chromium, driven by Playwright: `make browser` installs both."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

CHROMIUM = Path("/usr/bin/chromium")
FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking"]


def playwright_or_skip() -> Any:
    """The module of Playwright; without it, or without Chromium, the test module is skipped."""
    driver = pytest.importorskip("playwright.sync_api", reason="no Playwright: make browser")
    if not CHROMIUM.exists():
        pytest.skip(f"there is no {CHROMIUM}: make browser", allow_module_level=True)
    return driver


@contextmanager
def opened_browser(playwright: Any) -> Iterator[Any]:
    """A running browser."""
    with playwright.sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        try:
            yield browser
        finally:
            browser.close()


def serious_findings(page: Any) -> list[Any]:
    """What axe, Deque's checker of accessibility, finds serious or critical on a page."""
    axe = pytest.importorskip("axe_playwright_python", reason="no axe: make browser")
    page.evaluate((Path(axe.__file__).parent / "axe.min.js").read_text("utf-8"))
    found = page.evaluate("axe.run()")
    assert len(found["passes"]) > 10
    serious = [each for each in found["violations"] if each["impact"] in ("serious", "critical")]
    return [(each["id"], [node["html"] for node in each["nodes"]]) for each in serious]
