"""`semnav map`: list, show, check, generate, build, import and export floor plans."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

from tyro.conf import Positional, subcommand

from semnav_env.features.plot import check_suffix
from semnav_env.maps import FloorPlan, bundled_names, load_floor_plan
from semnav_env.maps.doorways import door_state
from semnav_env.scripts.map_build import MapBuild
from semnav_env.scripts.map_check import MapCheck
from semnav_env.scripts.map_export import MapExport
from semnav_env.scripts.map_generate import MapGenerate
from semnav_env.scripts.map_import import MapImport
from semnav_env.scripts.outputs import counted


@dataclass(frozen=True)
class MapList:
    """List the floor plans that come with the package.

    Attributes:
        json: print JSON.
    """

    json: bool = False

    def run(self) -> int:
        """Print one line for each plan."""
        plans = [summary(load_floor_plan(name)) for name in bundled_names()]
        print(json.dumps(plans) if self.json else "\n".join(_line(plan) for plan in plans))
        return 0


@dataclass(frozen=True)
class MapShow:
    """Show what a floor plan holds.

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


Arguments = (
    Annotated[MapList, subcommand("list")]
    | Annotated[MapShow, subcommand("show")]
    | Annotated[MapCheck, subcommand("check")]
    | Annotated[MapGenerate, subcommand("generate")]
    | Annotated[MapBuild, subcommand("build")]
    | Annotated[MapImport, subcommand("import")]
    | Annotated[MapExport, subcommand("export")]
)


def summary(plan: FloorPlan) -> dict[str, Any]:
    """What a plan holds, as JSON; metres."""
    west, south, east, north = plan.boundary.bounds
    return {
        "name": plan.name,
        "size": [round(east - west, 3), round(north - south, 3)],
        "bounds": [west, south, east, north],
        "segments": len(plan.segments),
        "doors": [
            {
                "name": door.name,
                "open": door.open,
                "state": door_state(door, plan).value,
                "width": round(door.width, 3),
                "start": door.start,
                "end": door.end,
            }
            for door in plan.doors
        ],
        "rooms": [room.name for room in plan.rooms],
        "corridors": [corridor.name for corridor in plan.corridors],
        "intersections": [crossing.name for crossing in plan.intersections],
        "source": plan.source,
    }


def _draw(plan: FloorPlan, path: Path) -> None:
    from semnav_env.maps.draw import save_picture

    path.parent.mkdir(parents=True, exist_ok=True)
    save_picture(plan, path)


def _line(plan: dict[str, Any]) -> str:
    width, height = plan["size"]
    doors, rooms = counted(len(plan["doors"]), "door"), counted(len(plan["rooms"]), "room")
    return f"{plan['name']:<20} {width:5.1f} x {height:.1f} m, {doors}, {rooms}"


def _paragraph(plan: dict[str, Any]) -> str:
    rows = [_line(plan), f"  source: {plan['source'] or 'not stated'}"]
    rows += [
        f"  {kind}: {', '.join(plan[kind]) or 'none'}"
        for kind in ("rooms", "corridors", "intersections")
    ]
    rows += [
        f"  door {door['name']}: {door['state']}, {door['width']:.2f} m wide"
        for door in plan["doors"]
    ]
    return "\n".join(rows)
