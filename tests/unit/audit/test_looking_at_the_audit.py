"""Goal: who may looks at the audit sees what is their affair, finds it, and can take it away; what
leaves as a file can be checked by others and computes nothing.

Method: the workshop's server; a file's hashes are made once more by its own description. The
commands that work on a folder are run on one.
"""

from __future__ import annotations

import csv
import hashlib
import io
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.parse import quote

import pytest

from backend.core.audit import Action, AuditEntry
from backend.errors import StoreError
from backend.rebuild import rebuild_store
from backend.store import Store, open_store
from backend.store.audit import AuditLog
from backend.store.sql.database import Database
from backend.store.upkeep.audit import verify_audit
from tests.fakes.command import spindle
from tests.fakes.house import PASSWORD
from tests.fakes.server import ServerHere
from tests.fakes.workshop import Workshop, open_workshop

pytestmark = pytest.mark.slow
FORMULA = "=HYPERLINK(1)"


@pytest.fixture(scope="module")
def workshop(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Workshop]:
    with open_workshop(tmp_path_factory.mktemp("audit")) as opened:
        opened.ask("Ben", "POST", "/bikes", json={"name": FORMULA})
        yield opened


def listed(workshop: Workshop, who: str, query: str = "") -> list[dict[str, Any]]:
    """All pages."""
    items: list[dict[str, Any]] = []
    page = workshop.ask(who, "GET", f"/audit?limit=3&{query}")
    while True:
        items += page["items"]
        if page["next"] is None:
            return items
        page = workshop.ask(who, "GET", f"/audit?limit=3&{query}&cursor={page['next']}")


def test_pages_go_from_the_newest_to_the_first_event_and_miss_none(workshop: Workshop) -> None:
    items = listed(workshop, "Anna")

    assert [one["id"] for one in items] == list(range(len(items), 0, -1))
    assert len(items) > 12
    newest = items[0]
    assert (newest["action"], newest["object_name"]) == ("bike_added", FORMULA)
    assert (newest["actor_kind"], newest["actor_name"]) == ("person", "Ben")
    assert newest["after"] == {"name": FORMULA, "lost": False}


def test_accounts_and_keys_are_the_affair_of_who_manages_people(workshop: Workshop) -> None:
    every, dealer_s = listed(workshop, "Anna"), listed(workshop, "Ben")
    exported = workshop.clients["Ben"].get("/audit/export?format=jsonl").text

    kinds = {one["object_kind"] for one in every}
    assert {"account", "bike"} <= kinds
    assert {one["object_kind"] for one in dealer_s} == kinds - {"account", "key"}
    assert workshop.ask("Ben", "GET", "/audit?object_kind=account")["items"] == []
    assert "account_" not in exported
    assert workshop.refused("Rita", "GET", "/audit") == (403, "not_allowed")
    assert workshop.refused("Rita", "GET", "/audit/export")[0] == 403


@pytest.mark.parametrize(
    ("query", "found"),
    [
        ("who=rit", {"account_signed_in", "bike_taken"}),
        ("who=RITA&action=bike_taken", {"bike_taken"}),
        ("who=%25", set()),
        ("object_kind=bike&who=ben", {"bike_added", "bike_offered"}),
        ("from=2000-01-01T00:00:00Z&to=2000-01-02T00:00:00Z", set()),
        ("unit_key=ebl:nobody", set()),
    ],
)
def test_events_are_found_by_who_what_and_when(
    workshop: Workshop, query: str, found: set[str]
) -> None:
    assert {one["action"] for one in listed(workshop, "Anna", query)} == found


def test_the_events_of_a_bike_name_it_as_it_is_called_now(workshop: Workshop) -> None:
    bike = workshop.bikes["Olaf"]
    workshop.ask("Ben", "PATCH", f"/bikes/{bike}", json={"name": "Grey"})

    items = listed(workshop, "Ben", f"bike_id={bike}")

    assert [one["action"] for one in items] == [
        "bike_changed",
        "bike_taken",
        "bike_offered",
        "bike_added",
    ]
    assert {one["bike_name"] for one in items} == {"Grey"}
    assert items[-1]["object_name"] == "Olaf's bike"
    assert (items[0]["before"], items[0]["after"]) == ({"name": "Olaf's bike"}, {"name": "Grey"})


@pytest.mark.parametrize("cursor", ["x", "-1", "1.5", "²", "9" * 30])
def test_a_cursor_that_is_none_is_refused(workshop: Workshop, cursor: str) -> None:
    assert workshop.refused("Anna", "GET", f"/audit?cursor={quote(cursor)}")[0] == 422


def test_each_line_of_the_export_has_the_hash_of_what_it_says(workshop: Workshop) -> None:
    answer = workshop.clients["Anna"].get("/audit/export?format=jsonl")
    lines = [json.loads(line) for line in answer.text.splitlines()]

    previous = "0" * 64
    for number, line in enumerate(lines, start=1):
        stated = line.pop("sha256")
        plain = json.dumps(line, sort_keys=True, separators=(",", ":"))
        assert hashlib.sha256(plain.encode()).hexdigest() == stated
        assert (line["id"], line["previous_sha256"]) == (number, previous)
        previous = stated
    assert ".jsonl" in answer.headers["content-disposition"]
    store = workshop.server.services.store._store
    url = store.database.engine.url.render_as_string(hide_password=False)
    assert verify_audit(url).head_sha256 == previous


def test_no_cell_of_the_table_is_a_formula(workshop: Workshop) -> None:
    answer = workshop.clients["Ben"].get("/audit/export?object_kind=bike")
    empty = workshop.clients["Ben"].get("/audit/export?object_kind=store")
    header, *rows = csv.reader(io.StringIO(answer.text))

    names = [row[header.index("object_name")] for row in rows]
    assert names[0] == "Rita's bike"
    assert f"'{FORMULA}" in names
    assert not any(cell.startswith(("=", "+", "-", "@")) for row in rows for cell in row)
    assert empty.text.strip().split(",") == header


def test_on_a_server_that_asks_nobody_the_name_is_what_they_say(tmp_path: Path) -> None:
    with ServerHere(tmp_path, SPINDLE_AUTHOR="desk") as server:
        for number, headers in enumerate(({}, {"spindle-author": quote("Zoë")})):
            server.ask("POST", "/bikes", json={"name": f"bike {number}"}, headers=headers)
        items = server.get("/audit")["items"]

    assert [(one["actor_kind"], one["actor_name"], one["person_id"]) for one in items] == [
        ("person", "Zoë", None),
        ("person", "desk", None),
    ]


def test_what_a_command_does_to_a_folder_is_a_command_s(tmp_path: Path) -> None:
    words = ("--data", tmp_path, "--password-stdin")
    add = ("people", "add", "Anna", "--role", "admin", *words)
    reset = ("people", "reset", "Anna", *words)

    for command in (add, reset):
        assert spindle(None, *command, stdin=f"{PASSWORD}\n").returncode == 0
    with open_store(f"sqlite:///{tmp_path}/spindle.db", (tmp_path / "objects").as_uri()) as store:
        events = events_of(store)

    assert [(one["actor_kind"], one["action"]) for one in events] == [
        ("command", "account_added"),
        ("command", "account_password_set"),
    ]
    assert all(one["actor_name"] for one in events)
    check = spindle(None, "audit", "verify", "--data", tmp_path)
    assert (check.returncode, check.stdout.splitlines()[0][:8]) == (0, "2 events")


def events_of(store: Store) -> list[dict[str, Any]]:
    from backend.audit.records import AuditReader
    from backend.audit.types import AuditFilter

    return [dict(row) for row in AuditReader(store.database).rows(AuditFilter())]


def test_the_audit_of_a_rebuilt_database_begins_anew_and_says_so(tmp_path: Path) -> None:
    urls = f"sqlite:///{tmp_path}/spindle.db", (tmp_path / "objects").as_uri()
    with open_store(*urls) as store:
        AuditLog(store.database).note(AuditEntry(Action.STORE_BACKED_UP))
    (tmp_path / "spindle.db").write_bytes(b"no database" * 1000)

    rebuild_store(*urls)

    with open_store(*urls) as store:
        [event] = events_of(store)
    assert (event["action"], event["id"]) == ("store_rebuilt", 1)
    assert json.loads(event["after"])["set_aside"] == ["spindle.db.damaged"]
    assert verify_audit(urls[0]).misfit is None


def test_what_a_full_disk_did_not_take_is_added_later_under_the_same_name(
    store: Store, monkeypatch: pytest.MonkeyPatch
) -> None:
    log = AuditLog(store.database)

    def full(database: Database, work: object) -> None:
        raise StoreError("The disk is full.")

    with monkeypatch.context() as patch:
        patch.setattr(Database, "write", full)
        log.note(AuditEntry(Action.UNIT_FAULTS_CLEARED, "ebl:A", unit_key="ebl:A"))
        log.close()
    assert events_of(store) == []

    log.catch_up()
    log.catch_up()

    assert [one["action"] for one in events_of(store)] == ["unit_faults_cleared"]
