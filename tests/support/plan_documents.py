"""A small floor plan as the document that a file holds."""

from __future__ import annotations

import copy
import json
from typing import Any

from semnav_env.world.maps import FloorPlan
from semnav_env.world.maps.reader import parse_plan

Document = dict[str, Any]

# a hall of 4 x 3 m with an open, a closed and a half-open door in its south wall
HALL: list[tuple[str, Any, dict[str, Any]]] = [
    ("Polygon", [[[0, 0], [9, 0], [9, 3], [0, 3], [0, 0]]], {"kind": "boundary"}),
    ("LineString", [[1, 0], [0, 0], [0, 3], [9, 3], [9, 0], [8, 0]], {"kind": "wall"}),
    ("LineString", [[2, 0], [4, 0]], {"kind": "wall"}),
    ("LineString", [[5, 0], [7, 0]], {"kind": "wall", "assumed": True}),
    ("LineString", [[4, 0], [5, 0]], {"kind": "leaf"}),
    ("LineString", [[7, 0], [7.5, 0.866]], {"kind": "leaf"}),
    ("LineString", [[1, 0], [2, 0]], {"kind": "door", "name": "one", "state": "open"}),
    ("LineString", [[4, 0], [5, 0]], {"kind": "door", "name": "two", "state": "closed"}),
    ("LineString", [[7, 0], [8, 0]], {"kind": "door", "name": "three", "state": "half-open"}),
    ("Polygon", [[[0, 0], [9, 0], [9, 3], [0, 3], [0, 0]]], {"kind": "corridor", "name": "hall"}),
    ("Polygon", [[[3, 2], [4, 2], [4, 3], [3, 2]]], {"kind": "furniture", "note": "a desk"}),
]


def hall() -> Document:
    features = [
        {"type": "Feature", "properties": p, "geometry": {"type": t, "coordinates": c}}
        for t, c, p in copy.deepcopy(HALL)
    ]
    return {"type": "FeatureCollection", "name": "hall", "features": features}


def parse(document: Document) -> FloorPlan:
    return parse_plan(json.dumps(document), "hall.geojson", "hall")
