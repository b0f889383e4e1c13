"""Goal: whatever changes the unit on a connection can name the unit that it is for.

Method: the description of the API; that they refuse is in the story of the bikes on one cable.
"""

from __future__ import annotations

from tests.fakes.api import description

UNDER_A_CONNECTION = "/devices/{device_id}/"


def test_every_change_under_a_connection_takes_the_unit_s_key_and_may_refuse() -> None:
    changes = [
        operation
        for path, operations in description()["paths"].items()
        if UNDER_A_CONNECTION in path
        for method, operation in operations.items()
        if method != "get"
    ]

    assert len(changes) >= 12
    for operation in changes:
        headers = {one["name"] for one in operation["parameters"] if one["in"] == "header"}
        assert "spindle-unit" in headers, operation["operationId"]
        assert "412" in operation["responses"], operation["operationId"]
