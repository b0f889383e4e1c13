"""`spindle serve`; `spindle sim` and `spindle scenario`, handed to the simulator's own process."""

from __future__ import annotations

import os
import subprocess
import sys
from argparse import Namespace
from collections.abc import Sequence


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
        "tls": options.tls,
    }
    return serve(load(flags))


def run_simulator(arguments: Sequence[str]) -> int:
    """Runs `python -m sim_device ...` in place of this process; its exit code is ours."""
    command = [sys.executable, "-m", "sim_device", "--as", "spindle", *arguments]
    if os.name == "posix":
        sys.stdout.flush()
        os.execv(sys.executable, command)
    return subprocess.call(command)
