"""Recordings for the viewer of Rerun (`rerun FILE`), written with its own package.

Everything lies in the plane z = 0: the 2D views of Rerun look down with y to the bottom.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from semnav_features.frames import Pose
from semnav_features.writing import replacing
from semnav_scripts.recording.moment import RecordedMoment, Segment

INSTALL = 'recordings for Rerun need its package: pip install "semnav-env[rerun]"'
"""Said where the extra is missing."""

ARROW_LENGTH = 0.6
"""Length of the arrows of robot and goal, metres."""

POINT_RADIUS, LINE_RADIUS = 0.02, 0.03
"""Half the width of what is drawn, metres."""

COLOURS = {
    "scan": (214, 69, 48),
    "robot": (66, 118, 196),
    "walls": (224, 138, 30),
    "doors": (20, 128, 78),
    "goal": (200, 24, 104),
}
"""Red, green and blue of what is drawn, by its entity."""


class RerunWriter:
    """Writes moments to a recording; see `rerun_writer`."""

    def __init__(self, rerun: Any, recording: Any) -> None:
        self._rerun, self._recording = rerun, recording
        self._way: list[tuple[float, float, float]] = []

    def write(self, moment: RecordedMoment) -> None:
        """Add a moment."""
        self._recording.set_time("stamp", duration=moment.seconds)
        self._way.append((*moment.robot[:2], 0.0))
        hits = np.pad(moment.hits, ((0, 0), (0, 1)))
        points = self._rerun.Points3D(hits, colors=COLOURS["scan"], radii=POINT_RADIUS)
        self._recording.log("world/scan", points)
        self._lines("world/walls", COLOURS["walls"], moment.walls)
        self._lines("world/doors", COLOURS["doors"], moment.doors)
        door = () if moment.goal_door is None else (moment.goal_door,)
        self._lines("world/goal/door", COLOURS["goal"], door)
        self._arrow("world/goal", COLOURS["goal"], moment.goal)
        self._arrow("world/robot", COLOURS["robot"], moment.robot)
        way = self._rerun.LineStrips3D([self._way], colors=COLOURS["robot"])
        self._recording.log("world/way", way)
        text = self._rerun.TextDocument("\n\n".join(moment.said))
        self._recording.log("said", text)

    def _lines(self, entity: str, colour: tuple[int, ...], segments: tuple[Segment, ...]) -> None:
        strips = [[(*end, 0.0) for end in segment] for segment in segments]
        lines = self._rerun.LineStrips3D(strips, colors=colour, radii=LINE_RADIUS)
        self._recording.log(entity, lines)

    def _arrow(self, entity: str, colour: tuple[int, ...], pose: Pose) -> None:
        x, y, heading = pose
        vector = ARROW_LENGTH * math.cos(heading), ARROW_LENGTH * math.sin(heading), 0.0
        arrow = self._rerun.Arrows3D(origins=[(x, y, 0.0)], vectors=[vector], colors=colour)
        self._recording.log(entity, arrow)


@contextmanager
def rerun_writer(path: Path) -> Iterator[RerunWriter]:
    """A writer of a recording, which replaces an older file only when it is complete.

    Args:
        path: of the file (.rrd).

    Raises:
        ValueError: the package is not installed.
    """
    try:
        import rerun
    except ImportError:
        raise ValueError(INSTALL) from None
    with replacing(path) as part:
        recording = rerun.RecordingStream("semnav follow", recording_id=path.stem)
        recording.save(part)
        recording.log("world", rerun.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
        yield RerunWriter(rerun, recording)
        recording.flush()
        recording.disconnect()
