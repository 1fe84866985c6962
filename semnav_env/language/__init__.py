"""Commands: texts become typed clauses, and clauses become texts and tokens."""

from typing import TYPE_CHECKING

from semnav_env.language.clauses import (
    Approach,
    BackUp,
    Clause,
    Face,
    Follow,
    GoBack,
    GoToDoor,
    GoToRoom,
    IfThere,
    Leave,
    Pace,
    Speed,
    Stop,
    Turn,
    Turning,
)
from semnav_env.language.command import MAX_CLAUSES, Command
from semnav_env.language.finding_clauses import (
    AskName,
    CallOut,
    GoToPerson,
    LookAround,
    SearchHouse,
    SearchRoom,
)
from semnav_env.language.own_clause import OwnClause
from semnav_env.language.references import (
    ENTRY,
    LAST,
    MAX_FROM_END,
    MAX_ORDINAL,
    OTHER,
    SOME,
    Distance,
    DoorReference,
    DoorRelation,
    Place,
    PlaceOffset,
    PlaceReference,
    Relation,
    RoomReference,
    Side,
    Unit,
)
from semnav_env.language.tokens import CLAUSE_FEATURES, token_mask, token_space
from semnav_features.lazy_names import lazy_names

if TYPE_CHECKING:
    from semnav_env.language.canonical import read
    from semnav_env.language.encoding import decode, encode
    from semnav_env.language.errors import CommandError
    from semnav_env.language.interpreters import Interpretation, Interpreter, ModelInterpreter
    from semnav_env.language.program import from_program, to_program
    from semnav_env.language.question import AmbiguousCommandError, Ask, Question
    from semnav_env.language.rewording import paraphrases
    from semnav_env.language.sampling import sample_clause, sample_command
    from semnav_env.language.translating.corrections import corrections
    from semnav_env.language.translating.interpreter import LearnedInterpreter, correct, parse

__all__ = [
    "CLAUSE_FEATURES",
    "ENTRY",
    "LAST",
    "MAX_CLAUSES",
    "MAX_FROM_END",
    "MAX_ORDINAL",
    "OTHER",
    "SOME",
    "AmbiguousCommandError",
    "Approach",
    "Ask",
    "AskName",
    "BackUp",
    "CallOut",
    "Clause",
    "Command",
    "CommandError",
    "Distance",
    "DoorReference",
    "DoorRelation",
    "Face",
    "Follow",
    "GoBack",
    "GoToDoor",
    "GoToPerson",
    "GoToRoom",
    "IfThere",
    "Interpretation",
    "Interpreter",
    "LearnedInterpreter",
    "Leave",
    "LookAround",
    "ModelInterpreter",
    "OwnClause",
    "Pace",
    "Place",
    "PlaceOffset",
    "PlaceReference",
    "Question",
    "Relation",
    "RoomReference",
    "SearchHouse",
    "SearchRoom",
    "Side",
    "Speed",
    "Stop",
    "Turn",
    "Turning",
    "Unit",
    "correct",
    "corrections",
    "decode",
    "encode",
    "from_program",
    "paraphrases",
    "parse",
    "read",
    "sample_clause",
    "sample_command",
    "to_program",
    "token_mask",
    "token_space",
]

__getattr__ = lazy_names(
    __name__,
    {
        ".canonical": ("read",),
        ".encoding": ("decode", "encode"),
        ".errors": ("CommandError",),
        ".interpreters": ("Interpretation", "Interpreter", "ModelInterpreter"),
        ".program": ("from_program", "to_program"),
        ".question": ("AmbiguousCommandError", "Ask", "Question"),
        ".rewording": ("paraphrases",),
        ".sampling": ("sample_clause", "sample_command"),
        ".translating.corrections": ("corrections",),
        ".translating.interpreter": ("LearnedInterpreter", "correct", "parse"),
    },
)
