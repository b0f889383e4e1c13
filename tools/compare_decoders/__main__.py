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
        compared = compare(file.read_bytes())
        report(file, compared)
        total["equal"] += compared.equal
        total["differ"] += compared.differ.total()
        total["only fitdecode"] += compared.only_theirs.total()
        total["only Spindle"] += compared.only_ours.total()
    print(f"{len(files)} files: " + ", ".join(f"{n:,} {what}" for what, n in total.items()))
    return 1 if total["differ"] or total["only fitdecode"] else 0


def report(file: Path, compared: Comparison) -> None:
    """A line for a file, and one for each field that differs."""
    print(
        f"{file.name}: {compared.records} records ({compared.records_theirs} by fitdecode), ",
        end="",
    )
    print(f"{compared.equal:,} cells equal")
    for what, found in (
        ("differ", compared.differ),
        ("only fitdecode has", compared.only_theirs),
        ("only Spindle has", compared.only_ours),
    ):
        for name, count in found.most_common():
            example = f", {compared.examples[name]}" if what == "differ" else ""
            print(f"    {what}: {name} {count:,}{example}")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
