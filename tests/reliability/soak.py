"""`python -m tests.reliability.soak PART COUNT`: tries for long, and writes the page about it.

The parts are `inputs` (COUNT of each area of share 1), `strikes` (COUNT of each kind on each
command that writes), `signals` (COUNT of each kind on each of some commands) and `steps` (COUNT in
all). `make soak` does all four.
"""

from __future__ import annotations

import sys
import time

from tests.reliability import signals
from tests.reliability.areas import AREAS, Area, compile_kernels, try_area
from tests.reliability.page import keep
from tests.reliability.steps import MOST_GROWTH, drive
from tests.reliability.strikes import STRIKES, fault
from tests.reliability.writers import WRITERS, Writer

BATCH = 200
"""Inputs that are tried in one child process: a fault in it counts once."""


def try_inputs(count: int) -> int:
    """Try bad inputs of all areas; returns the number of failures."""
    results = {
        area.name: _told(area.name, _try_area(area, round(count * area.share))) for area in AREAS
    }
    keep("inputs", results)
    return sum(failed for _, failed in results.values())


def _try_area(area: Area, count: int) -> list[int]:
    failed = 0
    for number in range(0, count, BATCH):
        outcome = try_area(area, min(BATCH, count - number), number)
        if outcome.fault:
            failed += 1
            print(f"  {area.name}, seed {number}: {outcome}", file=sys.stderr)
    return [count, failed]


def strike_writers(count: int) -> int:
    """Strike all commands that write; returns the number of failures."""
    results = {writer.name: _told(writer.name, _strike(writer, count)) for writer in WRITERS}
    keep("strikes", results)
    return sum(failed for _, failed in results.values())


def _strike(writer: Writer, count: int) -> list[int]:
    failed = 0
    for strike in STRIKES:
        for seed in range(count):
            if wrong := fault(writer, strike, seed):
                failed += 1
                print(f"  {writer.name}, {strike.name}, seed {seed}: {wrong}", file=sys.stderr)
    return [count * len(STRIKES), failed]


def signal_commands(count: int) -> int:
    """Send signals to commands at random moments; returns the number of failures."""
    results = {}
    for command in signals.COMMANDS:
        name = command.split()[0]
        results[name] = _told(name, _signal(command, count))
    keep("signals", results)
    return sum(failed for _, failed in results.values())


def _signal(command: str, count: int) -> list[int]:
    failed = 0
    for number in signals.SIGNALS:
        for seed in range(count):
            if wrong := signals.fault(command, number, seed):
                failed += 1
                print(f"  {command}, {number.name}, seed {seed}: {wrong}", file=sys.stderr)
    return [count * len(signals.SIGNALS), failed]


def drive_far(count: int) -> int:
    """Drive; returns 1 if memory has grown."""
    for so_far in drive(count, max(1, count // 100)):
        print(so_far, flush=True)
    keep("steps", so_far._asdict())
    return int(so_far.memory - so_far.warm > MOST_GROWTH)


def _told(name: str, result: list[int]) -> list[int]:
    print(
        f"{time.strftime('%X')}  {name:<28}{result[0]:>8} tried {result[1]:>3} failures", flush=True
    )
    return result


PARTS = {
    "inputs": try_inputs,
    "strikes": strike_writers,
    "signals": signal_commands,
    "steps": drive_far,
}

if __name__ == "__main__":
    part, number = sys.argv[1:]
    compile_kernels()
    raise SystemExit(min(1, PARTS[part](int(number))))
