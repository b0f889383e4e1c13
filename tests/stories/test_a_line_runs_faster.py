"""Goal: a unit on a real serial line is taken from 115200 to 1 Mbaud and back, and told so. Method:
the server with a simulated unit whose line has a rate; its far end is the port that pyserial sets.

The unit runs at a part of real time: the proof of a rate has 200 ms of the unit's, which a loaded
machine would miss.
"""

from __future__ import annotations

import time

from backend.device.driver import Driver
from backend.device.ebl.session.operation import query
from backend.device.link import Opener
from firmware_protocol._generated import AliveRequest, AliveResponse
from tests.fakes.server import eventually
from tests.fakes.unit_link import ebl_driver

PATIENCE_S = 30.0


def driver(url: str) -> Driver:
    started = ebl_driver(Opener(url), lambda event: None)
    started.start()
    assert started.connected.wait(PATIENCE_S), started.status().reason
    return started


def test_at_a_low_speed_the_port_and_the_unit_agree_on_a_megabaud() -> None:
    unit = driver("sim:fast?baud=1000000&speed=0.1")
    try:
        # Of its clock not a step may have passed: it tells the new rate once it has begun.
        alive = eventually(
            lambda: unit.run(query(AliveRequest(), AliveResponse), PATIENCE_S),
            lambda told: told.uptime_us > 0,
        )
        assert alive.bits_per_second == 1_000_000
        assert unit.status().statistics.bits_per_second == 1_000_000
    finally:
        unit.close()


def test_at_a_low_speed_a_line_that_is_to_stay_slow_carries_what_fits() -> None:
    unit = driver("sim:slow?baud=115200&speed=0.5")
    try:
        deadline_s = time.monotonic() + PATIENCE_S
        while unit.status().statistics.stream_rows < 20 and time.monotonic() < deadline_s:
            alive = unit.run(query(AliveRequest(), AliveResponse), PATIENCE_S)
            assert alive.bits_per_second == 115200
        assert unit.status().statistics.stream_rows >= 20
        assert unit.status().statistics.bits_per_second == 115200
    finally:
        unit.close()
