"""Commands: from words to typed clauses, and back to words."""

from semnav_env.commands.clauses import (
    LAST,
    MAX_ORDINAL,
    Approach,
    Clause,
    DoorReference,
    Follow,
    GoToDoor,
    Place,
    PlaceReference,
    Side,
    Stop,
    Turn,
    Turning,
)
from semnav_env.commands.command import MAX_CLAUSES, Command
from semnav_env.commands.errors import CommandError
from semnav_env.commands.parser import parse
from semnav_env.commands.sampling import sample_clause, sample_command
from semnav_env.commands.tokens import CLAUSE_FEATURES, decode, encode, token_space

__all__ = [
    "CLAUSE_FEATURES",
    "LAST",
    "MAX_CLAUSES",
    "MAX_ORDINAL",
    "Approach",
    "Clause",
    "Command",
    "CommandError",
    "DoorReference",
    "Follow",
    "GoToDoor",
    "Place",
    "PlaceReference",
    "Side",
    "Stop",
    "Turn",
    "Turning",
    "decode",
    "encode",
    "parse",
    "sample_clause",
    "sample_command",
    "token_space",
]
