"""A recorded episode: poses, velocities and contacts, one row for each step."""

from __future__ import annotations

import os
from collections.abc import Iterable
from contextlib import closing
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_env.world.dynamics.settings import AWAY
from semnav_env.world.physics import World
from semnav_features.door_passages import DoorPassage, PassableDoor, door_passages
from semnav_features.frames import FloatArray, Pose, Twist
from semnav_features.readers.log import DamageError
from semnav_features.readers.npz_arrays import NpzArrays
from semnav_features.writing import replacing

REQUIRED_ARRAYS = ("poses", "velocities", "contacts", "impulses")
"""Names of the arrays that every recording has."""

OPTIONAL_ARRAYS = ("people", "leaves")
"""Names of the arrays that only a recording among people or changing doors has."""


@dataclass(frozen=True, eq=False)
class Recording:
    """A driven episode as arrays; row 0 is the start, and each step adds a row.

    Attributes:
        poses: true poses of the robot's centre, shape (n + 1, 3), world frame, metres and radians.
        velocities: of the robot's centre: forward, left (m/s) and yaw rate (rad/s), robot frame,
            shape (n + 1, 3).
        contacts: solid segments touched during the step, shape (n + 1,).
        impulses: sum of the magnitudes of the impulses received during the step, N s, shape
            (n + 1,).
        period: duration of a step, seconds.
        people: x, y and radius of each person, metres, shape (n + 1, k, 3); all three are `AWAY`
            until somebody is added by hand.
        leaves: the leaves of doors that open and close as they stood at the end: x1, y1, x2, y2
            in metres, shape (m, 4).

    Raises:
        ValueError: the arrays do not fit together, are empty or not finite.
    """

    poses: FloatArray
    velocities: FloatArray
    contacts: NDArray[np.int64]
    impulses: FloatArray
    period: float
    people: FloatArray | None = None
    leaves: FloatArray | None = None

    def __post_init__(self) -> None:
        rows = len(self.poses) if np.ndim(self.poses) else 0
        driven = (rows, 3), (rows, 3), (rows,), (rows,)
        moved = (rows, None, 3), (None, 4)
        for name, shape in zip(
            (*REQUIRED_ARRAYS, *OPTIONAL_ARRAYS), (*driven, *moved), strict=True
        ):
            array: NDArray[Any] | None = getattr(self, name)
            if array is not None and not (rows and _fits(array, shape)):
                told = str(shape).replace("None", "any")
                raise ValueError(
                    f"{name} of a recording has shape {array.shape}; it must be {told}, "
                    "finite, with at least one row"
                )
        if not 0.0 < self.period < np.inf:
            raise ValueError(f"the period is {self.period}; it must be positive and finite")

    @property
    def steps(self) -> int:
        """Number of steps."""
        return len(self.poses) - 1

    @property
    def seconds(self) -> float:
        """Simulated time."""
        return self.steps * self.period

    @property
    def path(self) -> FloatArray:
        """Positions of the robot's centre, shape (n + 1, 2), world frame, metres."""
        return self.poses[:, :2]

    @cached_property
    def speeds(self) -> FloatArray:
        """Speed of the robot's centre, shape (n + 1,), m/s."""
        return np.asarray(np.hypot(self.velocities[:, 0], self.velocities[:, 1]))

    @property
    def collisions(self) -> int:
        """Number of contacts that began."""
        touched = self.contacts > 0
        return int(touched[0]) + int(np.count_nonzero(touched[1:] & ~touched[:-1]))

    def passages(self, doors: Iterable[PassableDoor]) -> tuple[DoorPassage, ...]:
        """How the robot passed doorways, in the order of time."""
        seconds = np.arange(len(self.poses), dtype=np.float64) * self.period
        return door_passages(self.poses, seconds, doors)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write an .npz file; its suffix is added if the path has another one."""
        arrays = {name: getattr(self, name) for name in REQUIRED_ARRAYS}
        moved = {name: getattr(self, name) for name in OPTIONAL_ARRAYS}
        arrays |= {name: array for name, array in moved.items() if array is not None}
        name = os.fspath(path)
        with replacing(name if name.endswith(".npz") else f"{name}.npz") as part:
            np.savez_compressed(part, allow_pickle=False, period=self.period, **arrays)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Recording:
        """Read what `save` wrote.

        Raises:
            ValueError: no archive, or an array is missing or does not fit; names the file.
            OSError: it cannot be opened.
        """
        try:
            return cls(**_arrays(Path(path)))
        except (TypeError, ValueError, DamageError) as error:
            said = str(error) or "is truncated or damaged"
            raise ValueError(f"{os.fspath(path)!r} is no recording: {said}") from None


def _arrays(path: Path) -> dict[str, Any]:
    """The fields of a recording in a file."""
    with closing(NpzArrays(path)) as file:
        names = (*REQUIRED_ARRAYS, "period", *OPTIONAL_ARRAYS)
        arrays: dict[str, Any] = {n: array for n in names if (array := file.whole(n)) is not None}
    for name in (*REQUIRED_ARRAYS, "period"):
        if name not in arrays:
            raise ValueError(f"it lacks {name!r}")
    if arrays["period"].size != 1:
        raise ValueError("its period is not one number")
    numbers = {"contacts": arrays["contacts"].astype(np.int64), "period": arrays["period"].item()}
    return arrays | numbers


def _fits(array: NDArray[Any], shape: tuple[int | None, ...]) -> bool:
    """Whether an array is finite and has a shape, in which None is any number."""
    if array.ndim != len(shape) or not np.isfinite(array).all():
        return False
    return all(m in (None, n) for n, m in zip(array.shape, shape, strict=True))


class Recorder:
    """Records a world step by step.

        recorder = Recorder(env.world)  # after env.reset
        ...                             # env.step(action)
        recorder.note()                 # after each step
        recorder.recording()

    Args:
        world: after its `reset`.
    """

    def __init__(self, world: World) -> None:
        self._world = world
        self._poses: list[Pose] = []
        self._velocities: list[Twist] = []
        self._touched: list[tuple[int, float]] = []
        self._people: list[FloatArray] = []
        self.note()

    def note(self) -> None:
        """Record the world as it is now."""
        world = self._world
        self._poses.append(world.pose)
        self._velocities.append(world.velocity)
        contacts = world.contacts
        self._touched.append((contacts.count, contacts.impulse))
        if world.moving is not None:
            self._people.append(world.moving_shapes[0].copy())

    def recording(self) -> Recording:
        """The recording so far."""
        counts, impulses = zip(*self._touched, strict=True)
        return Recording(
            np.array(self._poses),
            np.array(self._velocities),
            np.array(counts, dtype=np.int64),
            np.array(impulses, dtype=np.float64),
            1.0 / self._world.control_hz,
            *self._moved(),
        )

    def _moved(self) -> tuple[FloatArray | None, FloatArray | None]:
        """People and leaves, if there may be any."""
        if self._world.moving is None:
            return None, None
        people = np.full((len(self._people), len(self._people[-1]), 3), AWAY)
        for moment, there in zip(people, self._people, strict=True):
            moment[: len(there)] = there
        return people, self._world.moving_shapes[1].copy()
