"""`spindle serve`."""

from __future__ import annotations

from argparse import Namespace


def run_server(options: Namespace) -> int:
    """Runs the server until it is told to stop."""
    # Only here: the other verbs must not wait for the server's imports.
    from backend.main import serve
    from backend.settings import load

    devices = options.device
    if devices == ["none"]:
        devices = []
    flags = {
        "host": options.host,
        "port": options.port,
        "data": options.data,
        "device": devices,
        "author": options.author,
    }
    return serve(load(flags))
