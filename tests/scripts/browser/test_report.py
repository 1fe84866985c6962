"""The report of `semnav evaluate --html` in Debian's Chromium: `make browser`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from semnav_agents.evaluation import summarise
from semnav_scripts.report.html_report import save_report
from tests.scripts.test_report import MADE_BY, WHO
from tests.support.chromium import new_page, playwright_or_skip, serious_findings
from tests.support.kept_drives import failure

expect = playwright_or_skip().expect
WIDTHS = (360, 1300)


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> str:
    path: Path = tmp_path_factory.mktemp("report") / "report.html"
    results = [failure(0), failure(1, kind="Wait")]
    everything = summarise("all", results)
    save_report(path, WHO | MADE_BY, [everything], everything, results)
    return path.as_uri()


def visit(
    browser: Any, address: str, still: bool = False, **settings: Any
) -> tuple[Any, list[str]]:
    """The opened page, and what goes wrong on it or is asked for elsewhere.

    Args:
        browser: a running one.
        address: of the page.
        still: whether its time stands still but for `page.clock.run_for`: a busy machine would
            miss what plays.
        settings: of the page.
    """
    page, faults = new_page(browser, **settings)
    if still:
        page.clock.install(time=0)
        page.clock.pause_at(1000)
    page.on("request", lambda asked: asked.url != address and faults.append(asked.url))
    page.goto(address)
    return page, faults


def painted(page: Any) -> Any:
    """The picture of the first failure."""
    return page.evaluate("document.querySelector('canvas').toDataURL()")


def test_a_failure_is_drawn_at_its_end_and_plays(browser: Any, address: str) -> None:
    page, faults = visit(browser, address, still=True)
    clock, button = page.locator("article output").first, page.locator("article button").first
    expect(clock).to_have_text("6.0 s")
    end = painted(page)
    page.select_option("#speed", "1")
    button.click()
    expect(button).to_have_text("Halt")
    page.clock.run_for(2000)
    expect(clock).not_to_have_text("6.0 s")
    assert painted(page) != end
    button.click()
    expect(button).to_have_text("Play")
    page.select_option("#speed", "16")
    button.click()
    page.clock.run_for(6000)
    expect(clock).to_have_text("6.0 s")
    expect(button).to_have_text("Play")
    assert painted(page) == end
    assert faults == []
    page.close()


def test_one_failure_plays_at_a_time(browser: Any, address: str) -> None:
    page, _ = visit(browser, address, still=True)
    page.select_option("#speed", "1")
    first, second = page.locator("article button").all()
    first.click()
    second.click()
    expect(first).to_have_text("Play")
    expect(second).to_have_text("Halt")
    page.close()


def test_the_slider_goes_to_a_moment(browser: Any, address: str) -> None:
    page, _ = visit(browser, address)
    slider = page.locator("article input").first
    slider.focus()
    page.keyboard.press("Home")
    expect(page.locator("article output").first).to_have_text("0.0 s")
    page.keyboard.press("ArrowRight")
    expect(page.locator("article output").first).to_have_text("0.2 s")
    page.close()


@pytest.mark.parametrize("width", WIDTHS)
def test_nothing_is_wider_than_the_window(browser: Any, address: str, width: int) -> None:
    page, _ = visit(browser, address, viewport={"width": width, "height": 800})
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    page.close()


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing_serious_in_a_report(browser: Any, address: str, scheme: str) -> None:
    page, _ = visit(browser, address, color_scheme=scheme)
    assert serious_findings(page) == []
    page.close()
