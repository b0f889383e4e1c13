"""Goal: the five mode slots survive the way to the unit and back, and wrong ones are named."""

from typing import Any

import pytest

from backend.domain.assist_mode import AssistModes
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
