"""A server, a browser and pages in it, which the tests of this folder share."""

from __future__ import annotations

import pytest

from tests.support.chromium import new_page, opened_browser, playwright_or_skip


@pytest.fixture(scope="package")
def browser():
    with opened_browser(playwright_or_skip()) as opened:
        yield opened


@pytest.fixture(scope="package")
def address():
    """Of a server that has compiled everything, as `semnav serve` does before it is there."""
    from semnav_scripts.page.warm_up import warm_up
    from tests.support.page_in_browser import served

    warm_up()
    with served() as home:
        yield home


@pytest.fixture(scope="package")
def window(browser):
    """One page for most of the tests, and its errors: opening another takes a process."""
    return new_page(browser)


@pytest.fixture
def page(window, address):
    """A page whose scene is there; it must not report an error by the end."""
    from tests.support.page_in_browser import visit

    opened, faults = window
    faults.clear()
    visit(opened, address)
    yield opened
    assert faults == []


@pytest.fixture(scope="package")
def driven(browser, address):
    """A page on which a run has ended well; each test leaves it at its end."""
    from tests.support.page_in_browser import COMMAND, expect_verdict, hurry, say, visit

    opened, faults = new_page(browser)
    visit(opened, address)
    hurry(opened)
    say(opened, COMMAND)
    expect_verdict(opened, "Done.")
    yield opened
    opened.close()
    assert faults == []
