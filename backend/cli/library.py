"""`spindle library ...`: tables and configurations by name, with or without a unit."""

from __future__ import annotations

import sys
from argparse import Namespace
from pathlib import Path
from typing import Any

from backend.cli.client import Server, print_json, print_table, text_of
from backend.cli.device import read_json, server_of
from backend.errors import InvalidRequest, RequestRefused

FELT = ("start_s", "rise_nm_per_s", "ripple_pct", "lag_ms", "toggles_hz", "market", "seconds")


def list_entries(options: Namespace) -> int:
    """What comes with Spindle, and what is kept here."""
    answer = server_of(options).ask("GET", "/library", params={"deleted": options.deleted})
    if options.json:
        print_json(answer)
        return 0
    keys = ("id", "name", "kind", "version", "changed_at", "author", "comment")
    rows = [[row[key] for key in keys] for row in answer["items"]]
    print_table(rows, ["id", "name", "kind", "version", "changed", "author", "what it is"])
    return 0


def show(options: Namespace) -> int:
    """An entry: its rules, or its parameters."""
    server = server_of(options)
    path, request = path_of(server, options.entry)
    entry = server.ask("GET", path, **request)
    if options.json:
        print_json(entry)
        return 0
    print(f"{entry['name']}  {entry['format']}")
    if entry["comment"]:
        print(f"  {entry['comment']}")
    rows = [
        [name, parameter["value"], parameter["unit"]]
        for name, parameter in entry["parameters"].items()
    ]
    print_table(rows, ["parameter", "value", "unit"])
    return 0


def add(options: Namespace) -> int:
    """Keeps a file's document, or what a unit has now."""
    server = server_of(options)
    if (options.file is None) == (options.unit is None):
        raise InvalidRequest("Name a file, or a unit with --unit.")
    document = read_json(options.file) if options.file else of_unit(server, options.unit)
    if not isinstance(document, dict):
        raise InvalidRequest(f"{options.file} is no document: it is no JSON object.")
    return keep(server, document, options)


def import_fis(options: Namespace) -> int:
    """Keeps the table of a `.fis` file, and says how far the unit is from it."""
    server = server_of(options)
    question = {"text": text_in(options.file), "name": options.name or ""}
    answer = server.ask("POST", "/library/fis", json=question)
    if not options.json:
        far = answer["deviation"]
        print(
            f"The unit differs from the file by at most {far['gain']:.4f}: it gains "
            f"{far['gain_of_unit']:.4f} for {far['gain_of_file']:.4f} "
            f"at {far['speed_kmh']:g} km/h and a torque rate of {far['torque_rate']:g}."
        )
    return keep(server, answer["document"], options)


def remove(options: Namespace) -> int:
    """Takes an own item out of the library; its versions stay."""
    server = server_of(options)
    row = row_of(server, options.entry)
    gone = server.ask("DELETE", f"/library/{row['id']}", headers={"if-match": row["etag"]})
    print_json(gone) if options.json else print(f"{gone['id']}: `library add --replace` undoes it.")
    return 0


def export(options: Namespace) -> int:
    """An entry as a file."""
    server = server_of(options)
    path, request = path_of(server, options.entry, "/export")
    request["params"] |= {"format": options.format, "table": options.table}
    content = server.response("GET", path, **request).content
    if options.output is None:
        sys.stdout.buffer.write(content)
        return 0
    options.output.write_bytes(content)
    if options.json:
        print_json({"file": str(options.output), "bytes": len(content)})
    return 0


def compare(options: Namespace) -> int:
    """Two of them side by side."""
    server = server_of(options)
    question = {
        "left": side(server, options.left) | {"table": options.table},
        "right": side(server, options.right) | {"table": options.table},
        "feel": options.feel,
    }
    answer = server.ask("POST", "/library/compare", json=question)
    if options.json:
        print_json(answer)
        return 0
    changed = answer["parameters"]
    print_table(
        [[each["name"], each["old"], each["new"]] for each in changed], ["", *names(answer)]
    )
    tables = answer["tables"]
    if tables is not None:
        far = tables["largest"]
        print(
            f"{len(tables['cells'])} rules differ. The gain differs by at most {far['gain']:+.4f}, "
            f"from {far['left']:.4f} to {far['right']:.4f}, at {far['speed_kmh']:g} km/h and a "
            f"torque rate of {far['torque_rate']:g}."
        )
    if options.feel:
        for end in ("left", "right"):
            if answer[end]["not_felt"]:
                print(f"{answer[end]['name']}: {answer[end]['not_felt']}")
        felt = [answer[end]["feel"] or {} for end in ("left", "right")]
        print_table(
            [[key, *(each.get(key) for each in felt)] for key in FELT], ["", *names(answer)]
        )
    return 0


def names(answer: dict[str, Any]) -> list[str]:
    """What the two are called."""
    return [text_of(answer[end]["name"]) for end in ("left", "right")]


def keep(server: Server, document: dict[str, Any], options: Namespace) -> int:
    """A document as a new item, or in place of the one named."""
    words = {"name": options.name, "comment": options.comment}
    document = document | {key: word for key, word in words.items() if word is not None}
    if options.replace is None:
        row = server.ask("POST", "/library", json=document)
    else:
        old = row_of(server, options.replace)
        headers = {"if-match": old["etag"]}
        row = server.ask("PUT", f"/library/{old['id']}", json=document, headers=headers)
    print_json(row) if options.json else print(row["id"])
    return 0


def of_unit(server: Server, unit: str) -> dict[str, Any]:
    """What a unit has now, as a document. unit: empty for the only one."""
    from backend.formats.backup import backup_json

    path = f"/devices/{server.device_id(unit or None)}"
    items = server.ask("GET", f"{path}/parameters")["items"]
    units = {item["name"]: item["unit"] for item in items}
    return backup_json(server.ask("GET", path), server.ask("GET", f"{path}/config"), units)


def row_of(server: Server, word: str) -> dict[str, Any]:
    """The entry of this id, else the one of this name. Raises RequestRefused."""
    rows = server.ask("GET", "/library", params={"deleted": True})["items"]
    found = [row for row in rows if row["id"] == word]
    found = found or [row for row in rows if row["name"] == word and not row["deleted"]]
    if not found:
        raise RequestRefused(f"The library has no {word!r}; `spindle library list` shows what is.")
    return dict(found[0])


def split(word: str) -> tuple[str, int | None]:
    """`NAME@N`: the name, and which version or revision of it; a name may hold an @ as well."""
    name, at, number = word.rpartition("@")
    return (name, int(number)) if at and number.isdecimal() else (word, None)


def path_of(server: Server, word: str, part: str = "") -> tuple[str, dict[str, Any]]:
    """Where an entry is asked for, and with what."""
    name, version = split(word)
    params = {} if version is None else {"version": version}
    return f"/library/{row_of(server, name)['id']}{part}", {"params": params}


def side(server: Server, word: str) -> dict[str, Any]:
    """A word of `compare`: an entry, or `unit` or a unit's name; @N for an earlier one."""
    name, number = split(word)
    try:
        found = {"library": row_of(server, name)["id"]}
        return found if number is None else found | {"version": number}
    except RequestRefused:
        unit = server.device_id(None if name == "unit" else name)
        return {"device": unit} if number is None else {"device": unit, "revision": number}


def text_in(file: Path) -> str:
    """A text file. Raises InvalidRequest with the reason if it cannot be read."""
    try:
        return file.read_bytes().decode("utf-8-sig", errors="replace")
    except OSError as error:
        raise InvalidRequest(f"{file} cannot be read: {error.strerror}.") from None
