"""Checks starts, meanings and feasibility of frozen episodes again."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from semnav_env.judge.episodes.episode import Episode, Expected, StaleEpisodeError
from semnav_env.judge.readings import answers
from semnav_env.language import Command, CommandError, parse
from semnav_env.language.corpora.meanings import key_of
from semnav_env.mind.grounding import GroundingError
from semnav_env.robots import ROBOTS
from semnav_env.world.maps import FloorPlan
from semnav_env.world.maps.geodesic import Geodesic
from semnav_env.world.maps.placement import placement_error


def faults(episodes: Iterable[Episode]) -> Iterator[tuple[Episode, tuple[str, ...]]]:
    """Yield every episode with its faults; most episodes have none."""
    plan: FloorPlan | None = None
    geodesic: Geodesic | None = None
    for episode in episodes:
        try:
            found = episode.plan()
        except StaleEpisodeError as error:
            yield episode, (str(error),)
            continue
        if geodesic is None or found is not plan:
            plan, geodesic = found, found.derived(Geodesic)
        yield episode, tuple(_faults(episode, found, geodesic))


def _faults(episode: Episode, plan: FloorPlan, geodesic: Geodesic) -> Iterator[str]:
    for robot in ROBOTS.values():
        problem = placement_error(plan, robot, episode.start)
        if problem is not None:
            yield f"{episode.id}: {problem}"
    meanings = episode.meanings()
    anew = replace(episode, programs=(), token_rows=()).understood(plan.room_names)
    if episode.programs not in ((), anew.programs):
        yield f"{episode.id}: its programs are not what its readings mean"
    if episode.token_rows not in ((), anew.token_rows):
        yield f"{episode.id}: its tokens are not those of its first reading"
    meant = _taken_for(episode, plan)
    if meant and key_of(meant) not in map(key_of, meanings):
        said = meant.say(episode.language)
        yield f'{episode.id}: "{episode.command}" now means "{said}"'
    for command in meanings:
        try:
            answers(plan, geodesic, command, episode.start)
            impossible = ""
        except GroundingError as error:
            impossible = str(error)
        if bool(impossible) != (episode.expected is Expected.INFEASIBLE):
            yield f"{episode.id}: {impossible or 'it can be carried out'}"


def _taken_for(episode: Episode, plan: FloorPlan) -> Command | None:
    """What a robot that hears the words does; None if it asks, or refuses them."""
    try:
        return parse(episode.command, episode.language, plan.room_names)
    except CommandError:
        return None
