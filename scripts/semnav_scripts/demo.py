"""`semnav demo`: let one robot carry out one command, with a film or a picture of it."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from tyro.conf import Positional

from semnav_agents.base import Agent, steps
from semnav_agents.evaluation.causes import what_happened
from semnav_agents.evaluation.drive import recognised_impossible
from semnav_agents.registry import make_agent
from semnav_env.env import SemNavEnv
from semnav_env.language import SearchHouse, corrections, parse
from semnav_env.language.finding_clauses import FindingClause
from semnav_env.language.language import Language
from semnav_env.language.told import Told, in_words_of
from semnav_env.language.vocabulary.recognition import language_of_text
from semnav_env.rendering.film import STEPS_PER_FRAME, Film
from semnav_env.world.dynamics.social import for_json
from semnav_env.world.maps import FloorPlan, load_floor_plan
from semnav_scripts.arguments import parse_pose
from semnav_scripts.asking import asking
from semnav_scripts.display import needing_display
from semnav_scripts.dynamics_options import NOTHING_MOVES, DynamicsOptions
from semnav_scripts.outputs import check_file
from semnav_scripts.progress import share_driven, tracked, work_bar

DEFAULT_MAP = "heidelberg_hallway"
"""The default floor plan."""

STEPS_PER_SEARCH_FRAME = 60
"""The same for a search, which takes minutes: the film is twenty times as fast."""

KNOWS_THE_PLAN = "the agent knows the floor plan; --agent explorer searches a house without it"
"""Remark on the default agent of a search of a house."""

ENDED = '"{echo}": {verdict} after {seconds:.1f} s and {metres:.1f} m, {count} collisions'
ENDED_TOUCHED_ONCE = ENDED.removesuffix("s")
"""What is told at the end."""

FOUND = (
    "{found} of {victims} people found, {false_reports} false reports, "
    "least covered room {share:.0f} %"
)
"""The outcome of a search in one line."""


@dataclass(frozen=True)
class _DemoTask:
    """The command of the drive, its floor plan and its options.

    Attributes:
        plan: the floor plan.
        spoken: language of the command.
        options: for `env.reset`.
        seed: for `env.reset`.
        searches: whether people are to be found.
        usual_agent: who drives if nobody is named.
        limits: of the episode, as arguments of the environment; its own if empty.
        infeasible: whether the right answer is to say that the command is impossible.
        corrections: a line for each word of the command that was corrected into another.
    """

    plan: FloorPlan
    spoken: Language
    options: dict[str, Any]
    seed: int
    searches: bool = False
    usual_agent: str = "scripted"
    limits: dict[str, Any] = field(default_factory=dict)
    infeasible: bool = False
    corrections: tuple[Told, ...] = ()


@dataclass(frozen=True)
class Arguments:
    """Let a robot carry out a command.

    The exit code is 0 if the robot succeeded, 1 if it did not, and 2 if the command cannot be
    carried out from its start.

    Attributes:
        command: the command; in a terminal the robot asks about an ambiguous one.
        episode: instead of a command the id of a frozen episode, such as val_unseen-00246, or
            FILE:ID for one of a file; the same agent drives it as in `semnav evaluate`.
        map: a floor plan: a name (office_cross, or office:medium:17, generated) or a path;
            heidelberg_hallway if not given, for a search a generated house.
        language: of the command: en or de (english, german); recognised if not given.
        robot: wheelchair or spot.
        agent: scripted, oracle, blind, random, drive, listener, listener_drives (trained), the
            folder of a trained agent, or package.module:Class; searcher (knows the plan) or
            explorer for a search of a house, finder for other commands to find people. If not
            given: scripted, or one of these.
        pose: start pose of the robot, x,y,heading in metres and radians; random if not given.
        seed: seed of everything that is random; 0 if not given.
        dynamics: people, doors and furniture that move.
        save: film to write (.gif or .mp4).
        picture: picture of the end to write (.png).
        show: show the drive in a window, without --save and --picture.
        json: print the outcome as JSON.
    """

    command: Positional[str | None] = None
    episode: str | None = None
    map: str | None = None
    language: str | None = None
    robot: str = "wheelchair"
    agent: str | None = None
    pose: str | None = None
    seed: int | None = None
    dynamics: DynamicsOptions = NOTHING_MOVES
    save: Path | None = None
    picture: Path | None = None
    show: bool = False
    json: bool = False

    def run(self) -> int:
        """Drive, film and report."""
        if self.seed is not None and self.seed < 0:
            raise ValueError(f"seed is {self.seed}; it must be 0 or more")
        self._check_files()
        told = self._commanded() if self.episode is None else self._frozen(self.episode)
        agent = make_agent(self.agent or told.usual_agent)
        env = self._environment(told, agent)
        film = Film(env, STEPS_PER_SEARCH_FRAME if told.searches else STEPS_PER_FRAME)
        observation, start = env.reset(seed=told.seed, options=told.options)
        info: dict[str, Any] = {}
        driven = tracked(
            steps(env, agent, observation, start),
            lambda _: f"{env.seconds:.0f} s",
            lambda: share_driven(env.judge),
        )
        with needing_display("--save FILE writes a film without one"):
            for step in driven:
                info = step.info
                if self._filmed:
                    film.note("is_success" in info)
        judge = env.judge
        if told.infeasible:
            info["is_success"] = recognised_impossible(judge, info["impossible"])
        echo = judge.mission.command.say(told.spoken)
        env.close()
        self._save(film)
        info["why"] = "" if info["is_success"] else what_happened(judge)
        info["corrections"] = [each.say(told.spoken) for each in told.corrections]
        self._report(start, echo, told.spoken, info, env.seconds, for_json(env.world.social()))
        return 0 if info["is_success"] else 1

    @property
    def _filmed(self) -> bool:
        return self.save is not None or self.picture is not None

    def _commanded(self) -> _DemoTask:
        """The task of the drive, from a command."""
        if self.command is None:
            raise ValueError("give a command for the robot, or --episode ID")
        plan = load_floor_plan(self.map or DEFAULT_MAP)
        command = parse(self.command, self.language, plan.room_names, asking())
        spoken = language_of_text(self.command, self.language)
        options: dict[str, Any] = {"command": command, "language": spoken.code}
        if self.pose is not None:
            options["pose"] = parse_pose(self.pose)
        searches = any(isinstance(each, FindingClause) for each in command.clauses)
        searcher = "searcher" if command.clauses == (SearchHouse(),) else "finder"
        usual = searcher if searches else "scripted"
        task = _DemoTask(plan, spoken, options, self.seed or 0, searches, usual)
        return replace(task, corrections=corrections(self.command, plan.room_names))

    def _frozen(self, name: str) -> _DemoTask:
        """The task of a frozen episode, with the noise and the limit of `evaluate`."""
        from semnav_agents.evaluation.jobs import EPISODE_SECONDS
        from semnav_env.judge.episodes import Expected, find_episode

        others = ("command", "map", "language", "pose", "seed")
        for other in (other for other in others if getattr(self, other) is not None):
            option = other if other == "command" else f"--{other}"
            raise ValueError(
                f"--episode has these settings; leave out {option} {getattr(self, other)!r}"
            )
        episode = find_episode(name)
        spoken = language_of_text(episode.command, episode.language)
        infeasible = episode.expected is Expected.INFEASIBLE
        told = _DemoTask(episode.plan(), spoken, {"episode": episode}, episode.number)
        return replace(told, limits={"max_seconds": EPISODE_SECONDS}, infeasible=infeasible)

    def _environment(self, told: _DemoTask, agent: Agent) -> SemNavEnv:
        """The environment for a command: that of a search has a person detector and victims."""
        mode = "human" if self.show else "rgb_array" if self._filmed else None
        if not told.searches:
            return SemNavEnv(
                self.robot,
                told.plan,
                observation=agent.observation,
                dynamics=self.dynamics,
                render_mode=mode,
                **told.limits,
            )
        from semnav_env.rescue.environment import VICTIMS, search_and_rescue

        return search_and_rescue(
            observation=agent.observation,
            robot=self.robot,
            floor_plan=told.plan if self.map else f"office:house:{told.seed}",
            dynamics=replace(self.dynamics, victims=self.dynamics.victims or VICTIMS),
            render_mode=mode,
        )

    def _check_files(self) -> None:
        """Refuse bad paths before the drive, which takes a while."""
        from semnav_env.rendering.video import check_suffix

        if self.show and (self.save or self.picture):
            raise ValueError("--show opens a window; give it without --save and --picture")
        check_file(self.save, "--save")
        check_file(self.picture, "--picture")
        if self.save is not None:
            check_suffix(self.save)
        if self.picture is not None:
            check_suffix(self.picture, (".png",))

    def _save(self, film: Film) -> None:
        from semnav_env.rendering.video import save_png

        if self.save is not None:
            with work_bar(f"writing {self.save.name}"):
                film.save(self.save)
        if self.picture is not None:
            save_png(self.picture, film.frames[-1])

    def _report(
        self,
        start: dict[str, Any],
        echo: str,
        spoken: Language,
        info: dict[str, Any],
        seconds: float,
        social: dict[str, Any],
    ) -> None:
        outcome = {
            **({"episode": self.episode} if self.episode else {}),
            "command": start["command"],
            **({"corrections": info["corrections"]} if info["corrections"] else {}),
            "floor_plan": start["floor_plan"],
            "pose": start["pose"],
            "success": info["is_success"],
            "verdicts": [str(verdict) for verdict in info["verdicts"]],
            "why": in_words_of(spoken, info["why"]),
            "crossed_doors": list(info["crossed_doors"]),
            "collisions": info["collisions"],
            "impossible": info["impossible"] and in_words_of(spoken, info["impossible"]),
            "seconds": round(seconds, 2),
            "path_length": round(info["path_length"], 3),
            "route_length": round(info["route_length"], 3),
            **social,
            **({"search": info["search"]} if "search" in info else {}),
            "files": [str(path) for path in (self.save, self.picture) if path is not None],
        }
        if self.json:
            print(json.dumps(outcome))
            return
        for line in self._lines(outcome, echo, spoken):
            print(line)

    def _lines(self, outcome: dict[str, Any], echo: str, spoken: Language) -> Iterator[str]:
        """What is told of an outcome, in the language of the command."""
        tell, verdicts = spoken.tell, ["done"] if outcome["success"] else outcome["verdicts"]
        pose = ",".join(f"{value:.2f}" for value in outcome["pose"])
        yield tell("from {pose} in {plan}", pose=pose, plan=outcome["floor_plan"])
        yield from outcome.get("corrections", ())
        if "search" in outcome and self.agent is None:
            yield tell(KNOWS_THE_PLAN)
        touches = outcome["collisions"]
        yield tell(
            ENDED_TOUCHED_ONCE if touches == 1 else ENDED,
            echo=echo,
            verdict=" / ".join(map(tell, verdicts)),
            seconds=outcome["seconds"],
            metres=outcome["path_length"],
            count=touches,
        )
        if outcome["why"]:
            yield tell("why: {why}", why=outcome["why"])
        if "search" in outcome:
            found = outcome["search"]
            yield tell(FOUND, **found | {"share": 100 * found["least_coverage"]})
        if outcome["impossible"]:
            yield tell("the robot found the command impossible: {why}", why=outcome["impossible"])
        for path in outcome["files"]:
            yield tell("wrote {path}", path=path)
