"""Goal: ARCHITECTURE.md shows every room there is and none that is gone, and stays one page;
CONTRIBUTING.md names every kind of test. Method: their tables."""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
TESTS = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8").split("\n## Tests\n")[1]
LINES_MAX = 80


def rooms() -> set[str]:
    """The paths that the table's first column names; `a/b`, `c` stands for a/b and a/c."""
    named = set()
    for cell in re.findall(r"(?m)^\| (`[^|]+`) \|", PAGE):
        first, *others = re.findall(r"`([^`]+)`", cell)
        siblings = (str(Path(first).parent / other) for other in others if "/" not in other)
        named |= {first, *siblings, *(other for other in others if "/" in other)}
    return named


def test_every_room_on_the_map_exists() -> None:
    assert sorted(room for room in rooms() if not (ROOT / room).exists()) == []


def test_every_room_of_the_backend_is_on_the_map() -> None:
    packages = {f"backend/{path.parent.name}" for path in (ROOT / "backend").glob("*/__init__.py")}

    assert packages - rooms() == set()


def test_the_map_is_one_page() -> None:
    assert len(PAGE.splitlines()) <= LINES_MAX


def test_every_kind_of_test_is_described() -> None:
    folders = {path.parent for path in (ROOT / "tests").rglob("*.*") if path.suffix != ".pyc"}
    kinds = {folder.relative_to(ROOT / "tests").parts[:1] for folder in folders} - {()}
    described = set(re.findall(r"`(\w+)`", TESTS.split("\n## ")[0]))

    missing = sorted({name for (name,) in kinds} - described)
    assert missing == [], f"CONTRIBUTING.md, Tests: what is tests/{', tests/'.join(missing)} for?"
