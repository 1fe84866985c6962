"""Draws the pictures and films of docs/images that a command of `semnav` makes."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from studies.figures import IMAGES

COMMANDS = {
    "demo.gif": "demo 'go through the second door on the right' --map heidelberg_hallway"
    " --robot wheelchair --agent scripted --seed 3 --save {}",
    "people.gif": "demo 'go through the second door on the left' --map office_cross"
    " --pose 3.0,9.1,0 --pedestrians 6 --model orca --changing-doors 0.3 --seed 3 --save {}",
    "search.gif": "demo 'search the house' --robot spot --save {}",
    "finding_people.png": """demo 'search room "kitchen", go to the person you found and ask for"""
    """ the name' --map villa_hall --robot spot --pose 1,1,1.57 --seed 3 --picture {}""",
    "heidelberg_hallway.png": "map show heidelberg_hallway --out {}",
    "office_cross.png": "map show office_cross --out {}",
    "villa_hall.png": "map show villa_hall --out {}",
    "freiburg-079.png": "map build {log} --out {plan} --picture {}",
    "habits.png": "habits {log} --episodes val_unseen --agents scripted drive --count 120"
    " --plot {}",
}
"""What is typed for each; `log` is freiburg-079-corrected.log.gz of the Radish data set."""


def main(name: str, log: Path | None = None) -> None:
    """Draw one of them.

    Args:
        name: its file, such as demo.gif.
        log: the recorded log, where the picture shows one.

    Raises:
        ValueError: there is no such picture, or its log is not given.
    """
    if name not in COMMANDS:
        raise ValueError(f"no picture {name!r}; there are: {', '.join(COMMANDS)}")
    if "{log}" in COMMANDS[name] and log is None:
        raise ValueError(f"{name} shows a log: give freiburg-079-corrected.log.gz with --log")
    places = {"log": log, "plan": Path("out", "floor.geojson")}
    words = COMMANDS[name].format(IMAGES / name, **places)
    subprocess.run(f"{sys.executable} -m semnav {words}", shell=True, check=True)
