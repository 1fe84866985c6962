"""Cases to evaluate the extractor on, and what it found in them."""

import numpy as np

from semnav_env.world.maps import load_floor_plan
from semnav_features import Wall
from studies.features.cases import draw_cases
from studies.features.comparison import compare
from studies.features.records import CountingLimits, Detection, Sighting, as_table

OFFICE = load_floor_plan("office_cross")
WALL = Wall((0.0, -1.0), (4.0, -1.0), beams=100)


def cases(plan=OFFICE, poses=6, sigmas=(0.0, 0.02), clutter=True, seed=1):
    return list(draw_cases(plan, poses, sigmas, clutter, np.random.default_rng(seed)))


def tables(scan, truth, found):
    sightings, detections = compare(scan, truth, found, CountingLimits())
    return as_table(sightings, Sighting), as_table(detections, Detection)
