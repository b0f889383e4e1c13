"""Simulate: what a simulated unit can be sent on, and time that passes for one at once."""

from __future__ import annotations

import time
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

from backend.errors import Conflict, NoAnswer
from backend.law.scenarios import live_scenarios
from backend.services.units.inspection import Inspection

LOOK_EVERY_S = 0.01
# A unit that has not lived through a tenth of a second in this long never will.
STUCK_S = 15.0


@dataclass(frozen=True)
class Scenario:
    """A ride that a simulated unit can be sent on: `scenario` of its simulation takes the name."""

    name: str
    description: str


def scenarios() -> list[Scenario]:
    """Every scenario that can be ridden."""
    return [Scenario(name, doc) for name, doc in live_scenarios()]


def advance(inspection: Inspection, device_id: str, seconds: float) -> dict[str, Any]:
    """Let `seconds` pass and return what rider, road and clock do then.

    Every row the unit built in that time has arrived by then, but for the two or three that wait
    for their frame to be full. Raises Conflict for a real unit and for a clock that runs by itself,
    NoAnswer when time does not pass.
    """
    seen = inspection.simulation(device_id)
    if seen.get("clock") != "virtual":
        raise Conflict(
            f"The clock of {device_id} runs by itself; set `clock` of its simulation to "
            "`virtual`, or add the unit as `sim:NAME?clock=virtual`."
        )
    seen = inspection.simulate(device_id, {"advance_s": seconds})
    last_left_s, last_s = seen["advance_left_s"], time.monotonic()
    while seen["advance_left_s"] > 0:
        time.sleep(LOOK_EVERY_S)
        # A unit that computes on a busy machine may answer late; STUCK_S ends the waiting.
        with suppress(NoAnswer):
            seen = inspection.simulation(device_id)
        now_s = time.monotonic()
        if seen["advance_left_s"] != last_left_s:
            last_left_s, last_s = seen["advance_left_s"], now_s
        elif now_s - last_s > STUCK_S:
            raise NoAnswer(
                f"{device_id}: {last_left_s:g} s of {seconds:g} s are still to pass, and none has "
                f"for {STUCK_S:g} s. Look whether its process and its line are alive."
            )
    return seen
