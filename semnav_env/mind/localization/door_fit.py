"""Fits a door of the plan to a detected one: the filter's update and its Mahalanobis distance."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from semnav_env.mind.localization.dead_reckoning import ReckonedState, symmetric
from semnav_env.mind.localization.door_pose import seen_jambs
from semnav_features.clouds.detected_door import DetectedDoor
from semnav_features.elements import Door
from semnav_features.frames import FloatArray, Pose, wrap_angle

ITERATIONS = 4
"""Steps of an iterated update; the last of them are shorter than a micrometre."""


@dataclass(frozen=True, eq=False)
class DoorFit:
    """The update under the assumption that a detected door is a given door of the plan.

    Attributes:
        door: the door of the plan, world frame.
        distance: squared Mahalanobis distance between the two doors.
        state: the state after the update.
    """

    door: Door
    distance: float
    state: ReckonedState


def fitted(prior: ReckonedState, door: Door, detected: DetectedDoor, plan_sigma: float) -> DoorFit:
    """Iterated extended Kalman update (Bell and Cathey 1993), covariance in Joseph's form.

    Each step linearises about the last result x_i: with the residual r = z - h(x_i), its Jacobian
    H, the noise R and the prior x_0, P,

        d = r + H (x_i - x_0),  S = H P H^T + R,  x_{i+1} = x_0 + P H^T S^-1 d,

    and d^T S^-1 d is the squared Mahalanobis distance.

    Args:
        prior: the state before the update.
        door: the door of the plan, world frame.
        detected: the detected door, robot frame.
        plan_sigma: standard deviation of each jamb of the plan, metres.
    """
    update = _linear_update(np.zeros(6), prior, door, detected, plan_sigma)
    for _ in range(ITERATIONS - 1):
        update = _linear_update(update.step, prior, door, detected, plan_sigma)
    step, gain, covariance = update.step, update.gain, prior.covariance
    kept = np.eye(6) - gain @ update.jacobian
    distance_error, turn_error, veer = np.add(prior.biases, step[3:]).tolist()
    state = ReckonedState(
        _shifted(prior.pose, step),
        (distance_error, turn_error, veer),
        symmetric(kept @ covariance @ kept.T + gain @ update.noise @ gain.T),
    )
    return DoorFit(door, update.distance, state)


class LinearUpdate(NamedTuple):
    """One step of `fitted`.

    Attributes:
        step: x_{i+1} - x_0, shape (6,).
        distance: squared Mahalanobis distance.
        gain: P H^T S^-1, shape (6, n).
        jacobian: H, shape (n, 6).
        noise: R, shape (n, n).
    """

    step: FloatArray
    distance: float
    gain: FloatArray
    jacobian: FloatArray
    noise: FloatArray


def _linear_update(
    about: FloatArray, prior: ReckonedState, door: Door, detected: DetectedDoor, plan_sigma: float
) -> LinearUpdate:
    """The step that follows when linearised about x_0 + `about`."""
    residual, by_pose, noise = seen_jambs(_shifted(prior.pose, about), door, detected)
    noise = noise + plan_sigma**2 * np.eye(len(noise))
    jacobian = np.hstack((by_pose, np.zeros_like(by_pose)))
    spread = jacobian @ prior.covariance @ jacobian.T + noise
    innovation = residual + jacobian @ about
    gain = np.asarray(np.linalg.solve(spread, jacobian @ prior.covariance).T, np.float64)
    distance = float(innovation @ np.linalg.solve(spread, innovation))
    return LinearUpdate(gain @ innovation, distance, gain, jacobian, noise)


def _shifted(pose: Pose, step: FloatArray) -> Pose:
    dx, dy, turn = step[:3].tolist()
    return pose[0] + dx, pose[1] + dy, wrap_angle(pose[2] + turn)
