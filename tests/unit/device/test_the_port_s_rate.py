"""Goal: the rate that pyserial sets is the rate of the line. Method: a real pseudo-terminal, whose
two ends share their settings; the unit's end reads what the host's end has set.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from backend.device.link.opening import Opener
from backend.device.link.simulated import SimulatedAddress
from backend.errors import InvalidRequest
from sim_device.serial_line import PtyLine


@pytest.mark.parametrize("rate", [230400, 921600, 1_000_000])
def test_the_far_end_sees_the_rate_the_port_is_set_to(tmp_path: Path, rate: int) -> None:
    far = PtyLine(tmp_path / "port")
    near = Opener(f"{tmp_path / 'port'}?baud={rate}").open()
    try:
        assert (near.bits_per_second, far.host_baud()) == (115200, 115200)
        assert near.bits_per_second_requested == rate

        near.set_baudrate(rate)

        assert (near.bits_per_second, far.host_baud()) == (rate, rate)
    finally:
        near.close()
        far.close()


def test_a_pseudo_terminal_has_no_rate_unless_the_url_says_so(tmp_path: Path) -> None:
    far = PtyLine(tmp_path / "port")
    near = Opener(str(tmp_path / "port")).open()
    try:
        assert near.bits_per_second is None
    finally:
        near.close()
        far.close()


def test_a_simulated_unit_gets_a_line_with_a_rate_when_one_is_asked_for() -> None:
    asked = SimulatedAddress.parse("sim:a?baud=921600")

    assert asked.baud == 921600
    assert "--serial-rate 115200" in " ".join(asked.command(Path("port")))
    assert "--serial-rate" not in SimulatedAddress.parse("sim:a").command(Path("port"))


@pytest.mark.parametrize(
    "url", ["sim:a?baud=fast", "sim:a?baud=9", "sim:a?baud=115200&clock=virtual"]
)
def test_a_rate_that_makes_no_sense_is_refused(url: str) -> None:
    with pytest.raises(InvalidRequest):
        SimulatedAddress.parse(url)
