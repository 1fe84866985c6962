"""The parser of a language: Lark's LALR(1) table, fed with the longest phrases that fit."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache
from itertools import pairwise
from typing import Any

from lark import Lark, Token
from lark.exceptions import UnexpectedToken, VisitError
from lark.lexer import Lexer
from lark.parsers.lalr_interactive_parser import InteractiveParser

from semnav_env.commands.language import NAME, PUNCTUATION, QUESTION, Language
from semnav_env.commands.meanings import meanings_of
from semnav_env.commands.parts import Found
from semnav_env.commands.rooms import spoken_names
from semnav_env.commands.words import FILLER, Lexicon, pieces


class MeaninglessError(ValueError):
    """Words that fit the grammar and yet mean nothing: "turn 7 degrees".

    Attributes:
        start: where they begin in the text.
        stop: where they end.
    """

    def __init__(self, problem: str, start: int, stop: int) -> None:
        super().__init__(problem)
        self.start = start
        self.stop = stop


class _NoLexer(Lexer):
    """Words are found by `Lexicon`, which knows what the parser can take next."""

    def __init__(self, _: Any) -> None:
        pass

    def lex(self, *_: Any) -> Iterable[Token]:  # type: ignore[override]
        return ()


def find_clauses(language: Language, text: str, rooms: tuple[str, ...] = ()) -> list[Found]:
    """The clauses of a normalised text, in order.

    Args:
        language: whose grammar and words.
        text: normalised.
        rooms: names of rooms that may be spoken of without quotation marks.

    Raises:
        lark.UnexpectedToken: the text is not a command.
        MeaninglessError: it is, but with a number or an order that nothing has.
    """
    spoken = spoken_names(rooms)
    tree = _tree(language, text, tuple(spoken))
    try:
        return _apart(meanings_of(tree, language, spoken), text)
    except VisitError as error:
        if not isinstance(error.orig_exc, ValueError):
            raise
        meta: Any = getattr(error.obj, "meta", None)
        start, stop = getattr(meta, "start_pos", 0), getattr(meta, "end_pos", len(text))
        raise MeaninglessError(str(error.orig_exc), start, stop) from None


def _apart(found: list[Found], text: str) -> list[Found]:
    """Let a bare side speak of a door only right after one without a side: "the door, left".

    After "and" or "then" it is a turn.
    """
    apart = found[:1] and [found[0].without_asides()]
    for before, each in pairwise(found):
        joined = any(map(str.isalpha, text[before.stop : each.start]))
        apart.append(each if before.wants_side and not joined else each.without_asides())
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
