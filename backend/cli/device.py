"""`spindle device ...`"""

from __future__ import annotations

import json
import os
from argparse import Namespace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from backend.cli.client import (
    Server,
    default_ca,
    default_key,
    default_server,
    print_json,
    print_table,
    text_of,
)
from backend.core.author import tidy_author
from backend.errors import InvalidRequest, RequestRefused

if TYPE_CHECKING:
    from backend.formats.backup import Backup


def server_of(options: Namespace) -> Server:
    """The server the command line names."""
    author = tidy_author(options.author or os.environ.get("SPINDLE_AUTHOR") or "")
    key = options.key or default_key()
    ca = options.ca or default_ca()
    return Server(options.server or default_server(), author=author, key=key, ca=ca)


def list_devices(options: Namespace) -> int:
    """Every unit and its state."""
    answer = server_of(options).ask("GET", "/devices")
    if options.json:
        print_json(answer)
        return 0
    rows = [
        [device["id"], device["kind"], device["state"], device["url"], device["reason"]]
        for device in answer["items"]
    ]
    print_table(rows, ["unit", "kind", "state", "url", "why"])
    return 0


def add(options: Namespace) -> int:
    """Opens a unit."""
    body = {"url": options.url, "name": options.name}
    device = server_of(options).ask("POST", "/devices", json=body)
    print_json(device) if options.json else print(device["id"])
    return 0


def remove(options: Namespace) -> int:
    """Lets a unit go."""
    server = server_of(options)
    server.ask("DELETE", f"/devices/{server.device_id(options.unit)}")
    return 0


def show(options: Namespace) -> int:
    """Identity, link and newest values of a unit."""
    server = server_of(options)
    path = f"/devices/{server.device_id(options.unit)}"
    device = server.ask("GET", path)
    if device["state"] in ("ready", "read_only"):
        device["snapshot"] = server.ask("GET", f"{path}/snapshot")
    if options.json:
        print_json(device)
        return 0
    print(f"{device['id']}  {device['state']}: {device['reason']}")
    for part in ("identity", "config"):
        for name, value in (device[part] or {}).items():
            print(f"  {name:24} {text_of(value)}")
    for name, value in device.get("snapshot", {}).get("channels", {}).items():
        print(f"  {name:24} {text_of(value)}")
    return 0


def get(options: Namespace) -> int:
    """Parameters of a unit, all or the named ones."""
    server = server_of(options)
    unit, names = unit_and_words(server, options.words)
    config = server.ask("GET", f"/devices/{unit}/config", params={"bank": options.bank})
    parameters = config["parameters"]
    if unknown := [name for name in names if name not in parameters]:
        raise RequestRefused(f"The unit has no parameter {', '.join(unknown)}.")
    values = {name: parameters[name] for name in names or parameters}
    if options.json:
        print_json({**config, "parameters": values})
    else:
        print_table([[name, value] for name, value in values.items()], ["parameter", "value"])
    return 0


def set_parameters(options: Namespace) -> int:
    """Changes the named parameters, all of them or none."""
    server = server_of(options)
    unit, words = unit_and_words(server, options.words)
    changes = dict(assignment(word) for word in words)
    return write(server, unit, changes, options)


def backup(options: Namespace) -> int:
    """A configuration of a unit as a JSON file that `restore` and `diff` read."""
    from backend.formats.backup import backup_json

    server = server_of(options)
    unit = server.device_id(options.unit)
    device = server.ask("GET", f"/devices/{unit}")
    config = server.ask("GET", f"/devices/{unit}/config", params={"bank": options.bank})
    items = server.ask("GET", f"/devices/{unit}/parameters")["items"]
    saved = backup_json(device, config, {item["name"]: item["unit"] for item in items})
    if options.output is None:
        print_json(saved)
        return 0
    options.output.write_text(json.dumps(saved, indent=2, ensure_ascii=False) + "\n")
    if options.json:
        print_json({"file": str(options.output)})
    return 0


def restore(options: Namespace) -> int:
    """Writes the values of a backup that differ from the unit's and that we may change.

    All of them into the unit it was made of. Into another one the set-up alone: the calibration of
    the sensor, its certificate and the wheel stay with the unit they were measured on.
    """
    server = server_of(options)
    unit = server.device_id(options.unit)
    backup = backup_at(options.file)
    items = server.ask("GET", f"/devices/{unit}/parameters")["items"]
    device = server.ask("GET", f"/devices/{unit}")
    require_same_kind(backup, options.file.name, device["family"], items)
    saved = backup.parameters
    if not options.json:
        notes = unknown_here(saved, items)
        for note in [*notes, *second_table_moves(backup, items)]:
            print(note)
    differing = [p for p in items if p["name"] in saved and saved[p["name"]] != p["value"]]
    is_same = backup.unit_key is not None and backup.unit_key == device["unit_key"]
    factory = [p["name"] for p in differing if p["access"] == "factory"]
    stays = [
        p["name"]
        for p in differing
        if p.get("of_the_unit") and not is_same and p["name"] not in factory
    ]
    left_out = {*factory, *stays}
    changes = {p["name"]: saved[p["name"]] for p in differing if p["name"] not in left_out}
    if not options.json:
        print_left_out(factory, stays, backup.unit_key)
    if not changes:
        done: dict[str, Any] = {"changed": [], "left_out": sorted(left_out)}
        print_json(done) if options.json else print("Nothing to restore.")
        return 0
    options.reason = options.reason or f"restored from {options.file.name}"
    read_from = {"read_from": backup.unit_key} if backup.unit_key else {}
    return write(server, unit, changes, options, read_from, {"left_out": sorted(left_out)})


def print_left_out(factory: list[str], stays: list[str], made_of: str | None) -> None:
    """Says which values of a backup the unit does not get, and why."""
    if factory:
        print(f"Left as they are, because only the factory may change them: {', '.join(factory)}.")
    if stays:
        other = f"it is of {made_of}" if made_of else "it does not say which unit it is of"
        print(
            f"Left as they are, because they stay with the unit they were measured on, and the "
            f"file is not this unit's own ({other}): {', '.join(stays)}."
        )


def diff(options: Namespace) -> int:
    """What differs between a backup and the unit, or between two backups; of a table the table.

    Of values of two units, which of them stay with the unit they were measured on.
    """
    from backend.formats.backup import of_the_unit, read_backup

    one = backup_at(options.file)
    if options.other is not None and Path(options.other).is_file():
        other = backup_at(Path(options.other))
    else:
        server = server_of(options)
        unit = server.device_id(options.other)
        # A server of before may tell choices in the words of then.
        other = read_backup(server.ask("GET", f"/devices/{unit}/config"), unit)
    tables = [backup for backup in (one, other) if backup.is_table] or [one, other]
    old, new = one.parameters, other.parameters
    names = dict.fromkeys(name for backup in tables for name in backup.parameters)
    differing = [name for name in names if old.get(name) != new.get(name)]
    changed = [{"name": name, "old": old.get(name), "new": new.get(name)} for name in differing]
    same = one.unit_key is not None and one.unit_key == other.unit_key
    stays = [] if same else of_the_unit(differing)
    print_changes({"changed": changed, "stays_with_unit": stays}, options)
    if stays and not options.json:
        print(f"Of these stay with the unit they were measured on: {', '.join(stays)}.")
    return 0


def list_presets(options: Namespace) -> int:
    """The configurations and tables that come with Spindle; `restore` takes their names."""
    from backend.law import presets

    documents = [presets.load(name) for name in presets.names()]
    if options.json:
        items = [{"name": one.name, "kind": one.kind, "comment": one.comment} for one in documents]
        print_json({"items": items})
        return 0
    rows = [[one.name, one.kind, one.comment] for one in documents]
    print_table(rows, ["preset", "kind", "what it is"])
    return 0


def backup_at(file: Path) -> Backup:
    """A backup's file, or the preset of that name where there is no such file."""
    from backend.formats.backup import backup_of, read_backup
    from backend.law import presets

    if not file.exists() and str(file) in presets.names():
        return backup_of(presets.load(str(file)))
    return read_backup(read_json(file), file.name)


def require_same_kind(backup: Backup, name: str, family: str, items: list[dict[str, Any]]) -> None:
    """Raises InvalidRequest for a backup of another make, or in other units than this unit's."""
    if backup.family not in (None, family):
        raise InvalidRequest(
            f"{name} is for a unit of the family {backup.family}; this one is {family}."
        )
    for item in items:
        unit = backup.units.get(item["name"], item["unit"])
        if unit != item["unit"]:
            raise InvalidRequest(
                f"{name} has {item['name']} in {unit!r}; this unit has it in {item['unit']!r}."
            )


def unknown_here(saved: dict[str, Any], items: list[dict[str, Any]]) -> list[str]:
    """Says which values of a backup this unit has no parameter for."""
    names = {item["name"] for item in items}
    unknown = [name for name in saved if name not in names]
    return [f"This unit does not have {', '.join(unknown)}."] if unknown else []


def second_table_moves(backup: Backup, items: list[dict[str, Any]]) -> list[str]:
    """Says that a table's points are the second one's too, if a mode uses that and they change."""
    from backend.core.fuzzy_table import PARAMETER_NAMES, SHARED_FIELDS

    now = {item["name"]: item["value"] for item in items}
    shared = [PARAMETER_NAMES[field] for field in SHARED_FIELDS]
    changes = any(backup.parameters.get(name) != now.get(name) for name in shared)
    if not (backup.is_table and changes and any(now.get("mode_tables") or ())):
        return []
    return [
        "The second table, which a mode uses, shares its points with the first and changes too."
    ]


def write(
    server: Server,
    unit: str,
    changes: dict[str, Any],
    options: Namespace,
    more_request: dict[str, Any] | None = None,
    more_output: dict[str, Any] | None = None,
) -> int:
    """One transaction, made for the configuration as it is now.

    more_request: more of the request. more_output: more of what is printed as JSON.
    """
    path = f"/devices/{unit}/config"
    etag = server.response("GET", path).headers["etag"]
    body = {"parameters": changes, "reason": options.reason, **(more_request or {})}
    if options.token is not None:
        body["token"] = options.token
    answer = server.ask("PATCH", path, json=body, headers={"if-match": etag})
    print_changes({**answer, **(more_output or {})}, options)
    return 0


def print_changes(answer: dict[str, Any], options: Namespace) -> None:
    """Old and new value of everything that changed."""
    if options.json:
        print_json(answer)
        return
    rows = [[change["name"], change["old"], change["new"]] for change in answer["changed"]]
    print_table(rows, ["parameter", "old", "new"])


def unit_and_words(server: Server, words: list[str]) -> tuple[str, list[str]]:
    """The unit's id, and the words without it: the first word may name the unit."""
    if words and "=" not in words[0]:
        try:
            return server.device_id(words[0]), words[1:]
        except RequestRefused:
            pass
    return server.device_id(None), words


def assignment(word: str) -> tuple[str, Any]:
    """`name=value`; the value is JSON, or else a text as it stands."""
    name, equals, text = word.partition("=")
    if not equals or not name:
        raise InvalidRequest(f"{word!r}: write NAME=VALUE.")
    return name, value_of(text)


def value_of(text: str) -> Any:
    """JSON where it is some, else the text as it stands."""
    try:
        return json.loads(text)
    except ValueError:
        return text


def read_json(file: Path) -> Any:
    """A JSON file, with a byte order mark or without. Raises InvalidRequest with the reason."""
    try:
        return json.loads(read_bytes(file).decode("utf-8-sig"))
    except UnicodeDecodeError as error:
        raise InvalidRequest(f"{file} is not UTF-8 text, at byte {error.start}.") from None
    except ValueError as error:
        raise InvalidRequest(f"{file} is not JSON: {error}.") from None


def read_bytes(file: Path) -> bytes:
    """A file's bytes. Raises InvalidRequest where it cannot be read."""
    try:
        return file.read_bytes()
    except OSError as error:
        raise InvalidRequest(f"{file} cannot be read: {error.strerror}.") from None
