"""A lidar of one's own: a full circle of 720 beams, 12 m far, 40 times a second.

Its rate is the control rate: one step of the environment is one sweep. One sees how long a step is,
and what the features of the first scan are, from the TiM561 and from this lidar.
"""

import math

import numpy as np

from semnav_env.env import SemNavEnv
from semnav_env.mind.observations import table
from semnav_env.world.lidar import LidarSpec

AROUND = LidarSpec(
    name="around",
    beams=720,
    angle_min=-math.pi,
    angle_increment=2.0 * math.pi / 720,
    range_max=12.0,
    rate_hz=40.0,
    sigma=0.01,
    source="an example",
)


def main() -> None:
    """Look from the same place with both."""
    for lidar in ("tim561", AROUND):
        env = SemNavEnv(lidar=lidar, observation="all", max_seconds=60.0)
        observation, _ = env.reset(seed=0, options={"pose": (-2.5, -0.3, 0.24)})
        walls, doors = table(observation, "walls"), table(observation, "doors")
        print(f"{env.lidar_spec.name}: {observation['scan'].size} beams", end=", ")
        print(f"{len(walls)} walls and {len(doors)} doors in one scan", end=", ")
        env.step(np.zeros(env.action_space.shape))
        print(f"a step lasts {1000 * env.seconds:.0f} ms", end=", ")
        print(f"an episode at most {env.max_steps} steps")


if __name__ == "__main__":
    main()
