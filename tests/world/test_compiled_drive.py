"""The physics that compiled code steps is the one that Pymunk steps, bit for bit."""

from __future__ import annotations

import platform
import sys

import pytest

from semnav_env.features.frames import Contact, Pose
from semnav_env.robots import ROBOTS, RobotSpec
from semnav_env.world import World, chipmunk, world
from semnav_env.world.contacts import Contacts
from tests.support.driving import at_the_wall, random_commands
from tests.support.small_plans import furnished_hall

Moment = tuple[Pose, Pose, Contacts, list[Contact]]


def moments(robot: RobotSpec) -> list[Moment]:
    """What a world says while a robot is driven about and into things."""
    driven, found = World(furnished_hall(), robot), []
    driven.reset((3.0, 2.0, 0.5))
    for command in random_commands(5, 600):
        driven.step(command)
        found.append((driven.pose, driven.velocity, driven.contacts, driven.touches))
    return found


@pytest.mark.parametrize("robot", ROBOTS.values(), ids=lambda robot: robot.name)
def test_pymunk_drives_as_compiled_code_does(
    robot: RobotSpec, monkeypatch: pytest.MonkeyPatch
) -> None:
    compiled = moments(robot)
    monkeypatch.setattr(world, "chipmunk_can_be_called", lambda: False)
    assert moments(robot) == compiled
    assert sum(contacts.count > 0 for _, _, contacts, _ in compiled) > 30


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
