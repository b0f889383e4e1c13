"""Goal: the typed parts are views of the one configuration: what is written through one is in the
unit, a fault names the view's own field, and each view has every parameter of its groups.

Method: the service with the small honest unit; the registry's groups beside the views' models.
"""

from __future__ import annotations

import pytest
from pydantic import BaseModel

from backend.errors import AccessDenied, InvalidRequest, LimitViolation
from backend.tuning.models.law import Calibration, UnitLimits
from firmware_protocol._generated import PARAMETERS
from firmware_protocol.parameters import default_config, pack_image
from tests.unit.tuning.conftest import Bench

# One parameter of every typed view that is not as the factory set it.
OTHER = {
    "fuzzy_table_name": "another",
    "second_table_name": "another",
    "assist_mode_at_start": 1,
    "torque_filter_s": 0.7,
    "pedal_stop_ms": 200,
}


def test_the_fuzzy_table_is_read_edited_and_written_as_one(bench: Bench) -> None:
    table = bench.tuning.read_part(bench.id, "fuzzy_table").value
    assert table["name"] == "thesis 4-2"
    assert table["inference"] == "mamdani_centroid"
    table["rules"][0][0] = "PB"

    change = bench.tuning.write_part(bench.id, "fuzzy_table", table, "more at the start")

    assert [one.name for one in change.changed] == ["fuzzy_rules"]
    assert bench.tuning.read_part(bench.id, "fuzzy_table").value == table


def test_the_second_table_is_written_beside_the_first(bench: Bench) -> None:
    first = bench.tuning.read_part(bench.id, "fuzzy_table").value
    table = bench.tuning.read_part(bench.id, "second_fuzzy_table").value
    assert table["name"] == "thesis 4-2, smooth"
    table["rules"][0][0] = "PB"
    table["gain_points"][0] = 0.05

    change = bench.tuning.write_part(bench.id, "second_fuzzy_table", table, "")

    assert [one.name for one in change.changed] == ["second_gain_points", "second_rules"]
    assert bench.tuning.read_part(bench.id, "second_fuzzy_table").value == table
    assert bench.tuning.read_part(bench.id, "fuzzy_table").value == first


def test_points_both_tables_share_are_not_changed_by_way_of_the_second(bench: Bench) -> None:
    table = bench.tuning.read_part(bench.id, "second_fuzzy_table").value
    table["speed_points_kmh"][4] = 24.0
    table["rules"][0][0] = "PB"

    with pytest.raises(LimitViolation) as caught:
        bench.tuning.write_part(bench.id, "second_fuzzy_table", table, "")

    assert [(fault.field, fault.code) for fault in caught.value.fields] == [
        ("speed_points_kmh", "shared")
    ]
    assert bench.held == default_config()


def test_a_fault_in_the_second_table_names_the_field_of_the_view(bench: Bench) -> None:
    table = bench.tuning.read_part(bench.id, "second_fuzzy_table").value | {"name": "冬" * 9}

    with pytest.raises(InvalidRequest) as caught:
        bench.tuning.write_part(bench.id, "second_fuzzy_table", table, "")

    assert [fault.field for fault in caught.value.fields] == ["name"]


@pytest.mark.parametrize(("market", "ends_kmh"), [("eu_epac", 25.0), ("japan", 24.0)])
def test_the_limits_say_where_the_market_lets_assist_end(
    bench: Bench, market: str, ends_kmh: float
) -> None:
    bench.unit.image = pack_image(default_config() | {"market": market})

    limits = bench.tuning.read_part(bench.id, "limits").value

    assert (limits["assist_cutoff_kmh"], limits["market"]) == (25.0, market)
    assert limits["effective_assist_cutoff_kmh"] == ends_kmh


def test_what_was_read_as_limits_can_be_written_back_as_it_is(bench: Bench) -> None:
    bench.unit.image = pack_image(default_config() | {"market": "japan"})
    limits = bench.tuning.read_part(bench.id, "limits").value

    change = bench.tuning.write_part(bench.id, "limits", limits | {"pedal_stop_ms": 200}, "")

    assert [one.name for one in change.changed] == ["pedal_stop_ms"]
    assert bench.held == default_config() | {"market": "japan", "pedal_stop_ms": 200}


def test_the_market_is_the_maker_s_and_not_changed_with_the_limits(bench: Bench) -> None:
    limits = bench.tuning.read_part(bench.id, "limits").value

    with pytest.raises(AccessDenied):
        bench.tuning.write_part(bench.id, "limits", limits | {"market": "japan"}, "")

    assert bench.held == default_config()


def test_the_assist_modes_are_five_slots(bench: Bench) -> None:
    modes = bench.tuning.read_part(bench.id, "assist_modes").value
    modes["modes"][1] = {"name": "rain", "law": "fuzzy", "ratio": 0.75}

    bench.tuning.write_part(bench.id, "assist_modes", modes, "")

    assert bench.held["mode_names"] == ["off", "rain", "tour", "sport", "boost"]
    assert bench.held["mode_laws"] == ["off", "fuzzy", "fixed", "fuzzy", "fuzzy"]
    assert bench.held["mode_ratios"] == [0.0, 0.75, 1.0, 1.0, 1.5]


def test_a_fault_in_a_typed_view_names_the_field_of_the_view(bench: Bench) -> None:
    modes = bench.tuning.read_part(bench.id, "assist_modes").value
    modes["modes"][4]["ratio"] = 7.5

    with pytest.raises(LimitViolation) as caught:
        bench.tuning.write_part(bench.id, "assist_modes", modes, "")

    assert [fault.field for fault in caught.value.fields] == ["modes[4].ratio"]


def test_calibration_and_limits_are_views_of_the_same_configuration(bench: Bench) -> None:
    calibration = bench.tuning.read_part(bench.id, "calibration").value | {
        "sensor_offset_counts": 812.0
    }
    limits = bench.tuning.read_part(bench.id, "limits").value | {"assist_cutoff_kmh": 20.0}

    bench.tuning.write_part(bench.id, "calibration", calibration, "new zero")
    change = bench.tuning.write_part(bench.id, "limits", limits, "")

    assert bench.held["sensor_offset_counts"] == 812.0
    assert bench.held["assist_cutoff_kmh"] == 20.0
    assert change.generation == 9


@pytest.mark.parametrize(
    "view", ["fuzzy_table", "second_fuzzy_table", "assist_modes", "calibration", "limits"]
)
def test_a_typed_view_can_be_tried_like_any_other_change(bench: Bench, view: str) -> None:
    value = bench.tuning.read_part(bench.id, view).value
    bench.unit.image = pack_image(default_config() | OTHER)

    change = bench.tuning.write_part(bench.id, view, value, "try", None, 30)

    assert change.changed
    assert change.state == "provisional"
    assert change.expires_at is not None


@pytest.mark.parametrize(
    ("groups", "model"), [({"sensor"}, Calibration), ({"limits", "market"}, UnitLimits)]
)
def test_every_parameter_of_the_part_has_a_field(groups: set[str], model: type[BaseModel]) -> None:
    names = {row.name for row in PARAMETERS if row.group in groups}

    missing = sorted(names - model.model_fields.keys())

    assert missing == [], f"backend/tuning/models/law.py: {model.__name__} lacks {missing}"
