"""A command that somebody gave, kept as an episode."""

from __future__ import annotations

from semnav_env.judge.episodes.episode import Episode
from semnav_env.judge.episodes.fingerprint import fingerprint
from semnav_env.language import Command
from semnav_env.world.maps import FloorPlan
from semnav_features.frames import FloatArray, Pose


def said_episode(
    name: str,
    floor_plan: tuple[str, FloorPlan],
    start: Pose,
    said: tuple[str, str, Command],
    route: FloatArray,
) -> Episode:
    """The episode that began when somebody gave a command.

    Args:
        name: its id, whose number is the seed of its noise, such as "page-00003".
        floor_plan: name or path by which the floor plan is found again, and the plan.
        start: pose of the robot's centre, world frame.
        said: text and language of the command, and what it means.
        route: the true route, metres, shape (n, 2).
    """
    plan_name, plan = floor_plan
    text, language, command = said
    episode = Episode(
        id=name,
        floor_plan=plan_name,
        plan_hash=plan.derived(fingerprint),
        start=start,
        command=text,
        language=language,
        readings=(command.say(language),),
        route=tuple((float(x), float(y)) for x, y in route),
        programs=(command,),
    )
    return episode.understood(plan.room_names)
