"""What waits to be sent to one browser: never more than it can hold."""

from __future__ import annotations

import asyncio
import threading
from collections import deque

MAX_NEWS = 64
"""The most messages that may wait; a client that takes none of so many is gone."""


class ClientTooSlowError(Exception):
    """A client did not take the messages that it was sent."""


class Outbox:
    """Messages from the thread of a session to the event loop of the server.

    News are sent in order, each of them. Of pictures only the latest waits: a slow client sees
    fewer of them, and costs no memory.

    Args:
        loop: the event loop that sends.
    """

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        self._loop, self._lock = loop, threading.Lock()
        self._news: deque[str | bytes] = deque()
        self._picture: str | None = None
        self._filled = asyncio.Event()
        self.dropped = 0
        """Number of pictures that a later one replaced before they were sent."""

    def put_news(self, message: str | bytes) -> None:
        """Add a message.

        Raises:
            ClientTooSlowError: too many wait already.
        """
        with self._lock:
            if len(self._news) >= MAX_NEWS:
                raise ClientTooSlowError(f"{MAX_NEWS} messages wait for the client")
            self._news.append(message)
        self._wake()

    def put_picture(self, message: str) -> None:
        """Replace the picture that waits, if one does."""
        with self._lock:
            self.dropped += self._picture is not None
            self._picture = message
        self._wake()

    async def next(self) -> str | bytes:
        """The next message, as soon as there is one; news come before a picture."""
        while True:
            with self._lock:
                self._filled.clear()
                if self._news:
                    return self._news.popleft()
                if self._picture is not None:
                    message, self._picture = self._picture, None
                    return message
            await self._filled.wait()

    def _wake(self) -> None:
        if not self._loop.is_closed():
            self._loop.call_soon_threadsafe(self._filled.set)
