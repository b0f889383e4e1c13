"""What comes with Spindle: configurations, tables, scenarios, and a sample ride."""

from __future__ import annotations

from sim_device.lockstep import LockstepUnit
from sim_device.preset import load, names
from sim_device.scenario_file import load as load_scenario
from sim_device.scenario_file import names as scenario_names

__all__ = ["load", "names"]


def live_scenarios() -> list[tuple[str, str]]:
    """Name and purpose of each; those that are only measured in virtual time are not among them."""
    scenarios = [load_scenario(name) for name in scenario_names()]
    return [(scenario.name, scenario.doc) for scenario in scenarios if scenario.live]


SAMPLE_SCENARIO = "commute"
SAMPLE_SEED = 7
SAMPLE_S = 1.0
# The modes of the factory that give more and more, then the fuzzy one.
SAMPLE_MODES = ((0, 1), (60, 2), (110, 3))
"""Seconds after the start, and the slot chosen then."""
FLASH_PAGE_BYTES = 512


def sample_log() -> bytes:
    """The flash for ride logs after one round of the scenario: blocks that each stand alone.

    The same bytes each time: the noise has its seed, and time is the unit's own.
    """
    unit = LockstepUnit(SAMPLE_SEED, name="sample", scenario=SAMPLE_SCENARIO)
    chosen = 0
    for state in unit.ride_once(SAMPLE_S):
        while chosen < len(SAMPLE_MODES) and state["t_s"] >= SAMPLE_MODES[chosen][0]:
            unit.select_mode(SAMPLE_MODES[chosen][1])
            chosen += 1
    log = unit.unit.log()
    written = len(log.rstrip(b"\xff"))
    return log[: -(-written // FLASH_PAGE_BYTES) * FLASH_PAGE_BYTES]
