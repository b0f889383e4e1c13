"""`python -m firmware_protocol.generate [--check]`: writes every generated file, or compares."""

import argparse
import sys
from pathlib import Path

from firmware_protocol.generate import (
    c_header,
    c_source,
    python,
    released,
    spec,
    typescript,
    vectors,
    wireshark,
)
from firmware_protocol.generate.registry import load
from firmware_protocol.generate.schema import compress, schema_hash
from firmware_protocol.generate.tables import BadRegistry

ROOT = Path(__file__).resolve().parents[2]


def outputs(root: Path) -> dict[Path, str]:
    """Every generated file under `root` with the text it must have. Raises BadRegistry."""
    folder = root / "firmware_protocol"
    registry = load(folder / "registry.toml")
    release = released.read(folder / "released.json")
    released.check(release, registry)
    schema_file = folder / "c" / "ebl_schema.c"
    committed = schema_file.read_text(encoding="utf-8") if schema_file.exists() else ""
    compressed = compress(registry.schema, committed)
    digest = schema_hash(registry.schema)
    spec_file = folder / "SPEC.md"
    logic = (folder / "generate" / "dissector.lua").read_text(encoding="utf-8")
    return {
        folder / "c" / "ebl_registry.h": c_header.header(registry, len(compressed)),
        folder / "c" / "ebl_registry.c": c_source.registry_source(registry),
        folder / "c" / "ebl_messages.c": c_source.messages_source(registry),
        schema_file: c_source.schema_source(compressed, digest),
        folder / "_generated.py": python.module(registry, digest),
        root / "backend/core/_generated.py": python.domain_module(registry),
        root / "frontend/src/generated/registry.ts": typescript.module(registry),
        folder / "wireshark" / "ebl.lua": wireshark.dissector(registry, logic),
        spec_file: spec.filled(spec_file.read_text(encoding="utf-8"), registry),
        **vectors.files(registry, folder / "vectors", released.new_names(release, registry)),
    }


def stale(root: Path) -> list[Path]:
    """The generated files under `root` that are missing or differ from the registry."""
    return [path for path, text in outputs(root).items() if _differs(path, text)]


def _differs(path: Path, text: str) -> bool:
    return not path.exists() or path.read_text(encoding="utf-8") != text


def main(arguments: list[str]) -> int:
    """Writes the files that changed; with --check only names them and returns 1."""
    parser = argparse.ArgumentParser(prog="firmware_protocol.generate", description=__doc__)
    parser.add_argument("--check", action="store_true", help="write nothing, fail on a difference")
    check = parser.parse_args(arguments).check
    try:
        texts = outputs(ROOT)
    except BadRegistry as refused:
        sys.stderr.write(f"firmware_protocol/registry.toml: {refused}\n")
        return 1
    changed = [path for path, text in texts.items() if _differs(path, text)]
    for path in changed:
        sys.stdout.write(f"{'stale' if check else 'wrote'} {path.relative_to(ROOT)}\n")
        if not check:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(texts[path], encoding="utf-8", newline="\n")
    return 1 if check and changed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
