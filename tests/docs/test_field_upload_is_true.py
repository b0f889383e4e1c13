"""Goal: the script of docs/field-upload.md brings fifty logs over a line that drops, each once.

Method: the script as the page has it, run by `sh` with `curl`, to a server behind a relay that ends
many connections in the middle of what they say.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from pathlib import Path
from urllib.parse import urlsplit

import pytest

from tests.fakes.bad_line import BadLine
from tests.fakes.track_files import gpx_file, gpx_track
from tests.fakes.workshop import open_workshop

pytestmark = pytest.mark.slow
PAGE = Path(__file__).resolve().parents[2] / "docs" / "field-upload.md"
LOGS = 50


def run_script(
    folder: Path, port: int, key: str, files: list[Path], **environment: str
) -> subprocess.CompletedProcess[str]:
    """The page's script, at its end; its pauses are shorter."""
    (script,) = re.findall(r"(?s)```sh\n(.*?)```", PAGE.read_text(encoding="utf-8"))
    at = folder / "send.sh"
    at.write_text(script.replace("sleep 1", "sleep 0.02"))
    return subprocess.run(
        [shutil.which("sh") or "sh", at, f"http://127.0.0.1:{port}", *files],
        env={**os.environ, "SPINDLE_KEY": key, **environment},
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
    )


def sent_by_script(folder: Path, port: int, key: str, files: list[Path]) -> str:
    """What it prints, which is what became of the files."""
    if shutil.which("curl") is None:
        pytest.fail("curl is not installed: .ci/ensure-tools curl", pytrace=False)
    return run_script(folder, port, key, files).stdout


def test_without_curl_it_says_so_and_ends(tmp_path: Path) -> None:
    done = run_script(tmp_path, 1, "sp_x", [tmp_path / "log.gpx"], PATH=str(tmp_path))
    assert done.returncode == 127
    assert "curl" in done.stderr
    assert done.stdout == ""


def test_the_field_sends_fifty_logs_over_a_bad_line(tmp_path: Path) -> None:
    files = []
    for number in range(LOGS):
        files.append(tmp_path / f"log {number}.gpx")
        files[-1].write_bytes(gpx_file(gpx_track((10_000 + 500 * number, 10_300 + 500 * number))))
    damaged = tmp_path / "damaged.gpx"
    damaged.write_bytes(gpx_file(gpx_track((60_000, 60_300)))[:-9_000])
    no_ride = tmp_path / "no ride.bin"
    no_ride.write_bytes(b"\x00\x01" * 30_000)
    with open_workshop(tmp_path / "server") as workshop:
        bike = workshop.old_bike("Rita")
        body = {"name": "logger", "scopes": ["upload_files"], "bike_id": bike}
        made = workshop.ask("Ben", "POST", "/keys", json=body)
        line = BadLine(urlsplit(workshop.server.url).port or 0)

        first = sent_by_script(tmp_path, line.port, made["secret"], files[:30])
        # The logger's battery was empty; it begins anew with all it has.
        rest = sent_by_script(tmp_path, line.port, made["secret"], [*files, damaged, no_ride])

        assert first.count('"state":"complete"') == 30
        assert rest.count('"state":"complete"') == LOGS
        assert '"state":"rejected"' in next(one for one in rest.splitlines() if "no ride" in one)
        assert line.dropped > LOGS / 2
        rides = workshop.ask("Rita", "GET", f"/rides?limit=100&bike={bike}")["items"]
        # The damaged file is a ride as far as it can be read.
        assert len(rides) == LOGS + 1
        keys = workshop.ask("Ben", "GET", "/keys")["items"]
        assert keys[0]["used_at"] is not None

        workshop.ask("Ben", "DELETE", f"/keys/{made['key']['id']}")
        assert sent_by_script(tmp_path, line.port, made["secret"], files[:1]) == ""
        line.close()
