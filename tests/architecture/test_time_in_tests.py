"""Goal: no test depends on how fast the machine is.

Method: the sources. A simulated unit that runs faster than real time is watched by polls: how long
its ride gets depends on the machine. It stands only in tests whose names say that speed is what
they are about; rides come from virtual time.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]
# What measures is no test.
MEASURES = {"bench", "reproduction"}
FASTER = re.compile(r"[?&]speed=")
ABOUT_SPEED = re.compile(r"speed|faster|pace")


def places(node: ast.AST, within: str = "") -> Iterator[tuple[str, int]]:
    """The function around each url with a speed, empty outside of one, and the line."""
    if isinstance(node, ast.FunctionDef):
        within = node.name
    if isinstance(node, ast.Constant) and isinstance(node.value, str) and FASTER.search(node.value):
        yield within, node.lineno
    for child in ast.iter_child_nodes(node):
        yield from places(child, within)


def strangers(text: str) -> list[int]:
    """Lines with a speed in what is not about speed."""
    return [line for within, line in places(ast.parse(text)) if not ABOUT_SPEED.search(within)]


def test_only_what_is_about_speed_runs_faster_than_real_time() -> None:
    found = [
        f"{path.relative_to(TESTS)}:{line}"
        for path in sorted(TESTS.rglob("*.py"))
        if path.relative_to(TESTS).parts[0] not in MEASURES and path != Path(__file__)
        for line in strangers(path.read_text(encoding="utf-8"))
    ]

    assert found == [], "Use clock=virtual and advance, or say in the name that it is about speed."


def test_a_planted_one_is_seen() -> None:
    planted = 'URL = "sim:one?seed=1&speed=5"\ndef test_a_faster_unit():\n    "sim?speed=2"\n'

    assert strangers(planted) == [1]
