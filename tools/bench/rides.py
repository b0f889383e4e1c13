"""What a ride costs: on disk, to close, and to look at."""

import sqlite3
import tempfile
import time
from contextlib import closing
from pathlib import Path

import numpy as np

from backend.core.channels import ChannelSpec
from backend.core.ride import RideContext
from backend.rides.traces.trace import trace
from backend.store import Store, open_store
from firmware_protocol._generated import CHANNELS
from tools.bench.figures import Figure, median_of
from tools.bench.ride import HZ, SAMPLES, two_hours

# ride_logs section 5, measured on 2 h x 100 Hz x 12 channels: calculated from 20,000 FIT records.
FIT_BYTES_PER_ROW = 32.0
PIXELS = 1000
SPIKE_ROW = 431_234


def run() -> list[Figure]:
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        with open_store(f"sqlite:///{root}/spindle.db", f"file://{root}/objects") as store:
            return measure(store, root)


def measure(store: Store, root: Path) -> list[Figure]:
    channels, rows = counts()
    ride_id = store.rides.start_live(channels, 1_000_000 // HZ, 0, RideContext(), "bench")
    start = time.perf_counter()
    tails = [
        store.rides.append_tail(ride_id, first, rows[first : first + HZ])
        for first in range(0, SAMPLES, HZ)
    ]
    for tail in tails:
        tail.result()
    tail_s = time.perf_counter() - start
    start = time.perf_counter()
    store.rides.finish(ride_id)
    finish_s = time.perf_counter() - start
    stored = sum(path.stat().st_size for path in (root / "objects").rglob("*") if path.is_file())
    per_row = stored / SAMPLES
    overview_per_row = overview_bytes(root / "spindle.db") / SAMPLES

    reader = store.rides.reader(ride_id)
    names = [channel.name for channel in channels]
    whole_ms = 1e3 * median_of(31, lambda: trace(reader, names, 0, SAMPLES / HZ, PIXELS).to_bytes())
    window_ms = 1e3 * median_of(31, lambda: trace(reader, names, 600, 660, PIXELS).to_bytes())
    view = trace(reader, ["rider_torque_nm"], 0, SAMPLES / HZ, PIXELS)
    kept = int(view.maximum["rider_torque_nm"].max()) == int(
        rows[:, names.index("rider_torque_nm")].max()
    )
    csv = csv_bytes_per_row(rows, channels)
    return [
        Figure("bytes a row on disk, 12 channels", f"{per_row:.2f}", "<= 6.5", per_row <= 6.5,
               f"CSV {csv:.1f} ({csv / per_row:.0f} times), FIT {FIT_BYTES_PER_ROW:.0f} "
               f"({FIT_BYTES_PER_ROW / per_row:.0f} times; figure from the format study)"),
        Figure("bytes a row of its overview, kept beside it in SQL", f"{overview_per_row:.2f}", "",
               None, f"together {per_row + overview_per_row:.2f}"),
        Figure("2000 points of 12 channels x 720,000 samples, warm", f"{whole_ms:.2f} ms",
               "<= 5 ms, every extreme kept", whole_ms <= 5 and kept,
               f"one-sample spike of 95 Nm kept: {'yes' if kept else 'no'}"),
        Figure("60 s of the same 12 channels, row by row", f"{window_ms:.2f} ms", "", None),
        Figure("closing a 2 h ride (object, overview, figures)", f"{finish_s:.2f} s", "", None),
        Figure("recording it: a commit a second", f"{1e3 * tail_s * HZ / SAMPLES:.2f} ms each",
               "", None, f"{SAMPLES / HZ / tail_s:,.0f} units could be recorded at once"),
    ]  # fmt: skip


def overview_bytes(database: Path) -> int:
    with closing(sqlite3.connect(database)) as connection:
        return int(connection.execute("SELECT sum(length(payload)) FROM ride_lod").fetchone()[0])


def counts() -> tuple[list[ChannelSpec], np.ndarray]:
    """The ride as the unit would send it: int16 counts of the registry's scales."""
    ride = two_hours()
    scales = {channel.name: channel for channel in CHANNELS}
    channels = [ChannelSpec(name, scales[name].unit, scales[name].scale) for name in ride]
    rows = np.stack(
        [np.round(values / scales[name].scale) for name, values in ride.items()], axis=1
    )
    rows = np.clip(rows, -32767, 32767).astype(np.int16)
    rows[SPIKE_ROW, list(ride).index("rider_torque_nm")] = 16_000
    return channels, rows


def csv_bytes_per_row(rows: np.ndarray, channels: list[ChannelSpec]) -> float:
    sample = rows[100_000:110_000]
    lines = (
        ",".join(f"{count * channel.scale:g}" for count, channel in zip(row, channels, strict=True))
        for row in sample
    )
    return sum(len(line) + 1 for line in lines) / len(sample)
