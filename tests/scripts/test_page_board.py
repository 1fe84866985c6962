"""Floor plans of a visitor's own: dropped on the page, drawn on, driven in and kept."""

from __future__ import annotations

import json

import pytest

from semnav_env.judge.episodes import load_episodes
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.maps.check import check
from semnav_env.world.maps.writer import to_geojson
from semnav_scripts.page.requests import MAX_FILE
from tests.support.asked import asked_about
from tests.support.command_line import run
from tests.support.page_visitor import (
    SCENE,
    SECOND_DOOR,
    WALLS,
    in_the_hallway,
    opened_page,
    visitor,
)

pytest.importorskip("starlette", reason='needs pip install "semnav-env[serve]"')
pytest.importorskip("httpx2", reason="the test client of Starlette needs httpx2")


@pytest.fixture
def client():
    with opened_page(sessions=2) as opened:
        yield opened


def in_the_room_behind(board):
    """The board with everything that can be said of `WALLS`."""
    board.draw("door", (3.1, 2.1), (3.9, 1.9), name="office")
    board.draw("corridor", (0.5, 0.9), (7.5, 1.1), name="hall")
    return board.draw("room", (5.0, 4.0), name="library")


def test_a_dropped_plan_is_driven_in(client):
    text = to_geojson(load_floor_plan("heidelberg_hallway"))
    with visitor(client) as one:
        one.drop("mine.geojson", text.encode())
        assert len(one.next("board")["plan"]["doors"]) == 4
        one.send(**SCENE | {"plan": "own"})
        assert one.next("scene")["scene"]["plan"] == "own"
        one.send(type="speed", factor=16)
        one.send(**SECOND_DOOR)
        assert one.next("ended")["outcome"] == "done"


def test_a_dropped_map_is_drawn_on_until_nothing_is_wrong_and_driven_in(client):
    with visitor(client) as one:
        one.drop("walls.csv", WALLS.encode())
        assert one.next("board")["plan"]["doors"] == []
        board = in_the_room_behind(one)
        assert [door["name"] for door in board["plan"]["doors"]] == ["office"]
        assert one.draw("check")["faults"] == []
        one.send(type="scene", plan="own", pose=[1.0, 1.0, 0.0])
        one.next("scene")
        one.send(type="speed", factor=16)
        one.send(type="command", text="go through the first door on the left")
        assert one.next("ended")["outcome"] == "done"


def test_the_board_is_kept_as_a_file_that_passes_the_check(client, tmp_path):
    with visitor(client) as one:
        one.drop("walls.csv", WALLS.encode())
        one.next("board")
        in_the_room_behind(one)
        one.send(type="keep", what="board")
        name, content = one.next_file()
    (tmp_path / name).write_bytes(content)
    assert check(load_floor_plan(tmp_path / name)) == []


def test_a_plan_without_a_corridor_is_not_driven_in(client):
    with visitor(client) as one:
        one.drop("walls.csv", WALLS.encode())
        one.next("board")
        one.send(type="scene", plan="own")
        assert "no corridor" in one.next("error")["text"]


def test_what_is_undone_can_be_done_again(client):
    with visitor(client) as one:
        one.send(**SCENE)
        before = one.draw("open")
        after = one.draw("room", *room(before), name="lab")
        undone = one.draw("undo")
        assert undone["plan"] == before["plan"]
        assert (undone["undo"], undone["redo"]) == (0, 1)
        assert one.draw("redo")["plan"] == after["plan"] != before["plan"]


def room(board):
    """A place in the first room of a board."""
    return [board["plan"]["rooms"][0]["at"]]


def test_opening_the_board_takes_the_plan_of_the_scene(client):
    with visitor(client) as one:
        one.drop("walls.csv", WALLS.encode())
        one.next("board")
        one.send(**SCENE)
        one.next("scene")
        assert one.draw("open")["plan"]["name"] == "heidelberg_hallway"


@pytest.mark.parametrize(
    ("name", "content", "why"),
    [
        ("plan.geojson", b"{", "not JSON"),
        ("plan.geojson", b"\xff\xfe", "not UTF-8"),
        ("plan.geojson", b'{"type": "FeatureCollection", "features": []}', "plan.geojson"),
        ("map.png", b"no picture", "map.png"),
        ("map.yaml", b"image: /etc/passwd", "no floor plan of a known kind"),
        ("../../secret", b"", "no floor plan of a known kind"),
        ("walls.csv", b"a,b,c,d", "walls.csv"),
        ("walls.csv", b"0," * (MAX_FILE // 2 + 1), "at most 4000000"),
    ],
)
def test_a_file_that_is_no_floor_plan_is_refused_in_one_line(client, name, content, why):
    with in_the_hallway(client) as one:
        one.drop(name, content)
        told = one.next("error")["text"]
        assert why in told
        assert "/tmp" not in told
        assert "should not have happened" not in told
        one.send(**SECOND_DOOR)
        assert one.next("ended")["outcome"] == "done"


def test_the_episode_of_a_run_is_carried_out_again(client, tmp_path, capsys):
    with in_the_hallway(client) as one:
        one.send(**SECOND_DOOR)
        one.next("ended")
        one.send(type="keep", what="episode")
        name, content = one.next_file()
    (tmp_path / name).write_bytes(content)
    (episode,) = load_episodes(str(tmp_path / name))
    assert (episode.command, episode.start) == (SECOND_DOOR["text"], tuple(SCENE["pose"]))
    _, printed, said = run(capsys, "evaluate", tmp_path / name, "--json")
    assert not said, said
    assert json.loads(printed)[-1]["success"] == 1.0


def test_the_episode_of_a_plan_of_ones_own_names_the_file_of_the_plan(client, tmp_path):
    with in_the_hallway(client) as one:
        one.send(**SCENE, boxes=[[7.7, -1.3]])
        one.next("scene")
        one.send(**SECOND_DOOR)
        one.next("ended")
        for what in ("plan", "episode"):
            one.send(type="keep", what=what)
            name, content = one.next_file()
            (tmp_path / name).write_bytes(content)
    (episode,) = load_episodes(str(tmp_path / name))
    assert any(s.material == "furniture" for s in episode.plan().surfaces)


def test_an_answered_question_is_kept_with_its_meaning(client):
    text, question = asked_about()
    with in_the_hallway(client) as one:
        one.send(type="command", text=text)
        one.send(type="answer", text=one.next("asked")["choices"][0])
        one.next("understood")
        one.send(type="keep", what="episode")
        assert json.loads(one.next_file()[1])["command"] == str(question.readings[0])
