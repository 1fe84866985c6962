from __future__ import annotations

import math
from dataclasses import FrozenInstanceError, fields

import numpy as np
import pytest

from semnav_features import ExtractorSettings
from semnav_features.strategies import BreakpointRule


def test_the_record_holds_every_field_by_name() -> None:
    settings = ExtractorSettings(sigma=0.03, wall_beams=7, one_sided_doors=False)
    record = settings.as_record()
    assert record.shape == (1,)
    for field in fields(settings):
        if not isinstance(field.default, str):
            assert record[0][field.name] == getattr(settings, field.name)


def test_the_record_holds_the_number_of_a_strategy() -> None:
    for rule in BreakpointRule:
        settings = ExtractorSettings(breakpoint_rule=rule.name.lower())
        assert settings.as_record()[0]["breakpoint_rule"] == rule


def test_settings_cannot_be_changed() -> None:
    with pytest.raises(FrozenInstanceError):
        ExtractorSettings().sigma = 1.0  # type: ignore[misc]


def test_every_field_is_described() -> None:
    described = ExtractorSettings.__doc__ or ""
    assert all(f"        {field.name}: " in described for field in fields(ExtractorSettings))


def test_numpy_numbers_become_python_numbers() -> None:
    settings = ExtractorSettings(sigma=np.float32(0.5), wall_beams=np.int64(9))  # type: ignore[arg-type]
    assert type(settings.sigma) is float
    assert type(settings.wall_beams) is int


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"sigma": -0.01}, "sigma is -0.01; it must be a number from 0 to 1000 m"),
        ({"sigma": math.nan}, "sigma is nan"),
        ({"rupture_range": math.inf}, "rupture_range is inf"),
        ({"sigma": "wide"}, "sigma is 'wide'; it must be a number"),
        ({"wall_beams": 4.5}, "wall_beams is 4.5; it must be a whole number"),
        ({"wall_beams": math.nan}, "wall_beams is nan; it must be a whole number"),
        ({"breakpoint_rule": "certat"}, "'certat'; it must be one of constant, borges_aldon, cer"),
        ({"breakpoint_rule": "CERTAD"}, "'CERTAD'; it must be one of"),
        ({"breakpoint_rule": 2}, "breakpoint_rule is 2; it must be one of"),
        ({"door_beams": 0}, "door_beams is 0; it must be a whole number from 1"),
        ({"one_sided_doors": 1}, "one_sided_doors is 1; it must be True or False"),
        ({"breakpoint_angle": 0.0}, "breakpoint_angle"),
        ({"door_clear_fraction": 1.5}, "from 0 to 1"),
        ({"door_width_min": 1.3}, "must be at most door_width_max, which is 1.2"),
        ({"merge_gap": 0.9}, "must be at most door_width_min"),
        ({"corridor_distance_min": 7.0}, "must be at most corridor_distance_max"),
    ],
)
def test_bad_limits_are_refused_with_their_range(values: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        ExtractorSettings(**values)  # type: ignore[arg-type]
