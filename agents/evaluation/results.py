"""What came of an episode, and of many."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Result:
    """One episode.

    Attributes:
        command: what the robot was told.
        seed: of the episode.
        success: the whole command was carried out.
        verdicts: one per clause.
        collisions: how often it touched something.
        seconds: simulated time.
        path_length: of the robot's centre, metres.
        route_length: of the shortest way, metres.
        remark: what the robot believed at the end, if it found the command impossible.
    """

    command: str
    seed: int
    success: bool
    verdicts: tuple[str, ...]
    collisions: int
    seconds: float
    path_length: float
    route_length: float
    remark: str = ""

    @property
    def spl(self) -> float:
        """Success weighted by path length (Anderson et al. 2018), of this episode."""
        longest = max(self.path_length, self.route_length)
        return self.route_length / longest if self.success and longest > 0 else float(self.success)


@dataclass(frozen=True)
class Summary:
    """Many episodes of one command, or of all.

    Attributes:
        name: the command, or "all".
        episodes: how many.
        success: share.
        contact_free: share without any contact.
        spl: mean success weighted by path length.
        seconds: mean simulated time.
        failures: one line for each failed episode.
    """

    name: str
    episodes: int
    success: float
    contact_free: float
    spl: float
    seconds: float
    failures: tuple[str, ...]


def summarise(name: str, results: Sequence[Result]) -> Summary:
    """The shares and means of some episodes; there must be at least one."""
    count = len(results)
    return Summary(
        name,
        count,
        sum(r.success for r in results) / count,
        sum(r.collisions == 0 for r in results) / count,
        sum(r.spl for r in results) / count,
        sum(r.seconds for r in results) / count,
        tuple(_failure(r) for r in results if not r.success),
    )


def _failure(result: Result) -> str:
    verdicts = " / ".join(result.verdicts)
    remark = f" ({result.remark})" if result.remark else ""
    return f"seed {result.seed}: {verdicts}{remark}"
