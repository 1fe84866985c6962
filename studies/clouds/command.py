"""`python -m studies clouds`: how many door jambs each detector finds in which clouds."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain

import numpy as np

from semnav_features.clouds import MesStep
from semnav_scripts.progress import tracked
from studies.clouds import detectors
from studies.clouds.detectors import CloudResult, Look, Sensor, judge
from studies.clouds.scenes import POSES, SHUT, CloudScene, draw_scenes
from studies.sheets import Cell, ResultSheet

FROZEN_SEED = 2021
"""Of the scenes that are reported. Detectors were tuned on those of the seeds 77 and 99."""

DETECTORS: dict[str, tuple[Sensor, Look]] = {
    "Mes 2021, crop by hand": (detectors.spot, detectors.by_hand()),
    "Mes 2021, crop by the robot": (detectors.spot, detectors.by_robot),
    "Mes 2021, crop by hand, cloud thinned to 1 cm": (detectors.spot, detectors.thinned),
    "DoorFinder": (detectors.spot, detectors.finder),
    "DoorFinder, then for shut doors": (detectors.spot, detectors.finder_of_both),
    "DoorFinder, three clouds": (detectors.spot_on_its_way, detectors.finder),
    "DoorFinder, full height": (detectors.full_height, detectors.finder),
    "DoorFinder and 2D lidar": (detectors.spot, detectors.with_lidar),
    "DoorFinder, three clouds, and 2D lidar": (detectors.spot_on_its_way, detectors.with_lidar),
    "2D lidar": (detectors.lidar, detectors.scan_doors),
}

ABLATION: dict[str, tuple[Sensor, Look]] = {
    "all steps": (detectors.spot, detectors.by_hand()),
    **{f"without {s.value}": (detectors.spot, detectors.by_hand(s)) for s in MesStep},
}

HERS = {"A": (3, 3, 6, 6, 6), "B": (3, 4, 6, 6, 8), "C": (1, 2, 3, 3, 4), "D": (0, 3, 2, 2, 6)}
"""Mes 2021, chapter 8: doors found, clouds, jambs found, jambs shown, jambs. Table 8.2 says 6 for
the jambs of C, which has two clouds; her total of 24 counts 4."""


@dataclass(frozen=True)
class Arguments:
    """Find doors in the categories A to D of Mes 2021, chapter 8.

    Attributes:
        scenes: of each category.
        seed: of the scenes; the default are those that are reported.
        shut: doors that are shut, of glass and of wood, instead of hers, which are open.
        ablation: leave out each step of her pipeline instead of comparing detectors.
        json: print as JSON.
    """

    scenes: int = 100
    seed: int = FROZEN_SEED
    shut: bool = False
    ablation: bool = False
    json: bool = False

    def run(self) -> int:
        """Measure and print."""
        if self.scenes < 1 or self.seed < 0:
            raise ValueError("--scenes must be at least 1, and --seed at least 0")
        looks = ABLATION if self.ablation else DETECTORS
        categories = tuple(SHUT if self.shut else POSES)
        results: dict[str, dict[str, list[CloudResult]]] = {
            name: {category: [] for category in categories} for name in looks
        }
        total = self.scenes * len(categories)
        done: list[str] = []
        scenes = chain(*(draw_scenes(category, self.scenes, self.seed) for category in categories))
        for scene in tracked(scenes, lambda n: f"{n} of {total}", lambda: len(done) / total):
            done.append(scene.category)
            for name, result in _judged(scene, looks):
                results[name][scene.category].append(result)
        sheets = [_doors(results, categories), _jambs(results, not self.shut)]
        if self.json:
            print(json.dumps({sheet.title: sheet.records() for sheet in sheets}))
        else:
            print("\n\n".join(sheet.markdown() for sheet in sheets))
        return 0


def _judged(
    scene: CloudScene, looks: dict[str, tuple[Sensor, Look]]
) -> Iterator[tuple[str, CloudResult]]:
    for name, (sensor, look) in looks.items():
        yield name, judge(scene, sensor(scene), look)


def _doors(
    results: dict[str, dict[str, list[CloudResult]]], categories: Sequence[str]
) -> ResultSheet:
    """Doors with both jambs right, by category."""
    rows: list[tuple[Cell, ...]] = []
    if all(category in HERS for category in categories):
        hers = tuple(HERS[category][0] / HERS[category][1] for category in categories)
        rows.append(("Mes 2021, as reported, 12 clouds", *hers))
    shown = next(iter(results.values())).values()
    rows.append(("both jambs shown", *(float(np.mean([all(r.shown) for r in b])) for b in shown)))
    for name, by in results.items():
        rows.append((name, *(float(np.mean([all(r.right) for r in each])) for each in by.values())))
    return ResultSheet("Doors found, share of the clouds", ("detector", *categories), rows)


def _jambs(results: dict[str, dict[str, list[CloudResult]]], with_hers: bool) -> ResultSheet:
    """Jambs of all categories, with what she reports if they are hers."""
    found, shown, all_jambs = (sum(HERS[c][k] for c in POSES) for k in (2, 3, 4))
    nan = float("nan")
    rows: list[tuple[Cell, ...]] = []
    if with_hers:
        rows.append(("Mes 2021, as reported", found / all_jambs, found / shown, nan, nan, nan, nan))
    for name, by in results.items():
        rows.append((name, *_jamb_row([*chain(*by.values())])))
    columns = ("detector", "found", "found of shown", "false", *_ERRORS, "ms, median")
    return ResultSheet("Jambs", columns, rows)


_ERRORS = ("error, median, m", "error, 95 %, m")


def _jamb_row(results: Sequence[CloudResult]) -> tuple[Cell, ...]:
    right = np.array([result.right for result in results])
    wrong = np.array([result.wrong for result in results])
    shown = np.array([result.shown for result in results])
    errors = [error for result in results for error in result.errors] or [float("nan")]
    reported = max(int(right.sum() + wrong.sum()), 1)
    return (
        float(right.mean()),
        float((right & shown).sum() / max(shown.sum(), 1)),
        float(wrong.sum() / reported),
        *(float(value) for value in np.quantile(errors, (0.5, 0.95))),
        1e3 * float(np.median([result.seconds for result in results])),
    )
