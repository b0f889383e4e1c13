"""Goal: the library answers without a unit: what comes with Spindle, and what users keep beside it.

Method: the application over a store of its own and nothing else, held against the presets' files;
hostile documents; eight clients that change one item at once.
"""

from __future__ import annotations

import copy
import json
import math
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from importlib.resources import files
from pathlib import Path
from typing import Any, cast
from urllib.parse import quote

import numpy as np
import pytest
from fastapi.testclient import TestClient

from backend.core.fuzzy_table import FuzzyTable
from backend.store import open_store
from backend.tuning.library.compare import Compare
from backend.tuning.library.records import LibraryStore
from backend.tuning.library.service import Library, preset_etag
from backend.tuning.service import Tuning
from firmware_protocol.configuration_file import read
from tests.fakes.api import api_with, client_of

LIBRARY = "/api/v1/library"
ROOT = Path(__file__).resolve().parents[3]
CHANGES = 8

Document = dict[str, Any]


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    tmp_path = tmp_path_factory.mktemp("library")
    with open_store(f"sqlite:///{tmp_path}/spindle.db", f"file://{tmp_path}/objects") as store:
        library = Library(LibraryStore(store.database))
        compare = Compare(library, cast(Tuning, None))
        yield client_of(api_with(author="workshop", library=library, compare=compare))


def saved(name: str) -> Document:
    """The preset's file as JSON."""
    path = files("sim_device") / "presets" / f"{name}.json"
    return cast(Document, json.loads(path.read_text(encoding="utf-8")))


def own(name: str, preset: str = "even") -> Document:
    """A preset under another name, to be kept."""
    return {**saved(preset), "name": name}


def kept_in(client: TestClient) -> list[Document]:
    """The rows of what users keep."""
    return [row for row in client.get(LIBRARY).json()["items"] if row["source"] == "own"]


def test_every_preset_is_listed_with_what_it_is_good_for(client: TestClient) -> None:
    answer = client.get(LIBRARY).json()
    rows = [row for row in answer["items"] if row["source"] == "preset"]

    assert answer["next"] is None
    kinds = {row["id"]: row["kind"] for row in rows}
    assert kinds == {
        "thesis": "configuration",
        "thesis-table": "table",
        "thesis-rescaled": "table",
        "even": "table",
        "strong-start": "table",
    }
    for row in rows:
        assert (row["name"], row["family"]) == (row["id"], "ebl")
        assert row["comment"]
        assert row["etag"] == client.get(f"{LIBRARY}/{row['id']}").headers["etag"]
        assert "parameters" not in row


@pytest.mark.parametrize("name", ["thesis", "even"])
def test_an_entry_is_its_file(client: TestClient, name: str) -> None:
    entry = client.get(f"{LIBRARY}/{name}").json()

    assert read(entry) == read(saved(name))
    # Without the comments that nobody wrote, it is the file to the last field.
    for parameter in entry["parameters"].values():
        if not parameter["comment"]:
            del parameter["comment"]
    assert entry == saved(name)


def test_a_preset_s_tag_changes_with_its_content_alone(client: TestClient) -> None:
    first, again = (client.get(f"{LIBRARY}/even").headers["etag"] for _ in range(2))
    entry = Library(cast(Any, None)).entry("even")

    assert first == again == entry.etag == preset_etag(dict(reversed(entry.document.items())))
    assert preset_etag({**entry.document, "comment": "another"}) != first
    assert client.get(f"{LIBRARY}/strong-start").headers["etag"] != first


@pytest.mark.parametrize(
    "name", ["nobody", "..", "thesis.json", "own-1", "own-0", "own-99999999999999999999"]
)
def test_what_is_not_there_is_a_problem_that_names_it(client: TestClient, name: str) -> None:
    path = f"{LIBRARY}/{name.replace('.', '%2E')}"
    answers = [client.get(path), client.put(path, json=own("mine")), client.delete(path)]

    for answer in answers:
        assert answer.status_code in (404, 405), answer.text
        assert answer.headers["content-type"] == "application/problem+json"
    assert answers[0].json()["code"] == "not_found"


def test_what_is_kept_comes_back_as_the_file_it_was(client: TestClient) -> None:
    made = client.post(LIBRARY, json=own("夜骑 1"), headers={"spindle-author": quote("王工")})
    row = made.json()
    backup = own("whole", "thesis") | {"identity": {"serial_number": "SP-1"}, "crc32": 1}
    whole = client.post(LIBRARY, json=backup).json()

    assert made.status_code == 201
    assert made.headers["location"] == f"{LIBRARY}/{row['id']}"
    assert (
        made.headers["etag"] == row["etag"] == client.get(f"{LIBRARY}/{row['id']}").headers["etag"]
    )
    assert (row["author"], row["author_proof"], row["version"]) == ("王工", "stated", 1)
    assert read(client.get(f"{LIBRARY}/{row['id']}").json()) == read(own("夜骑 1"))
    assert (whole["kind"], whole["author"]) == ("configuration", "workshop")
    assert "identity" not in client.get(f"{LIBRARY}/{whole['id']}").json()
    assert kept_in(client)[-2:] == [row, whole]


def test_nothing_that_was_kept_is_lost(client: TestClient) -> None:
    first = client.post(LIBRARY, json=own("mine")).json()
    path = f"{LIBRARY}/{first['id']}"

    other = own("softer", "strong-start")
    second = client.put(path, json=other, headers={"if-match": first["etag"]}).json()
    gone = client.delete(path, headers={"if-match": second["etag"]}).json()
    seen = client.get(path)
    between = client.get(LIBRARY).json()["items"]
    with_deleted = client.get(LIBRARY, params={"deleted": True}).json()["items"]
    again = client.post(LIBRARY, json=own("softer")).json()
    taken = client.put(path, json=other)
    back = client.put(path, json=client.get(path, params={"version": 1}).json()).json()

    assert (seen.status_code, gone["deleted"]) == (404, True)
    assert first["id"] not in [row["id"] for row in between]
    assert first["id"] in [row["id"] for row in with_deleted if row["deleted"]]
    # The name of what is deleted is free, and it comes back under another.
    assert again["id"] != first["id"]
    assert (taken.status_code, taken.json()["code"]) == (409, "name_taken")
    assert (back["version"], back["deleted"], back["name"]) == (4, False, "mine")
    versions = client.get(f"{path}/versions").json()["items"]
    assert [(row["version"], row["deleted"]) for row in versions] == [
        (4, False),
        (3, True),
        (2, False),
        (1, False),
    ]
    assert [
        client.get(path, params={"version": number}).json()["name"] for number in (1, 2, 3)
    ] == [
        "mine",
        "softer",
        "softer",
    ]
    assert client.get(path, params={"version": 9}).status_code == 404


def test_what_comes_with_spindle_stays_as_it_is(client: TestClient) -> None:
    changed = client.put(f"{LIBRARY}/even", json=own("mine"))
    deleted = client.delete(f"{LIBRARY}/even")
    named = client.post(LIBRARY, json=own("even"))

    assert [changed.status_code, deleted.status_code] == [403, 403]
    assert changed.json()["code"] == deleted.json()["code"] == "preset_read_only"
    assert (named.status_code, named.json()["code"]) == (409, "name_taken")


def test_of_clients_that_change_an_item_at_once_one_wins(client: TestClient) -> None:
    made = client.post(LIBRARY, json=own("ours")).json()
    path = f"{LIBRARY}/{made['id']}"

    def change(number: int) -> int:
        body = own(f"by {number}")
        return client.put(path, json=body, headers={"if-match": made["etag"]}).status_code

    def add(_: int) -> int:
        return client.post(LIBRARY, json=own("wanted")).status_code

    with ThreadPoolExecutor(CHANGES) as pool:
        changed = sorted(pool.map(change, range(CHANGES)))
        added = sorted(pool.map(add, range(CHANGES)))

    assert changed == [200, *[412] * (CHANGES - 1)]
    assert added == [201, *[409] * (CHANGES - 1)]
    assert len(client.get(f"{path}/versions").json()["items"]) == 2


def with_value(parameter: str, value: object) -> Document:
    document = copy.deepcopy(own("mine"))
    document["parameters"][parameter]["value"] = value
    return document


HOSTILE: dict[str, Document] = {
    "a number that is none": with_value("fuzzy_gain_points", [0.1, 0.2, math.nan, 0.4, 0.5]),
    "a number beyond the bounds": with_value("fuzzy_gain_points", [0.1, 0.2, 0.3, 0.4, 50.0]),
    "a number beyond all numbers": with_value("fuzzy_gain_points", [0.1, 0.2, 0.3, 0.4, 10**400]),
    "points that fall": with_value("fuzzy_speed_points_kmh", [5.0, 4.0, 15.0, 20.0, 25.0]),
    "a label that is none": with_value("fuzzy_rules", [["XX"] * 5] * 5),
    "four rows": with_value("fuzzy_rules", [["ZO"] * 5] * 4),
    "a name the unit cannot hold": with_value("fuzzy_table_name", "x" * 25),
    "a list of lists of lists": with_value("fuzzy_rules", [[[["ZO"]]]]),
    "huge": with_value("fuzzy_rules", [["ZO"] * 64] * 65),
    "another unit": own("mine", "thesis")
    | {"parameters": {"gear_ratio": {"value": 40.34, "unit": "km/h"}}},
    "another make": own("mine") | {"family": "bafang"},
    "of tomorrow": own("mine") | {"version": 2},
    "of before": {"parameters": {"gear_ratio": 40.34}},
    "another file": {"format": "gpx"},
    "an unknown field": own("mine") | {"colour": "red"},
    "no name": own("  "),
    "a name of two lines": own("a\nb"),
    "a name that turns the line around": own("a\u202eb"),
    "a name without end": own("x" * 81),
    "a comment without end": own("mine") | {"comment": "x" * 2001},
    "a table with a limit in it": own("mine")
    | {"parameters": saved("even")["parameters"] | {"gear_ratio": {"value": 40.34, "unit": ""}}},
    "a configuration of nothing": own("mine", "thesis") | {"parameters": {}},
    "an unknown parameter": own("mine", "thesis")
    | {"parameters": {"throttle": {"value": 1, "unit": ""}}},
}  # fmt: skip


@pytest.mark.parametrize("document", HOSTILE.values(), ids=HOSTILE.keys())
def test_a_document_that_no_unit_takes_is_refused_whole(
    client: TestClient, document: Document
) -> None:
    kept = kept_in(client) or [client.post(LIBRARY, json=own("kept")).json()]
    body = json.dumps(document).encode()
    headers = {"content-type": "application/json"}

    added = client.post(LIBRARY, content=body, headers=headers)
    changed = client.put(f"{LIBRARY}/{kept[0]['id']}", content=body, headers=headers)

    assert [added.status_code, changed.status_code] == [422, 422], added.text
    assert added.json()["detail"]
    assert kept_in(client) == kept


def test_a_document_of_an_older_unit_is_kept_in_today_s_words(client: TestClient) -> None:
    old = own("old", "thesis")
    old["parameters"] = {
        "mode_laws": {"value": ["OFF", "FIXED", "FIXED", "FUZZY", "FUZZY"], "unit": ""}
    }

    row = client.post(LIBRARY, json=old).json()

    kept = client.get(f"{LIBRARY}/{row['id']}").json()["parameters"]
    assert kept["mode_laws"]["value"] == ["off", "fixed", "fixed", "fuzzy", "fuzzy"]


def test_a_table_goes_out_to_other_programs_and_comes_back(client: TestClient) -> None:
    fis = client.get(f"{LIBRARY}/even/export", params={"format": "fis"})
    csv = client.get(f"{LIBRARY}/even/export", params={"format": "csv"}).text
    json_file = client.get(f"{LIBRARY}/even/export").json()
    before = kept_in(client)
    read_again = client.post(f"{LIBRARY}/fis", json={"text": fis.text, "name": "from MATLAB"})
    spoilt = fis.text.replace("1 1, 1 (1) : 1", "1 1, 1 (1) : 2")
    refused = client.post(f"{LIBRARY}/fis", json={"text": spoilt})
    none = client.get(f"{LIBRARY}/even/export", params={"format": "fis", "table": "second"})

    assert 'filename="even.fis"' in fis.headers["content-disposition"]
    assert read(json_file) == read(saved("even"))
    rules = saved("even")["parameters"]["fuzzy_rules"]["value"]
    assert [line.split(",")[1:] for line in csv.splitlines()[1:6]] == rules
    assert kept_in(client) == before
    answer = read_again.json()
    assert answer["deviation"]["gain"] < 1e-6
    for name, entry in answer["document"]["parameters"].items():
        assert entry["value"] == saved("even")["parameters"][name]["value"]
    assert client.post(LIBRARY, json=answer["document"]).json()["name"] == "from MATLAB"
    line = fis.text.splitlines().index("1 1, 1 (1) : 1") + 1
    assert (refused.status_code, refused.json()["code"]) == (422, "bad_fis")
    assert refused.json()["errors"][0]["field"] == f"line {line}"
    assert (none.status_code, none.json()["code"]) == (409, "entry_has_no_table")


def test_two_tables_differ_where_they_were_made_to_differ(client: TestClient) -> None:
    even = FuzzyTable.from_parameters(
        {name: entry["value"] for name, entry in saved("even")["parameters"].items()}
    )
    rules = [list(row) for row in even.rules]
    assert rules[1][3] == "PS"
    rules[1][3] = "NB"
    draft = even.to_json() | {"rules": rules}

    answer = client.post(
        f"{LIBRARY}/compare", json={"left": {"library": "even"}, "right": {"fuzzy_table": draft}}
    ).json()

    assert [change["name"] for change in answer["parameters"]] == ["fuzzy_rules"]
    tables = answer["tables"]
    assert tables["cells"] == [{"row": 1, "column": 3, "left": "PS", "right": "NB"}]
    assert (tables["points_changed"], tables["inference_changed"]) == ([], False)
    # A weighted average is bilinear: it differs most at the changed node, by the two labels' gains.
    assert tables["largest"] == {
        "gain": pytest.approx(0.0 - 0.375),
        "speed_kmh": 10.0,
        "torque_rate": pytest.approx(0.3),
        "left": pytest.approx(0.375),
        "right": pytest.approx(0.0),
    }
    assert np.shape(tables["left"]) == (len(tables["speeds_kmh"]), len(tables["torque_rates"]))
    assert answer["left"]["feel"] is None


@pytest.mark.slow
def test_how_two_feel_is_what_the_page_of_tables_says(client: TestClient) -> None:
    sides = {"left": {"library": "strong-start"}, "right": {"library": "even"}}
    answer = client.post(f"{LIBRARY}/compare", json=sides | {"feel": True}).json()
    page = (ROOT / "docs" / "tables.md").read_text(encoding="utf-8")

    felt = [answer[end]["feel"] for end in ("left", "right")]
    # Measured once for what an entry holds.
    assert client.get(f"{LIBRARY}/even/feel").json() == felt[1]
    for name, feel in zip(("strong-start", "even"), felt, strict=True):
        row = next(
            line
            for line in page.splitlines()
            if line.startswith(f"| `{name}` |") and " s |" in line
        )
        start_s, toggles_hz = row.split("|")[3], row.split("|")[4]
        assert feel["start_s"] == pytest.approx(float(start_s.removesuffix(" s ")), abs=0.051)
        assert feel["toggles_hz"] == pytest.approx(float(toggles_hz), abs=0.051)
        assert feel["market"] == "eu_epac"
        # The factory's filter of 0.5 s passes 63 % of a sudden push in that time.
        assert 250.0 < feel["lag_ms"] < 600.0
        assert 0.0 < feel["ripple_pct"] < 30.0


@pytest.mark.parametrize(
    ("side", "status"),
    [
        ({}, 422),
        ({"library": "even", "device": "unit"}, 422),
        ({"library": "nobody"}, 404),
        ({"library": "even", "version": 2}, 404),
    ],
)
def test_a_side_is_just_one_thing_that_is_there(
    client: TestClient, side: Document, status: int
) -> None:
    asked = {"left": {"library": "even"}, "right": side}

    assert client.post(f"{LIBRARY}/compare", json=asked).status_code == status


def test_a_configuration_no_unit_takes_together_is_compared_but_not_felt(
    client: TestClient,
) -> None:
    parts = {"parameters": {"fixed_taper_start_kmh": {"value": 24.5, "unit": "km/h"}}}
    row = client.post(LIBRARY, json=own("part", "thesis") | parts).json()

    asked = {"left": {"library": row["id"]}, "right": {"library": "thesis"}, "feel": True}
    answer = client.post(f"{LIBRARY}/compare", json=asked).json()

    assert answer["left"]["feel"] is None
    assert "No simulated unit takes these values" in answer["left"]["no_feel_reason"]
    assert (answer["tables"], answer["left"]["fuzzy_table"]) == (None, None)
    taper = next(each for each in answer["parameters"] if each["name"] == "fixed_taper_start_kmh")
    assert (taper["old"], taper["new"]) == (24.5, 15.0)
