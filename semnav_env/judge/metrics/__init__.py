"""Measures of driven episodes: plain functions over recorded arrays."""

from semnav_env.judge.metrics.measure import measure
from semnav_env.judge.metrics.motion import clearances, collisions_per_100m, rms_jerk
from semnav_env.judge.metrics.paths import cls, dtw, ndtw, resampled, sdtw, soft_spl, spl
from semnav_env.judge.metrics.recording import Recorder, Recording
from semnav_env.judge.metrics.results import COST_METRICS, METRIC_NAMES, Metrics, means, worst
from semnav_env.judge.metrics.risk import WORST_SHARES, cvar

__all__ = [
    "COST_METRICS",
    "METRIC_NAMES",
    "WORST_SHARES",
    "Metrics",
    "Recorder",
    "Recording",
    "clearances",
    "cls",
    "collisions_per_100m",
    "cvar",
    "dtw",
    "means",
    "measure",
    "ndtw",
    "resampled",
    "rms_jerk",
    "sdtw",
    "soft_spl",
    "spl",
    "worst",
]
