"""Commands that are spoken, by a recogniser of speech in place of the browser's."""

from __future__ import annotations

from tests.support.chromium import new_page
from tests.support.page_in_browser import COMMAND, expect, expect_verdict, visit

HEARS = """window.SpeechRecognition = window.webkitSpeechRecognition = class {
  start() {
    const words = [{ transcript: " go through the second door on the right" }];
    const said = Object.assign(words, { isFinal: true });
    setTimeout(() => {
      window.lang = this.lang;
      if (window.deaf) this.onerror({ error: "not-allowed" });
      else this.onresult({ results: [said] });
      this.onend();
    }, 50);
  }
}"""
HEARS_NOT = "window.SpeechRecognition = window.webkitSpeechRecognition = undefined"


def test_a_spoken_command_is_driven(browser, address):
    page, _ = new_page(browser)
    page.add_init_script(HEARS)
    visit(page, address)
    page.select_option("#language", "en")
    page.evaluate("window.deaf = true")
    page.click("#speak")
    expect_verdict(page, "may not use the microphone")
    page.evaluate("window.deaf = false")
    page.click("#speak")
    expect(page.locator("#clauses li")).to_have_text([COMMAND])
    assert page.evaluate("window.lang") == "en-US"
    page.close()


def test_without_speech_recognition_there_is_no_button_for_it(browser, address):
    page, _ = new_page(browser)
    page.add_init_script(HEARS_NOT)
    visit(page, address)
    expect(page.locator("#speak")).to_be_hidden()
    page.close()
