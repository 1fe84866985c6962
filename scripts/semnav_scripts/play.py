"""`semnav play`: drive a robot by keyboard or gamepad."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from tyro.conf import Positional

from semnav_env.env import SemNavEnv
from semnav_env.judge.episodes.files import PLAN_SUFFIX
from semnav_env.language import Command, parse
from semnav_env.language.vocabulary.recognition import language_of_text
from semnav_env.rendering.backend import load_pygame
from semnav_env.rules import Rules, SuccessRules
from semnav_env.world.maps import FloorPlan, load_floor_plan
from semnav_scripts.arguments import OptionalText, parse_pose
from semnav_scripts.asking import asking
from semnav_scripts.display import needing_display
from semnav_scripts.dynamics_options import NOTHING_MOVES, DynamicsOptions
from semnav_scripts.outputs import check_folder
from semnav_scripts.playing.game import Game, described
from semnav_scripts.playing.kept_runs import EPISODES, check_new, keep_runs
from semnav_scripts.playing.played_drive import PlayedDrive, PlayedRun

MAX_SECONDS = 3600.0
"""Time limit of a command, simulated seconds."""

STILL_SECONDS = 60.0
"""Time of standing still after which a command has failed, seconds: a person looks and thinks."""


@dataclass(frozen=True)
class Arguments:
    """Drive a robot by keyboard or gamepad, and see what it sees.

    Arrow keys or w, a, s, d drive, q and e move SPOT sideways, shift doubles the speed. Enter
    begins to type a command, which is given by Enter again; the arrow keys drive meanwhile. Tab (or
    the first button of a gamepad) switches the assistance on and off, Escape ends. The exit code is
    0 if the last command was carried out, and 1 if not.

    Attributes:
        command: the first command; drawn if not given.
        map: a floor plan: a name (office_cross, or office:medium:17, generated) or a path.
        language: of commands: en or de; recognised if not given.
        robot: wheelchair or spot.
        lidar: name of the lidar, such as tim561.
        pose: start pose of the robot, x,y,heading in metres and radians; random if not given.
        seed: seed of everything that is random.
        assist: begin with assistance: the robot touches nothing that it sees, and helps through
            doors.
        dynamics: people, doors and furniture that move.
        out: folder to keep the runs in; `semnav habits FOLDER/played.jsonl` measures them.
        seconds: end after this time, simulated seconds.
        json: print the outcome as JSON.
    """

    command: Positional[str | None] = None
    map: str = "heidelberg_hallway"
    language: OptionalText = None
    robot: str = "wheelchair"
    lidar: str = "tim561"
    pose: OptionalText = None
    seed: int = 0
    assist: bool = False
    dynamics: DynamicsOptions = NOTHING_MOVES
    out: Path | None = None
    seconds: float = MAX_SECONDS
    json: bool = False

    def run(self) -> int:
        """Drive until the window is closed or time is up, keep the runs and report."""
        self._check()
        drive = PlayedDrive(self._environment(), self._plan_name, self.seed, self.assist)
        pose = None if self.pose is None else parse_pose(self.pose)
        drive.begin(self._said(drive.env.floor_plan), pose)
        game = self._game(drive)
        try:
            game.play(self.seconds)
        finally:
            drive.finish()
            if self.out is not None:
                keep_runs(self.out, drive.runs)
        self._report(drive.runs)
        return 0 if drive.runs and drive.runs[-1].success else 1

    def _check(self) -> None:
        if self.seed < 0:
            raise ValueError(f"seed is {self.seed}; it must be 0 or more")
        if not self.seconds > 0.0:
            raise ValueError(f"--seconds is {self.seconds:g}; it must be positive")
        check_folder(self.out, "--out")
        if self.out is not None:
            check_new(self.out)
        load_pygame()

    def _game(self, drive: PlayedDrive) -> Game:
        with needing_display("`semnav serve` needs a browser only"):
            return Game(drive, self.language)

    def _environment(self) -> SemNavEnv:
        return SemNavEnv(
            self.robot,
            load_floor_plan(self.map),
            observation="all",
            lidar=self.lidar,
            dynamics=self.dynamics,
            rules=Rules(success=SuccessRules(still_seconds=STILL_SECONDS)),
            max_seconds=MAX_SECONDS,
        )

    def _said(self, plan: FloorPlan) -> tuple[str, str, Command] | None:
        """The first command: its text, its language and what it means."""
        if self.command is None:
            return None
        command = parse(self.command, self.language, plan.room_names, asking())
        return self.command, language_of_text(self.command, self.language).code, command

    @property
    def _plan_name(self) -> str:
        """What the floor plan is found by, from whatever folder."""
        is_file = self.map.endswith(PLAN_SUFFIX) or Path(self.map).is_file()
        return str(Path(self.map).resolve()) if is_file else self.map

    def _report(self, runs: Sequence[PlayedRun]) -> None:
        files = [] if self.out is None else [str(self.out / EPISODES)]
        if self.json:
            print(json.dumps({"runs": [run.outcome for run in runs], "files": files}))
            return
        for run in runs:
            print(f"{run.episode.id}: {described(run)}")
        for file in files:
            print(f"wrote {file}; `semnav habits {file}` measures how doorways were passed")
