"""`semnav follow`: the belief of a robot that follows a command on a recorded log."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from functools import cached_property
from itertools import islice
from pathlib import Path
from typing import Any

from tyro.conf import OmitArgPrefixes, Positional

from semnav_env.language import Command
from semnav_env.language.language import Language
from semnav_env.language.told import in_words_of
from semnav_env.language.vocabulary.recognition import language_of_text
from semnav_env.mind.belief import Belief
from semnav_env.mind.belief.log_following import PoseChoice, follow_log
from semnav_features import ExtractorSettings
from semnav_features.frames import Pose
from semnav_features.mapping import ScanOdometry
from semnav_features.mapping.matched_log import loss_of
from semnav_features.plot import check_suffix
from semnav_features.readers import Geometry, LogCheck, LogRecord, TruncatedLogError, open_log
from semnav_features.readers.log_check import PoseSource
from semnav_scripts.arguments import parse_pose
from semnav_scripts.ground import understood
from semnav_scripts.outputs import check_distinct, check_file
from semnav_scripts.printable import printable
from semnav_scripts.progress import tracked
from semnav_scripts.recording.mcap_file import mcap_writer
from semnav_scripts.recording.moment import MomentWriter, moment_of
from semnav_scripts.recording.rerun_file import rerun_writer
from semnav_scripts.scene_report import bad_text, print_notes


@dataclass(frozen=True)
class Arguments:
    """Follow a command on a recorded log, with the belief tracker of the environment.

    The robot gets the command at the first scan. Each line is a moment in which its clause or its
    goal changed. Poses are in the odom frame, whose origin is the pose at the first scan. The exit
    code is 0 if the robot believes in the end that it has carried out the whole command, and 1 if
    not, or if so many scans found no match that its poses are unreliable. A truncated log is
    followed up to its last complete scan; the exit code is then 2. Notes on stderr name possible
    errors of the log.

    Attributes:
        log: the log: a file, or the folder of a ROS 2 bag; see `semnav extract --help`.
        command: the command; it cannot name rooms, because a log does not say where they are.
        language: of the command: en or de (english, german); recognised if not given.
        mount: pose of the lidar on the robot, x,y,heading in metres and radians.
        poses: source of the robot's poses: "log" takes the poses of the log, "odometry" its wheel
            odometry, and "match" matches each scan with the earlier ones, with wheel odometry as a
            guess if the log has it; odometry, or else the log's poses, if not given.
        topic: of the scans in a bag, such as /scan; not needed if there is only one.
        first: number of the first scan, from 1.
        limit: stop after this number of scans.
        geometry: values of the scans that the log does not contain.
        plot: picture of the memory at the end (.png, .pdf or .svg).
        rerun: recording for the viewer of Rerun to write (.rrd).
        mcap: recording for Foxglove to write (.mcap).
        settings: limits of the extractor, metres and radians.
        json: print one JSON object a line.
    """

    log: Positional[Path]
    command: Positional[str]
    language: str | None = None
    mount: str = "0,0,0"
    poses: PoseChoice | None = None
    topic: str | None = None
    first: int = 1
    limit: int | None = None
    geometry: OmitArgPrefixes[Geometry] = field(default_factory=Geometry)
    plot: Path | None = None
    rerun: Path | None = None
    mcap: Path | None = None
    settings: ExtractorSettings = field(default_factory=ExtractorSettings)
    json: bool = False

    def run(self) -> int:
        """Follow the command, and print the changes of the belief."""
        command, mount = understood(self.command, self.language, ()), parse_pose(self.mount)
        for name in ("first", "limit"):
            value = getattr(self, name)
            if value is not None and value < 1:
                raise ValueError(f"--{name} is {value}; it must be at least 1")
        outputs = {"--plot": self.plot, "--rerun": self.rerun, "--mcap": self.mcap}
        check_distinct({"the log": self.log, **outputs})
        for option, path in outputs.items():
            check_file(path, option)
        if self.plot is not None:
            check_suffix(self.plot)
        matcher = ScanOdometry()
        beliefs, damage = self._follow(command, mount, matcher)
        done = beliefs[-1].clause
        if not self.json:
            print(f"believed to be done: {done} of {len(command.clauses)} clauses")
        if self.plot is not None:
            from semnav_env.rendering.belief_picture import save_beliefs

            save_beliefs(self.plot, beliefs, len(command.clauses), str(command))
        for path in outputs.values():
            if path is not None and not self.json:
                print(f"wrote {path}")
        if damage:
            raise damage
        if loss := loss_of(matcher, len(beliefs)):
            print(loss, file=sys.stderr)
        return 0 if done == len(command.clauses) and not loss else 1

    def _follow(
        self, command: Command, mount: Pose, matcher: ScanOdometry
    ) -> tuple[list[Belief], TruncatedLogError | None]:
        """Print each change of the belief; returns all beliefs and the error of a truncated log."""
        beliefs: list[Belief] = []
        damage: TruncatedLogError | None = None
        with self._writers() as writers, open_log(self.log, self.geometry, self.topic) as log:
            stop = None if self.limit is None else self.first - 1 + self.limit
            check = LogCheck(log.unit, _WATCHED[self.poses])
            records = check.watched(islice(log, self.first - 1, stop))
            options: Any = {"mount": mount, "extractor": self.settings, "poses": self.poses}
            followed = follow_log(records, command, matcher=matcher, **options)
            try:
                for record, belief in tracked(
                    followed, lambda n: f"{n} scans", lambda: log.fraction
                ):
                    if not beliefs or _mind(belief) != _mind(beliefs[-1]):
                        print(self._line(record, belief, command))
                    for writer in writers:
                        writer.write(moment_of(record, belief, command, mount, len(beliefs)))
                    beliefs.append(belief)
            except TruncatedLogError as error:
                damage = error
            if log.bad:
                print(printable(bad_text(log)), file=sys.stderr)
            print_notes(check.notes())
        if not beliefs:
            raise damage or ValueError(f"{self.log} has no scan {self.first}")
        return beliefs, damage

    @contextmanager
    def _writers(self) -> Iterator[list[MomentWriter]]:
        """The writers of the recordings that are wanted."""
        with ExitStack() as open_files:
            writers: list[MomentWriter] = []
            if self.rerun is not None:
                writers.append(open_files.enter_context(rerun_writer(self.rerun)))
            if self.mcap is not None:
                writers.append(open_files.enter_context(mcap_writer(self.mcap)))
            yield writers

    @cached_property
    def _spoken(self) -> Language:
        """The language of the command."""
        return language_of_text(self.command, self.language)

    def _line(self, record: LogRecord, belief: Belief, command: Command) -> str:
        clauses = command.clauses
        over = belief.clause >= len(clauses)
        said: dict[str, Any] = {
            "scan": record.line,
            "stamp": record.stamp,
            "pose": [round(value, 3) for value in belief.pose],
            "clause": belief.clause + 1,
            "text": "" if over else clauses[belief.clause].say(self._spoken),
            "goal": belief.goal.kind.name.lower(),
            "goal_pose": [round(value, 3) for value in belief.goal.pose],
            "reasons": [in_words_of(self._spoken, reason) for reason in belief.reasons],
        }
        if self.json:
            return json.dumps(said)
        x, y, _ = belief.pose
        at = f"scan {record.line:>6}  at {x:7.2f} {y:7.2f}"
        if over:
            return f"{at}  all clauses done"
        return f"{at}  clause {said['clause']}  {said['goal']:<5} {'; '.join(said['reasons'])}"


_WATCHED: dict[PoseChoice | None, tuple[PoseSource, ...]] = {
    "log": ("pose",),
    "odometry": ("odometry",),
    "match": ("odometry",),
    None: ("pose", "odometry"),
}
"""Fields of a record that are checked for errors, by the source of the poses."""


def _mind(belief: Belief) -> tuple[int, str, tuple[str, ...]]:
    """The part of a belief whose changes are printed."""
    return belief.clause, belief.goal.kind.name, belief.reasons
