"""`spindle sim` and `spindle scenario`: handed to the simulator's own process, unchanged."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Sequence


def run_simulator(arguments: Sequence[str]) -> int:
    """Runs `python -m sim_device ...` in place of this process; its exit code is ours."""
    command = [sys.executable, "-m", "sim_device", "--as", "spindle", *arguments]
    if os.name == "posix":
        sys.stdout.flush()
        os.execv(sys.executable, command)
    return subprocess.call(command)
