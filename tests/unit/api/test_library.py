"""Goal: the library answers without a unit: what there is, and each entry as the file it is.

Method: the application without services, held against the presets' own files.
"""

from __future__ import annotations

import json
from importlib.resources import files

import pytest
from fastapi.testclient import TestClient

from backend.api.app import ApiSettings, create_app
from backend.services.tuning.library import library_entry, library_etag
from firmware_protocol.configuration_file import read

LIBRARY = "/api/v1/library"


@pytest.fixture(scope="module")
def client() -> TestClient:
    return TestClient(create_app(ApiSettings("test")), base_url="http://127.0.0.1")


def saved(name: str) -> object:
    """The preset's file as JSON."""
    path = files("sim_device") / "presets" / f"{name}.json"
    return json.loads(path.read_text(encoding="utf-8"))


def test_every_preset_is_listed_with_what_it_is_good_for(client: TestClient) -> None:
    answer = client.get(LIBRARY).json()

    assert answer["next"] is None
    kinds = {row["id"]: row["kind"] for row in answer["items"]}
    assert kinds == {
        "thesis": "configuration",
        "thesis-table": "table",
        "thesis-rescaled": "table",
        "even": "table",
        "strong-start": "table",
    }
    for row in answer["items"]:
        assert (row["name"], row["family"], row["source"]) == (row["id"], "ebl", "preset")
        assert row["comment"]
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


def test_an_entry_s_tag_changes_with_its_content_alone(client: TestClient) -> None:
    first, again = (client.get(f"{LIBRARY}/even").headers["etag"] for _ in range(2))
    entry = library_entry("even")

    assert first == again == library_etag(dict(reversed(entry.items())))
    assert library_etag({**entry, "comment": "another"}) != first
    assert client.get(f"{LIBRARY}/strong-start").headers["etag"] != first


@pytest.mark.parametrize("name", ["nobody", "..", "thesis.json"])
def test_what_is_not_there_is_a_problem_that_names_it(client: TestClient, name: str) -> None:
    answer = client.get(f"{LIBRARY}/{name.replace('.', '%2E')}")

    assert answer.status_code == 404
    assert answer.headers["content-type"] == "application/problem+json"
    assert answer.json()["code"] == "not_found"
