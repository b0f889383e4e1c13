"""Goal: the firmware's rooms know only the rooms below them. Method: read every #include.

The law includes nothing but itself; physics knows no firmware; hal.h is the only way from the
product to the world.
"""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FIRMWARE = ROOT / "sim_device" / "firmware"
STANDARD_HEADERS = {"stddef.h", "stdint.h", "stdbool.h", "limits.h", "float.h", "string.h"}

ROOMS = {
    "control": FIRMWARE / "control",
    "hal": FIRMWARE / "hal",
    "protocol": ROOT / "firmware_protocol" / "c",
    "app": FIRMWARE / "app",
    "host": FIRMWARE / "boards" / "host",
    "mps2_an386": FIRMWARE / "boards" / "mps2_an386",
    "physics": ROOT / "sim_device" / "physics",
    "monocypher": ROOT / "third_party" / "monocypher",
}

# room -> rooms whose headers it may include, itself always.
ALLOWED: dict[str, set[str]] = {
    "control": set(),
    "hal": set(),
    "protocol": set(),
    "physics": set(),
    "monocypher": set(),
    "app": {"control", "hal", "protocol", "monocypher"},
    "host": {"app", "control", "hal", "physics", "protocol"},
    "mps2_an386": {"app", "control", "hal", "host", "protocol"},
}

# Rooms that also run on a microcontroller: no heap, no printing, no libm.
BARE_METAL_ROOMS = ("control", "app", "protocol")


def includes(path: Path) -> list[tuple[str, str]]:
    found = re.findall(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', path.read_text(), flags=re.M)
    return [(mark, name) for mark, name in found]


def files(room: str) -> list[Path]:
    return sorted(ROOMS[room].rglob("*.[ch]"))


@pytest.mark.parametrize("room", sorted(ROOMS))
def test_a_room_includes_only_what_lies_below_it(room: str) -> None:
    owner = {path.name: name for name in ROOMS for path in files(name) if path.suffix == ".h"}

    strangers = [
        f"{path.name} includes {name}"
        for path in files(room)
        for mark, name in includes(path)
        if mark == '"' and owner.get(Path(name).name) not in ALLOWED[room] | {room}
    ]

    assert strangers == []


@pytest.mark.parametrize("room", BARE_METAL_ROOMS)
def test_what_runs_on_a_microcontroller_needs_no_heap_and_no_libm(room: str) -> None:
    foreign = [
        f"{path.name} includes <{name}>"
        for path in files(room)
        for mark, name in includes(path)
        if mark == "<" and name not in STANDARD_HEADERS
    ]
    heap = [
        path.name
        for path in files(room)
        if re.search(r"\b(malloc|calloc|realloc|free|printf)\s*\(", path.read_text())
    ]

    assert foreign == []
    assert heap == []


def test_the_law_keeps_no_state_of_its_own() -> None:
    globals_found = [
        f"{path.name}: {line.strip()}"
        for path in files("control")
        if path.suffix == ".c"
        for line in path.read_text().splitlines()
        if re.match(
            r"^(static\s+)?(?!const|inline|typedef|enum|struct)\w[\w ]*\s+\w+(\[.*\])?\s*(=|;)",
            line,
        )
        and "const" not in line
        and "(" not in line.split("=")[0]
    ]

    assert globals_found == []
