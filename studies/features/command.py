"""`python -m studies features`: the feature extractor against the truth."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from semnav_env.world.maps import bundled_names, load_floor_plan
from semnav_features import ExtractorSettings
from semnav_scripts.progress import tracked
from studies.doors.map_doors import map_sheets, mapped
from studies.doors.openings import read_openings
from studies.doors.real_doors import FREIBURG, FREIBURG_LABELS, door_sheet, look_through
from studies.features.figures import save_figures
from studies.features.real_logs import find_logs, log_row, log_sheet
from studies.features.report import in_short, sheets
from studies.features.study import DEFAULT_STRATEGY, Extractor, Study, all_extractors
from studies.sheets import Cell, ResultSheet


@dataclass(frozen=True)
class Arguments:
    """Measure the feature extractor on simulated scans whose truth is known, and on real logs.

    Attributes:
        plans: floor plans, bundled names or paths; all bundled ones if none is given.
        poses: random poses in each plan without clutter, and as many with it; 0 for none.
        sigma: standard deviations of the ranges, metres.
        strategies: names of strategies of the extractor, "barbret" for the chain of his thesis, or
            "all".
        data: folder with real logs in a folder carmen, freiburg-079 among them.
        labels: file with the openings of freiburg-079; by default the one of the package.
        every: take each Nth scan of a real log.
        seed: of poses, clutter and noise.
        out: folder for the tables (Markdown and JSON) and the figures.
        full: print all tables, not the most important ones only.
        json: print all tables as JSON.
    """

    plans: tuple[str, ...] = ()
    poses: int = 1000
    sigma: tuple[float, ...] = (0.0, 0.01, 0.02, 0.03)
    strategies: tuple[str, ...] = (DEFAULT_STRATEGY,)
    data: Path | None = None
    labels: Path = FREIBURG_LABELS
    every: int = 8
    seed: int = 0
    out: Path | None = None
    full: bool = False
    json: bool = False

    def run(self) -> int:
        """Measure, write and print."""
        study = Study(self._check())
        self._simulate(study)
        simulated, real = sheets(study, self._told) if self.poses else [], list(self._real())
        tables = simulated + real
        if self.out is not None:
            self._write(self.out, study, tables)
        if self.json:
            print(json.dumps(self._document(study, tables)))
        elif self.full or not simulated:
            print(_markdown(tables))
        else:
            print(_markdown(in_short(study, self._told) + real))
            print("\nall tables: --full, or --out for a page with figures")
        return 0

    @property
    def _told(self) -> float:
        """The noise that is told in detail: the lidar's, or the nearest to it."""
        return min(self.sigma, key=lambda sigma: abs(sigma - ExtractorSettings().sigma))

    def _check(self) -> dict[str, Extractor]:
        """The strategies that were asked for, if all arguments are in order."""
        for name, least in (("poses", 0), ("every", 1), ("seed", 0)):
            if getattr(self, name) < least:
                raise ValueError(f"--{name} is {getattr(self, name)}; it must be at least {least}")
        if not self.sigma or not all(0.0 <= sigma <= 1.0 for sigma in self.sigma):
            raise ValueError(f"--sigma is {self.sigma}; give metres from 0 to 1, such as 0.02")
        if not self.poses and self.data is None:
            raise ValueError("--poses is 0 and there is no --data: nothing to measure")
        if self.out is not None and self.out.exists() and not self.out.is_dir():
            raise ValueError(f"--out is {self.out}, which is a file; give a folder")
        known = all_extractors()
        names = tuple(known) if "all" in self.strategies else self.strategies
        if DEFAULT_STRATEGY not in names:
            names = (DEFAULT_STRATEGY, *names)
        if unknown := [name for name in names if name not in known]:
            raise ValueError(f"no strategy {unknown[0]!r}; there are: all, {', '.join(known)}")
        return {name: known[name] for name in names}

    def _simulate(self, study: Study) -> None:
        plans = [load_floor_plan(name) for name in self.plans or bundled_names()]
        total = 2 * self.poses * len(plans)
        cases = study.run(plans, self.poses, self.sigma, (False, True), self.seed)
        for _ in tracked(cases, lambda n: f"{n} poses", lambda: study.cases / max(total, 1)):
            pass

    def _real(self) -> Iterator[ResultSheet]:
        if self.data is None:
            return
        logs = find_logs(self.data)
        openings = read_openings(self.labels)
        default = ExtractorSettings()
        looking = look_through(self.data / FREIBURG, default, self.every)
        glimpses = list(tracked(looking, lambda n: f"{n} scans of freiburg-079", lambda: None))
        yield door_sheet(glimpses, openings)
        growing = mapped(self.data / FREIBURG, default)
        *_, line_map = tracked(growing, lambda n: f"{n} scans into a map", lambda: None)
        yield from map_sheets(line_map.doors, openings)
        rows: list[tuple[Cell, ...]] = []
        for row in tracked(
            (log_row(log, default) for log in logs),
            lambda n: f"{n} logs",
            lambda: len(rows) / len(logs),
        ):
            rows.append(row)
        yield log_sheet(rows)

    def _document(self, study: Study, tables: list[ResultSheet]) -> dict[str, Any]:
        asked = {"poses": self.poses, "sigma": self.sigma, "seed": self.seed, "every": self.every}
        records = {table.title: table.records() for table in tables}
        return {"asked": asked, "limits": asdict(study.limits), "tables": records}

    def _write(self, folder: Path, study: Study, tables: list[ResultSheet]) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        page = "# Feature extraction, measured\n\n" + _markdown(tables)
        (folder / "features.md").write_text(page + "\n", encoding="utf-8")
        text = json.dumps(self._document(study, tables), indent=1)
        (folder / "features.json").write_text(text + "\n", encoding="utf-8")
        if self.poses:
            save_figures(study, self._told, folder)


def _markdown(tables: list[ResultSheet]) -> str:
    return "\n\n".join(table.markdown() for table in tables)
