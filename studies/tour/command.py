"""`python -m studies tour`: a tour of ten rooms with drift, with each correction."""

from __future__ import annotations

import json
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass
from functools import partial
from itertools import product
from pathlib import Path
from statistics import fmean, median

from semnav_scripts.jsonl import JsonLines
from semnav_scripts.progress import tracked
from studies.tour.tour import CORRECTIONS, TourResult, result, tour


@dataclass(frozen=True)
class Arguments:
    """Drive the tour with each correction; the same seeds for all.

    Attributes:
        seeds: how many tours.
        first: the first seed. Rules were chosen on seeds from 1000 on.
        factors: how many times as large as in SPOT's preset the errors of odometry are.
        corrections: which ones.
        workers: processes.
        out: file for the rows, one JSON object a line.
    """

    seeds: int = 100
    first: int = 0
    factors: tuple[float, ...] = (1.0, 2.0)
    corrections: tuple[str, ...] = tuple(CORRECTIONS)
    workers: int = 1
    out: Path = Path("out/tour.jsonl")

    def run(self) -> int:
        """Drive, print a row for each correction, and keep the rows."""
        self.out.parent.mkdir(parents=True, exist_ok=True)
        seeds = range(self.first, self.first + self.seeds)
        with JsonLines(self.out) as out, ProcessPoolExecutor(self.workers) as pool:
            for factor, correction in product(self.factors, self.corrections):
                results = list[TourResult]()
                for each in tracked(
                    pool.map(partial(driven, correction, factor), seeds),
                    lambda n: f"{n} tours",
                    lambda results=results: len(results) / self.seeds,  # type: ignore[misc]
                ):
                    results.append(each)
                found = row(correction, factor, results)
                out.write(found | {"tours": [asdict(each) for each in results]})
                print(json.dumps(found), flush=True)
        return 0


def driven(correction: str, factor: float, seed: int) -> TourResult:
    """The result of one tour; the arguments are those of `tour`."""
    return result(list(tour(correction, factor, seed)))


def row(correction: str, factor: float, results: list[TourResult]) -> dict[str, object]:
    """The figures of a correction: metres, shares, seconds."""
    errors = [each.error for each in results]
    worst = [each.worst_correction for each in results]
    return {
        "correction": correction,
        "factor": factor,
        "error": round(fmean(errors), 3),
        "largest_error": round(max(errors), 3),
        "reckoned_error": round(fmean(each.reckoned_error for each in results), 3),
        "lost": round(fmean(each.lost for each in results), 3),
        "all_rooms": round(fmean(each.rooms == 10 for each in results), 3),
        "rooms": round(fmean(each.rooms for each in results), 2),
        "corrections": round(fmean(each.corrections for each in results), 1),
        "refused": round(fmean(each.refused for each in results), 1),
        "worst_correction": round(max(worst), 3),
        "usual_worst_correction": round(median(worst), 3),
        "worst_harm": round(max(each.worst_harm for each in results), 3),
        "contacts": round(fmean(each.contacts for each in results), 2),
    }
