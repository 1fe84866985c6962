"""What an agent observes: declared once, packed into one row per step, read back by name."""

from semnav_env.observations.layout import ENTRIES, GOAL, MODES, TABLES, UNBOUNDED, Entry
from semnav_env.observations.observer import (
    EntryObservation,
    ExtraEntry,
    Moment,
    ObservationType,
    as_observation,
)
from semnav_env.observations.readers import SeenGoal, read_odometry, table

__all__ = [
    "ENTRIES",
    "GOAL",
    "MODES",
    "TABLES",
    "UNBOUNDED",
    "Entry",
    "EntryObservation",
    "ExtraEntry",
    "Moment",
    "ObservationType",
    "SeenGoal",
    "as_observation",
    "read_odometry",
    "table",
]
