"""What people say is acted on as they mean it, asked about, or refused."""

from __future__ import annotations

SAID = """
second door on the right = go through the second door on the right
the second door on your right = go through the second door on the right
zweite Tür rechts = go through the second door on the right
it's the second door on the right = go through the second door on the right
go down the hallway, then the second door on the right = go through the second door on the right
take the second left = turn left at the second turning
make a left at the T-junction = turn left at the first T-junction
am Flurende nach links = turn left at the end of the hallway
turn left, no, right = turn right
fahr zurück zum Start = go back to the start
geh an zwei Türen vorbei und dann links rein = go through the third door on the left
"""
TABLE = [tuple(row.split(" = ")) for row in SAID.strip().splitlines()]
