"""Floors that are dropped on the page and drawn on."""

from __future__ import annotations

from tests.support.page_in_browser import becomes, expect, expect_verdict, hurry, painted, say
from tests.support.page_visitor import WALLS


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
    draw(page, "erase", (5.0, 4.0))
    expect(page.locator("#board-said")).to_contain_text("0 rooms")
    page.click("#undo")
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


def test_the_view_of_the_board_is_moved(page):
    page.click("#open-board")
    expect(page.locator("#draw")).to_be_visible()
    for _ in range(4):  # until the plan is larger than the view
        page.click("#nearer")
    before = painted(page)
    draw(page, "view", (4.0, 2.5), (2.0, 2.5))
    becomes(page, before, False)
