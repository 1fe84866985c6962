"""`semnav extract`: turn a log of lidar scans into scenes."""

from __future__ import annotations

from contextlib import nullcontext
from dataclasses import dataclass, field
from itertools import islice
from pathlib import Path
from typing import Any

from tyro.conf import OmitArgPrefixes, Positional

from semnav_features import ExtractorSettings, Scan, Scene, extract
from semnav_features.plot import check_suffix, save_page
from semnav_features.readers import Geometry, LogCheck, ScanLog, TruncatedLogError, open_log
from semnav_scripts.jsonl import JsonLines
from semnav_scripts.outputs import check_distinct, check_file
from semnav_scripts.progress import tracked
from semnav_scripts.sampling import EvenSample
from semnav_scripts.scene_report import ExtractionTally, document, print_notes, rejections


@dataclass(frozen=True)
class Arguments:
    """Turn a log of lidar scans into walls, doors, corners and corridors.

    It reads CARMEN logs, CSV and BreezySLAM's logs (text or gz), npz archives, ROS 1 bags, and
    ROS 2 bags (folder, .db3 or .mcap). A truncated log is processed up to its last complete scan;
    the exit code is then 2. Notes on stderr name possible errors of the log.

    Attributes:
        log: the log: a file, or the folder of a ROS 2 bag.
        topic: of the scans in a bag, such as /scan; not needed if there is only one.
        out: file for the scenes, one JSON object a line, in the frame of the lidar.
        plot: picture of some scans with their features (.png, .pdf or .svg).
        scans: number of scans in the picture, spread evenly over the log.
        every: take only every Nth scan.
        limit: stop after this number of scans.
        geometry: values of the scans that the log does not contain.
        settings: limits of the extractor, metres and radians.
        explain: write with each scene the rejected candidates, and why; some thousand times slower.
        json: print the summary as JSON on stdout.
    """

    log: Positional[Path]
    topic: str | None = None
    out: Path | None = None
    plot: Path | None = None
    scans: int = 9
    every: int = 1
    limit: int | None = None
    geometry: OmitArgPrefixes[Geometry] = field(default_factory=Geometry)
    settings: ExtractorSettings = field(default_factory=ExtractorSettings)
    explain: bool = False
    json: bool = False

    def run(self) -> int:
        """Extract the scenes, and print a summary."""
        self._check()
        page = EvenSample[tuple[str, Scan, Scene]](self.scans)
        damage: TruncatedLogError | None = None
        with open_log(self.log, self.geometry, self.topic) as log:
            tally, check = ExtractionTally(log), LogCheck(log.unit)
            try:
                self._extract(log, tally, check, page)
            except TruncatedLogError as error:
                damage = error
        written = [self.out] if self.out and tally.scenes else []
        if self.plot and tally.scenes:
            save_page(self.plot, page.items())
            written.append(self.plot)
        if self.json:
            print(tally.as_json(damage is None, written, check.notes()))
        else:
            print("\n".join([tally.as_text(), *(f"wrote {path}" for path in written)]))
        print_notes(check.notes())
        if damage:
            raise damage
        return 0

    def _extract(
        self,
        log: ScanLog,
        tally: ExtractionTally,
        check: LogCheck,
        page: EvenSample[tuple[str, Scan, Scene]],
    ) -> None:
        stop = None if self.limit is None else (self.limit - 1) * self.every + 1
        records = check.watched(islice(log, 0, stop, self.every))
        with JsonLines(self.out) if self.out else nullcontext() as out:
            for record in tracked(records, tally.label, lambda: log.fraction):
                scene = extract(record.scan, self.settings, explain=self.explain)
                tally.add(scene)
                page.offer((f"scan {log.scans}, {log.unit} {record.line}", record.scan, scene))
                if out:
                    out.write(document(record, scene) | self._reasons(scene))

    def _reasons(self, scene: Scene) -> dict[str, Any]:
        return {"rejections": rejections(scene)} if self.explain else {}

    def _check(self) -> None:
        if self.explain and self.out is None:
            raise ValueError("--explain writes its reasons into --out; give a file")
        for name in ("every", "limit", "scans"):
            value = getattr(self, name)
            if value is not None and value < 1:
                raise ValueError(f"--{name} is {value}; it must be at least 1")
        if self.out and self.out.resolve() == self.log.resolve():
            raise ValueError(f"--out is the log itself, {self.log}; give another file")
        check_file(self.out, "--out")
        check_file(self.plot, "--plot")
        check_distinct({"the log": self.log, "--out": self.out, "--plot": self.plot})
        if self.plot:
            check_suffix(self.plot)
