"""The library: tables and configurations under a name, to look at and to put into a unit.

What comes with Spindle is in it, read only.
"""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from typing import Any, Literal

from backend.control import presets
from backend.errors import NotFound


@dataclass(frozen=True, slots=True)
class LibraryRow:
    """One entry without its values. id: what it is asked for by. family: of the unit it is for.

    kind: `table` or `configuration`. source: who put it there.
    """

    id: str
    name: str
    kind: str
    comment: str
    family: str
    source: Literal["preset"] = "preset"


def library_rows() -> list[LibraryRow]:
    """Every entry, by name."""
    found = [(name, presets.load(name)) for name in presets.names()]
    return [LibraryRow(name, one.name, one.kind, one.comment, one.family) for name, one in found]


def library_entry(entry_id: str) -> dict[str, Any]:
    """The entry as a file that `spindle device restore` takes. Raises NotFound."""
    if entry_id not in presets.names():
        raise NotFound(f"The library has no {entry_id!r}. GET /library lists what it has.")
    return presets.load(entry_id).to_json()


def library_etag(entry: dict[str, Any]) -> str:
    """Names what an entry holds: it changes with the content and with nothing else."""
    content = json.dumps(entry, sort_keys=True, separators=(",", ":"))
    return f'"{hashlib.sha256(content.encode()).hexdigest()[:16]}"'
