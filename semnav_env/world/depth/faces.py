"""Rectangles in space, four corners each, in order around them: shape (4, 3), metres."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TypeAlias

import numpy as np

from semnav_features.frames import FloatArray, Point

Place: TypeAlias = Sequence[float] | FloatArray


def upright(a: Place, b: Place, low: float, high: float) -> FloatArray:
    """The rectangle above the segment from a to b, between two heights."""
    return np.array([(*a, low), (*b, low), (*b, high), (*a, high)])


def box(
    a: FloatArray, b: FloatArray, depth: float, low: float, high: float
) -> tuple[FloatArray, ...]:
    """The six sides of a box around the segment from a to b, `depth` across it."""
    along = (b - a) / math.dist(a, b)
    across = 0.5 * depth * np.array([-along[1], along[0]])
    ring = [a - across, b - across, b + across, a + across]
    sides = [upright(p, q, low, high) for p, q in zip(ring, (*ring[1:], ring[0]), strict=True)]
    lids = [np.array([(*corner, height) for corner in ring]) for height in (low, high)]
    return *sides, *lids


def prism(corners: Sequence[Point], height: float) -> Iterator[FloatArray]:
    """The sides of a prism on a polygon, and its top if that has three or four corners.

    Cameras of a robot look over the top of few things, and only boxes have one here.
    """
    ring = [(float(x), float(y)) for x, y in corners]
    for a, b in zip(ring, (*ring[1:], ring[0]), strict=True):
        yield upright(a, b, 0.0, height)
    if len(ring) in (3, 4):
        yield np.array([(*corner, height) for corner in (*ring, ring[-1])[:4]])


def column(x: float, y: float, radius: float, height: float) -> Iterator[FloatArray]:
    """The sides of an upright octagon: a person."""
    turns = np.arange(8) * (math.tau / 8)
    yield from prism([(x + radius * math.cos(t), y + radius * math.sin(t)) for t in turns], height)
