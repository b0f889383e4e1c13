"""The scenarios that a simulated unit can ride, as the simulator describes them."""

from __future__ import annotations

from sim_device.scenario_file import load, names


def live_scenarios() -> list[tuple[str, str]]:
    """Name and purpose of each; those that are only measured in virtual time are not among them."""
    scenarios = [load(name) for name in names()]
    return [(scenario.name, scenario.doc) for scenario in scenarios if scenario.live]
