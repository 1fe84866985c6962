"""The scene as the form and a link tell it."""

from __future__ import annotations

import re

from tests.support.chromium import new_page
from tests.support.page_in_browser import (
    COMMAND,
    becomes,
    expect,
    expect_verdict,
    hurry,
    painted,
    say,
    visit,
)


def test_what_cannot_be_is_told_and_the_form_shows_what_is(page):
    page.fill("#start", "90, 90, 0")
    page.keyboard.press("Enter")
    expect_verdict(page, "start pose")
    expect(page.locator("#start")).to_have_value("-2.5, -0.6, 0.25")


def test_a_link_brings_scene_and_command_back(page, browser, address):
    page.select_option("#plan", "office:small")
    page.fill("#office-number", "3")
    page.keyboard.press("Tab")
    page.select_option("#robot", "spot")
    expect(page.locator("#robot")).to_have_value("spot")
    page.click("#suggestion")
    expect(page.locator("#clauses li").first).to_be_visible()
    said, link = page.input_value("#command"), page.url
    page.click("#reset")
    other, _ = new_page(browser)
    visit(other, link)
    expect(other.locator("#plan")).to_have_value("office:small")
    expect(other.locator("#office-number")).to_have_value("3")
    expect(other.locator("#robot")).to_have_value("spot")
    expect(other.locator("#command")).to_have_value(said)
    expect(other.locator("#clauses li").first).to_be_visible()
    other.close()


def test_each_field_of_the_form_changes_the_scene(page):
    page.select_option("#agent", "oracle")
    for field, value in (("#seed", "3"), ("#people", "2")):
        expect(page.locator("#suggestion")).to_be_visible()  # the scene before is there
        page.fill(field, value)
        page.keyboard.press("Tab")
    expect(page.locator("#suggestion")).to_be_visible()
    page.uncheck("#leaves")
    expect(page.locator("#door-details")).to_be_hidden()
    hurry(page)
    say(page, COMMAND)
    expect(page.locator("#clauses li")).to_have_text([COMMAND])
    for told in ("agent=oracle", "seed=3", "people=2", "leaves=no"):
        assert told in page.url
    expect_verdict(page, re.compile("Done|Not done"))


def test_another_office_is_generated(page):
    page.select_option("#plan", "office:small")
    expect(page.locator("#suggestion")).to_be_visible()
    first, suggested = page.input_value("#office-number"), page.inner_text("#suggestion")
    page.click("#another")
    expect(page.locator("#suggestion")).not_to_have_text(suggested)
    assert page.input_value("#office-number") != first


def test_the_link_is_copied_or_shown(page):
    """A browser may refuse to copy."""
    page.click("#link")
    expect(page.locator("#kept")).to_have_text(re.compile("link is copied|plan=heidelberg_hallway"))


def test_the_plan_is_zoomed_and_shown_whole_again(page):
    page.click("#whole")
    whole = painted(page)
    for zoom, back in (("#nearer", "#farther"), ("#nearer", "#whole")):
        page.click(zoom)
        becomes(page, whole, False)
        page.click(back)
        becomes(page, whole, True)
