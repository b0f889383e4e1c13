"""`spindle ... | head`: a reader that has enough ends the command, quietly."""

from __future__ import annotations

import contextlib
import os
import sys
from collections.abc import Callable


def until_nobody_reads(work: Callable[[], int]) -> int:
    """Runs `work` and flushes what it said; its exit code, 0 where the reader left early."""
    try:
        try:
            return work()
        finally:
            # At exit Python does it once more, with a trace where there is nobody.
            sys.stdout.flush()
            sys.stderr.flush()
    except BrokenPipeError:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        for stream in (sys.stdout, sys.stderr):
            with contextlib.suppress(OSError, ValueError):
                os.dup2(nowhere, stream.fileno())
        return 0
