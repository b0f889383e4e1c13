"""Goal: the server answers whatever is asked as its description says: no server error, no status,
content type, header or body that is not described, and nothing accepted that it forbids; where
people sign in, for a stranger and for a rider, too. One of schemathesis' checks is left out: that
whatever fits the schema is accepted. Which values fit together, the unit says.

Method: schemathesis makes requests from the OpenAPI description, good and bad ones, and holds the
answers against it. Behind one server is a simulated unit in virtual time, behind the other are a
workshop and its riders. Half of the requests meet the unit, a rider's all meet what is theirs. The
operations are known once the application is built, hence parts of a fixed number: who only collects
tests builds none.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import pytest
import requests

from backend.app import STRANGERS
from tests import counts
from tests.fakes.api import description
from tests.fakes.server import ServerHere
from tests.fakes.workshop import Workshop, open_workshop

pytestmark = [pytest.mark.slow, pytest.mark.large_count]

# Enough to find what is wrong with a route at first sight; a night finds more.
EXAMPLES = counts.of(6)
PARTS = 8
FILES = ("application/zip", "image/jpeg", "image/png", "image/webp")
# Would take from a rider what the rest of the requests meet.
OF_A_RIDER = frozenset(
    {
        "DELETE /api/v1/session",
        "POST /api/v1/rides/delete",
        "DELETE /api/v1/bikes/{bike_id}/owner",
        "DELETE /api/v1/rides/{ride_id}",
        "DELETE /api/v1/uploads/{upload_id}",
    }
)
# Of a request to a unit that some other request added, on a port where there is none.
ABSENT = {"not_connected", "no_answer"}


@dataclass(frozen=True)
class Asker:
    """Makes requests to a server, and judges the answers.

    known: what half of the requests meet, or every one, by the name of its place in a path.
    spared: operations that would end what the others need.
    """

    url: str
    session: requests.Session
    known: Mapping[str, str | int]
    spared: frozenset[str]
    checks: list[Any]
    examples: int = EXAMPLES
    every: bool = False

    def ask(self, operation: Any, mode: Any) -> None:
        """Asks for an operation, some times; raises where an answer is not as described."""
        from hypothesis import HealthCheck, Phase, given, settings
        from hypothesis import strategies as st

        @settings(
            max_examples=self.examples,
            deadline=None,
            derandomize=True,
            database=None,
            phases=(Phase.explicit, Phase.generate),
            suppress_health_check=list(HealthCheck),
        )
        @given(
            operation.as_strategy(generation_mode=mode),
            st.just(True) if self.every else st.booleans(),
        )
        def asked(case: Any, of_what_is_there: bool) -> None:
            places = case.path_parameters or {}
            if of_what_is_there and operation.label not in self.spared:
                places.update({name: self.known[name] for name in places.keys() & self.known})
            if operation.label.endswith("/advance") and mode.value == "positive":
                # A day of the unit's time is a minute of ours.
                case.body["seconds"] = 0.5
            case.call_and_validate(
                base_url=self.url, session=self.session, checks=self.checks, timeout=60
            )

        asked()


@pytest.fixture(scope="module")
def operations() -> list[Any]:
    import schemathesis

    # Bytes as they are, like any other file.
    schemathesis.serializer.alias([*FILES], "application/octet-stream")
    described = schemathesis.openapi.from_dict(description())
    return [found.ok() for found in described.get_all_operations()]


def judges() -> list[Any]:
    """What holds an answer against the description."""
    from schemathesis.checks import not_a_server_error
    from schemathesis.specs.openapi import checks

    def no_fault_of_the_server(context: Any, response: Any, case: Any) -> bool | None:
        """An answer of 500 and more is a fault, unless it tells that a unit is not there."""
        if response.status_code in (503, 504) and response.json().get("code") in ABSENT:
            return None
        return not_a_server_error(context, response, case)

    def refused_if_wrong(context: Any, response: Any, case: Any) -> bool | None:
        """What names another unit is refused before anything else is looked at."""
        if response.status_code == 412 and response.json().get("code") == "other_unit":
            return None
        return checks.negative_data_rejection(context, response, case)

    return [
        no_fault_of_the_server,
        checks.status_code_conformance,
        checks.content_type_conformance,
        checks.response_headers_conformance,
        checks.response_schema_conformance,
        checks.missing_required_header,
        refused_if_wrong,
        checks.unsupported_method,
    ]


@pytest.fixture(scope="module")
def asker(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Asker]:
    unit = "sim?clock=virtual&scenario=none"
    with ServerHere(tmp_path_factory.mktemp("described"), [unit]) as server:
        device = server.ready_device()
        server.advance(device, 0.1)
        with requests.Session() as session:
            session.trust_env = False
            spared = frozenset({"DELETE /api/v1/devices/{device_id}"})
            yield Asker(server.url, session, {"device_id": device}, spared, judges())


@pytest.fixture(scope="module")
def workshop(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Workshop]:
    with open_workshop(tmp_path_factory.mktemp("workshop")) as opened:
        yield opened


@pytest.fixture(scope="module", params=["stranger", "Rita"])
def somebody(request: pytest.FixtureRequest, workshop: Workshop) -> Iterator[Asker]:
    """A stranger, who is refused everything else than to sign in; a rider, who has a bike."""
    who, url = request.param, workshop.server.url

    def a_stranger_is_refused(context: Any, response: Any, case: Any) -> None:
        place = (case.operation.method.upper(), case.operation.path)
        assert response.status_code == 401 or place in STRANGERS, place

    with requests.Session() as session:
        session.trust_env = False
        session.headers["origin"] = url
        checks, spared = judges(), frozenset[str]()
        if who == "stranger":
            checks.append(a_stranger_is_refused)
        else:
            spared = OF_A_RIDER
            session.cookies.update(dict(workshop.clients[who].cookies))
        places = (workshop.bikes, workshop.rides, workshop.uploads)
        known = {
            name: of["Rita"]
            for name, of in zip(("bike_id", "ride_id", "upload_id"), places, strict=True)
        }
        yield Asker(url, session, known, spared, checks, examples=counts.of(2), every=True)


def cannot_be_asked_wrongly(operation: Any) -> bool:
    """What takes nothing but texts in its address takes every one."""
    text = {"type": "string"}
    return not list(operation.body) and all(
        str(one.location.value) == "path" and text.items() <= one.definition["schema"].items()
        and not {"enum", "format", "pattern", "maxLength"} & set(one.definition["schema"])
        for one in operation.iter_parameters()
    )  # fmt: skip


def ask_each(asker: Asker, operations: list[Any], mode: str, subtests: pytest.Subtests) -> None:
    """Asks for each of the operations that can be asked in a mode."""
    from schemathesis import GenerationMode

    for operation in operations:
        if mode == "negative" and cannot_be_asked_wrongly(operation):
            continue
        with subtests.test(operation=operation.label):
            asker.ask(operation, GenerationMode(mode))


@pytest.mark.parametrize("mode", ["positive", "negative"])
@pytest.mark.parametrize("part", range(PARTS))
def test_every_answer_is_as_described(
    asker: Asker, operations: list[Any], part: int, mode: str, subtests: pytest.Subtests
) -> None:
    ask_each(asker, operations[part::PARTS], mode, subtests)


@pytest.mark.parametrize("mode", ["positive", "negative"])
def test_every_answer_where_people_sign_in_is_as_described(
    somebody: Asker, operations: list[Any], mode: str, subtests: pytest.Subtests
) -> None:
    others = [one for one in operations if one.label not in somebody.spared]
    ask_each(somebody, others, mode, subtests)
