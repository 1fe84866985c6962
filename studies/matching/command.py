"""`python -m studies matching`: how exactly scans are matched, and how well that is known."""

from __future__ import annotations

import itertools
import json
import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from semnav_env.world.maps import FloorPlan, bundled_names, load_floor_plan
from semnav_env.world.maps.importers import load_vector_map
from semnav_features.mapping import MatchSettings
from semnav_features.readers import open_log
from semnav_scripts.progress import tracked
from studies.matching.drift import drift_of
from studies.matching.matching import (
    CHI_SQUARE_95,
    PairError,
    PairSpec,
    errors_of,
    log_differences,
    poses_in,
    poses_on,
    read_ways,
    simulated_pairs,
)
from studies.sheets import Cell, ResultSheet


@dataclass(frozen=True)
class Arguments:
    """Match simulated pairs of scans whose poses are known, and successive scans of real logs.

    Attributes:
        plans: floor plans, bundled names or paths, or vector maps (.vectormap.json with a
            .navigation.json beside it); all bundled plans if none is given.
        logs: logs with corrected poses.
        pairs: in each plan and for each sigma; 0 for none.
        sigma: standard deviations of the ranges, metres.
        every: take each Nth scan of a log.
        seed: of poses, guesses and noise.
        settings: limits of the matcher.
        json: print as JSON.
    """

    plans: tuple[str, ...] = ()
    logs: tuple[Path, ...] = ()
    pairs: int = 100
    sigma: tuple[float, ...] = (0.01,)
    every: int = 1
    seed: int = 0
    settings: MatchSettings = field(default_factory=MatchSettings)
    json: bool = False

    def run(self) -> int:
        """Measure and print."""
        if self.pairs < 0 or self.every < 1 or self.seed < 0:
            raise ValueError("--pairs and --seed must be at least 0, and --every at least 1")
        names = self.plans or bundled_names()
        cases = list(itertools.product(names, self.sigma)) if self.pairs else []
        rows: list[tuple[Cell, ...]] = []
        found = (self._simulated(name, sigma) for name, sigma in cases)
        for row in tracked(found, lambda n: f"{n} cases", lambda: len(rows) / len(cases)):
            rows.append(row)
        sheets = [ResultSheet("Simulated pairs", _SIMULATED, rows)] if rows else []
        if self.logs:
            sheets.append(ResultSheet("Successive scans", _REAL, [*map(self._real, self.logs)]))
            drifts = [self._drift(path, wheels) for path in self.logs for wheels in (False, True)]
            sheets.append(ResultSheet("Odometry from scans", _DRIFT, drifts))
        if self.json:
            print(json.dumps({sheet.title: sheet.records() for sheet in sheets}))
        else:
            print("\n\n".join(sheet.markdown() for sheet in sheets))
        return 0

    def _simulated(self, name: str, sigma: float) -> tuple[Cell, ...]:
        rng = np.random.default_rng(self.seed)
        plan, poses = _plan_and_poses(name, rng)
        pairs = simulated_pairs(plan, poses, rng, PairSpec(sigma=sigma))
        next(errors_of(pairs, self.settings))  # the first compiles
        errors = list(errors_of(itertools.islice(pairs, self.pairs), self.settings))
        return plan.name, 1000.0 * sigma, *_simulated_row(errors)

    def _real(self, path: Path) -> tuple[Cell, ...]:
        with open_log(path) as log:
            records = itertools.islice(log, 0, None, self.every)
            differences = log_differences(records, self.settings)
            found = list(tracked(differences, lambda n: f"{n} scans", lambda: log.fraction))
        table = np.array([(d.position, d.angle, d.loop_position, d.loop_angle) for d in found])
        middle = np.median(table.reshape(-1, 4), axis=0) * _REAL_UNITS if found else _NOTHING
        return path.name.split(".")[0], len(found), *map(float, middle)

    def _drift(self, path: Path, wheels: bool) -> tuple[Cell, ...]:
        with open_log(path) as log:
            records = tracked(
                itertools.islice(log, 0, None, self.every),
                lambda n: f"{n} scans followed",
                lambda: log.fraction,
            )
            drift = drift_of(records, wheels, self.settings)
        guide = "wheels" if wheels else "the motion before"
        told = (path.name.split(".")[0], guide, drift.scans, drift.path, drift.lost)
        if not len(drift.position):
            return *told, *_NOTHING
        position = np.percentile(drift.position, (50, 90))
        angle = np.degrees(np.percentile(drift.angle, (50, 90)))
        return *told, *map(float, (*position, *angle))


_SIMULATED = (
    *("plan", "sigma, mm", "pairs", "position, mm", "p90", "heading, degrees", "p90 "),
    *("mean NEES", "covered at 95 %", "undetermined", "ms"),
)
_DRIFT = (
    *("log", "guess from", "scans", "way, m", "not matched", "drift per 10 m, m", "p90"),
    *("degrees", "p90 "),
)
_REAL = ("log", "scans", "to its poses, mm", "degrees", "loop of three, mm", "degrees ")
_REAL_UNITS = np.array((1e3, math.degrees(1.0), 1e3, math.degrees(1.0)))
_NOTHING = (math.nan,) * 4


def _plan_and_poses(
    name: str, rng: np.random.Generator
) -> tuple[FloorPlan, Iterator[tuple[float, float, float]]]:
    if name.endswith(".vectormap.json"):
        ways = read_ways(name.replace(".vectormap.json", ".navigation.json"))
        return load_vector_map(name).plan, poses_on(ways, rng)
    plan = load_floor_plan(name)
    return plan, poses_in(plan, rng)


def _simulated_row(errors: list[PairError]) -> tuple[Cell, ...]:
    position = np.percentile([error.position for error in errors], (50, 90)) * 1e3
    angle = np.degrees(np.percentile([error.angle for error in errors], (50, 90)))
    return (
        len(errors),
        *map(float, (*position, *angle)),
        float(np.mean([error.nees for error in errors])),
        float(np.mean([error.nees < CHI_SQUARE_95 for error in errors])),
        sum(error.undetermined for error in errors),
        float(np.median([error.seconds for error in errors])) * 1e3,
    )
