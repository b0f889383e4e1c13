"""Goal: the five mode slots survive the way to the unit and back, and wrong ones are named."""

from typing import Any

import pytest

from backend.core.assist_mode import AssistModes
from backend.errors import InvalidRequest
from firmware_protocol.parameters import default_config


def factory_modes() -> dict[str, Any]:
    return AssistModes.from_parameters(default_config()).to_json()


def test_the_factory_modes_come_back_as_they_were() -> None:
    config = default_config()

    modes = AssistModes.from_json(factory_modes())

    assert modes.to_parameters() == {name: config[name] for name in modes.to_parameters()}
    assert [mode.law for mode in modes.modes] == ["off", "fixed", "fixed", "fuzzy", "fuzzy"]


@pytest.mark.parametrize(
    ("slot", "change", "field"),
    [
        (1, {"law": "turbo"}, "modes[1].law"),
        (2, {"ratio": float("inf")}, "modes[2].ratio"),
        (2, {"ratio": "1"}, "modes[2].ratio"),
        (3, {"ratio": -0.1}, "modes[3].ratio"),
        (4, {"name": "a very long name indeed"}, "modes[4].name"),
    ],
)
def test_a_wrong_slot_is_refused_by_name(slot: int, change: dict[str, Any], field: str) -> None:
    modes = factory_modes()
    modes["modes"][slot].update(change)

    with pytest.raises(InvalidRequest) as refused:
        AssistModes.from_json(modes)

    assert [fault.field for fault in refused.value.fields] == [field]


@pytest.mark.parametrize("value", [{}, {"modes": [], "mode_at_start": 0}, {"modes": [{}] * 5}])
def test_anything_but_five_slots_is_refused(value: dict[str, Any]) -> None:
    with pytest.raises(InvalidRequest):
        AssistModes.from_json(value)


def test_what_a_slot_does_not_say_leaves_the_law_as_it_was() -> None:
    first = AssistModes.from_parameters(default_config()).modes[2]

    assert (first.taper, first.table, first.torque_pct) == ("taper_speeds", "first", 100)
    assert (first.ramp_up_nm_per_s, first.ramp_down_nm_per_s) == (2000, 2000)


def test_a_slot_s_taper_table_ramps_and_torque_come_back() -> None:
    value = AssistModes.from_parameters(default_config()).to_json()
    value["modes"][4] |= {
        "taper": "japan_2_to_1",
        "table": "second",
        "ramp_up_nm_per_s": 80,
        "ramp_down_nm_per_s": 300,
        "torque_pct": 60,
    }

    parameters = {**default_config(), **AssistModes.from_json(value).to_parameters()}

    assert parameters["mode_tables"] == [0, 0, 0, 0, 1]
    assert parameters["mode_tapers"][4] == "japan_2_to_1"
    assert AssistModes.from_parameters(parameters).to_json() == value


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("taper", "steep"),
        ("table", "third"),
        ("ramp_up_nm_per_s", 4),
        ("ramp_down_nm_per_s", 2001),
        ("torque_pct", 101),
        ("torque_pct", 50.5),
    ],
)
def test_what_no_slot_can_have_is_refused_by_its_name(field: str, value: object) -> None:
    modes = AssistModes.from_parameters(default_config()).to_json()
    modes["modes"][1][field] = value

    with pytest.raises(InvalidRequest) as refused:
        AssistModes.from_json(modes)

    assert [fault.field for fault in refused.value.fields] == [f"modes[1].{field}"]
