"""Goal: whatever lies in the flash for logs, the directory is one. Found by tools/fuzz."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from sim_device.firmware.python._native import ffi, lib

from backend.formats.blocks import block_at, encode_block
from tests.fakes.bench_logs import directory, fetch, logs, ride, unit_with_log

BLOCK_BYTES = 1024
LOG_BYTES = 64 * BLOCK_BYTES
FREE_BLOCK = 40


def test_a_second_beginning_of_a_log_is_no_log() -> None:
    unit = unit_with_log(BLOCK_BYTES, LOG_BYTES)
    ride(unit, 3.0)
    (log,) = logs(unit)
    data = fetch(unit, log)
    first = block_at(data, 0)
    assert first is not None
    flash = np.frombuffer(ffi.buffer(lib.bench_log(unit.board), LOG_BYTES), dtype=np.uint8)
    page = encode_block(replace(first, boot_id=first.boot_id + 1))
    at = FREE_BLOCK * BLOCK_BYTES
    flash[at : at + len(page)] = np.frombuffer(page, dtype=np.uint8)

    unit.boot()
    unit.hello()

    assert directory(unit).total == 1
    assert logs(unit) == [log]
    assert fetch(unit, log) == data
