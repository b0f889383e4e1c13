"""What a file costs: read by the rivals and by us, and five hundred of them through the server."""

import os
import statistics
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import fitdecode
import httpx

from backend.formats import Outcome, Readers, read_in_child
from backend.formats.formats import read_file
from tests.fakes.fit_file import START_S, commute, fit_file
from tools.bench.figures import Figure, best_of
from tools.bench.law import RIVALS
from tools.bench.server import serving

SCRIPT = Path(__file__).with_name("rivals_fit.py")
FILES = 500
AT_ONCE = 3
# Minutes of the files that are compared: a short way, a ride, a day.
MINUTES = (10, 60, 240)
CHILDREN = 8


def run() -> list[Figure]:
    """Every figure of this section; SPINDLE_RIDES names a folder of real files to add."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        return [*readers(folder), *children(folder), *batch(folder)]


def readers(folder: Path) -> list[Figure]:
    """Reading in this process, against fitdecode and Garmin's SDK in theirs."""
    files = []
    for minutes in MINUTES:
        path = folder / f"{minutes}.fit"
        path.write_bytes(fit_file(commute(60 * minutes)))
        files.append(path)
    if real := os.environ.get("SPINDLE_RIDES"):
        files += [path for path in sorted(Path(real).rglob("*.fit")) if is_clean(path)]
    fitdecode_ratios, garmin_ratios, salvage_ratios = [], [], []
    for path in files:
        data = path.read_bytes()
        damaged = data[: len(data) * 6 // 10] + data[len(data) * 6 // 10 + 1 :]
        ours_s = best_of(5, lambda data=data: read_file("a.fit", data))
        salvage_s = best_of(3, lambda data=damaged: read_file("a.fit", data))
        theirs_s = best_of(2, lambda path=path: by_fitdecode(path))
        fitdecode_ratios.append(theirs_s / ours_s)
        salvage_ratios.append(theirs_s / salvage_s)
        garmin_ratios.append(by_garmin_s(path) / ours_s)
    middle = statistics.median(fitdecode_ratios)
    saved = statistics.median(salvage_ratios)
    told = (
        f"median of {len(files)} files, {min(fitdecode_ratios):.0f} to {max(fitdecode_ratios):.0f}"
    )
    return [
        Figure("reading a FIT file, against fitdecode", f"{middle:.0f} times as quick",
               ">= 40", middle >= 40, told),
        Figure("the same against Garmin's own SDK",
               f"{statistics.median(garmin_ratios):.0f} times as quick", "", None),
        Figure("salvaging it with one byte lost, against fitdecode on the sound file",
               f"{saved:.1f} times as quick", ">= 3", saved >= 3,
               "fitdecode stops where the byte is missing"),
    ]  # fmt: skip


def is_clean(path: Path) -> bool:
    """Whether both readers take a file whole."""
    try:
        by_fitdecode(path)
    except Exception:
        # Whatever fitdecode raises: it has many errors, and some that are not its own.
        return False
    return read_file(path.name, path.read_bytes()).state == "complete"


def by_fitdecode(path: Path) -> int:
    """Every value of every message, as its documentation reads a file."""
    count = 0
    with fitdecode.FitReader(path) as reader:
        for frame in reader:
            if isinstance(frame, fitdecode.FitDataMessage):
                count += len({field.name: field.value for field in frame.fields})
    return count


def by_garmin_s(path: Path) -> float:
    """Seconds that Garmin's SDK takes, in its own environment."""
    told = subprocess.run(
        [str(RIVALS), str(SCRIPT), "2", str(path)], check=True, capture_output=True, text=True
    )
    return float(told.stdout)


def children(folder: Path) -> list[Figure]:
    """A file read by a child that waits, against one that is started for it."""
    path = folder / "10.fit"
    warm = Readers()

    def read(how: str) -> Outcome:
        return warm.read(path, "a.fit") if how == "warm" else read_in_child(path, "a.fit")

    read("warm")
    warm_s = best_of(CHILDREN, lambda: read("warm"))
    cold_s = best_of(CHILDREN, lambda: read("cold"))
    warm.stop()
    return [
        Figure("a file of ten minutes by a child that waits", f"{1e3 * warm_s:.1f} ms",
               "<= a tenth of a child's start", warm_s <= cold_s / 10,
               f"by a child of its own {1e3 * cold_s:.0f} ms"),
    ]  # fmt: skip


def batch(folder: Path) -> list[Figure]:
    """Files sent as the page sends them, until each has its verdict."""
    files = [fit_file(commute(120, START_S + day * 86_400)) for day in range(FILES)]
    with (
        serving(folder / "batch", "sim") as (_process, address, _ready),
        httpx.Client(timeout=60, trust_env=False) as client,
    ):

        def send(number: int) -> str:
            told = {"name": f"{number}.fit"}
            answer = client.post(f"{address}/rides/import", params=told, content=files[number])
            return str(answer.json()["state"])

        start = time.perf_counter()
        with ThreadPoolExecutor(AT_ONCE) as senders:
            states = list(senders.map(send, range(FILES)))
        spent_s = time.perf_counter() - start
    each_ms = 1e3 * spent_s / FILES
    whole = states.count("complete") == FILES
    return [
        Figure(f"a batch of {FILES} files to rides through HTTP", f"{spent_s:.1f} s", "all of them",
               whole, f"{AT_ONCE} at once"),
        Figure("the same, a file", f"{each_ms:.0f} ms", "<= 250 ms", each_ms <= 250),
    ]  # fmt: skip


if __name__ == "__main__":
    for figure in run():
        sys.stdout.write(f"{figure.subject}: {figure.value} {figure.target} {figure.against}\n")
