"""The results of episodes, and their summaries."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field

from semnav_agents.evaluation.intervals import wilson_interval
from semnav_agents.evaluation.kept_drive import KeptDrive
from semnav_env.judge import FAILURES
from semnav_env.judge.metrics import WORST_SHARES, Metrics, means, worst
from semnav_env.world.dynamics.social import for_json

INTERVAL_MEASURES = ("success", "contact_free")
"""Measures that are shares of episodes, and so have an interval."""


@dataclass(frozen=True)
class Result:
    """The result of one episode.

    Attributes:
        command: what the robot was told.
        seed: of the episode.
        verdicts: one for each clause.
        metrics: all measures.
        cause: why it failed, in words; empty after success.
        rechecked: verdict of the second opinion if it differs from the judge's; else empty.
        social: how near people came, see `SocialRecord.outcome`; empty without people.
        episode: id of a frozen episode; otherwise empty.
        group: name under which it is counted.
        kind: kind of the clause that failed, such as "Turn".
        floor_plan: name of the plan.
        kept: the drive itself, of failures and if `Extras` asks for it; no part of a row.
    """

    command: str
    seed: int
    verdicts: tuple[str, ...]
    metrics: Metrics
    cause: str = ""
    rechecked: str = ""
    social: dict[str, float] = field(default_factory=dict)
    episode: str = ""
    group: str = ""
    kind: str = ""
    floor_plan: str = ""
    kept: KeptDrive | None = None

    @property
    def success(self) -> bool:
        """Whether the whole command was carried out."""
        return self.metrics.success

    def row(self) -> dict[str, object]:
        """The result as one flat object, for a line of a file."""
        first = {"floor_plan": self.floor_plan, "command": self.command, "seed": self.seed}
        told = {"verdicts": self.verdicts} | ({"episode": self.episode} if self.episode else {})
        last = {"cause": self.cause, "rechecked": self.rechecked}
        return {**first, **told, **for_json(asdict(self.metrics) | self.social), **last}


@dataclass(frozen=True)
class LeftOut:
    """An episode that is not driven: its command is void where doors and furniture have changed.

    Attributes:
        command: what the robot was to be told.
        seed: of the episode.
        why: what the command lacks.
        episode: id of a frozen episode; otherwise empty.
    """

    command: str
    seed: int
    why: str
    episode: str = ""

    def row(self) -> dict[str, object]:
        """As one flat object, for a line of a file; it has none of the measures."""
        named = {"episode": self.episode} if self.episode else {}
        return {"command": self.command, "seed": self.seed, **named, "left_out": self.why}


@dataclass(frozen=True)
class Summary:
    """The measures of the episodes of a group, or of all.

    Attributes:
        name: of the group, or "all".
        episodes: number of episodes.
        means: mean of each measure, by its name.
        worst: mean of each measure over its worst episodes, one dictionary for each of
            `metrics.WORST_SHARES`.
        failures: the failed episodes.
        disagreements: number of episodes that the second opinion judges otherwise.
        left_out: number of episodes that could not begin, and count in no measure.
    """

    name: str
    episodes: int
    means: dict[str, float]
    worst: tuple[dict[str, float], ...]
    failures: tuple[Result, ...]
    disagreements: int
    left_out: int = 0

    @property
    def intervals(self) -> dict[str, tuple[float, float]]:
        """Wilson's interval of 95 % of each share of episodes, by the name of the measure."""
        return {n: wilson_interval(self.means[n], self.episodes) for n in INTERVAL_MEASURES}

    def row(self) -> dict[str, object]:
        """The summary as one object: means by name, then means of the worst episodes by share."""
        return {
            "name": self.name,
            "episodes": self.episodes,
            "left_out": self.left_out,
            **for_json(self.means),
            "intervals": self.intervals,
            "cvar": {
                f"{share:.0%}": for_json(row)
                for share, row in zip(WORST_SHARES, self.worst, strict=True)
            },
            "failures": [failure_line(result) for result in self.failures],
            "disagreements": self.disagreements,
        }


def summarise(name: str, results: Sequence[Result], left_out: int = 0) -> Summary:
    """The summary of some results, of which there must be at least one.

    Args:
        name: of the group.
        results: of the episodes that were driven.
        left_out: number of those that were not.
    """
    measured = [result.metrics for result in results]
    return Summary(
        name,
        len(results),
        means(measured),
        tuple(worst(measured, share) for share in WORST_SHARES),
        tuple(result for result in results if not result.success),
        sum(bool(result.rechecked) for result in results),
        left_out,
    )


def failure_line(result: Result) -> str:
    """A failed episode in one line: its id or seed, the verdicts and the cause."""
    which = f'{result.episode} "{result.command}"' if result.episode else f"seed {result.seed}"
    return f"{which}: {' / '.join(result.verdicts)} ({result.cause})"


def common_causes(results: Sequence[Result]) -> list[tuple[str, int]]:
    """Verdict and kind of clause of the failures, with their counts, the most common first."""
    failed = (result for result in results if not result.success)
    return Counter(short_cause(result) for result in failed).most_common()


def short_cause(result: Result) -> str:
    """Verdict and kind of the clause that failed, in words."""
    verdict = next((verdict for verdict in result.verdicts if verdict in FAILURES), "answered")
    words = re.sub("(?<=[a-z])(?=[A-Z])", " ", result.kind).lower()
    return f'{verdict}, clause "{words}"' if words else verdict
