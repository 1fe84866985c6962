"""`semnav view`: see a kept run again, in a window or as a film or picture."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, arg

from semnav_agents.evaluation import Result
from semnav_agents.evaluation.drive import Watch, drive
from semnav_agents.evaluation.jobs import SuiteJob
from semnav_agents.evaluation.kept_results import KeptResult, is_results, read_kept_result
from semnav_agents.evaluation.provenance import rules_fingerprint
from semnav_agents.evaluation.runner import SuiteSetup, make_env
from semnav_agents.registry import make_agent
from semnav_env.env import SemNavEnv
from semnav_env.judge.episodes import find_episode, load_episodes
from semnav_env.rendering.film import STEPS_PER_FRAME, Film
from semnav_env.rendering.video import check_suffix
from semnav_features.validation import require
from semnav_scripts.display import needing_display
from semnav_scripts.outputs import check_file
from semnav_scripts.progress import WorkBar, share_driven, work_bar

MAX_FRAMES = 200
"""The most frames of a film: 40 s of it, and some 400 MB of memory."""

FULL_WIDTH, LEAST_WIDTH = 960, 160
"""Width of a picture before it is scaled, and the least width of a film, pixels."""


@dataclass(frozen=True)
class Arguments:
    """See a kept run again: it is driven once more, and goes as it went.

    The exit code is 1 if it ended otherwise than it is kept, as with an agent whose random numbers
    depend on more than its observations, or by other rules.

    Attributes:
        which: a result of `semnav evaluate --out`, as FILE:ID with the id of its episode or the
            number of its line; FILE alone is its first failure. Or a frozen episode: its id, such
            as val_unseen-00246, or FILE:ID, or FILE with a single one.
        out: film or picture to write (.gif, .mp4 or .png, the last moment); a window shows the run
            if not given.
        width: of the film or picture, pixels, at most 960.
        speed: of the film, simulated seconds a second; long runs are filmed faster, so that no film
            takes more than 40 s.
        agent: who drives; if not given, the agent of the result, for an episode scripted.
        robot: wheelchair or spot, for an episode; a result has its own.
        episodes: file of the episodes of a result, if it is no longer where it was.
        json: print JSON.
    """

    which: Annotated[Positional[str], arg(metavar="RUN")]
    out: Path | None = None
    width: int = 640
    speed: float = 4.0
    agent: str | None = None
    robot: str | None = None
    episodes: Path | None = None
    json: bool = False

    def run(self) -> int:
        """Drive, show or write, and say how it ended."""
        require(LEAST_WIDTH <= self.width <= FULL_WIDTH, "--width", self.width, "from 160 to 960")
        require(0.2 <= self.speed <= 100.0, "--speed", self.speed, "from 0.2 to 100")
        check_file(self.out, "--out")
        if self.out is not None:
            check_suffix(self.out)
        kept, setup, job = self._found()
        result = self._driven(setup, job)
        differs = kept is not None and not _agree(kept, result)
        notes = _notes(kept, differs)
        if self.json:
            row = {"agent": setup.agent, "robot": setup.robot, **result.row()}
            print(json.dumps({**row, "notes": notes, "out": str(self.out) if self.out else None}))
        else:
            name = kept.name if kept else job.name
            print(f"{name}, agent {setup.agent}, robot {setup.robot}")
            print(f'"{result.command}": {" / ".join(result.verdicts)}')
            for line in (result.cause, *notes, self.out and f"wrote {self.out}"):
                if line:
                    print(line)
        return 1 if differs else 0

    def _found(self) -> tuple[KeptResult | None, SuiteSetup, SuiteJob]:
        """What is asked for: a kept result or a frozen episode, and who drives it."""
        file, _, which = self.which.rpartition(":")
        if Path(self.which).is_file() or not file:
            file, which = self.which, ""
        if Path(file).is_file() and is_results(Path(file)):
            kept = read_kept_result(Path(file), which, self.episodes)
            if self.robot is not None:
                raise ValueError(f"--robot is for episodes; this result is of {kept.setup.robot}")
            return (
                kept,
                replace(kept.setup, agent=self.agent or _bundled(kept.setup.agent)),
                kept.job,
            )
        if self.episodes is not None:
            raise ValueError("--episodes is for results; give the file before the id: FILE:ID")
        if Path(file).is_file() and not which:
            found = load_episodes(Path(file))
            require(len(found) == 1, "number of episodes", len(found), f"1, or give {file}:ID")
            episode = found[0]
        else:
            episode = find_episode(self.which)
        setup = SuiteSetup(self.agent or "scripted", self.robot or "wheelchair")
        return None, setup, SuiteJob(episode, episode.number)

    def _driven(self, setup: SuiteSetup, job: SuiteJob) -> Result:
        """The result of the drive, which is shown or written on the way."""
        agent = make_agent(setup.agent)
        shows = self.out is None
        env = make_env(setup, job, agent.observation, "human" if shows else "rgb_array")
        film = Film(env, max(1, round(STEPS_PER_FRAME * self.speed)), MAX_FRAMES)
        with work_bar("driving") as bar:
            watch = _watch(env, None if shows else film, bar)
            with needing_display("--out FILE writes a film without one"):
                driven = drive(env, agent, job.seed, job.options(env), watch)
            if self.out is not None:
                bar.show(f"writing {self.out.name}", None)
                film.save(self.out, self.width / FULL_WIDTH)
        env.close()
        return job.result(driven)


def _bundled(agent: object) -> str:
    """The agent that a file names, if that runs no code which the reader does not expect.

    Raises:
        ValueError: it is a class of some module.
    """
    name = str(agent)
    if ":" in name:
        raise ValueError(f"this result is of {name!r:.80}, which is no bundled agent; give --agent")
    return name


def _watch(env: SemNavEnv, film: Film | None, bar: WorkBar) -> Watch:
    """Films, and shows how much is driven."""

    def watch(over: bool) -> None:
        if film is not None:
            film.note(over)
        bar.show(f"{env.seconds:.0f} s", share_driven(env.judge))

    return watch


def _agree(kept: KeptResult, result: Result) -> bool:
    """Whether a run ended as it is kept."""
    same_verdicts = not kept.verdicts or kept.verdicts == result.verdicts
    return kept.success == result.success and same_verdicts


def _notes(kept: KeptResult | None, differs: bool) -> list[str]:
    """What is to be known of a kept result: how it ended then, and by other rules."""
    if kept is None:
        return []
    notes = []
    if differs:
        ended = " / ".join(kept.verdicts) or ("success" if kept.success else "no success")
        notes.append(f"it ended otherwise than it is kept: {ended}")
    if kept.rules and kept.rules != rules_fingerprint():
        notes.append(f"it was driven by other rules, {kept.rules}; now {rules_fingerprint()}")
    return notes
