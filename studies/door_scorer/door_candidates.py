"""Every gap in a scan that the door scorer is asked about, with its evidence."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from semnav_features import ExtractorSettings, Scan
from semnav_features.extraction import beam_directions, sensor_of
from semnav_features.frames import FloatArray
from semnav_features.kernels.chain import extract_arrays
from semnav_features.kernels.evidence_layout import EVIDENCE_NAMES
from semnav_features.kernels.scratch import allocate_features, allocate_scratch
from semnav_features.scene import Door, ends_of

MAX_CANDIDATES = 2048
"""Room in the arrays that the kernel fills."""

UNUSED_STATE = -1
"""State of an entry that the kernel did not fill."""


class Candidates(NamedTuple):
    """Gaps of a scan.

    Attributes:
        ends: their jambs as a door's, lidar frame, shape (n, 4), metres.
        evidence: what was measured of them, shape (n, inputs of the scorer).
    """

    ends: FloatArray
    evidence: FloatArray


def candidates_of(scan: Scan, settings: ExtractorSettings) -> Candidates:
    """The candidates of a scan at or above the least confidence of the settings, in beam order."""
    directions = beam_directions(len(scan.ranges), scan.angle_min, scan.angle_increment)
    beams = len(directions)
    scratch = allocate_scratch(beams, MAX_CANDIDATES)
    scratch.candidates["state"] = UNUSED_STATE
    extract_arrays(
        scan.ranges[:beams].copy(),
        directions,
        sensor_of(scan),
        settings.as_record()[0],
        scratch,
        allocate_features(),
        True,
    )
    count = np.count_nonzero(scratch.candidates["state"] != UNUSED_STATE)
    numbers = scratch.evidence[:count].view(np.float64).reshape(count, len(EVIDENCE_NAMES))
    return Candidates(_ends(scratch.candidates[:count]), numbers.copy())


def _ends(gaps: np.ndarray) -> FloatArray:
    along = np.stack((gaps["along_x"], gaps["along_y"]), axis=1)
    start = np.stack((gaps["start_x"], gaps["start_y"]), axis=1)
    end = np.stack((gaps["end_x"], gaps["end_y"]), axis=1)
    start = start + 0.5 * gaps["start_slack"][:, None] * along
    end = end - 0.5 * gaps["end_slack"][:, None] * along
    return np.concatenate((start, end), axis=1)


def apart(ends: FloatArray, doors: tuple[Door, ...]) -> FloatArray:
    """The larger distance between the jambs of each gap and each door, shape (n, doors), metres."""
    others = ends_of(doors)
    gaps = ends[:, None].reshape(-1, 1, 2, 2)
    same = np.hypot(*np.moveaxis(gaps - others.reshape(1, -1, 2, 2), -1, 0)).max(axis=-1)
    turned = others.reshape(1, -1, 2, 2)[:, :, ::-1]
    return np.asarray(np.minimum(same, np.hypot(*np.moveaxis(gaps - turned, -1, 0)).max(axis=-1)))
