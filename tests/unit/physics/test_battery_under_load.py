"""Goal: the battery sags, counts and switches off as ten lithium cells and their management do."""

from typing import Any

import pytest
from sim_device.firmware.python._native import ffi, lib


class Battery:
    def __init__(self, **changes: float) -> None:
        bike = ffi.new("physics_config *")
        lib.physics_default(bike)
        self.config: Any = ffi.new("battery_config *", bike.battery)
        for name, value in changes.items():
            setattr(self.config, name, value)
        self.state: Any = ffi.new("battery_state *")
        lib.battery_reset(self.config, self.state)

    def draw(self, power_w: float, seconds: float, fault_cut: int = 0) -> None:
        for _ in range(round(seconds / 0.01)):
            lib.battery_step(self.config, self.state, {"power_w": power_w}, fault_cut, 0.01)


def test_a_full_pack_has_42_v_and_an_empty_one_30() -> None:
    assert lib.battery_open_circuit_v(100.0) == 42.0
    assert lib.battery_open_circuit_v(0.0) == 30.0


def test_twelve_amperes_sag_the_pack_by_two_volts_in_the_end() -> None:
    battery = Battery(capacity_ah=1e6)
    rest_v = battery.state.voltage_v

    battery.draw(12.0 * (rest_v - 2.0), 200.0)

    assert battery.state.current_a == pytest.approx(12.0, rel=0.02)
    assert rest_v - battery.state.voltage_v == pytest.approx(12 * (0.12 + 0.05), rel=0.03)


def test_the_slow_part_of_the_sag_goes_with_its_time_constant() -> None:
    battery = Battery(capacity_ah=1e6)
    battery.draw(400.0, 300.0)
    slow_v = battery.state.polarisation_v

    battery.draw(0.0, 40.0)

    assert battery.state.polarisation_v == pytest.approx(slow_v / 2.71828, rel=0.01)


def test_an_hour_at_one_ampere_takes_one_ampere_hour() -> None:
    battery = Battery(capacity_ah=10.0)
    drawn_ah = 0.0
    before_pct = battery.state.soc_pct

    for _ in range(3600):
        battery.draw(36.0, 0.01)
        lib.battery_step(battery.config, battery.state, {"power_w": 36.0}, 0, 0.99)
        drawn_ah += battery.state.current_a / 3600

    assert before_pct - battery.state.soc_pct == pytest.approx(10.0 * drawn_ah, rel=0.01)


def test_cold_and_empty_cells_resist_more() -> None:
    resistance = lib.battery_resistance_ohm
    warm, cold = Battery(), Battery(temperature_degc=-5.0)

    assert resistance(cold.config, 60.0) == pytest.approx(0.12 * 1.75)
    assert resistance(warm.config, 0.0) == pytest.approx(2 * resistance(warm.config, 60.0))


def test_the_management_opens_on_under_voltage_after_its_delay_and_for_good() -> None:
    battery = Battery(soc_pct_start=2.0, resistance_ohm=0.4)

    battery.draw(250.0, 0.45)
    before = battery.state.cut
    battery.draw(250.0, 0.2)

    assert (before, battery.state.cut) == (0, 1)
    battery.draw(0.0, 60.0)
    assert battery.state.voltage_v == 0.0
    assert battery.state.current_a == 0.0


def test_a_spark_of_current_opens_nothing() -> None:
    battery = Battery(cut_current_a_max=5.0)

    battery.draw(400.0, 0.3)
    battery.draw(0.0, 1.0)
    battery.draw(400.0, 0.3)

    assert battery.state.cut == 0
    battery.draw(400.0, 0.6)
    assert battery.state.cut == 1


def test_a_cut_can_be_ordered() -> None:
    battery = Battery()

    battery.draw(0.0, 0.02, fault_cut=1)

    assert battery.state.voltage_v == 0.0
