"""The two results of finding a referent: it is known, or it must be searched."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Generic, TypeVar

from semnav_features.corridor import Corridor
from semnav_features.frames import Point, Pose

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Known(Generic[T]):
    """The referent is found, or the question is answered.

    Attributes:
        value: the referent.
    """

    value: T


@dataclass(frozen=True, slots=True)
class Searching:
    """The referent has not been seen yet; the robot must look for it.

    Attributes:
        what: the referent of the search, in words.
        lookout: the pose from which to look for it, in the frame of the scene.
        corridor: the corridor along which the search leads; None if there is none.
        on_the_spot: whether only the heading of `lookout` matters.
        places: of the known way to the lookout, (x, y) in metres; empty if it lies in view.
    """

    what: str
    lookout: Pose
    corridor: Corridor | None = field(default=None, compare=False, repr=False)
    on_the_spot: bool = False
    places: tuple[Point, ...] = field(default=(), compare=False, repr=False)
