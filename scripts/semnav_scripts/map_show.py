"""`semnav map show`: show the contents of a floor plan."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tyro.conf import Positional

from semnav_env.world.maps import FloorPlan, load_floor_plan
from semnav_features.plot import check_suffix
from semnav_scripts.plan_summary import in_a_line, summary


@dataclass(frozen=True)
class Arguments:
    """Show the contents of a floor plan.

    Attributes:
        plan: name of a bundled plan, of a generated one (office:medium:17), or path of a file.
        out: picture to write (.png, .pdf or .svg).
        json: print JSON.
    """

    plan: Positional[str]
    out: Path | None = None
    json: bool = False

    def run(self) -> int:
        """Print the summary, and draw the plan if asked to."""
        if self.out:
            check_suffix(self.out)
        plan = load_floor_plan(self.plan)
        if self.out:
            _draw(plan, self.out)
        print(json.dumps(summary(plan)) if self.json else _paragraph(summary(plan)))
        if self.out and not self.json:
            print(f"wrote {self.out}")
        return 0


def _draw(plan: FloorPlan, path: Path) -> None:
    from semnav_env.world.maps.draw import save_picture

    save_picture(plan, path)


def _paragraph(plan: dict[str, Any]) -> str:
    rows = [in_a_line(plan), f"  source: {plan['source'] or 'not stated'}"]
    rows += [
        f"  {kind}: {', '.join(plan[kind]) or 'none'}"
        for kind in ("rooms", "corridors", "intersections")
    ]
    rows += [
        f"  door {door['name']}: {door['state']}, {door['width']:.2f} m wide"
        for door in plan["doors"]
    ]
    return "\n".join(rows)
