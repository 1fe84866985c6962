"""Eight numbers at once are, in compiled code, what NumPy makes of them."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numba.core.errors import TypingError

from semnav_features.frames import FloatArray
from semnav_features.kernels import lanes
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.lanes import (
    WIDTH,
    first_lanes,
    larger,
    largest,
    load,
    select,
    smaller,
    smallest,
    spread,
    store,
)

eights = st.lists(st.floats(-1e9, 1e9), min_size=2 * WIDTH, max_size=2 * WIDTH).map(np.array)


@kernel
def all_of_them(numbers: FloatArray, place: int, number: float, out: FloatArray) -> None:
    """Each operation once; `out` has shape (67,)."""
    a, b = load(numbers, place), load(numbers, WIDTH)
    store(out, 0, a + b)
    store(out, 8, number - a * b)
    store(out, 16, 2.5 * a + number)
    store(out, 24, larger(a, b))
    store(out, 32, smaller(a, b))
    store(out, 40, select((a >= b) & (a <= number), a, spread(number)))
    store(out, 48, select(first_lanes(place), a, b))
    store(out, 56, abs(a))
    out[64], out[65], out[66] = largest(a), smallest(a), larger(number, out[0])


@given(eights, st.integers(0, WIDTH), st.floats(-1e9, 1e9))
def test_compiled_lanes_give_the_same_bits_as_numpy(
    numbers: FloatArray, place: int, number: float
) -> None:
    compiled, plain = np.zeros((2, 67))
    all_of_them(numbers, place, number, compiled)
    all_of_them.py_func(numbers, place, number, plain)
    assert compiled.tobytes() == plain.tobytes() or (compiled == plain).all()


def test_lanes_are_read_from_contiguous_rows_only() -> None:
    """Neighbours in a column are not neighbours in memory."""
    with pytest.raises(TypingError):
        all_of_them(np.zeros((16, 2))[:, 0], 0, 0.0, np.zeros(67))


def test_first_lanes_are_none_and_all_at_the_ends() -> None:
    assert [int(lanes.first_lanes(k).sum()) for k in (-3, 0, 3, 8, 99)] == [0, 0, 3, 8, 8]
