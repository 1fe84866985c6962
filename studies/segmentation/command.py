"""`python -m studies segmentation`: how much of the walls a strategy brings back in one piece."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from dataclasses import asdict, dataclass, replace

import numpy as np

from semnav_env.world.maps.library import bundled_names, load_floor_plan
from semnav_features.settings import ExtractorSettings
from semnav_features.strategies import BreakpointRule, strategy_names
from semnav_scripts.progress import tracked
from studies.features.study import all_strategies
from studies.segmentation.segment_labels import LabelledScan, labelled_scans
from studies.segmentation.segmentation import Rate, known_noise, measure
from studies.sheets import ResultSheet

MEASURES = {
    "lines": "Straight walls, by the whole chain",
    "surfaces": "Connected surfaces, by the breakpoint rule alone",
}
THESIS_ANGLE = 10.0
"""Lambda of the thesis (Barbret (2.3)), degrees."""


@dataclass(frozen=True)
class Arguments:
    """The segmentation rate (Weerakoon et al. (11)) in simulated scans, per strategy and noise.

    Every breakpoint rule is measured with the lambda of the thesis, too.

    Attributes:
        plans: floor plans, bundled names or paths; all bundled ones if none is given.
        poses: random poses in each plan.
        sigma: standard deviations of the ranges, metres.
        known_noise: fit sigma and split_distance to each noise; without, they stay as shipped.
        seed: of poses and noise.
        json: print as JSON.
    """

    plans: tuple[str, ...] = ()
    poses: int = 100
    sigma: tuple[float, ...] = (0.0, 0.005, 0.01, 0.02, 0.03)
    known_noise: bool = False
    seed: int = 0
    json: bool = False

    def run(self) -> int:
        """Measure and print."""
        if self.poses < 1 or self.seed < 0:
            raise ValueError("--poses must be at least 1 and --seed at least 0")
        if not self.sigma or not all(0.0 <= sigma <= 1.0 for sigma in self.sigma):
            raise ValueError(f"--sigma is {self.sigma}; give metres from 0 to 1, such as 0.02")
        scans = self._scans()
        chosen = strategies()
        rates: dict[str, list[Rate]] = {}
        for name, found in tracked(
            ((name, self._measure(scans, settings)) for name, settings in chosen.items()),
            lambda n: f"{n} strategies",
            lambda: len(rates) / len(chosen),
        ):
            rates[name] = found
        if self.json:
            rows = [{"strategy": n, **asdict(rate)} for n, row in rates.items() for rate in row]
            print(json.dumps(rows))
        else:
            print("\n\n".join(_sheet(measure, rates).markdown() for measure in MEASURES))
        return 0

    def _scans(self) -> list[LabelledScan]:
        rng, settings = np.random.default_rng(self.seed), ExtractorSettings()
        plans = [load_floor_plan(name) for name in self.plans or bundled_names()]
        total = len(plans) * self.poses * len(self.sigma)
        scans: list[LabelledScan] = []
        drawn: Iterator[LabelledScan] = (
            scan
            for plan in plans
            for scan in labelled_scans(plan, self.poses, self.sigma, rng, settings)
        )
        for scan in tracked(drawn, lambda n: f"{n} scans", lambda: len(scans) / total):
            scans.append(scan)
        return scans

    def _measure(self, scans: list[LabelledScan], settings: ExtractorSettings) -> list[Rate]:
        if not self.known_noise:
            return measure(scans, settings)
        return [
            measure([s for s in scans if s.noise == noise], known_noise(settings, noise))[0]
            for noise in sorted(self.sigma)
        ]


def strategies() -> dict[str, ExtractorSettings]:
    """Every strategy in the place of the default's, and the rules with the lambda of the thesis."""
    steep = ExtractorSettings(breakpoint_angle=math.radians(THESIS_ANGLE))
    return all_strategies() | {
        f"breakpoint_rule={name}, {THESIS_ANGLE:g} degrees": replace(steep, breakpoint_rule=name)
        for name in strategy_names(BreakpointRule)
        if name not in ("constant", "dietmayer", "lee")
    }


def _sheet(measure: str, rates: dict[str, list[Rate]]) -> ResultSheet:
    noises = [rate.noise for rate in next(iter(rates.values()))]
    columns = ("strategy", *(f"{1e3 * noise:g} mm" for noise in noises))
    rows = [(name, *(getattr(rate, measure) for rate in row)) for name, row in rates.items()]
    return ResultSheet(MEASURES[measure], columns, rows)
