"""Draw docs/images/play.png: what a person sees who drives with assistance."""

from __future__ import annotations

import numpy as np

from semnav_env.approach import DoorSide
from semnav_env.env import SemNavEnv
from semnav_env.language import parse
from semnav_env.rendering.video import save_png
from semnav_env.rendering.viewer import Viewer
from semnav_features.door_passages import DoorPassage
from semnav_scripts.playing.played_drive import PlayedDrive
from studies.figures import IMAGES

PLAN, DOOR = "heidelberg_hallway", "south_1"
SAID = "leave the room"
TYPED = "> turn left and go to the end of the hall_"

BEFORE, BESIDE, ANGLE = 1.5, 0.25, 0.1
"""Start before the door and beside its middle, metres, and heading off its axis, radians: a robot
that drives straight on hits a jamb."""

AHEAD = (0.35, 0.0)
"""The action of the person, shares of the largest speeds."""

SECONDS, SECONDS_PASSED = 2.2, 6.0
"""Time of the picture, and time by which the door is passed, seconds."""


def main() -> None:
    """Drive straight at a jamb with assistance, draw it, and say how the door was passed."""
    env = SemNavEnv(floor_plan=PLAN, observation="all")
    door = next(each for each in env.floor_plan.doors if each.name == DOOR)
    side = DoorSide(door.start, door.end).opposite  # that of the room
    x, y = side.before(np.array(((BEFORE, BESIDE),)))[0].tolist()
    drive = PlayedDrive(env, PLAN, 0, assist=True)
    drive.begin((SAID, "en", parse(SAID)), (x, y, side.through + ANGLE))
    while env.seconds < SECONDS:
        drive.step(AHEAD)
    save_png(IMAGES / "play.png", Viewer(env.floor_plan).draw(drive.frame(TYPED)))
    while env.seconds < SECONDS_PASSED:
        drive.step(AHEAD)
    drive.finish()
    passages: tuple[DoorPassage, ...] = drive.runs[0].recording.passages(env.floor_plan.doors)
    print(drive.verdict, [passage.row() for passage in passages], env.judge.period.collisions)
