"""Goal: the rate of the line changes at both ends or at none, and a host that guessed wrong finds
the unit; the rate that pyserial sets is the rate of the line.

Method: the real firmware and the real session in virtual time on a line that is sampled bit by bit,
so that wrong rates make the noise they make. For the port a real pseudo-terminal, whose two ends
share their settings.

Times are the specification's: 10 ms, 200 ms, 5 s at the unit; HELLO five times at 150 ms.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from backend.device.ebl.session.operation import query
from backend.device.ebl.session.stream_receiver import StreamPlan
from backend.device.link.opening import Opener
from backend.device.link.simulated import SimulatedAddress
from backend.device.states import LinkState
from backend.errors import InvalidRequest
from firmware_protocol._generated import (
    AliveRequest,
    AliveResponse,
    CfgInfoRequest,
    CfgInfoResponse,
    MessageId,
)
from sim_device.serial_line import PtyLine
from tests.fakes.line_bench import FIRST, LineBench

FAST = 1_000_000


def is_message(frame: bytes, message_id: int) -> bool:
    return int.from_bytes(frame[2:4], "little") == message_id


def bits_per_second(bench: LineBench) -> int | None:
    return bench.session.link_statistics().bits_per_second


def works(bench: LineBench, rate: int) -> None:
    """Both ends are at this rate, and a question is answered."""
    bench.run_until(lambda: bench.session.state is LinkState.READY)
    alive = bench.ask(query(AliveRequest(), AliveResponse))
    assert (alive.bits_per_second, bench.unit_rate, bench.rates[-1]) == (rate, rate, rate)
    assert bits_per_second(bench) == rate
    assert isinstance(bench.ask(query(CfgInfoRequest(), CfgInfoResponse)), CfgInfoResponse)


def test_without_a_wish_the_fastest_that_the_unit_offers_is_taken() -> None:
    bench = LineBench(plan=StreamPlan()).connect()

    works(bench, FAST)
    bench.run(2.0)

    statistics = bench.session.link_statistics()
    assert (statistics.frames_bad, statistics.stream_rows_lost) == (0, 0)
    assert statistics.stream_rows >= 190


@pytest.mark.parametrize("wanted", [230400, 460800, 921600])
def test_the_rate_that_is_wished_for_is_taken(wanted: int) -> None:
    works(LineBench(wanted=wanted).connect(), wanted)


@pytest.mark.parametrize("wanted", [FIRST, 57600, 2_000_000])
def test_a_wish_that_is_no_other_offered_rate_leaves_it_as_it_is(wanted: int) -> None:
    bench = LineBench(wanted=wanted).connect()

    works(bench, FIRST)

    assert bench.rates == [FIRST]


def test_a_unit_without_a_rate_is_not_asked_for_one() -> None:
    bench = LineBench(line_baud=0).connect()

    assert not any(is_message(frame, MessageId.SET_BAUD) for frame in bench.sent)


def test_a_lost_acknowledgement_is_asked_for_again_and_the_switch_happens() -> None:
    bench = LineBench()
    lost: list[bytes] = []

    def lose_the_first(frame: bytes) -> bool:
        if is_message(frame, MessageId.SET_BAUD) and not lost:
            lost.append(frame)
            return False
        return True

    bench.to_host = lose_the_first
    bench.connect()

    assert lost
    works(bench, FAST)


def test_acknowledgements_that_never_come_leave_both_at_the_old_rate() -> None:
    bench = LineBench()
    bench.to_host = lambda frame: not is_message(frame, MessageId.SET_BAUD)

    bench.connect()

    works(bench, FIRST)
    assert bench.rates == [FIRST]


def test_when_no_ping_arrives_both_go_back_and_the_session_goes_on() -> None:
    bench = LineBench(plan=StreamPlan())
    bench.to_unit = lambda frame: (
        not (is_message(frame, MessageId.PING) and bench.rates[-1] == FAST)
    )

    bench.connect()

    works(bench, FIRST)
    assert bench.rates == [FIRST, FAST, FIRST, FAST, FIRST]
    bench.run(1.0)
    assert bench.session.link_statistics().stream_rows > 50


def test_when_no_answer_at_the_new_rate_comes_the_unit_is_still_found() -> None:
    # The unit heard the PING and stays; the host did not hear so and goes back: they disagree.
    bench = LineBench()
    bench.to_host = lambda frame: bench.rates[-1] != FAST
    bench.plug_in()
    bench.run(1.5)
    assert bench.session.state is LinkState.CONNECTING
    bench.to_host = lambda frame: True

    bench.run_until(lambda: bench.session.state is LinkState.READY, patience_s=6.0)

    works(bench, bench.unit_rate)


def test_noise_of_a_wrong_rate_before_hello_harms_nobody() -> None:
    # Another host left the unit at 1 Mbaud with a stream a moment ago; we begin at 115200.
    bench = LineBench(plan=StreamPlan()).connect()
    works(bench, FAST)
    bench.unplug()
    bench.run(0.2)

    bench.plug_in()
    bench.run_until(lambda: bench.session.state is LinkState.READY, patience_s=2.0)

    works(bench, FAST)
    assert bench.rates[-2:] == [FIRST, FAST]
    assert bench.session.link_statistics().frames_bad > 0


def test_a_unit_left_alone_waits_at_its_first_rate() -> None:
    bench = LineBench(plan=StreamPlan()).connect()
    bench.unplug()
    bench.run(5.1)
    assert bench.unit_rate == FIRST

    bench.plug_in()

    bench.run_until(lambda: bench.session.state is LinkState.READY, patience_s=0.6)
    works(bench, FAST)


@pytest.mark.parametrize("at_s", [0.055, 0.070, 0.080, 0.100, 0.150])
def test_unplugged_in_the_middle_of_the_switch(at_s: float) -> None:
    bench = LineBench(plan=StreamPlan()).plug_in()
    bench.run(at_s)
    bench.unplug()
    bench.run(0.05)

    bench.plug_in()

    bench.run_until(lambda: bench.session.state is LinkState.READY, patience_s=3.0)
    works(bench, FAST)


def test_a_unit_that_restarts_is_found_at_its_first_rate_and_goes_fast_again() -> None:
    bench = LineBench(plan=StreamPlan()).connect()
    bench.run(12.0)
    bench.restart_unit()

    bench.run_until(lambda: bench.session.state is not LinkState.READY)
    works(bench, FAST)

    assert bench.session.handshake is not None
    assert bench.session.handshake.identity.boot_id == 2


def test_a_port_that_cannot_run_so_fast_stays_slow() -> None:
    bench = LineBench()
    bench.port_rates_max = 500_000

    bench.connect()

    bench.run(1.0)
    works_slow = bench.ask(query(AliveRequest(), AliveResponse))
    assert works_slow.bits_per_second == FIRST
    assert bench.rates == [FIRST] or set(bench.rates) == {FIRST}


def test_where_nobody_answers_the_reason_names_the_rates_that_were_tried() -> None:
    bench = LineBench(wanted=921600)
    bench.to_host = lambda frame: False
    bench.plug_in()

    bench.run(2.0)

    assert bench.session.state is LinkState.CONNECTING
    assert "at 115200 and 921600 baud" in bench.session.reason


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
