"""Fixtures that stories and browser tests share: one real server with one simulated unit."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.fakes.server import SpindleServer


def pytest_configure(config: pytest.Config) -> None:
    """The client of these tests is httpx, which is what the command uses too."""
    config.addinivalue_line("filterwarnings", "ignore:Using `httpx` with `starlette.testclient`")


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
