"""Where an episode begins if nothing is said."""

import itertools

import numpy as np
import pytest

from semnav_env.judge import plan_goals
from semnav_env.judge.tasks import EpisodeRequest, MissionMaker, starts
from semnav_env.judge.tasks.sampling import DOORS, TURNS, leads_nowhere
from semnav_env.judge.tasks.starts import LEAST_AHEAD, WIDEST_HALF
from semnav_env.language import Command
from semnav_env.mind.grounding import GroundingError
from semnav_env.robots import robot_spec
from semnav_env.rules import Rules
from semnav_env.world.maps import load_floor_plan
from semnav_features.corridor import corridor_at

PLAN = load_floor_plan("office_cross")


@pytest.mark.parametrize("plan", ["heidelberg_hallway", "office_cross"])
def test_a_random_start_looks_along_a_hallway(plan: str) -> None:
    floor_plan = load_floor_plan(plan)
    missions = MissionMaker(floor_plan, robot_spec("wheelchair"))
    rng = np.random.default_rng(0)
    for _ in range(20):
        x, y, heading = missions.make(EpisodeRequest(), rng).start
        views = [corridor_at(floor_plan.scene, (x, y, heading + turn)) for turn in (-0.2, 0.0, 0.2)]
        assert any(seen.end > LEAST_AHEAD and seen.half_width < WIDEST_HALF for seen in views)


def test_a_start_takes_the_same_draws_however_many_are_made_at_once(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    rngs = [np.random.default_rng(0) for _ in range(2)]
    for first_draws, rng in zip((512, 4), rngs, strict=True):
        monkeypatch.setattr(starts, "FIRST_DRAWS", first_draws)
        drawn = [starts.sample_start(PLAN, robot_spec("spot"), rng) for _ in range(10)]
        assert len(set(drawn)) == 10
    assert rngs[0].bit_generator.state == rngs[1].bit_generator.state


def test_a_clause_that_leads_nowhere_cannot_be_carried_out() -> None:
    rng, rules, refused = np.random.default_rng(0), Rules(), 0
    clauses = [*itertools.chain(*TURNS, *DOORS)]
    for _ in range(5):
        start = starts.sample_start(PLAN, robot_spec("spot"), rng)
        corridor = corridor_at(PLAN.scene, start)
        for clause in itertools.chain(*clauses):
            if leads_nowhere(clause, PLAN.scene, corridor, rules.grounding):
                refused += 1
                with pytest.raises(GroundingError):
                    plan_goals(PLAN, Command((clause,)), start)
    assert refused > 50
