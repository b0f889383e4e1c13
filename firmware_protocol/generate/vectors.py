"""`python -m firmware_protocol.generate.vectors`: writes the golden vectors, all but seed.json.

They are written when the registry grows and then stay: a case that is in a file already is kept as
it stands, so that a changed wire shows as a test that fails. `make gen` never touches them.
"""

import json
import sys
from pathlib import Path
from typing import Any

from firmware_protocol.generate import vector_frames, vector_images, vector_messages
from firmware_protocol.generate.registry import load

FOLDER = Path(__file__).resolve().parents[1]


def files() -> dict[str, str]:
    """The text of every vector file by its name, one case to a line."""
    registry = load(FOLDER / "registry.toml")
    sets: dict[str, list[Any]] = {
        "messages.json": vector_messages.cases(registry),
        "framing.json": vector_frames.framing_cases(),
        "damage.json": vector_frames.damage_cases(int(registry.protocol["mtu"])),
        "verdicts.json": vector_frames.verdict_cases(registry),
        "images.json": vector_images.cases(registry),
    }
    return {name: _text(grown(FOLDER / "vectors" / name, cases)) for name, cases in sets.items()}


def grown(path: Path, cases: list[Any]) -> list[Any]:
    """The cases with those of the file at `path` kept to the byte, in their place."""
    old = json.loads(path.read_text(encoding="utf-8"))["cases"] if path.exists() else []
    names = {case["name"] for case in cases}
    kept = [case for case in old if case["name"] in names]
    known = {case["name"] for case in kept}
    return kept + [case for case in cases if case["name"] not in known]


def _text(cases: list[Any]) -> str:
    return '{"cases": [\n' + ",\n".join(json.dumps(case) for case in cases) + "\n]}\n"


if __name__ == "__main__":
    for name, text in files().items():
        (FOLDER / "vectors" / name).write_text(text, encoding="utf-8", newline="\n")
        sys.stdout.write(f"wrote {name}\n")
