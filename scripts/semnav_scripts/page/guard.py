"""Lets in only those who ask for this server by its own name, from its own page.

A page from elsewhere that a browser has open could otherwise talk to a server of this machine, by
a request of its own (`Origin`) or by a name that leads here (`Host`).
"""

from __future__ import annotations

from urllib.parse import urlsplit

from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

LOCAL_NAMES = frozenset({"127.0.0.1", "localhost", "::1"})
"""Names of this machine for itself."""

POLICY = b"default-src 'self'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'"
"""Nothing from elsewhere is loaded, and no other page shows this one."""


class OwnOriginOnly:
    """Refuses requests with a foreign `Host` or `Origin`.

    Args:
        app: what is guarded.
        names: by which the server may be asked for, without a port.
    """

    def __init__(self, app: ASGIApp, names: frozenset[str] = LOCAL_NAMES) -> None:
        self._app, self._names = app, names

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, or refuse it: with 403, or by closing the WebSocket."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        problem = self._problem(scope)
        if problem is None:
            await self._app(scope, receive, _with_policy(send))
        elif scope["type"] == "http":
            await PlainTextResponse(problem, 403)(scope, receive, send)
        else:
            await send({"type": "websocket.close", "code": 1008, "reason": problem})

    def _problem(self, scope: Scope) -> str | None:
        headers = [(name, value.decode("latin-1")) for name, value in scope["headers"]]
        hosts = [value for name, value in headers if name == b"host"]
        if len(hosts) != 1 or _name(f"//{hosts[0]}") not in self._names:
            return f"this server answers only to {', '.join(sorted(self._names))}"
        origins = [value for name, value in headers if name == b"origin"]
        if any(urlsplit(origin).netloc != hosts[0] for origin in origins):
            return "pages from elsewhere may not use this server"
        return None


def _name(address: str) -> str | None:
    try:
        return urlsplit(address).hostname
    except ValueError:
        return None


def _with_policy(send: Send) -> Send:
    async def sending(message: Message) -> None:
        if message["type"] == "http.response.start":
            headers = [
                (b"content-security-policy", POLICY),
                (b"x-content-type-options", b"nosniff"),
                (b"referrer-policy", b"no-referrer"),
                (b"cache-control", b"no-cache"),
            ]
            message = {**message, "headers": [*message.get("headers", []), *headers]}
        await send(message)

    return sending
