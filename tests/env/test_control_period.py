"""One control period is made of the same parts for one robot and for many."""

from __future__ import annotations

from typing import Any

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.control_period import ends, info_of
from semnav_env.env import SemNavEnv
from semnav_env.judge import Judge, Period
from semnav_env.judge.judge_state import PERIOD
from semnav_env.judge.tasks import RewardWeights, Tick, weigh

LENGTHS = st.floats(-10.0, 10.0)
FLAGS = st.tuples(*[st.booleans()] * 5)
PERIODS = st.tuples(st.integers(0, 9), st.tuples(*[LENGTHS] * 3), st.integers(0, 9)).flatmap(
    lambda counts: st.tuples(LENGTHS, LENGTHS, FLAGS).map(
        lambda judged: Period(*counts, *judged[:2], *judged[2])
    )
)
ROBOTS = st.lists(st.tuples(PERIODS, st.integers(0, 9)), min_size=1, max_size=5)


def together(periods: list[Period]) -> Period:
    """The periods of several robots as one of arrays."""
    rows = np.array([tuple(each) for each in periods], PERIOD)
    return Period(*(rows[name] for name in Period._fields))


def bits(value: Any) -> bytes:
    return np.asarray(value, float).tobytes()


@given(ROBOTS)
def test_what_is_said_of_many_robots_is_what_is_said_of_each(
    robots: list[tuple[Period, int]],
) -> None:
    periods, limits = [period for period, _ in robots], [limit for _, limit in robots]
    many, weights = together(periods), RewardWeights()
    terms = weigh(np.array([weights.each] * len(robots)).T, *many.judged, many.in_contact)
    terminated, truncated = ends(many, np.array(limits))
    infos = info_of(many, np.array([("done",)] * len(robots)))
    for k, (period, limit) in enumerate(robots):
        own = weigh(weights.each, *period.judged, period.in_contact)
        assert {n: bits(v) for n, v in own.items()} == {n: bits(v[k]) for n, v in terms.items()}
        assert (terminated[k], truncated[k]) == ends(period, limit)
        info = info_of(period, ("done",))
        assert info.keys() == infos.keys()
        assert bits(info["pose"]) == bits(infos["pose"][k])


@given(PERIODS, st.integers(0, 9))
def test_an_episode_is_truncated_only_if_it_is_not_over(period: Period, limit: int) -> None:
    assert ends(period, limit) == (period.over, period.steps >= limit and not period.over)


def test_rewards_of_a_tick_are_those_of_its_period() -> None:
    """An agent's own rewards can build on the usual ones."""
    env = SemNavEnv()
    env.reset(seed=0)
    for _ in range(20):
        _, _, _, _, info = env.step(np.array([1.0, 0.4]))
        period, motion = env.judge.period, env.simulator.motion
        tick = Tick(*period.judged, motion, env.belief, np.zeros(2))
        assert env.rewards.terms(tick) == info["reward_terms"]


def test_the_period_counts_what_the_simulator_counts() -> None:
    env = SemNavEnv()
    env.reset(seed=1)
    for _ in range(10):
        env.step(np.array([1.0, 0.0]))
        period, motion = env.judge.period, env.simulator.motion
        assert (period.steps, period.pose) == (env.simulator.steps, motion.pose)
        assert period.in_contact == motion.in_contact


def test_a_judge_that_measures_no_way_says_the_same_of_clauses() -> None:
    env = SemNavEnv()
    env.reset(seed=0)
    judges = Judge(env.judge.mission), Judge(env.judge.mission, measures_way=False)
    for _ in range(60):
        env.step(np.array([1.0, 0.0]))
        one, other = (judge.update(env.simulator.motion) for judge in judges)
        assert one._replace(progress=0.0) == other
    assert judges[0].verdicts == judges[1].verdicts
