"""Goal: ARCHITECTURE.md shows every room there is and none that is gone. Method: its tables."""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")


def section(title: str) -> str:
    return PAGE.split(f"\n## {title}\n")[1].split("\n## ")[0]


def test_every_room_on_the_map_exists() -> None:
    rooms = re.findall(r"(?m)^\| `([^`]+)` \|", section("Rooms"))

    assert rooms
    assert [room for room in rooms if not (ROOT / room).exists()] == []


def test_every_folder_of_tests_is_on_the_map() -> None:
    folders = {path.parent for path in (ROOT / "tests").rglob("*.*") if path.suffix != ".pyc"}
    kinds = {folder.relative_to(ROOT / "tests").parts[:1] for folder in folders} - {()}

    told = set(re.findall(r"`(\w+)`", section("Tests")))

    missing = sorted({name for (name,) in kinds} - told)
    assert missing == [], f"ARCHITECTURE.md, Tests: what is tests/{', tests/'.join(missing)} for?"
