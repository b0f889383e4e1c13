"""What each value of a simulated bike can be: physical sense, and no division by zero.

Wide on purpose: a strange bike may be simulated, an impossible one would answer with numbers that
are none. Names are `part.value` as in sim_device/physics/*.h.
"""

from collections.abc import Mapping

from sim_device.scenario_phase import ScenarioError, Setting, Value

_ANY = (0.0, 1e9)
_SHARE = (0.0, 1.0)
_DEGC = (-60.0, 200.0)
_SWITCHES = ("road.source", "road.dyno_convention", "drivetrain.literal_4_14", "motor.model")
_ADC_BITS = (8.0, 10.0, 12.0, 14.0, 16.0)

# The least that is not none: what is divided by.
_RANGES: dict[str, tuple[float, float]] = {
    "road.mass_kg": (1.0, 1e9),
    "road.wheel_inertia_kg_m2": (0.0, 100.0),
    "road.wheel_radius_m": (0.05, 2.0),
    "road.rolling_coefficient": _SHARE,
    "road.drag_area_m2": (0.0, 10.0),
    "road.air_density_kg_m3": (0.0, 10.0),
    "road.gravity_m_s2": (0.0, 30.0),
    "road.brake_force_n": _ANY,
    "road.dyno_roller_radius_m": (0.01, 10.0),
    "road.flywheel_kg_m2": _ANY,
    "road.rollers_kg_m2": _ANY,
    "road.dyno_mass_kg": _ANY,
    "road.roller_coefficient": _SHARE,
    "road.grip": (0.0, 2.0),
    "road.rear_wheel_share": (0.01, 1.0),
    "drivetrain.gear_ratio": (0.1, 1000.0),
    "drivetrain.chainring_teeth": (1.0, 200.0),
    "drivetrain.cog_teeth": (1.0, 200.0),
    "drivetrain.gear_efficiency": (0.01, 1.0),
    "drivetrain.gear_drag_nm": (0.0, 10.0),
    "drivetrain.chain_efficiency": (0.01, 1.0),
    "drivetrain.chain_drag_nm": (0.0, 100.0),
    "drivetrain.crank_inertia_kg_m2": (1e-4, 10.0),
    **{f"gears.cog_teeth_{n}": (0.0, 60.0) for n in range(1, 15)},
    "gears.cadence_rpm": (1.0, 250.0),
    "gears.hysteresis_rpm": (1.0, 250.0),
    "gears.shift_s": (0.0, 10.0),
    "gears.shift_torque_share": _SHARE,
    "motor.torque_constant_nm_per_a": (1e-3, 10.0),
    "motor.resistance_ohm": (1e-3, 100.0),
    "motor.winding_share": _SHARE,
    # More, and the coldest winding would have none.
    "motor.resistance_share_per_k": (0.0, 0.01),
    "motor.friction_nm_s": (0.0, 1.0),
    "motor.hysteresis_nm": (0.0, 10.0),
    "motor.inertia_kg_m2": (1e-6, 10.0),
    "motor.torque_nm_max": (0.0, 1000.0),
    "motor.speed_rpm_max": (0.0, 1e5),
    "motor.inductance_h": (1e-6, 0.1),
    "motor.pole_pairs": (1.0, 100.0),
    "motor.current_bandwidth_hz": (1.0, 2000.0),
    # Smaller, and a step of a millisecond would cool it by more than it is warm.
    "motor.winding_heat_j_per_k": (1.0, 1e6),
    "motor.housing_heat_j_per_k": (1.0, 1e6),
    "motor.bridge_heat_j_per_k": (1.0, 1e6),
    "motor.winding_k_per_w": (0.1, 1000.0),
    "motor.housing_k_per_w": (0.1, 1000.0),
    "motor.bridge_k_per_w": (0.1, 1000.0),
    "motor.ambient_degc": _DEGC,
    "motor.switching_share": (0.0, 0.1),
    "motor.standby_current_a": (0.0, 2.0),
    "battery.capacity_ah": (1e-3, 1000.0),
    "battery.resistance_ohm": (1e-3, 100.0),
    "battery.polarisation_ohm": (0.0, 100.0),
    "battery.polarisation_s": (0.01, 1e5),
    "battery.resistance_share_per_k_cold": _SHARE,
    "battery.soc_pct_start": (0.0, 100.0),
    "battery.temperature_degc": _DEGC,
    "battery.cut_voltage_v_min": (0.0, 100.0),
    "battery.cut_current_a_max": (0.0, 1e4),
    "battery.cut_after_s": (0.0, 1e5),
    "rider.stroke_ripple": _SHARE,
    "rider.dead_spot_deg": (-360.0, 360.0),
    "rider.asymmetry": (-1.0, 1.0),
    "rider.stroke_noise": _SHARE,
    "rider.still_leg_drag_nm": (0.0, 1000.0),
    "rider.torque_nm_max": (0.0, 1000.0),
    "rider.cadence_rpm_empty": (1.0, 1000.0),
    "rider.critical_power_w": (0.0, 2000.0),
    "rider.reserve_j": (1.0, 1e6),
    "rider.peak_power_w": (0.0, 5000.0),
    "sensor.shaft_diameter_m": (1e-3, 0.2),
    "sensor.bore_diameter_m": (0.0, 0.2),
    "sensor.elastic_modulus_pa": (1e8, 1e13),
    "sensor.poisson_ratio": (0.0, 0.5),
    "sensor.gauge_factor": (0.1, 500.0),
    "sensor.bridge_v": (0.1, 50.0),
    "sensor.amplifier_gain": (1.0, 1e5),
    "sensor.zero_v": (0.0, 50.0),
    "sensor.converter_v": (0.1, 50.0),
    "sensor.nm_per_count": (1e-4, 1.0),
    "sensor.zero_counts": (-32767.0, 32767.0),
    "sensor.gain": (0.01, 100.0),
    "sensor.noise_nm": (0.0, 100.0),
    "sensor.bending_share": (-1.0, 1.0),
    "sensor.bending_lever_m": (0.0, 1.0),
    "sensor.bending_deg": (-360.0, 360.0),
    "sensor.side_share": (-1.0, 1.0),
    "sensor.hysteresis_nm": (0.0, 100.0),
    "sensor.creep_share": (-1.0, 1.0),
    "sensor.creep_s": (0.01, 1e6),
    "sensor.ambient_degc": _DEGC,
    "sensor.board_soak_s": (0.0, 1e6),
    "sensor.gauge_soak_s": (0.0, 1e6),
    "sensor.reference_degc": _DEGC,
    "sensor.zero_nm_per_k": (-10.0, 10.0),
    "sensor.span_share_per_k": (-0.1, 0.1),
    "sensor.fault_drift_nm_per_min": (-1000.0, 1000.0),
    # More than this and a pulse could come before the one ahead of it.
    "wheel.jitter_share": (0.0, 0.08),
    "link.bit_error_rate": (0.0, 0.5),
    "link.burst_bit_error_rate": (0.0, 0.5),
    "link.burst_share": _SHARE,
    "link.burst_words": (1.0, 1e6),
    "link.burst_angle_deg": (0.0, 360.0),
    "link.coupling": _SHARE,
    "link.coupling_min": _SHARE,
    "link.restart_s": (0.0, 1e5),
}

BIKE_VALUES: dict[str, Setting] = {
    **{name: Setting(0.0, choices=(0.0, 1.0)) for name in _SWITCHES},
    "wheel.pulses_per_turn": Setting(36.0, choices=tuple(float(n) for n in range(1, 101))),
    "sensor.adc_bits": Setting(16.0, choices=_ADC_BITS),
    **{name: Setting(low, min=low, max=high) for name, (low, high) in _RANGES.items()},
}


def read_bike_value(where: str, name: str, given: object) -> float:
    """`given` as this value of the bike. Raises ScenarioError with `where` and what is allowed."""
    value: Value = BIKE_VALUES[name].read(where, given)
    return float(value)


def read_bike(given: Mapping[str, object]) -> dict[str, float]:
    """`part.value` -> number, all checked. Raises ScenarioError, also for what no bike has."""
    unknown = sorted(set(given) - set(BIKE_VALUES))
    if unknown:
        known = ", ".join(sorted(BIKE_VALUES))
        raise ScenarioError(f"the bike has no {', '.join(unknown)}; it has: {known}")
    return {name: read_bike_value(f"bike: {name}", name, value) for name, value in given.items()}
