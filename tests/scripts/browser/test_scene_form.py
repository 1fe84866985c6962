"""The scene as the form and a link tell it."""

from __future__ import annotations

from tests.support.chromium import new_page
from tests.support.page_in_browser import expect, expect_verdict, visit


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
