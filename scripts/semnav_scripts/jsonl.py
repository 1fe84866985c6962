"""JSON Lines files that are never left incomplete."""

from __future__ import annotations

import errno
import json
import os
from contextlib import ExitStack
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from semnav_features.interruption import uninterrupted
from semnav_features.sole_writer import sole_writer
from semnav_features.writing import (
    discard,
    naming,
    part_of,
    put_in_place,
    target_of,
    writing_mode,
)
from semnav_scripts.outputs import counted


class JsonLines:
    """A file with one JSON object in each line, which replaces an older file only at the end.

    Until then the lines are written to a file beside it, `.NAME-....part.jsonl`. Each line is a
    single write, so no line is ever incomplete. The end may also be an error or an interruption;
    the error then gets a note that says where the lines are. Without any line an older file stays.

    Args:
        path: of the file; missing folders are made. A pipe or a terminal is written directly.

    Raises:
        OSError: it cannot be written, or another run is writing it.
    """

    def __init__(self, path: Path) -> None:
        self.path = target_of(path).resolve()
        with naming(self.path):
            self._part = part_of(self.path)
        self._lines, self._lock = 0, ExitStack()

    def write(self, document: dict[str, Any]) -> None:
        """Add a line.

        Raises:
            ValueError: a number is not finite.
            OSError: the disk is full.
        """
        line = json.dumps(document, allow_nan=False).encode() + b"\n"
        with naming(self.path):
            written = self._file.write(line)
        if written != len(line):
            self._file.truncate(self._file.tell() - written)
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(self.path))
        self._lines += 1

    def __enter__(self) -> Self:
        """The open file."""
        try:
            with naming(self.path):
                if self._part != self.path:
                    self._lock.enter_context(sole_writer(self.path))
                self._file = open(self._part, writing_mode(self._part), buffering=0)
        except BaseException:  # Ctrl-C may come when the file is there already
            with self._lock:
                discard(self._part, self.path)
            raise
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Rename the file to its final name."""
        with uninterrupted(), self._lock:
            self._file.close()
            if not self._lines and error is not None:
                discard(self._part, self.path)
                return
            with naming(self.path):
                put_in_place(self._part, self.path)
        if error is not None and self._part != self.path:
            error.add_note(f"'{self.path}' holds the {counted(self._lines, 'line')} so far")
