"""The leaderboard as text that fits a terminal of 80 columns."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

SHARED = ("split", "robot", "version, rules")
"""Columns that are printed once above the rows that share their value."""

LONGEST_NAME = 15
"""Length of an agent's name beyond which it has a line of its own, characters."""

SHOWN_DIGITS = 8
"""Digits of a fingerprint that are shown; files and JSON have all of them."""

SEPARATOR = " "


def plain_table(headings: Sequence[str], lines: Sequence[Sequence[str]]) -> str:
    """A table with intervals below their values, and with shared values above the rows.

    Args:
        headings: of all columns.
        lines: the cells of each row; "0.967 (0.92 to 1.00)" is a value with its interval.
    """
    shared = [k for k, name in enumerate(headings) if name in SHARED]
    shown = [k for k in range(len(headings)) if k not in shared]
    widths = _widths([[headings[k] for k in shown], *_rows(lines, shown)])
    text = [_aligned([headings[k] for k in shown], widths)]
    for what, group in groupby(lines, lambda cells: ", ".join(cells[k] for k in shared)):
        text += ["", what]
        for row in _rows(list(group), shown):
            text.append(_aligned(row, widths))
    return "".join(f"{line.rstrip()}\n" for line in text)


def _rows(lines: Sequence[Sequence[str]], shown: Sequence[int]) -> Iterator[list[str]]:
    """The rows of text of each line: a long name, the values, their intervals."""
    for cells in lines:
        name, *values = (cells[k] for k in shown)
        parted = [value.rstrip(")").partition(" (")[::2] for value in values]
        if len(name) > LONGEST_NAME:
            yield [name]
            name = ""
        yield [name, *(value for value, _ in parted)]
        intervals = [interval.replace(" to ", "-") for _, interval in parted]
        if any(intervals):
            yield ["", *intervals]


def _widths(rows: Sequence[Sequence[str]]) -> list[int]:
    whole = [row for row in rows if len(row) > 1]
    return [max(map(len, column)) for column in zip(*whole, strict=True)]


def _aligned(row: Sequence[str], widths: Sequence[int]) -> str:
    """A row: the name to the left, numbers to the right."""
    name, *numbers = row
    padded = map(str.rjust, numbers, widths[1:])
    return SEPARATOR.join([name.ljust(widths[0]), *padded])
