"""Goal: the options of `spindle ride import` answer for a table, with what was said before; what
they lack is named as the option that says it.

Method: questions as the server asks them, no server.
"""

from __future__ import annotations

from argparse import ArgumentTypeError
from typing import Any

import pytest

from backend.cli.parser import build_parser
from backend.cli.table_answer import answer_of, column_meaning

SPEEDS = ["km/h", "m/s", "mph"]
POWERS = ["rider_power_w", "motor_power_w", "battery_power_w"]


def column(name: str, channel: str | None = None, **more: Any) -> dict[str, Any]:
    return {"name": name, "channel": channel, "unit": None, "units": [], "channels": []} | more


def question(*columns: dict[str, Any], **more: Any) -> dict[str, Any]:
    asks = {"time_zone": False, "rows_per_second": False, "date_order": False, "answer": None}
    offered = [{"name": "speed_kmh", "units": SPEEDS}, {"name": POWERS[0], "units": []}]
    return asks | {"columns": columns, "offered_channels": offered} | more


def answer(asked: dict[str, Any], *words: str) -> tuple[dict[str, Any], list[str]]:
    return answer_of(build_parser().parse_args(["ride", "import", "a.csv", *words]), asked)


def test_a_name_may_hold_the_sign_and_none_leaves_a_column_out() -> None:
    assert column_meaning("v=1=speed_kmh") == ("v=1", "speed_kmh")
    assert column_meaning("lamp=none") == ("lamp", "")
    for wrong in ("lamp", "=speed_kmh", "lamp="):
        with pytest.raises(ArgumentTypeError):
            column_meaning(wrong)


def test_each_thing_that_is_asked_has_its_option() -> None:
    power = column("watts", POWERS[0], channels=[*POWERS, ""])
    asked = question(column("v", "speed_kmh", units=SPEEDS), power, date_order=True)

    _, lacks = answer(asked)
    whole, nothing = answer(
        asked, "--speed-unit", "mph", "--dates", "day_first", "--column", "watts=none"
    )

    assert [lack.split(" ")[0] for lack in lacks] == ["--speed-unit", "--column", "--dates"]
    assert nothing == []
    assert whole["units"] == {"v": "mph"}
    assert (whole["channels"], whole["date_order"]) == ({"watts": ""}, "day_first")


def test_a_column_that_becomes_a_speed_needs_a_unit_unless_the_table_says_it() -> None:
    asked = question(column("v"), column("w (mph)", unit="mph"))

    _, lacks = answer(asked, "--column", "v=speed_kmh")
    whole, nothing = answer(asked, "--column", "w (mph)=speed_kmh")

    assert lacks == ["--speed-unit (km/h, m/s, mph) of v"]
    assert (whole["units"], nothing) == ({"w (mph)": "mph"}, [])


def test_what_is_left_out_needs_no_unit_and_other_tables_columns_are_not_sent() -> None:
    asked = question(column("v", "speed_kmh", units=SPEEDS))

    whole, lacks = answer(asked, "--column", "v=none", "--column", "other=speed_kmh")

    assert (whole["channels"], whole["units"], lacks) == ({"v": ""}, {}, [])


def test_what_was_said_before_counts() -> None:
    before = {"time_zone": "UTC", "units": {"v": "m/s"}, "channels": {"watts": POWERS[1]}}
    power = column("power", POWERS[0], channels=[*POWERS, ""])
    asked = question(column("v", "speed_kmh", units=SPEEDS), power, time_zone=True, answer=before)

    whole, lacks = answer(asked, "--column", f"power={POWERS[2]}")

    assert lacks == []
    assert (whole["time_zone"], whole["units"]) == ("UTC", {"v": "m/s"})
    assert whole["channels"] == {"watts": POWERS[1], "power": POWERS[2]}
