"""`semnav map check`: find the faults of a floor plan."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path

from tyro.conf import Positional

from semnav_env.robots import robot_spec
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.maps.check import check
from semnav_features.plot import check_suffix
from semnav_scripts.progress import work_bar


@dataclass(frozen=True)
class Arguments:
    """Find the faults of a floor plan; the exit code is 1 if there are any.

    Attributes:
        plan: name of a bundled plan, of a generated one (office:medium:17), or path of a file.
        robot: wheelchair or spot; its body has to reach every open door and every room.
        plot: picture to write (.png, .pdf or .svg), with the faults marked.
        json: print JSON.
    """

    plan: Positional[str]
    robot: str = "wheelchair"
    plot: Path | None = None
    json: bool = False

    def run(self) -> int:
        """Check the plan, and print one line for each fault."""
        if self.plot:
            check_suffix(self.plot)
        plan, robot = load_floor_plan(self.plan), robot_spec(self.robot)
        with work_bar(f"looking for faults of {plan.name}"):
            faults = check(plan, robot)
        if self.plot:
            from semnav_env.world.maps.draw import save_picture

            save_picture(plan, self.plot, faults=faults)
        if self.json:
            rows = [asdict(fault) for fault in faults]
            print(json.dumps({"plan": plan.name, "robot": robot.name, "faults": rows}))
        else:
            self._report(plan.name, [str(fault) for fault in faults])
        return 1 if faults else 0

    def _report(self, name: str, faults: list[str]) -> None:
        rooms = f"a {self.robot} gets through every open door and into every room that has one"
        print("\n".join(faults) if faults else f"{name}: nothing is wrong; {rooms}")
        if self.plot:
            print(f"wrote {self.plot}")
