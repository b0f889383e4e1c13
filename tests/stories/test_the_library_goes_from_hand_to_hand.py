"""Goal: what a dealer keeps in the library can be compared with what a unit has or had, and travels
as a file; nothing of it writes to the unit.

Method: the command, in this process, against a whole server with a simulated unit.
"""

from __future__ import annotations

import json
from functools import partial
from pathlib import Path

from tests.fakes import command
from tests.fakes.server import SpindleServer


def test_a_dealer_keeps_compares_and_hands_on(
    server: SpindleServer, device: str, tmp_path: Path
) -> None:
    spindle = partial(command.spindle, server)
    before = server.get(f"/devices/{device}/config")
    document, fis = tmp_path / "mine.json", tmp_path / "mine.fis"

    kept = spindle(
        "library", "add", "--unit", "--name", "as delivered", "--author", "Wang", "--json"
    )
    row = json.loads(kept.stdout)
    spindle("device", "set", "torque_filter_s=0.7", "--author", "Li")
    now = spindle("library", "compare", "as delivered", "unit", "--feel", "--json")
    newest = server.get(f"/devices/{device}/config/revisions")["items"][0]
    was = spindle("library", "compare", row["id"], f"unit@{newest['seq'] - 1}", "--json")
    told = spindle("library", "compare", "even", "unit")
    server.until_writable(device)
    spindle("device", "set", "torque_filter_s=0.5")

    assert kept.returncode == now.returncode == was.returncode == told.returncode == 0, now.stderr
    assert (row["kind"], row["author"], newest["author"]) == ("configuration", "Wang", "Li")
    compared = json.loads(now.stdout)
    assert [change["name"] for change in compared["parameters"]] == ["torque_filter_s"]
    # A longer filter follows later.
    felt = [compared[end]["feel"]["lag_ms"] for end in ("left", "right")]
    assert felt[0] < felt[1]
    assert json.loads(was.stdout)["parameters"] == []
    assert "rules differ. The gain differs by at most" in told.stdout

    spindle("library", "export", "even", "--format", "fis", "--output", fis)
    spindle("library", "export", "even", "--output", document)
    taken = spindle("library", "import", fis, "--name", "from MATLAB")
    again = spindle("library", "add", document, "--name", "mine")
    twice = spindle("library", "add", document, "--name", "mine")
    gone = spindle("library", "remove", "mine", "--json")
    unseen = spindle("library", "list")
    back = spindle(
        "library",
        "add",
        document,
        "--name",
        "mine",
        "--replace",
        json.loads(gone.stdout)["id"],
    )
    listed = spindle("library", "list", "--json")
    shown = spindle("library", "show", "mine")
    preset = spindle("library", "remove", "even")
    nobody = spindle("library", "add")

    assert "differs from the file by at most 0.0000" in taken.stdout
    codes = [run.returncode for run in (taken, again, twice, gone, back, shown, preset, nobody)]
    assert codes == [0, 0, 1, 0, 0, 0, 1, 2], [taken.stderr, again.stderr, back.stderr]
    assert "mine" not in [line.split()[1] for line in unseen.stdout.splitlines()]
    rows = {row["name"]: row for row in json.loads(listed.stdout)["items"]}
    assert (rows["mine"]["version"], rows["from MATLAB"]["kind"]) == (3, "table")
    assert "fuzzy_rules" in shown.stdout
    assert "comes with Spindle" in preset.stderr
    assert server.get(f"/devices/{device}/config")["parameters"] == before["parameters"]
