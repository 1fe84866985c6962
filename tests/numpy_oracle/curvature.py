"""Where a group of points turns, in plain NumPy; see `kernels.curvature`."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from semnav_features.frames import FloatArray
from semnav_features.settings import ExtractorSettings
from tests.numpy_oracle.constants import CURVATURE


def curvature_peaks(points: FloatArray, settings: ExtractorSettings) -> list[int]:
    """The sharpest point of every run of points that turn enough, without their shoulders."""
    bends = [_Bend.at(points, i, settings) for i in range(len(points))]
    runs: list[list[_Bend]] = [[]]
    for bend in bends[1:-1]:
        if bend.curvature < 0.5 * bend.needed:
            runs.append([])
        elif runs[-1] or bend.curvature >= bend.needed:
            runs[-1].append(bend)
    peaks = [max(run, key=lambda bend: bend.curvature) for run in runs if run]
    return [
        peak.place
        for k, peak in enumerate(peaks)
        if not any(map(peak.is_shoulder_of, peaks[max(k - 1, 0) : k + 2]))
    ]


@dataclass(frozen=True)
class _Bend:
    """A point, the ends of its arms, one plus the cosine between them, and how much is needed."""

    place: int
    behind: int
    ahead: int
    curvature: float
    needed: float

    @classmethod
    def at(cls, points: FloatArray, i: int, settings: ExtractorSettings) -> _Bend:
        slack = settings.split_distance
        ahead, behind = i + _reach(points[i:], slack), i - _reach(points[i::-1], slack)
        arms = points[ahead] - points[i], points[behind] - points[i]
        a, b = (float(np.linalg.norm(arm)) for arm in arms)
        if min(a, b) < slack:
            return cls(i, behind, ahead, 0.0, 1.0)
        noise = settings.sigma * math.sqrt(1 / a**2 + 1 / b**2 + (1 / a + 1 / b) ** 2)
        least = max(CURVATURE.least_turn, min(CURVATURE.deviations * noise, math.pi))
        cosine = float(arms[0] @ arms[1]) / (a * b)
        return cls(i, behind, ahead, 1.0 + cosine, 1.0 - math.cos(least))

    def is_shoulder_of(self, other: _Bend) -> bool:
        """Whether a sharper bend lies within the arms."""
        within = self.behind <= other.place <= self.ahead
        return within and other.curvature > self.curvature


def _reach(points: FloatArray, slack: float) -> int:
    """The last point whose contour is longer than its chord by slack at most."""
    at, contour = 0, 0.0
    while at < len(points) - 1:
        away = np.linalg.norm(points[at:] - points[at], axis=1)
        far = np.flatnonzero(away[1:] >= slack)
        to = at + 1 + int(far[0]) if len(far) else len(points) - 1
        contour += float(away[to - at])
        if contour - float(np.linalg.norm(points[to] - points[0])) > slack:
            break
        at = to
    return at
