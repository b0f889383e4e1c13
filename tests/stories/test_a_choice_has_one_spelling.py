"""Goal: whatever the server says, a choice is in lower case, but for the labels of rules; and what
was written before, when parameters were told in upper case, still means the same.

Method: the answers of every route that tells of a unit, value by value; a backup and a request as
version 0.2 had them. One unit was never set up by a factory, so that there is a fault to be told.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.fakes.api import description
from tests.fakes.command import spindle
from tests.fakes.server import ServerHere, SpindleServer

pytestmark = pytest.mark.slow

RULE_LABELS = {"NB", "NS", "ZO", "PS", "PB"}
# A member of an enumeration as C spells it.
CONSTANT = re.compile(r"[A-Z][A-Z0-9]*(_[A-Z0-9]+)*")
# Units of measurement look like it.
UNITS = {"A", "V", "W"}
OLD = {
    "fuzzy_inference": "WEIGHTED_AVERAGE",
    "mode_laws": ["OFF", "FIXED", "FUZZY", "FUZZY", "FUZZY"],
    "mode_tapers": ["NONE", "NONE", "JAPAN_1_TO_1", "JAPAN_2_TO_1", "TAPER_SPEEDS"],
}
TODAY = {
    "fuzzy_inference": "weighted_average",
    "mode_laws": ["off", "fixed", "fuzzy", "fuzzy", "fuzzy"],
    "mode_tapers": ["none", "none", "japan_1_to_1", "japan_2_to_1", "taper_speeds"],
}
MORE = [
    "/devices/{device_id}/parts/fuzzy_table?table=second",
    "/devices/{device_id}/config?bank=default",
]


@pytest.fixture(scope="module")
def pair(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[SpindleServer, str, str]]:
    """A server with a unit that was written in the old spelling, and one without a market."""
    urls = [
        "sim:known?clock=virtual&scenario=none",
        "sim:blank?market=none&clock=virtual&scenario=none",
    ]
    with ServerHere(tmp_path_factory.mktemp("spelling"), urls) as server:
        server.all_ready(2)
        known, blank = (server.ready_device(number) for number in (0, 1))
        # Their first rows.
        for one in (known, blank):
            server.advance(one, 0.1)
        server.configure(known, "as version 0.2 asked", **OLD)
        yield server, known, blank


OF_PEOPLE = {"/api/v1/keys", "/api/v1/session/passkeys"}


def questions() -> list[str]:
    """Every question about a unit, or about nothing, that needs no more than its address."""
    return [
        path.removeprefix("/api/v1")
        for path, operations in description()["paths"].items()
        if path.startswith("/api/v1") and "get" in operations
        if "application/json" in operations["get"]["responses"]["200"]["content"]
        if set(re.findall(r"{(\w+)}", path)) <= {"device_id"}
        # This server asks nobody to sign in, and has no accounts to tell of.
        if operations["get"].get("x-permission") != "manage_people" and path not in OF_PEOPLE
        if not any(
            parameter["required"] and parameter["in"] == "query"
            for parameter in operations["get"].get("parameters", ())
        )
    ]


def texts(node: Any) -> Iterator[str]:
    if isinstance(node, str):
        yield node
    elif isinstance(node, dict | list):
        for child in node.values() if isinstance(node, dict) else node:
            yield from texts(child)


def test_no_answer_has_a_choice_in_upper_case(pair: tuple[SpindleServer, str, str]) -> None:
    server, *devices = pair
    paths = {path.format(device_id=one) for path in questions() + MORE for one in devices}
    answers = {path: server.get(path) for path in sorted(paths)}

    shouted = {
        (path, text)
        for path, answer in answers.items()
        for text in texts(answer)
        if CONSTANT.fullmatch(text) and text not in RULE_LABELS | UNITS
    }

    assert shouted == set()
    assert [fault["name"] for fault in answers[f"/devices/{devices[1]}/faults"]["items"]] == [
        "not_provisioned"
    ]
    rows = {row["name"]: row for row in answers[f"/devices/{devices[0]}/parameters"]["items"]}
    assert rows["market"]["choices"][0] == rows["market"]["value"] == "eu_epac"
    assert rows["gear_ratio"]["access"] == "factory"


def test_a_request_in_the_old_spelling_is_done_and_noted_in_that_of_today(
    pair: tuple[SpindleServer, str, str],
) -> None:
    server, known, _ = pair

    config = server.get(f"/devices/{known}/config")["parameters"]
    newest = server.get(f"/devices/{known}/config/revisions")["items"][0]

    assert {name: config[name] for name in TODAY} == TODAY
    assert newest["reason"] == "as version 0.2 asked"
    assert {change["name"]: change["new"] for change in newest["changed"]} == TODAY


def test_another_spelling_is_no_change(
    pair: tuple[SpindleServer, str, str], tmp_path: Path
) -> None:
    server, known, _ = pair
    path = f"/devices/{known}/config"
    before = server.get(path)
    kept = tmp_path / "kept.json"
    kept.write_text(json.dumps(before | {"parameters": before["parameters"] | OLD}))

    again = server.ask("PATCH", path, json={"parameters": OLD, "reason": "again"})
    differing = spindle(server, "device", "diff", kept, known, "--json")
    restored = spindle(server, "device", "restore", kept, known)

    assert (again["changed"], again["generation"]) == ([], before["generation"])
    assert json.loads(differing.stdout)["changed"] == []
    assert restored.stdout == "Nothing to restore.\n"
    assert server.get(path) == before
