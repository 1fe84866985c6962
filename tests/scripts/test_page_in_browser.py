"""The page of `semnav serve` in Debian's Chromium: `make browser` installs what it needs."""

from __future__ import annotations

import threading
import time
from contextlib import contextmanager
from pathlib import Path

import pytest

from semnav_scripts.page.listening import listening

uvicorn = pytest.importorskip("uvicorn", reason='needs pip install "semnav-env[serve]"')
playwright = pytest.importorskip("playwright.sync_api", reason="no Playwright: make browser")
CHROMIUM = Path("/usr/bin/chromium")
if not CHROMIUM.exists():
    pytest.skip(f"there is no {CHROMIUM}: make browser", allow_module_level=True)

expect = playwright.expect
FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking"]
PHONE = {"width": 360, "height": 740}
COMMAND = "go through the second door on the right"
PATIENCE = 60_000
"""How long a busy machine may take for a run, milliseconds."""


@contextmanager
def served():
    """The address of a running server."""
    from semnav_scripts.page.app import page_app

    with listening("127.0.0.1", 0) as place:
        server = uvicorn.Server(uvicorn.Config(page_app(), log_level="warning"))
        thread = threading.Thread(target=server.run, kwargs={"sockets": [place]})
        thread.start()
        try:
            while not server.started:
                time.sleep(0.01)
            yield f"http://127.0.0.1:{place.getsockname()[1]}/"
        finally:
            server.should_exit = True
            thread.join()


@pytest.fixture(scope="module")
def address():
    with served() as home:
        yield home


@pytest.fixture(scope="module")
def browser():
    with playwright.sync_playwright() as driver:
        opened = driver.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        yield opened
        opened.close()


@pytest.fixture
def page(browser, address):
    """A page whose scene is there; it must not report an error by the end."""
    opened = browser.new_page()
    opened.set_default_timeout(PATIENCE)
    faults = []
    opened.on("pageerror", lambda error: faults.append(str(error)))
    opened.on("console", lambda said: said.type == "error" and faults.append(said.text))
    visit(opened, address)
    yield opened
    opened.close()
    assert faults == []


def visit(page, address):
    page.goto(address)
    expect(page.locator("#suggestion")).to_be_visible(timeout=PATIENCE)


def say(page, text):
    page.fill("#command", text)
    page.keyboard.press("Enter")


def hurry(page):
    page.select_option("#speed", "8")


def expect_verdict(page, words):
    expect(page.locator("#verdict")).to_contain_text(words, timeout=PATIENCE)


def test_a_command_is_typed_understood_driven_and_judged(page):
    hurry(page)
    say(page, COMMAND)
    expect(page.locator("#clauses li")).to_have_text([COMMAND])
    expect_verdict(page, "Done.")
    expect(page.locator("#clauses li")).to_have_class("done")
    expect(page.locator("#reason")).to_contain_text("second door on the right")


def test_it_works_by_the_keyboard_alone(page):
    page.keyboard.press("Tab")
    expect(page.locator("#command")).to_be_focused()
    page.keyboard.type(COMMAND)
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    expect(page.locator("#pause")).to_be_enabled()
    page.locator("#stop").focus()
    page.keyboard.press("Enter")
    expect_verdict(page, "Stopped by you.")


def test_a_question_has_its_answers_as_buttons(page):
    say(page, "turn 90 degrees")
    expect(page.locator("#heard .question")).to_have_text("Left, or right?")
    expect(page.locator("#heard button")).to_have_text(["left", "right"])
    page.click("#heard button >> text=right")
    expect(page.locator("#clauses li")).to_have_text(["turn right by 90 degrees"])


def test_what_is_not_understood_is_underlined(page):
    say(page, "sing the song of the sea")
    expect(page.locator("#heard mark")).not_to_be_empty()
    expect(page.locator("#heard .problem")).not_to_be_empty()


def test_words_are_shown_as_words(page):
    say(page, "<img src=x onerror=alert(1)>")
    expect(page.locator("#heard .said")).to_contain_text("<img src=x onerror=alert(1)>")
    assert page.locator("#heard img").count() == 0


def test_a_run_is_paused_stepped_and_goes_on(page):
    say(page, COMMAND)
    page.click("#pause")
    expect(page.locator("#pause")).to_have_text("Go on")
    page.wait_for_timeout(300)
    before = page.inner_text("#clock")
    page.click("#step")
    expect(page.locator("#clock")).not_to_have_text(before)
    hurry(page)
    page.click("#pause")
    expect_verdict(page, "Done.")


def test_a_click_shuts_a_door_and_the_robot_does_not_get_in(page):
    say(page, COMMAND)
    expect(page.locator("#pause")).to_be_enabled()
    page.click("summary")
    page.click("[data-door=south_2]")
    expect(page.locator("[data-door=south_2]")).to_contain_text("shut, open it")
    hurry(page)
    expect_verdict(page, "Not done")


def test_boxes_are_put_down_by_the_cross_and_taken_away(page):
    page.check("input[value=box]")
    page.focus("#canvas")
    for _ in range(2):
        page.keyboard.press("Shift+ArrowRight")
    page.keyboard.press("Enter")
    expect(page.locator("#clear-boxes")).to_be_enabled()
    page.click("#clear-boxes")
    expect(page.locator("#clear-boxes")).to_be_disabled()


def test_the_robot_is_placed_by_a_drag(page):
    page.check("input[value=robot]")
    box = page.locator("#canvas").bounding_box()
    x, y = box["x"] + 0.62 * box["width"], box["y"] + 0.46 * box["height"]
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x - 60, y + 1)
    page.mouse.up()
    expect(page.locator("#start")).not_to_have_value("-2.5, -0.6, 0.25")


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
    other = browser.new_page()
    visit(other, link)
    expect(other.locator("#plan")).to_have_value("office:small")
    expect(other.locator("#office-number")).to_have_value("3")
    expect(other.locator("#robot")).to_have_value("spot")
    expect(other.locator("#command")).to_have_value(said)
    expect(other.locator("#clauses li").first).to_be_visible()
    other.close()


def test_the_film_is_downloaded(page):
    pytest.importorskip("pygame")
    hurry(page)
    say(page, COMMAND)
    expect_verdict(page, "Done.")
    with page.expect_download() as download:
        page.click("#film")
    assert download.value.suggested_filename == "semnav.gif"
    assert Path(download.value.path()).read_bytes().startswith(b"GIF89a")


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_is_wider_than_a_phone_and_text_can_be_read(browser, address, scheme):
    page = browser.new_page(viewport=PHONE, color_scheme=scheme)
    visit(page, address)
    assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]
    ratios = page.evaluate(CONTRASTS)
    assert min(ratios.values()) >= 4.5, ratios
    page.close()


def test_everything_that_can_be_used_has_a_name(page):
    """What a screen reader says of buttons, fields and lists."""
    labels = "[...(e.labels ?? [])].map(label => label.textContent).join()"
    for element in page.locator("button:visible, input:visible, select:visible, canvas").all():
        name = element.evaluate(f"e => e.ariaLabel || e.textContent.trim() || {labels}")
        assert name.strip(), element.evaluate("e => e.outerHTML")
    assert page.locator("#verdict").get_attribute("role") == "status"
    assert page.locator("#heard").get_attribute("aria-live") == "polite"


def test_a_server_that_goes_away_is_told(browser):
    with served() as home:
        page = browser.new_page()
        visit(page, home)
    expect(page.locator("#connection")).to_contain_text("not connected")
    page.close()


CONTRASTS = """() => {
  const style = getComputedStyle(document.documentElement);
  const light = (name) => {
    const hex = style.getPropertyValue(`--${name}`).trim();
    const [r, g, b] = [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16) / 255)
      .map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const pairs = [["ink", "card"], ["muted", "card"], ["muted", "page"], ["accent", "card"],
    ["on-accent", "accent"], ["bad", "card"], ["good", "card"], ["ink", "active"]];
  return Object.fromEntries(pairs.map(([a, b]) => {
    const [x, y] = [light(a), light(b)].sort((p, q) => q - p);
    return [`${a} on ${b}`, (x + 0.05) / (y + 0.05)];
  }));
}"""


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing_serious(browser, address, scheme):
    """Deque's checker of accessibility, before and after a question."""
    axe = pytest.importorskip("axe_playwright_python", reason="no axe: make browser")
    page = browser.new_page(color_scheme=scheme)
    visit(page, address)
    for text in ("", "turn 90 degrees"):
        if text:
            say(page, text)
            expect(page.locator("#heard button")).to_have_text(["left", "right"])
        page.evaluate((Path(axe.__file__).parent / "axe.min.js").read_text("utf-8"))
        found = page.evaluate("axe.run()")
        assert len(found["passes"]) > 10
        serious = [v for v in found["violations"] if v["impact"] in ("serious", "critical")]
        assert [(each["id"], [n["html"] for n in each["nodes"]]) for each in serious] == []
    page.close()
