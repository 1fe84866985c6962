"""`python -m studies places`: corridors told from other places by single scans."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path

from semnav_features import ExtractorSettings
from studies.places.passage import PassageLimits
from studies.places.place_scans import (
    CLUTTER_SLICES,
    CORRIDOR_LABEL,
    called_corridor,
    place_sheets,
    read_place_labels,
)


@dataclass(frozen=True)
class Arguments:
    """Measure how well single scans tell a corridor from other places.

    Attributes:
        data: folder with clutter_slices/clutter_slices.npz, or such a file.
        corridor: label of the place that is a corridor.
        settings: of the extractor.
        limits: what a corridor is.
        json: print the tables as JSON.
    """

    data: Path
    corridor: str = CORRIDOR_LABEL
    settings: ExtractorSettings = field(default_factory=ExtractorSettings)
    limits: PassageLimits = field(default_factory=PassageLimits)
    json: bool = False

    def run(self) -> int:
        """Measure and print."""
        path = self.data / CLUTTER_SLICES if self.data.is_dir() else self.data
        labels = read_place_labels(path)
        called = called_corridor(path, self.settings, self.limits)
        sheets = list(place_sheets(labels, called, self.corridor))
        if self.json:
            print(json.dumps({sheet.title: sheet.records() for sheet in sheets}))
        else:
            print("\n\n".join(sheet.markdown() for sheet in sheets))
        return 0
