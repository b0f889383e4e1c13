"""Goal: a ride's motor energy is given to the modes and rules that carried it, and to nobody twice.

Method: a ride row by row in a real store, whose speed and torque rate lie on known cells of the
table, so that each rule's energy is torque x speed x time by hand.
"""

from __future__ import annotations

import numpy as np
import pytest

from backend.errors import InvalidRequest
from backend.rides.insight.ledger import EnergyLedger
from backend.store import Store
from tests.fakes.kept_rides import config_of as nobody_kept
from tests.unit.rides.test_why_a_moment_was_as_it_was import PUSHING, ROWS, config_of, kept

POWER_W = 0.5 * PUSHING["motor_speed_rpm"] * 2.0 * np.pi / 60.0
TOTAL_WH = POWER_W * ROWS * 0.01 / 3600.0


def test_each_mode_and_rule_has_its_own_part(store: Store) -> None:
    # Seven tenths in a fuzzy mode: on the cell of 10 km/h and rate 0, then half way to 15 km/h.
    mode = np.where(np.arange(ROWS) < 700, 3.0, 1.0)
    speed = np.where(np.arange(ROWS) < 400, 10.0, 12.5)
    ride_id = kept(
        store,
        assist_mode=mode,
        speed_kmh=speed,
        torque_rate=np.zeros(ROWS),
        fuzzy_gain=np.where(mode == 3.0, 0.3, np.nan),
    )

    told = EnergyLedger(store, config_of)(ride_id)

    assert told["motor_wh"] == pytest.approx(TOTAL_WH, rel=1e-3)
    assert [(one["mode"], one["name"], one["law"]) for one in told["modes"]] == [
        (1, "eco", "fixed"),
        (3, "sport", "fuzzy"),
    ]
    assert [one["share"] for one in told["modes"]] == pytest.approx([0.3, 0.7])
    assert [(rule["row"], rule["column"], rule["label"]) for rule in told["rules"]] == [
        (1, 0, "ZO"),
        (2, 0, "NS"),
    ]
    assert [rule["share"] for rule in told["rules"]] == pytest.approx([0.55, 0.15])
    assert told["without_rule_wh"] == pytest.approx(0.3 * TOTAL_WH, rel=1e-3)


def test_what_is_not_known_is_null(store: Store) -> None:
    ride_id = kept(store, torque_rate=np.zeros(ROWS), motor_torque_demanded_nm=None)

    asked_only = EnergyLedger(store, config_of)(ride_id)
    by_defaults = EnergyLedger(store, nobody_kept)(ride_id)

    assert (asked_only["motor_wh"], asked_only["rules"]) == (None, None)
    assert asked_only["modes"][0]["motor_wh"] is None
    assert asked_only["motor_excluded_s"] == pytest.approx(ROWS * 0.01)
    assert (by_defaults["rules"], by_defaults["modes"][0]["name"]) == (None, None)
    with pytest.raises(InvalidRequest) as lacking:
        EnergyLedger(store, config_of)(kept(store))
    assert lacking.value.code == "missing_channel"
