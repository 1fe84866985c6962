"""`semnav map generate`: write a generated office to a file."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

from semnav_env.world.maps import generate_office, save_floor_plan
from semnav_features.plot import check_suffix
from semnav_scripts.outputs import counted


@dataclass(frozen=True)
class Arguments:
    """Generate an office; the same distribution and seed always give the same one.

    Attributes:
        distribution: small, medium, large or hard.
        seed: 0 or more.
        out: GeoJSON file to write; all commands also take office:DISTRIBUTION:SEED without a file.
        plot: picture to write (.png, .pdf or .svg).
        json: print JSON.
    """

    distribution: str = "medium"
    seed: int = 0
    out: Path | None = None
    plot: Path | None = None
    json: bool = False

    def run(self) -> int:
        """Generate the office, write the files, and print a summary."""
        if self.plot:
            check_suffix(self.plot)
        plan = generate_office(self.seed, self.distribution)
        written = [path for path in (self.out, self.plot) if path is not None]
        if self.out:
            save_floor_plan(plan, self.out)
        if self.plot:
            from semnav_env.world.maps.draw import save_picture

            save_picture(plan, self.plot)
        if self.json:
            counts = {"rooms": len(plan.rooms), "doors": len(plan.doors)}
            print(json.dumps({"name": plan.name, **counts, "files": list(map(str, written))}))
            return 0
        print(
            f"{plan.name}: {counted(len(plan.rooms), 'room')}, {counted(len(plan.doors), 'door')}"
        )
        for path in written:
            print(f"wrote {path}")
        return 0
