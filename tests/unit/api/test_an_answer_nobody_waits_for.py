"""Goal: work that takes long ends when the page that asked for it was left or asks something else.

Method: a real uvicorn on loopback, and a service that works until it is told to stop.
"""

from __future__ import annotations

import http.client
import threading
import time
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from backend.errors import NotFound, RequestRefused
from backend.web.connections import PatientProtocol
from tests.fakes.api import api_with
from tests.unit.api.test_connections import PATIENCE_S, serving

pytestmark = pytest.mark.slow


class Working:
    """Rides again until nobody asks any more, or for a moment where `briefly`."""

    def __init__(self) -> None:
        self.begun = threading.Event()
        self.given_up = threading.Event()
        self.briefly = False

    def __call__(
        self, ride_id: int, told: object, check_connected: Callable[[], None], **changes: Any
    ) -> Any:
        self.begun.set()
        until = time.monotonic() + (0.05 if self.briefly else PATIENCE_S)
        while time.monotonic() < until:
            try:
                check_connected()
            except RequestRefused:
                self.given_up.set()
                raise
            time.sleep(0.01)
        raise NotFound("The work came to its end.")


@pytest.fixture
def working() -> Working:
    return Working()


@pytest.fixture
def asking(working: Working) -> Iterator[http.client.HTTPConnection]:
    with serving(PatientProtocol, api_with(ride_again=working)) as (host, port):
        connection = http.client.HTTPConnection(host, port, timeout=PATIENCE_S)
        yield connection
        connection.close()


def ask(connection: http.client.HTTPConnection) -> None:
    headers = {"content-type": "application/json"}
    connection.request("POST", "/api/v1/rides/1/again", b"{}", headers)


def test_an_estimate_ends_when_its_asker_goes_away(
    working: Working, asking: http.client.HTTPConnection
) -> None:
    ask(asking)
    assert working.begun.wait(PATIENCE_S)

    asking.close()

    assert working.given_up.wait(PATIENCE_S)


def test_who_waits_gets_the_answer_and_can_ask_again(
    working: Working, asking: http.client.HTTPConnection
) -> None:
    working.briefly = True

    for _ in range(2):
        ask(asking)
        response = asking.getresponse()
        assert (response.status, b"came to its end" in response.read()) == (404, True)

    assert not working.given_up.is_set()
