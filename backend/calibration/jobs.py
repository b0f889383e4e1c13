"""Calibration jobs: opened on a unit, set up, captured, fitted.

Everything is in the store before a call returns, so that nothing is lost with a link, a page or
the server; whoever comes back finds the job open. A capture is taken when somebody says so and the
readings are steady, never by itself.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from backend.calibration import job as kept
from backend.calibration.capture import State, capture_of
from backend.calibration.describe import worked_of
from backend.calibration.files import StoredCalibration
from backend.calibration.judgement import Limits, limits_for
from backend.calibration.plain import to_plain
from backend.calibration.reading import NO_READINGS, Readings, SteadyWindow, newest_window
from backend.calibration.records import CalibrationStore
from backend.calibration.setup import Setup, setup_of
from backend.calibration.steady import WINDOW_S
from backend.calibration.unit_record import PARAMETER_OF, record_of
from backend.device.capability import Capability
from backend.errors import Conflict, FieldError, InvalidRequest, NotFound
from backend.units.service import Devices
from backend.units.types import Device

READY = "ready"
FOOT = "foot_at_start"
FACTORY_GAIN = "sensor_gain_nm_per_count_factory"


class CalibrationJobs:
    """Jobs up to their fit. For any thread. limits: to be judged by. now_s: Unix time."""

    def __init__(
        self,
        devices: Devices,
        store: CalibrationStore,
        readings: Readings,
        limits: Sequence[Limits],
        now_s: Callable[[], float] = time.time,
    ) -> None:
        self._devices = devices
        self._store = store
        self._readings = readings
        self._limits = limits
        self._now_s = now_s
        self._capturing = threading.Lock()

    # ------------------------------------------------------------------ which there are

    def open(self, device_id: str, author: str) -> tuple[int, bool]:
        """The open job of the unit on a connection, and whether it was made now.

        Raises NotFound, NoAnswer for one that is not there, NameFirst, CapabilityMissing.
        """
        key, unit = self._devices.own(device_id)
        unit.require(Capability.CALIBRATE, Capability.STREAM)
        config = unit.read_config()
        identity = self._devices.get(device_id).identity
        parameters = config.parameters
        model = identity.model if identity else None
        facts: dict[str, Any] = {
            "serial_number": identity.serial_number if identity else None,
            "model": model,
            "firmware_version": identity.firmware_version if identity else None,
            "market": parameters.get("market"),
            "battery_min_v": parameters.get("battery_voltage_v_min"),
            "gain_made_with": parameters.get(FACTORY_GAIN),
        }
        bands = {
            name: band
            for name in PARAMETER_OF.values()
            if name in parameters
            and (band := unit.parameters.free_of(name, parameters)) is not None
        }
        free = {name: [band.min, band.max] for name, band in bands.items()}
        limits = to_plain(limits_for(facts["market"], model, self._limits))
        body = kept.new_body(facts, record_of(parameters), free, limits)
        job, is_new = self._store.open(key, model, body, author)
        return job.id, is_new

    def connection(self, job: StoredCalibration) -> Device | None:
        """The connection a job's unit is on now, ready to be asked; None while it is on none."""
        return next(
            (
                device
                for device in self._devices.list()
                if device.unit_key == job.unit_key and device.state == READY
            ),
            None,
        )

    def connected(self, job: StoredCalibration) -> str:
        """As `connection`, its id. Raises Conflict."""
        device = self.connection(job)
        if device is None:
            raise Conflict(
                f"The unit of calibration {job.id} is not connected. Nothing is lost: go on when "
                "it is there again.",
                "not_connected",
            )
        return device.id

    # ------------------------------------------------------------------ setup and captures

    def set_up(self, job_id: int, setup: Mapping[str, Any]) -> None:
        """Give a job its instruments and plan; a fit of before is one no more.

        setup: as of calibration.setup's Setup, without the gain that the unit was made with, which
        the unit tells. Raises InvalidRequest naming every field, NotFound, Conflict.
        """

        def work(body: kept.Body) -> kept.Body:
            kept.require_unwritten(body)
            gain = body["unit"]["gain_made_with"] or body["found"].get(
                PARAMETER_OF["gain_nm_per_count"]
            )
            checked = setup_of({**setup, "gain_nm_per_count": gain})
            return {**body, "setup": to_plain(checked), "fitted_us": None}

        self._store.change(job_id, work)

    def capture(self, job_id: int, state: State, pedals_free: bool = False) -> None:
        """Take the newest steady window as a capture. The state's temperature is the unit's to say.

        pedals_free: somebody looked, and what the unit takes for a foot is a zero that moved.
        Raises Conflict with a field for each reason why not, NotFound, InvalidRequest.
        """
        job = self._store.get(job_id)
        setup = kept.require_setup(job.body)
        if state.kind == "verify":
            kept.require_written(job.body)
            self._require_unseen(job_id, state)
        else:
            kept.require_unwritten(job.body)
        device_id = self.connected(job)
        if state.kind == "zero" and not pedals_free:
            self._require_no_foot(device_id)
        with self._capturing:
            window = self._steady(device_id, setup)
            at_us = int(self._now_s() * 1e6)

            def make(number: int, body: kept.Body) -> tuple[kept.Body, kept.Body]:
                given = {name: getattr(state, name) for name in State.__slots__}
                state_now = State(**{**given, "sensor_degc": window.sensor_degc})
                made = capture_of(number, state_now, window.raw_counts, window.duration_s, at_us)
                unit_nm = {**body["unit_nm"], str(number): window.unit_nm}
                fitted_us = body["fitted_us"] if state.kind == "verify" else None
                return to_plain(made), {**body, "unit_nm": unit_nm, "fitted_us": fitted_us}

            self._store.capture(job_id, make)
            self._readings.taken(device_id)

    def strike(self, job_id: int, number: int, reason: str, author: str) -> None:
        """Let a capture count no more; it stays, with the reason.

        Raises NotFound, Conflict once what was fitted is in the unit; a verification can be struck
        then, too.
        """
        at_us = int(self._now_s() * 1e6)
        of = {one.number: one.body["state"]["kind"] for one in self._store.captures(job_id)}
        if number not in of:
            raise NotFound(f"Calibration {job_id} has no capture {number}.")

        def work(body: kept.Body) -> kept.Body:
            if of[number] == "verify":
                return body
            kept.require_unwritten(body)
            return {**body, "fitted_us": None}

        struck = {"reason": reason, "author": author, "at_us": at_us}
        self._store.strike(job_id, number, struck, work)

    def fit(self, job_id: int) -> None:
        """Hold what follows from setup and captures as the job's fit.

        Raises Conflict with a field for each refusal, `too_few_captures` without one, NotFound.
        """
        job = self._store.get(job_id)
        kept.require_setup(job.body)
        worked = worked_of(job.body, self._store.captures(job_id))
        if worked is not None and worked.refusals:
            faults = [
                FieldError(
                    ",".join(f"captures[{number}]" for number in refusal.captures),
                    refusal.code,
                    refusal.sentence,
                )
                for refusal in worked.refusals
            ]
            message = "; ".join(fault.message for fault in faults)
            raise Conflict(f"Not fitted: {message}.", "captures_contradict", faults)
        if worked is None or worked.fit is None:
            raise Conflict("The captures do not suffice for a fit.", "too_few_captures")
        at_us = int(self._now_s() * 1e6)

        def work(body: kept.Body) -> kept.Body:
            kept.require_unwritten(body)
            return {**body, "fitted_us": at_us}

        self._store.change(job_id, work)

    # ------------------------------------------------------------------ inside

    def _steady(self, device_id: str, setup: Setup) -> SteadyWindow:
        """The newest window. Raises Conflict with every reason why it is none."""
        recent = self._readings.untaken(device_id)
        window = None if recent is None else newest_window(recent, setup)
        reasons = (NO_READINGS,) if window is None else window.reasons
        if window is None or reasons:
            faults = [FieldError("readings", one.code, one.sentence) for one in reasons]
            message = "; ".join(fault.message for fault in faults)
            raise Conflict(f"Not steady for {WINDOW_S:g} s: {message}.", "not_steady", faults)
        return window

    def _require_no_foot(self, device_id: str) -> None:
        if FOOT in self._devices.get(device_id).faults_active:
            raise Conflict(
                "The unit tells of a foot on the pedal since it was switched on. Take everything "
                "off the pedals; if nothing is there, the zero has moved that far: say that the "
                "pedals are free.",
                "foot_on_pedal",
            )

    def _require_unseen(self, job_id: int, state: State) -> None:
        captures = kept.counting(self._store.captures(job_id))
        used = {one.state.mass_kg for one in captures if one.state.kind == "load"}
        if state.mass_kg in used:
            message = f"{state.mass_kg:g} kg is a load of the fit: verify with another mass."
            fault = FieldError("mass_kg", "mass_was_fitted", message)
            raise InvalidRequest(message, "mass_was_fitted", [fault])
