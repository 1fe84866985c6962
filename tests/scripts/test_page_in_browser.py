"""The page of `semnav serve` in Debian's Chromium: `make browser` installs what it needs."""

from __future__ import annotations

import re
import threading
import time
from contextlib import contextmanager
from pathlib import Path

import pytest

from semnav_scripts.page.listening import listening
from tests.support.asked import asked_about
from tests.support.chromium import (
    new_page,
    opened_browser,
    playwright_or_skip,
    serious_findings,
)
from tests.support.page_visitor import WALLS

uvicorn = pytest.importorskip("uvicorn", reason='needs pip install "semnav-env[serve]"')
playwright = playwright_or_skip()
expect = playwright.expect
PHONE = {"width": 360, "height": 740}
COMMAND = "go through the second door on the right"


@contextmanager
def served():
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


@pytest.fixture(scope="module")
def address():
    """Of a server that has compiled everything, as `semnav serve` does before it is there."""
    from semnav_scripts.page.warm_up import warm_up

    warm_up()
    with served() as home:
        yield home


@pytest.fixture(scope="module")
def browser():
    with opened_browser(playwright) as opened:
        yield opened


@pytest.fixture(scope="module")
def window(browser):
    """One page for most of the tests, and its errors: opening another takes a process."""
    return new_page(browser)


@pytest.fixture
def page(window, address):
    """A page whose scene is there; it must not report an error by the end."""
    opened, faults = window
    faults.clear()
    visit(opened, address)
    yield opened
    assert faults == []


@pytest.fixture(scope="module")
def driven(browser, address):
    """A page on which a run has ended well; each test leaves it at its end."""
    opened, faults = new_page(browser)
    visit(opened, address)
    hurry(opened)
    say(opened, COMMAND)
    expect_verdict(opened, "Done.")
    yield opened
    opened.close()
    assert faults == []


def visit(page, address):
    page.goto(address)
    expect(page.locator("#suggestion")).to_be_visible()


LATER = re.compile(r"^(0\.[2-9]|[1-9])")
"""What the clock shows once a run has several moments."""


def say(page, text):
    page.fill("#command", text)
    page.keyboard.press("Enter")


def hurry(page):
    page.select_option("#speed", "8")


def drive_and_pause(page):
    """Begin to drive, and stop the time: a busy machine is in time for whatever follows."""
    page.select_option("#speed", "0.25")
    say(page, COMMAND)
    expect(page.locator("#clock")).to_have_text(LATER)
    page.click("#pause")
    expect(page.locator("#pause")).to_have_text("Go on")


def go_on(page):
    hurry(page)
    page.click("#pause")


def expect_verdict(page, words):
    expect(page.locator("#verdict")).to_contain_text(words)


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


def test_a_click_shuts_a_door_and_the_robot_does_not_get_in(page):
    drive_and_pause(page)
    page.click("summary")
    page.click("[data-door=south_2]")
    expect(page.locator("[data-door=south_2]")).to_contain_text("shut, open it")
    go_on(page)
    expect_verdict(page, "Not done")


def test_boxes_are_put_down_by_the_cross_and_taken_away(page):
    page.check("input[value=box]")
    page.focus("#canvas")
    page.keyboard.press("Shift+ArrowRight")
    page.keyboard.press("Shift+ArrowRight")
    page.keyboard.press("Enter")
    expect_verdict(page, "no wall")
    page.keyboard.press("Shift+ArrowUp")
    page.keyboard.press("Enter")
    expect(page.locator("#clear-boxes")).to_be_enabled()
    page.click("#clear-boxes")
    expect(page.locator("#clear-boxes")).to_be_disabled()


def test_a_box_and_a_person_come_into_a_run_that_goes_on(page):
    """The scene stays as it is: neither begins it anew."""
    drive_and_pause(page)
    before = seconds(page)
    for what, way, told in (("box", 3, "A box is put down"), ("person", 4, "A person walks")):
        page.check(f"input[value={what}]")
        page.focus("#canvas")
        for key in (*["Shift+ArrowRight"] * way, "Shift+ArrowUp", "Enter"):
            page.keyboard.press(key)
        expect_verdict(page, told)
    assert seconds(page) >= before
    assert page.input_value("#people") == "0"
    expect(page.locator("#clear-boxes")).to_be_disabled()
    go_on(page)
    expect_verdict(page, re.compile("Done|Not done"))


def test_a_person_is_added_only_to_a_run(page):
    page.check("input[value=person]")
    page.focus("#canvas")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Enter")
    expect_verdict(page, "while the robot drives")


def seconds(page):
    """What the clock of the run shows."""
    return float(page.inner_text("#clock").split()[0])


def test_the_robot_is_placed_by_a_drag_also_before_the_first_picture(page, browser, address):
    """A browser that is busy draws late; the place does not depend on it."""
    place_robot(page)
    expect(page.locator("#start")).not_to_have_value("-2.5, -0.6, 0.25")
    late, faults = new_page(browser)
    late.add_init_script("window.requestAnimationFrame = () => 0")
    visit(late, address)
    place_robot(late)
    expect(late.locator("#start")).to_have_value(page.input_value("#start"))
    late.close()
    assert faults == []


def place_robot(page):
    """Drag the robot to a place right of the middle, and turn it to the left."""
    page.check("input[value=robot]")
    box = page.locator("#canvas").bounding_box()
    x, y = box["x"] + 0.62 * box["width"], box["y"] + 0.46 * box["height"]
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x - 60, y + 1)
    page.mouse.up()


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


def test_the_film_is_downloaded(driven):
    pytest.importorskip("pygame")
    with driven.expect_download() as download:
        driven.click("#film")
    assert download.value.suggested_filename == "semnav.gif"
    assert Path(download.value.path()).read_bytes().startswith(b"GIF89a")


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
        page, _ = new_page(browser)
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
def test_all_can_be_used_and_read_also_on_a_phone(browser, address, scheme):
    """Deque's checker of accessibility: the scene, a question, and the drawing board."""
    page, _ = new_page(browser, color_scheme=scheme)
    visit(page, address)
    ratios = page.evaluate(CONTRASTS)
    assert min(ratios.values()) >= 4.5, ratios
    wide = page.viewport_size
    for state in ("scene", "question", "board"):
        if state == "question":
            say(page, asked_about()[0])
            expect(page.locator("#heard button")).to_have_count(2)
        if state == "board":
            page.click("#open-board")
            expect(page.locator("#draw")).to_be_visible()
        assert serious_findings(page) == []
        page.set_viewport_size(PHONE)
        assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]
        page.set_viewport_size(wide)
    page.close()


def test_a_run_is_looked_at_again(driven):
    end = driven.inner_text("#clock")
    driven.click("#back")
    expect(driven.locator("#clock")).not_to_have_text(end)
    driven.fill("#moment", "0")
    expect(driven.locator("#back")).to_be_disabled()
    expect(driven.locator("#clauses li")).to_have_class("active")
    driven.select_option("#speed", "0.25")
    driven.click("#play")
    expect(driven.locator("#play")).to_have_text("Halt")
    hurry(driven)
    expect(driven.locator("#clock")).to_have_text(end)
    expect(driven.locator("#play")).to_have_text("Replay")
    expect(driven.locator("#clauses li")).to_have_class("done")


def test_a_paused_run_that_is_looked_at_goes_on_at_its_end(page):
    drive_and_pause(page)
    page.fill("#moment", "0")
    before = page.inner_text("#clock")
    go_on(page)
    expect(page.locator("#clock")).not_to_have_text(before)
    expect_verdict(page, "Done.")


def test_episode_and_floor_plan_are_downloaded(driven):
    for button, name, begin in (
        ("#episode", "episode.jsonl", b'{"id":"page-00000"'),
        ("#plan-copy", "heidelberg_hallway.geojson", b'{"type": "FeatureCollection"'),
    ):
        with driven.expect_download() as download:
            driven.click(button)
        assert download.value.suggested_filename == name
        assert Path(download.value.path()).read_bytes().startswith(begin)


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


def test_a_dropped_file_that_is_no_floor_plan_is_told(page):
    files = [{"name": "notes.txt", "mimeType": "text/plain", "buffer": b"hello"}]
    page.set_input_files("#plan-file", files)
    expect_verdict(page, "notes.txt:")
    drop(page, "bad.geojson", "{")
    expect_verdict(page, "bad.geojson: not JSON")


def drop(page, name, text):
    """Drop a file on the page, as from another window."""
    data = page.evaluate_handle(
        "([name, text]) => { const data = new DataTransfer();"
        " data.items.add(new File([text], name)); return data; }",
        [name, text],
    )
    page.dispatch_event("#canvas", "drop", {"dataTransfer": data})


def draw(page, tool, *points, name=""):
    """Draw by the pointer, from place to place of the plan of `WALLS`, metres."""
    page.check(f"input[value={tool}]")
    if name:
        page.fill("#part-name", name)
    box = page.locator("#canvas").bounding_box()
    scale = min((box["width"] - 32) / 10, (box["height"] - 32) / 7)  # with 1 m around the walls
    for k, (x, y) in enumerate(points):
        page.mouse.move(
            box["x"] + box["width"] / 2 + (x - 4.0) * scale,
            box["y"] + box["height"] / 2 - (y - 2.5) * scale,
        )
        if k == 0:
            page.mouse.down()
    page.mouse.up()


def test_a_map_is_drawn_on_saved_and_driven_in(page):
    drop(page, "walls.csv", WALLS)
    expect(page.locator("#draw")).to_be_visible()
    draw(page, "door", (3.1, 2.05), (3.9, 1.95), name="office")
    expect(page.locator("#board-said")).to_contain_text("1 doors")
    draw(page, "corridor", (0.6, 1.0), (7.4, 1.0))
    expect(page.locator("#board-said")).to_contain_text("1 corridors")
    draw(page, "room", (5.0, 4.0))
    expect(page.locator("#board-said")).to_contain_text("Type the name of the room first.")
    draw(page, "room", (5.0, 4.0), name="library")
    expect(page.locator("#board-said")).to_contain_text("1 rooms")
    page.click("#undo")
    expect(page.locator("#board-said")).to_contain_text("0 rooms")
    page.click("#redo")
    expect(page.locator("#board-said")).to_contain_text("1 rooms")
    page.click("#check")
    expect(page.locator("#board-said")).to_have_text("Nothing is wrong with it.")
    with page.expect_download() as download:
        page.click("#board-copy")
    assert download.value.suggested_filename == "plan.geojson"
    page.click("#drive-here")
    expect(page.locator("#draw")).to_be_hidden()
    expect(page.locator("#plan")).to_have_value("own")
    hurry(page)
    say(page, "go to the library")
    expect_verdict(page, "Done.")


def test_faults_are_listed_and_a_known_length_sets_the_scale(page):
    drop(page, "walls.csv", WALLS)
    draw(page, "corridor", (0.6, 1.0), (7.4, 1.0))
    expect(page.locator("#board-said")).to_contain_text("1 corridors")
    page.check("input[value=scale]")
    page.fill("#known-length", "16")
    draw(page, "scale", (0.0, 0.0), (8.0, 0.0))
    expect(page.locator("#undo")).to_be_enabled()
    page.click("#check")
    expect(page.locator("#board-said")).to_contain_text("wrong")
    page.click("#close-board")
    expect(page.locator("#talk")).to_be_visible()


def test_a_door_is_drawn_by_the_keyboard_alone(page):
    page.click("#open-board")
    expect(page.locator("#draw")).to_be_visible()
    page.check("input[value=wall]")
    page.focus("#canvas")
    for key in ("ArrowRight", "Enter", "Shift+ArrowUp", "Alt+ArrowUp", "Enter"):
        page.keyboard.press(key)
    expect(page.locator("#undo")).to_be_enabled()
