"""The output of `semnav extract`: scenes as JSON, and a summary of the run."""

from __future__ import annotations

import json
import sys
import time
from collections import Counter
from collections.abc import Iterable
from dataclasses import asdict
from pathlib import Path
from typing import Any

from semnav_features import Scene
from semnav_features.readers import LogRecord, ScanLog
from semnav_features.scene import Door
from semnav_scripts.printable import printable

_KINDS = ("walls", "doors", "corners", "corridors", "arcs")


def document(record: LogRecord, scene: Scene) -> dict[str, Any]:
    """A scene as JSON: metres, radians and seconds, in the frame of the lidar.

    `line` is `LogRecord.line`; `pose` is the lidar's in the frame of the log; a corner's `kind`
    is 0 outer, 1 inner or 2 potential. Lengths are rounded to a tenth of a millimetre.
    """
    return {
        "line": record.line,
        "stamp": record.stamp,
        "pose": record.pose,
        "odometry": record.odometry,
        "walls": [_rounded(asdict(wall)) for wall in scene.walls],
        "doors": [_rounded(_door(door)) for door in scene.doors],
        "corners": [_rounded(asdict(corner)) for corner in scene.corners],
        "corridors": [
            _rounded(dict(start=c.start, end=c.end, midpoint=c.midpoint)) for c in scene.corridors
        ],
        "arcs": [_rounded(asdict(arc)) for arc in scene.arcs],
    }


def rejections(scene: Scene) -> list[dict[str, Any]]:
    """The rejected candidates with their reasons, as JSON; points as in `document`."""
    return [_rounded(asdict(each)) for each in scene.rejections]


def _door(door: Door) -> dict[str, Any]:
    return {
        "start": door.start,
        "end": door.end,
        "midpoint": door.midpoint,
        "width": door.width,
        "confidence": door.confidence,
        "leaf": None if door.leaf is None else asdict(door.leaf),
    }


def bad_text(log: ScanLog) -> str:
    """The number of lines, rows or messages of a log that could not be read, by reason."""
    reasons = [
        f"  {count} x {reason} (first: {log.unit} {log.first_bad[reason]})"
        for reason, count in log.bad.most_common()
    ]
    return "\n".join([f"{log.bad.total()} bad {log.unit}s", *reasons])


def print_notes(notes: Iterable[str]) -> None:
    """Print the notes about possible errors of a log on stderr."""
    for note in notes:
        print(printable(f"note: {note}"), file=sys.stderr)


class ExtractionTally:
    """Counts of the features of a run, and its speed.

    Attributes:
        scenes: number of scans that were turned into scenes.
        found: number of features of each kind.
    """

    def __init__(self, log: ScanLog) -> None:
        self.scenes = 0
        self.found: Counter[str] = Counter()
        self._log = log
        self._first = self._last = 0.0

    def add(self, scene: Scene) -> None:
        """Count a scene."""
        self.scenes += 1
        self.found.update({kind: len(getattr(scene, kind)) for kind in _KINDS})
        self._last = time.perf_counter()
        self._first = self._first or self._last

    @property
    def rate(self) -> float | None:
        """Scans per second, reading and writing included; compiling at the start is left out."""
        elapsed = self._last - self._first
        return (self.scenes - 1) / elapsed if elapsed > 0 else None

    def label(self, scans: int) -> str:
        """One phrase for a progress bar."""
        return f"{scans} scans, {self._log.bad.total()} bad {self._log.unit}s"

    def as_text(self) -> str:
        """The summary for people."""
        rate = f", {self.rate:.0f} scans per second" if self.rate else ""
        found = ", ".join(f"{self.found[kind]} {kind}" for kind in _KINDS)
        return "\n".join([f"{self.scenes} scans{rate}", found, bad_text(self._log)])

    def as_json(self, whole: bool, written: list[Path], notes: list[str]) -> str:
        """The summary for programs.

        Args:
            whole: whether the log was complete.
            written: the written files.
            notes: notes about possible errors of the log.
        """
        return json.dumps(
            {
                "scans": self.scenes,
                "scans_per_second": self.rate,
                "found": {kind: self.found[kind] for kind in _KINDS},
                "bad_lines": dict(self._log.bad.most_common()),
                "log_whole": whole,
                "notes": notes,
                "wrote": [str(path) for path in written],
            }
        )


def _rounded(value: Any) -> Any:
    if isinstance(value, float):
        return round(value, 4)
    if isinstance(value, dict):
        return {key: _rounded(item) for key, item in value.items()}
    return [_rounded(item) for item in value] if isinstance(value, tuple | list) else value
