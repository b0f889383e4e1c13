"""Goal: whoever asks gets the limit proof of what he asks about, and it is kept as first made.

Method: the application over a store of its own, without a unit; a log of revisions that keeps one
with each. What the claims are worth is shown in tests/unit/law/test_limit_proof.py.
"""

from __future__ import annotations

from collections.abc import Iterator
from datetime import UTC, datetime
from typing import Any, cast

import pytest
from fastapi.testclient import TestClient

from backend.store import Store, open_store
from backend.tuning.library.records import LibraryStore
from backend.tuning.library.service import Library
from backend.tuning.limit_proof import LimitProofMaker, ProveLimits, ProvenRevisions
from backend.tuning.records import LimitProofStore, RevisionStore
from backend.tuning.service import Tuning
from backend.units.service import Devices
from firmware_protocol.parameters import default_config
from tests.fakes.api import api_with, client_of

PATH = "/api/v1/certificates"
FIRMWARE = "0.3.0"


@pytest.fixture(scope="module")
def store(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Store]:
    tmp_path = tmp_path_factory.mktemp("proofs")
    with open_store(f"sqlite:///{tmp_path}/spindle.db", f"file://{tmp_path}/objects") as store:
        yield store


@pytest.fixture(scope="module")
def client(store: Store) -> TestClient:
    kept = LimitProofMaker(LimitProofStore(store.database), FIRMWARE)
    library = Library(LibraryStore(store.database))
    prove_limits = ProveLimits(kept, cast(Devices, None), cast(Tuning, None), library)
    return client_of(api_with(prove_limits=prove_limits))


def asked(client: TestClient, **question: Any) -> dict[str, Any]:
    answer = client.post(PATH, json=question)
    assert answer.status_code == 200, answer.text
    return cast(dict[str, Any], answer.json())


def test_a_limit_proof_is_the_same_whenever_it_is_asked_for(client: TestClient) -> None:
    first = asked(client, library="even")
    again = asked(client, library="even", parameters={"fuzzy_table_name": "my own"})
    other = asked(client, library="even", parameters={"mode_ratios": [0.0, 0.5, 1.0, 1.5, 2.0]})

    assert first == again
    assert first["holds"] is True
    assert first["created_at"] is not None
    assert first["firmware_version"] == FIRMWARE
    assert first["table_sha256"] == other["table_sha256"]
    assert first["sha256"] != other["sha256"]
    assert {claim["holds"] for claim in first["claims"]} == {True}
    assert first["cells"][-1]["to_kmh"] == 25.0


def test_a_draft_is_proven_without_being_kept_anywhere_else(client: TestClient) -> None:
    slower = asked(client, parameters={"assist_cutoff_kmh": 18.0})

    cutoff = next(claim for claim in slower["claims"] if claim["code"] == "cutoff")
    assert (cutoff["bound"], cutoff["allowed"], cutoff["margin"]) == (18.0, 25.0, 7.0)


@pytest.mark.parametrize(
    ("question", "status"),
    [
        ({"parameters": {"assist_cutoff_band_kmh": 6.0}}, 422),
        ({"parameters": {"market": "atlantis"}}, 422),
        ({"parameters": {"market": 3}}, 422),
        ({"parameters": {"mode_laws": "fuzzy"}}, 422),
        ({"parameters": {"no_such_thing": 1}}, 422),
        ({"library": "nobody"}, 404),
        ({"library": "even", "device_id": "one"}, 422),
    ],
    ids=str,
)
def test_what_no_unit_takes_is_refused_with_its_reason(
    client: TestClient, question: dict[str, Any], status: int
) -> None:
    answer = client.post(PATH, json=question)

    assert answer.status_code == status, answer.text
    assert answer.json()["detail"]


def test_each_revision_is_kept_with_its_limit_proof(store: Store, client: TestClient) -> None:
    config = {**default_config(), "market": "china"}
    kept = LimitProofMaker(LimitProofStore(store.database), FIRMWARE)
    log = ProvenRevisions(RevisionStore(store.database), kept)

    revision = log.append("ebl:test", config, reason="first")
    other_make = log.append("bbsfw:test", {"assist_cutoff_kmh": 25.0})

    assert [found.seq for found in log.list("ebl:test")] == [revision.seq]
    assert other_make.seq == 1
    nobody_asked_yet = datetime.now(UTC)
    told = asked(client, parameters={"market": "china"})
    assert datetime.fromisoformat(told["created_at"]) <= nobody_asked_yet
    assert told["market"] == "china"
