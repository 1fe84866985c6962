"""A command followed on a log: what a robot would have believed at each scan, and where it led.

`follow_log` hands each record to a `BeliefTracker`, which needs scans and odometry only; a robot of
yours calls its `update` in the same way. One sees each change of the goal and of the clause. Give
the path of a log and a command; without them, a drive of the scripted agent is recorded first.

    python examples/command_on_log.py robot.log.gz "go through the first door on the left"
"""

import sys
from collections.abc import Iterable, Iterator

from semnav_env.language import parse
from semnav_env.mind.belief.log_following import follow_log
from semnav_env.robots import SPOT
from semnav_features import Scan
from semnav_features.frames import Pose
from semnav_features.readers import LogRecord, open_log

COMMAND = "go through the second door on the right, then stop"


def recorded() -> Iterator[LogRecord]:
    """The scans and the odometry of a drive in the simulator."""
    from semnav_agents import make_agent
    from semnav_agents.base import steps
    from semnav_env.env import SemNavEnv
    from semnav_env.mind.observations import read_odometry

    agent = make_agent("scripted")
    env = SemNavEnv(SPOT, observation=agent.observation)
    start = env.reset(seed=0, options={"command": COMMAND, "pose": (-2.5, -0.6, 0.25)})
    lidar = env.lidar_spec
    for number, step in enumerate(steps(env, agent, *start), 1):
        ranges, odometry = step.observation["scan"], read_odometry(step.observation)[0]
        scan = Scan(ranges, lidar.angle_min, lidar.angle_increment, range_max=lidar.range_max)
        yield LogRecord(scan, None, odometry, number)


def follow(records: Iterable[LogRecord], command: str, mount: Pose) -> None:
    """Print what changes in the belief."""
    told = None
    for record, belief in follow_log(records, parse(command), mount=mount):
        new = belief.clause, type(belief.goal).__name__, belief.reasons
        if new != told:
            print(f"scan {record.line}: clause {new[0]}, {new[1]}: {'; '.join(new[2])}")
        told = new


if __name__ == "__main__":
    if len(sys.argv) == 3:
        with open_log(sys.argv[1]) as log:
            follow(log, sys.argv[2], mount=(0.0, 0.0, 0.0))
    else:
        follow(recorded(), COMMAND, SPOT.lidar_mount)
