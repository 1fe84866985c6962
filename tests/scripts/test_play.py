"""`semnav play`: a robot driven by keyboard and gamepad, without a screen."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from semnav_env.approach import DoorSide
from semnav_env.env import SemNavEnv
from semnav_env.judge.episodes import load_episodes
from semnav_env.rendering.window import Window
from semnav_env.world.maps import load_floor_plan
from semnav_scripts.main import main
from semnav_scripts.playing.controls import MAX_TYPED, Controls
from semnav_scripts.playing.game import HELP, Game
from semnav_scripts.playing.played_drive import PlayedDrive

pygame = pytest.importorskip("pygame", reason="the extra `play` is not installed")

COMMAND = "go through the second door on the right"
START = "-2.5,-0.6,0.25"
Events = list[Any]


@pytest.fixture(autouse=True)
def _no_screen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")


def key(name: str, down: bool = True, unicode: str = "") -> Any:
    """The event of a key, by its name in pygame without "K_"."""
    kind = pygame.KEYDOWN if down else pygame.KEYUP
    return pygame.event.Event(kind, key=getattr(pygame, f"K_{name}"), unicode=unicode)


def typed(text: str) -> Events:
    letters = (key("SPACE" if c == " " else c, unicode=c) for c in text)
    return [key("RETURN"), *letters, key("RETURN")]


def acted(monkeypatch: pytest.MonkeyPatch, script: dict[int, Events]) -> None:
    """Let a person do these things, by the number of the picture, as fast as can be drawn."""
    pictures: Iterator[int] = iter(range(1_000_000))
    monkeypatch.setattr(Window, "events", lambda _: script.get(next(pictures), []))
    monkeypatch.setattr(Window, "present", lambda *_: True)


def controls_after(*events: Any) -> Controls:
    controls = Controls()
    for event in events:
        controls.take(event)
    return controls


@pytest.mark.parametrize(
    ("names", "action"),
    [
        (["w"], (0.5, 0.0, 0.0)),
        (["UP"], (0.5, 0.0, 0.0)),
        (["s", "a"], (-0.5, 0.0, 0.4)),
        (["RIGHT"], (0.0, 0.0, -0.4)),
        (["q"], (0.0, 0.5, 0.0)),
        (["w", "LSHIFT"], (1.0, 0.0, 0.0)),
        (["w", "s"], (0.0, 0.0, 0.0)),
    ],
)
def test_held_keys_are_an_action(names: list[str], action: tuple[float, ...]) -> None:
    controls = controls_after(*map(key, names))
    np.testing.assert_allclose(controls.action(3), action, atol=1e-6)
    np.testing.assert_allclose(controls.action(2), (action[0], action[2]), atol=1e-6)
    for name in names:
        controls.take(key(name, down=False))
    assert not controls.action(3).any()


def test_a_stick_is_an_action_and_its_rest_is_none() -> None:
    def axis(number: int, value: float) -> Any:
        return pygame.event.Event(pygame.JOYAXISMOTION, axis=number, value=value)

    controls = controls_after(axis(1, -0.8), axis(0, 0.5), axis(7, 1.0))
    np.testing.assert_allclose(controls.action(2), (0.8, -0.5), atol=1e-6)
    controls.take(axis(1, 0.05))
    np.testing.assert_allclose(controls.action(2), (0.0, -0.5), atol=1e-6)


def test_letters_are_typed_while_the_arrows_drive() -> None:
    controls = controls_after(key("RETURN"), key("w", unicode="w"), key("UP"))
    assert controls.typed == "w"
    assert controls.action(2)[0] == 0.5
    controls.take(key("BACKSPACE"))
    assert controls.typed == ""


def test_keys_that_were_held_when_the_window_lost_the_focus_are_let_go() -> None:
    controls = controls_after(key("w"), pygame.event.Event(pygame.WINDOWFOCUSLOST))
    assert not controls.action(2).any()


def test_what_is_typed_has_an_end() -> None:
    letters = [key("w", unicode="w")] * (MAX_TYPED + 5)
    assert controls_after(key("RETURN"), *letters).typed == "w" * MAX_TYPED


def game() -> tuple[Game, PlayedDrive]:
    env = SemNavEnv(observation="all")
    drive = PlayedDrive(env, "heidelberg_hallway", 0, assist=False)
    drive.begin(None, (-2.5, -0.6, 0.25))
    return Game(drive), drive


def test_nothing_moves_before_the_first_key(monkeypatch: pytest.MonkeyPatch) -> None:
    acted(monkeypatch, {10: [key("w")], 15: [key("ESCAPE")]})
    played, drive = game()
    played.play(60.0)
    assert drive.env.simulator.steps == 5
    assert drive.env.world.pose[0] > -2.5


def test_a_command_typed_while_driving_begins_where_the_robot_is(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    acted(monkeypatch, {0: [key("UP")], 12: typed(COMMAND), 20: [key("ESCAPE")]})
    played, drive = game()
    played.play(60.0)
    drive.finish()
    first, second = drive.runs
    assert second.episode.command == COMMAND
    np.testing.assert_allclose(second.episode.start, first.recording.poses[-1], atol=1e-6)
    assert (first.recording.steps, second.recording.steps) == (12, 8)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("dance the tango", "dance"),
        ("go through the ninth door on the right", "door"),
        ("take the first or the second door on the right", "?"),
    ],
)
def test_what_cannot_be_done_is_answered_and_the_drive_goes_on(
    monkeypatch: pytest.MonkeyPatch, text: str, said: str
) -> None:
    acted(monkeypatch, {0: [key("UP")], 5: typed(text), 10: [key("ESCAPE")]})
    played, drive = game()
    told: list[str] = []
    framed = PlayedDrive.frame
    monkeypatch.setattr(
        PlayedDrive, "frame", lambda self, prompt: told.append(prompt) or framed(self, prompt)
    )
    played.play(60.0)
    assert told[0] == HELP
    assert said in told[-1]
    assert drive.env.simulator.steps == 10


def test_an_answer_settles_a_question(monkeypatch: pytest.MonkeyPatch) -> None:
    doubtful = typed("take the first or the second door on the right")
    acted(monkeypatch, {0: doubtful, 1: typed("the second"), 2: [key("ESCAPE")]})
    played, drive = game()
    played.play(60.0)
    assert str(drive.env.judge.mission.command) == COMMAND


def test_tab_switches_the_assistance(monkeypatch: pytest.MonkeyPatch) -> None:
    acted(monkeypatch, {0: [key("UP"), key("TAB")], 3: [key("ESCAPE")]})
    played, drive = game()
    played.play(60.0)
    assert drive.agent.active
    assert "assistance: on" in drive.frame("").status


def test_a_wall_is_not_hit_with_assistance(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["play", COMMAND, "--pose", START, "--seconds", "8", "--json"]
    collisions = []
    for more in ([], ["--assist"]):
        acted(monkeypatch, {0: [key("UP"), key("RIGHT")]})
        assert main([*words, *more]) == 1
        (run,) = json.loads(capsys.readouterr().out)["runs"]
        collisions.append(run["collisions"])
    assert collisions[0] > 0 == collisions[1]


def test_a_kept_run_is_an_episode_that_habits_reads(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A drive straight out of the hallway through its south door."""
    acted(monkeypatch, {0: [key("UP")]})
    door = next(
        each for each in load_floor_plan("heidelberg_hallway").doors if each.name == "south_1"
    )
    side = DoorSide(door.start, door.end)
    x, y = side.before(np.array(((1.2, 0.0),)))[0].tolist()
    pose = f"{x},{y},{side.through}"
    words = ["play", "stop", "--pose", pose, "--seconds", "5", "--assist"]
    main([*words, "--out", str(tmp_path)])
    played = tmp_path / "played.jsonl"
    assert f"wrote {played}" in capsys.readouterr().out
    (episode,) = load_episodes(played)
    assert (episode.command, episode.floor_plan) == ("stop", "heidelberg_hallway")
    assert main(["habits", str(played), "--json"]) == 0
    (passage,) = json.loads(capsys.readouterr().out)["played.jsonl"]["passages"]
    assert passage["door"] == "south_1"
    assert 0.3 < passage["speed"] < 0.9
    assert main([*words, "--out", str(tmp_path)]) == 2
    assert "has runs already" in capsys.readouterr().err


def test_an_episode_without_its_recording_is_named(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    acted(monkeypatch, {})
    main(["play", "stop", "--pose", START, "--seconds", "0.2", "--out", str(tmp_path)])
    (tmp_path / "played-00000.npz").unlink()
    capsys.readouterr()
    assert main(["habits", str(tmp_path / "played.jsonl")]) == 2
    assert "episode played-00000 has no" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--seed", "-1"], "seed is -1"),
        (["--seconds", "0"], "--seconds is 0; it must be positive"),
        (["--map", "nowhere"], "nowhere"),
        (["--pose", "1,2"], "is not x,y,heading"),
        (["go", "--pose", START], "go"),
    ],
)
def test_bad_input_gets_one_line(
    words: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["play", *words]) == 2
    (line,) = capsys.readouterr().err.strip().splitlines()
    assert said in line


def test_no_screen_is_named(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("SDL_VIDEODRIVER", "no_such_driver")
    pygame.display.quit()
    assert main(["play", "stop", "--pose", START]) == 2
    assert "needs a display" in capsys.readouterr().err


@pytest.mark.parametrize("words", [["demo", "go forward", "--show"], ["view", "test_real-00000"]])
def test_what_opens_a_window_says_in_one_line_that_it_needs_a_display(
    words: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("SDL_VIDEODRIVER", "no_such_driver")
    pygame.display.quit()
    assert main(words) == 2
    [line] = capsys.readouterr().err.strip().splitlines()
    assert "a window needs a display" in line
    assert "FILE writes a film without one" in line
