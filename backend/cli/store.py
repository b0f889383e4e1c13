"""`spindle store ...`: asks no server, since a store that needs this has none."""

from __future__ import annotations

from argparse import Namespace
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

from backend.cli.client import print_json, text_of

# So many of a list are shown to people; `--json` shows all.
SHOWN_MAX = 20


def places(options: Namespace) -> tuple[str, str, Path]:
    """Database, objects and their copies as the server would find them."""
    from backend.settings import load

    settings = load({"data": options.data})
    return settings.db, settings.objects, settings.cache


def as_command() -> AbstractContextManager[None]:
    """What is done in here a command did, in the name of the system's user."""
    from backend.core.actor import Actor, acting
    from backend.settings import system_user

    return acting(Actor("command", system_user()))


def check(options: Namespace) -> int:
    """Says what is in database and folder; 1 if anything is wrong."""
    from backend.store.upkeep.check import check_store

    result = check_store(*places(options))
    if options.json:
        print_json(result.as_json())
    else:
        print_check(result.as_json())
    return 0 if result.is_fine else 1


def print_check(result: dict[str, Any]) -> None:
    """The check as a person reads it."""
    database, folder, objects = result["database"], result["folder"], result["objects"]
    lines = {
        "database": database["url"],
        "database state": database["state"],
        "database of store": database["identity"],
        "rides in it": database["rides"],
        "folder": folder["path"],
        "folder of store": folder["identity"],
        "sound objects": objects["sound"],
        "bytes": objects["bytes"],
    }
    for name, value in lines.items():
        print(f"{name:20} {text_of(value)}")
    for ride in database["live"]:
        print(f"ride {ride['ride_id']}: {ride['state']}, {ride['row_count']} rows so far")
    for ride_id in database["rides_damaged"]:
        print(f"Ride {ride_id}: its row in the database is damaged; a server mends it.")
    print_keys("missing", objects["missing"])
    print_keys("damaged", [f"{each['key']}: {each['reason']}" for each in objects["damaged"]])
    print_keys("not known to the database", objects["unknown"])
    print_keys("in lost+found", objects["lost_found"])
    if result["reason"]:
        print(f"Database and folder are not one store: {result['reason']}.")
        print("`spindle store rebuild` brings every ride of the folder into an empty database.")
    elif result["ok"]:
        print("Everything is there.")


def print_keys(words: str, keys: list[str]) -> None:
    """A list of files, the first of them named."""
    if keys:
        print(f"{words}: {len(keys)}")
    for key in keys[:SHOWN_MAX]:
        print(f"  {key}")
    if len(keys) > SHOWN_MAX:
        print(f"  ... {len(keys) - SHOWN_MAX} more")


def rebuild(options: Namespace) -> int:
    """Brings every ride of the folder into an empty database; 1 if files were not taken."""
    from backend.rebuild import rebuild_store, report_lines

    with as_command():
        report = rebuild_store(*places(options))
    if options.json:
        print_json(report.as_json())
    else:
        for line in report_lines(report):
            print(line)
    return 1 if report.not_taken else 0
