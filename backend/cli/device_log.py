"""`spindle device download`: a ride from a unit's own flash."""

from __future__ import annotations

import sys
import time
from argparse import Namespace

from backend.cli.client import print_json
from backend.cli.device import server_of

POLL_S = 0.5


def download(options: Namespace) -> int:
    """Fetches a log and says what became of it; its progress goes to standard error."""
    server = server_of(options)
    path = f"/devices/{server.device_id(options.unit)}/logs/{options.log}/download"
    state = server.ask("POST", path)
    while state["state"] not in ("done", "failed"):
        if not options.json and sys.stderr.isatty():
            print(f"\r{state['received']} of {state['length']} bytes", end="", file=sys.stderr)
        time.sleep(POLL_S)
        state = server.ask("GET", path)
    if options.json:
        print_json(state)
    elif state["state"] == "failed":
        print(state["detail"])
    else:
        became = "is" if state["duplicate_of"] else "became"
        print(
            f"Log {options.log} {became} ride {state['ride_id']}. {state['detail'] or ''}".rstrip()
        )
    return 0 if state["state"] == "done" else 1
