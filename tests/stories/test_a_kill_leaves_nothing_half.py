"""Goal: whoever signs in, takes a bike or writes a visit while the server dies finds it done wholly
or not at all, and all that was answered is there.

Method: a server in a process of its own and a day in its workshop, step by step. It is killed while
one of the steps is under way, at a moment of it that nobody chooses, and looked at after a new
start: each thing stands as after the steps that were answered, or as after one more.
"""

from __future__ import annotations

import io
import threading
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import httpx
import pytest
from PIL import Image

from tests.fakes.command import spindle
from tests.fakes.server import ServerProcess, api_client

pytestmark = pytest.mark.slow
PASSWORD = "eine lange Nacht"
# What is under way at the kill: signing in, joining by a code, taking a bike over, a visit begun,
# written, a photograph, its end, its consent. Each with a delay, so that it is met at more than its
# beginning.
KILLED_AT = (
    (0, 0.0),
    (3, 0.1),
    (6, 0.0),
    (7, 0.004),
    (8, 0.002),
    (9, 0.03),
    (10, 0.0),
    (11, 0.003),
)
# Done, photographs, state and consent of a visit after each of the steps from its beginning.
STAGES = (
    None,
    ("", 0, "open", False),
    ("oiled", 0, "open", False),
    ("oiled", 1, "open", False),
    ("oiled", 1, "closed", False),
    ("oiled", 1, "closed", True),
)
BEGUN = 7


def picture() -> bytes:
    data = io.BytesIO()
    Image.new("RGB", (900, 600), "sienna").save(data, "JPEG")
    return data.getvalue()


@dataclass
class Day:
    """A day in the workshop with one bike and one new rider; answered: steps, in their order."""

    url: str
    number: int
    answered: int = 0
    bike: int = 0
    visit: int = 0
    codes: list[str] = field(default_factory=list)
    clients: dict[str, httpx.Client] = field(default_factory=dict)
    went_on: threading.Condition = field(default_factory=threading.Condition)

    @property
    def rider(self) -> str:
        return f"Rita {self.number}"

    def ask(self, who: str, method: str, path: str, **request: Any) -> Any:
        if who not in self.clients:
            self.clients[who] = api_client(self.url, origin=self.url)
        answer = self.clients[who].request(method, path, **request)
        assert answer.is_success, f"{who} {method} {path}: {answer.text}"
        return answer.json() if answer.content else None

    def sign_in(self, who: str) -> None:
        self.ask(who, "POST", "/sign-in", json={"name": who, "password": PASSWORD})

    def add_bike(self) -> None:
        made = self.ask("Ben", "POST", "/bikes", json={"name": f"bike {self.number}"})
        self.bike = made["bike"]["id"]

    def make_code(self, who: str) -> None:
        self.codes.append(self.ask(who, "POST", f"/bikes/{self.bike}/pairing", json={})["code"])

    def join(self) -> None:
        body = {"name": self.rider, "password": PASSWORD}
        self.ask(self.rider, "POST", f"/pairings/{self.codes[0]}/account", json=body)

    def open_visit(self) -> None:
        body = {"complaint": "it bucks", "customer": "Frau Müller"}
        self.visit = self.ask("Ben", "POST", f"/bikes/{self.bike}/visits", json=body)["id"]

    def of_visit(self, method: str, end: str = "", **request: Any) -> None:
        self.ask("Ben", method, f"/visits/{self.visit}{end}", **request)

    def consent(self) -> None:
        seen = self.ask("Olaf", "GET", f"/visits/{self.visit}")
        body = {"content_sha256": seen["content_sha256"]}
        self.ask("Olaf", "POST", f"/visits/{self.visit}/consent", json=body)

    def steps(self) -> list[Callable[[], None]]:
        return [
            lambda: self.sign_in("Ben"),
            self.add_bike,
            lambda: self.make_code("Ben"),
            self.join,
            lambda: self.make_code(self.rider),
            lambda: self.sign_in("Olaf"),
            lambda: self.ask("Olaf", "POST", f"/pairings/{self.codes[1]}"),
            self.open_visit,
            lambda: self.of_visit("PATCH", json={"version": 1, "done": "oiled"}),
            lambda: self.of_visit("POST", "/photos?name=a.jpg", content=picture()),
            lambda: self.of_visit("POST", "/close"),
            self.consent,
        ]

    def live(self) -> None:
        """Goes through the day until the server dies."""
        with suppress(httpx.TransportError):
            for step in self.steps():
                step()
                with self.went_on:
                    self.answered += 1
                    self.went_on.notify_all()


def killed_in(server: ServerProcess, day: Day, step: int, delay_s: float) -> None:
    """Kill a server while a step of the day is under way."""
    living = threading.Thread(target=day.live)
    living.start()
    with day.went_on:
        assert day.went_on.wait_for(lambda: day.answered >= step, timeout=120)
        # A step that ended in this time makes way for the next one.
        day.went_on.wait(delay_s)
    server.kill()
    living.join()


def whole_steps(day: Day, answered: int) -> tuple[int, int]:
    """How many steps may be done: those answered, and one more."""
    return answered, min(answered + 1, len(day.steps()))


def look_at(server: ServerProcess, day: Day, admin: Day) -> None:
    """What became of a day, after a new start."""
    least, most = whole_steps(day, day.answered)
    if day.answered > 0:
        # The session that was answered is one.
        cookies = day.clients["Ben"].cookies
        with httpx.Client(base_url=f"{server.url}/api/v1", cookies=cookies, timeout=30.0) as ben:
            assert ben.get("/session").json()["signed_in"]["person"]["name"] == "Ben"
    bikes = {one["name"]: one["id"] for one in admin.ask("Anna", "GET", "/bikes")["items"]}
    name = f"bike {day.number}"
    assert (name in bikes) in (least > 1, most > 1)
    if name not in bikes:
        return
    owners = admin.ask("Anna", "GET", f"/bikes/{bikes[name]}")["owners"]
    now = [one["name"] for one in owners if one["until"] is None]
    # Who joined has the bike, and who took it over has it alone.
    people = {one["name"] for one in admin.ask("Anna", "GET", "/people")["items"]}
    joined = day.rider in people
    assert joined in (least > 3, most > 3)
    assert joined == (day.rider in [one["name"] for one in owners])
    taken = now == ["Olaf"]
    assert taken in (least > 6, most > 6)
    assert now == (["Olaf"] if taken else [day.rider] if joined else [])
    # A code is good until it was taken, and no longer.
    for code, used in zip(day.codes, (joined, taken), strict=False):
        assert admin.clients["Anna"].get(f"/pairings/{code}").is_success is not used
    visits = admin.ask("Anna", "GET", f"/bikes/{bikes[name]}/visits")["items"]
    assert len(visits) <= 1
    stage = stage_of(visits[0]) if visits else None
    possible = [STAGES[max(0, done - BEGUN)] for done in (least, most)]
    assert stage in possible
    for photo in visits[0]["content"]["photos"] if visits else ():
        path = f"/visits/{visits[0]['id']}/photos/{photo['sha256']}"
        with Image.open(io.BytesIO(admin.clients["Anna"].get(path).content)) as shown:
            assert shown.size == (900, 600)


def stage_of(visit: dict[str, Any]) -> tuple[str, int, str, bool]:
    content = visit["content"]
    return content["done"], len(content["photos"]), visit["state"], visit["consent_holds"]


def test_a_server_that_is_killed_leaves_nothing_half(tmp_path: Path) -> None:
    data = tmp_path / "data"
    for name, role in (("Anna", "admin"), ("Ben", "dealer"), ("Olaf", "rider")):
        words = ("people", "add", name, "--role", role, "--password-stdin", "--data", data)
        assert spindle(None, *words, stdin=f"{PASSWORD}\n").returncode == 0
    days: list[Day] = []

    for number, (step, delay_s) in enumerate((*KILLED_AT, (0, 0.0))):
        server = ServerProcess(data, [], SPINDLE_AUTH="required").start()
        admin = Day(server.url, -1)
        admin.sign_in("Anna")
        for day in days:
            look_at(server, day, admin)
        assert spindle(None, "audit", "verify", "--data", data).returncode == 0
        days.append(Day(server.url, number))
        killed_in(server, days[-1], step, delay_s)

    assert [day.answered >= step for day, (step, _) in zip(days, KILLED_AT, strict=False)] == (
        [True] * len(KILLED_AT)
    )
    found = spindle(None, "store", "check", "--data", data)
    assert found.returncode == 0, found.stdout
