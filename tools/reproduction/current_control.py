"""Writes docs/current-law.md: `python -m tools.reproduction.current_control`, two minutes.

The last step of the list that the page Why shows is what the motor gave less what the law, run
again on the recorded readings, tells it. Here it is measured on rides that a server recorded: five
minutes of every scenario that is ridden, in every sample, at the crank.
"""

import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from backend import law
from backend.rides.replay.service import law_inputs, read_columns
from backend.store import open_store
from sim_device.scenario_file import load, names
from tests.fakes.server import ServerProcess, SpindleServer, eventually

PAGE = Path(__file__).resolve().parents[2] / "docs" / "current-law.md"
RIDDEN_S, REST_S = 300.0, 60.0
HEAD = """# What current control misses

`current_control`, the last step of `GET /rides/{id}/why`, is what the motor delivered, as the unit
tells it, less what the law tells the motor when it runs again on the recorded readings; at the
crank. Its size is measured here in every sample of five minutes of each scenario in which either is
above nothing. Written by `python -m tools.reproduction.current_control`.

| scenario | assisted, s | median, Nm | 99 % within, Nm | told the motor, Nm (99 %) |
|---|---|---|---|---|
"""
TAIL = """
What a sample tells of the motor is of the control step before, readings are rounded to their
channels' scales, and a motor that spins slower than the crank pushes nothing whatever it is told.
"""


def recorded(server: SpindleServer, name: str) -> tuple[int, dict[str, Any]]:
    """The id of the longest ride that a scenario's minutes became on a unit of their own, and the
    unit's configuration."""
    url = f"sim:{name}?clock=virtual&scenario=none"
    device = server.ask("POST", "/devices", json={"url": url})["id"]
    eventually(lambda: server.get(f"/devices/{device}")["state"], lambda state: state == "ready")
    config = server.get(f"/devices/{device}/config")["parameters"]
    before = {ride["id"] for ride in server.get("/rides")["items"]}
    advance = f"/devices/{device}/simulation/advance"
    server.simulate(device, scenario=name, seed=load(name).seed)
    server.ask("POST", advance, json={"seconds": RIDDEN_S})
    server.simulate(device, scenario=None, rider={"kind": "off"}, brake=True, faults={})
    server.ask("POST", advance, json={"seconds": REST_S})
    rides = eventually(
        lambda: [ride for ride in server.get("/rides")["items"] if ride["id"] not in before],
        lambda found: found and all(ride["state"] == "done" for ride in found),
    )
    server.client.delete(f"/devices/{device}")
    return int(max(rides, key=lambda ride: ride["row_count"])["id"]), config


def row(name: str, columns: dict[str, Any], config: dict[str, Any], step_s: float) -> str:
    """One scenario's line."""
    readings = law.law_readings(config, law_inputs(columns))
    told_nm = np.asarray(law.replay(config, step_s=step_s, **readings).motor_torque_nm)
    delivered_nm = columns["motor_torque_nm"]
    driven = (told_nm > 0.0) | (delivered_nm > 0.0)
    gear = config["gear_ratio"]
    missed_nm = np.abs(delivered_nm - told_nm)[driven & np.isfinite(delivered_nm)] * gear
    median_nm, most_nm = np.percentile(missed_nm, [50, 99])
    torque_nm = np.percentile(told_nm[driven], 99) * gear
    seconds = len(missed_nm) * step_s
    return f"| {name} | {seconds:.0f} | {median_nm:.2f} | {most_nm:.1f} | {torque_nm:.0f} |\n"


def main() -> None:
    live = [name for name in names() if load(name).live]
    with tempfile.TemporaryDirectory() as folder:
        data = Path(folder)
        server = ServerProcess(data, []).start()
        try:
            rides = {name: recorded(server, name) for name in live}
        finally:
            server.stop()
        rows = []
        with open_store(f"sqlite:///{data}/spindle.db", f"file://{data}/objects") as store:
            for name, (ride_id, config) in rides.items():
                reader = store.rides.reader(ride_id)
                step_s = (reader.period_us or 0) / 1e6
                rows.append(row(name, read_columns(reader), config, step_s))
    PAGE.write_text(HEAD + "".join(rows) + TAIL, encoding="utf-8")


if __name__ == "__main__":
    main()
