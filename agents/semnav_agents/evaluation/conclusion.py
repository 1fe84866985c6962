"""The result of a driven episode, and the files about it that are wanted."""

from __future__ import annotations

import re
import zlib
from dataclasses import dataclass
from pathlib import Path

from semnav_agents.evaluation.drive import Drive
from semnav_agents.evaluation.results import Result, failure_line

MAX_NAME_LENGTH = 90
"""Characters of a command in the name of a picture; file names end at 255 bytes."""


@dataclass(frozen=True)
class Extras:
    """Further outputs of a driven episode.

    Attributes:
        recheck: judge it a second time, by other code.
        pictures: folder for a picture of each failure.
        films: folder for a film of each failure, for which it is driven a second time.
        keep: keep the drive of each failure, `Result.kept`.
    """

    recheck: bool = False
    pictures: Path | None = None
    films: Path | None = None
    keep: bool = False


NO_EXTRAS = Extras()
"""No further outputs: only drive and measure."""


def conclude(
    driven: Drive,
    command: str,
    seed: int,
    extras: Extras = NO_EXTRAS,
    *,
    episode: str = "",
    group: str = "",
) -> Result:
    """The result of a driven episode, with a second opinion and a picture of a failure if wanted.

    Args:
        driven: the episode.
        command: name of the command in the results.
        seed: of the episode.
        extras: what else to do.
        episode: id of a frozen episode; otherwise empty.
        group: name under which it is counted; the command if empty.
    """
    result = Result(
        command=command,
        seed=seed,
        verdicts=tuple(str(verdict) for verdict in driven.judge.verdicts),
        metrics=driven.metrics,
        cause=driven.cause,
        rechecked=driven.rechecked() if extras.recheck else "",
        social=driven.social,
        episode=episode,
        group=group or command,
        kind=driven.kind,
        floor_plan=driven.judge.mission.floor_plan.name,
        kept=driven.kept() if extras.keep and not driven.metrics.success else None,
    )
    if extras.pictures is not None and not result.success:
        name = file_stem(driven, episode or command, seed)
        said = failure_line(result)
        driven.save_picture(
            extras.pictures / f"{name}.png", said if episode else f"{command}: {said}"
        )
    return result


def file_stem(driven: Drive, command: str, seed: int) -> str:
    """The name of files about an episode; a long command is cut and gets a checksum."""
    words = re.sub("[^a-z0-9]+", "_", command.lower()).strip("_")
    if len(words) > MAX_NAME_LENGTH:
        words = f"{words[:MAX_NAME_LENGTH]}_{zlib.crc32(command.encode()):08x}"
    return f"{driven.judge.mission.floor_plan.name}-{words}-{driven.robot.name}-seed{seed}"
