"""A server with a workshop's dealer and two riders, each with a bike of their own and a ride."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import httpx

from backend.core.person import Person, RoleName
from tests.fakes.house import PASSWORD
from tests.fakes.server import ServerHere
from tests.fakes.track_files import gpx_file, gpx_track

RIDERS = ("Rita", "Olaf")


@dataclass
class Workshop:
    """clients: signed in, by the name of their account. bikes, rides, uploads: one of each rider,
    by the rider's name."""

    server: ServerHere
    clients: dict[str, httpx.Client]
    people: dict[str, Person]
    bikes: dict[str, int] = field(default_factory=dict)
    rides: dict[str, int] = field(default_factory=dict)
    uploads: dict[str, str] = field(default_factory=dict)

    def ask(self, who: str, method: str, path: str, **request: Any) -> Any:
        """The JSON of somebody's request that must succeed."""
        answer = self.clients[who].request(method, path, **request)
        assert answer.is_success, f"{who} {method} {path}: {answer.status_code} {answer.text}"
        return answer.json() if answer.content else None

    def refused(self, who: str, method: str, path: str, **request: Any) -> tuple[int, str]:
        """Status and code of somebody's request that must not succeed."""
        answer = self.clients[who].request(method, path, **request)
        assert answer.is_error, f"{who} {method} {path}: {answer.status_code}"
        return answer.status_code, answer.json()["code"]

    def pair(self, bike_id: int, who: str, **body: Any) -> None:
        """The dealer makes a code and somebody takes it."""
        code = self.ask("Ben", "POST", f"/bikes/{bike_id}/pairing", json=body)["code"]
        self.ask(who, "POST", f"/pairings/{code}")

    def old_bike(self, who: str) -> int:
        """A bike that has been somebody's for longer than any file here is old."""
        bike = self.ask("Ben", "POST", "/bikes", json={"name": "rental"})["bike"]["id"]
        self.pair(bike, who, owned_from="2000-01-01T00:00:00Z")
        return int(bike)

    def send(self, who: str, name: str, content: bytes) -> dict[str, Any]:
        """What became of a file that somebody sent."""
        answer: dict[str, Any] = self.ask(
            who, "POST", f"/rides/import?name={name}", content=content
        )
        return answer


def add_account(server: ServerHere, name: str, role: RoleName) -> tuple[Person, httpx.Client]:
    """A new account, and a browser that it is signed in with."""
    people = server.services.people
    assert people is not None
    person = people.accounts.add(name, role, PASSWORD)
    token, _ = people.sign_in.sign_in(name, PASSWORD, "here")
    client = httpx.Client(
        base_url=f"{server.url}/api/v1",
        headers={"origin": server.url},
        cookies={"spindle_session": token},
        timeout=30.0,
        trust_env=False,
    )
    return person, client


@contextmanager
def open_workshop(folder: Path) -> Iterator[Workshop]:
    """The workshop on an empty folder: Anna administers, Ben deals, Rita and Olaf ride."""
    with ExitStack() as closing:
        server = closing.enter_context(ServerHere(folder / "data", SPINDLE_AUTH="required"))
        roles: dict[str, RoleName] = {"Anna": "admin", "Ben": "dealer"}
        workshop = Workshop(server, {}, {})
        for name in ("Anna", "Ben", *RIDERS):
            person, client = add_account(server, name, roles.get(name, "rider"))
            workshop.people[name] = person
            workshop.clients[name] = closing.enter_context(client)
        for number, name in enumerate(RIDERS):
            bike = workshop.ask("Ben", "POST", "/bikes", json={"name": f"{name}'s bike"})
            workshop.bikes[name] = bike["bike"]["id"]
            workshop.pair(workshop.bikes[name], name)
            track = gpx_file(gpx_track((1000 * number, 1000 * number + 120)))
            upload = workshop.send(name, f"{name}.gpx", track)
            workshop.uploads[name], [workshop.rides[name]] = upload["id"], upload["ride_ids"]
        yield workshop
