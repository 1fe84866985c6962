"""Sends Ctrl-C or SIGTERM to a command, a process of its own, at a random moment."""

from __future__ import annotations

import random
import signal
import subprocess
import sys
import tempfile
import time
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

import semnav
from tests.reliability.children import WALL_SECONDS
from tests.reliability.strikes import contents, inputs
from tests.support.paths import ROOT

COMMANDS = (
    "ground stop --map office_cross --pose 3,11.5,0 --json",
    "demo stop --map office_cross --pose 3,11.5,0 --picture {out}/end.png",
    "extract {inputs}/drive.log --out {out}/scenes.jsonl",
    "evaluate val_seen --agent random --episodes 2 --out {out}/rows.jsonl",
    "map show office_cross --out {out}/plan.png",
    "doctor",
)
"""What is interrupted; {inputs} and {out} are folders."""

SIGNALS = (signal.SIGINT, signal.SIGTERM)
NOT_A_LINE = ("Traceback", "Exception ignored", "Error:", "Fatal")


class Ended(NamedTuple):
    """How a process ended: its exit code, minus the number of a signal, and what it said."""

    code: int
    said: str


def run(words: list[str], number: int = 0, wait: float = 0.0) -> Ended:
    """Run a command and send it a signal.

    Args:
        words: the command.
        number: of the signal; none if 0.
        wait: since it began to mind signals, seconds. Before, Python alone is at work.
    """
    command = [sys.executable, str(ROOT / "semnav.py"), *words]
    pipe = subprocess.PIPE
    process = subprocess.Popen(command, stdout=pipe, stderr=pipe, text=True, errors="replace")
    if number and _minds_signals(process):
        time.sleep(wait)
        process.send_signal(number)
    _, said = process.communicate(timeout=WALL_SECONDS)
    return Ended(process.returncode, said)


def _minds_signals(process: subprocess.Popen[str]) -> bool:
    """Wait until a process has a handler of SIGTERM; False if it has ended before."""
    mask = 1 << (signal.SIGTERM - 1)
    while process.poll() is None:
        for line in Path(f"/proc/{process.pid}/status").read_text().splitlines():
            if line.startswith("SigCgt:") and int(line.split()[1], 16) & mask:
                return True
        time.sleep(0.001)
    return False


@lru_cache(maxsize=len(COMMANDS))
def undisturbed(command: str) -> tuple[Ended, float]:
    """How a command ends that nothing happens to, and how long it takes, seconds."""
    with tempfile.TemporaryDirectory() as out:
        begun = time.monotonic()
        ended = run(_words(command, Path(out)))
        return ended, time.monotonic() - begun


def _words(command: str, out: Path) -> list[str]:
    return command.format(inputs=inputs(), out=out).split()


def fault(command: str, number: int, seed: int) -> str:
    """What is wrong after a signal; empty if nothing is.

    Args:
        command: one of `COMMANDS`.
        number: of the signal.
        seed: of the moment at which it comes.
    """
    usual, seconds = undisturbed(command)
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder)
        wait = random.Random(seed).uniform(0.0, seconds)
        ended = run(_words(command, out), number, wait)
        if any(word in ended.said for word in NOT_A_LINE):
            return f"after {wait:.3f} s: {ended.said[-3000:]}"
        if ended.code == 128 + number:
            word = semnav.WORDS[signal.Signals(number)]
            last = (ended.said.splitlines() or [""])[-1]
            if not last.startswith(f"semnav: {word}"):
                return f"after {wait:.3f} s it ends with {last!r}"
        elif ended.code not in (usual.code, -number):  # it was over, or Python was leaving
            return f"after {wait:.3f} s: exit code {ended.code}: {ended.said[-3000:]}"
        left = [name for name in contents(out) if ".part" in name or name.endswith(".lock")]
        return f"{left[0]} is left" if left else ""
