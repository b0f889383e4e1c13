"""`spindle device logs`, `spindle device download` and `spindle device erase`"""

from __future__ import annotations

import sys
import time
from argparse import Namespace

from backend.cli.client import print_json, print_table
from backend.cli.device import server_of

LOOK_EVERY_S = 0.5


def list_logs(options: Namespace) -> int:
    """Every ride log of a unit."""
    server = server_of(options)
    answer = server.ask("GET", f"/devices/{server.device_id(options.unit)}/logs")
    if options.json:
        print_json(answer)
        return 0
    rows = [
        [
            log["log_id"],
            log["state"],
            log["started_at"],
            round(log["duration_s"]),
            log["length"],
            "yes" if log["confirmed"] else "no",
        ]
        for log in answer["items"]
    ]
    print_table(rows, ["log", "state", "started", "seconds", "bytes", "fetched"])
    if answer["overwritten"]:
        print(f"{answer['overwritten']} logs were overwritten before anybody fetched them.")
    return 0


def erase(options: Namespace) -> int:
    """Frees a fetched log in the unit's flash."""
    server = server_of(options)
    path = f"/devices/{server.device_id(options.unit)}/logs/{options.log}"
    answer = server.ask("DELETE", path)
    if options.json:
        print_json(answer)
    else:
        blocks = answer["erases"]
        so_far = "" if blocks is None else f"; {blocks} blocks of the unit's flash so far"
        print(f"Log {options.log} is erased{so_far}.")
    return 0


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
