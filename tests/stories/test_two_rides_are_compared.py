"""Goal: whoever changed a setting between two rides sees both side by side, and what was changed.

Method: a simulated unit in virtual time is ridden twice, the second time with another rule; the
page's requests and the shell's command are asked. Figures are judged by each ride's own summary,
settings by what was written to the unit.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from tests.fakes.ride_in_time import recorded_ride
from tests.fakes.server import ServerHere, SpindleServer

CELL = (1, 2)


@pytest.fixture(scope="module")
def pair(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[SpindleServer, list[int]]]:
    """A server, and its rides before and after the change."""
    unit = "sim:one?seed=11&clock=virtual&scenario=none"
    with ServerHere(tmp_path_factory.mktemp("pair"), [unit]) as server:
        device = server.ready_device()
        rides = [recorded_ride(server, device)["id"]]
        rules = server.get(f"/devices/{device}/config")["parameters"]["fuzzy_rules"]
        row, column = CELL
        rules[row][column] = "PB" if rules[row][column] != "PB" else "PS"
        server.configure(device, "for the hill", fuzzy_rules=rules, torque_filter_s=0.7)
        rides.append(recorded_ride(server, device)["id"])
        yield server, rides


def asked(pair: tuple[SpindleServer, list[int]], what: str = "", **params: Any) -> dict[str, Any]:
    server, (a, b) = pair
    answer: dict[str, Any] = server.get(f"/rides/compare{what}", params={"a": a, "b": b, **params})
    return answer


def test_figures_and_settings_stand_side_by_side(pair: tuple[SpindleServer, list[int]]) -> None:
    told = asked(pair)

    server, rides = pair
    for one in told["figures"]:
        for side, ride in zip("ab", rides, strict=True):
            summary = server.get(f"/rides/{ride}")["summary"]
            if one["name"] in summary:
                assert one[side]["value"] == pytest.approx(summary[one["name"]], rel=1e-3)
        if one["difference"] is not None:
            assert one["difference"] == pytest.approx(one["b"]["value"] - one["a"]["value"])
    settings = told["settings"]
    assert {one["name"] for one in settings["differences"]} == {"fuzzy_rules", "torque_filter_s"}
    (table,) = settings["tables"]
    assert [(cell["row"], cell["column"]) for cell in table["cells"]] == [CELL]
    assert (told["motor_torque"], told["no_route"]) == ("alike", "neither")


def test_the_traces_lie_on_one_axis(pair: tuple[SpindleServer, list[int]]) -> None:
    by_time = asked(pair, "/series", by="time", channels="speed_kmh", px=200)
    by_way = asked(pair, "/series", by="distance", channels="speed_kmh", px=200)
    told = asked(pair)

    assert by_time["end_x"] == pytest.approx(max(told[side]["length_s"] for side in "ab"))
    assert by_way["end_x"] == pytest.approx(max(told[side]["length_m"] for side in "ab"))
    server, rides = pair
    for side, ride in zip("ab", rides, strict=True):
        top = server.get(f"/rides/{ride}")["summary"]["speed_kmh_max"]
        for series in (by_time, by_way):
            (channel,) = series["channels"]
            greatest = [value for value in channel[side]["max"] if value is not None]
            assert max(greatest) == pytest.approx(top, abs=0.01), "no extreme is lost"


def test_torque_round_the_crank_is_told_of_both(pair: tuple[SpindleServer, list[int]]) -> None:
    told = asked(pair, "/crank")

    assert (told["a_refused"], told["b_refused"]) == (None, None)
    apart = [b - a for a, b in zip(told["a"]["rider_nm"], told["b"]["rider_nm"], strict=True)]
    assert told["difference"]["rider_nm"] == pytest.approx(apart)
