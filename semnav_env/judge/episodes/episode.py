"""A frozen episode: floor plan, start, command and the right answer."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Self

import numpy as np
from numpy.typing import NDArray

from semnav_env.judge.episodes.fingerprint import fingerprint
from semnav_env.language import CLAUSE_FEATURES, MAX_CLAUSES, Command, encode, parse, read
from semnav_env.world.maps import FloorPlan, load_floor_plan
from semnav_features.frames import Point, Pose


class Expected(StrEnum):
    """The right answer to a command: carry it out, say that it is impossible, or ask back."""

    FEASIBLE = "feasible"
    INFEASIBLE = "infeasible"
    AMBIGUOUS = "ambiguous"


class StaleEpisodeError(ValueError):
    """The floor plan has changed since the episode was made."""


@dataclass(frozen=True)
class Episode:
    """One frozen episode; it is the same for every body.

    Attributes:
        id: name of the split and a number, as "train-00017".
        floor_plan: name of a bundled or generated plan, or a path.
        plan_hash: `fingerprint` of its geometry.
        start: pose of the robot's centre (x, y, heading), world frame.
        command: text of the command.
        language: language of the command, "en" or "de".
        readings: every meaning of the command in canonical words of that language.
        route: the true route as (x, y), metres, simplified to 5 cm. The route of an impossible
            command ends where it becomes impossible; that of an ambiguous one is empty.
        expected: the right answer.
        programs: the readings as programs, so that they need not be parsed; empty if not stored.
        token_rows: the tokens of the first reading, a row for each clause, with the rooms of the
            floor plan numbered as `commands.encode` does it; empty if not stored.
    """

    id: str
    floor_plan: str
    plan_hash: str
    start: Pose
    command: str
    language: str
    readings: tuple[str, ...]
    route: tuple[Point, ...]
    expected: Expected = Expected.FEASIBLE
    programs: tuple[Command, ...] = ()
    token_rows: tuple[tuple[int, ...], ...] = ()

    @property
    def number(self) -> int:
        """Number in its split, which is also the seed of its noise."""
        return int(self.id.rpartition("-")[2])

    @property
    def clauses(self) -> int:
        """Number of clauses of the first reading."""
        return len(self.meanings()[0].clauses)

    @property
    def group(self) -> str:
        """Group in tables of results: "1 clause", "2 clauses" and so on."""
        return f"{self.clauses} clause{'s' if self.clauses > 1 else ''}"

    def plan(self) -> FloorPlan:
        """The floor plan.

        Raises:
            StaleEpisodeError: it is not the one that the episode was made in.
            FloorPlanError: there is none of that name.
        """
        plan = load_floor_plan(self.floor_plan)
        found = plan.derived(fingerprint)
        if found != self.plan_hash:
            raise StaleEpisodeError(
                f"{self.id}: {self.floor_plan} has changed since the episode was made (its "
                f"fingerprint is {found}, not {self.plan_hash}); generate the episodes again"
            )
        return plan

    @property
    def tokens(self) -> NDArray[np.int64]:
        """The first reading as tokens, shape (`MAX_CLAUSES`, `CLAUSE_FEATURES`), see `encode`."""
        if not self.token_rows:
            return encode(self.meanings()[0], self.plan().room_names)
        tokens = np.zeros((MAX_CLAUSES, CLAUSE_FEATURES), np.int64)
        tokens[: len(self.token_rows)] = self.token_rows
        return tokens

    def understood(self, rooms: tuple[str, ...]) -> Self:
        """A copy of the episode that stores programs and tokens.

        Args:
            rooms: names of the rooms of its floor plan.
        """
        meanings = self.meanings()
        rows = encode(meanings[0], rooms)[: len(meanings[0].clauses)]
        return replace(self, programs=meanings, token_rows=tuple(map(tuple, rows.tolist())))

    def command_in(self, rooms: tuple[str, ...]) -> Command:
        """The command that the words mean, given the names of rooms; parsed only if not stored."""
        return self.programs[0] if self.programs else parse(self.command, self.language, rooms)

    def meanings(self) -> tuple[Command, ...]:
        """The readings as commands."""
        if self.programs:
            return self.programs
        with self.named_in_errors():
            return tuple(read(reading, self.language) for reading in self.readings)

    @contextmanager
    def named_in_errors(self) -> Iterator[None]:
        """Add the episode's id to a `ValueError` that does not name it."""
        try:
            yield
        except ValueError as error:
            if self.id not in "".join([str(error), *getattr(error, "__notes__", ())]):
                error.add_note(f"episode {self.id}")
            raise
