"""Cutting the neighbourhood of an expected door out of a cloud (Mes 2021, 6.3.1)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semnav_features.clouds.detected_door import frame_of
from semnav_features.elements import Door
from semnav_features.frames import FloatArray, points_to_local


@dataclass(frozen=True)
class CropBox:
    """Margins around an expected door. Mes 2021 set them by hand for each cloud.

    Attributes:
        along: beyond each jamb along the wall, metres.
        across: to either side of the wall, metres.
        low: least height, metres; above the floor, which would join both jambs into one cluster.
        high: largest height, metres; below the lintel, for the same reason.
        sigmas: how many standard deviations of the expected place are added to `along` and
            `across`.
    """

    along: float = 0.15
    across: float = 0.15
    low: float = 0.1
    high: float = 1.9
    sigmas: float = 1.0


def crop(
    points: FloatArray, expected: Door, sigma: float, margins: CropBox = CropBox()
) -> FloatArray:
    """The points near an expected door; arguments and errors are those of `crop_mask`."""
    return points[crop_mask(points, expected, sigma, margins)]


def crop_mask(
    points: FloatArray, expected: Door, sigma: float, margins: CropBox = CropBox()
) -> NDArray[np.bool_]:
    """Mask of the points near an expected door, shape (n,).

    Args:
        points: robot frame, metres, shape (n, 3).
        expected: where the door should be, robot frame.
        sigma: standard deviation of that place, metres.
        margins: the box.

    Raises:
        ValueError: an expected door without a width, or a sigma that is negative or not finite.
    """
    if not 0.0 <= sigma < math.inf:
        raise ValueError(f"sigma is {sigma} m; it must be finite and not negative")
    along, across = np.abs(points_to_local(frame_of(expected), points[:, :2])).T
    wide, height = margins.sigmas * sigma, points[:, 2]
    beside = along <= 0.5 * expected.width + margins.along + wide
    near = across <= margins.across + wide
    return np.asarray(beside & near & (height >= margins.low) & (height <= margins.high))
