"""Calling and listening: what microphones hear, and where a speaker is believed to be."""

from __future__ import annotations

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_env.env import SemNavEnv
from semnav_env.judge.payload import Payload
from semnav_env.rescue.call_and_listen import CallAndListen
from semnav_env.rescue.microphones import USUAL_MICROPHONES, MicrophoneArray
from semnav_env.rescue.voice_fix import HeardVoice, PersonVoice, fix
from semnav_env.rescue.voices_entry import VoicesEntry, read_voices
from semnav_env.world.maps import FloorPlan, Material, Surface, load_floor_plan
from semnav_features.frames import Point, Pose, to_local

VILLA = load_floor_plan("villa_hall")
EARS = replace(USUAL_MICROPHONES, answers=1.0)
HERE: Pose = (1.2, 2.4, 0.5)
EXACT = 1e-9

places = st.tuples(st.floats(-10.0, 10.0), st.floats(-10.0, 10.0))
headings = st.floats(-math.pi, math.pi)


def with_person(x: float, y: float) -> FloorPlan:
    """The villa with somebody on the floor."""
    corners = ((x - 0.2, y - 0.2), (x + 0.2, y - 0.2), (x + 0.2, y + 0.2), (x - 0.2, y + 0.2))
    body = Surface((*corners, corners[0]), Material.PERSON)
    return replace(VILLA, surfaces=(*VILLA.surfaces, body))


def voice_of(person: Point, pose: Pose, std: float = 0.05, error: float = 0.0) -> HeardVoice:
    x, y = to_local(pose, person)
    return HeardVoice(pose, math.atan2(y, x) + error, std)


@given(places, st.lists(st.tuples(places, headings), min_size=2, max_size=5))
@settings(max_examples=50)
def test_exact_directions_meet_at_the_speaker(
    person: Point, heard: list[tuple[Point, float]]
) -> None:
    poses = [(*place, heading) for place, heading in heard]
    found = fix([voice_of(person, pose) for pose in poses if math.dist(pose[:2], person) > 0.5])
    if found is not None:
        assert found.place == pytest.approx(person, abs=1e-4)


def test_the_covariance_is_that_of_the_errors() -> None:
    """The mean of the normalised squared errors is their number of dimensions."""
    rng, person, std = np.random.default_rng(0), (3.0, 4.0), 0.03
    poses = [(0.0, 0.0, 0.3), (5.0, 0.0, -1.0), (0.0, 6.0, 2.0)]
    squares = []
    for _ in range(500):
        errors = std * rng.standard_normal(3)
        found = fix([voice_of(person, p, std, e) for p, e in zip(poses, errors, strict=True)])
        assert found is not None
        off = np.subtract(found.place, person)
        squares.append(off @ np.linalg.solve(found.covariance, off))
    assert np.mean(squares) == pytest.approx(2.0, abs=0.25)


def test_one_direction_or_parallel_ones_tell_no_place() -> None:
    assert fix([]) is None
    assert fix([voice_of((3.0, 0.0), (0.0, 0.0, 0.0))]) is None
    assert fix([voice_of((9.0, 0.0), (x, 0.01 * x, 0.0)) for x in (0.0, 1.0)]) is None


def test_directions_that_meet_behind_a_robot_tell_no_place() -> None:
    poses = (0.0, 0.0, 0.0), (4.0, 0.0, 0.0)
    turned = [HeardVoice(pose, b, 0.05) for pose, b in zip(poses, (2.0, 1.0), strict=True)]
    assert fix(turned) is None


def test_an_array_hears_the_direction_of_a_person_in_the_room() -> None:
    array = MicrophoneArray(with_person(1.0, 1.0), replace(EARS, bearing_std=EXACT), _rng())
    [answer] = array.call(HERE)
    assert answer.bearing == pytest.approx(voice_of((1.0, 1.0), HERE).bearing, abs=1e-6)


def test_distance_and_walls_make_a_direction_worse_and_then_inaudible() -> None:
    near, far = (EARS.std(distance, 0) for distance in (2.0, 8.0))
    assert near == EARS.bearing_std < far < EARS.std(8.0, 1)
    [behind_a_wall] = MicrophoneArray(with_person(5.0, 4.0), EARS, _rng()).call(HERE)
    [before_it] = MicrophoneArray(with_person(1.0, 1.0), EARS, _rng()).call(HERE)
    assert behind_a_wall.std > EARS.std_per_wall > before_it.std
    assert MicrophoneArray(with_person(-8.0, 4.4), EARS, _rng()).call(HERE) == []


def test_of_many_answers_those_that_were_heard_last_are_observed() -> None:
    """Whoever answered first is not preferred, nor left out as a speaker."""
    heard = [PersonVoice(k % 2, HeardVoice((0.1 * k, 0.0, 0.0), 0.3, 0.05)) for k in range(40)]
    payload = SimpleNamespace(voices=heard)
    belief = SimpleNamespace(pose=(0.0, 0.0, 0.0))
    row = VoicesEntry().observe(SimpleNamespace(payload=payload, belief=belief))  # type: ignore[arg-type]
    read = read_voices({"voices": row}, (0.0, 0.0, 0.0))
    assert [each.person for each in read] == [k % 2 for k in range(24, 40)]
    assert [each.voice.pose[0] for each in read] == pytest.approx([0.1 * k for k in range(24, 40)])


def test_who_cannot_answer_never_does() -> None:
    array = MicrophoneArray(with_person(1.0, 1.0), replace(EARS, answers=0.0), _rng())
    assert not any(array.call(HERE) for _ in range(20))


def test_a_robot_calls_once_where_it_stands_still() -> None:
    payload = CallAndListen(EARS)
    assert isinstance(payload, Payload)
    env = SemNavEnv("spot", with_person(1.0, 1.0), payload=payload)
    env.reset(seed=0, options={"command": "stop", "pose": HERE})
    for _ in range(8 * 15):
        payload.update(env.simulator.motion, env.tracker)
    assert (payload.calls, [each.person for each in payload.voices]) == (1, [0])
    assert payload.fixes == {}
    assert payload.final_info()["voices"]["heard"] == 1
    assert "heard: 1" in payload.marks().status


def _rng() -> np.random.Generator:
    return np.random.default_rng(0)
