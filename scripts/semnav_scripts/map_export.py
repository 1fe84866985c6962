"""`semnav map export`: write a floor plan as a map of ROS's map_server."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Literal

from tyro.conf import Positional

from semnav_env.world.maps import load_floor_plan
from semnav_env.world.maps.occupancy_export import export_map


@dataclass(frozen=True)
class Arguments:
    """Write a floor plan as a map of ROS's map_server.

    Beside the YAML file and its image it writes doors.yaml and locations.yaml, from which `semnav
    map import` reads the doors and places back.

    Attributes:
        plan: name of a bundled plan, of a generated one (office:medium:17), or path of a file.
        out: the map to write (.yaml), in a folder of its own.
        resolution: metres per pixel.
        image: format of the image, pgm or png.
        json: print the report as JSON.
    """

    plan: Positional[str]
    out: Path
    resolution: float = 0.05
    image: Literal["pgm", "png"] = "pgm"
    json: bool = False

    def run(self) -> int:
        """Write and report."""
        report = export_map(load_floor_plan(self.plan), self.out, self.resolution, f".{self.image}")
        print(json.dumps(asdict(report)) if self.json else report)
        return 0
