"""Goal: what the pages can do, a shell can do: same verbs, JSON on request, honest exit codes.

Exit 0 done, 1 refused with the reason, 2 wrong usage (contract, Commands).
"""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from firmware_protocol.parameters import default_config
from tests.fakes.command import ROOT, Ran, spindle, spindle_process
from tests.fakes.fit_file import fit_ride
from tests.fakes.server import SpindleServer, eventually

WRONG = [
    ["device"],
    ["ride", "export", "not-a-number"],
    ["ride", "import", "a.csv", "--column", "power"],
    ["ride", "import", "a.csv", "--dates", "year_first"],
    ["api", "GET"],
    ["api", "FETCH", "/devices"],
    ["api", "PATCH", "/devices/{unit}/config", "no-equals-sign"],
    ["api", "POST", "/lint", "--input", "no-such-file.json"],
    ["device", "set", "no-equals-sign"],
    ["device", "restore", "no-such-file.json"],
    ["serve", "--port", "99999"],
    ["fly"],
    ["scenario", "run", "moon"],
    ["scenario", "run", "kinematics", "--set", "speed_kmh"],
    ["scenario", "run", "kinematics", "--set", "speed_kmh=fast"],
    ["scenario", "run", "kinematics", "--set", "colour=red"],
    ["sim", "--tcp", "nowhere"],
]


def test_a_unit_is_listed_and_shown(server: SpindleServer, device: str) -> None:
    listed = spindle(server, "device", "list", "--json")
    shown = spindle(server, "device", "show")

    assert device in [item["id"] for item in json.loads(listed.stdout)["items"]]
    assert shown.returncode == 0
    assert device in shown.stdout
    assert "speed_kmh" in shown.stdout


def test_a_parameter_is_set_backed_up_compared_and_restored(
    server: SpindleServer, device: str, tmp_path: Path
) -> None:
    kept = tmp_path / "kept.json"

    backup = spindle(server, "device", "backup", "--output", kept)
    change = spindle(server, "device", "set", "torque_filter_s=0.7", "--reason", "a try")
    differing = spindle(server, "device", "diff", kept, "--json")
    server.until_writable(device)
    restore = spindle(server, "device", "restore", kept)
    value = spindle(server, "device", "get", "torque_filter_s", "--json")
    before = spindle(server, "device", "get", "torque_filter_s", "--bank", "previous", "--json")
    made = spindle(server, "device", "backup", "--bank", "default")

    assert backup.returncode == change.returncode == restore.returncode == 0, change.stderr
    assert [item["name"] for item in json.loads(differing.stdout)["changed"]] == ["torque_filter_s"]
    assert json.loads(value.stdout)["parameters"]["torque_filter_s"] == pytest.approx(0.5)
    assert json.loads(before.stdout)["parameters"]["torque_filter_s"] == pytest.approx(0.7)
    values = json.loads(made.stdout)["parameters"]
    assert {name: entry["value"] for name, entry in values.items()} == default_config()
    saved = json.loads(kept.read_text())
    assert (saved["format"], saved["version"]) == ("spindle-configuration", 1)
    assert saved["parameters"]["torque_filter_s"] == {"value": 0.5, "unit": "s"}
    assert saved["identity"]["serial_number"] == saved["name"]


def test_a_preset_is_a_backup_that_comes_with_spindle(
    server: SpindleServer, device: str, tmp_path: Path
) -> None:
    kept = tmp_path / "kept.json"
    spindle(server, "device", "backup", "--output", kept)

    listed = spindle(server, "device", "presets")
    differing = spindle(server, "device", "diff", "thesis", "--json")
    taken = spindle(server, "device", "restore", "thesis")
    band = spindle(server, "device", "get", "assist_cutoff_band_kmh", "--json")
    server.until_writable(device)
    back = spindle(server, "device", "restore", kept)

    assert "thesis" in listed.stdout
    missing = {change["name"] for change in json.loads(differing.stdout)["changed"]}
    assert "assist_cutoff_band_kmh" in missing
    assert taken.returncode == back.returncode == 0, taken.stderr
    assert json.loads(band.stdout)["parameters"]["assist_cutoff_band_kmh"] == 0.0


def test_a_table_says_that_it_moves_the_second_one_s_points(
    server: SpindleServer, device: str
) -> None:
    spindle(server, "device", "set", "mode_tables=[0,0,0,0,1]")
    server.until_writable(device)

    taken = spindle(server, "device", "restore", "even")
    again = spindle(server, "device", "restore", "even")

    assert "The second table, which a mode uses, shares its points" in taken.stdout
    assert again.stdout == "Nothing to restore.\n"


def test_a_table_that_comes_with_spindle_changes_the_table_alone(
    server: SpindleServer, device: str
) -> None:
    before = server.get(f"/devices/{device}/config")["parameters"]

    listed = spindle(server, "device", "presets", "--json")
    differing = spindle(server, "device", "diff", "strong-start", "--json")
    taken = spindle(server, "device", "restore", "strong-start")
    now = server.get(f"/devices/{device}/config")["parameters"]
    none_left = spindle(server, "device", "diff", "strong-start", "--json")
    server.until_writable(device)
    spindle(server, "device", "restore", "thesis-table")

    kinds = {item["name"]: item["kind"] for item in json.loads(listed.stdout)["items"]}
    assert (kinds["strong-start"], kinds["thesis"]) == ("table", "configuration")
    told = {change["name"] for change in json.loads(differing.stdout)["changed"]}
    assert taken.returncode == 0, taken.stderr
    assert told == {name for name in before if before[name] != now[name]}
    assert "fuzzy_rules" in told
    assert all(name.startswith("fuzzy_") for name in told)
    assert "second table" not in taken.stdout
    assert json.loads(none_left.stdout)["changed"] == []
    assert server.get(f"/devices/{device}/config")["parameters"] == before


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"family": "bbsfw"}, "is for a unit of the family bbsfw; this one is ebl"),
        ({"version": 2}, "version 2, and this Spindle reads version 1: use a newer one"),
        (
            {"parameters": {"torque_filter_s": {"value": 700, "unit": "ms"}}},
            "has torque_filter_s in 'ms'; this unit has it in 's'",
        ),
        ({"parameters": {"torque_filter_s": 0.7}}, "parameter torque_filter_s has no `value`"),
    ],
)
def test_a_file_for_another_unit_changes_nothing_and_says_why(
    server: SpindleServer, device: str, tmp_path: Path, change: dict[str, object], says: str
) -> None:
    kept = tmp_path / "kept.json"
    spindle(server, "device", "backup", "--output", kept)
    kept.write_text(json.dumps(json.loads(kept.read_text()) | change))
    before = server.get(f"/devices/{device}/config")

    restore = spindle(server, "device", "restore", kept)

    assert restore.returncode != 0
    assert says in restore.stderr
    assert server.get(f"/devices/{device}/config") == before


def test_a_refused_value_is_named_and_ends_with_one(server: SpindleServer, device: str) -> None:
    refused = spindle(server, "device", "set", "assist_cutoff_kmh=60")

    assert refused.returncode == 1
    assert "assist_cutoff_kmh" in refused.stderr
    assert refused.stdout == ""


def test_a_file_is_imported_listed_and_exported(server: SpindleServer, tmp_path: Path) -> None:
    file = tmp_path / "lunch.fit"
    file.write_bytes(fit_ride(1_600_000_000, [20.0] * 400, [75] * 400, [160] * 400))
    csv = tmp_path / "lunch.csv"

    result = spindle(server, "ride", "import", file, "--json")
    (ride,) = json.loads(result.stdout)["ride_ids"] or [result.stdout]
    shown = spindle(server, "ride", "show", str(ride))
    exported = spindle(server, "ride", "export", str(ride), "--output", csv)
    page = tmp_path / "lunch.html"
    told = ("--language", "zh", "--threshold-power-w", "160")
    reported = spindle(server, "ride", "report", str(ride), "-o", page, *told)
    listed = spindle(server, "ride", "list")
    card = eventually(lambda: server.get(f"/rides/{ride}")["speed_line_kmh"], bool)
    tags = (f"ride_ids=[{ride}]", 'add=["winter"]')
    tagged = spindle(server, "api", "POST", "/rides/tags", *tags)
    found = spindle(server, "ride", "list", "--tag", "Winter", "--json")
    none = spindle(server, "ride", "list", "--motor", "--json")
    home = server.get("/rides/home", params={"zone": "Asia/Tokyo"})

    assert reported.returncode == 0, reported.stderr
    assert "骑行" in page.read_text(encoding="utf-8")
    zipped = tmp_path / "rides.zip"
    packed = spindle(server, "ride", "archive", str(ride), "--formats", "csv,fit", "-o", zipped)
    shared = spindle(server, "ride", "export", str(ride), "--format", "fit", "--blur", "200")

    assert packed.returncode == 0, packed.stderr
    with zipfile.ZipFile(zipped) as found_files:
        assert len(found_files.namelist()) == 3
    assert (shared.returncode, "no position" in shared.stderr) == (1, True)
    assert tagged.returncode == 0, tagged.stderr
    assert card == [20.0] * 64
    assert [item["id"] for item in json.loads(found.stdout)["items"]] == [ride]
    assert ride not in {item["id"] for item in json.loads(none.stdout)["items"]}
    assert home["tags"] == [{"tag": "winter", "rides": 1}]
    assert [len(home[spans]) for spans in ("weeks", "months")] == [12, 12]
    assert result.returncode == exported.returncode == 0
    assert "distance_km" in shown.stdout
    assert "lunch" in listed.stdout
    assert len(csv.read_text().splitlines()) == 401


def test_a_file_that_is_no_ride_ends_with_one_and_the_reason(
    server: SpindleServer, tmp_path: Path
) -> None:
    file = tmp_path / "letter.fit"
    file.write_bytes(b"dear sirs")

    result = spindle(server, "ride", "import", file)

    assert result.returncode == 1
    assert "letter.fit" in result.stderr


def test_a_table_is_read_as_the_options_say(server: SpindleServer, tmp_path: Path) -> None:
    file = tmp_path / "logger.csv"
    rows = "".join(f"9/5/2025 5:12:{s:02} PM,13.42,36,1{s},{s}\n" for s in range(60))
    file.write_text(f"timestamp,speed,voltage,power,trip\n{rows}")
    known = ("--time-zone", "Europe/Berlin", "--speed-unit", "mph", "--dates", "month_first")

    lacks = spindle(server, "ride", "import", file)
    nearly = spindle(server, "ride", "import", file, *known, "--column", "power=watts")
    meanings = ("--column", "power=battery_power_w", "--column", "trip=distance_m")
    read = spindle(
        server, "ride", "import", file, *known, *meanings, "--distance-unit", "m", "--json"
    )

    assert (lacks.returncode, nearly.returncode) == (1, 1)
    for option in ("--dates (day_first, month_first)", "--time-zone", "--speed-unit (km/h, m/s,"):
        assert option in lacks.stderr
    assert "'power=CHANNEL' (rider_power_w, motor_power_w, battery_power_w, none)" in lacks.stderr
    assert "power cannot be watts" in nearly.stderr
    assert read.returncode == 0, read.stderr
    ride = server.get(f"/rides/{json.loads(read.stdout)['ride_ids'][0]}")
    assert ride["started_at"][:19] == "2025-09-05T15:12:00"
    names = {channel["name"] for channel in ride["channels"]}
    assert {"speed_kmh", "battery_power_w", "distance_m"} <= names
    assert "rider_power_w" not in names

    put_right = spindle(server, "ride", "import", file, "--dates", "day_first", "--json")
    same = spindle(server, "ride", "import", file, *known[:4])

    assert json.loads(put_right.stdout)["ride_ids"] == [ride["id"]], put_right.stderr
    assert same.returncode == 0, same.stderr
    assert server.get(f"/rides/{ride['id']}")["started_at"][:19] == "2025-05-09T15:12:00"


def test_any_request_of_the_api_is_sent_from_the_shell(
    server: SpindleServer, device: str, tmp_path: Path
) -> None:
    readings = tmp_path / "readings.json"
    strokes = [[0.0, 50.2, 100.0], [0.0, 50.2, 100.0]]
    load = {"full_scale_nm": 100.0, "load_nm": [0.0, 50.0, 100.0]}
    readings.write_text(json.dumps(load | {"forward": strokes, "reverse": strokes}))
    backup = tmp_path / "store.zip"

    def api(*words: str | Path) -> Ran:
        return spindle(server, "api", *words)

    figures = api("POST", "/calibration/evaluate", "--input", readings, "--json")
    again = api("post", "api/v1/calibration/evaluate", f"forward=@{readings}", "load_nm=[0]")
    tried = api("POST", "/devices/{unit}/trial-values", "parameters.pedal_stop_ms=222", "ttl_s=200")
    told = api("GET", "/devices/{unit}/trial-values", "--unit", device, "--json")
    ended = api("DELETE", "/devices/{unit}/trial-values")
    second = api("GET", "/devices/{unit}/parts/fuzzy_table", "table=second", "--json")
    listed = api("GET", "/devices")
    refused = api(
        "POST", "/devices/{unit}/trial-values", "parameters.pedal_stop_ms=99999", "ttl_s=9"
    )
    saved = api("GET", "/store/backup", "-o", backup)
    gone = api("DELETE", "/library/even", "-H", 'if-match: "x"')

    # 0.2 Nm off at 50 Nm of 100 Nm full scale; the strokes repeat exactly.
    assert json.loads(figures.stdout)["linearity_pct"] == pytest.approx(0.2)
    assert (again.returncode, "full_scale_nm" in again.stderr) == (1, True)
    assert "pedal_stop_ms: 222" in tried.stdout
    assert json.loads(told.stdout)["parameters"] == {"pedal_stop_ms": 222}
    assert "remaining_s: -" in ended.stdout
    assert json.loads(second.stdout)["name"] == "thesis 4-2, smooth"
    assert listed.stdout.splitlines()[0].startswith("id ")
    assert device in listed.stdout
    assert (refused.returncode, "pedal_stop_ms" in refused.stderr) == (1, True)
    assert saved.returncode == 0, saved.stderr
    assert zipfile.is_zipfile(backup)
    assert (gone.returncode, "comes with Spindle" in gone.stderr) == (1, True)


def test_no_server_is_said_so_with_what_to_do() -> None:
    result = spindle(None, "device", "list", "--server", "http://127.0.0.1:9")

    assert result.returncode == 1
    assert "spindle serve" in result.stderr


def test_wrong_usage_ends_with_two(
    server: SpindleServer, device: str, subtests: pytest.Subtests
) -> None:
    for words in WRONG:
        at = None if words[0] in ("serve", "fly", "scenario", "sim") else server
        with subtests.test(words=words):
            result = spindle(at, *words)

            assert result.returncode == 2, result.stderr
            assert result.stderr
            assert "sim_device" not in result.stderr


def test_scenarios_run_without_a_server() -> None:
    listed = spindle(None, "scenario", "list")
    run = spindle_process("scenario", "run", "kinematics", "--json", "--set", "speed_kmh=25")
    wrong = spindle_process("scenario", "run", "moon")

    assert "slope" in listed.stdout
    assert (run.returncode, wrong.returncode) == (0, 2)
    assert wrong.stderr.startswith("spindle: ")
    # 25 km/h on a wheel of 0.33 m radius: 25 / 3.6 / (2 pi 0.33) * 60 turns a minute.
    assert json.loads(run.stdout)["wheel_rpm"] == pytest.approx(200.95, rel=0.01)


def test_a_folder_is_uploaded_and_what_is_here_is_not_sent_again(
    server: SpindleServer, tmp_path: Path
) -> None:
    days = [1_610_000_000 + day * 86_400 for day in range(3)]
    for day, start_s in enumerate(days):
        folder = tmp_path / f"{day}"
        folder.mkdir()
        (folder / "ride.fit").write_bytes(fit_ride(start_s, [20.0] * 90, [75] * 90, [160] * 90))
    (tmp_path / "notes.txt").write_bytes(b"words" * 2000)

    first = spindle(server, "ride", "upload", tmp_path, "--json")
    again = spindle(server, "ride", "upload", tmp_path / "0", tmp_path / "1" / "ride.fit")

    assert json.loads(first.stdout)["summary"] == {
        "complete": 3,
        "here": 0,
        "partial": 0,
        "rejected": 1,
    }
    assert first.returncode == 1
    assert again.stdout.endswith("2 files: 2 already here.\n")
    assert again.returncode == 0


def test_a_file_that_appears_in_a_watched_folder_becomes_a_ride(
    server: SpindleServer, tmp_path: Path
) -> None:
    words = [sys.executable, "-m", "backend.cli", "ride", "upload", str(tmp_path), "--watch"]
    watch = subprocess.Popen(
        [*words, "--server", server.url], cwd=ROOT, stdout=subprocess.PIPE, text=True
    )
    (tmp_path / "watched.fit").write_bytes(
        fit_ride(1_620_000_000, [20.0] * 90, [75] * 90, [160] * 90)
    )
    assert watch.stdout is not None
    first = watch.stdout.readline()
    watch.send_signal(signal.SIGINT)
    said, _ = watch.communicate(timeout=30)

    assert "watched.fit: ride" in first
    assert said.endswith("1 file: 1 read completely.\n")
    assert watch.returncode == 0
