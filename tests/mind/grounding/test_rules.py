"""The rules of reference: every row of rules.json, on true scenes and on what a robot sees."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from itertools import pairwise

import numpy as np
import pytest

from semnav_env.judge import plan_goals
from semnav_env.judge.routes.route import Route
from semnav_env.language import parse
from semnav_env.mind.belief import BeliefTracker
from semnav_env.mind.grounding import GroundingError
from semnav_env.mind.grounding.goal import door_of
from semnav_env.robots import WHEELCHAIR
from semnav_env.rules import GroundingRules
from semnav_env.world.lidar import Lidar
from semnav_features.frames import Point, Pose, compose, relative, to_parent
from tests.support.paths import ROOT
from tests.support.situations import ROWS, Row, situation


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.id)
def test_a_command_means_what_the_table_says(row: Row) -> None:
    plan, command = situation(row.situation), parse(row.command)
    if isinstance(row.expected, str) and " " in row.expected:
        with pytest.raises(GroundingError, match=re.escape(row.expected)):
            plan_goals(plan, command, row.begin)
        return
    goal = plan_goals(plan, command, row.begin)[-1]
    if isinstance(row.expected, str):
        door = door_of(goal)
        assert door is not None
        assert door.name == row.expected
    else:
        assert math.dist(goal.pose[:2], row.expected) < 0.15


def test_the_documentation_speaks_of_every_row() -> None:
    pages = ("commands", "which_doors", "implicit_steps")
    text = "".join((ROOT / "docs" / "concepts" / f"{page}.md").read_text("utf-8") for page in pages)
    named = set(re.findall(r"\b[DCFWKOJBRNE]\d+\b", text))
    assert named == {row.id for row in ROWS}


UNSEEN = {"W1"}
"""Its door is beside the start, and the near jamb behind what the lidar sees."""

DOORS = [row for row in ROWS if isinstance(row.expected, str) and " " not in row.expected]
SIGHTED = [row for row in DOORS if row.id not in UNSEEN]


def way(row: Row) -> Iterator[Pose]:
    """The poses of a robot that drives along the true goals and stops before the last door.

    Where doors are counted from the end it has a look at the end first.
    """
    *goals, last = plan_goals(situation(row.situation), parse(row.command), row.begin)
    stops = [pose for goal in goals for pose in (goal.onward or goal.pose, goal.pose)]
    if last.corridor is not None and re.search("last|other", row.command):
        stops.append(last.corridor.place(last.corridor.end - 1.0))
    stops.append(compose(last.pose, (-GroundingRules().stand_off - 0.3, 0.0, 0.0)))
    for here, there in pairwise([row.begin, *stops]):
        if math.dist(here[:2], there[:2]) > 0.1:
            route = Route(here, np.array([here[:2], there[:2]]), there[2])
            yield from map(tuple, route.poses.tolist())


def made_out(row: Row) -> list[Point]:
    """The middles of the doors that such a robot takes for the one meant, as it goes."""
    plan, command = situation(row.situation), parse(row.command)
    lidar = Lidar(plan, mount=WHEELCHAIR.lidar_mount)
    tracker = BeliefTracker(lidar.spec, lidar.mount)
    tracker.begin(command)
    doors = []
    for step, pose in enumerate(way(row)):
        ranges = lidar.ranges(pose, (0, 0, step))
        belief = tracker.update(ranges, relative(row.begin, pose), (0.75, 0.0, 0.0))
        door = door_of(belief.goal)
        if belief.clause == len(command.clauses) - 1 and door is not None:
            doors.append(to_parent(row.begin, door.midpoint))
    return doors


@pytest.mark.parametrize("row", SIGHTED, ids=lambda row: row.id)
def test_a_robot_that_sees_it_means_that_door_and_never_another(row: Row) -> None:
    doors, meant = made_out(row), situation(row.situation).door(row.expected)
    assert doors
    assert max(math.dist(door, meant.midpoint) for door in doors) < 0.35
