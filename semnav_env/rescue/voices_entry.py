"""The entry "voices" of the observation: from where the robot has heard whom."""

from __future__ import annotations

import math
from typing import Any

import gymnasium as gym
import numpy as np
from numpy.typing import NDArray

from semnav_env.mind.observations import Moment
from semnav_env.rescue.people_entry import FARTHEST
from semnav_env.rescue.voice_fix import HeardVoice, PersonVoice
from semnav_env.robots import RobotSpec
from semnav_features.frames import Pose, compose, relative
from semnav_features.lidar_spec import LidarSpec

MOST_VOICES = 16
"""Rows of the entry; of more answers the earliest are left out."""

COLUMNS = ("is_there", "person", "x", "y", "cosine", "sine", "std")
"""Columns of a row: whether it counts, number of the speaker, where the answer was heard and its
direction (robot frame, metres), and the standard deviation of the direction, radians."""


class VoicesEntry:
    """The answers that the robot has heard, a row for each, flat; none without microphones.

    Attributes:
        name: its key in the observation.
    """

    name = "voices"

    def space(self, robot: RobotSpec, lidar: LidarSpec) -> gym.spaces.Box:
        """Rows of `COLUMNS`, flat; float32."""
        most = [1.0, FARTHEST, FARTHEST, FARTHEST, 1.0, 1.0, math.pi]
        least = [0.0, 0.0, -FARTHEST, -FARTHEST, -1.0, -1.0, 0.0]
        high, low = (np.tile(row, MOST_VOICES).astype(np.float32) for row in (most, least))
        return gym.spaces.Box(low, high)

    def observe(self, moment: Moment) -> NDArray[np.float32]:
        """Make new rows."""
        rows = np.zeros((MOST_VOICES, len(COLUMNS)), np.float32)
        heard: list[PersonVoice] = getattr(moment.payload, "voices", [])
        for row, (person, voice) in zip(rows, heard[-MOST_VOICES:], strict=False):
            x, y, turn = relative(moment.belief.pose, voice.pose)
            x, y = np.clip((x, y), -FARTHEST, FARTHEST).tolist()
            angle = turn + voice.bearing
            row[:] = 1.0, person, x, y, math.cos(angle), math.sin(angle), min(voice.std, math.pi)
        return rows.ravel()


def read_voices(observation: dict[str, NDArray[Any]], pose: Pose) -> list[PersonVoice]:
    """The voices of an observation.

    Args:
        observation: with the entry "voices".
        pose: believed pose of the robot, in the frame in which the voices are wanted.
    """
    rows = observation["voices"].reshape(-1, len(COLUMNS)).astype(np.float64)
    return [
        PersonVoice(int(person), HeardVoice(compose(pose, (x, y, math.atan2(s, c))), 0.0, std))
        for there, person, x, y, c, s, std in rows.tolist()
        if there > 0.5
    ]
