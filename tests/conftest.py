"""Settings shared by all tests."""

from hypothesis import settings

# The first call of a compiled kernel takes seconds, so no example has a deadline.
# Every run draws the same examples; `--hypothesis-profile=explore` looks for new ones.
settings.register_profile("semnav", deadline=None, derandomize=True)
settings.register_profile("explore", deadline=None)
settings.load_profile("semnav")
