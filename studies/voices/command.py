"""`python -m studies voices`: a person in another room answers, and the robot goes to the voice."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from semnav_agents.base import steps
from semnav_agents.searching.finder import Finder
from semnav_env.rescue import MicrophoneSettings, PersonDetectorSettings, PersonFinder
from semnav_env.rescue.environment import search_and_rescue
from semnav_env.world.dynamics import Dynamics
from semnav_env.world.dynamics.victims import victims_of
from semnav_scripts.progress import tracked
from studies.sheets import Cell, ResultSheet

FIRST_SEED = 30_000
"""Seed of the first house; nothing was tuned on houses from here on."""

COMMAND = "call and listen and go to the person you found"

MAX_SECONDS = 400.0
"""Time limit of a drive, simulated seconds."""

BLIND = PersonDetectorSettings(hit_near=0.0, hit_far=0.0, false_near=0.0, false_far=0.0, clutter=0)
"""A camera that finds nobody, as in smoke."""

EYES = {"with the camera": PersonDetectorSettings(), "by voice alone": BLIND}
"""What the robot sees with."""


@dataclass(frozen=True)
class VoiceDrive:
    """One drive.

    Attributes:
        seed: of the house and the episode.
        heard: whether the person was heard.
        error: distance of the place by voice from the person's middle, metres; NaN without one.
        std: that the robot gives for it, metres, in the least certain direction.
        seen: whether the camera has reported the person, within 1 m.
        success: whether the robot was within 2 m of the person then.
        calls: number of calls.
        contacts: begun.
        seconds: of simulated time.
    """

    seed: int
    heard: bool
    error: float
    std: float
    seen: bool
    success: bool
    calls: int
    contacts: int
    seconds: float


@dataclass(frozen=True)
class Arguments:
    """Let a robot in a hall call, and go to the person who answers, in generated houses.

    One person, who can answer, lies or sits on the floor of some room.

    Attributes:
        houses: how many.
        first: seed of the first; those below `FIRST_SEED` are for tuning.
        robot: spot or wheelchair.
        out: file of results (.jsonl), a line for each drive; none if not given.
        json: print as JSON.
    """

    houses: int = 60
    first: int = FIRST_SEED
    robot: str = "spot"
    out: Path | None = None
    json: bool = False

    def run(self) -> int:
        """Drive, and print the figures."""
        if self.houses < 1:
            raise ValueError(f"houses is {self.houses}; it must be 1 or more")
        found: dict[str, list[VoiceDrive]] = {name: [] for name in EYES}
        total = self.houses * len(EYES)
        done: list[str] = []
        for name, each in tracked(
            self._drives(), lambda n: f"{n} of {total}", lambda: len(done) / total
        ):
            done.append(name)
            found[name].append(each)
            if self.out is not None:
                with self.out.open("a", encoding="utf-8") as lines:
                    print(json.dumps({"eyes": name, **asdict(each)}), file=lines)
        sheet = figures(found)
        print(json.dumps(sheet.records()) if self.json else sheet.markdown())
        return 0

    def _drives(self) -> Iterator[tuple[str, VoiceDrive]]:
        for seed in range(self.first, self.first + self.houses):
            for name, eyes in EYES.items():
                yield name, drive(self.robot, seed, eyes)


def drive(robot: str, seed: int, eyes: PersonDetectorSettings) -> VoiceDrive:
    """Let a robot go to the voice in the house of a seed."""
    agent = Finder()
    payload = PersonFinder(eyes, microphones=MicrophoneSettings(answers=1.0))
    env = search_and_rescue(
        robot=robot,
        observation=agent.observation,
        dynamics=Dynamics(victims=1),
        payload=payload,
        max_seconds=MAX_SECONDS,
    )
    told = {"command": COMMAND, "floor_plan": f"office:house:{seed}"}
    observation, info = env.reset(seed=seed, options=told)
    for step in steps(env, agent, observation, info):
        info = step.info
    [person] = victims_of(env.floor_plan)
    voices = list(info["found"]["voices"].values())
    place = (person.centroid.x, person.centroid.y)
    return VoiceDrive(
        seed,
        bool(payload.voices),
        math.dist(voices[0]["place"], place) if voices else math.nan,
        voices[0]["std"] if voices else math.nan,
        info["search"]["found"] == 1,
        bool(info["is_success"]),
        info["found"]["calls"],
        info["collisions"],
        round(env.seconds, 1),
    )


def figures(found: dict[str, list[VoiceDrive]]) -> ResultSheet:
    """The figures of each way of seeing."""
    columns = (
        *("", "heard", "seen", "met", "placed by voice", "error, m, median", "error, m, 90 %"),
        *("within 2 std", "calls", "time, s, median", "contacts"),
    )
    return ResultSheet("Found by voice", columns, [_row(*each) for each in found.items()])


def _row(name: str, drives: Sequence[VoiceDrive]) -> tuple[Cell, ...]:
    placed = [each for each in drives if not math.isnan(each.error)]
    errors = [each.error for each in placed] or [math.nan]
    good = [each.error <= 2.0 * each.std for each in placed]
    return (
        name,
        f"{sum(each.heard for each in drives)} of {len(drives)}",
        sum(each.seen for each in drives),
        sum(each.success for each in drives),
        len(placed),
        *(float(value) for value in np.quantile(errors, (0.5, 0.9))),
        float(np.mean(good)) if good else math.nan,
        float(np.mean([each.calls for each in drives])),
        float(np.median([each.seconds for each in drives])),
        sum(each.contacts for each in drives),
    )
