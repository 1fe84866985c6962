"""Poses and angles, in Python and in compiled code."""

from __future__ import annotations

import math

from hypothesis import given
from hypothesis import strategies as st
from numba import njit

from semnav_features.frames import wrap_angle

half_turns = st.integers(-40, 40).map(lambda n: n * math.pi)


@njit
def wrapped_by_compiled_code(angle: float) -> float:
    return wrap_angle(angle)


@given(st.floats(-1e6, 1e6) | st.floats(-7.0, 7.0) | half_turns)
def test_compiled_code_wraps_an_angle_to_the_last_bit_alike(angle: float) -> None:
    assert repr(wrapped_by_compiled_code(angle)) == repr(wrap_angle(angle))
