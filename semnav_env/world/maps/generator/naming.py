"""Names of generated offices: "office:medium:17" has seed 17 and distribution "medium".

The name is one word without blanks or slashes, so that it is never taken for a path and needs no
quotes in a shell. It determines the whole plan, so that a process needs only the name.
"""

from __future__ import annotations

import re
from numbers import Integral

from rapidfuzz import process

from semnav_env.world.maps.floor_plan import OFFICE_PREFIX, FloorPlan
from semnav_env.world.maps.generator.distributions import NAMED_SETTINGS
from semnav_env.world.maps.generator.settings import OfficeSettings

CUSTOM_DISTRIBUTION = "custom"
"""Name for settings that do not belong to a fixed distribution."""

MAX_SEED = 2**63 - 1
"""Largest seed."""


def generate_office(seed: int, settings: str | OfficeSettings = "medium") -> FloorPlan:
    """An office with corridors, rooms, doors, furniture and names.

    The same seed and settings give the same plan, byte for byte when written. The plan's name, as
    "office:medium:17", is one that `load_floor_plan` takes, if the settings are those of a
    distribution.

    Args:
        seed: 0 or more.
        settings: the name of a distribution (small, medium, large, hard, house), or ranges of
            one's own.

    Raises:
        ValueError: no such distribution, an invalid seed, or settings that no office meets.
    """
    if isinstance(seed, bool) or not isinstance(seed, Integral) or not 0 <= seed <= MAX_SEED:
        raise ValueError(f"the seed is {seed!r}; give a whole number from 0 to {MAX_SEED}")
    from semnav_env.world.maps.generator.office import (
        draw_office,  # most environments need no office
    )

    ranges = distribution(settings) if isinstance(settings, str) else settings
    names = [name for name, fixed in NAMED_SETTINGS.items() if fixed == ranges]
    return draw_office(
        int(seed), ranges, office_name(names[0] if names else CUSTOM_DISTRIBUTION, seed)
    )


def office_name(distribution: str, seed: int) -> str:
    """The name of an office, as "office:medium:17"."""
    return f"{OFFICE_PREFIX}:{distribution}:{seed}"


def office_named(name: str) -> FloorPlan:
    """The generated office of a name.

    Raises:
        ValueError: not of the form "office:medium:17", or no such distribution.
    """
    match = re.fullmatch(rf"{OFFICE_PREFIX}:([a-z]+):(0|[1-9][0-9]{{0,18}})", name)
    if match is None:
        raise ValueError(
            f"{name[:80]!r} names no generated office; write "
            f"{OFFICE_PREFIX}:DISTRIBUTION:SEED, as in {office_name('medium', 17)}"
        )
    return generate_office(int(match[2]), match[1])


def distribution(name: str) -> OfficeSettings:
    """The distribution of that name.

    Raises:
        ValueError: no such distribution; lists those there are.
    """
    if name in NAMED_SETTINGS:
        return NAMED_SETTINGS[name]
    near = process.extractOne(name[:80], list(NAMED_SETTINGS), score_cutoff=60)
    hint = f"; did you mean {near[0]}?" if near else ""
    known = ", ".join(NAMED_SETTINGS)
    raise ValueError(f"no distribution of offices named {name[:80]!r}; there are: {known}{hint}")
