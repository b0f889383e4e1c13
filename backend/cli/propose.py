"""`spindle propose`: settings for a wish, found on rides."""

from __future__ import annotations

import sys
import time
from argparse import Namespace
from typing import Any

from backend.cli.client import Server, print_json, print_table, text_of
from backend.cli.device import server_of

OBJECTIVES = ("more_range", "gentler_start", "flatter_at_the_limit")
RUNNING = ("waiting", "riding", "proving")
LOOK_S = 0.3


def propose(options: Namespace) -> int:
    """Waits for what is found; Ctrl-C cancels it. 1 if nothing was."""
    server = server_of(options)
    question = {
        "ride_ids": options.rides,
        "objective": options.objective,
        "target_pct": options.target_pct,
        "mass_kg": options.mass_kg,
    }
    if options.knobs is not None:
        question["knobs"] = options.knobs.split(",")
    job = waited_for(server, server.ask("POST", "/proposals", json=question), options.json)
    found = job["candidates"]
    if options.save is not None and found:
        chosen = next(one for one in found if one["recommended"])
        server.ask("POST", "/library", json={**chosen["document"], "name": options.save})
    print_json(job) if options.json else print_job(job)
    return 0 if found else 1


def waited_for(server: Server, job: dict[str, Any], silent: bool) -> dict[str, Any]:
    """The job once it is over; how far it is goes to the error output."""
    path = f"/proposals/{job['id']}"
    try:
        while job["state"] in RUNNING:
            time.sleep(LOOK_S)
            job = server.ask("GET", path)
            if not silent:
                sys.stderr.write(f"\r{job['state']} {job['progress']:.0%}  ")
    except KeyboardInterrupt:
        job = server.ask("DELETE", path)
    if not silent:
        sys.stderr.write("\r")
    return job


def print_job(job: dict[str, Any]) -> None:
    """What was found, and what each of them sets."""
    print(f"{job['state']} after {job['rides_ridden']} rides of the twin, {job['seconds']:.1f} s")
    if job["detail"]:
        print(job["detail"])
    rows = []
    for number, one in enumerate(job["candidates"], start=1):
        battery, duration = one["battery_wh_per_km"], one["duration_s"]
        rows.append(
            [
                f"{number}{' *' if one['recommended'] else ''}",
                f"{one['gained_pct']:+.1f} %",
                f"{battery['before']:.2f} -> {battery['after']:.2f}",
                f"{battery['low']:.2f} to {battery['high']:.2f}",
                f"{duration['before']:.0f} -> {duration['after']:.0f}",
                f"{duration['low']:.0f} to {duration['high']:.0f}",
            ]
        )
    if rows:
        print_table(rows, ["", "gains", "Wh/km", "nine of ten", "time s", "nine of ten"])
    for number, one in enumerate(job["candidates"], start=1):
        for change in one["changed"]:
            print(
                f"{number} {change['name']}: {text_of(change['old'])} -> {text_of(change['new'])}"
            )
