"""A full disk, a kill and Ctrl-C lose nothing, whatever command writes.

Some strikes are part of every run, of commands that differ in how they write: a whole file, two of
them, lines, and a dataset. The others are slow, and `make soak` tries more of all.
"""

from __future__ import annotations

import pytest

from semnav_scripts.main import SEMNAV
from semnav_scripts.map import COMMANDS as MAP
from tests.reliability.strikes import STRIKES, Strike, fault
from tests.reliability.writers import WRITERS, Writer

QUICK_STRIKES = {"full disk", "killed while writing"}
QUICK_COMMANDS = {"map generate", "map import", "extract", "demonstrate"}
WRITE_NOTHING = {
    *("ground", "bench", "doctor", "evaluate language", "map list", "map check"),
    *("serve", "node", "simulate", "completion"),
    *("map", "episodes"),  # further commands of these stand in the table
}

CASES = [
    pytest.param(
        writer,
        strike,
        id=f"{writer.name}, {strike.name}",
        marks=[]
        if strike.name in QUICK_STRIKES and writer.name in QUICK_COMMANDS
        else pytest.mark.slow,
    )
    for writer in WRITERS
    for strike in STRIKES
]


@pytest.mark.parametrize(("writer", "strike"), CASES)
def test_a_strike_loses_nothing(writer: Writer, strike: Strike) -> None:
    assert not (wrong := fault(writer, strike, seed=1)), wrong


def test_every_command_that_writes_is_struck() -> None:
    names = {*SEMNAV.commands, *(f"map {name}" for name in MAP.commands)}
    assert names - WRITE_NOTHING <= {writer.name for writer in WRITERS}
