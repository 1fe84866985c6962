"""A visitor of the page of `semnav serve`, who talks as a browser does."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

HOME = "http://127.0.0.1:8321"
SCENE = {"type": "scene", "pose": [-2.5, -0.6, 0.25]}
SECOND_DOOR = {"type": "command", "text": "go through the second door on the right"}

WALLS = """0,0,8,0\n8,0,8,2\n8,2,4,2\n3,2,0,2\n0,2,0,0\n0,2,0,5\n0,5,8,5\n8,5,8,2\n"""
"""A corridor, 2 m wide, with an opening of 1 m to a room behind it: lines of a .csv file."""


class Visitor:
    """A visitor of the page, whose messages come until one of some type does."""

    def __init__(self, socket: Any) -> None:
        self.socket = socket

    def send(self, **message: Any) -> None:
        self.socket.send_text(json.dumps(message))

    def drop(self, name: str, content: bytes) -> None:
        """Drop a file on the page."""
        self.socket.send_bytes(json.dumps({"name": name}).encode() + b"\n" + content)

    def draw(self, tool: str, *points: tuple[float, float], **fields: Any) -> dict[str, Any]:
        """Draw, and return the board."""
        self.send(type="draw", tool=tool, points=points, **fields)
        return self.next("board")

    def next(self, *kinds: str) -> dict[str, Any]:
        """The next message of one of these types; other good news before it are skipped."""
        while True:
            message = json.loads(self.socket.receive_text())
            if message["type"] in kinds:
                return message
            assert message["type"] not in ("error", "refused"), message

    def next_file(self) -> tuple[str, bytes]:
        """Name and content of the next file."""
        while (content := self.socket.receive().get("bytes")) is None:
            pass
        head, _, content = content.partition(b"\n")
        return json.loads(head)["name"], content


@contextmanager
def opened_page(sessions: int) -> Iterator[Any]:
    """The client of a page."""
    from starlette.testclient import TestClient

    from semnav_scripts.page.app import page_app

    with TestClient(page_app(sessions=sessions), base_url=HOME) as opened:
        yield opened


@contextmanager
def visitor(client: Any, **headers: str) -> Iterator[Visitor]:
    address = f"{HOME.replace('http', 'ws')}/session"
    with client.websocket_connect(address, headers=headers) as socket:
        yield Visitor(socket)


@contextmanager
def in_the_hallway(client: Any) -> Iterator[Visitor]:
    """A visitor whose robot stands in the hallway and hurries."""
    with visitor(client) as one:
        one.send(**SCENE)
        one.next("scene")
        one.send(type="speed", factor=16)
        yield one
