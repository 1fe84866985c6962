"""Commands on the page: typed, understood, asked about, driven and judged."""

from __future__ import annotations

from tests.support.asked import asked_about
from tests.support.chromium import new_page
from tests.support.page_in_browser import (
    COMMAND,
    drive_and_pause,
    expect,
    expect_verdict,
    go_on,
    say,
    seconds,
    served,
    visit,
)


def test_a_command_is_typed_understood_driven_and_judged(driven):
    expect(driven.locator("#clauses li")).to_have_text([COMMAND])
    expect(driven.locator("#clauses li")).to_have_class("done")
    expect(driven.locator("#reason")).to_contain_text("second door on the right")


def test_it_works_by_the_keyboard_alone(page):
    page.keyboard.press("Tab")
    expect(page.locator("#command")).to_be_focused()
    page.keyboard.type(COMMAND)
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    expect(page.locator("#pause")).to_be_enabled()
    expect(page.locator("#replay")).to_be_hidden()
    page.locator("#stop").focus()
    page.keyboard.press("Enter")
    expect_verdict(page, "Stopped by you.")


def test_a_question_has_its_answers_as_buttons(page):
    text, question = asked_about()
    say(page, text)
    expect(page.locator("#heard .question")).to_have_text(question.text)
    expect(page.locator("#heard button")).to_have_text([each.name for each in question.choices])
    page.click("#heard button >> nth=1")
    expect(page.locator("#clauses li").last).to_have_text(str(question.readings[1].clauses[-1]))


def test_what_is_not_understood_is_underlined(page):
    say(page, "sing the song of the sea")
    expect(page.locator("#heard mark")).not_to_be_empty()
    expect(page.locator("#heard .problem")).not_to_be_empty()


def test_words_are_shown_as_words(page):
    say(page, "<img src=x onerror=alert(1)>")
    expect(page.locator("#heard .said")).to_contain_text("<img src=x onerror=alert(1)>")
    assert page.locator("#heard img").count() == 0


def test_a_run_is_paused_stepped_and_goes_on(page):
    expect(page.locator("#episode")).to_be_disabled()
    drive_and_pause(page)
    page.wait_for_timeout(300)
    before = seconds(page)
    page.click("#step")
    expect(page.locator("#clock")).not_to_have_text(f"{before:.2f} s")
    assert 0.0 < seconds(page) - before < 0.2
    go_on(page)
    expect_verdict(page, "Done.")


def test_a_server_that_goes_away_is_told(browser):
    with served() as home:
        page, _ = new_page(browser)
        visit(page, home)
    expect(page.locator("#connection")).to_contain_text("not connected")
    page.close()
