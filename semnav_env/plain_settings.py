"""Settings as plain dictionaries, which is what JSON makes of a specification of an environment.

`env.spec.to_json()` writes each settings object as a dictionary of all its fields. The environment
takes such a dictionary in place of the object, so that `EnvSpec.from_json(...)` makes the same.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from difflib import get_close_matches
from typing import Any, cast, get_type_hints

from semnav_env.judge.tasks import RewardWeights
from semnav_env.robots import RobotSpec
from semnav_env.rules import Rules
from semnav_env.world.dynamics import Dynamics
from semnav_env.world.simulator import OdometrySettings
from semnav_features import ExtractorSettings
from semnav_features.lidar_spec import LidarSpec

SETTINGS: dict[str, type] = {
    "robot": RobotSpec,
    "lidar": LidarSpec,
    "odometry": OdometrySettings,
    "extractor": ExtractorSettings,
    "rewards": RewardWeights,
    "dynamics": Dynamics,
    "rules": Rules,
}
"""Arguments of the environment that may be dictionaries, and what these stand for."""


def no_argument(name: str, known: list[str]) -> TypeError:
    """The error that names the argument of the environment that was meant."""
    near = get_close_matches(name, known, 1)
    hint = f"did you mean {near[0]!r}?" if near else f"there are: {', '.join(known)}"
    return TypeError(f"SemNavEnv has no argument {name!r}; {hint}")


def from_plain(value: Any, kind: Any) -> Any:
    """The settings object that a dictionary of all its fields describes; the inverse of `asdict`.

    Lists become tuples. Anything else is left as it is, for the environment to take or refuse.

    Args:
        value: a dictionary, or a value of a field.
        kind: the dataclass that a dictionary stands for, or another type.

    Raises:
        ValueError: a field has a value that is wrong.
    """
    if isinstance(value, list | tuple):
        return tuple(from_plain(each, None) for each in value)
    if not (is_dataclass(kind) and isinstance(value, Mapping)):
        return value
    if value.keys() != {field.name for field in fields(kind)}:
        return value
    hints = get_type_hints(kind)
    return cast(Any, kind)(**{name: from_plain(each, hints[name]) for name, each in value.items()})
