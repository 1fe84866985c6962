"""The picture speaks the language in which the robot was told its command."""

from __future__ import annotations

import pytest

from semnav_env.env import SemNavEnv
from semnav_env.judge import Verdict
from semnav_env.rendering.frame import Frame
from semnav_env.rendering.legend import _ENTRIES, _OPTIONAL_ENTRIES
from semnav_env.rendering.picture_words import GERMAN, label, spoken_language
from semnav_env.rendering.snapshot import snapshot

POSE = (-2.5, -0.6, 0.25)
ENGLISH, SAID = "go through the second door on the right", "fahr durch die zweite Tür rechts"


def shown(**told: str) -> Frame:
    env = SemNavEnv()
    env.reset(seed=0, options={**told, "pose": POSE})
    return snapshot(env, [POSE[:2]])


@pytest.mark.parametrize(
    "told",
    [
        {"command": "geh durch die zweite Tür rechts"},
        {"command": "geh durch die zweite Tür rechts", "language": "german"},
    ],
)
def test_a_german_command_is_shown_in_german(told: dict[str, str]) -> None:
    frame = shown(**told)
    assert (frame.command, frame.language) == ((SAID,), "de")
    assert frame.status == ("t = 0,0 s   läuft", "Kollisionen: 0")


def test_an_english_command_is_shown_in_english() -> None:
    frame = shown(command=ENGLISH)
    assert (frame.command, frame.language) == ((ENGLISH,), "en")
    assert frame.status == ("t = 0.0 s   active", "collisions: 0")


def test_every_label_and_verdict_has_german_words() -> None:
    labels = {name for name, _ in (*_ENTRIES, *_OPTIONAL_ENTRIES)}
    assert labels | set(Verdict) <= GERMAN.keys()


def test_a_language_without_labels_has_the_english_ones() -> None:
    assert label("wall", "fr") == "wall"
    assert label(Verdict.WRONG_DOOR, "en") == "wrong door"


def test_what_tells_no_language_is_shown_in_english() -> None:
    assert spoken_language("").code == "en"
    assert spoken_language("\u2603 \u2603").code == "en"
