"""The files that a visitor keeps of a scene: its floor plan, its command, its film."""

from __future__ import annotations

import json
import re

from semnav_env.judge.episodes import Episode
from semnav_env.judge.episodes.files import PLAN_SUFFIX, to_line
from semnav_env.judge.episodes.said import said_episode
from semnav_env.world.maps import FloorPlan
from semnav_env.world.maps.writer import to_geojson
from semnav_scripts.page.drive import PageDrive
from semnav_scripts.page.film import gif
from semnav_scripts.page.requests import OWN


def kept_file(what: str, drive: PageDrive) -> bytes:
    """A file of a scene, as `with_name` sends it.

    Args:
        what: "film", "episode" or "plan".
        drive: the scene and its last run.

    Raises:
        ValueError: no command has been carried out there, of which film or episode could be.
        ImportError: a film needs the extra "render".
    """
    if what == "plan":
        return plan_file(drive.floor_plan)
    if what == "film":
        return with_name("semnav.gif", gif(drive.frames, drive.control_hz))
    return with_name("episode.jsonl", to_line(_episode(drive)).encode())


def plan_file(plan: FloorPlan) -> bytes:
    """A floor plan as a file."""
    return with_name(_file_name(plan), to_geojson(plan).encode())


def with_name(name: str, content: bytes) -> bytes:
    """A binary message: a line with the name of a file in JSON, then its content."""
    return json.dumps({"name": name}).encode() + b"\n" + content


def _episode(drive: PageDrive) -> Episode:
    """The command of the last run as an episode, whose number is the seed."""
    if drive.said is None:
        raise ValueError("there is no episode yet; give a command first")
    plan, scene = drive.floor_plan, drive.scene
    is_listed = scene.plan != OWN and not scene.boxes
    named = scene.plan if is_listed else _file_name(plan), plan
    route = drive.env.judge.mission.route
    return said_episode(f"page-{scene.seed:05d}", named, drive.start, drive.said, route)


def _file_name(plan: FloorPlan) -> str:
    """The name of a plan's file; only characters that every system takes."""
    return (re.sub(r"[^A-Za-z0-9_-]+", "_", plan.name).strip("_") or "plan") + PLAN_SUFFIX
