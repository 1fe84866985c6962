"""`python -m studies page`: how soon a robot of the page moves, and how many pictures come."""

from __future__ import annotations

import json
import os
import re
import statistics
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

SCENE = {"type": "scene", "plan": "office_cross", "pose": [1.3, 9.1, 0.0]}
COMMAND = {"type": "command", "text": "turn left at the intersection, then go down the hallway"}

PATIENCE = 300.0
"""How long a busy machine may take for a message, seconds."""

HEADINGS = (
    "| clients | to first motion, ms: median, most | pictures a second: mean | least "
    "| of a core | server, MB |"
)


@dataclass(frozen=True)
class Arguments:
    """Measure `semnav serve` through its WebSocket, as a browser uses it.

    The server runs in a process of its own and is warm: it says so before it listens. Its
    processor time does not depend on what else the machine does; the other times do.

    Attributes:
        clients: numbers of clients that drive at the same time, at one simulated second a second.
        runs: runs of each client.
        seconds: time for which the pictures of a run are counted.
    """

    clients: tuple[int, ...] = (1, 4)
    runs: int = 5
    seconds: float = 4.0

    def run(self) -> int:
        """Print a row for each number of clients."""
        with serving(max(self.clients)) as (server, address):
            print(HEADINGS)
            print("|---|---|---|---|---|---|")
            for count in self.clients:
                print(self._row(server, address, count), flush=True)
        return 0

    def _row(self, server: subprocess.Popen[str], address: str, count: int) -> str:
        found: list[tuple[float, float]] = []
        visits = [threading.Thread(target=self._visit, args=(address, found)) for _ in range(count)]
        busy, begun = processor_seconds(server.pid), time.perf_counter()
        for visit in visits:
            visit.start()
        for visit in visits:
            visit.join()
        motion = [1000.0 * first for first, _ in found]
        rates = [rate for _, rate in found]
        share = (processor_seconds(server.pid) - busy) / (time.perf_counter() - begun)
        cells = (
            f"{count}",
            f"{statistics.median(motion):.0f}, {max(motion):.0f}",
            f"{statistics.mean(rates):.1f}",
            f"{min(rates):.1f}",
            f"{100.0 * share:.0f} %",
            f"{resident_megabytes(server.pid):.0f}",
        )
        return f"| {' | '.join(cells)} |"

    def _visit(self, address: str, found: list[tuple[float, float]]) -> None:
        from websockets.sync.client import connect

        with connect(f"{address}/session", max_size=None) as socket:
            socket.send(json.dumps(SCENE))
            start = next_message(socket, "frame")["pose"]
            for _ in range(self.runs):
                asked = time.perf_counter()
                socket.send(json.dumps(COMMAND))
                next_message(socket, "understood")
                while next_message(socket, "frame")["pose"] == start:
                    pass
                moved = time.perf_counter()
                pictures = 0
                while time.perf_counter() < moved + self.seconds:
                    pictures += next_message(socket, "frame", "ended")["type"] == "frame"
                found.append((moved - asked, pictures / (time.perf_counter() - moved)))
                socket.send(json.dumps({"type": "playback", "action": "stop"}))
                next_message(socket, "ended")


@contextmanager
def serving(sessions: int) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """A warm server in a process of its own, and its address."""
    command = [sys.executable, "-m", "semnav", "serve", "--port", "0", "--sessions", str(sessions)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        try:
            assert server.stdout is not None
            ready = next(line for line in server.stdout if line.startswith("open "))
            address = re.search(r"http(://\S+)", ready)
            assert address is not None
            yield server, f"ws{address[1]}"
        finally:
            server.terminate()


def resident_megabytes(process: int) -> float:
    """Memory of a process, megabytes (Linux)."""
    told = Path(f"/proc/{process}/status").read_text()
    return int(told.split("VmRSS:")[1].split()[0]) / 1024


def processor_seconds(process: int) -> float:
    """Processor time of a process so far, seconds (Linux)."""
    fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def next_message(socket: Any, *kinds: str) -> dict[str, Any]:
    """The next message of one of these types."""
    while True:
        message: dict[str, Any] = json.loads(socket.recv(timeout=PATIENCE))
        if message["type"] in kinds:
            return message
        if message["type"] in ("error", "refused"):
            raise ValueError(str(message))
