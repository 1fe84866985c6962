"""What an episode is asked to be; what is not asked for is drawn."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

import semnav_env.language
from semnav_env.language import Ask, Command
from semnav_env.robots import RobotSpec
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.simulator.odometry import OdometrySettings
from semnav_features.frames import Pose
from semnav_features.lidar_spec import LidarSpec
from semnav_features.validation import finite_floats, require, shown

if TYPE_CHECKING:
    from semnav_env.judge.episodes.episode import Episode

LARGEST_HEADING = 2.0 * math.tau
"""A larger heading must be degrees, not radians that nobody wrapped; radians."""


@dataclass(frozen=True)
class EpisodeRequest:
    """What an episode is asked to be. `None` stands for what is to be drawn, or for the usual one.

    Attributes:
        command: text or `Command`.
        language: of the text; None to recognise it.
        ask: asks a person what is meant where the text leaves it open, such as `input`.
        implicit_steps: whether to do what goes without saying, such as leaving the room first.
        pose: start of the robot's centre (x, y, heading), world frame.
        floor_plan: a bundled name, a path or a `FloorPlan`.
        episode: an `Episode`, or the id of one that the environment draws from; it says all that
            stands above by itself.
        robot: the body of this episode; it must have the action space of the environment.
        lidar: of this episode; it must have the beams, the range and the rate of the environment.
        odometry: how dead reckoning errs in this episode.
        feasible: whether the command must be one that can be carried out.
        episode_id: of the episode that all this was taken from; empty if there is none.
        words: in which the command of that episode was said; empty if there is none.
    """

    command: str | Command | None = None
    language: str | None = None
    ask: Ask | None = None
    implicit_steps: bool = True
    pose: Any = None
    floor_plan: str | Path | FloorPlan | None = None
    episode: Episode | str | None = None
    robot: RobotSpec | None = None
    lidar: LidarSpec | None = None
    odometry: OdometrySettings | None = None
    feasible: bool = True
    episode_id: str = ""
    words: str = ""

    @classmethod
    def from_options(cls, options: dict[str, Any] | None) -> EpisodeRequest | None:
        """The options of `reset` as a request; None where nothing is asked for.

        Raises:
            ValueError: no dictionary, an option that is unknown, one beside an episode that has its
                own, or implicit steps that are neither True nor False.
        """
        if not isinstance(options, dict | None):
            raise ValueError(f"options are a dict with {', '.join(OPTIONS)}, not {shown(options)}")
        given = options or {}
        for unknown in given.keys() - set(OPTIONS):
            raise ValueError(f"no option {shown(unknown)}; there are: {', '.join(OPTIONS)}")
        if given.get("episode") is not None:
            for part in given.keys() - {"episode"}:
                raise ValueError(f"an episode has its own {part}; leave {part!r} out")
        asked = {name: value for name, value in given.items() if value is not None}
        steps = asked.get("implicit_steps", True)
        ask = asked.get("ask")
        require(ask is None or callable(ask), "ask", ask, "a function from a question to an answer")
        require(isinstance(steps, bool), "implicit_steps", steps, "True or False")
        return cls(**asked) if given else None

    @property
    def info(self) -> dict[str, Any]:
        """What `reset` says of the request, for `info`."""
        told = {"episode_id": self.episode_id, "instruction": self.instruction}
        return {name: value for name, value in told.items() if value}

    @property
    def instruction(self) -> str:
        """The command in the words in which it was said; empty if none is asked for."""
        if isinstance(self.command, Command):
            return self.words or self.command.say(self.language or "en")
        return self.command or ""

    def checked_command(self, rooms: tuple[str, ...]) -> Command | None:
        """The command, if one is asked for.

        Args:
            rooms: names of the rooms of the floor plan.

        Raises:
            ValueError: neither text nor a command, or an unknown language.
            CommandError: the text is not understood.
        """
        from semnav_env.language.languages import language_of  # read when first spoken

        given = self.command
        language = None if self.language is None else language_of(self.language)
        if given is None or isinstance(given, Command):
            return given
        if isinstance(given, str):
            return semnav_env.language.parse(given, language, rooms, self.ask)
        raise ValueError(f"a command is text or a Command, not {type(given).__name__}")

    def checked_pose(self) -> Pose | None:
        """The start pose, if one is asked for.

        Raises:
            ValueError: not three numbers, or a heading in degrees.
        """
        if self.pose is None:
            return None
        numbers = finite_floats(self.pose)
        if numbers is None or len(numbers) != 3:
            raise ValueError(
                f"a pose is (x, y, heading), finite, metres and radians, not {shown(self.pose)}"
            )
        x, y, heading = numbers
        if abs(heading) > LARGEST_HEADING:
            raise ValueError(
                f"the heading {heading:g} is more than two turns; give it in radians, not degrees "
                "(math.radians)"
            )
        return x, y, heading


_INTERNAL = ("robot", "lidar", "odometry", "feasible", "episode_id", "words")
OPTIONS = tuple(each.name for each in fields(EpisodeRequest) if each.name not in _INTERNAL)
"""Options of `reset`."""
