"""A run that is looked at again, and the files that are kept of it."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.page_in_browser import drive_and_pause, expect, expect_verdict, go_on, hurry


def test_a_run_is_looked_at_again(driven):
    end = driven.inner_text("#clock")
    driven.click("#back")
    expect(driven.locator("#clock")).not_to_have_text(end)
    driven.fill("#moment", "0")
    expect(driven.locator("#back")).to_be_disabled()
    expect(driven.locator("#clauses li")).to_have_class("active")
    driven.click("#forth")
    expect(driven.locator("#back")).to_be_enabled()
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


def test_the_film_is_downloaded(driven):
    pytest.importorskip("pygame")
    with driven.expect_download() as download:
        driven.click("#film")
    assert download.value.suggested_filename == "semnav.gif"
    assert Path(download.value.path()).read_bytes().startswith(b"GIF89a")


def test_episode_and_floor_plan_are_downloaded(driven):
    for button, name, begin in (
        ("#episode", "episode.jsonl", b'{"id":"page-00000"'),
        ("#plan-copy", "heidelberg_hallway.geojson", b'{"type": "FeatureCollection"'),
    ):
        with driven.expect_download() as download:
            driven.click(button)
        assert download.value.suggested_filename == name
        assert Path(download.value.path()).read_bytes().startswith(begin)
