"""Goal: what a bike was made for is seen by whoever connects, cannot be talked away, and a mistaken
market is refused in words.
"""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.fakes.server import ServerHere, SpindleServer, eventually


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[SpindleServer]:
    """One unit made for Japan, at rest."""
    devices = ["sim:tokyo?market=japan&clock=virtual&scenario=none"]
    with ServerHere(tmp_path_factory.mktemp("market"), devices) as running:
        yield running


def test_a_unit_for_japan_ends_assist_at_24_and_says_so(server: SpindleServer) -> None:
    limits = server.get(f"/devices/{server.ready_device()}/parts/limits")

    assert limits["market"] == "japan"
    assert limits["assist_cutoff_kmh"] == 24.0
    assert limits["effective_assist_cutoff_kmh"] == 24.0


def test_a_dealer_does_not_move_it_to_another_market(server: SpindleServer) -> None:
    device = server.ready_device()
    limits = server.get(f"/devices/{device}/parts/limits")

    response = server.client.put(
        f"/devices/{device}/parts/limits", json=limits | {"market": "eu_epac"}
    )

    assert response.status_code == 403
    assert server.get(f"/devices/{device}/parts/limits")["market"] == "japan"


def test_a_market_that_is_none_is_named_with_those_there_are(server: SpindleServer) -> None:
    device = server.ask("POST", "/devices", json={"url": "sim:mars?market=mars"})["id"]

    seen = eventually(
        lambda: server.get(f"/devices/{device}"), lambda seen: "mars" in str(seen["reason"])
    )

    assert "eu_epac" in seen["reason"]
    server.ask("DELETE", f"/devices/{device}")
