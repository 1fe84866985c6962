"""`semnav map import`: make a floor plan from a map of another program."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, field
from pathlib import Path
from shlex import quote

from tyro.conf import Positional

from semnav_env.robots import robot_spec
from semnav_env.world.maps import FloorPlan, save_floor_plan
from semnav_env.world.maps.check import check
from semnav_env.world.maps.importers import Drawing, Tracing, import_map
from semnav_features.plot import check_suffix
from semnav_scripts.outputs import check_distinct
from semnav_scripts.progress import work_bar

MAX_FAULTS = 12
"""The most faults that are printed; the picture lists all."""


@dataclass(frozen=True)
class Arguments:
    """Make a floor plan from a map of another program; say what was imported and what is wrong.

    It reads maps of ROS's map_server (.yaml, with doors.yaml and locations.yaml beside it if they
    exist; or the image alone), drawings (.dxf, .svg), floor plans of the KTH and MIT campus data
    sets (.xml), buildings of OpenStreetMap (.osm), vector maps and houses of HouseExpo (.json),
    lists of wall segments (.csv), and floor plans in another unit than metres (.geojson).

    Attributes:
        source: the map.
        out: the floor plan to write (.geojson).
        resolution: of an image without .yaml file, metres per pixel.
        tracing: how the pixels of an occupancy map become walls.
        drawing: scale and layers of a drawing; the scale also of other lists of coordinates; the
            level of a building of OpenStreetMap.
        picture: picture of the plan to write, with its faults (.png, .pdf or .svg);
            NAME_plan.png beside NAME.geojson if not given.
        robot: wheelchair or spot; faults are searched for its body.
        json: print the report as JSON.
    """

    source: Positional[Path]
    out: Path
    resolution: float | None = None
    tracing: Tracing = field(default_factory=Tracing)
    drawing: Drawing = field(default_factory=Drawing)
    picture: Path | None = None
    robot: str = "wheelchair"
    json: bool = False

    def run(self) -> int:
        """Read, write, draw, and say what is wrong and what to do next."""
        if self.out.resolve() == self.source.resolve():
            raise ValueError(f"--out is the map itself, {self.source}; give another file")
        robot, picture = robot_spec(self.robot), self.picture or self._usual_picture()
        if picture:
            check_suffix(picture)
        outputs = {"--out": self.out, "--picture": picture}
        check_distinct({"the map": self.source, **outputs})
        with work_bar(f"reading {self.source.name}") as bar:
            plan, report = import_map(self.source, self.resolution, self.tracing, self.drawing)
            for read in report.source:  # a .yaml file names its image
                check_distinct({"the map": Path(read), **outputs})
            save_floor_plan(plan, self.out)
            bar.show("looking for faults", None)
            faults = check(plan, robot)
            if picture:
                from semnav_env.world.maps.draw import save_picture

                save_picture(plan, picture, faults=faults)
        if self.json:
            rows = [asdict(fault) for fault in faults]
            files = {"out": str(self.out), "picture": str(picture) if picture else None}
            print(json.dumps({**asdict(report), **files, "faults": rows}))
        else:
            print(f"{report}\nwrote {self.out}" + (f" and {picture}" if picture else ""))
            for fault in faults[:MAX_FAULTS]:
                print(f"fault: {fault}")
            if len(faults) > MAX_FAULTS:
                print(f"... and {len(faults) - MAX_FAULTS} more, which the picture lists")
            print(f"next: {self._next_line(plan, len(faults))}")
        return 0

    def _usual_picture(self) -> Path | None:
        """The picture beside the plan; None beside a pipe or a terminal."""
        return self.out.with_name(f"{self.out.stem}_plan.png") if self.out.suffix else None

    def _next_line(self, plan: FloorPlan, faults: int) -> str:
        """The command to type next, and what it is for."""
        file = quote(str(self.out))
        if faults or not plan.corridors:
            task = "mend the faults" if faults else "draw the corridors, which are missing"
            return f"`semnav serve`, and drop {file} there: {task}, and save it"
        return f'`semnav demo "go down the hallway" --map {file}`'
