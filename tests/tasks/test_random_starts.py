"""Where an episode begins if nothing is said."""

import numpy as np
import pytest

from semnav_env.features.corridor import corridor_at
from semnav_env.maps import load_floor_plan
from semnav_env.robots import robot_spec
from semnav_env.tasks import EpisodeRequest, MissionMaker
from semnav_env.tasks.starts import LEAST_AHEAD, WIDEST_HALF


@pytest.mark.parametrize("plan", ["heidelberg_hallway", "office_cross"])
def test_a_random_start_looks_along_a_hallway(plan: str) -> None:
    floor_plan = load_floor_plan(plan)
    missions = MissionMaker(floor_plan, robot_spec("wheelchair"))
    rng = np.random.default_rng(0)
    for _ in range(20):
        x, y, heading = missions.make(EpisodeRequest(), rng).start
        views = [corridor_at(floor_plan.scene, (x, y, heading + turn)) for turn in (-0.2, 0.0, 0.2)]
        assert any(seen.end > LEAST_AHEAD and seen.half_width < WIDEST_HALF for seen in views)
