"""Goal: the firmware's rooms know only the rooms below them. Method: read every #include.

The law includes nothing but itself; physics knows no firmware; hal.h is the only way from the
product to the world. The product's inner rooms have an order too, and no room has a circle.
"""

import re
from collections import Counter
from collections.abc import Iterable, Mapping
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FIRMWARE = ROOT / "sim_device" / "firmware"
APP = FIRMWARE / "app"
STANDARD_HEADERS = {"stddef.h", "stdint.h", "stdbool.h", "limits.h", "float.h", "string.h"}

ROOMS = {
    "control": FIRMWARE / "control",
    "hal": FIRMWARE / "hal",
    "protocol": ROOT / "firmware_protocol" / "c",
    "app": APP,
    "host": FIRMWARE / "boards" / "host",
    "mps2_an386": FIRMWARE / "boards" / "mps2_an386",
    "physics": ROOT / "sim_device" / "physics",
    "twin": ROOT / "sim_device" / "twin",
    "monocypher": ROOT / "third_party" / "monocypher",
}

# room -> rooms whose headers it may include, itself always.
ALLOWED: dict[str, set[str]] = {
    "control": set(),
    "hal": set(),
    "protocol": set(),
    "physics": set(),
    "twin": {"control"},
    "monocypher": set(),
    "app": {"control", "hal", "protocol", "monocypher"},
    "host": {"app", "control", "hal", "physics", "protocol"},
    "mps2_an386": {"app", "control", "hal", "host", "protocol"},
}

# The same of the product's inner rooms, the lowest first; "" is app.h and app.c alone on top.
INNER_ALLOWED: dict[str, set[str]] = {
    "storage": set(),
    "faults": set(),
    "line": {"storage"},
    "ride_log": {"line", "storage"},
    "config": {"faults", "line", "storage"},
    "private": {"config", "faults", "line", "ride_log", "storage"},
    "requests": {"config", "faults", "line", "private", "ride_log", "storage"},
    "": {"private", "requests"},
}

# What a board sees of the product: what it calls, and what it measures and keeps time with.
BOARDS_SEE = {"", "faults"}

# Programs that are no unit: one counts a signature's instructions, one is the law alone.
NO_BOARD = {("main_count.c", "signature.h"), ("main_law.c", "config_law.h")}

# Rooms that also run on a microcontroller: no heap, no printing, no libm.
BARE_METAL_ROOMS = ("control", "app", "protocol")


def includes(text: str) -> list[tuple[str, str]]:
    return re.findall(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', text, flags=re.M)


def files(room: str) -> list[Path]:
    return sorted(ROOMS[room].rglob("*.[ch]"))


def found(path: Path, name: str) -> Path | None:
    """The header that a file includes by this name, as a compiler looks for it."""
    places = (path.parent, *ROOMS.values())
    return next((place / name for place in places if (place / name).is_file()), None)


def room_of(header: Path | None) -> str | None:
    return next((name for name, at in ROOMS.items() if header and header.is_relative_to(at)), None)


def inner_room(path: Path) -> str:
    """The product's inner room; empty for what lies on top."""
    return path.relative_to(APP).parent.as_posix().removeprefix(".")


def included(path: Path) -> Iterable[tuple[str, Path | None]]:
    for mark, name in includes(path.read_text()):
        if mark == '"':
            yield name, found(path, name)


def circles(room: Path) -> list[set[str]]:
    """Modules of a folder (a header with its source) that include each other in the end."""
    paths = sorted(room.rglob("*.[ch]"))
    below: dict[str, set[str]] = {}
    for path in paths:
        reached = below.setdefault(module(room, path), set())
        for _, name in includes(path.read_text()):
            header = next((at / name for at in (path.parent, room) if (at / name).is_file()), None)
            if header is not None:
                reached.add(module(room, header))
        reached.discard(module(room, path))
    return knots(below)


def module(room: Path, path: Path) -> str:
    return path.resolve().relative_to(room.resolve()).with_suffix("").as_posix()


def knots(below: Mapping[str, set[str]]) -> list[set[str]]:
    reach = {name: set(direct) for name, direct in below.items()}
    for middle in reach:
        for reached in reach.values():
            if middle in reached:
                reached |= reach[middle]
    bound = [frozenset(o for o in reach[n] if n in reach[o]) for n in reach if n in reach[n]]
    return [set(knot) for knot in dict.fromkeys(bound)]


@pytest.mark.parametrize("room", sorted(ROOMS))
def test_a_room_includes_only_what_lies_below_it(room: str) -> None:
    strangers = [
        f"{path.name} includes {name}"
        for path in files(room)
        for name, header in included(path)
        if room_of(header) not in ALLOWED[room] | {room}
    ]

    assert strangers == []


@pytest.mark.parametrize("inner", sorted(INNER_ALLOWED))
def test_an_inner_room_of_the_product_includes_only_what_lies_below_it(inner: str) -> None:
    strangers = [
        f"{path.name} includes {name}"
        for path in files("app")
        for name, header in included(path)
        if inner_room(path) == inner
        and header is not None
        and header.is_relative_to(APP)
        and inner_room(header) not in INNER_ALLOWED[inner] | {inner}
    ]

    assert strangers == []


def test_every_file_of_the_product_is_in_an_inner_room_or_is_app() -> None:
    astray = {
        inner_room(path) for path in files("app") if inner_room(path) not in INNER_ALLOWED
    } | {path.name for path in APP.glob("*.[ch]") if path.stem != "app"}

    assert astray == set()


@pytest.mark.parametrize("board", ["host", "mps2_an386"])
def test_a_board_sees_what_it_calls_and_not_how_it_is_done(board: str) -> None:
    strangers = [
        f"{path.name} includes {name}"
        for path in files(board)
        for name, header in included(path)
        if header is not None and header.is_relative_to(APP) and not is_of_boards(path, header)
    ]

    assert strangers == []


def is_of_boards(path: Path, header: Path) -> bool:
    return (path.name, header.name) in NO_BOARD or inner_room(header) in BOARDS_SEE


@pytest.mark.parametrize("room", sorted(ROOMS))
def test_no_room_has_a_circle(room: str) -> None:
    assert circles(ROOMS[room]) == []


def test_a_planted_circle_is_seen(tmp_path: Path) -> None:
    (tmp_path / "line").mkdir()
    (tmp_path / "line" / "link.h").write_text("")
    (tmp_path / "line" / "link.c").write_text('#include "link.h"\n#include "top.h" // top\n')
    (tmp_path / "top.h").write_text('#include "middle.h" // middle\n')
    (tmp_path / "middle.c").write_text('#include "line/link.h" // link\n')
    (tmp_path / "middle.h").write_text("#include <stdint.h>\n")
    (tmp_path / "alone.c").write_text('#include "top.h" // top\n')

    assert circles(tmp_path) == [{"line/link", "middle", "top"}]


def test_no_two_sources_have_the_same_name() -> None:
    """Symbol tables, stack reports and the board's objects know a file's name, not its folder."""
    names = Counter(path.name for room in ROOMS for path in files(room) if path.suffix == ".c")

    assert [name for name, count in names.items() if count > 1] == []


@pytest.mark.parametrize("room", BARE_METAL_ROOMS)
def test_what_runs_on_a_microcontroller_needs_no_heap_and_no_libm(room: str) -> None:
    foreign = [
        f"{path.name} includes <{name}>"
        for path in files(room)
        for mark, name in includes(path.read_text())
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
