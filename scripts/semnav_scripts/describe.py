"""`semnav describe`: say the command that leads a robot somewhere."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from tyro.conf import arg

from semnav_env.judge import plan_goals
from semnav_env.judge.routes.describe import describe
from semnav_env.judge.routes.route_to import route_to
from semnav_env.language import Approach, paraphrases, to_program
from semnav_env.language.languages import language_of
from semnav_env.mind.grounding.goal import door_of
from semnav_env.robots import robot_spec
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.maps.placement import placement_error
from semnav_features.frames import Point
from semnav_features.plot import check_suffix
from semnav_scripts.arguments import parse_pose
from semnav_scripts.outputs import check_file


@dataclass(frozen=True)
class Arguments:
    """Say the shortest command that leads from a pose to a door, a room or a place.

    Attributes:
        start: start pose of the robot, x,y,heading in metres and radians.
        to: name of a door, a room or a corridor, or x,y in metres.
        map: a floor plan: a name (office_cross, or office:medium:17, generated) or a path.
        approach: go through a door that is named, or only to it.
        robot: wheelchair or spot.
        language: of the words: en or de (english, german).
        paraphrases: number of other wordings to print.
        seed: of the other wordings.
        plot: picture of the route to write (.png, .pdf or .svg).
        json: print as JSON.
    """

    start: Annotated[str, arg(name="from")]
    to: str
    map: str = "heidelberg_hallway"
    approach: Literal["through", "to"] = "through"
    robot: str = "wheelchair"
    language: str = "en"
    paraphrases: int = 3
    seed: int = 0
    plot: Path | None = None
    json: bool = False

    def run(self) -> int:
        """Find the route and describe it."""
        for name in ("seed", "paraphrases"):
            if getattr(self, name) < 0:
                raise ValueError(f"--{name} is {getattr(self, name)}; it must be 0 or more")
        check_file(self.plot, "--plot")
        if self.plot is not None:
            check_suffix(self.plot)
        floor_plan, start = load_floor_plan(self.map), parse_pose(self.start)
        language = language_of(self.language)
        error = placement_error(floor_plan, robot_spec(self.robot), start)
        if error is not None:
            raise ValueError(f"pose {self.start}: {error}")
        route = route_to(floor_plan, start, _goal(self.to), Approach(self.approach))
        command = describe(floor_plan, route)
        rng = np.random.default_rng(self.seed)
        others = paraphrases(command, rng, self.paraphrases, language)
        said = command.say(language)
        if self.plot is not None:
            from semnav_env.judge.routes.draw import save_routes

            save_routes(floor_plan, [(route, said)], self.plot)
        door = door_of(plan_goals(floor_plan, command, start)[-1])
        if self.json:
            outcome = {
                "command": said,
                "paraphrases": others,
                "program": to_program(command),
                "door": door.name if door is not None else None,
                "route": np.round(route.points, 3).tolist(),
                "length": round(route.length, 3),
            }
            print(json.dumps(outcome, ensure_ascii=False))
        else:
            print("\n".join([said, *(f"  or: {other}" for other in others)]))
            if self.plot is not None:
                print(f"wrote {self.plot}")
        return 0


def _goal(text: str) -> str | Point:
    """A point if the text is two numbers, otherwise a name."""
    number = r"\s*([-+]?\d+(?:\.\d*)?)\s*"
    match = re.fullmatch(f"{number},{number}", text)
    return (float(match[1]), float(match[2])) if match else text
