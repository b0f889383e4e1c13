"""Goal: a feature's tables are its own: another feature uses its types and its service.

Method: every import of a `records` module in the backend. Start, command and rebuild put
features together; they may know all of them.
"""

import ast
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BACKEND = ROOT / "backend"
ABOVE = {"main", "cli", "rebuild"}


def room(path: Path) -> str:
    """The first folder or file below `backend` that a module lies in."""
    return path.relative_to(BACKEND).with_suffix("").parts[0]


def imported(path: Path) -> set[str]:
    nodes = ast.walk(ast.parse(path.read_text(encoding="utf-8")))
    return {node.module for node in nodes if isinstance(node, ast.ImportFrom) and node.module}


def test_the_records_of_a_feature_are_imported_by_it_alone() -> None:
    uses = {
        (room(path), module.split(".")[1])
        for path in BACKEND.rglob("*.py")
        for module in imported(path)
        if module.startswith("backend.") and module.endswith(".records")
    }

    assert len(uses) > len(ABOVE)
    assert {(by, of) for by, of in uses if by != of and by not in ABOVE} == set()
