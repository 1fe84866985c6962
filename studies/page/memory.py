"""`python -m studies page_memory`: memory of `semnav serve` while a client drives for an hour."""

from __future__ import annotations

import json
import statistics
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import cycle
from typing import Any

from websockets.sync.client import ClientConnection, connect

from studies.page.command import (
    COMMAND,
    PATIENCE,
    SCENE,
    next_message,
    processor_seconds,
    resident_megabytes,
    serving,
)

SCENES: tuple[dict[str, Any], ...] = (
    SCENE,
    {"type": "scene", "plan": "heidelberg_hallway", "robot": "spot", "people": 3, "leaves": True},
    {"type": "scene", "plan": "office:medium:17"},
)
"""Scenes that the client builds in turn; a new one for every run."""

FILM_PERIOD = 10
"""Every so many runs the client also asks for the film, the episode and the plan of its run."""

SECONDS_OF_RUN = 60.0
"""A run that has not ended is stopped after this time, seconds."""


@dataclass(frozen=True)
class Arguments:
    """Measure the memory of `semnav serve` each minute, while one client drives all the time.

    The client builds a scene, drives a command in it to its end, and goes on with the next
    scene. Every tenth run it downloads film, episode and plan, and connects anew. The
    scenes repeat, so that caches fill once, in the first minutes.

    Attributes:
        minutes: how long to measure.
        warm: minutes at the start that the growth leaves out.
        speed: simulated seconds in a second.
    """

    minutes: float = 60.0
    warm: float = 10.0
    speed: float = 1.0

    def run(self) -> int:
        """Print a row a minute and the growth of the memory at the end."""
        with serving(sessions=1) as (server, address):
            print("| minute | runs | pictures | server, MB | of a core |\n|---|---|---|---|---|")
            client = RepeatingClient(address, self.speed)
            memory: list[tuple[float, float]] = []
            begun, busy = time.monotonic(), processor_seconds(server.pid)
            for pictures in client.drive(begun + 60.0 * self.minutes):
                minute = (time.monotonic() - begun) / 60.0
                if minute >= len(memory):
                    memory.append((minute, resident_megabytes(server.pid)))
                    share = (processor_seconds(server.pid) - busy) / max(60.0 * minute, 1.0)
                    cells = f"{minute:.1f} | {client.runs} | {pictures} | {memory[-1][1]:.1f}"
                    print(f"| {cells} | {100.0 * share:.0f} % |", flush=True)
        print(growth([row for row in memory if row[0] >= self.warm]))
        return 0


@dataclass
class RepeatingClient:
    """A client that drives one run after the other.

    Attributes:
        address: of the server, `ws://...`.
        speed: simulated seconds in a second.
        runs: that have ended so far.
        pictures: that have come so far.
    """

    address: str
    speed: float
    runs: int = field(default=0, init=False)
    pictures: int = field(default=0, init=False)

    def drive(self, end: float) -> Iterator[int]:
        """Drive until a time of `time.monotonic`; yields the number of pictures after each one."""
        scenes = cycle(SCENES)
        while time.monotonic() < end:
            with connect(f"{self.address}/session", max_size=None, ping_interval=None) as socket:
                socket.send(json.dumps({"type": "speed", "factor": self.speed}))
                for _ in range(FILM_PERIOD):
                    yield from self._one_run(socket, next(scenes), end)
                for what in ("film", "episode", "plan"):
                    socket.send(json.dumps({"type": "keep", "what": what}))
                    while isinstance(socket.recv(timeout=PATIENCE), str):
                        pass

    def _one_run(
        self, socket: ClientConnection, scene: dict[str, Any], end: float
    ) -> Iterator[int]:
        socket.send(json.dumps(scene))
        suggestion = next_message(socket, "scene")["suggestion"]
        text = COMMAND["text"] if scene is SCENE else suggestion
        socket.send(json.dumps({"type": "command", "text": text}))
        next_message(socket, "understood")
        end = min(end, time.monotonic() + SECONDS_OF_RUN)
        while next_message(socket, "frame", "ended")["type"] == "frame":
            self.pictures += 1
            yield self.pictures
            if time.monotonic() >= end:
                socket.send(json.dumps({"type": "playback", "action": "stop"}))
                next_message(socket, "ended")
                break
        self.runs += 1


def growth(memory: list[tuple[float, float]]) -> str:
    """How memory grew, in words.

    Args:
        memory: minutes and megabytes.

    Returns:
        the slope of the line of least squares, and the range.
    """
    if len(memory) < 2:
        return "too short to say how memory grows"
    slope = statistics.linear_regression(*zip(*memory, strict=True)).slope
    sizes = [size for _, size in memory]
    return (
        f"minutes {memory[0][0]:.0f} to {memory[-1][0]:.0f}: {60.0 * slope:+.1f} MB an hour, "
        f"between {min(sizes):.1f} and {max(sizes):.1f} MB"
    )
