"""A drive unit on the bench: the real firmware against physics, and Spindle's own host beside it.

No process, no port and no clock: time passes in `advance`, and the same seed and calls give the
same bytes. What crosses the line is the wire protocol, so that whatever a firmware team changes is
tested the way a dealer's computer would see it.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeVar, Unpack

import numpy as np
import numpy.typing as npt

from backend.device.configuration import ConfigImage
from backend.device.ebl.operations.config_transaction import read_config, write_config
from backend.device.ebl.operations.readings import clear_faults, fault_frames, read_values
from backend.device.ebl.session.operation import Operation
from backend.device.ebl.session.session import Session
from backend.device.ebl.session.stream_receiver import StreamPlan
from backend.device.readings import Fault, Snapshot
from backend.device.states import LinkState
from backend.device.stream import StreamBlock
from backend.errors import NoAnswer
from sim_device.bike_ranges import read_bike
from sim_device.lockstep import LockstepUnit
from spindle.client import STANDSTILL_WITHIN_S, rests
from spindle.stimulus import Stimulus

Result = TypeVar("Result")

STEP_S = 0.020
CONNECT_WITHIN_S = 10.0
OPERATION_WITHIN_S = 30.0
NONCE = b"bench-01"


class DriveUnit:
    """One unit in virtual time, connected and streaming.

    seed: of the noise. scenario: a live one to ride from the start, by name or its file's path,
    None for a bike at rest. config: parameters by registry name, written before anything moves.
    bike: `part.name` -> value over the pinned bike. market: whose law it was made for. Raises
    ScenarioError, ConfigureError and ValueError for what does not exist.
    """

    def __init__(
        self,
        seed: int = 0,
        scenario: str | None = None,
        config: Mapping[str, Any] | None = None,
        bike: Mapping[str, float] | None = None,
        market: str = "eu_epac",
    ) -> None:
        self._seed = seed
        self._bike = read_bike(bike or {})
        self.unit = LockstepUnit(
            seed,
            dict(config or {}),
            name="bench",
            scenario=scenario,
            bike=self._bike,
            market=market,
        )
        self._now_s = 0.0
        self._boots = 1
        self._blocks: list[StreamBlock] = []
        self._session = Session(self._now_s, StreamPlan())
        self._connect()

    # ------------------------------------------------------------------ time and stimulus

    @property
    def t_s(self) -> float:
        """The unit's time since its last start."""
        return float(self.unit.observe()["t_s"])

    def advance(self, seconds: float) -> None:
        """Let time pass for unit and host."""
        whole, rest = divmod(round(seconds * 1e6), round(STEP_S * 1e6))
        for _ in range(whole):
            self._step(STEP_S)
        if rest:
            self._step(rest / 1e6)

    def simulate(self, **changes: Unpack[Stimulus]) -> None:
        """Change rider, road, load, brake, faults: the fields of `PUT /devices/{id}/simulation`.

        Raises ScenarioError with what is at fault, and changes nothing.
        """
        self.unit.simulation_set(dict(changes))

    def ride(
        self, torque_nm: float = 25.0, seconds: float = 0.0, **changes: Unpack[Stimulus]
    ) -> None:
        """A rider with legs pushes in the fuzzy mode, brake off, for `seconds`."""
        usual: Stimulus = {
            "brake": False,
            "assist_mode": 3,
            "rider": {"kind": "legs", "torque_nm": torque_nm, "cadence_rpm_max": 90.0},
        }
        self.unit.simulation_set({**usual, **changes})
        self.advance(seconds)

    def stand_still(self) -> None:
        """Brake until wheel and motor rest, which a write needs. Raises NoAnswer."""
        self.simulate(scenario=None, rider={"kind": "off"}, brake=True)
        for _ in range(round(STANDSTILL_WITHIN_S)):
            if rests(self.unit.observe()):
                return
            self.advance(1.0)
        raise NoAnswer(f"The bike still moves after braking {STANDSTILL_WITHIN_S:g} s.")

    def restart(self) -> None:
        """Take the battery out and put it in again: flash stays, everything else is gone."""
        self._boots += 1
        self.unit = LockstepUnit(
            self._seed,
            name="bench",
            bike=self._bike,
            flash=self.unit.unit.flash(),
            log=self.unit.unit.log(),
            boot_id=self._boots,
        )
        self._session.port_failed(self._now_s, NoAnswer("The battery is out."))
        self._connect()

    # ------------------------------------------------------------------ what can be seen

    def observe(self) -> dict[str, Any]:
        """What somebody beside the bike sees: true values, not the unit's measurements."""
        return self.unit.observe()

    def channels(self) -> dict[str, float | None]:
        """Every telemetry channel as the unit reports it now; missing is None."""
        values: Snapshot = self.ask(read_values())
        return values.channels

    def trace(self, *names: str) -> dict[str, npt.NDArray[np.float64]]:
        """`t_s` and the named channels since the last start, as received: (rows,), NaN is missing.

        Raises KeyError for a channel that does not exist.
        """
        kept = [block for block in self._blocks if block.channels]
        specs = {spec.name: column for column, spec in enumerate(kept[0].channels)} if kept else {}
        columns: dict[str, list[npt.NDArray[np.float64]]] = {"t_s": [], **{n: [] for n in names}}
        for block in kept:
            rows = np.arange(len(block.values))
            columns["t_s"].append((block.t0_us + rows * block.period_us) / 1e6)
            for name in names:
                number = specs[name]
                columns[name].append(block.channels[number].to_values(block.values[:, number]))
        empty = np.empty(0)
        return {name: np.concatenate(parts) if parts else empty for name, parts in columns.items()}

    def faults(self) -> list[Fault]:
        """The faults that are active or were, with what the bike did when they came."""
        return self.ask(fault_frames())

    def clear_faults(self) -> list[Fault]:
        """Forget the faults that are over; what is left."""
        return self.ask(clear_faults())

    # ------------------------------------------------------------------ configuration

    def config(self) -> ConfigImage:
        """The active configuration, read over the wire."""
        return self.ask(read_config())

    def write(self, **parameters: Any) -> ConfigImage:
        """Change parameters; returns what was read back and compared.

        Raises NotStandingStill while the bike moves, LimitViolation naming what is out of range.
        """
        base = self.ask(read_config())
        return self.ask(write_config(base, parameters))

    def ask(self, operation: Operation[Result], within_s: float = OPERATION_WITHIN_S) -> Result:
        """Run any operation of backend.device to its end; its error is raised here."""
        results: list[Result] = []
        errors: list[BaseException] = []
        self._session.start(operation, results.append, errors.append)
        deadline_s = self._now_s + within_s
        while not results and not errors:
            if self._now_s > deadline_s:
                raise NoAnswer(f"The unit has not answered within {within_s:g} s of its time.")
            self._step(STEP_S)
        if errors:
            raise errors[0]
        return results[0]

    # ------------------------------------------------------------------ inside

    def _connect(self) -> None:
        self._blocks.clear()
        self._session.port_opened(self._now_s, "bench", NONCE)
        deadline_s = self._now_s + CONNECT_WITHIN_S
        while self._session.state is not LinkState.READY:
            if self._now_s > deadline_s:
                raise NoAnswer(f"The unit is not ready: {self._session.reason}")
            self._step(STEP_S)

    def _step(self, seconds: float) -> None:
        self._now_s += seconds
        self.unit.advance(seconds)
        self._session.receive(self.unit.receive(), self._now_s)
        self._session.tick(self._now_s)
        self.unit.send(self._session.bytes_to_send())
        events = self._session.next_events()
        self._blocks += [event for event in events if isinstance(event, StreamBlock)]
