"""Goal: whoever helps from afar gets what a unit says of itself, and nothing of people or places.

Method: a server with a simulated unit that has an owner's name, a reason with an address in it, and
a ride; then the same unit away.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.fakes.server import ServerHere

pytestmark = pytest.mark.slow
PRIVATE = ("Annas Rad", "Müller", "Hauptstraße", "bench", "author", 'reason"')


def test_it_has_what_the_unit_says_and_no_word_of_people(tmp_path: Path) -> None:
    with ServerHere(tmp_path, ["sim:bench?clock=virtual"]) as server:
        device = server.ready_device()
        server.ask("POST", "/devices", json={"url": "sim:bench?clock=virtual", "name": "Annas Rad"})
        server.configure(device, "für Frau Müller, Hauptstraße 5", pedal_stop_ms=420)

        here = server.get(f"/devices/{device}/support")

        assert here["identity"]["serial_number"]
        assert here["parameters"]["pedal_stop_ms"] == 420
        assert [one["name"] for one in here["checks"]["checks"]][:2] == ["zero", "drift"]
        newest = here["revisions"][0]
        assert [one["name"] for one in newest["changed"]] == ["pedal_stop_ms"]
        text = json.dumps(here | {"left_out": []}, ensure_ascii=False)
        assert [word for word in PRIVATE if word in text] == []
        assert str(tmp_path) not in text

    with ServerHere(tmp_path, ["socket://127.0.0.1:9?family=ebl"]) as server:
        # Nobody is at this address, and nobody ever was.
        [other] = server.get("/devices")["items"]
        away = server.get(f"/devices/{other['id']}/support")
        assert (away["checks"], away["parameters"], away["revisions"]) == (None, None, [])
        assert "127.0.0.1" not in json.dumps(away)
