"""Goal: what a dealer keeps in the library can be compared with what a unit has or had, and travels
as a file; nothing of it writes to the unit.

Method: the command, in this process, against a whole server with a simulated unit.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from tests.fakes import command
from tests.fakes.server import SpindleServer


def test_a_dealer_keeps_compares_and_hands_on(
    server: SpindleServer, device: str, tmp_path: Path
) -> None:
    def spindle(*words: str | Path) -> Any:
        done = command.spindle(server, *words, "--json")
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout) if done.stdout else None

    before = server.get(f"/devices/{device}/config")
    document, fis = tmp_path / "mine.json", tmp_path / "mine.fis"

    spindle("device", "backup", "--output", document)
    body = json.loads(document.read_text()) | {"name": "as delivered"}
    document.write_text(json.dumps(body))
    row = spindle("api", "POST", "/library", "--input", document, "--author", "Wang")
    spindle("device", "set", "torque_filter_s=0.7", "--author", "Li")
    newest = server.get(f"/devices/{device}/config/revisions")["items"][0]
    kept, unit = f"left.library={row['id']}", f"right.device={device}"
    now = spindle("api", "POST", "/library/compare", kept, unit, "feel=true")
    was = spindle(
        "api", "POST", "/library/compare", kept, unit, f"right.revision={newest['seq'] - 1}"
    )
    server.until_writable(device)
    spindle("device", "set", "torque_filter_s=0.5")

    assert (row["kind"], row["author"], newest["author"]) == ("configuration", "Wang", "Li")
    assert [change["name"] for change in now["parameters"]] == ["torque_filter_s"]
    # A longer filter follows later.
    assert now["left"]["feel"]["lag_ms"] < now["right"]["feel"]["lag_ms"]
    assert was["parameters"] == []

    spindle("api", "GET", "/library/even/export", "format=fis", "-o", fis)
    taken = spindle("api", "POST", "/library/fis", f"text=@{fis}", "name=from MATLAB")
    again = server.ask("POST", "/library", json=taken["document"])
    gone = spindle("api", "DELETE", f"/library/{again['id']}", "-H", f"if-match: {again['etag']}")
    unseen = [entry["id"] for entry in spindle("api", "GET", "/library")["items"]]
    document.write_text(json.dumps(body | {"name": "mine"}))
    back = spindle("api", "PUT", f"/library/{again['id']}", "--input", document)

    assert taken["deviation"]["gain"] < 1e-6
    assert gone["deleted"]
    assert again["id"] not in unseen
    assert (back["version"], back["deleted"]) == (3, False)
    assert server.get(f"/devices/{device}/config")["parameters"] == before["parameters"]
