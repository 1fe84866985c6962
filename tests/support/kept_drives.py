"""Drives as they are kept, made by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from semnav_agents.evaluation import Result
from semnav_agents.evaluation.kept_drive import KeptDrive
from semnav_env.judge.metrics.final_belief import FinalBelief
from semnav_env.robots import robot_spec
from semnav_env.world.maps import load_floor_plan
from semnav_features.scene import Door
from tests.support.evaluated import result

MOMENTS = 30


def kept_drive(floor_plan: str = "heidelberg_hallway") -> KeptDrive:
    """A metre along the hallway past a person, with a contact in its middle."""
    along = np.linspace(0.0, 1.0, MOMENTS)
    poses = np.column_stack((along - 2.5, 0.24 * along - 0.3, np.full(MOMENTS, 0.24)))
    touched = np.zeros(MOMENTS, dtype=bool)
    touched[MOMENTS // 2] = True
    return KeptDrive(
        floor_plan=load_floor_plan(floor_plan),
        robot=robot_spec("wheelchair"),
        clauses=("stop",),
        seconds=6.0,
        poses=poses,
        touched=touched,
        people=np.tile([0.0, 0.5, 0.25], (MOMENTS, 1, 1)),
        leaves=np.zeros((0, 4)),
        route=np.array([(-2.5, -0.3), (0.0, 0.0)]),
        goals=((0.0, 0.0),),
        belief=FinalBelief((Door((0.0, -1.0), (1.0, -1.0)),), (1.0, 0.0)),
    )


def failure(seed: int = 0, kind: str = "Turn", cause: str = "crossed a, wanted b") -> Result:
    """A failure whose drive was kept."""
    return replace(
        result(False, seed=seed),
        kind=kind,
        cause=cause,
        group="stop",
        floor_plan="heidelberg_hallway",
        kept=kept_drive(),
    )
