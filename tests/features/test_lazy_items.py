"""A scene's features are made when somebody looks at them, and are then like a tuple."""

import pickle

import numpy as np
import pytest

from semnav_features.elements import CorridorProbe
from semnav_features.kernels.layout import CORRIDOR
from semnav_features.lazy_items import LazyItems

ROWS = [(0.0, 1.0, 2.0, 3.0), (4.0, 5.0, 6.0, 7.0)]
ITEMS = tuple(CorridorProbe((a, b), (c, d)) for a, b, c, d in ROWS)


@pytest.fixture
def lazy() -> LazyItems[CorridorProbe]:
    return LazyItems(np.array(ROWS, CORRIDOR), lambda a, b, c, d: CorridorProbe((a, b), (c, d)))


def test_lazy_items_equal_the_tuple_of_their_items(lazy: LazyItems[CorridorProbe]) -> None:
    assert lazy == ITEMS
    assert lazy == ITEMS
    assert lazy != ITEMS[:1]
    assert hash(lazy) == hash(ITEMS)
    assert repr(lazy) == repr(ITEMS)


def test_lazy_items_are_indexed_and_joined_like_a_tuple(lazy: LazyItems[CorridorProbe]) -> None:
    assert len(lazy) == 2
    assert lazy[-1] == ITEMS[-1]
    assert lazy[:1] == ITEMS[:1]
    assert lazy + ITEMS == ITEMS + lazy == ITEMS + ITEMS
    assert ITEMS[1] in lazy


def test_lazy_items_are_pickled_as_a_tuple(lazy: LazyItems[CorridorProbe]) -> None:
    restored = pickle.loads(pickle.dumps(lazy))
    assert type(restored) is tuple
    assert restored == ITEMS


def test_an_item_is_made_only_once(lazy: LazyItems[CorridorProbe]) -> None:
    assert lazy[0] is lazy[0]


def test_lazy_items_keep_what_was_there_when_they_were_made() -> None:
    rows = np.array(ROWS, CORRIDOR)
    lazy = LazyItems(rows, lambda *ends: ends)
    rows["start_x"] = 9.0
    assert lazy == tuple(ROWS)
