"""Draw docs/images/speed.png: how a step grows with the building, the beams and the robots."""

from __future__ import annotations

import re

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from semnav_env.bench.suite import growth_parts
from semnav_env.bench.timing import Timing, timings
from semnav_env.world.maps import load_floor_plan
from studies.figures import IMAGES

THREADS, RUNS, STEPS = 2, 5, 1500

PANELS = (
    ("segments of the building", {"one environment": r"step, (\d+) segments"}),
    ("beams of the lidar", {"one environment": r"step, (\d+) beams"}),
    (
        "robots in a vector environment",
        {
            "one thread": r"step of one of (\d+) robots, 1 thread$",
            "two threads": r"step of one of (\d+) robots, 2 threads",
        },
    ),
)


def draw(ax: Axes, title: str, lines: dict[str, str], found: list[Timing]) -> None:
    """One panel: microseconds of a robot's step over a size."""
    for label, pattern in lines.items():
        matches = [(re.match(pattern, timing.name), timing.microseconds) for timing in found]
        points = [(int(match[1]), cost) for match, cost in matches if match]
        sizes, costs = zip(*points, strict=True)
        ax.plot(sizes, costs, "o-", label=label)
    ax.set_xscale("log")
    ax.set_xticks(sizes, [f"{size:,}" for size in sizes])
    ax.minorticks_off()
    ax.set_ylim(0.0, 1.15 * ax.get_ylim()[1])
    ax.set(xlabel=title, ylabel="microseconds for a robot's step")
    ax.grid(alpha=0.3)
    ax.legend(fontsize=8)


def main() -> None:
    """Measure and draw; prints what was measured."""
    plan = load_floor_plan("office_cross")
    parts = growth_parts(plan, THREADS, STEPS, robot="wheelchair", observation="semantic")
    found = timings(parts, RUNS)
    for timing in found:
        print(f"{timing.name}: {timing.microseconds:.1f} us, {timing.ratio:.1f}")
    figure = Figure(figsize=(10.5, 3.2), layout="constrained")
    for ax, (title, lines) in zip(figure.subplots(1, 3), PANELS, strict=True):
        draw(ax, title, lines, found)
    FigureCanvasAgg(figure).print_png(IMAGES / "speed.png")


if __name__ == "__main__":
    main()
