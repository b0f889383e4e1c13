"""Goal: what a bike was made for is seen by whoever connects, and its table is judged by it; a
mistaken market is refused in words. Nobody talks it away: tests/unit/tuning/test_typed_parts.py.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from spindle.client import Spindle
from tests.fakes.server import ServerHere, SpindleServer, eventually


@pytest.fixture(scope="module")
def tokyo(tmp_path_factory: pytest.TempPathFactory) -> Iterator[SpindleServer]:
    """One unit made for Japan, at rest."""
    devices = ["sim:tokyo?market=japan&clock=virtual&scenario=none"]
    with ServerHere(tmp_path_factory.mktemp("market"), devices) as running:
        yield running


def test_a_unit_for_japan_ends_assist_at_24_and_says_so(tokyo: SpindleServer) -> None:
    limits = tokyo.get(f"/devices/{tokyo.ready_device()}/parts/limits")

    assert limits["market"] == "japan"
    assert limits["assist_cutoff_kmh"] == 24.0
    assert limits["effective_assist_cutoff_kmh"] == 24.0


def test_a_market_that_is_none_is_named_with_those_there_are(server: SpindleServer) -> None:
    device = server.ask("POST", "/devices", json={"url": "sim:mars?market=mars"})["id"]

    seen = eventually(
        lambda: server.get(f"/devices/{device}"), lambda seen: "mars" in str(seen["reason"])
    )

    assert "eu_epac" in seen["reason"]
    server.ask("DELETE", f"/devices/{device}")


def test_what_the_unit_says_of_its_limits_is_what_the_linter_judges(
    server: SpindleServer, device: str
) -> None:
    limits = server.get(f"/devices/{device}/parts/limits")
    assert (limits["market"], limits["effective_assist_cutoff_kmh"]) == ("eu_epac", 25.0)
    assert Spindle(server.url).unit(device).limits().effective_assist_cutoff_kmh == 25.0

    def codes(market: str) -> set[str]:
        question: dict[str, Any] = {
            "fuzzy_table": server.get(f"/devices/{device}/parts/fuzzy_table"),
            "assist_modes": server.get(f"/devices/{device}/parts/assist_modes"),
            "limits": limits | {"market": market},
        }
        report = server.ask("POST", "/lint", json=question)
        return {finding["code"] for kind in report.values() for finding in kind}

    told = {"cutoff_above_market", "peak_above_market", "ratio_above_market"}
    assert told <= codes("japan")
    assert not told & codes("eu_epac")
