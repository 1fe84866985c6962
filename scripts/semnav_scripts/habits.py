"""`semnav habits`: how drivers pass doorways, in recorded logs and in episodes."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, field
from itertools import chain, islice
from pathlib import Path
from typing import Literal

import numpy as np
from rich.console import Console
from rich.table import Table
from tyro.conf import OmitArgPrefixes, Positional

from semnav_agents.evaluation.drive import drive
from semnav_agents.evaluation.jobs import EPISODE_SECONDS
from semnav_agents.registry import make_agent
from semnav_env.env import SemNavEnv
from semnav_env.judge.episodes import Episode, evenly, load_episodes
from semnav_features import ExtractorSettings, extract
from semnav_features.door_passages import DoorPassage, door_passages, driving_habits
from semnav_features.frames import ORIGIN, compose, relative
from semnav_features.mapping import LineMap, ScanOdometry
from semnav_features.mapping.matched_log import matched
from semnav_features.plot import check_suffix
from semnav_features.readers import Geometry, LogError, LogRecord, open_log
from semnav_scripts.arguments import parse_pose
from semnav_scripts.outputs import check_file
from semnav_scripts.playing.kept_runs import EPISODES, passages_of_runs
from semnav_scripts.progress import tracked


@dataclass(frozen=True)
class Arguments:
    """Measure how drivers pass doorways: angle, lateral offset, speed, corrections.

    Give recorded logs, episodes, or both: each log is one driver, and so is each agent. The doors
    of a log are those of a map that is built from its scans; those of an episode are the plan's.

    Attributes:
        logs: logs, as `semnav extract` reads them, and runs that `semnav play --out` kept.
        episodes: a split (`semnav episodes list`), or a file of episodes, for agents to drive.
        agents: the drivers of the episodes, as `semnav evaluate --agent` takes them.
        robot: their body, wheelchair or spot.
        count: number of episodes, evenly spaced.
        poses: source of the robot's poses in a log: "log", or "match" for matching the scans.
        mount: pose of the lidar on the robot, x,y,heading in metres and radians.
        limit: number of scans of each log; all if not given.
        geometry: values of the scans that a log does not contain.
        topic: of the scans in a bag, such as /scan.
        plot: picture of all passages, a panel for each driver (.png, .pdf or .svg).
        json: print one JSON object: for each driver its habits and its passages.
    """

    logs: Positional[tuple[Path, ...]] = ()
    episodes: str | None = None
    agents: tuple[str, ...] = ("scripted", "drive")
    robot: str = "wheelchair"
    count: int = 40
    poses: Literal["log", "match"] = "log"
    mount: str = "0,0,0"
    limit: int | None = None
    geometry: OmitArgPrefixes[Geometry] = field(default_factory=Geometry)
    topic: str | None = None
    plot: Path | None = None
    json: bool = False

    def run(self) -> int:
        """Measure and print; 1 if nobody passed a doorway."""
        self._check()
        drivers = {log.name: self._of_log(log) for log in self.logs}
        if self.episodes is not None:
            chosen = evenly(load_episodes(self.episodes), self.count)
            drivers |= {agent: self._of_agent(agent, chosen) for agent in self.agents}
        if self.plot is not None:
            from semnav_features.plot_passages import save_passages  # matplotlib only when wanted

            save_passages(self.plot, drivers)
        if self.json:
            print(json.dumps({name: _document(passages) for name, passages in drivers.items()}))
        else:
            Console().print(_table(drivers))
            if self.plot is not None:
                print(f"wrote {self.plot}")
        return 0 if any(drivers.values()) else 1

    def _check(self) -> None:
        if not self.logs and self.episodes is None:
            raise ValueError("give a log, or --episodes with a split such as val_unseen")
        if self.count < 1:
            raise ValueError(f"--count is {self.count}; it must be at least 1")
        if self.limit is not None and self.limit < 1:
            raise ValueError(f"--limit is {self.limit}; it must be at least 1")
        check_file(self.plot, "--plot")
        if self.plot is not None:
            check_suffix(self.plot)

    def _of_log(self, path: Path) -> tuple[DoorPassage, ...]:
        """The passages of whoever drove when a log was recorded."""
        if path.name == EPISODES:
            return passages_of_runs(path)
        mount, settings = parse_pose(self.mount), ExtractorSettings()
        robot_from_lidar = relative(mount, ORIGIN)
        line_map, poses, seconds = LineMap(), [], []
        with open_log(path, self.geometry, self.topic) as log:
            records = islice(log, 0, self.limit)
            placed = (
                matched(records, ScanOdometry(), mount)
                if self.poses == "match"
                else map(_as_logged, records)
            )
            for record, pose in tracked(placed, lambda n: f"{n} scans", lambda: log.fraction):
                line_map.add(extract(record.scan, settings), record.scan, pose)
                poses.append(compose(pose, robot_from_lidar))
                seconds.append(math.nan if record.stamp is None else record.stamp)
        driven = np.array(poses, dtype=float).reshape(-1, 3)
        return door_passages(driven, np.array(seconds, dtype=float), line_map.doors)

    def _of_agent(self, name: str, episodes: Sequence[Episode]) -> tuple[DoorPassage, ...]:
        """The passages of an agent over all episodes."""
        found: list[tuple[DoorPassage, ...]] = []
        total = len(episodes)
        for passages in tracked(
            self._driven(name, episodes),
            lambda n: f"{name}: {n} of {total}",
            lambda: len(found) / total,
        ):
            found.append(passages)
        return tuple(chain.from_iterable(found))

    def _driven(self, name: str, episodes: Sequence[Episode]) -> Iterator[tuple[DoorPassage, ...]]:
        agent = make_agent(name)
        env = SemNavEnv(self.robot, observation=agent.observation, max_seconds=EPISODE_SECONDS)
        for episode in episodes:
            with episode.named_in_errors():
                driven = drive(env, agent, episode.number, {"episode": episode})
            yield driven.passages()


def _as_logged(record: LogRecord) -> tuple[LogRecord, tuple[float, float, float]]:
    if record.pose is None:
        raise LogError("the log has no poses; find them with --poses match")
    return record, record.pose


def _document(passages: Sequence[DoorPassage]) -> dict[str, object]:
    habits = asdict(driving_habits(passages))
    told = {k: None if isinstance(v, float) and math.isnan(v) else v for k, v in habits.items()}
    return {"habits": told, "passages": [passage.row() for passage in passages]}


def _table(drivers: dict[str, tuple[DoorPassage, ...]]) -> Table:
    table = Table(title="passages through doorways: median, and 90th percentile")
    table.add_column("driver")
    for column in ("passages", "angle, deg", "offset, cm", "speed, m/s", "corrections"):
        table.add_column(column, justify="right")
    for name, passages in drivers.items():
        h = driving_habits(passages)
        angle, angle_90 = math.degrees(h.angle), math.degrees(h.angle_90)
        table.add_row(
            name,
            str(h.passages),
            f"{angle:.1f}, {angle_90:.1f}",
            f"{100 * h.offset:.1f}, {100 * h.offset_90:.1f}",
            f"{h.speed:.2f}",
            f"{h.corrections:.2f}",
        )
    return table
