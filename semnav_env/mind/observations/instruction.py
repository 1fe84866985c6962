"""The words of the command as an entry of the observation, like `mission` in MiniGrid."""

from __future__ import annotations

from dataclasses import dataclass

from gymnasium.spaces import Text

from semnav_env.mind.observations.observer import Moment
from semnav_env.robots import RobotSpec
from semnav_features.lidar_spec import LidarSpec

UNKNOWN_CHARACTER = "?"
"""Replacement for a character that the space does not contain."""

CHARACTERS = frozenset(map(chr, (*range(32, 127), *range(161, 256)))) | frozenset("–—‘’‚“”„…")
"""Characters of the space: those of Western European languages, and their quotation marks."""


@dataclass(frozen=True)
class InstructionEntry:
    """The command in the words in which it was given, as a `Text` space.

        SemNavEnv(observation=EntryObservation("command", [InstructionEntry()]))

    stable-baselines3 takes no text; leave it out there, or turn it into numbers first.

    Attributes:
        name: its key in the observation.
        max_length: characters; longer words are cut.
    """

    name: str = "instruction"
    max_length: int = 400

    def space(self, robot: RobotSpec, lidar: LidarSpec) -> Text:
        """The space of the entry."""
        return Text(self.max_length, min_length=0, charset=CHARACTERS)

    def observe(self, moment: Moment) -> str:
        """The words, with `UNKNOWN_CHARACTER` in place of characters outside the space."""
        said = moment.instruction[: self.max_length]
        return "".join(each if each in CHARACTERS else UNKNOWN_CHARACTER for each in said)
