"""Goal: the server answers whatever is asked as its description says: no server error, no status,
content type, header or body that is not described, and nothing accepted that it forbids. One of
schemathesis' checks is left out: that whatever fits the schema is accepted. Which values fit
together, the unit says.

Method: schemathesis makes requests from the OpenAPI description, good and bad ones, and holds the
answers against it; behind the server is a simulated unit in virtual time, which half of them meet.
The operations are known once the application is built, hence parts of a fixed number: who only
collects tests builds none.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import pytest

from tests import counts
from tests.fakes.api import description
from tests.fakes.server import ServerHere, SpindleServer

pytestmark = [pytest.mark.slow, pytest.mark.large_count]

# Enough to find what is wrong with a route at first sight; a night finds more.
EXAMPLES = counts.of(6)
PARTS = 8
FILES = ("application/zip", "image/jpeg", "image/png", "image/webp")
# Of a request to a unit that some other request added, on a port where there is none.
ABSENT = {"not_connected", "no_answer"}


@dataclass(frozen=True)
class Asker:
    """Makes requests to the server and its one unit, and judges the answers."""

    server: SpindleServer
    device: str
    session: Any
    operations: list[Any]
    checks: list[Any]

    def ask(self, operation: Any, mode: Any) -> None:
        """Asks for an operation, some times; raises where an answer is not as described."""
        from hypothesis import HealthCheck, Phase, given, settings
        from hypothesis import strategies as st

        @settings(
            max_examples=EXAMPLES,
            deadline=None,
            derandomize=True,
            database=None,
            phases=(Phase.explicit, Phase.generate),
            suppress_health_check=list(HealthCheck),
        )
        @given(operation.as_strategy(generation_mode=mode), st.booleans())
        def asked(case: Any, of_the_unit: bool) -> None:
            # Half of what asks for a unit asks for the one there is; nobody removes it.
            removes = operation.label == "DELETE /api/v1/devices/{device_id}"
            if "device_id" in (case.path_parameters or {}) and of_the_unit and not removes:
                case.path_parameters["device_id"] = self.device
            if operation.label.endswith("/advance") and mode.value == "positive":
                # A day of the unit's time is a minute of ours.
                case.body["seconds"] = 0.5
            case.call_and_validate(
                base_url=self.server.url, session=self.session, checks=self.checks, timeout=60
            )

        asked()


@pytest.fixture(scope="module")
def asker(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Asker]:
    import requests
    import schemathesis
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

    judged = [
        no_fault_of_the_server,
        checks.status_code_conformance,
        checks.content_type_conformance,
        checks.response_headers_conformance,
        checks.response_schema_conformance,
        checks.missing_required_header,
        refused_if_wrong,
        checks.unsupported_method,
    ]
    # Bytes as they are, like any other file.
    schemathesis.serializer.alias([*FILES], "application/octet-stream")
    described = schemathesis.openapi.from_dict(description())
    operations = [found.ok() for found in described.get_all_operations()]
    unit = "sim?clock=virtual&scenario=none"
    with ServerHere(tmp_path_factory.mktemp("described"), [unit]) as server:
        device = server.ready_device()
        server.advance(device, 0.1)
        with requests.Session() as session:
            session.trust_env = False
            yield Asker(server, device, session, operations, judged)


def cannot_be_asked_wrongly(operation: Any) -> bool:
    """What takes nothing but texts in its address takes every one."""
    text = {"type": "string"}
    return not list(operation.body) and all(
        str(one.location.value) == "path" and text.items() <= one.definition["schema"].items()
        and not {"enum", "format", "pattern", "maxLength"} & set(one.definition["schema"])
        for one in operation.iter_parameters()
    )  # fmt: skip


@pytest.mark.parametrize("mode", ["positive", "negative"])
@pytest.mark.parametrize("part", range(PARTS))
def test_every_answer_is_as_described(
    asker: Asker, part: int, mode: str, subtests: pytest.Subtests
) -> None:
    from schemathesis import GenerationMode

    for operation in asker.operations[part::PARTS]:
        if mode == "negative" and cannot_be_asked_wrongly(operation):
            continue
        with subtests.test(operation=operation.label):
            asker.ask(operation, GenerationMode(mode))
