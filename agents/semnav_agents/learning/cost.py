"""What a training cost: a line for each session, beside the agent."""

from __future__ import annotations

import json
import os
import platform
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from semnav_agents.evaluation.provenance import provenance
from semnav_features.reading import read_bytes
from semnav_features.writing import write_file

COST_FILE = "cost.jsonl"

MAX_COST_SIZE = 2**20
"""Largest file that is gone on with, bytes."""


@contextmanager
def noted_cost(folder: Path) -> Iterator[None]:
    """Add a line on a session to the folder of its agent, also of one that ends in an error.

    The line says when it began, the machine, the time by the clock and the processor time of this
    process, in seconds, and by which version, commit and rules. A session that is killed has none.
    """
    begin = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())
    clock, processor = time.monotonic(), time.process_time()
    try:
        yield
    finally:
        row = {
            "begin": begin,
            "processor": processor_name(),
            "cores": os.cpu_count(),
            "seconds": round(time.monotonic() - clock, 1),
            "cpu_seconds": round(time.process_time() - processor, 1),
            **provenance().row(),
        }
        if folder.is_dir():
            _add(folder / COST_FILE, json.dumps(row))


def processor_name() -> str:
    """The name of the processor, such as "AMD EPYC 7B13"."""
    try:
        lines = Path("/proc/cpuinfo").read_text("utf-8").splitlines()
    except OSError:
        lines = []
    named = (line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    return next(named, platform.processor() or platform.machine())


def _add(file: Path, line: str) -> None:
    before = read_bytes(file, MAX_COST_SIZE) if file.exists() else b""
    write_file(file, before + f"{line}\n".encode())
