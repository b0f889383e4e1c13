"""Goal: a person who raises a limit is told what is needed, and gets it with the maker's token.

Method: the host's session against the unit's firmware in virtual time.
"""

from __future__ import annotations

import pytest

from backend.device.ebl.operations.config_transaction import read_config, write_config
from backend.errors import AccessDenied, NotStandingStill, TokenNeeded
from firmware_protocol.layout import Value
from firmware_protocol.unlock_token import Token
from sim_device.lockstep import LockstepUnit
from tests.fakes.bench import Bench
from tests.fakes.maker import Maker, challenge_of
from tests.fakes.simulated_unit import LockstepAsUnit

MAKER = Maker()
RAISED: dict[str, Value] = {"assist_cutoff_kmh": 25.0}
LOWERED: dict[str, Value] = {"assist_cutoff_kmh": 20.0}


def lowered(key: bytes | None) -> Bench:
    """A connected unit whose dealer has lowered the cut-off."""
    bench = Bench(LockstepAsUnit(LockstepUnit(unlock_key=key))).connect()
    bench.ask(write_config(bench.ask(read_config()), LOWERED))
    bench.run(2.5)
    return bench


def refusal(bench: Bench, changes: dict[str, Value], token: Token | None = None) -> AccessDenied:
    with pytest.raises(AccessDenied) as caught:
        bench.ask(write_config(bench.ask(read_config()), changes, token=token))
    return caught.value


def test_the_refusal_names_the_limit_and_carries_what_must_be_signed() -> None:
    bench = lowered(MAKER.public_key)
    error = refusal(bench, {**RAISED, "torque_filter_s": 0.4})
    assert isinstance(error, TokenNeeded)
    assert [field.field for field in error.fields] == ["assist_cutoff_kmh"]
    assert "from 20.0 to 25.0 km/h" in error.message

    token = MAKER.sign(challenge_of(error))
    changes: dict[str, Value] = {**RAISED, "torque_filter_s": 0.4}
    bench.ask(write_config(bench.ask(read_config()), changes, token=token))

    assert bench.ask(read_config()).parameters["assist_cutoff_kmh"] == 25.0


def test_a_token_shown_to_a_riding_bike_waits_until_it_stands() -> None:
    unit = LockstepUnit(unlock_key=MAKER.public_key)
    bench = Bench(LockstepAsUnit(unit)).connect()
    bench.ask(write_config(bench.ask(read_config()), LOWERED))
    bench.run(2.5)
    unit.rider("legs", 30.0)
    bench.run(4.0)
    error = refusal(bench, RAISED)
    assert isinstance(error, TokenNeeded)
    token = MAKER.sign(challenge_of(error))

    # Checking a signature takes 1.7 million instructions: at 100 MHz, longer than a control step.
    with pytest.raises(NotStandingStill, match="no token while wheel or motor turn"):
        bench.ask(write_config(bench.ask(read_config()), RAISED, token=token))
    unit.simulation_set({"rider": {"kind": "off"}, "brake": True})
    bench.run(10.0)
    bench.ask(write_config(bench.ask(read_config()), RAISED, token=token))

    assert bench.ask(read_config()).parameters["assist_cutoff_kmh"] == 25.0


def test_a_factory_parameter_is_asked_for_at_the_factory_s_level() -> None:
    bench = lowered(MAKER.public_key)

    error = refusal(bench, {"wheel_pulses_per_turn": 18})
    assert isinstance(error, TokenNeeded)
    assert error.challenge["level"] == "factory"

    token = MAKER.sign(challenge_of(error))
    bench.ask(write_config(bench.ask(read_config()), {"wheel_pulses_per_turn": 18}, token=token))


def test_a_wheel_beyond_its_band_is_named_with_what_may_be_set_and_what_to_do() -> None:
    bench = lowered(MAKER.public_key)

    error = refusal(bench, {"wheel_circumference_m": 1.6, "torque_filter_s": 0.4})

    assert isinstance(error, TokenNeeded)
    assert error.challenge["level"] == "factory"
    assert [(f.field, f.code) for f in error.fields] == [("wheel_circumference_m", "outside_band")]
    assert "from 1.9905131 to 2.156389 it may be set here" in error.message
    assert "within 4 % of the factory's 2.073451" in error.message
    assert "Measure it once more" in error.message


def test_a_unit_without_a_key_says_that_nobody_can() -> None:
    error = refusal(lowered(None), RAISED)

    assert not isinstance(error, TokenNeeded)
    assert "carries no maker's key" in error.message
    assert "assist_cutoff_kmh should go up from 20.0 to 25.0 km/h" in error.message


def test_a_wrong_token_is_refused_and_the_next_one_has_to_wait() -> None:
    bench = lowered(MAKER.public_key)
    error = refusal(bench, RAISED)
    assert isinstance(error, TokenNeeded)
    wrong = Maker(2).sign(challenge_of(error))

    assert refusal(bench, RAISED, wrong).code == "token_refused"
    assert refusal(bench, RAISED).code == "token_delay"
    bench.run(1.1)
    assert refusal(bench, RAISED, wrong).code == "token_expired"
    assert refusal(bench, RAISED).code == "token_needed"
    assert bench.ask(read_config()).parameters["assist_cutoff_kmh"] == 20.0
