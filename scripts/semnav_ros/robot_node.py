"""The core of a robot's node: messages in, velocities out; it knows no middleware."""

from __future__ import annotations

import math
from dataclasses import replace

from semnav_agents.registry import AgentSource
from semnav_env.language import Command
from semnav_env.language.told import in_words_of
from semnav_env.mind.belief import Belief
from semnav_env.mind.grounding import GoalKind
from semnav_env.robots import RobotSpec, robot_spec
from semnav_features.frames import ORIGIN, FloatArray, Pose, Twist, compose, relative
from semnav_features.lidars import lidar_spec
from semnav_ros.command_drive import CommandDrive
from semnav_ros.conversation import STOP, Conversation
from semnav_ros.laser_frame import FixedFrames
from semnav_ros.lidar_check import learned_lidar, ranges_for, scan_of
from semnav_ros.messages import (
    BeliefMessage,
    Bumps,
    Counts,
    NodeReply,
    NodeStatus,
    OdometryMessage,
    Phase,
    ScanMessage,
    TransformMessage,
)
from semnav_ros.odometry_track import OdometryTrack
from semnav_ros.shown_belief import goal_pose, shown_belief
from semnav_ros.stamps import Arrival, StampJudge
from semnav_ros.standstill import PATIENCE, StandstillWatch

STALE = 0.5
"""Age of the last scan from which on the robot stands, seconds by the node's clock."""

NO_SCAN = f"no scan for {STALE:g} s"

NO_MOTION = f"the robot has been told to move for {PATIENCE:g} s, and odometry says that it stands"

FAREWELL = 1.0
"""How long the node goes on to say that the robot stands, seconds, after it has nothing to do."""

STILL: Twist = (0.0, 0.0, 0.0)
ACTIVE = (Phase.RUNNING, Phase.IMPOSSIBLE)
"""Phases of a command that runs; a clause that is impossible may become possible."""


class RobotNode:
    """Carries out spoken commands on what one robot publishes.

        node = RobotNode("wheelchair", mount=(0.45, 0.0, 0.0))
        node.command("go through the second door on the right", now)
        node.odometry(OdometryMessage(stamp, (x, y, heading)), now)
        forward, left, yaw_rate = node.scan(ScanMessage(stamp, ranges, -2.36, 0.0058), now).velocity

    `now` is the time of the call by the node's own clock, seconds, which never goes back
    (`time.monotonic`); stamps are of the robot's clock, which may. The robot moves only while a
    command runs, and only by a scan that is not older than `STALE`: call `tick` often enough.

    Args:
        robot: the body; "wheelchair", "spot" or a spec of yours.
        agent: what drives, see `make_agent`; it must not need the floor plan. None: a navigator
            drives, such as nav2; answers have its goals, and velocities are zero.
        mount: pose of the lidar in the base frame; None takes it from the transforms.
        base: x of the base frame's origin in the robot frame, metres: 0 if it lies in the middle of
            the body, negative if it lies behind, as at an axle.
        base_frame: name of the base frame in the transforms.
        language: of the commands: "en" or "de"; recognised if not given.

    Attributes:
        counts: of the messages so far.

    Raises:
        ValueError: no such robot, agent or language, or a mount that is not on the body.
    """

    counts: Counts

    def __init__(
        self,
        robot: str | RobotSpec = "wheelchair",
        agent: AgentSource | None = "scripted",
        mount: Pose | None = None,
        base: float = 0.0,
        base_frame: str = "base_link",
        language: str | None = None,
    ) -> None:
        self._robot, self._agent = robot_spec(robot), agent
        self._base: Pose = (base, 0.0, 0.0)
        self._base_frame, self._frames, self._mount = base_frame, FixedFrames(), mount
        body = self._robot if mount is None else self._body(mount)
        CommandDrive(body, lidar_spec("tim561"), agent).warm()
        self._talk = Conversation(language)
        self.counts = Counts()
        self._stamps = StampJudge(self.counts)
        self._track = OdometryTrack(self._robot, self.counts)
        self._watch = StandstillWatch()
        self._drive: CommandDrive | None = None
        self._bumps: Bumps = ()
        self._last_scan = self._active_at = -math.inf
        self._problem = self._refusal = ""
        self._phase, self._velocity = Phase.IDLE, STILL
        self._goal: Pose | None = None
        self._waiting: Command | None = None
        self._clauses: tuple[str, ...] = ()
        self._start = ORIGIN
        self._seen: tuple[Belief, Pose] | None = None

    @property
    def needs_transforms(self) -> bool:
        """Whether the pose of the lidar must come from the transforms."""
        return self._mount is None

    def transform(self, transform: TransformMessage) -> None:
        """Take a fixed transform, such as from the base frame to the lidar."""
        self._frames.take(transform)

    def bumps(self, bumps: Bumps) -> None:
        """Take where the body is touched now; it holds until the next call."""
        self._bumps = [(x + self._base[0], y, direction) for x, y, direction in bumps]

    def odometry(self, odometry: OdometryMessage, now: float) -> NodeReply:
        """Take dead reckoning; after a jump the robot stands until the next scan."""
        try:
            if self._track.take(odometry):
                self._stand("odometry jumped; the robot counts as standing where it stood")
        except ValueError as error:
            self._stand(str(error))
        return self.tick(now)

    def command(self, text: str, now: float) -> NodeReply:
        """Take a command or the answer to a question; it replaces what runs, a stop at once.

        A text that is refused or asked about ends what runs, too: whoever speaks to a robot that
        drives wants something else of it.
        """
        self._forget()
        if self._phase is Phase.HELD:
            self._talk.refuse(text, "the robot is held by its stop switch")
        elif (command := self._talk.hear(text)) is None:
            self._phase = Phase.ASKING if self._talk.question else Phase.REFUSED
        elif command == STOP:
            self._phase = Phase.STOPPED
        else:
            self._begin(command)
        return self.tick(now)

    def stop(self, held: bool, now: float) -> NodeReply:
        """Take a stop switch: while held nothing moves, and after it only by a new command."""
        if held or self._phase is Phase.HELD:
            self._forget()
            self._phase = Phase.HELD if held else Phase.STOPPED
        return self.tick(now)

    def scan(self, message: ScanMessage, now: float) -> NodeReply:
        """Take a scan that came at `now`; the answer has the velocity that it leads to."""
        try:
            drive, ranges = self._checked(message)
        except ValueError as error:
            self.counts.refused += 1
            self._refusal = str(error)
            self._stand(self._refusal)
            return self.tick(now)
        self._refusal = ""
        arrival, seconds = self._stamps.judge(message.stamp, 1.0 / drive.lidar.rate_hz)
        if arrival in (Arrival.NEW, Arrival.CLOCK_WENT_BACK):
            self.counts.scans += 1
            self._last_scan = now
            if arrival is Arrival.CLOCK_WENT_BACK:
                self._stand("the clock of the scans went back")
            elif self._phase in ACTIVE:
                self._try_to_advance(drive, ranges, message.stamp, seconds)
        return self.tick(now)

    def tick(self, now: float) -> NodeReply:
        """What holds now: the robot has to stand where the last scan is too old."""
        problem = self._problem if self._phase in ACTIVE else ""
        if self._phase not in ACTIVE:
            self._halt()
        elif now - self._last_scan > STALE:
            self._halt()
            problem = self._refusal or NO_SCAN
        if self._phase in (*ACTIVE, Phase.ASKING, Phase.HELD):
            self._active_at = now
        status = self._status(problem)
        drives = now - self._active_at <= FAREWELL
        return NodeReply(self._velocity, drives, status, self._talk.said, self._goal)

    @property
    def belief(self) -> BeliefMessage | None:
        """What is believed, odometry frame; None before the first scan of a command."""
        return None if self._seen is None else shown_belief(*self._seen, self._base)

    @property
    def pose(self) -> Pose:
        """The last pose of the base frame by odometry, odometry frame."""
        return self._track.reported

    @property
    def odometry_frame(self) -> str:
        """The name of the odometry frame."""
        return self._track.name

    def _checked(self, message: ScanMessage) -> tuple[CommandDrive, FloatArray]:
        """What drives by the scans of this lidar, and the ranges of the scan."""
        scan = scan_of(message)
        if self._drive is not None:
            return self._drive, ranges_for(self._drive.lidar, scan)
        mount = self._mount or self._frames.pose(message.frame, self._base_frame)
        if mount is None:
            raise ValueError(
                f"no transform from {self._base_frame!r} to {message.frame!r}; publish it, or give "
                "the pose of the lidar"
            )
        lidar = learned_lidar(message)
        self._drive = CommandDrive(self._body(mount), lidar, self._agent)
        self._drive.warm()
        if self._waiting is not None:
            self._drive.begin(self._waiting, self._talk.text)
        return self._drive, ranges_for(lidar, scan)

    def _begin(self, command: Command) -> None:
        """Get ready for a command, which begins at the next scan."""
        self._waiting, self._phase = command, Phase.RUNNING
        self._clauses = tuple(map(str, command.clauses))
        if self._drive is not None:
            self._drive.begin(command, self._talk.text)

    def _body(self, mount: Pose) -> RobotSpec:
        """The body with the lidar at a pose in the base frame."""
        return replace(self._robot, lidar_mount=compose(self._base, mount))

    def _try_to_advance(
        self, drive: CommandDrive, ranges: FloatArray, stamp: float, seconds: float | None
    ) -> None:
        """Advance, or stand where what was sensed is refused, such as a bump that is not finite."""
        try:
            self._advance(drive, ranges, stamp, seconds)
        except ValueError as error:
            self._stand(str(error))

    def _advance(
        self, drive: CommandDrive, ranges: FloatArray, stamp: float, seconds: float | None
    ) -> None:
        """Take a scan into the belief, and let the agent act."""
        if (base := self._track.at(stamp)) is None:
            self._stand("no odometry near the time of the scan")
            return
        centre = compose(base, relative(self._base, ORIGIN))
        if self._waiting is not None:
            self._start, self._waiting, seconds = centre, None, None
        belief, velocity = drive.update(ranges, relative(self._start, centre), self._bumps, seconds)
        self._seen = belief, relative(self._track.frame, centre)
        stands = self._watch.stands(stamp, base, velocity)
        self._velocity, self._problem = velocity, NO_MOTION if stands else ""
        self._goal = self._navigated(belief)
        if belief.clause >= len(self._clauses):
            self._phase = Phase.DONE
        elif belief.impossible is not None:
            self._phase = Phase.IMPOSSIBLE
            self._halt()
        else:
            self._phase = Phase.RUNNING

    def _navigated(self, belief: Belief) -> Pose | None:
        """Where a navigator shall go; None where an agent drives, or to stand still."""
        if self._agent is not None or belief.target.kind is GoalKind.STOP:
            return None
        assert self._seen is not None
        return goal_pose(*self._seen, self._base)

    def _stand(self, problem: str) -> None:
        """Stand until the next scan, and say why."""
        self._halt()
        self._problem = problem

    def _halt(self) -> None:
        """Stand until something else is decided."""
        self._velocity, self._goal = STILL, None

    def _forget(self) -> None:
        """Forget the command that runs."""
        self._halt()
        self._problem, self._clauses = "", ()
        self._waiting = self._seen = None

    def _status(self, problem: str) -> NodeStatus:
        belief = None if self._seen is None else self._seen[0]
        clause, reasons = (0, ()) if belief is None else (belief.clause, belief.reasons)
        reasons = tuple(in_words_of(self._talk.spoken, reason) for reason in reasons)
        counts = replace(self.counts)
        return NodeStatus(
            self._phase, problem, self._talk.text, self._clauses, clause, reasons, counts
        )
