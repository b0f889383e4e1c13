"""Goal: a physical name tells its unit, and every parameter and channel of the wire agrees."""

import pytest

from backend.core.quantities import plain, unit_of
from firmware_protocol._generated import CHANNELS, PARAMETERS

REGISTRY_SPELLING = {"°C": "degC", "Ω": "ohm"}


@pytest.mark.parametrize(
    ("name", "unit"),
    [
        ("rider_torque_nm", "Nm"),
        ("motor_torque_nm_max", "Nm"),
        ("assist_ramp_up_nm_per_s", "Nm/s"),
        ("sensor_gain_nm_per_count", "Nm/count"),
        ("sensor_offset_counts_per_k", "counts/K"),
        ("sensor_gain_share_per_k", "1/K"),
        ("assist_ratio", ""),
        ("s", ""),
    ],
)
def test_a_name_tells_its_unit(name: str, unit: str) -> None:
    assert unit_of(name) == unit


def test_the_registry_names_its_quantities_from_the_closed_list() -> None:
    rows = [*PARAMETERS, *CHANNELS]

    wrong = {
        row.name: row.unit
        for row in rows
        if (unit := unit_of(row.name)) and REGISTRY_SPELLING.get(unit, unit) != row.unit
    }

    assert wrong == {}


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (1053.2, "1053"),
        (4294967295.0, "4294967295"),
        (12.345, "12.3"),
        (9.999, "10"),
        (-0.0001234, "-0.000123"),
        (1e-9, "0.000000001"),
        (5.0, "5"),
        (0.0, "0"),
    ],
)
def test_a_number_for_people_has_no_exponent(value: float, text: str) -> None:
    assert plain(value, 3) == text
