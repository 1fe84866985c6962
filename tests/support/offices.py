"""Seeds and distributions of generated offices, to test with."""

from __future__ import annotations

import pytest
from hypothesis import strategies as st

from semnav_env.world.maps import DISTRIBUTIONS

every_distribution = pytest.mark.parametrize("name", DISTRIBUTIONS)
seeds = st.integers(0, 2**63 - 1)
names = st.sampled_from(list(DISTRIBUTIONS))
