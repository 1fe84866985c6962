"""Bad inputs of every area, some of each; `make soak` tries more."""

from __future__ import annotations

import pytest

from tests.reliability.areas import AREAS, Area, try_area
from tests.reliability.hostile import settings_classes
from tests.test_layers import MODULES

COUNT = 20
"""Inputs of an area of share 1."""

ENDINGS = ("Settings", "Spec", "Rules", "Weights", "Setup")
NOT_SET_BY_USERS = {"SuiteSetup", "NetworkSettings"}  # the latter is a base without fields


@pytest.mark.parametrize("area", AREAS, ids=lambda area: area.name)
def test_bad_inputs_are_refused_or_harmless(area: Area) -> None:
    outcome = try_area(area, round(COUNT * area.share), number=1)
    assert not outcome.fault, outcome


def test_every_class_of_settings_checks_its_fields() -> None:
    checked = {kind.__name__ for kind in settings_classes()}
    named = {
        word.split("(")[0].rstrip(":")
        for module in MODULES.values()
        for line in module.path.read_text().splitlines()
        if line.startswith("class ")
        for word in [line.removeprefix("class ")]
    }
    settings = {name for name in named if name.endswith(ENDINGS)} - NOT_SET_BY_USERS
    assert settings <= checked
