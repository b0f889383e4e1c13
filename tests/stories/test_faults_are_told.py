"""Goal: the API tells a unit's faults and forgets those that are over.

A simulated bike cannot be broken over the API, so what a fault looks like is proven against the
firmware in tests/simulation; here it is the way there and back, and the counts beside it.
"""

from __future__ import annotations

from tests.fakes.server import SpindleServer, eventually


def test_a_sound_bike_has_no_fault_and_nothing_to_forget(
    server: SpindleServer, device: str
) -> None:
    assert server.get(f"/devices/{device}/faults")["items"] == []
    assert server.ask("POST", f"/devices/{device}/faults/clear")["items"] == []


def test_the_link_s_books_balance_and_its_clock_is_known(
    server: SpindleServer, device: str
) -> None:
    server.advance(device, 5.0)
    link = eventually(
        lambda: server.get(f"/devices/{device}")["link"],
        lambda link: link["balance_built"] > 0 and link["clock_uncertainty_ms"] is not None,
    )

    parts = link["balance_received"] + link["balance_lost"] + link["balance_dropped"]
    assert link["balance_built"] == parts
    assert link["clock_uncertainty_ms"] > 0.0
