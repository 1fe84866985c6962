"""The physics that compiled code steps is the one that Pymunk steps, bit for bit."""

from __future__ import annotations

import platform
import sys
from collections.abc import Callable

import numpy as np
import pytest

from semnav_env.robots import ROBOTS, SPOT
from semnav_env.world.dynamics import Dynamics
from semnav_env.world.physics import World, chipmunk, world
from semnav_env.world.physics.contacts import Contacts
from semnav_features.frames import MOST_CONTACTS, Contact, Pose
from tests.support.driving import at_the_wall, random_commands
from tests.support.moving_worlds import world_of
from tests.support.small_plans import empty_hall, furnished_hall

Moment = tuple[Pose, Pose, Contacts, list[Contact]]


SCRAPING = [(1.0, 0.2, 0.05)] * 60 + [(1.0, -0.2, -0.05)] * 60
CROWD = Dynamics(6, changing_doors=1.0)


def moments(driven: World, start: Pose, commands: list[Pose]) -> list[Moment]:
    """What a world says while a robot is driven about and into things."""
    found = []
    driven.reset(start, np.random.default_rng(3))
    for command in commands:
        driven.step(command)
        found.append((driven.pose, driven.velocity, driven.contacts, driven.touches))
    return found


@pytest.mark.parametrize("robot", ROBOTS)
@pytest.mark.parametrize(
    ("build", "start", "commands"),
    [
        (lambda r: World(furnished_hall(), ROBOTS[r]), (3.0, 2.0, 0.5), random_commands(5, 600)),
        (lambda r: World(empty_hall(12.0, 6.0), ROBOTS[r]), (6.0, 4.5, 0.6), SCRAPING),
        (lambda r: world_of("office_cross", r, CROWD), (3.0, 9.1, 0.0), random_commands(7, 400)),
    ],
    ids=["furniture", "along a wall", "people and leaves"],
)
def test_pymunk_drives_and_touches_as_compiled_code_does(
    build: Callable[[str], World],
    start: Pose,
    commands: list[Pose],
    robot: str,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    compiled = moments(build(robot), start, commands)
    monkeypatch.setattr(world, "chipmunk_can_be_called", lambda: False)
    assert moments(build(robot), start, commands) == compiled
    assert sum(contacts.count > 0 for _, _, contacts, _ in compiled) > 30
    assert sum(len(touches) for *_, touches in compiled) > 30


def test_of_many_contacts_the_first_are_kept() -> None:
    """A robot in a corner touches two walls, each at up to two points in each of 40 substeps."""
    cornered = World(empty_hall(), SPOT, substeps=40)
    cornered.reset((9.0, 5.0, 0.785))
    for _ in range(40):
        cornered.step((1.0, 0.0, 0.0))
    assert cornered.contacts.count > MOST_CONTACTS
    assert MOST_CONTACTS - 1 <= len(cornered.touches) <= MOST_CONTACTS


@pytest.mark.skipif(sys.platform != "linux", reason="other machines may need Pymunk's own path")
@pytest.mark.skipif(platform.machine() != "x86_64", reason="as above")
def test_compiled_code_drives_where_it_was_tested() -> None:
    assert chipmunk.chipmunk_can_be_called()


@pytest.mark.parametrize(("system", "machine"), [("win32", "AMD64"), ("linux", "riscv64")])
def test_an_unknown_convention_of_calling_is_left_to_pymunk(
    system: str, machine: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "platform", system)
    monkeypatch.setattr(platform, "machine", lambda: machine)
    assert not chipmunk.chipmunk_can_be_called.__wrapped__()


def test_other_results_than_pymunks_are_left_to_pymunk(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(chipmunk, "run_substeps", lambda record: None)
    assert not chipmunk.chipmunk_can_be_called.__wrapped__()


def test_a_contact_is_forgotten_in_the_next_period_and_at_a_reset() -> None:
    free, reset = at_the_wall(), at_the_wall()
    for _ in range(10):
        free.step((-1.0, 0.0, 0.0))
    reset.reset((3.0, 2.0, 0.5))
    for driven in (free, reset):
        assert (driven.in_contact, driven.contacts, driven.touches) == (False, Contacts(), [])
