"""Goal: nobody makes a bike read slower or its rider stronger than the factory measured it.

Method: the whole unit on the bench. A dealer's change is committed with what any tool sends; the
numbers at the edges are the issue's: 4 % of the circumference, 15 % of the gain, 5 Nm of the zero,
which are 500 counts of the factory's 0.01 Nm. Tokens come from OpenSSL's Ed25519.
"""

import random

import numpy as np
import pytest

from firmware_protocol import parameters
from firmware_protocol._generated import (
    BAND_BY_NAME,
    BANDS,
    Access,
    LiveSetRequest,
    Status,
)
from firmware_protocol.bands import band_holds, band_limits
from firmware_protocol.layout import Band, Value
from sim_device.firmware.python import wire
from tests import counts
from tests.fakes.bench_unit import BenchUnit
from tests.fakes.maker import Maker, challenged, commit, provision, respond, staged, staged_anyhow

MAKER = Maker()
ROUNDS = counts.of(3000)
CIRCUMFERENCE_M = 2.073451
COMMIT_PAUSE_S = 2.5
FACTORY_NEEDED = (Status.ACCESS, Access.FACTORY)

INSIDE = [
    ("wheel_circumference_m", CIRCUMFERENCE_M * 0.9601),
    ("wheel_circumference_m", CIRCUMFERENCE_M * 1.0399),
    ("sensor_gain_nm_per_count", 0.00851),
    ("sensor_gain_nm_per_count", 0.01149),
    ("sensor_offset_counts", -500.0),
    ("sensor_offset_counts", 500.0),
]
OUTSIDE = [
    ("wheel_circumference_m", CIRCUMFERENCE_M * 0.9599),
    ("wheel_circumference_m", CIRCUMFERENCE_M * 1.0401),
    ("sensor_gain_nm_per_count", 0.02),
    ("sensor_gain_nm_per_count", 0.00849),
    ("sensor_offset_counts", -3000.0),
    ("sensor_offset_counts", 500.1),
]


@pytest.fixture
def unit() -> BenchUnit:
    bench = BenchUnit()
    provision(bench, MAKER)
    return bench


def allowed_by_the_maker(bench: BenchUnit, changes: dict[str, Value]) -> None:
    transaction, image = staged(bench, changes)
    token = MAKER.sign(challenged(bench, Access.FACTORY, image))
    assert respond(bench, transaction, token).status == Status.OK
    assert commit(bench, transaction, image).status == Status.OK
    bench.advance(COMMIT_PAUSE_S)


@pytest.mark.parametrize(("name", "value"), INSIDE)
def test_near_the_factory_s_value_a_dealer_writes_what_was_measured(
    unit: BenchUnit, name: str, value: float
) -> None:
    assert unit.write({name: value}).status == Status.OK

    assert unit.config()[name] == pytest.approx(value)


@pytest.mark.parametrize(("name", "value"), OUTSIDE)
def test_beyond_it_only_the_maker_s_token_of_the_factory_s_level_does(
    unit: BenchUnit, name: str, value: float
) -> None:
    transaction, image = staged(unit, {name: value})
    refused = commit(unit, transaction, image)
    assert (refused.status, refused.detail) == FACTORY_NEEDED
    dealers = MAKER.sign(challenged(unit, Access.DEALER, image))
    assert respond(unit, transaction, dealers).status == Status.OK
    assert commit(unit, transaction, image).status == Status.ACCESS

    token = MAKER.sign(challenged(unit, Access.FACTORY, image))
    assert respond(unit, transaction, token).status == Status.OK
    assert commit(unit, transaction, image).status == Status.OK


@pytest.mark.parametrize(("name", "value"), OUTSIDE)
def test_nor_is_it_tried_on_the_fly(unit: BenchUnit, name: str, value: float) -> None:
    (items,) = parameters.set_items({name: value})
    refused = unit.ask(LiveSetRequest(5, items))

    assert (refused.status, refused.detail) == FACTORY_NEEDED


def test_small_steps_do_not_lead_out_of_the_band(unit: BenchUnit) -> None:
    assert unit.write({"wheel_circumference_m": CIRCUMFERENCE_M * 0.97}).status == Status.OK
    unit.advance(COMMIT_PAUSE_S)

    transaction, image = staged(unit, {"wheel_circumference_m": CIRCUMFERENCE_M * 0.95})

    assert commit(unit, transaction, image).status == Status.ACCESS


def test_what_the_maker_allowed_stays_beside_other_changes_and_comes_back_freely(
    unit: BenchUnit,
) -> None:
    allowed_by_the_maker(unit, {"sensor_gain_nm_per_count": 0.02})

    assert unit.write({"torque_filter_s": 0.4}).status == Status.OK
    unit.advance(COMMIT_PAUSE_S)
    transaction, image = staged(unit, {"sensor_gain_nm_per_count": 0.0199})
    assert commit(unit, transaction, image).status == Status.ACCESS
    unit.advance(COMMIT_PAUSE_S)
    unit.hello()

    assert unit.write({"sensor_gain_nm_per_count": 0.011}).status == Status.OK


def test_a_smaller_gain_does_not_widen_the_zero_s_band(unit: BenchUnit) -> None:
    assert unit.write({"sensor_gain_nm_per_count": 0.0086}).status == Status.OK
    unit.advance(COMMIT_PAUSE_S)

    # 580 counts are 5 Nm by the gain that was set, and 5.8 Nm by the factory's.
    transaction, image = staged(unit, {"sensor_offset_counts": 580.0})

    assert commit(unit, transaction, image).status == Status.ACCESS


@pytest.mark.parametrize("band", BANDS, ids=lambda band: band.parameter)
def test_the_middle_of_a_band_and_the_pulses_are_the_factory_s(band: Band) -> None:
    bench = BenchUnit()
    bench.hello()
    value = float(str(parameters.default_config()[band.around])) + 0.0005

    assert staged_anyhow(bench, {band.around: value}).status == Status.ACCESS
    bench.hello()
    assert staged_anyhow(bench, {"wheel_pulses_per_turn": 18}).status == Status.ACCESS


@pytest.mark.large_count
def test_host_and_unit_draw_the_same_line_to_the_last_bit() -> None:
    draw = random.Random(7)
    for _ in range(ROUNDS):
        band = BANDS[draw.randrange(len(BANDS))]
        config = {
            **parameters.default_config(),
            "wheel_circumference_m_factory": draw.uniform(0.9, 2.9),
            "sensor_gain_nm_per_count_factory": draw.uniform(0.001, 0.1),
            "sensor_offset_counts_factory": draw.uniform(-3000.0, 3000.0),
        }
        # At an edge, or a few steps of float32 beside it.
        value = np.float32(band_limits(band, config)[draw.randrange(2)])
        for _ in range(draw.randrange(4)):
            value = np.nextafter(value, np.float32(draw.choice((-np.inf, np.inf))))
        config[band.parameter] = float(value)

        held = wire.band_holds(BANDS.index(band), parameters.pack_image(config))

        assert held == band_holds(band, config), (band, config)


def test_the_limits_that_are_shown_are_taken_and_nothing_wider_is() -> None:
    config = parameters.default_config()

    for name, low, high in (
        ("wheel_circumference_m", 1.990513, 2.156389),
        ("sensor_gain_nm_per_count", 0.0085, 0.0115),
        ("sensor_offset_counts", -500.0, 500.0),
    ):
        band = BAND_BY_NAME[name]
        limits = band_limits(band, config)
        assert limits == pytest.approx((low, high), rel=1e-6)
        assert all(band_holds(band, {**config, name: limit}) for limit in limits)
