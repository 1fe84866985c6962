"""Settings shared by all tests."""

from hypothesis import settings

# The first call of a compiled kernel takes seconds, so no example has a deadline.
settings.register_profile("semnav", deadline=None)
settings.load_profile("semnav")
