"""The planner's heuristic: compiled by itself, and right between cells that are closed."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

CODE = """
import math
import numpy as np
from semnav_agents.planning.collision import obstacle_field
from semnav_agents.planning.heuristic import COARSE_CELL, coarse_cell, seconds_at

field = obstacle_field(np.array([[0.5, 0.5]]), (0.0, 0.0), 2.0)
time = np.full((60, 60), math.inf)
j, i = coarse_cell(field, 0.0, 0.0)
time[j + 1, i - 1], time[j - 1, i] = 4.0, 3.0
assert seconds_at(field, time, 0.0, 0.0) == 3.0 + COARSE_CELL
assert seconds_at(field, time, 99.0, 0.0) == math.inf
time[j, i] = 7.0
assert seconds_at(field, time, 0.0, 0.0) == 7.0
"""


def test_a_closed_cell_takes_its_best_neighbour_and_is_compiled_first(tmp_path: Path) -> None:
    """In a process that compiled nothing before, as where one kept kernel is missing."""
    environment = os.environ | {"SEMNAV_CACHE_DIR": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, "-c", CODE], env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr[-2000:]
