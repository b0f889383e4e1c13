"""Goal: a configuration is checked by name, unit and range before anything is sent.

Method: the thesis's own numbers as the factory configuration (table 4-2, eq. 4.16, section 4.10),
then one wrong value at a time, and what a careless caller may hand over.
"""

import json
import struct
from pathlib import Path
from typing import Any

import pytest

from firmware_protocol import parameters
from firmware_protocol._generated import IMAGE_LENGTH, PARAMETER_BY_NAME, PARAMETERS, Violation
from firmware_protocol.generate.parameter_rows import IMAGE_BYTES_MAX

VECTORS = Path(__file__).resolve().parents[3] / "firmware_protocol" / "vectors"


def with_changes(**changes: Any) -> dict[str, Any]:
    return {**parameters.default_config(), **changes}


def test_the_factory_configuration_is_the_thesis_and_nothing_is_wrong_with_it() -> None:
    config = parameters.default_config()

    assert parameters.violations(config) == []
    assert config["gear_ratio"] == 40.34
    assert config["fuzzy_rules"][0] == ["ZO", "ZO", "PS", "PB", "PB"]  # type: ignore[index]


def test_the_image_is_every_parameter_in_the_order_of_its_id_packed() -> None:
    offsets = [row.image_offset for row in sorted(PARAMETERS, key=lambda row: row.id)]
    sizes = [row.size for row in PARAMETERS]

    assert sum(sizes) == IMAGE_LENGTH
    assert offsets == [sum(sizes[:at]) for at in range(len(sizes))]


def test_an_image_reads_back_as_the_numbers_people_typed() -> None:
    config = with_changes(
        sensor_gain_nm_per_count=0.0123, mode_names=["aus", "öko", "a", "", "助力"]
    )

    assert parameters.unpack_image(parameters.pack_image(config)) == config


def test_the_image_of_the_first_version_is_the_start_of_every_later_one() -> None:
    assert PARAMETER_BY_NAME["motor_resistance_ohm"].image_offset + 4 == 299
    assert min(row.image_offset for row in PARAMETERS if row.id >= 0x0600) == 299


def test_a_ride_log_has_room_for_the_whole_configuration() -> None:
    block, header, check, state = 512, 32, 4, 4
    payload, whose, same = block - header - check - state, 28, 4

    assert (payload - whose) + (payload - same) == IMAGE_BYTES_MAX >= IMAGE_LENGTH


def test_two_configurations_share_nothing() -> None:
    first, second = parameters.default_config(), parameters.default_config()

    first["fuzzy_rules"][0][0] = "PB"  # type: ignore[index]

    assert second["fuzzy_rules"][0][0] == "ZO"  # type: ignore[index]


@pytest.mark.parametrize(
    ("changes", "index", "code", "words"),
    [
        ({"assist_cutoff_kmh": 25.1}, 0, "ABOVE_MAX", "must be at most 25 km/h, not 25.1"),
        ({"assist_cutoff_kmh": 25.000002}, 0, "ABOVE_MAX", "at most 25 km/h, not 25.000002"),
        ({"battery_voltage_v_min": 10.0}, 0, "BELOW_MIN", "must be at least 24 V, not 10"),
        ({"torque_filter_s": float("nan")}, 0, "NOT_FINITE", "must be a finite number"),
        ({"pedal_stop_ms": 10**400}, 0, "NOT_FINITE", "must be a finite number"),
        ({"torque_filter_s": -(10**400)}, 0, "NOT_FINITE", "must be a finite number"),
        ({"pedal_stop_ms": 150.5}, 0, "NOT_A_NUMBER", "must be a whole number"),
        ({"pedal_stop_ms": -1}, 0, "BELOW_MIN", "must be at least 50 ms, not -1"),
        ({"cog_teeth": True}, 0, "NOT_A_NUMBER", "must be a number"),
        ({"cog_teeth": None}, 0, "NOT_A_NUMBER", "must be a number"),
        ({"fuzzy_inference": "MAGIC"}, 0, "NOT_A_CHOICE", "mamdani_centroid, weighted_average"),
        ({"fuzzy_inference": 0}, 0, "NOT_A_CHOICE", "must be one of"),
        ({"mode_ratios": [0, 1, 2, 3, 3.5]}, 4, "ABOVE_MAX", "mode_ratios[4] must be at most 3"),
        ({"mode_ratios": [0, 1]}, 0, "WRONG_SHAPE", "must be a list of 5 values"),
        ({"fuzzy_rules": [["ZO"] * 5] * 4}, 0, "WRONG_SHAPE", "must be a list of 5 x 5 values"),
        ({"gear_ratio": [40.34]}, 0, "WRONG_SHAPE", "holds a list where one value belongs"),
        (
            {"fuzzy_rules": [["ZO"] * 5] * 4 + [["ZO", "ZO", "UP", "ZO", "ZO"]]},
            22,
            "NOT_A_CHOICE",
            "fuzzy_rules[4][2] must be one of NB, NS, ZO, PS, PB",
        ),
        (
            {"fuzzy_speed_points_kmh": [5, 10, 10, 20, 25]},
            2,
            "NOT_INCREASING",
            "fuzzy_speed_points_kmh[2] must be at least 0.1 above 10",
        ),
        ({"fuzzy_table_name": "x" * 25}, 0, "TOO_LONG", "at most 24 bytes in UTF-8, not 25"),
        ({"fuzzy_table_name": "a\nb"}, 0, "NOT_TEXT", "control characters"),
        ({"fuzzy_table_name": "\ud800"}, 0, "NOT_TEXT", "UTF-8"),
        ({"fuzzy_table_name": 7}, 0, "NOT_TEXT", "must be a text"),
        ({"fuzzy_table_name": None}, 0, "NOT_TEXT", "must be a text"),
        ({"fuzzy_gain_points": None}, 0, "WRONG_SHAPE", "must be a list of 5 values"),
        ({"fixed_taper_end_kmh": 15.0}, 0, "TAPER_ORDER", "greater than fixed_taper_start_kmh"),
        ({"assist_limit": 3}, 0, "UNKNOWN_PARAMETER", "is not a parameter of this unit"),
    ],
)
def test_a_wrong_value_is_refused_by_name(
    changes: dict[str, Any], index: int, code: str, words: str
) -> None:
    (found,) = parameters.violations(with_changes(**changes))

    assert (found.field, found.index, found.code) == (next(iter(changes)), index, code)
    assert words in found.message


def test_a_configuration_with_a_parameter_left_out_is_not_whole() -> None:
    config = parameters.default_config()
    del config["gear_ratio"]

    (found,) = parameters.violations(config)

    assert (found.field, found.code) == ("gear_ratio", "MISSING_PARAMETER")


def test_a_limit_means_the_number_that_travels() -> None:
    """0.1 as a float32 is a little more than 0.1; that must not refuse the limit itself."""
    gain = struct.unpack("<f", struct.pack("<f", 0.1))[0]

    assert gain > 0.1
    assert parameters.violations(with_changes(sensor_gain_nm_per_count=gain)) == []


@pytest.mark.parametrize(
    "case",
    [
        pytest.param(case, id=case["name"])
        for case in json.loads((VECTORS / "images.json").read_text())["cases"]
        if "NOT_TEXT" not in str(case["violations"])
    ],
)
def test_the_host_names_the_violations_the_golden_images_have(case: dict[str, Any]) -> None:
    image = bytearray(parameters.pack_image(parameters.default_config()))
    for offset, data in case["changes"]:
        image[offset : offset + len(data) // 2] = bytes.fromhex(data)

    found = parameters.violations(parameters.unpack_image(bytes(image)))

    assert [
        [PARAMETER_BY_NAME[v.field].id, v.index, Violation[v.code].name] for v in found
    ] == case["violations"]


def test_changes_travel_as_id_first_index_count_values() -> None:
    (items,) = parameters.set_items({"pedal_stop_ms": 200, "mode_laws": ["off"] * 5})

    assert items.hex(" ") == "02 02 00 05 00 00 00 00 00 06 04 00 01 c8 00"


def test_changes_are_cut_into_messages_that_fit_and_say_the_same() -> None:
    config = parameters.default_config()
    chunks = parameters.set_items(config, length_max=60)

    image = bytearray(IMAGE_LENGTH)
    by_id = {row.id: row for row in PARAMETERS}
    for chunk in chunks:
        at = 0
        while at < len(chunk):
            number, first, count = struct.unpack_from("<HBB", chunk, at)
            row = by_id[number]
            size = count * row.length
            start = row.image_offset + first * row.length
            image[start : start + size] = chunk[at + 4 : at + 4 + size]
            at += 4 + size

    assert max(map(len, chunks)) <= 60
    assert bytes(image) == parameters.pack_image(config)


def test_the_whole_configuration_fits_two_messages() -> None:
    assert len(parameters.set_items(parameters.default_config())) == 2


def test_what_cannot_be_put_into_the_image_is_refused_with_its_violation() -> None:
    with pytest.raises(parameters.BadValue, match="fuzzy_inference must be one of") as refused:
        parameters.set_items({"fuzzy_inference": "MAGIC"})
    assert refused.value.violation.code == "NOT_A_CHOICE"

    with pytest.raises(parameters.BadValue, match="assist_limit is not a parameter"):
        parameters.set_items({"assist_limit": 3})


def test_bytes_of_another_length_are_not_an_image() -> None:
    with pytest.raises(parameters.BadImage, match=f"298 bytes; .* needs {IMAGE_LENGTH}"):
        parameters.unpack_image(bytes(298))
