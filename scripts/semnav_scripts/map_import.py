"""`semnav map import`: make a floor plan from a map of another program."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, field
from pathlib import Path
from shlex import quote

from tyro.conf import Positional

from semnav_env.world.maps import save_floor_plan
from semnav_env.world.maps.importers import Drawing, Tracing, import_map
from semnav_features.plot import check_suffix
from semnav_scripts.outputs import check_distinct


@dataclass(frozen=True)
class Arguments:
    """Make a floor plan from a map of another program, and report what was imported.

    It reads maps of ROS's map_server (.yaml, with doors.yaml and locations.yaml beside it if they
    exist; or the image alone), drawings (.dxf, .svg), floor plans of the KTH and MIT campus data
    sets (.xml), vector maps and houses of HouseExpo (.json), lists of wall segments (.csv), and
    floor plans in another unit than metres (.geojson).

    Attributes:
        source: the map.
        out: the floor plan to write (.geojson).
        resolution: of an image without .yaml file, metres per pixel.
        tracing: how the pixels of an occupancy map become walls.
        drawing: scale and layers of a drawing; the scale also of other lists of coordinates.
        picture: picture of the plan to write (.png, .pdf or .svg).
        json: print the report as JSON.
    """

    source: Positional[Path]
    out: Path
    resolution: float | None = None
    tracing: Tracing = field(default_factory=Tracing)
    drawing: Drawing = field(default_factory=Drawing)
    picture: Path | None = None
    json: bool = False

    def run(self) -> int:
        """Read, write and report."""
        if self.out.resolve() == self.source.resolve():
            raise ValueError(f"--out is the map itself, {self.source}; give another file")
        if self.picture:
            check_suffix(self.picture)
        outputs = {"--out": self.out, "--picture": self.picture}
        check_distinct(outputs)
        plan, report = import_map(self.source, self.resolution, self.tracing, self.drawing)
        for read in report.source:  # a .yaml file names its image
            check_distinct({"the map": Path(read), **outputs})
        save_floor_plan(plan, self.out)
        if self.picture:
            from semnav_env.world.maps.draw import save_picture

            save_picture(plan, self.picture)
        if self.json:
            print(json.dumps({**asdict(report), "out": str(self.out)}))
        else:
            print(f"{report}\nwrote {self.out}")
            print(f"`semnav map check {quote(str(self.out))}` says what is still wrong with it")
        return 0
