"""`python -m studies offices`: generate many offices, check each, and time both."""

from __future__ import annotations

import json
import statistics
import time
from contextlib import nullcontext
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

from semnav_env.robots import ROBOTS, RobotSpec, robot_spec
from semnav_env.world.maps import DISTRIBUTIONS, generate_office
from semnav_env.world.maps.check import check
from semnav_env.world.maps.generator.naming import distribution, office_name
from semnav_scripts.progress import tracked


@dataclass(frozen=True)
class OfficeCheck:
    """One office.

    Attributes:
        distribution: it is drawn from.
        seed: of it.
        rooms: how many.
        doors: how many.
        square_metres: of its floor.
        seconds: to generate it.
        check_seconds: to check it.
        faults: found by the check.
    """

    distribution: str
    seed: int
    rooms: int
    doors: int
    square_metres: float
    seconds: float
    check_seconds: float
    faults: tuple[str, ...]


@dataclass(frozen=True)
class Arguments:
    """Generate offices, check each one, and count.

    The exit code is 1 if a fault was found.

    Attributes:
        distributions: of small, medium, large and hard; all of them if none is named.
        count: of offices per distribution.
        first_seed: of them.
        robot: wheelchair or spot; the smaller body passes wherever the larger one does.
        out: file for every office as it comes, one JSON object a line.
        json: print JSON.
    """

    distributions: tuple[str, ...] = ()
    count: int = 100
    first_seed: int = 0
    robot: str = "wheelchair"
    out: Path | None = None
    json: bool = False

    def run(self) -> int:
        """Measure, and print one row for each distribution."""
        if self.count < 1 or self.first_seed < 0:
            raise ValueError("count must be at least 1, and first_seed 0 or more")
        names = self.distributions or tuple(DISTRIBUTIONS)
        for name in names:
            distribution(name)
        robot = robot_spec(self.robot)
        measure(names[0], self.first_seed, robot)  # compiles what is compiled
        offices = self._offices(names, robot)
        rows = [summary(n, [o for o in offices if o.distribution == n]) for n in names]
        faulty = [office for office in offices if office.faults]
        if self.json:
            print(json.dumps({"summary": rows, "faulty": [asdict(o) for o in faulty]}))
        else:
            _show(rows, faulty)
        return 1 if faulty else 0

    def _offices(self, names: tuple[str, ...], robot: RobotSpec) -> list[OfficeCheck]:
        """One of each distribution in turn, so that a run that is cut off can be used."""
        seeds = range(self.first_seed, self.first_seed + self.count)
        if self.out is not None:
            self.out.parent.mkdir(parents=True, exist_ok=True)
        total, offices = len(names) * self.count, list[OfficeCheck]()
        drawn = (measure(name, seed, robot) for seed in seeds for name in names)
        with nullcontext() if self.out is None else self.out.open("w") as out:
            for office in tracked(drawn, lambda n: f"{n} offices", lambda: len(offices) / total):
                offices.append(office)
                if out is not None:
                    print(json.dumps(asdict(office)), file=out, flush=True)
        return offices


def measure(name: str, seed: int, robot: RobotSpec = ROBOTS["wheelchair"]) -> OfficeCheck:
    """Generate and check one office."""
    began = time.perf_counter()
    plan = generate_office(seed, name)
    made = time.perf_counter()
    faults = tuple(map(str, check(plan, robot)))
    checked = time.perf_counter()
    counts = len(plan.rooms), len(plan.doors), plan.boundary.area
    return OfficeCheck(name, seed, *counts, made - began, checked - made, faults)


def summary(name: str, offices: list[OfficeCheck]) -> dict[str, Any]:
    """What the table says of a distribution."""
    return {
        "distribution": name,
        "offices": len(offices),
        "valid": sum(not office.faults for office in offices) / len(offices),
        "rooms": _spread([office.rooms for office in offices]),
        "doors": _spread([office.doors for office in offices]),
        "square_metres": _spread([office.square_metres for office in offices]),
        "seconds": statistics.fmean(office.seconds for office in offices),
        "most_seconds": max(office.seconds for office in offices),
        "check_seconds": statistics.fmean(office.check_seconds for office in offices),
    }


def _spread(values: list[Any]) -> tuple[float, float, float]:
    """Least, mean and most."""
    return min(values), round(statistics.fmean(values), 1), max(values)


def _show(rows: list[dict[str, Any]], faulty: list[OfficeCheck]) -> None:
    heads = ("offices", "count", "valid", "rooms", "doors", "m2", "s", "most", "check")
    table = Table(*heads, caption="least/mean/most; seconds: mean, most, mean of the check")
    for row in rows:
        spreads = (row["rooms"], row["doors"], row["square_metres"])
        sizes = ["/".join(f"{value:.0f}" for value in spread) for spread in spreads]
        seconds = (f"{row[key]:.3f}" for key in ("seconds", "most_seconds", "check_seconds"))
        first = (row["distribution"], str(row["offices"]), f"{100 * row['valid']:.1f} %")
        table.add_row(*first, *sizes, *seconds)
    console = Console()
    console.print(table)
    for office in faulty:
        name = office_name(office.distribution, office.seed)
        for fault in office.faults:
            console.print(f"{name}: {fault}", highlight=False, soft_wrap=True)
