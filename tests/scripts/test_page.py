"""The page of `semnav serve`, asked as a browser asks it."""

from __future__ import annotations

import asyncio
import json
import math
import re
import signal
import subprocess
import sys
from subprocess import PIPE

import pytest

from semnav_scripts.page.outbox import MAX_NEWS, ClientTooSlowError, Outbox
from semnav_scripts.page.requests import MAX_REQUEST, SceneRequest, read_request
from tests.support.asked import asked_about
from tests.support.command_line import run
from tests.support.paths import ROOT, source

pytest.importorskip("starlette", reason='needs pip install "semnav-env[serve]"')
pytest.importorskip("httpx2", reason="the test client of Starlette needs httpx2")
WebSocketDisconnect = pytest.importorskip("starlette.websockets").WebSocketDisconnect

from tests.support.page_visitor import (  # noqa: E402
    HOME,
    SCENE,
    SECOND_DOOR,
    in_the_hallway,
    opened_page,
    visitor,
)


@pytest.fixture
def client():
    with opened_page(sessions=2) as opened:
        yield opened


def test_the_page_is_served_with_a_policy_that_loads_nothing_from_elsewhere(client):
    answer = client.get("/")
    assert answer.status_code == 200
    assert "default-src 'self'" in answer.headers["content-security-policy"]


def test_the_page_names_no_address_of_elsewhere():
    files = [path for path in source("semnav_scripts/page/web").iterdir()]
    assert {path.suffix for path in files} == {".html", ".css", ".js", ".svg"}
    for path in files:
        text = path.read_text("utf-8").replace('xmlns="http://www.w3.org/2000/svg"', "")
        assert not re.search(r"https?://", text), path


@pytest.mark.parametrize("origin", ["https://evil.example", "http://127.0.0.1:9", "null"])
def test_a_foreign_origin_is_refused(client, origin):
    assert client.get("/", headers={"origin": origin}).status_code == 403
    with pytest.raises(WebSocketDisconnect), visitor(client, origin=origin):
        pass


def test_the_own_origin_is_let_in(client):
    with visitor(client, origin=HOME) as one:
        assert one.next("choices")["plans"]


@pytest.mark.parametrize("host", ["evil.example", "127.0.0.1.evil.example:8321", "[::1", ""])
def test_a_foreign_host_is_refused(client, host):
    assert client.get("/", headers={"host": host}).status_code == 403
    with pytest.raises(WebSocketDisconnect), visitor(client, host=host):
        pass


@pytest.mark.parametrize(
    ("message", "why"),
    [
        ("", "no JSON"),
        ("{", "no JSON"),
        ("[" * 4000, "no JSON"),
        ("[]", "JSON object"),
        ("x" * (MAX_REQUEST + 1), "characters"),
        ('{"text": "stop"}', "type is None"),
        ('{"type": ["scene"]}', "type is"),
        ('{"type": "shell"}', "must be one of scene"),
        ('{"type": "command"}', "lacks something"),
        ('{"type": "command", "text": "  "}', "a command"),
        ('{"type": "command", "text": 7}', "must be text"),
        ('{"type": "command", "text": "stop", "sudo": true}', "has no 'sudo'"),
        ('{"type": "command", "text": "%s"}' % ("a" * 501), "at most 500"),
        ('{"type": "scene", "plan": "/etc/passwd"}', "plan is '/etc/passwd'"),
        ('{"type": "scene", "plan": "office:huge:1"}', "no distribution"),
        ('{"type": "scene", "plan": "\\ud800"}', "plan is"),
        ('{"type": "scene", "agent": "os:abort"}', "agent is 'os:abort'"),
        ('{"type": "scene", "seed": 1e400}', "seed is inf"),
        ('{"type": "scene", "seed": true}', "seed is True"),
        ('{"type": "scene", "pose": [1, 2]}', "a tuple of 3"),
        ('{"type": "scene", "pose": [0, 0, NaN]}', "pose[2] is nan"),
        ('{"type": "scene", "people": -1}', "people is -1"),
        ('{"type": "scene", "boxes": [[0, 0, 0]]}', "boxes[0]"),
        ('{"type": "scene", "boxes": [[900, 900]]}', "inside the floor plan"),
        ('{"type": "speed", "factor": 0}', "factor is 0"),
        ('{"type": "door", "door": "1", "shut": "yes"}', "shut is 'yes'"),
        ('{"type": "door", "door": "nowhere", "shut": true}', "door is 'nowhere'"),
        ('{"type": "put", "what": "dog", "place": [0, 0]}', "what is 'dog'"),
        ('{"type": "put", "what": "box", "place": [0, NaN]}', "place[1] is nan"),
        ('{"type": "put", "what": "robot", "place": [0, 0], "heading": 9}', "heading is 9"),
        ('{"type": "put", "what": "box", "place": [0, 0]}', "nothing drives"),
        ('{"type": "playback", "action": "step"}', "nothing drives"),
        ('{"type": "answer", "text": "left"}', "nothing was asked"),
        ('{"type": "keep", "what": "film"}', "no film yet"),
        ('{"type": "keep", "what": "episode"}', "no episode yet"),
        ('{"type": "keep", "what": "shadow"}', "what is 'shadow'"),
        ('{"type": "scene", "plan": "own"}', "drop a file"),
        ('{"type": "draw", "tool": "sword"}', "tool is 'sword'"),
        ('{"type": "draw", "tool": "door", "points": [[0, 0]]}', "two places for door"),
        ('{"type": "draw", "tool": "room", "points": [[0, 0], [1, 1]]}', "one place for room"),
        ('{"type": "draw", "tool": "scale", "points": [[0, 0], [1, 1]], "length": 0}', "length"),
        (
            '{"type": "draw", "tool": "door", "points": [[0, 0], [9, 9]], "name": "%s"}'
            % ("x" * 81),
            "at most 80",
        ),
        ('{"type": "draw", "tool": "undo"}', "nothing is left to undo"),
        ('{"type": "draw", "tool": "redo"}', "nothing was undone"),
        ('{"type": "draw", "tool": "erase", "points": [[99, 99]]}', "neither a door nor a region"),
    ],
)
def test_what_is_wrong_with_a_message_is_answered_and_the_session_goes_on(client, message, why):
    with visitor(client) as one:
        one.send(**SCENE)
        one.next("scene")
        one.socket.send_text(message)
        told = one.next("error")["text"]
        assert why in told
        assert "\n" not in told
        assert len(told) <= 500
        assert "should not have happened" not in told
        one.send(**SCENE)
        assert one.next("scene", "error")["type"] == "scene"


@pytest.mark.parametrize(
    "head", [b"", b"\0\1", b"{}", b'{"name": ""}', b'{"name": 7}', b"[" * 9999]
)
def test_a_binary_message_without_the_name_of_a_file_is_answered_with_an_error(client, head):
    with visitor(client) as one:
        one.socket.send_bytes(head + b"\n{}")
        assert "name" in one.next("error")["text"]


def test_a_command_without_a_scene_is_answered_with_an_error(client):
    with visitor(client) as one:
        one.send(**SECOND_DOOR)
        assert "choose a scene first" in one.next("error")["text"]


def test_one_visitor_too_many_is_refused_until_another_leaves(client):
    with in_the_hallway(client) as first:
        with visitor(client), visitor(client) as third:
            assert "all 2 places are taken" in third.next("error", "choices")["text"]
            with pytest.raises(WebSocketDisconnect):
                third.socket.receive_text()
            first.send(**SECOND_DOOR)
            assert first.next("ended")["outcome"] == "done"
        with visitor(client) as another:
            assert another.next("error", "choices")["type"] == "choices"
    assert client.app.state.visits.now == set()


def test_a_command_is_understood_driven_and_judged(client):
    with in_the_hallway(client) as one:
        one.send(**SECOND_DOOR)
        assert one.next("understood")["clauses"] == ["go through the second door on the right"]
        frame = one.next("frame")
        assert len(frame["hits"]) > 2 * 500
        assert frame["verdicts"] == ["active"]
        assert frame["reasons"]
        ended = one.next("ended")
    assert (ended["outcome"], ended["verdicts"]) == ("done", ["done"])


def test_german_is_answered_in_german(client):
    with in_the_hallway(client) as one:
        one.send(type="command", text="fahr durch die zweite Tür rechts")
        assert one.next("understood")["clauses"] == ["fahr durch die zweite Tür rechts"]


def test_an_ambiguous_command_is_asked_about_and_an_answer_settles_it(client):
    with in_the_hallway(client) as one:
        text, question = asked_about()
        one.send(type="command", text=text)
        asked = one.next("asked")
        assert asked["question"] == question.text
        assert asked["choices"] == [choice.name for choice in question.choices]
        one.send(type="answer", text=asked["choices"][1])
        assert one.next("understood")["clauses"][-1] == str(question.readings[1].clauses[-1])


def test_an_answer_that_settles_nothing_is_asked_again(client):
    with in_the_hallway(client) as one:
        text, question = asked_about()
        one.send(type="command", text=text)
        one.next("asked")
        one.send(type="answer", text="blue")
        assert one.next("asked", "refused")["question"] == question.text


def test_a_refusal_says_which_words_are_not_understood(client):
    with in_the_hallway(client) as one:
        one.send(type="command", text="sing the song of the sea", language="en")
        refused = one.next("refused", "asked", "understood")
        assert refused["type"] == "refused"
        start, stop = refused["position"], refused["position"] + refused["length"]
        assert 0 <= start < stop <= len(refused["text"])


def test_half_a_letter_is_no_command(client):
    with in_the_hallway(client) as one:
        one.send(type="command", text="turn \ud800 left")
        assert one.next("refused", "asked", "understood")["text"]


def test_a_command_that_makes_no_sense_here_is_refused_with_the_reason(client):
    with in_the_hallway(client) as one:
        one.send(type="command", text="go through the ninth door on the right")
        assert "door" in one.next("refused", "understood")["why"]


def test_a_call_to_stop_ends_the_run(client):
    with in_the_hallway(client) as one:
        one.send(type="speed", factor=0.5)
        one.send(**SECOND_DOOR)
        one.next("understood")
        one.send(type="command", text="Halt!")
        assert one.next("ended")["outcome"] == "stopped by you"


def test_a_run_is_paused_stepped_and_stopped(client):
    with in_the_hallway(client) as one:
        one.send(type="speed", factor=0.1)
        one.send(**SECOND_DOOR)
        one.next("understood")
        one.send(type="playback", action="step")
        one.send(type="playback", action="step")
        while (seconds := one.next("frame")["seconds"]) < 0.13:  # two steps
            pass
        assert seconds < 0.25
        one.send(type="playback", action="stop")
        assert one.next("ended")["verdicts"] == ["active"]


def test_a_door_that_is_shut_by_hand_stops_the_robot(client):
    with in_the_hallway(client) as one:
        one.send(**SECOND_DOOR)
        one.next("understood")
        one.send(type="door", door="south_2", shut=True)
        ended = one.next("ended", "error")
    assert ended["type"] == "ended"
    assert ended["outcome"] == "failed"


@pytest.mark.parametrize(
    ("what", "part", "numbers"), [("box", "leaves", 16), ("person", "people", 3)]
)
def test_what_is_added_to_a_run_is_in_its_pictures(client, what, part, numbers):
    with in_the_hallway(client) as one:
        one.send(type="speed", factor=0.25)
        one.send(**SECOND_DOOR)
        one.next("understood")
        before = one.next("frame")
        one.send(type="put", what=what, place=[1.0, 0.4])
        one.next("put")
        pictures = [one.next("frame") for _ in range(3)]  # the first may be of the time before
    assert len(pictures[-1][part]) == len(before[part]) + numbers
    assert pictures[-1]["seconds"] > before["seconds"]


def test_a_robot_is_carried_and_its_run_goes_on(client):
    place = [0.0, 0.0]
    with in_the_hallway(client) as one:
        one.send(type="speed", factor=0.25)
        one.send(**SECOND_DOOR)
        one.next("understood")
        before = one.next("frame")
        one.send(type="put", what="robot", place=place, heading=0.24)
        one.next("put")
        pictures = [one.next("frame") for _ in range(3)]  # the first may be of the time before
        one.send(type="speed", factor=16)
        ended = one.next("ended")
    assert math.dist(pictures[-1]["pose"][:2], place) < 0.2
    assert before["seconds"] < pictures[-1]["seconds"] < ended["seconds"]
    assert ended["outcome"] == "done"


def test_what_cannot_be_added_is_told_and_the_run_goes_on(client):
    with in_the_hallway(client) as one:
        one.send(type="speed", factor=0.25)
        one.send(**SECOND_DOOR)
        one.next("understood")
        refusals = (
            ("box", "inside the floor plan"),
            ("person", "a free place"),
            ("robot", "outside"),
        )
        for what, why in refusals:
            one.send(type="put", what=what, place=[99.0, 0.0])
            assert why in one.next("error")["text"]
        one.send(type="speed", factor=16)
        assert one.next("ended")["outcome"] == "done"


def test_a_box_is_part_of_the_scene(client):
    with visitor(client) as one:
        one.send(**SCENE, boxes=[[0.0, 0.3]])
        scene = one.next("scene")
    boxes = [s for s in scene["plan"]["surfaces"] if s["material"] == "furniture"]
    assert [0.25, 0.55] in boxes[-1]["points"]
    assert scene["scene"]["boxes"] == [[0.0, 0.3]]


def test_the_film_of_a_run_is_a_gif(client):
    pytest.importorskip("pygame")
    with in_the_hallway(client) as one:
        one.send(**SECOND_DOOR)
        one.next("ended")
        one.send(type="keep", what="film")
        name, content = one.next_file()
    assert name == "semnav.gif"
    assert content.startswith(b"GIF89a")


def test_the_same_scene_and_command_give_the_same_run(client):
    ends = []
    for _ in range(2):
        with visitor(client) as one:
            one.send(type="scene", plan="office_cross", robot="spot", people=3, seed=5)
            one.send(type="command", text=one.next("scene")["suggestion"])
            one.send(type="speed", factor=16)
            ends.append(one.next("ended"))
    assert ends[0] == ends[1]


def test_a_slow_visitor_misses_pictures_and_costs_no_memory():
    async def taken():
        outbox = Outbox(asyncio.get_running_loop())
        for number in range(1000):
            outbox.put_picture(str(number))
        outbox.put_news("news")
        return [await outbox.next(), await outbox.next()], outbox.dropped

    assert asyncio.run(taken()) == (["news", "999"], 999)


def test_a_visitor_who_takes_nothing_is_given_up():
    async def full():
        outbox = Outbox(asyncio.get_running_loop())
        for _ in range(MAX_NEWS):
            outbox.put_news("news")
        with pytest.raises(ClientTooSlowError):
            outbox.put_news("one too many")

    asyncio.run(full())


def test_a_request_that_lacks_nothing_is_what_it_says():
    assert read_request('{"type": "scene"}') == SceneRequest()


def test_without_its_extra_the_command_says_what_to_install(capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "uvicorn", None)
    code, _, said = run(capsys, "serve")
    assert code == 2
    assert 'pip install "semnav-env[serve]"' in said
    assert said.count("\n") == 1


def test_ctrl_c_ends_the_server_although_a_robot_drives():
    command = [sys.executable, "-m", "semnav", "serve", "--port", "0"]
    with subprocess.Popen(command, cwd=ROOT, stdout=PIPE, stderr=PIPE, text=True) as server:
        ready = next(line for line in server.stdout if line.startswith("open "))
        connect = pytest.importorskip("websockets.sync.client").connect
        with connect(re.search(r"http(\S+)", ready)[1].join(("ws", "/session"))) as socket:
            socket.send(json.dumps(SCENE))
            socket.send(json.dumps(SECOND_DOOR))
            while json.loads(socket.recv())["type"] != "understood":
                pass
            server.send_signal(signal.SIGINT)
            assert server.wait(timeout=30) == 130
        assert server.stderr.read().splitlines()[-1:] == ["semnav: interrupted"]


@pytest.mark.parametrize("words", [("--host", "0.0.0.0"), ("--port", -1), ("--sessions", 0)])
def test_options_that_cannot_be_are_refused_in_one_line(capsys, words):
    code, _, said = run(capsys, "serve", *words)
    assert (code, said.count("\n")) == (2, 1)
    assert f"{words[0]} is" in said


def test_a_port_that_is_taken_is_said_before_anything_is_compiled(capsys):
    from semnav_scripts.page.listening import listening

    with listening("127.0.0.1", 0) as taken:
        code, _, said = run(capsys, "serve", "--port", taken.getsockname()[1])
    assert code == 2
    assert "try --port 0" in said
