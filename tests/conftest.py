"""Fixtures that stories and browser tests share: one real server with one simulated unit.

`pytest --unit=qemu` runs the same tests with the firmware on an emulated Cortex-M4F
(sim_device/firmware/boards/mps2_an386) in place of the host build. `pytest --prove` runs large
counts in full (tests/counts.py).
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from sim_device import emulator
from tests import counts
from tests.fakes import board_rig
from tests.fakes.server import SpindleServer

# When a room's turn comes; what is slow elsewhere has turn 1, what is quick comes last.
TURNS = {"stories": 1, "browser": 2}


def pytest_addoption(parser: pytest.Parser) -> None:
    """Which build of the firmware the units under test run; how much of large counts."""
    parser.addoption("--unit", choices=("host", "qemu"), default="host")
    parser.addoption("--prove", action="store_true", help="large counts in full, not a tenth")


def pytest_configure(config: pytest.Config) -> None:
    """The client of these tests is httpx, which is what the command uses too."""
    config.addinivalue_line("filterwarnings", "ignore:Using `httpx` with `starlette.testclient`")
    if config.getoption("--prove"):
        os.environ[counts.PROVE_VARIABLE] = "1"
    if config.getoption("--unit") == "qemu":
        reason = emulator.missing()
        if reason is not None:
            pytest.exit(reason, returncode=1)
        os.environ[emulator.BOARD_VARIABLE] = emulator.BOARD


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """What only the host build can show is left out on the board; who works beside whom."""
    share_out(items)
    if config.getoption("--unit") == "qemu":
        for item in items:
            for mark in item.iter_markers("host_build"):
                item.add_marker(pytest.mark.skip(reason=mark.args[0]))


def share_out(items: list[pytest.Item]) -> None:
    """Parts for `--dist loadgroup`, the long ones first so that no worker is left with one.

    A file is one part, because its tests share what it builds; tests marked `spread` are parts of
    their own. What needs a Chromium and a server of each worker comes late: idle ones cost, too.
    """
    turns: dict[Path, int] = {}
    for item in items:
        spread = item.get_closest_marker("spread") is not None
        slow = item.get_closest_marker("slow") is not None
        if not spread:
            item.add_marker(pytest.mark.xdist_group(f"{item.path.parent.name}/{item.path.stem}"))
        turn = 0 if spread else TURNS.get(item.path.parent.name, 1 if slow else 3)
        turns[item.path] = min(turn, turns.get(item.path, turn))
    items.sort(key=lambda item: turns[item.path])


def pytest_collection_finish(session: pytest.Session) -> None:
    """Tests of the unit's C get the board's C; stories start boards of their own."""
    on_board = session.config.getoption("--unit") == "qemu"
    if on_board and "sim_device.firmware.python.law" in sys.modules and session.items:
        rig = board_rig.Rig()
        rig.take_over()
        session.config.add_cleanup(rig.close)


@pytest.fixture(scope="session")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[SpindleServer]:
    """`spindle serve` with one simulated unit, on a free port, in a folder of its own."""
    running = SpindleServer(tmp_path_factory.mktemp("spindle"), ["sim:bench?seed=1"]).start()
    yield running
    running.stop()


@pytest.fixture(scope="session")
def device(server: SpindleServer) -> str:
    """The id of the simulated unit, once it is ready."""
    return server.ready_device()
