"""`spindle device try` and `spindle device service`."""

from __future__ import annotations

from argparse import Namespace
from typing import Any

from backend.cli.client import print_json, print_table, text_of
from backend.cli.device import assignment, server_of, unit_and_words
from backend.errors import InvalidRequest


def try_values(options: Namespace) -> int:
    """Tries values in the unit's memory, ends that, or tells what is tried."""
    server = server_of(options)
    unit, words = unit_and_words(server, options.words)
    path = f"/devices/{unit}/live"
    if options.end and words:
        raise InvalidRequest("--end ends what is tried; it takes no values.")
    if options.end:
        answer = server.ask("DELETE", path)
    elif words:
        changes = dict(assignment(word) for word in words)
        body = {"parameters": changes, "ttl_s": options.seconds}
        answer = server.ask("POST", path, json=body)
    else:
        answer = server.ask("GET", path)
    if options.json:
        print_json(answer)
        return 0
    if answer["remaining_s"] is None:
        print("Nothing is tried: the configuration applies.")
        return 0
    print(f"Tried for another {answer['remaining_s']:.0f} s:")
    rows: list[list[Any]] = [[name, value] for name, value in answer["parameters"].items()]
    print_table(rows, ["parameter", "value"])
    return 0


def service(options: Namespace) -> int:
    """What the unit knows of its own wear."""
    server = server_of(options)
    answer = server.ask("GET", f"/devices/{server.device_id(options.unit)}/service")
    if options.json:
        print_json(answer)
        return 0
    for name, value in answer.items():
        if name != "config_slots":
            print(f"  {name:24} {text_of(value)}")
    rows = [
        [slot["state"], slot["generation"], slot["erases"], slot["active"]]
        for slot in answer["config_slots"]
    ]
    print_table(rows, ["slot", "generation", "erases", "active"])
    return 0
