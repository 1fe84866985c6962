"""The parser of a language: Lark's LALR(1) table, fed with the longest phrase that fits.

Lark has no lexer that asks the parser which terminals may come next, so `Lexicon` does that here,
and the parser is fed token by token.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from itertools import pairwise
from typing import Any

from lark import Lark, Token
from lark.exceptions import UnexpectedToken, VisitError
from lark.lexer import Lexer
from lark.parsers.lalr_interactive_parser import InteractiveParser

from semnav_env.commands.clause_readings import ClauseReadings
from semnav_env.commands.clause_transformer import clauses_of_tree
from semnav_env.commands.language import NAME, PUNCTUATION, QUESTION, Language
from semnav_env.commands.rooms import spoken_names
from semnav_env.commands.words import FILLER, Lexicon, pieces


class MeaninglessError(ValueError):
    """Words that fit the grammar but have no meaning: "turn 7 degrees".

    Attributes:
        start: index of their first character in the text.
        stop: index behind their last character.
    """

    def __init__(self, problem: str, start: int, stop: int) -> None:
        super().__init__(problem)
        self.start = start
        self.stop = stop


class _NoLexer(Lexer):
    """Stands in for Lark's lexer, which is never asked: `Lexicon` finds the words."""

    def __init__(self, _: Any) -> None:
        pass

    def lex(self, lexer_state: Any, parser_state: Any) -> Iterator[Token]:
        return iter(())


def find_clauses(
    language: Language, text: str, rooms: tuple[str, ...] = ()
) -> list[ClauseReadings]:
    """The clauses of a normalised text, in order, each with its readings.

    Args:
        language: gives the grammar and the words.
        text: from `normalise`.
        rooms: names of rooms that need no quotation marks.

    Raises:
        lark.UnexpectedToken: the text does not fit the grammar.
        MeaninglessError: it fits, but has no meaning.
    """
    spoken = spoken_names(rooms)
    tree = _tree(language, text, tuple(spoken))
    try:
        return _apart(clauses_of_tree(tree, language, spoken), text)
    except VisitError as error:
        if not isinstance(error.orig_exc, ValueError):
            raise
        meta: Any = getattr(error.obj, "meta", None)
        start, stop = getattr(meta, "start_pos", 0), getattr(meta, "end_pos", len(text))
        raise MeaninglessError(str(error.orig_exc), start, stop) from None


def _apart(found: list[ClauseReadings], text: str) -> list[ClauseReadings]:
    """Decide what a bare "left" means: the side of a door, or a turn.

    It is the side only directly behind a door without one ("the door, left"). After "and" or
    "then" it is a turn.
    """
    apart = found[:1] and [found[0].without_sides()]
    for before, each in pairwise(found):
        joined = any(map(str.isalpha, text[before.stop : each.start]))
        apart.append(each if before.wants_side and not joined else each.without_sides())
    return apart


def _tree(language: Language, text: str, rooms: tuple[str, ...]) -> Any:
    parser: InteractiveParser = _parser(language).parse_interactive()
    lexicon = _lexicon(language, rooms)
    words = pieces(text)
    first, last = 0, None
    while first < len(words):
        state = parser.parser_state
        accepted = state.parse_conf.parse_table.states[state.position]
        word = lexicon.find(words, first, accepted)
        start, stop = words[first].start, words[word.stop - 1].stop
        first = word.stop
        if word.terminal != FILLER:
            last = Token(word.terminal, word.text, start_pos=start, end_pos=stop)
            _feed(parser, last)
    end = Token("$END", "", start_pos=len(text), end_pos=len(text))
    return _feed(parser, end)


def _feed(parser: InteractiveParser, token: Token) -> Any:
    try:
        return parser.feed_token(token)
    except UnexpectedToken as unexpected:
        unexpected.interactive_parser = parser
        raise


@lru_cache(maxsize=32)
def _lexicon(language: Language, rooms: tuple[str, ...]) -> Lexicon:
    phrases = [
        (t, language.folded(p.casefold())) for t, ps in language.terminals.items() for p in ps
    ]
    signs = [(PUNCTUATION, sign) for sign in language.punctuation] + [(QUESTION, "?")]
    return Lexicon([*phrases, *signs, *((NAME, name) for name in rooms)])


@lru_cache(maxsize=32)
def _parser(language: Language) -> Lark:
    return Lark(
        language.lark(),
        parser="lalr",
        lexer=_NoLexer,
        propagate_positions=True,
        maybe_placeholders=False,
    )
