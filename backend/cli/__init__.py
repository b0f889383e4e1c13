"""The `spindle` command: starts a server, or asks one. Exit 0 done, 1 refused, 2 wrong usage."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from backend.cli.client import print_json
from backend.cli.parser import build_parser
from backend.cli.pipe import until_nobody_reads
from backend.errors import InvalidRequest, NoAnswer, Outcome, SpindleError, TokenNeeded

# Of a change whose answer did not come, below the message.
OUTCOMES: dict[Outcome, str] = {
    "unchanged": "Outcome: unchanged. Nothing of it is in the unit.",
    "changed": "Outcome: changed. The unit has it, at least in part.",
    "unknown": "Outcome: unknown. Look at what the unit has before you repeat it.",
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs one command line; what it returns is the process's exit code."""
    return until_nobody_reads(lambda: run(arguments))


def run(arguments: Sequence[str] | None) -> int:
    """As `main`, for somebody who reads to the end."""
    words = list(sys.argv[1:] if arguments is None else arguments)
    if words[:1] in (["sim"], ["scenario"]):
        # The simulator has its own command line; this one only saves people from knowing its name.
        from backend.cli.serve import run_simulator

        return run_simulator(words)
    options = build_parser().parse_args(words)
    try:
        code: int = options.run(options)
    except SpindleError as error:
        sys.stderr.write(f"{error.message}\n")
        for field in error.fields:
            sys.stderr.write(f"  {field.field}: {field.message}\n")
        if isinstance(error, NoAnswer) and error.outcome is not None:
            sys.stderr.write(f"{OUTCOMES[error.outcome]}\n")
        if isinstance(error, TokenNeeded):
            # For `spindle unlock sign`, which reads it from a pipe or a file.
            print_json(error.challenge)
        # A server's refusal is a plain RequestRefused: this one is about the arguments themselves.
        return 2 if isinstance(error, InvalidRequest) else 1
    except KeyboardInterrupt:
        return 1
    return code
