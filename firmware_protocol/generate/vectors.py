"""The golden vectors, all but seed.json, which was written by hand.

A case of something that was released stays as it stands in its file, so that a changed wire shows
as a test that fails. What came after the release follows the registry.
"""

import json
import re
from pathlib import Path
from typing import Any

from firmware_protocol.generate import vector_frames, vector_images, vector_messages
from firmware_protocol.generate.registry import Registry

Cases = list[dict[str, Any]]


def files(registry: Registry, folder: Path, new_names: frozenset[str]) -> dict[Path, str]:
    """The text of every vector file in `folder`, one case to a line.

    new_names: parameters, messages and events that are in no release.
    """
    sets: dict[str, Cases] = {
        "messages.json": vector_messages.cases(registry),
        "framing.json": vector_frames.framing_cases(),
        "damage.json": vector_frames.damage_cases(int(registry.protocol["mtu"])),
        "verdicts.json": vector_frames.verdict_cases(registry),
        "images.json": vector_images.cases(registry),
    }
    return {
        folder / name: _text(grown(_written(folder / name), cases, new_names))
        for name, cases in sets.items()
    }


def grown(written: Cases, cases: Cases, new_names: frozenset[str]) -> Cases:
    """The written cases in their order, those of `new_names` as in `cases`, then the rest."""
    wanted = {case["name"]: case for case in cases}
    kept = [
        wanted[case["name"]] if new_names.intersection(re.findall(r"\w+", case["name"])) else case
        for case in written
        if case["name"] in wanted
    ]
    known = {case["name"] for case in kept}
    return kept + [case for case in cases if case["name"] not in known]


def _written(path: Path) -> Cases:
    if not path.exists():
        return []
    found: Cases = json.loads(path.read_text(encoding="utf-8"))["cases"]
    return found


def _text(cases: Cases) -> str:
    return '{"cases": [\n' + ",\n".join(json.dumps(case) for case in cases) + "\n]}\n"
