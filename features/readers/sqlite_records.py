"""ROS 2's SQLite storage in the order of recording, cut off or not."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

from semnav_env.features.readers.channel import Channel, Message


def sqlite_messages(path: Path) -> Iterator[Message]:
    """The messages of a .db3 file.

    Raises:
        sqlite3.DatabaseError: it ends too early or is damaged.
    """
    address = f"{path.resolve().as_uri()}?immutable=1"
    with closing(sqlite3.connect(address, uri=True)) as database:
        # Without it SQLite opens no file that is shorter than its first page says.
        database.execute("PRAGMA writable_schema=ON")
        topics = database.execute("SELECT id, name, type, serialization_format FROM topics")
        channels = {number: Channel.of(*names) for number, *names in topics}
        rows = database.execute("SELECT topic_id, timestamp, data FROM messages ORDER BY id")
        for number, time, data in rows:
            yield channels[number], time, data
        (whole,) = database.execute("PRAGMA page_count").fetchone()
        (size,) = database.execute("PRAGMA page_size").fetchone()
        if path.stat().st_size < whole * size:
            raise EOFError
