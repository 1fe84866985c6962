"""What is tried with bad inputs, area by area: a strategy, and what must hold for each input."""

from __future__ import annotations

import contextlib
import io
import math
import random
import tempfile
import time
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st

from semnav_env.env import SemNavEnv
from semnav_env.judge.tasks import RewardWeights
from semnav_env.judge.tasks.request import OPTIONS
from semnav_env.language import parse
from semnav_env.robots import SPOT, WHEELCHAIR, RobotSpec
from semnav_env.robots.actions import Actions
from semnav_env.world.lidar import Lidar
from semnav_env.world.physics import World
from semnav_env.world.simulator import OdometrySettings
from semnav_env.world.simulator.odometry import Odometry
from semnav_features import extract
from semnav_features.lidar_spec import LidarSpec
from semnav_features.settings import ExtractorSettings
from semnav_scripts.main import main
from tests.reliability.children import PROCESSOR_SECONDS, Outcome, in_child, outcome_of
from tests.reliability.hostile import VALUES, constructed, drawn, settings_classes, settings_of
from tests.reliability.long_texts import RUNS, read_run
from tests.reliability.mutations import write_mutated
from tests.reliability.readers import READERS, Reader
from tests.support.episodes import START
from tests.support.small_plans import empty_hall

HOSTILE = st.sampled_from(VALUES) | st.floats() | st.integers() | st.text(max_size=9)


class Area(NamedTuple):
    """One kind of bad inputs.

    Attributes:
        name: in the table.
        inputs: what is drawn.
        holds: raises for an input that does not end as it should.
        share: of the inputs of a run; those that take long get fewer.
    """

    name: str
    inputs: st.SearchStrategy[Any]
    holds: Callable[[Any], None]
    share: float = 1.0


def construct(change: tuple[type, dict[str, Any]]) -> None:
    """Settings are constructed or refused."""
    constructed(*change)


def drive(robot: RobotSpec) -> None:
    """Any body that was not refused drives through a hall, and stays finite and inside."""
    world = World(empty_hall(30.0, 20.0), robot)
    world.reset((0.0, 0.0, 0.3))
    for k in range(12):
        world.step((50.0 * (-1) ** (k // 5), 50.0, 50.0))
        assert all(map(math.isfinite, (*world.pose, *world.velocity))), world.pose
    assert abs(world.pose[0]) < 16.0, world.pose


def sweep(lidar: LidarSpec) -> None:
    """Any lidar that was not refused gives a scan, and that a scene."""
    few = replace(lidar, beams=min(lidar.beams, 2000))
    scene = extract(Lidar(empty_hall(), few).scan((0.3, 0.2, 0.1), key=(1, 2, 3)))
    ends = [x for wall in scene.walls for x in (*wall.start, *wall.end)]
    assert all(map(math.isfinite, ends)), ends


def look(limits: ExtractorSettings) -> None:
    """Any extractor that was not refused finds a finite scene."""
    scene = extract(_scan(), limits)
    ends = [x for wall in scene.walls for x in (*wall.start, *wall.end)]
    assert all(map(math.isfinite, ends)), ends


@cache
def _scan() -> Any:
    return Lidar(empty_hall()).scan((0.3, 0.2, 0.1), key=(1, 2, 3))


def reckon(errors: OdometrySettings) -> None:
    """Any odometry that was not refused stays finite."""
    odometry = Odometry(errors)
    odometry.reset((0.0, 0.0, 0.0), np.random.default_rng(1))
    for k in range(9):
        pose = odometry.update((0.1 * k, -0.2 * k, 0.7 * k))
        assert all(map(math.isfinite, pose)), pose


def reward(weights: RewardWeights) -> None:
    """Any weights that were not refused make finite rewards."""
    env = _env()
    env.rewards = weights
    env.reset(seed=1, options=START)
    assert math.isfinite(env.step([1.0, 0.0])[1])


def act(action: Any) -> None:
    """An action is a bounded velocity, or refused."""
    for robot in (WHEELCHAIR, SPOT):
        with contextlib.suppress(ValueError):
            twist = Actions(robot).twist(action)
            assert abs(twist[0]) <= robot.max_speed, twist
            assert abs(twist[2]) <= robot.max_turn_rate, twist


def begin(options: Any) -> None:
    """An episode begins as it is asked for, or is refused in one line."""
    outcome = outcome_of(lambda: _env().reset(seed=1, options=options))
    assert not outcome.fault or outcome.fault == "several lines", outcome


@cache
def _env() -> SemNavEnv:
    return SemNavEnv()


def understand(text: str) -> None:
    """A text is a command, or refused; a command says itself."""
    for language in ("en", "de"):
        with contextlib.suppress(ValueError):
            command = parse(text, language)
            assert parse(str(command)) == command


def call(words: list[str]) -> None:
    """A command line ends in 0, 1 or 2, and says one line if it is refused."""
    said, failed = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(failed):
        code = main(words)
    assert code in (0, 1, 2), code
    assert code != 2 or failed.getvalue().count("\n") == 1, failed.getvalue()[:2000]
    assert len(failed.getvalue()) < 2000


def read_damaged(reader: Reader) -> Callable[[int], None]:
    """A damaged file, which a number is the seed of, is read or refused."""

    @cache
    def sound() -> tuple[Path, Path]:
        folder = Path(tempfile.mkdtemp(prefix="semnav-soak-"))
        path = reader.make(folder)
        (folder / "sound").write_bytes(path.read_bytes())
        return folder / "sound", path

    def holds(number: int) -> None:
        original, path = sound()
        write_mutated(original, path, random.Random(number))
        outcome = outcome_of(lambda: reader.read(path), path.parent.name)
        assert not outcome.fault, outcome

    return holds


WORDS = ("--json", "--map", "office_cross", "--pose", "-1,0,0", "--out", "--help", "-2.5,-0.3,nan")
TEXTS = st.text(max_size=20) | st.sampled_from(("x" * 100_000, "\0", "../..", "1e400", "-1", ""))
LINES = st.tuples(
    st.sampled_from(("map", "ground", "extract", "describe", "nothing", "")),
    st.sampled_from(("show", "check", "import", "go through the door", "none.log", "")),
    st.lists(st.sampled_from(WORDS) | TEXTS, max_size=3),
).map(lambda parts: [*filter(None, parts[:2]), *parts[2]])
SAYINGS = st.lists(
    st.sampled_from(
        [
            "go",
            "turn",
            "left",
            "right",
            "the",
            "second",
            "door",
            "hallway",
            "3²",
            "1.000",
            "until",
            "then",
            "geh",
            "tür",
        ]
    )
    | TEXTS,
    max_size=9,
).map(" ".join)
ASKED = st.dictionaries(st.sampled_from(OPTIONS) | TEXTS, HOSTILE, max_size=3) | HOSTILE
ACTIONS = st.lists(HOSTILE, max_size=4) | HOSTILE | st.tuples(st.floats(), st.floats())
FIELDS = st.sampled_from(settings_classes()).flatmap(
    lambda kind: st.tuples(st.just(kind), drawn(kind))
)
SEEDS = st.integers(0, 2**62)

AREAS = (
    Area("fields of settings", FIELDS, construct),
    Area("bodies, driven", settings_of(RobotSpec), drive, 0.2),
    Area("lidars, looking around", settings_of(LidarSpec), sweep, 0.1),
    Area("extractors, on a scan", settings_of(ExtractorSettings), look, 0.2),
    Area("odometry, moved", settings_of(OdometrySettings), reckon, 0.2),
    Area("rewards, of a step", settings_of(RewardWeights), reward, 0.05),
    Area("actions", ACTIONS, act),
    Area("options of `reset`", ASKED, begin, 0.5),
    Area("texts as commands", SAYINGS, understand, 0.3),
    Area("long runs as commands", RUNS, read_run, 0.05),
    Area("command lines", LINES, call, 0.1),
    *(Area(f"damaged: {r.name}", SEEDS, read_damaged(r), 0.25) for r in READERS),
)
"""All areas, in the order of the table."""


def compile_kernels() -> None:
    """Compile what the areas call, so that their children need not."""
    reward(RewardWeights())
    look(ExtractorSettings())
    reckon(OdometrySettings())
    act([1.0, 0.0, 0.0])


def try_area(area: Area, count: int, number: int) -> Outcome:
    """Try a number of inputs in a child process.

    Args:
        area: what to try.
        count: number of inputs.
        number: seed of what is drawn.
    """

    @seed(number)
    @settings(
        max_examples=count,
        deadline=None,
        derandomize=False,
        database=None,
        phases=(Phase.generate,),
        suppress_health_check=list(HealthCheck),
    )
    @given(area.inputs)
    def tried(drawn_input: Any) -> None:
        begun = time.process_time()
        area.holds(drawn_input)
        used = time.process_time() - begun
        assert used < PROCESSOR_SECONDS, f"takes {used:.1f} s: {drawn_input!r:.500}"

    return in_child(tried, seconds=20.0 + 0.2 * count)
