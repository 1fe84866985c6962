"""The place of a speaker from directions of the voice, heard from several places."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from semnav_features.frames import FloatArray, Point, Pose

STEPS = 10
"""Largest number of Gauss-Newton steps."""

LEAST_CROSSING = math.radians(10.0)
"""Least angle at which two of the directions must cross, radians: flatter ones meet anywhere."""


class HeardVoice(NamedTuple):
    """A direction of a voice.

    Attributes:
        pose: where it was heard: the believed pose of the robot, odometry frame.
        bearing: robot frame, radians.
        std: its standard deviation, radians.
    """

    pose: Pose
    bearing: float
    std: float

    @property
    def direction(self) -> float:
        """In the frame of the pose's parent, radians."""
        return self.pose[2] + self.bearing


class PersonVoice(NamedTuple):
    """A direction of a voice, with the number of the speaker."""

    person: int
    voice: HeardVoice


class VoiceFix(NamedTuple):
    """A place of a speaker: metres, the frame of the poses, and its covariance, m^2, (2, 2)."""

    place: Point
    covariance: FloatArray


def by_speaker(voices: Sequence[PersonVoice]) -> dict[int, list[HeardVoice]]:
    """The directions of each voice, in their order, by number of the speaker."""
    each: dict[int, list[HeardVoice]] = {}
    for person, voice in voices:
        each.setdefault(person, []).append(voice)
    return each


def fix(voices: Sequence[HeardVoice]) -> VoiceFix | None:
    """The place that agrees best with directions of one voice.

    Least squares over the errors of the directions, each divided by its standard deviation, by
    Gauss-Newton from the point that is nearest to all lines (bearings-only localisation).

    Returns:
        None if no two of them cross at `LEAST_CROSSING` or more, or if they meet behind a robot.
    """
    angles = np.array([voice.direction for voice in voices])
    eyes = np.array([voice.pose[:2] for voice in voices]).reshape(-1, 2)
    stds = np.array([voice.std for voice in voices])
    if not _cross(angles):
        return None
    across = np.column_stack((-np.sin(angles), np.cos(angles)))
    place = np.linalg.lstsq(across, (across * eyes).sum(axis=1), rcond=None)[0]
    for _ in range(STEPS):
        slopes, errors = _linearised(place, eyes, angles, stds)
        step = np.linalg.lstsq(slopes, errors, rcond=None)[0]
        place = place + step
        if math.hypot(*step) < 1e-6:
            break
    away = place - eyes
    ahead = away[:, 0] * np.cos(angles) + away[:, 1] * np.sin(angles)
    if (ahead <= 0.0).any() or not _cross(np.arctan2(away[:, 1], away[:, 0])):
        return None  # lines that meet behind may send the place to where all directions are alike
    slopes, _ = _linearised(place, eyes, angles, stds)
    covariance = np.asarray(np.linalg.inv(slopes.T @ slopes), dtype=np.float64)
    return VoiceFix((float(place[0]), float(place[1])), covariance)


def _cross(angles: FloatArray) -> bool:
    """Whether two of some directions cross at `LEAST_CROSSING` or more."""
    crossing = np.abs(np.sin(angles[:, None] - angles))
    return bool(np.any(crossing >= math.sin(LEAST_CROSSING)))


def _linearised(
    place: FloatArray, eyes: FloatArray, angles: FloatArray, stds: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Slopes of the directions to a place, shape (n, 2), and their errors, both over the stds."""
    x, y = (place - eyes).T
    square = np.maximum(x * x + y * y, 1e-6)
    slopes = np.column_stack((-y, x)) / square[:, None]
    errors = np.angle(np.exp(1j * (angles - np.arctan2(y, x))))
    return slopes / stds[:, None], errors / stds
