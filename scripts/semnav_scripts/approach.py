"""`semnav approach`: the poses from which a door can be passed, best first."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import shapely
from shapely import Polygon
from tyro.conf import arg

from semnav_env.approach import THESIS_SETTINGS, ApproachPlan, Surroundings, plan_approach
from semnav_env.approach.in_plan import side_towards
from semnav_env.approach.poses import CandidatePose
from semnav_env.robots import SPOT, RobotSpec, robot_spec
from semnav_env.world.maps import FloorPlan, PlanDoor, load_floor_plan
from semnav_env.world.maps.placement import placement_error
from semnav_features.frames import Pose, wrap_angle
from semnav_features.plot import check_suffix
from semnav_scripts.arguments import parse_pose
from semnav_scripts.outputs import check_file

TABLE_HEADINGS = f"{'x, m':>9}{'y, m':>9}{'heading':>9}{'area error':>12}{'angle error':>13}"

CORNER_TOUCHES = "safe for the ellipse, but a corner of the body touches a wall"
"""Remark on a pose that is safe by the definition of Mes but in which the body does not fit."""


@dataclass(frozen=True)
class Arguments:
    """Plan the pose before a door from which a robot can pass it, by the method of Mes 2021.

    For SPOT in villa_hall, without --from and --obstacle, it prints the tables of Mes 2021. Heading
    0 points along x. The exit code is 1 if the robot cannot stand before the door in any pose.

    Attributes:
        door: name of the door.
        map: a floor plan: a name (office_cross, or office:medium:17, generated) or a path.
        robot: wheelchair or spot.
        start: where the robot stands, x,y,heading in metres and radians; it says from which side
            the door is approached, by default from the corridor.
        obstacle: x,y,radius of an obstacle, such as a bin, metres; may be repeated.
        plot: picture to write (.png, .pdf or .svg).
        json: print as JSON.
    """

    door: str
    map: str = "villa_hall"
    robot: str = "spot"
    start: Annotated[str | None, arg(name="from")] = None
    obstacle: tuple[str, ...] = ()
    plot: Path | None = None
    json: bool = False

    def run(self) -> int:
        """Plan, and print the poses."""
        check_file(self.plot, "--plot")
        if self.plot is not None:
            check_suffix(self.plot)
        floor_plan, robot = load_floor_plan(self.map), robot_spec(self.robot)
        door = _door_named(floor_plan, self.door)
        start = _start(self.start, floor_plan, robot)
        side = side_towards(floor_plan, door, start and start[:2])
        things = [_disc(text) for text in self.obstacle]
        around = Surroundings.of_plan(floor_plan).with_obstacles(*things)
        is_in_thesis = (self.map, robot, start, things) == ("villa_hall", SPOT, None, [])
        settings = THESIS_SETTINGS if is_in_thesis else None
        plan = plan_approach(side, around, robot, settings, start)
        behind = plan_approach(side.opposite, around, robot).best
        if self.plot is not None:
            from semnav_env.approach.draw import save_approach

            save_approach(floor_plan, self.door, plan, robot, self.plot, start)
        after = None if behind is None else (*behind[:2], behind[2] + math.pi)
        print(json.dumps(_outcome(plan, after)) if self.json else _text(self.door, plan))
        if self.plot is not None and not self.json:
            print(f"wrote {self.plot}")
        return 0 if plan.best is not None else 1


def _door_named(plan: FloorPlan, name: str) -> PlanDoor:
    try:
        return plan.door(name)
    except KeyError as error:
        raise ValueError(str(error.args[0])) from None


def _start(text: str | None, plan: FloorPlan, robot: RobotSpec) -> Pose | None:
    if text is None:
        return None
    pose = parse_pose(text)
    problem = placement_error(plan, robot, pose)
    if problem is not None:
        raise ValueError(f"pose {text}: {problem}")
    return pose


def _disc(text: str) -> Polygon:
    """A round obstacle written as "x,y,radius"."""
    try:
        x, y, radius = parse_pose(text)
    except ValueError:
        raise ValueError(f"--obstacle {text!r} is not x,y,radius, such as -5.4,4.3,0.2") from None
    disc = shapely.Point(x, y).buffer(radius)
    if not isinstance(disc, Polygon) or disc.is_empty or not disc.is_valid:
        raise ValueError(f"--obstacle {text!r}: x and y must be finite, and radius more than 0")
    return disc


def _outcome(plan: ApproachPlan, after: Pose | None) -> dict[str, Any]:
    return {
        "evaluated": len(plan.ranked),
        "clear_of_walls": plan.clear_count,
        "safe": len(plan.safe),
        "free_square": plan.square_is_free,
        "best": _pose(plan.best),
        "after": _pose(after),
        "poses": [_row(each) for each in plan.clear_of_walls],
        "refused": [_row(each) for each in plan.ranked[plan.clear_count :]],
    }


def _row(each: CandidatePose) -> dict[str, Any]:
    errors = {"area_error": each.area_error, "angle_error": each.angle_error}
    said = {"refusal": each.refusal or None, "body_clear": each.body_clear}
    return {**(_pose(each.pose) or {}), **errors, **said}


def _pose(pose: Pose | None) -> dict[str, float] | None:
    if pose is None:
        return None
    x, y, heading = pose
    turned = math.pi - (math.pi - heading + 1e-9) % math.tau  # in (-pi, pi]
    return {"x": round(x, 4), "y": round(y, 4), "heading": round(turned, 5)}


def _text(door: str, plan: ApproachPlan) -> str:
    whole = sum(each.body_clear for each in plan.safe)
    counts = f"{len(plan.ranked)} poses, {plan.clear_count} clear of walls, {len(plan.safe)} safe "
    counts += f"for the ellipse, {whole} of these for the whole body"
    best = plan.best
    if best is None:
        taken = "no pose lets the body stand before the door"
    else:
        straight = ", straight before the door" if best == plan.straight else ""
        taken = f"best: {best[0]:.3f},{best[1]:.3f},{wrap_angle(best[2]):.4f}{straight}"
    rows = [_line(each) for each in plan.clear_of_walls]
    return "\n".join([f"{door}: {counts}", taken, TABLE_HEADINGS, *rows])


def _line(each: CandidatePose) -> str:
    x, y, heading = each.pose
    why = each.refusal or ("" if each.body_clear else CORNER_TOUCHES)
    errors = f"{each.area_error:>12.5f}{each.angle_error:>13.5f}"
    return f"{x:>9.3f}{y:>9.3f}{heading:>9.4f}{errors}  {why}".rstrip()
