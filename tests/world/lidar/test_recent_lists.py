"""The lists of near segments that nobody uses take bounded memory."""

import gc
from concurrent.futures import ThreadPoolExecutor
from weakref import ref

import numpy as np

from semnav_env.world.lidar.culling import MAX_KEPT_BYTES, Culling, Recent
from tests.support.small_plans import empty_hall


def lists_of(size: int) -> Culling:
    return Culling(np.zeros(1), np.zeros(0, np.int64), np.zeros((4, size // 32)))


def test_lists_are_kept_up_to_a_bound_those_asked_for_last() -> None:
    recent, third = Recent(), MAX_KEPT_BYTES // 3
    found = [lists_of(third) for _ in range(3)]
    first, second, last = map(ref, found)
    for each in found:
        recent.keep(each)
    recent.keep(found[0])
    recent.keep(lists_of(third))
    del each, found
    gc.collect()
    assert first() is not None
    assert second() is None
    assert last() is not None
    assert recent.bytes <= MAX_KEPT_BYTES


def test_lists_go_with_their_floor_plan() -> None:
    recent, plan, lists = Recent(), empty_hall(), lists_of(1_000)
    recent.drop_with(plan, lists)
    recent.keep(lists)
    kept = ref(lists)
    del plan, lists
    gc.collect()
    other = lists_of(320)
    recent.keep(other)
    assert kept() is None
    assert recent.bytes == other.size


def test_lists_that_are_too_large_to_keep_replace_all_others() -> None:
    recent = Recent()
    recent.keep(lists_of(1_000))
    huge = lists_of(2 * MAX_KEPT_BYTES)
    recent.keep(huge)
    assert recent.bytes == huge.size
    recent.keep(lists_of(1_000))
    assert recent.bytes < MAX_KEPT_BYTES


def test_threads_that_keep_and_drop_lists_at_once_all_come_to_their_end() -> None:
    recent = Recent()

    def keep_and_let_go(_: int) -> None:
        for _ in range(200):
            plan, lists = empty_hall(), lists_of(320)
            recent.drop_with(plan, lists)
            recent.keep(lists)

    with ThreadPoolExecutor(8) as threads:
        list(threads.map(keep_and_let_go, range(8)))
    recent.keep(last := lists_of(320))
    assert recent.bytes == last.size
