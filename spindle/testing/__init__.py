"""pytest fixtures for whoever builds firmware, tools or bikes around Spindle.

In a conftest.py: `pytest_plugins = ["spindle.testing"]`. Then a test may ask for

- `drive_unit`: one unit in virtual time, no server (DriveUnit). Mark the test with
  `@pytest.mark.drive_unit(seed=3, scenario="commute", config={...})` to have another one.
- `server`: a whole Spindle server of the test session with one unit in virtual time.
- `client`: its typed client (spindle.client.Spindle).
"""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from spindle.client import READY_WITHIN_S, Spindle, Unit
from spindle.testing.drive_unit import DriveUnit
from spindle.testing.server import RunningServer, ServerDied

__all__ = ["DriveUnit", "RunningServer", "ServerDied", "Spindle", "Unit"]

SERVED = "sim:bench?clock=virtual&scenario=none&seed=1"


def pytest_configure(config: pytest.Config) -> None:
    """The one mark of the kit, so that `--strict-markers` knows it."""
    config.addinivalue_line(
        "markers", "drive_unit(seed, scenario, config, bike, market): which unit the fixture makes"
    )


@pytest.fixture
def drive_unit(request: pytest.FixtureRequest) -> DriveUnit:
    """One unit in virtual time, connected; the mark `drive_unit` says which."""
    mark = request.node.get_closest_marker("drive_unit")
    return DriveUnit(**mark.kwargs) if mark else DriveUnit()


@pytest.fixture(scope="session")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningServer]:
    """A server with one unit whose time passes when told to; it lives as long as the session."""
    running = RunningServer(tmp_path_factory.mktemp("spindle"), [SERVED]).start()
    yield running
    running.stop()


@pytest.fixture
def client(server: RunningServer) -> Spindle:
    """The server's client, its unit ready."""
    spindle = Spindle(server.url)
    spindle.unit(within_s=READY_WITHIN_S).wait_ready()
    return spindle
