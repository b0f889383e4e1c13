"""What the last release promised the units and files that have it, and whether a registry keeps it.

`released.json` is the registry of that release, without its prose. Whoever has that release reads
and writes what later ones say: an id keeps its meaning, a payload grows at its end, and the image
of the release is the beginning of every later one. What came after it may still change.

`python -m firmware_protocol.generate.released` writes it anew: a step of a release.
"""

import json
import sys
import tomllib
from pathlib import Path
from typing import Any

from firmware_protocol.generate.registry import Registry, load
from firmware_protocol.generate.tables import BadRegistry

FOLDER = Path(__file__).resolve().parents[1]
PROJECT = FOLDER.parent / "pyproject.toml"

PARAMETER_KEEPS = ("name", "type", "unit", "shape", "length", "enum")
CHANNEL_KEEPS = ("name", "unit", "scale")

Raw = dict[str, Any]


def read(path: Path) -> Raw:
    """The release in a `released.json`: its `version`, and the `registry` without prose."""
    found: Raw = json.loads(path.read_text(encoding="utf-8"))
    return found


def text(version: str, schema: str) -> str:
    """What `released.json` holds: one row of the registry's `schema` to a line."""
    parts = []
    for name, rows in json.loads(schema).items():
        if isinstance(rows, list):
            lines = ",\n".join(json.dumps(row) for row in rows)
            parts.append(f"{json.dumps(name)}: [\n{lines}\n]")
        else:
            lines = ",\n".join(f"{json.dumps(key)}: {json.dumps(row)}" for key, row in rows.items())
            parts.append(f"{json.dumps(name)}: {{\n{lines}\n}}")
    return f'{{"version": "{version}", "registry": {{\n' + ",\n".join(parts) + "\n}}\n"


def new_names(released: Raw, registry: Registry) -> frozenset[str]:
    """Parameters, messages and events that came after the release: they may still change."""
    old = released["registry"]
    known = {row["name"] for kind in ("parameter", "message") for row in old[kind]}
    known |= old["event_fields"].keys()
    names = {row.name for row in registry.parameters} | {row.name for row in registry.messages}
    return frozenset(names | {name for name, _ in registry.events}) - known


def check(released: Raw, registry: Registry) -> None:
    """Raises BadRegistry for the first promise of the release that `registry` breaks."""
    version, old = released["version"], released["registry"]
    raw = json.loads(registry.schema)
    _check_parameters(version, old, registry, raw)
    _check_messages(version, old, raw)
    for kind in ("enum", "flags"):
        for name, members in old[kind].items():
            for member, number in members.items():
                if raw[kind].get(name, {}).get(member) != number:
                    raise BadRegistry(
                        f"{kind}.{name}: {member} is {number} since release {version}; numbers stay"
                    )
    channels = {row["id"]: row for row in raw["channel"]}
    for row in old["channel"]:
        _check_same("channel", CHANNEL_KEEPS, row, channels.get(row["id"]), version)


def _check_parameters(version: str, old: Raw, registry: Registry, raw: Raw) -> None:
    now = {row["id"]: row for row in raw["parameter"]}
    known = {row["id"] for row in old["parameter"]}
    greatest = max(known)
    for parameter in registry.parameters:
        if parameter.id not in known and parameter.id <= greatest:
            raise BadRegistry(
                f"{parameter.name}: its id 0x{parameter.id:04X} must be above 0x{greatest:04X}, "
                f"the greatest of release {version}; ids only grow, so that an image of that "
                "release stays the beginning of a later one"
            )
    for row in old["parameter"]:
        _check_same("parameter", PARAMETER_KEEPS, row, now.get(row["id"]), version)


def _check_messages(version: str, old: Raw, raw: Raw) -> None:
    now = {row["id"]: row for row in raw["message"]}
    for row in old["message"]:
        found = now.get(row["id"])
        _check_same("message", ("name",), row, found, version)
        assert found is not None
        for side in ("request", "response"):
            _check_grown(f"{row['name']} {side}", row[side], found[side], version)
    for name, fields in old["event_fields"].items():
        _check_grown(f"event {name}", fields, raw["event_fields"].get(name, []), version)


def _check_grown(what: str, old: list[Any], now: list[Any], version: str) -> None:
    if now[: len(old)] != old:
        raise BadRegistry(
            f"{what}: its fields of release {version} must stay; new ones follow at the end"
        )


def _check_same(kind: str, keys: tuple[str, ...], old: Raw, now: Raw | None, version: str) -> None:
    name = f"{kind} {old['name']} (0x{old['id']:04X})"
    if now is None:
        raise BadRegistry(f"{name} is in release {version} and must stay; a parameter may retire")
    for key in keys:
        if old.get(key) != now.get(key):
            raise BadRegistry(
                f"{name}: its {key} was {old.get(key)!r} in release {version} and stays; a changed "
                "meaning is a new id"
            )


def main() -> int:
    """Writes `released.json` from the registry and the version in pyproject.toml."""
    version = tomllib.loads(PROJECT.read_text(encoding="utf-8"))["project"]["version"]
    registry = load(FOLDER / "registry.toml")
    target = FOLDER / "released.json"
    target.write_text(text(version, registry.schema), encoding="utf-8", newline="\n")
    sys.stdout.write(f"wrote {target.name} of release {version}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
