"""Goal: the tree stays pleasant to walk through. Method: measure every file git knows.

Limits come from the house style: a budget of lines for each room, files of at most 500 lines,
functions of at most 70, lines of at most 100 characters, no TODO, and a sentence of purpose in
every package.
"""

import ast
import re
from collections import Counter
from pathlib import Path

import pytest

from tests.fakes.sources import ROOT, is_generated, relative, tracked

FILE_LINES_MAX = 500
FUNCTION_LINES_MAX = 70
LINE_LENGTH_MAX = 100
CODE_SUFFIXES = {".py", ".c", ".h", ".ts", ".svelte", ".css"}
LINES_MAX = {
    "backend": 1_770,
    "backend/audit": 370,
    "backend/bikes": 920,
    "backend/calibration": 7_650,
    "backend/cli": 2_080,
    "backend/core": 3_080,
    "backend/device": 6_580,
    "backend/formats": 8_550,
    "backend/imports": 2_890,
    "backend/law": 4_400,
    "backend/paper": 450,
    "backend/people": 2_280,
    "backend/rides": 10_690,
    "backend/server": 660,
    "backend/store": 8_860,
    "backend/tuning": 3_540,
    "backend/units": 2_270,
    "backend/visits": 2_110,
    "backend/web": 1_740,
    "firmware_protocol": 4_450,
    "frontend": 49_060,
    "sim_device": 21_180,
    "spindle": 700,
    "tests": 78_490,
    "tools": 4_960,
}
"""Lines of written code a room may have. A commit lowers a budget with what it removes; one that
raises it states the reason in its message."""


def is_foreign(path: Path) -> bool:
    """Another project's source, kept as it came."""
    return path.relative_to(ROOT).parts[0] == "third_party"


def written_code() -> list[Path]:
    return [
        path
        for path in tracked()
        if path.suffix in CODE_SUFFIXES and not is_generated(path) and not is_foreign(path)
    ]


def room_of(path: Path) -> str:
    """The top level; within the backend the package below it."""
    first, *rest = path.relative_to(ROOT).parts
    return f"{first}/{rest[0]}" if first == "backend" and len(rest) > 1 else first


def test_no_room_outgrows_its_budget() -> None:
    lines: Counter[str] = Counter()
    for path in written_code():
        if path.parent != ROOT:
            lines[room_of(path)] += len(path.read_text().splitlines())

    assert set(lines) == set(LINES_MAX)
    assert {room: n for room, n in lines.items() if n > LINES_MAX[room]} == {}


def test_no_file_is_longer_than_a_sitting() -> None:
    long = {relative(p): n for p in written_code() if (n := len(p.read_text().splitlines())) > 500}

    assert long == {}


def test_no_line_runs_off_the_screen() -> None:
    wide = [
        f"{relative(path)}:{number}"
        for path in written_code()
        for number, line in enumerate(path.read_text().splitlines(), start=1)
        if len(line) > LINE_LENGTH_MAX and "http" not in line
    ]

    assert wide == []


def test_no_python_function_outgrows_a_screen() -> None:
    long = [
        f"{relative(path)}:{node.name}"
        for path in written_code()
        if path.suffix == ".py"
        for node in ast.walk(ast.parse(path.read_text()))
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
        and (node.end_lineno or 0) - node.lineno >= FUNCTION_LINES_MAX
    ]

    assert long == []


def test_no_c_function_outgrows_a_screen() -> None:
    long = []
    for path in written_code():
        if path.suffix != ".c":
            continue
        start = 0
        for number, line in enumerate(path.read_text().splitlines(), start=1):
            if line.startswith("{") or (line.endswith("{") and not line.startswith((" ", "#"))):
                start = number
            if line.startswith("}") and start and number - start >= FUNCTION_LINES_MAX:
                long.append(f"{relative(path)}:{start}")

    assert long == []


def test_nothing_is_left_to_do_later() -> None:
    marks = [
        f"{relative(path)}:{number}"
        for path in written_code()
        if path != Path(__file__)
        for number, line in enumerate(path.read_text().splitlines(), start=1)
        if re.search(r"\b(TODO|FIXME|XXX|HACK)\b", line)
    ]

    assert marks == []


def test_every_package_says_what_it_is_for() -> None:
    silent = [
        relative(path)
        for path in tracked()
        if path.name == "__init__.py" and not ast.get_docstring(ast.parse(path.read_text()))
    ]

    assert silent == []


@pytest.mark.parametrize("word", ["utils", "helpers", "manager", "misc", "common"])
def test_no_file_is_named_after_nothing(word: str) -> None:
    assert [relative(p) for p in tracked() if p.stem == word] == []


def test_no_file_is_too_large_to_read() -> None:
    assert [relative(p) for p in tracked() if p.stat().st_size > 1_000_000] == []
