"""The socket of the page, opened before anything slow is done."""

from __future__ import annotations

import socket


def listening(host: str, port: int) -> socket.socket:
    """A socket that listens at an address.

    Args:
        host: name or address.
        port: 0 for any that is free.

    Raises:
        ValueError: the address is taken, or is none of this machine.
    """
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    try:
        return socket.create_server((host, port), family=family)
    except OSError as error:
        why = error.strerror or str(error)
        raise ValueError(f"cannot listen at {host}, port {port}: {why}; try --port 0") from None
