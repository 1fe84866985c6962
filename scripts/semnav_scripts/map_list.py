"""`semnav map list`: list the floor plans that come with the package."""

from __future__ import annotations

import json
from dataclasses import dataclass

from semnav_env.world.maps import bundled_names, load_floor_plan
from semnav_scripts.plan_summary import in_a_line, summary


@dataclass(frozen=True)
class Arguments:
    """List the floor plans that come with the package.

    Attributes:
        json: print JSON.
    """

    json: bool = False

    def run(self) -> int:
        """Print one line for each plan."""
        plans = [summary(load_floor_plan(name)) for name in bundled_names()]
        print(json.dumps(plans) if self.json else "\n".join(in_a_line(plan) for plan in plans))
        return 0
