"""Files that are damaged at random, as disks, downloads and attackers damage them."""

from __future__ import annotations

import random
import zipfile
from collections.abc import Callable
from pathlib import Path

STRANGE = (
    *(b"0", b"-1", b"1e400", b"nan", b"NaN", b"Infinity", b"9" * 400, b"1" + b"0" * 5000),
    *(b"[" * 2000, b"{" * 50, b'"' * 3, b"*a", b"&a ", b"\xff\xfe", b"\0" * 40, b"\n" * 9, b"<"),
    *(b"\x7f" * 8, b"\xff" * 8, b"\x80" * 4, (2**62).to_bytes(8, "little"), b"null", b"../../x"),
)
"""What is put into a file: numbers, openings and lengths that parsers stumble over."""


def mutated(data: bytes, rng: random.Random) -> bytes:
    """The data with one to four random changes."""
    for _ in range(rng.choice((1, 1, 2, 4))):
        data = rng.choice(CHANGES)(data, rng)
    return data


def _place(data: bytes, rng: random.Random) -> int:
    return rng.randrange(len(data) + 1)


def _flip(data: bytes, rng: random.Random) -> bytes:
    changed = bytearray(data or b"\0")
    for _ in range(rng.choice((1, 1, 3, 20))):
        changed[rng.randrange(len(changed))] = rng.randrange(256)
    return bytes(changed)


def _cut(data: bytes, rng: random.Random) -> bytes:
    return data[: _place(data, rng)]


def _remove(data: bytes, rng: random.Random) -> bytes:
    start = _place(data, rng)
    return data[:start] + data[start + rng.choice((1, 4, 50)) :]


def _repeat(data: bytes, rng: random.Random) -> bytes:
    start = _place(data, rng)
    return data[:start] + data[start : start + rng.choice((2, 9, 200))] * 3 + data[start:]


def _insert(data: bytes, rng: random.Random) -> bytes:
    start = _place(data, rng)
    return data[:start] + rng.choice(STRANGE) + data[start:]


def _overwrite(data: bytes, rng: random.Random) -> bytes:
    start, strange = _place(data, rng), rng.choice(STRANGE)
    return data[:start] + strange + data[start + len(strange) :]


CHANGES: tuple[Callable[[bytes, random.Random], bytes], ...] = (
    *(_flip, _flip, _cut, _remove, _repeat, _insert, _overwrite),
)
"""Ways of changing data."""


def write_mutated(sound: Path, target: Path, rng: random.Random) -> None:
    """Write a damaged copy of a file; of an archive, half of the time a damaged member of it."""
    data = sound.read_bytes()
    if not zipfile.is_zipfile(sound) or rng.random() < 0.5:
        target.write_bytes(mutated(data, rng))
        return
    with zipfile.ZipFile(sound) as before, zipfile.ZipFile(target, "w") as after:
        chosen = rng.choice(before.namelist())
        for name in before.namelist():
            member = before.read(name)
            after.writestr(name, mutated(member, rng) if name == chosen else member)
