"""A simulated unit in virtual time: time passes when `advance` is called, and only then.

Two units with the same arguments and the same calls give the same bytes. The unit as a process on
a serial port (sim_device.simulator) is this one with a clock attached.
"""

import hashlib
import json
from collections.abc import Iterator
from dataclasses import replace
from typing import Any, Final

from firmware_protocol._generated import Market, MessageId, Status
from firmware_protocol.spelling import member_of, words_of
from sim_device.configure import write_config
from sim_device.controls import NOT_CONSISTENT, Changes, choices_made, pack, parse_changes, plain
from sim_device.firmware.python.unit import UID_LENGTH, Unit, default_bike, finite_or_none
from sim_device.scenario_file import ScenarioFile, load, load_live
from sim_device.scenario_phase import (
    RIDER_KINDS,
    SPEED_SENSOR_FAULTS,
    TORQUE_SENSOR_FAULTS,
    Phase,
    ScenarioError,
)
from sim_device.scenario_script import Script
from sim_device.sensor_state import SensorState, state_of
from sim_device.workbench import Workbench, hung

US_PER_S: Final[int] = 1_000_000

# A phase's values that are the bike's: which they are, and what they are on the pinned bike.
_SURROUNDINGS: Final[dict[str, tuple[tuple[str, ...], float]]] = {
    "ambient_degc": (
        ("motor.ambient_degc", "sensor.ambient_degc", "battery.temperature_degc"),
        20.0,
    ),
    "grip": (("road.grip",), 0.0),
    "bit_error_rate": (("link.bit_error_rate",), 0.0),
    "burst_share": (("link.burst_share",), 0.0),
    "coupling": (("link.coupling",), 1.0),
}


def uid_of(name: str, seed: int) -> bytes:
    """The 12 bytes that tell this simulated unit from every other."""
    return hashlib.sha256(f"spindle simulated unit {name} {seed}".encode()).digest()[:UID_LENGTH]


NO_MARKET = "none"
"""In a market's place: nobody provisioned the unit."""


def market_named(name: str) -> Market | None:
    """The market of this name, in any case; None for `none`, a unit that no factory has
    provisioned. Raises ValueError with those there are."""
    if name == NO_MARKET:
        return None
    try:
        return member_of(Market, name)
    except KeyError:
        listed = ", ".join(words_of(Market))
        raise ValueError(f"there is no market {name}; there are {listed}") from None


class LockstepUnit:
    """One simulated unit with its rider and road.

    Args:
        seed: of the noise; with `name` it also makes the serial number.
        config_overrides: parameters by registry name, written over the wire before anything moves.
        name: tells units with equal seeds apart.
        scenario: a live scenario to ride from the start: its name, its file's path or as read.
        bike: `part.name` -> value, over the pinned bike W1.
        sensor: the state of its torque sensor (sim_device.sensor_state), in every scenario.
        flash: the flash of an earlier life. log: that for ride logs.
        market: whose law a new unit is made for, by name; one with a flash keeps its own.
        unlock_key: the maker's public key; without one no limit can be raised again.
        boot_id: another one tells the host that the unit was restarted.
        line_baud: the serial line's rate at boot, 0 for a line where bytes take no time.
        speed_factor, clock: kept for the process that paces the unit (sim_device.simulator).
        bike_alone: the firmware runs on another board (sim_device.emulated).

    Raises:
        ScenarioError: there is no such live scenario.
        ValueError: there is no such market.
        ConfigureError: an override was refused.
    """

    def __init__(
        self,
        seed: int = 0,
        config_overrides: dict[str, Any] | None = None,
        *,
        name: str = "lockstep",
        scenario: str | ScenarioFile | None = None,
        bike: dict[str, float] | None = None,
        sensor: str | None = None,
        flash: bytes | None = None,
        log: bytes | None = None,
        market: str = "eu_epac",
        unlock_key: bytes | None = None,
        boot_id: int = 1,
        line_baud: int = 0,
        speed_factor: float = 1.0,
        clock: str = "real",
        bike_alone: bool = False,
    ) -> None:
        ridden = load_live(scenario) if isinstance(scenario, str) else scenario
        self._own = {ridden.name: ridden} if ridden is not None else {}
        self.seed = seed
        self.speed_factor = speed_factor
        self.clock = clock
        self.owed_us = 0
        self._sensor = state_of(sensor) if sensor is not None else SensorState({})
        self._bike: dict[str, float] = {"road.source": 0.0, "road.mass_kg": 100.0} | (bike or {})
        self._bike |= self._sensor.bike
        self._dyno_nm = 0.0
        self._phase = Phase(seconds=1.0)
        self._scripted = self._phase
        self._by_hand: dict[str, Any] = {}
        self._before_scenario: dict[str, float] = {}
        self._running = False
        self._script: Script | None = None
        self._workbench: Workbench | None = None
        self._times_hung = 0
        self.unit = Unit(
            uid=uid_of(name, seed),
            boot_id=boot_id,
            seed=seed,
            bike=self._bike,
            flash=flash,
            log=log,
            market=market_named(market),
            unlock_key=unlock_key,
            line_baud=line_baud,
            request=self.answer,
            bike_alone=bike_alone,
        )
        if config_overrides:
            write_config(self.unit, config_overrides)
        if ridden is not None:
            self._start(ridden)
        else:
            self._by_hand = self._sensor.by_hand()
            self._perform(self._phase)

    def advance(self, seconds: float) -> None:
        """Lets `seconds` of the unit's time pass, through the phases of a running scenario."""
        left_us = round(seconds * US_PER_S)
        while left_us > 0:
            left_us -= self._advance_in_phase(left_us)

    def ride_once(self, look_s: float) -> Iterator[dict[str, Any]]:
        """Rides the running scenario to the end of its last phase: what is seen every `look_s`,
        at the end of every phase and of the ride."""
        while self._running and self._script is not None and not self._script.rounds:
            self._advance_in_phase(round(look_s * US_PER_S))
            yield self.observe()

    @property
    def stalled_phases(self) -> list[int]:
        """Of the scenario: which phases in metres, from 1, ended because the bike hardly moved."""
        return list(self._script.stalled) if self._script else []

    def pay(self, limit_us: int) -> int:
        """Lets at most `limit_us` of the time pass that was asked for with `advance_s`; how much
        that was."""
        paid_us = min(self.owed_us, limit_us)
        self.advance(paid_us / US_PER_S)
        self.owed_us = max(0, self.owed_us - paid_us)
        return paid_us

    def poll(self) -> None:
        """Lets the unit answer what it has received while its clock stands."""
        self.unit.poll()

    def send(self, data: bytes) -> int:
        """Bytes from the host to the unit; returns how many its line took."""
        return self.unit.receive(data)

    def host_baud(self, baud: int | None) -> None:
        """The host's end of a line with a rate runs at this one; None: at whatever the unit's."""
        self.unit.host_baud(self.unit.line_baud if baud is None else baud)

    def receive(self, bytes_max: int = 8192) -> bytes:
        """Bytes the unit has sent to the host since the last call, at most `bytes_max`."""
        return self.unit.transmit(bytes_max)

    def observe(self) -> dict[str, Any]:
        """What an observer beside the bike sees (unit_observation in unit.h); missing is NaN."""
        return self.unit.observe()

    def rider(self, kind: str, torque_nm: float = 0.0, cadence_rpm_max: float = 100.0) -> None:
        """`kind`: off, constant (a servo) or legs (two strokes a turn)."""
        rider = {"kind": kind, "torque_nm": torque_nm, "cadence_rpm_max": cadence_rpm_max}
        self.simulation_set({"rider": rider})

    def road(self, grade_deg: float = 0.0, wind_ms: float = 0.0) -> None:
        """The slope, and the wind against the direction of travel."""
        self.simulation_set({"road": {"grade_deg": grade_deg, "wind_ms": wind_ms}})

    def brake(self, pulled: bool) -> None:
        """Pulls or releases the brake lever."""
        self.simulation_set({"brake": pulled})

    def select_mode(self, mode: int) -> None:
        """Selects an assist-mode slot, 0 to 4, on the handlebar."""
        self.simulation_set({"assist_mode": mode})

    def place(self, speed_kmh: float) -> None:
        """Puts the bike on the road at this speed, its energy ledger and noise started afresh."""
        before_m = self._distance_m
        self._leave_workbench()
        self.unit.place(speed_kmh, self.seed)
        if self._script is not None:
            self._script.put_back(before_m, self._distance_m)

    def hang(self, mass_kg: float, side: str = "right", **said: float) -> None:
        """Hangs a mass on a pedal of the bike on a workbench; `said`: of sim_device.workbench."""
        self.simulation_set({"workbench": {"mass_kg": mass_kg, "side": side, **said}})

    def simulation_get(self) -> dict[str, Any]:
        """The JSON object of SIM_GET."""
        seen = self.observe()
        phase = self._phase
        return {
            "scenario": self._script.scenario.name if self._script else None,
            "running": self._running,
            "speed_factor": self.speed_factor,
            "clock": self.clock,
            "advance_left_s": self.owed_us / US_PER_S,
            "t_s": seen["t_s"],
            "seed": self.seed,
            "rider": {
                "kind": phase.rider,
                "torque_nm": phase.torque_nm,
                "cadence_rpm_max": phase.cadence_rpm_max,
            },
            "road": {"grade_deg": phase.grade_deg, "wind_ms": phase.wind_ms},
            **choices_made(self._bike),
            "dyno_nm": self._dyno_now_nm,
            "mass_kg": self._bike["road.mass_kg"],
            "assist_mode": seen["assist_mode"],
            "brake": phase.brake,
            "walk_button": phase.walk_button,
            "ambient_degc": self._bike.get("sensor.ambient_degc", 20.0),
            "grip": self._bike.get("road.grip", 0.0),
            "faults": phase.faults,
            "workbench": self._workbench.as_controls() if self._workbench else None,
            "rotor_link": {
                "words_good": seen["words_good"],
                "words_bad": seen["words_bad"],
                "words_lost": seen["words_lost"],
            },
            "energy_balance_error_pct": _rounded(seen["energy_balance_error_pct"]),
            "energy_consistent": bool(seen["energy_consistent"]),
            "label": None if seen["energy_consistent"] else NOT_CONSISTENT,
        }

    def simulation_set(self, changes: dict[str, Any]) -> None:
        """Changes what is named, as SIM_SET does. Raises ScenarioError and changes nothing.

        Taking rider, road or brake into one's own hands stops a running scenario.
        """
        self._apply(self._read(json.dumps(changes)))

    def answer(self, message_id: int, request: bytes) -> tuple[int, bytes]:
        """Status and body for a board request: SIM_GET and SIM_SET."""
        if message_id not in (MessageId.SIM_GET, MessageId.SIM_SET):
            return Status.UNKNOWN_MSG, b""
        if message_id == MessageId.SIM_SET:
            try:
                self._apply(self._read(plain(request)))
            except ScenarioError as error:
                return Status.RANGE, f"{error.field}\n{error}".encode()
        return Status.OK, pack(self.simulation_get())

    def _read(self, text: str) -> Changes:
        return parse_changes(text, self._own)

    def _apply(self, changes: Changes) -> None:
        self._keep_time(changes)
        if changes.seed is not None:
            self.seed = changes.seed
            self.unit.seed_noise(changes.seed)
        if changes.speed_factor is not None:
            self.speed_factor = changes.speed_factor
        self._dyno_nm = changes.by_hand.get("dyno_nm", self._dyno_nm)
        if changes.bike:
            self._change_bike(changes.bike)
        if changes.stop_scenario:
            self._script, self._running = None, False
        if changes.scenario is not None:
            self._start(self._own.get(changes.scenario) or load(changes.scenario))
        if changes.workbench:
            self._hang(replace(self._workbench or Workbench(), **changes.workbench))
        if changes.leave_workbench or changes.running:
            self._leave_workbench()
        if changes.phase:
            self._running = self._running and set(changes.phase) == {"assist_mode"}
        self._by_hand |= changes.by_hand
        if changes.running is not None:
            self._running = changes.running and self._script is not None and not self._script.over
        self._perform(replace(self._phase, **changes.phase))

    def _keep_time(self, changes: Changes) -> None:
        clock = changes.clock or self.clock
        if changes.advance_s is not None and clock != "virtual":
            raise ScenarioError("advance_s: the clock is real; set clock to virtual first")
        if clock != self.clock:
            self.clock, self.owed_us = clock, 0
        self.owed_us += round((changes.advance_s or 0.0) * US_PER_S)

    def _change_bike(self, values: dict[str, float]) -> None:
        self._bike.update(values)
        self.unit.change_bike(values)

    def _hang(self, workbench: Workbench) -> None:
        """What hangs there already does not begin to swing."""
        self._running = False
        if workbench != self._workbench:
            self._times_hung += 1
            self.unit.hang_mass(hung(workbench, self.seed, self._times_hung))
        self._workbench = workbench

    def _leave_workbench(self) -> None:
        self._workbench = None
        self.unit.hang_mass(None)

    def _start(self, scenario: ScenarioFile) -> None:
        self._leave_workbench()
        self._by_hand = self._sensor.by_hand()
        self._leave_scenario_bike()
        if scenario.bike:
            self._before_scenario = {path: self._bike_value(path) for path in scenario.bike}
            self._change_bike(scenario.bike | self._sensor.bike)
            self.unit.renew()
        if scenario.speed_kmh is not None:
            self.unit.place(scenario.speed_kmh, self.seed)
        self._script, self._running = Script(scenario, self._distance_m), True
        self._perform(self._script.phase)

    def _leave_scenario_bike(self) -> None:
        """Gives back what the scenario before had changed of the bike and around it."""
        usual = {path: value for paths, value in _SURROUNDINGS.values() for path in paths}
        around = {path: value for path, value in usual.items() if path in self._bike}
        if around or self._before_scenario:
            self._change_bike(around | self._before_scenario)
        self._before_scenario = {}

    def _bike_value(self, path: str) -> float:
        return self._bike[path] if path in self._bike else default_bike()[path]

    @property
    def _distance_m(self) -> float:
        return float(self.unit.observe(("distance_m",))["distance_m"])

    def _advance_in_phase(self, left_us: int) -> int:
        """Lets at most `left_us` pass, not beyond the end of a phase; how much did."""
        script = self._script
        if script is None:
            return self.unit.advance_us(left_us)
        if not self._running:
            before_m = self._distance_m
            passed_us = self.unit.advance_us(left_us)
            script.put_back(before_m, self._distance_m)
            return passed_us
        passed_us = self.unit.advance_us(min(left_us, script.left_us), script.end_m)
        if not self._running or self._script is not script:  # the host has said so meanwhile
            return passed_us
        script.passed(passed_us, self._distance_m)
        if script.over:
            self._running = False
        elif script.phase is not self._scripted:
            self._perform(script.phase)
        return passed_us

    def _perform(self, scripted: Phase) -> None:
        self._scripted = scripted
        self._phase = phase = replace(scripted, **self._by_hand)
        self._surround(phase)
        self.unit.set_rider(RIDER_KINDS[phase.rider], phase.torque_nm, phase.cadence_rpm_max)
        self.unit.set_road(
            grade_deg=phase.grade_deg,
            wind_ms=phase.wind_ms,
            dyno_nm=self._dyno_now_nm,
            brake=phase.brake,
        )
        self.unit.set_faults(
            {
                "torque_sensor": TORQUE_SENSOR_FAULTS[phase.torque_sensor],
                "speed_sensor": SPEED_SENSOR_FAULTS[phase.speed_sensor],
                "link_lost": int(phase.link_lost),
                "motor_hall": int(phase.motor_hall),
                "battery_cut": int(phase.battery_cut),
                "motor_warmer_k": phase.motor_warmer_k,
                "controller_warmer_k": phase.controller_warmer_k,
                "pulses_missed": phase.pulses_missed,
            }
        )
        self.unit.hold_walk_button(phase.walk_button)
        if phase.assist_mode is not None:
            self.unit.select_mode(phase.assist_mode)

    @property
    def _dyno_now_nm(self) -> float:
        """What a scenario does not load stays as it was loaded by hand."""
        return self._dyno_nm if self._phase.dyno_nm is None else self._phase.dyno_nm

    def _surround(self, phase: Phase) -> None:
        """Puts air, road and link into the state the phase names; what it leaves out stays."""
        changed = {
            path: float(value)
            for name, (paths, usual) in _SURROUNDINGS.items()
            if (value := getattr(phase, name)) is not None
            for path in paths
            if self._bike.get(path, usual) != value
        }
        if changed:
            self._bike.update(changed)
            self.unit.change_surroundings(changed)


def _rounded(value: float) -> float | None:
    """A percentage as short as it is worth: the answer has to fit a frame."""
    finite = finite_or_none(value)
    return None if finite is None else round(finite, 6)
