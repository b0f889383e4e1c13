"""Which tests run on one worker of `pytest -n`, and in what order the parts are handed out.

A file is one part, because its tests share what it builds; in the files of `SPREAD` each test is a
part of its own. xdist's own way, a mark for a group, does nothing with pytest 9.2
(pytest-xdist issue 1386), so the parts are made from the tests' names.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from xdist.scheduler import LoadScopeScheduling

SPREAD = {
    "tests/tools/test_fuzzers_find_nothing.py",
    "tests/tools/test_every_known_break_is_noticed.py",
    "tests/unit/law/test_gain_bounds.py",
    "tests/unit/sim_device/test_no_transient_breaks_a_law.py",
}
"""Files whose tests share nothing that is expensive to make."""

TURNS = {"stories": 1, "browser": 2}
"""When a room's turn comes; what is slow elsewhere has turn 1, what is quick comes last."""


def part_of(nodeid: str) -> str:
    """The part that a test belongs to: its file, or itself."""
    path = nodeid.partition("::")[0]
    return nodeid if path in SPREAD else path


def long_ones_first(items: Iterable[pytest.Item]) -> list[pytest.Item]:
    """No worker is left with a long part. What needs a Chromium and a server of each worker comes
    late: idle ones cost, too."""
    turns: dict[Path, int] = {}
    for item in items:
        spread = item.nodeid.partition("::")[0] in SPREAD
        slow = item.get_closest_marker("slow") is not None
        turn = 0 if spread else TURNS.get(item.path.parent.name, 1 if slow else 3)
        turns[item.path] = min(turn, turns.get(item.path, turn))
    return sorted(items, key=lambda item: turns[item.path])


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: object) -> LoadScopeScheduling:
    """Asked by the process that hands out the tests."""
    from xdist.scheduler import LoadScopeScheduling  # not there where tests run one by one

    class Parts(LoadScopeScheduling):
        def _split_scope(self, nodeid: str) -> str:
            return part_of(nodeid)

    return Parts(config, log)
