"""Goal: the second table is read, written and ridden like the first; neither touches the other.

The whole way is real, as in test_tuning_changes_the_bike: HTTP, protocol, the unit's C. Expected
gains are those of tables with one label in every cell, whose weighted average is that label's peak.
"""

from __future__ import annotations

import pytest

from backend.tuning.models.law import FuzzyTable
from spindle.client import Spindle, Unit
from tests.fakes.server import WRITES_EVERY_S, SpindleServer

GAIN_FIRST = 0.05
GAIN_SECOND = 0.25


@pytest.fixture
def unit(server: SpindleServer, device: str) -> Unit:
    """A standing bike as a program drives it."""
    return Spindle(server.url).unit(device)


def flat(table: FuzzyTable, gain: float) -> FuzzyTable:
    """The table with the same gain everywhere: its least set's."""
    peaks = [gain, gain + 0.01, gain + 0.02, gain + 0.03, gain + 0.04]
    return table.model_copy(
        update={
            "inference": "weighted_average",
            "gain_points": peaks,
            "rules": [["NB"] * 5] * 5,
            "name": f"flat {gain}",
        }
    )


def live_gain(unit: Unit, mode: int) -> float | None:
    """The gain on the road in a mode, after five seconds."""
    unit.simulate(
        brake=False,
        assist_mode=mode,
        rider={"kind": "constant", "torque_nm": 20.0, "cadence_rpm_max": 90.0},
        road={"grade_deg": 0.0, "wind_ms": 0.0},
    )
    unit.advance(5.0)
    now = unit.snapshot().channels
    assert now["assist_mode"] == mode
    return now["fuzzy_gain"]


def test_each_mode_gets_the_gain_of_the_table_it_uses(unit: Unit) -> None:
    first, second = unit.fuzzy_table(), unit.fuzzy_table("second")
    unit.write({"mode_tables": [0, 0, 0, 0, 1]}, "boost by the second table")
    unit.advance(WRITES_EVERY_S)

    change = unit.write_fuzzy_table(flat(second, GAIN_SECOND), "second", "a story")
    assert unit.fuzzy_table() == first
    unit.advance(WRITES_EVERY_S)
    unit.write_fuzzy_table(flat(first, GAIN_FIRST), reason="a story")

    assert change.verified
    assert {one.name for one in change.changed} == {
        "second_table_name", "second_gain_points", "second_rules",
    }  # fmt: skip
    assert unit.fuzzy_table("second") == flat(second, GAIN_SECOND)
    assert live_gain(unit, mode=3) == pytest.approx(GAIN_FIRST, abs=0.001)
    assert live_gain(unit, mode=4) == pytest.approx(GAIN_SECOND, abs=0.001)


def test_a_change_of_the_second_table_made_for_an_older_configuration_is_refused(
    server: SpindleServer, device: str, unit: Unit
) -> None:
    path, query = f"/devices/{device}/parts/fuzzy_table", {"table": "second"}
    response = server.client.get(path, params=query)
    unit.write({"torque_filter_s": 0.4}, "somebody else")

    refused = server.client.put(
        path,
        params=query,
        json=response.json() | {"name": "late"},
        headers={"if-match": response.headers["etag"]},
    )

    assert refused.status_code == 412
    assert unit.fuzzy_table("second").name == response.json()["name"]


@pytest.mark.parametrize("method", ["GET", "PUT"])
def test_a_table_the_unit_does_not_have_is_refused_by_name(
    server: SpindleServer, device: str, method: str
) -> None:
    path = f"/devices/{device}/parts/fuzzy_table"
    body = server.get(path) if method == "PUT" else None

    response = server.client.request(method, path, params={"table": "third"}, json=body)

    assert response.status_code == 422
    assert [fault["field"] for fault in response.json()["errors"]] == ["table"]
