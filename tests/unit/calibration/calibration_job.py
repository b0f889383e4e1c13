"""A workshop for tests of calibration jobs: a unit behind a thread, a store, a sensor of one's own.

The readings are made here: counts of a straight sensor with noise, its truth told to nobody.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from backend.calibration.capture import state_of
from backend.calibration.records import CalibrationStore
from backend.calibration.service import open_calibrations
from backend.calibration.types import Job
from backend.core.channels import ChannelSpec
from backend.device.stream import StreamBlock
from backend.store import Store, open_store
from backend.tuning.records import RevisionStore
from backend.tuning.service import Tuning
from backend.units.service import Devices
from firmware_protocol.parameters import unpack_image
from tests.fakes.unit import FakeUnit
from tests.fakes.unit_link import UnitOpener

URL = "socket://bench:1"
PERIOD_US = 10_000
CHANNELS = (
    ChannelSpec("rider_torque_raw", "counts", 1.0),
    ChannelSpec("rider_torque_nm", "Nm", 0.01),
    ChannelSpec("sensor_temperature_degc", "degC", 0.01),
    ChannelSpec("speed_kmh", "km/h", 0.01),
    ChannelSpec("cadence_rpm", "rpm", 0.01),
)
GRAVITY_MS2, ARM_M, DEGC = 9.81, 0.17, 21.0
LOADS_KG = (10.0, 25.0, 40.0)
SETUP: dict[str, Any] = {
    "arm_m": ARM_M,
    "arm_limit_m": 0.0003,
    "gravity": {"gravity_ms2": GRAVITY_MS2, "standard_ms2": 1e-4, "source": "given"},
    "masses": [{"name": "discs", "mass_kg": 10.0, "mass_class": "M2"}],
    "loads_kg": list(LOADS_KG),
    "full_scale_nm": 80.0,
}
TRUE_OFFSET, TRUE_GAIN, NOISE_COUNTS = 37.0, 0.0103, 6.0


class Workshop:
    """One unit, one job. plugged: whether its cable is in."""

    def __init__(self, folder: Path, limits: Sequence[dict[str, Any]] = ()) -> None:
        self.folder = folder
        self.limits = limits
        self.unit = FakeUnit()
        self.now_s = 100.0
        self.clock_set_by_s = 0.0
        self.t_us = 0
        self.random = np.random.default_rng(7)
        self.start()
        self.job = 0

    def start(self) -> None:
        """As a server starts, on what the folder has."""
        self.store: Store = open_store(
            f"sqlite:///{self.folder}/spindle.db", (self.folder / "objects").as_uri()
        )
        self.calibrations = CalibrationStore(self.store)
        self.opener = UnitOpener(self.unit, URL)
        self.devices = Devices(opener=lambda url: self.opener, streaming=False)
        self.device = self.devices.add(URL).id
        tuning = Tuning(self.devices, RevisionStore(self.store.database))
        self.use = open_calibrations(
            self.devices,
            self.calibrations,
            tuning,
            "9.9",
            self.limits,
            lambda: self.now_s,
            self.unix_s,
        )

    def stop(self) -> None:
        self.devices.close()
        self.store.close()

    def restart(self) -> None:
        """The server dies and another one starts: nothing is left but the folder."""
        self.stop()
        self.start()

    def unix_s(self) -> float:
        """What the host's clock shows."""
        return time.time() + self.clock_set_by_s

    @property
    def held(self) -> dict[str, Any]:
        """What the unit holds."""
        return dict(unpack_image(self.unit.image))

    def open(self) -> Job:
        self.job, _ = self.use.jobs.open(self.device, "Ada")
        return self.view()

    def view(self) -> Job:
        return self.use.show.get(self.job)

    # ------------------------------------------------------------------ the bench

    def read(self, counts: np.ndarray, speed_kmh: float = 0.0) -> None:
        """Let the unit send raw counts (n,), a row every 10 ms."""
        values = np.zeros((counts.size, len(CHANNELS)), np.int16)
        values[:, 0] = np.rint(counts)
        values[:, 1] = np.rint((counts - TRUE_OFFSET) * TRUE_GAIN * 100)
        values[:, 2] = round(DEGC * 100)
        values[:, 3] = round(speed_kmh * 100)
        block = StreamBlock(self.t_us, PERIOD_US, 0, values, 0, 1, 0, CHANNELS)
        self.t_us += counts.size * PERIOD_US
        self.use.readings.recent.follow(self.device, block)

    def hang(self, mass_kg: float, angle_deg: float = 0.0, seconds: float = 3.2) -> None:
        """Hang a mass on a pedal and wait until it is still."""
        load_nm = mass_kg * GRAVITY_MS2 * ARM_M * np.cos(np.radians(angle_deg))
        still = TRUE_OFFSET + load_nm / TRUE_GAIN
        self.read(still + self.random.normal(0, NOISE_COUNTS, round(seconds * 100)))

    def capture(self, body: dict[str, Any], hung_kg: float | None = None) -> None:
        """Hang what is said, or something else, and take the reading."""
        state = state_of(body)
        self.hang(state.mass_kg if hung_kg is None else hung_kg, state.crank_angle_deg)
        self.use.jobs.capture(self.job, state)

    def capture_all(self, wrong_at: int | None = None) -> None:
        """Every step that is to be done; at one of them another mass hangs than is said."""
        for number, step in enumerate(self.view().steps):
            if step.capture is None:
                state = {name: getattr(step.state, name) for name in step.state.__slots__}
                wrong_kg = 20.0 if number == wrong_at else None
                self.capture(state, wrong_kg)

    def fitted(self, **changes: Any) -> Job:
        """A job with every step captured and fitted."""
        self.open()
        self.use.jobs.set_up(self.job, {**SETUP, **changes})
        self.capture_all()
        self.use.jobs.fit(self.job)
        return self.view()
