"""Goal: whoever asks the law in Python is refused what the unit would refuse, in the same words.

Method: every parameter of the registry that has a least or a greatest value is set to it and to the
next number beyond it. The unit's own C check of an image has the verdict; the law's Python door
must have the same, and name the parameter as the host's check does.
"""

from typing import Any

import numpy as np
import pytest

from firmware_protocol._generated import PARAMETERS
from firmware_protocol.layout import Parameter
from firmware_protocol.parameters import default_config, pack_image, violations
from sim_device.firmware.python import wire
from sim_device.firmware.python.law import AssistLaw, LawRefused, gain_points

BOUNDED = [row for row in PARAMETERS if row.min is not None and row.max is not None]
LARGEST = {"u8": 255, "u16": 65535, "u32": 4294967295}


def beside(row: Parameter) -> list[float | int]:
    """The least and the greatest value, and what of the next ones beyond travels at all."""
    assert row.min is not None
    assert row.max is not None
    if row.type == "f32":
        low, high = np.float32(row.min), np.float32(row.max)
        beyond = np.nextafter(low, np.float32(-np.inf)), np.nextafter(high, np.float32(np.inf))
        return [float(number) for number in (low, high, *beyond)]
    low_number, high_number = int(row.min), int(row.max)
    numbers = (low_number, high_number, low_number - 1, high_number + 1)
    return [number for number in numbers if 0 <= number <= LARGEST[row.type]]


def shaped(shape: tuple[int, ...], default: Any, value: float) -> Any:
    """The default with its first element replaced: the others keep what the unit takes."""
    if not shape:
        return value
    return [shaped(shape[1:], default[0], value), *default[1:]]


def configs(row: Parameter) -> list[dict[str, Any]]:
    default = default_config()
    return [
        {**default, row.name: shaped(row.shape, default[row.name], value)} for value in beside(row)
    ]


@pytest.mark.parametrize("row", BOUNDED, ids=lambda row: row.name)
def test_the_law_takes_what_the_unit_takes_and_refuses_the_rest(row: Parameter) -> None:
    for config in configs(row):
        refused_by_unit = wire.image_violations(pack_image(config)) != []
        words = [found.message for found in violations(config)]

        if refused_by_unit:
            with pytest.raises(LawRefused) as refusal:
                AssistLaw(config)
            assert str(refusal.value) == f"configuration: {' '.join(words)}"
        else:
            AssistLaw(config)
            assert words == []


def test_every_bounded_parameter_has_a_value_that_is_refused() -> None:
    refused = {
        row.name
        for row in BOUNDED
        if any(wire.image_violations(pack_image(config)) for config in configs(row))
    }

    # What fills its whole type has nothing beyond.
    filled = {row.name for row in BOUNDED if len(beside(row)) == 2}
    assert refused == {row.name for row in BOUNDED} - filled


def test_a_cutoff_band_of_six_kilometres_an_hour_is_refused_with_its_limit() -> None:
    with pytest.raises(LawRefused, match="assist_cutoff_band_kmh must be at most 5 km/h, not 6"):
        AssistLaw({**default_config(), "assist_cutoff_band_kmh": 6.0})


def test_a_table_alone_is_refused_in_the_same_words() -> None:
    table = {**default_config(), "fuzzy_gain_points": [0.1, 0.2, 0.3, 0.4, 0.6]}

    with pytest.raises(
        LawRefused, match=r"fuzzy table: fuzzy_gain_points\[4\] must be at most 0.5"
    ):
        gain_points(table, [5.0], [0.0])


def test_a_name_the_registry_does_not_have_is_not_looked_at() -> None:
    AssistLaw({**default_config(), "of_another_family": -1.0})
