"""Goal: nobody raises a limit without the maker's word for exactly that change.

Method: the whole unit on the bench; tokens are signed by an independent Ed25519 (OpenSSL's, through
`cryptography`). Delays are those of the protocol page, 4.3: 1, 2, 4 .. 60 s.
"""

import math
from dataclasses import replace

import pytest
from sim_device.firmware.python._native import lib

from firmware_protocol._generated import (
    Access,
    AuthChallengeRequest,
    AuthChangedEvent,
    AuthDropRequest,
    AuthResponseRequest,
    CfgSetRequest,
    CfgValidateRequest,
    LiveSetRequest,
    Status,
)
from firmware_protocol.parameters import set_items
from firmware_protocol.unlock_token import Token
from tests.fakes.bench_unit import FLASH_BLOCK_BYTES, BenchUnit
from tests.fakes.maker import (
    Maker,
    challenged,
    commit,
    provision,
    respond,
    staged,
    staged_anyhow,
)

MAKER = Maker()
LOWERED = {"assist_cutoff_kmh": 20.0, "motor_torque_nm_max": 1.5}
RAISED = {"assist_cutoff_kmh": 25.0}
JUNK = Token(2**63, bytes(64))
COMMIT_PAUSE_S = 2.5


@pytest.fixture
def unit() -> BenchUnit:
    """A provisioned unit whose dealer has lowered its limits."""
    bench = BenchUnit()
    provision(bench, MAKER)
    lower(bench)
    return bench


def lower(bench: BenchUnit) -> None:
    assert bench.write(dict(LOWERED)).status == Status.OK
    bench.advance(COMMIT_PAUSE_S)


def guess(bench: BenchUnit, transaction: int, image: bytes) -> int:
    challenged(bench, Access.DEALER, image)
    return respond(bench, transaction, JUNK).status


def delay_s(bench: BenchUnit) -> int:
    response = bench.ask(AuthChallengeRequest(Access.DEALER))
    return response.detail if response.status == Status.AUTH_DELAY else 0


def test_the_maker_s_token_raises_a_limit(unit: BenchUnit) -> None:
    transaction, image = staged(unit, RAISED)
    assert commit(unit, transaction, image).status == Status.ACCESS
    token = MAKER.sign(challenged(unit, Access.DEALER, image))

    assert respond(unit, transaction, token).status == Status.OK
    assert commit(unit, transaction, image).status == Status.OK

    assert unit.config()["assist_cutoff_kmh"] == 25.0
    levels = [e.message.level for e in unit.events if isinstance(e.message, AuthChangedEvent)]
    assert levels == [Access.DEALER, Access.RIDER]


def test_lowering_needs_no_token_and_no_key() -> None:
    bench = BenchUnit()

    assert bench.write(dict(LOWERED)).status == Status.OK


def test_one_limit_raised_among_lowered_ones_needs_a_token(unit: BenchUnit) -> None:
    mixed = {"assist_cutoff_kmh": 15.0, "motor_torque_nm_max": 1.6}
    transaction, image = staged(unit, mixed)

    refused = commit(unit, transaction, image)

    assert (refused.status, refused.detail) == (Status.ACCESS, Access.DEALER)


def test_what_is_no_limit_goes_up_and_down_freely(unit: BenchUnit) -> None:
    for seconds in (0.3, 0.9, 0.5):
        assert unit.write({"torque_filter_s": seconds}).status == Status.OK
        unit.advance(COMMIT_PAUSE_S)


def test_without_a_key_nothing_can_be_asked_or_raised() -> None:
    bench = BenchUnit()
    lower(bench)
    transaction, image = staged(bench, RAISED)

    assert bench.ask(AuthChallengeRequest(Access.DEALER)).status == Status.NOT_FOUND
    assert respond(bench, transaction, JUNK).status == Status.NOT_FOUND
    assert commit(bench, transaction, image).status == Status.ACCESS
    assert bench.config()["assist_cutoff_kmh"] == 20.0


def test_a_damaged_key_counts_as_none(unit: BenchUnit) -> None:
    unit.flash()[-FLASH_BLOCK_BYTES + 10] ^= 1
    unit.boot()

    assert unit.ask(AuthChallengeRequest(Access.DEALER)).status == Status.NOT_FOUND
    assert lib.bench_provision_unlock_key(unit.board, Maker(9).public_key) < 0


def test_another_key_does_not_replace_the_first(unit: BenchUnit) -> None:
    assert lib.bench_provision_unlock_key(unit.board, Maker(9).public_key) < 0
    assert lib.bench_provision_unlock_key(unit.board, MAKER.public_key) == 0


def test_a_flash_without_room_keeps_no_key() -> None:
    small = BenchUnit(flash_block_bytes=512, flash_bytes=4 * 512)

    assert lib.bench_provision_unlock_key(small.board, MAKER.public_key) < 0


def test_a_token_is_good_once(unit: BenchUnit) -> None:
    transaction, image = staged(unit, RAISED)
    token = MAKER.sign(challenged(unit, Access.DEALER, image))
    assert respond(unit, transaction, token).status == Status.OK
    assert commit(unit, transaction, image).status == Status.OK
    unit.advance(COMMIT_PAUSE_S)
    lower(unit)
    transaction, image = staged(unit, RAISED)

    assert respond(unit, transaction, token).status == Status.STATE
    challenged(unit, Access.DEALER, image)
    assert respond(unit, transaction, token).status == Status.AUTH_BAD
    assert commit(unit, transaction, image).status == Status.ACCESS


def test_a_token_does_not_outlive_the_power_even_if_the_boot_id_comes_again() -> None:
    bench = BenchUnit()
    provision(bench, MAKER)
    lower(bench)
    transaction, image = staged(bench, RAISED)
    token = MAKER.sign(challenged(bench, Access.DEALER, image))
    assert respond(bench, transaction, token).status == Status.OK

    lib.bench_boot(bench.board, 2)
    bench.advance(COMMIT_PAUSE_S)
    transaction, image = staged(bench, RAISED)
    challenged(bench, Access.DEALER, image)

    assert respond(bench, transaction, token).status == Status.AUTH_BAD


@pytest.mark.parametrize("what", ["uid", "nonce", "level", "image", "key"])
def test_a_token_for_something_else_is_refused(unit: BenchUnit, what: str) -> None:
    transaction, image = staged(unit, RAISED)
    challenge = challenged(unit, Access.DEALER, image)
    other_image = image[:-1] + bytes([image[-1] ^ 1])
    other = {
        "uid": replace(challenge, uid=b"bench-unit-2"),
        "nonce": replace(challenge, nonce=bytes(16)),
        "level": replace(challenge, level=Access.FACTORY),
        "image": replace(challenge, image=other_image),
        "key": challenge,
    }[what]
    maker = Maker(2) if what == "key" else MAKER

    assert respond(unit, transaction, maker.sign(other)).status == Status.AUTH_BAD
    assert commit(unit, transaction, image).status == Status.ACCESS


def test_a_token_cannot_claim_more_time_than_its_challenge_and_its_time_cannot_be_changed(
    unit: BenchUnit,
) -> None:
    transaction, image = staged(unit, RAISED)
    challenge = challenged(unit, Access.DEALER, image)
    longer = MAKER.sign(challenge, challenge.expires_us + 1)
    assert respond(unit, transaction, longer).status == Status.AUTH_BAD
    unit.advance(1.0)
    challenge = challenged(unit, Access.DEALER, image)
    token = MAKER.sign(challenge)

    changed = replace(token, expires_us=token.expires_us - 1)

    assert respond(unit, transaction, changed).status == Status.AUTH_BAD


def test_a_token_ends_with_its_time_and_a_challenge_after_a_minute(unit: BenchUnit) -> None:
    transaction, image = staged(unit, RAISED)
    challenge = challenged(unit, Access.DEALER, image)
    soon = MAKER.sign(challenge, challenge.expires_us - 59_000_000)
    assert respond(unit, transaction, soon).status == Status.OK
    unit.advance(1.0)
    assert commit(unit, transaction, image).status == Status.ACCESS

    late = MAKER.sign(challenged(unit, Access.DEALER, image))
    for _ in range(3):
        unit.advance(20.0)
        unit.ask(CfgValidateRequest(transaction))

    assert respond(unit, transaction, late).status == Status.EXPIRED


def test_a_granted_token_covers_no_other_content(unit: BenchUnit) -> None:
    transaction, image = staged(unit, RAISED)
    token = MAKER.sign(challenged(unit, Access.DEALER, image))
    assert respond(unit, transaction, token).status == Status.OK

    more = unit.stage(transaction, {**RAISED, "motor_torque_nm_max": 2.0})

    assert commit(unit, transaction, more).status == Status.ACCESS


def test_drop_bye_and_a_new_session_take_a_grant_back(unit: BenchUnit) -> None:
    transaction, image = staged(unit, RAISED)
    token = MAKER.sign(challenged(unit, Access.DEALER, image))
    assert respond(unit, transaction, token).status == Status.OK
    assert unit.ask(AuthDropRequest()).status == Status.OK

    assert commit(unit, transaction, image).status == Status.ACCESS
    challenged(unit, Access.DEALER, image)
    unit.hello()
    transaction, image = staged(unit, RAISED)
    assert respond(unit, transaction, token).status == Status.STATE


def test_a_factory_parameter_needs_a_token_of_that_level(unit: BenchUnit) -> None:
    transaction, image = staged(unit, {"gear_ratio": 36.744})
    refused = commit(unit, transaction, image)
    assert (refused.status, refused.detail) == (Status.ACCESS, Access.FACTORY)
    token = MAKER.sign(challenged(unit, Access.DEALER, image))
    assert respond(unit, transaction, token).status == Status.OK
    assert commit(unit, transaction, image).status == Status.ACCESS

    token = MAKER.sign(challenged(unit, Access.FACTORY, image))
    assert respond(unit, transaction, token).status == Status.OK
    assert commit(unit, transaction, image).status == Status.OK

    assert unit.config()["gear_ratio"] == pytest.approx(36.744)


def test_a_slower_market_takes_the_cutoff_as_it_stands_and_the_unit_goes_on() -> None:
    bench = BenchUnit()
    provision(bench, MAKER)
    transaction, image = staged(bench, {"market": "japan"})
    token = MAKER.sign(challenged(bench, Access.FACTORY, image))
    assert respond(bench, transaction, token).status == Status.OK
    assert commit(bench, transaction, image).status == Status.OK
    bench.advance(COMMIT_PAUSE_S)

    bench.boot()
    bench.hello()

    # 25 km/h stays: the law ends assist at 24 by itself, and a market that goes back finds it.
    config = bench.config()
    assert (config["market"], config["assist_cutoff_kmh"]) == ("japan", 25.0)
    assert bench.write({"pedal_stop_ms": 200}).status == Status.OK


def test_no_token_reaches_past_the_absolute_cap(unit: BenchUnit) -> None:
    assert staged_anyhow(unit, {"assist_cutoff_kmh": 25.5}).status == Status.RANGE
    assert staged_anyhow(BenchUnit(), {"battery_current_a_max": 13.0}).status == Status.RANGE


def test_a_level_that_needs_no_token_cannot_be_asked_for(unit: BenchUnit) -> None:
    assert unit.ask(AuthChallengeRequest(Access.RIDER)).status == Status.RANGE
    assert unit.ask(AuthChallengeRequest(7)).status == Status.RANGE


def test_live_values_raise_no_limit_either(unit: BenchUnit) -> None:
    (up,) = set_items({"assist_cutoff_kmh": 24.0})
    (down,) = set_items({"assist_cutoff_kmh": 10.0})
    (back,) = set_items({"assist_cutoff_kmh": 20.0})

    assert unit.ask(LiveSetRequest(10, up)).status == Status.ACCESS
    assert unit.ask(LiveSetRequest(10, down)).status == Status.OK
    assert unit.ask(LiveSetRequest(10, back)).status == Status.OK


def test_nothing_is_spent_before_the_change_is_valid_and_the_bike_stands(unit: BenchUnit) -> None:
    transaction, image = staged(unit, RAISED)
    token = MAKER.sign(challenged(unit, Access.DEALER, image))
    (item,) = set_items(RAISED)
    unit.ask(CfgSetRequest(transaction, item))
    assert respond(unit, transaction, token).status == Status.STATE
    unit.ask(CfgValidateRequest(transaction))
    for moving in ({"speed_kmh": 12.0}, {"motor_speed_rpm": 400.0}, {"speed_kmh": math.nan}):
        unit.inputs(**{"speed_kmh": 0.0, "motor_speed_rpm": 0.0, **moving})
        steps_before = lib.bench_flash_steps(unit.board)
        assert respond(unit, transaction, token).status == Status.NOT_STOPPED
        assert lib.bench_flash_steps(unit.board) == steps_before
    unit.inputs(speed_kmh=0.0, motor_speed_rpm=0.0)

    assert respond(unit, transaction, token).status == Status.OK


def test_a_lost_answer_is_repeated_and_costs_no_second_attempt(unit: BenchUnit) -> None:
    transaction, image = staged(unit, RAISED)
    token = MAKER.sign(challenged(unit, Access.DEALER, image))
    request = AuthResponseRequest(transaction, token.expires_us, token.signature)
    first = unit.ask(request)

    assert unit.ask_again(request) == first
    assert first.status == Status.OK


def test_guessing_is_slowed_to_a_minute_and_a_good_token_ends_it(unit: BenchUnit) -> None:
    transaction, image = staged(unit, RAISED)
    delays = []
    for _ in range(8):
        assert guess(unit, transaction, image) == Status.AUTH_BAD
        delays.append(delay_s(unit))
        for _ in range(delays[-1]):
            assert delay_s(unit) > 0
            unit.advance(1.0)
            unit.ask(CfgValidateRequest(transaction))

    assert delays == [1, 2, 4, 8, 16, 32, 60, 60]
    token = MAKER.sign(challenged(unit, Access.DEALER, image))
    assert respond(unit, transaction, token).status == Status.OK
    assert guess(unit, transaction, image) == Status.AUTH_BAD
    assert delay_s(unit) == 1


def test_restarts_do_not_shorten_the_delay(unit: BenchUnit) -> None:
    transaction, image = staged(unit, RAISED)
    for wait_s in (1, 2, 4):
        assert guess(unit, transaction, image) == Status.AUTH_BAD
        unit.advance(wait_s)
    assert guess(unit, transaction, image) == Status.AUTH_BAD

    for _ in range(3):
        unit.advance(7.0)
        unit.boot()
        assert delay_s(unit) == 8


@pytest.mark.slow
def test_guesses_over_restarts_never_lose_count(unit: BenchUnit) -> None:
    """Over the line; ten thousand past it are in test_app_unlock_numbers."""
    for attempt in range(1, 31):
        transaction, image = staged(unit, RAISED)
        assert guess(unit, transaction, image) == Status.AUTH_BAD
        unit.boot()
        expected = min(60, 2 ** min(attempt - 1, 6))
        assert delay_s(unit) == expected
        unit.advance(expected)


@pytest.mark.parametrize("good", [False, True], ids=["junk", "the maker's"])
def test_power_lost_at_any_byte_of_an_attempt_never_grants_or_forgets_it(good: bool) -> None:
    """Before the record is whole nothing was looked at; after it, the attempt counts."""
    bench = BenchUnit()
    provision(bench, MAKER)
    lower(bench)
    flash = bench.flash().copy()
    looked_at = []
    for steps in range(40):
        bench.flash()[:] = flash
        bench.boot()
        transaction, image = staged(bench, RAISED)
        token = MAKER.sign(challenged(bench, Access.DEALER, image)) if good else JUNK
        if not good:
            challenged(bench, Access.DEALER, image)
        lib.bench_flash_cut_after(bench.board, steps)
        status = respond(bench, transaction, token).status
        cut_commit = commit(bench, transaction, image).status
        bench.boot()

        looked_at.append(status != Status.FLASH_FAIL)
        assert cut_commit != Status.OK
        counted = delay_s(bench) > 0
        # An attempt that was looked at and not proven good is on record.
        assert counted or status in (Status.OK, Status.FLASH_FAIL)
        if status == Status.FLASH_FAIL and steps < 12:
            assert not counted
        if status == Status.FLASH_FAIL and steps >= 12:
            assert counted

    assert not any(looked_at[:12])
    assert looked_at[-1]
