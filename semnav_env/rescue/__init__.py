"""Search and rescue: a person detector, its map of people, and the judgement of a search."""

from semnav_env.rescue.outcome import SearchOutcome
from semnav_env.rescue.person_map import PersonMap, PersonTrack
from semnav_env.rescue.person_search import PersonSearch
from semnav_env.rescue.settings import PersonDetectorSettings, PersonMapSettings, SearchRules

__all__ = [
    "PersonDetectorSettings",
    "PersonMap",
    "PersonMapSettings",
    "PersonSearch",
    "PersonTrack",
    "SearchOutcome",
    "SearchRules",
]
