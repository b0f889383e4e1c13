"""Goal: the server answers whatever is asked as its description says: no server error, no status,
content type, header or body that is not described, and nothing accepted that it forbids. One of
schemathesis' checks is left out: that whatever fits the schema is accepted. Which values fit
together, the unit says.

Method: schemathesis makes requests from the OpenAPI description, good and bad ones, and holds the
answers against it; behind the server is a simulated unit in virtual time, which half of them meet.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import Any

import pytest
import schemathesis
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st
from hypothesis.errors import Unsatisfiable
from schemathesis import GenerationMode
from schemathesis.checks import not_a_server_error
from schemathesis.specs.openapi.checks import (
    content_type_conformance,
    missing_required_header,
    negative_data_rejection,
    response_headers_conformance,
    response_schema_conformance,
    status_code_conformance,
    unsupported_method,
)

from backend.api.app import ApiSettings, create_app
from tests import counts
from tests.fakes.server import ServerProcess, SpindleServer

pytestmark = [pytest.mark.slow, pytest.mark.large_count]

# Enough to find what is wrong with a route at first sight; a night finds more.
EXAMPLES = counts.of(6, least=2)
# Of a request to a unit that some other request added, on a port where there is none.
ABSENT = {"not_connected", "no_answer"}


def no_fault_of_the_server(context: Any, response: Any, case: Any) -> bool | None:
    """An answer of 500 and more is a fault, unless it tells that a unit is not there."""
    if response.status_code in (503, 504) and response.json().get("code") in ABSENT:
        return None
    return not_a_server_error(context, response, case)


CHECKS = [
    no_fault_of_the_server,
    status_code_conformance,
    content_type_conformance,
    response_headers_conformance,
    response_schema_conformance,
    missing_required_header,
    negative_data_rejection,
    unsupported_method,
]


DESCRIPTION = schemathesis.openapi.from_dict(create_app(ApiSettings(version="0")).openapi())
OPERATIONS = {found.ok().label: found.ok() for found in DESCRIPTION.get_all_operations()}


@pytest.fixture(scope="module")
def unit(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[SpindleServer, str]]:
    """A server and the id of its one unit."""
    folder = tmp_path_factory.mktemp("described")
    server = ServerProcess(folder, ["sim?clock=virtual&scenario=none"]).start()
    yield server, server.ready_device()
    server.stop()


@pytest.mark.parametrize("mode", list(GenerationMode), ids=lambda mode: mode.value)
@pytest.mark.parametrize("label", OPERATIONS)
def test_every_answer_is_as_described(
    unit: tuple[SpindleServer, str], label: str, mode: GenerationMode
) -> None:
    server, device = unit
    operation = OPERATIONS[label]

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
        if "device_id" in (case.path_parameters or {}) and of_the_unit and not removes(label):
            case.path_parameters["device_id"] = device
        if label.endswith("/advance") and mode is GenerationMode.POSITIVE:
            # A day of the unit's time is a minute of ours.
            case.body["seconds"] = 0.5
        case.call_and_validate(base_url=server.url, checks=CHECKS, timeout=60)

    # What takes nothing cannot be asked wrongly.
    with contextlib.suppress(Unsatisfiable):
        asked()


def removes(label: str) -> bool:
    """Whether an operation takes units away."""
    return label == "DELETE /api/v1/devices/{device_id}"
