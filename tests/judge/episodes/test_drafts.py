"""What is drafted for episodes: fair starts, commands that nobody would read otherwise."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely

from semnav_env.judge import Judge, Verdict, plan_goals, plan_mission
from semnav_env.judge.episodes import SPLITS, Episode, load_episodes
from semnav_env.judge.episodes.ambiguity_filter import AmbiguityFilter
from semnav_env.judge.episodes.drafts import Drafter
from semnav_env.judge.episodes.generate import (
    LIMITS,
    exits,
    generate_episode,
)
from semnav_env.judge.episodes.random_clauses import CommandTopic
from semnav_env.judge.episodes.site import LARGEST_BODY, Site
from semnav_env.judge.episodes.wording import worded
from semnav_env.judge.recheck import recheck
from semnav_env.judge.routes.room_guide import RoomGuide
from semnav_env.judge.tasks.starts import LEAST_AHEAD, WIDEST_HALF, is_in_junction, sample_start
from semnav_env.language import (
    Command,
    CommandError,
    DoorReference,
    Follow,
    GoToDoor,
    GoToRoom,
    IfThere,
    Leave,
    Place,
    PlaceReference,
    Side,
    Turn,
    parse,
)
from semnav_env.mind.grounding import Goal, ReachGoal
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.maps.placement import is_clear, placement_error
from semnav_features.corridor import corridor_at
from semnav_features.frames import Pose, to_local
from tests.support.erring import ghost, targets

OFFICE = "office:medium:2000017"
SITE = Site(load_floor_plan(OFFICE), OFFICE)
WEST: Pose = (1.3, 9.1, 0.0)


def drafter(seed: int, site: Site = SITE) -> Drafter:
    rng = np.random.default_rng(seed)
    return Drafter(site.plan, site.geodesic, sample_start(site.plan, LARGEST_BODY, rng), rng)


def goals_of(episode: Episode, site: Site) -> tuple[Goal, ...]:
    command = parse(episode.readings[0], episode.language, site.plan.room_names)
    guide = RoomGuide(site.plan, command, site.geodesic)
    return plan_goals(site.plan, command, episode.start, guide)


@pytest.mark.parametrize("name", ["heidelberg_hallway", "office_cross", "villa_hall", OFFICE])
def test_no_start_is_beside_the_mouth_of_an_arm(name: str) -> None:
    plan, rng = load_floor_plan(name), np.random.default_rng(0)
    for _ in range(15):
        x, y, heading = sample_start(plan, LARGEST_BODY, rng)
        for turn in (0.0, np.pi):
            for junction in corridor_at(plan.scene, (x, y, heading + turn)).junctions:
                assert all(o.near >= 0.6 or o.far <= -0.6 for o in junction.openings)


@pytest.mark.parametrize("name", ["heidelberg_hallway", "office_cross", OFFICE])
def test_no_start_is_right_beside_a_door(name: str) -> None:
    plan, rng = load_floor_plan(name), np.random.default_rng(1)
    for _ in range(15):
        start = sample_start(plan, LARGEST_BODY, rng)
        for door in plan.scene.doors:
            along, beside = to_local(start, door.midpoint)
            assert abs(along) >= 0.9 or abs(beside) >= 2.0


def test_every_body_can_face_the_door_that_it_is_told_to_go_to() -> None:
    """In the measured corridor no wheelchair can face one of the doors from 0.9 m before it."""
    plan = load_floor_plan("heidelberg_hallway")
    site = Site(plan, "heidelberg_hallway")
    for number in range(0, 40, 2):
        for goal in goals_of(generate_episode(site, SPLITS["test_real"], number), site):
            if isinstance(goal, ReachGoal) and goal.distance_tolerance < 1.0:
                assert placement_error(plan, LARGEST_BODY, goal.pose) is None


def test_both_bodies_fit_where_turns_and_corridors_end() -> None:
    """A corridor that is first seen from a doorway beside it can have its axis along a wall."""
    for episode in load_episodes("test_real"):
        site = Site(episode.plan(), episode.floor_plan)
        for goal in goals_of(episode, site):
            if isinstance(goal, ReachGoal) and goal.corridor is not None:
                assert placement_error(site.plan, LARGEST_BODY, goal.pose) is None, episode.id


def test_in_the_middle_of_a_crossing_one_is_in_a_junction() -> None:
    plan = load_floor_plan("office_cross")
    middle = plan.region("crossing").polygon.centroid
    assert is_in_junction(corridor_at(plan.scene, (middle.x, middle.y, 0.0)))
    assert not is_in_junction(corridor_at(plan.scene, WEST))


def test_rooms_to_leave_have_one_exit_and_space_to_turn() -> None:
    """Both bodies can turn around where they start."""
    split = replace(SPLITS["val_unseen"], clauses=(1, 2, 3))
    seen = 0
    for number in range(60):
        episode = generate_episode(SITE, split, number)
        clauses = episode.meanings()[0].clauses
        if not isinstance(clauses[0], Leave):
            continue
        seen += 1
        place = shapely.Point(episode.start[:2])
        (room,) = (room for room in SITE.plan.rooms if room.polygon.contains(place))
        assert exits(SITE.plan, room.polygon) == 1
        assert is_clear(SITE.plan, episode.start[:2], LIMITS.start_clearance - 0.01)
        for clause in clauses[1:2]:
            goal = plan_goals(SITE.plan, Command((Leave(),)), episode.start)[0]
            ahead = corridor_at(SITE.plan.scene, goal.onward)
            across = ahead.end <= LEAST_AHEAD or ahead.half_width >= WIDEST_HALF
            assert not across or (isinstance(clause, Turn) and clause.at is None)
    assert seen > 3


def test_where_no_room_has_a_name_none_is_spoken_of() -> None:
    site = Site(replace(SITE.plan, rooms=()), OFFICE)
    split = replace(SPLITS["val_unseen"], clauses=(1,))
    for number in range(6):
        clauses = generate_episode(site, split, number).meanings()[0].clauses
        assert not any(isinstance(clause, GoToRoom) for clause in clauses)


@pytest.mark.parametrize("clauses", [2, 3, 4])
def test_both_judges_agree_on_drafted_conditions(clauses: int) -> None:
    """Judge and second opinion judge each branch alike."""
    verdicts, said = set(), set()
    for seed in range(24):
        draft, rng = drafter(seed), np.random.default_rng(seed)
        command = draft.feasible(clauses, CommandTopic.CONDITION)
        if command is None:
            continue
        assert len(command.clauses) == clauses
        for language in ("en", "de"):
            assert parse(command.say(language), language) == command
        judge = Judge(plan_mission(SITE.plan, SITE.geodesic, command, draft.start))
        recording = ghost(judge, targets(SITE.plan, judge, rng), rng, stand=11.0)
        assert recheck(recording, SITE.plan, judge.goals).verdict == judge.verdict
        verdicts.add(judge.verdict)
        said |= {(c.absent, c.otherwise) for c in command.clauses if isinstance(c, IfThere)}
    assert Verdict.DONE in verdicts
    assert len(verdicts) > 1
    assert len(said) > 1


def test_a_condition_is_in_doubt_where_a_closed_door_decides_it() -> None:
    plan = load_floor_plan("office_cross")
    ambiguity_filter = AmbiguityFilter(plan)
    conditions = [
        IfThere(DoorReference(n, side)) for side in (Side.LEFT, Side.RIGHT) for n in range(1, 12)
    ]
    answers = {condition: ambiguity_filter.met(condition, WEST) for condition in conditions}
    opened = AmbiguityFilter(replace(plan, doors=tuple(door for door in plan.doors if door.open)))
    sure = {condition: opened.met(condition, WEST) for condition in conditions}
    doubtful = [condition for condition in conditions if answers[condition] is None]
    assert any(sure[condition] is not None for condition in doubtful)
    assert all(sure[c] is answers[c] for c in conditions if answers[c] is not None)
    assert True in answers.values()


def test_impossible_commands_stay_so_under_any_count() -> None:
    """They stay impossible with closed doors counted and without glass."""
    seen = set()
    for number in range(24):
        draft = drafter(number)
        command = draft.infeasible(1 + number % 2)
        if command is None:
            continue
        begin = draft.start
        if len(command.clauses) > 1:
            goal = plan_goals(SITE.plan, Command(command.clauses[:-1]), begin)[-1]
            begin = goal.onward or goal.pose
        last = command.clauses[-1]
        seen.add(type(last))
        assert draft.ambiguity_filter.impossible(last, begin)
        assert not any(
            j.is_corner and j.far > 0.5 for j in corridor_at(SITE.plan.scene, begin).junctions
        )
        assert corridor_at(SITE.plan.scene, begin).end < 40.0
    assert len(seen) > 1


def test_what_some_count_allows_is_not_called_impossible() -> None:
    """A command that some way of counting allows is not impossible."""
    ambiguity_filter = AmbiguityFilter(load_floor_plan("office_cross"))
    feasible = GoToDoor(DoorReference(1, Side.RIGHT))
    crossing = Follow(PlaceReference(Place.CORNER))  # there is no corner, but a crossing
    assert not ambiguity_filter.impossible(feasible, WEST)
    assert not ambiguity_filter.impossible(crossing, WEST)


def taken_for(text: str, language: str) -> Command | None:
    """The command on which a robot acts; None if it asks, or refuses the text."""
    try:
        return parse(text, language)
    except CommandError:
        return None


@pytest.mark.parametrize("language", ["en", "de"])
def test_a_corrected_slip_means_what_was_meant(language: str) -> None:
    rng, slips, heard = np.random.default_rng(0), set(), []
    no = {"en": ", no, ", "de": ", nein, "}[language]
    for said in (
        "turn left at the first corner and go through the second door on the right",
        "go to the third door",
        "turn right at the second intersection",
        "leave the room and turn left",
    ):
        for _ in range(40):
            text = worded(parse(said), language, rng, ())
            assert text is not None
            heard.append(taken_for(text, language) in (None, parse(said)))
            if no in text:
                slips.add(said)
    assert len(slips) == 4
    assert np.mean(heard) >= 0.95


@pytest.mark.parametrize("language", ["en", "de"])
def test_the_first_door_behind_a_closed_one_is_the_next(language: str) -> None:
    command = parse("turn left, then go through the first door on the left")
    texts = {
        worded(command, language, np.random.default_rng(seed), (), closed=True)
        for seed in range(20)
    }
    words = {"en": "is closed, take the next", "de": "geschlossen ist, nimm die nächste"}
    assert any(words[language] in str(text) for text in texts)
    assert all(taken_for(str(text), language) in (None, command) for text in texts)


def test_no_draft_leads_past_a_corner() -> None:
    """Around it, or straight on? Both are said so; a turn at the corner is drawn instead."""
    past_corner = Follow(PlaceReference(Place.CORNER), past=True)
    assert all(drafter(seed).problem((past_corner,)) is not None for seed in range(10))
    commands = [drafter(seed).feasible(2, CommandTopic.FOLLOW) for seed in range(40)]
    assert not any(past_corner in command.clauses for command in commands if command)


def test_passing_doors_and_turning_by_degrees_are_said_underway() -> None:
    commands = [drafter(seed).feasible(3, CommandTopic.TURN) for seed in range(40)]
    clauses = [clause for command in commands if command for clause in command.clauses]
    assert any(isinstance(clause, Follow) and clause.past for clause in clauses)
    assert any(isinstance(clause, Turn) and clause.degrees for clause in clauses)
