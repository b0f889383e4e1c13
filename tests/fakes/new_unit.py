"""What a unit holds that was never tuned: the registry's defaults, and the factory's sensor."""

from __future__ import annotations

from firmware_protocol.layout import Value
from firmware_protocol.parameters import default_config

SENSOR_AS_DRAWN: dict[str, Value] = {
    # 0.02 Nm/K and 0.02 %/K of thesis_checks 6, at 0.01 Nm a count: what a factory knows of it.
    "sensor_offset_counts_per_k": 2.0,
    "sensor_gain_share_per_k": -2e-4,
    "sensor_reference_degc": 20.0,
}


def new_unit_config() -> dict[str, Value]:
    """Every parameter of a simulated unit as it leaves the factory."""
    return default_config() | SENSOR_AS_DRAWN
