"""Settings of the tests of reliability."""

import pytest

from tests.reliability.areas import compile_kernels


@pytest.fixture(autouse=True, scope="session")
def _compiled() -> None:
    """Children that are limited in time inherit compiled kernels."""
    compile_kernels()
