"""Usage: python -m tools.compare_decoders FILE_OR_FOLDER ...

Reads every FIT file found with Spindle and with fitdecode, and tells what differs, cell by cell.
"""

import sys
from collections import Counter
from pathlib import Path

from tools.compare_decoders.cells import Comparison, compare


def main(arguments: list[str]) -> int:
    """1 when a value differs or a cell that fitdecode has is missing."""
    if not arguments:
        print(__doc__)
        return 2
    files = sorted(
        file
        for argument in map(Path, arguments)
        for file in (argument.rglob("*") if argument.is_dir() else [argument])
        if file.suffix.lower() == ".fit"
    )
    total = Counter[str]()
    for file in files:
        told = compare(file.read_bytes())
        report(file, told)
        total["equal"] += told.equal
        total["differ"] += told.differ.total()
        total["only fitdecode"] += told.only_theirs.total()
        total["only Spindle"] += told.only_ours.total()
    print(f"{len(files)} files: " + ", ".join(f"{n:,} {what}" for what, n in total.items()))
    return 1 if total["differ"] or total["only fitdecode"] else 0


def report(file: Path, told: Comparison) -> None:
    """A line for a file, and one for each field that differs."""
    print(f"{file.name}: {told.records} records ({told.records_theirs} by fitdecode), ", end="")
    print(f"{told.equal:,} cells equal")
    for what, found in (
        ("differ", told.differ),
        ("only fitdecode has", told.only_theirs),
        ("only Spindle has", told.only_ours),
    ):
        for name, count in found.most_common():
            example = f", {told.examples[name]}" if what == "differ" else ""
            print(f"    {what}: {name} {count:,}{example}")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
