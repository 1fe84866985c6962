"""Uses everything once, so that the first visitor waits for nothing to be compiled."""

from __future__ import annotations

from semnav_scripts.page.drive import PageDrive
from semnav_scripts.page.requests import SceneRequest
from semnav_scripts.page.understanding import Understood, understand

FIRST = SceneRequest(pose=(-2.5, -0.6, 0.25))
"""The scene with which the page opens."""

COMMANDS = ("fahr durch die zweite Tür rechts", "go through the second door on the right")
"""Commands that can be carried out there, in every language."""

PERSON = (1.0, 0.4)
"""Where a person begins to walk, metres, away from the robot."""

STEPS = 30
"""Control periods in which an agent has looked, planned and driven."""


def warm_up() -> None:
    """Drive for two seconds in the scene with which the page opens."""
    drive = PageDrive(FIRST)
    for text in COMMANDS:
        heard = understand(text, None, drive.env.floor_plan.room_names)
        if isinstance(heard, Understood):
            drive.begin(heard.text, heard.command, heard.language.code)
    drive.put("person", PERSON)
    for _ in range(STEPS):
        drive.step()
        drive.frame()
