"""The cause of a failed episode, in words."""

from __future__ import annotations

from semnav_env.judge import Judge, Verdict
from semnav_env.judge.metrics import Metrics
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
    words = [what_happened(judge)]
    if impossible:
        words.append(f"robot: {impossible}")
    words.append(f"{metrics.goal_distance:.1f} m from the goal")
    if metrics.collisions:
        words.append(f"{metrics.collisions} collisions")
    return "; ".join(words)


def what_happened(judge: Judge) -> str:
    """What the robot did instead of the clause in which an episode failed."""
    goal = judge.follower.goal
    match judge.failure:
        case Verdict.WRONG_DOOR:
            return f"crossed {judge.crossed[-1]}, {_instead(goal)}"
        case Verdict.WRONG_TURN:
            return f"left by another arm or went past, {_instead(goal)}"
        case Verdict.INCOMPLETE:
            return f"not done in full: {judge.mission.command.clauses[judge.clause]}"
        case _:
            return f"not done: {goal.because}"


def _instead(goal: Goal) -> str:
    wanted = door_of(goal)
    door = f" ({wanted.name})" if wanted is not None and wanted.name else ""
    return f"wanted: {goal.because}{door}"
