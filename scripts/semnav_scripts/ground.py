"""`semnav ground`: say what a command refers to in a floor plan."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

from tyro.conf import Positional

from semnav_env.judge.goals import goals_in_turn
from semnav_env.language import (
    AmbiguousCommandError,
    Command,
    CommandError,
    corrections,
    parse,
)
from semnav_env.language.told import in_words_of
from semnav_env.language.vocabulary.recognition import language_of_text
from semnav_env.mind.grounding import GroundingError
from semnav_env.mind.grounding.goal import door_of
from semnav_env.robots import robot_spec
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.maps.placement import placement_error
from semnav_scripts.arguments import OptionalText, parse_pose
from semnav_scripts.asking import asking

TABLE_HEADINGS = f"{'goal':<6}{'x, m':>9}{'y, m':>9}{'heading, rad':>14}  clause"


@dataclass(frozen=True)
class Arguments:
    """Say what a command refers to in a floor plan, clause by clause.

    Each clause gives a goal: "reach" a place, "pass" the named door, or "stop". A line shows the
    goal, the target pose of the robot's centre in the frame of the floor plan, the referent in
    words, and the door. Behind a door to pass, the heading points away from the door.

    Attributes:
        command: a command, or only a place, such as "the second door on the right".
        map: a floor plan: a name (office_cross, or office:medium:17, generated) or a path.
        pose: pose of the robot, x,y,heading in metres and radians.
        robot: wheelchair or spot.
        language: of the command: en or de (english, german); recognised if not given.
        json: print as JSON.
    """

    command: Positional[str]
    pose: str
    map: str = "heidelberg_hallway"
    robot: str = "wheelchair"
    language: OptionalText = None
    json: bool = False

    def run(self) -> int:
        """Ground the command on the true scene."""
        floor_plan, pose = load_floor_plan(self.map), parse_pose(self.pose)
        error = placement_error(floor_plan, robot_spec(self.robot), pose)
        if error is not None:
            raise ValueError(f"pose {self.pose}: {error}")
        command = understood(self.command, self.language, floor_plan.room_names)
        spoken = language_of_text(self.command, self.language)
        try:
            goals = list(goals_in_turn(floor_plan, command, pose))
        except GroundingError as refused:
            raise refused.in_words_of(spoken) from None
        rows = [
            {
                "kind": goal.kind.name.lower(),
                "understood": in_words_of(spoken, goal.because),
                "pose": [round(value, 3) for value in goal.pose],
                "door": door.name if (door := door_of(goal)) is not None else None,
            }
            for _, goal in goals
        ]
        if self.json:
            print(json.dumps(rows))
        else:
            for each in corrections(self.command, floor_plan.room_names):
                print(each.say(spoken))
            print("\n".join([TABLE_HEADINGS, *map(_line, rows)]))
        return 0


def _line(row: dict[str, Any]) -> str:
    x, y, heading = row["pose"]
    door = f"  (door {row['door']})" if row["door"] else ""
    return f"{row['kind']:<6}{x:>9.3f}{y:>9.3f}{heading:>14.3f}  {row['understood']}{door}"


def understood(text: str, language: str | None = None, rooms: tuple[str, ...] = ()) -> Command:
    """The command of a text; for a place alone, the command to go there.

    Raises:
        CommandError: the text is neither a command nor a place.
    """
    try:
        return parse(text, language, rooms, asking())
    except AmbiguousCommandError:
        raise
    except CommandError as error:
        if language not in (None, "en"):
            raise
        try:
            return parse(f"go to {text}", language, rooms, asking())
        except CommandError as place_error:
            further = (place_error.position or 0) - len("go to ") > (error.position or 0)
            raise place_error if further else error from None
