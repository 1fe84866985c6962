"""What a search for a referent gives: it is known, or here is where to look for it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Generic, TypeVar

from semnav_features.corridor import Corridor
from semnav_features.frames import Pose

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Known(Generic[T]):
    """What a reference names, or the answer to what was asked.

    Attributes:
        value: the referent.
    """

    value: T


@dataclass(frozen=True, slots=True)
class Searching:
    """What a reference names has not been seen yet.

    Attributes:
        what: is being looked for, in words.
        lookout: the pose from which to look for it, in the frame of the scene.
        corridor: along which the search leads; None if it leads along none.
        on_the_spot: whether only the heading of `lookout` matters.
    """

    what: str
    lookout: Pose
    corridor: Corridor | None = field(default=None, compare=False, repr=False)
    on_the_spot: bool = False
