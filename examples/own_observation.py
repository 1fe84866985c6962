"""Observations of one's own: an entry beside the usual ones, and a type that replaces them all.

One sees the spaces, and what they hold after a second of driving.
"""

import math
from typing import Any

import numpy as np
from gymnasium.spaces import Box

from semnav_env.env import SemNavEnv
from semnav_env.mind.observations import EntryObservation, Moment
from semnav_env.robots import RobotSpec


class NearestHit:
    """An entry: distance and direction of what is nearest to the lidar."""

    name = "nearest_hit"

    def space(self, robot: RobotSpec, lidar: Any) -> Box:
        """Metres, radians."""
        self.angles = lidar.angles
        return Box(np.float32([0, -math.pi]), np.float32([np.inf, math.pi]))

    def observe(self, moment: Moment) -> np.ndarray:
        """From the ranges of the last scan."""
        nearest = int(np.argmin(moment.tracker.ranges))
        return np.float32([moment.tracker.ranges[nearest], self.angles[nearest]])


class GoalOnly:
    """A whole observation: where to drive now, in the robot frame, and nothing else."""

    def space(self, robot: RobotSpec, lidar: Any) -> Box:
        """X and y, metres."""
        return Box(-np.inf, np.inf, (2,), np.float32)

    def observe(self, moment: Moment) -> np.ndarray:
        """Turn the goal from the odometry frame into the robot's."""
        x, y, heading = moment.belief.pose
        along, aside = moment.belief.target.pose[0] - x, moment.belief.target.pose[1] - y
        c, s = math.cos(heading), math.sin(heading)
        return np.float32([c * along + s * aside, c * aside - s * along])


def main() -> None:
    """Make both environments and drive a little."""
    for observation in (EntryObservation("raw", extra=[NearestHit()]), GoalOnly()):
        env = SemNavEnv(observation=observation)
        env.reset(seed=0, options={"pose": (-2.5, -0.3, 0.24)})
        for _ in range(15):
            seen = env.step(np.array([0.5, 0.0]))[0]
        print(type(observation).__name__)
        named = seen.items() if isinstance(seen, dict) else [("goal", seen)]
        for name, value in named:
            print(f"  {name}: shape {value.shape}, starts with {value[:2].round(2)}")


if __name__ == "__main__":
    main()
