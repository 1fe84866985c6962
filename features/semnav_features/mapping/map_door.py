"""A door of a map: the weighted median of its sightings, and whether its doorway stayed open."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from semnav_features.elements import Door
from semnav_features.frames import FloatArray
from semnav_features.mapping.doorway import DoorwayEvidence


@dataclass(slots=True, eq=False)
class MapDoor:
    """A door that was seen in several scans.

    Attributes:
        seen: both jambs of every sighting, rows (x1, y1, x2, y2) in metres, in one direction.
        weights: of each sighting, 0 to 1: how square the door was met.
        belief: sum of the confidences of the sightings.
        ends: the weighted median of the sightings.
        passage: evidence of beams for its opening.
    """

    seen: list[FloatArray]
    weights: list[float]
    belief: float
    ends: FloatArray = field(init=False)
    passage: DoorwayEvidence = field(init=False)

    def __post_init__(self) -> None:
        self.ends = weighted_median(self.seen, self.weights)
        self.passage = DoorwayEvidence(self.ends)

    def see(self, door: FloatArray, weight: float, confidence: float) -> None:
        """Add a sighting, in whichever direction."""
        self.seen.append(self._alike(door))
        self.weights.append(weight)
        self.belief += confidence
        self._agree()

    def absorb(self, other: MapDoor) -> None:
        """Take over the sightings of another door, and its beam counts if they are larger."""
        self.seen += map(self._alike, other.seen)
        self.weights += other.weights
        self.belief += other.belief
        if other.passage.looks > self.passage.looks:
            self.passage = other.passage
        self._agree()

    def distance(self, door: FloatArray) -> float:
        """Larger distance of a jamb of a sighting from this door's jamb, metres."""
        off = self._alike(door) - self.ends
        return max(math.hypot(off[0], off[1]), math.hypot(off[2], off[3]))

    def apart(self, other: MapDoor) -> float:
        """Distance between the middles of two doors, metres."""
        off = (self.ends[:2] + self.ends[2:] - other.ends[:2] - other.ends[2:]) / 2
        return math.hypot(off[0], off[1])

    @property
    def share(self) -> float:
        """Mean confidence over the scans that saw through it, 0 for a scan that found no door."""
        return self.belief / max(self.passage.looks, len(self.seen))

    def as_door(self) -> Door:
        """The door of a scene."""
        x1, y1, x2, y2 = self.passage.bounds(self.ends).tolist()
        confidence = self.share * self.passage.openness
        return Door((x1, y1), (x2, y2), sightings=len(self.seen), confidence=confidence)

    def _alike(self, door: FloatArray) -> FloatArray:
        """A door in the direction of this one."""
        along = (self.ends[2:] - self.ends[:2]) @ (door[2:] - door[:2])
        return door if along >= 0.0 else door[[2, 3, 0, 1]]

    def _agree(self) -> None:
        """Take the median of the sightings; restart the beam counts if this moved the door."""
        self.ends = weighted_median(self.seen, self.weights)
        if not self.passage.lies_along(self.ends):
            looks = self.passage.looks
            self.passage = DoorwayEvidence(self.ends)
            self.passage.looks = looks


def weighted_median(rows: Sequence[FloatArray], weights: Sequence[float]) -> FloatArray:
    """For each column the mean of the lower and the upper weighted median.

    With equal weights this is the median.

    Args:
        rows: values, each of shape (k,).
        weights: positive, one for each row.
    """
    values, share = np.array(rows), np.array(weights)
    order = np.argsort(values, axis=0)
    ordered = np.take_along_axis(values, order, axis=0)
    reached = np.cumsum(share[order], axis=0)
    half = 0.5 * share.sum() * (1.0 + np.array((-1e-9, 1e-9)))
    lower, upper = [(reached < level).sum(axis=0) for level in half]
    columns = np.arange(values.shape[1])
    middle: FloatArray = 0.5 * (ordered[lower, columns] + ordered[upper, columns])
    return middle
