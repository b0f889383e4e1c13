"""Goal: what comes with Spindle under a name is what that name promises, and no unit refuses it.

Method: every preset is written into a unit; the thesis's is held against the thesis.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from firmware_protocol._generated import PARAMETERS, Access
from firmware_protocol.configuration_file import TABLE_PARAMETERS, BadConfigurationFile, read
from firmware_protocol.parameters import default_config, unpack_image
from sim_device import preset
from sim_device.configure import read_image, write_config
from sim_device.lockstep import LockstepUnit
from sim_device.preset_unit import parameters_of, preset_unit
from tests.fakes.simulated_unit import new_unit_config

# A bike's own, which no preset may overwrite.
MEASURED = {row.name for row in PARAMETERS if row.record == "CALIBRATION"}


def saved_preset(name: str) -> dict[str, Any]:
    """A preset's file as JSON."""
    path = Path(preset.__file__).parent / "presets" / f"{name}.json"
    saved: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return saved


@pytest.mark.parametrize("name", preset.names())
def test_a_unit_takes_it_and_keeps_its_calibration(name: str) -> None:
    unit = LockstepUnit(1, {"sensor_offset_counts": 12.0})
    # A unit takes one change every two seconds.
    unit.advance(3.0)

    write_config(unit.unit, preset.load(name).values)

    now = unpack_image(read_image(unit.unit))
    assert now["sensor_offset_counts"] == 12.0
    assert not MEASURED & set(preset.load(name).parameters)
    assert {key: now[key] for key in preset.load(name).values} == preset.load(name).values


def test_the_thesis_s_set_says_every_parameter_a_dealer_may_set() -> None:
    tunable = {row.name for row in PARAMETERS if row.access != Access.FACTORY} - MEASURED

    assert set(preset.load("thesis").parameters) == tunable


def test_the_thesis_s_set_is_the_thesis_s() -> None:
    values = preset.load("thesis").values

    # Table 4-2 with its lost cell as the prose has it; limits of table 2-1; hard cut at 25 km/h.
    assert values["fuzzy_rules"][0] == ["ZO", "ZO", "PS", "PB", "PB"]
    assert values["fuzzy_rules"][-1] == ["NB", "NB", "NS", "NS", "NS"]
    assert values["fuzzy_speed_points_kmh"] == [5, 10, 15, 20, 25]
    assert (values["fixed_taper_start_kmh"], values["fixed_taper_end_kmh"]) == (15, 24)
    assert (values["motor_torque_nm_max"], values["battery_current_a_max"]) == (2.0, 12.0)
    assert (values["assist_cutoff_kmh"], values["assist_cutoff_band_kmh"]) == (25, 0)


def test_a_table_is_the_factory_s_unit_with_another_table() -> None:
    table = preset.load("even").values

    assert set(table) == set(TABLE_PARAMETERS)
    assert parameters_of("even") == default_config() | table
    made = preset_unit("even", 1, {"torque_filter_s": 0.7}).unit
    told = new_unit_config() | table | {"torque_filter_s": 0.7}
    assert unpack_image(read_image(made)) == told


def test_the_thesis_s_table_is_that_of_its_configuration() -> None:
    of_configuration = preset.load("thesis").values

    table = preset.load("thesis-table").values
    rescaled = preset.load("thesis-rescaled").values

    assert table == {name: of_configuration[name] for name in TABLE_PARAMETERS}
    assert {name for name in table if table[name] != rescaled[name]} == {
        "fuzzy_table_name",
        "fuzzy_torque_rate_points",
    }


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"motor_torque_nm_max": {"value": 1.0, "unit": "Nm"}}, "motor_torque_nm_max is no part"),
        ({"second_rules": {"value": [], "unit": ""}}, "second_rules is no part"),
        ({"fuzzy_rules": None}, "a table without fuzzy_rules"),
    ],
)
def test_a_table_s_file_holds_one_table_and_nothing_else(
    change: dict[str, object], says: str
) -> None:
    saved = saved_preset("even")
    whole = {**saved["parameters"], **change}
    saved["parameters"] = {name: entry for name, entry in whole.items() if entry is not None}

    with pytest.raises(BadConfigurationFile, match=says):
        read(saved)


def test_the_thesis_s_unit_assists_to_25_kmh_and_not_beyond() -> None:
    unit = preset_unit("thesis", 1, {})
    unit.select_mode(3)
    unit.road(grade_deg=-1.0)
    unit.place(24.0)
    unit.rider("constant", 40.0)
    assisted_kmh = []
    for _ in range(2000):
        unit.advance(0.01)
        if unit.observe()["motor_demand_nm"] > 0.0:
            assisted_kmh.append(unit.observe()["speed_kmh"])

    # The reading of an accelerating wheel lags by a few control steps.
    assert 25.0 <= max(assisted_kmh) < 25.15


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"format": "other"}, "no `format`"),
        ({"version": 3}, "version 3"),
        ({"name": None}, "`name` is no text"),
        ({"parameters": []}, "no `parameters`"),
        ({"parameters": {"a": 1}}, "a has no `value`"),
        ({"parameters": {"a": {"value": 1}}}, "unit or comment of its parameter a"),
        ({"parameters": {"a": {"value": 1, "unit": "", "min": 0}}}, "unknown 'min'"),
    ],
)
def test_a_file_that_is_none_says_where(change: dict[str, object], says: str) -> None:
    with pytest.raises(BadConfigurationFile, match=says):
        read(saved_preset("thesis") | change)
