"""The cause of a failed episode, in words."""

from __future__ import annotations

from semnav_env.judge import Judge, Verdict
from semnav_env.judge.metrics import Metrics
from semnav_env.language.told import Told
from semnav_env.mind.grounding.goal import Goal, door_of


def cause_of(judge: Judge, metrics: Metrics, impossible: str | None) -> str:
    """The cause of a failure, in words; empty after success.

    Args:
        judge: the judge of the episode.
        metrics: of the episode.
        impossible: why the robot believed that the command is impossible; None if it did not.
    """
    if judge.success:
        return ""
    words: list[str] = [what_happened(judge)]
    if impossible:
        words.append(f"robot: {impossible}")
    words.append(f"{metrics.goal_distance:.1f} m from the goal")
    if metrics.collisions:
        words.append(f"{metrics.collisions} collisions")
    return "; ".join(words)


def what_happened(judge: Judge) -> Told:
    """What the robot did instead of the clause in which an episode failed."""
    goal = judge.follower.goal
    match judge.failure:
        case Verdict.WRONG_DOOR:
            return Told("crossed {door}, {instead}", door=judge.crossed[-1], instead=_instead(goal))
        case Verdict.WRONG_TURN:
            return Told("left by another arm or went past, {instead}", instead=_instead(goal))
        case Verdict.INCOMPLETE:
            clause = judge.mission.command.clauses[judge.clause]
            return Told("not done in full: {what}", what=clause)
        case _:
            return Told("not done: {what}", what=goal.because)


def _instead(goal: Goal) -> Told:
    wanted = door_of(goal)
    door = f" ({wanted.name})" if wanted is not None and wanted.name else ""
    return Told("wanted: {what}{door}", what=goal.because, door=door)
