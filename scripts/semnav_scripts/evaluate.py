"""`semnav evaluate`: drive many episodes, and print one table."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Sequence
from contextlib import nullcontext
from dataclasses import asdict, dataclass
from itertools import chain
from pathlib import Path
from statistics import fmean, median
from typing import Any

from rich.console import Console
from tyro.conf import Positional

from semnav_agents.evaluation import (
    Extras,
    LeftOut,
    Result,
    Summary,
    Trial,
    common_causes,
    failure_line,
    misreading,
    run_suite,
    suite,
    summarise,
    usual_agent,
)
from semnav_agents.evaluation.jobs import SuiteJob, suite_jobs
from semnav_agents.evaluation.provenance import provenance
from semnav_agents.evaluation.resuming import parts_left, results_so_far, rows_so_far
from semnav_agents.evaluation.runner import JOBS_OF_A_SHARE
from semnav_agents.learned import agent_label
from semnav_env.judge.episodes import Episode, Expected, evenly, is_episodes, load_episodes
from semnav_env.rendering.backend import load_pygame
from semnav_env.rendering.video import check_suffix
from semnav_features.lidars import TIM561, lidar_spec
from semnav_scripts.dynamics_options import NOTHING_MOVES, DynamicsOptions
from semnav_scripts.evaluation_tables import commands_table, headings, measures_table
from semnav_scripts.jsonl import JsonLines
from semnav_scripts.outputs import check_distinct, check_file, check_folder, counted
from semnav_scripts.progress import tracked
from semnav_scripts.report.gallery import without_excess
from semnav_scripts.report.html_report import save_report

USUAL_SEEDS = 20
"""Default number of seeds of a suite."""


@dataclass(frozen=True)
class Arguments:
    """Run a suite of commands many times, or the episodes of a split once, and count.

    Printed are agent, body, split, version and rules, shares with intervals of 95 %, all measures,
    and the failures.

    Attributes:
        suite: heidelberg, office_cross, villa_doors, villa_turns, villa_rooms, villa_exits, "villa"
            for these four, or "all"; villa_search; villa_find; a split (`semnav episodes list`); or
            a file of episodes.
        agent: scripted, oracle, blind, random, drive, listener, listener_drives (trained), the
            folder of a trained agent, or package.module:Class; searcher (knows the plan) or
            explorer for villa_search, finder for villa_find. If not given: scripted, or one of
            these.
        robot: wheelchair or spot.
        lidar: name of a lidar, such as rplidar_a1; docs/guides/lidars.md lists them.
        seeds: number of start poses, each with its own noise, for every command of a suite; 20 if
            not given.
        first_seed: number of the first seed; 0 if not given.
        episodes: number of episodes of a split, evenly spaced; all if not given.
        workers: number of processes; if not given, one for each core, but no more than have 32
            episodes to drive.
        recheck: judge every path a second time with Shapely, and count disagreements.
        pictures: folder for a picture of each failure.
        films: folder for a film (.gif) of each failure, which is driven a second time for it.
        html: report to write (.html): the tables, and why episodes failed, with their drives.
        dynamics: people, doors and furniture that move.
        out: file for the episodes, one JSON object in each line, written as they are driven. Until
            the end or an interruption this file is `.NAME-....part.jsonl` beside the target.
        resume: go on with what an ended or killed run has written to --out; what it drove is not
            driven again, and the file becomes the same.
        json: print the table as JSON.
    """

    suite: Positional[str] = "heidelberg"
    agent: str | None = None
    robot: str = "wheelchair"
    lidar: str = "tim561"
    seeds: int | None = None
    first_seed: int | None = None
    episodes: int | None = None
    workers: int | None = None
    recheck: bool = False
    pictures: Path | None = None
    films: Path | None = None
    html: Path | None = None
    dynamics: DynamicsOptions = NOTHING_MOVES
    out: Path | None = None
    resume: bool = False
    json: bool = False

    def run(self) -> int:
        """Run, and print success and contacts per command."""
        count = USUAL_SEEDS if self.seeds is None else self.seeds
        first = self.first_seed or 0
        if count < 1 or (self.workers is not None and self.workers < 1):
            raise ValueError("seeds and workers must be at least 1")
        if first < 0:
            raise ValueError(f"first_seed is {first}; it must be 0 or more")
        if self.episodes is not None and self.episodes < 1:
            raise ValueError(f"--episodes is {self.episodes}; it must be at least 1")
        lidar_spec(self.lidar)  # says at once if there is none of that name
        self._check_outputs()
        trials = self._trials()
        if any(isinstance(t, Episode) and t.expected is Expected.AMBIGUOUS for t in trials):
            return self._ask([trial for trial in trials if isinstance(trial, Episode)])
        seeds = range(first, first + count)
        jobs = suite_jobs(trials, seeds)
        total = len(jobs)
        extras = Extras(self.recheck, self.pictures, self.films, keep=self.html is not None)
        workers = self.workers or min(os.cpu_count() or 1, -(-total // JOBS_OF_A_SHARE))
        how = workers, extras, self.dynamics, self.lidar
        agent = self.agent or usual_agent(trials)
        who = self._who(agent)
        known, left_out = self._known(jobs, who), list[LeftOut]()
        suite_run = run_suite(trials, agent, self.robot, seeds, *how, left_out, len(known))
        results = self._drive(without_excess(chain(known, suite_run)), total, who, left_out)
        if not results:
            raise ValueError(f"no episode could begin; the first: {left_out[0].why}")
        groups = list(dict.fromkeys(result.group for result in results))
        if isinstance(trials[0], Episode):
            groups.sort()
        summaries = [_summary(group, results) for group in groups]
        everything = summarise("all", results, len(left_out))
        if self.html is not None:
            save_report(self.html, who, summaries, everything, results)
        self._show(summaries, everything, results, who)
        if not self.json:
            for each in left_out:
                print(
                    f'left out: {each.episode or f"seed {each.seed}"} "{each.command}": {each.why}'
                )
        for written in (self.out, self.html):
            if written is not None and not self.json:
                print(f"wrote {written}")
        return 0

    def _check_outputs(self) -> None:
        """Refuse bad paths before the drives, which take a while."""
        check_file(self.out, "--out")
        check_file(self.html, "--html")
        check_distinct({"--out": self.out, "--html": self.html})
        if self.html is not None:
            check_suffix(self.html, (".html",))
        if self.resume and self.out is None:
            raise ValueError("--resume goes on with the file of --out; give it")
        if self.resume:
            self._check_resumable()
        check_folder(self.pictures, "--pictures")
        check_folder(self.films, "--films")
        if self.films is not None:
            load_pygame()  # says at once where it is missing

    def _check_resumable(self) -> None:
        """Refuse what rows of an earlier run do not hold."""
        drawn = (("recheck", self.recheck), ("pictures", self.pictures), ("films", self.films))
        for name, value in (*drawn, ("html", self.html)):
            if value:
                raise ValueError(f"--{name} needs all drives; leave out --resume")
        if self.dynamics.changing_doors or self.dynamics.moved_furniture:
            raise ValueError(
                "--changing-doors and --moved-furniture leave episodes out; leave out --resume"
            )

    def _who(self, agent: str) -> dict[str, Any]:
        """Fields of every row: agent, split, body, version, rules, and what is not as usual."""
        who = agent_label(agent) | {"split": Path(self.suite).name, "robot": self.robot}
        usual, chosen = asdict(NOTHING_MOVES), asdict(self.dynamics)
        if moved := {name: value for name, value in chosen.items() if value != usual[name]}:
            who |= {"dynamics": moved}
        if self.lidar != TIM561.name:
            who |= {"lidar": self.lidar}
        return who | provenance().row()

    def _known(self, jobs: Sequence[SuiteJob], who: dict[str, Any]) -> list[Result]:
        """The results of an earlier run that are gone on with."""
        if not self.resume or self.out is None:
            return []
        return results_so_far(rows_so_far(self.out), jobs, who, self.out)

    def _drive(
        self,
        episodes: Iterator[Result],
        total: int,
        who: dict[str, Any],
        left_out: list[LeftOut],
    ) -> list[Result]:
        """All results; each is written at once, so that an interruption loses none."""
        results: list[Result] = []
        with JsonLines(self.out) if self.out else nullcontext() as out:
            for result in tracked(
                episodes,
                lambda n: f"{n} episodes",
                lambda: (len(results) + len(left_out)) / total,
            ):
                results.append(result)
                if out:
                    out.write(who | result.row())
            if out:
                for each in left_out:
                    out.write(who | each.row())
        if self.resume and self.out is not None:
            for part in parts_left(self.out):
                part.unlink()
        return results

    def _trials(self) -> Sequence[Trial | Episode]:
        if not is_episodes(self.suite):
            if self.episodes is not None:
                raise ValueError("--episodes is for splits and files; give a suite --seeds")
            return suite(self.suite)
        for option, value in (("--seeds", self.seeds), ("--first-seed", self.first_seed)):
            if value is not None:
                raise ValueError(f"{option} is for suites; give a split --episodes")
        found = load_episodes(self.suite)
        if self.episodes is not None and self.episodes > len(found):
            raise ValueError(f"--episodes is {self.episodes}; {self.suite} has {len(found)}")
        return found if self.episodes is None else evenly(found, self.episodes)

    def _ask(self, episodes: Sequence[Episode]) -> int:
        """Count the ambiguous commands whose readings the grammar finds."""
        if self.html is not None:
            raise ValueError("--html shows drives; these commands are only read")
        wrong = {episode: cause for episode in episodes if (cause := misreading(episode))}
        right = len(episodes) - len(wrong)
        failures = [
            f'{episode.id} "{episode.command}": {cause}' for episode, cause in wrong.items()
        ]
        if self.json:
            print(json.dumps({"episodes": len(episodes), "right": right, "failures": failures}))
            return 0
        said = f"ambiguous commands: {right} of {len(episodes)} understood as all that they mean"
        print("\n".join([said, *failures]))
        return 0

    def _show(
        self,
        summaries: list[Summary],
        everything: Summary,
        results: list[Result],
        who: dict[str, Any],
    ) -> None:
        if self.json:
            print(json.dumps([who | summary.row() for summary in (*summaries, everything)]))
            return
        console = Console()
        for line in headings(who, everything):
            console.print(line, highlight=False, soft_wrap=True)
        console.print()
        console.print(commands_table([*summaries, everything]))
        console.print()
        console.print(measures_table(everything))
        for cause, count in common_causes(results):
            console.print(f"{count} x {cause}", highlight=False)
        for row in summaries:
            for failure in row.failures:
                line = f"{row.name}: {failure_line(failure)}"
                console.print(line, highlight=False, soft_wrap=True)
        self._show_extras(results)

    def _show_extras(self, results: list[Result]) -> None:
        if self.dynamics.pedestrians:
            intrusions = [result.social["personal_space_intrusions"] for result in results]
            soonest = [result.social["least_time_to_collision"] for result in results]
            print(
                f"people: {fmean(intrusions):.2f} intrusions an episode; "
                f"least time to collision {median(soonest):.1f} s (median over episodes)"
            )
        if self.recheck:
            odd = [result for result in results if result.rechecked]
            print(f"second opinion: {len(odd)} of {len(results)} episodes judged differently")
            for result in odd:
                said = f"{' / '.join(result.verdicts)}, second opinion: {result.rechecked}"
                print(f"{result.command}: seed {result.seed}: {said}")
        failed = sum(not result.success for result in results)
        outputs = ("drew", self.pictures, "pictures"), ("filmed", self.films, "films")
        for done, folder, things in outputs:
            if folder is not None:
                into = f"{done} {counted(failed, 'failure')} into {folder}"
                print(into if failed else f"nothing failed, so there are no {things}")


def _summary(group: str, results: list[Result]) -> Summary:
    return summarise(group, [result for result in results if result.group == group])
