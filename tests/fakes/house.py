"""An application with accounts on SQLite and nothing else: who is let through meets a missing
service."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

from fastapi import FastAPI
from fastapi.testclient import TestClient

from backend.app import build_api
from backend.core.person import RoleName
from backend.people.service import PeopleService
from backend.services import Services
from backend.store import open_store
from backend.web.app import WebSettings
from backend.web.safety import AllowedHosts

ORDER: list[RoleName] = ["rider", "dealer", "engineer", "admin"]
PASSWORD = "eine lange Nacht"
ORIGIN = {"origin": "http://127.0.0.1"}


@dataclass
class House:
    """An application that asks who is there, its people, and who is signed in as what."""

    app: FastAPI
    people: PeopleService
    cookies: dict[str, str]

    def client(self, role: str | None = None, base: str = "http://127.0.0.1") -> TestClient:
        """A browser; signed in as the role."""
        client = TestClient(self.app, base_url=base, raise_server_exceptions=False)
        if role is not None:
            client.cookies.set("spindle_session", self.cookies[role])
        return client


@contextmanager
def open_house(folder: Path, now_s: Callable[[], float] = time.monotonic) -> Iterator[House]:
    """The house on an empty folder, with one account of every role, named after it."""
    with open_store(f"sqlite:///{folder}/spindle.db", (folder / "o").as_uri()) as store:
        people = PeopleService(store.database, now_s)
        app = build_api(
            WebSettings("test", AllowedHosts(frozenset({"workshop"})), guarded=True),
            cast(Services, None),
            people,
        )
        cookies = {}
        for role in reversed(ORDER):
            people.accounts.add(role, role, PASSWORD)
            cookies[role], _ = people.sign_in.sign_in(role, PASSWORD, "here")
        yield House(app, people, cookies)


def new_key(house: House, *scopes: str, role: RoleName = "admin", **more: Any) -> tuple[int, str]:
    """A key of the role's person: its number, and what a program sends."""
    whose = next(one.id for one in house.people.accounts.list() if one.name == role)
    body = {"name": "field", "scopes": list(scopes), "person_id": whose, **more}
    answer = house.client("admin").post("/api/v1/keys", json=body, headers=ORIGIN)
    assert answer.status_code == 201, answer.text
    return answer.json()["key"]["id"], answer.json()["secret"]


def bearer(secret: str) -> dict[str, str]:
    return {"authorization": f"Bearer {secret}"}
