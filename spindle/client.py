"""A typed client of Spindle's API.

    spindle = Spindle("http://127.0.0.1:8750")
    unit = spindle.unit()
    unit.simulate(brake=False, rider={"kind": "legs", "torque_nm": 25.0})
    unit.advance(60.0)
    assert unit.snapshot().channels["speed_kmh"] > 20.0

Answers are the API's own models, so a program is checked against what the server sends. A refusal
is raised as backend.errors.RequestRefused with every field that is at fault.
"""

from __future__ import annotations

import time
from collections.abc import Mapping
from typing import Any, TypeVar, Unpack

from pydantic import TypeAdapter

from backend.cli.client import Server, default_ca, default_key, default_server
from backend.device.readings import Fault, Snapshot
from backend.errors import NoAnswer, RequestRefused
from backend.rides.models import Ride, RideList, Series
from backend.server.health import Health
from backend.tuning.models.config import ParameterList
from backend.tuning.models.law import FuzzyTable, Table, UnitLimits
from backend.tuning.types import Config, ConfigChange, Parameter
from backend.units.dashboard import Dashboard
from backend.units.simulation import Simulation
from backend.units.types import Device, FaultList
from spindle.stimulus import Stimulus

LOOK_EVERY_S = 0.05
READY_WITHIN_S = 30.0
# A brake brings any simulated bike to rest within this much of its own time.
STANDSTILL_WITHIN_S = 60.0
# Below these the firmware calls a bike at rest, with room for rounding.
STANDSTILL_KMH = 0.01
STANDSTILL_MOTOR_RPM = 0.1


Kind = TypeVar("Kind")


def read_as(kind: type[Kind], answer: object) -> Kind:
    """An answer of the API as the type that the server made it of."""
    return TypeAdapter(kind).validate_python(answer)


class Spindle:
    """A server. url: where it listens; as told by SPINDLE_HOST and SPINDLE_PORT if None.

    key: for a server that asks who this is; as told by SPINDLE_KEY if None. ca: a file with the
    certificate of a server that no authority signed; as told by SPINDLE_CA if None.
    """

    def __init__(
        self, url: str | None = None, key: str | None = None, ca: str | None = None
    ) -> None:
        self.server = Server(
            url or default_server(), key=key or default_key(), ca=ca or default_ca()
        )

    def health(self) -> Health:
        """Version and units. Raises LinkError when no server answers."""
        return read_as(Health, self.server.ask("GET", "/health"))

    def unit(self, name: str | None = None, within_s: float = 0.0) -> Unit:
        """The unit of this id, url, key or serial number; the only one if None.

        within_s: a server that has just started may not know its units yet. Raises RequestRefused.
        """
        deadline_s = time.monotonic() + within_s
        while True:
            try:
                return Unit(self.server, self.server.device_id(name))
            except RequestRefused:
                if time.monotonic() >= deadline_s:
                    raise
                time.sleep(LOOK_EVERY_S)

    def add(self, url: str, name: str | None = None) -> Unit:
        """Connect the unit at this url, as `POST /devices` does. name: what its owner calls it."""
        body = {"url": url, "name": name}
        added = read_as(Device, self.server.ask("POST", "/devices", json=body))
        return Unit(self.server, added.id)

    def rides(self) -> list[Ride]:
        """The latest rides, newest first."""
        return read_as(RideList, self.server.ask("GET", "/rides")).items

    def finished_ride(self, within_s: float = READY_WITHIN_S) -> Ride:
        """The newest ride, once its record is closed. Raises NoAnswer when that does not come."""
        deadline_s = time.monotonic() + within_s
        while not (rides := self.rides()) or rides[0].state != "done":
            if time.monotonic() > deadline_s:
                state = rides[0].state if rides else "none"
                raise NoAnswer(f"No ride was finished within {within_s:g} s; the newest: {state}.")
            time.sleep(LOOK_EVERY_S)
        return rides[0]

    def series(self, ride_id: int, *channels: str, px: int = 2000) -> Series:
        """Exact minima and maxima of a ride's channels in `px` bins."""
        asked = {"channels": ",".join(channels), "px": px}
        answer = self.server.ask("GET", f"/rides/{ride_id}/series", params=asked)
        return read_as(Series, answer)


class Unit:
    """One unit of a server."""

    def __init__(self, server: Server, device_id: str) -> None:
        self.id = device_id
        self._server = server
        self._path = f"/devices/{device_id}"

    def device(self) -> Device:
        """State, identity, configuration stamp, counters of the link, active faults."""
        return read_as(Device, self._server.ask("GET", self._path))

    def wait_ready(self, within_s: float = READY_WITHIN_S) -> Device:
        """Wait until the unit can be asked. Raises NoAnswer with its own reason."""
        deadline_s = time.monotonic() + within_s
        while (seen := self.device()).state != "ready":
            if time.monotonic() > deadline_s:
                raise NoAnswer(f"{self.id} is not ready after {within_s:g} s: {seen.reason}")
            time.sleep(LOOK_EVERY_S)
        return seen

    def snapshot(self) -> Snapshot:
        """The latest row of every channel."""
        return read_as(Snapshot, self._server.ask("GET", f"{self._path}/snapshot"))

    def dashboard(self) -> Dashboard:
        """Speed, acceleration, powers, battery, distance and range as the rider sees them."""
        return read_as(Dashboard, self._server.ask("GET", f"{self._path}/dashboard"))

    def parameters(self) -> list[Parameter]:
        """Every parameter with its range, unit, default and value."""
        answer = self._server.ask("GET", f"{self._path}/parameters")
        return read_as(ParameterList, answer).items

    def config(self) -> Config:
        """The active configuration, read from the unit."""
        return read_as(Config, self._server.ask("GET", f"{self._path}/config"))

    def write(
        self, parameters: Mapping[str, Any], reason: str = "", confirm_s: int = 0
    ) -> ConfigChange:
        """Change parameters; when this returns they were read back and compared.

        confirm_s: not 0 for a trial, which ends by itself unless `confirm` is called in time.
        """
        body = {"parameters": dict(parameters), "reason": reason, "confirm_s": confirm_s}
        answer = self._server.ask("PATCH", f"{self._path}/config", json=body)
        return read_as(ConfigChange, answer)

    def fuzzy_table(self, table: Table = "first") -> FuzzyTable:
        """One of the two rule tables, read from the unit."""
        answer = self._server.ask("GET", f"{self._path}/parts/fuzzy_table", params={"table": table})
        return read_as(FuzzyTable, answer)

    def write_fuzzy_table(
        self,
        value: FuzzyTable,
        table: Table = "first",
        reason: str = "",
        confirm_s: int = 0,
    ) -> ConfigChange:
        """Write a whole rule table, as `write` does.

        The second table's points of speed and torque rate are the first's; others are refused.
        """
        query = {"table": table, "reason": reason, "confirm_s": confirm_s}
        path, body = f"{self._path}/parts/fuzzy_table", value.model_dump()
        return read_as(ConfigChange, self._server.ask("PUT", path, params=query, json=body))

    def limits(self) -> UnitLimits:
        """What the unit enforces whatever a table says, and where assist ends because of it."""
        return read_as(UnitLimits, self._server.ask("GET", f"{self._path}/parts/limits"))

    def confirm(self) -> ConfigChange:
        """Keep what is on trial."""
        answer = self._server.ask("POST", f"{self._path}/config/confirm")
        return read_as(ConfigChange, answer)

    def roll_back(self) -> ConfigChange:
        """Give up what is on trial."""
        answer = self._server.ask("POST", f"{self._path}/config/rollback")
        return read_as(ConfigChange, answer)

    def faults(self) -> tuple[Fault, ...]:
        """The faults that are active or were, with what the bike did when they came."""
        return read_as(FaultList, self._server.ask("GET", f"{self._path}/faults")).items

    def clear_faults(self) -> tuple[Fault, ...]:
        """Forget the faults that are over; what is left."""
        answer = self._server.ask("POST", f"{self._path}/faults/clear")
        return read_as(FaultList, answer).items

    def simulation(self) -> Simulation:
        """Rider, road and clock. Raises RequestRefused for a real unit."""
        return read_as(Simulation, self._server.ask("GET", f"{self._path}/simulation"))

    def simulate(self, **changes: Unpack[Stimulus]) -> Simulation:
        """Change rider, road, load, clock or faults. Raises RequestRefused naming the fault."""
        answer = self._server.ask("PUT", f"{self._path}/simulation", json=changes)
        return read_as(Simulation, answer)

    def advance(self, seconds: float) -> Simulation:
        """Let time pass for a unit with a virtual clock."""
        path = f"{self._path}/simulation/advance"
        return read_as(Simulation, self._server.ask("POST", path, json={"seconds": seconds}))

    def stand_still(self) -> None:
        """Brake until wheel and motor rest, which a write needs. Raises NoAnswer."""
        clock = self.simulate(scenario=None, rider={"kind": "off"}, brake=True).clock
        passed_s = 0.0
        while not rests(self.snapshot().channels):
            if passed_s > STANDSTILL_WITHIN_S:
                raise NoAnswer(f"{self.id} still moves after braking {STANDSTILL_WITHIN_S:g} s.")
            if clock == "virtual":
                self.advance(1.0)
                passed_s += 1.0
            else:
                time.sleep(LOOK_EVERY_S)
                passed_s += LOOK_EVERY_S


def rests(seen: Mapping[str, float | None]) -> bool:
    """Whether wheel and motor stand still, by `speed_kmh` and `motor_speed_rpm`; a missing one
    does not say so."""
    speed_kmh, motor_speed_rpm = seen["speed_kmh"], seen["motor_speed_rpm"]
    if speed_kmh is None or motor_speed_rpm is None:
        return False
    return abs(speed_kmh) < STANDSTILL_KMH and abs(motor_speed_rpm) < STANDSTILL_MOTOR_RPM
