"""Goal: what an older unit, backup or server called its wheel is still read, and said.

Method: the circumference of a circle; 0.33 m was the default of the radius.
"""

import math

import pytest

from backend.device.ebl.operations.parameters import TABLE
from firmware_protocol._generated import PARAMETER_BY_ID, PARAMETER_BY_NAME, RETIRED
from firmware_protocol.layout import Value
from firmware_protocol.retired import brought_forward


def test_a_radius_becomes_the_circumference_it_stands_for() -> None:
    found, notes = brought_forward({"wheel_radius_m": 0.35, "cog_teeth": 14})

    assert found == {"wheel_circumference_m": pytest.approx(2 * math.pi * 0.35), "cog_teeth": 14}
    assert notes == ["wheel_radius_m 0.35 is wheel_circumference_m 2.19911 now (times 6.28319)."]


def test_every_radius_a_unit_could_have_is_a_circumference_it_can_have() -> None:
    row = PARAMETER_BY_NAME["wheel_circumference_m"]
    for radius_m in (0.15, 0.33, 0.45):
        found, _ = brought_forward({"wheel_radius_m": radius_m})

        assert row.min is not None
        assert row.max is not None
        assert row.min <= float(str(found["wheel_circumference_m"])) <= row.max


def test_the_name_of_today_wins_over_the_retired_one() -> None:
    config: dict[str, Value] = {"wheel_radius_m": 0.35, "wheel_circumference_m": 2.1}

    assert brought_forward(config) == ({"wheel_circumference_m": 2.1}, [])


def test_what_is_no_number_is_left_out_and_told() -> None:
    found, notes = brought_forward({"wheel_radius_m": "29er"})

    assert found == {}
    assert "wheel_radius_m '29er' is no number" in notes[0]


def test_a_retired_id_is_never_given_again() -> None:
    assert [row.id for row in RETIRED if row.id in PARAMETER_BY_ID] == []


def test_who_writes_the_old_name_is_told_the_new_one() -> None:
    (error,) = TABLE.unknown_names({"wheel_radius_m": 0.33})

    assert "It is wheel_circumference_m now" in error.message
