"""The judge and the second opinion, which share no code, agree."""

from __future__ import annotations

import ast
from collections import Counter
from dataclasses import replace
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_agents.evaluation import drive
from semnav_agents.oracle import OracleAgent
from semnav_env.env import SemNavEnv
from semnav_env.judge import FAILURES, Judge, Verdict, plan_mission
from semnav_env.judge import reading_judge as first
from semnav_env.judge import recheck as second
from semnav_env.judge.astray import wrong_arms
from semnav_env.judge.metrics import Recording
from semnav_env.judge.recheck import recheck
from semnav_env.judge.tasks.sampling import sample_mission
from semnav_env.language import Clause, Command, GoBack, GoToRoom, parse
from semnav_env.language.rooms import plain_name
from semnav_env.language.sampling import sample_command
from semnav_env.mind.grounding import Goal, GroundingError
from semnav_env.robots import WHEELCHAIR
from semnav_env.rules import Rules, SuccessRules
from semnav_env.world.maps import bundled_names, load_floor_plan
from semnav_env.world.maps.geodesic import Geodesic
from semnav_env.world.maps.placement import sample_pose
from semnav_features.frames import FloatArray, Pose
from tests.support.erring import ErringAgent, ghost, targets

PLANS = {name: load_floor_plan(name) for name in bundled_names()}
GEODESICS = {name: Geodesic(plan) for name, plan in PLANS.items()}


def glide(name: str, seed: int) -> tuple[Judge, Recording] | None:
    """A random command on a plan and a ghost that carries it out, more or less."""
    plan, rng = PLANS[name], np.random.default_rng(seed)
    start = sample_pose(plan, WHEELCHAIR, rng)
    judge = next(filter(None, (judge_of_any(name, start, rng) for _ in range(40))), None)
    if judge is None:
        return None
    times = rng.choice((0.0, 0.2, 3.0)), rng.choice((0.0, 2.0, 9.9, 10.1, 12.0))
    wobble = rng.choice((0.0, 0.1, 0.3))
    points = targets(plan, judge, rng)
    return judge, ghost(judge, points, rng, wobble=wobble, pause=times[0], stand=times[1])


def judge_of_any(name: str, start: Pose, rng: np.random.Generator) -> Judge | None:
    """The judge of a random command, of any kind half of the time; None if not feasible."""
    drawn = sample_mission(PLANS[name], GEODESICS[name], start, rng)
    command = drawn and drawn.command
    kind = rng.integers(8)
    if kind < 3:
        command = sample_command(rng, 4, 3)
    elif kind == 3 and command is not None:
        command = Command((*command.clauses, GoBack()))
    elif kind == 4:
        rooms = PLANS[name].rooms
        command = Command((GoToRoom(plain_name(rooms[rng.integers(len(rooms))].name)),))
    try:
        return command and Judge(plan_mission(PLANS[name], GEODESICS[name], command, start))
    except GroundingError:
        return None


@pytest.mark.parametrize("name", PLANS)
def test_both_judge_gliding_ghosts_alike(name: str) -> None:
    seen: Counter[Verdict] = Counter()
    for seed in range(100):
        glided = glide(name, seed)
        if glided is None:
            continue
        judge, recording = glided
        found = recheck(recording, judge.mission.floor_plan, judge.goals)
        assert found.verdict == judge.verdict, f"seed {seed}: {judge.mission.command}"
        early = judge.verdict is Verdict.STOPPED_SHORT or not judge.goals  # nothing to do
        assert abs(found.step - recording.steps) <= 1 or early  # sums of periods are not exact
        seen[judge.verdict] += 1
    assert seen[Verdict.DONE] > 20
    assert seen[Verdict.WRONG_DOOR] > 5
    assert sum(seen.values()) > 60


def test_every_way_to_fail_is_among_the_ghosts() -> None:
    glides = [glide("office_cross", seed) for seed in range(60)]
    seen = {glided[0].verdict for glided in glides if glided is not None}
    assert seen == {Verdict.DONE, *FAILURES} - {Verdict.INCOMPLETE}  # that of searches


@pytest.mark.parametrize("name", PLANS)
@pytest.mark.parametrize("robot", ["wheelchair", "spot"])
def test_both_judge_driven_episodes_alike(name: str, robot: str) -> None:
    env = SemNavEnv(robot, PLANS[name], observation="truth", max_seconds=25.0)
    for seed, agent in enumerate((OracleAgent(), ErringAgent(1), ErringAgent(2))):
        driven = drive(env, agent, seed, {})
        assert driven.rechecked() == ""
        assert driven.metrics.success == (driven.judge.verdict is Verdict.DONE)


def arms_that_end_sooner(clause: Clause, goal: Goal, rules: SuccessRules) -> FloatArray:
    return wrong_arms(clause, goal, replace(rules, wrong_arm_depth=0.6))


@pytest.mark.parametrize(
    ("module", "name", "value"),
    [
        (first, "wrong_arms", arms_that_end_sooner),
        (first, "may_cross", lambda *_: True),
    ],
)
def test_a_judge_that_judges_otherwise_is_found_out(
    monkeypatch: pytest.MonkeyPatch, module: ModuleType, name: str, value: object
) -> None:
    monkeypatch.setattr(module, name, value)
    glides = [glide("office_cross", seed) for seed in range(60)]
    verdicts = [
        (judge.verdict, recheck(recording, judge.mission.floor_plan, judge.goals).verdict)
        for judge, recording in filter(None, glides)
    ]
    assert any(one != other for one, other in verdicts)


def test_other_rules_give_other_verdicts() -> None:
    rules = Rules(success=SuccessRules(still_speed=2.0, still_yaw_rate=2.0))
    glides = [glide("office_cross", seed) for seed in range(60)]
    verdicts = [
        (judge.verdict, recheck(recording, judge.mission.floor_plan, judge.goals, rules).verdict)
        for judge, recording in filter(None, glides)
    ]
    assert any(one != other for one, other in verdicts)


def test_a_disagreement_is_told() -> None:
    """A judge that is led to believe in another path is found out."""
    env = SemNavEnv(observation="truth", max_seconds=25.0)
    driven = drive(env, OracleAgent(), 0, {})
    assert driven.judge.success
    driven.judge.leading.failure = Verdict.WRONG_DOOR
    assert driven.rechecked() == "done"


def walked(*points: tuple[float, float], heading: float = 0.0) -> Recording:
    path = np.array(points, dtype=np.float64)
    count = len(path)
    poses = np.column_stack((path, np.full(count, heading)))
    speeds = np.column_stack((np.ones(count), np.zeros((count, 2))))
    return Recording(poses, speeds, np.zeros(count, dtype=np.int64), np.zeros(count), 1 / 15)


@pytest.mark.parametrize(
    ("command", "points", "verdict"),
    [
        ("go through the first door on the right", [(3.4, 9.0), (3.4, 7.0)], "done"),
        ("go through the second door on the right", [(3.4, 9.0), (3.4, 7.0)], "wrong door"),
        ("go through the first door on the right", [(6.0, 9.0)], "out of time"),
        ("turn right at the intersection", [(15.0, 9.1), (15.0, 12.5)], "wrong turn"),
        ("turn right at the intersection", [(20.0, 9.1)], "wrong turn"),
        ("follow the hallway until the end", [(28.9, 9.1)], "done"),
    ],
)
def test_plain_walks_are_judged_as_by_hand(
    command: str, points: list[tuple[float, float]], verdict: str
) -> None:
    start = (1.3, 9.1, 0.0)
    judge = Judge(
        plan_mission(PLANS["office_cross"], GEODESICS["office_cross"], parse(command), start)
    )
    recording = walked(start[:2], *points)
    assert recheck(recording, judge.mission.floor_plan, judge.goals).verdict == verdict


@given(st.integers(0, 10_000))
def test_what_comes_after_the_end_changes_nothing(seed: int) -> None:
    start = (1.3, 9.1, 0.0)
    command = parse("go through the first door on the right")
    judge = Judge(plan_mission(PLANS["office_cross"], GEODESICS["office_cross"], command, start))
    more = np.random.default_rng(seed).uniform(0.0, 25.0, (5, 2)).tolist()
    recording = walked(start[:2], (3.4, 9.0), (3.4, 7.0), *map(tuple, more))
    found = recheck(recording, judge.mission.floor_plan, judge.goals)
    assert (found.verdict, found.step) == ("done", 2)


def test_the_second_opinion_imports_no_judge_or_follower() -> None:
    tree = ast.parse(Path(second.__file__).read_text())
    names = {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
    names |= {a.name for node in ast.walk(tree) if isinstance(node, ast.Import) for a in node.names}
    assert not [
        name for name in names if name.endswith(("judge.judge", "reading_judge", "follower"))
    ]
