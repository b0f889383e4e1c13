"""Goal: what the unit tells of its battery adds up: its current, summed, is the charge that went.

Method: every scenario that is ridden, through the wire to the host's own receiver at 100 rows a
second; the charge is counted by the battery itself, millisecond by millisecond.
"""

import pytest

from sim_device.firmware.python.unit import default_bike
from sim_device.scenario_file import load, names
from spindle.testing import DriveUnit

ROW_S = 0.01
# What a subscription takes, and what its last frame holds back.
FLUSH_S = 0.5
RIDE_S_MAX = 430.0


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in names() if load(name).live])
def test_the_told_current_adds_up_to_the_charge_used(name: str) -> None:
    scenario = load(name)
    capacity_ah = scenario.bike.get("battery.capacity_ah", default_bike()["battery.capacity_ah"])
    unit = DriveUnit(scenario.seed, scenario=name)
    unit.advance(FLUSH_S)  # until the first row has come
    begun_s, begun_pct = unit.t_s, unit.observe()["battery_soc_pct"]

    unit.advance(min(scenario.duration_s_max, RIDE_S_MAX))
    ended_s, ended_pct = unit.t_s, unit.observe()["battery_soc_pct"]
    unit.advance(FLUSH_S)
    told = unit.trace("battery_current_a")

    during = (told["t_s"] > begun_s + ROW_S / 2) & (told["t_s"] < ended_s + ROW_S / 2)
    assert during.sum() == round((ended_s - begun_s) / ROW_S)
    told_ah = told["battery_current_a"][during].sum() * ROW_S / 3600
    used_ah = (begun_pct - ended_pct) / 100 * capacity_ah
    assert used_ah > 0.001
    assert told_ah == pytest.approx(used_ah, rel=0.01)
