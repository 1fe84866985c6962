"""Small maps of pixels, and labels beside them, for tests."""

import numpy as np
from PIL import Image

SOLID, FREE, UNKNOWN = 0, 254, 205


def write_map(folder, grey, name="floor", **fields):
    """A map of map_server: an image and its YAML file."""
    Image.fromarray(np.asarray(grey, dtype=np.uint8)).save(folder / f"{name}.pgm")
    told = {"image": f"{name}.pgm", "resolution": 0.1, "origin": [0.0, 0.0, 0.0]} | fields
    path = folder / f"{name}.yaml"
    path.write_text("".join(f"{key}: {value}\n" for key, value in told.items()))
    return path


def two_rooms():
    """Two rooms of 3 m, a door of 0.9 m between them, and one that is closed to the south."""
    grey = np.full((34, 67), FREE)
    grey[[0, 1, -1, -2], :] = SOLID
    grey[:, [0, 1, 32, 33, 34, -1, -2]] = SOLID
    grey[12:21, 32:35] = FREE
    return grey


def narrowing(folder):
    """Two rooms and a door of 0.6 m, which straightening would narrow to less than 0.5 m.

    Its jambs lie a pixel behind the rough faces of two cabinets and are put on one line with them.
    """
    grey = two_rooms()
    grey[12:21, 32:35] = SOLID
    grey[13:19, 32:35] = FREE
    for rows, rough, columns in ((slice(13), 13, slice(6, 22)), (slice(19, 34), 18, slice(44, 60))):
        grey[rows, columns] = SOLID
        grey[rough, columns.start : columns.stop : 2] = SOLID
    (folder / "locations.yaml").write_text(PLACES)
    (folder / "doors.yaml").write_text(
        "- {name: narrow, door_corner_pt_1: [3.2, 1.35], door_corner_pt_2: [3.15, 2.1], "
        "approach: [{from: west, point: [2, 2, 0]}]}\n"
    )
    return write_map(folder, grey, resolution=0.095)


DOORS = """
- name: between
  door_corner_pt_1: [3.4, 1.2]
  door_corner_pt_2: [3.3, 2.3]
  approach: [{from: west, point: [2, 2, 0]}]
- {name: south, door_corner_pt_1: [1, 0.1], door_corner_pt_2: [2, 0.1]}
- {name: nowhere, door_corner_pt_1: [1, 1.5], door_corner_pt_2: [2, 1.5]}
"""
PLACES = """
locations: [west, east]
polygons: [[2, 2, 32, 2, 32, 32, 2, 32, 2, 2], [35, 2, 65, 2, 65, 32, 35, 32]]
"""
