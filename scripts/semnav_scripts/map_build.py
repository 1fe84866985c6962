"""`semnav map build`: build a floor plan from a log of lidar scans."""

from __future__ import annotations

import json
import sys
from dataclasses import dataclass, field
from itertools import islice
from pathlib import Path
from typing import Literal

from tyro.conf import OmitArgPrefixes, Positional

from semnav_env.world.maps import FloorPlan, save_floor_plan
from semnav_env.world.maps.line_map_plan import plan_of_scene
from semnav_features import ExtractorSettings, extract
from semnav_features.frames import Pose
from semnav_features.mapping import KeyframeRule, LineMap, MapSettings, ScanOdometry
from semnav_features.mapping.matched_log import loss_of, matched
from semnav_features.plot import check_suffix
from semnav_features.readers import (
    Geometry,
    LogCheck,
    LogRecord,
    ScanLog,
    TruncatedLogError,
    open_log,
)
from semnav_scripts.arguments import parse_pose
from semnav_scripts.outputs import check_distinct, check_file
from semnav_scripts.progress import tracked
from semnav_scripts.scene_report import bad_text, print_notes


@dataclass(frozen=True)
class Arguments:
    """Build a floor plan of walls and doors from a log of lidar scans.

    It reads the same logs as `semnav extract`. A truncated log is mapped up to its last
    complete scan; the exit code is then 2. It is 1 if so many scans found no match that the plan is
    unreliable. Notes on stderr name possible errors of the log.

    Attributes:
        log: the log: a file, or the folder of a ROS 2 bag.
        out: the floor plan to write (.geojson).
        topic: of the scans in a bag, such as /scan; not needed if there is only one.
        poses: source of the scans' poses: "log" takes the poses of the log; "match" matches each
            scan with the earlier ones, corrects the drift by walls and landmarks that are seen
            again, starts at (0, 0, 0), and uses wheel odometry if the log has it.
        mount: pose of the lidar on the robot, x,y,heading in metres and radians, by which wheel
            odometry becomes the motion of the lidar; only for "match".
        every: take only every Nth scan.
        limit: stop after this number of scans.
        picture: of the plan (.png, .pdf or .svg).
        geometry: values of the scans that the log does not contain.
        settings: limits of the extractor, metres and radians.
        map_settings: limits of the map, metres and radians.
        json: print the summary as JSON on stdout.
    """

    log: Positional[Path]
    out: Path
    topic: str | None = None
    poses: Literal["log", "match"] = "log"
    mount: str = "0,0,0"
    every: int = 1
    limit: int | None = None
    picture: Path | None = None
    geometry: OmitArgPrefixes[Geometry] = field(default_factory=Geometry)
    settings: ExtractorSettings = field(default_factory=ExtractorSettings)
    map_settings: MapSettings = field(default_factory=MapSettings)
    json: bool = False

    def run(self) -> int:
        """Build the plan, and print a summary."""
        self._check()
        mount = parse_pose(self.mount)
        line_map, odometry = (
            LineMap(self.map_settings),
            ScanOdometry(rule=KeyframeRule(corners=True)),
        )
        damage: TruncatedLogError | None = None
        with open_log(self.log, self.geometry, self.topic) as log:
            check = LogCheck(log.unit, ["odometry" if self.poses == "match" else "pose"])
            try:
                self._fill(line_map, odometry, log, check, mount)
            except TruncatedLogError as error:
                damage = error
        plan = plan_of_scene(line_map.scene, self.out.stem, f"mapped from {self.log.name}")
        loss = loss_of(odometry, line_map.scans + line_map.repeated)
        self._write(plan, line_map, odometry.lost, log, check)
        print_notes(check.notes())
        if damage:
            raise damage
        if loss:
            print(loss, file=sys.stderr)
        return 1 if loss else 0

    def _fill(
        self,
        line_map: LineMap,
        odometry: ScanOdometry,
        log: ScanLog,
        check: LogCheck,
        mount: Pose,
    ) -> None:
        stop = None if self.limit is None else (self.limit - 1) * self.every + 1
        records = check.watched(islice(log, 0, stop, self.every))
        matches = self.poses == "match"
        placed = matched(records, odometry, mount) if matches else map(_as_logged, records)
        for record, pose in tracked(placed, lambda n: f"{n} scans", lambda: log.fraction):
            line_map.add(extract(record.scan, self.settings), record.scan, pose)

    def _write(
        self, plan: FloorPlan, line_map: LineMap, lost: int, log: ScanLog, check: LogCheck
    ) -> None:
        save_floor_plan(plan, self.out)
        if self.picture:
            from semnav_env.world.maps.draw import save_picture

            save_picture(plan, self.picture)
        counts = {
            "scans": line_map.scans,
            "repeated": line_map.repeated,
            "lost": lost,
            "bad_lines": dict(log.bad.most_common()),
            "walls": len(line_map.walls),
            "doors": len(plan.doors),
            "notes": check.notes(),
            "out": str(self.out),
        }
        if self.json:
            print(json.dumps(counts))
        else:
            left_out = " ({repeated} more left out, taken where the one before was)"
            said = f"{{scans}} scans{left_out if line_map.repeated else ''}, {{walls}} walls"
            no_match = "\n{lost} scans found no match and count as moved as guessed" if lost else ""
            print(f"{said}, {{doors}} doors{no_match}".format(**counts))
            if log.bad:
                print(bad_text(log))
            print(f"wrote {self.out}")
            if self.picture:
                print(f"wrote {self.picture}")

    def _check(self) -> None:
        for name in ("every", "limit"):
            value = getattr(self, name)
            if value is not None and value < 1:
                raise ValueError(f"--{name} is {value}; it must be at least 1")
        if self.out.resolve() == self.log.resolve():
            raise ValueError(f"--out is the log itself, {self.log}; give another file")
        check_file(self.out, "--out")
        check_file(self.picture, "--picture")
        check_distinct({"the log": self.log, "--out": self.out, "--picture": self.picture})
        if self.picture:
            check_suffix(self.picture)


def _as_logged(record: LogRecord) -> tuple[LogRecord, Pose]:
    if record.pose is None:
        raise ValueError("the log has no poses; find them with --poses match")
    return record, record.pose
