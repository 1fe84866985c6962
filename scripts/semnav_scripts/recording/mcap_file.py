"""Recordings for Foxglove: MCAP files with its own schemas in JSON, written with MCAP's package."""

from __future__ import annotations

import base64
import json
import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from semnav_features.frames import FloatArray, Pose
from semnav_features.writing import replacing
from semnav_scripts.recording.moment import RecordedMoment, Segment

INSTALL = 'recordings for Foxglove need MCAP: pip install "semnav-env[mcap]"'
"""Said where the extra is missing."""

FRAME = "odom"
"""Name of the frame in which everything is drawn."""

TOPICS = {
    "/tf": "foxglove.FrameTransform",
    "/scene": "foxglove.SceneUpdate",
    "/scan": "foxglove.PointCloud",
    "/goal": "foxglove.PoseInFrame",
    "/said": "foxglove.Log",
}
"""Schemas of Foxglove by topic. It knows them by name, so their text in the file may be short."""

LINE_WIDTH = 0.06
"""Width of lines, metres."""

WALL, DOOR, GOAL = (0.88, 0.54, 0.12), (0.08, 0.5, 0.31), (0.78, 0.09, 0.41)
"""Red, green and blue of what is drawn, from 0 to 1."""

LINE_LIST = 2
"""The type of `foxglove.LinePrimitive` that joins points in pairs."""

FLOAT32 = 7
"""The type of a `foxglove.PackedElementField` of four bytes."""

INFO = 2
"""The level of `foxglove.Log` of usual news."""


class McapWriter:
    """Writes moments to an MCAP file; see `mcap_writer`."""

    def __init__(self, writer: Any) -> None:
        self._writer, self._last = writer, ""
        schemas = {
            name: writer.register_schema(name, "jsonschema", json.dumps(_schema(name)).encode())
            for name in dict.fromkeys(TOPICS.values())
        }
        self._channels = {
            topic: writer.register_channel(topic, "json", schemas[name])
            for topic, name in TOPICS.items()
        }

    def write(self, moment: RecordedMoment) -> None:
        """Add a moment; what is said only when it changes."""
        stamp = round(moment.seconds * 1e9)
        when = {"sec": stamp // 10**9, "nsec": stamp % 10**9}
        self._put("/tf", stamp, {
            "timestamp": when,
            "parent_frame_id": FRAME,
            "child_frame_id": "base_link",
            "translation": _place(moment.robot[:2]),
            "rotation": _turn(moment.robot),
        })  # fmt: skip
        door = () if moment.goal_door is None else (moment.goal_door,)
        lines = [_lines(moment.walls, WALL), _lines(moment.doors, DOOR), _lines(door, GOAL)]
        self._put("/scene", stamp, _update("memory", when, lines))
        self._put("/scan", stamp, {"timestamp": when, "frame_id": FRAME, **_cloud(moment.hits)})
        goal = {"position": _place(moment.goal[:2]), "orientation": _turn(moment.goal)}
        self._put("/goal", stamp, {"timestamp": when, "frame_id": FRAME, "pose": goal})
        said = "; ".join(moment.said)
        if said != self._last:
            news = {"level": INFO, "message": said, "name": "semnav", "file": "", "line": 0}
            self._put("/said", stamp, {"timestamp": when, **news})
            self._last = said

    def _put(self, topic: str, stamp: int, message: dict[str, Any]) -> None:
        content = json.dumps(message, separators=(",", ":")).encode()
        self._writer.add_message(self._channels[topic], stamp, content, stamp)


@contextmanager
def mcap_writer(path: Path) -> Iterator[McapWriter]:
    """A writer of a recording, which replaces an older file only when it is complete.

    Args:
        path: of the file (.mcap).

    Raises:
        ValueError: the package is not installed.
    """
    try:
        from mcap.writer import Writer
    except ImportError:
        raise ValueError(INSTALL) from None
    with replacing(path) as part, open(part, "wb") as file:
        writer = Writer(file)
        writer.start(profile="", library="semnav-env")
        yield McapWriter(writer)
        writer.finish()  # type: ignore[no-untyped-call]


def _schema(name: str) -> dict[str, Any]:
    return {"title": name, "type": "object"}


def _update(name: str, when: dict[str, int], lines: list[dict[str, Any]]) -> dict[str, Any]:
    """A `foxglove.SceneUpdate` with one entity of lines, which replaces that of the same name."""
    entity = {
        "timestamp": when,
        "frame_id": FRAME,
        "id": name,
        "lifetime": {"sec": 0, "nsec": 0},
        "frame_locked": False,
        "lines": lines,
    }
    return {"deletions": [], "entities": [entity]}


def _cloud(points: FloatArray) -> dict[str, Any]:
    """The points of a `foxglove.PointCloud`, x, y and z."""
    packed = np.zeros((len(points), 3), "<f4")
    packed[:, :2] = points
    fields = [{"name": axis, "offset": 4 * k, "type": FLOAT32} for k, axis in enumerate("xyz")]
    data = base64.b64encode(packed.tobytes()).decode()
    return {"pose": _pose_at(0.0, 0.0), "point_stride": 12, "fields": fields, "data": data}


def _lines(segments: tuple[Segment, ...], colour: tuple[float, ...]) -> dict[str, Any]:
    """A `foxglove.LinePrimitive`."""
    return {
        "type": LINE_LIST,
        "pose": _pose_at(0.0, 0.0),
        "thickness": LINE_WIDTH,
        "scale_invariant": False,
        "points": [_place(end) for segment in segments for end in segment],
        "color": _rgba(colour),
        "colors": [],
        "indices": [],
    }


def _pose_at(x: float, y: float) -> dict[str, Any]:
    return {"position": _place((x, y)), "orientation": _turn((x, y, 0.0))}


def _place(point: tuple[float, float]) -> dict[str, float]:
    return {"x": round(point[0], 4), "y": round(point[1], 4), "z": 0.0}


def _turn(pose: Pose) -> dict[str, float]:
    """The heading of a pose as a quaternion."""
    half = pose[2] / 2.0
    return {"x": 0.0, "y": 0.0, "z": math.sin(half), "w": math.cos(half)}


def _rgba(colour: tuple[float, ...]) -> dict[str, float]:
    return dict(zip("rgba", (*colour, 1.0), strict=True))
