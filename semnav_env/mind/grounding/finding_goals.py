"""The goals of clauses to find people.

Where people are is not known beforehand, so each clause ends when the robot stands still for a
while: thereby it says that it has finished. Whether it has done what was said is for the payload to
judge, see `semnav_env.rescue.PersonFinder`.
"""

from __future__ import annotations

from semnav_env.language.clauses import Clause, GoToRoom
from semnav_env.language.finding_clauses import CallOut, LookAround, SearchHouse, SearchRoom
from semnav_env.language.told import told
from semnav_env.mind.grounding.goal import Goal, StopGoal
from semnav_env.mind.grounding.goals import way_goal
from semnav_env.mind.grounding.situation import Situation


def finding_goal(clause: Clause, situation: Situation) -> Goal:
    """The goal of a clause to find people.

    Of a named room it is first to go in, and then to search; see `Follower`. Through doors leads a
    search, or the way to a person, but not a look around, nor a call.

    Raises:
        GroundingError: the robot has not been told the way to the room.
    """
    if isinstance(clause, SearchRoom) and clause.room is not None and not situation.inside:
        return way_goal(GoToRoom(clause.room.name), situation)
    rules = situation.rules.success
    searches = isinstance(clause, SearchHouse | SearchRoom)
    rest = rules.search_rest_seconds if searches else rules.finding_rest_seconds
    stays = isinstance(clause, LookAround | CallOut)
    return StopGoal(situation.begin, told(clause), rest, roams=not stays)
