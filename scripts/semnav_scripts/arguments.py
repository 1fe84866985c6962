"""Reads command lines as frozen dataclasses, with one-line errors."""

from __future__ import annotations

import io
import math
import re
from collections.abc import Sequence
from contextlib import redirect_stderr
from dataclasses import replace
from types import NoneType
from typing import TYPE_CHECKING, Any, Optional, Protocol, TypeAlias, cast, get_args

import tyro
from tyro.constructors import ConstructorRegistry, PrimitiveConstructorSpec, PrimitiveTypeInfo

from semnav_scripts.terminal_text import as_utf8

if TYPE_CHECKING:  # `semnav doctor` must start without the compiled kernels
    from semnav_features.frames import Pose

OptionalText: TypeAlias = Optional[str]  # noqa: UP045 - for `str | None` tyro imports typeguard
"""A text or None as the type of an option; this form saves 0.05 s at the start."""

NONE = "None"
"""The word for an option that is absent."""

READERS = ConstructorRegistry()
"""How tyro reads types of options, where not in its own way."""


@READERS.primitive_rule
def _read_optional(type_info: PrimitiveTypeInfo) -> PrimitiveConstructorSpec[Any] | None:
    """Show `X | None` as X: a person leaves out an option that may be absent.

    Launch files cannot leave one out: they give the word None. A choice shows that word.
    """
    kinds = set(get_args(type_info.type))
    if len(kinds) != 2 or NoneType not in kinds:
        return None
    (kind,) = kinds - {NoneType}
    spec = ConstructorRegistry.get_primitive_spec(PrimitiveTypeInfo.make(kind, type_info.markers))
    if not isinstance(spec, PrimitiveConstructorSpec) or spec.choices is not None:
        return None
    return replace(
        spec,
        instance_from_str=lambda words: None if words == [NONE] else spec.instance_from_str(words),
        is_instance=lambda value: value is None or spec.is_instance(value),
        str_from_instance=lambda value: [NONE] if value is None else spec.str_from_instance(value),
    )


class Runnable(Protocol):
    """The arguments of a sub-command, with the method that runs it."""

    def run(self) -> int:
        """Run the sub-command and return its exit code."""
        ...


class HelpShown(Exception):  # noqa: N818 - not an error: the help was asked for and printed
    """Raised after the help was printed; there is nothing to run."""


def parse(arguments: Any, words: Sequence[str], prog: str) -> Runnable:
    """Read command-line words as an instance of `arguments`.

    Args:
        arguments: a dataclass with a `run` method, or a union of such.
        words: the words after the name of the command.
        prog: name of the command in help and errors.

    Raises:
        HelpShown: the help was asked for and printed.
        ValueError: the words do not fit; one line names the word and a correct value.
    """
    box = io.StringIO()
    try:
        with redirect_stderr(box):
            return _with_said_command(
                tyro.cli(arguments, args=list(words), prog=prog, registry=READERS)
            )
    except SystemExit as stop:
        if not stop.code:
            raise HelpShown from None
        raise ValueError(f"{_unboxed(box.getvalue())} (see {prog} --help)") from None


def _with_said_command(arguments: Any) -> Runnable:
    """The arguments with their `command`, if they have one, as its words were typed."""
    command = getattr(arguments, "command", None)
    if isinstance(command, str):
        arguments = replace(arguments, command=as_utf8(command))
    return cast(Runnable, arguments)


def _unboxed(box: str) -> str:
    """The sentences of tyro's error box, without its frame, title and advice."""
    rows = [re.sub("[│─╭╮╰╯]+", " ", row).strip() for row in box.splitlines()[1:]]
    text = " ".join(row for row in rows if row)
    return re.split(r" ?(?:Argument helptext:|For full helptext|Full helptext)", text)[0].strip()


def parse_pose(text: str) -> Pose:
    """Read a pose written as "x,y,heading", metres and radians.

    Raises:
        ValueError: the text is something else.
    """
    try:
        x, y, heading = (float(part) for part in text.split(","))
    except ValueError:
        x = y = heading = math.nan
    if not math.isfinite(x + y + heading):
        raise ValueError(f"pose {text!r} is not x,y,heading, such as -2.5,-0.3,0.24")
    return x, y, heading
