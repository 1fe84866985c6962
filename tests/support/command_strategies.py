"""Hypothesis strategies for clauses and commands."""

from dataclasses import replace

from hypothesis import strategies as st

from semnav_env.language import (
    ENTRY,
    MAX_CLAUSES,
    MAX_FROM_END,
    MAX_ORDINAL,
    OTHER,
    SOME,
    Approach,
    AskName,
    CallOut,
    Command,
    Distance,
    DoorReference,
    Face,
    Follow,
    GoBack,
    GoToDoor,
    GoToPerson,
    GoToRoom,
    IfThere,
    Leave,
    LookAround,
    Place,
    PlaceOffset,
    PlaceReference,
    Relation,
    RoomReference,
    SearchHouse,
    SearchRoom,
    Side,
    Stop,
    Turn,
    Turning,
    Unit,
)
from semnav_env.language.command import room_of

ordinals = st.integers(-MAX_FROM_END, MAX_ORDINAL).filter(lambda ordinal: ordinal != OTHER)
doors = st.builds(
    DoorReference, ordinals | st.just(OTHER), st.one_of(st.none(), st.sampled_from(Side))
)
approached_doors = doors | st.just(DoorReference(ENTRY))
junctions = st.builds(
    PlaceReference, st.sampled_from([place for place in Place if place is not Place.END]), ordinals
)
places = st.one_of(st.just(PlaceReference(Place.END)), junctions)
distances = st.one_of(
    st.integers(1, 100).map(lambda halves: Distance(halves / 2)),
    st.integers(1, 100).map(lambda steps: Distance(steps, Unit.STEPS)),
    st.just(SOME),
)
turns_by = st.builds(
    Turn,
    st.sampled_from((Turning.LEFT, Turning.RIGHT)),
    degrees=st.integers(1, 72).map(lambda fives: 5 * fives),
)
rooms = st.sampled_from(("kitchen", "printer room", "3.508", "room_west_1", "left", "12 b", "e-1"))
room_references = st.builds(RoomReference, rooms)
turned_sides = (Side.LEFT, Side.RIGHT)
off_doors = st.builds(PlaceOffset, distances, st.sampled_from(Relation), doors | junctions)
off_rooms = st.builds(PlaceOffset, distances, st.sampled_from(Relation), room_references)
off_ends = st.builds(PlaceOffset, distances, st.just(Relation.BEFORE), places)
offsets = st.builds(Follow, st.one_of(off_doors, off_rooms, off_ends))
"""Without a token of their own, see `PlaceOffset`."""

follows = st.one_of(
    st.builds(Follow, room_references, st.booleans()),
    st.builds(Follow, st.one_of(st.none(), places, doors, distances)),
    st.builds(Follow, st.one_of(junctions, doors), past=st.just(True)),
)
findings = st.one_of(
    st.builds(SearchRoom, st.none() | room_references),
    st.sampled_from((LookAround(), CallOut(), GoToPerson(), AskName())),
)
clauses = st.one_of(
    follows,
    st.builds(Stop, st.integers(0, 100)),
    st.just(Leave()),
    st.just(SearchHouse()),
    findings,
    st.just(GoBack()),
    st.builds(GoToRoom, rooms, st.sampled_from((Approach.TO, Approach.THROUGH))),
    st.builds(
        Face, st.one_of(approached_doors, places, room_references, st.sampled_from(turned_sides))
    ),
    turns_by,
    st.builds(Turn, st.sampled_from(Turning), st.one_of(st.none(), places)),
    st.builds(GoToDoor, approached_doors, st.sampled_from(Approach)),
)
conditions = st.builds(IfThere, st.one_of(places, doors), st.booleans())
stretches = st.one_of(
    st.tuples(clauses),
    st.tuples(clauses),
    st.tuples(conditions, clauses),
    st.tuples(conditions.map(lambda c: replace(c, otherwise=True)), clauses, clauses),
)
commands = (
    st.lists(stretches, min_size=1, max_size=MAX_CLAUSES)
    .map(lambda found: tuple(clause for stretch in found for clause in stretch))
    .filter(lambda found: len(found) <= MAX_CLAUSES)
    .map(Command)
)
without_rooms = commands.filter(lambda c: not any(map(room_of, c.clauses)))
