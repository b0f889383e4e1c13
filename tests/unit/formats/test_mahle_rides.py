"""Goal: a ride of Mahle's My SmartBike is read as its JSON says it, in the units its own totals
prove; damage costs the points it hit; a hostile document costs nothing but itself.

Method: files made here; Python's own json is the other reader. Damage is done to every place of a
small file.
"""

from __future__ import annotations

import json
from datetime import UTC, datetime

import pytest

from backend.formats.formats import SNIFFED_BYTES, read_file, refused_by_head
from backend.formats.outcome import COMPLETE, PARTIAL, REJECTED, ImportedRide
from backend.formats.questions import TableAnswer
from tests.fakes.kept_rides import values_of
from tests.fakes.mahle_file import AHEAD, EVERY_S, STARTED, mahle_file, mahle_ride

RIDE = mahle_ride()
FILE = mahle_file(RIDE)
SMALL = mahle_file(mahle_ride(12))


def only_ride(file: bytes, answer: TableAnswer | None = None) -> ImportedRide:
    outcome = read_file("ride.json", file, answer)
    assert outcome.state == COMPLETE, outcome.detail
    (ride,) = outcome.rides
    return ride


def rows_of(ride: ImportedRide) -> list[tuple[float, ...]]:
    """Every row as its moment and its values."""
    moments = (ride.started_us + ride.rows.times_us).tolist()
    columns = [values_of(ride, channel.name).tolist() for channel in ride.rows.channels]
    return list(zip(moments, *columns, strict=True))


def test_every_value_is_what_json_reads() -> None:
    ride = only_ride(FILE)

    points = json.loads(FILE)["locations"]
    moments = [datetime.fromisoformat(p["ts"]).replace(tzinfo=UTC) - AHEAD for p in points]
    assert (ride.started_us + ride.rows.times_us).tolist() == [
        round(moment.timestamp() * 1e6) for moment in moments
    ]
    for name, key in (
        ("latitude_deg", "la"),
        ("longitude_deg", "lo"),
        ("altitude_m", "ge"),
        ("distance_m", "gd"),
        ("grade_pct", "sl"),
        ("speed_kmh", "sp"),
        ("cadence_rpm", "cp"),
        ("rider_power_w", "rw"),
        ("motor_power_w", "mw"),
        ("motor_temperature_degc", "tm"),
        ("assist_mode", "al"),
        ("or", "or"),
    ):
        assert values_of(ride, name) == pytest.approx([p[key] for p in points], abs=1e-9), name
    for name, key in (
        ("battery_soc_pct", "sc"),
        ("battery_voltage_v", "vl"),
        ("battery_current_a", "po"),
        ("battery_temperature_degc", "tm"),
        ("battery_left_wh", "cc"),
        ("bt_bc", "bc"),
    ):
        theirs = [p["bt"][0][key] for p in points]
        assert values_of(ride, name) == pytest.approx(theirs, abs=1e-9), name


def test_what_proves_no_unit_has_none_and_what_is_text_is_listed() -> None:
    ride = only_ride(FILE)

    units = {channel.name: channel.unit for channel in ride.rows.channels}
    assert (units["or"], units["bt_bc"], units["battery_left_wh"]) == ("", "", "Wh")
    assert ride.intake is not None
    assert set(ride.intake.fields_unread) == {
        "activity_name",
        "description",
        "activity_visibility",
        "weather",
        "device_uuid",
    }
    assert ride.intake.rows_kept == len(RIDE["locations"])


def test_totals_are_what_the_app_stated_and_stand_beside_ours() -> None:
    (statement,) = only_ride(FILE).metadata.statements

    told = {figure.name: (figure.value, figure.unit) for figure in statement.figures}
    assert told["consumed_capacity"] == (5.5, "Wh")
    assert told["total_distance"] == (RIDE["total_distance"], "m")
    assert told["max_torque"] == (1023.0, "")
    # Null is nothing stated.
    assert "calories" not in told


def test_a_pause_is_from_the_point_that_tells_it_to_the_next() -> None:
    (pause,) = only_ride(FILE).metadata.pauses

    at = len(RIDE["locations"]) // 2
    assert (pause.from_s, pause.to_s) == (EVERY_S * at, EVERY_S * (at + 1))


def test_the_zone_is_the_difference_of_the_files_two_clocks() -> None:
    ride = only_ride(FILE)

    assert ride.started_us / 1e6 == pytest.approx(STARTED.timestamp() + 1.28)
    assert ride.intake is not None
    assert ride.intake.taken_as == {"clock": "UTC+02:00"}


@pytest.mark.parametrize(
    "members",
    [
        {"start_date": None},
        # Neither hours nor quarters apart from the points.
        {"start_date": "2024-07-24 15:28:43"},
        # The clocks are an hour further apart at the end than at the beginning.
        {"stop_date": "2024-07-24 14:48:59"},
    ],
    ids=["no start", "a clock that is wrong", "summer time"],
)
def test_where_the_clocks_tell_no_zone_it_is_asked(members: dict[str, str | None]) -> None:
    file = mahle_file(mahle_ride(**members))

    asked = read_file("ride.json", file)
    ride = only_ride(file, TableAnswer("Europe/Berlin"))

    assert asked.code == "needs_mapping"
    assert asked.question is not None
    assert asked.question.time_zone
    assert ride.started_us / 1e6 == pytest.approx(STARTED.timestamp() + 1.28)
    assert ride.intake is not None
    assert ride.intake.taken_as == {"time_zone": "Europe/Berlin"}


def test_a_file_cut_anywhere_keeps_whole_points_and_no_other() -> None:
    whole = rows_of(only_ride(SMALL))
    first = SMALL.index(b'"ts"') + 60

    for length in range(first, len(SMALL) - 1, 3):
        outcome = read_file("ride.json", SMALL[:length])
        assert outcome.state == PARTIAL, length
        assert outcome.code == "truncated", (length, outcome.detail)
        (ride,) = outcome.rides
        points = SMALL[:length].count(b'"ts"')
        rows = rows_of(ride)
        assert rows == whole[: len(rows)], length
        # The last time may be there while its point is not closed.
        assert len(rows) in (points - 1, points), length


def test_damage_costs_the_points_it_hit() -> None:
    whole = rows_of(only_ride(SMALL))
    begins = SMALL.index(b'"locations"')

    for at in range(begins + 20, len(SMALL) - 200, 7):
        damaged = SMALL[:at] + b"\x00" * 5 + SMALL[at + 5 :]
        outcome = read_file("ride.json", damaged)
        (ride,) = outcome.rides
        rows = rows_of(ride)
        assert (outcome.state, outcome.code) == (PARTIAL, "damaged"), at
        assert len(rows) >= len(whole) - 2, at
        assert set(rows) <= set(whole), at


def test_a_battery_within_a_cut_point_is_no_point() -> None:
    closed = SMALL.rindex(b"}", 0, SMALL.rindex(b'"cp"')) + 1

    outcome = read_file("ride.json", SMALL[:closed])

    (ride,) = outcome.rides
    assert len(ride.rows.times_us) == 11


@pytest.mark.parametrize(
    "hostile",
    [
        b"[" * 3_000_000,
        b'{"a":' * 500_000,
        b'"' + b"x" * 3_000_000,
        b"9" * 3_000_000,
        b'{"al":' * 500_000,
        b'{"ts":' * 500_000,
    ],
    ids=["lists", "objects", "text", "digits", "points", "times"],
)
def test_a_hostile_value_is_passed_over(hostile: bytes) -> None:
    head, tail = FILE.split(b'"locations"', 1)
    before = head + b'"trap": ' + hostile + b', "locations"' + tail
    whole = rows_of(only_ride(FILE))

    for file in (before, FILE[:-3] + b', "trap": ' + hostile):
        outcome = read_file("ride.json", file)

        # Behind a trap before them the points may be out of reach; none of them is another.
        assert outcome.state in (PARTIAL, REJECTED)
        for ride in outcome.rides:
            assert set(rows_of(ride)) <= set(whole)
    assert outcome.state == PARTIAL


def test_the_head_alone_tells_the_format() -> None:
    assert refused_by_head("ride.json", FILE[:SNIFFED_BYTES]) is None

    other = refused_by_head("ride.json", b'{"type": "FeatureCollection", "locations": []}')
    assert other is not None
    assert other.code == "unsupported_format"
    assert "a JSON document" in (other.detail or "")
