"""Fixtures that stories and browser tests share: a real server, and simulated units.

`pytest --unit=qemu` runs the same tests with the firmware on an emulated Cortex-M4F
(sim_device/firmware/boards/mps2_an386) in place of the host build. `pytest --prove` runs large
counts in full (tests/counts.py).
"""

from __future__ import annotations

import gc
import itertools
import os
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from sim_device import emulator
from tests import counts, parts
from tests.fakes import board_rig
from tests.fakes.cable import Cable
from tests.fakes.new_database import new_databases_are_copied
from tests.fakes.server import ServerHere
from tests.run import again, guard, started

__all__ = ["new_databases_are_copied"]

# Of units that tests make for themselves.
NUMBERS = itertools.count(1)

pytest_xdist_make_scheduler = parts.pytest_xdist_make_scheduler


def pytest_addoption(parser: pytest.Parser) -> None:
    """Which build of the firmware the units under test run; how much of large counts."""
    parser.addoption("--unit", choices=("host", "qemu"), default="host")
    parser.addoption("--prove", action="store_true", help="large counts in full, not a tenth")


@pytest.hookimpl(tryfirst=True)
def pytest_configure(config: pytest.Config) -> None:
    """The client of these tests is httpx, which is what the command uses too."""
    guard.guarded(config)
    started.counted(config)
    again.told(config)
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
    """What only the host build can show is left out on the board."""
    items[:] = parts.long_ones_first(items)
    again.may_be_tried_again(items)
    if config.getoption("--unit") == "qemu":
        for item in items:
            for mark in item.iter_markers("host_build"):
                item.add_marker(pytest.mark.skip(reason=mark.args[0]))


def pytest_unconfigure() -> None:
    """At its end a process gives back what it froze; libraries in C complain otherwise."""
    gc.unfreeze()


def pytest_collection_finish(session: pytest.Session) -> None:
    """Tests of the unit's C get the board's C; stories start boards of their own."""
    # Modules and tests live as long as the process: collecting garbage need not look at them, nor
    # after every few hundred objects. A tenth of the processor's time.
    gc.freeze()
    gc.set_threshold(100_000, 50, 100)
    on_board = session.config.getoption("--unit") == "qemu"
    if on_board and "sim_device.firmware.python.law" in sys.modules and session.items:
        rig = board_rig.Rig()
        rig.take_over()
        session.config.add_cleanup(rig.close)


@pytest.fixture(scope="session")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServerHere]:
    """A server for all tests of this worker, in a folder of its own; a unit brings each test."""
    with ServerHere(tmp_path_factory.mktemp("spindle")) as running:
        yield running


@pytest.fixture
def device(server: ServerHere) -> Iterator[str]:
    """The id of a simulated unit of the test's own: new, at rest, its time standing."""
    number = next(NUMBERS)
    url = f"sim:own{number}?seed={number}&clock=virtual&scenario=none"
    device = server.add_unit(url)
    # Its first row.
    server.advance(device, 0.1)
    yield device
    server.ask("DELETE", f"/devices/{device}")


@pytest.fixture
def cable(tmp_path: Path) -> Iterator[Cable]:
    """A server of the test's own with one address, and units that come onto it in turn."""
    with Cable(tmp_path) as made:
        yield made
