"""Hypothesis strategies for clauses and commands."""

from hypothesis import strategies as st

from semnav_env.commands import (
    LAST,
    MAX_CLAUSES,
    MAX_ORDINAL,
    Approach,
    Command,
    DoorReference,
    Follow,
    GoToDoor,
    Place,
    PlaceReference,
    Side,
    Stop,
    Turn,
    Turning,
)

ordinals = st.integers(1, MAX_ORDINAL)
doors = st.builds(
    DoorReference, st.one_of(ordinals, st.just(LAST)), st.one_of(st.none(), st.sampled_from(Side))
)
junctions = st.builds(PlaceReference, st.sampled_from((Place.INTERSECTION, Place.CORNER)), ordinals)
places = st.one_of(st.just(PlaceReference(Place.END)), junctions)
clauses = st.one_of(
    st.just(Stop()),
    st.builds(Turn, st.sampled_from(Turning), st.one_of(st.none(), places)),
    st.builds(GoToDoor, doors, st.sampled_from(Approach)),
    st.builds(Follow, st.one_of(st.none(), places, doors)),
)
commands = st.lists(clauses, min_size=1, max_size=MAX_CLAUSES).map(lambda c: Command(tuple(c)))
