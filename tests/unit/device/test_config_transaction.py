"""A change of the configuration happens whole, once, on the base it was made for, or not at all.

The unit is bent one way at a time: moving, changed by somebody else, silent at the worst moment,
lying when read back. After every failure the unit must hold exactly what it held before.
Nobody is told that a trial ended for the reason of the trial before it.
"""

from __future__ import annotations

from collections.abc import Callable

import pytest

from backend.device.configuration import ConfigImage, TrialStatus
from backend.device.ebl.operations.config_transaction import (
    CommitUnanswered,
    read_config,
    write_config,
)
from backend.device.ebl.session.unit_state import UnitState
from backend.device.states import LinkStatistics
from backend.errors import (
    AccessDenied,
    ConfigConflict,
    LimitViolation,
    NoAnswer,
    NotStandingStill,
    PeerProtocolError,
    SpindleError,
)
from firmware_protocol._generated import (
    IMAGE_LENGTH,
    PARAMETER_BY_NAME,
    ConfigProvisionalEvent,
    ConfigRolledBackEvent,
    MessageId,
    Status,
)
from firmware_protocol._generated import Event as EventCode
from firmware_protocol.codec import Event, Request, decode
from firmware_protocol.framing import FrameDecoder
from firmware_protocol.layout import Message
from firmware_protocol.parameters import default_config
from tests.fakes.bench import Bench
from tests.fakes.unit import FakeUnit


def connected() -> tuple[Bench, FakeUnit, ConfigImage]:
    unit = FakeUnit()
    bench = Bench(unit).connect()
    return bench, unit, bench.ask(read_config())


def silence_from(unit: FakeUnit, message_id: MessageId) -> Callable[[bytes], bytes]:
    """A line on which the unit falls silent when this request reaches it."""
    decoder = FrameDecoder()

    def watch(data: bytes) -> bytes:
        for frame in decoder.feed(data):
            request = decode(frame)
            assert isinstance(request, Request)
            if request.message.MESSAGE_ID is message_id:
                unit.silent = True
        return data

    return watch


def test_the_whole_configuration_is_read_with_its_generation_and_checksum() -> None:
    _, unit, config = connected()

    assert config.parameters == default_config()
    assert config.generation == unit.generation


def test_a_written_value_is_in_the_unit_and_nothing_else_changed() -> None:
    bench, _, base = connected()
    rules = [["NB"] * 5] * 5

    after = bench.ask(write_config(base, {"fuzzy_rules": rules, "pedal_stop_ms": 200}))

    expected = default_config() | {"fuzzy_rules": rules, "pedal_stop_ms": 200}
    assert after.parameters == expected
    assert bench.ask(read_config()).parameters == expected


def test_a_unit_with_small_frames_gets_the_change_in_several_pieces() -> None:
    bench, unit, base = connected()
    everything = {
        name: value
        for name, value in default_config().items()
        if PARAMETER_BY_NAME[name].group == "fuzzy"
    }
    unit.executed.clear()

    bench.ask(write_config(base, everything, mtu=128))

    assert unit.executed.count(MessageId.CFG_SET) > 1
    # Pieces of 104 bytes.
    assert unit.executed.count(MessageId.CFG_READ) == -(-IMAGE_LENGTH // 104)


def refused_with(
    status: Status, at: MessageId
) -> tuple[Bench, FakeUnit, ConfigImage, Callable[[], ConfigImage]]:
    bench, unit, base = connected()
    unit.refuse[at] = status
    return bench, unit, base, lambda: bench.ask(write_config(base, {"pedal_stop_ms": 200}))


@pytest.mark.parametrize(
    ("status", "at", "error"),
    [
        (Status.NOT_STOPPED, MessageId.CFG_COMMIT, NotStandingStill),
        (Status.STALE_BASE, MessageId.CFG_BEGIN, ConfigConflict),
        (Status.ACCESS, MessageId.CFG_SET, AccessDenied),
        (Status.RANGE, MessageId.CFG_SET, LimitViolation),
        (Status.FLASH_FAIL, MessageId.CFG_COMMIT, SpindleError),
        (Status.CRC_MISMATCH, MessageId.CFG_COMMIT, SpindleError),
        (Status.EXPIRED, MessageId.CFG_VALIDATE, SpindleError),
    ],
)
def test_every_refusal_has_its_error_and_changes_nothing(
    status: Status, at: MessageId, error: type[SpindleError]
) -> None:
    _, unit, base, write = refused_with(status, at)
    image = unit.image

    with pytest.raises(error):
        write()

    assert unit.image == image
    assert unit.generation == base.generation


def test_after_a_refused_change_the_next_one_goes_through() -> None:
    bench, unit, base, write = refused_with(Status.FLASH_FAIL, MessageId.CFG_COMMIT)
    with pytest.raises(SpindleError):
        write()

    unit.refuse.clear()
    after = bench.ask(write_config(base, {"pedal_stop_ms": 300}))

    assert unit.executed.count(MessageId.CFG_ABORT) == 1
    assert after.parameters["pedal_stop_ms"] == 300


def test_a_change_on_an_outdated_base_is_refused() -> None:
    bench, _unit, base = connected()
    bench.ask(write_config(base, {"pedal_stop_ms": 200}))

    with pytest.raises(ConfigConflict, match="somebody else changed it"):
        bench.ask(write_config(base, {"pedal_stop_ms": 300}))

    assert bench.ask(read_config()).parameters["pedal_stop_ms"] == 200


def test_the_unit_checks_for_itself_and_its_list_comes_back_with_names() -> None:
    bench, unit, base = connected()
    wrong = {
        "fuzzy_gain_points": [0.1, 0.2, 0.15, 0.4, 0.5],
        "motor_torque_nm_max": 3.0,
    }

    with pytest.raises(LimitViolation) as caught:
        bench.ask(write_config(base, wrong))

    assert [(error.field, error.code) for error in caught.value.fields] == [
        ("fuzzy_gain_points[2]", "not_increasing"),
        ("motor_torque_nm_max", "above_max"),
    ]
    assert "0 to 2 Nm" in caught.value.fields[1].message
    assert unit.generation == base.generation


@pytest.mark.parametrize("at", [MessageId.CFG_BEGIN, MessageId.CFG_SET, MessageId.CFG_VALIDATE])
def test_silence_before_the_commit_leaves_the_unit_unchanged_and_says_so(at: MessageId) -> None:
    bench, unit, base = connected()
    image = unit.image
    bench.to_unit = silence_from(unit, at)

    with pytest.raises(NoAnswer) as caught:
        bench.ask(write_config(base, {"pedal_stop_ms": 200}))

    assert not isinstance(caught.value, CommitUnanswered)
    assert "configuration is unchanged" in caught.value.message
    assert unit.image == image


def test_silence_at_the_commit_is_told_as_not_known() -> None:
    bench, unit, base = connected()
    bench.to_unit = silence_from(unit, MessageId.CFG_COMMIT)

    with pytest.raises(CommitUnanswered, match="not known"):
        bench.ask(write_config(base, {"pedal_stop_ms": 200}))


def flipped(image: bytes) -> bytes:
    at = PARAMETER_BY_NAME["motor_torque_nm_max"].image_offset
    return image[:at] + bytes(4) + image[at + 4 :]


def test_a_unit_that_lies_when_read_back_is_caught_and_the_field_is_named() -> None:
    bench, unit, base = connected()
    unit.lies = lambda image: flipped(image) if unit.generation > base.generation else image

    with pytest.raises(PeerProtocolError, match=r"motor_torque_nm_max should be 1\.5") as caught:
        bench.ask(write_config(base, {"motor_torque_nm_max": 1.5}))

    assert [error.field for error in caught.value.fields] == ["motor_torque_nm_max"]
    assert caught.value.code == "read_back_differs"


def test_a_unit_whose_image_does_not_have_its_own_checksum_is_not_believed() -> None:
    bench, unit, _ = connected()
    reads = iter([False, True] * 3)
    unit.lies = lambda image: flipped(image) if next(reads) else image

    with pytest.raises(PeerProtocolError, match="does not have the checksum"):
        bench.ask(read_config())


def test_a_configuration_that_moves_while_it_is_read_is_read_again() -> None:
    bench, unit, _base = connected()
    honest = unit.image
    moved = flipped(honest)
    reads = iter([honest, moved, moved, moved])
    unit.lies = lambda image: next(reads)

    config = bench.ask(read_config())

    assert config.parameters["motor_torque_nm_max"] == 0.0


def hear(state: UnitState, seq: int, code: EventCode, message: Message) -> None:
    state.take(Event(seq, code, 1_000_000 * seq, message), LinkStatistics(), float(seq))


def test_a_rollback_has_no_cause_until_the_unit_was_asked() -> None:
    state = UnitState()
    state.refresh(0, TrialStatus(False, 7, 111, 0.0, "time_out", 8), 0.0)

    hear(state, 1, EventCode.CONFIG_PROVISIONAL, ConfigProvisionalEvent(9, 222, 60))
    assert state.trial_ends_s is not None
    hear(state, 2, EventCode.CONFIG_ROLLED_BACK, ConfigRolledBackEvent(10, 111))
    assert state.trial_ends_s is None
    assert state.rollback_cause is None

    state.refresh(0, TrialStatus(False, 10, 111, 0.0, "asked", 9), 3.0)
    assert state.rollback_cause == "asked"
