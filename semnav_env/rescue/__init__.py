"""Search and rescue: a person detector, its map of people, judged searches, and calling."""

from semnav_env.rescue.call_and_listen import CallAndListen
from semnav_env.rescue.microphones import MicrophoneArray, MicrophoneSettings
from semnav_env.rescue.outcome import SearchOutcome
from semnav_env.rescue.person_finder import PersonFinder
from semnav_env.rescue.person_map import PersonMap, PersonTrack
from semnav_env.rescue.person_search import PersonSearch
from semnav_env.rescue.settings import PersonDetectorSettings, PersonMapSettings, SearchRules
from semnav_env.rescue.voice_fix import HeardVoice, PersonVoice, VoiceFix, fix

__all__ = [
    "CallAndListen",
    "HeardVoice",
    "MicrophoneArray",
    "MicrophoneSettings",
    "PersonDetectorSettings",
    "PersonFinder",
    "PersonMap",
    "PersonMapSettings",
    "PersonSearch",
    "PersonTrack",
    "PersonVoice",
    "SearchOutcome",
    "SearchRules",
    "VoiceFix",
    "fix",
]
