"""`spindle device download`: a ride from a unit's own flash."""

from __future__ import annotations

import sys
import time
from argparse import Namespace

from backend.cli.client import print_json
from backend.cli.device import server_of

LOOK_EVERY_S = 0.5


def download(options: Namespace) -> int:
    """Fetches a log and says what became of it; its progress goes to standard error."""
    server = server_of(options)
    path = f"/devices/{server.device_id(options.unit)}/logs/{options.log}/download"
    seen = server.ask("POST", path)
    while seen["state"] not in ("done", "failed"):
        if not options.json and sys.stderr.isatty():
            print(f"\r{seen['received']} of {seen['length']} bytes", end="", file=sys.stderr)
        time.sleep(LOOK_EVERY_S)
        seen = server.ask("GET", path)
    if options.json:
        print_json(seen)
    elif seen["state"] == "failed":
        print(seen["detail"])
    else:
        became = "is" if seen["duplicate_of"] else "became"
        print(f"Log {options.log} {became} ride {seen['ride_id']}. {seen['detail'] or ''}".rstrip())
    return 0 if seen["state"] == "done" else 1
