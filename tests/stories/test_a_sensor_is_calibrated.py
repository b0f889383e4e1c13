"""Goal: whoever hangs masses on a pedal gets a calibrated sensor, whatever is lost on the way: the
cable, the server, the right mass.

Method: a server, the unit's firmware behind a cable that is pulled, its sensor with a zero and a
gain of its own. Masses hang on the workbench of the simulated bike: they swing at first, and
mass, arm and angle are in truth off within their limits. What is found is compared with what was
planted, and the file is worked out again by the command without a server.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from backend.calibration.describe import has_record
from backend.cli import main
from tests.fakes.relay import Relay
from tests.fakes.server import ServerHere, ServerProcess, eventually
from tests.fakes.simulated_unit import UnitOnPort

pytestmark = pytest.mark.slow

PLANTED_ZERO = 40
SCENARIO = """
doc = "A workshop: nobody rides."
seed = 7
repeat = true

[bike.sensor]
noise_nm = 0.06
gain = {gain}
zero_counts = {zero}

[[phases]]
seconds = 36000
rider = "off"
brake = true
"""
COUNTS_PER_NM = 100.0
GRAVITY_MS2, ARM_M = 9.81, 0.17
# A mass that was hung swings no more.
SETTLES_S = 15.0
MASS_LIMIT_SHARE = 1.6e-4
"""Of class M2, OIML R 111-1:2004, table 1."""

SETUP: dict[str, Any] = {
    "arm_m": ARM_M,
    "arm_limit_m": 0.0003,
    "gravity": {"gravity_ms2": GRAVITY_MS2, "standard_ms2": 1e-4},
    "masses": [{"name": "discs", "mass_kg": 10.0, "mass_class": "M2"}],
    "loads_kg": [10.0, 25.0, 40.0],
    "full_scale_nm": 80.0,
}
GAIN = "sensor_gain_nm_per_count"


class Workshop:
    """A unit on a cable, and the server that is asked; `path` of the open calibration.

    gain: of its sensor, times that of the one as drawn. maker: whose tokens it takes. here: the
    server is on a thread of the test, where it is not to be killed. Time passes for the unit only
    while a mass is waited for.
    """

    def __init__(self, folder: Path, gain: float, maker: Path, here: bool = False) -> None:
        self.gain = gain
        scenario = folder / "workshop.toml"
        scenario.write_text(SCENARIO.format(gain=gain, zero=PLANTED_ZERO), encoding="utf-8")
        words = ["--virtual", "--seed", "7", "--scenario", str(scenario)]
        self.unit = UnitOnPort(*words, "--unlock-key", f"{maker}.pub")
        self.cable = Relay(self.unit.port)
        self.data = folder / "data"
        self.start(here)

    def start(self, here: bool = False) -> None:
        """Starts the server; it tells where the unit stands."""
        url = f"socket://127.0.0.1:{self.cable.port}"
        server = ServerHere if here else ServerProcess
        self.server: ServerHere | ServerProcess = server(self.data, [url]).start()
        self.device = self.server.ready_device()
        self.server.advance(self.device, 1.0)

    def end(self) -> None:
        self.server.stop()
        self.cable.cut()
        self.unit.unplug()

    def config(self) -> dict[str, Any]:
        parameters: dict[str, Any] = self.server.get(f"/devices/{self.device}/config")["parameters"]
        return parameters

    def open(self) -> dict[str, Any]:
        job = self.server.ask("POST", "/calibrations", json={"device_id": self.device})
        self.path = f"/calibrations/{job['id']}"
        return self.job()

    def job(self) -> dict[str, Any]:
        job: dict[str, Any] = self.server.get(self.path)
        return job

    def hang(self, mass_kg: float, side: str = "right") -> None:
        """Hang a mass there and wait until the reading says that it hangs still."""
        bench = {"side": side, "mass_kg": mass_kg, "crank_angle_deg": 0.0, "arm_m": ARM_M}
        self.server.simulate(self.device, workbench={**bench, "mass_limit_share": MASS_LIMIT_SHARE})
        self.wait_still(mass_kg)

    def wait_still(self, mass_kg: float) -> None:
        """Wait until the reading is that of a mass, to a share that arm and mass may be off by."""
        seen = mass_kg * GRAVITY_MS2 * ARM_M * self.gain * COUNTS_PER_NM + PLANTED_ZERO

        def hangs(reading: dict[str, Any]) -> bool:
            return bool(reading["steady"]) and abs(reading["mean_counts"] - seen) < 10 + seen / 200

        self.server.advance(self.device, SETTLES_S)
        eventually(lambda: self.server.get(f"{self.path}/reading"), hangs)

    def next_state(self) -> dict[str, Any] | None:
        job = self.job()
        if job["next_step"] is None:
            return None
        state = job["steps"][job["next_step"]]["state"]
        return {name: value for name, value in state.items() if name != "sensor_degc"}

    def capture(self, count: int = 1000, hung_kg: float | None = None) -> None:
        """The next steps; something else than is said may hang there."""
        while count and (state := self.next_state()) is not None:
            self.hang(state["mass_kg"] if hung_kg is None else hung_kg, state["side"])
            self.server.ask("POST", f"{self.path}/captures", json=state)
            count -= 1

    def refused(self, path: str, body: object = None) -> list[str]:
        """The code of a POST that must not succeed, and those of the faults it names."""
        answer = self.server.client.post(f"{self.path}{path}", json=body)
        assert answer.is_error, answer.text
        told = answer.json()
        return [told["code"], *(fault["code"] for fault in told["errors"])]


@pytest.fixture
def maker(tmp_path: Path) -> Path:
    """The maker's key, and its public half beside it."""
    key = tmp_path / "maker.pem"
    assert main(["unlock", "keygen", str(key)]) == 0
    return key


@pytest.fixture
def workshop(tmp_path: Path, maker: Path, request: pytest.FixtureRequest) -> Iterator[Workshop]:
    gain, here = request.param
    made = Workshop(tmp_path, gain, maker, here=here)
    yield made
    made.end()


def of_gain(gain: float, here: bool) -> pytest.MarkDecorator:
    return pytest.mark.parametrize("workshop", [(gain, here)], indirect=True, ids=[f"gain {gain}"])


def within_its_uncertainty(worked: dict[str, Any], gain: float) -> float:
    """The truth is as near as is said, at zero and full scale; how near at full scale, in Nm."""
    fit, budget = worked["fit"]["coefficients"], worked["budget"]
    for place, torque_nm in ((0, 0.0), (-1, 80.0)):
        counts = PLANTED_ZERO + torque_nm * gain * COUNTS_PER_NM
        found_nm = (counts - fit["offset_counts"]) * fit["gain_nm_per_count"]
        assert abs(found_nm - torque_nm) < budget["expanded_nm"][place]
    return float(budget["expanded_nm"][-1])


@pytest.mark.long
@of_gain(1.03, here=False)
def test_a_sensor_is_calibrated_though_cable_server_and_a_mass_go_wrong(
    workshop: Workshop, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = workshop.config()
    opened = workshop.open()
    assert {check["code"]: check["passed"] for check in opened["checks"]}["standing"]
    workshop.server.ask("PUT", f"{workshop.path}/setup", json=SETUP)
    workshop.capture(4)

    # The cable is pulled, and put in again.
    workshop.cable.cut()
    eventually(workshop.job, lambda job: job["device_id"] is None)
    assert workshop.refused("/captures", {"kind": "zero"}) == ["not_connected"]
    workshop.cable.mend()
    eventually(workshop.job, lambda job: job["device_id"] is not None)
    workshop.capture(4)

    # The server is gone without a word.
    kept = workshop.job()["captures"]
    assert isinstance(workshop.server, ServerProcess)
    workshop.server.kill()
    workshop.start(here=True)
    assert workshop.open()["captures"] == kept
    assert len(kept) == 8

    # 20 kg hang where 10 kg are said.
    workshop.capture(1)
    workshop.capture(1, hung_kg=20.0)
    workshop.capture()
    assert workshop.refused("/fit") == ["captures_contradict", "wrong_mass"]
    (wrong,) = [one for one in workshop.job()["captures"] if one["refusals"]]
    assert wrong["number"] == 10
    said = {"reason": "the wrong disc"}
    workshop.server.ask("DELETE", f"{workshop.path}/captures/10", params=said)
    workshop.capture()

    fitted = workshop.server.ask("POST", f"{workshop.path}/fit")
    expanded_nm = within_its_uncertainty(fitted["worked"], workshop.gain)
    causes = {cause["code"] for cause in fitted["worked"]["judgement"]["causes"]}
    assert {"not_verified", "gain_not_noise"} <= causes
    assert workshop.config() == before

    written = workshop.server.ask("POST", f"{workshop.path}/write", params={"reason": "a story"})
    assert written["state"] == "written"
    assert has_record(workshop.config(), written["changes"][-1]["record"])
    newest = workshop.server.get(f"/devices/{workshop.device}/config/revisions")["items"][0]
    assert newest["reason"] == "a story"

    workshop.hang(30.0)
    verified = workshop.server.ask(
        "POST", f"{workshop.path}/verify", json={"side": "right", "mass_kg": 30.0}
    )
    (check,) = verified["worked"]["verifications"]
    assert check["unseen"]
    assert check["en"] <= 1
    # What the unit itself tells, by what was written into it.
    assert verified["captures"][-1]["unit_nm"] == pytest.approx(
        30.0 * GRAVITY_MS2 * ARM_M, abs=expanded_nm
    )

    closed = workshop.server.ask("POST", f"{workshop.path}/close")
    assert closed["result"]["verdict"] == verified["worked"]["judgement"]["verdict"]
    file = next((workshop.data / "objects" / "calibrations").rglob("*.json"))
    assert main(["calibrate", "evaluate", str(file)]) == 0
    assert "follows from the raw captures" in capsys.readouterr().out
    assert json.loads(file.read_text())["written"]["sha256"] == written["certificate_sha256"]


@of_gain(1.2, here=True)
def test_with_the_maker_s_word_and_back_to_what_the_unit_had(
    workshop: Workshop, maker: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A small plan, from a shell; a gain beyond the band."""

    def spindle(method: str, path: str, *words: str, ends: int = 0) -> Any:
        capsys.readouterr()
        given = [method, path, *words, "--server", workshop.server.url, "--json"]
        code = main(["api", *given])
        said = capsys.readouterr()
        assert code == ends, said.out + said.err
        return json.loads(said.out)

    before = workshop.config()
    setup = tmp_path / "setup.json"
    setup.write_text(json.dumps({**SETUP, "loads_kg": [10.0, 40.0], "sides": ["right"]}))
    spindle("POST", "/calibrations", f"device_id={workshop.device}")
    workshop.open()
    path = workshop.path
    spindle("PUT", f"{path}/setup", "--input", str(setup))
    workshop.capture()
    workshop.hang(10.0)
    extra = {"kind": "load", "side": "right", "mass_kg": 10.0, "stroke": 3, "direction": "loading"}
    workshop.server.ask("POST", f"{path}/captures", json=extra)
    struck = spindle("DELETE", f"{path}/captures/13", "reason=one too many")
    assert struck["captures"][-1]["struck"]["reason"] == "one too many"

    fitted = spindle("POST", f"{path}/fit")
    assert fitted["worked"]["judgement"]["verdict"] != "fail"
    challenge = tmp_path / "challenge.json"
    challenge.write_text(json.dumps(spindle("POST", f"{path}/write", ends=1)))
    assert workshop.config() == before
    assert main(["unlock", "sign", str(maker), str(challenge)]) == 0
    token = capsys.readouterr().out.strip()
    spindle("POST", f"{path}/write", "reason==from the shell", f"token=={token}")
    assert workshop.config()[GAIN] == pytest.approx(0.01 / workshop.gain, rel=2e-3)
    workshop.hang(25.0)
    verified = spindle("POST", f"{path}/verify", "side=right", "mass_kg=25")
    assert verified["worked"]["verifications"][-1]["en"] <= 1
    spindle("POST", f"{path}/restore")
    assert workshop.config() == before
    assert spindle("POST", f"{path}/close")["changes"][-1]["kind"] == "restore"

    file = tmp_path / "calibration-1.json"
    paper = ("GET", f"{path}/certificate.pdf", "-o")
    file.write_text(json.dumps(spindle("GET", f"{path}/certificate")))
    assert main(["calibrate", "evaluate", str(file)]) == 0
    asked, kept = tmp_path / "asked.pdf", tmp_path / "kept.pdf"
    assert main(["api", *paper, str(asked), "--server", workshop.server.url]) == 0
    assert main(["calibrate", "paper", str(file), str(kept)]) == 0
    assert asked.read_bytes() == kept.read_bytes()
