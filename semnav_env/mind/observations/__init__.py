"""Observations of an agent: declared once, packed into one row per step, read by name."""

from typing import TYPE_CHECKING

from semnav_env.mind.observations.checking import check_observation
from semnav_env.mind.observations.layout import (
    ENTRIES,
    GOAL,
    MEMORY_ENTRIES,
    MEMORY_TABLES,
    MODES,
    TABLES,
    UNBOUNDED,
    Entry,
)
from semnav_env.mind.observations.observer import (
    EntryObservation,
    ExtraEntry,
    Moment,
    ObservationType,
    as_observation,
)
from semnav_features.lazy_names import lazy_names

if TYPE_CHECKING:
    from semnav_env.mind.observations.cloud_entry import CloudEntry
    from semnav_env.mind.observations.instruction import InstructionEntry
    from semnav_env.mind.observations.pace_entry import PaceEntry, read_pace
    from semnav_env.mind.observations.readers import SeenGoal, read_odometry, table

__all__ = [
    "ENTRIES",
    "GOAL",
    "MEMORY_ENTRIES",
    "MEMORY_TABLES",
    "MODES",
    "TABLES",
    "UNBOUNDED",
    "CloudEntry",
    "Entry",
    "EntryObservation",
    "ExtraEntry",
    "InstructionEntry",
    "Moment",
    "ObservationType",
    "PaceEntry",
    "SeenGoal",
    "as_observation",
    "check_observation",
    "read_odometry",
    "read_pace",
    "table",
]

__getattr__ = lazy_names(
    __name__,
    {
        ".cloud_entry": ("CloudEntry",),
        ".instruction": ("InstructionEntry",),
        ".pace_entry": ("PaceEntry", "read_pace"),
        ".readers": ("SeenGoal", "read_odometry", "table"),
    },
)
