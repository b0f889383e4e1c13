"""Goal: what a mechanic writes is what the unit does.

The whole way is real: HTTP, the reader thread, the protocol, the unit's C. What must not be written
is refused in tests/unit/tuning, and by the firmware in tests/simulation.
Expected gains are the thesis' table 4-2 at its own points, where the centroid is a known number.
"""

from __future__ import annotations

from urllib.parse import quote

import pytest

from tests.fakes.server import SpindleServer


def ride_along(server: SpindleServer, device: str) -> dict[str, float]:
    """A rider pushes steadily in the fuzzy mode, on a flat road; what the unit tells after five
    seconds."""
    server.simulate(
        device,
        brake=False,
        assist_mode=3,
        rider={"kind": "constant", "torque_nm": 20.0, "cadence_rpm_max": 90.0},
        road={"grade_deg": 0.0, "wind_ms": 0.0},
    )
    server.advance(device, 5.0)
    channels: dict[str, float] = server.get(f"/devices/{device}/snapshot")["channels"]
    return channels


def test_a_table_of_one_label_gives_that_gain_on_the_road(
    server: SpindleServer, device: str
) -> None:
    table = server.get(f"/devices/{device}/parts/fuzzy_table")
    table["inference"] = "weighted_average"
    table["rules"] = [["PB"] * 5] * 5
    table["gain_points"] = [0.05, 0.10, 0.15, 0.20, 0.25]
    table["name"] = "always most"

    change = server.ask(
        "PUT", f"/devices/{device}/parts/fuzzy_table", json=table, params={"reason": "a story"}
    )

    assert change["verified"] is True
    assert change["state"] == "committed"
    assert server.get(f"/devices/{device}/parts/fuzzy_table") == table
    assert ride_along(server, device)["fuzzy_gain"] == pytest.approx(0.25, abs=0.001)


def test_the_live_gain_is_the_one_the_surface_promised(server: SpindleServer, device: str) -> None:
    table = server.get(f"/devices/{device}/parts/fuzzy_table")

    now = ride_along(server, device)
    point = [now["speed_kmh"], max(0.0, now["torque_rate"])]
    body = {"fuzzy_table": table, "points": [point]}
    promised = server.ask("POST", "/surface/points", json=body)["gain"][0]

    # Counts of the wire: 0.01 km/h and 0.0005 in rate; the surface's steepest slope is 0.44.
    assert now["fuzzy_gain"] == pytest.approx(promised, abs=0.002)


def test_raw_counts_become_newton_metres_by_the_calibration_that_was_written(
    server: SpindleServer, device: str
) -> None:
    calibration = server.get(f"/devices/{device}/parts/calibration")
    calibration["sensor_gain_nm_per_count"] *= 1.1
    calibration["sensor_offset_counts"] += 100.0

    server.ask("PUT", f"/devices/{device}/parts/calibration", json=calibration)
    server.advance(device, 1.0)
    now = server.get(f"/devices/{device}/snapshot")["channels"]

    gain, offset = calibration["sensor_gain_nm_per_count"], calibration["sensor_offset_counts"]
    expected_nm = gain * (now["rider_torque_raw"] - offset)
    # One raw count and half a count of the channel.
    assert now["rider_torque_nm"] == pytest.approx(expected_nm, abs=gain + 0.01)


def test_a_calibration_is_kept_with_its_certificate_and_what_is_not_known_of_it(
    server: SpindleServer, device: str
) -> None:
    calibration = server.get(f"/devices/{device}/parts/calibration")
    assert calibration["sensor_reference_degc"] == 20.0
    record = {
        "sensor_offset_counts_per_k": 1.5,
        "sensor_gain_share_per_k": None,
        "sensor_reference_degc": 23.5,
        "calibrated_at_utc_s": 1795443600,
        "calibration_number": 3,
        "calibration_certificate": [0, 17, 34, 51, 170, 187, 204, 255],
    }

    server.ask("PUT", f"/devices/{device}/parts/calibration", json=calibration | record)

    assert server.get(f"/devices/{device}/parts/calibration") == calibration | record
    rows = server.get(f"/devices/{device}/parameters")["items"]
    assert {row["name"] for row in rows if row["may_be_none"]} == {*list(record)[:3]}
    whole = server.get(f"/devices/{device}/config")["parameters"]
    assert whole["sensor_gain_share_per_k"] is None


@pytest.mark.parametrize(
    ("part", "newer"), [("calibration", "torque_filter"), ("limits", "assist_cutoff_extra_kmh")]
)
def test_a_program_of_before_writes_a_part_without_what_came_since(
    server: SpindleServer, device: str, part: str, newer: str
) -> None:
    before = server.get(f"/devices/{device}/parts/{part}")
    known_then = {name: value for name, value in before.items() if name != newer}

    server.ask("PUT", f"/devices/{device}/parts/{part}", json=known_then)

    assert server.get(f"/devices/{device}/parts/{part}") == before


def test_every_change_is_remembered_with_reason_and_author(
    server: SpindleServer, device: str
) -> None:
    body = {"parameters": {"torque_filter_s": 0.45}, "reason": "smoother on the climb"}
    named = {"spindle-author": quote("王工")}
    server.ask("PATCH", f"/devices/{device}/config", json=body, headers=named)

    newest = server.get(f"/devices/{device}/config/revisions")["items"][0]
    of_it = {"device_id": device, "revision": newest["seq"]}
    certificate = server.ask("POST", "/certificates", json=of_it)

    assert newest["reason"] == "smoother on the climb"
    assert (newest["author"], newest["author_proof"]) == ("王工", "stated")
    assert [change["name"] for change in newest["changed"]] == ["torque_filter_s"]
    assert newest["changed"][0]["new"] == pytest.approx(0.45)
    assert certificate["holds"]
