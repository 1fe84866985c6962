"""The value of a rank is that of the sorted values."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from semnav_features.kernels.selection import finite_values, value_of_rank

FEW_VALUES = st.sampled_from([0.5, 1.0, 1.5, 2.0])
"""Sides of corridors repeat the same few distances."""


@given(st.lists(FEW_VALUES | st.floats(-1e6, 1e6), min_size=1, max_size=60), st.data())
def test_value_of_rank_is_that_of_the_sorted_values(
    values: list[float], data: st.DataObject
) -> None:
    rank = data.draw(st.integers(0, len(values) - 1))
    assert value_of_rank(np.array(values), rank) == sorted(values)[rank]


@given(st.lists(FEW_VALUES | st.sampled_from([np.inf, -np.inf, np.nan]), max_size=30))
def test_finite_values_are_those_that_numpy_calls_finite(values: list[float]) -> None:
    given_values = np.array(values, np.float64)
    expected = given_values[np.isfinite(given_values)]
    np.testing.assert_array_equal(finite_values(given_values), expected)
