"""What a visitor changes on the plan by hand, before a run and while it goes on."""

from __future__ import annotations

import re

from tests.support.chromium import new_page
from tests.support.page_in_browser import (
    drive_and_pause,
    expect,
    expect_verdict,
    go_on,
    seconds,
    visit,
)


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


def test_the_robot_is_carried_in_a_run_that_goes_on(page):
    """The scene stays as it is, and so does the link."""
    drive_and_pause(page)
    page.wait_for_timeout(300)  # the last picture before the pause may be under way
    before, start, link = seconds(page), page.input_value("#start"), page.url
    place_robot(page)
    expect_verdict(page, "The robot is carried there.")
    expect(page.locator("#clock")).not_to_have_text(f"{before:.2f} s")
    assert 0.0 < seconds(page) - before < 0.2
    assert (page.input_value("#start"), page.url) == (start, link)
    go_on(page)
    expect_verdict(page, re.compile("Done|Not done"))


def test_the_robot_is_carried_by_the_keyboard_but_not_out_of_the_plan(page):
    drive_and_pause(page)
    page.check("input[value=robot]")
    page.focus("#canvas")
    for _ in range(4):
        page.keyboard.press("Shift+ArrowUp")
    page.keyboard.press("Enter")
    expect_verdict(page, "is free")
    for _ in range(4):
        page.keyboard.press("Shift+ArrowDown")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Enter")
    expect_verdict(page, "The robot is carried there.")
